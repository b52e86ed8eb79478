# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Arguments of functions on polygons: what is given becomes cells, and cells become its kind."""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

import numpy as np

from . import _core
from ._arrays import as_threads
from ._cell_set import CellSet
from ._errors import InvalidInput, warn_caller
from ._geometries import (
    Edges,
    Invalid,
    box_of,
    feature_of,
    features_of,
    in_degrees,
    is_box,
    is_file,
    is_of_geopandas,
    require_rules,
)
from ._pickled import with_arrays
from ._regions import Regions
from ._taken_apart import shapely_array, taken_apart
from ._types import ArrayLike, BoolArray, FloatArray, IntArray

# A function of the library that gets geometries, in arrays or as GeoJSON. It returns its result and
# remarks.
Call: TypeAlias = Callable[[Any], tuple[Any, Sequence[str]]]


@dataclass
class Operand:
    """The geometries of one argument: cells, or features that will be read.

    Attributes
    ----------
    name : str
        The name of the argument.
    shape : tuple of int
        The shape of the array; () for one geometry.
    given : sequence of object
        The polygons as they are given, none if cells are; an array of objects if each of them is a
        geometry of shapely or None.
    features : sequence of mapping or None
        The polygons as GeoJSON, or None if they are geometries of shapely.
    source : GeoSeries, GeoDataFrame or None
        What has the polygons, in degrees.
    encoding : str or None
        The encoding of the arrays of Arrow that are given.
    cells : CellRings
        The polygons as cells.
    unchecked : CellSet or None
        The cells that are given if some of them may cross themselves.
    shared : Geometries or None
        The geometries of all arguments if any of them has lines or points.
    first : int
        The cell of the first polygon.
    longitudes : ndarray, shape (k, 2)
        The least and the greatest longitude of each geometry as given; infinities where it has
        none, and no rows for cells.

    """

    name: str
    shape: tuple[int, ...]
    given: Any = ()
    features: Sequence[Mapping[str, Any]] | None = None
    is_of_cells: bool = False
    source: Any = None
    encoding: str | None = None
    cells: _core.CellRings = field(default_factory=_core.CellRings)
    unchecked: CellSet | None = None
    shared: _core.Geometries | None = None
    first: int = 0
    longitudes: FloatArray = field(default_factory=lambda: np.empty((0, 2)))

    @property
    def is_single(self) -> bool:
        """Whether it is one geometry."""
        return self.shape == ()

    @property
    def num_polygons(self) -> int:
        """How many polygons there are."""
        return int(np.prod(self.shape))

    @property
    def is_frame(self) -> bool:
        """Whether polygons have attributes."""
        return hasattr(self.source, "columns")

    @property
    def is_missing(self) -> BoolArray:
        """Which polygons are None."""
        if self.is_of_cells:
            return np.zeros(self.num_polygons, bool)
        if self.features is None:
            return np.array([shape is None for shape in self.given], bool)
        return np.array([feature.get("geometry") is None for feature in self.features], bool)

    def shapes(self) -> np.ndarray[Any, Any]:
        """The polygons as geometries of shapely: the same ones if they are that already."""
        import shapely.geometry

        made = np.full(self.num_polygons, None)
        if self.features is None:
            made[:] = self.given
            return made
        for k, (given, feature) in enumerate(zip(self.given, self.features, strict=True)):
            known = feature.get("geometry")
            if isinstance(given, shapely.Geometry):
                made[k] = given
            elif known is not None:
                made[k] = shapely.geometry.shape(known)
        return made

    def geojson(self) -> Sequence[Mapping[str, Any]]:
        """The polygons as features of GeoJSON."""
        if self.features is None:
            return [feature_of(shape) for shape in self.given]
        return self.features

    def rings(self) -> _core.CellRings:
        """The polygons of this argument alone."""
        return cells_from(self.cells, self.first, self.num_polygons)

    def all_geometries(self) -> _core.Geometries:
        """The geometries of which those of this argument begin at `first`."""
        if self.shared is not None:
            return self.shared
        groups = np.zeros(self.cells.num_cells + 1, np.int64)
        return with_arrays(_core.Geometries(), {"line_groups": groups, "polygons": self.cells})

    def geometries(self) -> _core.Geometries:
        """The geometries of this argument alone."""
        return geometries_from(self.all_geometries(), self.first, self.num_polygons)


