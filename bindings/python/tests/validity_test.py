# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons that are not valid: GEOS says which they are near (0, 0), and what becomes of them."""

import json
import math

import numpy as np
import pytest

import rondel
import rondel.mesh

shapely = pytest.importorskip("shapely")

TIE = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
BOX = shapely.box(0, 0, 1, 1)
GEODESIC = {"edges": "geodesic"}


def folded(rng, corners=7):
    return shapely.Polygon(rng.uniform(-0.005, 0.005, (corners, 2)))


def with_holes(rng):
    return shapely.Polygon(folded(rng, 6).exterior, [folded(rng, 4).exterior for _ in range(2)])


def with_parts(rng):
    return shapely.MultiPolygon([folded(rng, 5), with_holes(rng), folded(rng, 3)])


def on_a_lattice(rng):
    """Corners on sides, sides that repeat each other, spikes."""
    while True:
        places = rng.integers(0, 4, (9, 2)) * 0.002
        if len(np.unique(places, axis=0)) > 2:
            return shapely.Polygon(places)


KINDS = (folded, with_holes, with_parts, on_a_lattice)


def even_odd(*rings):
    """The faces between lines from which a ray crosses an odd number of sides."""
    noded = shapely.union_all([shapely.LineString(ring.coords) for ring in rings])
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    ends = [np.array(ring.coords) for ring in rings if not ring.is_empty]
    (ax, ay), (bx, by) = (
        np.concatenate([p[:-1] for p in ends]).T,
        np.concatenate([p[1:] for p in ends]).T,
    )

    def is_inside(face):
        x, y = face.representative_point().coords[0]
        crossed = (ay > y) != (by > y)
        height = np.where(crossed, by - ay, 1)
        return np.count_nonzero(crossed & (ax + (y - ay) / height * (bx - ax) > x)) % 2 == 1

    return shapely.union_all([face for face in faces if is_inside(face)])


def expected_of(geometry):
    """The union of the polygons, each by the even-odd rule."""
    parts = getattr(geometry, "geoms", [geometry])
    return shapely.union_all([even_odd(p.exterior, *p.interiors) for p in parts if not p.is_empty])


def is_near(found, expected):
    return shapely.symmetric_difference(found, expected).area <= 1e-6 * 1e-4


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
def test_small_polygons_become_those_of_geos(kind, edges):
    rng = np.random.default_rng(1)
    given = [kind(rng) for _ in range(60)]
    valid = rondel.is_valid(given, edges=edges)
    reasons = rondel.validity_reason(given, edges=edges)
    assert (reasons == "Valid Geometry").tolist() == valid.tolist()
    assert all(valid[shapely.is_valid(given)])
    found = rondel.make_valid(given, edges=edges)
    for k, (mine, theirs) in enumerate(zip(found, given, strict=True)):
        if valid[k] and (edges == "geodesic" or theirs.is_valid):
            assert mine is theirs
        else:
            assert mine.is_valid
            assert mine.geom_type in ("Polygon", "MultiPolygon")
        assert is_near(expected_of(mine), expected_of(theirs))
    assert not valid.all()
    assert rondel.is_valid(found, edges=edges).all()
    again = rondel.make_valid(found, edges=edges)
    assert all(one is other for one, other in zip(again, found, strict=True))
    with pytest.warns(UserWarning, match="was repaired"):
        areas = rondel.area(given, edges=edges, invalid="repair")
    assert areas == pytest.approx(rondel.area(found, edges=edges), rel=1e-6, abs=1e-16)


@pytest.mark.parametrize("method", ["linework", "structure"])
def test_rings_of_four_corners_become_those_of_geos(method):
    rng = np.random.default_rng(2)
    rings = [folded(rng, 4) for _ in range(50)]  # whose sides go around no place twice
    for mine, ring in zip(rondel.make_valid(rings), rings, strict=True):
        assert is_near(mine, shapely.make_valid(ring, method=method))


def anywhere(rng, n):
    return rng.uniform((-180, -90), (180, 90), (n, 2))


def on_a_wide_lattice(rng, n):
    return np.stack([rng.integers(-4, 5, n) * 45, rng.integers(-2, 3, n) * 45], -1)


