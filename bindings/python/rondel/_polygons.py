# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Set operations and measures of geometries, with the names of shapely and GeoPandas."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

import numpy as np

from . import _core
from ._arrays import as_radius, as_threads
from ._errors import warn_caller
from ._geometries import Edges, Invalid
from ._operands import (
    Operand,
    cell_set,
    cells_at,
    encoded,
    geometries_at,
    have_lines,
    like,
    operands,
    paired,
    rows_at,
)
from ._shapes import shapes_of, shapes_of_geometries
from ._types import FloatArray

How: TypeAlias = Literal["intersection", "union", "identity", "symmetric_difference", "difference"]
SUFFIXES = ("_1", "_2")  # of columns that both tables have


def intersection(
    a: Any,
    b: Any,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    tolerance_deg: float = 0.01,
    align: bool = True,
    threads: int | None = None,
) -> Any:
    """Computes what geometries have in common, pair by pair.

    Parameters
    ----------
    a, b : geometries
        Points, lines and polygons. Each is one geometry of shapely, GeoJSON, or a box of west,
        south, east and north in degrees; or many: a sequence or an array of geometries of any
        shape, a GeoSeries or GeoDataFrame, arrays or tables of GeoArrow, a FeatureCollection, a
        `CellSet` or `Regions`.
        Shapes are broadcast as those of arrays of NumPy, so one geometry goes with each of many.
        Projected coordinates are converted to longitudes and latitudes by their `crs`.
    edges : {'lonlat', 'geodesic'}, optional
        What joins positions, in arguments and in results: straight lines in longitude and latitude
        as in RFC 7946 (default), or great circles, which need no positions in between. It has no
        effect on cells.
    invalid : {'error', 'repair'}, optional
        What to do with polygons that are not valid: 'error' (default) raises an error that names
        the first one, what is wrong with it, and a place; 'repair' makes them valid, as
        `make_valid` does, and warns of it. Cells are refused, or `CellSet.repaired`, if they cross
        or overlap themselves.
    tolerance_deg : float, optional
        The largest distance of a result's straight lines from its arcs, in degrees; by default
        0.01. Lines get positions in between until they are so near, unless edges are geodesic.
    align : bool, optional
        Whether rows of two GeoSeries or GeoDataFrames with different indices are paired by index,
        as in pandas (default), rather than by position. A row that the other one has not has no
        result (None).
    threads : int, optional
        The largest number of threads; by default one for each core.

    Returns
    -------
    shapely.Geometry, ndarray, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        The kind of the first argument that has many geometries, or else of one geometry. Sequences
        become arrays, and GeoJSON geometries of shapely. A GeoDataFrame gets other geometries; a
        GeoSeries keeps its index; both are in EPSG:4326, or the degrees of their own body. Nothing
        is an empty polygon, or an empty collection if any geometry is none of polygons; the result
        of None is None, or a cell without rings. Lines and polygons are cut at the antimeridian and
        at the poles, and polygons are valid there and counterclockwise. With lines or points the
        result has all places, also those in which geometries only touch; with polygons alone it is
        one of polygons.

    Raises
    ------
    ValueError
        If a geometry is not valid, has positions that are no longitudes and latitudes, or is a line
        that jumps by more than 180 degrees of longitude; the message has the argument and the
        number of the geometry. If shapes do not fit, or the arguments are on different bodies. If
        edges are geodesic and a ring of the result goes around more than a hemisphere, or around
        both poles.
    TypeError
        If an argument has no geometries.

    Warns
    -----
    UserWarning
        If polygons were repaired, or have no area but for rounding.

    Notes
    -----
    All is computed on the sphere, where sides are arcs of great circles. Which sides cross is
    decided exactly, and places of crossings are rounded once, to the nearest doubles
    (docs/theory/arrangements.md). Straight lines in longitude and latitude become arcs that are
    within 1e-4 degrees of them, the same ones in both arguments. Longitudes and latitudes of the
    result are rounded once more, so that those with up to 12 decimals stay what they are; and its
    lines are near to arcs only. A `CellSet` is exact: its corners are those of the operation, bit
    by bit, and operations on it can be chained as often as one likes.

    Examples
    --------
    >>> import rondel, shapely
    >>> fiji, date_line = shapely.box(177, -19, 181, -16), shapely.box(179, -25, 185, 0)
    >>> parts = rondel.intersection(fiji, date_line)
    >>> parts.geom_type, parts.bounds
    ('MultiPolygon', (-180.0, -19.0, 180.0, -16.0))
    >>> boxes = [shapely.box(0, 0, 10, 10), shapely.box(20, 0, 30, 10)]
    >>> rondel.intersection(boxes, shapely.box(5, 0, 9, 1)).tolist()[1]
    <POLYGON EMPTY>
    >>> rondel.intersection(shapely.LineString([(170, 0), (190, 0)]), date_line)
    <MULTILINESTRING ((179 0, 180 0), (-180 0, -175 0))>

    """
    return _pairwise(a, b, "intersection", edges, invalid, tolerance_deg, align, threads)


