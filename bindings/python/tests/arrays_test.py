# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What goes in and comes out: copies, types, errors."""

import decimal
import fractions
import gc
import os
import pickle
import re
import subprocess
import sys
import warnings
import weakref

import clouds
import numpy as np
import pytest

import rondel
import rondel.mesh

KEEPERS = {
    "delaunay": rondel.delaunay,
    "SphericalDelaunay": rondel.SphericalDelaunay,
    "SphericalVoronoi": rondel.SphericalVoronoi,
    "convex_hull": rondel.convex_hull,
    "ConvexHull": rondel.ConvexHull,
}


@pytest.mark.parametrize("make", KEEPERS.values(), ids=KEEPERS)
@pytest.mark.parametrize("kind", [np.array, memoryview, np.asfortranarray, np.float32])
def test_points_are_copied(make, kind):
    points = clouds.uniform(10).astype(np.float32 if kind is np.float32 else np.float64)
    if kind is not np.float32:
        points = kind(points)
    assert not np.may_share_memory(make(points, **tolerant(make)).points, np.asarray(points))


def tolerant(make):
    return {"threshold": 1e-3} if make is rondel.SphericalVoronoi else {}


@pytest.mark.parametrize("make", KEEPERS.values(), ids=KEEPERS)
def test_points_are_used_where_they_lie_if_asked_for(make):
    points = clouds.uniform(10)
    kept = make(points, copy=False).points
    assert np.shares_memory(kept, points)
    assert not kept.flags.writeable
    assert points.flags.writeable


