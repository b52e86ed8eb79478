# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Simplification of lines and polygons, with the name of shapely."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import _core
from ._arrays import as_radius, as_threads
from ._geometries import Edges, Invalid, require_rules
from ._operands import cell_set, like, operand_of, require_sound, told_by_core
from ._shapes import shapes_of, shapes_of_geometries

DRAWN_SHARE = 1 / 16  # of the tolerance, for lines that follow arcs


def simplify(
    geometries: Any,
    tolerance: float,
    radius: float = 1.0,
    *,
    simplify_boundary: bool = True,
    drop_small: bool = False,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    threads: int | None = None,
) -> Any:
    """Removes corners of lines and polygons on the sphere as far as a distance allows.

    Parameters
    ----------
    geometries : geometries
        One or many, as in `intersection`. All are simplified together.
    tolerance : float
        How far lines may be from those that they replace, along great circles, in the unit of
        `radius`.
    radius : float, optional
        The radius of the sphere; by default 1, for distances in radians. With 6371.0088, the mean
        radius of the Earth, distances are in kilometers.
    simplify_boundary : bool, optional
        Whether corners are removed that are on a ring of one polygon alone, as in
        `shapely.coverage_simplify`.
    drop_small : bool, optional
        Whether rings vanish that are nowhere wider than the tolerance. By default they keep three
        corners or more.
    edges, invalid, threads
        As in `intersection`.

    Returns
    -------
    shapely.Polygon, shapely.MultiPolygon, ndarray, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        The kind of the argument, as of `intersection`.

    Raises
    ------
    ValueError
        If a geometry is not valid, or has positions that are no longitudes and latitudes; the
        message has its number. If the tolerance is negative or not finite, or the radius is not
        positive.
    TypeError
        If the argument has no polygons.

    Notes
    -----
    A border that two polygons share is simplified once and stays common to them, so that no gaps
    and no overlaps appear. Points and the ends of lines stay. Topology is decided by exact
    predicates, and distances with bounds of their errors (docs/theory/simplification.md). Straight
    lines in longitude and latitude become arcs before, and the lines of the result follow arcs;
    both take a sixteenth of the tolerance.
    A `CellSet` has its own corners, bit by bit.

    Examples
    --------
    >>> import rondel, shapely
    >>> shape = shapely.Polygon([(0, 0), (1, 0.1), (2, 0), (2, 1), (2.1, 2), (0, 2)])
    >>> simple = rondel.simplify(shape, 20, radius=6371.0088)  # kilometers
    >>> len(shape.exterior.coords), len(simple.exterior.coords)
    (7, 5)

    """
    radius = as_radius(radius)
    require_rules(edges=edges, invalid=invalid)
    number = as_threads(threads)
    given = operand_of("geometries", geometries, edges)
    require_sound(given, invalid, threads)
    allowed = float(tolerance) / radius
    keeps = not simplify_boundary
    if given.is_of_cells:
        cells = given.rings()
        return cell_set(_core.simplified_of(cells, allowed, drop_small, keeps, number), threads)
    drawn_deg = math.degrees(allowed) * DRAWN_SHARE if allowed > 0 else 0.01
    if given.num_polygons:
        share = allowed * (1 - 2 * DRAWN_SHARE)

        def call(shapes: Any) -> Any:
            found, remarks, do_overlap = _core.simplified_in(
                shapes, share, drop_small, keeps, drawn_deg, edges, invalid, number
            )
            return (found, do_overlap), remarks

        made, do_overlap = told_by_core([given], edges, call, with_lines=True)
    else:
        made, do_overlap = _core.Geometries(), False
    drawing = "apart" if do_overlap else "together"
    drawn = shapes_of_geometries if len(made.lines) > 1 else shapes_of
    of_kind = made if len(made.lines) > 1 else made.polygons
    shapes = drawn(of_kind, edges, min(drawn_deg, 0.01), threads, drawing)
    shapes[given.is_missing] = None
    if given.source is None:
        return shapes.reshape(given.shape)[()]
    return like(given, shapes, np.arange(given.num_polygons), given.source.index)
