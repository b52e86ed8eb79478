# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons of other libraries: shapely, GeoPandas, and whatever has `__geo_interface__`."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Literal, TypeAlias

import numpy as np

from . import _core
from ._errors import FileError, InvalidInput, warn_caller
from ._projected import in_lonlat
from ._properties import json_cells
from ._taken_apart import shapely_array, taken_apart

Edges: TypeAlias = Literal["lonlat", "geodesic"]
Invalid: TypeAlias = Literal["error", "repair"]
PolygonOverlap: TypeAlias = Literal["keep", "error", "first"]
Sides: TypeAlias = Literal["parallels", "great_circles"]
Corners: TypeAlias = Literal["error", "made"]

Groups: TypeAlias = np.ndarray[Any, np.dtype[np.int32]] | None


def read_cells(
    name: str,
    edges: Edges,
    overlap: PolygonOverlap,
    invalid: Invalid,
    threads: int,
    groups: Groups = None,
    sides: Sides = "parallels",
    corners: Corners = "error",
) -> _core.CellSet:
    """The cells of a file; polygons with a group below 0 are left out."""
    with _hints():
        cells = _core.CellSet.read(name, sides, edges, overlap, invalid, groups, corners, threads)
    for remark in cells.facts.remarks:
        warn_caller(f"{name}: {remark}")
    return cells


def polygons_of(
    geometries: Any,
    edges: Edges,
    overlap: PolygonOverlap,
    invalid: Invalid,
    threads: int,
    groups: Groups = None,
) -> _core.CellSet:
    """The polygons of objects: a cell for each of them, empty where the group is below 0."""
    rules = edges, overlap, invalid

    def from_text(given: Any) -> _core.CellSet:
        made: _core.CellSet = _of_objects(
            given,
            edges,
            lambda file: _core.CellSet.read(file, "parallels", *rules, groups, "error", threads),
        )
        return made

    arrays = _arrays_of(geometries, edges)
    rows = _properties(geometries) if is_of_geopandas(geometries) else []
    try:
        cells = (
            None if arrays is None else _core.CellSet.of_geometries(arrays, *rules, groups, threads)
        )
    except InvalidInput as error:
        if not rows:
            raise ValueError(_told_of_geometries(str(error))) from None
        cells = None
    if cells is None or (rows and cells.facts.remarks):
        # Messages have the names of geometries, which are among their properties.
        cells = from_text(geometries)
    for remark in cells.facts.remarks:
        warn_caller(remark)
    facts = _core.CellFacts(cells.facts)
    if arrays is not None and rows:
        plain = [{**feature_of(None), "properties": row} for row in rows]
        facts.columns = from_text({"type": "FeatureCollection", "features": plain}).facts.columns
    facts.name = ""  # that of a file which is gone
    return cells.with_facts(facts)


def features_of(features: Any, edges: Edges, read: Callable[[Any], Any]) -> Any:
    """The result of `read`, which gets a file or bytes with the features."""
    if is_file(features):
        with _hints():
            return read(os.fspath(features))
    return _of_objects(features, edges, read)


def is_geodesic(edges: Edges) -> bool:
    require_rules(edges=edges)
    return edges == "geodesic"


def require_rules(edges: str = "lonlat", overlap: str = "error", invalid: str = "error") -> None:
    """Refuses other words, also where no polygons are read to which they matter."""
    for name, word, one, other in (
        ("edges", edges, "lonlat", "geodesic"),
        ("overlap", overlap, "error", "first"),
        ("invalid", invalid, "error", "repair"),
    ):
        if word not in (one, other):
            raise ValueError(f"{name} must be {one!r} or {other!r}, not {word!r}")


