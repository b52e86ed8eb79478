# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""`rondel.constrained_delaunay`, beside exact arithmetic on integers."""

import itertools
import math
import pathlib
import pickle

import geopandas
import numpy as np
import pytest
import shapely

import rondel
from rondel import _core

DATA = pathlib.Path(__file__).resolve().parents[3] / "data"
SQUARE = [[0, 1], [1, 2], [2, 3], [3, 0]]


# ---- Exact integers: all points have the same distance from the center, so that no root is needed.


def lattice(squared_radius):
    """All integer points at this squared distance; many of them are cocircular."""
    size = math.isqrt(squared_radius)
    span = range(-size, size + 1)
    return [p for p in itertools.product(span, span, span) if dot(p, p) == squared_radius]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def volume(a, b, c):
    return dot(cross(a, b), c)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b, strict=True))


def is_above(a, b, c, p):
    """1 if p is above the plane of a, b, c, 0 if it is in it."""
    value = volume(minus(b, a), minus(c, a), minus(p, a))
    return (value > 0) - (value < 0)


def is_within(a, b, x):
    """Whether x is in the inside of the arc."""
    normal = cross(a, b)
    return dot(normal, x) == 0 and is_in_front(a, b, x)


def is_in_front(a, b, x):
    normal = cross(a, b)
    return dot(cross(a, x), normal) > 0 and dot(cross(x, b), normal) > 0


def do_cross(a, b, c, d):
    """Whether two arcs cross in the inside of both."""
    x = cross(cross(a, b), cross(c, d))
    return any(is_in_front(a, b, y) and is_in_front(c, d, y) for y in (x, minus((0, 0, 0), x)))


def random_case(seed, count, tries):
    """Integer points and constraints between them that do not cross."""
    random = np.random.default_rng(seed)
    every = lattice([101, 146, 194, 326, 2501][seed % 5])
    if seed % 3 == 0:  # of one hemisphere
        every = [p for p in every if p[0] + 2 * p[1] + 3 * p[2] > 0]
    points = [every[k] for k in random.permutation(len(every))[:count]]
    constraints = []
    for a, b in random.integers(0, len(points), (tries, 2)).tolist():
        p, q = points[a], points[b]
        if not any(cross(p, q)):
            continue
        chain = sorted(
            (dot(p, points[v]), v) for v in range(len(points)) if is_within(p, q, points[v])
        )
        # Angles grow as cosines fall, for points at one distance.
        sites = [a, *(v for _, v in reversed(chain)), b]
        pieces = list(itertools.pairwise(sites))
        others = [piece for _, known in constraints for piece in known]
        if not any(
            do_cross(points[c], points[d], points[e], points[f])
            for (c, d), (e, f) in itertools.product(pieces, others)
        ):
            constraints.append(((a, b), pieces))
    return points, constraints


def require_constrained_delaunay(points, constraints, tri):
    """The conditions that determine the triangulation, up to ties."""
    faces = [tuple(face) for face in tri.simplices[~tri.ghost].tolist()]
    assert all(volume(*(points[k] for k in face)) > 0 for face in faces)
    apex = {}
    for face in faces:
        for i in range(3):
            side = face[i], face[(i + 1) % 3]
            assert side not in apex
            apex[side] = face[(i + 2) % 3]
    plain = rondel.delaunay(np.array(points, float))
    border = {(a, b) for a, b in apex if (b, a) not in apex}
    assert border == border_of(plain.simplices[~plain.ghost].tolist())
    assert len(faces) == np.count_nonzero(~plain.ghost)
    edges = {tuple(sorted(piece)) for _, pieces in constraints for piece in pieces}
    assert edges == {tuple(edge) for edge in tri.constrained_edges.tolist()}
    assert edges <= {tuple(sorted(side)) for side in apex}
    for (a, b), third in apex.items():
        if (b, a) in apex and tuple(sorted((a, b))) not in edges:
            corners = [points[k] for k in (a, b, third)]
            assert is_above(*corners, points[apex[b, a]]) <= 0


def border_of(faces):
    sides = {(face[i], face[(i + 1) % 3]) for face in faces for i in range(3)}
    return {(a, b) for a, b in sides if (b, a) not in sides}