def union(
    a: Any,
    b: Any,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    tolerance_deg: float = 0.01,
    align: bool = True,
    threads: int | None = None,
) -> Any:
    """Computes what is in a geometry or in the other one, pair by pair.

    Parameters
    ----------
    a, b, edges, invalid, tolerance_deg, align, threads
        As in `intersection`.

    Returns
    -------
    shapely.Geometry, ndarray, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        As of `intersection`. The whole sphere is the box from -180, -90 to 180, 90.

    Raises
    ------
    ValueError, TypeError
        As `intersection`.

    Examples
    --------
    >>> import rondel, shapely
    >>> north, south = shapely.box(-180, -5, 180, 90), shapely.box(-180, -90, 180, 5)
    >>> rondel.union(north, south).equals(shapely.box(-180, -90, 180, 90))
    True

    """
    return _pairwise(a, b, "union", edges, invalid, tolerance_deg, align, threads)


def difference(
    a: Any,
    b: Any,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    tolerance_deg: float = 0.01,
    align: bool = True,
    threads: int | None = None,
) -> Any:
    """Computes what is in a geometry and not in the other one, pair by pair.

    Parameters
    ----------
    a, b, edges, invalid, tolerance_deg, align, threads
        As in `intersection`.

    Returns
    -------
    shapely.Geometry, ndarray, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        As of `intersection`.

    Raises
    ------
    ValueError, TypeError
        As `intersection`.

    Examples
    --------
    >>> import rondel, shapely
    >>> ring = rondel.difference(shapely.box(0, 0, 9, 9), shapely.box(3, 3, 6, 6))
    >>> len(ring.interiors), bool(abs(rondel.area(ring) - rondel.area((0, 0, 9, 9))
    ...                               + rondel.area((3, 3, 6, 6))) < 1e-6)
    (1, True)

    """
    return _pairwise(a, b, "difference", edges, invalid, tolerance_deg, align, threads)


def symmetric_difference(
    a: Any,
    b: Any,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    tolerance_deg: float = 0.01,
    align: bool = True,
    threads: int | None = None,
) -> Any:
    """Computes what is in one of two geometries alone, pair by pair.

    Parameters
    ----------
    a, b, edges, invalid, tolerance_deg, align, threads
        As in `intersection`.

    Returns
    -------
    shapely.Geometry, ndarray, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        As of `intersection`.

    Raises
    ------
    ValueError, TypeError
        As `intersection`.

    Examples
    --------
    >>> import rondel, shapely
    >>> box = shapely.box(0, 0, 9, 9)
    >>> rondel.symmetric_difference(box, box)
    <POLYGON EMPTY>

    """
    return _pairwise(a, b, "symmetric_difference", edges, invalid, tolerance_deg, align, threads)


def union_all(
    geometries: Any,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    tolerance_deg: float = 0.01,
    threads: int | None = None,
) -> Any:
    """Computes what is in any of many geometries, without rounding in between.

    Parameters
    ----------
    geometries : geometries
        One or many, as in `intersection`.
    edges, invalid, tolerance_deg, threads
        As in `intersection`.

    Returns
    -------
    shapely.Geometry or CellSet
        A geometry of shapely, empty if there is no place; for cells a `CellSet` with one cell.
        Missing geometries have no place. Lines are divided where they cross, and joined where two
        of them end, as after `shapely.line_merge`.

    Raises
    ------
    ValueError, TypeError
        As `intersection`.

    Examples
    --------
    >>> import rondel, shapely
    >>> rows = [shapely.box(lon, -5, lon + 90, 5) for lon in (-180, -90, 0, 90)]
    >>> belt = rondel.union_all(rows)
    >>> belt.geom_type, belt.bounds
    ('Polygon', (-180.0, -5.0, 180.0, 5.0))

    """
    (given,) = operands({"geometries": geometries}, edges, threads, invalid)
    if have_lines(given):
        united = _core.unite_geometries(given.geometries(), as_threads(threads))
        return shapes_of_geometries(united, edges, tolerance_deg, threads, "apart")[0]
    made = _core.unite(given.rings(), as_threads(threads))
    if given.is_of_cells:
        return cell_set(made, threads)
    return shapes_of(made, edges, tolerance_deg, threads, "apart")[0]


