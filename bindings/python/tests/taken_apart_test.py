# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Geometries of shapely, read as arrays, beside the same ones as GeoJSON, read as text."""

import json
import math
import pathlib
import warnings

import numpy as np
import pytest

import rondel

shapely = pytest.importorskip("shapely")

DATA = pathlib.Path(__file__).parents[3] / "data"
GEODESIC = {"edges": "geodesic"}
BOX = shapely.box(0, 0, 1, 1)
TIE = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
HIGH = shapely.Polygon(
    [(5, 0, 1), (6, 0, math.pi), (6, 1, -3)], [[(5.9, 0.2, 1), (5.9, 0.3, 1), (5.8, 0.2, 1)]]
)
EMPTY = [
    None,
    shapely.Polygon(),
    shapely.MultiPolygon(),
    shapely.GeometryCollection(),
    shapely.Point(),
    shapely.LineString(),
    shapely.MultiPoint(),
]
HOSTILE = [
    BOX,
    *EMPTY,
    shapely.box(170, -20, 190, -10),
    shapely.box(-190, -15, -171, -5),
    shapely.box(-180, -90, 180, 90),
    shapely.box(-180, 60, 180, 90),
    shapely.Polygon([(-180, -90), (-180, -70), (0, -60), (180, -70), (180, -90), (0, -90)]),
    shapely.Polygon([(0, 0), (0, 1), (1, 1), (1, 0)], [[(0.2, 0.2), (0.4, 0.2), (0.4, 0.4)]]),
    HIGH,
    shapely.MultiPolygon([BOX, shapely.box(1, 0, 2, 1), HIGH]),
    shapely.GeometryCollection([shapely.MultiPolygon([BOX]), shapely.GeometryCollection([HIGH])]),
    shapely.GeometryCollection([shapely.GeometryCollection()]),
    shapely.Polygon([(0, 0), (np.nextafter(1, 2), -0.0), (1, 1e-300), (5e-324, 1)]),
    shapely.Polygon([(0, 0), (1e-14, 0), (1e-14, 1e-14)]),
]
FAULTY = [
    TIE,
    shapely.Polygon([(0, 0)] * 4),
    shapely.Polygon(BOX.exterior, [shapely.box(5, 5, 6, 6).exterior]),
    shapely.MultiPolygon([BOX, shapely.box(0.5, 0.5, 2, 2)]),
    shapely.Polygon([(lon, -70) for lon in range(-180, 180, 10)]),
    shapely.box(5000, 0, 5001, 1),
]


def countries():
    found = json.loads((DATA / "countries-110m.geojson").read_text())["features"]
    return [shapely.geometry.shape(feature["geometry"]) for feature in found]


def mapping(shape):
    return None if shape is None else shapely.geometry.mapping(shape)


def features(shapes):
    """The same geometries, as GeoJSON where None has a place."""
    return [{"type": "Feature", "properties": {}, "geometry": mapping(shape)} for shape in shapes]


def plain(found):
    """The bits of a result."""
    if isinstance(found, rondel.CellSet):
        return [array.tobytes() for array in (*found.rings, found.whole)]
    if isinstance(found, np.ndarray) and found.dtype == object:
        return [plain(item) for item in found.ravel()]
    if isinstance(found, shapely.Geometry):
        return shapely.to_wkb(found)
    return found.tobytes() if isinstance(found, np.ndarray) else found


