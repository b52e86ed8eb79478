# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes that models of atmosphere and ocean run on."""

from __future__ import annotations

import json
import pathlib
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import as_floats, as_name, as_threads, frozen
from ._delaunay import SphericalDelaunay, delaunay
from ._geometries import Edges
from ._mesh_making import (
    Defects,
    Density,
    Partition,
    ScvtReport,
    Spacing,
    partition,
    scvt_points,
)
from ._mesh_parts import Lines, plot_mesh, removed_cells
from ._types import ArrayLike, FloatArray, IntArray, Path, Progress

if TYPE_CHECKING:
    import xarray

__all__ = [
    "Culled",
    "Defects",
    "EdgeWeights",
    "Mesh",
    "Partition",
    "ScvtReport",
    "from_points",
    "partition",
    "read",
    "scvt",
]

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
            The file.
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
        import xarray

        counts = np.diff(self.offsets)
        width = int(counts.max())
        column = np.arange(len(self.edges_on_cell)) - np.repeat(self.offsets[:-1], counts)
        row = np.repeat(np.arange(len(counts)), counts)

        def padded(entries: IntArray) -> IntArray:
            out = np.zeros((len(counts), width), np.int32)
            out[row, column] = entries + 1
            return out

        data: dict[str, Any] = {
            "nEdgesOnCell": ("nCells", counts.astype(np.int32)),
            "areaCell": ("nCells", self.cell_areas),
            "meshDensity": ("nCells", self.density),
            "dcEdge": ("nEdges", self.cell_distances),
            "dvEdge": ("nEdges", self.vertex_distances),
            "angleEdge": ("nEdges", self.normal_angles),
            "areaTriangle": ("nVertices", self.triangle_areas),
            "kiteAreasOnVertex": (("nVertices", "vertexDegree"), self.kite_areas),
        }
        for name, entries in (
            ("edgesOnCell", self.edges_on_cell),
            ("cellsOnCell", self.cells_on_cell),
            ("verticesOnCell", self.vertices_on_cell),
        ):
            data[name] = (("nCells", "maxEdges"), padded(entries))
        for name, dimensions, rows in (
            ("cellsOnEdge", ("nEdges", "TWO"), self.cells_on_edge),
            ("verticesOnEdge", ("nEdges", "TWO"), self.vertices_on_edge),
            ("cellsOnVertex", ("nVertices", "vertexDegree"), self.cells_on_vertex),
            ("edgesOnVertex", ("nVertices", "vertexDegree"), self.edges_on_vertex),
        ):
            data[name] = (dimensions, rows + 1)
        for what, dimension, points in (
            ("Cell", "nCells", self.points),
            ("Edge", "nEdges", self.edge_points),
            ("Vertex", "nVertices", self.vertex_points),
        ):
            x, y, z = points.T
            lon = np.arctan2(y, x) % (2 * np.pi)
            lon[lon >= 2 * np.pi] = 0
            for axis, values in (("x", x), ("y", y), ("z", z), ("lon", lon)):
                data[axis + what] = (dimension, values)
            data["lat" + what] = (dimension, np.arctan2(z, np.hypot(x, y)))
        attributes = {
            "on_a_sphere": "YES",
            "sphere_radius": self.radius,
            "is_periodic": "NO",
            "Conventions": "MPAS",
            "mesh_spec": "1.0",
        }
        return xarray.Dataset(data, attrs=attributes)


