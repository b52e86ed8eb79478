# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Properties that users give to the cells of a diagram."""

from __future__ import annotations

import datetime
import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._errors import warn_caller


def checked_properties(
    properties: Mapping[str, Any] | None,
    taken: tuple[str, ...],
    count: int,
    *,
    as_json: bool = False,
) -> dict[str, Any]:
    """The properties, if each has a name of its own and a value for every site.

    If they become JSON, infinite numbers are told.
    """
    checked: dict[str, Any] = {}
    for key, values in (properties or {}).items():
        name = str(key)
        if name in taken or name in checked:
            raise ValueError(f"the name {name!r} is taken: call the property something else")
        if len(values) != count:
            raise ValueError(f"the property {name!r} has {len(values)} values for {count} sites")
        if as_json and (num_infinite := _num_infinite(values)):
            warn_caller(
                f"the property {name!r} has infinite numbers ({num_infinite}), which become null"
            )
        checked[name] = values
    return checked


def _num_infinite(values: Any) -> int:
    if getattr(values, "dtype", None) is not None and values.dtype.kind == "f":
        return int(np.isinf(np.ma.asarray(values).compressed()).sum())
    numbers = (value for value in values if isinstance(value, (float, np.floating)))
    return sum(map(math.isinf, numbers))


def json_cells(values: Any) -> list[str]:
    """Each value as JSON; an empty text is null."""
    if np.ma.is_masked(values):
        masked = np.ma.getmaskarray(values).reshape(len(values), -1).all(axis=1)
        cells = json_cells(np.ma.getdata(values))
        return ["" if gone else cell for cell, gone in zip(cells, masked.tolist(), strict=True)]
    array = np.asarray(values if hasattr(values, "dtype") else [])
    kind = array.dtype.kind if array.shape == (len(values),) else "O"
    if kind in "iu":
        return [str(value) for value in array.tolist()]
    if kind == "b":
        return ["true" if value else "false" for value in array.tolist()]
    if kind == "f":
        floats = array.astype(np.float64).tolist()
        return [repr(value) if math.isfinite(value) else "" for value in floats]
    if kind == "M":
        texts = np.datetime_as_string(array).tolist()
        return ["" if text == "NaT" else json.dumps(text) for text in texts]
    return [_json_cell(value) for value in values]


def _json_cell(value: Any) -> str:
    """One value of a sequence of any."""
    if isinstance(value, np.generic) and value.dtype.kind in "iubfM":
        return json_cells(np.array([value]))[0]
    if is_missing(value):
        return ""
    if isinstance(value, float) and not math.isfinite(value):
        return ""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, default=_as_text)


def is_missing(value: Any) -> bool:
    """Whether it is None, what is masked, or pandas' NaT or NA, which cannot be compared."""
    return value is None or value is np.ma.masked or type(value).__name__ in ("NaTType", "NAType")


def with_gaps(values: Any) -> Any:
    """An array; what is masked is NaN or NaT, or None where the values are no numbers or times."""
    if isinstance(values, (list, tuple)) and any(value is np.ma.masked for value in values):
        values = np.ma.stack(values)
    array = np.asarray(values)
    if not np.ma.is_masked(values):
        return array
    masked = np.ma.getmaskarray(values)
    if array.dtype.kind in "mM":
        return np.where(masked, np.array("NaT", array.dtype), array)
    if array.dtype.kind in "biuf":
        kind = array.dtype if array.dtype.kind == "f" else np.float64
        return np.where(masked, np.nan, array).astype(kind)
    found = array.astype(object)
    found[masked] = None
    return found


def _as_text(value: Any) -> str:
    if isinstance(value, (datetime.date, datetime.time)):
        return value.isoformat()
    return str(value)
