# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The accessor of xarray's Datasets."""

import warnings

import clouds
import numpy as np
import pytest

import rondel

try:
    import xarray

    import rondel.xarray
except ImportError:
    xarray = None
pytestmark = [
    pytest.mark.skipif(xarray is None, reason="needs xarray"),
    pytest.mark.filterwarnings("ignore:left out, as they are no real numbers. name$"),
]

LON, LAT = rondel.lonlat(clouds.uniform(120)).T
TEMPERATURE = np.random.default_rng(0).normal(size=(3, 120))
AXES = (np.arange(0, 360, 30.0), np.arange(-90, 91, 30.0))
EAST = {"standard_name": "longitude", "units": "degrees_east"}
NORTH = {"standard_name": "latitude", "units": "degrees_north"}
GRID = xarray and xarray.Dataset(
    coords={"lon": ("lon", AXES[0], EAST), "lat": ("lat", AXES[1], NORTH)}
)


def unstructured(**names):
    lon, lat = names.get("lon", "lon"), names.get("lat", "lat")
    return xarray.Dataset(
        {
            "t": (("time", "cell"), TEMPERATURE.astype(np.float32), {"units": "K"}),
            "height": ("cell", np.arange(120), {"units": "m"}),
            "name": ("cell", [f"station {i}" for i in range(120)]),
            "hour": ("time", [0, 6, 12]),
        },
        coords={lon: ("cell", LON), lat: ("cell", LAT), "time": [10, 20, 30]},
        attrs={"title": "made up"},
    )


def expected(values, method="sibson"):
    return rondel.interpolate(LON, LAT, values, AXES[0], AXES[1][:, None], method)


def test_to_a_grid():
    ds = unstructured()
    found = ds.rondel.interpolate(GRID)
    assert list(found.data_vars) == ["t", "height", "hour"]
    assert found.t.dims == ("time", "lat", "lon")
    assert found.t.dtype == np.float32
    assert np.allclose(found.t, expected(ds.t), atol=1e-6)
    assert np.allclose(found.height, expected(np.arange(120)), atol=1e-12)
    assert found.attrs == ds.attrs
    assert found.t.attrs == {"units": "K"}
    assert found.lon.attrs == {"standard_name": "longitude", "units": "degrees_east"}
    assert found.time.values.tolist() == [10, 20, 30]
    assert found.hour.identical(ds.hour)
    one = ds.t.rondel.interpolate(GRID, "cubic")
    assert one.identical(ds.rondel.interpolate(GRID, "cubic").t)


def test_between_all_kinds_of_grids():
    ds = unstructured()
    grid = ds.rondel.interpolate(GRID)
    turned = xarray.broadcast(grid.lat, grid.lon)
    curved = xarray.Dataset(
        coords={
            "latitude": (("y", "x"), turned[0].values),
            "longitude": (("y", "x"), turned[1].values),
        }
    )
    there = ds.rondel.interpolate(curved)
    assert there.t.dims == ("time", "y", "x")
    assert np.array_equal(there.t, grid.t)
    points = unstructured(lon="x_of", lat="y_of")[["x_of", "y_of"]]
    points.x_of.attrs["units"] = "degrees_east"
    points.y_of.attrs["standard_name"] = "latitude"
    back = grid.rondel.interpolate(points, "linear")
    assert back.t.dims == ("time", "cell")
    assert np.allclose(back.t, there.rondel.interpolate(points, "linear").t, atol=1e-6)
    assert {"x_of", "y_of"} < set(back.coords)