def area(
    geometries: Any,
    radius: float = 1.0,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    threads: int | None = None,
) -> Any:
    """Computes the areas of geometries on the sphere.

    Parameters
    ----------
    geometries : geometries
        One or many, as in `intersection`.
    radius : float, optional
        The radius of the sphere; by default 1, for steradians. With 6371.0088, the mean radius of
        the Earth, areas are in square kilometers.
    edges, invalid, threads
        As in `intersection`.

    Returns
    -------
    float or ndarray of float64
        The area of each geometry, 0 for points and lines; NaN if it is missing.

    Raises
    ------
    ValueError, TypeError
        As `intersection`, or if the radius is not positive.

    Notes
    -----
    The area is that of the arcs that lines become, and differs from that between straight lines in
    longitude and latitude by a share of at most 1/1000, or 1e-3 times 1e-4 degrees if that is less.

    Examples
    --------
    >>> import rondel, shapely
    >>> float(rondel.area(shapely.box(-180, 0, 180, 90), radius=6371.0088).round(-3))
    255033000.0

    """
    radius = as_radius(radius)
    return _measured(geometries, edges, invalid, threads, "areas", radius * radius)


def length(
    geometries: Any,
    radius: float = 1.0,
    *,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    threads: int | None = None,
) -> Any:
    """Computes the lengths of lines, and of the borders of polygons, on the sphere.

    Parameters
    ----------
    geometries : geometries
        One or many, as in `intersection`.
    radius : float, optional
        The radius of the sphere; by default 1, for radians. With 6371.0088, the mean radius of the
        Earth, lengths are in kilometers.
    edges, invalid, threads
        As in `intersection`.

    Returns
    -------
    float or ndarray of float64
        The length of each line, or of the border of each polygon, with its holes; NaN if it is
        missing. Where a polygon is cut at the antimeridian, or led around a pole, it has no
        border.

    Raises
    ------
    ValueError, TypeError
        As `intersection`, or if the radius is not positive.

    Notes
    -----
    The length is that of the arcs that lines become, which are within 1e-4 degrees of straight
    lines in longitude and latitude.

    Examples
    --------
    >>> import rondel, shapely
    >>> hemisphere = shapely.box(-180, 0, 180, 90)
    >>> float(rondel.length(hemisphere, radius=6371.0088).round(2))
    40030.23

    """
    return _measured(geometries, edges, invalid, threads, "lengths", as_radius(radius))


def overlay(
    a: Any,
    b: Any,
    how: How = "intersection",
    *,
    keep_geom_type: bool = True,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    tolerance_deg: float = 0.01,
    return_indices: bool = False,
    threads: int | None = None,
) -> Any:
    """Divides two sets of geometries by each other, with the attributes of both.

    Parameters
    ----------
    a, b : geometries
        As in `intersection`. Geometries of one set may overlap.
    how : {'intersection', 'union', 'identity', 'symmetric_difference', 'difference'}, optional
        Which pieces are returned: the intersections of geometries of both sets ('intersection', by
        default); what is in none of the other set, of the first one ('difference') or of both
        ('symmetric_difference'); intersections and what is in the first set alone ('identity'); or
        all ('union').
    keep_geom_type : bool, optional
        Whether to leave out the lines and points in which geometries only meet: where lines cross,
        and where a line touches a polygon; by default True, with a warning. Pieces of two polygons
        are polygons in any case.
    edges, invalid, tolerance_deg, threads
        As in `intersection`.
    return_indices : bool, optional
        Whether to return the geometries of each piece as well; by default False.

    Returns
    -------
    pieces : ndarray of shapely geometries, GeoSeries, GeoDataFrame, GeoArrow or CellSet
        The kind of `a`, an array for one geometry, sorted by the geometry of `a` and then by that
        of `b`; none comes last. Pieces that are no wider than rounding are left out, unless they
        are cells. A GeoDataFrame has the columns of `a` and, but for 'difference', those of `b`, if
        it is one, too: names that both have end in ``_1`` and ``_2``, and values are missing where
        a piece has no geometry.
    first, second : ndarray of int32
        With `return_indices`: the geometries of each piece, as positions in `a` and `b`; -1 for
        none.

    Raises
    ------
    ValueError, TypeError
        As `intersection`, or if `how` is another word.

    Notes
    -----
    In place of `geopandas.overlay`, on the sphere. All sides are divided at once, so that pieces
    that meet have the same positions along their border, bit by bit, as long as no two pieces
    overlap.

    Examples
    --------
    >>> import geopandas, rondel, shapely
    >>> zones = geopandas.GeoDataFrame(
    ...     {"zone": ["west", "east"]}, crs=4326,
    ...     geometry=[shapely.box(170, -10, 180, 10), shapely.box(-180, -10, -170, 10)])
    >>> storms = geopandas.GeoDataFrame(
    ...     {"storm": ["Ada"]}, geometry=[shapely.box(175, -5, 182, 5)], crs=4326)
    >>> parts = rondel.overlay(zones, storms)
    >>> parts[["zone", "storm"]].values.tolist()
    [['west', 'Ada'], ['east', 'Ada']]
    >>> (rondel.area(parts) / rondel.area(storms)).round(4).tolist()
    [0.7143, 0.2857]

    """
    first, second = operands({"a": a, "b": b}, edges, threads, invalid)
    pieces: Any
    if have_lines(first, second):
        made, rows, others, num_left_out = _core.overlay_geometry_pieces(
            first.geometries(), second.geometries(), how, not keep_geom_type, as_threads(threads)
        )
        if num_left_out > 0:
            warn_caller(
                f"{num_left_out} lines and points in which geometries only meet were left out; "
                "keep_geom_type=False keeps them"
            )
        shapes = shapes_of_geometries(made, edges, tolerance_deg, threads, "apart")
    else:
        cells, rows, others, do_overlap = _core.overlay_pieces(
            first.rings(), second.rings(), how, as_threads(threads)
        )
        if first.is_of_cells:
            pieces = cell_set(cells, threads)
            return (pieces, rows, others) if return_indices else pieces
        drawing = "apart" if do_overlap else "together"
        shapes = shapes_of(cells, edges, tolerance_deg, threads, drawing)
    import shapely

    is_there = ~shapely.is_empty(shapes)
    shapes, rows, others = shapes[is_there], rows[is_there], others[is_there]
    pieces = _with_attributes(first, second, how, shapes, rows, others)
    return (pieces, rows, others) if return_indices else pieces