CHANGES = {
    "moved": lambda p: np.add(p, 0.05, out=p),
    "sorted": lambda p: p.sort(axis=0),
    "nan": lambda p: p.fill(np.nan),
    "zero": lambda p: p.fill(0.0),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_what_the_caller_changes_later_changes_nothing(change):
    points = clouds.uniform(2000)
    expected = rondel.SphericalVoronoi(points.copy())
    tri, found = rondel.delaunay(points), rondel.SphericalVoronoi(points)
    hull = rondel.convex_hull(points)
    change(points)
    assert np.array_equal(found.vertices, expected.vertices)
    assert np.array_equal(found.calculate_areas(), expected.calculate_areas())
    assert np.array_equal(found.centroids, expected.centroids)
    assert found.to_geojson() == expected.to_geojson()
    queries = clouds.uniform(20, seed=3)
    assert np.array_equal(
        tri.k_nearest(queries, 5), np.argsort(-queries @ expected.points.T, axis=1)[:, :5]
    )
    assert tri.validate()
    assert 4.1 < hull.volume < 4 / 3 * np.pi


def test_points_of_a_circle_are_copied():
    points = np.array([[1.0, 0], [0, 1], [-1, 0], [0, -1]])
    kept = rondel.SphericalVoronoi(points)
    assert not np.may_share_memory(kept.points, points)
    assert np.shares_memory(rondel.SphericalVoronoi(points, copy=False).points, points)


def test_the_input_lives_as_long_as_what_was_made_of_it():
    points = clouds.uniform(10)
    alive = weakref.ref(points)
    tri = rondel.delaunay(points, copy=False)
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
    assert np.shares_memory(diagram.cells.points, diagram._diagram.points)


def test_arrays_cannot_be_written_to():
    points = 2 * clouds.uniform(10)
    tri = rondel.delaunay(points)
    for name in ("points", "simplices", "neighbors", "duplicates", "hidden", "ring", "ghost"):
        assert not getattr(tri, name).flags.writeable, name
    for name in ("lonlat", "circumcenters"):
        assert not getattr(tri, name).flags.writeable, name
    degrees = rondel.delaunay_lonlat([0, 90, 180, 10], [0, 0, 0, 80])
    assert not degrees.points.flags.writeable
    assert not degrees.lonlat.flags.writeable
    for diagram in (tri.voronoi(), rondel.SphericalVoronoi(points, 2.0)):
        for name in ("points", "areas", "centroids", "ridge_points", "ridge_vertices"):
            assert not getattr(diagram, name).flags.writeable, name
        assert not any(array.flags.writeable for array in diagram.cells)


def test_vertices_belong_to_the_user():
    diagram = rondel.SphericalVoronoi(clouds.uniform(20))
    areas = diagram.calculate_areas()
    diagram.vertices *= 6371
    assert np.allclose(np.linalg.norm(diagram.vertices, axis=1), 6371)
    assert np.allclose(np.linalg.norm(diagram.cells.points, axis=1), 1)
    assert np.array_equal(diagram.calculate_areas(), areas)


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


def test_wrong_shapes_are_named():
    tri, circle = rondel.delaunay(clouds.cube()), [[1, 0], [0, 1], [-1, 0]]
    lonlat, triangles = [[0, 0], [4, 0], [4, 3]], [[0, 1, 2]]
    for call, message in (
        (lambda: tri.conflict_region([[1, 0, 0]]), "point must have shape (3,), not (1, 3)"),
        (lambda: tri.conflict_region([10, 20]), "point must have shape (3,), not (2,)"),
        (
            lambda: rondel.power_diagram(lonlat, [[1], [2], [3]]),
            "radii_deg must have shape (3,), not (3, 1)",
        ),
        (lambda: rondel.power_diagram(lonlat, [1]), "radii_deg must have shape (3,), not (1,)"),
        (
            lambda: rondel.mesh.TriangleMesh(lonlat, triangles, depths=[[1], [2], [3]]),
            "depths must have shape (n,), not (3, 1)",
        ),
        (
            lambda: rondel.mesh.TriangleMesh(lonlat, triangles, levels=[[1, 2]]),
            "levels must have shape (n,), not (1, 2)",
        ),
        (lambda: rondel.Weights([0, 1], [0], [[1.0]], (1, 1)), "data must have shape (n,)"),
        (lambda: rondel.Weights([0, 1], [[0]], [1.0], (1, 1)), "indices must have shape (n,)"),
        (
            lambda: rondel.SphericalVoronoi(circle, center=[0, 0, 0]),
            "center must have shape (2,), not (3,)",
        ),
        (lambda: rondel.lonlat(lonlat), "points must have shape (..., 3), not (3, 2)"),
        (lambda: rondel.point_set_hash([]), "points must have shape (..., 3), not (0,)"),
        (
            lambda: rondel.CellSet.polygons([0, 1], [[0, 3]], [0, 1, 2], clouds.cube()),
            "rings must have shape (n,), not (1, 2)",
        ),
    ):
        with pytest.raises(ValueError, match=re.escape(message)):
            call()
    with pytest.raises(TypeError, match=r"shape must be two integers, not \(1.0, 1.0\)"):
        rondel.Weights([0, 1], [0], [1.0], (1.0, 1.0))


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
    assert np.array_equal(rondel.unit_vectors([0, 10], 5), rondel.unit_vectors([0, 10], [5, 5]))
    assert rondel.unit_vectors(np.zeros((3, 1)), np.zeros(4)).shape == (3, 4, 3)
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


THREADS_OF_AREAS = """
import os, pickle, sys, threading
import rondel
import rondel.mesh

def max_more_threads(diagram):
    count = lambda: len(os.listdir("/proc/self/task"))
    before, most, has_ended = count(), 0, threading.Event()
    def look():
        nonlocal most
        while not has_ended.is_set():
            most = max(most, count())
    looking = threading.Thread(target=look)
    looking.start()
    diagram.areas
    has_ended.set()
    looking.join()
    return max(most, count()) - before

built = rondel.SphericalVoronoi(pickle.load(sys.stdin.buffer), threads=1)
# One looks, and one works.
assert max_more_threads(built) <= 2
copied = pickle.loads(pickle.dumps(rondel.SphericalVoronoi(built.points, threads=1)))
print(max_more_threads(copied))
"""


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="needs Linux")
def test_what_was_built_elsewhere_uses_all_cores():
    points = clouds.uniform(200_000)
    if rondel.delaunay(points[:10]).report["threads"] == 1:
        pytest.skip("there is one core, or no threads")
    ended = subprocess.run(
        [sys.executable, "-c", THREADS_OF_AREAS], input=pickle.dumps(points), capture_output=True
    )
    assert ended.stderr == b""
    assert int(ended.stdout) > 2


