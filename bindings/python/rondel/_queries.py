# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Queries of position and distance, for static and dynamic triangulations."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import Any, NamedTuple, NoReturn, overload

import numpy as np

from ._arrays import (
    HINT_OF_DEGREES,
    as_count,
    as_indices,
    as_number,
    as_queries,
    as_threads,
    require_unmasked,
)
from ._mesh import Lists
from ._types import ArrayLike, FloatArray, IntArray


class Where(IntEnum):
    """What a query point lies on: the ray from the center through it meets this."""

    VERTEX = 0
    EDGE = 1
    FACE = 2
    OUTSIDE = 3


class Location(NamedTuple):
    """The answer of `locate`, of `SphericalDelaunay` and `ConstrainedDelaunay`, for query points.

    Attributes
    ----------
    where : ndarray of int32, shape (...)
        What each point lies on, as a value of `Where`: a vertex, an edge, a face or nothing.
    face : ndarray of int32, shape (...)
        A face that contains the point; of several the first; -1 outside.
    sites : ndarray of int32, shape (..., 3)
        The one, two or three sites of that vertex, edge or face, filled up with -1.

    """

    where: IntArray
    face: IntArray
    sites: IntArray


class FaceLocations:
    """The faces that have given points."""

    # Returns the object that answers to locate().
    def _locator(self) -> Any:
        raise NotImplementedError

    def locate(self, xi: ArrayLike, *, threads: int | None = None) -> Location:
        """Finds what each query point lies on: a vertex, an edge, a face or nothing.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Query points; only their directions from the center of the sphere are used.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        Location
            `where` (a `Where`), `face` (of several the first; -1 outside) and `sites`, one for a
            vertex, two for an edge, three for a face, filled up with -1. Their shapes are (...),
            (...) and (..., 3).

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center.

        Examples
        --------
        >>> import rondel
        >>> tri = rondel.delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
        >>> found = tri.locate([[0, 2, 0], [1, 1, 0]])
        >>> found.sites.tolist()
        [[1, -1, -1], [0, 1, -1]]

        """
        queries, shape = as_queries(xi)
        where, face, sites = self._locator().locate(queries, as_threads(threads))
        return Location(where.reshape(shape)[()], face.reshape(shape)[()], sites.reshape(*shape, 3))

    def find_simplex(self, xi: ArrayLike, *, threads: int | None = None) -> IntArray:
        """Finds the face that contains each point, like `scipy.spatial.Delaunay.find_simplex`.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Query points; only their directions from the center of the sphere are used.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        ndarray of int32, shape (...)
            Rows of `simplices`. For points on edges and vertices, the first of the faces there; -1
            where there is no face: outside of sites that do not surround the center, and below
            dimension 2.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center.

        """
        return self.locate(xi, threads=threads).face


class Queries:
    """The queries of a triangulation.

    Query points are points in space; only their directions from the center of the sphere are used.
    """

    def _locator(self) -> Any:
        raise NotImplementedError

    def nearest(self, xi: ArrayLike, *rest: NoReturn, threads: int | None = None) -> IntArray:
        """Finds the nearest vertex of each query point, exactly.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Query points; only their directions from the center of the sphere are used.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        ndarray of int32, shape (...)
            Indices of sites; of several at the same distance the lowest, and -1 if there are no
            sites. For model 'weighted' it is the site in whose power cell the query lies.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center.

        Examples
        --------
        >>> import rondel
        >>> tri = rondel.delaunay_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> tri.nearest(rondel.unit_vectors([10, 100], [5, 80])).tolist()
        [0, 4]

        """
        if rest:
            raise TypeError("nearest() takes points of shape (..., 3); " + HINT_OF_DEGREES)
        queries, shape = as_queries(xi)
        return self._locator().nearest(queries, as_threads(threads)).reshape(shape)[()]

    def k_nearest(self, xi: ArrayLike, k: int, *, threads: int | None = None) -> IntArray:
        """Finds the k nearest vertices of each query point, exactly.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Query points; only their directions from the center of the sphere are used.
        k : int
            The number of vertices for each query, at least 0.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        ndarray of int32, shape (..., k)
            Indices of sites in order of distance; of equal distances the lower index comes first.
            Rows are filled up with -1 if there are fewer vertices.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center.
        ValueError
            If k is negative, or 2**31 or more.

        Examples
        --------
        >>> import rondel
        >>> tri = rondel.delaunay_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> tri.k_nearest(rondel.unit_vectors(10, 5), 3).tolist()
        [0, 1, 4]

        """
        queries, shape = as_queries(xi)
        k = as_count(k, "k")
        found = self._locator().k_nearest(queries, k, as_threads(threads))
        return found.reshape(*shape, k)

    @overload
    def within(
        self, xi: Sequence[float], angle: float, *, threads: int | None = None
    ) -> IntArray: ...
    @overload
    def within(
        self, xi: Sequence[Sequence[float]], angle: float, *, threads: int | None = None
    ) -> Lists: ...
    @overload
    def within(self, xi: ArrayLike, angle: float, *, threads: int | None = None) -> Any: ...
    def within(self, xi: ArrayLike, angle: float, *, threads: int | None = None) -> Any:
        """Finds all vertices within an angle of each query point, exactly.

        Parameters
        ----------
        xi : array_like, shape (3,) or (q, 3)
            One query point or several; only their directions from the center of the sphere are
            used.
        angle : float
            The largest distance in radians. For model 'weighted', 0 finds the circles that contain
            the query.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        ndarray of int32, or Lists
            For one query its sites in increasing order. For several a tuple (indptr, indices): the
            sites of query i are ``indices[indptr[i]:indptr[i + 1]]``.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center, or the angle is negative.

        """
        queries, shape = as_queries(xi)
        if len(shape) > 1:
            raise ValueError(f"xi must have shape (3,) or (q, 3), not {(*shape, 3)}")
        lists = Lists(
            *self._locator().within(queries, as_number(angle, "angle"), as_threads(threads))
        )
        return lists if shape else lists.indices

    def distance(self, xi: ArrayLike, sites: ArrayLike) -> FloatArray:
        """Computes the distances between query points and sites.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Query points; only their directions from the center of the sphere are used.
        sites : array_like of int, shape (...)
            Indices of sites, broadcast against the query points, as in
            ``distance(xi[:, None], k_nearest(xi, 5))``.

        Returns
        -------
        ndarray of float64, shape (...)
            Angles in radians, from 0 to pi; infinite for the site -1. For model 'weighted' the
            Laguerre distance ``arccos(cos(angle) |P| / R)``, which is 0 inside of the circle.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center, or there is no such site.

        """
        queries, shape = as_queries(xi)
        require_unmasked(sites, "sites")
        sites = np.asarray(sites)
        shape = np.broadcast_shapes(shape, sites.shape)
        rows = np.broadcast_to(np.reshape(queries, (*np.shape(xi)[:-1], 3)), (*shape, 3))
        rows, names = rows.reshape(-1, 3), np.broadcast_to(sites, shape).reshape(-1)
        found = np.full(names.shape, np.inf)
        known = names != -1
        found[known] = self._locator().distance(
            np.ascontiguousarray(rows[known]), as_indices(names[known], "sites")
        )
        return found.reshape(shape)[()]