@pytest.mark.parametrize("seed", range(40))
def test_integers_prove_the_result(seed):
    points, constraints = random_case(seed, 8 + seed % 40, 30)
    edges = [ends for ends, _ in constraints]
    tri = rondel.constrained_delaunay(np.array(points, float), edges)
    if tri.dimension < 2:
        return
    require_constrained_delaunay(points, constraints, tri)
    assert rondel.check_constrained(points, edges, tri.simplices)
    sources = [set() for _ in tri.constrained_edges]
    rows = {tuple(edge): k for k, edge in enumerate(tri.constrained_edges.tolist())}
    for k, (_, pieces) in enumerate(constraints):
        for piece in pieces:
            sources[rows[tuple(sorted(piece))]].add(k)
    found = np.split(tri.sources.indices, tri.sources.indptr[1:-1])
    assert [set(row.tolist()) for row in found] == sources


@pytest.mark.parametrize("seed", range(20))
def test_orders_and_threads_do_not_matter(seed):
    points, constraints = random_case(seed, 30, 40)
    edges = np.array([ends for ends, _ in constraints]).reshape(-1, 2)
    tri = rondel.constrained_delaunay(points, edges, threads=1)
    random = np.random.default_rng(seed)
    order = random.permutation(len(points))
    place = np.argsort(order)
    mixed = place[edges][random.permutation(len(edges))]
    mixed[::2] = mixed[::2, ::-1]
    other = rondel.constrained_delaunay(np.array(points)[order], mixed, threads=2)
    # Faces begin with the corner that is first in the spatial order, so that rows are equal.
    assert np.array_equal(order[other.simplices], tri.simplices)
    assert np.array_equal(other.ghost, tri.ghost)
    assert np.array_equal(other.sides, tri.sides)
    assert np.array_equal(
        np.unique(np.sort(order[other.constrained_edges]), axis=0),
        tri.constrained_edges.reshape(-1, 2),
    )


def test_without_constraints_it_is_the_delaunay_triangulation():
    points = np.random.default_rng(1).normal(size=(500, 3))
    plain = rondel.delaunay(points)
    tri = rondel.constrained_delaunay(points)
    assert np.array_equal(tri.simplices, plain.simplices)
    assert np.array_equal(tri.edges, plain.edges)
    assert tri.constrained_edges.shape == tri.constraints.shape == (0, 2)
    assert not tri.sides.any()
    assert not tri.inside.any()
    assert tri.validate()
    everything = rondel.constrained_delaunay(points, plain.edges)
    assert np.array_equal(everything.simplices, plain.simplices)
    assert everything.sides.all()


