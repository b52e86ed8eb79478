# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sites for tests, and strategies of Hypothesis that make them."""

import numpy as np
from hypothesis import strategies as st


def uniform(count, seed=0):
    """Random points of the unit sphere."""
    points = np.random.default_rng(seed).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def circle(count, normal=(0.0, 0.0, 1.0)):
    """Points of a great circle, to rounding; exact for the z axis."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    a = np.cross(normal, (1.0, 0.3, 0.0))
    a /= np.linalg.norm(a)
    b = np.cross(normal, a)
    return np.cos(angle)[:, None] * a + np.sin(angle)[:, None] * b


def patch(count, size, seed=0):
    """Random points within an angle of about `size` of the north pole."""
    plane = np.random.default_rng(seed).uniform(-size, size, (count, 2))
    points = np.column_stack([plane, np.ones(count)])
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def cube():
    """The corners of a cube, on the unit sphere."""
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
    return signs / np.sqrt(3.0)


# Small integers: many sites in one place, on one great circle, cocircular.
_small = st.integers(-2, 2)
grid_points = st.lists(st.tuples(_small, _small, _small).filter(any), max_size=24).map(
    lambda rows: np.array(rows, dtype=float).reshape(-1, 3)
)
_coordinate = st.floats(-1e6, 1e6, allow_nan=False).filter(lambda x: x == 0 or abs(x) > 1e-6)
any_points = st.lists(
    st.tuples(_coordinate, _coordinate, _coordinate).filter(any), max_size=40
).map(lambda rows: np.array(rows, dtype=float).reshape(-1, 3))
points = st.one_of(grid_points, any_points)
