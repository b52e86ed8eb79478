# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Data on pixels of HEALPix: all of them, some of them, and in any order."""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
pytest.importorskip("netCDF4")
import rondel.xarray  # noqa: E402

CELLS = rondel.CellSet.named("healpix:3:ring")
FIELD = np.cos(np.radians(CELLS._degrees()[:, 1])) + np.sin(np.radians(CELLS._degrees()[:, 0]))
NORTH = np.arange(300)


def pixels(numbers, dim="cell", *, places=False, mapping=None, with_numbers=True, attrs=None):
    """A Dataset on some pixels, as tools for HEALPix have it."""
    texts = {"grid_mapping_name": "healpix", "refinement_level": 3, "indexing_scheme": "ring"}
    data = xarray.Dataset(
        {"t": (dim, FIELD[numbers], {"grid_mapping": "crs"}), "crs": ((), 0, mapping or texts)}
    )
    if with_numbers:
        data = data.assign_coords({dim: (dim, np.asarray(numbers), attrs or {})})
    if places:
        lon, lat = CELLS._degrees()[numbers].T
        data = data.assign_coords(
            lon=(dim, lon, {"units": "degrees_east"}), lat=(dim, lat, {"units": "degrees_north"})
        )
    return data


def regridded(data, folder, target, method):
    """The field by `regrid`, and by `regrid_file`, which are the same."""
    found = rondel.regrid(data, target, method).t.values
    data.to_netcdf(folder / "in.nc")
    rondel.regrid_file(folder / "in.nc", target, folder / "out.nc", method=method)
    with xarray.open_dataset(folder / "out.nc") as file:
        np.testing.assert_allclose(file.t.values, found, rtol=1e-12)
    return found


@pytest.mark.parametrize(
    "mapping",
    [
        {"grid_mapping_name": "HEALPix", "refinement_level": 3, "indexing_scheme": "RING"},
        {"grid_mapping_name": "healpix", "healpix_nside": 8, "healpix_order": "Ring"},
    ],
)
def test_attributes_have_any_case_of_letters(tmp_path, mapping):
    found = regridded(pixels(np.arange(768), mapping=mapping), tmp_path, "grid:30", "conservative")
    wanted = regridded(pixels(np.arange(768)), tmp_path, "grid:30", "conservative")
    np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize("method", ["conservative", "nearest", "linear"])
@pytest.mark.parametrize("dim", ["cell", "healpix_index", "cell_ids"])
def test_numbers_say_which_pixels_there_are(tmp_path, dim, method):
    data = pixels(NORTH, dim)
    found = regridded(data, tmp_path, "grid:30", method)
    lon, lat = CELLS._degrees()[NORTH].T
    if method == "conservative":
        whole = pixels(np.arange(768))
        whole["t"] = whole.t.where(whole.cell < len(NORTH))
        np.testing.assert_allclose(found, rondel.regrid(whole, "grid:30").t, rtol=1e-12)
    else:
        points = xarray.Dataset(
            {"t": ("n", FIELD[NORTH])},
            {
                "lon": ("n", lon, {"units": "degrees_east"}),
                "lat": ("n", lat, {"units": "degrees_north"}),
            },
        )
        np.testing.assert_allclose(found, rondel.regrid(points, "grid:30", method).t, rtol=1e-12)


@pytest.mark.parametrize("places", [False, True])
@pytest.mark.parametrize("with_numbers", [False, True])
def test_the_order_of_pixels_is_that_of_their_numbers_or_places(tmp_path, places, with_numbers):
    if not places and not with_numbers:
        return
    turned = pixels(np.arange(768)[::-1], places=places, with_numbers=with_numbers)
    for method in ("conservative", "nearest"):
        found = regridded(turned, tmp_path, "grid:30", method)
        wanted = regridded(pixels(np.arange(768)), tmp_path, "grid:30", method)
        np.testing.assert_allclose(found, wanted, rtol=1e-12)


