# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regridder, against closed forms, SciPy, and what conservation and linearity say."""

import clouds
import numpy as np
import pytest
import scipy.interpolate

import rondel

xarray = pytest.importorskip("xarray")

FINE = {"lon": np.arange(2.5, 360, 5), "lat": np.arange(-87.5, 90, 5)}
COARSE = {"lon": np.arange(-175.0, 180, 10), "lat": np.arange(85.0, -90, -10)}
CONSERVATIVE = ["conservative", "conservative_normed", "conservative_2nd"]
METHODS = [
    *CONSERVATIVE,
    "bilinear",
    "nearest_s2d",
    "linear",
    "laplace",
    "sibson",
    "hermite",
    "cubic",
]


def dataset(axes, **variables):
    marks = {"lon": {"units": "degrees_east"}, "lat": {"units": "degrees_north"}}
    coords = {name: (name, axes[name], marks[name]) for name in ("lon", "lat")}
    return xarray.Dataset(variables, coords=coords)


def smooth(lon, lat):
    x, y, z = rondel.unit_vectors(lon, lat).T
    return (1 + x - 2 * y * z + 0.5 * z).T


def field(axes):
    return smooth(axes["lon"], axes["lat"][:, None])


@pytest.mark.parametrize("method", METHODS)
def test_constants_and_smooth_fields(method):
    regridder = rondel.Regridder(FINE, COARSE, method)
    assert regridder.shape_in == (36, 72)
    assert regridder.shape_out == (18, 36)
    assert np.allclose(regridder(np.ones((36, 72))), 1, atol=1e-13)
    found = regridder(np.stack([field(FINE), 2 * field(FINE)]))
    assert found.shape == (2, 18, 36)
    # Means over cells are not the values at their centers.
    tolerance = {"nearest_s2d": 0.2, **dict.fromkeys(CONSERVATIVE, 0.06)}.get(method, 0.02)
    assert np.allclose(found[0], field(COARSE), atol=tolerance)
    assert np.allclose(found[1], 2 * found[0], atol=1e-13)


@pytest.mark.parametrize("method", CONSERVATIVE)
def test_integrals_are_kept(method):
    regridder = rondel.Regridder(FINE, COARSE, method)
    cells = [rondel.CellSet.lonlat_centers(axes["lon"], axes["lat"]) for axes in (FINE, COARSE)]
    values = np.random.default_rng(0).normal(size=(36, 72))
    before = values.ravel() @ cells[0].areas
    assert np.isclose(regridder(values).ravel() @ cells[1].areas, before, atol=1e-13)
    assert np.isclose(cells[0].areas.sum(), 4 * np.pi, rtol=1e-14)


def test_bilinear_is_that_of_scipy():
    lon, lat = np.meshgrid(np.linspace(-30, 400, 40), np.linspace(-87.5, 87.5, 33))
    values = np.random.default_rng(1).normal(size=(36, 72))
    around = np.concatenate([values[:, -1:], values, values[:, :1]], axis=1)
    axis = np.concatenate([[-2.5], FINE["lon"], [362.5]])
    expected = scipy.interpolate.RegularGridInterpolator((FINE["lat"], axis), around)
    found = rondel.Regridder(FINE, {"lon": lon, "lat": lat}, "bilinear")(values)
    assert np.allclose(found, expected((lat, lon % 360)), atol=1e-12)
    # In any order of the axes.
    turned = {"lon": FINE["lon"][::-1], "lat": FINE["lat"][::-1]}
    again = rondel.Regridder(turned, {"lon": lon, "lat": lat}, "bilinear")(values[::-1, ::-1])
    assert np.allclose(found, again, atol=1e-12)