def operands(
    given: Mapping[str, Any], edges: Edges, threads: int | None, invalid: Invalid = "error"
) -> list[Operand]:
    """The arguments by their names. Geometries of all of them are read together, so that they have
    the same corners along sides that they share.
    """
    require_rules(edges=edges, invalid=invalid)
    made = [operand_of(name, polygons, edges) for name, polygons in given.items()]
    bodies = [operand for operand in made if getattr(operand.source, "crs", None) is not None]
    for other in bodies[1:]:
        if not other.source.crs.equals(bodies[0].source.crs, ignore_axis_order=True):
            raise ValueError(
                f"{bodies[0].name} and {other.name} are on different bodies, "
                f"{bodies[0].source.crs.name!r} and {other.source.crs.name!r}"
            )
    for operand in made:
        require_sound(operand, invalid, threads)
    read = [operand for operand in made if not operand.is_of_cells]
    geometries, longitudes = _read(read, edges, invalid, as_threads(threads))
    has_lines = len(geometries.lines) > 1
    first = 0
    for operand in read:
        operand.cells, operand.first = geometries.polygons, first
        operand.shared = geometries if has_lines else None
        operand.longitudes = longitudes[first : first + operand.num_polygons]
        first += operand.num_polygons
    return made


def require_sound(operand: Operand, invalid: Invalid, threads: int | None) -> None:
    """Refuses cells that cross or overlap themselves, or repairs them with a warning."""
    if operand.unchecked is None:
        return
    if invalid == "repair":
        operand.cells = operand.unchecked.repaired(threads=threads)._cells.rings()
        return
    try:
        _ = operand.unchecked.areas  # looked for once
    except InvalidInput as error:
        raise InvalidInput(f"{operand.name}: {error}", error.index) from None


def operand_of(name: str, given: Any, edges: Edges) -> Operand:
    """An argument whose polygons are not read yet."""
    if isinstance(given, (CellSet, Regions)):
        rings = given._rings if isinstance(given, Regions) else given._cells.rings()
        unchecked = given if isinstance(given, CellSet) and not given._is_sound else None
        shape: tuple[int, ...] = (rings.num_cells,)
        return Operand(name, shape, is_of_cells=True, cells=rings, unchecked=unchecked)
    if is_file(given):
        raise TypeError(f"{name} is the name of a file; rondel.CellSet.read() reads its polygons")
    try:
        source, encoding = _frame_of(given)
    except ValueError as error:  # of Arrow
        raise ValueError(f"{name}: {error}") from None
    if source is not None:
        source = in_degrees(source, edges)
        if source.crs is not None and source.crs.equals(4326, ignore_axis_order=True):
            source = source.set_crs(4326, allow_override=True)  # has other names, as OGC:CRS84
        flat: Any = np.asarray(source.geometry, object)
        return Operand(name, flat.shape, flat, source=source, encoding=encoding)
    if is_box(given):
        given = box_of(*map(float, given))
        if "shapely" in sys.modules:  # else nothing is of it, and shapely may be missing
            import shapely.geometry

            given = shapely.geometry.shape(given)
    shapes = shapely_array([given])
    if shapes is not None:
        return Operand(name, (), shapes)
    known = given if isinstance(given, Mapping) else getattr(given, "__geo_interface__", None)
    if known is not None:
        return _operand_of_mapping(name, known, given)
    if given is None:
        return Operand(name, (), [None], [feature_of(None)])
    if not isinstance(given, Iterable):
        raise TypeError(f"{name} must be polygons or a CellSet, not {type(given).__name__}")
    flat = given.ravel() if isinstance(given, np.ndarray) else list(given)
    shape = given.shape if isinstance(given, np.ndarray) else (len(flat),)
    shapes = shapely_array(flat)
    if shapes is not None:
        return Operand(name, shape, shapes)
    return Operand(name, shape, [*flat], [feature_of(geometry) for geometry in flat])


