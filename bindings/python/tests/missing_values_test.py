# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Missing and packed values after xarray has opened or changed them, against the tool and against
rules that are computed here.
"""

import os
import subprocess
import warnings

import numpy as np
import pytest

import rondel

netCDF4 = pytest.importorskip("netCDF4")  # noqa: N816
xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402 (needs xarray)

TOOL = os.environ.get("RONDEL")
LON, LAT = np.arange(0.0, 360, 90), np.array([-60.0, 0, 60])
AXES = {"lon": LON, "lat": LAT}


def write(path, kind, attributes, raw, fill=None):
    """A variable t(lat, lon) of these numbers; without any they are as netCDF fills them."""
    with netCDF4.Dataset(path, "w") as file:
        for name, values, units in (
            ("lat", LAT, "degrees_north"),
            ("lon", LON, "degrees_east"),
        ):
            file.createDimension(name, len(values))
            variable = file.createVariable(name, "f8", (name,))
            variable.units = units
            variable[:] = values
        variable = file.createVariable("t", kind, ("lat", "lon"), fill_value=fill)
        variable.set_auto_maskandscale(False)
        variable.setncatts(attributes)
        for row, values in enumerate(raw):
            variable[row] = values


def at_its_own_places(path, chunks=None):
    with xarray.open_dataset(path) as ds:
        ds = ds if chunks is None else ds.chunk(chunks)
        return np.asarray(rondel.Regridder(ds, AXES, "nearest_s2d")(ds.t).values, np.float64)


def run_tool(path, folder):
    rondel.Regridder(AXES, AXES, "nearest_s2d").to_netcdf(folder / "w.nc")
    command = [TOOL, "apply", folder / "w.nc", f"{path}:t", "-o", folder / "out.npy", "--quiet"]
    return subprocess.run(list(map(str, command)), check=False, capture_output=True, text=True)


def by_tool(path, folder):
    run_tool(path, folder).check_returncode()
    return np.load(folder / "out.npy").reshape(3, 4)


SINGLE, DOUBLE = np.float32, np.float64
FILLED = [
    (kind, {"scale_factor": of(scale), **offset})
    for kind in ("i2", "u2", "i4", "u4", "f4", "f8")
    for of, scale, offset in (
        (SINGLE, 0.1, {}),
        (DOUBLE, 0.1, {}),
        (SINGLE, -0.5, {"add_offset": SINGLE(273.15)}),
        (SINGLE, 0.01, {"add_offset": DOUBLE(-5)}),
    )
]


@pytest.mark.parametrize(("kind", "attributes"), FILLED)
def test_what_nobody_wrote_is_missing_however_it_is_packed(tmp_path, kind, attributes):
    path = tmp_path / "f.nc"
    rows = np.array([[1, 2, 3, 4], [5, 6, 7, 100]])
    write(path, kind, attributes, rows)
    right = rows * float(attributes["scale_factor"]) + float(attributes.get("add_offset", 0))
    for chunks in (None, {"lat": 2}):
        found = at_its_own_places(path, chunks)
        assert np.isnan(found[2]).all()
        np.testing.assert_allclose(found[:2], right, rtol=1e-6)
    if TOOL is not None:
        np.testing.assert_array_equal(np.isnan(by_tool(path, tmp_path)), np.isnan(found))


BOUNDS = [
    ("i2", {"scale_factor": SINGLE(0.01), "valid_min": SINGLE(1.0)}),
    ("i2", {"scale_factor": SINGLE(0.01), "valid_max": SINGLE(1.0)}),
    ("i2", {"scale_factor": DOUBLE(0.01), "valid_range": np.array([1.0, 1.02])}),
    ("i2", {"scale_factor": SINGLE(0.01), "valid_range": np.array([100, 102], "i2")}),
    ("i4", {"scale_factor": SINGLE(-0.1), "valid_range": np.array([100, 102], "i4")}),
    ("u1", {"add_offset": SINGLE(0.3), "valid_max": np.uint8(101)}),
    ("f4", {"scale_factor": SINGLE(0.1), "valid_range": np.array([100, 102], "f4")}),
    ("f4", {"valid_range": np.array([100, 102], "f4")}),
]


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
@pytest.mark.parametrize(("kind", "attributes"), BOUNDS)
def test_numbers_at_a_bound_are_what_the_tool_makes_of_them(tmp_path, kind, attributes):
    raw = np.array([[98, 99, 100, 101], [102, 103, 104, 1], [100, 102, 0, 7]])
    write(tmp_path / "b.nc", kind, attributes, raw)
    right = by_tool(tmp_path / "b.nc", tmp_path)
    assert 0 < np.isnan(right).sum() < 12
    found = at_its_own_places(tmp_path / "b.nc")
    np.testing.assert_array_equal(np.isnan(found), np.isnan(right))
    np.testing.assert_allclose(found, right, rtol=1e-6)


def packed_in_degrees(path):
    """0.01 degrees, from 1 to 40 degrees."""
    bounds = {"scale_factor": 0.01, "valid_range": np.array([100, 4000], "i2")}
    raw = np.array([[500, 600, 700, 800], [2000, 2100, 2200, 2300], [3000, 3100, 3200, 50]])
    write(path, "i2", bounds, raw, fill=np.int16(-32768))
    right = np.where(raw < 100, np.nan, raw * 0.01)
    return right


@pytest.mark.parametrize("keep", [True, False])
def test_results_have_no_bounds_of_packed_numbers(tmp_path, keep):
    right = packed_in_degrees(tmp_path / "p.nc")
    with xarray.open_dataset(tmp_path / "p.nc") as ds, warnings.catch_warnings():
        warnings.simplefilter("error")
        ds.t.attrs["units"] = "degC"
        regridder = rondel.Regridder(ds, AXES, "nearest_s2d")
        for found in (
            ds.rondel.interpolate((LON, LAT), "nearest", grid=True),
            regridder(ds, keep_attrs=keep),
            regridder(ds.t, keep_attrs=keep).to_dataset(name="t"),
        ):
            assert set(found.t.attrs) <= {"units"}
            np.testing.assert_allclose(found.t, right, rtol=1e-6)
            again = regridder(found)
            np.testing.assert_array_equal(again.t, found.t)
            found.to_netcdf(tmp_path / "q.nc")
            np.testing.assert_array_equal(at_its_own_places(tmp_path / "q.nc"), found.t)
    if TOOL is not None:
        np.testing.assert_allclose(by_tool(tmp_path / "q.nc", tmp_path), right, rtol=1e-6)


def test_bounds_that_outlived_their_packing_are_told(tmp_path):
    right = packed_in_degrees(tmp_path / "p.nc")
    with xarray.open_dataset(tmp_path / "p.nc") as file:
        ds = file.load()
    mean = ds.expand_dims(time=2).mean("time", keep_attrs=True)
    regridder = rondel.Regridder(AXES, AXES, "nearest_s2d")
    with pytest.warns(UserWarning, match="'t': valid_range are not heeded: they are integers"):
        found = regridder(mean)
    # What the bounds had left out is a number of the mean, as xarray has made it.
    np.testing.assert_allclose(found.t, np.where(np.isnan(right), 0.5, right), rtol=1e-6)
    ds["t"] += 273.15
    with pytest.warns(UserWarning, match="'t': no number is within valid_range"):
        assert np.isnan(regridder(ds).t).all()
    floats = mean.copy()
    floats.t.attrs["valid_range"] = np.array([6.0, 31])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = regridder(floats).t.values
    assert np.nanmin(found) == 6
    assert np.nanmax(found) == 31
    whole = xarray.DataArray(np.arange(12).reshape(3, 4), dims=("lat", "lon"))
    whole.attrs["valid_max"] = np.int64(7)
    assert np.nanmax(regridder(whole)) == 7


METHODS = ["bilinear", "linear", "conservative", "nearest_s2d"]


@pytest.mark.parametrize("method", METHODS)
def test_only_unmapped_targets_are_zero(method):
    """As in xESMF: a target that needs a missing value has none."""
    lon, lat = np.arange(0.0, 50, 10), np.arange(-20.0, 21, 10)
    source, target = {"lon": lon, "lat": lat}, {"lon": [15.0, 31, 33, 200], "lat": [5.0, 15]}
    field = np.full((5, 5), 280.0)
    field[2, 2] = np.nan
    plain = rondel.Regridder(source, target, method)
    zero = rondel.Regridder(source, target, method, unmapped_to_nan=False)
    unmapped = (np.diff(plain.weights.indptr) == 0).reshape(plain.shape_out)
    assert method == "nearest_s2d" or unmapped[:, 3].all()
    for values in (field, np.stack([field, field + 1])):
        right = np.where(unmapped, 0, plain(values))
        np.testing.assert_array_equal(zero(values), right)
        assert np.isnan(zero(values)).any() or method == "nearest_s2d"
    data = xarray.DataArray(field, [lat, lon], ("lat", "lon"), name="t")
    np.testing.assert_array_equal(zero(data), zero(field))
    np.testing.assert_array_equal(zero(data.to_dataset()).t, zero(field))
    # Targets that a mask leaves out stay without a value, and so do all others without one.
    masked = {**target, "mask": np.array([[1, 0, 1, 1], [1, 1, 1, 1]])}
    found = rondel.Regridder(source, masked, method, unmapped_to_nan=False)(field)
    assert np.isnan(found[0, 1])
    assert not (found == 0).any()


NO_DOUBLE = 2**53 + 1
WIDE = {
    "as it is": ("i8", {}, None, 2**53),
    "no double": ("i8", {}, None, NO_DOUBLE),
    "beside a fill value": ("i8", {}, NO_DOUBLE, 2**53),
    "the fill value": ("i8", {}, NO_DOUBLE, NO_DOUBLE),
    "another fill value": ("i8", {}, -1, NO_DOUBLE),
    "above": ("i8", {"valid_max": np.int64(NO_DOUBLE)}, None, 2**53 + 2),
    "at the end": ("i8", {"valid_max": np.int64(NO_DOUBLE)}, None, 2**53),
    "below": ("i8", {"valid_range": np.array([-NO_DOUBLE, 9])}, None, -(2**53) - 2),
    "outside and no double": ("i8", {"valid_min": np.int64(0)}, None, -NO_DOUBLE),
    "never written": ("i8", {}, None, -(2**63) + 2),
    "least": ("i8", {}, None, -(2**63)),
    "unsigned": ("u8", {}, 2**64 - 1, 2**64 - 1),
    "unsigned, never written": ("u8", {}, None, 2**64 - 2),
    "unsigned, no double": ("u8", {}, None, 2**64 - 1),
    "missing twice": ("i8", {"missing_value": np.array([5, NO_DOUBLE])}, -7, NO_DOUBLE),
}


@pytest.mark.skipif(TOOL is None, reason="needs the command")
@pytest.mark.parametrize("case", WIDE)
def test_integers_of_64_bits_are_compared_exactly(case, tmp_path):
    kind, attributes, fill, value = WIDE[case]
    raw = np.arange(12).reshape(3, 4).astype(kind)
    raw[1, 2] = value
    path = tmp_path / "wide.nc"
    write(path, kind, attributes, raw, fill)
    with xarray.open_dataset(path, mask_and_scale=False) as opened:
        ds = opened.load()
    by_tool = run_tool(path, tmp_path)
    for chunks in (None, {"lat": 1}):
        if chunks is not None:
            pytest.importorskip("dask")
            ds = ds.chunk(chunks)
        regridder = rondel.Regridder(ds, AXES, "nearest_s2d")
        if by_tool.returncode == 0:
            expected = np.load(tmp_path / "out.npy").reshape(3, 4)
            found = ds.t.rondel.interpolate((LON, LAT), "nearest", grid=True)
            for there in (regridder(ds.t), found):
                assert np.array_equal(there, expected, equal_nan=True)
        else:
            assert f"{value} is no double" in by_tool.stderr
            words = f"'t' has the integer {value}, which is no double"
            with pytest.raises(rondel.InvalidInput, match=words):
                np.asarray(regridder(ds.t))
            with pytest.raises(rondel.InvalidInput, match=words):
                np.asarray(ds.t.rondel.interpolate((LON, LAT), "nearest", grid=True))


@pytest.mark.parametrize("fill", [NO_DOUBLE, np.int64(NO_DOUBLE), np.array([NO_DOUBLE])])
def test_attributes_in_memory_are_compared_exactly(fill):
    values = np.full((3, 4), 7)
    values[0, :2] = 2**53, NO_DOUBLE
    field = xarray.DataArray(values, AXES, ("lat", "lon"), "t", {"_FillValue": fill})
    found = field.rondel.interpolate((LON, LAT), "nearest", grid=True)
    assert found.values[0, :2].tolist()[0] == 2**53
    assert np.isnan(found).values.nonzero() == ([0], [1])


def test_integers_that_xarray_has_rounded_are_told(tmp_path):
    raw = np.arange(12).reshape(3, 4)
    raw[1, 2] = NO_DOUBLE
    write(tmp_path / "wide.nc", "i8", {}, raw, fill=-1)
    with pytest.warns(UserWarning, match="'t': 1 of 12 numbers were 64-bit integers from 2"):
        at_its_own_places(tmp_path / "wide.nc")
    raw[1, 2] = 2**53 - 1
    write(tmp_path / "exact.nc", "i8", {}, raw, fill=-1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.array_equal(at_its_own_places(tmp_path / "exact.nc"), raw)


def test_vectors_of_integers_are_not_rounded():
    values = np.full((3, 4), NO_DOUBLE)
    ds = xarray.Dataset(dict.fromkeys("uv", (("lat", "lon"), values)), AXES)
    regridder = rondel.Regridder(ds, AXES, "nearest_s2d")
    with pytest.raises(rondel.InvalidInput, match="'u' has the integer 9007199254740993"):
        regridder(ds, vectors=[("u", "v")])


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("chunks", [None, {"lat": 1}])
def test_infinite_values_are_refused_by_their_place(dtype, chunks):
    values = np.ones((2, 3, 4), dtype)
    values[1, 2, 3] = -np.inf
    axes = {**AXES, "time": [0, 1]}
    field = xarray.DataArray(values, axes, ("time", "lat", "lon"), "t")
    if chunks is not None:
        pytest.importorskip("dask")
        field = field.chunk(chunks)
    for ask in (
        lambda: rondel.Regridder(AXES, AXES, "conservative")(field),
        lambda: field.rondel.interpolate((LON, LAT), "linear", grid=True),
    ):
        with pytest.raises(rondel.InvalidInput, match="values of 't' have an infinite number"):
            np.asarray(ask())


@pytest.mark.parametrize("kind", ["i8", "u8"])
def test_bounds_of_other_types_hold_for_integers_that_are_no_doubles(kind, tmp_path):
    raw = np.arange(12).reshape(3, 4).astype(kind)
    raw[1, 2] = NO_DOUBLE
    for most in (np.int32(11), 11.5, np.float32(2**40), np.uint64(11)):
        field = xarray.DataArray(raw, AXES, ("lat", "lon"), "t", {"valid_max": most})
        found = field.rondel.interpolate((LON, LAT), "nearest", grid=True)
        assert np.isnan(found).values.nonzero() == ([1], [2])
        if TOOL is None or isinstance(most, np.uint64):
            continue
        path = tmp_path / "wide.nc"
        write(path, kind, {"valid_max": most}, raw)
        assert np.array_equal(by_tool(path, tmp_path), found, equal_nan=True)
