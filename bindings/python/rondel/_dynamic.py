# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A triangulation whose sites can be inserted, removed and moved."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, overload

import numpy as np

from . import _core
from ._arrays import (
    as_center,
    as_floats,
    as_indices,
    as_points,
    as_queries,
    as_radius,
    as_threads,
    is_weighted,
    unit_vectors,
)
from ._delaunay import SphericalDelaunay
from ._dynamic_sites import DynamicSites, as_id
from ._queries import Queries
from ._repr import count
from ._types import ArrayLike, FloatArray, IntArray, Model


class Snapshot(NamedTuple):
    """A triangulation at one time: point i of `delaunay` has the id ``ids[i]``."""

    ids: IntArray
    delaunay: SphericalDelaunay


class DynamicTriangulation(DynamicSites, Queries):
    """A Delaunay or regular triangulation under insertions, removals and moves.

    At any time it is the triangulation that `delaunay` computes for the current sites. Each site
    has an id, which it keeps until it is removed; then the id may be given to a new site. The sites
    of the constructor have the ids 0 to n - 1. A call that raises changes nothing, and Ctrl-C waits
    for the end of a change. Several threads may use one object.

    Parameters
    ----------
    points : array_like, shape (n, 3), optional
        The first sites, which are copied; by default there are none.
    model : {'projected', 'weighted'}, optional
        What a point represents, as in `delaunay`; by default 'projected'.
    radius : float, optional
        The radius of the sphere, in the unit of the points; by default 1.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin.
    threads : int, optional
        The largest number of threads for the first sites; by default one for each core.

    Raises
    ------
    InvalidInput
        If a coordinate is not finite, or a projected point is the center.

    Notes
    -----
    A change takes about two microseconds with a million sites, and some tenths of a second whenever
    the number of sites has doubled or halved. Insertion follows Caroli et al., SEA 2010, section 4;
    removal follows Chew 1990 and Devillers 1999.

    Examples
    --------
    >>> import rondel
    >>> sites = rondel.DynamicTriangulation([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
    >>> new = sites.insert([0, 0, -1])
    >>> new
    4
    >>> sites.neighbors(new)
    array([0, 3, 1], dtype=int32)
    >>> sites.remove(new)
    >>> sites
    <rondel.DynamicTriangulation: 4 sites, 4 vertices, 4 faces, projected>

    """

    _state: _core.DynamicTriangulation

    def __init__(
        self,
        points: ArrayLike | None = None,
        model: Model = "projected",
        *,
        radius: float = 1.0,
        center: ArrayLike | None = None,
        threads: int | None = None,
    ) -> None:
        self._model: Model = model
        self._radius = as_radius(radius)
        if points is None:
            self._state = _core.DynamicTriangulation(
                is_weighted(model), as_center(center), self._radius * self._radius
            )
        else:
            first = SphericalDelaunay(points, model, radius=radius, center=center, threads=threads)
            self._state = _core.DynamicTriangulation(first._triangulation)

    @classmethod
    def from_lonlat(
        cls, lon: ArrayLike, lat: ArrayLike, *, threads: int | None = None
    ) -> DynamicTriangulation:
        """Makes the triangulation of longitudes and latitudes on the unit sphere.

        Parameters
        ----------
        lon, lat : array_like, shape (n,)
            Longitudes and latitudes of the first sites in degrees; latitudes are from -90 to 90.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        DynamicTriangulation
            The triangulation; the sites have the ids 0 to n - 1.

        Raises
        ------
        InvalidInput
            If an angle is not finite or a latitude is outside [-90, 90].

        """
        return cls(unit_vectors(lon, lat).reshape(-1, 3), threads=threads)

    def __reduce__(self) -> tuple[Any, ...]:
        t = self.snapshot()
        sphere = {"radius": self._radius, "center": t.delaunay.center}
        return (_restored, (t.ids, t.delaunay.points, self._model, sphere))

    def _locator(self) -> _core.DynamicTriangulation:
        return self._state

    @overload
    def insert(self, points: Sequence[float], *, hint: int | None = None) -> int: ...
    @overload
    def insert(self, points: Sequence[Sequence[float]], *, hint: None = None) -> IntArray: ...
    @overload
    def insert(self, points: ArrayLike, *, hint: int | None = None) -> Any: ...
    def insert(self, points: ArrayLike, *, hint: int | None = None) -> Any:
        """Adds one site or several.

        Parameters
        ----------
        points : array_like, shape (3,) or (n, 3)
            The coordinates of one site, or of several.
        hint : int, optional
            The id of a close site, which saves the search for the place of a single new site.

        Returns
        -------
        int or ndarray of int32, shape (n,)
            The ids of the new sites, in the order of `points`.

        Raises
        ------
        InvalidInput
            If a coordinate is not finite, a projected point is the center, or there is no site
            `hint`.

        """
        array = as_floats(points, "points")
        if array.shape != (3,):
            if hint is not None:
                raise ValueError("a hint is for one point")
            return self._state.insert(as_points(array))
        if hint is None:
            return self._state.insert_one(tuple(array.tolist()))
        return self._state.insert_near(tuple(array.tolist()), as_id(hint))

    def insert_lonlat(self, lon: ArrayLike, lat: ArrayLike, *, hint: int | None = None) -> Any:
        """Adds one site or several by longitude and latitude.

        Parameters
        ----------
        lon, lat : float or array_like, shape (n,)
            Longitudes and latitudes in degrees; latitudes are from -90 to 90.
        hint : int, optional
            As in `insert`.

        Returns
        -------
        int or ndarray of int32, shape (n,)
            The ids of the new sites.

        Raises
        ------
        InvalidInput
            If an angle is not finite, a latitude is outside [-90, 90], or there is no site `hint`.

        """
        return self.insert(unit_vectors(lon, lat), hint=hint)

    def remove(self, ids: ArrayLike) -> None:
        """Removes one site or several.

        Parameters
        ----------
        ids : int or array_like of int, shape (n,)
            The ids of the sites.

        Raises
        ------
        InvalidInput
            If there is no such site or an id appears twice.

        """
        self._state.remove(as_indices(np.atleast_1d(ids), "ids"))

    def move(self, ids: ArrayLike, points: ArrayLike) -> None:
        """Moves one site, or several one after the other. They keep their ids.

        Parameters
        ----------
        ids : int or array_like of int, shape (n,)
            The ids of the sites.
        points : array_like, shape (3,) or (n, 3)
            The new coordinates of each of them.

        Raises
        ------
        InvalidInput
            If there is no such site, a point is not valid as in `insert`, or the lengths differ.

        """
        to = as_points(np.atleast_2d(as_floats(points, "points")))
        self._state.move(as_indices(np.atleast_1d(ids), "ids"), to)

    def move_all(self, points: ArrayLike, *, threads: int | None = None) -> None:
        """Moves all sites at once. They keep their ids.

        The triangulation is the one that a build of the points gives. Where sites move by a small
        share of their spacing, it is mended by flips of edges, which takes less time.

        Parameters
        ----------
        points : array_like, shape (n, 3)
            The new coordinates: row i is for the site `ids[i]`.
        threads : int, optional
            The largest number of threads; by default that of the first sites.

        Raises
        ------
        InvalidInput
            If there is not one point for each site, or a point is not valid as in `insert`.

        Notes
        -----
        Lawson, "Software for C1 surface interpolation", 1977: flips until each edge is locally
        Delaunay. Sites that do not surround the center, and hidden sites, lead to a build.

        Examples
        --------
        >>> import rondel
        >>> points = rondel.unit_vectors([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> sites = rondel.DynamicTriangulation(points)
        >>> sites.move_all(points + [0.1, 0, 0])
        >>> sites.neighbors(0)
        array([1, 4, 3, 5], dtype=int32)

        """
        to = as_points(np.atleast_2d(as_floats(points, "points")))
        self._state.move_all(to, None if threads is None else as_threads(threads))

    def find_simplex(self, xi: ArrayLike, *, threads: int | None = None) -> IntArray:
        """Finds the corners of the face that contains each query point.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Query points; only their directions from the center of the sphere are used.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        ndarray of int32, shape (..., 3)
            The ids of the three corners; for a point on an edge its two ends and -1, on a vertex
            its id and -1, outside of all faces -1.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center.

        """
        queries, shape = as_queries(xi)
        return self._state.locate(queries, as_threads(threads)).reshape(*shape, 3)

    def neighbors(self, site: int) -> IntArray:
        """Returns the neighbors of a site.

        Parameters
        ----------
        site : int
            The id of the site.

        Returns
        -------
        ndarray of int32, shape (k,)
            The ids of the neighbors, counterclockwise from the lowest; for a duplicate those of its
            representative, for a hidden site none.

        Raises
        ------
        InvalidInput
            If there is no such site.

        """
        return self._state.neighbors(as_id(site))

    def is_vertex(self, site: int) -> bool:
        """Tells whether the site, or its representative, is a vertex; otherwise it is hidden."""
        return self._state.is_vertex(as_id(site))

    def snapshot(self) -> Snapshot:
        """Returns the current sites and their triangulation as arrays.

        Returns
        -------
        Snapshot
            `ids`, in increasing order, and `delaunay`, a `SphericalDelaunay` of their points.

        """
        ids, triangulation = self._state.snapshot()
        return Snapshot(
            ids, SphericalDelaunay._from_parts(triangulation.points, triangulation, self._radius)
        )

    @property
    def model(self) -> Model:
        """str: 'projected' or 'weighted'."""
        return self._model

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("sites", count(len(self), "site")),
            ("vertices", count(self._state.num_vertices, "vertex", "vertices")),
            self._size(),
            ("model", self.model),
        ]


# Ids that are not in use are given to duplicates, which go again.
def _restored(
    ids: IntArray, points: FloatArray, model: Model, sphere: dict[str, Any]
) -> DynamicTriangulation:
    if len(ids) == 0:
        return DynamicTriangulation(model=model, **sphere)
    unused = np.setdiff1d(np.arange(ids[-1] + 1), ids)
    all_points = np.empty((ids[-1] + 1, 3))
    all_points[ids] = points
    all_points[unused] = points[0]
    copy = DynamicTriangulation(all_points, model, **sphere)
    copy.remove(unused)
    return copy
