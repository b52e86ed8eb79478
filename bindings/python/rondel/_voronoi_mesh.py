# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The class of meshes: their arrays, quality and files."""

from __future__ import annotations

import json
import os
import pathlib
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import as_name, as_threads, frozen
from ._geometries import Edges, Invalid
from ._mesh_making import ScvtReport
from ._mesh_parts import removed_cells
from ._pickled import arrays_of, with_arrays
from ._plot_mesh import plot_mesh
from ._types import ArrayLike, FloatArray, IntArray, Path

if TYPE_CHECKING:
    import xarray

Kind: TypeAlias = Literal["nc4", "cdf5", "cdf2"]


class EdgeWeights(NamedTuple):
    """Weights of edges in compressed rows (CSR), which `Mesh.tangential_weights` returns.

    The row of edge e has the edges ``indices[indptr[e]:indptr[e + 1]]`` and their weights in
    `data`.
    """

    indptr: npt.NDArray[np.int64]
    indices: IntArray
    data: FloatArray


class CellQuality(NamedTuple):
    """Measures of each cell, which decide whether a model runs on the mesh: `Mesh.cell_quality`.

    Attributes
    ----------
    centroid_offset : ndarray of float64, shape (n,)
        The distance of the center of mass from the site, in spacings.
    edge_ratio : ndarray of float64, shape (n,)
        The length of an edge over the distance of the sites on both sides (dv/dc), the least of
        the cell's edges.
    side_ratio : ndarray of float64, shape (n,)
        The shortest edge over the longest.
    distance_ratio : ndarray of float64, shape (n,)
        The distance of the farthest neighbor over that of the nearest.
    gradient : ndarray of float64, shape (n,)
        The difference of the spacings of two neighbors over their mean, the largest of the cell.

    """

    centroid_offset: FloatArray
    edge_ratio: FloatArray
    side_ratio: FloatArray
    distance_ratio: FloatArray
    gradient: FloatArray


class Culled(NamedTuple):
    """The result of `Mesh.cull`.

    Attributes
    ----------
    mesh : Mesh
        The mesh that is left.
    cells, edges, vertices : ndarray of int32
        The new number of each cell, edge and vertex of the original mesh; -1 if it was removed.

    """

    mesh: Mesh
    cells: IntArray
    edges: IntArray
    vertices: IntArray


