# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sides of projected geometries are straight in their projection, and neighbors share them; also
across the antimeridian and around the poles."""

import clouds  # noqa: F401 (the package beside this file)
import numpy as np
import pytest

import rondel

geopandas = pytest.importorskip("geopandas")
pyproj = pytest.importorskip("pyproj")
shapely = pytest.importorskip("shapely")

CELLS = rondel.SphericalVoronoi(rondel.unit_vectors([0, 120, -120], [0, 20, -50]))


def area_of_ring(lon, lat):
    """That of straight lines in longitude and latitude, in closed form."""
    lon, lat = np.radians(lon), np.radians(lat)
    east = (np.diff(lon) + np.pi) % (2 * np.pi) - np.pi
    south, north = lat[:-1], lat[1:]
    flat = np.abs(north - south) < 1e-9
    step = np.where(flat, 1, north - south)
    sine = np.where(flat, np.sin((south + north) / 2), (np.cos(south) - np.cos(north)) / step)
    return abs((east * sine).sum())


@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
@pytest.mark.parametrize(
    ("crs", "corners"),
    [
        (3857, [(0, 0), (8e6, 1e6), (3e6, 9e6)]),
        (3035, [(2.6e6, 1.5e6), (6e6, 1.5e6), (6e6, 5e6), (2.6e6, 5e6)]),
        (3031, [(1e6, -1e6), (1e6, 1e6), (3e6, 1e6), (3e6, -1e6)]),
        (32633, [(3e5, 5e6), (7e5, 5e6), (7e5, 6e6)]),
    ],
)
def test_sides_are_those_of_the_projection(crs, corners, edges):
    shape = shapely.Polygon(corners)
    found = CELLS.clip(geopandas.GeoSeries([shape], crs=crs), edges=edges).areas.sum()
    fine = geopandas.GeoSeries([shapely.segmentize(shape, 1000.0)], crs=crs).to_crs(4326).iloc[0]
    expected = area_of_ring(*np.array(fine.exterior.coords).T)
    border = 2 * np.pi * fine.length / 360
    assert abs(found - expected) < np.radians(2e-4) * border
    plain = geopandas.GeoSeries([shape], crs=crs).to_crs(4326).iloc[0]
    assert crs == 32633 or abs(area_of_ring(*np.array(plain.exterior.coords).T) - expected) > 1e-3


@pytest.mark.parametrize(
    ("crs", "east", "north"), [(3857, 0, 4e6), (3035, 4e6, 3e6), (5070, 0, 2e6)]
)
def test_neighbors_share_their_divided_sides(crs, east, north):
    rng = np.random.default_rng(crs)
    x, y = np.meshgrid(np.linspace(-3e6, 3e6, 5), np.linspace(-3e6, 3e6, 5))
    x = x + east + rng.uniform(-2e5, 2e5, x.shape)
    y = y + north + rng.uniform(-2e5, 2e5, y.shape)
    cells = []
    for i, j in np.ndindex(4, 4):
        ring = [(x[k], y[k]) for k in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))]
        first = rng.integers(4)
        cells.append(shapely.Polygon(ring[first:] + ring[:first]))
    frame = geopandas.GeoDataFrame({"name": range(16)}, geometry=cells, crs=crs)
    found = rondel.polygons(frame)  # overlaps would be an error
    whole = CELLS.clip(geopandas.GeoSeries([frame.union_all()], crs=crs)).areas.sum()
    assert np.isclose(found.areas.sum(), whole, rtol=1e-13)


def test_lines_parts_and_holes_are_divided():
    hole = [(1e6, 3e6), (2e6, 3e6), (2e6, 4e6)]
    shell = [(0, 0), (8e6, 1e6), (3e6, 9e6)]
    parts = shapely.MultiPolygon([shapely.Polygon(shell, [hole]), shapely.box(-3e6, 0, -2e6, 1e6)])
    lists = [shapely.Polygon(shell), shapely.Polygon(hole), shapely.box(-3e6, 0, -2e6, 1e6)]

    def area_of(shape):
        return CELLS.clip(geopandas.GeoSeries([shape], crs=3857)).areas.sum()

    each = [area_of(shape) for shape in lists]
    assert np.isclose(area_of(parts), each[0] - each[1] + each[2], rtol=1e-6)
    line = geopandas.GeoSeries([None, shapely.LineString([(0, 0), (8e6, 5e6)])], crs=3857)
    found = rondel.feature_cells(line.iloc[1:], 50)
    assert len(found) == 1


def to_crs(crs, lon, lat):
    return pyproj.Transformer.from_crs(4326, crs, always_xy=True).transform(lon, lat)


def enclosed(shape, crs):
    """The area of a polygon by an integral along its border, which is divided in the CRS. Where the
    border goes around a pole, the other side of it is what lies below."""
    transform = pyproj.Transformer.from_crs(crs, 4326, always_xy=True).transform
    areas = []
    for ring in (shape.exterior, *shape.interiors):
        fine = shapely.segmentize(ring, ring.length / 40000)
        lon, lat = (np.radians(x) for x in transform(*np.array(fine.coords).T))
        east = (np.diff(lon) + np.pi) % (2 * np.pi) - np.pi
        area = abs((east * np.sin((lat[1:] + lat[:-1]) / 2)).sum())
        areas.append(2 * np.pi - area if abs(east.sum()) > np.pi else area)
    return areas[0] - sum(areas[1:])


def check_areas(shapes, crs, edges="lonlat"):
    found = rondel.polygons(geopandas.GeoSeries(shapes, crs=crs), edges=edges, overlap="keep").areas
    for k, shape in enumerate(shapes):
        assert found[k] == pytest.approx(enclosed(shape, crs), rel=1e-4), (crs, k)


ACROSS = [3832, 3994, 3460, 2193, 32660, "+proj=eqc +lon_0=180", "+proj=laea +lon_0=180 +lat_0=-20"]


@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
@pytest.mark.parametrize("crs", ACROSS)
def test_polygons_go_on_across_the_antimeridian(crs, edges):
    x, y = to_crs(crs, 179.5, -30)
    shell = shapely.box(x - 4e5, y - 3e5, x + 7e5, y + 9e5)
    holes = [shapely.box(x + dx, y, x + dx + 1e5, y + 1e5) for dx in (-3e5, 0, 3e5)]
    lake = shell.difference(shapely.union_all(holes))
    check_areas([shell, lake, *holes], crs, edges)
    parts = rondel.polygons(geopandas.GeoSeries([shapely.MultiPolygon(holes)], crs=crs))
    assert parts.areas[0] == pytest.approx(sum(enclosed(hole, crs) for hole in holes), rel=1e-4)


def test_a_box_across_the_antimeridian_is_that_box():
    box = shapely.box(*to_crs(3832, 170, -20), *to_crs(3832, 190, -10))
    expected = np.radians(20) * (np.sin(np.radians(20)) - np.sin(np.radians(10)))
    found = rondel.polygons(geopandas.GeoSeries([box], crs=3832)).areas
    assert found == pytest.approx(expected, rel=1e-5)
    web = geopandas.GeoSeries([shapely.box(-25e6, 0, -19e6, 1e6)], crs=3857)  # x beyond -180
    east = 6e6 / 6378137 * np.sin(2 * np.arctan(np.exp(1e6 / 6378137)) - np.pi / 2)
    assert rondel.polygons(web).areas == pytest.approx(east, rel=1e-5)


@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
@pytest.mark.parametrize("crs", [3413, 3031, "+proj=laea +lat_0=75 +lon_0=-100", 32660])
def test_polygons_around_a_pole_have_it_in_them(crs, edges):
    x, y = to_crs(crs, 0, -90 if crs == 3031 else 90)
    big = shapely.box(x - 2e6, y - 2.5e6, x + 2.2e6, y + 1.5e6)
    angles, radii = np.linspace(0, 2 * np.pi, 40, endpoint=False), np.tile([3e5, 2e6], 20)
    star = np.column_stack([x + radii * np.cos(angles), y + radii * np.sin(angles)])
    lakes = [shapely.box(x + s - 1e5, y + t - 1e5, x + s + 1e5, y + t + 1e5)
             for s in (-9e5, -3e5, 3e5, 9e5) for t in (-12e5, -4e5, 4e5)]  # fmt: skip
    shapes = [big, shapely.Polygon(star), shapely.Point(x + 1e5, y + 1e5).buffer(1e6)]
    if edges == "lonlat":
        lakes.append(shapely.box(x - 5e4, y - 6e4, x + 9e4, y + 8e4))  # with the pole in it
        shapes += [big.difference(lakes[-1]), big.difference(shapely.union_all(lakes))]
    check_areas(shapes, crs, edges)


def test_tiles_that_meet_at_a_pole_share_it():
    quarters = [shapely.box(0, 0, s * 1e6, t * 1e6) for s in (-1, 1) for t in (-1, 1)]
    corner = shapely.box(-1e6, -1e6, 1e6, 1e6).difference(quarters[0])  # 270 degrees at the pole
    check_areas([*quarters, corner, shapely.box(-1e6, 0, 1e6, 1e6)], 3413)
    assert rondel.polygons(geopandas.GeoSeries(quarters, crs=3413)).areas.sum() == pytest.approx(
        enclosed(shapely.box(-1e6, -1e6, 1e6, 1e6), 3413), rel=1e-4
    )


@pytest.mark.parametrize(("crs", "lon", "lat"), [(3832, 179, 3), (2193, 179, -45), (3413, 0, 89)])
def test_neighbors_across_the_antimeridian_share_their_sides(crs, lon, lat):
    rng = np.random.default_rng(crs)
    corners = np.stack(np.meshgrid(*[np.linspace(-1.5e6, 1.5e6, 7)] * 2), axis=-1)
    corners += to_crs(crs, lon, lat) + rng.uniform(-1e5, 1e5, corners.shape)
    cells = []
    for i, j in np.ndindex(6, 6):
        ring = [corners[k] for k in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))]
        first = rng.integers(4)
        cells.append(shapely.Polygon(ring[first:] + ring[:first]))
    found = rondel.polygons(geopandas.GeoSeries(cells, crs=crs))  # overlaps would be an error
    whole = rondel.polygons(geopandas.GeoSeries([shapely.union_all(cells)], crs=crs))
    assert found.areas.sum() == pytest.approx(whole.areas[0], rel=1e-13)


def test_lines_go_on_across_the_antimeridian_and_through_a_pole():
    line = shapely.LineString([to_crs(3832, 170, -20), to_crs(3832, 190, -20)])
    point = shapely.Point(to_crs(3832, 179.9, 40))
    found = rondel.feature_cells(geopandas.GeoSeries([line, point], crs=3832), 50)
    plain = [shapely.LineString([(170, -20), (190, -20)]), shapely.Point(179.9, 40)]
    assert found.areas == pytest.approx(rondel.feature_cells(plain, 50).areas, rel=1e-3)
    across = geopandas.GeoSeries(
        [shapely.LineString([(-1e6, y), (1e6, y)]) for y in (-1e5, 1e5)], crs=3413
    )
    through = geopandas.GeoSeries([shapely.LineString([(-1e6, 0), (1e6, 0)])], crs=3413)
    halves = rondel.feature_cells(across, 50).areas
    assert halves[0] == pytest.approx(halves[1], rel=5e-3)
    assert rondel.feature_cells(through, 50).areas == pytest.approx(4 * np.pi)


@pytest.mark.parametrize(("crs", "unit", "meridian"), [(4322, 1, 0), (4807, 0.9, 2.33722917)])
def test_geographic_systems_keep_their_turns(crs, unit, meridian):
    """Conversion of datums brings longitudes to -180 to 180; a side is as long as it was."""
    for west, east in ((170, 190), (-170, 170), (-190, -170)):
        box = shapely.box(
            (west - meridian) / unit, -20 / unit, (east - meridian) / unit, -10 / unit
        )
        expected = rondel.polygons([shapely.box(west, -20, east, -10)]).areas
        found = rondel.polygons(geopandas.GeoSeries([box], crs=crs)).areas
        assert found == pytest.approx(expected, rel=1e-3)


def test_a_corner_on_the_side_of_another_ring_is_a_corner_of_both():
    shell, hole = shapely.box(0, 0, 4e6, 4e6), shapely.Polygon([(0, 1e6), (2e6, 1e6), (2e6, 2e6)])
    check_areas([shell.difference(hole), hole], 3035)
    pieces = [shapely.box(0, 4e6, 1e6 * k, 5e6) for k in (3,)]
    pieces += [shapely.box(1e6 * k, 5e6, 1e6 * (k + 1), 6e6) for k in range(3)]
    pieces += [shapely.box(3e6, 4e6 + k * 5e5, 4e6, 4.5e6 + k * 5e5) for k in range(4)]
    found = rondel.polygons(geopandas.GeoSeries(pieces, crs=3035)).areas.sum()
    whole = rondel.polygons(geopandas.GeoSeries([shapely.union_all(pieces)], crs=3035)).areas[0]
    assert found == pytest.approx(whole, rel=1e-12)
