# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Places that a mask leaves out: those of SCRIP and OASIS, and the variable `mask`."""

import os
import subprocess
import warnings

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402 (needs xarray)

TOOL = os.environ.get("RONDEL")
LON, LAT = (a.ravel() for a in np.meshgrid(np.arange(0, 360, 20.0), np.arange(-80, 81, 20.0)))
MASKED = np.arange(LON.size) % 7 == 3
TO_LON, TO_LAT = np.arange(5.0, 360, 30), np.arange(-70.0, 71, 28)
GARBAGE = -1e30


def smooth(lon, lat):
    return 10 + np.cos(np.radians(lat)) * np.sin(np.radians(lon))


def scrip(mask=None):
    """A Dataset of places, each seventh masked, where the field has what no one should use."""
    cells = {"units": "degrees"}
    mask = np.where(MASKED, 0, 1).astype(np.int32) if mask is None else mask
    return xarray.Dataset(
        {
            "grid_center_lon": ("grid_size", LON, cells),
            "grid_center_lat": ("grid_size", LAT, cells),
            "grid_imask": ("grid_size", mask),
            "h": (("time", "grid_size"), np.where(MASKED, GARBAGE, smooth(LON, LAT))[None]),
        }
    )


def oasis():
    """The same on two dimensions, where 1 is masked."""
    marks = {"lon": {"units": "degrees_east"}, "lat": {"units": "degrees_north"}}
    made = xarray.Dataset()
    for kind, values in (("lon", LON), ("lat", LAT)):
        made[f"torc.{kind}"] = (("y", "x"), values.reshape(9, 18), marks[kind])
    made["torc.msk"] = (("y", "x"), MASKED.reshape(9, 18).astype(np.int32))
    made["h"] = (("y", "x"), scrip().h.values.reshape(9, 18))
    return made


@pytest.mark.parametrize(("make", "name"), [(scrip, "grid_imask"), (oasis, "torc.msk")])
def test_masked_cells_of_conventions_are_left_out(make, name):
    ds = make()
    used = ~MASKED
    told = pytest.warns(UserWarning, match=f"23 of 162 cells are masked by '{name}'")
    with told:
        found = ds.rondel.interpolate((TO_LON, TO_LAT), "linear", grid=True).h.values.squeeze()
    # The warning names the others alone.
    sites, lat = (a.reshape(-1) for a in np.meshgrid(TO_LON, TO_LAT))
    tri = rondel.delaunay_lonlat(LON[used], LAT[used])
    right = tri.interpolate(smooth(LON, LAT)[used], rondel.unit_vectors(sites, lat), "linear")
    np.testing.assert_array_equal(found.ravel(), right)
    for method in ("linear", "nearest_s2d"):
        with pytest.warns(UserWarning, match="23 of 162 cells are masked"):
            regridder = rondel.Regridder(ds, {"lon": TO_LON, "lat": TO_LAT}, method)
        values = regridder(ds.h).values
        assert np.isfinite(values).all()
        assert values.min() > 8.9
        assert not np.isin(np.flatnonzero(MASKED), regridder.weights.indices).any()


def test_a_mask_that_masks_nothing_is_not_told():
    ds = scrip(np.ones(LON.size, np.int32))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ds.rondel.interpolate((TO_LON, TO_LAT), "linear", grid=True)
    missing = np.where(MASKED, np.nan, 1.0)
    with pytest.warns(UserWarning, match="23 of 162 cells are masked"):
        found = scrip(missing).rondel.interpolate((TO_LON, TO_LAT), "linear", grid=True)
    assert found.h.min() > 8.9
    with pytest.raises(ValueError, match="grid_imask has the dimensions"):
        scrip().assign(grid_imask=("other", [1, 0])).rondel.weights((TO_LON, TO_LAT), grid=True)


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_the_tool_interpolates_the_same(tmp_path):
    ds = scrip()
    around = np.array([-10.0, 10, 10, -10]), np.array([-10.0, -10, 10, 10])
    for kind, middle, corners in zip(("lon", "lat"), (LON, LAT), around, strict=True):
        values = middle[:, None] + corners
        ds[f"grid_corner_{kind}"] = (("grid_size", "grid_corners"), values, {"units": "degrees"})
    plain = {name: {"_FillValue": None} for name in ds.variables}
    ds.to_netcdf(tmp_path / "s.nc", format="NETCDF3_CLASSIC", encoding=plain)
    command = [TOOL, "interpolate", f"{tmp_path}/s.nc:h", "--to", "grid:12x6"]
    command += ["--method", "linear", "-o", f"{tmp_path}/o.nc"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0
    assert '23 of 162 cells are masked by "grid_imask"' in done.stderr
    with xarray.open_dataset(tmp_path / "o.nc") as opened:
        file = opened.load()
    with pytest.warns(UserWarning, match="masked"):
        found = ds.rondel.interpolate(file, "linear").h
    np.testing.assert_allclose(found.values.squeeze(), file.h.values.squeeze(), atol=1e-12)


@pytest.mark.parametrize("method", ["nearest_s2d", "bilinear", "conservative_normed"])
def test_a_mask_counts_for_datasets_and_arrays(method):
    lon, lat = np.arange(0.0, 60, 5), np.arange(-30.0, 31, 5)
    mask = np.ones((len(lat), len(lon)))
    mask[3:6, 4:9] = 0
    mask[8, 8] = np.nan
    values = smooth(lon, lat[:, None])
    values[~(mask == 1)] = GARBAGE
    ds = xarray.Dataset(
        {"t": (("lat", "lon"), values), "mask": (("lat", "lon"), mask)}, {"lon": lon, "lat": lat}
    )
    target = {"lon": np.arange(2.0, 50, 4), "lat": np.arange(-20.0, 21, 4)}
    right = rondel.Regridder(ds, target, method)(ds.t)
    assert np.nanmin(right) > 8.9
    field = ds.set_coords("mask").t
    np.testing.assert_array_equal(rondel.Regridder(field, target, method)(ds.t), right)
    # The targets that a mask leaves out have no value.
    for grid in (ds, field):
        found = rondel.Regridder(target, grid, method)(np.ones((11, 12)))
        assert np.isnan(found[~(mask == 1)]).all()
