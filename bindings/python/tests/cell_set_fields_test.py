# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regridder between cell sets, grids of two dimensions and fields: which fields are at their
places, by whatever names, and which shapes come back.
"""

import clouds
import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402 (needs xarray)

LON, LAT = np.arange(-157.5, 180, 45), np.array([-67.5, -22.5, 22.5, 67.5])
TARGET = {"lon": LON, "lat": LAT}
SOURCES = {
    "grid": rondel.lonlat_grid(8, 4),
    "centers": rondel.CellSet.lonlat_centers(LON, LAT),
    "two dimensions": dict(zip(("lon", "lat"), np.meshgrid(LON, LAT), strict=True)),
    "axes": TARGET,
}


def latitudes(lat=LAT, dims=("lat", "lon")):
    """A field whose value is its own latitude, without attributes on the coordinates."""
    values = np.repeat(lat[:, None], len(LON), 1)
    return xarray.DataArray(values, [lat, LON], dims, name="t")


@pytest.mark.parametrize("source", SOURCES)
def test_fields_upside_down_are_refused_whatever_the_source_is(source):
    regridder = rondel.Regridder(SOURCES[source], TARGET, "nearest_s2d")
    for dims in (("lat", "lon"), ("latitude", "longitude")):
        field = latitudes(dims=dims)
        turned = field.assign_coords({dims[1]: LON % 360}).expand_dims(time=2)
        for right in (field, turned):
            found = regridder(right)
            assert (found.transpose("lon", ..., "lat") == LAT).all()
        for wrong in (latitudes(LAT[::-1], dims), field.roll({dims[1]: 1}, roll_coords=True)):
            with pytest.raises(ValueError, match="not th"):
                regridder(wrong)


def test_a_dimension_in_the_way_is_told():
    regridder = rondel.Regridder(SOURCES["two dimensions"], TARGET, "nearest_s2d")
    with pytest.raises(ValueError, match="dimension 'y' that is not the source's"):
        regridder(latitudes().expand_dims(y=2))


def test_places_of_a_grid_are_the_middles_of_its_cells():
    regridder = rondel.Regridder(TARGET, rondel.lonlat_grid(8, 4), "nearest_s2d")
    found = regridder(latitudes())
    assert found.dims == ("lat", "lon")
    assert np.array_equal(found.lat, LAT)
    assert np.array_equal(found.lon, LON)


def mesh_file(path, kind):
    """A file of a mesh whose fields are at the cells' sites, which are no centers of mass; the
    name of the dimension of cells, and the names of their coordinates.
    """
    mesh = rondel.mesh.from_points(clouds.uniform(80, 5))
    getattr(mesh, f"to_{kind}")(path)
    with xarray.open_dataset(path) as file:
        made = file.load()
    names = {"mpas": ("lonCell", "latCell"), "scrip": ("grid_center_lon", "grid_center_lat")}
    lon, lat = names[kind]
    (dim,) = made[lon].dims
    degrees = rondel.lonlat(mesh.points)
    assert np.abs(degrees - rondel.lonlat(rondel.CellSet.read(path).centers)).max() > 0.1
    made = made.assign(t=(("lev", dim), np.stack([degrees[:, 1], degrees[:, 0]])))
    return made, dim, (lon, lat)


@pytest.mark.parametrize("kind", ["mpas", "scrip"])
def test_fields_of_the_file_of_a_cell_set_are_taken(tmp_path, kind):
    ds, dim, (lon, lat) = mesh_file(tmp_path / "mesh.nc", kind)
    cells = rondel.CellSet.read(tmp_path / "mesh.nc")
    for method in ("conservative", "nearest_s2d"):
        regridder = rondel.Regridder(cells, TARGET, method)
        plain = regridder(ds.t.values)
        field = ds.set_coords([lon, lat]).t
        for data in (field, ds.t, field.rename({dim: "n"})):
            np.testing.assert_array_equal(regridder(data), plain)
        np.testing.assert_array_equal(regridder(ds[[lon, lat, "t"]]).t, plain)
        with pytest.raises(ValueError, match=f"'t' are at {lon} and {lat}"):
            regridder(field[:, ::-1])


def test_cells_of_a_grid_along_one_dimension(tmp_path):
    """As SCRIP has them with `grid_dims`, while the cell set is (nlat, nlon)."""
    west, south = np.meshgrid(np.arange(0, 360, 30.0), np.arange(-90, 90, 30.0))
    corners = {
        "lon": np.stack([west, west + 30, west + 30, west], -1),
        "lat": np.stack([south, south, south + 30, south + 30], -1),
    }
    ds = xarray.Dataset({"grid_dims": ("grid_rank", np.array([12, 6], np.int32))})
    for kind, middle in (("lon", west + 15), ("lat", south + 15)):
        ds[f"grid_center_{kind}"] = ("grid_size", middle.ravel(), {"units": "degrees"})
        values = corners[kind].reshape(72, 4)
        ds[f"grid_corner_{kind}"] = (("grid_size", "grid_corners"), values, {"units": "degrees"})
    ds["h"] = (("time", "grid_size"), np.random.default_rng(2).normal(size=(3, 72)))
    encoding = {name: {"_FillValue": None} for name in ds.variables}
    ds.to_netcdf(tmp_path / "grid.nc", format="NETCDF3_CLASSIC", encoding=encoding)
    regridder = rondel.Regridder(rondel.CellSet.read(tmp_path / "grid.nc"), TARGET, "conservative")
    assert regridder.shape_in == (6, 12)
    plain = regridder(ds.h.values.reshape(3, 6, 12))
    np.testing.assert_array_equal(regridder(ds.h), plain)
    np.testing.assert_array_equal(regridder(ds).h, plain)
    at_places = ds.set_coords(["grid_center_lon", "grid_center_lat"]).h
    np.testing.assert_array_equal(regridder(at_places), plain)
    with pytest.raises(ValueError, match="'h' are at grid_center_lon"):
        regridder(at_places[:, ::-1])


@pytest.mark.parametrize("method", ["bilinear", "nearest_s2d", "linear"])
def test_targets_that_repeat_keep_their_shape(method):
    columns = np.broadcast_to([5.0, 20, 65], (2, 3))
    grids = (
        {"lon": np.full((2, 3), 5.0), "lat": np.full((2, 3), 5.0)},
        {"lon": columns, "lat": 0 * columns},
        xarray.Dataset(coords={"lon": (("y", "x"), columns), "lat": (("y", "x"), 0 * columns)}),
    )
    field = latitudes()
    for grid in grids:
        regridder = rondel.Regridder(TARGET, grid, method)
        assert regridder.shape_out == (2, 3)
        found = regridder(field.values)
        assert found.shape == (2, 3)
        assert np.array_equal(found[0], found[1])
    by_accessor = field.rondel.interpolate((columns, 0 * columns), "linear")
    assert by_accessor.shape == (2, 3)
    # A time is still none of the dimensions.
    dims = ("Time", "y", "x")
    lon, lat = np.broadcast_arrays(*np.meshgrid([5.0, 20, 65], [0.0, 9]), np.zeros((4, 2, 3)))[:2]
    moving = xarray.Dataset(coords={"XLONG": (dims, lon), "XLAT": (dims, lat)})
    assert rondel.Regridder(TARGET, moving, method).shape_out == (2, 3)
    assert rondel.Regridder(moving, TARGET, "nearest_s2d").shape_in == (2, 3)
