# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Clipped and joined cells, against closed forms, and as GDAL, GEOS and GeoArrow see them."""

import itertools
import json
import re

import clouds
import numpy as np
import pytest

import rondel

CELLS = rondel.SphericalVoronoi(clouds.uniform(200, 5))
ISLAND = {
    "type": "Polygon",
    "coordinates": [
        [[160, -20], [-160, -20], [-160, 30], [160, 30], [160, -20]],
        [[170, -5], [170, 5], [175, 5], [175, -5], [170, -5]],
    ],
}
# Cut at the antimeridian, as RFC 7946 wants it.
ISLANDS = {
    "type": "MultiPolygon",
    "coordinates": [
        [
            [[160, -20], [180, -20], [180, 30], [160, 30], [160, -20]],
            [[170, -5], [170, 5], [175, 5], [175, -5], [170, -5]],
        ],
        [[[-180, -20], [-160, -20], [-160, 30], [-180, 30], [-180, -20]]],
    ],
}


def between(west, east, south, north):
    return np.radians(east - west) * (np.sin(np.radians(north)) - np.sin(np.radians(south)))


WITHIN = 1e-5  # parallels are arcs within 1e-4 degrees of them
AREA = between(160, 200, -20, 30) - between(170, 175, -5, 5)


def test_clipped_cells_fill_the_region():
    clipped = CELLS.clip(ISLANDS)
    assert len(clipped) == 200
    assert np.array_equal(clipped.labels, np.arange(200))
    assert np.isclose(clipped.areas.sum(), AREA, rtol=WITHIN)
    assert np.all(clipped.areas <= CELLS.areas + 1e-14)
    region = rondel.CellSet.from_geometries([ISLANDS])
    assert np.isclose(clipped.areas.sum(), region.areas[0], rtol=1e-13)
    geodesic = CELLS.clip(ISLANDS, edges="geodesic")
    assert abs(geodesic.areas.sum() / clipped.areas.sum() - 1) > 1e-3
    assert np.isclose(CELLS.clip(region).areas.sum(), AREA, rtol=WITHIN)


def test_clipped_cells_are_dissolved_without_slivers():
    joined = CELLS.clip(ISLANDS).dissolve(CELLS.points[:, 2] > 0)
    assert sorted(joined.labels.tolist()) == [False, True]
    assert np.isclose(joined.areas.sum(), AREA, rtol=WITHIN)
    rings, corners = joined.cell_set().rings[1:3]
    points = joined.cell_set().rings[3]
    sides = set()
    for begin, end in itertools.pairwise(rings):
        ring = [points[k].tobytes() for k in corners[begin:end]]
        sides |= set(zip(ring, ring[1:] + ring[:1], strict=True))
    common = [side for side in sides if side[::-1] in sides]
    assert len(common) > 4
    whole = joined.dissolve(["all", "all"])
    assert whole.labels.tolist() == ["all"]
    assert np.isclose(whole.areas[0], joined.areas.sum(), rtol=1e-13)
    assert len(whole.cell_set().rings[1]) - 1 == 2  # the border and the hole


def test_groups_are_labels():
    groups = [None if i % 3 == 0 else "odd" if i % 2 else "even" for i in range(200)]
    joined = CELLS.dissolve(groups)
    assert joined.labels.tolist() == ["odd", "even"]
    mask = np.array([g == "odd" for g in groups])
    assert np.isclose(joined.areas[0], CELLS.areas[mask].sum(), rtol=1e-13)
    numbers = CELLS.dissolve(np.where(np.arange(200) < 150, 7.5, np.nan))
    assert numbers.labels.tolist() == [7.5]
    assert np.isclose(numbers.areas[0], CELLS.areas[:150].sum(), rtol=1e-13)
    with pytest.raises(ValueError, match="3 groups for 200 cells"):
        CELLS.dissolve([1, 2, 3])
    with pytest.raises(ValueError, match=r"groups must have shape \(n,\), not \(100, 2\)"):
        CELLS.dissolve(np.zeros((100, 2)))
    everything = CELLS.dissolve(np.zeros(200, int))
    assert len(everything) == 1
    assert np.isclose(everything.areas[0], 4 * np.pi, rtol=1e-15)  # no border, but not empty
    assert repr(everything) == "<rondel.Regions: 1 region>"


