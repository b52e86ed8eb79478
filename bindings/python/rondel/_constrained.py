# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations with given edges."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any, Literal, TypeAlias

import numpy as np

from . import _core
from ._arrays import as_center, as_kept, as_points, as_threads, degrees_of, frozen, in_words
from ._cell_set import CellSet
from ._delaunay import CheckReport
from ._errors import CrossingConstraints, InvalidInput
from ._geo import TriangleShapes
from ._geometries import Edges, Invalid
from ._linear import LinearInterpolation
from ._mesh import Lists, Mesh
from ._operands import Operand, operands
from ._pickled import arrays_of, with_arrays
from ._plot import TrianglePictures
from ._queries import FaceLocations
from ._regions import Regions
from ._repr import count
from ._tables import TriangleTables
from ._types import ArrayLike, BoolArray, FloatArray, IntArray, Progress

Crossings: TypeAlias = Literal["refuse", "split"]


class ConstrainedDelaunay(
    Mesh,  # faces and who is next to whom
    FaceLocations,  # locate, find_simplex
    LinearInterpolation,  # interpolate, weights
    TriangleShapes,  # to_geojson, to_geopandas, to_xarray
    TriangleTables,  # to_netcdf, to_parquet
    TrianglePictures,  # lonlat_triangles, plot
):
    """A triangulation with given edges: what `constrained_delaunay` returns.

    Each constraint is a chain of edges, divided at points that lie on it exactly; every other edge
    is locally Delaunay. The result is exact and unique, as that of `SphericalDelaunay`.

    Notes
    -----
    `ghost` tells the faces outside of points in one hemisphere, which constraints leave as
    they are; `simplices[~ghost]` are the triangles on the sphere. The algorithm inserts one
    constraint after the other (M. V. Anglada, "An improved incremental algorithm for constructing
    restricted Delaunay triangulations", Computers & Graphics 21, 1997); docs/theory/constrained.md
    has the proof.

    """

    def __init__(self) -> None:
        raise TypeError("rondel.constrained_delaunay() makes these objects")

    @classmethod
    def _of(
        cls,
        built: _core.ConstrainedTriangulation,
        points: FloatArray,
        constraints: IntArray,
        polygons: Lists,
        geometries: IntArray | None,
        *,
        is_split: bool,
        west_deg: float = -180.0,
    ) -> ConstrainedDelaunay:
        self = cls.__new__(cls)
        self._keep(
            built, points, constraints, polygons, geometries, is_split=is_split, west_deg=west_deg
        )
        return self

    def _keep(
        self,
        built: _core.ConstrainedTriangulation,
        points: FloatArray,
        constraints: IntArray,
        polygons: Lists,
        geometries: IntArray | None,
        *,
        is_split: bool,
        west_deg: float,
    ) -> None:
        has_added = len(points) < built.triangulation.num_sites
        Mesh.__init__(
            self, built.triangulation.points if has_added else points, built.triangulation
        )
        self._built = built
        self._num_given = len(points)
        self._constraints = frozen(constraints)
        self._polygons = polygons
        self._geometries = None if geometries is None else frozen(geometries)
        self._is_split = is_split
        self._west_deg = west_deg
        self._degrees: FloatArray | None = None

    def __getstate__(self) -> dict[str, Any]:
        arrays = arrays_of(self._built)
        del arrays["triangulation"]
        return {
            **super().__getstate__(),
            "built": arrays,
            "given": (self._num_given, self._constraints, self._polygons, self._geometries),
            "is_split": self._is_split,
            "west_deg": self._west_deg,
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(state)
        arrays = {**state["built"], "triangulation": self._triangulation}
        number, constraints, polygons, geometries = state["given"]
        self._keep(
            with_arrays(_core.ConstrainedTriangulation(), arrays),
            self._points[:number],
            constraints,
            Lists(*polygons),
            geometries,
            is_split=state["is_split"],
            west_deg=state["west_deg"],
        )

    @property
    def center(self) -> FloatArray:
        """Ndarray of float64, shape (3,): the center of the sphere."""
        return np.array(self._triangulation.center)

    @cached_property
    def lonlat(self) -> FloatArray:
        """Ndarray of float64, shape (n, 2): longitudes and latitudes of the points in degrees; of
        geometries as they have them, where doubles tell, from -180 to 180 or in their turn.
        """
        if self._geometries is not None:
            return frozen(_core.short_lonlats(self.points, self._west_deg))
        return frozen(degrees_of(self.points, self._triangulation.center))

    @property
    def constraints(self) -> IntArray:
        """Ndarray of int32, shape (c, 2): the ends of each constraint, as they were given, or as
        geometries have them.
        """
        return self._constraints

    @property
    def geometries(self) -> IntArray | None:
        """Ndarray of int32, shape (c,): the geometry of each constraint; None for points."""
        return self._geometries

    @property
    def num_added(self) -> int:
        """int: how many points were added where constraints cross; they are the last ones."""
        return self.npoints - self._num_given

    @cached_property
    def edges(self) -> IntArray:
        """Ndarray of int32, shape (e, 2): every edge once, the lower index first, sorted."""
        # An edge between solid faces may be one between ghost faces, too.
        return np.unique(_core.edges(self._triangulation), axis=0).reshape(-1, 2)

    @property
    def constrained_edges(self) -> IntArray:
        """Ndarray of int32, shape (k, 2): the edges that are parts of constraints, the lower index
        first, sorted. Of duplicates the lowest index stands for all.
        """
        return self._built.edges

    @property
    def sources(self) -> Lists:
        """Lists: the constraints that each constrained edge is a part of, ascending."""
        return Lists(self._built.source_offsets, self._built.sources)

    @cached_property
    def sides(self) -> BoolArray:
        """Ndarray of bool, shape (m, 3): whether the edge opposite to the corner
        ``simplices[f, i]`` is constrained. Sides of ghost faces may be, too.
        """
        bits = np.unpackbits(self._built.sides[:, None], axis=1, count=3, bitorder="little")
        return frozen(bits.astype(bool).reshape(-1, 3))

    @cached_property
    def _lazy_locator(self) -> _core.ConstrainedLocator:
        return _core.ConstrainedLocator(self._built)

    def _locator(self) -> _core.ConstrainedLocator:
        return self._lazy_locator

    @cached_property
    def _lazy_interpolator(self) -> _core.ConstrainedInterpolator:
        return _core.ConstrainedInterpolator(self._built)

    def _linear_interpolator(self) -> _core.ConstrainedInterpolator:
        return self._lazy_interpolator

    def faces_inside(self, polygons: Lists | Iterable[ArrayLike] | None = None) -> Lists:
        """Finds the faces in polygons whose sides are constraints, exactly.

        Parameters
        ----------
        polygons : Lists or iterable of array_like, optional
            For each polygon the positions of the constraints that are its sides, in any order; the
            interior is to the left of each. By default the polygons of all geometries, one for
            each geometry; without geometries all constraints are the sides of one polygon.

        Returns
        -------
        Lists
            The faces in each polygon, ascending. Ghost faces are in none.

        Raises
        ------
        InvalidInput
            If the sides of a polygon do not close rings that have the interior on one side, or it
            leaves the hull of the points (the position of the polygon).

        Notes
        -----
        From the left of each side it goes from face to face, up to the sides of the polygon. So
        polygons may be around poles, larger than a hemisphere, share sides, overlap, and have
        holes.

        Examples
        --------
        >>> import rondel
        >>> points = rondel.unit_vectors([0, 10, 10, 0, 5], [0, 0, 10, 10, 20])
        >>> tri = rondel.constrained_delaunay(points, [[0, 1], [1, 2], [2, 3], [3, 0]])
        >>> len(tri.faces_inside().indices), int((~tri.ghost).sum())
        (2, 3)

        """
        rows = self._polygons if polygons is None else _lists_of(polygons)
        try:
            return Lists(*_core.faces_inside(self._built, self._constraints, *rows))
        except InvalidInput as error:
            if polygons is not None or self._geometries is None:
                raise
            raise InvalidInput(re.sub("^polygon", "geometry", str(error)), error.index) from None

    @cached_property
    def inside(self) -> BoolArray:
        """Ndarray of bool, shape (m,): the faces in any of the polygons, those of
        ``faces_inside()``, which also says what is raised.
        """
        mask = np.zeros(len(self.simplices), bool)
        mask[self.faces_inside().indices] = True
        return frozen(mask)

    def validate(self, *, threads: int | None = None) -> CheckReport:
        """Proves or refutes, by another algorithm, that this is the triangulation of the points.

        Parameters
        ----------
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        CheckReport
            As of `check_constrained`. Where constraints were split, their parts are the
            constraints.

        """
        given = self.constrained_edges if self._is_split else self._constraints
        return check_constrained(
            self.points, given, self.simplices, center=self.center, threads=threads
        )

    def _facts(self) -> list[tuple[str, str]]:
        number = len(self._constraints)
        edges = count(len(self.constrained_edges), "constrained edge")
        return [
            *super()._facts(),
            ("constraints", count(number, "constraint")),
            ("constrained edges", edges),
        ]


def constrained_delaunay(
    points: Any,
    edges: Any = None,
    *,
    crossings: Crossings = "refuse",
    center: ArrayLike | None = None,
    invalid: Invalid = "error",
    threads: int | None = None,
    progress: Progress = None,
) -> ConstrainedDelaunay:
    """Computes the Delaunay triangulation of points in which given arcs are edges.

    Parameters
    ----------
    points : array_like, shape (n, 3), or geometries
        Coordinates x, y, z of the sites; each is projected on the sphere exactly
        (`unit_vectors` makes them of longitudes and latitudes). Or points, lines and polygons as
        in `intersection`: their places are the sites, each once, and their sides are the
        constraints.
    edges : array_like, shape (m, 2), or {'lonlat', 'geodesic'}, optional
        The two ends of each constraint, as positions in `points`; by default there are none. A
        constraint is the shorter arc between them. Constraints may be repeated, overlap, and have
        points on them. For geometries what joins their positions, as in `intersection`: lines that
        are straight in longitude and latitude (default), or arcs of great circles.
    crossings : {'refuse', 'split'}, optional
        What becomes of constraints that cross between their ends: an error (default), or each
        crossing, rounded to doubles, becomes a point. Points must be unit vectors then. Constraints
        that both have one of the points exactly on them are divided there, and do not cross.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin. For points only.
    invalid : {'error', 'repair'}, optional
        What becomes of polygons that are not valid, as in `intersection`. For geometries only.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    ConstrainedDelaunay
        The triangulation: `simplices`, `constrained_edges`, `inside` and more.

    Raises
    ------
    CrossingConstraints
        If constraints cross and are not split. It is a `ValueError` that has the positions of both
        and the place; for geometries the message has their numbers.
    InvalidInput
        If a coordinate is not finite or a point is the center (its position); if a constraint ends
        at no point, or both ends are in one place or opposite to each other (its position).
    ValueError
        If a geometry is not valid, or is the whole sphere; the message has its number.

    See Also
    --------
    delaunay : without constraints.
    check_constrained : the proof of faces of any origin.

    Notes
    -----
    The result depends neither on the order of points and constraints nor on `threads`.

    Examples
    --------
    A border across the short diagonal of four points:

    >>> import rondel
    >>> points = rondel.unit_vectors([0, 10, 0, -10], [-2, 0, 2, 0])
    >>> short = rondel.delaunay(points)
    >>> short.simplices[~short.ghost].tolist()
    [[3, 0, 2], [2, 0, 1]]
    >>> tri = rondel.constrained_delaunay(points, [[3, 1]])
    >>> tri
    <rondel.ConstrainedDelaunay: 4 points, 4 faces, 2 ghost faces, 1 constraint, 1 constrained edge>
    >>> tri.simplices[~tri.ghost].tolist()
    [[3, 0, 1], [3, 1, 2]]

    The inside of a polygon with a hole:

    >>> import shapely
    >>> ring = shapely.box(170, -10, 190, 10) - shapely.box(175, -5, 185, 5)
    >>> tri = rondel.constrained_delaunay(ring, "geodesic")
    >>> int(tri.inside.sum()), int((~tri.ghost).sum())
    (8, 10)

    """
    if crossings not in ("refuse", "split"):
        raise ValueError(f"crossings must be 'refuse' or 'split', not {crossings!r}")
    is_split = crossings == "split"
    number = as_threads(threads)
    origin = as_center(center)
    if not _are_geometries(points, edges):
        if invalid != "error":
            raise ValueError("invalid is about geometries, and points are given")
        kept = as_kept(points, copy=True)
        constraints = as_constraints(edges, len(kept))
        built = _core.constrained_delaunay(kept, constraints, origin, is_split, number, progress)
        one = Lists(
            np.array([0, len(constraints)], np.int64), np.arange(len(constraints), dtype=np.int32)
        )
        return ConstrainedDelaunay._of(built, kept, constraints, one, None, is_split=is_split)
    if any(origin):
        raise ValueError("center is about points, and geometries are given")
    words: Edges = "lonlat" if edges is None else edges
    (given,) = operands({"geometries": points}, words, threads, invalid)
    try:
        parts = _core.constraints_of_geometries(given.geometries())
    except InvalidInput as error:
        raise ValueError(_named(given, str(error))) from None
    sites, constraints, owners, indptr, indices = parts
    rows = Lists(indptr, indices)
    try:
        built = _core.constrained_delaunay(sites, constraints, origin, is_split, number, progress)
    except CrossingConstraints as error:
        raise _crossing_of(given, owners, error) from None
    west_deg = _core.west_of(given.longitudes, np.empty((0, 2)))
    return ConstrainedDelaunay._of(
        built, sites, constraints, rows, owners, is_split=is_split, west_deg=west_deg
    )


def check_constrained(
    points: ArrayLike,
    edges: ArrayLike | None,
    simplices: ArrayLike,
    *,
    center: ArrayLike | None = None,
    threads: int | None = None,
) -> CheckReport:
    """Proves or refutes that triangles are the constrained Delaunay triangulation of points.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        The sites, as in `constrained_delaunay`.
    edges : array_like, shape (m, 2), or None
        The constraints. None of them may cross another one.
    simplices : array_like, shape (k, 3)
        The triangles, in any order, as positions in `points`; counterclockwise seen from outside.
        Of points in one hemisphere the ghost faces belong to them.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin.
    threads : int, optional
        The largest number of threads; by default one for each core.

    Returns
    -------
    CheckReport
        It is true if the triangles are right; otherwise `reason` says in one line what is wrong.

    Raises
    ------
    InvalidInput
        As `constrained_delaunay`, except for constraints that cross: then no triangles are right.

    Examples
    --------
    >>> import rondel
    >>> points = rondel.unit_vectors([0, 10, 0, -10], [-2, 0, 2, 0])
    >>> faces = rondel.delaunay(points).simplices
    >>> bool(rondel.check_constrained(points, None, faces))
    True
    >>> rondel.check_constrained(points, [[3, 1]], faces).is_valid
    False

    """
    given = as_points(points)
    triangles = np.asarray(simplices)
    if triangles.size == 0:
        triangles = np.zeros((0, 3), np.int32)
    if triangles.dtype.kind not in "iu" or triangles.ndim != 2 or triangles.shape[1] != 3:
        raise ValueError(
            f"simplices must be integers of shape (k, 3), not {in_words(triangles)} of shape "
            f"{triangles.shape}"
        )
    outside = np.flatnonzero(((triangles < 0) | (triangles >= len(given))).any(axis=1))
    if outside.size:
        raise InvalidInput(f"simplex {outside[0]} has a corner that is no point", int(outside[0]))
    found = _core.check_constrained(
        given,
        as_constraints(edges, len(given)),
        np.require(triangles, np.int32, ["C", "A"]),
        as_center(center),
        as_threads(threads),
    )
    return CheckReport(*(getattr(found, name) for name in CheckReport._fields))


def _are_geometries(given: Any, edges: Any) -> bool:
    """Whether they are geometries, and not the coordinates of points."""
    if isinstance(edges, str) or isinstance(given, (CellSet, Regions)):
        return True
    if isinstance(given, (list, tuple)) or getattr(given, "dtype", None) == np.dtype(object):
        given = next((item for item in given if item is not None), None)
    return isinstance(given, Mapping) or hasattr(given, "__geo_interface__")


def as_constraints(edges: Any, num_points: int) -> IntArray:
    """Pairs of positions of points."""
    array = np.asarray([] if edges is None else edges)
    if array.size == 0:
        return np.zeros((0, 2), np.int32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"edges must be integers, not {in_words(array)}")
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"edges must have shape (m, 2), not {array.shape}")
    for k in np.flatnonzero(((array < 0) | (array >= num_points)).any(axis=1))[:1]:
        site = next(site for site in array[k].tolist() if not 0 <= site < num_points)
        raise InvalidInput(
            f"constraint {k} ends at site {site}, but there are {count(num_points, 'site')}", int(k)
        )
    return np.array(array, np.int32, order="C")


