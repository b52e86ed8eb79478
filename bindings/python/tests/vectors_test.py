# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Vectors that are regridded by their components in space, as `regrid_file` does it."""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")


def frame(lon, lat):
    lon, lat = np.radians(lon), np.radians(lat)
    east = np.stack([-np.sin(lon), np.cos(lon), np.zeros_like(lon)], -1)
    north = np.stack([-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)], -1)
    return east, north, np.cross(east, north)


@pytest.fixture
def winds():
    """A solid rotation around an axis, at two times, with a missing component."""
    lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
    east, north, up = frame(*np.meshgrid(lon, lat))
    wind = np.cross([0.4, -1.0, 0.3], up)
    u, v = ((wind * to).sum(-1) * np.array([1, 2])[:, None, None] for to in (east, north))
    v[1, 3, 4] = np.nan
    dims = ("time", "lat", "lon")
    coords = {
        "lat": ("lat", lat, {"units": "degrees_north"}),
        "lon": ("lon", lon, {"units": "degrees_east"}),
    }
    return xarray.Dataset(
        {
            "u": (dims, u, {"units": "m s-1"}),
            "t": (dims, np.ones(u.shape)),
            "v": (dims, v.astype("f4")),
        },
        coords,
    )


@pytest.mark.parametrize("method", ["conservative", "conservative_2nd", "linear", "nearest"])
@pytest.mark.parametrize("target", ["grid:9x7", "O8", "healpix:2"])
def test_vectors_are_those_of_regrid_file(winds, method, target, tmp_path):
    pytest.importorskip("netCDF4")
    if method == "conservative_2nd":
        winds = winds.fillna(0)  # regrid_file counts missing values as 0 where it keeps integrals
    winds.to_netcdf(tmp_path / "in.nc")
    options = {"norm": "destarea"} if method == "conservative_2nd" else {}
    rondel.regrid_file(
        tmp_path / "in.nc",
        target,
        tmp_path / "out.nc",
        method=method,
        vectors=[("u", "v")],
        **options,
    )
    found = rondel.regrid(winds, target, method, vectors=[("u", "v")])
    assert list(found.data_vars) == ["u", "t", "v"]
    done = {"cell_methods": "area: mean"} if method.startswith("conservative") else {}
    assert found.u.attrs == {"units": "m s-1", **done}
    assert found.v.dtype == np.float32
    with xarray.open_dataset(tmp_path / "out.nc") as wanted:
        np.testing.assert_allclose(found.u.values, wanted.u.values, rtol=0, atol=1e-15)
        np.testing.assert_allclose(found.v.values, wanted.v.values, rtol=0, atol=1e-7)
        assert not np.allclose(found.u.values, rondel.regrid(winds, target, method).u.values)


def test_the_integral_in_space_is_kept(winds):
    winds = winds.fillna(0).astype("f8")
    cells, target = rondel.CellSet.named("grid:10"), rondel.CellSet.named("healpix:3")
    regridder = rondel.Regridder(winds, "healpix:3", "conservative")
    east, north, _ = frame(*np.meshgrid(winds.lon, winds.lat))
    space = winds.u.values[..., None] * east + winds.v.values[..., None] * north
    areas = cells.areas.reshape(18, 36)
    assert regridder.shape_in == areas.shape
    parts = regridder(np.moveaxis(space, -1, 0))  # the oracle: three scalar fields
    before = (space * areas[..., None]).sum((1, 2))
    after = (parts * target.areas).sum(-1).T
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-12)
    found = regridder(winds, vectors=[("u", "v")])
    to_east, to_north, to_up = frame(found.lon.values, found.lat.values)
    vectors = np.moveaxis(parts, 0, -1)
    np.testing.assert_allclose(found.u.values, (vectors * to_east).sum(-1), rtol=0, atol=1e-14)
    np.testing.assert_allclose(found.v.values, (vectors * to_north).sum(-1), rtol=0, atol=1e-14)
    # The formula leaves out the part across the sphere, of second order in the size of the cells.
    assert np.abs((vectors * to_up).sum(-1)).max() < 0.1