def test_bilinear_at_poles_and_outside():
    points = {"lon": [0, 90, 12, 200], "lat": [90, -90, 88.75, -88.75]}
    values = field(FINE)
    regridder = rondel.Regridder(FINE, points, "bilinear", locstream_out=True)
    found = regridder(values)
    assert found.shape == (4,)
    assert np.isclose(found[0], values[-1].mean())
    assert np.isclose(found[1], values[0].mean())
    assert np.allclose(found, smooth(points["lon"], points["lat"]), atol=0.02)
    region = {"lon": np.arange(10, 31, 5.0), "lat": np.arange(40, 61, 5.0)}
    wanted = ([10, 30, 20, 9, 20, 380], [40, 60, 50, 50, 61, 45])
    one = np.ones((5, 5))
    found = rondel.Regridder(region, wanted, "bilinear", locstream_out=True)(one)
    assert np.isnan(found).tolist() == [False, False, False, True, True, False]
    zero = rondel.Regridder(region, wanted, "bilinear", locstream_out=True, unmapped_to_nan=False)
    assert zero(one).tolist() == [1, 1, 1, 0, 0, 1]
    near = rondel.Regridder(
        region, wanted, "bilinear", locstream_out=True, extrap_method="nearest_s2d"
    )
    numbers = np.arange(25.0).reshape(5, 5)
    assert near(numbers)[3:5].tolist() == [10, 22]


def test_datasets():
    time = np.arange(3)
    values = np.random.default_rng(2).normal(size=(3, 36, 72)).astype(np.float32)
    ds = dataset(
        FINE, t=(("time", "lat", "lon"), values, {"units": "K"}), name=("time", list("abc"))
    ).assign_coords(time=time)
    ds.attrs["title"] = "made up"
    out = dataset(COARSE)
    regridder = rondel.Regridder(ds, out, "conservative")
    found = regridder(ds)
    assert list(found.data_vars) == ["t", "name"]
    assert found.t.dims == ("time", "lat", "lon")
    assert found.t.dtype == np.float32
    assert found.attrs == {}
    assert np.array_equal(found.lat, out.lat)
    assert np.allclose(found.t, regridder(values), atol=1e-6)
    kept = regridder(ds, keep_attrs=True)
    assert kept.attrs == ds.attrs
    assert kept.t.attrs == {"units": "K"}
    # In another order of dimensions, and by position where names differ.
    assert np.array_equal(regridder(ds.t.transpose("lat", "lon", "time")), found.t)
    unnamed = xarray.DataArray(values, dims=("time", "y", "x"))
    assert np.array_equal(regridder(unnamed), found.t)
    with pytest.raises(ValueError, match=r"must have shape \(\.\.\., 36, 72\), not \(72, 36\)"):
        regridder(np.zeros((72, 36)))


def test_dask_stays_lazy():
    array = pytest.importorskip("dask.array")
    values = array.from_array(np.random.default_rng(3).normal(size=(4, 36, 72)), chunks=(1, 36, 72))
    regridder = rondel.Regridder(FINE, COARSE, "bilinear")
    found = regridder(values)
    assert hasattr(found, "__dask_graph__")
    assert np.array_equal(found.compute(), regridder(values.compute()))


def test_cells_of_corners():
    lon_b, lat_b = np.meshgrid(np.arange(0, 361, 10.0), np.arange(-80, 81, 10.0))
    lon, lat = np.meshgrid(np.arange(5, 360, 10.0), np.arange(-75, 80, 10.0))
    curvilinear = {"lon": lon, "lat": lat, "lon_b": lon_b, "lat_b": lat_b}
    four = [np.stack([c[:-1, :-1], c[:-1, 1:], c[1:, 1:], c[1:, :-1]], -1) for c in (lon_b, lat_b)]
    bounds = xarray.Dataset(
        {"west": (("y", "x", "k"), four[0]), "south": (("y", "x", "k"), four[1])},
        coords={
            "lon": (("y", "x"), lon, {"units": "degrees_east", "bounds": "west"}),
            "lat": (("y", "x"), lat, {"units": "degrees_north", "bounds": "south"}),
        },
    )
    values = np.random.default_rng(4).normal(size=(16, 36))
    found = rondel.Regridder(curvilinear, COARSE, "conservative_normed")(values)
    assert np.array_equal(
        rondel.Regridder(bounds, COARSE, "conservative_normed")(values), found, equal_nan=True
    )
    lines = {"lon": lon[0], "lat": lat[:, 0], "lon_b": lon_b[0], "lat_b": lat_b[:, 0]}
    expected = rondel.CellSet.lonlat_grid(lon_b[0], lat_b[:, 0])
    regridder = rondel.Regridder(lines, expected, "conservative")
    assert np.array_equal(regridder(values), values)
    pairs = {**lines, "lon_b": np.stack([lon_b[0, :-1], lon_b[0, 1:]], -1)}
    assert np.array_equal(rondel.Regridder(pairs, expected, "conservative")(values), values)
    with pytest.raises(ValueError, match="no corners of cells: name them lon_b and lat_b"):
        rondel.Regridder({"lon": lon, "lat": lat}, COARSE, "conservative")
    with pytest.raises(ValueError, match="leave a gap before cell 1"):
        rondel.Regridder({**pairs, "lon_b": pairs["lon_b"] + [[0, -1]]}, COARSE, "conservative")


