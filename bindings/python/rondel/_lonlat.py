# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Arcs and triangles in the plane of longitude and latitude, cut where it ends.

Longitudes of neighboring corners are *unwrapped*: they differ by at most 180 degrees and may lie
beyond the ends of the map. A triangle whose longitudes do not come back to where they began has a
pole inside.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import half_turn
from ._types import FloatArray, IntArray


class LonLatTriangles(NamedTuple):
    """Triangles of the plane of longitude and latitude.

    Attributes
    ----------
    lon, lat : ndarray of float64, shape (k,)
        Nodes: first the sites, then copies of some, a turn away or at the latitude of a pole.
    triangles : ndarray of int32, shape (t, 3)
        Positions in `lon` and `lat`.
    sites : ndarray of int32, shape (k,)
        The site of each node.
    faces : ndarray of int32, shape (t,)
        The face of each triangle.

    """

    lon: FloatArray
    lat: FloatArray
    triangles: IntArray
    sites: IntArray
    faces: IntArray

    def triangulation(self) -> Any:
        """The same as a `matplotlib.tri.Triangulation`."""
        from matplotlib.tri import Triangulation

        return Triangulation(self.lon, self.lat, self.triangles)


def flat_triangles(
    degrees: FloatArray, simplices: IntArray, faces: npt.NDArray[np.intp]
) -> LonLatTriangles:
    """`LonLatTriangles` of some faces; `degrees` (n, 2) are the places of the sites."""
    corners = simplices[faces]
    lon, lat = degrees[:, 0], degrees[:, 1]
    steps = half_turn(lon[np.roll(corners, -1, axis=1)] - lon[corners])
    unwrapped = lon[corners[:, :1]] + np.cumsum(steps, axis=1) - steps
    is_polar = (np.abs(steps.sum(axis=1)) > 180) | (np.abs(lat[corners]) == 90).any(axis=1)
    inside = (np.abs(unwrapped) <= 180).all(axis=1) & (unwrapped == lon[corners]).all(axis=1)
    plain = inside & ~is_polar
    crossing = ~inside & ~is_polar

    copies = _Copies()
    copies.add(unwrapped[crossing], lat[corners[crossing]], corners[crossing], faces[crossing])
    for k in np.flatnonzero(is_polar):
        for piece in _polar_pieces(unwrapped[k], steps[k], lat[corners[k]], corners[k]):
            copies.add(*piece, faces[k : k + 1])
    more_lon, more_lat, more_sites, more_faces = copies.arrays()
    count = len(degrees)
    return LonLatTriangles(
        np.concatenate([lon, more_lon.ravel()]),
        np.concatenate([lat, more_lat.ravel()]),
        np.concatenate([corners[plain], count + np.arange(more_lon.size).reshape(-1, 3)]).astype(
            np.int32
        ),
        np.concatenate([np.arange(count), more_sites.ravel()]).astype(np.int32),
        np.concatenate([faces[plain], more_faces]).astype(np.int32),
    )


class _Copies:
    """Triangles with nodes of their own, once for each end of the map that they reach."""

    def __init__(self) -> None:
        self._parts = [(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))]

    def add(self, lon: Any, lat: Any, sites: Any, faces: Any) -> None:
        lon = lon - 360 * np.round(lon.mean(axis=1, keepdims=True) / 360)
        self._parts.append((lon, lat, sites, faces))
        for turn, reaches in ((360, lon.min(axis=1) < -180), (-360, lon.max(axis=1) > 180)):
            self._parts.append((lon[reaches] + turn, lat[reaches], sites[reaches], faces[reaches]))

    def arrays(self) -> tuple[Any, ...]:
        return tuple(np.concatenate(column) for column in zip(*self._parts, strict=True))


def _polar_pieces(
    lon: FloatArray, steps: FloatArray, lat: FloatArray, sites: IntArray
) -> Iterator[tuple[FloatArray, FloatArray, IntArray]]:
    """The two triangles between each side of a polar triangle and its pole, where the map has a
    line in place of a point.
    """
    at_pole = np.flatnonzero(np.abs(lat) == 90)
    pole = lat[at_pole[0]] if len(at_pole) else np.copysign(90.0, steps.sum())
    for i in range(3):
        j = (i + 1) % 3
        if i in at_pole or j in at_pole:
            continue
        west_to = half_turn(lon[j] - lon[i]) if len(at_pole) else steps[i]
        names = [sites[at_pole[0]]] * 2 if len(at_pole) else [sites[i], sites[j]]
        quad_lon = np.array([lon[i], lon[i] + west_to, lon[i] + west_to, lon[i]])
        quad_lat = np.array([lat[i], lat[j], pole, pole])
        quad_sites = np.array([sites[i], sites[j], names[1], names[0]])
        for half in ([0, 1, 2], [0, 2, 3]):
            yield quad_lon[None, half], quad_lat[None, half], quad_sites[None, half]


def arcs(a: FloatArray, b: FloatArray) -> list[FloatArray]:
    """Arcs of great circles between unit vectors (k, 3), as lines of longitude and latitude that
    end where the map does.
    """
    positions, offsets = _core.arc_lines(np.ascontiguousarray(a), np.ascontiguousarray(b))
    return np.split(positions, offsets[1:-1]) if len(positions) else []
