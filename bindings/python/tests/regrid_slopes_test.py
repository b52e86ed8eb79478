# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Monotone slopes of `rondel.regrid` and `Regridder`: the same as those of files, in any blocks."""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")

LON, LAT = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)


def steps(*, has_gaps=False):
    random = np.random.default_rng(4)
    values = (random.random((3, 18, 36)) < 0.4).astype(float)
    if has_gaps:
        values[random.random(values.shape) < 0.2] = np.nan
    return xarray.DataArray(values, {"lat": LAT, "lon": LON}, ("time", "lat", "lon"), "step")


@pytest.mark.parametrize("has_gaps", [False, True])
def test_values_are_those_of_files_and_have_no_new_extremes(tmp_path, has_gaps):
    data = steps(has_gaps=has_gaps)
    data.to_netcdf(tmp_path / "in.nc")
    options = {"method": "conservative_2nd", "limiter": "slopes"}
    rondel.regrid_file(tmp_path / "in.nc", "healpix:3", tmp_path / "out.nc", **options)
    found = rondel.regrid(data, "healpix:3", **options)
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        np.testing.assert_array_equal(found.values, file.step.values)
    there = found.values[~np.isnan(found.values)]
    assert there.min() >= 0
    assert there.max() <= 1
    plain = rondel.regrid(data, "healpix:3", "conservative_2nd").values
    assert np.nanmin(plain) < -0.01
    if not has_gaps:
        np.testing.assert_allclose(found.values.mean(-1), plain.mean(-1), rtol=1e-13)


def test_blocks_change_no_byte():
    pytest.importorskip("dask")
    data = steps(has_gaps=True)
    options = {"method": "conservative_2nd", "limiter": "slopes"}
    wanted = rondel.regrid(data, "healpix:3", **options)
    found = rondel.regrid(data.chunk(time=1), "healpix:3", output_chunks=100, **options)
    np.testing.assert_array_equal(found.values, wanted.values)


def test_limiters_without_effect_are_refused():
    data = steps()
    with pytest.raises(ValueError, match="limiter must be 'none' or 'slopes', not 'bounds'"):
        rondel.regrid(data, "healpix:1", "conservative_2nd", limiter="bounds")
    with pytest.raises(ValueError, match="limiter has no effect with the method 'bilinear'"):
        rondel.regrid(data, "healpix:1", "bilinear", limiter="slopes")
    with pytest.raises(ValueError, match="creep_fill"):
        rondel.Regridder(
            data, "healpix:1", "conservative_2nd", limiter="slopes", extrap_method="creep_fill"
        )


@pytest.mark.parametrize(
    "method", ["conservative", "conservative_2nd", "linear", "sibson", "hermite", "cubic"]
)
def test_constants_are_exact(method):
    data = xarray.full_like(steps(), 280.1)
    assert (rondel.regrid(data, "healpix:3", method).values == 280.1).all()
