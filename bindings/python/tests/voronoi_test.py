# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Voronoi and power diagrams."""

import itertools

import clouds
import numpy as np
import pytest
from hypothesis import given

import rondel


def as_corners(diagram):
    """The corners of each cell as sets of rounded coordinates."""
    return [
        {tuple(corner) for corner in np.round(diagram.vertices[region], 9) + 0.0}
        for region in diagram.regions
    ]


def test_the_diagram_is_that_of_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    for count, radius, center in ((8, 1, (0, 0, 0)), (500, 2.5, (1, 2, 3))):
        points = radius * clouds.uniform(count) + center
        theirs = spatial.SphericalVoronoi(points, radius, center)
        ours = rondel.SphericalVoronoi(points, radius, center)
        theirs.sort_vertices_of_regions()
        ours.sort_vertices_of_regions()
        assert as_corners(ours) == as_corners(theirs)
        assert np.allclose(ours.calculate_areas(), theirs.calculate_areas(), rtol=1e-9)
        assert ours._simplices.shape == theirs._simplices.shape


@given(clouds.points)
def test_the_cells_of_any_points_cover_the_sphere(points):
    diagram = rondel.SphericalVoronoi(points, threshold=np.inf, duplicates="merge")
    if len(points):
        assert abs(diagram.areas.sum() - 4 * np.pi) < 1e-9
    offsets, rings, corners = diagram.cells
    assert len(offsets) == len(points) + 1
    assert rings.max(initial=-1) < len(corners)
    assert np.allclose(np.linalg.norm(corners, axis=1), 1, atol=1e-14)
    assert (np.diff(offsets)[diagram.duplicates[:, 0]] == 0).all()
    assert len(diagram.regions) == len(points)


def test_regions_are_counterclockwise():
    diagram = rondel.SphericalVoronoi(clouds.uniform(100))
    for site, region in enumerate(diagram.regions):
        corners = diagram.vertices[region]
        turns = np.cross(corners, np.roll(corners, -1, 0)) @ diagram.points[site]
        assert (turns > 0).all()


# What SciPy refuses, or gets wrong.


def test_duplicates_are_named_or_merged():
    points = np.concatenate([clouds.uniform(20), clouds.uniform(3)])
    with pytest.raises(rondel.InvalidInput, match="Duplicate generators present") as caught:
        rondel.SphericalVoronoi(points)
    assert caught.value.index == 20
    merged = rondel.SphericalVoronoi(points, duplicates="merge")
    assert merged.duplicates.tolist() == [[20, 0], [21, 1], [22, 2]]
    assert merged.regions[20:] == [[], [], []]
    assert np.array_equal(merged.areas[:20], rondel.SphericalVoronoi(points[:20]).areas)


def test_three_sites():
    diagram = rondel.SphericalVoronoi(np.eye(3))
    assert diagram._simplices.shape == (2, 3)
    assert [sorted(region) for region in diagram.regions] == [[0, 1]] * 3
    assert np.allclose(diagram.areas, 4 * np.pi / 3)


def test_sites_of_a_great_circle():
    diagram = rondel.SphericalVoronoi(np.concatenate([np.eye(3)[:2], -np.eye(3)[:2]]))
    assert np.allclose(diagram.areas, np.pi)
    assert {tuple(p) for p in diagram.vertices[diagram.regions[0]]} >= {(0, 0, 1), (0, 0, -1)}


def test_one_and_two_sites():
    one = rondel.SphericalVoronoi([[0, 0, 1]])
    assert np.allclose(one.areas, 4 * np.pi)
    assert one.regions == [[]]
    two = rondel.SphericalVoronoi([[0, 0, 1], [0, 0, -1]])
    assert np.allclose(two.areas, 2 * np.pi)
    assert np.abs(two.vertices[two.regions[0]][:, 2]).max() < 1e-15


def test_a_dense_patch():
    points = np.concatenate([clouds.patch(1000, 1e-7), clouds.uniform(100)])
    diagram = rondel.SphericalVoronoi(points)
    assert abs(diagram.areas.sum() - 4 * np.pi) < 1e-12
    inner = np.sort(diagram.areas)[:500]
    assert (inner > 0).all()
    assert inner.max() < 1e-15


def test_a_hemisphere():
    points = clouds.uniform(50)
    points[:, 2] = np.abs(points[:, 2])
    diagram = rondel.SphericalVoronoi(points)
    assert abs(diagram.areas.sum() - 4 * np.pi) < 1e-12
    assert (diagram.vertices[:, 2] < 0).any()


def test_points_off_the_sphere_are_refused_unless_asked_for():
    points = 1.5 * clouds.uniform(20)
    with pytest.raises(ValueError, match="Radius inconsistent"):
        rondel.SphericalVoronoi(points)
    assert rondel.SphericalVoronoi(points, threshold=np.inf).vertices.shape == (36, 3)


def test_points_on_a_circle():
    angles = np.radians([0, 90, 120, 250])
    points = np.column_stack([np.cos(angles), np.sin(angles)])
    for order in ([0, 1, 2, 3], [3, 1, 0, 2]):
        diagram = rondel.SphericalVoronoi(points[order])
        assert np.allclose(
            np.degrees(diagram.calculate_areas()), np.array([100, 60, 80, 120])[order]
        )
        for site, (a, b) in enumerate(diagram.regions):
            ends = diagram.vertices[[a, b]] @ diagram.points[site]
            others = diagram.vertices[[a, b]] @ diagram.points.T
            assert np.allclose(ends, others.max(axis=1))
    with pytest.raises(TypeError, match="three-dimensional"):
        diagram.sort_vertices_of_regions()
    with pytest.raises(TypeError, match="three-dimensional"):
        _ = diagram.cells
    assert repr(diagram) == "<rondel.SphericalVoronoi: 4 points, 2 dimensions>"


