# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds that repeat along time or other dimensions, as those of joined Datasets do: equal records
count once, and cells that change are an error.
"""

import numpy as np
import pytest

import rondel
import rondel.xarray

xarray = pytest.importorskip("xarray")
LON, LAT = np.arange(-165.0, 180, 30), np.arange(-75.0, 90, 30)
EAST, NORTH = np.meshgrid(np.arange(5.0, 45, 10), np.arange(-10.0, 20, 10))
UNITS = {"lat": "degrees_north", "lon": "degrees_east"}


def axes(record, change=0.0):
    """A field along axes, with bounds in several records, of which the last one may differ."""
    made = xarray.Dataset()
    for name, centers in (("lat", LAT), ("lon", LON)):
        bounds = np.stack([np.stack([centers - 15, centers + 15], -1)] * 3)
        bounds[2, 1, 0] += change if name == "lat" else 0
        made[name] = (name, centers, {"units": UNITS[name], "bounds": f"{name}_bnds"})
        made[f"{name}_bnds"] = ((record, name, "bnds"), bounds)
    made["t"] = ((record, "lat", "lon"), np.random.default_rng(3).random((3, len(LAT), len(LON))))
    return made


def curvilinear(record, change=0.0):
    """The same with coordinates of two dimensions."""
    made = xarray.Dataset()
    sides = {"lat": [-5, -5, 5, 5], "lon": [-5, 5, 5, -5]}
    for name, centers in (("lat", NORTH), ("lon", EAST)):
        bounds = np.stack([centers[..., None] + sides[name]] * 3)
        bounds[2] += change if name == "lat" else 0
        made[name] = (("y", "x"), centers, {"units": UNITS[name], "bounds": f"{name}_v"})
        made[f"{name}_v"] = ((record, "y", "x", "v"), bounds)
    made["t"] = ((record, "y", "x"), np.random.default_rng(4).random((3, *EAST.shape)))
    return made


def transposed(data, *dims):
    """The same with the records of bounds elsewhere."""
    names = [name for name in data.variables if name.endswith(("_bnds", "_v"))]
    return data.assign({name: data[name].transpose(..., *dims) for name in names})


@pytest.mark.parametrize("record", ["time", "record", "level"])
@pytest.mark.parametrize(("make", "target"), [(axes, "grid:60"), (curvilinear, "grid:10")])
def test_equal_records_count_once(tmp_path, record, make, target):
    data = make(record)
    once = data.copy()
    for name in [name for name in data.variables if name.endswith(("_bnds", "_v"))]:
        once[name] = data[name].isel({record: 0})
    expected = rondel.regrid(once, target).t
    assert expected.count() > 0
    corner = "bnds" if make is axes else "v"
    for given in (data, transposed(data, record), transposed(data, corner, record)):
        found = rondel.regrid(given, target)
        assert set(found.data_vars) == {"t"}
        np.testing.assert_array_equal(found.t, expected)
        np.testing.assert_array_equal(given.rondel.regrid(target).t, expected)
        given.to_netcdf(tmp_path / "many.nc")
        rondel.regrid_file(tmp_path / "many.nc", target, tmp_path / "out.nc")
        with xarray.open_dataset(tmp_path / "out.nc") as file:
            np.testing.assert_array_equal(file.t, expected)
        cells = rondel.CellSet.read(tmp_path / "many.nc")
        assert cells.num_cells == once.t.isel({record: 0}).size


@pytest.mark.parametrize("record", ["time", "level"])
@pytest.mark.parametrize("make", [axes, curvilinear])
def test_cells_that_change_are_refused(make, record):
    moving = make(record, change=0.5)
    for given in (moving, transposed(moving, record), moving.isel({record: [2, 0]})):
        with pytest.raises(rondel.InvalidInput, match=f"the bounds 'lat_.* along .*'{record}'"):
            rondel.regrid(given, "grid:30")
        with pytest.raises(ValueError, match="cells that change are not read"):
            rondel.Regridder(given, "grid:30", "conservative")
        with pytest.raises(ValueError, match="the bounds 'lat_"):
            rondel.zonal_statistics(given, "grid:30")


@pytest.mark.parametrize("make", [axes, curvilinear])
def test_target_with_records_has_bounds_of_cells_alone(make):
    target = make("time").drop_vars("t")
    source = xarray.Dataset(
        {"t": (("time", "lat", "lon"), np.ones((5, 6, 12)))}, {"lat": LAT, "lon": LON}
    )
    found = rondel.regrid(source, target)
    assert found.sizes["time"] == 5
    name = "lat_bnds" if make is axes else "lat_v"
    assert "time" not in found[name].dims
    np.testing.assert_array_equal(found[name], target[name].isel(time=0))
    assert float(abs(found.t - 1).max()) < 1e-15
