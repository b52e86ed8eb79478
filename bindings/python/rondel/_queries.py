# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Questions of place and distance, for triangulations that stay and for those that change."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import Any, NoReturn, overload

import numpy as np

from ._arrays import HINT_OF_DEGREES, as_indices, as_queries, as_threads, require_unmasked
from ._mesh import Lists
from ._types import ArrayLike, FloatArray, IntArray


class Where(IntEnum):
    """What the ray from the center through a query point meets."""

    VERTEX = 0
    EDGE = 1
    FACE = 2
    OUTSIDE = 3


class Queries:
    """Questions that `_locator()` answers. Query points stand for rays from the center."""

    def _locator(self) -> Any:
        raise NotImplementedError

    def nearest(self, xi: ArrayLike, *rest: NoReturn, threads: int | None = None) -> IntArray:
        """The nearest vertex of each query point, exactly; of several the lowest index.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Only directions from the center of the sphere count.
        threads : int, optional
            At most so many; by default one for each core.

        Returns
        -------
        ndarray of int32, shape (...)
            -1 if there are no points. With model 'weighted' the site in whose power cell the query
            lies.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center.

        """
        if rest:
            raise TypeError("nearest() takes points of shape (..., 3); " + HINT_OF_DEGREES)
        queries, shape = as_queries(xi)
        return self._locator().nearest(queries, as_threads(threads)).reshape(shape)[()]

    def k_nearest(self, xi: ArrayLike, k: int, *, threads: int | None = None) -> IntArray:
        """The k nearest vertices of each query point in order of distance, exactly.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
        k : int
        threads : int, optional

        Returns
        -------
        ndarray of int32, shape (..., k)
            Filled up with -1 where there are fewer vertices. Of equal distances the lower index
            comes first.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center.

        """
        queries, shape = as_queries(xi)
        if k < 0:
            raise ValueError(f"k must not be negative, but is {k}")
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
        """All vertices within an angle of each query point.

        Parameters
        ----------
        xi : array_like, shape (3,) or (q, 3)
        angle : float
            Radians. With model 'weighted' and angle 0: the circles that hold the query.
        threads : int, optional

        Returns
        -------
        ndarray of int32, or Lists
            For one query its sites in increasing order; for many a tuple (indptr, indices): those
            of query i are ``indices[indptr[i]:indptr[i + 1]]``.

        Raises
        ------
        InvalidInput
            If a query is not finite or is the center, or the angle is negative.

        """
        queries, shape = as_queries(xi)
        if len(shape) > 1:
            raise ValueError(f"xi must have shape (3,) or (q, 3), not {(*shape, 3)}")
        lists = Lists(*self._locator().within(queries, float(angle), as_threads(threads)))
        return lists if shape else lists.indices

    def distance(self, xi: ArrayLike, sites: ArrayLike) -> FloatArray:
        """Angles between query points and sites.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
        sites : array_like of int, shape (...)
            Broadcast against the query points: ``distance(xi[:, None], k_nearest(xi, 5))``.

        Returns
        -------
        ndarray of float64
            Radians from 0 to pi, infinite for the site -1. With model 'weighted' the Laguerre
            distance ``arccos(cos(angle) |P| / R)``, 0 inside of the circle.

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
