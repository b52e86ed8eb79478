# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Set operations and measures of polygons: shapely and GeoPandas are right near (0, 0)."""

import math
import warnings

import numpy as np
import pytest

import rondel

shapely = pytest.importorskip("shapely")

OPERATIONS = ("intersection", "union", "difference", "symmetric_difference")
EARTH = 6371.0088
SPHERE = 4 * math.pi
A, B = shapely.box(0, 0, 2, 2), shapely.box(1, 1, 3, 3)
WORLD = shapely.box(-180, -90, 180, 90)
WHOLE = rondel.CellSet.polygons([0, 0], [0], [], np.zeros((0, 3)), whole=[0])


def star(rng, middle=(0, 0), radius=0.01, corners=8):
    angles = np.sort(rng.uniform(0, 2 * math.pi, corners))
    lengths = radius * rng.uniform(0.3, 1, corners)
    return shapely.Polygon(
        np.array(middle) + np.stack([np.cos(angles), np.sin(angles)], -1) * lengths[:, None]
    )


def stars(rng, number, **options):
    found = []
    while len(found) < number:
        made = star(rng, rng.uniform(-0.008, 0.008, 2), **options)
        if made.is_valid:
            found.append(made)
    return found


def is_near(found, expected, share=1e-6):
    """Whether polygons near (0, 0) differ by no more than such a share of a star."""
    return shapely.symmetric_difference(found, expected).area <= share * 1e-4


def around(pole, latitude=60):
    """A cap, led to its pole along the edge of the map."""
    lon = np.linspace(-180, 180, 13)
    ring = [(x, pole * latitude) for x in lon]
    return shapely.Polygon([*ring, (180, pole * 90), (-180, pole * 90)])


def ring_cells(lon, lat):
    points = rondel.unit_vectors(lon, lat)
    return rondel.CellSet.polygons([0, 1], [0, len(points)], np.arange(len(points)), points)


@pytest.mark.parametrize("name", OPERATIONS)
@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
def test_small_polygons_are_those_of_the_plane(name, edges):
    rng = np.random.default_rng(3)
    first, second = stars(rng, 40), stars(rng, 40)
    found = getattr(rondel, name)(first, second, edges=edges)
    expected = getattr(shapely, name)(first, second)
    assert found.dtype == object
    for mine, theirs in zip(found, expected, strict=True):
        assert mine.is_valid
        assert is_near(mine, theirs)
    again = getattr(rondel, name)(first, second, edges=edges, threads=1)
    assert [g.wkb for g in again] == [g.wkb for g in found]


def test_unions_of_many_are_those_of_the_plane():
    rng = np.random.default_rng(4)
    for number in (1, 2, 5, 30):
        given = stars(rng, number)
        found = rondel.union_all(given)
        assert found.is_valid
        assert is_near(found, shapely.union_all(given))
    assert rondel.union_all([]).equals(shapely.Polygon())
    assert rondel.union_all([None, shapely.Polygon()]).is_empty
    assert is_near(rondel.union_all([None, given[0]]), given[0])
    assert is_near(rondel.union_all(given[0]), given[0])


REGIONS = {
    "date line": (shapely.box(170, -10, 190, 20), shapely.box(175, 0, 195, 30)),
    "cut at the date line": (
        shapely.MultiPolygon([shapely.box(170, -10, 180, 20), shapely.box(-180, -10, -170, 20)]),
        shapely.box(-190, 5, -165, 30),
    ),
    "north pole": (around(1), shapely.box(-20, 40, 70, 90)),
    "south pole": (around(-1, 50), around(-1, 70)),
    "both poles": (around(1, 10), around(-1, -20)),
    "hole": (A.buffer(5).difference(A), B.buffer(3)),
    "world": (WORLD, around(1)),
    "world less a box": (shapely.difference(WORLD, A), B),
    "apart": (A, shapely.box(100, 0, 110, 10)),
    "shared side": (A, shapely.box(2, 0, 4, 2)),
    "shared corner": (A, shapely.box(2, 2, 4, 4)),
    "same": (A, A),
}


