# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""GeoJSON, GeoPandas, xarray and UGRID."""

import itertools
import json

import clouds
import numpy as np
import pytest

import rondel

LON = np.array([0.0, 90, 180, -90, 30, -60, 170, 0, 0])
LAT = np.array([0.0, 0, 0, 0, 60, 45, -50, 90, -90])


def sphere_area(feature):
    """The area of a feature on the unit sphere, by integration of sin(latitude) over longitude."""
    parts = feature["geometry"]["coordinates"]
    if feature["geometry"]["type"] == "Polygon":
        parts = [parts]
    area = 0.0
    for (ring,) in parts:
        lon, lat = np.radians(ring).T[:2]
        middle = (np.sin(lat[:-1]) + np.sin(lat[1:])) / 2
        area -= (np.diff(lon) * middle).sum()
    return area


def test_cells_as_geojson():
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    collection = diagram.to_geojson(properties={"name": list("abcdefghi"), "t": LAT / 2})
    features = collection["features"]
    assert [f["properties"]["site"] for f in features] == list(range(9))
    assert [f["properties"]["name"] for f in features] == list("abcdefghi")
    assert [f["properties"]["t"] for f in features] == (LAT / 2).tolist()
    for feature, area in zip(features, diagram.areas, strict=True):
        assert abs(feature["properties"]["area"] - area) < 1e-12
        assert abs(sphere_area(feature) - area) < 1e-3
    assert features[2]["geometry"]["type"] == "MultiPolygon"  # it is on the antimeridian


def test_properties_of_all_kinds():
    values = [1, 2.5, np.float32(0.5), None, np.nan, np.int64(7), 1e300, -0.0, np.inf]
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    features = diagram.to_geojson(properties={"v": values, "site": LON})["features"]
    found = [f["properties"]["v"] for f in features]
    assert found == [1, 2.5, 0.5, None, None, 7, 1e300, 0, None]
    assert [f["properties"]["site_"] for f in features] == LON.tolist()
    with pytest.raises(ValueError, match="9 sites"):
        diagram.to_geojson(properties={"v": [1]})


def test_files(tmp_path):
    tri = rondel.delaunay_lonlat(LON, LAT)
    for thing in (tri, tri.voronoi()):
        path = tmp_path / "out.geojson"
        assert thing.to_geojson(path) is None
        assert json.loads(path.read_text(encoding="utf-8")) == thing.to_geojson()
        with pytest.raises(OSError, match="nowhere"):
            thing.to_geojson(tmp_path / "nowhere" / "out.geojson")
        with pytest.raises(ValueError, match="ends in"):
            thing.to_geojson(tmp_path / "out.json")


def test_triangles_as_geojson():
    tri = rondel.delaunay_lonlat(LON, LAT)
    features = tri.to_geojson()["features"]
    assert len(features) == len(tri.simplices)
    assert features[3]["properties"]["sites"] == tri.simplices[3].tolist()
    assert abs(sum(map(sphere_area, features)) - 4 * np.pi) < 1e-2


def test_polygons_are_valid():
    shapely = pytest.importorskip("shapely.geometry")
    for feature in rondel.SphericalVoronoi(clouds.uniform(200)).to_geojson()["features"]:
        polygon = shapely.shape(feature["geometry"])
        assert polygon.is_valid
        assert polygon.bounds[0] >= -180
        assert polygon.bounds[2] <= 180


def test_geopandas():
    geopandas = pytest.importorskip("geopandas")
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    frame = diagram.to_geopandas(properties={"lat": LAT})
    assert isinstance(frame, geopandas.GeoDataFrame)
    assert frame.crs.to_epsg() == 4326
    assert frame.geometry.is_valid.all()
    assert frame["lat"].tolist() == LAT.tolist()
    assert len(rondel.delaunay_lonlat(LON, LAT).to_geopandas()) == 14
    assert len(rondel.delaunay_lonlat([], []).voronoi().to_geopandas()) == 0


def test_ugrid():
    pytest.importorskip("xarray")
    tri = rondel.delaunay_lonlat(LON, LAT)
    mesh = tri.to_xarray()
    assert mesh["mesh"].attrs["cf_role"] == "mesh_topology"
    assert np.array_equal(mesh["face_node_connectivity"], tri.simplices)
    assert np.array_equal(mesh["node_lon"], LON)
    cells = tri.voronoi().to_xarray()
    corners = cells["face_node_connectivity"].values
    rings = [row[row >= 0].tolist() for row in corners]
    offsets, items, _ = tri.voronoi().cells
    assert rings == [items[a:b].tolist() for a, b in itertools.pairwise(offsets)]
    assert np.allclose(cells["face_area"].sum(), 4 * np.pi)


def test_uxarray_opens_it():
    uxarray = pytest.importorskip("uxarray")
    tri = rondel.delaunay(clouds.uniform(100))
    grid = uxarray.Grid.from_dataset(tri.to_xarray())
    assert (grid.n_node, grid.n_face) == (100, 196)
    assert abs(grid.face_areas.sum() - 4 * np.pi) < 1e-3
    cells = uxarray.Grid.from_dataset(tri.voronoi().to_xarray())
    assert (cells.n_node, cells.n_face) == (196, 100)
    assert np.allclose(cells.face_areas, tri.voronoi().areas, atol=1e-3)