@pytest.mark.parametrize("unit", ["D", "s", "ns"])
def test_times_are_labels(unit):
    days = np.array(["2020-01-01", "NaT", "2021-06-01", "2020-01-01"], f"M8[{unit}]")
    times = np.tile(days, 50)
    joined = CELLS.dissolve(times)
    np.testing.assert_array_equal(joined.labels, days[[0, 2]])
    assert joined.labels.dtype == days.dtype
    lost = np.ma.array(times, mask=times == days[2])
    np.testing.assert_array_equal(CELLS.dissolve(lost).labels, days[:1])
    kept = [feature["properties"]["group"] for feature in joined.to_geojson()["features"]]
    assert [text[:10] for text in kept] == ["2020-01-01", "2021-06-01"]
    cut = CELLS.clip([ISLANDS], values=days[:1])
    assert cut.values.dtype == days.dtype
    steps = CELLS.dissolve(times - days[0])
    np.testing.assert_array_equal(steps.labels, days[[0, 2]] - days[0])


def test_arrays_of_xarray_are_groups_values_and_properties():
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("geopandas")
    groups = ["even", "odd"] * 100
    for given in (groups, [0, 1] * 100, np.tile(np.array([0, 86400], "M8[s]"), 100)):
        found = CELLS.dissolve(xarray.DataArray(given, dims="site"))
        np.testing.assert_array_equal(found.labels, given[:2])
        assert found.areas.tolist() == CELLS.dissolve(groups).areas.tolist()
        cut = CELLS.clip([ISLANDS], values=xarray.DataArray(given[:1], dims="region"))
        np.testing.assert_array_equal(np.unique(cut.values), given[:1])
        properties = {"own": xarray.DataArray(given[:2], dims="region")}
        regions = CELLS.dissolve(groups)
        (first, second) = regions.to_geojson(properties=properties)["features"]
        assert first["properties"]["own"] != second["properties"]["own"]
        assert regions.to_geopandas(properties=properties)["own"].nunique() == 2


def test_duplicates_and_power_cells():
    points = np.vstack([CELLS.points[:50], CELLS.points[:2]])
    merged = rondel.SphericalVoronoi(points, duplicates="merge")
    assert merged.clip(ISLANDS).areas[50:].tolist() == [0, 0]
    radii = np.linspace(0, 20, 200)
    power = rondel.power_diagram(CELLS.points, radii)
    assert np.isclose(power.clip(ISLANDS).areas.sum(), AREA, rtol=WITHIN)


SHAPES = [
    {"type": "LineString", "coordinates": [[-40, 0], [40, 0]]},
    {"type": "MultiLineString", "coordinates": [[[170, 20], [190, 20]], [[170, 30], [170, 40]]]},
    {"type": "Point", "coordinates": [0, 90]},
    {"type": "Polygon", "coordinates": [[[80, -60], [100, -60], [100, -40], [80, -40], [80, -60]]]},
]


def test_cells_of_lines_and_polygons(tmp_path):
    """No line is nearer to a place than the feature that has it, but for the tolerance."""
    geometry = pytest.importorskip("shapely.geometry")
    cells = rondel.feature_cells(SHAPES, 30)
    assert len(cells) == 4
    assert cells.labels.tolist() == [0, 1, 2, 3]
    assert np.isclose(cells.areas.sum(), 4 * np.pi, rtol=1e-12)
    assert np.isclose(cells.areas_km2().sum(), 4 * np.pi * 6371.0088**2, rtol=1e-12)
    polygons = {f["properties"]["feature"]: f for f in cells.to_geojson()["features"]}
    shapes = [geometry.shape(polygons[i]["geometry"]) for i in range(4)]
    samples = []
    for shape in SHAPES:
        line = geometry.shape(shape)
        line = line.boundary if shape["type"] == "Polygon" else line
        if shape["type"] == "Point":
            degrees = np.array(shape["coordinates"], float)[None]
        else:
            steps = np.linspace(0, 1, 4001)
            parts = getattr(line, "geoms", [line])
            degrees = np.concatenate(
                [[p.coords[0] for p in part.interpolate(steps, normalized=True)] for part in parts]
            )
        samples.append(rondel.unit_vectors(*degrees.T))
    places = clouds.uniform(400, 8)
    where = [geometry.Point(p) for p in rondel.lonlat(places)]
    nearest = np.array([(places @ s.T).max(axis=1) for s in samples])
    distances = np.arccos(np.minimum(nearest, 1)) * 6371.0088
    distances[3, [shapes_contain(SHAPES[3], p) for p in where]] = 0
    for k, place in enumerate(where):
        (owner,) = [i for i in range(4) if shapes[i].contains(place)] or [None]
        if owner is not None:
            assert distances[owner, k] <= distances[:, k].min() + 30 + 1  # of the samples
    path = tmp_path / "features.geojson"
    path.write_text(json.dumps({"type": "GeometryCollection", "geometries": SHAPES}), "utf-8")
    again = rondel.feature_cells(path, 30)
    assert again.areas.tolist() == cells.areas.tolist()
    with pytest.raises(ValueError, match="must be positive"):
        rondel.feature_cells(SHAPES, 0)
    with pytest.raises(ValueError, match="where a geometry is needed"):
        rondel.feature_cells([{"type": "Circle", "coordinates": [1, 2]}], 1)