@pytest.mark.parametrize("where", REGIONS)
def test_areas_add_up(where):
    a, b = REGIONS[where]
    parts = {name: getattr(rondel, name)(a, b) for name in OPERATIONS}
    assert all(part.is_valid for part in parts.values())
    west, south, east, north = shapely.total_bounds(np.array(list(parts.values())))
    assert west >= -180
    assert south >= -90
    assert east <= 180
    assert north <= 90
    area = {name: rondel.area(part) for name, part in parts.items()}
    first, second = rondel.area(a), rondel.area(b)
    near = {"rel": 1e-4, "abs": 1e-9}  # results have arcs within 0.01 degrees of their own
    assert area["union"] + area["intersection"] == pytest.approx(first + second, **near)
    assert area["difference"] + area["intersection"] == pytest.approx(first, **near)
    assert area["symmetric_difference"] == pytest.approx(
        area["union"] - area["intersection"], **near
    )
    # The same with cells, exactly.
    cells = [rondel.CellSet.from_geometries([x]) for x in (a, b)]
    exact = {name: getattr(rondel, name)(*cells).areas[0] for name in OPERATIONS}
    sizes = [x.areas[0] for x in cells]
    assert exact["union"] + exact["intersection"] == pytest.approx(sum(sizes), abs=1e-12)
    assert exact["difference"] + exact["intersection"] == pytest.approx(sizes[0], abs=1e-12)
    assert [exact[name] for name in OPERATIONS] == pytest.approx(
        [area[name] for name in OPERATIONS], **near
    )


def test_the_whole_sphere_and_nothing():
    assert rondel.union(around(1, 0), around(-1, 0)).equals(WORLD)
    assert rondel.intersection(around(1, 0), around(-1, 0)).is_empty
    assert rondel.difference(WORLD, WORLD).is_empty
    rest = rondel.difference(WORLD, A)
    assert len(rest.interiors) == 1
    assert rondel.union(rest, A).equals(WORLD)
    nothing = shapely.Polygon()
    assert rondel.intersection(A, nothing).is_empty
    assert rondel.area(rondel.union(A, nothing)) == pytest.approx(rondel.area(A), rel=1e-9)
    assert rondel.intersection(WHOLE, A).areas == pytest.approx([rondel.area(A)], rel=1e-12)
    assert rondel.union(A, WHOLE).whole.tolist() == [0]
    empty = rondel.difference(WHOLE, WHOLE)
    assert (empty.num_cells, empty.areas.tolist(), len(empty.whole)) == (1, [0], 0)


def test_a_part_that_is_cut_off_fits_when_it_is_joined_again():
    # Sides of both are read together, and get the same corners.
    rng = np.random.default_rng(5)
    for _ in range(5):
        a = star(rng, rng.uniform((-100, -50), (100, 50)), 20)
        b = star(rng, np.array(a.centroid.coords[0]) + rng.uniform(-5, 5, 2), 12)
        if not (a.is_valid and b.is_valid):
            continue
        rest = rondel.difference(a, b)
        whole, expected = rondel.union(rest, b), rondel.union(a, b)
        assert [len(getattr(g, "geoms", [g])) for g in (whole, expected)] == [1, 1]
        assert len(whole.interiors) == len(expected.interiors)
        assert rondel.area(rondel.intersection(rest, b)) < 1e-6


def corners_of(cells):
    return {point.tobytes() for point in cells.rings[3]}


