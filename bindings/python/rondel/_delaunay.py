# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Delaunay and regular triangulations."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from . import _core
from ._arrays import (
    as_center,
    as_kept,
    as_lonlat,
    as_point,
    as_radius,
    as_threads,
    degrees_of,
    frozen,
    is_weighted,
)
from ._contours import Contours
from ._diagram import Diagram
from ._geo import TriangleShapes
from ._globe import Globes
from ._graphs import Graphs
from ._mesh import Mesh
from ._plot import TrianglePictures
from ._queries import FaceLocations, Queries
from ._tables import TriangleTables
from ._types import ArrayLike, FloatArray, IntArray, Model, Progress
from ._winds import VectorInterpolation
from ._zarr import ZarrGroups


class CheckReport(NamedTuple):
    """The verdict of an independent check. Its truth value is `is_valid`.

    Attributes
    ----------
    is_valid : bool
        Whether the faces are the triangulation of the points.
    reason : str
        What is wrong, in one line; empty if nothing is.
    num_vertices, num_edges, num_duplicates, num_hidden : int
        The numbers of vertices, edges, duplicates and hidden sites that the check has found.

    """

    is_valid: bool
    reason: str
    num_vertices: int
    num_edges: int
    num_duplicates: int
    num_hidden: int

    def __bool__(self) -> bool:
        return self.is_valid


