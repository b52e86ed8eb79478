# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files of weights that a Regridder writes and takes again: grids, methods and masks."""

import os
import subprocess

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")

LON, LAT = np.arange(5.0, 360, 15), np.arange(-82.5, 90, 15)
SOURCE = {"lon": LON, "lat": LAT}
TARGET = {"lon": np.arange(2.5, 360, 20), "lat": np.arange(-80.0, 90, 20)}
MASK = np.ones((12, 24), int)
MASK[5, 3:9] = 0
HALF = np.ones((9, 18), int)
HALF[:, 9:] = 0
METHODS = [
    "bilinear",
    "conservative",
    "conservative_normed",
    "conservative_2nd",
    "nearest_s2d",
    "nearest_d2s",
    "linear",
    "sibson",
]
FIELD = np.where(MASK, 1.0, 1e6)


def written(path, source, target, method, **options):
    made = rondel.Regridder(source, target, method, filename=path, **options)
    made.to_netcdf()
    return made


def again(path, source, target, method, **options):
    options = {"filename": path, "reuse_weights": True, **options}
    return rondel.Regridder(source, target, method, **options)


@pytest.mark.parametrize("method", METHODS)
def test_the_same_masks_and_methods_are_taken(tmp_path, method):
    source, target = {**SOURCE, "mask": MASK}, {**TARGET, "mask": HALF}
    for grids in ((SOURCE, TARGET), (source, TARGET), (SOURCE, target), (source, target)):
        made = written(tmp_path / "w.nc", *grids, method)
        found = again(tmp_path / "w.nc", *grids, method)
        assert np.array_equal(found(FIELD), made(FIELD), equal_nan=True)


@pytest.mark.parametrize("method", METHODS)
def test_other_methods_are_refused(tmp_path, method):
    written(tmp_path / "w.nc", SOURCE, TARGET, method)
    for other in METHODS:
        if other != method:
            with pytest.raises(ValueError, match=rf"w\.nc holds weights of .*not '{other}'"):
                again(tmp_path / "w.nc", SOURCE, TARGET, other)
    kept = rondel.read_weights(tmp_path / "w.nc")
    assert rondel.Regridder(SOURCE, TARGET, "cubic", weights=kept).weights.shape == kept.shape


@pytest.mark.parametrize("method", METHODS)
def test_other_masks_are_refused(tmp_path, method):
    source, target = {**SOURCE, "mask": MASK}, {**TARGET, "mask": HALF}
    whole, part = tmp_path / "whole.nc", tmp_path / "part.nc"
    kept = written(whole, SOURCE, TARGET, method).weights
    written(part, source, target, method)
    for weights in (whole, kept):
        uses = "have entries of sources that the mask leaves out: [1-6], the first is 12[3-8]"
        with pytest.raises(ValueError, match=uses):
            rondel.Regridder(source, TARGET, method, weights=weights)
        with pytest.raises(ValueError, match=r"entries of targets .*leaves out: [0-9]+, the first"):
            rondel.Regridder(SOURCE, target, method, weights=weights)
    with pytest.raises(ValueError, match=r"another mask, without sources .*: 6, the first is 123"):
        again(part, SOURCE, target, method)
    with pytest.raises(ValueError, match=r"another mask, without targets .*: 81, the first is 9"):
        again(part, source, TARGET, method)


@pytest.mark.parametrize(
    ("text", "norm", "methods"),
    [
        ("Bilinear remapping", "none", ["bilinear"]),
        ("Conservative remapping", "fracarea", ["conservative_normed"]),
        ("Conservative remapping", "destarea", ["conservative"]),
        ("Conservative remapping", "none", ["conservative", "conservative_normed"]),
        ("Nearest source to destination", "none", ["nearest_s2d"]),
        ("Nearest destination to source", "none", ["nearest_d2s"]),
        ("nearest", "none", ["nearest_s2d"]),
        ("patch", "none", []),
        ("Distance weighted avg of nearest neighbors", "none", METHODS),
        ("unknown", "none", METHODS),
    ],
)
def test_names_of_other_programs(tmp_path, text, norm, methods):
    made = rondel.Regridder(SOURCE, TARGET, "nearest_s2d").weights
    made.to_netcdf(tmp_path / "made.nc", method=text)
    with xarray.open_dataset(tmp_path / "made.nc") as file:
        file = file.load().assign_attrs(normalization=norm)
    file.to_netcdf(tmp_path / "w.nc")
    for method in METHODS:
        if method in methods:
            assert again(tmp_path / "w.nc", SOURCE, TARGET, method).weights.shape == made.shape
        else:
            with pytest.raises(ValueError, match="holds weights of the method"):
                again(tmp_path / "w.nc", SOURCE, TARGET, method)


