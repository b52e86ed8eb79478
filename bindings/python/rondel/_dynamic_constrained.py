# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A triangulation with given edges, whose sites and edges come and go."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _core
from ._arrays import as_center, as_point, as_points, as_threads
from ._constrained import ConstrainedDelaunay, as_constraints
from ._dynamic_sites import DynamicSites, as_id
from ._mesh import Lists
from ._repr import count
from ._types import ArrayLike, FloatArray, IntArray


class ConstrainedSnapshot(NamedTuple):
    """A triangulation at one time, with the ids of its points and constraints.

    Point i of `delaunay` has the id ``ids[i]``, constraint i the id ``constraint_ids[i]``.
    """

    ids: IntArray
    constraint_ids: IntArray
    delaunay: ConstrainedDelaunay


class DynamicConstrainedTriangulation(DynamicSites):
    """A constrained Delaunay triangulation under insertions and removals of sites and constraints.

    At any time it is the triangulation that `constrained_delaunay` computes for the current sites
    and constraints. Each site and each constraint has an id, which it keeps until it is removed;
    then the id may be given to a new one. Those of the constructor have the ids 0, 1, 2 ... A site
    may lie on constraints, which it divides; when it goes, their pieces unite. A call that raises
    changes nothing. Several threads may use one object.

    Parameters
    ----------
    points : array_like, shape (n, 3), optional
        The first sites, which are copied; by default there are none.
    edges : array_like, shape (m, 2), optional
        The two ends of each of the first constraints, as positions in `points`; by default there
        are none.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin.
    threads : int, optional
        The largest number of threads for the first sites; by default one for each core.

    Raises
    ------
    InvalidInput, CrossingConstraints
        As `constrained_delaunay`.

    Notes
    -----
    The insertion of a site and of an edge follow M. V. Anglada, "An improved incremental algorithm
    for constructing restricted Delaunay triangulations", Computers & Graphics 21, 1997, and
    J. R. Shewchuk and B. C. Brown, "Fast segment insertion and incremental construction of
    constrained Delaunay triangulations", Computational Geometry 48, 2015.

    Examples
    --------
    >>> import rondel
    >>> points = rondel.unit_vectors([0, 10, 0, -10], [-2, 0, 2, 0])
    >>> tri = rondel.DynamicConstrainedTriangulation(points)
    >>> border = tri.insert_constraint(3, 1)
    >>> tri
    <rondel.DynamicConstrainedTriangulation: 4 sites, 1 constraint, 4 faces>
    >>> middle = tri.insert([1, 0, 0])
    >>> tri.chain(border)
    array([3, 4, 1], dtype=int32)
    >>> tri.remove(middle)
    >>> tri.snapshot().delaunay.constrained_edges.tolist()
    [[1, 3]]

    """

    _state: _core.DynamicConstrainedTriangulation

    def __init__(
        self,
        points: ArrayLike | None = None,
        edges: ArrayLike | None = None,
        *,
        center: ArrayLike | None = None,
        threads: int | None = None,
    ) -> None:
        self._center = as_center(center)
        first = np.zeros((0, 3)) if points is None else as_points(points)
        self._state = _core.DynamicConstrainedTriangulation(
            first, as_constraints(edges, len(first)), self._center, as_threads(threads)
        )

    def __reduce__(self) -> tuple[Any, ...]:
        ids, constraint_ids, ends, built = self._state.snapshot()
        points = built.triangulation.points
        return (_restored, (ids, points, constraint_ids, ends, self._center))

    def insert(self, point: ArrayLike, *, hint: int | None = None) -> int:
        """Adds a site.

        Parameters
        ----------
        point : array_like, shape (3,)
            The coordinates of the site.
        hint : int, optional
            The id of a close site, which saves the search for the place of the new one.

        Returns
        -------
        int
            The id of the new site.

        Raises
        ------
        InvalidInput
            If a coordinate is not finite, the point is the center, or there is no site `hint`.

        """
        coordinates = as_point(point)
        if hint is None:
            return self._state.insert(coordinates)
        return self._state.insert_near(coordinates, as_id(hint))

    def remove(self, site: int) -> None:
        """Removes a site.

        Parameters
        ----------
        site : int
            The id of the site.

        Raises
        ------
        InvalidInput
            If there is no such site, or it is an end of a constraint.
        CrossingConstraints
            If several constraints meet in the site that would cross without it.

        """
        self._state.remove(as_id(site))

    def insert_constraint(self, first: int, second: int) -> int:
        """Adds the arc between two sites.

        Parameters
        ----------
        first, second : int
            The ids of the two sites.

        Returns
        -------
        int
            The id of the new constraint.

        Raises
        ------
        InvalidInput
            If there is no such site, or both are in one place or opposite to each other.
        CrossingConstraints
            If it crosses a constraint in the inside of both.

        """
        return self._state.insert_constraint(as_id(first), as_id(second, "site", 1))

    def remove_constraint(self, constraint: int) -> None:
        """Removes a constraint.

        Parameters
        ----------
        constraint : int
            The id of the constraint.

        Raises
        ------
        InvalidInput
            If there is no such constraint.

        """
        self._state.remove_constraint(as_id(constraint, "constraint"))

    def neighbors(self, site: int) -> IntArray:
        """Returns the vertices that share an edge with a site.

        Parameters
        ----------
        site : int
            The id of the site.

        Returns
        -------
        ndarray of int32, shape (k,)
            Their ids, counterclockwise: from the lowest on, or, on the border of the hull of the
            sites, from the next vertex of the border on.

        Raises
        ------
        InvalidInput
            If there is no such site.

        """
        return self._state.neighbors(as_id(site))

    def chain(self, constraint: int) -> IntArray:
        """Returns the vertices along a constraint.

        Parameters
        ----------
        constraint : int
            The id of the constraint.

        Returns
        -------
        ndarray of int32, shape (k,)
            Their ids, from one end to the other; of duplicates the lowest id.

        Raises
        ------
        InvalidInput
            If there is no such constraint.

        """
        return self._state.chain(as_id(constraint, "constraint"))

    def constraint(self, constraint: int) -> tuple[int, int]:
        """Returns the ids of the two sites of a constraint, as they were given."""
        return self._state.constraint(as_id(constraint, "constraint"))

    def snapshot(self) -> ConstrainedSnapshot:
        """Returns the current sites, constraints and their triangulation as arrays.

        Returns
        -------
        ConstrainedSnapshot
            `ids` and `constraint_ids`, in increasing order, and `delaunay`, a `ConstrainedDelaunay`
            of their points and constraints.

        """
        ids, constraint_ids, ends, built = self._state.snapshot()
        constraints = np.searchsorted(ids, ends)
        one = Lists(np.array([0, len(ends)], np.int64), np.arange(len(ends), dtype=np.int32))
        delaunay = ConstrainedDelaunay._of(
            built,
            built.triangulation.points,
            constraints.astype(np.int32),
            one,
            None,
            is_split=False,
        )
        return ConstrainedSnapshot(ids, constraint_ids, delaunay)

    @property
    def constraint_ids(self) -> IntArray:
        """Ndarray of int32: the ids of constraints in use, increasing."""
        return self._state.constraint_ids()

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("sites", count(len(self), "site")),
            ("constraints", count(self._state.num_constraints, "constraint")),
            self._size(),
        ]


# Ids that are not in use are given to sites and constraints that go again.
def _restored(
    ids: IntArray,
    points: FloatArray,
    constraint_ids: IntArray,
    ends: IntArray,
    center: tuple[float, float, float],
) -> DynamicConstrainedTriangulation:
    if len(ids) == 0:
        return DynamicConstrainedTriangulation(center=center)
    unused = np.setdiff1d(np.arange(ids[-1] + 1), ids)
    all_points = np.empty((ids[-1] + 1, 3))
    all_points[ids] = points
    all_points[unused] = points[0]
    edges = np.zeros((0, 2), np.int32)
    free = np.zeros(0, int)
    if len(ends) > 0:
        edges = np.tile(ends[0], (constraint_ids[-1] + 1, 1))
        edges[constraint_ids] = ends
        free = np.setdiff1d(np.arange(len(edges)), constraint_ids)
    copy = DynamicConstrainedTriangulation(all_points, edges, center=center)
    for constraint in free.tolist():
        copy.remove_constraint(constraint)
    for site in unused.tolist():
        copy.remove(site)
    return copy
