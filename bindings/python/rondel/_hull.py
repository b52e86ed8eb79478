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
    """The convex hull of points in space, exact and unique even if it is flat.

    The vertices are exactly the extreme points; a point inside a facet or an edge is no vertex. All
    points that are no vertices are `hidden`. If the points lie in one plane, the hull has a `ring`,
    the corners of its polygon, and no faces.

    Parameters
    ----------
    points, threads, progress, copy
        As in `convex_hull`, which also says what is raised.

    Notes
    -----
    The algorithm is the second approach of Caroli et al., "Robust and Efficient Delaunay
    Triangulations of Points on Or Close to a Sphere", SEA 2010, section 4.2: the hull is the
    regular triangulation of weighted sites.

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
        """float: the volume in the cubed unit of the points; 0 for a flat hull."""
        return self._size[0]

    @property
    def area(self) -> float:
        """float: the surface area in the squared unit of the points; for a flat hull that of both
        sides of the polygon.
        """
        return self._size[1]


def convex_hull(
    points: ArrayLike,
    *,
    threads: int | None = None,
    progress: Progress = None,
    copy: bool = True,
) -> ConvexHull:
    """Computes the convex hull of points in space.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Coordinates x, y, z of the points, in any unit.
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
    ConvexHull
        The hull; `simplices` are its triangles, `facets` its polygons, `vertices` its corners.

    Raises
    ------
    InvalidInput
        If a coordinate is not finite, or there are more than 715,827,882 points. It is a
        `ValueError` whose `index` is the first bad point.

    Notes
    -----
    See `ConvexHull` for the algorithm.

    Examples
    --------
    >>> import rondel
    >>> hull = rondel.convex_hull([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0.1, 0.1, 0.1]])
    >>> hull
    <rondel.ConvexHull: 5 points, 1 hidden, 4 faces>
    >>> hull.vertices.tolist()
    [0, 1, 2, 3]

    """
    return ConvexHull(points, threads=threads, progress=progress, copy=copy)
