# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Hostile polygons: shapely says which are valid and what their union is, an integral the area."""

import itertools
import json
import math
import re

import clouds
import numpy as np
import pytest

import rondel
import rondel.mesh

shapely = pytest.importorskip("shapely")

TOLERANCE = math.radians(1e-4)  # of arcs from straight lines
CELLS = rondel.SphericalVoronoi(clouds.uniform(40, 5))


def area_of_ring(ring):
    """The area between straight lines in longitude and latitude: the integral of the sine."""
    lon, lat = np.radians(np.array(ring.coords, np.longdouble)).T
    mean = np.sin((lat[1:] + lat[:-1]) / 2)
    half = (lat[1:] - lat[:-1]) / 2
    sinc = np.where(np.abs(half) < 1e-4, 1 - half**2 / 6, np.sin(half) / np.where(half, half, 1))
    return abs(float(np.sum((lon[1:] - lon[:-1]) * mean * sinc)))


def area_of(geometry):
    if geometry.is_empty:
        return 0.0
    total = 0.0
    for part in getattr(geometry, "geoms", [geometry]):
        if part.geom_type == "Polygon":
            total += area_of_ring(part.exterior) - sum(map(area_of_ring, part.interiors))
        elif hasattr(part, "geoms"):
            total += area_of(part)
    return total


def bound_of(geometry):
    """The largest difference of the area between arcs from that between straight lines."""
    return TOLERANCE * math.radians(geometry.length) + 1e-13


def star(rng, middle, radius, corners):
    angles = np.sort(rng.uniform(0, 2 * math.pi, corners))
    lengths = radius * rng.uniform(0.3, 1, corners)
    return np.array(middle) + np.stack([np.cos(angles), np.sin(angles)], -1) * lengths[:, None]


def sliver(rng):
    start, turn = rng.uniform((-150, -70), (150, 70)), rng.uniform(0, 2 * math.pi)
    along = np.array([math.cos(turn), math.sin(turn)]) * 10.0 ** rng.uniform(-3, 1)
    across = np.array([-along[1], along[0]]) * 10.0 ** rng.uniform(-9, -2)
    return shapely.Polygon([start, start + along, start + rng.uniform(0.1, 0.9) * along + across])


def bow_tie(rng):
    west, south = rng.uniform((-150, -60), (150, 50))
    a, b = rng.uniform(1, 9, 2)
    return shapely.Polygon(
        [(west, south), (west + a, south + b), (west + a, south), (west, south + b)]
    )


def bow_tie_with_corner(rng):
    x, y = (int(v) for v in rng.integers((-100, -50), (100, 50)))
    return shapely.Polygon(
        [(x - 4, y - 4), (x, y), (x + 4, y + 4), (x + 4, y - 4), (x, y), (x - 4, y + 4)]
    )


def holed(rng):
    shell = star(rng, rng.uniform((-100, -50), (100, 50)), 15, 12)
    hole = star(rng, shell.mean(0) + rng.uniform(-9, 9, 2), 3, 6)
    return shapely.Polygon(shell, [hole])


def keyhole(rng):
    x, y = (int(v) for v in rng.integers((-100, -50), (100, 50)))
    shell = [(x, y), (x + 9, y), (x + 9, y + 9), (x, y + 9), (x, y)]
    return shapely.Polygon([*shell, (x + 2, y + 2), (x + 2, y + 4), (x + 4, y + 3), (x + 2, y + 2)])


def spike(rng):
    x, y = rng.uniform((-100, -50), (100, 50))
    tip = (x + 9, y + rng.uniform(-3, 3))
    return shapely.Polygon([(x, y), (x + 4, y - 4), tip, (x + 4, y - 4), (x + 4, y + 4)])


def parts(rng):
    middle = rng.uniform((-100, -50), (100, 50))
    return shapely.MultiPolygon(
        [shapely.Polygon(star(rng, middle + rng.uniform(-9, 9, 2), 6, 7)) for _ in range(3)]
    )


def folded(rng):
    return shapely.Polygon(rng.uniform((-20, -20), (20, 20), (6, 2)))


def belt(rng):
    south, north = np.sort(rng.uniform(-80, 80, 2))
    return shapely.box(-180, south, 180, north)


