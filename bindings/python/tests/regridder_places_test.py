# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regridder and the accessor with data at other places and with packed numbers."""

import warnings

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402

EAST, NORTH = {"units": "degrees_east"}, {"units": "degrees_north"}
TARGET = {"lon": np.arange(12.5, 48, 5), "lat": np.arange(-17.5, 18, 5)}


def height(lon, lat):
    """Linear interpolation of this has an error below 0.05 on a grid of 4 degrees."""
    return np.cos(np.radians(lon)) + 3 * np.sin(np.radians(lat))


def staggered(shift=2.0):
    """Two fields on one pair of dimensions, each at its own places."""
    lon, lat = np.meshgrid(np.arange(0.0, 61, 4), np.arange(-32.0, 33, 4))
    coords = {}
    for letter, moved in (("T", 0.0), ("U", shift)):
        coords[letter + "LONG"] = (("y", "x"), lon + moved, EAST)
        coords[letter + "LAT"] = (("y", "x"), lat + moved, NORTH)
    made = xarray.Dataset(coords=coords)
    for name, letter, moved in (("heat", "T", 0.0), ("wind", "U", shift)):
        made[name] = (("y", "x"), height(lon + moved, lat + moved))
        made[name].encoding["coordinates"] = f"{letter}LONG {letter}LAT"
    return made


def test_data_at_other_places_are_refused():
    ds = staggered()
    regridder = rondel.Regridder(ds, TARGET, "linear", lon="TLONG", lat="TLAT")
    right = height(TARGET["lon"], TARGET["lat"][:, None])
    assert np.abs(regridder(ds.heat) - right).max() < 0.05
    at = "'wind' are at ULONG and ULAT, which are not the places of the source .TLONG and TLAT."
    for data in (ds.wind, ds.wind.expand_dims(time=3), ds.wind.transpose("x", "y")):
        with pytest.raises(ValueError, match=at):
            regridder(data)
    other = rondel.Regridder(ds, TARGET, "linear", lon="ULONG", lat="ULAT")
    assert np.abs(other(ds.wind) - right).max() < 0.05
    # Nothing says where values without coordinates are.
    bare = xarray.DataArray(ds.wind.values, dims=("y", "x"))
    assert regridder(bare).shape == regridder(ds.wind.values).shape == right.shape
    with pytest.warns(UserWarning, match="not those of the source: wind"):
        assert list(regridder(ds)) == ["heat"]


def test_the_same_places_by_other_names_are_taken():
    ds = staggered(shift=0.0)
    regridder = rondel.Regridder(ds, TARGET, "linear", lon="TLONG", lat="TLAT")
    turned = ds.assign_coords(ULONG=ds.ULONG - 360)
    turned.wind.encoding["coordinates"] = "ULONG ULAT"
    np.testing.assert_array_equal(regridder(turned.wind), regridder(ds.heat))
    # A grid of axes, and the same grid with coordinates of two dimensions.
    lon, lat = np.arange(0.0, 61, 4), np.arange(-32.0, 33, 4)
    axes = rondel.Regridder({"lon": lon, "lat": lat}, TARGET, "linear")
    assert axes(ds.heat).shape == (8, 8)
    with pytest.raises(ValueError, match="'wind' are at ULONG and ULAT"):
        axes(staggered().wind.drop_vars(["TLONG", "TLAT"]))


