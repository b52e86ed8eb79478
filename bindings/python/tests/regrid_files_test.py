# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Named grids, and files that are regridded."""

import pathlib
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
    assert found.warm.attrs == {"units": "K", "cell_methods": "area: mean"}
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


@pytest.mark.parametrize(
    "name", ["grid:30", "healpix:2", "healpix:2:ring", "F4", "O4", "C3", "R2B1"]
)
@pytest.mark.parametrize("kind", ["dataset", "array", "file", "written"])
def test_results_are_regridded_again(made, tmp_path, name, kind):
    path, data = made
    if kind == "file":
        rondel.regrid_file(path, name, tmp_path / "middle.nc")
        middle = xarray.open_dataset(tmp_path / "middle.nc")
    else:
        middle = rondel.regrid(data if kind != "array" else data.warm, name)
        if kind == "written":
            middle.to_netcdf(tmp_path / "middle.nc")
            middle = xarray.open_dataset(tmp_path / "middle.nc")
            rondel.regrid_file(tmp_path / "middle.nc", "grid:45", tmp_path / "tool.nc")
    found = rondel.regrid(middle, "grid:45")
    cells = rondel.CellSet.named(name)
    weights = rondel.remap(cells, "grid:45", norm="fracarea").weights
    values = middle if kind == "array" else middle.warm
    wanted = weights.apply(values.values.reshape(2, -1)).reshape(2, 4, 8)
    np.testing.assert_allclose(found if kind == "array" else found.warm, wanted, rtol=1e-13)
    if kind == "written":
        with xarray.open_dataset(tmp_path / "tool.nc") as tool:
            np.testing.assert_allclose(tool.warm, wanted, rtol=1e-13)
    if kind == "file":
        middle.close()


def test_results_carry_what_files_do(made, tmp_path):
    path, data = made
    for name in ("grid:30", "healpix:1", "F4"):
        rondel.regrid_file(path, name, tmp_path / "out.nc")
        found = rondel.regrid(data, name)
        with xarray.open_dataset(tmp_path / "out.nc") as out:
            assert found.warm.dims == out.warm.dims
            for axis in ("lat", "lon"):
                np.testing.assert_array_equal(found[axis], out[axis])
                assert found[axis].attrs["units"] == out[axis].attrs["units"]
                assert found[axis].attrs["standard_name"] == out[axis].attrs["standard_name"]
            mappings = [dict(d.crs.attrs) for d in (found, out) if "crs" in d]
            assert len(mappings) == (2 if name == "healpix:1" else 0)
            assert all(mapping == mappings[0] for mapping in mappings)
    # The mapping of the source is not that of the target.
    again = rondel.regrid(rondel.regrid(data, "healpix:1"), "O4")
    assert "crs" not in again.variables
    assert again.lat.attrs["rondel_grid"] == "O4"
    onward = rondel.regrid(again, "grid:45")
    assert not any("rondel_grid" in item.attrs for item in (onward, *onward.variables.values()))


def test_bounds_of_targets_are_carried(made):
    _, data = made
    lat, lon = [-60.0, 10.0, 75.0], [20.0, 150.0, 290.0]
    target = xarray.Dataset(
        {
            "lat_bnds": (("lat", "bnds"), [[-90.0, -30.0], [-30.0, 50.0], [50.0, 90.0]]),
            "lon_bnds": (("lon", "bnds"), [[-40.0, 90.0], [90.0, 220.0], [220.0, 320.0]]),
        },
        {
            "lat": ("lat", lat, {"units": "degrees_north", "bounds": "lat_bnds"}),
            "lon": ("lon", lon, {"units": "degrees_east", "bounds": "lon_bnds"}),
        },
    )
    found = rondel.regrid(data, target)
    np.testing.assert_array_equal(found.lat_bnds, target.lat_bnds)
    again = rondel.regrid(found, "grid:45")
    weights = rondel.Regridder(target, "grid:45", "conservative_normed").weights
    wanted = weights.apply(found.warm.values.reshape(2, -1)).reshape(2, 4, 8)
    np.testing.assert_allclose(again.warm, wanted, rtol=1e-14)
    # An array has no room for bounds, and names none.
    alone = rondel.regrid(data.warm, target)
    assert "bounds" not in alone.lat.attrs


def test_points_in_another_order_are_not_those_of_the_grid(made):
    _, data = made
    middle = rondel.regrid(data, "F4")
    turned = middle.isel(lat=slice(None, None, -1))
    np.testing.assert_allclose(
        rondel.regrid(turned, "grid:45").warm.mean(),
        rondel.regrid(middle, "grid:45").warm.mean(),
        rtol=1e-3,
    )
    pixels = rondel.regrid(data, "O4")
    shuffled = pixels.isel(cell=slice(None, None, -1))
    np.testing.assert_allclose(
        rondel.regrid(shuffled, "grid:45").warm, rondel.regrid(pixels, "grid:45").warm, rtol=1e-12
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"deflate": 99}, "deflate is 99, not from 0 to 9"),
        ({"deflate": 5}, "deflate has no effect on files other than netCDF-4"),
        ({"method": "linear", "norm": "destarea"}, "norm has no effect with a method between"),
        ({"method": "linear", "overlap": "each"}, "overlap has no effect with a method between"),
        ({"method": "nearest", "corners": "made"}, "corners have no effect with a method between"),
        ({"method": "nearest", "invalid": "repair"}, "invalid has no effect with a method between"),
        ({"method": "largest_share", "norm": "destarea"}, "norm has no effect with the method la"),
        ({"statistics": "mean", "tile": 100}, "tiles have no effect with statistics"),
        ({"statistics": "mean", "norm": "destarea"}, "norm has no effect with statistics"),
        ({"weigh_by": "fraction"}, "weigh_by has no effect without statistics"),
        ({"extrapolate_levels": 2}, "extrapolate_levels has no effect without extrapolate='creep"),
        (
            {"extrapolate": "idw", "extrapolate_levels": 2},
            "extrapolate_levels has no effect without extrapolate='creep_fill'",
        ),
        (
            {"extrapolate": "nearest", "extrapolate_sources": 3},
            "extrapolate_sources has no effect without extrapolate='inverse_dist'",
        ),
        ({"extrapolate_distance": 5.0}, "extrapolate_distance has no effect without extrapolate$"),
    ],
)
def test_options_without_effect_are_refused(made, tmp_path, options, message):
    with pytest.raises(ValueError, match=message):
        rondel.regrid_file(made[0], "grid:30", tmp_path / "out.nc", **options)
    assert not (tmp_path / "out.nc").exists()


