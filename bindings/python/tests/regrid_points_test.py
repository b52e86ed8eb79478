# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""rondel.regrid to points: tables, arrays, and lists of places; and the file of regrid_file."""

import warnings

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402

LON, LAT = np.arange(0.0, 360, 10), np.arange(-80.0, 81, 10)
TIMES = np.array(["2000-01-01", "2000-01-02"], "datetime64[ns]")
POINTS = np.array([[1.5, 2.25], [100, -33.3], [540, 12], [100, -33.3]])


def function(lon, lat):
    """Linear in both from longitude 0 to 350."""
    return (np.asarray(lon) % 360) * 0.5 - 2 * np.asarray(lat)


def fields():
    base = function(LON, LAT[:, None])
    return xarray.Dataset(
        {
            "t": (("time", "lat", "lon"), base + np.array([0, 7])[:, None, None], {"units": "K"}),
            "oro": (("lat", "lon"), base),
        },
        {
            "time": TIMES,
            "lat": ("lat", LAT, {"units": "degrees_north"}),
            "lon": ("lon", LON, {"units": "degrees_east"}),
        },
        {"title": "made up"},
    )


def expect_values(found, dim="point"):
    right = function(*POINTS.T)
    assert found.t.dims == ("time", dim)
    np.testing.assert_allclose(found.t, right + np.array([[0], [7]]), rtol=0, atol=1e-11)
    np.testing.assert_allclose(found.oro, right, rtol=0, atol=1e-11)
    np.testing.assert_array_equal(found.lon, POINTS[:, 0])
    np.testing.assert_array_equal(found.lat, POINTS[:, 1])


def test_tables_keep_their_columns():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame(
        {
            "name": ["a", None, "c", "d"],
            "lon": POINTS[:, 0],
            "Lat": POINTS[:, 1],
            "height": [1, 2, 3, 4],
            "when": pandas.to_datetime(["2001-01-01"] * 4),
            "oro": [1.5, 2, 3, np.nan],
        },
        index=[3, 1, 4, 1],
    )
    with pytest.warns(UserWarning, match="gave way to fields: oro is oro_$"):
        found = fields().rondel.regrid(table, "bilinear")
    expect_values(found)
    assert found["name"].values.tolist() == ["a", "", "c", "d"]
    assert found.height.values.tolist() == [1, 2, 3, 4]
    np.testing.assert_array_equal(found.oro_, [1.5, 2, 3, np.nan])
    assert found.when.dtype.kind == "M"
    assert found.attrs == {"title": "made up", "featureType": "timeSeries"}
    with pytest.warns(UserWarning, match="neither texts nor numbers: odd$"):
        found = rondel.regrid(fields().t, table.assign(odd=[[1]] * 4), "bilinear")
    assert set(found.coords) == {"time", "lat", "lon", "name", "height", "when", "oro"}


def test_arrays_are_points_on_request():
    lon, lat = POINTS.T
    for target in ((lon, lat), {"lon": lon, "lat": lat}):
        expect_values(rondel.regrid(fields(), target, "bilinear", locstream_out=True))
    assert rondel.regrid(fields(), (lon[:2], lat[:2]), "bilinear").oro.shape == (2, 2)


def test_frames_of_points_are_points():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    frame = geopandas.GeoDataFrame({"n": [5, 6, 7, 8]}, geometry=shapely.points(POINTS), crs=4326)
    found = rondel.regrid(fields(), frame, "bilinear")
    expect_values(found)
    assert found.n.values.tolist() == [5, 6, 7, 8]
    assert "geometry" not in found.coords


def test_geometries_count_and_columns_of_degrees_do_not():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    for columns in ({"lon": [99.0] * 4, "Lat": [-80.0] * 4}, {"lon": [99.0] * 4}):
        frame = geopandas.GeoDataFrame(columns, geometry=shapely.points(POINTS), crs=4326)
        with pytest.warns(UserWarning, match="gave way to fields: lon is lon_"):
            found = rondel.regrid(fields(), frame, "bilinear")
        expect_values(found)
        assert found.lon_.values.tolist() == [99.0] * 4
        value = rondel.Regridder(fields(), frame, "bilinear")(fields().oro)
        np.testing.assert_array_equal(value, found.oro)


def test_an_index_with_a_name_is_a_column():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame({"lon": POINTS[:, 0], "lat": POINTS[:, 1]})
    table.index = pandas.Index(list("abcd"), name="station")
    assert rondel.regrid(fields(), table, "bilinear").station.values.tolist() == list("abcd")
    table.index = pandas.MultiIndex.from_arrays([list("xyxy"), [1, 2, 3, 4]], names=["net", "k"])
    found = rondel.regrid(fields(), table, "bilinear")
    expect_values(found)
    assert found.net.values.tolist() == list("xyxy")
    assert found.k.values.tolist() == [1, 2, 3, 4]


