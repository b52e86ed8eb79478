# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What is carried of a Dataset, what is left out and told, and data that share a dimension."""

import warnings

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402 (needs xarray)

LON, LAT = np.arange(0.0, 360, 15), np.arange(-82.5, 90, 15)
POINTS = {"lon": ("place", [1.0, 50, 200]), "lat": ("place", [5.0, -40, 88])}
TARGET = xarray.Dataset({}, POINTS)


def dataset(times=2, **variables):
    heights = np.add.outer(np.arange(times), LAT[:, None] + 0 * LON)
    made = xarray.Dataset(
        {"t": (("time", "lat", "lon"), heights)},
        {"lon": LON, "lat": LAT, "time": np.arange(times, dtype=float)},
    )
    return made.assign(variables)


def by_accessor(data, target=TARGET):
    return data.rondel.interpolate(target, "linear")


def by_regridder(data, target=TARGET):
    return rondel.Regridder(data, target, "bilinear")(data)


WAYS = pytest.mark.parametrize("carry", [by_accessor, by_regridder])
EVERYWHERE = ("lat", "lon")


@WAYS
def test_variables_that_are_left_out_are_told(carry):
    shape = (len(LAT), len(LON))
    data = dataset(
        name=(EVERYWHERE, np.full(shape, "a")),
        day=(EVERYWHERE, np.full(shape, np.datetime64("2000-01-01", "ns"))),
        thing=(EVERYWHERE, np.full(shape, None, object)),
        zonal=(("time", "lat"), np.zeros((2, len(LAT)))),
        along=("lon", LON),
        step=("time", [1, 2]),
        number=3.0,
    )
    with pytest.warns(UserWarning, match="left out") as told:
        found = carry(data)
    assert list(found.data_vars) == ["t", "step", "number"]
    texts = [str(warning.message) for warning in told]
    assert texts == [
        "left out, as they are no real numbers: name, day, thing",
        "left out, as they have only some of the dimensions lat, lon: zonal, along",
    ]
    assert {warning.filename for warning in told} == {__file__}


@WAYS
def test_what_is_no_field_is_not_told(carry):
    data = dataset(lat_bnds=(("lat", "two"), np.stack([LAT - 7.5, LAT + 7.5], axis=1)))
    data["lat"].attrs = {"bounds": "lat_bnds", "units": "degrees_north"}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert list(carry(data).data_vars) == ["t"]


@WAYS
def test_booleans_are_numbers(carry):
    is_north = xarray.DataArray(LAT[:, None] + 0 * LON > 0, dims=EVERYWHERE)
    data = dataset(north=is_north)
    found = carry(data).north
    assert found.dtype == np.float64
    assert np.allclose(found.values[1:], [0, 1], atol=1e-12)
    assert 0 < found.values[0] < 1
    alone = data.north.rondel.interpolate(TARGET, "linear")
    assert np.array_equal(by_accessor(data).north, alone)


def test_data_without_the_dimensions_of_the_source_are_refused():
    regridder = rondel.Regridder(dataset(), TARGET, "bilinear")
    with pytest.raises(ValueError, match="the data have no dimension lat and no lon, which the"):
        regridder(dataset().rename(lat="y", lon="x"))
    with pytest.raises(ValueError, match="'t' and the source differ in the length of lon: 23, 24"):
        regridder(dataset().isel(lon=slice(1, None)))


@pytest.mark.parametrize("name", ["lon", "lat"])
def test_gaps_of_axes_are_told(name):
    data = dataset()
    axis = data[name].values.copy()
    axis[-1] = np.nan
    data = data.assign_coords({name: axis})
    count = 288 // len(axis)
    with pytest.warns(UserWarning, match=f"{count} of 288 places have no longitude or latitude"):
        found = by_accessor(data)
    kept = by_accessor(dataset().isel({name: slice(None, -1)}))
    assert np.array_equal(found.t, kept.t, equal_nan=True)


@WAYS
@pytest.mark.parametrize("times", [1, 2, 3])
def test_tracks_with_the_time_of_the_data_are_refused(carry, times):
    track = TARGET.rename(place="time")
    for data in (dataset(times), dataset(times).t):
        with pytest.raises(ValueError, match="'t' and the targets both have the dimension 'time'"):
            carry(data, track)
    # As the message says.
    found = carry(dataset(times), track.rename(time="place"))
    assert found.t.dims == ("time", "place")
    # Fields without time have no such question.
    assert carry(dataset(times).t[0].drop_vars("time"), track).dims == ("time",)


@WAYS
def test_dimensions_of_the_targets_are_not_mixed_up(carry):
    data = dataset(3, step=("time", [1, 2, 3])).isel(time=0, drop=True)
    data = data.assign(step=("time", [1, 2, 3])).assign_coords(time=[10, 20, 30])
    track = TARGET.rename(place="time")
    with pytest.warns(UserWarning, match="left out, as the targets have another dimension time: s"):
        found = carry(data, track)
    assert list(found.data_vars) == ["t"]
    assert "time" not in found.coords
    # The times of the track are those of the data.
    found = carry(data, track.assign_coords(time=[10, 20, 30]))
    assert found.step.values.tolist() == [1, 2, 3]


@WAYS
def test_data_of_no_time(carry):
    found = carry(dataset(0))
    assert found.t.shape == (0, 3)
    assert carry(dataset(0).t).shape == (0, 3)
    dask = pytest.importorskip("dask.array")
    lazy = carry(dataset(0).chunk())
    assert isinstance(lazy.t.data, dask.Array)
    assert lazy.t.values.shape == (0, 3)


def test_arrays_of_no_time():
    regridder = rondel.Regridder({"lon": LON, "lat": LAT}, TARGET, "bilinear")
    assert regridder(np.zeros((0, 12, 24))).shape == (0, 3)
    assert regridder(np.zeros((2, 0, 12, 24))).shape == (2, 0, 3)
