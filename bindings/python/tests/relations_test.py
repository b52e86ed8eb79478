# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Relations of polygons, with shapely's as the oracle where sides are along a lattice."""

import numpy as np
import pytest

import rondel

geopandas = pytest.importorskip("geopandas")
pandas = pytest.importorskip("pandas")
shapely = pytest.importorskip("shapely")

PREDICATES = (
    "intersects",
    "disjoint",
    "contains",
    "within",
    "covers",
    "covered_by",
    "touches",
    "overlaps",
    "equals",
)


def unions_of_squares(random, number):
    """Unions of squares of a lattice, whose sides are along meridians and parallels."""
    made = []
    for _ in range(number):
        corners = random.integers(0, 4, (int(random.integers(1, 5)), 2))
        made.append(shapely.union_all([shapely.box(x, y, x + 1, y + 1) for x, y in corners]))
    return np.array(made)


class TestRelations:
    def test_polygons_of_a_lattice_lie_as_in_the_plane(self):
        random = np.random.default_rng(1)
        a, b = unions_of_squares(random, 300), unions_of_squares(random, 300)
        expected = shapely.relate(a, b)
        assert len(set(expected)) > 8
        np.testing.assert_array_equal(rondel.relate(a, b), expected)
        for name in PREDICATES:
            found = getattr(rondel, name)(a, b)
            np.testing.assert_array_equal(found, getattr(shapely, name)(a, b), name)
        found = rondel.relate_pattern(a, b, "T*T******")
        np.testing.assert_array_equal(found, shapely.relate_pattern(a, b, "T*T******"))

    def test_the_date_line_and_poles_divide_nothing(self):
        cap, ring = shapely.box(-180, 60, 180, 90), shapely.box(-180, 50, 180, 60)
        assert rondel.touches(cap, ring)
        assert rondel.contains(cap, shapely.box(170, 70, 190, 80))
        assert rondel.touches(shapely.box(170, 0, 180, 1), shapely.box(-180, 0, -170, 1))
        whole = shapely.box(-180, -90, 180, 90)
        assert rondel.relate(whole, cap) == "212FFFFFF"

    def test_shapes_and_indices_are_those_of_set_operations(self):
        box = shapely.box(0, 0, 1, 1)
        assert rondel.intersects(box, box) is np.True_
        assert rondel.relate(np.array([[box, box]]), box).shape == (1, 2)
        first = geopandas.GeoSeries([box, box, None], index=[1, 2, 3])
        second = geopandas.GeoSeries([box, box], index=[2, 4])
        pandas.testing.assert_series_equal(
            rondel.intersects(first, second),
            pandas.Series([False, True, False, False], index=[1, 2, 3, 4]),
        )
        assert rondel.relate(first, box).tolist() == ["2FFF1FFF2", "2FFF1FFF2", None]
        cells = rondel.CellSet.from_geometries([box])
        assert rondel.equals(cells, cells)[0]

    def test_what_is_no_question_is_refused(self):
        box = shapely.box(0, 0, 1, 1)
        with pytest.raises(ValueError, match="pattern"):
            rondel.relate_pattern(box, box, "T*T")
        bow = shapely.Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
        with pytest.raises(ValueError, match=r"^b: geometry 0: ring 0 of part 0 crosses itself"):
            rondel.contains(box, [bow])
        with pytest.warns(UserWarning, match="was repaired"):
            assert rondel.contains(box, bow, invalid="repair")


class TestBuffers:
    def test_disks_have_the_area_of_caps(self):
        places = [shapely.Point(0, 0), shapely.Point(180, 45), shapely.Point(30, 90)]
        for angle in (1e-3, 0.5, 2.0):
            found = rondel.area(rondel.buffer(places, angle, tolerance=angle / 1e4))
            cap = 2 * np.pi * (1 - np.cos(angle))
            np.testing.assert_allclose(found, cap, rtol=2e-3)

    def test_lines_and_polygons_grow_and_shrink(self):
        line = shapely.LineString([(0, 0), (60, 0)])
        strip = rondel.buffer(line, 0.1)
        cap = 2 * np.pi * (1 - np.cos(0.1))
        assert abs(rondel.area(strip) - cap - 2 * np.sin(0.1) * np.pi / 3) < 2e-3
        box = shapely.box(0, 0, 10, 10)
        grown, shrunk = rondel.buffer(box, 100, 6371), rondel.buffer(box, -100, 6371)
        assert rondel.contains(grown, box)
        assert rondel.contains(box, shrunk)
        assert rondel.buffer(box, -1000, 6371).is_empty
        whole = rondel.buffer(box, 4.0)
        assert whole.equals(shapely.box(-180, -90, 180, 90))

    def test_results_are_of_the_kind_of_the_argument(self):
        points = geopandas.GeoSeries([shapely.Point(0, 0), None], index=["a", "b"], crs=4326)
        made = rondel.buffer(points, 0.1)
        assert made.index.tolist() == ["a", "b"]
        assert made.crs == points.crs
        assert made["b"] is None
        cells = rondel.buffer(rondel.CellSet.from_geometries([shapely.box(0, 0, 1, 1)]), 0.1)
        assert isinstance(cells, rondel.CellSet)
        with pytest.raises(ValueError, match="finite"):
            rondel.buffer(shapely.Point(0, 0), np.inf)
        with pytest.raises(ValueError, match="radius"):
            rondel.buffer(shapely.Point(0, 0), 1, 0)