def _operand_of_mapping(name: str, known: Mapping[str, Any], given: Any) -> Operand:
    if "crs" in known:  # refused if it is not in degrees
        nothing = {"type": "FeatureCollection", "features": [], "crs": known["crs"]}
        features_of(
            nothing, "lonlat", lambda text: _core.cells_of_polygons(text, "lonlat", "error", 1)
        )
    if known.get("type") == "FeatureCollection" and "features" in known:
        features = [feature_of(feature) for feature in known["features"]]
        return Operand(name, (len(features),), [None] * len(features), features)
    return Operand(name, (), [given], [feature_of(known)])


def _frame_of(given: Any) -> tuple[Any, str | None]:
    """A GeoSeries or GeoDataFrame of the same polygons, if it is one or of Arrow; how it is of
    Arrow.
    """
    geopandas: Any = sys.modules.get("geopandas")
    if is_of_geopandas(given):
        is_array = isinstance(given, geopandas.array.GeometryArray)
        return geopandas.GeoSeries(given) if is_array else given, None
    if hasattr(given, "__geo_interface__"):
        return None, None
    if not (hasattr(given, "__arrow_c_array__") or hasattr(given, "__arrow_c_stream__")):
        return None, None
    import pyarrow

    geopandas = importlib.import_module("geopandas")
    if hasattr(given, "__arrow_c_array__"):
        fields = [pyarrow.Field._import_from_c_capsule(given.__arrow_c_array__()[0])]
        made = geopandas.GeoSeries.from_arrow(given)
    else:
        given = pyarrow.table(given)
        fields = given.schema
        made = geopandas.GeoDataFrame.from_arrow(given)
    is_wkb = any("geoarrow.wkb" in f"{field.metadata} {field.type}" for field in fields)
    return made, "WKB" if is_wkb else "geoarrow"


def in_words_of(given: Sequence[Operand], message: str) -> str:
    """A message about a geometry of an operand of the library, with the argument that it is of."""

    def owner(match: re.Match[str]) -> str:
        number = int(match[1])
        for operand in given:
            place = number - operand.first
            if 0 <= place < operand.num_polygons:
                return operand.name if operand.is_single else f"{operand.name}: geometry {place}"
        return match[0]

    return re.sub(r"^geometry ([0-9]+) of the (?:first|second) operand", owner, message)


def have_lines(*given: Operand) -> bool:
    """Whether any argument has lines or points."""
    return any(operand.shared is not None for operand in given)


def _read(
    read: list[Operand], edges: Edges, invalid: Invalid, threads: int
) -> tuple[_core.Geometries, FloatArray]:
    """The geometries, and the extent of the longitudes of each."""
    if not any(operand.num_polygons for operand in read):
        return _core.Geometries(), np.empty((0, 2))
    made: tuple[_core.Geometries, FloatArray] = told_by_core(
        read,
        edges,
        lambda given: _core.geometries_of(given, edges, invalid, threads),
        with_lines=True,
    )
    return made


@dataclass
class Pairs:
    """The pairs of polygons of two arguments.

    Attributes
    ----------
    first, second : ndarray of int, shape (n,)
        The polygons of each row; -1 for none.
    shape : tuple of int
        The shape of the result.
    index : pandas.Index or None
        The index of the result if rows are aligned.
    rows : ndarray of int, shape (m,)
        The rows in which no polygon is missing.
    cells : ndarray of int32, shape (m, 2)
        The cells of these rows.

    """

    first: IntArray
    second: IntArray
    shape: tuple[int, ...]
    index: Any
    rows: IntArray
    cells: IntArray

    @property
    def num_rows(self) -> int:
        """How many rows there are."""
        return len(self.first)