class Mesh:
    """A Voronoi mesh of the sphere: cells, edges between them, and vertices, all immutable.

    `scvt`, `from_points` and `read` make it. Lengths and areas are those on a sphere of `radius`;
    angles are in radians; numbers of cells, edges and vertices start at 0.

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
    """How the work ended, if `scvt` made the mesh; otherwise None."""

    fixed: IntArray = frozen(np.empty(0, np.int32))
    """If `scvt` made the mesh: the cells of the fixed places, then of those along lines."""

    def __init__(self, arrays: _core.VoronoiMesh) -> None:
        self._arrays = arrays

    def __getstate__(self) -> dict[str, Any]:
        known = {name: self.__dict__[name] for name in ("report", "fixed") if name in self.__dict__}
        return {"arrays": arrays_of(self._arrays), "known": known}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._arrays = with_arrays(_core.VoronoiMesh(), state["arrays"])
        self.__dict__.update(state["known"])

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
        """Ndarray of int32: the cells across `edges_on_cell`; -1 at the border."""
        return self._arrays.cells_on_cell

    @property
    def vertices_on_cell(self) -> IntArray:
        """Ndarray of int32: the vertices at which `edges_on_cell` end, counterclockwise."""
        return self._arrays.vertices_on_cell

    @property
    def edge_points(self) -> FloatArray:
        """Ndarray of float64, shape (e, 3): the midpoints between the sites of the two cells."""
        return self._arrays.edge_points

    @property
    def cells_on_edge(self) -> IntArray:
        """Ndarray of int32, shape (e, 2): the cells; the normal points from first to second."""
        return self._arrays.cells_on_edge

    @property
    def vertices_on_edge(self) -> IntArray:
        """Ndarray of int32, shape (e, 2): the ends; the second is to the left of the normal."""
        return self._arrays.vertices_on_edge

    @property
    def cell_distances(self) -> FloatArray:
        """Ndarray of float64, shape (e,): the distances of the two sites, MPAS's dcEdge."""
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
        """EdgeWeights: the weights of TRiSK (Thuburn et al., J. Comput. Phys. 228, 2009), which
        reconstruct the velocity along an edge from the velocities across other edges.
        """
        indptr, indices, data = self._arrays.tangential_weights(0)
        return EdgeWeights(frozen(indptr), frozen(indices), frozen(data))

    @cached_property
    def quality(self) -> dict[str, Any]:
        """dict: the quality of the mesh.

        The keys are those of ``rondel mesh quality --json``. An extremum is a dict with its "value"
        and "where" it is, the number of a cell, edge or vertex.
        """
        report: dict[str, Any] = json.loads(self._arrays.quality_json(0))
        return report

    @cached_property
    def cell_quality(self) -> CellQuality:
        """CellQuality: measures of each cell, whose extrema are in `quality`."""
        return CellQuality(*map(frozen, self._arrays.cell_quality(0)))

    def quality_picture(self, path: Path, *, num_worst: int = 100) -> None:
        """Draws histograms and a map of the worst cells as an SVG.

        Parameters
        ----------
        path : path_like
            The file to write.
        num_worst : int, optional
            The number of worst cells of each kind; by default 100.

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
        invalid: Invalid = "error",
        threads: int | None = None,
    ) -> Culled:
        """Removes cells from the mesh.

        Edges and vertices stay if one of their cells does. They keep their order and their values
        bit by bit. At the border -1 stands for missing elements: the second cell of an edge, cells
        across edges, cells and edges around vertices.

        Parameters
        ----------
        mask : array_like, shape (n,), optional
            1 or True for cells that are removed, 0 or False for others.
        inside, outside : path_like, geometries or CellSet, optional
            Polygons as in `SphericalVoronoi.clip`. Cells are removed if their sites lie inside or
            on the border of `inside`, or if they do not lie in `outside`.
        edges : {'lonlat', 'geodesic'}, optional
            What joins positions of polygons: straight lines in longitude and latitude as in RFC
            7946 (default), or great circles.
        invalid
            As in `CellSet.read`.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        Culled
            The mesh that is left, and the new numbers of all cells, edges and vertices.

        Raises
        ------
        TypeError
            If neither a mask nor polygons are given.
        ValueError
            If the mask has another shape or other values.

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
        removed = removed_cells(self.points, mask, inside, outside, edges, invalid, threads)
        arrays, *maps = _core.cull_mesh(self._arrays, removed, as_threads(threads))
        return Culled(Mesh(arrays), *(frozen(numbers) for numbers in maps))

    def _write(
        self,
        path: Path,
        form: str,
        kind: Kind | None,
        threads: int | None,
        graph: str | None = None,
    ) -> None:
        name = as_name(path)
        if kind not in (None, "nc4", "cdf5", "cdf2"):
            raise ValueError(f"kind is {kind!r}, which is none of 'nc4', 'cdf5' and 'cdf2'")
        if kind in ("cdf5", "cdf2") and name.lower().endswith(".nc4"):
            raise ValueError(f"kind {kind!r} contradicts the name {name!r}, that of netCDF-4")
        self._arrays.write(name, form, kind or "by_name", graph, as_threads(threads))

    def to_mpas(
        self,
        path: Path,
        *,
        graph: Path | None = None,
        kind: Kind | None = None,
        threads: int | None = None,
    ) -> None:
        """Writes a mesh file of MPAS (MPAS Mesh Specification 1.0, 2015).

        Parameters
        ----------
        path : path_like
            The file to write.
        graph : path_like, optional
            Where to write ``graph.info`` for METIS; by default it is not written.
        kind : {'nc4', 'cdf5', 'cdf2'}, optional
            The format of netCDF; by default 'nc4', compressed netCDF-4, where the name of the file
            ends in ``.nc4``, and otherwise the classic format 'cdf5'. 'cdf2' is limited to 4 GiB a
            variable.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Raises
        ------
        OSError
            If a file cannot be written; then none of them is.
        ValueError
            If `graph` and `path` are one file, or `kind` is a classic format and the name ends in
            ``.nc4``.

        """
        if graph is not None and os.path.realpath(graph) == os.path.realpath(path):
            raise ValueError("graph is the file of path")
        self._write(path, "mpas", kind, threads, None if graph is None else as_name(graph))

    def to_ugrid(self, path: Path, *, kind: Kind | None = None, threads: int | None = None) -> None:
        """Writes a UGRID file, with the parameters of `to_mpas`."""
        self._write(path, "ugrid", kind, threads)

    def to_scrip(self, path: Path, *, kind: Kind | None = None, threads: int | None = None) -> None:
        """Writes a SCRIP grid file, with the parameters of `to_mpas`."""
        self._write(path, "scrip", kind, threads)

    def to_esmf(self, path: Path, *, kind: Kind | None = None, threads: int | None = None) -> None:
        """Writes an unstructured mesh file of ESMF, with the parameters of `to_mpas`."""
        self._write(path, "esmf", kind, threads)

    def to_exodus(
        self, path: Path, *, kind: Kind | None = None, threads: int | None = None
    ) -> None:
        """Writes an Exodus II file, with the parameters of `to_mpas`."""
        self._write(path, "exodus", kind, threads)

    def to_xarray(self) -> xarray.Dataset:
        """Converts the mesh to an xarray Dataset with the names, dimensions and numbers of MPAS.

        Returns
        -------
        xarray.Dataset
            The variables of an MPAS file, except for the weights and lists that follow from others.
            As in the file, numbers start at 1 and rows are filled with 0.

        """
        import xarray

        variables, attributes = self._arrays.mpas_content()
        return xarray.Dataset(variables, attrs=attributes)