def test_cell_sets_are_grids():
    tri = rondel.delaunay(clouds.uniform(400, 1))
    cells = rondel.CellSet.voronoi(tri)
    regridder = rondel.Regridder(cells, COARSE, "conservative")
    expected = rondel.remap(cells, rondel.CellSet.lonlat_centers(COARSE["lon"], COARSE["lat"]))
    values = np.random.default_rng(5).normal(size=400)
    assert np.array_equal(regridder(values).ravel(), expected.weights.apply(values))
    back = rondel.Regridder(COARSE, cells, "sibson")
    assert back(field(COARSE)).shape == (400,)
    labeled = xarray.DataArray(values, dims="station", attrs={"units": "m"})
    assert regridder(labeled, keep_attrs=True).attrs == {"units": "m"}
    assert regridder(labeled).dims == ("lat", "lon")


@pytest.mark.parametrize("method", METHODS)
def test_masks(method):
    mask = np.ones((36, 72), int)
    mask[10:20, 20:40] = 0
    target_mask = np.ones((18, 36), int)
    target_mask[0] = 0
    values = np.where(mask, 1.0, 1e9)
    regridder = rondel.Regridder({**FINE, "mask": mask}, {**COARSE, "mask": target_mask}, method)
    found = regridder(values)
    assert np.isnan(found[0]).all()
    rest = found[1:]
    if method in ("conservative", "conservative_2nd"):
        assert np.nanmax(rest) <= 1 + 1e-12  # where a part is masked, that counts as 0
    else:
        assert np.allclose(rest[~np.isnan(rest)], 1)
    assert np.isnan(rest).any() == (method != "nearest_s2d")
    assert not np.isnan(rest).all()


def test_nearest_d2s_gives_each_source_away():
    regridder = rondel.Regridder(FINE, COARSE, "nearest_d2s")
    values = np.random.default_rng(6).normal(size=(36, 72))
    assert np.isclose(regridder(values).sum(), values.sum())
    assert len(regridder.weights.data) == 36 * 72


def test_missing_values():
    values = np.ones((36, 72))
    values[:, :36] = np.nan
    regridder = rondel.Regridder(FINE, COARSE, "conservative")
    strict, lenient = regridder(values), regridder(values, skipna=True)
    assert np.isnan(strict).sum() >= np.isnan(lenient).sum()
    assert np.allclose(lenient[~np.isnan(lenient)], 1)
    half = np.ones((36, 72))
    half[::2] = np.nan
    assert np.isnan(regridder(half, skipna=True, na_thres=0.25)).all()
    with pytest.raises(ValueError, match="na_thres has no effect without skipna=True"):
        regridder(half, na_thres=0.5)
    with pytest.raises(ValueError, match="na_thres must be from 0 to 1, not 50"):
        regridder(half, skipna=True, na_thres=50)
    assert np.allclose(regridder(np.ma.masked_invalid(half), skipna=True), 1)


def test_weights_are_kept(tmp_path):
    regridder = rondel.Regridder(FINE, COARSE, "conservative")
    regridder.to_netcdf(tmp_path / "weights.nc")
    values = np.random.default_rng(7).normal(size=(36, 72))
    for weights in (tmp_path / "weights.nc", regridder.weights):
        again = rondel.Regridder(FINE, COARSE, "conservative", weights=weights)
        assert np.array_equal(again(values), regridder(values))
    with pytest.raises(ValueError, match="the weights have shape"):
        rondel.Regridder(COARSE, FINE, "conservative", weights=regridder.weights)
    assert repr(regridder).startswith("<rondel.Regridder: 36 x 72 to 18 x 36, conservative, ")


