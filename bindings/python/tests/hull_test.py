# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Convex hulls."""

import clouds
import numpy as np
import pytest
from hypothesis import given

import rondel


@given(clouds.points)
def test_no_point_is_outside(points):
    hull = rondel.convex_hull(points)
    assert len(hull.vertices) + len(hull.hidden) + len(hull.duplicates) == len(points)
    a, b, c = (points[hull.simplices[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    heights = normals @ points.T - np.einsum("ij,ij->i", normals, a)[:, None]
    size = np.abs(points).max(initial=1)
    assert (heights <= 1e-12 * size**3).all()


def test_the_hull_is_that_of_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(0).normal(size=(500, 3))
    theirs, ours = spatial.ConvexHull(points), rondel.convex_hull(points)
    assert ours.vertices.tolist() == sorted(theirs.vertices.tolist())
    assert abs(ours.volume / theirs.volume - 1) < 1e-12
    assert abs(ours.area / theirs.area - 1) < 1e-12


def test_flat_hulls():
    square = rondel.convex_hull([[0, 0, 5], [1, 0, 5], [1, 1, 5], [0, 1, 5], [0.5, 0.5, 5]])
    assert (square.dimension, square.volume, square.area) == (1, 0, 2)
    assert square.ring.tolist() == [0, 1, 2, 3]
    assert square.hidden[:, 0].tolist() == [4]
    line = rondel.convex_hull([[0, 0, 0], [1, 1, 1], [3, 3, 3], [2, 2, 2]])
    assert line.ring.tolist() == [0, 2]