def test_weights_are_kept(tmp_path):
    ds = unstructured()
    weights = ds.rondel.weights(GRID, "linear")
    weights.save(tmp_path / "weights.npz")
    for kept in (weights, rondel.Weights.load(tmp_path / "weights.npz")):
        found = ds.rondel.interpolate(GRID, weights=kept)
        assert found.identical(ds.rondel.interpolate(GRID, "linear"))
    for other in (ds.isel(cell=slice(None, None, -1)), ds.isel(cell=slice(50))):
        with pytest.raises(ValueError, match="weights are of other places"):
            other.rondel.interpolate(GRID, weights=weights)
    with pytest.raises(ValueError, match="weights are of other places"):
        ds.rondel.interpolate((AXES[0] + 1, AXES[1]), grid=True, weights=weights)
    with pytest.raises(TypeError, match=r"must be Weights, not str; rondel.read_weights\(\) reads"):
        ds.rondel.interpolate(GRID, weights="weights.npz")


def test_methods_beside_weights_are_told():
    ds = unstructured()
    weights = ds.rondel.weights(GRID, "linear")
    with pytest.warns(UserWarning, match="so these change nothing: method, outside$"):
        found = ds.rondel.interpolate(GRID, "cubic", weights=weights, outside="nearest", threads=1)
    assert found.identical(ds.rondel.interpolate(GRID, "linear"))
    assert ds.rondel.interpolate(GRID).identical(ds.rondel.interpolate(GRID, "sibson"))


def test_texts_are_no_places():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame({"lon": ["10E", "20E"], "lat": [1.0, 2]})
    with pytest.raises(TypeError, match="'lon' must be numbers, not text"):
        unstructured().rondel.interpolate(table)
    with pytest.raises(TypeError, match="'lat' must be numbers, not text"):
        rondel.Regridder({"lon": [1, 2], "lat": ["a", "b"]}, GRID, "linear")
    table["lon"] = pandas.array([10, None], "Int64")
    with pytest.warns(UserWarning, match="1 of 2 places have no longitude or latitude"):
        found = unstructured().rondel.interpolate(table, "nearest").height.values
    assert np.isfinite(found[0])
    assert np.isnan(found[1])


def test_missing_values():
    ds = unstructured()
    ds.t[1, 40] = np.nan
    assert np.isnan(ds.rondel.interpolate(GRID).t).any()
    assert not np.isnan(ds.rondel.interpolate(GRID, skipna=True).t).any()
    away = ds.isel(cell=LAT > 40).rondel
    assert np.isnan(away.interpolate(GRID).t.sel(lat=-60)).all()
    assert not np.isnan(away.interpolate(GRID, outside="nearest", skipna=True).t).any()


def test_dask_stays_lazy():
    dask = pytest.importorskip("dask.array")
    ds = unstructured()
    lazy = ds.chunk(time=1, cell=50).rondel.interpolate(GRID)
    assert isinstance(lazy.t.data, dask.Array)
    assert lazy.t.dtype == np.float32
    assert np.array_equal(lazy.t, ds.rondel.interpolate(GRID).t)


def test_what_is_not_found():
    ds = unstructured(lon="a", lat="b")
    with pytest.raises(ValueError, match="no coordinate has the longitudes: say lon=NAME"):
        ds.rondel.interpolate(GRID)
    found = ds.rondel.interpolate(GRID, lon="a", lat="b")
    assert found.t.identical(unstructured().rondel.interpolate(GRID).t)
    twice = unstructured().assign_coords(longitude=("cell", LON))
    with pytest.raises(ValueError, match="lon and longitude may be the longitudes"):
        twice.rondel.interpolate(GRID)
    with pytest.raises(ValueError, match=r"lat of a grid must have shape \(n,\)"):
        unstructured().rondel.interpolate((AXES[0], AXES[1][:, None]), grid=True)
    with pytest.raises(ValueError, match="method must be one of"):
        unstructured().rondel.interpolate(GRID, "bilinear")


@pytest.mark.parametrize("shape", [(), (7,), (2, 3)])
def test_tuples_are_pairs(shape):
    rng = np.random.default_rng(4)
    lon, lat = rng.uniform(-180, 180, shape), rng.uniform(-80, 80, shape)
    ds = unstructured()
    found = ds.rondel.interpolate((lon, lat), "linear")
    assert found.t.shape == (*ds.t.shape[:-1], *(shape or (1,)))
    expected = rondel.interpolate(LON, LAT, ds.t, lon, lat, "linear").astype("f4")
    assert np.array_equal(found.t, expected.reshape(found.t.shape))
    weights = ds.rondel.weights((lon, lat), "linear")
    assert ds.rondel.interpolate((lon, lat), weights=weights).identical(found)


