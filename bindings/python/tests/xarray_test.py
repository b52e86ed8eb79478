# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The accessor of xarray's Datasets."""

import clouds
import numpy as np
import pytest

import rondel

try:
    import xarray

    import rondel.xarray
except ImportError:
    xarray = None
pytestmark = pytest.mark.skipif(xarray is None, reason="needs xarray")

LON, LAT = rondel.lonlat(clouds.uniform(120)).T
TEMPERATURE = np.random.default_rng(0).normal(size=(3, 120))
AXES = (np.arange(0, 360, 30.0), np.arange(-90, 91, 30.0))


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
    found = ds.rondel.interpolate(AXES)
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
    one = ds.t.rondel.interpolate(AXES, "cubic")
    assert one.identical(ds.rondel.interpolate(AXES, "cubic").t)


def test_between_all_kinds_of_grids():
    ds = unstructured()
    grid = ds.rondel.interpolate(AXES)
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
    weights = ds.rondel.weights(AXES, "linear")
    weights.save(tmp_path / "weights.npz")
    for kept in (weights, rondel.Weights.load(tmp_path / "weights.npz")):
        found = ds.rondel.interpolate(AXES, weights=kept)
        assert found.identical(ds.rondel.interpolate(AXES, "linear"))
    for other in (ds.isel(cell=slice(None, None, -1)), ds.isel(cell=slice(50))):
        with pytest.raises(ValueError, match="weights are of other places"):
            other.rondel.interpolate(AXES, weights=weights)
    with pytest.raises(ValueError, match="weights are of other places"):
        ds.rondel.interpolate((AXES[0] + 1, AXES[1]), weights=weights)


def test_missing_values():
    ds = unstructured()
    ds.t[1, 40] = np.nan
    assert np.isnan(ds.rondel.interpolate(AXES).t).any()
    assert not np.isnan(ds.rondel.interpolate(AXES, skipna=True).t).any()
    away = ds.isel(cell=LAT > 40).rondel
    assert np.isnan(away.interpolate(AXES).t.sel(lat=-60)).all()
    assert not np.isnan(away.interpolate(AXES, outside="nearest", skipna=True).t).any()


def test_dask_stays_lazy():
    dask = pytest.importorskip("dask.array")
    ds = unstructured()
    lazy = ds.chunk(time=1, cell=50).rondel.interpolate(AXES)
    assert isinstance(lazy.t.data, dask.Array)
    assert lazy.t.dtype == np.float32
    assert np.array_equal(lazy.t, ds.rondel.interpolate(AXES).t)


def test_what_is_not_found():
    ds = unstructured(lon="a", lat="b")
    with pytest.raises(ValueError, match="no coordinate has the longitudes: say lon=NAME"):
        ds.rondel.interpolate(AXES)
    found = ds.rondel.interpolate(AXES, lon="a", lat="b")
    assert found.t.identical(unstructured().rondel.interpolate(AXES).t)
    twice = unstructured().assign_coords(longitude=("cell", LON))
    with pytest.raises(ValueError, match="lon and longitude may be the longitudes"):
        twice.rondel.interpolate(AXES)
    with pytest.raises(ValueError, match=r"lat of a grid must have shape \(n,\)"):
        unstructured().rondel.interpolate((AXES[0], AXES[1][:, None]))
    with pytest.raises(ValueError, match="method must be one of"):
        unstructured().rondel.interpolate(AXES, "bilinear")
