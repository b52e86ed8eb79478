# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons of other libraries: shapely, GeoPandas, and whatever has `__geo_interface__`."""

from __future__ import annotations

import json
import os
import pathlib
import tempfile
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, TypeAlias

from . import _core
from ._geo import write_named

Edges: TypeAlias = Literal["lonlat", "geodesic"]


def read_polygons(name: str, edges: Edges, threads: int) -> _core.Partition:
    """The polygons of a file of GeoJSON."""
    is_geodesic = _is_geodesic(edges)
    return _read(name, lambda file: _core.read_polygon_partition(file, is_geodesic, threads))


def polygons_of(geometries: Any, edges: Edges, threads: int) -> _core.Partition:
    """The polygons of objects: a cell for each of them."""
    return _of_objects(geometries, lambda name: read_polygons(name, edges, threads))


def features_of(features: Any, edges: Edges, read: Callable[[str, bool], Any]) -> Any:
    """What is read of a file of GeoJSON, or of objects: `read` gets a file and the edges."""
    is_geodesic = _is_geodesic(edges)
    if is_file(features):
        return _read(os.fspath(features), lambda file: read(file, is_geodesic))
    return _of_objects(features, lambda file: read(file, is_geodesic))


def _is_geodesic(edges: Edges) -> bool:
    if edges not in ("lonlat", "geodesic"):
        raise ValueError(f"edges must be 'lonlat' or 'geodesic', not {edges!r}")
    return edges == "geodesic"


def _read(name: str, read: Callable[[str], Any]) -> Any:
    made: list[Any] = []
    write_named(name, lambda file: made.append(read(file)))
    return made[0]


def _of_objects(geometries: Any, read: Callable[[str], Any]) -> Any:
    try:
        text = json.dumps(_collection(geometries), allow_nan=False)
    except ValueError:
        raise ValueError("geometries: a number is not finite") from None
    with tempfile.TemporaryDirectory() as folder:
        name = str(pathlib.Path(folder) / "geometries.geojson")
        pathlib.Path(name).write_text(text, "utf-8")
        try:
            return read(name)
        except OSError as error:
            problem = str(error).partition(name)[2].lstrip("0123456789: ")
            raise ValueError(f"geometries: {problem}") from None


def is_file(regions: Any) -> bool:
    return isinstance(regions, (str, os.PathLike))


def _collection(geometries: Any) -> dict[str, Any]:
    geometries = _from_arrow(geometries)
    crs = getattr(geometries, "crs", None)
    if crs is not None and not crs.is_geographic:
        geometries = geometries.to_crs(4326)
    geometries = getattr(geometries, "geometry", geometries)  # of a GeoDataFrame
    known = _interface(geometries)
    if known is not None:
        return known
    if not isinstance(geometries, Iterable):
        kind = type(geometries).__name__
        raise TypeError(f"polygons must be geometries, a file, or a Partition, not {kind}")
    return {"type": "FeatureCollection", "features": [_feature(g) for g in geometries]}


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


def _feature(geometry: Any) -> dict[str, Any]:
    known = None if geometry is None else _interface(geometry)
    if known is None and geometry is not None:
        raise TypeError(f"{type(geometry).__name__} is no geometry: it has no __geo_interface__")
    if known is not None and known.get("type") == "Feature":
        return dict(known)
    return {"type": "Feature", "properties": {}, "geometry": known}