class SphericalDelaunay(
    Mesh,  # faces and who is next to whom
    FaceLocations,  # locate, find_simplex
    Queries,  # nearest, k_nearest, within, distance
    VectorInterpolation,  # weights, interpolate, gradient, interpolate_vectors, interpolate_winds
    Graphs,  # graph, edge_index, hull_polygon, alpha_shape, largest_empty_circles
    Contours,  # isolines, bands
    TriangleShapes,  # to_geojson, to_geopandas, to_xarray
    TriangleTables,  # to_netcdf, to_parquet
    ZarrGroups,  # to_zarr
    TrianglePictures,  # lonlat_triangles, plot
    Globes,  # save_html, view
):
    """The Delaunay or regular triangulation of points on or close to a sphere.

    It is exact for every finite input and unique: it depends only on the set of points, not on
    their order, the number of threads or the machine. Degenerate input (duplicates, points on one
    circle, in one hemisphere, or a millimeter apart) is handled like any other.

    Parameters
    ----------
    points, model, radius, center, threads, progress, copy
        As in `delaunay`, which also says what is raised.

    Notes
    -----
    The algorithm is incremental insertion with exact predicates, after Caroli et al. [1]_, section
    4; large inputs are divided into certified blocks. Ties (cocircular points) are broken by a
    symbolic perturbation.

    References
    ----------
    .. [1] M. Caroli, P. M. M. de Castro, S. Loriot, O. Rouiller, M. Teillaud, C. Wormser, "Robust
       and Efficient Delaunay Triangulations of Points on Or Close to a Sphere", SEA 2010.

    Examples
    --------
    >>> import rondel
    >>> tri = rondel.delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
    >>> tri
    <rondel.SphericalDelaunay: 4 points, 4 faces, projected>
    >>> sorted(tri.simplices[tri.find_simplex([3, 2, 2])].tolist())
    [0, 1, 2]

    """

    def __init__(
        self,
        points: ArrayLike,
        model: Model = "projected",
        *,
        radius: float = 1.0,
        center: ArrayLike | None = None,
        threads: int | None = None,
        progress: Progress = None,
        copy: bool = True,
    ) -> None:
        points = as_kept(points, copy=copy)
        radius = as_radius(radius)
        built = _core.delaunay(
            points,
            is_weighted(model),
            as_center(center),
            radius * radius,
            as_threads(threads),
            progress,
        )
        self._keep(points, built, radius)

    def _keep(
        self,
        points: FloatArray,
        triangulation: _core.Triangulation,
        radius: float,
        degrees: FloatArray | None = None,
    ) -> None:
        Mesh.__init__(self, points, triangulation)
        self._radius = radius
        self._degrees = None if degrees is None else frozen(degrees)

    @classmethod
    def _from_parts(
        cls,
        points: FloatArray,
        triangulation: _core.Triangulation,
        radius: float,
        degrees: FloatArray | None = None,
    ) -> SphericalDelaunay:
        self = cls.__new__(cls)
        self._keep(points, triangulation, radius, degrees)
        return self

    def __getstate__(self) -> dict[str, Any]:
        return {**super().__getstate__(), "radius": self._radius, "degrees": self._degrees}

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(state)
        self._radius = state["radius"]
        degrees = state["degrees"]
        self._degrees = None if degrees is None else frozen(degrees)

    @property
    def model(self) -> Model:
        """str: 'projected' or 'weighted'."""
        return "weighted" if self._triangulation.is_weighted else "projected"

    @property
    def radius(self) -> float:
        """float: the radius of the sphere."""
        return self._radius

    @property
    def center(self) -> FloatArray:
        """Ndarray of float64, shape (3,): the center of the sphere."""
        return np.array(self._triangulation.center)

    @property
    def report(self) -> dict[str, Any]:
        """dict: the builder (ring, incremental, sphere or blocks; given, if nobody built it), the
        threads used, seconds of the stages, and how many predicates each rung of the
        ladder of precisions decided.
        """
        return self._triangulation.report

    @cached_property
    def lonlat(self) -> FloatArray:
        """Ndarray of float64, shape (n, 2): longitudes and latitudes of the points in degrees, as
        given to `delaunay_lonlat`, or of the rays through the points; NaN for the center.
        """
        if self._degrees is not None:
            return self._degrees
        return frozen(degrees_of(self.points, self._triangulation.center))

    @cached_property
    def circumcenters(self) -> FloatArray:
        """Ndarray of float64, shape (m, 3): the outward unit normals of the faces, which are the
        centers of their circles (model 'weighted': their power centers), seen from the center of
        the sphere. Within 4 ulp, whatever the shape of the face.
        """
        return frozen(_core.circumcenters(self._triangulation))

    @cached_property
    def _lazy_locator(self) -> _core.Locator:
        return _core.Locator(self._triangulation)

    def _locator(self) -> _core.Locator:
        return self._lazy_locator

    @cached_property
    def _lazy_interpolator(self) -> _core.Interpolator:
        return _core.Interpolator(self._triangulation)

    def _interpolator(self) -> _core.Interpolator:
        return self._lazy_interpolator

    def conflict_region(self, point: ArrayLike) -> IntArray:
        """Finds the faces that inserting a point would remove.

        Parameters
        ----------
        point : array_like, shape (3,)
            The point; for model 'projected' only its direction is used.

        Returns
        -------
        ndarray of int32, shape (k,)
            Rows of `simplices` whose circles contain the point, in increasing order.

        Raises
        ------
        InvalidInput
            If the point is not finite or is the center.

        """
        return self._locator().conflict_region(as_point(point))

    def voronoi(self) -> Diagram[SphericalDelaunay]:
        """Returns the Voronoi or power diagram, which is the dual of this triangulation.

        Returns
        -------
        SphericalVoronoi or PowerDiagram
            A diagram that shares this triangulation. The first of duplicates has the cell; the
            cells of the others are empty.

        """
        return Diagram._of(self)

    def validate(self, *, threads: int | None = None) -> CheckReport:
        """Proves or refutes, by another algorithm, that this is the triangulation of the points.

        Parameters
        ----------
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        CheckReport
            It is true if the triangulation is right; otherwise `reason` says in one line what is
            wrong.

        """
        t = self._triangulation
        found = _core.check(
            self._points, t.faces, t.is_weighted, t.center, t.squared_radius, as_threads(threads)
        )
        return CheckReport(*(getattr(found, name) for name in CheckReport._fields))

    def _facts(self) -> list[tuple[str, str]]:
        return [*super()._facts(), ("model", self.model)]


