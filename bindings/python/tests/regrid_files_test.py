# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Named grids, and files that are regridded."""

import pickle

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
pytest.importorskip("netCDF4")
import rondel.xarray  # noqa: E402 (the accessor, which needs xarray)


@pytest.fixture
def made(tmp_path):
    """A file with two times of a field on a grid of 10 degrees, and the Dataset."""
    lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
    warm = 280 + 20 * np.cos(np.radians(lat))[:, None] + np.cos(np.radians(lon))
    data = xarray.Dataset(
        {"warm": (("time", "lat", "lon"), np.stack([warm, warm + 1]), {"units": "K"})},
        {
            "time": ("time", [0.0, 6.0], {"units": "hours since 2000-01-01"}),
            "lat": ("lat", lat, {"units": "degrees_north"}),
            "lon": ("lon", lon, {"units": "degrees_east"}),
        },
    )
    path = tmp_path / "in.nc"
    data.to_netcdf(path)
    return path, data


@pytest.mark.parametrize(
    ("name", "shape"),
    [
        ("grid:30", (6, 12)),
        ("healpix:2", (192,)),
        ("healpix:2:ring", (192,)),
        ("F4", (8, 16)),
        ("N32", (6114,)),
        ("O4", (208,)),
        ("C3", (6, 3, 3)),
        ("R2B1", (320,)),
    ],
)
def test_grids_have_names(name, shape):
    cells = rondel.CellSet.named(name)
    assert cells.shape == shape
    assert cells.covers_sphere
    assert abs(cells.areas.sum() - 4 * np.pi) < 1e-11
    back = pickle.loads(pickle.dumps(cells))
    np.testing.assert_array_equal(back.areas, cells.areas)


def test_pixels_have_one_area():
    for order in (0, 2, 5):
        areas = rondel.CellSet.named(f"healpix:{order}").areas
        np.testing.assert_allclose(areas, 4 * np.pi / areas.size, rtol=1e-11)
    four_sides = rondel.CellSet.named("healpix:2", sides="great_circles").areas
    assert np.ptp(four_sides) > 1e-3 * four_sides.mean()


def test_names_that_are_none_are_refused():
    with pytest.raises(rondel.InvalidInput, match="'N33' is no grid: N is one of 32, 48"):
        rondel.CellSet.named("N33")
    with pytest.raises(rondel.InvalidInput, match="'nothing' is no grid: grids are"):
        rondel.remap("nothing", "grid:30")


def test_remap_and_regridder_take_names(made):
    _, data = made
    remap = rondel.remap("grid:10", "healpix:2")
    regridder = rondel.Regridder(data, "healpix:2", "conservative")
    values = regridder(data.warm)
    assert values.shape == (2, 192)
    # grid:10 begins at longitude -180, the Dataset at 5 degrees east of Greenwich.
    field = np.roll(data.warm.values[1], 18, axis=1).ravel()
    np.testing.assert_allclose(values[1], remap.weights.apply(field), rtol=1e-14)


def test_files_are_regridded_as_arrays_are(made, tmp_path):
    path, data = made
    report = rondel.regrid_file(path, "healpix:2", tmp_path / "out.nc", history="by a test")
    assert (report.sources, report.targets, report.fields) == (648, 192, 2)
    assert (report.missing, report.tiles, report.remarks) == (0, 0, ())
    with xarray.open_dataset(tmp_path / "out.nc") as out:
        wanted = rondel.Regridder(data, "healpix:2", "conservative")(data.warm)
        np.testing.assert_allclose(out.warm, wanted, rtol=1e-14)
        assert out.warm.attrs["units"] == "K"
        assert out.attrs["history"] == "by a test"
    tiles = rondel.regrid_file(
        path, "healpix:2", tmp_path / "tiles.nc", tile=50, history="by a test"
    )
    assert tiles.tiles > 3
    assert (tmp_path / "tiles.nc").read_bytes() == (tmp_path / "out.nc").read_bytes()


def test_wrong_words_and_files_are_refused(made, tmp_path):
    path, _ = made
    out = tmp_path / "out.nc"
    with pytest.raises(ValueError, match="method must be one of 'conservative'"):
        rondel.regrid_file(path, "grid:30", out, method="bicubic")
    with pytest.raises(OSError, match=r"missing\.nc"):
        rondel.regrid_file(tmp_path / "missing.nc", "grid:30", out)
    with pytest.raises(Exception, match='no variable "cold"'):
        rondel.regrid_file(path, "grid:30", out, names="cold")
    assert not out.exists()