def cap(rng):
    lons = np.linspace(-180, 180, 20)
    lats = rng.uniform(50, 80, 20)
    lats[-1] = lats[0]
    return shapely.Polygon([*zip(lons, lats, strict=True), (180, 90), (-180, 90)])


def ocean(rng):
    islands = [star(rng, (x, y), 4, 6) for x in range(-160, 170, 40) for y in range(-60, 70, 20)]
    return shapely.Polygon(shapely.box(-180, -90, 180, 90).exterior, islands)


def across_the_antimeridian(rng):
    ring = star(rng, (180, rng.uniform(-60, 60)), 15, 9)
    if rng.random() < 0.5:
        return shapely.Polygon(ring)
    ring = shapely.make_valid(shapely.Polygon(ring))
    west = shapely.intersection(ring, shapely.box(0, -90, 180, 90))
    east = shapely.intersection(ring, shapely.box(180, -90, 360, 90))
    moved = shapely.transform(east, lambda p: p - (360, 0))
    pieces = [
        p for g in (west, moved) for p in getattr(g, "geoms", [g]) if p.geom_type == "Polygon"
    ]
    return shapely.MultiPolygon(pieces)


KINDS = [
    sliver, bow_tie, bow_tie_with_corner, holed, keyhole, spike, parts, folded, belt, cap, ocean,
    across_the_antimeridian,
]  # fmt: skip


def area_or_message(polygon):
    try:
        return rondel.polygons([polygon]).areas[0], ""
    except ValueError as error:
        return 0.0, str(error)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_polygons_are_what_they_are_or_an_error(kind):
    rng = np.random.default_rng(11)
    for _ in range(4 if kind is ocean else 25):
        polygon = kind(rng)
        area, message = area_or_message(polygon)
        if message:
            assert message.startswith("geometries: geometry 0: "), message
            assert not polygon.is_valid, (polygon.wkt, message)
            continue
        expected = area_of(shapely.make_valid(polygon))
        assert abs(area - expected) <= bound_of(polygon), polygon.wkt
        if kind is sliver:
            assert 0 <= area < 2 * expected + 1e-15
        clipped = CELLS.clip(polygon).areas.sum()
        assert abs(clipped - area) <= 1e-12, polygon.wkt


def test_unions_of_disks():
    rng = np.random.default_rng(2)
    for _ in range(12):
        middle = rng.uniform((-100, -50), (100, 50))
        middles = middle + rng.uniform(-4, 4, (5, 2))
        given = [shapely.Point(p).buffer(rng.uniform(1, 6), quad_segs=3) for p in middles]
        given.append(given[0])
        union = shapely.union_all(given)
        area = CELLS.clip(given).areas.sum()
        assert abs(area - area_of(union)) <= bound_of(union)
        first = rondel.polygons(given, overlap="first").areas
        assert np.isclose(first.sum(), area, rtol=1e-11)
        assert first[-1] == 0
        assert abs(first[0] - area_of(given[0])) <= bound_of(given[0])
        with pytest.raises(ValueError, match=r"^geometries [0-9] and [0-9] overlap at"):
            rondel.polygons(given, overlap="error")


def test_overlaps_say_what_can_be_done(tmp_path):
    boxes = [shapely.box(k, k, k + 5, k + 5) for k in range(3)]
    features = [
        {"type": "Feature", "properties": {}, "geometry": shapely.geometry.mapping(box)}
        for box in boxes
    ]
    collection = {"type": "FeatureCollection", "features": features}
    path = tmp_path / "boxes.geojson"
    path.write_text(json.dumps(collection), "utf-8")
    hint = "and 2 more pairs of {}; overlap='first' gives what they share to the first one$"
    for given in (boxes, collection, path):
        is_file = given is path
        kind = "features" if is_file else "geometries"
        name = re.escape(f"{path}: ") if is_file else ""
        words = rf"^{name}{kind} 0 and 1 overlap at [0-9. ]*, {hint.format(kind)}"
        for call in (
            lambda given=given: CELLS.clip(given, values=[1, 2, 3]),
            lambda given=given: rondel.polygons(given, overlap="error"),
            lambda given=given: rondel.feature_cells(given, 500),
        ):
            with pytest.raises(OSError if is_file else ValueError, match=words):
                call()
        divided = CELLS.clip(given, values=[1, 2, 3], overlap="first").areas.sum()
        assert np.isclose(divided, CELLS.clip(given).areas.sum(), rtol=1e-9)