def paired(first: Operand, second: Operand, align: bool) -> Pairs:
    """Pairs by broadcasting; `align`: by the index of two tables."""
    i, k, shape, index = _rows_of_pairs(first, second, align)
    is_missing = (i < 0) | (k < 0)
    for operand, rows in ((first, i), (second, k)):
        is_missing[~is_missing] = operand.is_missing[rows[~is_missing]]
    there = np.flatnonzero(~is_missing)
    cells = np.column_stack([first.first + i[there], second.first + k[there]]).astype(np.int32)
    return Pairs(i, k, shape, index, there, cells)


def _rows_of_pairs(
    first: Operand, second: Operand, align: bool
) -> tuple[Any, Any, tuple[int, ...], Any]:
    if align and first.source is not None and second.source is not None:
        ours, theirs = first.source.index, second.source.index
        if not ours.equals(theirs):
            index, *rows = ours.join(theirs, how="outer", return_indexers=True)
            i, k = (np.arange(len(index)) if row is None else row for row in rows)
            return i, k, (len(index),), index
    numbers = [np.arange(x.num_polygons).reshape(x.shape) for x in (first, second)]
    try:
        i, k = np.broadcast_arrays(*numbers)
    except ValueError:
        raise ValueError(
            f"the shapes of a and b do not fit: {first.shape} and {second.shape}"
        ) from None
    return i.ravel(), k.ravel(), i.shape, None


def buffers(
    operand: Operand,
    distance: float,
    tolerance: float,
    edges: Edges,
    invalid: Invalid,
    threads: int,
) -> _core.CellRings:
    """The buffers of points, lines and polygons."""
    if operand.is_of_cells:
        made: _core.CellRings = _core.buffers_of(operand.rings(), distance, tolerance, threads)
        return made
    if not operand.num_polygons:
        return _core.CellRings()
    made = told_by_core(
        [operand],
        edges,
        lambda given: _core.buffers_in(given, distance, tolerance, edges, invalid, threads),
        with_lines=True,
    )
    return made


def told_by_core(read: list[Operand], edges: Edges, call: Call, *, with_lines: bool = False) -> Any:
    """The result of a call with all geometries; remarks become warnings."""
    result, remarks = _told(read, edges, call, with_lines=with_lines)
    for remark in remarks:
        warn_caller(remark)
    return result


def faults_of(operand: Operand, edges: Edges, threads: int | None) -> list[str]:
    """What is wrong with each polygon; an empty text for those that are valid or missing."""
    require_rules(edges=edges)
    number = as_threads(threads)
    if not operand.num_polygons:
        return []
    faults, _ = _told(
        [operand], edges, lambda given: (_core.polygon_faults(given, edges, number), ())
    )
    return [*faults]


def repaired_cells(
    operand: Operand, is_faulty: BoolArray, edges: Edges, threads: int | None
) -> _core.CellRings:
    """The cells of some polygons, repaired; those of others have no rings."""
    if operand.features is None:
        shapes = operand.given.copy()
        shapes[~is_faulty] = None
        taken = replace(operand, given=shapes)
    else:
        nothing = feature_of(None)
        pairs = zip(operand.features, is_faulty, strict=True)
        taken = replace(operand, features=[feature if k else nothing for feature, k in pairs])
    number = as_threads(threads)
    cells, _ = _told(
        [taken], edges, lambda given: _core.cells_of_polygons(given, edges, "repair", number)
    )
    made: _core.CellRings = cells
    return made


def _told(
    read: list[Operand], edges: Edges, call: Call, *, with_lines: bool = False
) -> tuple[Any, list[str]]:
    """The result of a call with all geometries, and remarks. These and errors have the name of the
    argument and the number of the geometry.
    """

    def owner(match: re.Match[str]) -> str:
        number = int(match[1])
        for operand in read:
            if number < operand.num_polygons:
                return operand.name if operand.is_single else f"{operand.name}: geometry {number}"
            number -= operand.num_polygons
        return match[0]

    def named(text: str) -> str:
        return re.sub(r"^(?:geometries: )?(?:geometry|feature) ([0-9]+)", owner, text)

    try:
        if not any(operand.features for operand in read):
            shapes = np.concatenate([operand.given for operand in read])
            result, remarks = call(taken_apart(shapes, with_lines=with_lines))
        else:
            features = [feature for operand in read for feature in operand.geojson()]
            known = {"type": "FeatureCollection", "features": features}
            result, remarks = features_of(known, edges, call)
    except ValueError as error:
        raise ValueError(named(str(error))) from None
    return result, [named(remark) for remark in remarks]