def test_what_others_hold_at_the_end_is_not_said_to_be_a_leak():
    program = """
import rondel
import rondel.mesh
tri = rondel.delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
held = tri.simplices
# What a library does that keeps a reference in memory of its own.
import ctypes
ctypes.pythonapi.Py_IncRef(ctypes.py_object(held))
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")


def test_messages_name_the_right_function():
    tri = rondel.delaunay_lonlat([0, 90, 180, 270, 0], [0, 0, 0, 0, 90])
    degrees = np.array([[2.3, 48.8], [13, 52], [12, 41]])
    for call, error, message in (
        (lambda: tri.nearest(2.3, 48.8), TypeError, r"rondel.unit_vectors\(lon, lat\)"),
        (lambda: tri.nearest([2.3, 48.8]), ValueError, r"rondel.unit_vectors\(lon, lat\)"),
        (lambda: tri.k_nearest([2.3, 48.8], 2), ValueError, r"rondel.unit_vectors\(lon, lat\)"),
        (lambda: rondel.delaunay(degrees), ValueError, r"rondel.unit_vectors\(lon, lat\)"),
        (lambda: rondel.SphericalVoronoi(degrees), ValueError, "SphericalVoronoi.from_lonlat"),
        (lambda: rondel.delaunay_lonlat(["2", "3"], [1, 2]), TypeError, "lon .* numbers, not text"),
        (lambda: rondel.unit_vectors([1j], [2]), TypeError, "not complex numbers"),
    ):
        with pytest.raises(error, match=message):
            call()


def test_geometries_are_no_numbers():
    shapely = pytest.importorskip("shapely")
    points = [shapely.Point(1, 2), shapely.Point(3, 4)]
    with pytest.raises(TypeError, match="lon must be real numbers"):
        rondel.delaunay_lonlat(points, [1, 2])
    geopandas = pytest.importorskip("geopandas")
    with pytest.raises(TypeError, match="lon must be real numbers, not geometries"):
        rondel.delaunay_lonlat(geopandas.GeoSeries(points), [1, 2])


def test_tables_are_rows_of_numbers():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame(np.eye(3), columns=list("xyz"))
    assert rondel.delaunay(table).npoints == 3


def test_errors_about_no_array_have_no_index():
    tri = rondel.delaunay(clouds.uniform(20))
    with pytest.raises(rondel.InvalidInput, match="angle -1 is negative") as caught:
        tri.within([0, 0, 1], -1)
    assert caught.value.index is None
    assert rondel.InvalidInput("wrong").index is None
    with pytest.raises(rondel.InvalidInput, match="not finite") as caught:
        tri.nearest([[0, 0, 1], [0, 0, np.nan]])
    assert caught.value.index == 1


def test_targets_are_called_targets():
    lon, lat = [0, 90, 180, 270, 0], [0, 0, 0, 0, 90]
    tri = rondel.delaunay_lonlat(lon, lat)
    values = np.arange(5.0)
    far = np.zeros(20)
    far[17] = 91
    for call in (
        lambda: tri.interpolate_winds(values, values, np.zeros(20), far),
        lambda: rondel.SphericalInterpolator((lon, lat), values)(np.zeros(20), far),
        lambda: rondel.SphericalInterpolator((lon, lat), values)(np.stack([far, far], axis=-1)),
        lambda: rondel.interpolate(lon, lat, values, np.zeros(20), far),
    ):
        with pytest.raises(
            rondel.InvalidInput, match=r"^target 17: latitude 91 is outside"
        ) as caught:
            call()
        assert caught.value.index == 17
    with pytest.raises(rondel.InvalidInput, match=r"^site 4: latitude 90.5 is outside"):
        rondel.interpolate(lon, [0, 0, 0, 0, 90.5], values, 0, 0)


def test_errors_of_files_have_the_number_of_the_system(tmp_path):
    lost = tmp_path / "lost" / "w.nc"
    with pytest.raises(FileNotFoundError) as caught:
        rondel.read_weights(lost)
    assert (caught.value.errno, caught.value.filename) == (2, str(lost))
    folder = tmp_path / "folder.nc"
    folder.mkdir()
    with pytest.raises(IsADirectoryError):
        rondel.read_weights(folder)
    empty = tmp_path / "empty.nc"
    empty.write_bytes(b"")
    with pytest.raises(OSError, match="empty") as caught:
        rondel.read_weights(empty)
    assert caught.value.errno is None


def test_completion_shows_what_is_for_users():
    import rondel.distributed
    import rondel.mesh
    import rondel.out_of_core

    assert {"delaunay", "mesh", "distributed", "__version__"} < set(dir(rondel))
    for module in (rondel, rondel.mesh, rondel.distributed, rondel.out_of_core):
        names = dir(module)
        assert set(module.__all__) <= set(names)
        assert not {"np", "Any", "TYPE_CHECKING", "annotations", "as_floats", "Path"} & set(names)
        assert all(hasattr(module, name) for name in names)


def test_integers_that_no_double_equals_are_refused():
    lon, lat = [0, 90, 180, 0], [0, 0, 0, 90]
    tri = rondel.delaunay_lonlat(lon, lat)
    there = rondel.unit_vectors(lon, lat)
    exact = np.array([0, 2**53, -(2**60), 2**53 + 2])
    assert np.array_equal(tri.interpolate(exact, there, "nearest"), exact)
    for values in (
        np.array([0, 1, 2, 2**53 + 1]),
        np.array([0, 1, 2, 2**64 - 1], np.uint64),
        [0, 1, 2, -(2**53) - 1],
    ):
        with pytest.raises(rondel.InvalidInput, match="no double") as caught:
            tri.interpolate(values, there, "nearest")
        assert caught.value.index == 3


def objects(*values):
    return np.array(values, object)


TEXTS = {
    "text": lambda _: objects(1, 2, 3, "5"),
    "with underscores": lambda _: objects("1_0", 2, 3, 4),
    "bytes": lambda _: objects(1, b"1", 2, 3),
    "missing beside": lambda _: objects(1, None, "2", np.nan),
    "masked": lambda _: np.ma.array(objects(1, 2, 3, "5"), mask=[1, 0, 0, 0]),
    "masked texts": lambda _: np.ma.array(["1", "2", "3", "4"], mask=[1, 0, 0, 0]),
    "categories": lambda pandas: pandas.Categorical(["1", "2", "1", "2"]),
    "column": lambda pandas: pandas.Series(["1", "2", "3", "4"], dtype=object),
    "texts of pandas": lambda pandas: pandas.array(["1", "2", None, "4"], dtype="string"),
}


@pytest.mark.parametrize("case", TEXTS)
def test_texts_in_arrays_of_objects_are_no_numbers(case):
    values = TEXTS[case](pytest.importorskip("pandas"))
    words = "real numbers, not (text|bytes)"
    lon, lat = [0, 90, 180, 0], [0, 0, 0, 90]
    tri = rondel.delaunay_lonlat(lon, lat)
    there = rondel.unit_vectors(lon, lat)
    with pytest.raises(TypeError, match=f"values must be {words}"):
        tri.interpolate(values, there, "nearest")
    with pytest.raises(TypeError, match=f"values must be {words}"):
        tri.weights(there, "nearest").apply(values)
    if np.ma.isMaskedArray(values):
        return  # is refused as coordinates for its mask
    with pytest.raises(TypeError, match=f"lat must be {words}"):
        rondel.unit_vectors(lon, values)
    with pytest.raises(TypeError, match=f"lon must be {words}"):
        rondel.delaunay_lonlat(values, lat)


def test_numbers_in_arrays_of_objects_are_numbers():
    pandas = pytest.importorskip("pandas")
    lon, lat = [0, 90, 180, 0], [0, 0, 0, 90]
    tri = rondel.delaunay_lonlat(objects(0, 90.0, np.int16(180), False), lat)
    there = rondel.unit_vectors(lon, lat)
    values = objects(fractions.Fraction(1, 2), None, pandas.NA, decimal.Decimal("0.25"))
    found = tri.interpolate(values, there, "nearest")
    assert np.array_equal(found, [0.5, np.nan, np.nan, 0.25], equal_nan=True)


def test_the_degrees_of_points_do_not_depend_on_where_they_are_in_memory():
    points = clouds.uniform(1000)
    one = np.array([rondel.lonlat(point) for point in points])
    wide = np.zeros((1000, 4))
    wide[:, 1:] = points
    for same in (points, np.asfortranarray(points), wide[:, 1:], wide[:, :0:-1][:, ::-1]):
        assert rondel.lonlat(same).tobytes() == one.tobytes()


def test_lonlat_refuses_points_without_direction():
    assert np.isnan(rondel.lonlat([np.nan, 0, 1])).any()
    with pytest.raises(rondel.InvalidInput, match="point 1 is the center") as caught:
        rondel.lonlat([[1, 0, 0], [0, 0, 0]])
    assert caught.value.index == 1
    with pytest.raises(rondel.InvalidInput, match="the center"):
        rondel.lonlat([1, 2, 3], center=[1, 2, 3])
    with pytest.raises(rondel.InvalidInput, match="point 0 is infinite"):
        rondel.lonlat([np.inf, 0, 0])


@pytest.mark.parametrize("radius", [-1, 0, np.nan])
def test_a_radius_is_positive(radius):
    points = np.eye(3)
    for make in (rondel.delaunay, rondel.DynamicTriangulation):
        with pytest.raises(rondel.InvalidInput, match="radius must be positive"):
            make(points, radius=radius)


def test_infinite_numbers_are_refused_or_told(tmp_path):
    lon, lat = [0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90]
    tri = rondel.delaunay_lonlat(lon, lat)
    values = [1, 2, np.inf, np.nan, 5, 6]
    for call in (
        lambda: tri.interpolate(values, [[1, 1, 1]], "linear"),
        lambda: tri.gradient(values),
        lambda: rondel.interpolate(lon, lat, [values, values], 10, 10, "nearest"),
        lambda: tri.save_html(tmp_path / "page.html", values),
        lambda: tri.isolines(values, [0]),
    ):
        with pytest.raises(rondel.InvalidInput, match="2") as caught:
            call()
        assert caught.value.index == 2
    assert not list(tmp_path.iterdir())
    for given in (values, np.array(values), np.ma.masked_invalid([1, 2, 3, np.nan, 5, 6])):
        is_told = not np.ma.isMaskedArray(given)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            cells = tri.voronoi().to_geojson(properties={"v": given})
        assert len(caught) == is_told
        assert cells["features"][3]["properties"]["v"] is None


def test_options_without_effect_are_refused(tmp_path):
    tri = rondel.delaunay_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
    with pytest.raises(ValueError, match="rings are of the methods"):
        tri.interpolate(np.arange(6), [[1, 1, 1]], "linear", rings=7)
    with pytest.raises(ValueError, match="rings are of the methods"):
        tri.weights([[1, 1, 1]], rings=3)
    assert tri.interpolate(np.arange(6), [[1, 1, 1]], "hermite", rings=3).shape == (1,)
    weights = tri.weights([[1, 1, 1]], "linear")
    with pytest.raises(ValueError, match="max_missing has no effect without skipna"):
        weights.apply(np.arange(6), max_missing=0.5)
    with pytest.raises(ValueError, match="view must be"):
        tri.save_html(tmp_path / "page.html", view=(0, 99))
    with pytest.raises(TypeError, match="k must be an integer, not float"):
        tri.k_nearest([1, 0, 0], 2.5)
    with pytest.raises(rondel.InvalidInput, match="level 1, 1, is not above the one before it, 3"):
        tri.isolines(np.arange(6), [3, 1])


def test_integers_beside_missing_values_are_not_rounded():
    pandas = pytest.importorskip("pandas")
    wide = 2**53 + 1
    tri = rondel.delaunay(clouds.uniform(6))
    for values in (
        [wide, None, 1, 1, 1, 1],
        [wide, 0.5, 1, 1, 1, 1],
        np.array([wide, None, 1, 1, 1, 1], object),
        np.ma.array([wide, 1, 1, 1, 1, 1], mask=[0, 1, 0, 0, 0, 0]),
        [wide, np.ma.masked, 1, 1, 1, 1],
        pandas.array([wide, None, 1, 1, 1, 1], dtype="Int64"),
        pandas.Series([wide, None, 1, 1, 1, 1], dtype="Int64"),
    ):
        with pytest.raises(
            rondel.InvalidInput, match=f"values have the integer {wide}, which"
        ) as e:
            tri.interpolate(values, tri.points, "nearest")
        assert e.value.index == 0
    for values in ([wide - 1, None, 1, 1, 1, 1], [1e300, None, 2.5, 1, 1, 2**70]):
        found = tri.interpolate(values, tri.points, "nearest")
        assert found[0] == values[0]
        assert np.isnan(found[1])