def beyond_the_map(rng, n):
    return np.stack([rng.integers(-400, 400, n), rng.choice([-90, -80, 0, 80, 90], n)], -1)


def beside_the_antimeridian(rng, n):
    lon = rng.uniform(160, 200, n)
    return np.stack([np.where(lon > 180, lon - 360, lon), rng.uniform(-30, 30, n)], -1)


def around_the_pole(rng, n):
    return np.stack([np.linspace(-180, 170, n), rng.uniform(40, 90, n)], -1)


HOSTILE = (
    anywhere,
    on_a_wide_lattice,
    beyond_the_map,
    beside_the_antimeridian,
    around_the_pole,
)


@pytest.mark.parametrize("places", HOSTILE)
def test_rings_of_any_form_become_valid(places):
    rng = np.random.default_rng(4)
    given = [shapely.Polygon(places(rng, rng.integers(3, 12))) for _ in range(20)]
    found = rondel.make_valid(given)
    valid = rondel.is_valid(given)
    assert not valid.all()
    assert shapely.is_valid(found[~valid]).all()
    assert rondel.is_valid(found).all()
    assert all(a is b for a, b in zip(rondel.make_valid(found), found, strict=True))
    bounds = shapely.bounds(found[~valid & ~shapely.is_empty(found)])
    assert (np.abs(bounds) <= (180, 90, 180, 90)).all()
    with pytest.warns(UserWarning, match="was repaired"):
        cells = rondel.CellSet.from_geometries(given, invalid="repair")
    # Lines of the result are within 0.01 degrees of the arcs.
    near = 1e-9 + math.radians(0.01) * rondel.length(found)
    assert (np.abs(rondel.area(found) - cells.areas) <= near).all()


FAULTS = [
    (TIE, "ring 0 of part 0 crosses itself at 1 1"),
    (shapely.Polygon([(0, 0), (2, 0), (0, 0)]), "runs to and fro along a line"),
    (shapely.Polygon(BOX.exterior, [shapely.box(3, 3, 4, 4).exterior]), "does not lie inside of"),
    (shapely.Polygon(BOX.exterior, [BOX.exterior]), "leave nothing"),
    (shapely.MultiPolygon([BOX, shapely.box(0.5, 0.5, 2, 2)]), "ring 0 of part"),
    (shapely.Polygon([(lon, 60) for lon in range(-180, 180, 10)]), "spans more than 180 degrees"),
]


@pytest.mark.parametrize(("geometry", "reason"), FAULTS)
def test_reasons_are_those_of_readers(geometry, reason):
    told = rondel.validity_reason(geometry)
    assert isinstance(told, str)
    assert reason in told
    assert rondel.is_valid(geometry) is False
    with pytest.raises(ValueError, match=r"^geometries: geometry 0: ") as error:
        rondel.CellSet.from_geometries(geometry)
    assert str(error.value) == f"geometries: geometry 0: {told}"
    assert rondel.is_valid(rondel.make_valid(geometry)) is True


def test_rings_around_a_pole_get_the_pole():
    for pole in (1, -1):
        ring = shapely.Polygon([(lon, pole * 60) for lon in range(-180, 180, 10)])
        whole = shapely.box(-180, min(pole * 60, pole * 90), 180, max(pole * 60, pole * 90))
        found = rondel.make_valid(ring)
        assert found.is_valid
        assert rondel.area(found) == pytest.approx(rondel.area(whole), rel=1e-4)
        assert abs(found.bounds[1 if pole < 0 else 3]) == 90
        assert rondel.is_valid(ring, **GEODESIC)
        hole = shapely.Polygon(shapely.box(-180, -90, 180, 90).exterior, [ring.exterior])
        rest = rondel.make_valid(hole)
        assert rondel.area(rest) == pytest.approx(4 * math.pi - rondel.area(whole), rel=1e-4)


def test_the_antimeridian_that_is_not_cut():
    positions = [(170, 0), (-170, 0), (-170, 10), (170, 10), (170, 5), (-175, 7)]
    ring = shapely.Polygon(positions)
    assert not rondel.is_valid(ring)
    found = rondel.make_valid(ring)
    assert found.is_valid
    assert found.geom_type == "MultiPolygon"
    assert found.bounds[0] == -180
    moved = shapely.transform(ring, lambda p: np.where(p < -100, p + np.array([360, 0]), p))
    assert rondel.area(found) == pytest.approx(rondel.area(moved, invalid="repair"), rel=1e-3)


