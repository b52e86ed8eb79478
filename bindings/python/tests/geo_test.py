# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""GeoJSON, GeoPandas, xarray and UGRID."""

import datetime
import errno
import io
import itertools
import json
import tempfile

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


def values_of(features, name):
    return [f["properties"][name] for f in features]


def test_properties_of_all_kinds():
    values = [1, 2.5, np.float32(0.5), None, np.nan, np.int64(7), 1e300, -0.0, np.inf]
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    features = diagram.to_geojson(properties={"v": values})["features"]
    assert values_of(features, "v") == [1, 2.5, 0.5, None, None, 7, 1e300, 0, None]
    with pytest.raises(ValueError, match="9 sites"):
        diagram.to_geojson(properties={"v": [1]})


def test_properties_keep_their_types():
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    days = np.array(["2020-01-31", "NaT", *["2021-12-01"] * 7], "M8[ns]")
    mixed = [True, "text", None, 2, 0.5, [1, {"a": None}], datetime.date(2020, 2, 3), 1 << 70, "'"]
    odd = [1j, np.timedelta64(3, "s"), np.longdouble(0.5), np.True_, np.str_("ß"), *[None] * 4]
    found = diagram.to_geojson(
        properties={
            "truth": LAT > 0,
            "day": days,
            "mixed": mixed,
            "odd": odd,
            "count": np.arange(9, dtype="u1"),
        }
    )["features"]
    assert values_of(found, "truth") == (LAT > 0).tolist()
    assert all(type(value) is bool for value in values_of(found, "truth"))
    assert values_of(found, "day")[0].startswith("2020-01-31")
    assert values_of(found, "day")[1] is None
    assert values_of(found, "mixed") == [*mixed[:6], "2020-02-03", *mixed[7:]]
    assert values_of(found, "odd")[:5] == ["1j", "3 seconds", 0.5, True, "ß"]
    assert [type(value) for value in values_of(found, "count")] == [int] * 9


def test_names_that_are_taken_are_refused():
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    for properties in ({"site": LON}, {"area": LON}, {1: LON, "1": LON}):
        with pytest.raises(ValueError, match="is taken"):
            diagram.to_geojson(properties=properties)


def test_files(tmp_path):
    tri = rondel.delaunay_lonlat(LON, LAT)
    for thing in (tri, tri.voronoi()):
        path = tmp_path / "out.geojson"
        assert thing.to_geojson(path) is None
        assert json.loads(path.read_text(encoding="utf-8")) == thing.to_geojson()
        lost = tmp_path / "nowhere" / "out.geojson"
        with pytest.raises(FileNotFoundError) as caught:
            thing.to_geojson(lost)
        assert (caught.value.errno, caught.value.filename) == (errno.ENOENT, str(lost))
        with pytest.raises(ValueError, match="ends in"):
            thing.to_geojson(tmp_path / "out.json")


def test_open_files(tmp_path):
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    properties = {"name": ["Ä\n"] * 9}
    path = tmp_path / "out.geojson"
    diagram.to_geojson(path, properties=properties)
    text, data = io.StringIO(), io.BytesIO()
    diagram.to_geojson(text, properties=properties)
    diagram.to_geojson(data, properties=properties)
    assert data.getvalue() == text.getvalue().encode() == path.read_bytes()
    with tempfile.NamedTemporaryFile() as file, tempfile.TemporaryFile("w+", newline="") as other:
        for target in (file, other):
            diagram.to_geojson(target, properties=properties)
            target.seek(0)
        assert file.read() == other.read().encode() == path.read_bytes()
    with tempfile.SpooledTemporaryFile() as file:
        diagram.dissolve("aabbccddd").to_geojson(file)
        assert file.seek(0, io.SEEK_END) > 0


def test_files_of_other_systems(tmp_path):
    fsspec = pytest.importorskip("fsspec")
    tri = rondel.delaunay_lonlat(LON, LAT)
    tri.to_geojson(tmp_path / "out.geojson")
    for mode in ("wb", "w"):
        for name in ("memory://out.geojson", (tmp_path / "other.geojson").as_uri()):
            with fsspec.open(name, mode, **({"newline": ""} if mode == "w" else {})) as file:
                tri.to_geojson(file)
            with fsspec.open(name, "rb") as file:
                assert file.read() == (tmp_path / "out.geojson").read_bytes()


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


