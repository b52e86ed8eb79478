# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sides of projected geometries are straight in their projection, and neighbors share them."""

import clouds  # noqa: F401 (the package beside this file)
import numpy as np
import pytest

import rondel

geopandas = pytest.importorskip("geopandas")
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
    assert np.isclose(area_of(parts), each[0] - each[1] + each[2], rtol=1e-12)
    line = geopandas.GeoSeries([None, shapely.LineString([(0, 0), (8e6, 5e6)])], crs=3857)
    found = rondel.feature_cells(line.iloc[1:], 50)
    assert len(found) == 1