def test_progress_is_told_and_may_end_the_work(made, tmp_path):
    path, _ = made
    told = []
    rondel.regrid_file(
        path, "grid:30", tmp_path / "out.nc", tile=40, progress=lambda *at: told.append(at)
    )
    assert told[-1] == ("regrid", 1.0)

    def stop(stage, fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        rondel.regrid_file(path, "grid:30", tmp_path / "none.nc", tile=40, progress=stop)


def test_a_run_that_ended_early_goes_on(tmp_path):
    lon, lat = np.arange(0.5, 360), np.arange(-89.5, 90)
    values = np.random.default_rng(8).normal(size=(40, lat.size, lon.size)).astype("f4")
    path, out = tmp_path / "in.nc", tmp_path / "out.nc"
    xarray.Dataset(
        {"t": (("time", "lat", "lon"), values)},
        {
            "lat": ("lat", lat, {"units": "degrees_north"}),
            "lon": ("lon", lon, {"units": "degrees_east"}),
        },
    ).to_netcdf(path)
    rondel.regrid_file(path, "healpix:4", out)
    wanted = out.read_bytes()
    out.unlink()

    def stop_late(stage, fraction):
        if fraction > 0.5:
            raise KeyboardInterrupt

    # So little memory that the weights are computed again for every few times.
    options = {"tile": 100, "memory": 6 << 20, "resume": True}
    with pytest.raises(KeyboardInterrupt):
        rondel.regrid_file(path, "healpix:4", out, progress=stop_late, **options)
    partial = tmp_path / "out.nc.partial"
    assert partial.exists()
    assert not out.exists()
    with pytest.raises(OSError, match=r"out\.nc\.partial: of a run with 'method: by kind', not"):
        rondel.regrid_file(path, "healpix:4", out, method="nearest", resume=True)
    report = rondel.regrid_file(path, "healpix:4", out, resume=True)
    assert report.resumed > 3072
    assert out.read_bytes() == wanted
    assert not partial.exists()


def test_too_little_memory_and_files_that_are_read_are_refused(made, tmp_path):
    path, _ = made
    before = path.read_bytes()
    with pytest.raises(rondel.InvalidInput, match=r"memory of 100 bytes is too small: \d+M are"):
        rondel.regrid_file(path, "healpix:2", tmp_path / "out.nc", memory=100)
    with pytest.raises(OSError, match=r"in\.nc: it is the file of the input, too"):
        rondel.regrid_file(path, "healpix:2", path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_datasets_are_regridded_in_one_call(made):
    _, data = made
    kind = (np.abs(data.lat) // 30).astype("i1").expand_dims({"lon": data.lon}, axis=1)
    data = data.assign(kind=kind.assign_attrs(flag_meanings="a b c"))
    found = rondel.regrid(data, "healpix:2")
    wanted = rondel.Regridder(data, "healpix:2", "conservative_normed")(data.warm)
    np.testing.assert_array_equal(found.warm, wanted)
    assert found.warm.attrs == {"units": "K"}
    assert set(np.unique(found.kind)) == {0, 1, 2}
    again = data.rondel.regrid("healpix:2", "largest_share")
    np.testing.assert_array_equal(again.kind, found.kind)
    assert np.isin(again.warm[0], data.warm[0]).all()
    near = rondel.regrid(data.warm, rondel.CellSet.named("healpix:2"), "nearest")
    assert np.isin(near, data.warm).all()
    lazy = rondel.regrid(data.chunk({"time": 1}), "healpix:2")
    np.testing.assert_array_equal(lazy.warm, found.warm)


def test_categories_are_counted_as_sums_say():
    generator = np.random.default_rng(4)
    remap = rondel.remap("grid:15", "healpix:1")
    kinds = generator.integers(0, 4, (2, remap.weights.shape[1])).astype(float)
    kinds[1, ::5] = np.nan
    shares = np.stack([remap.weights.apply((kinds == k).astype(float)) for k in range(4)])
    found = remap.weights.apply(kinds, how="largest_share", skipna=True)
    assert np.take_along_axis(shares, found[None].astype(int), 0)[0] == pytest.approx(shares.max(0))
    strict = remap.weights.apply(kinds, how="largest_share")
    assert np.isnan(strict[1]).any()
    assert not np.isnan(strict[0]).any()
    with pytest.raises(ValueError, match="how must be"):
        remap.weights.apply(kinds, how="mode")
