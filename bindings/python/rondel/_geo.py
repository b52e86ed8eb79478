# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations and diagrams for other libraries: GeoJSON, GeoPandas, xarray (UGRID).

The functions are methods of `SphericalDelaunay`, `SphericalVoronoi` and `PowerDiagram`.
"""

from __future__ import annotations

import json
import math
import os
import pathlib
import tempfile
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import lonlat
from ._types import FloatArray, IntArray

if TYPE_CHECKING:
    from ._delaunay import SphericalDelaunay
    from ._diagram import Diagram


def triangles_to_geojson(
    self: SphericalDelaunay, path: str | os.PathLike[str] | None = None
) -> Any:
    """The faces as GeoJSON (RFC 7946): counterclockwise, cut at the antimeridian, poles closed.

    A feature for each solid face, with the property `sites`, the indices of its corners.

    Parameters
    ----------
    path : path-like, optional
        Where to write the text; otherwise it is returned, parsed.

    Returns
    -------
    dict or None

    Raises
    ------
    OSError
        If the file cannot be written; then nothing is left of it.

    """

    def write(name: str) -> None:
        _core.write_triangles(name, self._triangulation, self.points)

    return _written(path, write)


def cells_to_geojson(
    self: Diagram,
    path: str | os.PathLike[str] | None = None,
    *,
    properties: Mapping[str, Sequence[Any]] | None = None,
    tolerance_deg: float = 0.01,
) -> Any:
    """The cells as GeoJSON (RFC 7946): counterclockwise, cut at the antimeridian, poles closed.

    A feature for each cell, with the properties `site` (its index) and `area` (steradians).

    Parameters
    ----------
    path : path-like, optional
        Where to write the text; otherwise it is returned, parsed.
    properties : mapping of str to sequence, optional
        More properties: for each a value for every site, a number, a text or None.
    tolerance_deg : float, optional
        How far the straight lines of a polygon may be from its arcs, in degrees.

    Returns
    -------
    dict or None

    Raises
    ------
    OSError
        If the file cannot be written; then nothing is left of it.

    """
    columns = [
        _column(str(name), values, len(self.points))
        for name, values in (properties.items() if properties is not None else ())
    ]

    def write(name: str) -> None:
        _core.write_cells(
            name,
            self._delaunay._triangulation,
            self.points,
            self._diagram,
            columns,
            float(tolerance_deg),
        )

    return _written(path, write)


def _written(path: str | os.PathLike[str] | None, write: Callable[[str], None]) -> Any:
    """What `write` makes: in the file, or parsed."""
    if path is not None:
        name = os.fspath(path)
        if not name.endswith(".geojson"):
            raise ValueError(f"the name of a GeoJSON file ends in .geojson: {name}")
        write(name)
        return None
    with tempfile.TemporaryDirectory() as folder:
        text = pathlib.Path(folder) / "rondel.geojson"
        write(str(text))
        return json.loads(text.read_bytes())


def _column(name: str, values: Sequence[Any], count: int) -> tuple[str, bool, list[str]]:
    """A column of text: the name, whether all cells are numbers, and the cells."""
    if len(values) != count:
        raise ValueError(f"the property {name!r} has {len(values)} values for {count} sites")
    cells, is_numeric = [], True
    for value in np.asarray(values, dtype=object).tolist():
        if hasattr(value, "item"):
            value = value.item()  # a NumPy scalar
        if value is None or (isinstance(value, float) and not math.isfinite(value)):
            cells.append("")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            cells.append(repr(value))
        else:
            is_numeric = False
            cells.append(str(value))
    return name, is_numeric, cells


def to_geopandas(self: Any, **options: Any) -> Any:
    """The features of `to_geojson` as a GeoDataFrame in longitudes and latitudes (EPSG:4326).

    Parameters
    ----------
    **options
        Those of `to_geojson`.

    Returns
    -------
    geopandas.GeoDataFrame
        Polygons that cross the antimeridian are multipolygons, cut there.

    Raises
    ------
    ImportError
        If GeoPandas is not installed.

    """
    import geopandas

    features = self.to_geojson(**options)["features"]
    if not features:
        return geopandas.GeoDataFrame({"geometry": []}, crs="EPSG:4326")
    return geopandas.GeoDataFrame.from_features(features, crs="EPSG:4326")


def triangles_to_xarray(self: SphericalDelaunay) -> Any:
    """The triangulation as a UGRID mesh: sites are nodes, triangles faces.

    Returns
    -------
    xarray.Dataset
        With the UGRID 1.0 conventions; ``uxarray.Grid.from_dataset`` opens it.

    Raises
    ------
    ImportError
        If xarray is not installed.

    """
    return _ugrid(self.lonlat, self.simplices)


def cells_to_xarray(self: Diagram) -> Any:
    """The diagram as a UGRID mesh: corners of cells are nodes, cells faces, in the order of sites.

    Returns
    -------
    xarray.Dataset
        With the UGRID 1.0 conventions; ``uxarray.Grid.from_dataset`` opens it. Cells have
        different numbers of corners, and rows are filled up with -1.

    Raises
    ------
    ImportError
        If xarray is not installed.

    """
    offsets, rings, points = self.cells
    sizes = np.diff(offsets)
    faces = np.full((len(sizes), max(3, sizes.max(initial=0))), -1, np.int32)
    faces[np.arange(faces.shape[1]) < sizes[:, None]] = rings
    mesh = _ugrid(lonlat(points, self.center), faces)
    areas = {"long_name": "area of the cell", "units": "sr"}
    mesh["face_area"] = ("n_face", self.areas / self.radius**2, areas)
    return mesh


def _ugrid(nodes: FloatArray, faces: IntArray) -> Any:
    """A Dataset by UGRID 1.0: a topology, the positions of nodes, the corners of faces."""
    import xarray

    degrees = [
        {"standard_name": "longitude", "long_name": "longitude of nodes", "units": "degrees_east"},
        {"standard_name": "latitude", "long_name": "latitude of nodes", "units": "degrees_north"},
    ]
    topology = {
        "cf_role": "mesh_topology",
        "long_name": "topology of the mesh",
        "topology_dimension": np.int32(2),
        "node_coordinates": "node_lon node_lat",
        "face_node_connectivity": "face_node_connectivity",
        "face_dimension": "n_face",
        "node_dimension": "n_node",
    }
    corners = {
        "cf_role": "face_node_connectivity",
        "long_name": "corners of the faces, counterclockwise",
        "start_index": np.int32(0),
        "_FillValue": np.int32(-1),
    }
    return xarray.Dataset(
        {
            "mesh": ((), np.int32(0), topology),
            "face_node_connectivity": (("n_face", "n_max_face_nodes"), faces, corners),
        },
        coords={
            "node_lon": ("n_node", nodes[:, 0], degrees[0]),
            "node_lat": ("n_node", nodes[:, 1], degrees[1]),
        },
        attrs={"Conventions": "CF-1.11 UGRID-1.0"},
    )