def test_lazy_vectors_are_the_same(winds):
    pytest.importorskip("dask.array")
    wanted = rondel.regrid(winds, "healpix:2", vectors=[("u", "v")])
    lazy = rondel.regrid(winds.chunk(time=1), "healpix:2", vectors=[("u", "v")])
    assert lazy.u.chunks is not None
    xarray.testing.assert_identical(lazy.compute(), wanted)


def test_attributes_of_components_are_filtered_as_those_of_others_are(winds):
    of_places = {"coordinates": "other", "grid_mapping": "crs", "cell_measures": "area: areas"}
    of_values = {"_FillValue": -9.0, "missing_value": -9.0, "valid_range": [-99.0, 99.0]}
    kept = {"units": "m s-1", "standard_name": "eastward_wind", "cell_methods": "time: mean"}
    winds.u.attrs = {**kept, **of_places, **of_values, "ancillary_variables": "quality t v"}
    winds.t.attrs = {"ancillary_variables": "u v"}
    winds = winds.assign(crs=0).drop_vars("v").assign(v=winds.v)
    wanted = rondel.regrid(winds, "healpix:2")
    found = rondel.regrid(winds, "healpix:2", vectors=[("u", "v")])
    kept["cell_methods"] += " area: mean"
    assert found.u.attrs == wanted.u.attrs == {**kept, "ancillary_variables": "t v"}
    of_others = {"ancillary_variables": "u v", "cell_methods": "area: mean"}
    assert found.t.attrs == wanted.t.attrs == of_others
    assert found.u.encoding == wanted.u.encoding
    assert found.u.encoding["grid_mapping"] in found.coords
    regridder = rondel.Regridder(winds, "healpix:2", "conservative")
    assert regridder(winds, vectors=[("u", "v")], keep_attrs=False).u.attrs == {}


def test_components_with_names_of_the_target_get_others(winds):
    lat = xarray.DataArray(np.arange(-80.0, 90, 10), dims="u")
    target = xarray.Dataset(coords={"lat": lat, "lon": ("v", np.arange(0.0, 360, 30))})
    wanted = rondel.regrid(winds, target.rename(u="y", v="x"), "linear", vectors=[("u", "v")])
    found = rondel.regrid(winds, target, "linear", vectors=[("u", "v")])
    for name in "uv":
        np.testing.assert_array_equal(found[f"{name}_"].values, wanted[name].values)


def test_a_component_at_other_places_is_named():
    lon, lat = np.meshgrid(np.arange(0.0, 40, 10), np.arange(0.0, 30, 10))
    of_lon, of_lat = {"units": "degrees_east"}, {"units": "degrees_north"}
    dims, wind = ("y", "x"), np.ones(lon.shape)
    data = xarray.Dataset(
        {
            "u": (dims, wind, {"coordinates": "lon_u lat_u"}),
            "v": (dims, wind, {"coordinates": "lon_v lat_v"}),
            "lon_u": (dims, lon, of_lon),
            "lat_u": (dims, lat, of_lat),
            "lon_v": (dims, lon + 5, of_lon),
            "lat_v": (dims, lat + 5, of_lat),
        }
    )
    regridder = rondel.Regridder(data[["u", "lon_u", "lat_u"]], "grid:30", "nearest_s2d")
    with (
        pytest.warns(UserWarning, match="are not those of the source: v"),
        pytest.raises(ValueError, match="'v', a component of vectors, is not at the places"),
    ):
        regridder(data, vectors=[("u", "v")])


