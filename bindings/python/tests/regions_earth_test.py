# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Cells of the stations on the land and in the countries of data/: areas, borders, validity."""

import collections
import csv
import itertools
import json
import pathlib

import numpy as np
import pytest

import rondel

DATA = pathlib.Path(__file__).resolve().parents[3] / "data"
LAND = DATA / "land-110m.geojson"
COUNTRIES = DATA / "countries-110m.geojson"
# They cross each other in the source.
CROSSED = {"Sudan", "S. Sudan", "Ethiopia"}

pytestmark = [
    pytest.mark.skipif(not LAND.exists(), reason="the data are not in the package"),
]


@pytest.fixture(scope="module")
def stations():
    with open(DATA / "stations.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return np.array([[float(row["longitude"]), float(row["latitude"])] for row in rows])


@pytest.fixture(scope="module")
def cells(stations):
    return rondel.SphericalVoronoi.from_lonlat(*stations.T)


def sides_of(regions):
    """How often each side occurs, by its ends, less how often it occurs the other way."""
    _, rings, corners, points = regions.cell_set().rings
    sides = collections.Counter()
    for begin, end in itertools.pairwise(rings):
        ring = [points[k].tobytes() for k in corners[begin:end]]
        for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
            sides[min(a, b), max(a, b)] += 1 if a < b else -1
    return {side: number for side, number in sides.items() if number != 0}


def area_of_lines(geojson):
    """By Green's formula, along lines that are straight in longitude and latitude."""
    total = 0.0
    for geometry in geojson:
        polygons = geometry["coordinates"]
        for polygon in [polygons] if geometry["type"] == "Polygon" else polygons:
            for number, ring in enumerate(polygon):
                lon, lat = np.radians(np.array(ring, float)).T
                # Along a straight line the mean of sin is not the sine of the mean.
                a, b = lat[:-1], lat[1:]
                half = (b - a) / 2
                mean = np.sin((a + b) / 2) * np.sinc(half / np.pi)
                area = abs(np.sum(np.diff(lon) * mean))
                total += area if number == 0 else -area
    return total


def geometries_of(path):
    document = json.loads(path.read_text("utf-8"))
    if "features" in document:
        return [feature["geometry"] for feature in document["features"]]
    return document.get("geometries", [document])


@pytest.mark.parametrize("path", [LAND, COUNTRIES])
def test_areas_add_up_to_the_polygons(cells, path):
    own = rondel.CellSet.read(path, overlap="first").areas
    clipped = cells.clip(path)
    assert np.isclose(clipped.areas.sum(), own.sum(), rtol=1e-12, atol=0)
    # Three countries overlap by some square kilometers, which count once.
    assert path == LAND or own.sum() < rondel.polygons(path).areas.sum() - 1e-7
    # Lines are straight in longitude and latitude, arcs within 0.0001 degrees of them.
    assert np.isclose(own.sum(), area_of_lines(geometries_of(path)), rtol=1e-5)


@pytest.mark.parametrize("path", [LAND, COUNTRIES])
def test_every_border_is_shared_by_two_or_is_the_polygons(cells, path):
    """No slivers and no gaps: what no second cell has is a side of all cells as one."""
    clipped = cells.clip(path)
    outer = sides_of(clipped)
    whole = clipped.dissolve(np.zeros(len(clipped), int))
    assert outer == sides_of(whole)
    twice = [side for side, number in outer.items() if abs(number) != 1]
    assert path == COUNTRIES or not twice
    for end in itertools.chain.from_iterable(twice):  # where they overlap
        lon, lat = rondel.lonlat(np.frombuffer(end))
        assert np.hypot(lon - 33.97, lat - 9.0) < 1
    thirds = clipped.dissolve(np.arange(len(clipped)) % 3)
    assert sides_of(thirds) == outer
    assert np.isclose(thirds.areas.sum(), clipped.areas.sum(), rtol=1e-12, atol=0)


def test_countries_that_cross_are_told(cells):
    document = json.loads(COUNTRIES.read_text("utf-8"))
    names = [feature["properties"]["name"] for feature in document["features"]]
    first, second, _ = sorted(names.index(name) for name in CROSSED)
    message = rf"features {first} \(Sudan\) and {second} \(Ethiopia\) overlap at 33.96"
    with pytest.raises(OSError, match=message):
        cells.clip(COUNTRIES, values=names)
    with pytest.raises(OSError, match=message):
        rondel.feature_cells(COUNTRIES, 500)
    parts = cells.clip(COUNTRIES, values=names, overlap="first")
    assert np.isclose(parts.areas.sum(), cells.clip(COUNTRIES).areas.sum(), rtol=1e-12)
    nearest = rondel.feature_cells(COUNTRIES, 500, overlap="first")
    assert np.isclose(nearest.areas.sum(), 4 * np.pi, rtol=1e-12)
    assert (nearest.areas >= rondel.polygons(COUNTRIES, overlap="first").areas - 1e-12).all()


def test_cells_on_land_are_valid(cells):
    pytest.importorskip("geopandas")
    clipped = cells.clip(LAND)
    frame = clipped.to_geopandas()
    assert len(frame) > 5_000
    assert frame.geometry.is_valid.all()
    assert (clipped.areas[frame.index] > 0).all()


def test_cells_joined_by_country_are_valid(cells, stations):
    geopandas = pytest.importorskip("geopandas")
    countries = geopandas.read_file(COUNTRIES)
    places = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*stations.T), crs=4326)
    found = geopandas.sjoin(places, countries[["name", "geometry"]], how="left")
    names = found["name"][~found.index.duplicated()].tolist()
    for joined in (cells.dissolve(names), cells.clip(LAND).dissolve(names)):
        frame = joined.to_geopandas()
        assert len(frame) > 150
        assert frame.geometry.is_valid.all()
    clipped = cells.clip(COUNTRIES).to_geopandas()
    invalid = clipped[~clipped.geometry.is_valid]
    near = countries[countries["name"].isin(CROSSED)].union_all().buffer(0.1)
    assert len(invalid) <= 3
    assert invalid.geometry.make_valid().intersects(near).all()