def test_options_of_regridders_without_effect_are_refused(made):
    _, data = made
    with pytest.raises(ValueError, match="extrap_distance has no effect without extrap_method"):
        rondel.regrid(data, "grid:30", extrap_distance=10)
    with pytest.raises(ValueError, match="corners has no effect with the method 'linear'"):
        rondel.regrid(data, "grid:30", "linear", corners="made")
    with pytest.raises(ValueError, match="overlap has no effect with the method 'nearest_s2d'"):
        rondel.Regridder(data, "grid:30", "nearest_s2d", overlap="each")
    with pytest.raises(ValueError, match="extrap_num_levels has no effect without extrap_method="):
        rondel.Regridder(data, "grid:30", "linear", extrap_method="idw", extrap_num_levels=1)
    with pytest.raises(ValueError, match="max_uncovered has no effect with the method 'linear'"):
        rondel.Regridder(data, "grid:30", "linear", max_uncovered=0.5)
    regridder = rondel.Regridder(data, "grid:30", "conservative")
    for option, word in (("overlap", "first"), ("invalid", "repair")):
        with pytest.raises(ValueError, match=f"{option} has no effect on given weights"):
            rondel.Regridder(
                data, "grid:30", "conservative", weights=regridder.weights, **{option: word}
            )
    with pytest.raises(ValueError, match="how must be 'sum', 'largest_share' or 'by_kind', not 'f"):
        regridder(data.warm, how="foo")


def test_targets_lack_what_no_source_covers(tmp_path):
    lon, lat = np.arange(5.0, 40, 10), np.arange(-15.0, 20, 10)
    data = xarray.Dataset(
        {"one": (("lat", "lon"), np.full((4, 4), 7.0))},
        {
            "lat": ("lat", lat, {"units": "degrees_north"}),
            "lon": ("lon", lon, {"units": "degrees_east"}),
        },
    )
    data.to_netcdf(tmp_path / "in.nc")
    for most in (0.0, 0.4, 0.5, 0.8, 1.0):
        rondel.regrid_file(tmp_path / "in.nc", "grid:30", tmp_path / "out.nc", max_missing=most)
        found = rondel.regrid(data, "grid:30", max_missing=most)
        with xarray.open_dataset(tmp_path / "out.nc") as out:
            np.testing.assert_allclose(found.one, out.one, rtol=1e-15)
    partly = rondel.Regridder(data, "grid:30", "conservative_normed")(data.one)
    assert np.isfinite(partly).sum() == 4


@pytest.mark.parametrize("target", ["grid:9", "healpix:2", "hexagons:R2B2"])
@pytest.mark.parametrize("method", ["conservative", "conservative_2nd"])
def test_constants_are_kept_at_the_border_of_a_region(tmp_path, method, target):
    lon, lat = np.arange(1.0, 60, 2), np.arange(1.0, 40, 2)
    places = {
        "lat": ("lat", lat, {"units": "degrees_north"}),
        "lon": ("lon", lon, {"units": "degrees_east"}),
    }
    data = xarray.Dataset({"warm": (("lat", "lon"), np.full((20, 30), 280.0))}, places)
    data.to_netcdf(tmp_path / "in.nc")
    rondel.regrid_file(tmp_path / "in.nc", target, tmp_path / "out.nc", method=method)
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        wanted = file.warm.values
    found = rondel.regrid(data, target, method).warm.values
    np.testing.assert_allclose(found, wanted, rtol=1e-12)
    assert np.isfinite(found).any()
    np.testing.assert_allclose(found[np.isfinite(found)], 280, rtol=1e-12)


def test_a_text_that_packs_numbers_is_not_applied_twice(made, tmp_path):
    _, data = made
    data = data.isel(time=0, drop=True)
    data.warm.attrs |= {"scale_factor": "0.5", "add_offset": "273"}
    data.to_netcdf(tmp_path / "in.nc")
    rondel.regrid_file(tmp_path / "in.nc", "grid:10", tmp_path / "once.nc")
    rondel.regrid_file(tmp_path / "once.nc", "grid:10", tmp_path / "twice.nc")
    for name in ("once.nc", "twice.nc"):
        with xarray.open_dataset(tmp_path / name) as found:
            wanted = np.roll(273 + 0.5 * data.warm, 18, axis=1)  # from -180 degrees on
            np.testing.assert_allclose(found.warm, wanted, rtol=1e-12)
            assert "scale_factor" not in {**found.warm.attrs, **found.warm.encoding}


@pytest.mark.parametrize("more", [{}, {"tile": 40}, {"limiter": "bounds"}, {"limiter": "slopes"}])
@pytest.mark.parametrize("max_missing", [0.0, 0.3, 0.5, 1.0])
def test_targets_are_missing_by_area_with_gradients_as_well(made, tmp_path, more, max_missing):
    _, data = made
    gaps = np.random.default_rng(3).random(data.warm.shape) < 0.3
    # No target is covered by halves, which rounding would decide.
    data.warm.where(~gaps).assign_coords(lon=data.lon + 0.3).to_netcdf(tmp_path / "in.nc")
    found = {}
    for method, options in (("conservative", {}), ("conservative_2nd", more)):
        out = tmp_path / f"{method}.nc"
        rondel.regrid_file(
            tmp_path / "in.nc", "grid:31x16", out, method=method, max_missing=max_missing, **options
        )
        with xarray.open_dataset(out) as file:
            found[method] = file.warm.isnull().values
    assert 0 < found["conservative"].sum() < found["conservative"].size
    np.testing.assert_array_equal(found["conservative_2nd"], found["conservative"])


