# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Masked arrays: what is masked is missing, or refused by name, whatever numbers lie below."""

import json
import warnings

import clouds
import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")

LON, LAT = np.arange(0.0, 60, 5), np.arange(0.0, 50, 5)
LONS, LATS = np.meshgrid(LON, LAT)
LAND = (LONS > 18) & (LONS < 37) & (LATS > 13) & (LATS < 29)
FIELD = np.where(LAND, -999.0, LONS + LATS)
TARGET = {"lon": [22.0, 41.0], "lat": [17.0, 33.0]}
METHODS = ["bilinear", "nearest_s2d", "nearest_d2s", "linear", "conservative_normed"]


def masked(values, which):
    """Masked numbers that would be quite possible places."""
    return np.ma.masked_array(np.where(which, 33, values), which)


def regridded(source, target, method, field=FIELD):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return rondel.Regridder(source, target, method)(field)


@pytest.mark.parametrize("method", ["nearest_s2d", "nearest_d2s", "linear"])
@pytest.mark.parametrize("side", ["source", "target"])
def test_masked_places_are_missing(method, side):
    places = {"lon": masked(LONS, LAND), "lat": masked(LATS, LAND)}
    holes = {"lon": np.where(LAND, np.nan, LONS), "lat": np.where(LAND, np.nan, LATS)}
    if side == "source":
        found, wanted = (regridded(given, TARGET, method) for given in (places, holes))
        assert not (found < -900).any()
    else:
        axes = {"lon": LON, "lat": LAT}
        found, wanted = (regridded(axes, given, method, LONS + LATS) for given in (places, holes))
        assert np.isnan(found[LAND]).all()
    assert np.array_equal(found, wanted, equal_nan=True)


@pytest.mark.parametrize("are_axes", [True, False])
def test_masked_places_are_counted(are_axes):
    gap = LON == 20
    places = (masked(LON, gap), LAT) if are_axes else (masked(LONS, LAND), LATS)
    count = 10 if are_axes else LAND.sum()
    with pytest.warns(UserWarning, match=f"{count} of 120 places have no longitude or latitude"):
        rondel.Regridder({"lon": places[0], "lat": places[1]}, TARGET, "nearest_s2d")
    with pytest.warns(UserWarning, match=f"{count} of 120 places have no longitude or latitude"):
        rondel.Regridder(TARGET, {"lon": places[0], "lat": places[1]}, "nearest_s2d")


def test_masked_lines_of_cells_are_refused():
    gap = masked(LON, LON == 20)
    with pytest.raises(ValueError, match=r"lon\[4\] is masked"):
        rondel.CellSet.lonlat_grid(gap, LAT)
    with pytest.raises(ValueError, match=r"longitude 4 is not finite"):
        regridded({"lon": gap, "lat": LAT}, TARGET, "conservative")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "mask",
    [
        np.ma.masked_array(np.ones(LAND.shape, int), LAND),
        np.ma.masked_array(np.ones(LAND.shape, bool), LAND),
        np.ma.masked_equal(np.where(LAND, 0, 1), 0),
        np.where(LAND, np.nan, 2.0),
        np.where(LAND, None, 1),
    ],
    ids=["integers", "booleans", "zeros", "nan", "none"],
)
def test_masks_with_gaps(method, mask):
    axes = {"lon": LON, "lat": LAT}
    wanted = regridded({**axes, "mask": ~LAND}, TARGET, method)
    assert not (wanted < -900).any()
    found = regridded({**axes, "mask": mask}, TARGET, method)
    assert np.array_equal(found, wanted, equal_nan=True)
    wanted = regridded(axes, {**axes, "mask": ~LAND}, method)
    found = regridded(axes, {**axes, "mask": mask}, method)
    assert np.isnan(found[LAND]).all()
    assert np.array_equal(found, wanted, equal_nan=True)


def test_masks_that_are_refused():
    axes = {"lon": LON, "lat": LAT}
    for texts in (np.full(LAND.shape, "land"), np.full(LAND.shape, "land", object)):
        with pytest.raises(TypeError, match="mask must be numbers or booleans, not"):
            rondel.Regridder({**axes, "mask": texts}, TARGET, "nearest_s2d")
    with pytest.raises(ValueError, match=r"mask must have shape \(10, 12\), not \(12, 10\)"):
        rondel.Regridder({**axes, "mask": ~LAND.T}, TARGET, "nearest_s2d")
    data = xarray.Dataset({"mask": ("lat", np.ones(10))}, axes)
    with pytest.raises(ValueError, match=r"mask has the dimensions \('lat',\)"):
        rondel.Regridder(data, TARGET, "nearest_s2d")


