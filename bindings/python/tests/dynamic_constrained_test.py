# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations with given edges that change."""

import contextlib
import pickle

import clouds
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rondel

SQUARE = rondel.unit_vectors([0, 10, 0, -10], [-2, 0, 2, 0])


def same_as_built(tri):
    """Whether the snapshot is what constrained_delaunay() makes of its points and constraints."""
    now = tri.snapshot().delaunay
    fresh = rondel.constrained_delaunay(now.points, now.constraints)
    return (
        np.array_equal(now.simplices, fresh.simplices)
        and np.array_equal(now.neighbors, fresh.neighbors)
        and np.array_equal(now.constrained_edges, fresh.constrained_edges)
        and np.array_equal(now.sides, fresh.sides)
        and now.sources.indices.tolist() == fresh.sources.indices.tolist()
    )


@given(clouds.grid_points, st.data())
def test_any_changes_lead_to_what_is_built_at_once(points, data):
    tri = rondel.DynamicConstrainedTriangulation()
    sites, constraints = set(), set()
    for point in points:
        sites.add(tri.insert(point))
        ends = [data.draw(st.sampled_from(sorted(sites))) for _ in range(2)]
        with contextlib.suppress(rondel.InvalidInput):
            constraints.add(tri.insert_constraint(*ends))
        if constraints and data.draw(st.booleans()):
            gone = data.draw(st.sampled_from(sorted(constraints)))
            tri.remove_constraint(gone)
            constraints.remove(gone)
        site = data.draw(st.sampled_from(sorted(sites)))
        if all(site not in tri.constraint(i) for i in constraints):
            with contextlib.suppress(rondel.CrossingConstraints):
                tri.remove(site)
                sites.remove(site)
        if not sites:
            sites.add(tri.insert(point))
    assert tri.ids.tolist() == sorted(sites)
    assert tri.constraint_ids.tolist() == sorted(constraints)
    assert same_as_built(tri)


def test_facts():
    tri = rondel.DynamicConstrainedTriangulation(SQUARE, [[0, 2]])
    middle = tri.insert([2, 0, 0], hint=1)
    assert tri.chain(0).tolist() == [0, middle, 2]
    assert tri.constraint(0) == (0, 2)
    assert sorted(tri.neighbors(middle).tolist()) == [0, 1, 2, 3]
    assert tri.point(middle).tolist() == [2, 0, 0]
    twin = tri.insert([3, 0, 0])
    assert tri.representative(twin) == middle
    assert len(tri) == 6
    assert 5 in tri
    assert -1 not in tri
    assert tri.dimension == 2
    assert repr(tri) == ("<rondel.DynamicConstrainedTriangulation: 6 sites, 1 constraint, 6 faces>")
    assert repr(rondel.DynamicConstrainedTriangulation()) == (
        "<rondel.DynamicConstrainedTriangulation: 0 sites, 0 constraints, dimension -1>"
    )


def test_what_is_refused():
    tri = rondel.DynamicConstrainedTriangulation(SQUARE, [[0, 2]])
    with pytest.raises(rondel.CrossingConstraints) as crossing:
        tri.insert_constraint(1, 3)
    assert crossing.value.constraints == (0, 1)
    for call, message in (
        (lambda: tri.remove(2), "site 2 is an end of constraint 0"),
        (lambda: tri.remove(-1), "site -1 does not exist"),
        (lambda: tri.remove_constraint(4), "constraint 4 does not exist"),
        (lambda: tri.insert_constraint(0, 9), "site 9 does not exist"),
        (lambda: tri.insert([0, 0, np.nan]), "not finite"),
    ):
        with pytest.raises(rondel.InvalidInput, match=message):
            call()
    with pytest.raises(ValueError, match="shape"):
        tri.insert([[1, 0, 0]])
    assert same_as_built(tri)


def test_pickles():
    tri = rondel.DynamicConstrainedTriangulation(
        SQUARE, [[0, 1], [0, 2], [2, 3]], center=[0, 0, 1e-3]
    )
    tri.remove_constraint(0)
    tri.remove(1)
    copy = pickle.loads(pickle.dumps(tri))
    assert copy.ids.tolist() == tri.ids.tolist() == [0, 2, 3]
    assert copy.constraint_ids.tolist() == [1, 2]
    assert copy.constraint(2) == (2, 3)
    assert np.array_equal(copy.snapshot().delaunay.simplices, tri.snapshot().delaunay.simplices)