def test_arrays_are_read_only_and_say_the_same():
    points = rondel.unit_vectors([0, 10, 10, 0, 5, 5], [0, 0, 10, 10, 5, 20])
    tri = rondel.constrained_delaunay(points, SQUARE)
    for name in ("points", "simplices", "constraints", "constrained_edges", "sides", "inside"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(tri, name)[...] = 0
    rows = {tuple(edge) for edge in tri.constrained_edges.tolist()}
    for face, sides in zip(tri.simplices.tolist(), tri.sides.tolist(), strict=True):
        for i in range(3):
            ends = tuple(sorted((face[(i + 1) % 3], face[(i + 2) % 3])))
            assert sides[i] == (ends in rows)
    assert np.array_equal(tri.constraints, SQUARE)
    assert tri.geometries is None
    assert tri.num_added == 0
    assert tri.simplices[tri.inside].min(axis=1).max() <= 3
    assert tri.inside.sum() == 4
    points[0] = np.nan  # a copy is kept
    assert np.isfinite(tri.points).all()


def test_edges_that_solid_and_ghost_faces_have_are_there_once():
    points = rondel.unit_vectors([0, 10, 10, 0], [0, 0, 10, 10])
    for diagonal in ([0, 2], [1, 3]):
        tri = rondel.constrained_delaunay(points, [diagonal])
        assert tri.edges.tolist() == np.unique(tri.edges, axis=0).tolist()
        assert diagonal in tri.edges.tolist()
        assert pickle.loads(pickle.dumps(tri)).validate()


def test_polygons_by_positions_of_constraints():
    lon, lat = np.array([[0, 0], [9, 0], [9, 9], [0, 9], [3, 3], [6, 3], [6, 6], [3, 6]]).T
    outer, hole = SQUARE, [[4, 7], [7, 6], [6, 5], [5, 4]]
    tri = rondel.constrained_delaunay(rondel.unit_vectors(lon, lat), [*outer, *hole])
    ring, disk = (tri.faces_inside([rows]) for rows in ([*range(8)], np.arange(4, dtype=np.uint8)))
    assert len(ring.indices) == 8
    assert len(disk.indices) == 10
    assert np.array_equal(tri.faces_inside().indices, ring.indices)
    both = tri.faces_inside([[*range(8)], [*range(4)], []])
    assert both.indptr.tolist() == [0, 8, 18, 18]
    again = tri.faces_inside(rondel.Lists([0, 8, 12, 12], [*range(8), *range(4)]))
    assert np.array_equal(again.indices, both.indices)
    assert tri.faces_inside([]).indptr.tolist() == [0]
    for wrong, reason in (
        ([4, 5], "close no ring"),
        ([9], "constraint 9"),
        ([0.5], "positions"),
        ([-1], "positions"),
    ):
        with pytest.raises(rondel.InvalidInput, match=reason) as caught:
            tri.faces_inside([[*range(4)], wrong])
        assert caught.value.index == 1
    with pytest.raises(rondel.InvalidInput, match="leaves the hull"):
        tri.faces_inside([[4, 5, 6, 7]])


def test_a_hemisphere_has_no_faces_on_one_circle():
    shapely = pytest.importorskip("shapely")
    tri = rondel.constrained_delaunay(shapely.box(-180, 0, 180, 90))
    with pytest.raises(rondel.InvalidInput, match="one more site there, such as a pole"):
        _ = tri.inside


# ---- Geometries


def areas_inside(tri):
    """The areas of the faces in each polygon, by the formula of Oosterom and Strackee."""
    indptr, indices = tri.faces_inside()
    a, b, c = tri.points[tri.simplices[indices]].transpose(1, 0, 2)
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    cosines = 1 + sum(np.einsum("ij,ij->i", x, y) for x, y in ((a, b), (b, c), (c, a)))
    sums = np.concatenate([[0], np.cumsum(2 * np.arctan2(volumes, cosines))])
    return np.diff(sums[indptr])


@pytest.mark.parametrize(
    ("name", "edges"),
    [("countries-110m", "lonlat"), ("countries-110m", "geodesic"), ("land-110m", "lonlat")],
)
def test_faces_fill_the_polygons_of_natural_earth(name, edges):
    frame = geopandas.read_file(DATA / f"{name}.geojson")
    if edges == "geodesic":  # Antarctica's sides along the antimeridian and the pole need lonlat
        frame = frame[frame.geometry.bounds.miny > -90].reset_index(drop=True)
    tri = rondel.constrained_delaunay(frame, edges, crossings="split")
    assert tri.validate()
    inside = tri.faces_inside()
    assert len(inside.indptr) == len(frame) + 1
    areas = np.asarray(rondel.area(frame, edges=edges))
    assert areas_inside(tri) == pytest.approx(areas, rel=1e-9)
    one = rondel.constrained_delaunay(frame.geometry.iloc[-1], edges)
    assert areas_inside(one) == pytest.approx(areas[-1:], rel=1e-9)
    assert tri.geometries.max() == len(frame) - 1
    assert (np.diff(tri.geometries) >= 0).all()


def test_kinds_of_geometries_are_one():
    shapes = [shapely.box(170, 60, 200, 80), None, shapely.Point(0, 0), shapely.box(0, -5, 20, 5)]
    lists = rondel.constrained_delaunay(shapes)
    series = geopandas.GeoSeries(shapes, crs=4326)
    collection = series.__geo_interface__
    for given in (
        series,
        geopandas.GeoDataFrame(geometry=series),
        collection,
        np.array(shapes, object),
        series.to_arrow(),
    ):
        tri = rondel.constrained_delaunay(given, "lonlat")
        assert np.array_equal(tri.points, lists.points)
        assert np.array_equal(tri.simplices, lists.simplices)
        assert np.array_equal(tri.inside, lists.inside)
    assert np.diff(lists.faces_inside().indptr).tolist()[1:3] == [0, 0]
    cells = rondel.constrained_delaunay(rondel.CellSet.from_geometries(shapes[::3]))
    assert areas_inside(cells) == pytest.approx(areas_inside(lists)[::3], rel=1e-12)
    for number in ([2], [0, 0, 1]):
        with pytest.raises((TypeError, ValueError)):
            rondel.constrained_delaunay(number)


def test_holes_poles_and_more_than_a_hemisphere():
    ring = [(0, 60), (90, 60), (180, 60), (270, 60)]
    cap = {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}
    small = rondel.constrained_delaunay(cap, "geodesic")
    assert np.count_nonzero(small.inside) == 2
    large = shapely.box(-180, -90, 180, 80) - shapely.box(-20, -20, 20, 20)
    with pytest.raises(rondel.InvalidInput, match=r"^geometry 1 leaves the hull"):
        rondel.constrained_delaunay([None, large]).faces_inside()
    tri = rondel.constrained_delaunay([shapely.Point(0, -90), large])
    assert tri.validate()
    assert areas_inside(tri)[1] == pytest.approx(rondel.area(large), rel=1e-12)
    corner = rondel.constrained_delaunay(
        [(shapely.box(0, 0, 40, 40) - shapely.box(10, 10, 20, 20))], "geodesic"
    )
    assert len(corner.points) == 8
    assert corner.inside.sum() == 8


def test_lines_of_geometries_cross_in_a_point():
    lines = [shapely.LineString([(0, 0), (10, 10)]), shapely.LineString([(0, 10), (10, 0)])]
    with pytest.raises(rondel.CrossingConstraints) as caught:
        rondel.constrained_delaunay(lines, "geodesic")
    text = str(caught.value)
    assert text.startswith("geometries: geometry 1 crosses geometry 0 at longitude 5, latitude 5.0")
    assert text.endswith("crossings='split' makes a point there")
    assert caught.value.constraints == (0, 1)
    assert caught.value.index == 1
    copied = pickle.loads(pickle.dumps(caught.value))
    assert (str(copied), copied.place) == (text, caught.value.place)
    split = rondel.constrained_delaunay(lines, "geodesic", crossings="split")
    assert split.num_added == 1
    assert split.npoints == 5
    assert split.lonlat[4] == pytest.approx(caught.value.place, abs=1e-12)
    assert len(split.constrained_edges) == 4
    assert split.validate()
    loaded = pickle.loads(pickle.dumps(split))
    assert loaded.num_added == 1
    assert np.array_equal(loaded.points, split.points)
    assert loaded.validate()
    assert repr(loaded) == repr(split)
    assert len(split.to_geopandas()) == np.count_nonzero(~split.ghost)


# ---- Errors


def test_errors_name_the_constraint():
    points = rondel.unit_vectors([0, 1, 1, 0, 180], [0, 0, 1, 1, 0])
    for edges, index, reason in (
        ([[0, 1], [2, 2]], 1, "begins and ends at site 2"),
        ([[0, 5]], 0, "ends at site 5, but there are 5 sites"),
        ([[0, 1], [1, 2], [-1, 2]], 2, "ends at site -1"),
        ([[0, 4]], 0, "opposite"),
        ([[1, 2], [0, 2], [1, 3]], 2, "constraints 1 and 2 cross at longitude 0.49"),
    ):
        with pytest.raises(rondel.InvalidInput, match=reason) as caught:
            rondel.constrained_delaunay(points, edges)
        assert caught.value.index == index
    with pytest.raises(rondel.CrossingConstraints) as caught:
        rondel.constrained_delaunay(points, [[0, 2], [1, 3]])
    assert caught.value.constraints == (0, 1)
    assert caught.value.place == pytest.approx((0.5, 0.5), abs=1e-4)
    with pytest.raises(rondel.InvalidInput, match="not finite"):
        rondel.constrained_delaunay([[0, 0, math.nan]], None)


def test_errors_of_arguments():
    points = rondel.unit_vectors([0, 1, 1, 0], [0, 0, 1, 1])
    box = shapely.box(0, 0, 1, 1)
    for given, edges, options, kind in (
        (points, [[0.5, 1]], {}, TypeError),
        (points, [[0, 1, 2]], {}, ValueError),
        (points, [0, 1], {}, ValueError),
        (points, None, {"crossings": "keep"}, ValueError),
        (points, None, {"threads": 0}, ValueError),
        (points, None, {"invalid": "repair"}, ValueError),
        (points[:, :2], None, {}, ValueError),
        (box, "straight", {}, ValueError),
        (box, [[0, 1]], {}, ValueError),
        (box, None, {"center": [1, 0, 0]}, ValueError),
        ("countries.geojson", "lonlat", {}, TypeError),
    ):
        with pytest.raises(kind):
            rondel.constrained_delaunay(given, edges, **options)
    with pytest.raises(TypeError, match="constrained_delaunay"):
        rondel.ConstrainedDelaunay()
    bow = shapely.Polygon([(10, 0), (12, 2), (12, 0), (10, 2)])
    with pytest.raises(ValueError, match="geometry 1"):
        rondel.constrained_delaunay([box, bow])
    with pytest.warns(UserWarning, match="geometry 1 was repaired"):
        repaired = rondel.constrained_delaunay([box, bow], invalid="repair")
    assert repaired.validate()
    whole = rondel.CellSet.from_geometries([shapely.box(-180, -90, 180, 90)])
    with pytest.raises(ValueError, match="the whole sphere, which has no sides"):
        rondel.constrained_delaunay(whole)


@pytest.mark.parametrize("count", range(4))
def test_few_points(count):
    points = np.eye(3)[:count].reshape(-1, 3)
    edges = [[0, 1]] if count > 1 else None
    tri = rondel.constrained_delaunay(points, edges)
    assert tri.dimension == [-1, 0, 1, 2][count]
    assert len(tri.constrained_edges) == (count > 1)
    assert tri.validate()
    assert tri.sides.shape == (len(tri.simplices), 3)
    assert pickle.loads(pickle.dumps(tri)).dimension == tri.dimension
    empty = rondel.constrained_delaunay([], "lonlat")
    assert empty.npoints == 0
    assert empty.faces_inside().indptr.tolist() == [0]


def test_the_check_refuses_other_faces():
    points = rondel.unit_vectors([0, 10, 0, -10], [-2, 0, 2, 0])
    faces = rondel.constrained_delaunay(points, [[1, 3]]).simplices
    assert rondel.check_constrained(points, [[1, 3]], faces[::-1])
    assert not rondel.check_constrained(points, None, faces)
    assert "constraint 0" in rondel.check_constrained(points, [[0, 2]], faces).reason
    assert not rondel.check_constrained(points, [[1, 3]], faces[1:])
    assert not rondel.check_constrained(points, [[1, 3], [0, 2]], faces)
    for wrong in ([[0, 1]], [[0.0, 1, 2]]):
        with pytest.raises(ValueError, match="simplices"):
            rondel.check_constrained(points, None, wrong)
    with pytest.raises(rondel.InvalidInput, match="simplex 1") as caught:
        rondel.check_constrained(points, None, [[0, 1, 2], [0, 1, 4]])
    assert caught.value.index == 1


def test_faces_that_are_not_delaunay_have_no_cells():
    points = rondel.unit_vectors([0, 90, 180, -90, 0], [50, 51, 52, 53, -90])
    delaunay = rondel.SphericalDelaunay(points)
    refused = 0
    for diagonal in ([0, 2], [1, 3]):
        constrained = rondel.constrained_delaunay(points, [diagonal])
        built = constrained._triangulation
        assert len(_core.circumcenters(built)) == 6
        if np.array_equal(constrained.simplices, delaunay.simplices):
            assert np.array_equal(_core.diagram(built).areas, delaunay.voronoi().areas)
            continue
        refused += 1
        for call in (
            lambda built=built: _core.diagram(built),
            lambda built=built: _core.centroids(built),
            lambda built=built: _core.site_graph(built, "gabriel"),
        ):
            with pytest.raises(rondel.InvalidInput, match="not those of the triangulation"):
                call()
    assert refused == 1


def test_progress_can_end_the_work():
    def stop(stage, fraction):
        raise ArithmeticError(stage)

    lon, lat = np.random.default_rng(0).uniform(-90, 90, (2, 200_000))
    points = rondel.unit_vectors(lon, lat)
    with pytest.raises(ArithmeticError):
        rondel.constrained_delaunay(points, [[0, 1]], crossings="split", progress=stop)


def test_location():
    rng = np.random.default_rng(5)
    points = rng.normal(size=(300, 3))
    edges = [[0, 1]]
    for pair in rng.integers(0, 300, (100, 2)).tolist():
        try:
            rondel.constrained_delaunay(points, [*edges, pair])
        except rondel.InvalidInput:
            continue
        edges.append(pair)
    tri = rondel.constrained_delaunay(points, edges)
    queries = rng.normal(size=(40, 50, 3))
    faces = tri.find_simplex(queries)
    assert faces.shape == (40, 50)
    corners = points[tri.simplices[faces]]
    for i in range(3):
        a, b = corners[..., i, :], corners[..., (i + 1) % 3, :]
        assert (np.einsum("...i,...i", np.cross(a, b), queries) >= -1e-9).all()
    assert tri.locate(points[7]).where == rondel.Where.VERTEX
    assert tri.locate(points[7]).sites.tolist() == [7, -1, -1]
    copy = pickle.loads(pickle.dumps(tri))
    assert copy.find_simplex(queries[0, 0]) == faces[0, 0]


def test_linear_interpolation_in_the_own_faces():
    rng = np.random.default_rng(6)
    points = rng.normal(size=(200, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    edges = [[0, 1]]
    for pair in rng.integers(0, 200, (100, 2)).tolist():
        try:
            rondel.constrained_delaunay(points, [*edges, pair])
        except rondel.InvalidInput:
            continue
        edges.append(pair)
    tri = rondel.constrained_delaunay(points, edges)
    targets = rng.normal(size=(30, 40, 3))
    values = rng.normal(size=(2, 200))
    corners = tri.simplices[tri.find_simplex(targets)]
    shares = np.linalg.solve(np.swapaxes(points[corners], -1, -2), targets[..., None])[..., 0]
    shares /= shares.sum(axis=-1, keepdims=True)
    expected = (values[:, corners] * shares).sum(axis=-1)
    found = tri.interpolate(values, targets)
    assert found.shape == (2, 30, 40)
    np.testing.assert_allclose(found, expected, atol=1e-10)
    weights = tri.weights(targets)
    np.testing.assert_array_equal(weights.apply(values).reshape(found.shape), found)
    copy = pickle.loads(pickle.dumps(tri))
    np.testing.assert_array_equal(copy.interpolate(values, targets), found)
    plain = rondel.delaunay(points)
    assert (found != plain.interpolate(values, targets, "linear")).any()
    unconstrained = rondel.constrained_delaunay(points)
    np.testing.assert_array_equal(
        unconstrained.interpolate(values, targets), plain.interpolate(values, targets, "linear")
    )


def test_linear_interpolation_outside_and_of_what_is_missing():
    points = rondel.unit_vectors([0, 10, 10, 0, 5], [0, 0, 10, 10, 5])
    tri = rondel.constrained_delaunay(points, [[0, 2]])
    outside = rondel.unit_vectors(-20, 4)
    assert np.isnan(tri.interpolate([1, 2, 3, 4, 5], outside))
    assert tri.interpolate([1, 2, 3, 4, 5], outside, outside="nearest") == 1
    with pytest.raises(rondel.InvalidInput, match="target 0"):
        tri.interpolate([1, 2, 3, 4, 5], outside, outside="error")
    assert np.isnan(tri.interpolate([1, np.nan, 3, 4, 5], rondel.unit_vectors(9, 2)))
    assert tri.interpolate([1, np.nan, 3, 4, 5], rondel.unit_vectors(2, 8)) > 3
    assert tri.interpolate(np.zeros((0, 5)), outside).shape == (0,)
    with pytest.raises(ValueError, match="values"):
        tri.interpolate([1, 2], outside)
    with pytest.raises(rondel.InvalidInput):
        tri.weights([0, 0, 0])


def test_constraints_that_meet_in_a_point_of_both_do_not_cross():
    """The rays of small integers: (1, 0, 0) is exactly on both arcs; without it they cross."""
    points = np.array([[4, -1, 0], [4, 1, 0], [4, 0, -1], [4, 0, 1], [1, 0, 0]], float)
    constraints = [[0, 1], [2, 3]]
    wanted = {(0, 4), (1, 4), (2, 4), (3, 4)}
    made = rondel.constrained_delaunay(points, constraints)
    assert {tuple(edge) for edge in made.constrained_edges.tolist()} == wanted
    with pytest.raises(rondel.CrossingConstraints):
        rondel.constrained_delaunay(points[:4], constraints)
    # A point beside both is none of either.
    points[4] = [1, 2**-40, 2**-40]
    with pytest.raises(rondel.CrossingConstraints):
        rondel.constrained_delaunay(points, constraints)