@pytest.mark.parametrize("norm", ["destarea", "fracarea"])
def test_the_limiter_keeps_constants_and_integrals_where_values_are_missing(made, tmp_path, norm):
    _, data = made
    values = np.full((18, 36), 7.0)
    values[np.random.default_rng(3).random(values.shape) < 0.3] = np.nan
    data["seven"] = (("lat", "lon"), values)
    data[["seven"]].to_netcdf(tmp_path / "in.nc")
    found = {}
    for limiter in ("none", "bounds", "slopes"):
        out = tmp_path / f"{limiter}.nc"
        rondel.regrid_file(
            tmp_path / "in.nc",
            "grid:20",
            out,
            method="conservative_2nd",
            norm=norm,
            max_missing=1.0,
            limiter=limiter,
        )
        with xarray.open_dataset(out) as file:
            found[limiter] = file.seven.values
    np.testing.assert_allclose(found["bounds"], found["none"], rtol=1e-13)
    if norm == "destarea":
        areas = rondel.CellSet.named("grid:20").areas.reshape(9, 18)
        wanted = np.nansum(values.ravel() * rondel.CellSet.named("grid:10").areas)
        for limiter in ("bounds", "slopes"):
            assert abs(np.nansum(found[limiter] * areas) - wanted) < 1e-12 * wanted
    else:
        assert set(found["slopes"][~np.isnan(found["slopes"])]) == {7.0}
    words = "'none', 'bounds', 'slopes'"
    with pytest.raises(ValueError, match=f"limiter must be one of {words}, not 'both'"):
        rondel.regrid_file(tmp_path / "in.nc", "grid:20", tmp_path / "o.nc", limiter="both")


def with_gaps(lon, lat):
    """Fields with no gap, with one, with the same one, and with another one."""
    x, y = np.meshgrid(np.radians(lon), np.radians(lat))
    field = 280 + 20 * np.cos(2 * y) * np.sin(x) + np.random.default_rng(4).normal(size=x.shape)
    fields = np.stack([field, field, 2 * field, field])
    fields[1:3, 5:12, 7:15] = np.nan
    fields[3][np.random.default_rng(5).random(x.shape) < 0.3] = np.nan
    return fields


@pytest.mark.parametrize("target", ["grid:15x7", "healpix:2", "O4"])
@pytest.mark.parametrize("max_missing", [0.0, 0.4, 1.0])
def test_gradients_end_at_gaps_of_data_as_at_those_of_files(made, tmp_path, target, max_missing):
    _, data = made
    fields = with_gaps(data.lon.values, data.lat.values)
    data = xarray.Dataset({"t": (("time", "lat", "lon"), fields)}, data.drop_vars("time").coords)
    data.to_netcdf(tmp_path / "in.nc")
    path, method = tmp_path / "out.nc", "conservative_2nd"
    rondel.regrid_file(tmp_path / "in.nc", target, path, method=method, max_missing=max_missing)
    with xarray.open_dataset(path) as file:
        wanted = file.t.values
    found = rondel.regrid(data, target, method, max_missing=max_missing)
    np.testing.assert_array_equal(found.t, wanted)
    assert 0 < np.isfinite(wanted[1:]).sum() <= wanted[1:].size
    regridder = rondel.Regridder(data, target, "conservative_2nd_normed")
    rules = {"skipna": max_missing > 0, "na_thres": max_missing if max_missing > 0 else 1.0}
    for each in (regridder, pickle.loads(pickle.dumps(regridder))):
        np.testing.assert_array_equal(each(data.t, **rules), wanted)
    # The order of fields, and which ones are carried together, change nothing.
    for k in (3, 1, 0, 2):
        np.testing.assert_array_equal(regridder(data.t[k], **rules), wanted[k])
    if max_missing == 0.4:
        pytest.importorskip("dask")
        lazy = data.chunk({"time": 1})
        blocks = rondel.regrid(lazy, target, method, max_missing=0.4, output_chunks=5)
        np.testing.assert_array_equal(blocks.t, wanted)


def test_gaps_of_second_order_can_be_extrapolated(made):
    _, data = made
    fields = with_gaps(data.lon.values, data.lat.values)[1, :, :18]
    data = xarray.Dataset({"t": (("lat", "lon"), fields)}, data.isel(lon=slice(18)).coords)
    plain = rondel.Regridder(data, "grid:15", "conservative_2nd_normed")
    filled = rondel.Regridder(
        data, "grid:15", "conservative_2nd_normed", extrap_method="nearest_s2d"
    )
    found, wanted = filled(data.t, skipna=True), plain(data.t, skipna=True)
    is_covered = np.diff(plain.weights.indptr).reshape(found.shape) > 0
    np.testing.assert_array_equal(found.values[is_covered], wanted.values[is_covered])
    assert np.isfinite(found.values[~is_covered]).all()
    assert np.isnan(wanted.values[~is_covered]).all()


