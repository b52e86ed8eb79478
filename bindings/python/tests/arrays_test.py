# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What goes in and comes out: copies, types, errors."""

import gc
import weakref

import clouds
import numpy as np
import pytest

import rondel


def test_a_contiguous_array_is_not_copied():
    points = clouds.uniform(10)
    assert rondel.delaunay(points).points is points
    assert rondel.SphericalVoronoi(points).points is points
    assert rondel.convex_hull(points).points is points


def test_the_input_lives_as_long_as_what_was_made_of_it():
    points = clouds.uniform(10)
    alive = weakref.ref(points)
    tri = rondel.delaunay(points)
    locator = tri._locator()
    del points
    gc.collect()
    assert alive() is not None
    del tri
    gc.collect()
    assert locator.nearest(clouds.uniform(3), 1).shape == (3,)
    assert alive() is not None
    del locator
    gc.collect()
    assert alive() is None


def test_results_live_longer_than_the_object():
    tri = rondel.delaunay(clouds.uniform(1000))
    faces, cells = tri.simplices, tri.voronoi().cells
    total, corners = faces.sum(), cells.points.sum()
    del tri
    gc.collect()
    assert faces.sum() == total
    assert cells.points.sum() == corners


def test_results_are_views_of_the_library_s_arrays():
    tri = rondel.delaunay(clouds.uniform(100))
    assert np.shares_memory(tri.simplices, tri.simplices)
    assert np.shares_memory(tri.neighbors, tri.neighbors)
    diagram = tri.voronoi()
    assert np.shares_memory(diagram.vertices, diagram.cells.points)
    assert np.shares_memory(diagram.cells.points, diagram._diagram.points)


def test_arrays_of_a_triangulation_cannot_be_written_to():
    tri = rondel.delaunay(clouds.uniform(10))
    for array in (tri.simplices, tri.neighbors, tri.duplicates, tri.hidden, tri.ring, tri.ghost):
        assert not array.flags.writeable


def test_types_and_shapes():
    tri = rondel.delaunay(clouds.uniform(10))
    assert tri.simplices.dtype == np.int32
    assert tri.simplices.shape == tri.neighbors.shape == (16, 3)
    assert tri.duplicates.shape == tri.hidden.shape == (0, 2)
    assert tri.edges.shape == (24, 2)
    assert tri.vertex_neighbor_vertices.indptr.dtype == np.int64


@pytest.mark.parametrize(
    "convert",
    [
        lambda p: p.tolist(),
        np.asfortranarray,
        lambda p: np.repeat(p, 2, axis=0)[::2],
        lambda p: p.astype(">f8"),
        lambda p: p.astype(object),
        memoryview,
        lambda p: np.frombuffer(b"x" + p.tobytes(), np.uint8)[1:].view(np.float64).reshape(p.shape),
    ],
)
def test_whatever_else_holds_numbers_is_converted(convert):
    points = clouds.uniform(20)
    expected = rondel.delaunay(points)
    found = rondel.delaunay(convert(points))
    assert np.array_equal(found.points, points)
    assert np.array_equal(found.simplices, expected.simplices)


def test_integers_are_numbers():
    assert len(rondel.delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]).simplices) == 4


@pytest.mark.parametrize("points", [[], np.zeros((0, 3))])
def test_no_points(points):
    tri = rondel.delaunay(points)
    assert (tri.dimension, tri.npoints, len(tri.edges)) == (-1, 0, 0)
    assert tri.nearest([0, 0, 1]) == -1
    assert tri.k_nearest([[0, 0, 1]], 2).tolist() == [[-1, -1]]
    assert tri.voronoi().regions == []
    assert tri.validate()
    assert rondel.convex_hull(points).volume == 0


@pytest.mark.parametrize("shape", [(3,), (4, 2), (4, 4), (2, 2, 3), ()])
def test_wrong_shapes(shape):
    with pytest.raises(ValueError, match="shape"):
        rondel.delaunay(np.ones(shape))


@pytest.mark.parametrize("values", [[["a", "b", "c"]], [[1j, 0, 0]], np.zeros((1, 3), "M8[s]")])
def test_wrong_types(values):
    with pytest.raises(TypeError, match="real numbers"):
        rondel.delaunay(values)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@pytest.mark.parametrize("make", [rondel.delaunay, rondel.convex_hull, rondel.SphericalVoronoi])
def test_an_error_names_the_index(make, bad):
    points = clouds.uniform(10)
    points[7, 1] = bad
    with pytest.raises(ValueError, match="site 7") as caught:
        make(points)
    assert isinstance(caught.value, rondel.InvalidInput)
    assert caught.value.index == 7


def test_masked_points_are_refused():
    points = np.ma.array(clouds.uniform(5), mask=np.zeros((5, 3), bool))
    assert rondel.delaunay(points).npoints == 5
    points[3, 2] = np.ma.masked
    with pytest.raises(rondel.InvalidInput, match="masked") as caught:
        rondel.delaunay(points)
    assert caught.value.index == 3


def test_the_center_is_no_site_and_no_query():
    with pytest.raises(rondel.InvalidInput, match="site 1"):
        rondel.delaunay([[1, 0, 0], [0, 0, 0]])
    with pytest.raises(rondel.InvalidInput, match="query 2"):
        rondel.delaunay(clouds.cube()).nearest([[1, 0, 0], [0, 1, 0], [0, 0, 0]])


def test_latitudes_have_an_end():
    with pytest.raises(rondel.InvalidInput, match="latitude") as caught:
        rondel.delaunay_lonlat([0, 0, 0], [0, 90, 90.5])
    assert caught.value.index == 2
    with pytest.raises(ValueError, match="differ in shape"):
        rondel.delaunay_lonlat([0, 0, 0], [0, 90])


@pytest.mark.parametrize(
    "options", [{"threads": 0}, {"model": "flat"}, {"center": [0, 0]}, {"radius": -0.0}]
)
def test_options_are_checked(options):
    with pytest.raises(ValueError):  # noqa: PT011 - each has words of its own
        rondel.delaunay(clouds.cube(), **options)


def test_degrees_and_unit_vectors():
    assert rondel.unit_vectors([0, 90, 180, 7], [0, 0, 0, 90]).tolist() == [
        [1, 0, 0],
        [0, 1, 0],
        [-1, 0, 0],
        [0, 0, 1],
    ]
    lon, lat = np.meshgrid(np.linspace(-179, 179, 9), np.linspace(-89, 89, 5))
    there = rondel.unit_vectors(lon, lat)
    assert there.shape == (5, 9, 3)
    back = rondel.lonlat(2 * there + (1, 2, 3), center=(1, 2, 3))
    assert np.allclose(back, np.stack([lon, lat], axis=-1), atol=1e-12)


def test_the_number_of_threads_changes_nothing():
    points = clouds.uniform(5000)
    one, two = (rondel.delaunay(points, threads=t) for t in (1, 2))
    assert np.array_equal(one.simplices, two.simplices)
    assert one.report["threads"] == 1