def test_cells_keep_their_corners_however_long_the_chain():
    rng = np.random.default_rng(6)
    cells = rondel.CellSet.from_geometries([star(rng, (0, 60), 25, 9)])
    place = rondel.CellSet.from_geometries([shapely.box(-180, 70, 180, 90)])
    known = corners_of(cells) | corners_of(place)
    assert corners_of(rondel.union_all(cells)) == corners_of(cells)
    first = cells
    for _ in range(10):
        rest = rondel.difference(first, place)
        first = rondel.union(rest, rondel.intersection(first, place))
    assert corners_of(first) >= corners_of(cells)
    assert 0 < len(corners_of(first) - known) < 20  # crossings
    assert first.areas == pytest.approx(cells.areas, abs=1e-14)
    assert rondel.area(rondel.symmetric_difference(first, cells)).max() < 1e-14
    assert rondel.union_all(rondel.overlay(cells, place, "union")).areas == pytest.approx(
        rondel.union(cells, place).areas, abs=1e-14
    )


def test_the_result_has_the_kind_of_the_first_argument_with_many():
    given = [A, B]
    assert isinstance(rondel.union(A, B), shapely.Polygon)
    assert isinstance(rondel.union(A, shapely.box(5, 5, 6, 6)), shapely.MultiPolygon)
    for many in (given, tuple(given), iter(given), np.array(given)):
        assert rondel.intersection(many, A).shape == (2,)
    assert isinstance(rondel.intersection(A, given), np.ndarray)
    assert rondel.intersection(A, np.array([[A, B, None]])).shape == (1, 3)
    assert rondel.intersection(np.array(given)[:, None], [A, B, A]).shape == (2, 3)
    cells = rondel.CellSet.from_geometries(given)
    for one, other in ((cells, A), (A, cells), (cells, given), (cells, cells)):
        assert isinstance(rondel.intersection(one, other), rondel.CellSet)
    assert isinstance(rondel.intersection(given, cells), np.ndarray)
    assert isinstance(rondel.union_all(cells), rondel.CellSet)
    diagram = rondel.SphericalVoronoi.from_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
    north = diagram.clip([-180, 0, 180, 90])
    assert rondel.area(rondel.difference(north, north.cell_set())).max() < 1e-12
    assert rondel.area(north) == pytest.approx(north.areas)


def test_positions_stay_what_they_are():
    rng = np.random.default_rng(9)
    for digits in (0, 1, 5, 12):
        corners = rng.uniform((-170, -80), (170, 80), (20, 2)).round(digits)
        boxes = np.hstack([corners, corners + 1]).round(digits)
        given = shapely.box(*boxes.T)
        found = rondel.union(given, shapely.Polygon())
        for shape, box in zip(found, given, strict=True):
            positions = {tuple(p) for p in shapely.get_coordinates(shape)}
            assert {tuple(p) for p in shapely.get_coordinates(box)} <= positions


def test_mappings_are_geometries():
    mapping = A.__geo_interface__
    feature = {"type": "Feature", "properties": {"name": "a"}, "geometry": mapping}
    collection = {"type": "FeatureCollection", "features": [feature, feature]}
    expected = rondel.intersection(A, B)
    for given in (mapping, feature, (0, 0, 2, 2), np.array([0.0, 0, 2, 2])):
        assert rondel.intersection(given, B).equals(expected)
    assert [g.equals(expected) for g in rondel.intersection(collection, B)] == [True, True]
    several = shapely.GeometryCollection([A, shapely.box(5, 5, 6, 6)])
    assert rondel.area(several) == pytest.approx(sum(rondel.area([*several.geoms])))


def test_what_is_missing_stays_missing():
    found = rondel.union([A, None, A], [None, B, B])
    assert [g is None for g in found] == [True, True, False]
    assert rondel.union(None, A) is None
    assert rondel.union([None], rondel.CellSet.from_geometries([A]))[0] is None
    assert rondel.union(rondel.CellSet.from_geometries([A]), [None]).areas.tolist() == [0]
    assert np.isnan(rondel.area([None, A])).tolist() == [True, False]
    assert math.isnan(rondel.length(None))
    assert rondel.overlay([None, A], A).size == 1


