# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations that change."""

import clouds
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rondel


def same_as_built(dynamic):
    """Whether the snapshot is what delaunay() makes of its points."""
    now = dynamic.snapshot().delaunay
    fresh = rondel.delaunay(now.points, dynamic.model)
    return np.array_equal(now.simplices, fresh.simplices) and np.array_equal(
        now.duplicates, fresh.duplicates
    )


@given(clouds.grid_points, st.data())
def test_any_changes_lead_to_what_is_built_at_once(points, data):
    sites = rondel.DynamicTriangulation()
    alive = {}
    for point in points:
        alive[sites.insert(point)] = point
        if alive and data.draw(st.booleans()):
            gone = data.draw(st.sampled_from(sorted(alive)))
            sites.remove(gone)
            del alive[gone]
        if alive and data.draw(st.booleans()):
            moved = data.draw(st.sampled_from(sorted(alive)))
            sites.move(moved, -alive[moved])
            alive[moved] = -alive[moved]
    assert sites.ids.tolist() == sorted(alive)
    assert all((sites.point(i) == alive[i]).all() for i in alive)
    assert same_as_built(sites)


def test_ranges():
    sites = rondel.DynamicTriangulation(clouds.uniform(50))
    ids = sites.insert(clouds.uniform(50, seed=1))
    assert ids.tolist() == list(range(50, 100))
    sites.remove(ids[::2])
    sites.move(ids[1::2], clouds.uniform(25, seed=2))
    assert len(sites) == 75
    assert 50 not in sites
    assert 51 in sites
    assert -1 not in sites
    assert 2**40 not in sites
    assert same_as_built(sites)


def test_all_sites_move():
    points = clouds.uniform(500)
    sites = rondel.DynamicTriangulation(points)
    sites.remove(7)
    for length, threads in ((0.001, None), (0.01, 1), (0.5, 3)):
        points = points + length * (clouds.uniform(500, seed=4) - 0.1)
        sites.move_all(np.delete(points, 7, axis=0), threads=threads)
        assert np.array_equal(sites.point(8), points[8])
        assert same_as_built(sites)
    with pytest.raises(ValueError, match="threads must be at least 1"):
        sites.move_all(sites.snapshot().delaunay.points, threads=0)


def test_a_hint_changes_nothing():
    sites = rondel.DynamicTriangulation(clouds.uniform(50))
    sites.insert(clouds.uniform(1, seed=3)[0], hint=7)
    assert same_as_built(sites)
    with pytest.raises(ValueError, match="one point"):
        sites.insert(clouds.uniform(2), hint=7)


def test_neighbors_and_representatives():
    sites = rondel.DynamicTriangulation(clouds.cube())
    twin = sites.insert(2 * clouds.cube()[3])
    assert sites.representative(twin) == 3
    assert sites.is_vertex(twin)
    assert np.array_equal(sites.neighbors(twin), sites.neighbors(3))
    sites.remove(3)
    assert sites.representative(twin) == twin


def test_hidden_sites_come_back():
    octahedron = np.concatenate([np.eye(3), -np.eye(3)])
    sites = rondel.DynamicTriangulation([*octahedron, [0.3, 0.3, 0.3]], model="weighted")
    assert not sites.is_vertex(6)
    assert sites.neighbors(6).size == 0
    sites.remove([0, 1])
    assert sites.is_vertex(6)


@pytest.mark.parametrize(
    "change",
    [
        lambda s: s.remove(99),
        lambda s: s.remove([0, 1, 1]),
        lambda s: s.remove(-1),
        lambda s: s.insert([0, 0, np.nan]),
        lambda s: s.insert([[0, 0, 1], [0, 0, 0]]),
        lambda s: s.insert([0, 0, 1], hint=99),
        lambda s: s.move(0, [0, 0, 0]),
        lambda s: s.move([0, 1], [[0, 0, 1]]),
        lambda s: s.move_all([[0, 0, 1]]),
        lambda s: s.move_all(np.full((8, 3), np.nan)),
        lambda s: s.neighbors(-1),
        lambda s: s.point(2**40),
        lambda s: s.is_vertex(8),
    ],
)
def test_what_is_refused_changes_nothing(change):
    sites = rondel.DynamicTriangulation(clouds.cube())
    before = sites.snapshot()
    with pytest.raises(rondel.InvalidInput):
        change(sites)
    after = sites.snapshot()
    assert np.array_equal(before.delaunay.points, after.delaunay.points)
    assert np.array_equal(before.delaunay.simplices, after.delaunay.simplices)


def test_ids_are_integers():
    sites = rondel.DynamicTriangulation(clouds.cube())
    with pytest.raises(TypeError):
        sites.remove([0.0])
    with pytest.raises(TypeError):
        sites.neighbors("0")


def test_description():
    assert repr(rondel.DynamicTriangulation()) == (
        "<rondel.DynamicTriangulation: 0 sites, 0 vertices, dimension -1, projected>"
    )


def test_threads_may_share_one_object():
    from concurrent.futures import ThreadPoolExecutor

    sites = rondel.DynamicTriangulation(clouds.uniform(200))
    new = clouds.uniform(200, seed=4)

    def change_and_ask(k):
        site = sites.insert(new[k])
        assert sites.nearest(new[k]) == site
        sites.remove(site)

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(change_and_ask, range(200)))
    assert len(sites) == 200
    assert same_as_built(sites)


def test_degrees():
    lon, lat = [0.0, 90, 180, -90, 10], [0.0, 10, -10, 0, 80]
    sites = rondel.DynamicTriangulation.from_lonlat(lon, lat)
    assert np.array_equal(sites.snapshot().delaunay.points, rondel.unit_vectors(lon, lat))
    assert sites.insert_lonlat(20, -80) == 5
    assert sites.insert_lonlat([30, 40], [5, 6]).tolist() == [6, 7]
    assert np.array_equal(sites.point(7), rondel.unit_vectors(40, 6))
    with pytest.raises(rondel.InvalidInput, match="latitude"):
        sites.insert_lonlat(0, 91)
