# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Graphs and regions, against all pairs and against SciPy."""

import clouds
import numpy as np
import pytest
import scipy.sparse
import scipy.spatial.distance

import rondel

SITES = clouds.uniform(80)
TRI = rondel.delaunay(SITES)
CHORDS = scipy.spatial.distance.squareform(scipy.spatial.distance.pdist(SITES))


def test_the_tree_is_as_long_as_that_of_all_pairs():
    tree = scipy.sparse.csgraph.minimum_spanning_tree(CHORDS)
    edges, lengths = TRI.graph("mst")
    assert sorted(map(tuple, np.sort(np.transpose(tree.nonzero()), axis=1))) == list(
        map(tuple, edges)
    )
    assert lengths == pytest.approx(2 * np.arcsin(CHORDS[edges[:, 0], edges[:, 1]] / 2), rel=1e-12)


@pytest.mark.parametrize("kind", ["gabriel", "relative"])
def test_edges_are_those_of_all_pairs(kind):
    expected = []
    for a in range(80):
        for b in range(a + 1, 80):
            others = [c for c in range(80) if c not in (a, b)]
            if kind == "gabriel":
                taken = any(
                    CHORDS[a, c] ** 2 + CHORDS[b, c] ** 2 <= CHORDS[a, b] ** 2 for c in others
                )
            else:
                taken = any(max(CHORDS[a, c], CHORDS[b, c]) < CHORDS[a, b] for c in others)
            if not taken:
                expected.append((a, b))
    assert list(map(tuple, TRI.graph(kind).edges)) == expected


def test_edge_index_has_both_directions_or_one():
    edges, lengths = TRI.graph("gabriel")
    one, one_lengths = TRI.edge_index("gabriel", both=False)
    assert one.dtype == np.int64
    assert np.array_equal(one, edges.T)
    assert np.array_equal(one_lengths, lengths)
    both, both_lengths = TRI.edge_index("gabriel")
    assert both.shape == (2, 2 * len(edges))
    matrix = scipy.sparse.coo_array((both_lengths, both), shape=(80, 80)).tocsr()
    assert (matrix != matrix.T).nnz == 0
    assert np.array_equal(both, np.stack(np.unique(both, axis=1)))


def test_the_delaunay_graph_has_all_edges_around_the_center():
    assert np.array_equal(TRI.graph().edges, TRI.edges)


def test_the_hull_is_the_sphere_or_a_polygon():
    assert TRI.hull_polygon().polygon_offsets.tolist() == [0, 0]
    assert TRI.hull_polygon().rings == []
    square = rondel.delaunay(rondel.unit_vectors([0, 10, 10, 0, 5], [0, 0, 10, 10, 5]))
    (ring,) = square.hull_polygon().rings
    assert np.roll(ring, -np.argmin(ring)).tolist() == [0, 1, 2, 3]
    (same,) = square.alpha_shape(1.0).rings
    assert same.tolist() == ring.tolist()
    assert square.alpha_shape(0.0).polygon_offsets.tolist() == [0]


def test_circles_are_those_of_the_faces():
    found = TRI.largest_empty_circles(len(TRI.simplices))
    radii = np.arccos((TRI.circumcenters * SITES[TRI.simplices[:, 0]]).sum(axis=1))
    assert found.radii == pytest.approx(np.sort(radii)[::-1], abs=1e-12)
    assert len(TRI.largest_empty_circles(3).centers) == 3


def test_wrong_arguments():
    with pytest.raises(ValueError, match="kind must be one of"):
        TRI.graph("nearest")
    with pytest.raises(rondel.InvalidInput):
        TRI.alpha_shape(-1)
    with pytest.raises(ValueError, match="negative"):
        TRI.largest_empty_circles(-1)
    weighted = rondel.delaunay(SITES, model="weighted")
    with pytest.raises(rondel.InvalidInput, match="weighted"):
        weighted.graph("mst")