@pytest.mark.parametrize(
    "method", ["conservative", "conservative_2nd", "bilinear", "nearest", "largest_share"]
)
@pytest.mark.parametrize("extrapolation", ["nearest_s2d", "inverse_dist", "creep_fill"])
def test_each_field_is_filled_by_its_own_gaps_in_memory_too(made, tmp_path, method, extrapolation):
    _, data = made
    fields = with_gaps(data.lon.values, data.lat.values)
    for k, field in enumerate(fields):
        field[4 + k : 9 + k, 5 : 20 - 3 * k] = np.nan
    attrs = {"units": "m s-1"}
    parts = {
        "t": (("time", "lat", "lon"), fields),
        "u": (("time", "lat", "lon"), fields[::-1], {"standard_name": "eastward_wind", **attrs}),
        "v": (("time", "lat", "lon"), fields[::-1], {"standard_name": "northward_wind", **attrs}),
        "kind": (("lat", "lon"), fields[0].round(), {"flag_values": [0.0], "flag_meanings": "a"}),
    }
    data = xarray.Dataset(parts, {name: data[name] for name in ("lat", "lon")})
    data.to_netcdf(tmp_path / "in.nc")
    vectors = [] if method == "largest_share" else [("u", "v")]
    options = {"vectors": vectors, "max_missing": 0.3}
    limit = {"extrapolate": extrapolation, "extrapolate_distance": 3000.0}
    rondel.regrid_file(
        tmp_path / "in.nc", "grid:15", tmp_path / "out.nc", method=method, **options, **limit
    )
    options |= {"extrap_method": extrapolation, "extrap_distance": 3000.0}
    found = rondel.regrid(data, "grid:15", method, **options)
    with xarray.open_dataset(tmp_path / "out.nc") as wanted:
        for name, field in wanted.data_vars.items():
            if name in parts:
                np.testing.assert_array_equal(found[name], field)
                assert found[name].attrs.get("flag_meanings") == field.attrs.get("flag_meanings")
    gaps = rondel.regrid(data, "grid:15", method, vectors=vectors, max_missing=0.3)
    assert np.isfinite(found.t).sum() > np.isfinite(gaps.t).sum()
    pytest.importorskip("dask")
    blocks = rondel.regrid(data.chunk({"time": 1}), "grid:15", method, output_chunks=5, **options)
    assert not isinstance(blocks.t.data, np.ndarray)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(blocks.t)), found.t)


def test_cells_that_overlap_are_taken_where_that_is_said(made):
    _, data = made
    shapely = pytest.importorskip("shapely")
    boxes = rondel.polygons([shapely.box(0, 0, 20, 20), shapely.box(10, 0, 30, 20)])
    with pytest.raises(rondel.InvalidInput, match="overlap='each'"):
        rondel.regrid(data, boxes)
    found = rondel.regrid(data, boxes, overlap="each")
    wanted = rondel.Regridder(data, boxes, "conservative_normed", overlap="each")(data)
    np.testing.assert_array_equal(found.warm, wanted.warm)


@pytest.mark.parametrize("parts", [2, 3])
@pytest.mark.parametrize("shift", [0.0, 0.3, 7.7])
def test_all_ways_decide_exact_shares_of_missing_values_equally(made, tmp_path, parts, shift):
    """One of 2 or 3 columns of sources in each target has no values: a share of 1/2 or 1/3."""
    _, data = made
    lon, share = data.lon.values + shift, 1 / parts
    gaps = (np.arange(36) % parts == 0) & (np.arange(36) >= parts)  # one column of targets has all
    values = np.where(gaps, np.nan, with_gaps(lon, data.lat.values)[0])
    places = {"lat": data.lat, "lon": ("lon", lon, {"units": "degrees_east"})}
    data = xarray.Dataset({"t": (("lat", "lon"), values)}, places)
    data.to_netcdf(tmp_path / "in.nc")
    step = 10 * parts
    edges = np.arange(0.0, 361, step) + shift
    target = xarray.Dataset(
        {},
        {
            "lat": ("lat", np.arange(-90 + step / 2, 90, step), {"units": "degrees_north"}),
            "lon": ("lon", edges[:-1] + step / 2, {"units": "degrees_east"}),
        },
    )
    target.to_netcdf(tmp_path / "target.nc")
    for most, is_there in ((share, True), (share - 1e-8, False), (share + 1e-8, True)):
        missing = {}
        for method in ("conservative", "conservative_2nd", "largest_share"):
            for tile in (0, 20):
                out = tmp_path / "out.nc"
                rondel.regrid_file(
                    tmp_path / "in.nc",
                    tmp_path / "target.nc",
                    out,
                    method=method,
                    max_missing=most,
                    tile=tile,
                )
                with xarray.open_dataset(out) as file:
                    missing[f"file {method} {tile}"] = file.t.isnull().values
            found = rondel.regrid(data, target, method, max_missing=most)
            missing[f"memory {method}"] = found.t.isnull().values
        for method in ("conservative", "conservative_2nd", "conservative_2nd_normed"):
            regridder = rondel.Regridder(data, target, method)
            found = regridder(data.t, skipna=True, na_thres=most)
            missing[f"regridder {method}"] = found.isnull().values
        cells = [rondel.CellSet.read(tmp_path / name) for name in ("in.nc", "target.nc")]
        weights = rondel.remap(*cells).weights
        found = weights.apply(values.ravel(), skipna=True, max_missing=most)
        missing["weights"] = np.isnan(found).reshape(target.lat.size, -1)
        zones = rondel.zonal_statistics(data, cells[1], ["mean"], max_missing=most)
        missing["zones"] = np.isnan(np.asarray(zones["t_mean"])).reshape(target.lat.size, -1)
        wanted = np.zeros((target.lat.size, target.lon.size), bool)
        wanted[:, 1:] = not is_there
        for way, found in missing.items():
            np.testing.assert_array_equal(found, wanted, f"{way} {most}")