def test_what_are_no_vectors_is_named(winds):
    for vectors, wanted in (
        ([("u", "w")], "'w', a component of vectors, is no variable"),
        ([("u", "u")], "'u' is a component of vectors twice"),
        ([("u", "flat")], "'u' and 'flat' have different dimensions"),
    ):
        data = winds.assign(flat=winds.u[0])
        with pytest.raises(ValueError, match=wanted):
            rondel.regrid(data, "grid:30", vectors=vectors)
    with pytest.raises(TypeError, match="vectors are variables of a Dataset"):
        rondel.regrid(winds.u, "grid:30", vectors=[("u", "v")])


def test_a_mask_is_a_field_here(winds, tmp_path):
    pytest.importorskip("netCDF4")
    mask = np.ones((18, 36))
    mask[:, :18] = 0
    data = winds.assign(mask=(("lat", "lon"), mask))
    data.to_netcdf(tmp_path / "in.nc")
    report = rondel.regrid_file(tmp_path / "in.nc", "grid:30", tmp_path / "out.nc")
    assert any('"mask" is a field as others' in remark for remark in report.remarks)
    with pytest.warns(UserWarning, match="'mask' of the data masks nothing here"):
        found = rondel.regrid(data, "grid:30")
    with xarray.open_dataset(tmp_path / "out.nc") as wanted:
        for name in ("t", "mask"):
            np.testing.assert_array_equal(found[name].values, wanted[name].values)
    assert np.isfinite(found.t.values).all()
    target = xarray.Dataset(coords=data.coords).assign(mask=data.mask)
    with pytest.warns(UserWarning, match="'mask' of the target masks nothing here"):
        on_target = rondel.regrid(winds[["t"]], target)
    assert np.isfinite(on_target.t.values).all()
    assert np.isnan(rondel.Regridder(data, "grid:30", "nearest_s2d")(winds).u.values).sum() == 0


def test_attributes_and_variables_do_not_change_what_data_are(winds):
    named = winds.assign_attrs(name="a model").assign(mask=winds.t[0] * 0)
    with pytest.warns(UserWarning, match="'mask' of the data masks nothing here"):
        found = rondel.regrid(named, "grid:30")
    assert np.isfinite(found.t.values).all()
    with pytest.warns(UserWarning, match="'mask' of the target masks nothing here"):
        found = rondel.regrid(winds[["t"]], named)
    assert np.isfinite(found.t.values).all()
    array = winds.t[0].assign_attrs(columns="a word", data_vars="another", geom_type="a third")
    wanted = rondel.regrid(winds.t[0], "grid:30")
    np.testing.assert_array_equal(rondel.regrid(array, "grid:30"), wanted)
    np.testing.assert_array_equal(rondel.regrid(winds.t[0], array), winds.t[0])
    assert len(rondel.zonal_statistics(array, "grid:90")) == 8
    lon = array.lon.assign_attrs(geom_type="a word")
    assert rondel.unit_vectors(lon, 0.0).shape == (36, 3)
    properties = {"note": xarray.DataArray([1, 2, 3, 4], attrs={"columns": "a word"})}
    lon, lat = [0, 90, 180, -90], [0, 0, 60, -60]
    frame = rondel.SphericalVoronoi.from_lonlat(lon, lat).to_geojson(properties=properties)
    assert [feature["properties"]["note"] for feature in frame["features"]] == [1, 2, 3, 4]


def test_longitudes_and_latitudes_may_differ_in_dimensions(winds):
    lon, lat = np.meshgrid(np.arange(0.0, 90, 30), np.arange(0.0, 60, 20))
    for target in ({"lat": ("y", lat[:, 0]), "lon": ("x", lon[0])},):
        wanted = xarray.Dataset(coords=target)
        found = rondel.regrid(winds, wanted, "linear")
        assert found.t.shape == (2, 3, 3)
        assert np.isfinite(found.t.values).all()
        turned = rondel.regrid(found, "grid:30", "nearest")
        assert turned.t.shape == (2, 6, 12)
        empty = rondel.regrid(winds.drop_vars(["t", "u", "v"]), wanted, "linear")
        assert not empty.data_vars
        assert {"lon", "lat"} <= set(empty.coords)
        assert rondel.regrid(winds.t[0], wanted, "linear").shape == (3, 3)