def test_tuples_are_broadcast_or_axes_of_a_grid():
    ds = unstructured()
    grid = ds.rondel.interpolate(GRID)
    asked = ds.rondel.interpolate(AXES, grid=True)
    assert asked.t.dims == ("time", "lat", "lon")
    assert np.array_equal(asked.t, grid.t)
    lists = tuple(values.tolist() for values in AXES)
    assert ds.rondel.interpolate(lists, grid=True).identical(asked)
    curved = ds.rondel.interpolate((AXES[0], AXES[1][:, None]))
    assert curved.t.dims == ("time", "y", "x")
    assert np.array_equal(curved.t, grid.t)
    named = ds.rondel.interpolate((GRID.lon, GRID.lat))
    assert np.array_equal(named.t, grid.t)
    # Arrays of different lengths are no pairs.
    assert ds.rondel.interpolate(AXES).identical(asked)
    with pytest.raises(ValueError, match=r"shapes \(2, 6\) and \(7,\), but are pairs; grid=True"):
        ds.rondel.interpolate((AXES[0].reshape(2, 6), AXES[1]))
    same = AXES[0][:7], AXES[1]
    assert ds.rondel.interpolate(same).t.shape == (len(ds.time), 7)
    assert ds.rondel.interpolate(same, grid=True).t.shape == (len(ds.time), 7, 7)


def test_places_that_are_given_twice_are_told():
    grid = GRID.isel(lat=slice(1, -1))
    values = np.arange(2.0 * 5 * 12).reshape(2, 5, 12)
    ds = grid.assign(t=(("time", "lat", "lon"), values))
    stacked = ds.t.stack(k=("time", "lat"))
    words = "60 of 120 places are those of others before them; at each place the first value"
    places = ([10.0, 50], [20.0, -30])
    with pytest.warns(UserWarning, match=words):
        found = stacked.rondel.interpolate(places, "linear")
    first = ds.t[0].rondel.interpolate(places, "linear")
    assert np.array_equal(found, first)
    with pytest.warns(UserWarning, match=words):
        stacked.rondel.weights(places, "linear")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        chosen = stacked.rondel.interpolate(places, "linear", duplicates="first")
        assert np.array_equal(chosen, first)
        mean = stacked.rondel.interpolate(places, "linear", duplicates="mean")
        assert np.allclose(mean, ds.t.mean("time").rondel.interpolate(places, "linear"))
        around = xarray.concat([GRID, GRID.isel(lon=[0]).assign_coords(lon=[360.0])], "lon")
        field = xarray.DataArray(np.ones((7, 13)), around.coords, ("lat", "lon"))
        assert np.allclose(field.rondel.interpolate(places), 1)


def labeled(values, *dims):
    return xarray.DataArray(values, dims=dims)


def test_arrays_with_names_are_paired_by_them():
    rng = np.random.default_rng(6)
    lon, lat, values = rng.uniform(0, 50, (3, 5, 5))
    to = np.array([20.0, 30]), np.array([22.0, 21])
    wanted = rondel.interpolate(lon, lat, values, *to, "linear")
    x, y, v = (labeled(each, "y", "x") for each in (lon, lat, values))
    turned = y.transpose("x", "y")
    assert not np.array_equal(rondel.interpolate(x, turned.values, v, *to, "linear"), wanted)
    for lats in (y, turned):
        for field in (v, v.transpose("x", "y")):
            assert np.array_equal(rondel.interpolate(x, lats, field, *to, "linear"), wanted)
    times = xarray.concat([v, v + 1], "time").transpose("x", "time", "y")
    both = rondel.interpolate(x, y, times, *to, "linear")
    assert np.allclose(both, [wanted, wanted + 1], rtol=1e-14)
    weights = rondel.area_weights(lat, lon)
    assert np.array_equal(rondel.area_weights(y, x), weights)
    assert np.array_equal(rondel.area_weights(turned, x), weights)
    assert np.array_equal(rondel.unit_vectors(x, turned), rondel.unit_vectors(lon, lat))
    assert np.array_equal(
        rondel.delaunay_lonlat(x, turned).points, rondel.delaunay_lonlat(lon, lat).points
    )
    flat = labeled(values.ravel(), "cell")
    f = rondel.SphericalInterpolator(
        (x.stack(cell=("y", "x")), turned.stack(cell=("y", "x"))), flat
    )
    assert np.array_equal(f(*to), rondel.interpolate(lon, lat, values, *to))