@pytest.mark.parametrize("end", ["nc", "nc4"])
def test_attributes_that_are_numbers_are_those_of_data(made, tmp_path, end):
    _, data = made
    data = data.isel(time=0, drop=True)
    data.attrs |= {"realization": np.int32(3), "branch_time": 1.5, "sphere_radius": 6371229.0}
    data.warm.attrs |= {
        "level": np.float32(850),
        "table": np.int16(7),
        "steps": np.array([1, 2, 3], np.int32),
        "flag_values": np.array([1, 2], np.int8),
        "actual_range": np.array([250.0, 310.0]),
        "_ChunkSizes": np.int32(18),
        "CDI_grid_num_LPE": np.int32(9),
        "number_of_grid_in_reference": np.int32(1),
        "GRIB_Nx": np.int32(36),
        "GRIB_paramId": np.int32(130),
    }
    data.to_netcdf(tmp_path / "in.nc", encoding={"warm": {"_FillValue": -9.0, "dtype": "f4"}})
    out = tmp_path / f"out.{end}"
    rondel.regrid_file(tmp_path / "in.nc", "healpix:1", out)
    found = rondel.regrid(xarray.open_dataset(tmp_path / "in.nc"), "healpix:1", "largest_share")
    kept = {"level": "f4", "table": "i2", "steps": "i4", "flag_values": "i1", "GRIB_paramId": "i4"}
    lost = {"actual_range", "_ChunkSizes", "CDI_grid_num_LPE", "number_of_grid_in_reference"}
    with xarray.open_dataset(out) as file:
        for side in (file, found):
            for name, kind in kept.items():
                attribute = np.asarray(side.warm.attrs[name])
                assert attribute.dtype == kind, (name, attribute.dtype)
                np.testing.assert_array_equal(attribute, data.warm.attrs[name])
            assert not {*side.warm.attrs} & (lost | {"GRIB_Nx"})
            assert np.asarray(side.attrs["realization"]).dtype == "i4"
            assert side.attrs["branch_time"] == 1.5
            assert "sphere_radius" not in side.attrs
            for name, number in (("refinement_level", 1), ("healpix_nside", 2)):
                assert np.asarray(side.crs.attrs[name]).dtype.kind == "i"
                assert side.crs.attrs[name] == number


@pytest.mark.parametrize("end", ["nc", "nc4"])
def test_texts_may_be_empty(made, tmp_path, end):
    """As WRF's `description`, which is empty for what needs none."""
    _, data = made
    empty = {"description": "", "units": "", "cell_methods": ""}
    data.warm.attrs = {**empty, "flag_meanings": ""}
    data.attrs = {"title": "", "history": ""}
    data.to_netcdf(tmp_path / "in.nc")
    out = tmp_path / f"out.{end}"
    rondel.regrid_file(tmp_path / "in.nc", "grid:30", out, history="rondel regrid")
    found = rondel.regrid(data, "grid:30")
    with xarray.open_dataset(out) as file:
        assert file.attrs["title"] == ""
        assert file.attrs["history"] == "rondel regrid"
        for side in (file, found):
            kept = {**empty, "cell_methods": "area: mean"}
            assert {name: side.warm.attrs[name] for name in empty} == kept
            assert "flag_meanings" not in side.warm.attrs
            assert side.warm.max() > data.warm.max() - 5
        # An empty list of meanings is none.
        np.testing.assert_allclose(file.warm, found.warm, rtol=1e-13)
        assert not np.isin(found.warm, data.warm).all()


@pytest.mark.parametrize("flags", ["flag_values", "flag_masks", "flag_meanings"])
def test_a_method_that_is_named_is_that_of_flags_as_well(made, tmp_path, flags):
    """The command, files and data have one rule."""
    _, data = made
    kind = (np.arange(18)[:, None] + np.arange(36)) % 2
    attrs = {flags: "low high" if flags == "flag_meanings" else np.array([0, 1], np.int8)}
    data = data.assign(kind=(("lat", "lon"), kind.astype(float), attrs))[["kind"]]
    data.to_netcdf(tmp_path / "in.nc")
    for method in (None, "conservative", "conservative-2nd", "largest-share", "linear"):
        rondel.regrid_file(tmp_path / "in.nc", "grid:25x17", tmp_path / "out.nc", method=method)
        options = () if method is None else (method,)
        found = rondel.regrid(data, "grid:25x17", *options).kind
        np.testing.assert_array_equal(found, data.rondel.regrid("grid:25x17", *options).kind)
        with xarray.open_dataset(tmp_path / "out.nc") as file:
            np.testing.assert_allclose(found, file.kind, atol=1e-12)
        assert np.isin(found, [0, 1]).all() == (method in (None, "largest-share")), method


def test_attributes_of_types_that_classic_files_lack(made, tmp_path):
    """Types that netCDF-4 alone has are kept there, and become larger ones of classic files."""
    netcdf = pytest.importorskip("netCDF4")
    path, _ = made
    numbers = {
        "byte": np.array([200, 1], np.uint8),
        "short": np.uint16(60000),
        "word": np.uint32(3_000_000_000),
        "small": np.int64(-5),
        "large": np.int64(1 << 40),
        "natural": np.uint64(1 << 63),
    }
    with netcdf.Dataset(tmp_path / "in.nc4", "w") as file, netcdf.Dataset(path) as given:
        for name, dimension in given.dimensions.items():
            file.createDimension(name, len(dimension))
        for name, variable in given.variables.items():
            copied = file.createVariable(name, "f8", variable.dimensions)
            copied[...] = variable[...]
            if "units" in variable.ncattrs():
                copied.units = variable.units
        file["warm"].setncatts({**numbers, "lost": np.int64((1 << 60) + 1)})
    kinds = {
        "nc4": ("u1", "u2", "u4", "i8", "i8", "u8"),
        "nc": ("i2", "i4", "f8", "i4", "f8", "f8"),
    }
    for end, types in kinds.items():
        report = rondel.regrid_file(tmp_path / "in.nc4", "grid:30", tmp_path / f"out.{end}")
        assert any(
            '"lost" of variable "warm" has integers that are' in text for text in report.remarks
        )
        with netcdf.Dataset(tmp_path / f"out.{end}") as file:
            for (name, number), kind in zip(numbers.items(), types, strict=True):
                attribute = np.asarray(file["warm"].getncattr(name))
                assert attribute.dtype == kind, (end, name)
                np.testing.assert_array_equal(attribute, number)
            assert "lost" not in file["warm"].ncattrs()


