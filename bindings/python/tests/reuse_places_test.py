# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights that a Regridder takes are of its places and cells, which the files it writes have."""

import os
import pickle
import subprocess

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")

LON, LAT = np.arange(0.0, 360, 30), np.array([-70.0, -30, 10, 40, 75])
SOURCE = {"lon": LON, "lat": LAT}
TARGET = {"lon": np.arange(10.0, 360, 40), "lat": np.array([-55.0, 0, 55])}
FIELD = np.random.default_rng(1).normal(size=(5, 12))
METHODS = [
    "bilinear",
    "conservative",
    "conservative_normed",
    "conservative_2nd",
    "nearest_s2d",
    "nearest_d2s",
    "linear",
]
OTHER_PLACES = "the weights are of other places, or of these in another order"


def moved(grid, lon=0.0, lat=0.0):
    return {**grid, "lon": grid["lon"] + lon, "lat": grid["lat"] + lat}


def flipped(grid):
    return {**grid, "lat": grid["lat"][::-1]}


def changed(path, function):
    """The file without hashes, as other programs write it, and with changes."""
    with xarray.open_dataset(path) as file:
        data = file.load()
    for name in ("rondel_source_hash", "rondel_target_hash"):
        data.attrs.pop(name, None)
    function(data)
    data.to_netcdf(path)


@pytest.mark.parametrize("mask", [None, np.arange(60).reshape(5, 12) % 7 > 0])
@pytest.mark.parametrize("method", METHODS)
def test_weights_of_other_places_are_refused(tmp_path, method, mask):
    path = tmp_path / "w.nc"
    source = SOURCE if mask is None else {**SOURCE, "mask": mask}
    made = rondel.Regridder(source, TARGET, method)
    made.to_netcdf(path)
    others = [
        (source, moved(TARGET, lon=1)),
        (source, moved(TARGET, lat=-0.001)),
        (source, flipped(TARGET)),
        (moved(source, lon=3), TARGET),
        (moved(source, lat=0.5), TARGET),
        ({**source, "lon": LON[::-1]}, TARGET),
    ]
    if mask is None:
        others.append((flipped(source), TARGET))
    for weights in (path, made.weights):
        same = rondel.Regridder(source, TARGET, method, weights=weights)
        assert np.array_equal(same(FIELD), made(FIELD), equal_nan=True)
        for grids in others:
            with pytest.raises(ValueError, match=OTHER_PLACES):
                rondel.Regridder(*grids, method, weights=weights)
    changed(path, lambda data: None)
    for grids in others:
        with pytest.raises(ValueError, match=rf"w\.nc: {OTHER_PLACES}: (source|target) \d+ is at"):
            rondel.Regridder(*grids, method, filename=path, reuse_weights=True)


@pytest.mark.parametrize("method", METHODS)
def test_places_may_be_off_as_single_precision_is(tmp_path, method):
    path = tmp_path / "w.nc"
    source, target = moved(SOURCE, lon=0.1, lat=0.1), moved(TARGET, lon=0.7)
    made = rondel.Regridder(source, target, method)
    made.to_netcdf(path)
    single = [{name: axis.astype(np.float32) for name, axis in g.items()} for g in (source, target)]
    assert np.array_equal(
        rondel.Regridder(*single, method, weights=path)(FIELD), made(FIELD), equal_nan=True
    )
    turned = moved(source, lon=-360)
    assert rondel.Regridder(turned, target, method, weights=path).shape_in == (5, 12)


def test_cells_of_other_corners_are_refused(tmp_path):
    path = tmp_path / "w.nc"
    lines = {"lat_b": np.array([-90.0, -50, -10, 25, 60, 90]), "lon_b": np.arange(-15.0, 360, 30)}
    rondel.Regridder({**SOURCE, **lines}, TARGET, "conservative").to_netcdf(path)
    for grid in (SOURCE, {**SOURCE, **lines, "lat_b": lines["lat_b"] * 0.9}):
        with pytest.raises(
            ValueError, match=rf"w\.nc: {OTHER_PLACES}: source \d+ has other corners"
        ):
            rondel.Regridder(grid, TARGET, "conservative", weights=path)

    def other_way(data):
        for name in ("xv_a", "yv_a"):
            data[name][:] = np.roll(data[name].values[:, ::-1], 1, axis=1)
        data["xv_a"] -= 360

    changed(path, other_way)
    again = rondel.Regridder({**SOURCE, **lines}, TARGET, "conservative", weights=path)
    assert np.isfinite(again(FIELD)).all()