def outcome(call, *given, **options):
    """The bits, or the error, with the warnings."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            found = plain(call(*given, **options))
        except (TypeError, ValueError) as error:
            found = type(error), str(error)
    return found, [str(warning.message) for warning in told]


CALLS = {
    "area": rondel.area,
    "validity": rondel.validity_reason,
    "repair": rondel.make_valid,
    "simplify": lambda shapes, **options: rondel.simplify(shapes, 0.002, **options),
    "buffer": lambda shapes, **options: rondel.buffer(shapes, 0.01, **options),
    "union_all": rondel.union_all,
    "cells": lambda shapes, **options: rondel.CellSet.from_geometries(
        shapes, overlap="first", **options
    ),
}


@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
@pytest.mark.parametrize("name", CALLS)
def test_arrays_and_text_have_the_same_results(name, edges):
    for shapes in (countries(), HOSTILE, EMPTY):
        rules = {"edges": edges}
        if name not in ("validity", "repair"):
            rules["invalid"] = "repair"
        assert outcome(CALLS[name], shapes, **rules) == outcome(
            CALLS[name], features(shapes), **rules
        )


@pytest.mark.parametrize("edges", ["lonlat", "geodesic"])
@pytest.mark.parametrize("name", CALLS)
def test_arrays_and_text_have_the_same_errors(name, edges):
    rules = {"edges": edges}
    for shape in FAULTY:
        for shapes in ([shape], [BOX, None, shape]):
            for more in ({}, {} if name in ("validity", "repair") else {"invalid": "repair"}):
                found = outcome(CALLS[name], shapes, **rules, **more)
                assert found == outcome(CALLS[name], features(shapes), **rules, **more)


def test_random_rings_have_the_same_results():
    rng = np.random.default_rng(11)
    for _ in range(40):
        shapes = []
        for _ in range(rng.integers(1, 6)):
            middle = rng.uniform((-200, -88), (200, 88))
            rings = [middle + rng.uniform(-2, 2, (rng.integers(3, 7), 2)) for _ in range(2)]
            shapes.append(shapely.Polygon(rings[0], rings[1:] if rng.random() < 0.5 else None))
        if rng.random() < 0.5:
            shapes = [shapely.MultiPolygon(shapes), *shapes[:2]]
        for name, call in CALLS.items():
            rules = {} if name in ("validity", "repair") else {"invalid": "repair"}
            assert outcome(call, shapes, **rules) == outcome(call, features(shapes), **rules)


def test_pairs_have_the_same_results():
    land = countries()
    window = shapely.box(150, -60, 200, 60)
    for call in (rondel.intersection, rondel.difference, rondel.relate, rondel.contains):
        found = outcome(call, land, window)
        assert found == outcome(call, features(land), mapping(window))
        assert found == outcome(call, land, (150, -60, 200, 60))
        assert found == outcome(call, land, mapping(window))  # arrays and text together
    assert outcome(rondel.union, HIGH, TIE)[0] == (
        ValueError,
        "b: ring 0 of part 0 crosses itself at 1 1",
    )
    shapes = np.array([[BOX, None], [HIGH, shapely.Polygon()]])
    assert rondel.area(shapes).shape == (2, 2)
    assert plain(rondel.area(shapes)) == plain(rondel.area(features(shapes.ravel())))


def test_tables_have_the_same_results():
    geopandas = pytest.importorskip("geopandas")
    shapes = [*countries(), None, shapely.Polygon()]
    series = geopandas.GeoSeries(shapes, crs=4326)
    frame = geopandas.GeoDataFrame({"name": range(len(shapes))}, geometry=series)
    plane = geopandas.GeoSeries([BOX, None, HIGH], crs=4326).to_crs(3857)
    for name, call in CALLS.items():
        wanted = outcome(call, features(shapes))
        for given in (series, frame, frame[["geometry"]], series.array):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = call(given)
            if name in ("repair", "simplify", "buffer"):
                found = np.asarray(getattr(found, "geometry", found), object)
            assert plain(found) == wanted[0]
    found, wanted = rondel.area(plane), rondel.area([BOX, None, HIGH])
    assert np.allclose(found, wanted, 1e-7, 0, equal_nan=True)


def test_names_of_rows_are_told():
    geopandas = pytest.importorskip("geopandas")
    name = ["Sudan", "Chad", None]
    frame = geopandas.GeoDataFrame({"name": name}, geometry=[BOX, None, shapely.box(0, 0, 2, 2)])
    for rules in ({"overlap": "error"}, {"invalid": "repair"}):
        for given in (frame, frame.set_geometry([BOX, TIE, TIE])):
            text = json.loads(given.to_json())
            found = outcome(rondel.CellSet.from_geometries, given, **rules)
            assert found == outcome(rondel.CellSet.from_geometries, text, **rules)
            assert "(Sudan)" in str(found) or "(Chad)" in str(found) or not found[1]
    cells = rondel.CellSet.from_geometries(frame, overlap="first")
    wanted = rondel.CellSet.from_geometries(json.loads(frame.to_json()), overlap="first")
    assert cells._cells.facts.columns[0].__reduce__() == wanted._cells.facts.columns[0].__reduce__()


def test_lines_and_points_are_taken_apart_too():
    line = shapely.LineString([(0, 0, 5), (1, 1, 5), (2, 0, 5)])
    several = shapely.GeometryCollection(
        [
            shapely.MultiPoint([(3, 3), (4, 4)]),
            shapely.MultiLineString([line]),
            BOX,
            shapely.Point(),
        ]
    )
    shapes = [line, None, shapely.Point(7, 7), several, shapely.Point(), BOX]
    assert outcome(CALLS["buffer"], shapes)[0][5] == plain(CALLS["buffer"](BOX))
    simple = shapely.GeometryCollection([part for part in several.geoms if not part.is_empty])
    given = [simple if shape is several else shape for shape in shapes]
    assert outcome(CALLS["buffer"], shapes) == outcome(CALLS["buffer"], features(given))
    for name, call in CALLS.items():
        if name == "buffer":
            continue
        for shape in (line, simple, shapely.LinearRing([(0, 0), (1, 0), (1, 1)])):
            found = outcome(call, [BOX, shape])
            if name in ("validity", "repair", "cells") or shape.geom_type == "LinearRing":
                assert found[0][0] is ValueError
            assert found == outcome(call, features([BOX, shape]))


def test_numbers_that_are_no_places_are_told():
    with np.errstate(invalid="ignore"):
        bad = shapely.Polygon([(0, 0), (1, 0), (1, math.nan)])
    assert outcome(rondel.area, [BOX, None, bad]) == outcome(
        rondel.area, features([BOX, None, bad])
    )
    north = shapely.box(0, 0, 1, 91)
    for shapes in (north, [BOX, shapely.MultiPolygon([BOX, north])]):
        (kind, message), _ = outcome(rondel.area, shapes)
        assert kind is ValueError
        assert message.startswith("geometries: ")
        assert message.endswith("latitude 91 is outside [-90, 90]")
    # Heights do not matter.
    with np.errstate(invalid="ignore"):
        high = shapely.Polygon([(0, 0, 1), (1, 0, 1), (1, 1, math.nan)])
    assert rondel.area(high) == rondel.area(shapely.force_2d(high))


def test_empty_parts_do_not_matter():
    parts = shapely.from_wkt("MULTIPOLYGON (EMPTY, ((0 0, 1 0, 1 1, 0 0)), EMPTY)")
    some = shapely.GeometryCollection([shapely.Point(), parts, shapely.LineString()])
    for shapes in ([parts], [some], [parts, None, some]):
        filled = [None if shape is None else shapely.box(0, 0, 1, 1) for shape in shapes]
        assert plain(rondel.is_valid(shapes)) == plain(rondel.is_valid(filled))
    assert rondel.area(parts) == rondel.area(some) == rondel.area(parts.geoms[1])


def test_single_geometries_are_cells():
    assert rondel.CellSet.from_geometries(BOX).num_cells == 1
    assert rondel.CellSet.from_geometries(shapely.Polygon()).num_cells == 1
    both = shapely.GeometryCollection([BOX, shapely.MultiPolygon([HIGH])])
    assert plain(rondel.CellSet.from_geometries(both)) == plain(
        rondel.CellSet.from_geometries(mapping(both))
    )
    with pytest.warns(UserWarning, match="there are no features"):
        assert rondel.CellSet.from_geometries(shapely.GeometryCollection()).num_cells == 0