@pytest.fixture
def ocean(tmp_path):
    """Files of an ocean, with bounds of all cells: without the centers of cells on land, as CICE
    writes them, and with all centers.
    """
    lon, lat = np.meshgrid(np.linspace(0, 60, 25), np.linspace(-30, 30, 13))
    lon, lat = lon + 5 * np.sin(np.radians(lat)), lat + 3 * np.sin(np.radians(lon))
    corners = [
        np.stack([each[:-1, :-1], each[:-1, 1:], each[1:, 1:], each[1:, :-1]], -1)
        for each in (lon, lat)
    ]
    land = np.zeros((12, 24), bool)
    land[3:6, 4:9] = land[0] = True
    fields = np.stack([corners[0].mean(-1), corners[0].mean(-1) * corners[1].mean(-1)])
    made = {}
    for name, gaps in (("whole", False), ("cice", True)):
        dims = ("nj", "ni")
        variables = {"aice": (("time", *dims), np.where(land, np.nan, fields))}
        for kind, array, units in zip(
            "TL", corners, ("degrees_east", "degrees_north"), strict=True
        ):
            side = "LON" if kind == "T" else "LAT"
            attrs = {"units": units, "bounds": f"{side.lower()}t_bounds"}
            center = np.where(land & gaps, np.nan, array.mean(-1))
            variables[f"T{side}"] = (dims, center, attrs)
            variables[attrs["bounds"]] = ((*dims, "nvertices"), array, {"units": units})
        made[name] = xarray.Dataset(variables).set_coords(["TLON", "TLAT"])
        made[name].to_netcdf(tmp_path / f"{name}.nc")
    return made


@pytest.mark.parametrize("method", ["conservative", "conservative_2nd", "largest_share"])
def test_cells_with_bounds_need_no_centers(ocean, tmp_path, method, recwarn):
    for max_missing in (0.3, 1.0):
        found = {}
        for name, data in ocean.items():
            out = tmp_path / "out.nc"
            options = {"method": method, "max_missing": max_missing}
            report = rondel.regrid_file(tmp_path / f"{name}.nc", "grid:7.5", out, **options)
            assert report.remarks == ()
            with xarray.open_dataset(out) as file:
                found[f"file {name}"] = file.aice.values
            found[f"memory {name}"] = rondel.regrid(data, "grid:7.5", **options).aice.values
        assert np.isfinite(found["file whole"]).sum() > 20
        for way, values in found.items():
            np.testing.assert_array_equal(values, found["file whole"], way)
    # They are targets, too.
    out, source = tmp_path / "out.nc", rondel.CellSet.named("O16")
    lon, lat = np.radians(source._degrees()).T
    field = xarray.DataArray(np.cos(lat) * np.cos(lon), dims="cell", name="t")
    found = [
        rondel.Regridder(source, each, "conservative_normed")(field).values
        for each in ocean.values()
    ]
    np.testing.assert_array_equal(*found)
    assert np.isfinite(found[0]).all()
    assert not [each for each in recwarn if "no longitude" in str(each.message)]


def test_files_of_weights_of_cells_without_centers_are_applied(ocean, tmp_path):
    """Fields without centers are at the places of weights that have them all, or lack the same."""
    for source in ocean:
        cells = rondel.CellSet.read(tmp_path / f"{source}.nc")
        rondel.remap(cells, "grid:10").to_netcdf(tmp_path / f"w_{source}.nc")
        weights = rondel.read_weights(tmp_path / f"w_{source}.nc")
        data = ocean["cice"]
        regridder = rondel.Regridder(data, "grid:10", "conservative", weights=weights)
        found = regridder(data.aice, skipna=True)
        assert np.isfinite(found).sum() > 20
        wanted = rondel.Regridder(ocean["whole"], "grid:10", "conservative")
        np.testing.assert_array_equal(found, wanted(ocean["whole"].aice, skipna=True))


@pytest.mark.parametrize("extrapolation", ["nearest_s2d", "creep_fill"])
def test_cells_without_centers_give_nothing_by_extrapolation(ocean, extrapolation):
    data = ocean["cice"]
    options = {"extrap_method": extrapolation}
    regridder = rondel.Regridder(data, "grid:10", "conservative_normed", **options)
    assert np.isfinite(regridder(data.aice, skipna=True)).mean() > 0.9
    back = rondel.Regridder(rondel.lonlat_grid(9, 9), data, "conservative_normed", **options)
    assert np.isfinite(back(np.ones((9, 9)))).all()


def test_methods_between_centers_say_that_some_lack(ocean, tmp_path):
    options = {"method": "linear", "max_missing": 1.0}
    report = rondel.regrid_file(tmp_path / "cice.nc", "grid:10", tmp_path / "o.nc", **options)
    assert any("39 of 288 places have no longitude or latitude" in text for text in report.remarks)
    with pytest.warns(UserWarning, match="39 of 288 places have no longitude or latitude"):
        rondel.regrid(ocean["cice"], "grid:10", "linear")


