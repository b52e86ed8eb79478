# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Fields whose `cell_methods` say that they are sums over cells, such as people per cell: each
target gets its share of each source's sum. Held against overlaps of boxes that are computed here.
"""

import warnings

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
WEST, SOUTH = np.arange(-180.0, 180, 15), np.arange(-60.0, 60, 10)
LINES = {"lon": np.append(WEST, 180), "lat": np.append(SOUTH, 60)}
METHODS = ["conservative", "conservative_2nd"]


def people(cell_methods="area: sum", gaps=0.0):
    rng = np.random.default_rng(11)
    values = rng.random((2, len(SOUTH), len(WEST))) * 1000
    values[rng.random(values.shape) < gaps] = np.nan
    dims = ("time", "lat", "lon")
    return xarray.Dataset(
        {
            "people": (dims, values, {"cell_methods": cell_methods, "units": "1"}),
            "warm": (dims, values, {"cell_methods": "area: maximum time: mean"}),
        },
        {
            "time": [0, 1],
            "lat": ("lat", SOUTH + 5, {"units": "degrees_north"}),
            "lon": ("lon", WEST + 7.5, {"units": "degrees_east"}),
        },
    )


def shares(own, others, height):
    """The part of each interval that is in each of the others, measured by a function."""
    low = np.maximum(height(own[:-1])[:, None], height(others[:-1])[None, :])
    high = np.minimum(height(own[1:])[:, None], height(others[1:])[None, :])
    return np.maximum(high - low, 0) / np.diff(height(own))[:, None]


def sums_on(west, south, values):
    """The sums in boxes between meridians and parallels; NaN where no source has a value."""
    east_west = shares(LINES["lon"], west, lambda x: x)
    south_north = shares(LINES["lat"], south, lambda y: np.sin(np.radians(y)))

    def carried(array):
        return np.einsum("tji,jm,in->tmn", array, south_north, east_west)

    is_there = carried(np.isfinite(values).astype(float)) > 0
    return np.where(is_there, carried(np.nan_to_num(values)), np.nan)


def written(data, target, tmp_path, **options):
    data.to_netcdf(tmp_path / "in.nc")
    report = rondel.regrid_file(tmp_path / "in.nc", target, tmp_path / "out.nc", **options)
    with xarray.open_dataset(tmp_path / "out.nc", decode_times=False) as file:
        return file.load(), report


@pytest.mark.parametrize("gaps", [0, 0.4])
@pytest.mark.parametrize("cell_methods", ["area: sum", "time: mean lat: lon: sum where land"])
def test_each_target_gets_its_share(tmp_path, gaps, cell_methods):
    data = people(cell_methods, gaps)
    # The poles have no source, and of some targets a third is covered.
    west, south = np.arange(-180.0, 181, 20), np.array([-90.0, -70, -55, 0, 45, 90])
    target = rondel.CellSet.lonlat_grid(west, south)
    expected = sums_on(west, south, data.people.values)
    assert np.isnan(expected[:, 0]).all()
    found = rondel.regrid(data, target)
    np.testing.assert_allclose(found.people, expected, rtol=1e-12)
    assert found.people.cell_methods == cell_methods
    grid = xarray.Dataset(
        coords={
            "lat": ("lat", (south[1:] + south[:-1]) / 2, {"units": "degrees_north"}),
            "lon": ("lon", (west[1:] + west[:-1]) / 2, {"units": "degrees_east"}),
        }
    )
    for name, lines in (("lat", south), ("lon", west)):
        grid[f"{name}_bnds"] = ((name, "bnds"), np.stack([lines[:-1], lines[1:]], -1))
        grid[name].attrs["bounds"] = f"{name}_bnds"
    grid.to_netcdf(tmp_path / "grid.nc")
    for options in ({}, {"norm": "destarea"}, {"tile": 9}):
        file, _ = written(data, tmp_path / "grid.nc", tmp_path, **options)
        np.testing.assert_allclose(file.people, expected, rtol=1e-12)
        assert file.people.cell_methods == cell_methods


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("target", ["healpix:2", "O8", "grid:7x11", "C6"])
@pytest.mark.parametrize("gaps", [0, 0.4])
def test_sums_are_kept(tmp_path, method, target, gaps):
    data = people(gaps=gaps)
    total = np.nansum(data.people.values, axis=(1, 2))
    found = rondel.regrid(data, target, method).people.values.reshape(2, -1)
    np.testing.assert_allclose(np.nansum(found, axis=1), total, rtol=1e-12)
    for options in ({}, {"norm": "destarea"}, {"tile": 30}):
        file, _ = written(data, target, tmp_path, method=method, **options)
        values = file.people.values.reshape(2, -1)
        np.testing.assert_allclose(np.nansum(values, axis=1), total, rtol=1e-12)
        np.testing.assert_allclose(values, found, rtol=1e-9, atol=1e-9)


def test_sums_of_a_mesh_are_kept(tmp_path):
    cells = rondel.CellSet.named("healpix:2")
    values = np.random.default_rng(12).random(cells.num_cells)
    field = xarray.Dataset({"n": ("cell", values, {"cell_methods": "cell: sum"})})
    field["crs"] = ((), 0, {"grid_mapping_name": "healpix", "refinement_level": 2})
    field.crs.attrs["indexing_scheme"] = "nested"
    field.n.attrs["grid_mapping"] = "crs"
    found = rondel.regrid(field, "grid:45")
    assert float(found.n.sum()) == pytest.approx(values.sum(), rel=1e-12)
    file, _ = written(field, "grid:45", tmp_path)
    np.testing.assert_allclose(file.n, found.n, rtol=1e-12)


def test_lazy_sums_are_the_same():
    pytest.importorskip("dask")
    data = people(gaps=0.2)
    for method in METHODS:
        lazy = rondel.regrid(data.chunk({"time": 1}), "healpix:1", method, output_chunks=7)
        assert lazy.people.chunks[1][0] == 7
        whole = rondel.regrid(data, "healpix:1", method)
        np.testing.assert_array_equal(lazy.people, whole.people)


def test_cell_methods_say_what_was_done(tmp_path):
    data = people("area: mean")
    data["kind"] = (data.people > 500).astype("i4").assign_attrs(flag_meanings="few many")
    data["plain"] = data.people.copy(data=data.people.values)
    data.plain.attrs = {}
    expected = {
        "people": "area: mean",
        "warm": "area: maximum time: mean area: mean",
        "kind": "area: mode",
        "plain": "area: mean",
    }
    file, _ = written(data, "grid:30", tmp_path)
    for found in (file, rondel.regrid(data, "grid:30")):
        assert {name: found[name].cell_methods for name in expected} == expected
    # Values between places are no means.
    file, _ = written(data, "grid:30", tmp_path, method="linear")
    for found in (file, rondel.regrid(data, "grid:30", "linear")):
        assert found.warm.cell_methods == "area: maximum time: mean"
        assert "cell_methods" not in found.plain.attrs
    # As in xESMF, attributes are kept on request, and a stale one is mended.
    regridder = rondel.Regridder(data, "grid:30", "conservative")
    assert regridder(data.warm, keep_attrs=True).cell_methods == expected["warm"]
    assert regridder(data.plain, keep_attrs=True).attrs == {}
    assert regridder(data.warm).attrs == {}


@pytest.mark.parametrize("method", ["linear", "nearest", "largest_share"])
def test_methods_that_keep_no_sums_tell_of_them(tmp_path, method):
    text = "people.? has sums over cells, by cell_methods"
    _, report = written(people(), "grid:30", tmp_path, method=method)
    assert any("has sums over cells" in remark for remark in report.remarks)
    with pytest.warns(UserWarning, match=text):
        rondel.regrid(people(), "grid:30", method)
    with pytest.warns(UserWarning, match=text):
        found = rondel.Regridder(people(), "grid:30", "conservative_normed")(people())
    assert float(found.people.max()) <= float(people().people.max())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rondel.regrid(people("time: sum"), "grid:30", method)


def test_sums_are_not_extrapolated(tmp_path):
    data = people()
    file, report = written(data, "grid:10", tmp_path, extrapolate="nearest")
    assert any("which are not extrapolated" in remark for remark in report.remarks)
    assert np.isfinite(file.warm).all()
    total = data.people.values.sum(axis=(1, 2))
    np.testing.assert_allclose(file.people.sum(["lat", "lon"]), total, rtol=1e-12)
    with pytest.warns(UserWarning, match="people has sums over cells.*not extrapolated"):
        found = rondel.regrid(data, "grid:10", extrap_method="nearest_s2d")
    assert np.isfinite(found.warm).all()
    np.testing.assert_allclose(found.people, file.people, rtol=1e-12)
