# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What stands beside the fields of a Dataset that is regridded: bounds, coordinates, attributes
that name variables; and that it is what the command writes.
"""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")

LON, LAT = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
PLACE = ("lat", "lon")
ONES = np.ones((18, 36))


def dataset(**variables):
    axes = {
        "lat": ("lat", LAT, {"units": "degrees_north"}),
        "lon": ("lon", LON, {"units": "degrees_east"}),
    }
    return xarray.Dataset(variables, axes)


def written(data, target, tmp_path, **options):
    """The result of the command for the same data."""
    data.to_netcdf(tmp_path / "in.nc", engine="netcdf4")
    rondel.regrid_file(tmp_path / "in.nc", target, tmp_path / "out.nc", **options)
    with xarray.open_dataset(tmp_path / "out.nc", engine="netcdf4") as found:
        return found.load()


def attributes(data):
    """Those that name variables, in a file."""
    names = ("formula_terms", "ancillary_variables", "bounds", "compress", "cell_measures")
    found = {}
    for name, item in data.variables.items():
        texts = {**item.encoding, **item.attrs}
        found[name] = {key: texts[key] for key in names if key in texts}
    return {name: texts for name, texts in found.items() if texts}


def hybrid():
    data = dataset(
        a=("lev", [0.1, 0.2]),
        b=("lev", [0.3, 0.4]),
        p0=1e5,
        ps=(PLACE, ONES),
        cell=(PLACE, 3 * ONES),
        ta=(("lev", *PLACE), np.ones((2, 18, 36)), {"ancillary_variables": "cell zonal p0"}),
        zonal=("lat", LAT),
        few_values=("few", [5.0, 6, 7]),
        lev_sides=(("lev", "side"), [[0, 1.5], [1.5, 2]], {"formula_terms": "a: a b: zonal"}),
    )
    terms = {"formula_terms": "a: a b: b p0: p0 ps: ps", "bounds": "lev_sides"}
    return data.assign_coords(
        lev=("lev", [1.0, 2], terms), few=("few", [0, 1, 3], {"compress": "lev side"})
    )


@pytest.mark.parametrize("target", ["grid:30", "healpix:1"])
@pytest.mark.filterwarnings("ignore:left out")
def test_attributes_name_what_is_there_as_in_files(target, tmp_path):
    data = hybrid()
    before = data.copy(deep=True)
    found = rondel.regrid(data, target)
    xarray.testing.assert_identical(data, before)
    assert data.lev.attrs == before.lev.attrs
    cell = "cell" if target == "grid:30" else "cell_"
    wanted = {
        "lev": {"formula_terms": "a: a b: b p0: p0 ps: ps", "bounds": "lev_sides"},
        "ta": {"ancillary_variables": f"{cell} p0"},
        "few": {"compress": "lev side"},
    }
    assert attributes(found) == wanted
    assert attributes(written(data, target, tmp_path)) == wanted


def test_a_field_with_a_name_of_the_target_gives_way(tmp_path):
    data = dataset(cell=(PLACE, 3 * ONES), t=("time", [1.0, 2]))
    data["cell"].attrs["units"] = "K"
    for target, name in (("healpix:1", "cell_"), ("grid:30", "cell")):
        found = rondel.regrid(data[["cell", "t"]], target)
        assert list(found.data_vars) == [name, "t"]
        assert found[name].attrs == {"units": "K", "cell_methods": "area: mean"}
        np.testing.assert_allclose(found[name], 3, rtol=1e-14)
        file = written(data[["cell", "t"]], target, tmp_path)
        np.testing.assert_allclose(file[name], found[name], rtol=1e-15)
        assert rondel.regrid(data["cell"], target).name == name
    # A Regridder without attributes does the same.
    assert list(rondel.Regridder(data, "healpix:1", "conservative")(data[["cell"]]).data_vars) == [
        "cell_"
    ]


@pytest.mark.parametrize("is_coordinate", [False, True])
def test_places_that_are_gathered_are_left_out_with_their_index(is_coordinate):
    land = np.flatnonzero(np.random.default_rng(4).uniform(size=648) < 0.4)
    data = dataset(t=(PLACE, ONES), gpp=("land", np.ones(len(land))))
    data["land"] = ("land", land, {"compress": "lat lon"})
    if not is_coordinate:
        data = data.reset_coords(drop=False)
    with pytest.warns(UserWarning, match="left out, as they are compressed by gathering: gpp$"):
        found = rondel.regrid(data, "grid:20")
    assert [*found.variables] == ["t", "lat", "lon"]
    assert "land" not in found.sizes


def test_areas_of_cells_are_left_out(tmp_path):
    data = dataset(
        areacella=(PLACE, ONES, {"standard_name": "cell_area", "units": "m2"}),
        vol=(PLACE, ONES),
        tas=(PLACE, ONES, {"cell_measures": "area: areacella volume: vol"}),
    )
    with pytest.warns(UserWarning, match="areas or volumes of cells: areacella, vol$"):
        found = rondel.regrid(data, "grid:30")
    assert list(found.data_vars) == ["tas"]
    assert attributes(found) == {}
    assert list(written(data, "grid:30", tmp_path).data_vars) == ["tas"]
    # One array is meant.
    assert rondel.regrid(data["areacella"], "grid:30").name == "areacella"


NODE_LON, NODE_LAT = np.meshgrid(np.arange(6) * 11.0 + 160, np.arange(5) * 9.0 - 11)
NODES = NODE_LON + 0.2 * NODE_LAT, NODE_LAT + 0.05 * (NODE_LON - 160)
CORNERS = [
    np.stack([each[:-1, :-1], each[:-1, 1:], each[1:, 1:], each[1:, :-1]], -1) for each in NODES
]
EDGES = np.array([-30.0, 50, 110, 330]), np.array([90.0, 61, 45, -20, -90])


@pytest.mark.parametrize("kind", ["corners", "lines"])
def test_bounds_of_a_set_of_cells_can_be_read_again(kind, tmp_path):
    data = dataset(t=(PLACE, np.add.outer(LAT, 0.1 * LON)))
    if kind == "corners":
        cells = rondel.CellSet.corners(*(each.reshape(20, 4) for each in CORNERS))
    else:
        cells = rondel.CellSet.lonlat_grid(*EDGES)
    found = rondel.regrid(data, cells)
    assert found.lat.attrs["bounds"] == "lat_bnds"
    if kind == "corners":
        assert found.lon_bnds.dims == ("cell", "nv")
        # A ring may begin at another corner.
        for values, corners in zip((found.lon_bnds % 360, found.lat_bnds), CORNERS, strict=True):
            wanted = np.sort(corners.reshape(20, 4))
            np.testing.assert_allclose(np.sort(values), wanted, atol=1e-11)
        assert (abs(found.lon_bnds - found.lon) <= 180).all()
    else:
        for name, edges in zip(("lon", "lat"), EDGES, strict=True):
            np.testing.assert_array_equal(
                found[f"{name}_bnds"], np.stack([edges[:-1], edges[1:]], 1)
            )
    again = rondel.Regridder(cells, "grid:6", "conservative_normed", max_uncovered=0.5)(found.t)
    found.to_netcdf(tmp_path / "out.nc", engine="netcdf4")
    with xarray.open_dataset(tmp_path / "out.nc", engine="netcdf4") as opened:
        for source in (found, opened):
            np.testing.assert_allclose(rondel.regrid(source, "grid:6").t, again, atol=1e-12)
    rondel.regrid_file(tmp_path / "out.nc", "grid:6", tmp_path / "again.nc")
    with xarray.open_dataset(tmp_path / "again.nc", engine="netcdf4") as opened:
        np.testing.assert_allclose(opened.t, again, atol=1e-12)


def test_bounds_of_files_are_those_of_datasets(tmp_path):
    """The cells of a curvilinear file: what the command writes of them is what they were."""
    grid = xarray.Dataset(
        {"lon_edges": (("j", "i", "k"), CORNERS[0]), "lat_edges": (("j", "i", "k"), CORNERS[1])},
        {
            "lon": (("j", "i"), CORNERS[0].mean(-1), {"units": "degrees_east"}),
            "lat": (("j", "i"), CORNERS[1].mean(-1), {"units": "degrees_north"}),
        },
    )
    for name in ("lon", "lat"):
        grid[name].attrs["bounds"] = f"{name}_edges"
    grid.to_netcdf(tmp_path / "grid.nc", engine="netcdf4")
    data = dataset(t=(PLACE, np.add.outer(LAT, 0.1 * LON)))
    own = rondel.regrid(data, grid)
    for options in ({}, {"method": "linear"}):
        file = written(data, tmp_path / "grid.nc", tmp_path, **options)
        for name in ("lon", "lat"):
            there = file[file[name].attrs["bounds"]].values
            np.testing.assert_allclose(np.sort(there), np.sort(own[f"{name}_edges"]), atol=1e-12)
        again = rondel.regrid(own.assign(t=(("j", "i"), file.t.values)), "grid:6").t
        np.testing.assert_allclose(rondel.regrid(file, "grid:6").t, again, atol=1e-12)