def test_arguments_of_other_types_are_told(made, tmp_path):
    path, _ = made
    out = tmp_path / "out.nc"
    for options, kind, message in (
        ({"memory": "much"}, ValueError, "memory is 'much', which is not a number of bytes"),
        ({"memory": -1}, ValueError, "memory is -1, which is not a number of bytes"),
        ({"max_missing": "0.5"}, TypeError, "max_missing must be a number, not str"),
        ({"tile": "3"}, TypeError, "tile must be an integer, not str"),
        ({"tile": -1}, ValueError, "tile must be from 0 to 2147483647, not -1"),
        ({"deflate": 1.5}, TypeError, "deflate must be an integer, not float"),
        ({"history": 3}, TypeError, "history must be a text, not int"),
        ({"names": [1]}, TypeError, "names must be a text, not int"),
        ({"vectors": ["uv"]}, TypeError, "vectors are pairs of names, not 'uv'"),
        ({"extrapolate": 4}, TypeError, "extrapolate must be a text, not int"),
        ({"source": 3}, TypeError, "expected str, bytes or os.PathLike object, not int"),
    ):
        with pytest.raises(kind, match=message) as caught:
            rondel.regrid_file(path, "grid:30", out, **options)
        assert "\n" not in str(caught.value)
    assert not out.exists()


def test_paths_may_be_bytes_and_memory_a_text(made, tmp_path):
    path, _ = made

    class Named:
        def __init__(self, name):
            self.name = name

        def __fspath__(self):
            return self.name

    wanted = tmp_path / "wanted.nc"
    rondel.regrid_file(path, "grid:30", wanted)
    for k, kind in enumerate((str, bytes, lambda p: Named(str(p)), lambda p: Named(bytes(p)))):
        out = tmp_path / f"{k}.nc"
        rondel.regrid_file(kind(path), "grid:30", kind(out), source=kind(path), memory="1.5G")
        assert out.read_bytes() == wanted.read_bytes()
        assert rondel.CellSet.read(kind(path)).num_cells == 648
    with pytest.raises(rondel.InvalidInput, match="memory"):
        rondel.regrid_file(path, "grid:0.1", tmp_path / "o.nc", memory="1K")


@pytest.mark.parametrize("statistics", [(), ("mean",)])
def test_no_file_is_left_by_progress_that_raises(made, tmp_path, statistics):
    path, _ = made
    options = {"statistics": statistics}
    said = []
    whole = tmp_path / "whole.nc"
    rondel.regrid_file(
        path, "grid:30", whole, progress=lambda *state: said.append(state), **options
    )
    assert said[-1][1] == 1
    assert whole.exists()
    for last in dict.fromkeys(said):
        out = tmp_path / "out.nc"

        def raises(*state, last=last):
            if state == last:
                raise RuntimeError("enough")

        with pytest.raises(RuntimeError, match="enough"):
            rondel.regrid_file(path, "grid:30", out, progress=raises, **options)
        assert [each.name for each in tmp_path.iterdir() if "out" in each.name] == []


def test_faces_of_a_mesh_may_lack_centers(tmp_path):
    """Conservative methods need none; others leave out the faces that have none, and say so."""
    node = {"mesh": "mesh", "location": "face", "coordinates": "face_lon face_lat"}
    about = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "lon lat",
        "face_node_connectivity": "corners",
        "face_coordinates": "face_lon face_lat",
    }
    east, north = {"units": "degrees_east"}, {"units": "degrees_north"}
    mesh = xarray.Dataset(
        {
            "mesh": ((), np.int32(0), about),
            "lon": ("node", [0.0, 10, 20, 0, 10, 20], east),
            "lat": ("node", [0.0, 0, 0, 10, 10, 10], north),
            "corners": (("face", "four"), [[0, 1, 4, 3], [1, 2, 5, 4]], {"start_index": 0}),
            "face_lon": ("face", [4.0, np.nan], east),
            "face_lat": ("face", [6.0, np.nan], north),
            "t": ("face", [1.0, 2.0], node),
        }
    )
    mesh.to_netcdf(tmp_path / "in.nc")
    out = tmp_path / "out.nc"
    rondel.regrid_file(tmp_path / "in.nc", "grid:5", out)
    with xarray.open_dataset(out) as file:
        counts = [int((file.t == value).sum()) for value in (1, 2)]
    assert counts == [4, 4]
    report = rondel.regrid_file(tmp_path / "in.nc", "grid:5", out, method="nearest")
    assert any("1 of 2 places have no longitude or latitude" in text for text in report.remarks)
    with xarray.open_dataset(out) as file:
        assert (file.t == 1).all()


@pytest.mark.parametrize("attribute", ["cf_role", "standard_name"])
def test_the_variable_of_a_mesh_is_left_with_it(tmp_path, attribute):
    """Files and data lose what says of which parts the mesh of the source consists."""
    lon, lat = np.array([0.0, 10, 20, 0, 10, 20]), np.array([0.0, 0, 0, 10, 10, 10])
    about = {
        attribute: "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "lon lat",
        "face_node_connectivity": "corners",
    }
    variables = {
        "lon": ("node", lon, {"units": "degrees_east", "standard_name": "longitude"}),
        "lat": ("node", lat, {"units": "degrees_north", "standard_name": "latitude"}),
        "corners": (("face", "four"), [[0, 1, 4, 3], [1, 2, 5, 4]], {"start_index": 0}),
        "t": ("node", lat, {"mesh": "mesh", "location": "node", "coordinates": "lon lat"}),
        "part": ("two", [0, 1], {"cf_role": "location_index_set", "mesh": "mesh"}),
        "run": ("two", [7.0, 8.0]),
    }
    for mesh in (((), np.int32(0), about), ("one", np.int32([0]), about)):
        data = xarray.Dataset({"mesh": mesh, **variables})
        data.to_netcdf(tmp_path / "in.nc")
        rondel.regrid_file(tmp_path / "in.nc", "grid:10", tmp_path / "out.nc", method="linear")
        found = rondel.regrid(data, "grid:10", "linear", lon="lon", lat="lat")
        with xarray.open_dataset(tmp_path / "out.nc") as file:
            assert {*file.variables} == {"t", "run", "lon", "lat"}
        assert {*found.variables} - {"lon_bnds", "lat_bnds"} == {"t", "run", "lon", "lat"}