def test_a_square_of_other_names_is_not_turned():
    lon, lat = np.arange(0.0, 60, 10), np.arange(-25.0, 30, 10)
    source = xarray.Dataset(coords={"longitude": ("longitude", lon), "latitude": ("latitude", lat)})
    source.longitude.attrs, source.latitude.attrs = EAST, NORTH
    regridder = rondel.Regridder(source, TARGET, "bilinear")
    values = height(lon, lat[:, None])
    right = regridder(values)
    for dims in (("lat", "lon"), ("y", "x"), ("a", "b")):
        found = regridder(xarray.DataArray(values, dims=dims))
        np.testing.assert_array_equal(found, right)
    for dims in (("lon", "lat"), ("x", "y")):
        with pytest.raises(ValueError, match=f"are {dims[0]} and {dims[1]}, those of the source"):
            regridder(xarray.DataArray(values.T, dims=dims))
    # The lengths decide where they differ.
    oblong = rondel.Regridder(source.isel(latitude=slice(5)), TARGET, "bilinear")
    found = oblong(xarray.DataArray(values[:5], dims=("x", "y")))
    np.testing.assert_array_equal(found, oblong(values[:5]))
    named = xarray.DataArray(values.T, dims=("longitude", "latitude"))
    np.testing.assert_array_equal(regridder(named), right)


PACKED = {
    "short": ("i2", {"scale_factor": 0.01, "add_offset": 273.15, "_FillValue": -32768}),
    "range": ("i2", {"scale_factor": 0.5, "valid_range": np.array([-200, 200], "i2")}),
    "unsigned": ("i1", {"_Unsigned": "true", "scale_factor": 0.5}),
    "only_unsigned": ("i1", {"_Unsigned": "true"}),
    "offset": ("i4", {"add_offset": 7, "missing_value": 100}),
}


