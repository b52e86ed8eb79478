# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Points and lines in set operations and relations, with shapely's as the oracle where lines are
along a lattice: on meridians and parallels, whose arcs Rondel draws within a tolerance.
"""

import math

import numpy as np
import pytest

import rondel

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")

PREDICATES = (
    "intersects",
    "disjoint",
    "contains",
    "within",
    "covers",
    "covered_by",
    "touches",
    "crosses",
    "overlaps",
    "equals",
)
ACROSS = shapely.LineString([(170, 5), (190, 5)])
BOX = shapely.box(175, 0, 185, 10)


def walks(random, number):
    """Lines along the lattice that go straight or turn, and may meet themselves."""
    made = []
    for _ in range(number):
        places = [random.integers(0, 4, 2)]
        for _ in range(random.integers(1, 5)):
            step = [(0, 1), (1, 0), (0, -1), (-1, 0)][random.integers(4)]
            places.append(places[-1] + np.multiply(step, random.integers(1, 3)))
        made.append(shapely.LineString(places))
    return made


def geometries(random, number):
    """Points, lines and polygons of the lattice."""
    made = []
    for _ in range(number):
        kind = random.integers(4)
        if kind == 0:
            made.append(shapely.MultiPoint(random.integers(0, 4, (random.integers(1, 4), 2))))
        elif kind == 1:
            made.append(shapely.MultiLineString(walks(random, random.integers(1, 3))))
        elif kind == 2:
            made.append(walks(random, 1)[0])
        else:
            x, y = random.integers(0, 3, 2)
            made.append(shapely.box(x, y, x + random.integers(1, 3), y + 1))
    return np.array(made, object)


def shares_ends(shape):
    """Whether several lines end in one place."""
    if shape.geom_type != "MultiLineString":
        return False
    ends = [line.coords[k] for line in shape.geoms for k in (0, -1)]
    return len({*ends}) < len(ends)


class TestRelations:
    @pytest.mark.filterwarnings("ignore:invalid value")
    def test_geometries_of_a_lattice_lie_as_in_the_plane(self):
        random = np.random.default_rng(2)
        a, b = geometries(random, 1000), geometries(random, 1000)
        # Shapely may forget the boundary of lines that have ends in common.
        are_known = [not (shares_ends(x) or shares_ends(y)) for x, y in zip(a, b, strict=True)]
        a, b = a[are_known], b[are_known]
        expected = shapely.relate(a, b)
        assert len(set(expected)) > 40
        np.testing.assert_array_equal(rondel.relate(a, b), expected)
        for name in PREDICATES:
            found = getattr(rondel, name)(a, b)
            np.testing.assert_array_equal(found, getattr(shapely, name)(a, b), name)

    def test_the_date_line_divides_no_line(self):
        assert rondel.crosses(ACROSS, BOX)
        assert rondel.within(shapely.LineString([(-179, 1), (-176, 9)]), BOX)
        assert rondel.contains(BOX, [shapely.Point(180, 5), shapely.Point(-180, 10)]).tolist() == [
            True,
            False,
        ]
        assert rondel.equals(ACROSS, shapely.LineString([(-190, 5), (-170, 5)]))


class TestSetOperations:
    @pytest.mark.parametrize(
        "name", ["intersection", "union", "difference", "symmetric_difference"]
    )
    def test_lines_of_a_lattice_are_divided_as_in_the_plane(self, name):
        random = np.random.default_rng(3)
        a, b = geometries(random, 200), geometries(random, 200)
        found = getattr(rondel, name)(a, b)
        # Shapely divides lines where they cross only if they have to be looked at.
        expected = np.array([shapely.union_all([x]) for x in getattr(shapely, name)(a, b)])
        if name == "intersection":  # of polygons only polygons
            are_polygons = (shapely.get_dimensions(a) == 2) & (shapely.get_dimensions(b) == 2)
            found, expected = found[~are_polygons], expected[~are_polygons]
        np.testing.assert_array_equal(shapely.is_empty(found), shapely.is_empty(expected))
        np.testing.assert_allclose(shapely.length(found), shapely.length(expected), atol=1e-2)
        found, expected = found[~shapely.is_empty(found)], expected[~shapely.is_empty(found)]
        assert shapely.covers(shapely.buffer(expected, 5e-3), found).all()
        assert shapely.covers(shapely.buffer(found, 5e-3), expected).all()

    def test_lengths_add_up(self):
        random = np.random.default_rng(4)
        lines = [shapely.LineString(random.uniform(-90, 90, (9, 2))) for _ in range(50)]
        boxes = [shapely.box(west, -60, west + 50, 70) for west in random.uniform(-90, 60, 50)]
        both = rondel.intersection(lines, boxes)
        rest = rondel.difference(lines, boxes)
        np.testing.assert_allclose(
            rondel.length(both) + rondel.length(rest), rondel.length(lines), rtol=1e-7
        )

    def test_kinds_are_told_apart(self):
        point = shapely.Point(180, 5)
        assert rondel.intersection(ACROSS, point).equals(shapely.Point(180, 5))
        assert rondel.intersection(ACROSS, BOX).geom_type == "MultiLineString"
        assert rondel.intersection(shapely.Point(0, 0), BOX).is_empty
        assert rondel.union(point, shapely.Point(3, 3)).geom_type == "MultiPoint"
        assert rondel.union(ACROSS, shapely.Point(3, 3)).geom_type == "GeometryCollection"
        assert rondel.intersection([ACROSS, None], BOX)[1] is None
        cells = rondel.CellSet.from_geometries([BOX])
        assert rondel.intersection(ACROSS, cells)[0].geom_type == "MultiLineString"
        assert rondel.union_all([ACROSS, BOX, point]).geom_type == "GeometryCollection"

    def test_measures_are_those_of_lines(self):
        quarter = shapely.LineString([(0, 0), (90, 0)])
        shapes = [quarter, shapely.Point(1, 1), None, shapely.box(-180, 0, 180, 90)]
        found = rondel.length(shapes)
        np.testing.assert_allclose(found[[0, 1, 3]], [math.pi / 2, 0, 2 * math.pi], atol=1e-12)
        assert np.isnan(found[2])
        np.testing.assert_allclose(rondel.area(shapes)[[0, 1, 3]], [0, 0, 2 * math.pi], atol=1e-12)
        assert rondel.length(quarter, edges="geodesic") == pytest.approx(math.pi / 2)


class TestOverlay:
    def test_tables_of_lines_have_the_columns_of_polygons(self):
        roads = geopandas.GeoDataFrame(
            {"road": ["through", "touching"]},
            geometry=[ACROSS, shapely.LineString([(170, -5), (175, 0)])],
            crs=4326,
        )
        zones = geopandas.GeoDataFrame({"zone": ["box"]}, geometry=[BOX], crs=4326)
        with pytest.warns(UserWarning, match="1 lines and points in which geometries only meet"):
            found = rondel.overlay(roads, zones)
        assert found[["road", "zone"]].to_numpy().tolist() == [["through", "box"]]
        found = rondel.overlay(roads, zones, keep_geom_type=False)
        assert found.geometry.geom_type.tolist() == ["MultiLineString", "Point"]
        with pytest.warns(UserWarning, match="only meet"):
            found, rows, others = rondel.overlay(roads, zones, "union", return_indices=True)
        assert (rows.tolist(), others.tolist()) == ([0, 0, 1, -1], [0, -1, -1, 0])
        assert found.geometry.geom_type.tolist()[-1] == "MultiPolygon"

    def test_points_are_joined_as_by_geopandas(self):
        random = np.random.default_rng(5)
        places = geopandas.GeoDataFrame(
            {"k": np.arange(400)},
            geometry=shapely.points(random.uniform(-9, 9, (400, 2))),
            crs=4326,
        )
        boxes = geopandas.GeoDataFrame(
            {"b": range(9)},
            geometry=[shapely.box(x, -5, x + 3, 5) for x in range(-9, 9, 2)],
            crs=4326,
        )
        _, rows, others = rondel.overlay(places, boxes, return_indices=True)
        expected = boxes.sindex.query(places.geometry, predicate="intersects")
        assert sorted(zip(rows, others, strict=True)) == sorted(zip(*expected, strict=True))


class TestSimplify:
    def test_lines_are_simplified_together(self):
        border = [(0, 0), (1, 0.001), (2, 0)]
        line, box = shapely.LineString(border), shapely.Polygon([*border, (2, 2), (0, 2)])
        found = rondel.simplify([line, box, shapely.Point(1, 1), None], 5, radius=6371.0088)
        assert shapely.get_num_coordinates(found[:3]).tolist() == [2, 5, 1]
        assert found[3] is None


def test_lines_that_cross_have_one_point_there():
    """Crossings of small integers, many of them in a position that divides one of the lines."""
    generator = np.random.default_rng(5)

    def lines(east, north):
        for _ in range(400):
            ends = generator.integers(0, 6, (2, 2))
            if (ends[0] != ends[1]).any():
                yield shapely.LineString(ends + np.array([east, north]))

    for east, north in ((0, 0), (30, -4), (-4, 40), (30, 60)):
        first, second = (np.array([*lines(east, north)][:350]) for _ in range(2))
        expected = shapely.intersection(first, second)
        made = rondel.intersection(first, second)
        assert shapely.is_valid(made).all()
        np.testing.assert_array_equal(
            [shape.geom_type for shape in made if not shape.is_empty],
            [shape.geom_type for shape in expected if not shape.is_empty],
        )
        assert np.nanmax(shapely.hausdorff_distance(made, expected)) < 0.02
        alone = [rondel.intersection(a, b) for a, b in zip(first[:40], second[:40], strict=True)]
        assert [shape.geom_type for shape in alone] == [shape.geom_type for shape in made[:40]]