SITES = {
    "poles and antimeridian": lambda: rondel.delaunay_lonlat(LON, LAT),
    "duplicates": lambda: rondel.delaunay_lonlat([*LON, *LON], [*LAT, *LAT]),
    "random": lambda: rondel.delaunay(clouds.uniform(200)),
    "patch": lambda: rondel.delaunay(clouds.patch(50, 0.1)),
    "one": lambda: rondel.delaunay([[0, 0, 1]]),
    "two": lambda: rondel.delaunay([[0, 0, 1], [0, 0, -1]]),
    "circle": lambda: rondel.delaunay(np.concatenate([np.eye(3)[:2], -np.eye(3)[:2]])),
    "none": lambda: rondel.delaunay([]),
    "hidden": lambda: (
        rondel.power_diagram(
            [[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90], [5, 0]], [30, 0, 0, 0, 0, 0, 0]
        ).delaunay
    ),
}


@pytest.mark.parametrize("make", SITES.values(), ids=SITES)
def test_geopandas_has_the_polygons_of_geojson(make):
    geopandas = pytest.importorskip("geopandas")
    tri = make()
    for thing, index in ((tri.voronoi(), "site"), (tri, None)):
        features = thing.to_geojson()["features"]
        frame = thing.to_geopandas()
        if not features:
            assert len(frame) == 0
            continue
        expected = geopandas.GeoDataFrame.from_features(features, crs="EPSG:4326")
        assert frame.geometry.geom_type.tolist() == expected.geometry.geom_type.tolist()
        assert frame.geometry.to_wkb().tolist() == expected.geometry.to_wkb().tolist()
        if index:
            assert frame["site"].tolist() == frame.index.tolist() == expected["site"].tolist()
            assert frame["area"].tolist() == expected["area"].tolist()
        else:
            corners = frame[["site_0", "site_1", "site_2"]].to_numpy().tolist()
            assert corners == expected["sites"].tolist()
            assert np.array_equal(tri.simplices[frame.index], corners)


def test_columns_keep_their_types():
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("geopandas")
    diagram = rondel.SphericalVoronoi.from_lonlat([0, *LON], [0, *LAT])
    given = {
        "truth": np.arange(10) % 2 == 0,
        "day": pandas.date_range("2020-01-01", periods=10, tz="UTC"),
        "kind": pandas.Categorical(list("abcabcabca")),
        "count": pandas.Series(range(10), index=list("zyxwvutsrq")),
        "name": list("abcdefghij"),
    }
    frame = diagram.to_geopandas(properties=given)
    kept = [0, 2, 3, 4, 5, 6, 7, 8, 9]
    assert frame["site"].tolist() == kept
    for name, values in given.items():
        expected = pandas.Series(pandas.Series(values).array[kept])
        assert frame[name].dtype == expected.dtype, name
        assert frame[name].tolist() == expected.tolist(), name
    assert diagram.to_geojson(properties=given)["features"][1]["properties"]["kind"] == "c"
    with pytest.raises(ValueError, match="is taken"):
        diagram.to_geopandas(properties={"geometry": range(10)})


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


@pytest.mark.parametrize("make", SITES.values(), ids=SITES)
def test_every_face_of_ugrid_has_corners_and_a_site(make):
    pytest.importorskip("xarray")
    tri = make()
    diagram = tri.voronoi()
    mesh = diagram.to_xarray(properties={"lat": tri.lonlat[:, 1]})
    corners = mesh["face_node_connectivity"].values
    assert ((corners >= 0).sum(axis=1) >= 3).all()
    sites = mesh["site"].values
    assert sites.tolist() == np.flatnonzero(np.diff(diagram.cells.offsets)).tolist()
    assert not np.isin(sites, tri.duplicates[:, 0]).any()
    places = np.column_stack([mesh["face_lon"], mesh["face_lat"]])
    assert np.array_equal(places, tri.lonlat[sites])
    assert np.array_equal(mesh["lat"], tri.lonlat[sites, 1])
    if len(sites):
        assert abs(mesh["face_area"].values.sum() - 4 * np.pi) < 1e-9
    for name in ("site", "face_area", "lat"):
        assert mesh[name].attrs["mesh"] == "mesh"
        assert mesh[name].attrs["location"] == "face"
    assert mesh["mesh"].attrs["face_coordinates"] == "face_lon face_lat"
    assert {"title", "history", "Conventions"} <= set(mesh.attrs)
    solid = tri.to_xarray()["face_node_connectivity"].values
    assert np.array_equal(solid, tri.simplices[~tri.ghost])
    with pytest.raises(ValueError, match="is taken"):
        diagram.to_xarray(properties={"face_lon": range(tri.npoints)})