@pytest.mark.parametrize("name", PACKED)
def test_numbers_that_xarray_left_packed_are_unpacked(name, tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    kind, attributes = PACKED[name]
    lon, lat = np.arange(0.0, 360, 45), np.arange(-60.0, 61, 20)
    packed = np.arange(-100, 124, 4)[: lat.size * lon.size].reshape(lat.size, lon.size).astype(kind)
    with netcdf.Dataset(tmp_path / "p.nc", "w") as file:
        for axis, values, marks in (("lat", lat, NORTH), ("lon", lon, EAST)):
            file.createDimension(axis, values.size)
            # The axes are packed, too.
            variable = file.createVariable(axis, "i2", (axis,))
            variable.setncatts({**marks, "scale_factor": 0.5})
            variable[:] = values
        fill = attributes.get("_FillValue")
        variable = file.createVariable("v", kind, ("lat", "lon"), fill_value=fill)
        variable.set_auto_maskandscale(False)
        variable.setncatts({k: v for k, v in attributes.items() if k != "_FillValue"})
        variable[:] = packed
    with (
        xarray.open_dataset(tmp_path / "p.nc", mask_and_scale=False) as raw,
        xarray.open_dataset(tmp_path / "p.nc") as decoded,
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("error")
        target = {"lon": [10.0, 100], "lat": [-35.0, 15, 33]}
        for method in ("nearest_s2d", "bilinear"):
            right = rondel.Regridder(decoded, target, method)(decoded.v)
            for source in (raw, decoded):
                regridder = rondel.Regridder(source, target, method)
                np.testing.assert_array_equal(regridder(raw.v), right)
                np.testing.assert_array_equal(regridder(raw).v, right)
        found = raw.v.rondel.interpolate(([10.0], [15.0]))
        np.testing.assert_array_equal(found, decoded.v.rondel.interpolate(([10.0], [15.0])))
        assert not {"scale_factor", "add_offset"} & set(found.attrs)


def test_cells_beside_their_coordinates_are_told():
    lon, lat = np.arange(0.0, 360, 60), np.arange(-75.0, 76, 30)
    source = xarray.Dataset(
        {"lon_bnds": (("lon", "two"), lon[:, None] + [30, 90])},
        {"lon": ("lon", lon, {**EAST, "bounds": "lon_bnds"}), "lat": ("lat", lat, NORTH)},
    )
    with pytest.warns(UserWarning, match="6 of 6 coordinates of 'lon' are outside of their cells"):
        rondel.Regridder(source, TARGET, "conservative")
    far = {"lon": lon, "lat": np.arange(-95.0, 96, 10)}
    with pytest.raises(rondel.InvalidInput, match="'lat': latitude -95 is beyond a pole"):
        rondel.Regridder(far, TARGET, "conservative")


@pytest.mark.parametrize("method", ["conservative", "nearest", "bilinear", "linear"])
def test_latitudes_beyond_a_pole_by_rounding_are_at_the_pole(method, tmp_path):
    pytest.importorskip("netCDF4")
    lat = np.linspace(-90, 90, 19)
    values = np.random.default_rng(2).normal(size=(19, 36))

    def regridded(north, target="grid:7x5"):
        coords = {
            "lat": ("lat", [*lat[:-1], north], NORTH),
            "lon": ("lon", np.arange(5.0, 360, 10), EAST),
        }
        data = xarray.Dataset({"t": (("lat", "lon"), values)}, coords)
        data.to_netcdf(tmp_path / "in.nc")
        return rondel.regrid(data, target, method).t

    def of_file():
        rondel.regrid_file(tmp_path / "in.nc", "grid:7x5", tmp_path / "out.nc", method=method)
        with xarray.open_dataset(tmp_path / "out.nc") as file:
            return file.t.load()

    wanted = regridded(90.0)
    for north in (90.000009, float(np.nextafter(np.float32(90), np.float32(91)))):
        np.testing.assert_array_equal(regridded(north), wanted)
        np.testing.assert_allclose(of_file(), wanted, rtol=1e-12)
    with pytest.raises(rondel.InvalidInput, match=r"'lat': latitude 90.00002 is beyond a pole"):
        regridded(90.00002)
    with pytest.raises(OSError, match=r"latitude 90.00002"):
        of_file()


def square(n=8):
    """A square curvilinear grid with its nodes, and a field that is the latitude."""
    node_lon, node_lat = np.meshgrid(np.linspace(0, 40, n + 1), np.linspace(-12, 12, n + 1))
    node_lat = node_lat + node_lon / 20
    lon, lat = ((nodes[1:, 1:] + nodes[:-1, :-1]) / 2 for nodes in (node_lon, node_lat))
    return xarray.Dataset(
        {"t": (("y", "x"), lat)},
        {
            "lon": (("y", "x"), lon),
            "lat": (("y", "x"), lat),
            "lon_b": (("y_b", "x_b"), node_lon),
            "lat_b": (("y_b", "x_b"), node_lat),
        },
    )


def test_the_corners_of_a_square_grid_have_any_order():
    ds = square()
    target = {"lon": np.arange(2.5, 40, 5), "lat": np.arange(-9.0, 10, 3)}
    right = rondel.Regridder(ds, target, "conservative")(ds.t)
    assert np.abs(right - target["lat"][:, None])[1:-1].max() < 1
    for other in (
        ds.transpose("y", "x", "x_b", "y_b"),
        ds.transpose("x", "y", "y_b", "x_b"),
        ds.assign_coords(lon_b=ds.lon_b.T),
        ds.assign_coords(lat_b=ds.lat_b.T),
    ):
        found = rondel.Regridder(other, target, "conservative")(other.t)
        np.testing.assert_allclose(found, right, rtol=0, atol=1e-12)
    arrays = {name: ds[name].values for name in ("lon", "lat", "lon_b", "lat_b")}
    turned = {**arrays, "lon_b": arrays["lon_b"].T, "lat_b": arrays["lat_b"].T}
    for source in (arrays, turned):
        found = rondel.Regridder(source, target, "conservative")(ds.t.values)
        np.testing.assert_allclose(found, right, rtol=0, atol=1e-12)
    long = ds.isel(x=slice(5), x_b=slice(6)).transpose("y", "x", "x_b", "y_b")
    assert rondel.Regridder(long, target, "conservative").shape_in == (8, 5)


@pytest.mark.parametrize(
    "change",
    [
        lambda ds: {"lon_b": ds.lon_b + 100},
        lambda ds: {"lat_b": ds.lat_b[::-1]},
        lambda ds: {"lat_b": ds.lat_b[::-1], "lon_b": ds.lon_b[:, ::-1]},
    ],
)
def test_corners_of_other_places_are_refused(change):
    ds = square()
    wrong = ds.assign_coords(
        {name: (array.dims, array.values) for name, array in change(ds).items()}
    )
    message = "of 64 cells with the corners 'lon_b' and 'lat_b' do not contain their centers"
    with pytest.raises(ValueError, match=message):
        rondel.Regridder(wrong, TARGET, "conservative")


def test_a_few_centers_outside_of_their_cells_are_told():
    ds = square()
    ds.lon[2, 3], ds.lat[2, 3] = 0, 0  # as on land in some files
    with pytest.warns(
        UserWarning, match="1 of 64 cells .* the first one cell 19 with the center 0"
    ):
        rondel.Regridder(ds, TARGET, "conservative")
    ds.lon[:, 2:], ds.lat[:, 2:] = 0, 0
    with pytest.warns(UserWarning, match="48 of 64 cells"):
        rondel.Regridder(ds, TARGET, "conservative")
    ds = square()
    ds.lon[2, 3], ds.lat[2, 3] = 0, 0
    mask = np.ones((8, 8))
    mask[2, 3] = 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rondel.Regridder(ds.assign(mask=(("y", "x"), mask)), TARGET, "conservative")


def test_dictionaries_have_the_names_that_tables_have():
    lon, lat = np.arange(0.0, 60, 4), np.arange(-32.0, 33, 4)
    field = height(lon, lat[:, None])
    right = rondel.Regridder({"lon": lon, "lat": lat}, TARGET, "bilinear")(field)
    named = {"Longitude": lon, "latitude": lat}
    np.testing.assert_array_equal(rondel.Regridder(named, TARGET, "bilinear")(field), right)
    for wrong, has in (({"lon": lon}, "lon"), ({}, "nothing"), ({"lon": lon, "y": lat}, "lon, y")):
        with pytest.raises(ValueError, match=f"has lat, in degrees; this one has {has}$|has lon"):
            rondel.Regridder(wrong, TARGET, "bilinear")


def test_masked_arrays_keep_their_type():
    lon, lat = np.arange(0.0, 60, 4), np.arange(-32.0, 33, 4)
    regridder = rondel.Regridder({"lon": lon, "lat": lat}, TARGET, "bilinear")
    field = height(lon, lat[:, None])
    masked = np.ma.masked_greater(field.astype("f4"), 1.9)
    found = regridder(masked)
    assert found.dtype == np.float32
    np.testing.assert_array_equal(found, regridder(np.ma.filled(masked, np.nan)))
    assert regridder(np.ma.masked_less(field.astype("i4"), 0)).dtype == np.float64


def test_the_cells_of_a_set_are_a_dimension_by_name_or_length():
    cells = rondel.CellSet.voronoi(
        rondel.delaunay(rondel.unit_vectors([0, 90, 200, 10], [0, 5, 0, 70]))
    )
    regridder = rondel.Regridder(cells, rondel.lonlat_grid(6, 3), "conservative")
    values = np.array([1.0, 2, 4, 8])
    right = regridder(values)
    for levels in (3, 4):  # as many levels as cells, too
        columns = values[:, None] + 100 * np.arange(levels)
        for name in ("nCells", "ncol", "cell", "cells"):
            data = xarray.DataArray(columns, dims=(name, "nVertLevels"), name="t")
            for turned in (data, data.T):
                for found in (regridder(turned), regridder(turned.to_dataset()).t):
                    assert found.dims == ("nVertLevels", *found.dims[1:])
                    np.testing.assert_allclose(found.values[0], right, rtol=1e-14)
    for dims in (("a", "b"), ("ncol", "nCells")):
        data = xarray.DataArray(np.zeros((4, 4)), dims=dims, name="t")
        for given in (data, data.to_dataset()):
            with pytest.raises(
                ValueError, match=f"'{dims[0]}' and '{dims[1]}' are dimensions of 4"
            ):
                regridder(given)
    # Times are no cells; one other dimension of the length is that of the cells by any name.
    found = regridder(xarray.DataArray(np.outer(np.arange(4), values), dims=("time", "a")))
    np.testing.assert_allclose(found.values[2], 2 * right, rtol=1e-14)
    found = regridder(xarray.DataArray(np.outer(values, np.arange(3)), dims=("a", "b")))
    np.testing.assert_allclose(found.values[2], 2 * right, rtol=1e-14)


def test_coordinates_in_radians_are_those_in_degrees(tmp_path):
    grid = rondel.lonlat_grid(6, 3)
    lon, lat = np.meshgrid(np.arange(-150.0, 180, 60), np.arange(-60.0, 61, 60))
    regridder = rondel.Regridder(grid, rondel.lonlat_grid(3, 2), "conservative")
    data = np.arange(18.0).reshape(3, 6)
    right = regridder(data)

    def labeled(shift, units):
        """The data with coordinates of the names that the grid has."""
        scale = np.pi / 180 if units else 1
        attrs = [{"units": units}] * 2 if units else [EAST, NORTH]
        coords = {
            "lat": (("y", "x"), (lat + shift) * scale, attrs[1]),
            "lon": (("y", "x"), lon * scale, attrs[0]),
        }
        return xarray.DataArray(data, coords, ("y", "x"), "t")

    for units in ("", "radian", "radians", "rad"):
        here = labeled(0, units)
        for given in (here, here.to_dataset()):
            found = regridder(given)
            found = found.t if hasattr(found, "data_vars") else found
            np.testing.assert_array_equal(found.values, right)
        for given in (labeled(1, units), labeled(1, units).to_dataset()):
            with pytest.raises(ValueError, match=r"places of the source|not that of the source"):
                regridder(given)


@pytest.mark.parametrize("method", ["nearest_s2d", "linear", "sibson"])
@pytest.mark.parametrize("is_lazy", [False, True])
def test_a_missing_value_hides_none_at_its_place(method, is_lazy):
    lon, lat = np.meshgrid(np.arange(0.0, 40, 5), np.arange(-20.0, 21, 5))
    places = {
        name: (("y", "x"), np.concatenate([own, own], axis=1), {"units": units})
        for name, own, units in (("lon", lon, "degrees_east"), ("lat", lat, "degrees_north"))
    }
    fields = np.stack([lon + lat, np.where(lon > 20, np.nan, lon + lat)])
    twice = np.concatenate([np.full_like(fields, np.nan), fields], axis=2)
    data = xarray.DataArray(twice, places, ("time", "y", "x"))
    before = twice.copy()
    with pytest.warns(UserWarning, match="72 of 144 places are those of others before"):
        regridder = rondel.Regridder(data, data, method)
    if is_lazy:
        pytest.importorskip("dask")
        data = data.chunk({"time": 1})
    found = np.asarray(regridder(data))[..., :8]
    np.testing.assert_array_equal(np.isnan(found), np.isnan(fields))
    np.testing.assert_allclose(found, fields, atol=1e-9)
    np.testing.assert_array_equal(twice, before)


@pytest.mark.parametrize("method", ["bilinear", "nearest_s2d", "linear"])
@pytest.mark.parametrize("step", [1, -1])
def test_repeated_columns_hide_nothing(method, step):
    lon, lat = np.arange(0.0, 361, 30)[::step], np.arange(-60.0, 61, 30)
    values = np.where(lon == 0, np.nan, lon % 360) + lat[:, None]
    data = xarray.DataArray(values, {"lat": lat, "lon": lon}, ("lat", "lon"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = rondel.Regridder(data, TARGET, method)(data)
    assert np.isfinite(found).all()
    whole = data.copy(data=lon % 360 + lat[:, None])
    np.testing.assert_array_equal(found, rondel.Regridder(whole, TARGET, method)(whole))