def test_files_as_in_xesmf(tmp_path):
    path = tmp_path / "weights.nc"
    with pytest.raises(ValueError, match="reuse_weights needs filename or weights"):
        rondel.Regridder(FINE, COARSE, "conservative", reuse_weights=True)
    with pytest.raises(FileNotFoundError):
        rondel.Regridder(FINE, COARSE, "conservative", filename=path, reuse_weights=True)
    first = rondel.Regridder(FINE, COARSE, "conservative", filename=path)
    assert not path.exists()
    assert first.filename == path
    first.to_netcdf()
    again = rondel.Regridder(FINE, COARSE, "conservative", filename=path, reuse_weights=True)
    values = np.random.default_rng(8).normal(size=(36, 72))
    assert np.array_equal(again(values), first(values))
    kept = rondel.Regridder(FINE, COARSE, "conservative", reuse_weights=True, weights=first.weights)
    assert np.array_equal(kept(values), first(values))
    with pytest.raises(ValueError, match="to_netcdf\\(\\) needs the name of a file"):
        kept.to_netcdf()
    options = {"filename": path, "reuse_weights": True, "max_uncovered": 0.5}
    with pytest.raises(ValueError, match="max_uncovered has no effect on given weights"):
        rondel.Regridder(FINE, COARSE, "conservative", **options)


def test_tables_are_points():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame({"lon": [2.0, 90], "lat": [48.0, -33]})
    regridder = rondel.Regridder(FINE, table, "nearest_s2d")
    assert regridder.shape_out == (2,)
    with pytest.raises(TypeError, match=r"places are a Dataset.*, not ndarray"):
        rondel.Regridder(FINE, np.zeros((3, 2)), "bilinear")


def test_refused():
    with pytest.raises(ValueError, match="method must be one of"):
        rondel.Regridder(FINE, COARSE, "patch")
    with pytest.raises(ValueError, match="extrap_method"):
        rondel.Regridder(FINE, COARSE, "bilinear", extrap_method="patch")
    with pytest.raises(TypeError, match="'reuse'"):
        rondel.Regridder(FINE, COARSE, "bilinear", reuse=True)
    assert rondel.Regridder(FINE, COARSE, "bilinear", periodic=True).method == "bilinear"


def test_data_in_another_order_are_refused():
    lon, lat = np.arange(-175.0, 180, 10), np.arange(-85.0, 90, 10)
    coords = {"lon": ("lon", lon), "lat": ("lat", lat)}
    ds = xarray.Dataset({"t": (("lat", "lon"), lat[:, None] + lon)}, coords)
    regridder = rondel.Regridder(ds, {"lon": [0.0, 10], "lat": [5.0, 6]}, "bilinear")
    expected = regridder(ds.t)
    same = (
        ds.assign_coords(lon=lon.astype("f4") + 360, lat=lat.astype("f4")),
        ds.transpose("lon", "lat"),
        ds.drop_vars(["lon", "lat"]),
        ds.assign(t=ds.t * 1.0),
    )
    for data in same:
        assert np.array_equal(regridder(data.t), expected)
    others = (
        ds.isel(lat=slice(None, None, -1)),
        ds.roll(lon=18, roll_coords=True),
        ds.assign_coords(lat=lat + 1),
    )
    for data in others:
        for kind in (data, data.t):
            with pytest.raises(ValueError, match=r"the coordinate '(lon|lat)' of the data is not"):
                regridder(kind)
    curved = xarray.Dataset(
        {"t": (("y", "x"), lat[:, None] + lon)},
        dict(zip(("lon", "lat"), ((("y", "x"), c) for c in np.meshgrid(lon, lat)), strict=True)),
    )
    with pytest.raises(ValueError, match="the coordinate 'lat' of the data is not"):
        rondel.Regridder(curved, ds, "nearest_s2d")(curved.isel(y=slice(None, None, -1)))