def test_geodesic_edges_get_no_positions():
    a = shapely.Polygon([(0, 60), (100, 60), (50, 80)])
    b = shapely.Polygon([(50, 50), (150, 60), (100, 80)])
    for name in OPERATIONS:
        found = getattr(rondel, name)(a, b, edges="geodesic")
        assert len(shapely.get_coordinates(found)) <= 20
        cells = [rondel.CellSet.from_geometries([g], edges="geodesic") for g in (a, b)]
        exact = getattr(rondel, name)(*cells).areas
        assert rondel.area(found, edges="geodesic") == pytest.approx(exact[0], rel=1e-13)
    lune = shapely.Polygon([(170, 0), (170, 90), (190, 0), (170, -90)])
    across = rondel.union_all(lune, edges="geodesic")
    assert across.geom_type == "MultiPolygon"
    assert rondel.area(across, edges="geodesic") == pytest.approx(SPHERE / 18, rel=1e-13)
    cap = shapely.Polygon([(0, 50), (90, 50), (180, 50), (270, 50)])
    cut = rondel.union_all(cap, edges="geodesic")
    assert rondel.area(cut, edges="geodesic") == pytest.approx(
        rondel.area(cap, edges="geodesic"), rel=1e-13
    )


def test_geodesic_results_are_not_larger_than_a_hemisphere():
    large = rondel.difference(WHOLE, shapely.box(0, 0, 9, 9), edges="geodesic")
    south = ring_cells([0, 240, 120], [10, 10, 10])
    for cells in (large, WHOLE, south):
        with pytest.raises(ValueError, match="geometry 0 of the result goes around more than"):
            rondel.union([A], cells, edges="geodesic")
        assert rondel.union([A], cells)[0].is_valid
    half = ring_cells([0, 120, 240], [0, 0, 0])
    assert rondel.area(rondel.intersection([WORLD], half)) == pytest.approx(SPHERE / 2)


def test_areas_and_lengths():
    assert rondel.area(WORLD) == pytest.approx(SPHERE, rel=1e-15)
    assert rondel.length(WORLD) == 0
    octant = shapely.box(0, 0, 90, 90)
    assert rondel.area(octant, EARTH) == pytest.approx(SPHERE / 8 * EARTH**2, rel=1e-9)
    assert rondel.length(octant, radius=EARTH) == pytest.approx(1.5 * math.pi * EARTH, rel=1e-9)
    box = shapely.box(10, 20, 30, 50)
    sines = math.sin(math.radians(50)) - math.sin(math.radians(20))
    assert rondel.area(box) == pytest.approx(math.radians(20) * sines, rel=1e-5)
    cosines = math.cos(math.radians(50)) + math.cos(math.radians(20))
    sides = math.radians(20) * cosines + 2 * math.radians(30)
    assert rondel.length(box) == pytest.approx(sides, rel=1e-6)
    triangle = shapely.Polygon([(0, 60), (100, 60), (50, 80)])
    corners = rondel.unit_vectors([0, 100, 50], [60, 60, 80])
    arcs = np.arccos((corners * np.roll(corners, 1, axis=0)).sum(axis=1)).sum()
    assert rondel.length(triangle, edges="geodesic") == pytest.approx(arcs, rel=1e-14)
    assert isinstance(rondel.area(box), float)
    assert rondel.area(np.array([[A], [B]])).shape == (2, 1)
    assert rondel.length([A, box]).shape == (2,)
    assert rondel.area([]).tolist() == []
    with pytest.raises(ValueError, match="radius must be positive, not 0"):
        rondel.area(A, 0)


TIE = shapely.Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
with np.errstate(invalid="ignore"):
    NAN = shapely.Polygon([(0, 0), (1, 0), (math.nan, 1)])
