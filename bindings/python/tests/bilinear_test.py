# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Bilinear weights of axes in any direction, against SciPy and closed forms."""

import warnings

import numpy as np
import pytest
import scipy.interpolate

import rondel

pytest.importorskip("xarray")

TARGETS = {
    "lon": [-180.0, -179.9, -0.25, 0.0, 33.3, 179.9, 180.0, 359.5, 541.0],
    "lat": [-90.0, -88.0, -86.0, -1.0, 0.0, 45.2, 85.0, 89.0, 90.0],
}
LON, LAT = np.arange(0.0, 360, 7.5), np.array([-85.0, -60, -22, 3, 40, 71, 86])
GAUSSIAN = np.degrees(np.arcsin(np.polynomial.legendre.leggauss(16)[0]))


def regridded(lon, lat, field, target=TARGETS):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return rondel.Regridder({"lon": lon, "lat": lat}, target, "bilinear")(field)


def noise(lon, lat):
    return np.random.default_rng(3).normal(size=(len(lat), len(lon)))


@pytest.mark.parametrize("lat", [LAT, GAUSSIAN, LAT[:4], LAT[3:]], ids=len)
@pytest.mark.parametrize("lon", [LON, LON[3:18]], ids=len)
def test_decreasing_axes_give_what_increasing_ones_give(lon, lat):
    field = noise(lon, lat)
    wanted = regridded(lon, lat, field)
    assert np.isfinite(wanted).any()
    for turn_lat in (1, -1):
        for turn_lon in (1, -1):
            found = regridded(lon[::turn_lon], lat[::turn_lat], field[::turn_lat, ::turn_lon])
            assert np.array_equal(found, wanted, equal_nan=True)


@pytest.mark.parametrize("turn", [1, -1])
def test_values_beyond_the_last_rows(turn):
    """Linear from each last row to its mean, at the pole; SciPy does it on a padded grid."""
    field = noise(LON, LAT)
    found = regridded(LON, LAT[::turn], field[::turn])
    padded = np.concatenate(
        [np.full((1, len(LON)), field[0].mean()), field, np.full((1, len(LON)), field[-1].mean())]
    )
    padded = np.concatenate([padded, padded[:, :1]], axis=1)
    grid = (np.r_[-90, LAT, 90], np.r_[LON, 360])
    lat, lon = np.meshgrid(TARGETS["lat"], np.mod(TARGETS["lon"], 360), indexing="ij")
    wanted = scipy.interpolate.interpn(grid, padded, np.stack([lat, lon], axis=-1))
    assert np.allclose(found, wanted, atol=1e-12, rtol=0)


@pytest.mark.parametrize(
    "lon",
    [
        np.linspace(-180, 180, 37),
        np.linspace(0, 360, 25),
        np.linspace(-180, 180, 37, dtype=np.float32) + np.float32(11.3),
        np.arange(-10.0, 371, 10),  # two columns and more are repeated
    ],
    ids=lambda lon: f"{lon[0]:.1f}",
)
def test_columns_that_repeat_the_first_ones(lon):
    lat = np.arange(-80.0, 81, 20)
    once = lon[lon < lon[0] + 360 - 1e-3]
    field = noise(once, lat)
    repeated = field[:, np.arange(len(lon)) % len(once)]
    # Targets on the seam itself, from both sides.
    target = {"lon": [float(lon[0]), float(lon[-1]), *TARGETS["lon"]], "lat": TARGETS["lat"]}
    wanted = regridded(once, lat, field, target)
    assert np.isfinite(wanted).all()
    assert np.array_equal(regridded(lon, lat, repeated, target), wanted)
    assert np.array_equal(regridded(lon[::-1], lat, repeated[:, ::-1], target), wanted)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_places_of_the_grid_have_its_values_whatever_turns_they_are_shifted_by(kind):
    """Also beside places without a value, and where the last digits differ."""
    rng = np.random.default_rng(8)
    for _ in range(25):
        step, first = rng.choice([0.1, 0.25, 0.7, 0.05, 1 / 3]), np.round(rng.uniform(-180, 300), 1)
        lon, lat = first + step * np.arange(20), step * np.arange(-5, 5) - 0.05
        field = rng.normal(size=(10, 20))
        field[rng.random((10, 20)) < 0.3] = np.nan
        source = {"lon": lon.astype(kind), "lat": lat.astype(kind)}
        around = (lon + 180) % 360 - 180
        for to_lon in (lon, lon + 360, lon - 360, *([around] if around.argmin() == 0 else [])):
            target = {"lon": to_lon, "lat": np.linspace(lat[0], lat[-1], 10)}
            found = rondel.Regridder(source, target, "bilinear")(field)
            assert np.array_equal(found, field, equal_nan=True)


def test_targets_outside_have_no_value():
    lon, lat = np.arange(190.3, 220, 0.7), np.arange(-10.0, 10)
    for far in (1e-6, 1e-3, 0.1):
        outside = {
            "lon": [lon[0] - far, 200.0, lon[-1] + far - 360],
            "lat": [-10 - far, 0, 9 + far],
        }
        found = regridded(lon, lat, np.ones((len(lat), len(lon))), outside)
        assert np.flatnonzero(np.isfinite(found)).tolist() == [4]


def test_rows_have_one_entry_of_a_place():
    weights = rondel.Regridder({"lon": LON, "lat": LAT}, TARGETS, "bilinear").weights
    row = np.repeat(np.arange(weights.shape[0]), np.diff(weights.indptr))
    pairs = np.column_stack([row, weights.indices])
    assert len(np.unique(pairs, axis=0)) == len(pairs)
    assert np.all(weights.data > 0)
    assert np.allclose(weights.apply(np.ones(weights.shape[1])), 1, atol=1e-14, rtol=0)


@pytest.mark.filterwarnings("ignore:.*are left out")
@pytest.mark.parametrize("name", ["lon", "lat"])
def test_axes_with_gaps_are_refused(name):
    axes = {"lon": LON.copy(), "lat": LAT.copy()}
    axes[name][2] = np.nan
    with pytest.raises(ValueError, match=rf"{name}\[2\] is nan"):
        rondel.Regridder(axes, TARGETS, "bilinear")