def test_ugrid_in_a_file(tmp_path):
    xarray = pytest.importorskip("xarray")
    netcdf = pytest.importorskip("netCDF4")
    path = tmp_path / "cells.nc"
    diagram = rondel.SphericalVoronoi.from_lonlat([0, *LON], [0, *LAT])
    mesh = diagram.to_xarray()
    mesh.to_netcdf(path)
    with netcdf.Dataset(path) as file:
        assert "coordinates" not in file.ncattrs()
        for name in ("node_lon", "node_lat", "face_lon", "face_lat", "face_area", "site"):
            assert "_FillValue" not in file[name].ncattrs(), name
        assert file["face_node_connectivity"].getncattr("_FillValue") == -1
    with xarray.open_dataset(path, mask_and_scale=False) as again:
        assert np.array_equal(again["face_node_connectivity"], mesh["face_node_connectivity"])
        assert np.array_equal(again["face_lon"], mesh["face_lon"])


def test_ugrid_is_what_its_checker_wants(tmp_path):
    checker = pytest.importorskip("ugrid_checks.check")
    pytest.importorskip("netCDF4")
    tri = rondel.delaunay_lonlat([0, *LON], [0, *LAT])
    for thing in (tri, tri.voronoi()):
        thing.to_xarray().to_netcdf(tmp_path / "mesh.nc")
        checked = checker.check_dataset(str(tmp_path / "mesh.nc"), print_summary=False)
        assert "No problems found" in checked.checking_report()


def test_uxarray_opens_it():
    uxarray = pytest.importorskip("uxarray")
    tri = rondel.delaunay(clouds.uniform(100))
    grid = uxarray.Grid.from_dataset(tri.to_xarray())
    assert (grid.n_node, grid.n_face) == (100, 196)
    assert abs(grid.face_areas.sum() - 4 * np.pi) < 1e-3
    cells = uxarray.Grid.from_dataset(tri.voronoi().to_xarray())
    assert (cells.n_node, cells.n_face) == (196, 100)
    assert np.allclose(cells.face_areas, tri.voronoi().areas, atol=1e-3)


def test_uxarray_opens_diagrams_with_duplicates():
    uxarray = pytest.importorskip("uxarray")
    tri = rondel.delaunay(np.concatenate([clouds.uniform(100), clouds.uniform(10)]))
    grid = uxarray.Grid.from_dataset(tri.voronoi().to_xarray())
    assert grid.validate()
    assert grid.n_face == 100
    assert np.allclose(grid.face_lon, tri.lonlat[:100, 0])
    grid.to_polycollection()


WIDE = 2**60 + 1
COLUMNS = {
    "None": [WIDE, None, 3, 4, 5, 6],
    "pandas": lambda pandas: pandas.array([WIDE, None, 3, 4, 5, 6], dtype="Int64"),
    "series": lambda pandas: pandas.Series([WIDE, None, 3, 4, 5, 6], dtype="Int64"),
    "masked": np.ma.array([WIDE, 2, 3, 4, 5, 6], mask=[0, 1, 0, 0, 0, 0]),
    "masked elements": [WIDE, np.ma.masked, 3, 4, 5, 6],
    "unsigned": [2**63 + 1, None, 3, 4, 5, 6],
    "NaN": [WIDE, float("nan"), 3, 4, 5, 6],
    "mixed": [WIDE, None, 3.5, 4, 5, 6],
}


