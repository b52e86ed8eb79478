# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The diagrams of `SphericalVoronoi` off the sphere: on circles, and in more dimensions."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from ._arrays import as_threads
from ._errors import InvalidInput
from ._repr import count
from ._types import FloatArray, IntArray


class FlatMesh:
    """In place of the triangulation of a diagram whose points are not three-dimensional."""

    def __init__(
        self,
        points: FloatArray,
        radius: float,
        center: FloatArray,
        simplices: IntArray,
        duplicates: IntArray,
    ) -> None:
        self.points = points
        self.radius = radius
        self.center = center
        self.simplices = simplices
        self.duplicates = duplicates

    @property
    def _triangulation(self) -> Any:
        raise TypeError("Only supported for three-dimensional point sets")

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("points", count(len(self.points), "point")),
            ("dimensions", f"{self.points.shape[1]} dimensions"),
        ]


def circle_diagram(
    points: FloatArray, radius: float, center: FloatArray, threads: int | None
) -> tuple[FlatMesh, dict[str, Any]]:
    """The diagram of points (n, 2) on a circle: an arc for each.

    They are triangulated as points of a great circle; the result is their order around it.
    Returns a mesh and the attributes `vertices`, `regions` and `areas`.
    """
    built = _core.delaunay(
        np.column_stack([points, np.zeros(len(points))]),
        False,
        (*center.tolist(), 0.0),
        radius * radius,
        as_threads(threads),
        None,
    )
    if len(built.ring) < 3:
        raise InvalidInput("Rank of input points must be at least 2", 0)
    rays = points - center
    ring = built.ring
    if _turns(rays[ring]).sum() < 0:
        ring = ring[::-1]
    following = np.roll(ring, -1)
    chords = rays[following] - rays[ring]
    normals = np.column_stack([chords[:, 1], -chords[:, 0]])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    regions: list[list[int]] = [[] for _ in points]
    for k, site in enumerate(ring.tolist()):
        regions[site] = [(k - 1) % len(ring), k]
    arcs = _turns(rays[ring])
    areas = np.zeros(len(points))
    areas[ring] = radius * (arcs + np.roll(arcs, 1)) / 2
    simplices = np.column_stack([ring, following])
    return FlatMesh(points, radius, center, simplices, built.duplicates), {
        "vertices": radius * normals + center,
        "regions": regions,
        "areas": areas,
    }


def _turns(rays: FloatArray) -> FloatArray:
    """The angle from each ray to the next one; the one that is left when all others are known lies
    between 0 and 2 pi.
    """
    following = np.roll(rays, -1, axis=0)
    cross = rays[:, 0] * following[:, 1] - rays[:, 1] * following[:, 0]
    angles = np.arctan2(cross, np.einsum("ij,ij->i", rays, following))
    backward = np.flatnonzero(angles < 0)
    if len(backward) == 1:  # the empty half of the circle
        angles[backward] += 2 * np.pi
    return angles


def general_diagram(
    points: FloatArray, radius: float, center: FloatArray, threshold: float
) -> tuple[FlatMesh, dict[str, Any]]:
    """The diagram of points in more dimensions, by SciPy, in the same form without `areas`."""
    try:
        from scipy.spatial import SphericalVoronoi
    except ImportError as error:
        raise TypeError(
            "Rondel is for points on the sphere, which are three-dimensional; for more dimensions "
            "rondel.SphericalVoronoi asks SciPy, which is not installed"
        ) from error
    found = SphericalVoronoi(points, radius, center, threshold)
    none = np.zeros((0, 2), np.int32)
    return FlatMesh(points, radius, center, found._simplices, none), {
        "vertices": found.vertices,
        "regions": found.regions,
    }
