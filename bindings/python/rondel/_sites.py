# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What targets that are a list of points say of themselves: names of stations, times of a track."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np
import xarray

from . import _core
from ._coordinates import parts_of_grids
from ._errors import warn_caller

# The methods that value points, in words.
METHODS_FOR_POINTS = (
    "'nearest', 'linear', 'laplace', 'sibson', 'hermite', 'cubic', 'bilinear' and 'native' are the "
    "methods for points"
)
_PRESSURES = ("Pa", "hPa", "mbar", "millibar", "bar", "dbar")


def columns_of(table: Any, taken: set[str], dim: Hashable) -> dict[Hashable, xarray.Variable]:
    """The columns of a DataFrame, and an index with names, but for those that are coordinates. A
    warning names others than texts, numbers, booleans and times.
    """
    names = [name for name in table.index.names if name is not None]
    if names and not {*names} & {*table.columns}:
        table = table.reset_index(names)
    made: dict[Hashable, xarray.Variable] = {}
    lost = []
    for name in table.columns:
        if str(name) in taken:
            continue
        values = _values_of(table[name])
        if values is None:
            lost.append(str(name))
        else:
            made[name] = xarray.Variable((dim,), values)
    if lost:
        warn_caller(f"left out, as they are neither texts nor numbers: {', '.join(lost)}")
    return made


def _values_of(column: Any) -> Any:
    """The values of a column as an array that files can have, or None."""
    values = np.asarray(column.to_numpy())
    if values.dtype.kind in "biufMmU":
        return values
    known = [item for item in values.tolist() if not _is_missing(item)]
    if all(isinstance(item, str) for item in known):
        texts = ["" if _is_missing(item) else item for item in values.tolist()]
        return np.array(texts, object)
    if all(isinstance(item, (int, float, bool, np.number)) for item in known):
        return np.array([np.nan if _is_missing(item) else item for item in values.tolist()], float)
    return None


def _is_missing(item: Any) -> bool:
    """Whether a cell of a table is None, NaN, or the missing value of pandas."""
    if item is None or type(item).__name__ in ("NAType", "NaTType"):
        return True
    return isinstance(item, float) and np.isnan(item)


def described(data: Any, dim: Hashable, own: set[str]) -> dict[Hashable, xarray.Variable]:
    """The variables of a Dataset or DataArray that describe places along a dimension, as those of a
    file do: texts, the axis of the dimension, coordinates, and numbers with a `cf_role` of names.
    `own` has the names of the longitudes and latitudes, and of their bounds.
    """
    if not isinstance(data, (xarray.Dataset, xarray.DataArray)):
        return {}
    known = data.variables if isinstance(data, xarray.Dataset) else data.coords.variables
    # A cf_role makes a variable a part of what CF or UGRID describes.
    parts = {name for name in parts_of_grids(data) if not _names_places(known.get(name))}
    found = {}
    for name, item in known.items():
        if item.dims != (dim,) or str(name) in own | parts:
            continue
        is_coordinate = name in data.coords
        if is_coordinate or item.dtype.kind in "OSU" or _names_places(item):
            found[name] = item.to_base_variable()
    return found


def _names_places(item: Any) -> bool:
    return item is not None and str(item.attrs.get("cf_role", "")).endswith("_id")


def feature_type(data: xarray.Dataset, dim: Hashable) -> str:
    """The `featureType` that CF (chapter 9) has for fields at points along a dimension, or an empty
    text if it has none: as in files of the command.
    """
    found = set()
    for array in data.data_vars.values():
        if dim not in array.dims or len(array.dims) == 1:
            continue  # what has neither times nor levels is a property of a point
        kinds = {_kind_of(data, name) for name in array.dims if name != dim}
        found.add("" if "" in kinds else "".join(sorted(kinds)))
    if not found:
        return "point"
    names = {"time": "timeSeries", "levels": "profile", "levelstime": "timeSeriesProfile"}
    return names.get(found.pop(), "") if len(found) == 1 else ""


def _kind_of(data: xarray.Dataset, dim: Hashable) -> str:
    """'time', 'levels' or an empty text, by the axis of a dimension."""
    if dim not in data.variables:
        return "time" if _core.is_name_of_time(str(dim)) else ""
    axis = data.variables[dim]
    attrs = {**axis.encoding, **axis.attrs}
    units = str(attrs.get("units", ""))
    is_time = axis.dtype.kind in "Mm" or "calendar" in axis.encoding
    is_time = is_time or " since " in units or attrs.get("standard_name") == "time"
    if is_time or attrs.get("axis") == "T":
        return "time"
    is_vertical = "positive" in attrs or attrs.get("axis") == "Z" or units in _PRESSURES
    return "levels" if is_vertical else ""