def _lists_of(polygons: Lists | Iterable[ArrayLike]) -> Lists:
    if isinstance(polygons, Lists):
        indices = np.asarray(polygons.indices)
        rows = np.split(indices, polygons.indptr[1:-1]) if len(polygons.indptr) > 1 else []
    else:
        rows = [np.asarray(row).reshape(-1) for row in polygons]
    for k, row in enumerate(rows):
        if row.size and (row.dtype.kind not in "iu" or row.min() < 0 or row.max() >= 2**31):
            raise InvalidInput(f"polygon {k} has something else than positions of constraints", k)
    indptr = np.concatenate([[0], np.cumsum([len(row) for row in rows], dtype=np.int64)])
    indices = np.concatenate([np.zeros(0, np.int32), *rows]).astype(np.int32)
    return Lists(indptr.astype(np.int64), indices)


def _name_of(given: Operand, geometry: int) -> str:
    return "geometries" if given.is_single else f"geometries: geometry {geometry}"


def _named(given: Operand, message: str) -> str:
    """A message that begins with the number of a feature, with the name of the geometry."""
    return re.sub(r"^feature ([0-9]+)", lambda match: _name_of(given, int(match[1])), message)


def _crossing_of(
    given: Operand, owners: IntArray, error: CrossingConstraints
) -> CrossingConstraints:
    """The error of constraints, in words of geometries."""
    first, second = (int(owners[k]) for k in error.constraints)
    other = "itself" if first == second else f"geometry {first}"
    lon, lat = error.place
    text = (
        f"{_name_of(given, second)} crosses {other} at longitude {lon:.9g}, latitude {lat:.9g}; "
        "crossings='split' makes a point there"
    )
    return CrossingConstraints(text, error.constraints, error.place)