def cells_from(cells: _core.CellRings, first: int, number: int) -> _core.CellRings:
    """Some cells in a row."""
    of_cells = cells.cells[first : first + number + 1]
    of_rings = cells.rings[of_cells[0] : of_cells[-1] + 1]
    whole = cells.whole[(cells.whole >= first) & (cells.whole < first + number)]
    arrays = {
        "cells": of_cells - of_cells[0],
        "rings": of_rings - of_rings[0],
        "corners": cells.corners[of_rings[0] : of_rings[-1]],
        "points": cells.points,
        "whole": whole - np.int32(first),
    }
    return with_arrays(_core.CellRings(), arrays)


def cells_at(cells: _core.CellRings, places: IntArray, number: int) -> _core.CellRings:
    """So many cells, of which those at `places` are given, and others are empty."""
    sizes = np.zeros(number, np.int64)
    sizes[places] = np.diff(cells.cells)
    arrays = {
        "cells": np.concatenate([[0], np.cumsum(sizes)]),
        "rings": cells.rings,
        "corners": cells.corners,
        "points": cells.points,
        "whole": places[cells.whole].astype(np.int32),
    }
    return with_arrays(_core.CellRings(), arrays)


def geometries_from(made: _core.Geometries, first: int, number: int) -> _core.Geometries:
    """Some geometries in a row."""
    groups = made.line_groups[first : first + number + 1]
    rows = made.lines[groups[0] : groups[-1] + 1]
    arrays = {
        "line_groups": groups - groups[0],
        "lines": rows - rows[0],
        "line_points": made.line_points[rows[0] : rows[-1]],
        "polygons": cells_from(made.polygons, first, number),
    }
    return with_arrays(_core.Geometries(), arrays)


def geometries_at(made: _core.Geometries, places: IntArray, number: int) -> _core.Geometries:
    """So many geometries, of which those at `places` are given, and others have no place."""
    sizes = np.zeros(number, np.int64)
    sizes[places] = np.diff(made.line_groups)
    arrays = {
        "line_groups": np.concatenate([[0], np.cumsum(sizes)]),
        "lines": made.lines,
        "line_points": made.line_points,
        "polygons": cells_at(made.polygons, places, number),
    }
    return with_arrays(_core.Geometries(), arrays)


def cell_set(cells: _core.CellRings, threads: int | None) -> CellSet:
    """The cells of a result, none of which crosses itself."""
    made = CellSet._of(_core.CellSet.valid_polygons(cells, as_threads(threads)))
    made._is_sound = True
    return made


def like(operand: Operand, shapes: np.ndarray[Any, Any], rows: Any, index: Any) -> Any:
    """The shapes as the kind of an argument, of which they have these rows; `index` is that of a
    GeoSeries or GeoDataFrame.
    """
    if operand.source is None:
        return shapes
    import geopandas

    series = geopandas.GeoSeries(shapes, index=index, crs=operand.source.crs)
    if operand.is_frame:
        series = rows_at(operand.source, rows).set_index(index).set_geometry(series.array)
    return encoded(series, operand.encoding)


def encoded(made: Any, encoding: str | None) -> Any:
    """The same for Arrow, if there is an encoding."""
    return made if encoding is None else made.to_arrow(geometry_encoding=encoding)


def rows_at(frame: Any, rows: ArrayLike) -> Any:
    """Rows of a table by their numbers, with missing values for -1."""
    plain = frame.reset_index(drop=True)
    return plain.reindex(rows) if np.any(np.less(rows, 0)) else plain.take(rows)