def _arrays_of(geometries: Any, edges: Edges) -> _core.LonLatGeometries | None:
    """Polygons of GeoArrow in degrees, of shapely and of GeoPandas; None of others, as of GeoJSON
    and WKB.
    """
    if hasattr(geometries, "__arrow_c_array__") and not hasattr(geometries, "__geo_interface__"):
        try:
            return _core.geometries_of_capsules(*geometries.__arrow_c_array__())
        except InvalidInput:
            return None
    shapely: Any = sys.modules.get("shapely")
    if shapely is None:
        return None
    if isinstance(geometries, shapely.GeometryCollection):
        shapes = shapely.get_parts(geometries)
    elif isinstance(geometries, shapely.Geometry):
        shapes = np.array([geometries], object)
    elif is_of_geopandas(geometries):
        shapes = in_degrees(geometries, edges)
        shapes = np.asarray(getattr(shapes, "geometry", shapes), object)
    elif isinstance(geometries, (list, tuple, np.ndarray)):
        shapes = shapely_array(geometries)
    else:
        shapes = None
    return None if shapes is None else taken_apart(shapes)


def _of_objects(geometries: Any, edges: Edges, read: Callable[[str | bytes], Any]) -> Any:
    collection = _collection(geometries, edges)
    try:
        text = json.dumps(collection, allow_nan=False, default=_plain)
    except ValueError:
        raise ValueError(
            f"{_first_not_finite(collection)} has a position that is not finite"
        ) from None
    try:
        return read(text.encode())
    except OSError as error:
        problem = re.sub(r"^geometries[:0-9]*: ", "", str(error))
        raise ValueError(_told_of_geometries(problem)) from None


# The end of errors about features that overlap.
_FIRST = "; overlap='first' gives what they share to the first one"


@contextmanager
def _hints() -> Iterator[None]:
    """Errors about features of a file that overlap say what can be done."""
    try:
        yield
    except FileError as error:
        text = str(error)
        if not re.search(r": features [0-9].* overlap at ", text):
            raise
        raise FileError(f"{text}{_FIRST}") from None


def _told_of_geometries(problem: str) -> str:
    if re.match(r"features [0-9]", problem):
        return re.sub(r"^features(?= [0-9])|features$", "geometries", problem) + _FIRST
    return "geometries: " + re.sub(r"^feature (?=[0-9])", "geometry ", problem)


def _plain(value: Any) -> Any:
    """Arrays and numbers of NumPy as JSON has them."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"a {type(value).__name__} has no place in GeoJSON")


def _first_not_finite(collection: Mapping[str, Any]) -> str:
    items = collection.get("features", collection.get("geometries", [collection]))
    for i, item in enumerate(items):
        try:
            json.dumps(item, allow_nan=False, default=_plain)
        except ValueError:
            return f"geometry {i}"
    return "what is beside the geometries"


def is_of_geopandas(geometries: Any) -> bool:
    geopandas: Any = sys.modules.get("geopandas")
    if geopandas is None:
        return False
    kinds = geopandas.GeoSeries, geopandas.GeoDataFrame, geopandas.array.GeometryArray
    return isinstance(geometries, kinds)


def is_file(regions: Any) -> bool:
    return isinstance(regions, (str, os.PathLike))


def _collection(geometries: Any, edges: Edges) -> dict[str, Any]:
    geometries = _from_arrow(geometries)
    geometries = in_degrees(geometries, edges)
    properties = _properties(geometries)
    geometries = getattr(geometries, "geometry", geometries)  # of a GeoDataFrame
    if is_box(geometries):
        return box_of(*map(float, geometries))
    known = _without_box(_interface(geometries))
    if properties:
        return {**known, "features": [*map(_with_properties, known["features"], properties)]}
    if known is not None:
        return known
    if not isinstance(geometries, Iterable):
        kind = type(geometries).__name__
        raise TypeError(f"polygons must be geometries, a file, or a CellSet, not {kind}")
    return {"type": "FeatureCollection", "features": [feature_of(g) for g in geometries]}


def in_degrees(geometries: Any, edges: Edges = "lonlat") -> Any:
    """Geometries of GeoPandas in degrees: of WGS 84, or of another body as its CRS has them.

    `edges` will join their positions.
    """
    are_arcs = is_geodesic(edges)
    crs = getattr(geometries, "crs", None)
    if crs is None or crs.equals(4326, ignore_axis_order=True):
        return geometries
    if crs.is_engineering and str(crs.name).lower().startswith("undefined "):
        # GeoPackage has systems that stand for none.
        return geometries.set_crs(None, allow_override=True)
    from pyproj.exceptions import ProjError

    try:
        return in_lonlat(geometries, crs, 4326, are_arcs)
    except ProjError as error:
        sphere = crs.geodetic_crs  # of the Moon, say, of which there is no way to WGS 84
        if sphere is None or not _has_degrees(sphere):
            raise ValueError(
                f"the CRS {crs.name!r} cannot be converted to EPSG:4326: {error}"
            ) from None
        if crs.equals(sphere):
            return geometries
        return in_lonlat(geometries, crs, sphere, are_arcs)


def _has_degrees(crs: Any) -> bool:
    """Whether a geographic CRS has degrees to the north and east of its body's first meridian."""
    axes = [(axis.unit_name, axis.direction) for axis in crs.axis_info[:2]]
    meridian = crs.prime_meridian.longitude if crs.prime_meridian is not None else 0
    return meridian == 0 and sorted(axes) == [("degree", "east"), ("degree", "north")]