@pytest.mark.filterwarnings("error")
def test_the_result_has_the_kind_of_the_argument():
    assert rondel.make_valid(BOX) is BOX
    assert rondel.make_valid(None) is None
    assert rondel.is_valid(None) is False
    assert rondel.validity_reason(None) is None
    many = np.array([[TIE, BOX, None]])
    found = rondel.make_valid(many)
    assert found.shape == (1, 3)
    assert found[0, 1] is BOX
    assert found[0, 2] is None
    assert rondel.is_valid(many).tolist() == shapely.is_valid(many).tolist()
    assert rondel.validity_reason(many)[0, 2] is None
    assert [r.shape for r in (rondel.is_valid([]), rondel.validity_reason([]))] == [(0,), (0,)]
    assert rondel.make_valid([]).shape == (0,)
    for given in (TIE.__geo_interface__, {"type": "Feature", "geometry": TIE.__geo_interface__}):
        assert rondel.make_valid(given).equals(rondel.make_valid(TIE))
    collection = {"type": "FeatureCollection", "features": [given]}
    assert rondel.make_valid(collection).shape == (1,)
    assert rondel.make_valid((0, 0, 1, 1)).equals(BOX)
    assert rondel.make_valid(BOX.__geo_interface__).equals_exact(BOX)
    assert rondel.make_valid(shapely.Polygon()).is_empty
    points = rondel.unit_vectors([0, 2, 2, 0], [0, 2, 0, 2])
    cells = rondel.CellSet.polygons([0, 1], [0, 4], [0, 1, 2, 3], points)
    repaired = rondel.make_valid(cells)
    assert isinstance(repaired, rondel.CellSet)
    assert repaired.areas == pytest.approx(rondel.area([rondel.make_valid(TIE)]), rel=1e-3)
    assert rondel.is_valid(cells).tolist() == [False]
    assert rondel.validity_reason(cells)[0] == (
        "the cell crosses or overlaps itself at 1 1.000457054"
    )
    twice = rondel.CellSet.from_geometries([BOX, BOX])
    assert rondel.is_valid(twice).tolist() == [True, True]
    assert rondel.is_valid(repaired).tolist() == [True]


def test_data_frames_stay_what_they_are():
    geopandas = pytest.importorskip("geopandas")
    frame = geopandas.GeoDataFrame(
        {"name": list("abc")}, geometry=[BOX, TIE, None], crs=4326, index=[3, 1, 2]
    )
    found = rondel.make_valid(frame)
    assert found.drop(columns="geometry").equals(frame.drop(columns="geometry"))
    assert found.index.equals(frame.index)
    assert found.crs == frame.crs
    assert found.geometry.iloc[0].equals_exact(BOX)
    series = rondel.make_valid(frame.geometry)
    assert isinstance(series, geopandas.GeoSeries)
    assert series.geom_equals_exact(found.geometry, 0).tolist() == [True, True, False]
    assert rondel.is_valid(frame).tolist() == [True, False, False]
    web = rondel.make_valid(frame.to_crs(3857))
    assert web.crs == 4326
    assert rondel.area(web)[:2] == pytest.approx(rondel.area(found)[:2], rel=1e-4)
    pytest.importorskip("pyarrow")
    back = geopandas.GeoSeries.from_arrow(rondel.make_valid(frame.geometry.to_arrow()))
    assert back.geom_equals(series.reset_index(drop=True)).tolist() == [True, True, False]


READERS = {
    "CellSet.from_geometries": rondel.CellSet.from_geometries,
    "polygons": rondel.polygons,
    "clip": rondel.SphericalVoronoi.from_lonlat([0, 120, 240], [0, 0, 0]).clip,
    "feature_cells": lambda given, **rules: rondel.feature_cells([*given, BOX], 50, **rules),
    "feature_cells within": lambda given, **rules: rondel.feature_cells(
        [shapely.Point(0, 0), shapely.Point(9, 9)], 50, within=given, **rules
    ),
    "union_all": rondel.union_all,
    "union": lambda given, **rules: rondel.union(BOX, given, **rules),
    "overlay": lambda given, **rules: rondel.overlay(given, BOX, **rules),
    "area": rondel.area,
    "length": rondel.length,
    "cull": lambda given, **rules: rondel.mesh.scvt(162).cull(inside=given, **rules),
}


