# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Bilinear weights in longitude and latitude, for fields on the axes of a grid."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import as_floats, point_set_hash, unit_vectors
from ._types import ArrayLike, FloatArray
from ._weights import Weights

_CYCLIC_DEG = 1e-4  # a turn in float32 is known so well
# How far from a row or column a target is still at it: what is lost where coordinates are shifted
# by turns, in double and in single precision.
_ROUNDING_DEG, _SINGLE_DEG = 1e-9, 1e-4


def bilinear_weights(
    lon: ArrayLike, lat: ArrayLike, to_lon: ArrayLike, to_lat: ArrayLike
) -> Weights:
    """Bilinear in the rectangles between four places of a grid; around the globe if it is.

    Beyond the last row of a grid that goes around the globe the mean of that row is at the pole.
    A column that repeats the first one a turn later takes no part. Axes that decrease give what
    the same places give in increasing order. Targets that are apart from a row or column by no
    more than the rounding of coordinates are at it, also beyond the last one.

    Parameters
    ----------
    lon, lat : array_like, shape (nlon,), (nlat,)
        The axes in degrees, each increasing or decreasing.
    to_lon, to_lat : array_like, shape (m,)
        Where values are wanted, in degrees.

    Returns
    -------
    Weights
        Columns are the places of the grid, latitude by latitude. Targets outside have no entry.

    """
    every_lon, every_lat = _axis(lon, "lon", period=360.0), _axis(lat, "lat")
    x, y = as_floats(to_lon, "to_lon"), as_floats(to_lat, "to_lat")
    # Both axes as increasing ones, without the column that repeats the first one a turn later.
    columns, rows_of_grid = _increasing(every_lon), _increasing(every_lat)
    columns = columns[every_lon[columns] < every_lon[columns[0]] + 360 - _CYCLIC_DEG]
    lons, lats = every_lon[columns], every_lat[rows_of_grid]
    slack = _slack(lons, lats, (lon, lat, to_lon, to_lat))
    west, east, across, is_in = _between_meridians(lons, x, slack)
    south, along = _between(lats, y, slack)
    inside = (along >= 0) & (along <= 1) & is_in
    nlon, rows = len(lons), np.arange(len(x))
    parts = [
        (rows[inside], (south + row)[inside] * nlon + column[inside], (u * v)[inside])
        for row, v in ((0, 1 - along), (1, along))
        for column, u in ((west, 1 - across), (east, across))
    ]
    if _is_around(lons):
        for beyond, last in ((along < 0, 0), (along > 1, len(lats) - 1)):
            beyond = beyond & (np.abs(y) > np.abs(lats[last])) & (np.sign(y) == np.sign(lats[last]))
            parts += _to_pole(rows, beyond, y, lats[last], last * nlon, nlon, (west, east, across))
    row, place, weight = _joined(parts, nlon * len(lats))
    offsets = np.zeros(len(x) + 1, np.int64)
    np.cumsum(np.bincount(row, minlength=len(x)), out=offsets[1:])
    return Weights(
        offsets,
        rows_of_grid[place // nlon] * len(every_lon) + columns[place % nlon],
        weight,
        (len(x), len(every_lon) * len(every_lat)),
        sites_hash=point_set_hash(unit_vectors(every_lon, every_lat[:, None])),
        targets_hash=point_set_hash(unit_vectors(x, y)),
    )


def _increasing(axis: FloatArray) -> Any:
    """The positions of an axis's numbers from the least to the greatest."""
    positions = np.arange(len(axis))
    return positions if axis[1] > axis[0] else positions[::-1]


def _joined(parts: list[Any], num_places: int) -> tuple[Any, Any, FloatArray]:
    """Rows, places and weights in order; one entry for each place of a row, none that is 0."""
    row, place, weight = (np.concatenate(part) for part in zip(*parts, strict=True))
    used = weight != 0
    keys, entry = np.unique(row[used] * num_places + place[used], return_inverse=True)
    sums: FloatArray = np.zeros(len(keys))
    np.add.at(sums, entry, weight[used])
    return keys // num_places, keys % num_places, sums


def _axis(values: ArrayLike, name: str, period: float | None = None) -> FloatArray:
    axis = as_floats(values, name)
    missing = np.flatnonzero(~np.isfinite(axis))
    if axis.ndim == 1 and missing.size:
        raise ValueError(f"{name}[{missing[0]}] is {axis[missing[0]]}: an axis has no gaps")
    given = axis
    if period is not None:
        axis = np.unwrap(axis, period=period)
    steps = np.diff(axis)
    rule = f"{name} must be an axis: two numbers or more, increasing or decreasing"
    if axis.ndim != 1 or len(axis) < 2:
        raise ValueError(rule)
    sign = -1 if 2 * np.count_nonzero(steps < 0) > len(steps) else 1
    wrong = np.flatnonzero(~(sign * steps > 0))
    if len(wrong):
        i = int(wrong[0]) + 1
        raise ValueError(f"{rule}; {name}[{i}] is {given[i]:g} after {given[i - 1]:g}")
    return axis


def _is_around(lons: FloatArray) -> bool:
    return bool(360 - (lons[-1] - lons[0]) <= 1.5 * np.diff(lons).max())


# The row of an increasing axis before each value, and how far it is from there to the next one,
# in steps; 0 or 1 where it is no farther than the slack from one of the two.
def _between(axis: FloatArray, values: FloatArray, slack: float) -> tuple[Any, FloatArray]:
    first = np.searchsorted(axis, values, side="right") - 1
    first = np.clip(first, 0, len(axis) - 2)
    share = (values - axis[first]) / (axis[first + 1] - axis[first])
    for end, place in ((0.0, axis[first]), (1.0, axis[first + 1])):
        share = np.where(np.abs(values - place) <= slack, end, share)
    return first, share


def _slack(lons: FloatArray, lats: FloatArray, given: Any) -> float:
    """The rounding of the coordinates, but never more than a thousandth of a step."""
    kinds = [np.asarray(each).dtype for each in given]
    is_single = any(kind.kind == "f" and kind.itemsize < 8 for kind in kinds)
    step = min(float(np.diff(lons).min()), float(np.diff(lats).min()))
    return min(_SINGLE_DEG if is_single else _ROUNDING_DEG, step / 1000)


# The columns on both sides of each longitude, the share of the second, and whether it is between.
def _between_meridians(
    lons: FloatArray, x: FloatArray, slack: float
) -> tuple[Any, Any, FloatArray, Any]:
    axis = np.append(lons, lons[0] + 360) if _is_around(lons) else lons
    wrapped = lons[0] + np.mod(x - lons[0], 360)
    wrapped = np.where(wrapped > axis[-1] + slack, wrapped - 360, wrapped)
    west, across = _between(axis, wrapped, slack)
    return west, (west + 1) % len(lons), across, (across >= 0) & (across <= 1)


def _to_pole(
    rows: Any, beyond: Any, y: FloatArray, last: float, begin: Any, nlon: int, columns: Any
) -> list[Any]:
    """Linear from the last row to its mean, which is at the pole."""
    west, east, across = (of_all[beyond] for of_all in columns)
    to_pole = (np.abs(y[beyond]) - abs(last)) / (90 - abs(last))
    mean = np.broadcast_to((to_pole / nlon)[:, None], (len(west), nlon))
    return [
        (rows[beyond], begin + west, (1 - to_pole) * (1 - across)),
        (rows[beyond], begin + east, (1 - to_pole) * across),
        (
            np.repeat(rows[beyond], nlon),
            np.tile(begin + np.arange(nlon), len(west)),
            mean.reshape(-1),
        ),
    ]