def test_files_with_centers_of_mass_are_of_the_same_cells(tmp_path):
    path = tmp_path / "w.nc"
    made = rondel.Regridder(SOURCE, TARGET, "conservative")
    made.to_netcdf(path)
    cells = rondel.CellSet.lonlat_centers(LON, LAT)

    def as_before(data):
        data["xc_a"][:], data["yc_a"][:] = rondel.lonlat(cells.centers).T

    changed(path, as_before)
    again = rondel.Regridder(SOURCE, TARGET, "conservative", weights=path)
    assert np.array_equal(again(FIELD), made(FIELD))


@pytest.mark.parametrize("with_bounds", [False, True])
def test_files_have_the_coordinates_of_cells(tmp_path, with_bounds):
    source = {**SOURCE}
    if with_bounds:
        source |= {
            "lat_b": np.array([-90.0, -60, -10, 20, 70, 90]),
            "lon_b": LON[0] - 5 + 30 * np.arange(13),
        }
    made = rondel.Regridder(source, TARGET, "conservative")
    made.to_netcdf(tmp_path / "w.nc")
    with xarray.open_dataset(tmp_path / "w.nc") as file:
        assert np.array_equal(file.yc_a.values.reshape(5, 12)[:, 0], LAT)
        assert np.array_equal(file.xc_a.values.reshape(5, 12)[0], LON)
        assert np.array_equal(file.yc_b.values.reshape(3, 9)[:, 0], TARGET["lat"])
    if "RONDEL" not in os.environ:
        return
    axes = {
        "lat": ("lat", LAT, {"units": "degrees_north"}),
        "lon": ("lon", LON, {"units": "degrees_east"}),
    }
    xarray.Dataset({"t": (("lat", "lon"), FIELD)}, coords=axes).to_netcdf(tmp_path / "t.nc")
    command = [os.environ["RONDEL"], "apply", "w.nc", "t.nc", "-o", "o.nc"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    with xarray.open_dataset(tmp_path / "o.nc") as out:
        assert np.allclose(out.t.values, made(FIELD), rtol=1e-14)


def test_curved_cells_have_their_coordinates(tmp_path):
    lon, lat = np.meshgrid(LON, LAT)
    lon_b, lat_b = np.meshgrid(np.arange(-15.0, 360, 30), [-85.0, -50, -10, 25, 60, 85])
    curved = {"lon": lon + 2, "lat": lat + 1, "lon_b": lon_b, "lat_b": lat_b}
    made = rondel.Regridder(curved, TARGET, "conservative")
    made.to_netcdf(tmp_path / "w.nc")
    with xarray.open_dataset(tmp_path / "w.nc") as file:
        assert np.array_equal(file.yc_a.values, lat.ravel() + 1)
    again = rondel.Regridder(curved, TARGET, "conservative", weights=tmp_path / "w.nc")
    assert np.array_equal(again(FIELD), made(FIELD), equal_nan=True)
    centers = {"lon": lon + 2, "lat": lat + 1}  # which are enough, as in xESMF
    again = rondel.Regridder(centers, TARGET, "conservative", weights=tmp_path / "w.nc")
    assert np.array_equal(again(FIELD), made(FIELD), equal_nan=True)
    for other in ({**curved, "lat": lat}, {**centers, "lat": lat}):
        with pytest.raises(ValueError, match=OTHER_PLACES):
            rondel.Regridder(other, TARGET, "conservative", weights=tmp_path / "w.nc")


def test_empty_cells_need_no_center(tmp_path):
    lon = np.array([[0.0, 90, 90, 0], [10, 10, 10, 10], [90, 180, 180, 90]])
    cells = rondel.CellSet.corners(lon, np.array([[0.0, 0, 50, 50]] * 3))
    made = rondel.Regridder(SOURCE, cells, "conservative")
    made.to_netcdf(tmp_path / "w.nc")

    def without(data):
        data["xc_b"][1] = data["yc_b"][1] = np.nan

    changed(tmp_path / "w.nc", without)
    again = rondel.Regridder(SOURCE, cells, "conservative", weights=tmp_path / "w.nc")
    assert np.array_equal(again(FIELD), made(FIELD), equal_nan=True)


def test_files_of_the_tool_are_taken(tmp_path):
    if "RONDEL" not in os.environ:
        pytest.skip("needs the tool")
    bounds = np.array([[-90.0, -60], [-60, -10], [-10, 20], [20, 70], [70, 90]])
    source = xarray.Dataset(
        {"lat_bnds": (("lat", "two"), bounds)},
        coords={
            "lat": ("lat", LAT, {"units": "degrees_north", "bounds": "lat_bnds"}),
            "lon": ("lon", LON, {"units": "degrees_east"}),
        },
    )
    source.to_netcdf(tmp_path / "s.nc")
    command = [os.environ["RONDEL"], "remap", "s.nc", "grid:45", "-o", "w.nc"]
    subprocess.run(command, cwd=tmp_path, capture_output=True, check=True)
    target = rondel.lonlat_grid(8, 4)
    again = rondel.Regridder(source, target, "conservative", weights=tmp_path / "w.nc")
    assert np.allclose(again(FIELD), rondel.Regridder(source, target, "conservative")(FIELD))
    turned = source.isel(lat=slice(None, None, -1))
    with pytest.raises(ValueError, match=OTHER_PLACES):
        rondel.Regridder(turned, target, "conservative", weights=tmp_path / "w.nc")


def test_weights_that_are_no_numbers_are_refused(tmp_path):
    path = tmp_path / "w.nc"
    rondel.Regridder(SOURCE, TARGET, "conservative").to_netcdf(path)

    def spoil(data):
        data["S"][2] = np.inf

    changed(path, spoil)
    with pytest.raises(ValueError, match=r"w\.nc: weight 2 is inf"):
        rondel.Regridder(SOURCE, TARGET, "conservative", weights=path)
    with pytest.raises(rondel.InvalidInput, match="weight 2 is inf") as caught:
        rondel.read_weights(path).apply(FIELD.ravel())
    assert caught.value.index == 2
    with pytest.raises(rondel.InvalidInput, match="weight 1 is nan"):
        rondel.Weights([0, 2], [0, 1], [1, np.nan], (1, 2))


def test_weights_that_are_areas_are_told(tmp_path):
    areas = [0.25, 0.5]
    data = xarray.Dataset(
        {
            "src_address": ("num_links", np.array([1, 2, 2], np.int32)),
            "dst_address": ("num_links", np.array([1, 1, 2], np.int32)),
            "remap_matrix": (("num_links", "num_wgts"), [[0.125], [0.125], [0.5]]),
            "dst_grid_area": ("dst_grid_size", areas),
            "src_grid_imask": ("src_grid_size", np.array([1, 1], np.int32)),
        },
        attrs={"normalization": "none", "map_method": "Conservative remapping"},
    )
    data.to_netcdf(tmp_path / "w.nc")
    with pytest.warns(UserWarning, match=r"w\.nc: the normalization is \"none\""):
        weights = rondel.read_weights(tmp_path / "w.nc")
    assert weights.apply([3.0, 5.0]).tolist() == [4.0, 5.0]


UNSORTED = [
    ("lat", [-70.0, 30, -10, 40, 75], r"lat.* 2.*-10.* 30"),
    ("lat", [-70.0, -30, -30, 40, 75], r"lat.* ?2.*-30"),
    ("lon", [0.0, 60, 30, *range(90, 360, 30)], r"lon.* ?2.*30.* 60"),
    ("lon", [0.0, 30, 30, *range(90, 360, 30)], r"lon.* ?2.*30"),
]


@pytest.mark.parametrize(("name", "axis", "match"), UNSORTED)
def test_axes_out_of_order_are_refused(name, axis, match):
    wrong = {**SOURCE, name: np.array(axis)}
    conservative = f"'{name}': (longitude|latitude) 2, .*must increase or decrease throughout"
    for grids in ((wrong, TARGET), (TARGET, wrong)):
        with pytest.raises(rondel.InvalidInput, match=conservative) as caught:
            rondel.Regridder(*grids, "conservative")
        assert caught.value.index == 2
    with pytest.raises(ValueError, match=rf"{name}\[2\] is .* after"):
        rondel.Regridder(wrong, TARGET, "bilinear")
    with pytest.raises(rondel.InvalidInput, match=match):
        rondel.CellSet.lonlat_centers(wrong["lon"], wrong["lat"])


@pytest.mark.parametrize("name", ["w.csv", "w.npz", "w", "w.nc.txt"])
def test_netcdf_has_its_endings(tmp_path, name):
    remap = rondel.remap(rondel.lonlat_grid(4, 2), rondel.lonlat_grid(2, 1))
    writers = (rondel.Regridder(SOURCE, TARGET, "bilinear"), remap, remap.weights)
    for writer in writers:
        with pytest.raises(ValueError, match=r"netCDF is written to \.nc"):
            writer.to_netcdf(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_weights_of_files_know_their_places(tmp_path):
    """Also without the hashes that files of other programs lack."""
    netcdf = pytest.importorskip("netCDF4")
    import rondel.xarray  # needs xarray

    lon, lat = np.arange(0.0, 360, 30), np.arange(-75.0, 90, 30)
    ds = xarray.Dataset(
        {"t": (("lat", "lon"), np.add.outer(lat, 0 * lon))}, {"lon": lon, "lat": lat}
    )
    target = {"lon": lon + 3, "lat": lat + 1}
    wanted = (target["lon"], target["lat"])
    rondel.Regridder(ds, target, "nearest_s2d").to_netcdf(tmp_path / "w.nc")
    with netcdf.Dataset(tmp_path / "w.nc", "a") as file:
        for name in [name for name in file.ncattrs() if "hash" in name]:
            file.delncattr(name)
    weights = rondel.read_weights(tmp_path / "w.nc")
    assert weights.sites_hash == weights.targets_hash == 0
    turned = ds.isel(lat=slice(None, None, -1))
    for read in (weights, pickle.loads(pickle.dumps(weights))):
        found = ds.rondel.interpolate(wanted, weights=read, grid=True)
        assert np.array_equal(found.t, ds.t)
        shifted = ds.assign_coords(lon=lon - 360)
        assert np.array_equal(shifted.rondel.interpolate(wanted, weights=read, grid=True).t, ds.t)
        for data, places in ((turned, wanted), (ds, (wanted[0], wanted[1][::-1]))):
            with pytest.raises(ValueError, match="weights are of other places"):
                data.rondel.interpolate(places, weights=read, grid=True)
        taken = rondel.Regridder(ds, target, "nearest_s2d", weights=read)
        assert np.array_equal(taken(ds.t), ds.t)
        with pytest.raises(ValueError, match="weights are of other places"):
            rondel.Regridder(turned, target, "nearest_s2d", weights=read)


@pytest.mark.parametrize("side", ["source", "target"])
@pytest.mark.parametrize("is_file", [False, True])
def test_weights_may_count_the_places_that_are_there(side, is_file, tmp_path):
    """Places without coordinates, of which weights of the others know nothing."""
    rng = np.random.default_rng(6)
    gaps = np.arange(40) % 7 == 2
    places = {"lon": rng.uniform(0, 60, 40), "lat": rng.uniform(0, 40, 40)}
    lacking = {name: np.where(gaps, np.nan, values) for name, values in places.items()}
    others = {name: values[~gaps] for name, values in places.items()}
    grid = {"lon": np.arange(10.0, 50, 7), "lat": np.arange(8.0, 30, 5)}
    values = rng.normal(size=40)
    if side == "source":
        made = rondel.Regridder(others, grid, "nearest_s2d", locstream_in=True)
        wanted = made(values[~gaps])
        sides = lacking, grid
    else:
        made = rondel.Regridder(grid, others, "nearest_s2d", locstream_out=True)
        field = rng.normal(size=(5, 6))
        wanted = made(field)
        sides = grid, lacking
    weights = made.weights
    if is_file:
        weights = tmp_path / "weights.nc"
        made.to_netcdf(weights)
    stream = {"locstream_in": True} if side == "source" else {"locstream_out": True}
    with pytest.warns(UserWarning, match="6 of 40 places have no longitude or latitude"):
        again = rondel.Regridder(*sides, "nearest_s2d", weights=weights, **stream)
    if side == "source":
        np.testing.assert_array_equal(again(np.where(gaps, 1e9, values)), wanted)
    else:
        found = again(field)
        np.testing.assert_array_equal(found[~gaps], wanted)
        assert np.isnan(found[gaps]).all()
    # They must be the places that are there.
    moved = dict(lacking, lon=lacking["lon"] + 1)
    pair = (moved, grid) if side == "source" else (grid, moved)
    with (
        pytest.warns(UserWarning, match="have no longitude"),
        pytest.raises(ValueError, match="are of other places"),
    ):
        rondel.Regridder(*pair, "nearest_s2d", weights=weights, **stream)