def test_neighbors_with_other_corners_share_their_borders():
    rng = np.random.default_rng(8)
    for _ in range(10):
        a, b = rng.uniform((-100, -50), (-90, 50)), rng.uniform((90, -50), (100, 50))
        steps = np.sort(rng.uniform(0, 1, 6))
        border = [tuple(a + t * (b - a)) for t in steps]  # rounded
        north = shapely.Polygon([a, *border, b, (b[0], 80), (a[0], 80)])
        south = shapely.Polygon([a, b, (b[0], -80), (a[0], -80)])
        cells = rondel.polygons([north, south], overlap="error")
        rings = CELLS.clip(cells).dissolve([0] * 40).cell_set().rings[1]
        assert len(rings) == 2
        area = area_of(north) + area_of(south)
        assert abs(CELLS.clip([south, north]).areas.sum() - area) < 1e-5


def test_a_box_is_west_south_east_north():
    expected = rondel.polygons(shapely.box(170, -10, 190, 20)).areas
    for box in ((170, -10, -170, 20), [170, -10, 190, 20], np.array([170.0, -10, 190, 20])):
        assert np.array_equal(rondel.polygons(box).areas, expected)
        assert np.isclose(CELLS.clip(box).areas.sum(), expected[0], rtol=1e-12)
    assert rondel.polygons((-180, -90, 180, 90)).areas[0] == 4 * math.pi
    with pytest.raises(ValueError, match="the box 0 10 5 10 has no area"):
        rondel.polygons((0, 10, 5, 10))


def test_errors_name_the_geometry():
    good = shapely.box(0, 0, 1, 1)
    with np.errstate(invalid="ignore"):
        bad = shapely.Polygon([(0, 0), (1, 0), (math.nan, 1)])
    with pytest.raises(ValueError, match=r"^geometry 1 has a position that is not finite"):
        rondel.polygons([good, bad])
    tie = shapely.Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
    for given in ([good, tie], shapely.GeometryCollection([good, tie])):
        with pytest.raises(
            ValueError, match=r"geometry 1: ring 0 of part 0 crosses itself at 0\.5 0\.5"
        ):
            rondel.polygons(given)
    with pytest.raises(ValueError, match="overlap must be"):
        rondel.polygons([good], overlap="share")
    with pytest.raises(ValueError, match="tolerance_km must be positive, not -1"):
        rondel.feature_cells([good], -1)


def test_the_world_and_what_is_in_it():
    world, island = shapely.box(-180, -90, 180, 90), shapely.box(10, 10, 11, 11)
    cells = rondel.feature_cells([island, shapely.Polygon(world.exterior, [island.exterior])], 50)
    assert np.isclose(cells.areas.sum(), 4 * math.pi, rtol=1e-13)
    assert np.isclose(cells.areas[0], area_of(island), rtol=1e-4)
    alone = rondel.feature_cells([world, {"type": "Point", "coordinates": [0, 0]}], 50)
    assert alone.areas.tolist() == [4 * math.pi, 0]
    both = rondel.polygons([island, world], overlap="first").areas
    assert np.isclose(both.sum(), 4 * math.pi, rtol=1e-13)
    for order in itertools.permutations([island, world, shapely.box(10.5, 10.5, 30, 20)]):
        assert np.isclose(CELLS.clip(list(order)).areas.sum(), 4 * math.pi, rtol=1e-12)


def test_geographic_crs_are_converted_to_degrees():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    box = shapely.box(0, 0, 10, 10)
    paris = 2.5969213 * 0.9  # grads from Greenwich, of 400 to a turn
    expected = rondel.polygons(shapely.box(paris, 0, paris + 9, 9)).areas
    found = rondel.polygons(geopandas.GeoSeries([box], crs=4807)).areas  # grads of Paris
    assert found == pytest.approx(expected, rel=1e-3)
    plain = rondel.polygons(box).areas
    for crs in (4326, 4979, 4269, 4258, "IAU_2015:30100"):
        assert rondel.polygons(geopandas.GeoSeries([box], crs=crs)).areas == pytest.approx(
            plain, rel=1e-9
        )
    moon = geopandas.GeoSeries([box], crs="IAU_2015:30100").to_crs("IAU_2015:30110")
    assert rondel.polygons(moon).areas == pytest.approx(plain, rel=1e-9)


