# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Voronoi and power diagrams."""

from __future__ import annotations

import gc
import itertools
from functools import cached_property
from typing import Any, Literal, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from . import _core, _geo, _plot
from ._arrays import ORIGIN, as_center, as_floats, as_lonlat, as_points, as_threads
from ._delaunay import SphericalDelaunay, delaunay_lonlat
from ._dimensions import FlatMesh, circle_diagram, general_diagram
from ._errors import InvalidInput
from ._repr import Described
from ._types import ArrayLike, FloatArray, IntArray, Progress

WhatIfDuplicates = Literal["raise", "merge"]
Kind = TypeVar("Kind", bound="Diagram")


class Cells(NamedTuple):
    """Cells in compressed rows: the ring of site i is ``rings[offsets[i]:offsets[i + 1]]``,
    positions in `points`, counterclockwise seen from outside. Its points are joined by the shorter
    arcs of great circles, none longer than 120 degrees.
    """

    offsets: npt.NDArray[np.int64]
    rings: IntArray
    points: FloatArray


class Diagram(Described):
    """The dual of a triangulation; found when it is first asked for."""

    def _keep(self, delaunay: Any) -> None:
        self._delaunay = delaunay

    def __getstate__(self) -> dict[str, Any]:
        state = self.__dict__.copy()
        if isinstance(self._delaunay, FlatMesh):
            return state
        for name in ("_diagram", "cells", "areas", "centroids", "vertices", "regions"):
            state.pop(name, None)
        return state

    @classmethod
    def _from_delaunay(cls: type[Kind], delaunay: SphericalDelaunay) -> Kind:
        self = cls.__new__(cls)
        self._keep(delaunay)
        return self

    @cached_property
    def _diagram(self) -> _core.Diagram:
        return _core.diagram(self._delaunay._triangulation, self._delaunay.points, None)

    def _on_sphere(self, directions: FloatArray) -> FloatArray:
        radius, center = self._delaunay.radius, self._delaunay._triangulation.center
        if radius == 1 and center == ORIGIN:
            return directions
        return radius * directions + np.array(center)

    @property
    def delaunay(self) -> SphericalDelaunay:
        """SphericalDelaunay: the triangulation, the dual of this diagram."""
        return self._delaunay

    @property
    def points(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the sites, not copied. Do not change them."""
        return self._delaunay.points

    @property
    def radius(self) -> float:
        """float: the radius of the sphere."""
        return self._delaunay.radius

    @property
    def center(self) -> FloatArray:
        """Ndarray of float64, shape (3,): the center of the sphere."""
        return self._delaunay.center

    @property
    def duplicates(self) -> IntArray:
        """Ndarray of int32, shape (d, 2): rows of a site and the one in the same place that stands
        for it. Duplicates have empty cells.
        """
        return self._delaunay.duplicates

    @property
    def _simplices(self) -> IntArray:
        return self._delaunay.simplices

    @cached_property
    def cells(self) -> Cells:
        """Cells: every cell, whatever the sites are. Hemispheres and lunes have as many points on
        their boundary as make its arcs short; a single site's cell, the whole sphere, none.
        """
        d = self._diagram
        return Cells(d.offsets, d.rings, self._on_sphere(d.points))

    @cached_property
    def vertices(self) -> FloatArray:
        """Ndarray of float64, shape (m, 3): the corners of the cells; vertex k is the center of the
        circle of face k. Below dimension 2, all points of `cells`.
        """
        points = self.cells.points
        faces = len(self._simplices)
        return points[:faces] if faces else points

    @cached_property
    def regions(self) -> list[list[int]]:
        """List of lists of int: the corners of each site's cell, positions in `vertices`,
        counterclockwise seen from outside. Empty for duplicates and hidden sites.
        """
        offsets, rings, _ = self.cells
        corners = rings < len(self.vertices)
        if not corners.all():
            offsets = np.concatenate([[0], np.cumsum(corners)])[offsets]
            rings = rings[corners]
        return _split(rings, offsets)

    @cached_property
    def areas(self) -> FloatArray:
        """Ndarray of float64, shape (n,): the areas of the cells, in units of the radius squared;
        0 for duplicates and hidden sites. Accurate for tiny cells too; the sum is
        4 pi radius**2.
        """
        areas = self._diagram.areas
        return areas if self.radius == 1 else areas * self.radius**2

    @cached_property
    def centroids(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the cells' centers of mass, moved out to the sphere;
        nan where a cell is empty or its center of mass is that of the sphere.
        """
        directions = _core.centroids(
            self._delaunay._triangulation, self._delaunay.points, self._diagram
        )
        none = ~directions.any(axis=1)
        if none.any():
            directions[none] = np.nan
        return self._on_sphere(directions)

    def _facts(self) -> list[tuple[str, str]]:
        return self._delaunay._facts()

    to_geojson = _geo.cells_to_geojson
    to_geopandas = _geo.to_geopandas
    to_xarray = _geo.cells_to_xarray
    plot = _plot.plot_cells


class SphericalVoronoi(Diagram):
    """The Voronoi diagram of points on a sphere; in place of `scipy.spatial.SphericalVoronoi`.

    Attributes, methods and errors are SciPy's; what is different is listed in the notes.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        A C-contiguous array of float64 is not copied, and must not be changed as long as the
        object lives. Shape (n, 2): points on a circle. More columns are handed to SciPy.
    radius : float, optional
        Of the sphere.
    center : array_like, shape (3,), optional
        Of the sphere; by default the origin.
    threshold : float, optional
        The largest distance of a point from the sphere, in radii; ``numpy.inf`` for any.
    duplicates : {'raise', 'merge'}, optional
        What to do with points in the same place (exactly: on the same ray). 'merge' gives the cell
        to the first of them, and the others empty ones.
    threads : int, optional
        At most so many threads; by default one for each core. The result is the same.
    progress : callable, optional
        Called as ``progress(stage, fraction)`` some times a second. What it raises ends the work.

    Attributes
    ----------
    points, radius, center, vertices, regions
        As in SciPy. The arrays are read-only.
    cells, areas, centroids, duplicates, delaunay
        Not in SciPy: cells in compressed rows, their areas and centers, and the triangulation.

    Raises
    ------
    InvalidInput
        A `ValueError` with the `index` of a bad point: not finite, a duplicate, or at the center.
    ValueError
        If points are farther than `threshold` from the sphere.

    Notes
    -----
    Different from SciPy, on purpose:

    1. `vertices` are numbered by the canonical order of the faces, not by Qhull's.
    2. Every set of sites has a diagram: one, two, all on a great circle. SciPy demands rank 3.
    3. Only points in the same place are duplicates. SciPy raises for points within `threshold`.
    4. `regions` are always sorted, and `sort_vertices_of_regions` has nothing to do.
    5. Of points on a circle, `calculate_areas` gives the arc of each site, where SciPy gives those
       between two sites.

    References
    ----------
    Caroli et al., SEA 2010; areas of cells: Van Oosterom and Strackee, IEEE Transactions on
    Biomedical Engineering 2, 1983.

    Examples
    --------
    >>> import math, rondel
    >>> sv = rondel.SphericalVoronoi([[0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0],
    ...                               [0, -1, 0]])
    >>> sv.vertices.shape
    (8, 3)
    >>> len(sv.regions[0])
    4
    >>> math.isclose(sv.calculate_areas()[0], 4 * math.pi / 6)
    True

    """

    def __init__(
        self,
        points: ArrayLike,
        radius: float = 1,
        center: ArrayLike | None = None,
        threshold: float = 1e-06,
        *,
        duplicates: WhatIfDuplicates = "raise",
        threads: int | None = None,
        progress: Progress = None,
    ) -> None:
        if radius is None:
            raise ValueError(
                "`radius` is `None`. Please provide a floating point number (i.e. `radius=1`)."
            )
        if duplicates not in ("raise", "merge"):
            raise ValueError(f"duplicates must be 'raise' or 'merge', not {duplicates!r}")
        points = as_floats(points, "points")
        if points.ndim == 2 and points.shape[1] != 3:
            self._be_flat(points, float(radius), center, threshold, duplicates, threads)
            return
        built = SphericalDelaunay(
            points, radius=radius, center=center, threads=threads, progress=progress
        )
        off = _core.largest_discrepancy(built.points, as_center(center), built.radius)
        _check_radius(off, threshold * built.radius)
        _check_duplicates(built.duplicates, duplicates)
        self._keep(built)

    def _be_flat(
        self,
        points: FloatArray,
        radius: float,
        center: ArrayLike | None,
        threshold: float,
        duplicates: WhatIfDuplicates,
        threads: int | None,
    ) -> None:
        if points.shape[1] < 2:
            raise ValueError(f"points must have shape (n, 3), not {points.shape}")
        dimensions = points.shape[1]
        center = np.zeros(dimensions) if center is None else as_floats(center, "center")
        if dimensions > 2:
            mesh, attributes = general_diagram(points, radius, center, threshold)
        else:
            mesh, attributes = circle_diagram(points, radius, center, threads)
            off = np.abs(np.linalg.norm(points - center, axis=1) - radius).max()
            _check_radius(off, threshold * radius)
            _check_duplicates(mesh.duplicates, duplicates)
        self._keep(mesh)
        self.__dict__.update(attributes)

    @classmethod
    def from_lonlat(
        cls,
        lon: ArrayLike,
        lat: ArrayLike,
        *,
        duplicates: WhatIfDuplicates = "merge",
        threads: int | None = None,
        progress: Progress = None,
    ) -> SphericalVoronoi:
        """The diagram of longitudes and latitudes in degrees, on the unit sphere.

        Parameters
        ----------
        lon, lat : array_like, shape (n,)
        duplicates : {'merge', 'raise'}, optional
        threads : int, optional
        progress : callable, optional

        Returns
        -------
        SphericalVoronoi

        """
        built = delaunay_lonlat(lon, lat, threads=threads, progress=progress)
        _check_duplicates(built.duplicates, duplicates)
        return cls._from_delaunay(built)

    def sort_vertices_of_regions(self) -> None:
        """Sorts the vertices of each region around its site. They are sorted from the start.

        Raises
        ------
        TypeError
            If the points are not three-dimensional.

        """
        if self.points.shape[1] != 3:
            raise TypeError("Only supported for three-dimensional point sets")

    def calculate_areas(self) -> FloatArray:
        """The areas of the cells.

        Returns
        -------
        ndarray of float64, shape (n,)
            In units of the radius squared; see `areas`. A new array.

        """
        return self.areas.copy()


def _split(items: IntArray, offsets: npt.NDArray[np.int64]) -> list[list[int]]:
    """The rows as lists of Python's integers. The collector of garbage would look at all of them
    again and again while there are more and more, which takes most of the time.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        row = items.tolist()
        return [row[a:b] for a, b in itertools.pairwise(offsets.tolist())]
    finally:
        if was_enabled:
            gc.enable()


def _check_radius(off: float, threshold: float) -> None:
    if not off < threshold:
        raise ValueError(
            f"Radius inconsistent with generators: a point is {off:.3g} off the sphere, the "
            f"threshold is {threshold:.3g}"
        )


def _check_duplicates(duplicates: IntArray, what: WhatIfDuplicates) -> None:
    if what == "merge" or len(duplicates) == 0:
        return
    site, first = (int(i) for i in duplicates[0])
    raise InvalidInput(
        f"Duplicate generators present: point {site} is in the same place as point {first}; "
        "duplicates='merge' merges them",
        site,
    )


class PowerDiagram(Diagram):
    """The power (Laguerre) diagram of circles on a sphere; made by `power_diagram`.

    A point of the sphere belongs to the circle of the smallest Laguerre distance
    arccos(cos(angle) / cos(radius)). Circles without a cell are `hidden`.
    """

    @property
    def hidden(self) -> IntArray:
        """Ndarray of int32, shape (h, 2): rows of a circle without a cell and a face of `delaunay`
        below which it lies.
        """
        return self._delaunay.hidden


def power_diagram(
    centers: ArrayLike,
    radii_deg: ArrayLike,
    *,
    threads: int | None = None,
    progress: Progress = None,
) -> PowerDiagram:
    """The power (Laguerre) diagram of circles on the unit sphere.

    Parameters
    ----------
    centers : array_like, shape (n, 3) or (n, 2)
        Unit vectors, or longitudes and latitudes in degrees.
    radii_deg : array_like, shape (n,) or float
        Angular radii in degrees, from 0 to less than 90.
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    PowerDiagram

    Raises
    ------
    InvalidInput
        If a radius is not in [0, 90), a center is not finite, or a latitude is outside [-90, 90].

    Notes
    -----
    A circle is the weighted site q / cos r, the pole of its plane (Sugihara, "Laguerre Voronoi
    diagram on the sphere", Journal for Geometry and Graphics 6, 2002).

    Examples
    --------
    >>> import rondel
    >>> lonlat = [[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90], [5, 0]]
    >>> diagram = rondel.power_diagram(lonlat, [30, 0, 0, 0, 0, 0, 0])
    >>> diagram
    <rondel.PowerDiagram: 7 points, 1 hidden, 8 faces, weighted>
    >>> diagram.hidden[:, 0]
    array([6], dtype=int32)

    """
    centers = as_floats(centers, "centers")
    radii = as_floats(radii_deg, "radii_deg")
    if radii.ndim == 0:
        radii = np.full(len(centers), float(radii))
    degrees = None
    if centers.ndim == 2 and centers.shape[1] == 2:
        degrees = as_lonlat(centers[:, 0], centers[:, 1])
        points = _core.polar_points_lonlat(degrees, radii)
    else:
        points = _core.polar_points(as_points(centers, "centers"), radii)
    built = _core.delaunay(points, True, ORIGIN, 1.0, as_threads(threads), progress)
    return PowerDiagram._from_delaunay(SphericalDelaunay._from_parts(points, built, 1.0, degrees))