def _with_attributes(
    first: Operand, second: Operand, how: How, shapes: Any, rows: Any, others: Any
) -> Any:
    """The pieces as the kind of the first argument, with columns of both."""
    if not first.is_frame or how == "difference" or not second.is_frame:
        index = np.arange(len(shapes))
        return like(first, shapes, rows, index)
    import geopandas
    import pandas

    tables = []
    for operand, numbers in ((first, rows), (second, others)):
        frame = operand.source
        names = {"geometry", frame.geometry.name} & {*frame.columns}
        tables.append(rows_at(pandas.DataFrame(frame.drop(columns=[*names])), numbers))
    names = {*tables[0].columns} & {*tables[1].columns}
    renamed = [
        table.rename(columns={name: f"{name}{suffix}" for name in names}).reset_index(drop=True)
        for table, suffix in zip(tables, SUFFIXES, strict=True)
    ]
    made = geopandas.GeoDataFrame(
        pandas.concat(renamed, axis=1), geometry=shapes, crs=first.source.crs
    )
    return encoded(made, first.encoding)


def _pairwise(
    a: Any,
    b: Any,
    how: How,
    edges: Edges,
    invalid: Invalid,
    tolerance_deg: float,
    align: bool,
    threads: int | None,
) -> Any:
    first, second = operands({"a": a, "b": b}, edges, threads, invalid)
    pairs = paired(first, second, align)
    is_second = first.is_single and not second.is_single
    leader, rows = (second, pairs.second) if is_second else (first, pairs.first)
    number = as_threads(threads)
    if have_lines(first, second):
        all_of_both = first.all_geometries(), second.all_geometries()
        found = _core.combine_geometry_pairs(*all_of_both, pairs.cells, how, number)
        found = geometries_at(found, pairs.rows, pairs.num_rows)
        shapes = shapes_of_geometries(found, edges, tolerance_deg, threads, "apart")
    else:
        made = _core.combine_pairs(first.cells, second.cells, pairs.cells, how, number)
        made = cells_at(made, pairs.rows, pairs.num_rows)
        if leader.is_of_cells:
            return cell_set(made, threads)
        shapes = shapes_of(made, edges, tolerance_deg, threads, "apart")
    shapes[np.setdiff1d(np.arange(pairs.num_rows), pairs.rows)] = None
    if leader.source is None:
        return shapes.reshape(pairs.shape)[()]
    index = pairs.index
    if index is None:
        if pairs.shape != leader.shape:
            raise ValueError(
                f"{leader.name} has {leader.shape[0]} rows, and the result {pairs.shape}"
            )
        index = leader.source.index
    return like(leader, shapes, rows, index)


def _measured(
    geometries: Any,
    edges: Edges,
    invalid: Invalid,
    threads: int | None,
    measure: str,
    unit: float,
) -> float | FloatArray:
    (given,) = operands({"geometries": geometries}, edges, threads, invalid)
    values: FloatArray = getattr(given.rings(), measure)() * unit
    if measure == "lengths" and have_lines(given):
        values = values + given.geometries().line_lengths() * unit
    values[given.is_missing] = np.nan
    return values.reshape(given.shape)[()]