@pytest.mark.parametrize("name", COLUMNS)
def test_integers_stay_integers_where_some_are_missing(name):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("geopandas")
    given = COLUMNS[name](pandas) if callable(COLUMNS[name]) else COLUMNS[name]
    diagram = rondel.SphericalVoronoi.from_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
    first = 2**63 + 1 if name == "unsigned" else WIDE
    texts = [str(first), None, "3.5" if name == "mixed" else "3", "4", "5", "6"]

    def all_texts(column):
        return [None if pandas.isna(value) else str(value) for value in column]

    properties = {"n": given}
    found = [
        feature["properties"]["n"]
        for feature in diagram.to_geojson(properties=properties)["features"]
    ]
    assert all_texts(found) == texts
    regions = diagram.clip([-180, -90, 180, 90])
    for frame in (
        diagram.to_geopandas(properties=properties),
        regions.to_geopandas(properties=properties),
    ):
        assert all_texts(frame["n"]) == texts


def test_ugrid_does_not_round_integers():
    pytest.importorskip("xarray")
    diagram = rondel.SphericalVoronoi(clouds.uniform(6))
    masked = np.ma.array([WIDE, 2, 3, 4, 5, 6], mask=[0, 1, 0, 0, 0, 0])
    small = np.ma.array([1, 2, 3, 4, 5, 6], mask=[0, 1, 0, 0, 0, 0])
    mesh = diagram.to_xarray(properties={"wide": masked, "small": small})
    assert mesh["wide"].values.tolist() == [WIDE, None, 3, 4, 5, 6]
    assert mesh["small"].dtype == np.float64


@pytest.mark.parametrize("text", ["\ud800", "a\0b"])
def test_texts_that_no_file_may_have_are_refused(text):
    diagram = rondel.SphericalVoronoi(clouds.uniform(6))
    regions = diagram.dissolve(["a", text, "b", "b", "b", "b"])
    for write, properties in (
        (diagram.to_geojson, {"s": [text] * 6}),
        (diagram.to_geojson, {text: [1] * 6}),
        (diagram.to_geojson, {"s": [{"in": [text]}] * 6}),
        (regions.to_geojson, None),
    ):
        with pytest.raises(ValueError, match=r"U\+0000 or is not UTF-8"):
            write(properties=properties)
    fine = diagram.to_geojson(properties={"s": ["\\u0000 \U0001f30d"] * 6})
    assert fine["features"][0]["properties"]["s"] == "\\u0000 \U0001f30d"


def test_numbers_of_numpy_in_dictionaries_are_numbers():
    diagram = rondel.SphericalVoronoi(clouds.uniform(6))
    value = {"k": np.int64(3), "v": np.array([1.5, 2]), "b": np.bool_(True)}
    found = diagram.to_geojson(properties={"d": [value] * 6})["features"][0]["properties"]["d"]
    assert found == {"k": 3, "v": [1.5, 2], "b": True}
    with pytest.raises(ValueError, match="the property 'd': "):
        diagram.to_geojson(properties={"d": [{"k": float("nan")}] * 6})


def test_properties_that_are_no_columns_are_refused(tmp_path):
    pandas = pytest.importorskip("pandas")
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    table = pandas.DataFrame({"a": range(9), "b": list("abcdefghi")})
    writers = [
        lambda properties: diagram.to_geojson(properties=properties),
        lambda properties: diagram.to_geojson(tmp_path / "out.geojson", properties=properties),
        lambda properties: diagram.dissolve(range(9)).to_geojson(properties=properties),
    ]
    for write in writers:
        for properties in (table, [1, 2], "a"):
            kind = type(properties).__name__
            with pytest.raises(TypeError, match=f"^properties must be a mapping .*, not {kind};"):
                write(properties)
        for values in (
            5,
            None,
            "abcdefghi",
            np.float64(3),
            table,
            set(range(9)),
            dict.fromkeys(range(9)),
            iter(range(9)),
        ):
            kind = type(values).__name__
            with pytest.raises(TypeError, match=f"^the property 'a' must .*, but is {kind}$"):
                write({"a": values})
        with pytest.raises(ValueError, match="the property 'a' has 2 values for 9"):
            write({"a": [1, 2]})
    features = diagram.to_geojson(properties=dict(table))["features"]
    assert [feature["properties"]["b"] for feature in features] == list("abcdefghi")