@pytest.mark.parametrize("kept", [np.arange(768)[::-1], np.arange(20, 400)[::-1]])
@pytest.mark.parametrize(
    ("name", "dim"), [("cells", "ncells"), ("any", "any"), ("ipix", "n"), ("ring_number", "n")]
)
def test_lists_of_pixels_have_many_names_and_are_no_fields(tmp_path, name, dim, kept):
    data = pixels(kept, dim, with_numbers=False)
    data = data.assign({name: (dim, kept)}) if name != dim else data.assign_coords({dim: kept})
    data = data.assign(more=(("time", dim), [FIELD[kept], FIELD[kept] + 1]))
    found = regridded(data, tmp_path, "grid:30", "conservative")
    # The values in the order of the pixels need no list.
    whole = pixels(np.arange(768), with_numbers=False)
    whole["t"] = whole.t.where(np.isin(np.arange(768), kept))
    wanted = rondel.regrid(whole, "grid:30").t
    np.testing.assert_allclose(found, wanted, rtol=1e-12)
    assert list(rondel.regrid(data, "grid:30").data_vars) == ["t", "more"]
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        assert list(file.data_vars) == ["t", "more"]


@pytest.mark.parametrize("is_coordinate", [False, True])
def test_lists_of_pixels_are_no_fields_of_another_source(tmp_path, is_coordinate):
    data = pixels(np.arange(768), with_numbers=False).assign(ipix=("cell", np.arange(768)))
    turned = data.isel(cell=slice(None, None, -1))
    if is_coordinate:
        data, turned = data.set_coords("ipix"), turned.set_coords("ipix")
    wanted = rondel.regrid(data, "grid:30")
    regridder = rondel.Regridder("healpix:3:ring", "grid:30", "conservative")
    found = regridder(data)
    assert list(found.data_vars) == ["t"]
    np.testing.assert_array_equal(found.t, wanted.t)
    data.to_netcdf(tmp_path / "in.nc")
    turned.to_netcdf(tmp_path / "turned.nc")
    rondel.regrid_file(tmp_path / "in.nc", "grid:30", tmp_path / "out.nc", source="healpix:3:ring")
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        assert list(file.data_vars) == ["t"]
    why = "has the numbers of pixels that are at other places than the source"
    for source, name, given in (
        ("healpix:3:ring", "turned.nc", turned),
        ("healpix:3", "in.nc", data),
    ):
        with pytest.raises(ValueError, match=why):
            rondel.Regridder(source, "grid:30", "conservative")(given)
        with pytest.raises(ValueError, match=why):
            rondel.regrid_file(tmp_path / name, "grid:30", tmp_path / "out.nc", source=source)


def test_other_integers_on_pixels_are_fields(tmp_path):
    counts = np.arange(768) % 7
    data = pixels(np.arange(768), with_numbers=False).assign(
        cell_number=("cell", counts), nest_index=("cell", np.arange(768)[::-1])
    )
    regridded(data, tmp_path, "grid:30", "conservative")
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        assert set(file.data_vars) == {"t", "cell_number", "nest_index"}
        np.testing.assert_allclose(
            file.cell_number, rondel.regrid(data, "grid:30").cell_number, rtol=1e-12
        )
    # The grid as the source says that values are in the order of the pixels.
    unclear = data.assign(place=("cell", np.arange(768)[::-1]))
    found = rondel.Regridder("healpix:3:ring", "grid:30", "conservative")(unclear)
    np.testing.assert_array_equal(found.t, rondel.regrid(data, "grid:30").t)
    unclear.to_netcdf(tmp_path / "in.nc")
    rondel.regrid_file(tmp_path / "in.nc", "grid:30", tmp_path / "out.nc", source="healpix:3:ring")
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        np.testing.assert_allclose(file.t, found.t, rtol=1e-12)


def test_places_of_some_pixels_have_their_cells(tmp_path):
    found = regridded(
        pixels(NORTH, places=True, with_numbers=False), tmp_path, "grid:30", "conservative"
    )
    np.testing.assert_allclose(
        found, regridded(pixels(NORTH), tmp_path, "grid:30", "conservative"), rtol=1e-12
    )


def test_some_pixels_are_targets_and_places():
    data = xarray.DataArray(
        np.arange(72.0).reshape(6, 12),
        {"lat": np.arange(-75.0, 90, 30), "lon": np.arange(-165.0, 180, 30)},
        ("lat", "lon"),
        name="v",
    )
    some = rondel.regrid(data, pixels(NORTH))
    assert some.dims == ("cell",)
    np.testing.assert_allclose(
        some.values, rondel.regrid(data, "healpix:3:ring").values[NORTH], rtol=1e-12
    )
    lon, lat = CELLS._degrees()[[3, 250]].T
    near = pixels(NORTH).rondel.interpolate((lon, lat), "nearest")
    np.testing.assert_array_equal(near.t.values, FIELD[[3, 250]])