@pytest.mark.parametrize(
    ("target", "dims"),
    [
        ("tripolar:15", ("y", "x")),
        ("hexagons:R2B1", ("cell",)),
        ("C4", ("tile", "y", "x")),
        ("O8", ("cell",)),
        ("healpix:1", ("cell",)),
        ("grid:30", ("lat", "lon")),
    ],
)
def test_dimensions_of_files_are_named(made, tmp_path, target, dims):
    path, data = made
    rondel.regrid_file(path, target, tmp_path / "out.nc")
    found = rondel.regrid(data, target)
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        assert file.warm.dims == ("time", *dims)
        if target != "C4":
            assert found.warm.dims == file.warm.dims
            assert found.warm.shape == file.warm.shape


@pytest.mark.parametrize("as_path", [str, pathlib.Path])
def test_files_are_no_grids_and_it_is_said_what_takes_them(made, tmp_path, as_path, monkeypatch):
    _, data = made
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cells").write_text("")
    for name, hint in (
        ("in.nc", r"xarray.open_dataset\(\) its fields, and rondel.regrid_file\(\) takes files"),
        ("elsewhere.nc", r"rondel.CellSet.read\(\) reads its cells"),
        ("countries.geojson", r"rondel.polygons\(\) reads .* rondel.zonal_statistics\(\) computes"),
        ("cells", r"rondel.CellSet.read\(\) reads its cells"),
    ):
        words = rf"'{name}' is a file, and no grid: .*{hint}"
        with pytest.raises(rondel.InvalidInput, match=words):
            rondel.regrid(data, as_path(name))
        with pytest.raises(rondel.InvalidInput, match=words):
            rondel.regrid(as_path(name), "healpix:1")
        with pytest.raises(rondel.InvalidInput, match=words):
            rondel.CellSet.named(name)


@pytest.mark.parametrize("method", ["conservative-2nd", "largest-share"])
def test_methods_may_be_spelled_as_in_the_command(made, tmp_path, method):
    path, data = made
    for name, spelled in (("a.nc", method), ("b.nc", method.replace("-", "_"))):
        rondel.regrid_file(path, "healpix:1", tmp_path / name, method=spelled, history="by a test")
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()
    found = rondel.regrid(data, "healpix:1", method)
    assert found.identical(rondel.regrid(data, "healpix:1", method.replace("-", "_")))


QUADS = np.array(
    [
        [(0, 0), (10, 0), (10, 10), (0, 10)],
        [(10, 0), (20, 10), (20, 0), (10, 10)],
        [(30, 0), (40, 10), (40, 0), (30, 10)],
    ],
    float,
)


def write_quads(path, kind, has_centers):
    """Three cells with a field, of which the last two cross themselves."""
    if kind == "ugrid":
        nodes, corners = QUADS.reshape(-1, 2), np.arange(12).reshape(3, 4)
        mesh = {
            "cf_role": "mesh_topology",
            "topology_dimension": 2,
            "node_coordinates": "nx ny",
            "face_node_connectivity": "corners",
        } | ({"face_coordinates": "fx fy"} if has_centers else {})
        variables = {
            "mesh": ((), 0, mesh),
            "corners": (("face", "four"), corners, {"start_index": 0}),
            "t": (("face",), [1.0, 2.0, 3.0], {"mesh": "mesh", "location": "face"}),
        }
        for k, (name, sense) in enumerate((("x", "degrees_east"), ("y", "degrees_north"))):
            variables[f"n{name}"] = ("node", nodes[:, k], {"units": sense})
            if has_centers:
                variables[f"f{name}"] = ("face", QUADS[..., k].mean(1), {"units": sense})
    else:
        variables = {"t": (("grid_size",), [1.0, 2.0, 3.0])}
        for k, name in enumerate(("lon", "lat")):
            units = {"units": "degrees"}
            variables[f"grid_corner_{name}"] = (("grid_size", "four"), QUADS[..., k], units)
            if has_centers:
                variables[f"grid_center_{name}"] = ("grid_size", QUADS[..., k].mean(1), units)
    xarray.Dataset(variables).to_netcdf(path)


@pytest.mark.parametrize("has_centers", [False, True])
@pytest.mark.parametrize("kind", ["ugrid", "scrip"])
def test_cells_that_cross_themselves_are_named_or_repaired(made, tmp_path, kind, has_centers):
    bad, out = tmp_path / "bad.nc", tmp_path / "out.nc"
    write_quads(bad, kind, has_centers)
    for side, names in (("source", (bad, "grid:5")), ("target", (made[0], bad))):
        message = rf"bad.nc: {side} cell 1 crosses or overlaps itself at 15\.0"
        for more in ({}, {"statistics": "mean"}, {"tile": 50}, {"method": "conservative_2nd"}):
            with pytest.raises(rondel.InvalidInput, match=message):
                rondel.regrid_file(*names, out, **more)
            report = rondel.regrid_file(*names, out, invalid="repair", **more)
            assert any(
                text.endswith(", and 1 more") and "bad.nc: cell 1 was repaired (it " in text
                for text in report.remarks
            )
    # The values are those of weights between the repaired cells.
    with pytest.warns(UserWarning, match="cell 1 was repaired"):
        cells = rondel.CellSet.read(bad, invalid="repair")
    remap = rondel.remap(cells, "grid:5", norm="fracarea")
    rondel.regrid_file(bad, "grid:5", out, invalid="repair", max_missing=1)
    with xarray.open_dataset(out) as file:
        wanted = remap.weights.apply(np.array([1.0, 2.0, 3.0]))
        is_there = np.isfinite(file.t.values.ravel())
        assert is_there.sum() >= 12
        np.testing.assert_allclose(file.t.values.ravel()[is_there], wanted[is_there], rtol=1e-13)