def test_cells_of_features_may_be_clipped():
    island = {"type": "Polygon", "coordinates": [[[-5, -5], [5, -5], [5, 5], [-5, 5], [-5, -5]]]}
    coast = {"type": "LineString", "coordinates": [[20, -30], [20, 30]]}
    ring = [[-10, -20], [30, -20], [30, 20], [-10, 20], [-10, -20]]
    sea = {"type": "Polygon", "coordinates": [ring]}
    within = rondel.feature_cells([island, coast], 50, within=sea)
    whole = rondel.CellSet.from_geometries([sea]).areas[0]
    assert abs(within.areas.sum() - whole) < 1e-13
    assert (within.areas > rondel.CellSet.from_geometries([island]).areas[0]).all()
    alone = rondel.feature_cells([coast], 50, within=sea)
    assert abs(alone.areas[0] - whole) < 1e-13


def shapes_contain(shape, place):
    return pytest.importorskip("shapely.geometry").shape(shape).contains(place)


def test_areas_in_square_kilometers():
    clipped = CELLS.clip(ISLANDS)
    for feature in clipped.to_geojson(radius_km=1000)["features"]:
        properties = feature["properties"]
        assert np.isclose(properties["area_km2"], properties["area"] * 1e6, rtol=1e-15)
    with pytest.raises(ValueError, match="'area_km2' is taken"):
        clipped.to_geojson(properties={"area_km2": range(200)})
    pytest.importorskip("geopandas")
    frame = clipped.to_geopandas(radius_km=6371.0088)
    assert np.allclose(frame["area_km2"], clipped.areas_km2()[frame["site"]], rtol=1e-15)


@pytest.mark.parametrize("radius", [-1, 0, np.nan, np.inf, 1e308, 1e-170])
def test_no_areas_of_what_is_no_radius(radius):
    clipped = CELLS.clip(ISLANDS)
    with pytest.raises(ValueError, match="radius_km is"):
        clipped.areas_km2(radius)
    with pytest.raises(ValueError, match="radius_km is"):
        clipped.to_geojson(radius_km=radius)


def test_geojson(tmp_path):
    clipped = CELLS.clip(ISLANDS)
    found = clipped.to_geojson(properties={"name": [f"site {i}" for i in range(200)]})
    assert found == json.loads(json.dumps(found))
    assert len(found["features"]) == np.count_nonzero(clipped.areas)
    for feature in found["features"]:
        properties = feature["properties"]
        assert properties["name"] == f"site {properties['site']}"
        assert properties["area"] == clipped.areas[properties["site"]]
    clipped.to_geojson(tmp_path / "cells.geojson")
    again = rondel.CellSet.read(tmp_path / "cells.geojson", edges="geodesic")
    assert np.isclose(again.areas.sum(), AREA, rtol=1e-5)
    with pytest.raises(ValueError, match="'area' is taken"):
        clipped.to_geojson(properties={"area": range(200)})
    with pytest.raises(ValueError, match="tolerance"):
        clipped.to_geojson(tolerance_deg=0)
    assert list(tmp_path.iterdir()) == [tmp_path / "cells.geojson"]
    assert clipped.__geo_interface__["type"] == "FeatureCollection"


@pytest.mark.parametrize(
    ("ending", "driver"), [("gpkg", "GPKG"), ("fgb", "FlatGeobuf"), ("shp", None)]
)
def test_files_of_gdal(tmp_path, ending, driver):
    geopandas = pytest.importorskip("geopandas")
    frame = CELLS.clip(ISLANDS).to_geopandas(properties={"z": CELLS.points[:, 2]})
    path = tmp_path / f"cells.{ending}"
    frame.to_file(path, driver=driver)
    found = geopandas.read_file(path)
    found = found.set_index("site").loc[frame["site"]]
    assert np.allclose(found["area"], frame["area"], rtol=1e-9)
    assert np.allclose(found["z"], frame["z"])
    assert found.crs == "EPSG:4326"
    assert np.all(found.geometry.is_valid)
    areas = [table.set_crs(None, allow_override=True).geometry.area for table in (found, frame)]
    assert np.allclose(*areas)


