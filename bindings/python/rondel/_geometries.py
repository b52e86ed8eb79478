# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons of other libraries: shapely, GeoPandas, and whatever has `__geo_interface__`."""

from __future__ import annotations

import json
import os
import pathlib
import tempfile
from collections.abc import Iterable, Mapping
from typing import Any, Literal, TypeAlias

from . import _core
from ._geo import write_named

Edges: TypeAlias = Literal["lonlat", "geodesic"]


def read_polygons(name: str, edges: Edges, threads: int) -> _core.Partition:
    """The polygons of a file of GeoJSON."""
    if edges not in ("lonlat", "geodesic"):
        raise ValueError(f"edges must be 'lonlat' or 'geodesic', not {edges!r}")
    made: list[_core.Partition] = []

    def read(name: str) -> None:
        made.append(_core.read_polygon_partition(name, edges == "geodesic", threads))

    write_named(name, read)
    return made[0]


def polygons_of(geometries: Any, edges: Edges, threads: int) -> _core.Partition:
    """The polygons of objects: a cell for each of them."""
    text = json.dumps(_collection(geometries))
    with tempfile.TemporaryDirectory() as folder:
        name = str(pathlib.Path(folder) / "geometries.geojson")
        pathlib.Path(name).write_text(text, "utf-8")
        try:
            return read_polygons(name, edges, threads)
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
