# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes that models of atmosphere and ocean run on."""

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
    Partition,
    ScvtReport,
    Spacing,
    partition,
    scvt_points,
)
from ._mesh_parts import Lines
from ._types import ArrayLike, Path, Progress
from ._voronoi_mesh import Culled, EdgeWeights, Mesh

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
    """A mesh of a netCDF file of any format; netCDF-4 by the library that netCDF4 brings.

    Parameters
    ----------
    path : path_like
        A file of MPAS, whose arrays are taken as they are; or of UGRID, SCRIP or ESMF, whose mesh
        is made again of the centers of its cells, which must be their Voronoi cells, and at a
        border of their corners.
    radius : float, optional
        Of the sphere; that of MPAS's files is in them.
    allow_zero_edges : bool, optional
        As in `from_points`.
    threads : int, optional
        At most so many threads; by default one for each core.

    Returns
    -------
    Mesh

    Raises
    ------
    OSError
        If the file cannot be read, or its cells are not those of its centers.

    Warns
    -----
    UserWarning
        For what the file has and the mesh has not: how many cells are masked, which of several
        meshes was read.

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
    fixed : array_like, shape (k, 3), path_like, or geometries, optional
        Places that are sites, and never move; they count among the `n`. Of a file of GeoJSON or of
        geometries the points, and on lines and outlines of polygons places the spacing apart; of a
        table the points.
    along : path_like, geometries, or sequence of array_like, shape (m, 3), optional
        Lines that edges of cells follow: a GeoJSON file; geometries as `rondel.feature_cells` takes
        them; or the points of each line, joined by great circles, of which the last is the first if
        it is closed. Two rows of sites beside each never move. The sides along which a file has cut
        polygons at the antimeridian are no lines.
    edges : {'lonlat', 'geodesic'}, optional
        What joins positions of a file or of geometries: straight lines in longitude and latitude
        (RFC 7946), or great circles.
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
        Called with the name of the stage and an estimate of the part of the work that is done, in
        the end 1.

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