def test_methods_over_cells_are_refused():
    lon, lat = POINTS.T
    for method in (None, "conservative", "conservative_2nd", "largest_share"):
        with pytest.raises(ValueError, match=r"^points have no cells.*; 'nearest', .* for points$"):
            rondel.regrid(fields(), (lon, lat), method, locstream_out=True)


def test_lists_keep_what_they_say_of_their_places():
    stations = xarray.Dataset(
        {"name": ("station", ["a", "b", "c", "d"], {"cf_role": "trajectory_id"})},
        {
            "lon": ("station", POINTS[:, 0]),
            "lat": ("station", POINTS[:, 1]),
            "height": ("station", [1.0, 2, 3, 4], {"units": "m"}),
            "station": [10, 20, 30, 40],
        },
        {"featureType": "timeSeries"},
    )
    stations["pressure"] = ("station", np.ones(4))
    found = rondel.regrid(fields(), stations, "bilinear")
    expect_values(found, "station")
    assert found["name"].values.tolist() == ["a", "b", "c", "d"]
    assert found["name"].attrs == {"cf_role": "timeseries_id"}
    assert found.height.attrs == {"units": "m"}
    assert found.station.values.tolist() == [10, 20, 30, 40]
    assert "pressure" not in found.variables
    assert found.featureType == "timeSeries"
    # A Regridder is like xESMF's, and has the places alone.
    plain = rondel.Regridder(fields(), stations, "bilinear")(fields())
    assert "height" not in plain.variables
    static = rondel.regrid(fields()[["oro"]], stations, "bilinear")
    assert static.featureType == "point"
    assert "cf_role" not in static["name"].attrs


def test_a_track_along_the_dimension_of_the_data_gets_another_one():
    track = xarray.Dataset(
        coords={
            "lon": ("time", POINTS[:, 0]),
            "lat": ("time", POINTS[:, 1]),
            "time": np.arange(4) + np.datetime64("2010-01-01", "ns"),
        }
    )
    with pytest.warns(UserWarning, match="the targets is|gave way") as told:
        found = rondel.regrid(fields(), track, "bilinear")
    assert [str(each.message) for each in told] == [
        "the dimension 'time' of the targets is 'point' in the result, as the data have one of "
        "that name",
        "what describes places gave way to fields: time is time_",
    ]
    expect_values(found)
    np.testing.assert_array_equal(found.time, TIMES)
    np.testing.assert_array_equal(found.time_, track.time)
    with pytest.warns(UserWarning, match="is 'point' in the result"):
        array = rondel.regrid(fields().t, track, "bilinear")
    xarray.testing.assert_equal(array.drop_attrs(), found.t.drop_attrs())
    # Data on the track itself have its dimension as that of their places.
    own = xarray.DataArray(np.arange(4.0), track.coords, ("time",))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # two of the places are one
        assert rondel.regrid(own, track, "nearest").values.tolist() == [0, 1, 2, 1]


def test_blocks_of_dask_have_the_same_values():
    pytest.importorskip("dask")
    lon, lat = np.random.default_rng(5).uniform((-180, -85), (180, 85), (50, 2)).T
    options = {"method": "sibson", "locstream_out": True}
    whole = rondel.regrid(fields(), (lon, lat), **options)
    lazy = rondel.regrid(fields().chunk(time=1), (lon, lat), output_chunks=13, **options)
    assert lazy.t.chunks == ((1, 1), (13, 13, 13, 11))
    xarray.testing.assert_identical(lazy.compute(), whole)


def test_files_have_the_same_values(tmp_path):
    pytest.importorskip("netCDF4")
    fields().to_netcdf(tmp_path / "in.nc")
    rows = [f"{lon},{lat},s{k}" for k, (lon, lat) in enumerate(POINTS)]
    (tmp_path / "sites.csv").write_text("\n".join(["lon,lat,name", *rows]) + "\n")
    report = rondel.regrid_file(
        tmp_path / "in.nc", tmp_path / "sites.csv", tmp_path / "out.nc", method="sibson"
    )
    assert (report.targets, report.fields, report.missing) == (4, 3, 0)
    with xarray.open_dataset(tmp_path / "out.nc") as made:
        lon, lat = POINTS.T
        wanted = rondel.regrid(fields(), (lon, lat), "sibson", locstream_out=True)
        np.testing.assert_array_equal(made.t, wanted.t)
        assert made.featureType == wanted.featureType == "timeSeries"
        assert made["name"].astype(str).values.tolist() == ["s0", "s1", "s2", "s3"]
        # What it wrote is a list of places itself.
        again = rondel.regrid(fields(), made, "sibson")
        np.testing.assert_array_equal(again.t, wanted.t)
        assert again["name"].astype(str).values.tolist() == ["s0", "s1", "s2", "s3"]
    with pytest.raises(OSError, match=r"sites.csv: points have no cells"):
        rondel.regrid_file(tmp_path / "in.nc", tmp_path / "sites.csv", tmp_path / "out.nc")
