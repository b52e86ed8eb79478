# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons that are not valid, with the names of shapely."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from ._arrays import as_threads, degrees_of
from ._geometries import Edges
from ._operands import cell_set, faults_of, like, operand_of, repaired_cells
from ._shapes import are_valid, shapes_of

VALID = "Valid Geometry"


def make_valid(
    geometries: Any,
    *,
    edges: Edges = "lonlat",
    tolerance_deg: float = 0.01,
    threads: int | None = None,
) -> Any:
    """Repairs polygons that are not valid.

    Parameters
    ----------
    geometries : polygons
        One or many, as in `intersection`.
    edges, tolerance_deg, threads
        As in `intersection`.

    Returns
    -------
    shapely.Polygon, shapely.MultiPolygon, ndarray, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        The kind of the argument, as of `intersection`. Polygons that are valid are returned as they
        are, others repaired, and empty if nothing is left of them.

    Raises
    ------
    ValueError
        If a geometry is not a polygon, or has positions that are no longitudes and latitudes. If
        edges are geodesic and a ring leads to the antipode of a position, or the result goes around
        more than a hemisphere.
    TypeError
        If the argument has no polygons.

    See Also
    --------
    validity_reason : what is wrong with polygons.

    Notes
    -----
    A polygon has the places that an odd number of its rings' sides divides from the outside, and a
    geometry is the union of its polygons (docs/guide/polygons.md, "Repair"). So sides that cross
    get a corner there, a hole outside of its shell is a part, spikes vanish, and a ring around a
    pole that is not led there gets the pole. No position moves but for rounding. Rings may meet
    themselves in points and run to and fro; with edges in longitude and latitude they become
    several rings, as shapely wants them.

    Examples
    --------
    >>> import rondel, shapely
    >>> tie = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> rondel.make_valid(tie).geom_type
    'MultiPolygon'
    >>> antarctic = shapely.Polygon([(lon, -70) for lon in range(-180, 180, 10)])
    >>> rondel.make_valid(antarctic).bounds[:2]
    (-180.0, -90.0)

    """
    given = operand_of("geometries", geometries, edges)
    if given.is_of_cells:
        return cell_set(_core.repaired(given.cells, as_threads(threads)), threads)
    is_faulty = np.array([fault != "" for fault in faults_of(given, edges, threads)], bool)
    shapes = given.shapes()
    if edges == "lonlat":
        # Rings may meet themselves here, but not in shapely.
        is_sound = ~is_faulty & ~given.is_missing
        is_faulty[is_sound] = ~are_valid(shapes[is_sound])
    if is_faulty.any():
        cells = repaired_cells(given, is_faulty, edges, threads)
        shapes[is_faulty] = shapes_of(cells, edges, tolerance_deg, threads, "apart")[is_faulty]
    if given.source is None:
        return shapes.reshape(given.shape)[()]
    return like(given, shapes, np.arange(len(shapes)), given.source.index)


def is_valid(geometries: Any, *, edges: Edges = "lonlat", threads: int | None = None) -> Any:
    """Finds out which polygons are valid on the sphere.

    Parameters
    ----------
    geometries : polygons
        One or many, as in `intersection`.
    edges, threads
        As in `intersection`.

    Returns
    -------
    bool or ndarray of bool
        Whether each polygon is valid; False if it is missing.

    Raises
    ------
    ValueError
        If a geometry is not a polygon, or has positions that are no longitudes and latitudes.
    TypeError
        If the argument has no polygons.

    See Also
    --------
    validity_reason : what is wrong with polygons.

    Notes
    -----
    The rules are those of `CellSet.read`: of simple features, but that rings may have either
    direction, may touch themselves, have spikes and have sides in common with other rings, and
    that a ring around a pole has to be led there. shapely's rules are stricter; `make_valid`
    returns what is valid by both.

    Examples
    --------
    >>> import rondel, shapely
    >>> tie = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> rondel.is_valid([tie, rondel.make_valid(tie)]).tolist()
    [False, True]

    """
    found = np.equal(validity_reason(geometries, edges=edges, threads=threads), VALID)
    return found.astype(bool) if isinstance(found, np.ndarray) else bool(found)


def validity_reason(geometries: Any, *, edges: Edges = "lonlat", threads: int | None = None) -> Any:
    """Tells what is wrong with polygons.

    Parameters
    ----------
    geometries : polygons
        One or many, as in `intersection`.
    edges, threads
        As in `intersection`.

    Returns
    -------
    str or ndarray of object
        ``"Valid Geometry"``, or what is wrong, with the ring and the longitude and latitude of a
        place; None for a polygon that is missing.

    Raises
    ------
    ValueError, TypeError
        As `is_valid`.

    Examples
    --------
    >>> import rondel, shapely
    >>> rondel.validity_reason(shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]))
    'ring 0 of part 0 crosses itself at 1 1'
    >>> rondel.validity_reason(shapely.box(0, 0, 1, 1))
    'Valid Geometry'

    """
    given = operand_of("geometries", geometries, edges)
    if given.is_of_cells:
        reasons = np.full(given.num_polygons, VALID, object)
        cells, places = _core.faulty_cells(given.cells, as_threads(threads))
        for cell, (lon, lat) in zip(cells, degrees_of(places), strict=True):
            reasons[cell] = f"the cell crosses or overlaps itself at {lon:.10g} {lat:.10g}"
        return reasons
    reasons = np.array([fault or VALID for fault in faults_of(given, edges, threads)], object)
    reasons[given.is_missing] = None
    return reasons.reshape(given.shape)[()]
