# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Coordinates of two dimensions beside axes along the same dimensions: of the same places the axes
are taken, which have cells, and of others the coordinates, as the axes are nominal then.
"""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")

LON, LAT = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
TARGET = {"lon": np.arange(15.0, 360, 30), "lat": np.arange(-75.0, 90, 30)}


def grid(names=(), shift=0.0, dtype=np.float64):
    """A field on axes, with further longitudes and latitudes of so many degrees farther north."""
    data = xarray.Dataset(
        {"t": (("lat", "lon"), np.random.default_rng(1).random((18, 36)))},
        coords={
            "lon": ("lon", LON, {"units": "degrees_east"}),
            "lat": ("lat", LAT, {"units": "degrees_north"}),
        },
    )
    lon, lat = np.meshgrid(LON, LAT)
    made = dict(zip(names, (lon.astype(dtype), (lat + shift).astype(dtype)), strict=False))
    return data.assign({name: (("lat", "lon"), values) for name, values in made.items()})


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("names", [("longitude", "latitude"), ("nav_lon", "nav_lat")])
@pytest.mark.parametrize("method", ["conservative", "bilinear", "nearest_s2d"])
def test_axes_of_the_same_places_are_taken(names, method, dtype):
    wanted = rondel.Regridder(grid(), TARGET, method)(grid().t)
    data = grid(names, dtype=dtype)
    for given in (data, data.set_coords(list(names))):
        assert np.array_equal(rondel.Regridder(given, TARGET, method)(given.t), wanted)


def test_other_places_are_those_of_two_dimensions():
    variables = grid(("nav_lon", "nav_lat"), 2.0)
    data = variables.set_coords(["nav_lon", "nav_lat"])
    found = rondel.Regridder(data, TARGET, "nearest_s2d")(data.t)
    moved = grid().assign_coords(lat=LAT + 2)
    assert np.array_equal(found, rondel.Regridder(moved, TARGET, "nearest_s2d")(moved.t))
    with pytest.raises(ValueError, match="no corners of cells"):
        rondel.Regridder(data, TARGET, "conservative")
    with pytest.raises(ValueError, match="are not the places of the source"):
        rondel.Regridder(variables, TARGET, "nearest_s2d")(variables.t)
    assert np.array_equal(rondel.Regridder(variables, TARGET, "nearest_s2d")(variables).t, found)
