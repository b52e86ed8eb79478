# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Convex hulls of points in space."""

from __future__ import annotations

from functools import cached_property

from . import _core
from ._arrays import as_kept, as_threads
from ._mesh import Mesh
from ._types import ArrayLike, Progress


class ConvexHull(Mesh):
    """The convex hull of points in space: exact and unique, also if it is flat.

    The vertices are exactly the extreme points: no point of a facet or an edge that is not a
    corner. All other points are `hidden`. Points in one plane have a `ring`, the corners of their
    polygon, and no faces.

    Parameters
    ----------
    points : array_like, shape (n, 3)
    threads : int, optional
    progress : callable, optional
    copy : bool, optional
        By default the points are copied. With ``copy=False`` a C-contiguous array of float64, also
        one that is mapped from a file, is used where it lies. It must not be changed as long as
        the object lives: results would be wrong, and calls might not end.

    Raises
    ------
    InvalidInput
        If a coordinate is not finite.

    Notes
    -----
    The second approach of Caroli et al., SEA 2010, section 4.2.

    Examples
    --------
    >>> import itertools, rondel
    >>> cube = rondel.convex_hull([*itertools.product([0, 1], repeat=3), (0.5, 0.5, 0.5)])
    >>> cube
    <rondel.ConvexHull: 9 points, 1 hidden, 12 faces>
    >>> cube.volume, cube.area
    (1.0, 6.0)
    >>> len(cube.facets.indptr) - 1
    6

    """

    def __init__(
        self,
        points: ArrayLike,
        *,
        threads: int | None = None,
        progress: Progress = None,
        copy: bool = True,
    ) -> None:
        points = as_kept(points, copy=copy)
        super().__init__(points, _core.convex_hull(points, as_threads(threads), progress))

    @cached_property
    def _size(self) -> tuple[float, float]:
        return _core.size_of_hull(self._triangulation)

    @property
    def volume(self) -> float:
        """float: the volume; 0 of a flat hull."""
        return self._size[0]

    @property
    def area(self) -> float:
        """float: the surface area; of a flat hull both sides of the polygon together."""
        return self._size[1]


def convex_hull(
    points: ArrayLike,
    *,
    threads: int | None = None,
    progress: Progress = None,
    copy: bool = True,
) -> ConvexHull:
    """The convex hull of points in space: see `ConvexHull`.

    Parameters
    ----------
    points : array_like, shape (n, 3)
    threads : int, optional
    progress : callable, optional
    copy : bool, optional

    Returns
    -------
    ConvexHull

    """
    return ConvexHull(points, threads=threads, progress=progress, copy=copy)