def test_packed_numbers_are_told():
    # Floating-point numbers may be packed or not: the attributes do not say it.
    values = xarray.DataArray(np.ones((4, 8), "f4"), dims=("lat", "lon"), attrs={"add_offset": 3.0})
    ds = xarray.Dataset(
        {"t": values}, {"lon": np.arange(0.0, 360, 45), "lat": np.arange(-60.0, 61, 40)}
    )
    with pytest.warns(UserWarning, match="t are packed: their attribute scale_factor or add_off"):
        rondel.Regridder(ds, {"lon": [0.0, 10], "lat": [5.0, 6]}, "bilinear")(ds)


def test_lines_of_cells_in_the_reverse_order():
    lon, lat = np.arange(-175.0, 180, 10), np.arange(85.0, -90, -10)
    ds = xarray.Dataset(
        {"t": (("lat", "lon"), lat[:, None] + lon), "lat_b": ("lat_b", np.arange(-90.0, 91, 10))},
        {"lon": lon, "lat": lat},
    )
    target = rondel.lonlat_grid(12, 6)
    found = rondel.Regridder(ds, target, "conservative")(ds.t)
    turned = rondel.Regridder(ds.drop_vars("lat_b"), target, "conservative")(ds.t)
    assert np.allclose(found, turned, atol=1e-9)
    far = ds.assign_coords(lat=lat + 20)
    with pytest.raises(ValueError, match="latitude 105 is far from its cell, 90 to 80"):
        rondel.Regridder(far, target, "conservative")


def test_fields_on_another_grid_are_left_out_and_told():
    two = dataset(FINE, v=(("lat", "lon"), field(FINE)))
    axes = {name: (f"{name}_2", COARSE[name], two[name].attrs) for name in ("lon", "lat")}
    two = two.assign_coords(lon_2=axes["lon"], lat_2=axes["lat"])
    two["w"] = (("lat_2", "lon_2"), field(COARSE))
    target = {"lon": np.arange(0.0, 360, 20), "lat": np.arange(-80.0, 81, 20)}
    made = rondel.Regridder(two, target, "bilinear", lon="lon_2", lat="lat_2")
    with pytest.warns(UserWarning, match="not those of the source: v$"):
        found = made(two)
    assert list(found.data_vars) == ["w"]
    assert np.abs(found["w"] - field(target)).max() < 0.1
    made = rondel.Regridder(two, target, "bilinear", lon="lon", lat="lat")
    with pytest.warns(UserWarning, match="not those of the source: w$"):
        assert list(made(two).data_vars) == ["v"]


def test_weights_of_a_grid_in_another_order_are_refused(tmp_path):
    source = dataset(FINE, v=(("lat", "lon"), field(FINE)))
    rondel.Regridder(source, COARSE, "bilinear").to_netcdf(tmp_path / "w.nc")
    rondel.Regridder(source, COARSE, "bilinear", weights=tmp_path / "w.nc")
    turned = {"lon": COARSE["lon"], "lat": COARSE["lat"][::-1]}
    for grids in ((source.isel(lat=slice(None, None, -1)), COARSE), (source, turned)):
        with pytest.raises(ValueError, match="in another order"):
            rondel.Regridder(*grids, "bilinear", weights=tmp_path / "w.nc")


def test_a_cubed_sphere_is_a_source_and_a_target():
    data = dataset(FINE, a=(("lat", "lon"), field(FINE)))
    found = rondel.regrid(data, "C6")
    assert found["a"].dims == ("tile", "y", "x")
    assert np.allclose(found["a"], smooth(found["lon"].values, found["lat"].values), atol=0.05)
    again = rondel.regrid(found, COARSE)  # the places name their grid
    flat = found.stack(cell=("tile", "y", "x")).reset_index("cell", drop=True)
    np.testing.assert_array_equal(again["a"], rondel.regrid(flat, COARSE)["a"])
    back = rondel.Regridder(rondel.CellSet.named("C6"), COARSE, "conservative")(np.ones((6, 6, 6)))
    assert np.allclose(back, 1, atol=1e-13)
