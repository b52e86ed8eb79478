# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations: laws over any points, and what each attribute says."""

import ast
import graphlib
import itertools
import pathlib

import clouds
import numpy as np
import pytest
from hypothesis import given

import rondel


def check_surface(tri):
    """Euler, neighbors across edges, edges, lists of neighbors."""
    faces, edges = tri.simplices, tri.edges
    vertices = len(tri.vertices)
    assert vertices == tri.npoints - len(tri.duplicates) - len(tri.hidden)
    if tri.dimension < 2:
        assert len(faces) == 0
        assert sorted(tri.ring.tolist()) == tri.vertices.tolist()
    else:
        assert len(faces) == 2 * vertices - 4
        assert len(edges) == 3 * vertices - 6
    for i in range(3):
        across = faces[tri.neighbors[:, i]]
        for end in (1, 2):
            assert (across == faces[:, [(i + end) % 3]]).any(axis=1).all()
    assert np.array_equal(np.unique(edges, axis=0), edges)
    check_neighbor_lists(tri)


def check_neighbor_lists(tri):
    indptr, indices = tri.vertex_neighbor_vertices
    assert len(indptr) == tri.npoints + 1
    sources = np.repeat(np.arange(tri.npoints), np.diff(indptr))
    lists = np.column_stack([sources, indices])
    both_ways = np.concatenate([tri.edges, tri.edges[:, ::-1]])
    assert np.array_equal(lists[np.lexsort(lists.T[::-1])], np.unique(both_ways, axis=0))
    first = indices[indptr[:-1][np.diff(indptr) > 0]]
    lowest = [indices[a:b].min() for a, b in itertools.pairwise(indptr) if b > a]
    assert first.tolist() == lowest


@given(clouds.points)
def test_any_points_have_a_triangulation(points):
    for model in ("projected", "weighted"):
        tri = rondel.delaunay(points, model)
        check_surface(tri)
        report = tri.validate()
        assert report, report.reason


@given(clouds.points)
def test_the_order_of_points_does_not_matter(points):
    order = np.random.default_rng(len(points)).permutation(len(points))
    tri, other = rondel.delaunay(points), rondel.delaunay(points[order])
    assert tri.dimension == other.dimension
    rays = points / np.linalg.norm(points, axis=1, keepdims=True)
    assert np.allclose(rays[tri.simplices], rays[order][other.simplices], rtol=0, atol=1e-15)


def test_neighbors_of_a_vertex_are_counterclockwise():
    tri = rondel.delaunay(clouds.uniform(200))
    indptr, indices = tri.vertex_neighbor_vertices
    for site in range(200):
        ring = tri.points[indices[indptr[site] : indptr[site + 1]]]
        turns = np.linalg.det(
            np.stack([np.broadcast_to(tri.points[site], ring.shape), ring, np.roll(ring, -1, 0)], 1)
        )
        assert (turns > 0).all()


def test_degenerate_points():
    same = rondel.delaunay([[1, 0, 0], [2, 0, 0], [0, 1, 0]])
    assert same.duplicates.tolist() == [[1, 0]]
    assert same.dimension == 1
    assert same.edges.tolist() == [[0, 2]]
    ring = rondel.delaunay(clouds.circle(12))
    assert len(ring.simplices) in (0, 20)  # rounded sites may leave the circle
    square = rondel.delaunay([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
    assert square.dimension == 1
    assert square.vertex_neighbor_vertices.indices.tolist() == [1, 3, 0, 2, 1, 3, 0, 2]


def test_points_a_millimetre_apart():
    tri = rondel.delaunay(np.concatenate([clouds.patch(500, 1e-10), clouds.uniform(50)]))
    assert len(tri.vertices) == 550
    assert tri.validate()


def test_ghost_faces_are_those_that_the_center_does_not_see():
    tri = rondel.delaunay(clouds.patch(50, 0.1))
    volumes = np.linalg.det(tri.points[tri.simplices])
    assert tri.ghost.any()
    assert not tri.ghost.all()
    assert (volumes[~tri.ghost] > 0).all()
    assert (volumes[tri.ghost] < 1e-12).all()
    assert not rondel.delaunay(clouds.uniform(50)).ghost.any()


def test_circumcenters_are_at_the_same_distance_from_the_corners():
    tri = rondel.delaunay(clouds.uniform(300))
    cosines = np.einsum("fj,fij->fi", tri.circumcenters, tri.points[tri.simplices])
    assert np.ptp(cosines, axis=1).max() < 1e-14


def test_weighted_sites_hide_others():
    lonlat = [[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90], [5, 0]]
    tri = rondel.power_diagram(lonlat, [30, 0, 0, 0, 0, 0, 0]).delaunay
    assert tri.model == "weighted"
    assert tri.hidden[:, 0].tolist() == [6]
    face = tri.hidden[0, 1]
    assert 0 in tri.simplices[face]


def test_another_sphere():
    points = clouds.uniform(100)
    there = 3 * points + (10, 20, 30)
    tri = rondel.delaunay(there, radius=3, center=(10, 20, 30))
    assert tri.center.tolist() == [10, 20, 30]
    assert tri.radius == 3
    assert np.array_equal(tri.simplices, rondel.delaunay(points).simplices)


def test_lonlat_is_what_was_given():
    tri = rondel.delaunay_lonlat([[540, 0], [90, 45]], [[0, 90], [0, -30]])
    assert tri.lonlat.tolist() == [[540, 0], [0, 90], [90, 0], [45, -30]]
    other = rondel.delaunay(tri.points)
    assert np.allclose(other.lonlat, [[180, 0], [0, 90], [90, 0], [45, -30]])


def test_validate_refutes():
    tri = rondel.delaunay(clouds.uniform(20))
    other = rondel.delaunay(clouds.uniform(20, seed=1))
    broken = rondel.SphericalDelaunay._from_parts(tri.points, other._triangulation, 1.0)
    report = broken.validate()
    assert not report
    assert report.reason


def test_facets_of_a_cube():
    indptr, indices = rondel.delaunay(clouds.cube()).facets
    assert np.diff(indptr).tolist() == [4] * 6
    assert np.bincount(indices).tolist() == [3] * 8


def test_descriptions():
    assert repr(rondel.delaunay(clouds.cube())) == (
        "<rondel.SphericalDelaunay: 8 points, 12 faces, projected>"
    )
    assert (
        "<td style='text-align:left'>12 faces</td>" in rondel.delaunay(clouds.cube())._repr_html_()
    )
    assert repr(rondel.delaunay([[1, 0, 0], [2, 0, 0]])) == (
        "<rondel.SphericalDelaunay: 2 points, 1 duplicate, dimension 0, projected>"
    )


def imports(path):
    """The modules of the package that a module imports, also in functions and for types."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            names = [node.module] if node.module else [alias.name for alias in node.names]
            found |= {name.partition(".")[0] for name in names}
    return found


def test_modules_do_not_import_each_other_in_circles():
    package = pathlib.Path(rondel.__file__).parent
    graph = {path.stem: imports(path) for path in package.glob("*.py")}
    assert len(graph) > 15
    assert graph["_voronoi"] >= {"_delaunay", "_diagram"}
    list(graphlib.TopologicalSorter(graph).static_order())  # raises CycleError


@pytest.mark.parametrize("name", rondel.__all__)
def test_everything_public_is_documented(name):
    thing = getattr(rondel, name)
    assert thing.__doc__
    for attribute, value in vars(thing).items() if isinstance(thing, type) else ():
        if not attribute.startswith("_") and (callable(value) or isinstance(value, property)):
            assert value.__doc__, attribute