ERRORS = [
    (lambda: rondel.union(A, TIE), ValueError, r"^b: ring 0 of part 0 crosses itself at 0\.5 0\.5"),
    (lambda: rondel.union([A, TIE], A), ValueError, "^a: geometry 1: ring 0 of part 0 crosses"),
    (lambda: rondel.union([A, A], [A, TIE]), ValueError, "^b: geometry 1: ring 0 of part 0 cross"),
    (lambda: rondel.area([TIE]), ValueError, "^geometries: geometry 0: ring 0 of part 0 crosses"),
    (lambda: rondel.union(A, shapely.Point(0, 91)), ValueError, "^b: latitude 91 is outside"),
    (
        lambda: rondel.union(A, [None, shapely.LineString([(170, 0), (-170, 0)])]),
        ValueError,
        "^b: geometry 1: its line from 170 0 to -170 0 spans more than 180 degrees",
    ),
    (
        lambda: rondel.relate(A, [A, shapely.GeometryCollection([A, shapely.Point(0, 0)])]),
        ValueError,
        "^b: geometry 1 has parts of several dimensions",
    ),
    (lambda: rondel.union(A, [A, NAN]), ValueError, "^b: geometry 1 has a position that is not f"),
    (lambda: rondel.area(shapely.box(0, 0, 1, 91)), ValueError, r"latitude 91 is outside \[-90"),
    (lambda: rondel.union([A, A, A], [A, A]), ValueError, r"shapes of a and b do not fit: \(3,\)"),
    (lambda: rondel.area({"type": "FeatureCollection"}), ValueError, '^geometries: type "FeatureC'),
    (lambda: rondel.union(A, "b.geojson"), TypeError, "^b is the name of a file; rondel.CellSet"),
    (lambda: rondel.union(3, A), TypeError, "^a must be polygons or a CellSet, not int"),
    (lambda: rondel.union(A, [1]), TypeError, "int is no geometry"),
    (lambda: rondel.union(A, A, edges="flat"), ValueError, "edges must be 'lonlat' or 'geodesic'"),
    (lambda: rondel.area(WHOLE, edges="flat"), ValueError, "edges must be 'lonlat' or 'geodesic'"),
    (lambda: rondel.union(A, A, tolerance_deg=0), ValueError, "the tolerance is not positive"),
    (lambda: rondel.union(A, A, threads=0), ValueError, "threads must be at least 1"),
    (lambda: rondel.overlay(A, A, "cut"), ValueError, "how must be one of .*, not 'cut'"),
    (lambda: rondel.union(rondel.lonlat_grid(4, 2), A), ValueError, "parallels have no sides"),
]


@pytest.mark.parametrize(("call", "kind", "message"), ERRORS)
def test_errors_name_the_geometry(call, kind, message):
    with pytest.raises(kind, match=message):
        call()


def test_what_is_too_narrow_is_told():
    sliver = shapely.Polygon([(0, 0), (1, 0), (1, 1e-14)])
    with pytest.warns(UserWarning, match=r"^b: geometry 1 is no wider than rounding"):
        assert rondel.union([None, A], [A, sliver])[1].is_valid


def test_pieces_of_arrays_have_their_polygons():
    rng = np.random.default_rng(7)
    first, second = stars(rng, 6), stars(rng, 5)  # which overlap
    for how in ("intersection", "union", "identity", "difference", "symmetric_difference"):
        pieces, i, k = rondel.overlay(first, second, how, return_indices=True)
        expected = _pieces(first, second, how)
        assert sorted(zip(i.tolist(), k.tolist(), strict=True)) == sorted(expected)
        for piece, *key in zip(pieces, i.tolist(), k.tolist(), strict=True):
            assert piece.is_valid
            assert is_near(piece, expected[tuple(key)])
        cells = rondel.CellSet.from_geometries(first)
        assert rondel.overlay(cells, second, how).num_cells >= len(pieces)
    assert rondel.overlay(A, B).shape == (1,)
    assert rondel.overlay([], []).shape == (0,)


def _pieces(first, second, how):
    """The pieces in the plane, by their polygons."""
    found = {}
    if how in ("intersection", "union", "identity"):
        for i, a in enumerate(first):
            found.update({(i, k): a.intersection(b) for k, b in enumerate(second)})
    if how != "intersection":
        others = shapely.union_all(second)
        found.update({(i, -1): a.difference(others) for i, a in enumerate(first)})
    if how in ("union", "symmetric_difference"):
        others = shapely.union_all(first)
        found.update({(-1, k): b.difference(others) for k, b in enumerate(second)})
    return {key: piece for key, piece in found.items() if not piece.is_empty}