@pytest.mark.parametrize("name", READERS)
def test_readers_repair_on_request(name):
    given = [shapely.transform(TIE, lambda p: p + np.array([20, 0]))]
    read = READERS[name]
    with pytest.raises(ValueError, match="ring 0 of part 0 crosses itself at 21 1"):
        read(given)
    with pytest.raises(ValueError, match="invalid must be 'error' or 'repair', not 'mend'"):
        read(given, invalid="mend")
    with pytest.warns(
        UserWarning, match=r" was repaired \(ring 0 of part 0 crosses itself at 21 1"
    ):
        read(given, invalid="repair")


def test_files_are_repaired(tmp_path):
    path = tmp_path / "tie.geojson"
    path.write_text(json.dumps(TIE.__geo_interface__))
    with pytest.raises(OSError, match="crosses itself"):
        rondel.CellSet.read(path)
    for read in (rondel.CellSet.read, rondel.polygons):
        with pytest.warns(UserWarning, match="tie.geojson: feature 0 was repaired"):
            cells = read(path, invalid="repair")
        assert cells.areas == pytest.approx(rondel.area([rondel.make_valid(TIE)]), rel=1e-6)


def test_warnings_name_the_argument():
    with pytest.warns(UserWarning, match=r"^b: geometry 1 was repaired \(ring 0"):
        found = rondel.intersection(BOX, [BOX, TIE], invalid="repair")
    assert found[1].area == pytest.approx(0.5, rel=1e-3)


ERRORS = [
    (shapely.Point(0, 0), ValueError, '^geometries: type "Point" where a Polygon'),
    ([BOX, shapely.box(0, 0, 1, 91)], ValueError, r"^geometries: geometry 1.*latitude 91"),
    ("a.geojson", TypeError, "^geometries is the name of a file"),
    (3, TypeError, "^geometries must be polygons"),
]


@pytest.mark.parametrize("function", [rondel.make_valid, rondel.is_valid, rondel.validity_reason])
@pytest.mark.parametrize(("given", "kind", "message"), ERRORS)
def test_errors_name_the_geometry(function, given, kind, message):
    with pytest.raises(kind, match=message):
        function(given)
    with pytest.raises(ValueError, match="edges must be 'lonlat' or 'geodesic'"):
        function(BOX, edges="flat")


def test_rings_that_meet_themselves_become_those_of_shapely():
    eight = shapely.Polygon([(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (1, 2), (1, 1), (0, 1)])
    keyhole = shapely.Polygon(
        [
            (0, 0),
            (4, 0),
            (4, 4),
            (0, 4),
            (0, 2),
            (1, 2),
            (1, 3),
            (2, 3),
            (2, 1),
            (1, 1),
            (1, 2),
            (0, 2),
        ]
    )
    for given in (eight, keyhole):
        assert rondel.is_valid(given)
        assert not given.is_valid
        made = rondel.make_valid(given)
        assert made.is_valid
        assert abs(made.area - given.area) < 1e-9
    assert rondel.make_valid(shapely.box(0, 0, 1, 1)) == shapely.box(0, 0, 1, 1)


def test_holes_that_meet_nothing_hide_no_ring_that_does():
    free = [shapely.box(x, y, x + 0.5, y + 0.5).exterior for x in range(1, 9) for y in (1, 7)]
    chain = [shapely.Polygon([(x, 4), (x + 1, 3), (x + 2, 4), (x + 1, 5)]) for x in range(0, 10, 2)]
    touching = [diamond.exterior for diamond in chain]
    shell = shapely.box(0, 0, 10, 10).exterior
    cut = shapely.Polygon(shell, free + touching)  # the diamonds divide it
    whole = shapely.Polygon(shell, free + touching[:3])
    assert not cut.is_valid
    assert rondel.is_valid([cut, whole]).all()
    made = rondel.make_valid([cut, whole])
    assert shapely.is_valid(made).all()
    assert made[0].geom_type == "MultiPolygon"
    assert made[1] is whole
    assert abs(made[0].area - cut.area) < 1e-9
