# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Copies and pickles are equal, and whole."""

import copy
import pickle

import clouds
import numpy as np
import pytest

import rondel

OBJECTS = {
    "triangulation": lambda: rondel.delaunay(clouds.uniform(50)),
    "degrees": lambda: rondel.delaunay_lonlat([0, 90, 180, 10], [0, 0, 0, 80]),
    "patch": lambda: rondel.delaunay(clouds.patch(50, 0.1)),
    "circle": lambda: rondel.delaunay(np.eye(3)[:2]),
    "weighted": lambda: rondel.delaunay(2 * clouds.uniform(50) ** 3, "weighted", radius=2),
    "voronoi": lambda: rondel.SphericalVoronoi(clouds.uniform(50)),
    "on a circle": lambda: rondel.SphericalVoronoi(np.array([[1.0, 0], [0, 1], [-1, 0]])),
    "power": lambda: rondel.power_diagram(clouds.uniform(50), 5.0),
    "hull": lambda: rondel.convex_hull(clouds.uniform(50)),
}
COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{
        f"pickle {p}": lambda thing, p=p: pickle.loads(pickle.dumps(thing, p))
        for p in range(pickle.HIGHEST_PROTOCOL + 1)
    },
}
ARRAYS = (
    *("points", "simplices", "neighbors", "duplicates", "hidden", "ghost", "ring"),
    *("edges", "vertices", "areas", "lonlat"),
)


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("build", OBJECTS.values(), ids=OBJECTS)
def test_a_copy_is_equal(build, make):
    thing = build()
    copied = make(thing)
    assert type(copied) is type(thing)
    assert repr(copied) == repr(thing)
    for name in ARRAYS:
        if hasattr(thing, name):
            assert np.array_equal(getattr(copied, name), getattr(thing, name)), name
    if hasattr(thing, "nearest"):
        assert np.array_equal(copied.nearest(clouds.cube()), thing.nearest(clouds.cube()))
    if isinstance(thing, rondel.SphericalVoronoi):
        assert copied.regions == thing.regions


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
def test_the_copy_of_a_changing_triangulation_has_the_same_ids(make):
    sites = rondel.DynamicTriangulation(
        clouds.uniform(30), "weighted", radius=2, center=(0, 0, 0.5)
    )
    sites.remove([0, 7, 8, 29])
    copied = make(sites)
    assert copied.ids.tolist() == sites.ids.tolist()
    assert repr(copied) == repr(sites)
    assert np.array_equal(copied.snapshot().delaunay.simplices, sites.snapshot().delaunay.simplices)
    sites.remove(sites.ids)
    assert len(make(sites)) == 0
    assert len(copied) == 26


def test_an_error_can_be_pickled():
    error = pickle.loads(pickle.dumps(rondel.InvalidInput("site 3: wrong", 3)))
    assert (str(error), error.index) == ("site 3: wrong", 3)


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
def test_what_the_user_changed_is_copied_too(make):
    for sphere in ({}, {"radius": 2.0, "center": (1, 2, 3)}):
        points = sphere.get("radius", 1) * clouds.uniform(50) + sphere.get("center", (0, 0, 0))
        diagram = rondel.SphericalVoronoi(points, **sphere)
        diagram.vertices *= 2
        diagram.regions[3].reverse()
        copied = make(diagram)
        assert np.array_equal(copied.vertices, diagram.vertices)
        assert copied.regions == diagram.regions
        diagram.vertices = diagram.vertices[:5]
        assert np.array_equal(make(diagram).vertices, diagram.vertices)


def test_what_can_be_found_again_is_not_pickled():
    diagram = rondel.SphericalVoronoi(clouds.uniform(1000))
    before = len(pickle.dumps(diagram))
    assert len(diagram.regions) == 1000
    assert diagram.vertices.sum() + diagram.areas.sum() + diagram.ridge_points.sum() != 0
    assert len(pickle.dumps(diagram)) == before