def test_pieces_that_meet_share_their_positions():
    rows = [shapely.box(0, 60, 30, 80), shapely.box(30, 60, 60, 80)]
    columns = [shapely.box(-10, 65, 70, 70), shapely.box(-10, 70, 70, 75)]
    pieces = rondel.overlay(rows, columns)
    assert len(pieces) == 4
    union = shapely.unary_union(pieces)
    assert union.geom_type == "Polygon"
    assert len(union.interiors) == 0
    assert math.isclose(union.area, sum(piece.area for piece in pieces), rel_tol=1e-12)


@pytest.mark.parametrize("how", ["union", "intersection", "difference", "symmetric_difference"])
def test_an_operand_does_not_make_the_other_one_valid(how):
    # The corner of the box is where the sides of the bow tie cross.
    box, tie = shapely.box(0, 0, 1, 1), shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    combine = getattr(rondel, how)
    for name, operands in (("b", (box, tie)), ("a", (tie, box))):
        with pytest.raises(ValueError, match=f"^{name}: ring 0 of part 0 crosses itself at 1 1$"):
            combine(*operands)
        with pytest.warns(UserWarning, match="crosses itself at 1 1"):
            found = combine(*operands, invalid="repair")
        sound = [rondel.make_valid(shape) for shape in operands]
        assert found.equals(combine(*sound))
    with pytest.raises(ValueError, match="geometry 1: ring 0 of part 0 crosses itself at 1 1"):
        rondel.union_all([box, tie])


CROSSING = rondel.CellSet.corners(
    [[0, 2, 2, 0, 0, 0], [0, 4, 4, 1, 1, 0]], [[0, 2, 0, 2, 2, 2], [0, 0, 4, 4, -1, -1]]
)
OF_CELLS = {
    "union": lambda cells, **rules: rondel.union(cells, A, **rules),
    "intersection": lambda cells, **rules: rondel.intersection(A, cells, **rules),
    "difference": lambda cells, **rules: rondel.difference(A, cells, **rules),
    "symmetric_difference": lambda cells, **rules: rondel.symmetric_difference(cells, A, **rules),
    "overlay": lambda cells, **rules: rondel.overlay(cells, cells, "union", **rules),
    "union_all": rondel.union_all,
    "buffer": lambda cells, **rules: rondel.buffer(cells, 1e4, **rules),
    "simplify": lambda cells, **rules: rondel.simplify(cells, 1e4, **rules),
    "area": rondel.area,
    "length": rondel.length,
    "relate": lambda cells, **rules: rondel.relate(cells, A, **rules),
    "contains": lambda cells, **rules: rondel.contains(cells, shapely.Point(1, 0.5), **rules),
}


@pytest.mark.parametrize("name", OF_CELLS)
def test_cells_that_cross_themselves_are_refused_or_repaired(name):
    call = OF_CELLS[name]
    with pytest.raises(rondel.InvalidInput, match="cell 0 crosses or overlaps itself at 1") as told:
        call(CROSSING)
    assert told.value.index == 0
    with pytest.warns(UserWarning, match=r"cell 0 was repaired .*, and 1 more"):
        found = call(CROSSING, invalid="repair")
    with pytest.warns(UserWarning, match="was repaired"):
        sound = CROSSING.repaired()
    with warnings.catch_warnings(action="error"):
        expected = call(sound)
    if isinstance(expected, rondel.CellSet):
        found, expected = found.areas, expected.areas
    if name != "overlay":
        assert np.all(found == expected)
    # The even-odd reading of the tie is two triangles.
    assert np.isclose(rondel.area(sound, radius=1)[0], 2 * np.radians(1) ** 2, rtol=1e-3)
