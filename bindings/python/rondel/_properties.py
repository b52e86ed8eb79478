# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Properties that users give to the cells of a diagram."""

from __future__ import annotations

import datetime
import json
import math
import re
import sys
from collections.abc import Mapping, Set
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
    properties = {} if properties is None else properties
    if not isinstance(properties, Mapping):
        kind = type(properties).__name__
        raise TypeError(
            f"properties must be a mapping of names to values, not {kind}; dict(table) makes a "
            "mapping of a table"
        )
    for key, values in properties.items():
        name = str(key)
        if name in taken or name in checked:
            raise ValueError(f"the name {name!r} is taken: call the property something else")
        if not _is_column(values):
            kind = type(values).__name__
            raise TypeError(f"the property {name!r} must have a value for each site, but is {kind}")
        if len(values) != count:
            raise ValueError(f"the property {name!r} has {len(values)} values for {count} sites")
        if as_json and (num_infinite := _num_infinite(values)):
            warn_caller(
                f"the property {name!r} has infinite numbers ({num_infinite}), which become null"
            )
        checked[name] = values.values if are_labeled(values) else values
    return checked


def _is_column(values: Any) -> bool:
    """Whether it has one value after another: no single value, set, mapping or table."""
    is_single = isinstance(values, (str, bytes)) or getattr(values, "ndim", 1) == 0
    is_other = isinstance(values, (Mapping, Set)) or hasattr(type(values), "columns")
    return hasattr(values, "__len__") and not (is_single or is_other)


def _num_infinite(values: Any) -> int:
    if getattr(values, "dtype", None) is not None and values.dtype.kind == "f":
        return int(np.isinf(np.ma.asarray(values).compressed()).sum())
    numbers = (value for value in values if isinstance(value, (float, np.floating)))
    return sum(map(math.isinf, numbers))


def json_columns(named: Mapping[str, Any]) -> list[tuple[str, list[str]]]:
    """Columns of JSON with their names; refuses what no file of GeoJSON may have."""
    columns = []
    for name, values in named.items():
        try:
            cells = json_cells(values)
        except ValueError as error:
            raise ValueError(f"the property {name!r}: {error}") from None
        bad = next((text for text in (name, *cells) if not _is_text(text)), None)
        if bad is not None:
            raise ValueError(
                f"the property {name!r} has the text {bad!a}, which has the character U+0000 or is "
                "not UTF-8"
            )
        columns.append((name, cells))
    return columns


def _is_text(text: str) -> bool:
    if "\0" in text or re.search(r"(?<!\\)(\\\\)*\\u0000", text):
        return False
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def json_cells(values: Any) -> list[str]:
    """Each value as JSON; an empty text is null."""
    if np.ma.is_masked(values):
        masked = np.ma.getmaskarray(values).reshape(len(values), -1).all(axis=1)
        cells = json_cells(np.ma.getdata(values))
        return ["" if gone else cell for cell, gone in zip(cells, masked.tolist(), strict=True)]
    array = plain(values if hasattr(values, "dtype") else [])
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


def are_labeled(*arrays: Any) -> bool:
    """Whether all arrays are those of xarray, whose dimensions have names."""
    xarray = sys.modules.get("xarray")
    return xarray is not None and all(isinstance(array, xarray.DataArray) for array in arrays)


def is_missing(value: Any) -> bool:
    """Whether it is None, what is masked, or pandas' NaT or NA, which cannot be compared."""
    return value is None or value is np.ma.masked or type(value).__name__ in ("NaTType", "NAType")


def plain(values: Any) -> Any:
    """An array of NumPy; of pandas' integers, some of which are missing, an array of objects."""
    dtype = getattr(values, "dtype", None)
    is_of_pandas = hasattr(dtype, "na_value") and getattr(dtype, "kind", "") in "iu"
    return np.asarray(values, object if is_of_pandas and values.isna().any() else None)


def stacked(values: Any) -> Any:
    """A masked array of a list whose elements are numbers or `masked`, or masked arrays."""
    lost = [value is np.ma.masked for value in values]
    if all(lost) or any(np.ndim(value) > 0 for value in values):
        return np.ma.stack(values)
    known = values[lost.index(False)]  # in place of what is masked
    return np.ma.array(
        [known if gone else value for value, gone in zip(values, lost, strict=True)], mask=lost
    )


def with_gaps(values: Any) -> Any:
    """An array; what is masked is NaN or NaT, or None where the values are no numbers or times."""
    if isinstance(values, (list, tuple)) and any(value is np.ma.masked for value in values):
        values = stacked(values)
    array = plain(values)
    if not np.ma.is_masked(values):
        return array
    masked = np.ma.getmaskarray(values)
    if array.dtype.kind in "mM":
        return np.where(masked, np.array("NaT", array.dtype), array)
    is_wide = array.dtype.kind in "iu" and not are_doubles(array[~masked])
    if array.dtype.kind in "biuf" and not is_wide:
        kind = array.dtype if array.dtype.kind == "f" else np.float64
        return np.where(masked, np.nan, array).astype(kind)
    found = array.astype(object)
    found[masked] = None
    return found


def are_doubles(integers: Any) -> bool:
    """Whether each of the integers is equal to a double."""
    return all(is_double(value) for value in integers.tolist() if abs(value) > 2**53)


def is_double(value: int) -> bool:
    try:
        return int(float(value)) == value
    except OverflowError:
        return False


def frame_column(values: Any) -> Any:
    """An array for a GeoDataFrame in which values keep their types: integers of which some are
    missing are those of pandas, which have a mask, where NumPy's would be doubles.
    """
    import pandas

    if np.ma.isMaskedArray(values) and values.dtype.kind in "iu":
        given = values.tolist()  # None where it is masked
    elif isinstance(values, (list, tuple)):
        given = list(values)
    else:
        return pandas.Series(values).array
    known = [value for value in given if not _is_gap(value)]
    numbers = [
        int(value)
        for value in known
        if isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    ]
    if len(numbers) == len(known) < len(given) and numbers:
        for kind, low, high in (("Int64", -(2**63), 2**63), ("UInt64", 0, 2**64)):
            if low <= min(numbers) and max(numbers) < high:
                return pandas.array([None if _is_gap(v) else int(v) for v in given], dtype=kind)
    are_exact = all(map(is_double, numbers)) or len(numbers) == len(given)
    return pandas.Series(given, dtype=None if are_exact else object).array


def _is_gap(value: Any) -> bool:
    return is_missing(value) or (isinstance(value, (float, np.floating)) and bool(np.isnan(value)))


def _as_text(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)) and value.dtype.kind in "biuf":
        return value.tolist()
    if isinstance(value, (datetime.date, datetime.time)):
        return value.isoformat()
    return str(value)