def delaunay(
    points: ArrayLike,
    model: Model = "projected",
    *,
    radius: float = 1.0,
    center: ArrayLike | None = None,
    threads: int | None = None,
    progress: Progress = None,
    copy: bool = True,
) -> SphericalDelaunay:
    """Computes the Delaunay or regular triangulation of points on or close to a sphere.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Coordinates x, y, z of the sites, in any unit. They need not lie on the sphere exactly.
    model : {'projected', 'weighted'}, optional
        What a point represents. 'projected' (default): its exact projection on the sphere, which
        gives the Delaunay triangulation, where every distinct direction is a vertex. 'weighted':
        the circle whose pole it is, which gives the regular triangulation, the convex hull; points
        inside it are `hidden` and have no cell.
    radius : float, optional
        The radius of the sphere, in the unit of the points; by default 1. It changes the results
        of weighted sites only.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.
    copy : bool, optional
        Whether to copy the points; by default True. With False a C-contiguous array of float64,
        which may be mapped from a file, is used in place. It must not be changed as long as the
        result lives: answers would be wrong, and calls might not end.

    Returns
    -------
    SphericalDelaunay
        The triangulation; `simplices` are its faces.

    Raises
    ------
    InvalidInput
        If a coordinate is not finite, a projected point is the center, or there are more than
        715,827,882 points. It is a `ValueError` whose `index` is the first bad point.
    KeyboardInterrupt
        If the user presses Ctrl-C, within a short time.

    See Also
    --------
    delaunay_lonlat : the same for longitudes and latitudes in degrees.
    power_diagram : the same for circles.

    Notes
    -----
    See `SphericalDelaunay` for the algorithm.

    Examples
    --------
    >>> import rondel
    >>> octahedron = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]]
    >>> tri = rondel.delaunay(octahedron)
    >>> tri
    <rondel.SphericalDelaunay: 6 points, 8 faces, projected>
    >>> tri.simplices.shape, tri.edges.shape
    ((8, 3), (12, 2))

    """
    return SphericalDelaunay(
        points,
        model,
        radius=radius,
        center=center,
        threads=threads,
        progress=progress,
        copy=copy,
    )


def delaunay_lonlat(
    lon: ArrayLike, lat: ArrayLike, *, threads: int | None = None, progress: Progress = None
) -> SphericalDelaunay:
    """Computes the Delaunay triangulation of longitudes and latitudes in degrees.

    Parameters
    ----------
    lon, lat : array_like, shape (n,)
        Longitudes and latitudes of the sites in degrees. Longitudes may be any finite numbers,
        latitudes are from -90 to 90. Arrays of more dimensions are flattened.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    SphericalDelaunay
        The triangulation on the unit sphere. Its `points` are unit vectors, its `lonlat` the
        degrees as given.

    Raises
    ------
    InvalidInput
        If an angle is not finite or a latitude is outside [-90, 90]; its `index` is the first bad
        site.

    Notes
    -----
    Unit vectors have the same bits on every machine, and multiples of 90 degrees are exact. All
    sites at a pole are in one place, whatever their longitudes.

    Examples
    --------
    >>> import rondel
    >>> tri = rondel.delaunay_lonlat([2.35, -74.01, 139.69, 151.21], [48.86, 40.71, 35.69, -33.87])
    >>> int(tri.nearest(rondel.unit_vectors(-0.13, 51.51)))  # London is closest to Paris
    0

    """
    degrees = as_lonlat(lon, lat)
    points = _core.unit_vectors(degrees)
    built = _core.delaunay(points, False, (0.0, 0.0, 0.0), 1.0, as_threads(threads), progress)
    return SphericalDelaunay._from_parts(points, built, 1.0, degrees)