def from_points(
    points: ArrayLike | SphericalDelaunay,
    *,
    radius: float = 1.0,
    density: ArrayLike | None = None,
    allow_zero_edges: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Mesh:
    """The mesh of the Voronoi cells of points.

    Parameters
    ----------
    points : array_like, shape (n, 3), or SphericalDelaunay
        The sites of the cells, or their triangulation.
    radius : float, optional
        Of the sphere, in metres for most models.
    density : array_like, shape (n,), optional
        What the mesh was made for, as MPAS has it: (least spacing / spacing)^4.
    allow_zero_edges : bool, optional
        Whether four sites on one circle, whose cells meet in one point, are accepted: models
        divide by the length of the edge there, which is 0.
    threads : int, optional
        At most so many threads; by default one for each core.
    progress : callable, optional
        Called with the name of the stage and the fraction done.

    Returns
    -------
    Mesh

    Raises
    ------
    InvalidInput
        For weighted sites, two in one place, four on one circle, or sites whose hull does not
        surround the center of the sphere.

    """
    if not isinstance(points, SphericalDelaunay):
        points = delaunay(points, threads=threads, progress=progress)
    values = np.empty(0) if density is None else as_floats(density, "density")
    if values.ndim != 1:
        raise ValueError(f"density has the shape {values.shape}, not (n,)")
    return Mesh(
        _core.mesh_of(
            points._triangulation,
            float(radius),
            np.ascontiguousarray(values),
            bool(allow_zero_edges),
            as_threads(threads),
            progress,
        )
    )


def read(
    path: Path,
    *,
    radius: float = 1.0,
    allow_zero_edges: bool = False,
    threads: int | None = None,
) -> Mesh:
    """A mesh of a netCDF file in one of the classic formats.

    Parameters
    ----------
    path : path_like
        A file of MPAS, whose arrays are taken as they are; or of UGRID, SCRIP or ESMF, whose mesh
        is made again of the centers of its cells, which must be their Voronoi cells.
    radius : float, optional
        Of the sphere; that of MPAS's files is in them.
    allow_zero_edges : bool, optional
        As in `from_points`.
    threads : int, optional
        At most so many threads; by default one for each core.

    Returns
    -------
    Mesh

    """
    return Mesh(
        _core.read_mesh(as_name(path), float(radius), bool(allow_zero_edges), as_threads(threads))
    )


def scvt(
    n: int | None = None,
    *,
    spacing: Spacing | None = None,
    density: Density | None = None,
    gradient: float | None = None,
    fixed: ArrayLike | None = None,
    along: Lines | None = None,
    radius: float = 1.0,
    tolerance: float = 1e-4,
    largest_tolerance: float = 1e-2,
    max_steps: int = 1000,
    raster_steps: int = 512,
    repair: bool = True,
    threads: int | None = None,
    progress: Progress = None,
) -> Mesh:
    """A centroidal Voronoi mesh: sites are moved until each is the centroid of its cell.

    Parameters
    ----------
    n : int, optional
        The number of cells; by default what the spacing asks for.
    spacing : float or callable, optional
        The distance of neighbors in radians: a number, or a function of unit vectors, shape
        (m, 3), that returns m numbers, which is called once. With `n` only proportions count.
    density : callable, optional
        Instead of the spacing, which is its power -1/4: a function as that of the spacing, of which
        only proportions count.
    gradient : float, optional
        How much the spacing grows over its own distance, at most.
    fixed : array_like, shape (k, 3), optional
        Places that are sites, and never move; they count among the `n`.
    along : path_like, or sequence of array_like, shape (m, 3), optional
        Lines that edges of cells follow: a GeoJSON file, or the points of each line, of which the
        last is the first if it is closed. Two rows of sites beside each never move.
    radius : float, optional
        Of the sphere, in metres for most models.
    tolerance, largest_tolerance : float, optional
        The mean and the largest distance of sites from the centroids of their cells, over the
        spacing, at which the work ends.
    max_steps : int, optional
        In each level.
    raster_steps : int, optional
        The function is asked for at so many places along a quarter of a great circle, a power of
        two up to 4096.
    repair : bool, optional
        Move sites by some hundredths of the spacing where edges are short, triangles obtuse, or
        cells have other than 5, 6 or 7 sides.
    threads : int, optional
        At most so many threads; by default one for each core. The result does not depend on it.
    progress : callable, optional
        Called with the name of the stage and the fraction of `max_steps`.

    Returns
    -------
    Mesh

    Examples
    --------
    >>> import rondel.mesh
    >>> mesh = rondel.mesh.scvt(642)
    >>> mesh
    <Mesh: 642 cells, 1920 edges, 1280 vertices>
    >>> mesh.report.end, mesh.quality["num_obtuse"]
    ('converged', 0)

    """
    points, densities, sites, report = scvt_points(
        n,
        spacing,
        density,
        fixed,
        along,
        gradient,
        tolerance,
        largest_tolerance,
        max_steps,
        raster_steps,
        repair,
        threads,
        progress,
    )
    mesh = from_points(
        points, radius=radius, density=densities if len(densities) else None, threads=threads
    )
    mesh.report = report
    mesh.fixed = frozen(sites)
    return mesh
