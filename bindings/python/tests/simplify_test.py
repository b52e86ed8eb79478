# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""`rondel.simplify`, beside shapely on small coverages."""

import pathlib

import geopandas
import numpy as np
import pytest
import shapely

import rondel

EARTH = 6371.0088
COUNTRIES = pathlib.Path(__file__).resolve().parents[3] / "data" / "countries-110m.geojson"


def coverage(seed, size):
    """Four polygons around a place near (0, 0), with wiggly borders, in degrees."""
    random = np.random.default_rng(seed)

    def line(a, b):
        t = np.linspace(0, 1, 60)[:, None]
        wiggles = random.normal(0, 0.01, (60, 1)) * [1, 1]
        wiggles[[0, -1]] = 0
        return shapely.LineString((1 - t) * a + t * b + wiggles * (b - a)[::-1])

    corners = np.array([(0, 0), (2, 0), (2, 2), (0, 2)]) * 1.0
    lines = [line(corners[k], corners[(k + 1) % 4]) for k in range(4)]
    middles = [shapely.get_point(each, 30) for each in lines]
    lines += [line(np.array(m.coords[0]), np.array([1.0, 1.0])) for m in middles]
    parts = list(shapely.polygonize([shapely.union_all(lines)]).geoms)
    return [shapely.transform(p, lambda x: x * size) for p in parts]


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
def test_a_coverage_stays_one_beside_shapely(seed, edges):
    given = coverage(seed, 0.1)
    assert shapely.coverage_is_valid(given)
    assert len(given) >= 4
    tolerance = 0.8
    made = rondel.simplify(given, tolerance, EARTH, edges=edges)
    assert shapely.is_valid(made).all()
    assert shapely.coverage_is_valid(made)
    before, after = shapely.get_num_coordinates(given), shapely.get_num_coordinates(made)
    assert after.sum() < before.sum() / 2
    degrees = np.degrees(tolerance / EARTH)
    for a, b in zip(given, made, strict=True):
        assert shapely.hausdorff_distance(a.exterior, b.exterior, 0.01) < 1.01 * degrees
    union, simple = shapely.union_all(given), shapely.union_all(made)
    assert simple.geom_type == union.geom_type == "Polygon"


def test_a_boundary_may_stay():
    given = coverage(1, 0.1)
    made = rondel.simplify(given, 1, EARTH, simplify_boundary=False, edges="geodesic")
    outer = shapely.union_all(given).exterior
    kept = shapely.union_all(made).exterior
    assert shapely.hausdorff_distance(outer, kept) < 1e-9
    assert shapely.get_num_coordinates(made).sum() < shapely.get_num_coordinates(given).sum()


def test_kinds_come_back():
    frame = geopandas.read_file(COUNTRIES)
    made = rondel.simplify(frame, 50, EARTH)
    assert isinstance(made, geopandas.GeoDataFrame)
    assert made["name"].equals(frame["name"])
    assert made.is_valid.all()
    assert made.geometry.count_coordinates().sum() < frame.geometry.count_coordinates().sum()
    cells = rondel.CellSet.from_geometries(frame)
    simple = rondel.simplify(cells, 50 / EARTH)
    assert simple.num_cells == cells.num_cells
    assert abs(simple.areas.sum() - cells.areas.sum()) < 0.02 * cells.areas.sum()
    assert rondel.simplify([None, shapely.box(0, 0, 1, 1)], 0.001)[0] is None
    assert rondel.simplify([], 1).size == 0


def test_small_rings_may_vanish():
    shapes = [shapely.Point(179.99, 5).buffer(0.05), shapely.box(0, 0, 5, 5)]
    kept = rondel.simplify(shapes, 20, EARTH)
    assert not kept[0].is_empty
    dropped = rondel.simplify(shapes, 20, EARTH, drop_small=True)
    assert dropped[0].is_empty
    assert not dropped[1].is_empty


def test_what_is_wrong_is_told():
    box = shapely.box(0, 0, 1, 1)
    with pytest.raises(ValueError, match="tolerance is negative"):
        rondel.simplify(box, -1)
    with pytest.raises(ValueError, match="geometries: "):
        rondel.simplify([box, shapely.LineString([(0, 0), (190, 1)])], 1)
    tie = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    with pytest.raises(ValueError, match="crosses itself"):
        rondel.simplify(tie, 0.01)
