# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Power diagrams."""

from __future__ import annotations

import numpy as np

from . import _core
from ._arrays import ORIGIN, as_floats, as_lonlat, as_points, as_threads, as_vector
from ._delaunay import SphericalDelaunay
from ._diagram import Diagram
from ._types import ArrayLike, IntArray, Progress


class PowerDiagram(Diagram[SphericalDelaunay], model="weighted"):
    """The power (Laguerre) diagram of circles on a sphere, which `power_diagram` makes.

    A point of the sphere belongs to the circle with the smallest Laguerre distance
    arccos(cos(angle) / cos(radius)), where `angle` is the distance from the circle's center.
    Circles without a cell are `hidden`.
    """

    @property
    def hidden(self) -> IntArray:
        """Ndarray of int32, shape (h, 2): each row has a circle without a cell and a face of
        `delaunay` below which it lies.
        """
        return self._delaunay.hidden


def power_diagram(
    centers: ArrayLike,
    radii_deg: ArrayLike,
    *,
    threads: int | None = None,
    progress: Progress = None,
) -> PowerDiagram:
    """Computes the power (Laguerre) diagram of circles on the unit sphere.

    Parameters
    ----------
    centers : array_like, shape (n, 3) or (n, 2)
        The centers of the circles: unit vectors, or longitudes and latitudes in degrees.
    radii_deg : array_like, shape (n,) or float
        Angular radii in degrees, from 0 to less than 90; one number holds for all circles.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    PowerDiagram
        The diagram: cell i belongs to circle i. With equal radii it is the Voronoi diagram.

    Raises
    ------
    InvalidInput
        If a radius is not in [0, 90), a center is not finite, or a latitude is outside [-90, 90].
        It is a `ValueError` whose `index` is the first bad circle.

    Notes
    -----
    A circle with the center q and the radius r is represented by the weighted site q / cos r, the
    pole of its plane (Sugihara, "Laguerre Voronoi diagram on the sphere", Journal for Geometry and
    Graphics 6, 2002).

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
    count = len(centers) if centers.ndim else None
    radii = as_floats(radii_deg, "radii_deg")
    if radii.ndim == 0 and count is not None:
        radii = np.full(count, float(radii))
    radii = as_vector(radii, "radii_deg", count)
    degrees = None
    if centers.ndim == 2 and centers.shape[1] == 2:
        degrees = as_lonlat(centers[:, 0], centers[:, 1])
        points = _core.polar_points_lonlat(degrees, radii)
    else:
        points = _core.polar_points(as_points(centers, "centers"), radii)
    built = _core.delaunay(points, True, ORIGIN, 1.0, as_threads(threads), progress)
    return PowerDiagram._from_delaunay(SphericalDelaunay._from_parts(points, built, 1.0, degrees))
