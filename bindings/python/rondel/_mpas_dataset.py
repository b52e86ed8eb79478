# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A mesh as an xarray Dataset with MPAS's names: `Mesh.to_xarray`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import degrees_of
from ._types import FloatArray, IntArray

if TYPE_CHECKING:
    import xarray


def _padded_rows(offsets: npt.NDArray[np.int64], entries: IntArray) -> IntArray:
    """Lists around cells as rows of numbers from 1 that end with 0."""
    counts = np.diff(offsets)
    rows = np.zeros((len(counts), int(counts.max())), np.int32)
    column = np.arange(len(entries)) - np.repeat(offsets[:-1], counts)
    rows[np.repeat(np.arange(len(counts)), counts), column] = entries + 1
    return rows


def _places(kind: str, points: FloatArray) -> dict[str, Any]:
    """Coordinates of cells, edges or vertices."""
    x, y, z = points.T
    lon, lat = np.radians(degrees_of(points)).T
    lon = np.where(lon < 0, lon + 2 * np.pi, lon)
    lon[lon >= 2 * np.pi] = 0
    dimension = "nVertices" if kind == "Vertex" else f"n{kind}s"
    coordinates = {"x": x, "y": y, "z": z, "lon": lon, "lat": lat}
    return {axis + kind: (dimension, values) for axis, values in coordinates.items()}


def dataset_of(mesh: _core.MeshArrays, density: FloatArray) -> xarray.Dataset:
    """The mesh with the names, dimensions and numbers of MPAS."""
    import xarray

    data: dict[str, Any] = {
        "nEdgesOnCell": ("nCells", np.diff(mesh.offsets).astype(np.int32)),
        "areaCell": ("nCells", mesh.cell_areas),
        "meshDensity": ("nCells", density),
        "dcEdge": ("nEdges", mesh.cell_distances),
        "dvEdge": ("nEdges", mesh.vertex_distances),
        "angleEdge": ("nEdges", mesh.normal_angles),
        "areaTriangle": ("nVertices", mesh.triangle_areas),
        "kiteAreasOnVertex": (("nVertices", "vertexDegree"), mesh.kite_areas),
    }
    for name, entries in (
        ("edgesOnCell", mesh.edges_on_cell),
        ("cellsOnCell", mesh.cells_on_cell),
        ("verticesOnCell", mesh.vertices_on_cell),
    ):
        data[name] = (("nCells", "maxEdges"), _padded_rows(mesh.offsets, entries))
    for name, dimensions, rows in (
        ("cellsOnEdge", ("nEdges", "TWO"), mesh.cells_on_edge),
        ("verticesOnEdge", ("nEdges", "TWO"), mesh.vertices_on_edge),
        ("cellsOnVertex", ("nVertices", "vertexDegree"), mesh.cells_on_vertex),
        ("edgesOnVertex", ("nVertices", "vertexDegree"), mesh.edges_on_vertex),
    ):
        data[name] = (dimensions, rows + 1)
    places = (
        ("Cell", mesh.cell_points),
        ("Edge", mesh.edge_points),
        ("Vertex", mesh.vertex_points),
    )
    for kind, points in places:
        data |= _places(kind, points)
    attributes = {
        "on_a_sphere": "YES",
        "sphere_radius": mesh.radius,
        "is_periodic": "NO",
        "Conventions": "MPAS",
        "mesh_spec": "1.0",
    }
    return xarray.Dataset(data, attrs=attributes)