def test_unlimited_dimensions_stay(winds):
    winds.encoding["unlimited_dims"] = {"time"}
    assert rondel.regrid(winds, "grid:30").encoding.get("unlimited_dims") == {"time"}
    winds.encoding["unlimited_dims"] = {"time", "lat"}
    found = rondel.regrid(winds, "healpix:1", vectors=[("u", "v")])
    assert found.encoding.get("unlimited_dims") == {"time"}


@pytest.mark.parametrize(
    ("east", "north", "why"),
    [
        ({"standard_name": "northward_wind"}, {"standard_name": "eastward_wind"}, "no eastward"),
        ({"standard_name": "eastward_wind"}, {"standard_name": "air_temperature"}, "no northward"),
        ({"standard_name": "grid_eastward_wind"}, {}, "which is no eastward component"),
        (
            {"standard_name": "eastward_wind"},
            {"standard_name": "northward_sea_water_velocity"},
            "which are different vectors",
        ),
        ({"units": "m s-1"}, {"units": "km h-1"}, "'u' has the units 'm s-1', and 'v' 'km h-1'"),
        ({}, {"flag_values": np.array([1, 2], "i4")}, "'v' has flags"),
        ({"flag_meanings": "calm storm"}, {}, "'u' has flags"),
    ],
)
def test_components_that_the_data_say_are_none_are_refused(winds, east, north, why, tmp_path):
    pytest.importorskip("netCDF4")
    winds.u.attrs, winds.v.attrs = east, north
    with pytest.raises(ValueError, match=why):
        rondel.regrid(winds, "grid:9x7", vectors=[("u", "v")])
    winds.to_netcdf(tmp_path / "in.nc")
    with pytest.raises(OSError, match=why):
        rondel.regrid_file(
            tmp_path / "in.nc", "grid:9x7", tmp_path / "out.nc", vectors=[("u", "v")]
        )


@pytest.mark.parametrize(
    ("east", "north"),
    [
        ({"standard_name": "eastward_wind"}, {"standard_name": "northward_wind"}),
        ({"standard_name": "x_wind"}, {"standard_name": "y_wind"}),  # along axes
        ({"standard_name": "unknown"}, {"standard_name": "unknown"}),
        ({"units": "m s-1"}, {"units": "m/s"}),
        ({"units": "m s**-1"}, {"units": "meters per second"}),
        ({"units": "kg.m-1.s-2"}, {"units": "kg/m/s^2"}),
        ({"units": "m s-1"}, {}),
    ],
)
def test_other_components_are_those_without_attributes(winds, east, north):
    wanted = rondel.regrid(winds, "grid:9x7", vectors=[("u", "v")])
    winds.u.attrs, winds.v.attrs = east, north
    found = rondel.regrid(winds, "grid:9x7", vectors=[("u", "v")])
    for name in ("u", "v"):
        np.testing.assert_array_equal(found[name], wanted[name])
        assert found[name].attrs == {**winds[name].attrs, "cell_methods": "area: mean"}


def test_vectors_have_no_largest_share(winds):
    with pytest.raises(ValueError, match="vectors have no largest share"):
        rondel.regrid(winds, "grid:9x7", "largest_share", vectors=[("u", "v")])
    regridder = rondel.Regridder(winds, "grid:9x7", "conservative")
    with pytest.raises(ValueError, match="vectors have no largest share"):
        regridder(winds, how="largest_share", vectors=iter([("u", "v")]))
    # Other arrays may have categories beside vectors.
    found = regridder(winds, how="by_kind", vectors=iter([("u", "v")]))
    np.testing.assert_array_equal(found.u, regridder(winds, vectors=[("u", "v")]).u)
