# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Buffers of points, lines and polygons, with the name of shapely."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import as_radius, as_threads
from ._geometries import Edges, Invalid, require_rules
from ._operands import buffers, cell_set, like, operand_of, require_sound
from ._shapes import shapes_of


def buffer(
    geometries: Any,
    distance: float,
    radius: float = 1.0,
    *,
    tolerance: float | None = None,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    tolerance_deg: float = 0.01,
    threads: int | None = None,
) -> Any:
    """Computes the places within a distance of points, lines and polygons on the sphere.

    Parameters
    ----------
    geometries : geometries
        One or many points, lines or polygons, as in `intersection`. Of a `CellSet` or `Regions` its
        polygons.
    distance : float
        The distance along great circles, in the unit of `radius`. A negative one takes away what
        is nearer than its magnitude to the border of a polygon.
    radius : float, optional
        The radius of the sphere; by default 1, for distances in radians. With 6371.0088, the mean
        radius of the Earth, distances are in kilometers.
    tolerance : float, optional
        How near the border of the buffer is to the places at the distance, in the unit of
        `radius`; by default a thousandth of the distance, for which a circle has 50 corners.
    edges, invalid, tolerance_deg, threads
        As in `intersection`.

    Returns
    -------
    shapely.Polygon, shapely.MultiPolygon, ndarray, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        The kind of the argument, as of `intersection`.

    Raises
    ------
    ValueError
        If a geometry is not valid, or has positions that are no longitudes and latitudes; the
        message has its number. If a number is not finite, the radius is not positive, or the
        tolerance is negative.
    TypeError
        If the argument has no geometries.

    Notes
    -----
    All places that are nearer than the distance minus the tolerance are in the buffer, and none
    farther than their sum (docs/theory/arrangements.md, "Buffers"). Ends and corners are round.

    Examples
    --------
    >>> import math
    >>> import rondel, shapely
    >>> disk = rondel.buffer(shapely.Point(180, -17), 100, radius=6371.0088)  # kilometers
    >>> disk.geom_type, disk.bounds[0], disk.bounds[2]
    ('MultiPolygon', -180.0, 180.0)
    >>> bool(abs(rondel.area(disk, radius=6371.0088) / (math.pi * 100**2) - 1) < 0.003)
    True

    """
    radius = as_radius(radius)
    require_rules(edges=edges, invalid=invalid)
    number = as_threads(threads)
    given = operand_of("geometries", geometries, edges)
    require_sound(given, invalid, threads)
    near = 0.0 if tolerance is None else float(tolerance) / radius
    made = buffers(given, float(distance) / radius, near, edges, invalid, number)
    if given.is_of_cells:
        return cell_set(made, threads)
    shapes = shapes_of(made, edges, tolerance_deg, threads, "apart")
    shapes[given.is_missing] = None
    if given.source is None:
        return shapes.reshape(given.shape)[()]
    return like(given, shapes, np.arange(given.num_polygons), given.source.index)
