# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Geometries of shapely as arrays of positions and offsets."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _core
from ._pickled import with_arrays
from ._types import FloatArray, IntArray

# Kinds of geometries, by shapely's numbers.
POINT, LINE, RING, POLYGON, POINTS, LINES = range(6)
NOT_OF_POLYGONS = (POINT, LINE, RING, POINTS, LINES)

Objects = np.ndarray[Any, Any]


def shapely_array(given: Sequence[Any] | Objects) -> Objects | None:
    """The objects as an array if each of them is a geometry of shapely or None."""
    shapely: Any = sys.modules.get("shapely")
    if shapely is None:
        return None
    objects = np.empty(len(given), object)
    for k, item in enumerate(given):
        objects[k] = item
    are_shapes = shapely.is_geometry(objects)
    return (
        objects if are_shapes.any() and (are_shapes | shapely.is_missing(objects)).all() else None
    )


def taken_apart(shapes: Objects, *, with_lines: bool = False) -> _core.LonLatGeometries:
    """The positions of polygons, and of lines and points if they are allowed.

    None and empty geometries have no positions. Heights are left out.

    Raises
    ------
    ValueError
        If a geometry, which the message numbers, is of another kind, or not finite.

    """
    import shapely

    parts, owners = shapes, np.arange(len(shapes))
    while True:
        is_there = ~(shapely.is_missing(parts) | shapely.is_empty(parts))
        parts, owners = parts[is_there], owners[is_there]
        kinds = shapely.get_type_id(parts)
        is_refused = np.isin(kinds, RING if with_lines else NOT_OF_POLYGONS)
        if is_refused.any():
            k = np.argmax(is_refused)
            raise ValueError(
                f'geometries: geometry {owners[k]}: type "{parts[k].geom_type}" where a '
                f"{'geometry' if with_lines else 'Polygon'} is needed"
            )
        if not (kinds > POLYGON).any():
            break
        parts, of = shapely.get_parts(parts, return_index=True)
        owners = owners[of]
    is_polygon = kinds == POLYGON
    lines, of_lines = parts[~is_polygon], owners[~is_polygon]
    rings, of_rings = shapely.get_rings(parts[is_polygon], return_index=True)
    arrays = {
        "line_groups": _offsets(np.bincount(of_lines, minlength=len(shapes))),
        "lines": _offsets(shapely.get_num_coordinates(lines)),
        "line_positions": _finite(lines, of_lines),
        "polygon_groups": _offsets(np.bincount(owners[is_polygon], minlength=len(shapes))),
        "polygons": _offsets(np.bincount(of_rings, minlength=np.count_nonzero(is_polygon))),
        "rings": _offsets(shapely.get_num_coordinates(rings)),
        "ring_positions": _finite(rings, owners[is_polygon][of_rings]),
    }
    return with_arrays(_core.LonLatGeometries(), arrays)


def _offsets(sizes: IntArray) -> np.ndarray[Any, np.dtype[np.int64]]:
    return np.concatenate([[0], np.cumsum(sizes, dtype=np.int64)])


def _finite(parts: Objects, owners: IntArray) -> FloatArray:
    """The positions of parts of geometries. Refuses numbers that are not finite."""
    import shapely

    positions: FloatArray = shapely.get_coordinates(parts)
    if not np.isfinite(positions).all():
        _, of = shapely.get_coordinates(parts, return_index=True)
        first = owners[of[np.argmin(np.isfinite(positions).all(axis=1))]]
        raise ValueError(f"geometry {first} has a position that is not finite")
    return positions