def test_geoparquet(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    pytest.importorskip("pyarrow.parquet")
    frame = CELLS.dissolve(np.arange(200) % 5).to_geopandas()
    frame.to_parquet(tmp_path / "cells.parquet")
    found = geopandas.read_parquet(tmp_path / "cells.parquet")
    assert found.geometry.to_wkb().tolist() == frame.geometry.to_wkb().tolist()
    assert np.all(found.geometry.is_valid)


def test_frames_have_the_polygons_of_geojson():
    geopandas = pytest.importorskip("geopandas")
    clipped = CELLS.clip(ISLANDS)
    frame = clipped.to_geopandas().set_crs(None, allow_override=True)
    expected = geopandas.GeoDataFrame.from_features(clipped.to_geojson()["features"])
    assert frame["site"].tolist() == expected["site"].tolist()
    assert frame.geometry.to_wkt().tolist() == expected.geometry.to_wkt().tolist()
    # The plane's areas of cells that share their sides sum to the region's, drawn.
    assert np.isclose(frame.geometry.area.sum(), 40 * 50 - 5 * 10, rtol=1e-5)
    assert np.isclose(frame.geometry.union_all().area, 40 * 50 - 5 * 10, rtol=1e-5)


def test_geometries_of_other_libraries():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    boxes = [shapely.box(0, -9, 9, 9), None, shapely.box(100, 20, 130, 40)]
    expected = [between(0, 9, -9, 9), 0, between(100, 130, 20, 40)]
    series = geopandas.GeoSeries(boxes, crs="EPSG:4326")
    frame = geopandas.GeoDataFrame({"name": list("abc")}, geometry=series)
    given = [
        boxes,
        np.array(boxes),
        series,
        frame,
        series.to_crs("EPSG:3857"),
        series.__geo_interface__,
        frame.to_arrow(geometry_encoding="geoarrow"),
        series.to_arrow(geometry_encoding="geoarrow"),
    ]
    for geometries in given:
        areas = rondel.CellSet.from_geometries(geometries).areas
        assert np.allclose(areas, expected, rtol=WITHIN)
    assert np.isclose(CELLS.clip(boxes[0]).areas.sum(), expected[0], rtol=WITHIN)


def test_what_is_no_polygon_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r'^geometries: .*type "Point" where a Polygon is needed'):
        CELLS.clip({"type": "Point", "coordinates": [1, 2]})
    with pytest.raises(TypeError, match="int is no geometry"):
        CELLS.clip([1])
    with pytest.raises(TypeError, match="not int"):
        CELLS.clip(1)
    with pytest.raises(ValueError, match="latitude"):
        CELLS.clip({"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 99], [0, 0]]]})
    with pytest.raises(FileNotFoundError):
        CELLS.clip(tmp_path / "nowhere.geojson")
    with pytest.raises(ValueError, match="edges must be"):
        CELLS.clip(ISLANDS, edges="straight")


@pytest.mark.parametrize(
    "read",
    [
        CELLS.clip,
        lambda path: rondel.feature_cells(path, 10),
        rondel.polygons,
        rondel.CellSet.read,
        rondel.mesh.read,
        rondel.read_weights,
        lambda path: rondel.mesh.scvt(42, fixed=path),
        lambda path: rondel.mesh.scvt(42, along=path),
    ],
)
def test_a_file_that_is_not_right_is_another_error_than_one_that_is_not_there(tmp_path, read):
    for name in ("wrong.geojson", "wrong.nc"):
        (tmp_path / name).write_text("wrong")
        with pytest.raises(rondel.FileError, match=re.escape(name)) as caught:
            read(tmp_path / name)
        assert isinstance(caught.value, ValueError)
        assert isinstance(caught.value, OSError)
        with pytest.raises(FileNotFoundError) as caught:
            read(tmp_path / "nowhere" / name)
        assert not isinstance(caught.value, ValueError)


def test_files_without_features_are_told(tmp_path):
    path = tmp_path / "e.geojson"
    path.write_text('{"type": "FeatureCollection", "features": []}')
    for read in (CELLS.clip, rondel.polygons, lambda path: rondel.feature_cells(path, 10)):
        with pytest.warns(UserWarning, match=r"e\.geojson: there are no features"):
            read(path)


def test_a_tolerance_that_is_too_small_is_refused_at_once():
    lines = [{"type": "LineString", "coordinates": [[0, 0], [x, 9]]} for x in (5, 10)]
    with pytest.raises(rondel.InvalidInput, match="arc of feature 0 could have more than 524288"):
        rondel.feature_cells(lines, 1e-9)


def test_cells_of_corners():
    lon, lat = np.meshgrid(np.arange(0, 360, 30), np.arange(-60, 60, 30))
    west, south = lon[..., None], lat[..., None]
    lons = np.concatenate([west, west + 30, west + 30, west], axis=-1)
    lats = np.concatenate([south, south, south + 30, south + 30], axis=-1)
    cells = rondel.CellSet.corners(lons, lats)
    assert cells.shape == (4, 12)
    turned = rondel.CellSet.corners(lons[..., ::-1], lats[..., ::-1])
    assert np.array_equal(turned.areas, cells.areas)
    # 360 degrees are 0: neighbors across the date line share their corners.
    assert len(cells.rings[3]) == 5 * 12
    with pytest.raises(rondel.InvalidInput, match=r"cell 1 has a corner at .* no place") as error:
        rondel.CellSet.corners([[0, 1, 2], [0, np.nan, 2]], [[0, 1, 0], [0, 1, 0]])
    assert error.value.index == 1
    with pytest.raises(ValueError, match="must have shape"):
        rondel.CellSet.corners([0, 1, 2], [0, 1, 2])


def test_cells_are_cut_by_values():
    diagram = rondel.SphericalVoronoi(clouds.uniform(60, 4))
    boxes = [
        {"type": "Polygon", "coordinates": [[[w, -40], [e, -40], [e, 40], [w, 40], [w, -40]]]}
        for w, e in ((-60, 0), (0, 60), (60, 120))
    ]
    cut = diagram.clip(boxes, values=["land", None, "sea"])
    assert set(cut.values) == {"land", "sea"}
    assert list(cut.labels) == sorted(cut.labels)
    for name, box in (("land", boxes[0]), ("sea", boxes[2])):
        alone = diagram.clip(box).areas
        found = np.zeros(60)
        np.add.at(found, cut.labels[cut.values == name], cut.areas[cut.values == name])
        assert np.allclose(found, alone, rtol=0, atol=1e-14)
    joined = diagram.clip(boxes, values=[1, 1, 1])
    assert np.allclose(joined.areas, diagram.clip(boxes).areas[joined.labels], atol=1e-14)
    features = cut.to_geojson()["features"]
    assert {feature["properties"]["value"] for feature in features} == {"land", "sea"}
    with pytest.raises(ValueError, match="2 values for 3 regions"):
        diagram.clip(boxes, values=["land", "sea"])


def test_cells_of_a_box_along_their_borders_are_valid():
    shapely = pytest.importorskip("shapely")
    lon, lat = np.meshgrid(np.arange(-172.5, 180, 15), np.arange(-82.5, 90, 15))
    voronoi = rondel.SphericalVoronoi.from_lonlat(lon.ravel(), lat.ravel())
    found = voronoi.clip([shapely.box(-20, -30, 70, 40)]).to_geojson()["features"]
    shapes = [shapely.geometry.shape(f["geometry"]) for f in found if f["geometry"]]
    assert len(shapes) > 30
    assert all(shape.is_valid for shape in shapes)
    assert shapely.coverage_is_valid(np.array(shapes))


def test_other_words_are_errors_also_where_they_have_no_effect():
    cells = rondel.SphericalVoronoi.from_lonlat([0], [0])
    box = [0, 0, 10, 10]
    for word in ("share", "keep", ""):
        for regions in (box, rondel.polygons(box)):
            with pytest.raises(ValueError, match="overlap must be 'error' or 'first', not"):
                cells.clip(regions, overlap=word)
        with pytest.raises(ValueError, match="overlap must be 'error' or 'first', not"):
            rondel.feature_cells(box, 100, overlap=word)
    with pytest.raises(ValueError, match="edges must be 'lonlat' or 'geodesic', not 'flat'"):
        cells.clip(rondel.polygons(box), edges="flat")


@pytest.mark.parametrize("nothing", [None, float("nan")])
@pytest.mark.parametrize("overlap", ["first", "error"])
def test_regions_without_a_value_take_no_space(tmp_path, nothing, overlap):
    cells = rondel.SphericalVoronoi.from_lonlat([0], [0])
    corners = [[(w, 0), (w + 10, 0), (w + 10, 10), (w, 10), (w, 0)] for w in (0, 5)]
    boxes = [{"type": "Polygon", "coordinates": [ring]} for ring in corners]
    expected = rondel.polygons([boxes[1]]).areas
    path = tmp_path / "boxes.geojson"
    path.write_text(json.dumps({"type": "GeometryCollection", "geometries": boxes}))
    for regions in (boxes, path):
        found = cells.clip(regions, values=[nothing, "b"], overlap=overlap)
        assert found.values.tolist() == ["b"]
        assert found.areas == pytest.approx(expected, rel=1e-12)
