# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Cells as polygons of shapely, whose positions are joined by lines or by great circles."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from ._arrays import as_threads, unit_vectors
from ._geo import polygon_shapes
from ._geometries import Edges, is_geodesic
from ._pickled import with_arrays
from ._types import BoolArray, FloatArray

UNSURE_AREA = 1e-10  # steradians, of rounding


def shapes_of(
    cells: _core.CellRings,
    edges: Edges,
    tolerance_deg: float,
    threads: int | None,
    drawing: str,
) -> np.ndarray[Any, Any]:
    """Polygons and multipolygons of shapely; those of cells without a place are empty."""
    import shapely

    are_arcs = is_geodesic(edges)
    # Arcs stay what they are between positions that will be joined by arcs.
    tolerance = 180.0 if are_arcs else float(tolerance_deg)
    drawn = cells.polygons(tolerance, as_threads(threads), drawing)
    positions, rings = drawn.positions, drawn.rings
    if are_arcs:
        positions, rings = _with_ends_of_arcs(positions, rings)
        _require_smaller_sides(positions, rings, drawn, cells.areas())
    shapes = polygon_shapes(positions, rings, drawn.polygons, drawn.owners, cells.num_cells)
    shapes[np.bincount(drawn.owners, minlength=cells.num_cells) == 0] = shapely.Polygon()
    return shapes


def shapes_of_geometries(
    geometries: _core.Geometries,
    edges: Edges,
    tolerance_deg: float,
    threads: int | None,
    drawing: str,
) -> np.ndarray[Any, Any]:
    """Points, lines, polygons and collections of shapely; those without a place are empty."""
    import shapely

    cells = geometries.polygons
    shapes = shapes_of(cells, edges, tolerance_deg, threads, drawing)
    tolerance = 180.0 if is_geodesic(edges) else float(tolerance_deg)
    positions, offsets, owners = geometries.drawn_lines(tolerance, as_threads(threads))
    sizes = np.diff(offsets)
    is_line = sizes > 1
    of_line = np.repeat(is_line, sizes)
    parts = np.empty(len(sizes), object)
    numbers = np.repeat(np.arange(np.count_nonzero(is_line)), sizes[is_line])
    parts[is_line] = shapely.linestrings(positions[of_line], indices=numbers)
    parts[~is_line] = shapely.points(positions[~of_line])
    ends = np.searchsorted(owners, np.arange(len(shapes) + 1))
    for k in np.unique(owners):
        own = [*parts[ends[k] : ends[k + 1]], *shapely.get_parts(shapes[k])]
        shapes[k] = _collected([part for part in own if not part.is_empty])
    is_empty = shapely.is_empty(shapes)
    shapes[is_empty] = shapely.GeometryCollection()
    return shapes


def are_valid(shapes: np.ndarray[Any, Any]) -> BoolArray:
    """Which polygons are valid for shapely, of those that are valid on the sphere.

    It looks for each hole along all of its shell, which takes long where there are thousands of
    holes. Holes that meet no other ring are not shown to it.
    """
    import shapely

    result: BoolArray = shapely.is_simple(shapely.boundary(shapes))
    for k in np.flatnonzero(~result):
        result[k] = shapely.is_valid(_without_free_holes(shapes[k]))
    return result


def _without_free_holes(shape: Any) -> Any:
    import shapely

    rings, owners = shapely.get_rings(shapely.get_parts(shape), return_index=True)
    larger, other = shapely.STRtree(rings).query(rings)  # whose boxes meet
    rank = np.argsort(np.argsort(shapely.get_num_coordinates(rings), kind="stable"))
    is_pair = rank[larger] > rank[other]
    larger, other = larger[is_pair], other[is_pair]
    shapely.prepare(rings)  # for the first of two that are compared
    meet = shapely.intersects(rings[larger], rings[other])
    is_kept = np.isin(np.arange(len(rings)), [larger[meet], other[meet]])
    is_kept |= np.diff(owners, prepend=-1) > 0  # shells
    rings, owners = rings[is_kept], owners[is_kept]
    begins = np.flatnonzero(np.diff(owners, prepend=-1))
    return shapely.multipolygons(
        [shapely.Polygon(ring, holes) for ring, *holes in np.split(rings, begins[1:])]
    )


def _collected(parts: list[Any]) -> Any:
    """One geometry of parts, a collection if they are of several kinds."""
    import shapely

    if len(parts) == 1:
        return parts[0]
    kinds = {
        "Point": shapely.multipoints,
        "LineString": shapely.multilinestrings,
        "Polygon": shapely.multipolygons,
    }
    made = []
    for kind, collect in kinds.items():
        some = [part for part in parts if part.geom_type == kind]
        if some:
            made.append(some[0] if len(some) == 1 else collect(some))
    return made[0] if len(made) == 1 else shapely.geometrycollections(made)


def _with_ends_of_arcs(positions: Any, rings: Any) -> tuple[Any, Any]:
    """Rings with a position at the equator, where they run along the antimeridian from pole to
    pole, or nearly so.
    """
    step = np.abs(np.diff(positions[:, 1], append=0))
    step[rings[1:] - 1] = 0
    after = np.flatnonzero(step > 90)
    after = after[np.abs(positions[after, 0]) == 180]
    after = after[positions[after, 0] == positions[after + 1, 0]]
    added = np.column_stack([positions[after, 0], np.zeros(len(after))])
    more = np.searchsorted(after, rings, side="left")
    return np.insert(positions, after + 1, added, axis=0), rings + more


def _require_smaller_sides(positions: Any, rings: Any, drawn: Any, areas: FloatArray) -> None:
    """Refuses polygons that are others if each ring is around the smaller side of the sphere, as it
    is between geodesic edges.
    """
    is_last = np.zeros(len(positions), bool)  # which is the first position again
    is_last[rings[1:] - 1] = True
    points = unit_vectors(positions[~is_last, 0], positions[~is_last, 1])
    arrays = {
        "cells": np.arange(len(rings)),
        "rings": rings - np.arange(len(rings)),
        "corners": np.arange(len(points), dtype=np.int32),
        "points": points,
    }
    sizes = with_arrays(_core.CellRings(), arrays).areas()
    sizes = np.minimum(sizes, 4 * np.pi - sizes)
    is_shell = np.zeros(len(sizes), bool)
    is_shell[drawn.polygons[:-1]] = True
    owners = drawn.owners[np.cumsum(is_shell) - 1]
    read = np.bincount(owners, np.where(is_shell, sizes, -sizes), minlength=len(areas))
    is_other = np.abs(read - areas) > UNSURE_AREA
    if is_other.any():
        raise ValueError(
            f"geometry {np.argmax(is_other)} of the result goes around more than a hemisphere, or "
            "has both poles inside, which geodesic edges cannot say; take edges='lonlat', or cells"
        )
