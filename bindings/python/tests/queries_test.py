# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Where points are, and what is near them."""

import clouds
import numpy as np
import pytest

import rondel

SITES = clouds.uniform(300)
QUERIES = clouds.uniform(100, seed=1)
COSINES = QUERIES @ SITES.T


@pytest.fixture(params=["built", "dynamic"])
def sites(request):
    if request.param == "built":
        return rondel.delaunay(SITES)
    return rondel.DynamicTriangulation(SITES)


def test_nearest(sites):
    assert np.array_equal(sites.nearest(QUERIES), COSINES.argmax(axis=1))
    assert sites.nearest(3 * SITES[17]) == 17
    assert sites.nearest(QUERIES.reshape(4, 25, 3)).shape == (4, 25)


def test_k_nearest(sites):
    assert np.array_equal(sites.k_nearest(QUERIES, 7), np.argsort(-COSINES, axis=1)[:, :7])
    assert sites.k_nearest(SITES[3], 1).tolist() == [3]
    assert sites.k_nearest(QUERIES, 0).shape == (100, 0)
    with pytest.raises(ValueError, match="k must be from 0"):
        sites.k_nearest(QUERIES, -1)
    few = rondel.delaunay(SITES[:2]).k_nearest(QUERIES[:1], 4)
    assert sorted(few[0].tolist()) == [-1, -1, 0, 1]


def test_within(sites):
    lists = sites.within(QUERIES, 0.3)
    for i in range(len(QUERIES)):
        row = lists.indices[lists.indptr[i] : lists.indptr[i + 1]]
        assert row.tolist() == np.flatnonzero(COSINES[i] >= np.cos(0.3)).tolist()
    assert sites.within(SITES[5], 0).tolist() == [5]
    assert len(sites.within(QUERIES[0], np.pi)) == len(SITES)
    with pytest.raises(rondel.InvalidInput, match="angle"):
        sites.within(QUERIES, -1)


def test_distance(sites):
    near = sites.k_nearest(QUERIES, 3)
    expected = np.arccos(np.take_along_axis(COSINES, near, 1))
    assert np.allclose(sites.distance(QUERIES[:, None], near), expected, atol=1e-12)
    assert sites.distance(SITES[4], 4) == 0
    assert sites.distance(SITES[4], [4, -1]).tolist() == [0, np.inf]
    with pytest.raises(rondel.InvalidInput, match="no site 300"):
        sites.distance(QUERIES, 300)


def test_the_distance_to_a_close_site_is_accurate():
    tri = rondel.delaunay(clouds.cube())
    close = tri.points[0] * (1 + 1e-3) + [1e-12, -1e-12, 0]
    assert 1.4e-12 < tri.distance(close, 0) < 1.5e-12


def test_find_simplex_and_locate():
    tri = rondel.delaunay(SITES)
    faces = tri.find_simplex(QUERIES)
    corners = tri.points[tri.simplices[faces]]
    for i in range(3):
        a, b = corners[:, i], corners[:, (i + 1) % 3]
        assert (np.einsum("ij,ij->i", np.cross(a, b), QUERIES) >= 0).all()
    at = tri.locate([SITES[8], SITES[8] + SITES[tri.edges[0, 0]], QUERIES[0]])
    assert at.where[0] == rondel.Where.VERTEX
    assert at.sites[0].tolist() == [8, -1, -1]
    assert at.where[2] == rondel.Where.FACE
    assert sorted(at.sites[2]) == sorted(tri.simplices[at.face[2]])


def test_outside():
    tri = rondel.delaunay(clouds.patch(30, 0.1))
    assert tri.find_simplex([0, 0, -1]) == -1
    assert tri.locate([0, 0, -1]).where == rondel.Where.OUTSIDE


def test_on_an_edge():
    octahedron = np.concatenate([np.eye(3), -np.eye(3)])
    at = rondel.delaunay(octahedron).locate([1, 1, 0])
    assert at.where == rondel.Where.EDGE
    assert at.sites.tolist() == [0, 1, -1]
    dynamic = rondel.DynamicTriangulation(octahedron)
    assert dynamic.find_simplex([1, 1, 0]).tolist() == [0, 1, -1]


def test_conflict_region_is_what_an_insertion_replaces():
    tri = rondel.delaunay(SITES)
    gone = set(tri.conflict_region(QUERIES[0]).tolist())
    after = {frozenset(face) for face in rondel.delaunay([*SITES, QUERIES[0]]).simplices.tolist()}
    for face, corners in enumerate(tri.simplices.tolist()):
        assert (face in gone) == (frozenset(corners) not in after)


def test_queries_from_several_threads_at_once():
    from concurrent.futures import ThreadPoolExecutor

    tri = rondel.delaunay(SITES)
    expected = tri.nearest(QUERIES)
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _: tri.nearest(QUERIES, threads=1), range(16)):
            assert np.array_equal(found, expected)


def test_wrong_numbers_are_refused_by_name():
    tri = rondel.delaunay(clouds.uniform(20))
    queries = clouds.uniform(2)
    for angle in ([0.1, 0.2], np.array([0.1, 0.2]), "0.1", None):
        with pytest.raises(TypeError, match=r"^angle must be a number, not "):
            tri.within(queries, angle)
    for angle in (np.float32(0.5), np.array(0.5)):
        assert np.array_equal(tri.within(queries, angle).indices, tri.within(queries, 0.5).indices)
    for k in (-1, 2**31, 2**40, 2**70):
        with pytest.raises(ValueError, match=f"^k must be from 0 to 2147483647, not {k}$"):
            tri.k_nearest(queries, k)
    for k in (2.5, "3", None):
        with pytest.raises(TypeError, match=r"^k must be an integer, not "):
            tri.k_nearest(queries, k)
    assert tri.k_nearest(queries, np.int64(3)).shape == (2, 3)