def _properties(frame: Any) -> list[dict[str, Any]]:
    """The rows of a GeoDataFrame but for geometries; none of anything else."""
    columns = [
        (str(name), json_cells(frame.iloc[:, k]))
        for k, name in enumerate(getattr(frame, "columns", ()))
        if str(frame.dtypes.iloc[k]) != "geometry"
    ]
    cells = [[json.loads(cell or "null") for cell in cells] for _, cells in columns]
    return [
        dict(zip((name for name, _ in columns), row, strict=True))
        for row in zip(*cells, strict=True)
    ]


def _without_box(known: Any) -> Any:
    """GeoJSON without `bbox`, which no reader asks for and which is NaN where nothing is in it."""
    if isinstance(known, (list, tuple)):
        return [_without_box(part) for part in known]
    if not isinstance(known, Mapping):
        return known
    nested = ("features", "geometry", "geometries")
    return {
        name: _without_box(part) if name in nested else part
        for name, part in known.items()
        if name != "bbox"
    }


def _with_properties(feature: Mapping[str, Any], properties: dict[str, Any]) -> dict[str, Any]:
    return {**feature, "properties": properties}


def is_box(bounds: Any) -> bool:
    """Whether it is west, south, east and north, as of shapely's and GeoPandas' bounds."""
    return (
        isinstance(bounds, (tuple, list, np.ndarray))
        and len(bounds) == 4
        and all(isinstance(bound, (int, float, np.number)) for bound in bounds)
    )


def box_of(west: float, south: float, east: float, north: float) -> dict[str, Any]:
    """A box, which crosses the antimeridian if its west is east of its east (RFC 7946, 5.2)."""
    if east < west:
        east += 360
    if not (south < north and west < east):
        raise ValueError(f"the box {west:g} {south:g} {east:g} {north:g} has no area")
    corners = [(west, south), (east, south), (east, north), (west, north), (west, south)]
    return {"type": "Polygon", "coordinates": [corners]}


def _from_arrow(geometries: Any) -> Any:
    """GeoArrow's arrays and tables as GeoPandas'."""
    if hasattr(geometries, "__geo_interface__"):
        return geometries
    if hasattr(geometries, "__arrow_c_array__"):
        import geopandas

        return geopandas.GeoSeries.from_arrow(geometries)
    if hasattr(geometries, "__arrow_c_stream__"):
        import geopandas

        return geopandas.GeoDataFrame.from_arrow(geometries)
    return geometries


def _interface(geometry: Any) -> Any:
    if isinstance(geometry, Mapping):
        return geometry
    return getattr(geometry, "__geo_interface__", None)


def feature_of(geometry: Any) -> dict[str, Any]:
    known = None if geometry is None else _interface(geometry)
    if known is None and geometry is not None:
        raise TypeError(f"{type(geometry).__name__} is no geometry: it has no __geo_interface__")
    known = _without_box(known)
    if known is not None and known.get("type") == "Feature":
        return dict(known)
    return {"type": "Feature", "properties": {}, "geometry": known}