@pytest.mark.parametrize(("places", "with_numbers"), [(False, True), (True, True), (True, False)])
def test_pictures_of_some_pixels_cover_no_more_than_these(places, with_numbers):
    plt = pytest.importorskip("matplotlib.pyplot")
    data = pixels(NORTH[:24], places=places, with_numbers=with_numbers)
    ax = data.rondel.plot("t", plt.figure().add_subplot(), coast=False)
    (drawn,) = (each for each in ax.collections if each.get_array() is not None)
    corners = np.concatenate([path.vertices for path in drawn.get_paths()])
    assert corners[:, 1].min() > 66
    plt.close("all")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (pixels(NORTH, with_numbers=False), "are on 'healpix:3:ring' with 768 pixels, but no dim"),
        (
            pixels(NORTH, mapping={"grid_mapping_name": "healpix", "refinement_level": 3}),
            "'crs' is the grid mapping of HEALPix, but has no indexing_scheme",
        ),
        (
            pixels(
                NORTH,
                mapping={
                    "grid_mapping_name": "healpix",
                    "refinement_level": 3,
                    "indexing_scheme": "nested_unique",
                },
            ),
            "'crs' is the grid mapping of HEALPix, but has no order that is read, nested or ring: "
            'its indexing_scheme is "nested_unique"',
        ),
        (
            pixels(np.arange(3), attrs={"standard_name": "healpix_index"}).assign_coords(
                cell=("cell", [1, 2, 768], {"standard_name": "healpix_index"})
            ),
            "variable 'cell' has the number 768, which is not one of the 768 pixels",
        ),
        (
            pixels(np.arange(3)).assign_coords(
                cell=("cell", [1, 2, 1], {"standard_name": "healpix_index"})
            ),
            "variable 'cell' has the number 1 of a pixel twice",
        ),
        (pixels([5, 5, 6]), "variable 'cell' has the number 5 of a pixel twice"),
        (
            pixels(np.arange(768)[::-1], "n", with_numbers=False).assign_coords(
                place=("n", np.arange(768)[::-1])
            ),
            "'place' may have the numbers of the pixels of 'healpix:3:ring'",
        ),
        (
            pixels([3, 5, 6], "n", with_numbers=False).assign(place=("n", [3, 5, 6])),
            "'place' may have the numbers of the pixels of 'healpix:3:ring'",
        ),
    ],
)
def test_what_is_missing_is_named(tmp_path, data, message):
    with pytest.raises(ValueError, match=message):
        rondel.regrid(data, "grid:30")
    data.to_netcdf(tmp_path / "in.nc")
    with pytest.raises(OSError, match=r"grid mapping of|has the number|may have the numbers"):
        rondel.regrid_file(tmp_path / "in.nc", "grid:30", tmp_path / "out.nc")


@pytest.mark.parametrize(
    ("shape", "is_way_out"), [((6, 4, 4), False), ((1, 96), False), ((8, 12), True)]
)
def test_corners_are_not_made_of_what_is_no_grid_of_rows(shape, is_way_out):
    lon, lat = rondel.CellSet.named("C4")._degrees().T
    dims = ("f", "j", "i")[-len(shape) :]
    data = xarray.Dataset(
        {"t": (dims, lat.reshape(shape))},
        {
            "lon": (dims, lon.reshape(shape), {"units": "degrees_east"}),
            "lat": (dims, lat.reshape(shape), {"units": "degrees_north"}),
        },
    )
    with pytest.raises(ValueError, match="there are no corners of cells") as told:
        rondel.regrid(data, "grid:30")
    assert ("corners='made'" in str(told.value)) == is_way_out


def test_a_cubed_sphere_with_its_faces_upside_down_has_its_cells(tmp_path):
    lon, lat = rondel.CellSet.named("C4")._degrees().reshape(6, 4, 4, 2).transpose(3, 0, 1, 2)
    dims = ("tile", "y", "x")
    data = xarray.Dataset(
        {"t": (dims, np.sin(np.radians(lon)) + lat / 90, {"coordinates": "lon lat"})},
        {
            "lon": (dims, lon, {"units": "degrees_east"}),
            "lat": (dims, lat, {"units": "degrees_north"}),
        },
        {"rondel_grid": "C4"},
    )
    wanted = rondel.regrid(data, "grid:30").t
    turned = data.isel(y=slice(None, None, -1))
    turned.t.attrs.clear()
    found = regridded(turned, tmp_path, "grid:30", "conservative")
    np.testing.assert_allclose(found, wanted, rtol=1e-9)
