# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes for models of the atmosphere and the ocean."""

from __future__ import annotations

import warnings

import numpy as np

from . import _core
from ._arrays import as_floats, as_name, as_threads, frozen
from ._delaunay import SphericalDelaunay, delaunay
from ._geometries import Edges
from ._mesh_making import (
    Defects,
    Density,
    EqualArea,
    ScvtReport,
    Spacing,
    equal_area,
    scvt_points,
)
from ._mesh_parts import Lines
from ._triangle_mesh import (
    Boundary,
    TriangleMesh,
    TriangleQuality,
    leave_out_flat,
    read_triangles,
    triangles,
)
from ._types import ArrayLike, Path, Progress
from ._voronoi_mesh import CellQuality, Culled, EdgeWeights, Mesh

__all__ = [
    "Boundary",
    "CellQuality",
    "Culled",
    "Defects",
    "EdgeWeights",
    "EqualArea",
    "Mesh",
    "ScvtReport",
    "TriangleMesh",
    "TriangleQuality",
    "equal_area",
    "from_points",
    "leave_out_flat",
    "read",
    "read_triangles",
    "scvt",
    "triangles",
]


def __dir__() -> list[str]:
    return list(__all__)


def from_points(
    points: ArrayLike | SphericalDelaunay,
    *,
    radius: float = 1.0,
    density: ArrayLike | None = None,
    allow_zero_edges: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Mesh:
    """Makes the mesh of the Voronoi cells of points.

    Parameters
    ----------
    points : array_like, shape (n, 3), or SphericalDelaunay
        The sites of the cells, or their triangulation.
    radius : float, optional
        The radius of the sphere, in meters for most models; by default 1.
    density : array_like, shape (n,), optional
        The density for which the mesh was made, as MPAS defines it: (least spacing / spacing)^4; by
        default 1 everywhere.
    allow_zero_edges : bool, optional
        Whether to accept four sites on one circle, whose cells meet in one point; by default False,
        since models divide by the length of the edge there, which is 0.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    Mesh
        The mesh; cell i belongs to point i.

    Raises
    ------
    InvalidInput
        If sites are weighted, two are in one place, four are on one circle, or the hull of the
        sites does not surround the center of the sphere. Its `index` is the site.

    Examples
    --------
    >>> import numpy as np
    >>> import rondel.mesh
    >>> points = np.random.default_rng(1).normal(size=(100, 3))
    >>> rondel.mesh.from_points(points, radius=6371229.0)
    <Mesh: 100 cells, 294 edges, 196 vertices>

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
    """Reads the mesh of a netCDF file.

    Parameters
    ----------
    path : path_like
        A file of MPAS, whose arrays are used as they are; or of UGRID, SCRIP or ESMF, whose mesh is
        computed from the centers of its cells, which must be Voronoi cells, and at a border from
        their corners. netCDF-4 is read by the library that the package netCDF4 brings.
    radius : float, optional
        The radius of the sphere; by default 1. MPAS files contain the radius, which is used
        instead.
    allow_zero_edges : bool, optional
        Whether to accept edges of length 0, as in `from_points`; by default False.
    threads : int, optional
        The largest number of threads; by default one for each core.

    Returns
    -------
    Mesh
        The mesh, with the cells in the order of the file, without those that it masks.

    Raises
    ------
    OSError
        If the file cannot be read, its cells are not the Voronoi cells of its centers, or numbers
        of an MPAS file contradict its points.

    Warns
    -----
    UserWarning
        If cells are masked (with their number), one of several meshes was read, or lists of MPAS
        do not fit to the others and are made again.

    See Also
    --------
    Mesh.to_mpas, Mesh.to_ugrid, Mesh.to_scrip, Mesh.to_esmf, Mesh.to_exodus : write files.

    Examples
    --------
    >>> import os, tempfile
    >>> import rondel.mesh
    >>> mesh = rondel.mesh.scvt(42)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     name = os.path.join(folder, "mesh.nc")
    ...     mesh.to_mpas(name)
    ...     rondel.mesh.read(name)
    <Mesh: 42 cells, 120 edges, 80 vertices>

    """
    name = as_name(path)
    found, remarks = _core.read_mesh(
        name, float(radius), bool(allow_zero_edges), as_threads(threads)
    )
    for remark in remarks:
        warnings.warn(f"{name}: {remark}", UserWarning, stacklevel=2)
    return Mesh(found)


def scvt(
    n: int | None = None,
    *,
    spacing: Spacing | None = None,
    density: Density | None = None,
    gradient: float | None = None,
    fixed: ArrayLike | Lines | None = None,
    along: Lines | None = None,
    edges: Edges = "lonlat",
    radius: float = 1.0,
    tolerance: float = 1e-4,
    largest_tolerance: float = 1e-2,
    max_steps: int = 1000,
    raster_steps: int = 512,
    repair: bool = True,
    threads: int | None = None,
    progress: Progress = None,
) -> Mesh:
    """Makes a spherical centroidal Voronoi tessellation (SCVT).

    Sites are moved until each is the centroid of its cell.

    Parameters
    ----------
    n : int, optional
        The number of cells; by default it follows from the spacing.
    spacing : float or callable, optional
        The distance of neighboring sites in radians: a number, or a function that maps unit
        vectors, shape (m, 3), to m numbers and is called once. If `n` is given, only its ratios
        matter. By default it is the same everywhere.
    density : callable, optional
        The density, which may be given with `n` instead of the spacing: a function like that of the
        spacing, which is proportional to the density to the power -1/4. Only its ratios matter.
    gradient : float, optional
        The largest growth of the spacing per distance; by default it is not limited.
    fixed : array_like, shape (k, 3), path_like, or geometries, optional
        Places that become sites and never move; they count among the `n`. Points of an array, of a
        table or of features are taken as they are; on lines and outlines of polygons, of a GeoJSON
        file or of geometries, places are taken at the distance of the spacing.
    along : path_like, geometries, or sequence of array_like, shape (m, 3), optional
        Lines that edges of cells follow: a GeoJSON file; geometries as `rondel.feature_cells` takes
        them; or the points of each line, joined by great circles, the last of which is the first if
        the line is closed. Two rows of sites beside each line never move. Sides along which a file
        cuts polygons at the antimeridian are ignored.
    edges : {'lonlat', 'geodesic'}, optional
        What joins positions of a file or of geometries: straight lines in longitude and latitude as
        in RFC 7946 (default), or great circles.
    radius : float, optional
        The radius of the sphere, in meters for most models; by default 1.
    tolerance, largest_tolerance : float, optional
        The mean and the largest distance of sites from the centroids of their cells, in units of
        the spacing, at which the work ends; by default 1e-4 and 1e-2.
    max_steps : int, optional
        The largest number of steps in each level; by default 1000.
    raster_steps : int, optional
        The function of the spacing is sampled at this many places along a quarter of a great
        circle, a power of two up to 4096; by default 512.
    repair : bool, optional
        Whether to move sites by some hundredths of the spacing where edges are short, triangles are
        obtuse, or cells have other than 5, 6 or 7 sides; by default True.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)`` with the name of the stage and an estimate of the
        fraction of all work that is done. An exception that it raises ends the work.

    Returns
    -------
    Mesh
        The mesh. Its `report` says how the work ended, its `fixed` which cells are fixed.

    Raises
    ------
    InvalidInput
        If a fixed place is not finite or two are the same, or spacings are not positive or put all
        sites into a part of the sphere.
    TypeError
        If neither `n` nor `spacing` is given, or `density` without `n`.
    ValueError
        If a tolerance is not positive and finite, or `max_steps` is negative.
    OSError
        If a file cannot be read.

    Warns
    -----
    UserWarning
        If the work ended before the tolerances were met.

    Notes
    -----
    The energy of Du, Gunzburger and Ju, "Constrained centroidal Voronoi tessellations for
    surfaces", SIAM J. Sci. Comput. 24, 2003, is minimized by L-BFGS, from few sites to many. See
    docs/guide/mesh-making.md.

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
        edges,
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