def test_bilinear_of_points_is_linear(tmp_path):
    lons, lats = np.meshgrid(LON, LAT)
    points = {"lon": lons, "lat": lats}
    written(tmp_path / "w.nc", points, TARGET, "bilinear")
    assert again(tmp_path / "w.nc", points, TARGET, "linear").method == "linear"


def test_targets_outside_are_filled_again(tmp_path):
    region = {"lon": [10.0, 20, 30], "lat": [40.0, 50]}
    written(tmp_path / "w.nc", region, TARGET, "bilinear")
    assert np.isnan(again(tmp_path / "w.nc", region, TARGET, "bilinear")(np.ones((2, 3)))).any()
    found = again(tmp_path / "w.nc", region, TARGET, "bilinear", extrap_method="nearest_s2d")
    assert (found(np.ones((2, 3))) == 1).all()


@pytest.mark.parametrize("method", METHODS)
def test_extrapolated_weights_are_none_without_extrapolation(tmp_path, method):
    source = {"lon": np.arange(0, 50, 5.0), "lat": np.arange(0, 50, 5.0)}
    target = {"lon": np.arange(-20.0, 70, 10), "lat": np.arange(-20.0, 70, 10)}
    path, options = tmp_path / "w.nc", {"extrap_method": "nearest_s2d"}
    values = np.random.default_rng(1).normal(size=(10, 10))
    made = written(path, source, target, method, **options)
    assert not np.isnan(made(values)).any()
    with pytest.raises(ValueError, match="extrapolated by nearest_s2d', but extrap_method is None"):
        again(path, source, target, method)
    for other in METHODS:
        if other != method:
            with pytest.raises(ValueError, match=f"by nearest_s2d.*, not '{other}'"):
                again(path, source, target, other, **options)
    found = again(path, source, target, method, **options)
    assert np.array_equal(found(values), made(values))
    # Written again they are still told from others.
    found.to_netcdf(path)
    with pytest.raises(ValueError, match="extrap_method is None"):
        again(path, source, target, method)
    plain = written(path, source, target, method)
    for wanted, how in ((plain, {}), (made, options)):
        found = again(path, source, target, method, **how)
        assert np.array_equal(found(values), wanted(values), equal_nan=True)


@pytest.mark.parametrize("method", METHODS)
def test_files_have_the_shapes_places_and_masks_of_grids(tmp_path, method):
    written(tmp_path / "w.nc", {**SOURCE, "mask": MASK}, {**TARGET, "mask": HALF}, method)
    with xarray.open_dataset(tmp_path / "w.nc") as file:
        assert file.src_grid_dims.values.tolist() == [24, 12]
        assert file.dst_grid_dims.values.tolist() == [18, 9]
        assert np.array_equal(file.mask_a.values.reshape(12, 24), MASK)
        assert np.array_equal(file.mask_b.values.reshape(9, 18), HALF)
        assert np.allclose(file.xc_b.values.reshape(9, 18)[0], TARGET["lon"], atol=1e-12)
        assert np.allclose(file.yc_b.values.reshape(9, 18)[:, 0], TARGET["lat"], atol=1e-12)
    if "RONDEL" in os.environ:
        written(tmp_path / "whole.nc", SOURCE, TARGET, method)
        for name in ("w.nc", "whole.nc"):
            command = [os.environ["RONDEL"], "check-weights", tmp_path / name]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stdout + done.stderr