@pytest.mark.parametrize("method", METHODS)
def test_masks_that_times_repeat(method):
    """As WRF repeats all of a grid."""
    axes = {"lon": LON, "lat": LAT}
    wanted = regridded({**axes, "mask": ~LAND}, TARGET, method)
    times = xarray.DataArray([~LAND] * 3, axes, ("Time", "lat", "lon"))
    for given in (times, times.transpose("lat", "Time", "lon")):
        found = regridded(xarray.Dataset({"mask": given}), TARGET, method)
        assert np.array_equal(found, wanted, equal_nan=True)
    changing = times.copy()
    changing[2, 4, 5] = 1 - changing[2, 4, 5]
    with pytest.raises(ValueError, match=r"mask changes along Time"):
        regridded(xarray.Dataset({"mask": changing}), TARGET, method)
    with pytest.raises(ValueError, match=r"mask changes along Time"):
        regridded(xarray.Dataset({"mask": times[:0]}), TARGET, method)


@pytest.mark.parametrize("name", ["source_mask", "target_mask"])
def test_masks_of_remap(name):
    halves = rondel.lonlat_grid(2, 1)
    for mask in (np.ma.masked_array([1, 1], [1, 0]), [np.nan, 1], [None, True], [0, 1]):
        found = rondel.remap(halves, halves, **{name: mask})
        assert found.weights.apply([5.0, 7.0])[1] == 7
        assert np.isnan(found.weights.apply([5.0, 7.0])[0])
    with pytest.raises(TypeError, match=f"{name} must be numbers or booleans, not text"):
        rondel.remap(halves, halves, **{name: ["no", "yes"]})


GONE = np.array([False, True, False, False, False, False])
PROPERTIES = {
    "number": np.ma.masked_array(np.arange(6) + 2**60, GONE),
    "float": np.ma.masked_array(np.arange(6.0), GONE),
    "text": np.ma.masked_array(list("abcdef"), GONE),
    "yes": np.ma.masked_array(np.ones(6, bool), GONE),
    "day": np.ma.masked_array(np.arange("2000-01-01", "2000-01-07", dtype="M8[D]"), GONE),
    "list": [1, np.ma.masked, 3, 4, 5, 6],
}
CUBE = rondel.SphericalVoronoi(np.concatenate([np.eye(3), -np.eye(3)]))


def test_masked_properties_are_null(tmp_path):
    regions = CUBE.dissolve(list("abcdef"))
    pages = [CUBE.to_geojson(properties=PROPERTIES), regions.to_geojson(properties=PROPERTIES)]
    regions.to_geojson(tmp_path / "regions.geojson", properties=PROPERTIES)
    pages.append(json.loads((tmp_path / "regions.geojson").read_text()))
    for page in pages:
        first, second = (feature["properties"] for feature in page["features"][:2])
        assert [second[name] for name in PROPERTIES] == [None] * 6
        values = [first[name] for name in PROPERTIES]
        assert values == [2**60, 0, "a", True, "2000-01-01", 1]


def test_masked_properties_of_datasets():
    data = CUBE.to_xarray(properties=PROPERTIES)
    for name in ("number", "float", "text", "yes", "day"):
        assert data[name].isnull().values.tolist() == GONE.tolist()
    assert data["float"].values[[0, 2]].tolist() == [0, 2]
    assert data["text"].values[[0, 2]].tolist() == ["a", "c"]
    assert data["day"].dtype.kind == "M"


def test_masked_indices_are_refused():
    gap = np.ma.masked_array([1, 2], [0, 1])
    with pytest.raises(ValueError, match=r"sites\[1\] is masked"):
        CUBE.delaunay.distance(np.eye(3)[:2], gap)
    with pytest.raises(ValueError, match=r"indices\[1\] is masked"):
        rondel.Weights([0, 2], gap, [1, 1], (1, 3))
    rows = [np.ma.masked_array([1.0, 0, 0], [0, 1, 0]), *np.eye(3)]
    with pytest.raises(ValueError, match=r"points\[0\] is masked"):
        rondel.delaunay(rows)


def test_masked_fields_in_a_list():
    points = clouds.uniform(20)
    values = np.ma.masked_array(np.arange(20.0), np.arange(20) == 3)
    found = rondel.delaunay(points).interpolate([values, values + 1], points, "nearest")
    assert np.isnan(found[:, 3]).all()
    assert np.array_equal(np.delete(found, 3, axis=1)[1], np.delete(np.arange(20), 3) + 1)


def test_masked_values_have_no_color():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    values = np.ma.masked_array([1.0, 1e9, 2, 3, 4, 5], GONE)
    for shown in (CUBE, CUBE.dissolve(list("abcdef"))):
        ax = pyplot.figure().add_subplot()
        colors = shown.plot(values, ax=ax, coast=False).collections[0]
        assert colors.get_clim() == (1, 5)
        pyplot.close(ax.figure)
