# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The mesh that `rondel.mesh` makes and reads: its arrays, its quality, its files."""

from __future__ import annotations

import json
import pathlib
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import as_name, as_threads, frozen
from ._geometries import Edges
from ._mesh_making import ScvtReport
from ._mesh_parts import plot_mesh, removed_cells
from ._mpas_dataset import dataset_of
from ._types import ArrayLike, FloatArray, IntArray, Path

if TYPE_CHECKING:
    import xarray

Kind: TypeAlias = Literal["cdf5", "cdf2"]

_FORMATS = ("mpas", "ugrid", "scrip", "esmf", "exodus")


class EdgeWeights(NamedTuple):
    """Weights of edges in compressed rows (CSR), as `Mesh.tangential_weights` gives them."""

    indptr: npt.NDArray[np.int64]
    indices: IntArray
    data: FloatArray


class Culled(NamedTuple):
    """What `Mesh.cull` leaves.

    ``cells``, ``edges`` and ``vertices`` have the new number of each one of the mesh before, -1
    where it is gone.
    """

    mesh: Mesh
    cells: IntArray
    edges: IntArray
    vertices: IntArray


class Mesh:
    """A Voronoi mesh of the sphere: cells, edges between them, and vertices, all immutable.

    It is made by `scvt`, `from_points` and `read`. Lengths and areas are those of a sphere of
    `radius`; angles are radians; numbers of cells, edges and vertices start at 0.

    Examples
    --------
    >>> import numpy as np
    >>> import rondel.mesh
    >>> points = np.random.default_rng(1).normal(size=(1000, 3))
    >>> mesh = rondel.mesh.from_points(points)
    >>> mesh
    <Mesh: 1000 cells, 2994 edges, 1996 vertices>
    >>> bool(abs(mesh.cell_areas.sum() / (4 * np.pi) - 1) < 1e-13)
    True
    >>> mesh.quality["num_obtuse"] > 0
    True

    """

    report: ScvtReport | None = None
    """Of a mesh that `scvt` made, how that ended."""

    fixed: IntArray = frozen(np.empty(0, np.int32))
    """Of a mesh that `scvt` made, the cells of the fixed places, then of those along lines."""

    def __init__(self, arrays: _core.MeshArrays) -> None:
        self._arrays = arrays

    def __repr__(self) -> str:
        return (
            f"<Mesh: {len(self.points)} cells, {len(self.edge_points)} edges, "
            f"{len(self.vertex_points)} vertices>"
        )

    @property
    def radius(self) -> float:
        """float: the radius of the sphere."""
        return self._arrays.radius

    @property
    def points(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the sites of the cells, on the sphere of `radius`."""
        return self._arrays.cell_points

    @property
    def cell_areas(self) -> FloatArray:
        """Ndarray of float64, shape (n,): the areas of the cells."""
        return self._arrays.cell_areas

    @property
    def density(self) -> FloatArray:
        """Ndarray of float64, shape (n,): the density that the mesh was made for; 1 without one."""
        given = self._arrays.density
        return given if len(given) else frozen(np.ones(len(self.points)))

    @property
    def offsets(self) -> npt.NDArray[np.int64]:
        """Ndarray of int64, shape (n + 1,): where the lists around each cell begin."""
        return self._arrays.offsets

    @property
    def edges_on_cell(self) -> IntArray:
        """Ndarray of int32: the edges around each cell, counterclockwise."""
        return self._arrays.edges_on_cell

    @property
    def cells_on_cell(self) -> IntArray:
        """Ndarray of int32: the cells across these edges."""
        return self._arrays.cells_on_cell

    @property
    def vertices_on_cell(self) -> IntArray:
        """Ndarray of int32: the vertices at which these edges end."""
        return self._arrays.vertices_on_cell

    @property
    def edge_points(self) -> FloatArray:
        """Ndarray of float64, shape (e, 3): the middles between the sites of the edges' cells."""
        return self._arrays.edge_points

    @property
    def cells_on_edge(self) -> IntArray:
        """Ndarray of int32, shape (e, 2): the normal points from the first to the second."""
        return self._arrays.cells_on_edge

    @property
    def vertices_on_edge(self) -> IntArray:
        """Ndarray of int32, shape (e, 2): the ends; the second is to the left of the normal."""
        return self._arrays.vertices_on_edge

    @property
    def cell_distances(self) -> FloatArray:
        """Ndarray of float64, shape (e,): between the two sites, MPAS's dcEdge."""
        return self._arrays.cell_distances

    @property
    def vertex_distances(self) -> FloatArray:
        """Ndarray of float64, shape (e,): the lengths of the edges, MPAS's dvEdge."""
        return self._arrays.vertex_distances

    @property
    def normal_angles(self) -> FloatArray:
        """Ndarray of float64, shape (e,): the normals' angles from east, MPAS's angleEdge."""
        return self._arrays.normal_angles

    @property
    def vertex_points(self) -> FloatArray:
        """Ndarray of float64, shape (v, 3): the circumcenters of the triangles of sites."""
        return self._arrays.vertex_points

    @property
    def cells_on_vertex(self) -> IntArray:
        """Ndarray of int32, shape (v, 3): the cells around each vertex, counterclockwise."""
        return self._arrays.cells_on_vertex

    @property
    def edges_on_vertex(self) -> IntArray:
        """Ndarray of int32, shape (v, 3): the edges, each before the cell of the same column."""
        return self._arrays.edges_on_vertex

    @property
    def kite_areas(self) -> FloatArray:
        """Ndarray of float64, shape (v, 3): the parts of cells in each triangle, with a sign."""
        return self._arrays.kite_areas

    @property
    def triangle_areas(self) -> FloatArray:
        """Ndarray of float64, shape (v,): the sums of the kites."""
        return self._arrays.triangle_areas

    @cached_property
    def tangential_weights(self) -> EdgeWeights:
        """EdgeWeights: TRiSK's, which make the velocity along edges of that across others."""
        indptr, indices, data = self._arrays.tangential_weights(0)
        return EdgeWeights(frozen(indptr), frozen(indices), frozen(data))

    @cached_property
    def quality(self) -> dict[str, Any]:
        """dict: how good the mesh is.

        The keys are those of the report of ``rondel mesh quality --json``; extremes are ``{"value",
        "where"}``.
        """
        report: dict[str, Any] = json.loads(self._arrays.quality_json(0))
        return report

    def quality_picture(self, path: Path, *, num_worst: int = 100) -> None:
        """Draws histograms and a map of the worst cells as an SVG.

        Parameters
        ----------
        path : path_like
            Where to write it.
        num_worst : int, optional
            How many cells of each kind.

        """
        text = self._arrays.quality_picture(num_worst)
        pathlib.Path(as_name(path)).write_text(text, encoding="utf-8")

    plot = plot_mesh

    def cull(
        self,
        mask: ArrayLike | None = None,
        *,
        inside: Any = None,
        outside: Any = None,
        edges: Edges = "lonlat",
        threads: int | None = None,
    ) -> Culled:
        """The mesh without some of its cells, and where all of them are now.

        Edges and vertices stay where one of their cells does; what stays keeps its order, and its
        numbers bit by bit. At the border -1 stands for what is not there: the second cell of an
        edge, cells across edges, cells and edges around vertices.

        Parameters
        ----------
        mask : array_like, shape (n,), optional
            1 or True for cells that are removed.
        inside, outside : path_like, geometries or Partition, optional
            Polygons as in `SphericalVoronoi.clip`: cells are removed whose sites lie in them, or
            on their borders; or those whose sites do not.
        edges : {'lonlat', 'geodesic'}, optional
            What joins positions of polygons.
        threads : int, optional
            At most so many threads; by default one for each core.

        Returns
        -------
        Culled

        Examples
        --------
        >>> import rondel.mesh
        >>> mesh = rondel.mesh.scvt(642)
        >>> north = mesh.cull(mesh.points[:, 2] < 0)
        >>> north.mesh
        <Mesh: 320 cells, 1002 edges, 683 vertices>
        >>> int((north.mesh.cells_on_edge[:, 1] == -1).sum())
        90

        """
        removed = removed_cells(self.points, mask, inside, outside, edges, threads)
        arrays, *maps = _core.cull_mesh(self._arrays, removed, as_threads(threads))
        return Culled(Mesh(arrays), *(frozen(numbers) for numbers in maps))

    def _write(self, path: Path, form: str, kind: Kind, threads: int | None) -> None:
        if kind not in ("cdf5", "cdf2"):
            raise ValueError(f"kind is {kind!r}, which is neither 'cdf5' nor 'cdf2'")
        self._arrays.write(as_name(path), _FORMATS.index(form), kind == "cdf2", as_threads(threads))

    def to_mpas(
        self,
        path: Path,
        *,
        graph: Path | None = None,
        kind: Kind = "cdf5",
        threads: int | None = None,
    ) -> None:
        """Writes a mesh file of MPAS.

        Parameters
        ----------
        path : path_like
            The file; netCDF-4, compressed, where it ends in ``.nc4``.
        graph : path_like, optional
            Where to write ``graph.info`` for METIS.
        kind : {'cdf5', 'cdf2'}, optional
            Which of netCDF's classic formats; CDF-2 has less than 4 GiB a variable.
        threads : int, optional
            At most so many threads; by default one for each core.

        """
        self._write(path, "mpas", kind, threads)
        if graph is not None:
            self._arrays.write_graph(as_name(graph))

    def to_ugrid(self, path: Path, *, kind: Kind = "cdf5", threads: int | None = None) -> None:
        """Writes a UGRID file, with the parameters of `to_mpas`."""
        self._write(path, "ugrid", kind, threads)

    def to_scrip(self, path: Path, *, kind: Kind = "cdf5", threads: int | None = None) -> None:
        """Writes a SCRIP grid file, with the parameters of `to_mpas`."""
        self._write(path, "scrip", kind, threads)

    def to_esmf(self, path: Path, *, kind: Kind = "cdf5", threads: int | None = None) -> None:
        """Writes an unstructured mesh file of ESMF, with the parameters of `to_mpas`."""
        self._write(path, "esmf", kind, threads)

    def to_exodus(self, path: Path, *, kind: Kind = "cdf5", threads: int | None = None) -> None:
        """Writes an Exodus II file, with the parameters of `to_mpas`."""
        self._write(path, "exodus", kind, threads)

    def to_xarray(self) -> xarray.Dataset:
        """The mesh as an xarray Dataset with the names, dimensions and numbers of MPAS.

        Returns
        -------
        xarray.Dataset
            Without the lists that follow from others and the weights; numbers start at 1, as in
            MPAS's files, and rows end with 0.

        """
        return dataset_of(self._arrays, self.density)