def test_cells_of_degrees():
    diagram = rondel.SphericalVoronoi.from_lonlat(
        [0, 90, 180, -90, 0, 0, 0], [0, 0, 0, 0, 90, -90, 0]
    )
    assert diagram.duplicates.tolist() == [[6, 0]]
    assert np.allclose(diagram.areas[:6], 4 * np.pi / 6)
    with pytest.raises(rondel.InvalidInput):
        rondel.SphericalVoronoi.from_lonlat([0, 0], [0, 0], duplicates="raise")


def test_relaxation_moves_sites_to_centroids():
    sites = clouds.uniform(40)
    for _ in range(60):
        sites = rondel.SphericalVoronoi(sites).centroids
    areas = rondel.SphericalVoronoi(sites).areas
    assert areas.max() / areas.min() < 1.5
    apart = rondel.SphericalVoronoi(2 * sites + 1, 2, (1, 1, 1)).centroids
    assert np.allclose(np.linalg.norm(apart - 1, axis=1), 2)


def test_the_dual_of_a_triangulation_is_not_built_again():
    tri = rondel.delaunay(clouds.uniform(30))
    diagram = tri.voronoi()
    assert diagram.delaunay is tri
    assert np.array_equal(diagram.vertices, tri.circumcenters)


def test_power_cells():
    centers, radii = clouds.uniform(60), np.random.default_rng(5).uniform(0, 20, 60)
    diagram = rondel.power_diagram(centers, radii)
    assert isinstance(diagram, rondel.PowerDiagram)
    assert abs(diagram.areas.sum() - 4 * np.pi) < 1e-12
    assert (diagram.areas[diagram.hidden[:, 0]] == 0).all()
    queries = clouds.uniform(500, seed=9)
    power = queries @ centers.T / np.cos(np.radians(radii))
    assert np.array_equal(diagram.delaunay.nearest(queries), power.argmax(axis=1))
    points = rondel.power_diagram(centers, 0.0)
    assert np.allclose(points.areas, rondel.SphericalVoronoi(centers).areas, rtol=1e-13)
    with pytest.raises(rondel.InvalidInput, match="radius") as caught:
        rondel.power_diagram(centers[:3], [1, 2, 90])
    assert caught.value.index == 2


def test_ridges_are_borders_between_neighbors():
    diagram = rondel.SphericalVoronoi(clouds.uniform(100))
    assert np.array_equal(diagram.ridge_points, diagram.delaunay.edges)
    assert np.array_equal(diagram.cells.points, diagram.vertices)
    a, b = (diagram.vertices[diagram.ridge_vertices[:, k]] for k in (0, 1))
    for end in (a, b):
        near = np.einsum("rj,rij->ri", end, diagram.points[diagram.ridge_points])
        assert np.allclose(near, (end @ diagram.points.T).max(axis=1)[:, None])
    first = diagram.points[diagram.ridge_points[:, 0]]
    assert (np.einsum("rj,rj->r", np.cross(a, b), first) > 0).all()


@given(clouds.points)
def test_ridges_of_any_points_are_all_borders(points):
    diagram = rondel.SphericalVoronoi(points, threshold=np.inf, duplicates="merge")
    offsets, rings, _ = diagram.cells
    sides = set()
    for site, (begin, end) in enumerate(itertools.pairwise(offsets)):
        ring = rings[begin:end].tolist()
        sides |= {(site, p, q) for p, q in zip(ring, ring[1:] + ring[:1], strict=True)}
    (left, right), (p, q) = diagram.ridge_points.T.tolist(), diagram.ridge_vertices.T.tolist()
    assert set(zip(left, p, q, strict=True)) | set(zip(right, q, p, strict=True)) == sides
    assert 2 * len(diagram.ridge_points) == len(sides)
    assert (diagram.ridge_points[:, 0] < diagram.ridge_points[:, 1]).all()
    edges = np.unique(diagram.ridge_points, axis=0)
    assert np.array_equal(edges, diagram.delaunay.edges.reshape(-1, 2))


def test_ridges_have_lengths_below_half_a_turn():
    points = clouds.uniform(50)
    points[:, 2] = np.abs(points[:, 2])
    for diagram in (rondel.SphericalVoronoi(points), rondel.SphericalVoronoi(np.eye(3))):
        a, b = (diagram.cells.points[diagram.ridge_vertices[:, k]] for k in (0, 1))
        length = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b))
        assert length.max() <= np.radians(120) + 1e-12
    assert abs(length.sum() - 3 * np.pi) < 1e-12  # of three lunes


def test_corners_and_neighbors_alternate_around_a_cell():
    for points in (clouds.uniform(100), clouds.patch(60, 0.2), clouds.cube()):
        diagram = rondel.SphericalVoronoi(points)
        indptr, indices = diagram.delaunay.vertex_neighbor_vertices
        faces = [set(face) for face in diagram.delaunay.simplices.tolist()]
        for site, region in enumerate(diagram.regions):
            neighbors = indices[indptr[site] : indptr[site + 1]].tolist()
            between = [{site, neighbors[k - 1], neighbors[k]} for k in range(len(neighbors))]
            first = between.index(faces[region[0]])
            assert [faces[k] for k in region] == between[first:] + between[:first]