def test_axes_with_names_are_those_of_a_grid():
    lon, lat = labeled(AXES[0][:7], "lon"), labeled(AXES[1], "lat")
    grid = AXES[0][:7], AXES[1][:, None]
    assert np.array_equal(rondel.unit_vectors(lon, lat), rondel.unit_vectors(*grid))
    assert np.array_equal(rondel.area_weights(lat, lon), rondel.area_weights(grid[1], grid[0]))
    found = rondel.interpolate(LON, LAT, TEMPERATURE, lon, lat)
    assert found.shape == (3, 7, 7)
    assert np.array_equal(found, rondel.interpolate(LON, LAT, TEMPERATURE, *grid))
    for make in (rondel.delaunay_lonlat, rondel.SphericalVoronoi.from_lonlat):
        with pytest.raises(ValueError, match=r"are pairs, but have the dimensions \('lon',\) and"):
            make(lon, lat)
    # Labels do not move one array against the other.
    shifted = lat.rename(lat="p").assign_coords(p=np.arange(7) + 1)
    pairs = lon.rename(lon="p").assign_coords(p=np.arange(7)), shifted
    assert np.array_equal(rondel.unit_vectors(*pairs), rondel.unit_vectors(AXES[0][:7], AXES[1]))


def test_tables_are_points():
    pandas = pytest.importorskip("pandas")
    ds = unstructured()
    wanted = ds.rondel.interpolate(([2.5, -70], [48.5, 10]), "linear").t
    table = pandas.DataFrame({"name": ["a", "b"], "Latitude": [48.5, 10], "Lon": [2.5, -70]})
    assert np.array_equal(ds.rondel.interpolate(table, "linear").t, wanted)
    with pytest.raises(ValueError, match="no column of the table has the longitudes"):
        ds.rondel.interpolate(table[["name", "Latitude"]])
    with pytest.raises(ValueError, match="columns Lon and longitude may be the lon"):
        ds.rondel.interpolate(table.assign(longitude=1.0))
    with pytest.raises(TypeError, match="not list"):
        ds.rondel.interpolate([[2.5, 48.5]])
    geopandas = pytest.importorskip("geopandas")
    points = geopandas.GeoSeries.from_xy(table["Lon"], table["Latitude"], crs=4326)
    frame = geopandas.GeoDataFrame(geometry=points)
    for known in (frame, frame.to_crs(3857)):
        assert np.allclose(ds.rondel.interpolate(known, "linear").t, wanted, rtol=1e-6)
    lost = frame.set_geometry([None, points[1]], crs=4326)
    for known in (lost, lost.to_crs(3857)):
        with pytest.warns(UserWarning, match="1 of 2 places have no longitude or latitude"):
            found = ds.rondel.interpolate(known, "linear").t
        assert np.isnan(found[..., 0]).all()
        assert np.allclose(found[..., 1], wanted[..., 1], rtol=1e-6)
    with pytest.raises(ValueError, match="no column of the table has the longitudes"):
        ds.rondel.interpolate(table[["name"]].assign(geometry="POINT (0 0)"))
    with pytest.raises(TypeError, match="places must be points"):
        ds.rondel.interpolate(frame.to_crs(3857).set_geometry(points.to_crs(3857).buffer(1)))