@pytest.mark.parametrize("kind", ["LOCAL_CS", "GEOGCS"])
def test_a_crs_of_geopackage_may_stand_for_none(kind):
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    crs = {
        "LOCAL_CS": 'LOCAL_CS["Undefined Cartesian SRS",UNIT["Meter",1],AXIS["Easting",EAST],'
        'AXIS["Northing",NORTH]]',
        "GEOGCS": 'GEOGCS["Undefined geographic SRS",DATUM["unknown",SPHEROID["unknown",6378137,'
        '298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],'
        'AXIS["Latitude",NORTH],AXIS["Longitude",EAST]]',
    }[kind]
    box = shapely.box(0, 0, 10, 10)
    found = geopandas.GeoSeries([box], crs=crs)
    assert rondel.polygons(found).areas == pytest.approx(rondel.polygons(box).areas, rel=1e-12)
    parts = rondel.intersection(found, geopandas.GeoSeries([shapely.box(5, 5, 15, 15)]))
    assert parts.iloc[0].bounds == pytest.approx((5, 5, 10, 10), abs=0.1)
    with pytest.raises(ValueError, match="cannot be converted"):
        rondel.polygons(geopandas.GeoSeries([box], crs='LOCAL_CS["Site",UNIT["Meter",1]]'))


def test_a_crs_of_geojson_has_to_be_in_degrees():
    mapping = {
        "type": "Polygon",
        "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]],
        "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::3857"}},
    }
    with pytest.raises(ValueError, match='names "urn:ogc:def:crs:EPSG::3857"'):
        rondel.polygons(mapping)


def test_positions_may_be_arrays():
    corners = np.array([[0, 0], [10, 0], [10, 10], [0, 0]], float)
    as_lists = {"type": "Polygon", "coordinates": [corners.tolist()]}
    expected = rondel.polygons(as_lists).areas
    for coordinates in ([corners], corners[np.newaxis], [list(corners)]):
        mapping = {"type": "Polygon", "coordinates": coordinates}
        assert (rondel.polygons(mapping).areas == expected).all()
        assert (rondel.polygons([mapping]).areas == expected).all()
    with pytest.raises(ValueError, match="geometry 0 has a position that is not finite"):
        rondel.polygons([{"type": "Polygon", "coordinates": [corners * np.nan]}])


@pytest.mark.filterwarnings("ignore:there are no features")
@pytest.mark.parametrize("crs", [4326, 3857])
def test_frames_without_geometries_have_no_cells(crs):
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    diagram = rondel.SphericalVoronoi(clouds.uniform(20))
    nothing = (
        geopandas.GeoSeries([], crs=crs),
        geopandas.GeoDataFrame({"name": []}, geometry=[], crs=crs),
        geopandas.GeoSeries([None, shapely.Polygon()], crs=crs),
        geopandas.GeoDataFrame({"name": ["a"]}, geometry=[None], crs=crs),
    )
    for frame in nothing:
        cells = rondel.polygons(frame)
        assert cells.num_cells == len(frame)
        assert not cells.areas.any()
        assert not diagram.clip(frame).areas.any()
        assert not rondel.feature_cells(frame, 5).areas.any()
    mesh = rondel.mesh.from_points(diagram.points)
    assert len(mesh.cull(inside=nothing[0]).mesh.points) == 20


def test_the_box_of_geojson_is_not_read():
    box = [[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]
    polygon = {"type": "Polygon", "coordinates": [box], "bbox": [math.nan] * 4}
    feature = {"type": "Feature", "properties": {}, "geometry": polygon, "bbox": [math.inf] * 4}
    whole = {"type": "FeatureCollection", "features": [feature], "bbox": [math.nan] * 4}
    areas = rondel.polygons({**polygon, "bbox": [0, 0, 9, 9]}).areas
    for given in (polygon, feature, whole, [polygon, feature]):
        assert (rondel.polygons(given).areas == areas).all()
