# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Datasets with a mesh by UGRID, MPAS, SCRIP or ESMF as source and target: their cells are those of
the arrays, read as the tool reads them from a file.
"""

import clouds
import numpy as np
import pytest

import rondel
import rondel.xarray

xarray = pytest.importorskip("xarray")
N = 60
NODES = ("node_lon", "node_lat")


def voronoi():
    """Cells, the corners of each in a row that ends with -1, and the places of cells and nodes."""
    tri = rondel.delaunay(clouds.uniform(N, 5))
    cells = rondel.CellSet.voronoi(tri)
    _, rings, corners, points = cells.rings
    sizes = np.diff(rings)
    rows = np.full((N, sizes.max()), -1)
    rows[np.arange(rows.shape[1]) < sizes[:, None]] = corners
    return cells, rows, rondel.lonlat(tri.points), rondel.lonlat(points)


CELLS, ROWS, CENTERS, POINTS = voronoi()
VALUES = np.random.default_rng(7).random(N)
EAST, NORTH = {"units": "degrees_east"}, {"units": "degrees_north"}


def ugrid():
    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": " ".join(NODES),
        "face_coordinates": "face_lon face_lat",
        "face_node_connectivity": "corners",
    }
    made = xarray.Dataset(
        {
            "mesh": ((), 0, topology),
            "corners": (("face", "nv"), ROWS, {"start_index": 0, "_FillValue": -1}),
            "x": ("face", VALUES, {"mesh": "mesh", "location": "face"}),
        }
    )
    for kind, places in (("node", POINTS), ("face", CENTERS)):
        made[f"{kind}_lon"] = (kind, places[:, 0], EAST)
        made[f"{kind}_lat"] = (kind, places[:, 1], NORTH)
    return made


def ugrid_without_centers():
    made = ugrid().drop_vars(["face_lon", "face_lat"])
    del made.mesh.attrs["face_coordinates"]
    return made


def mpas():
    made = xarray.Dataset(
        {
            "verticesOnCell": (("nCells", "maxEdges"), np.maximum(ROWS + 1, 0)),
            "nEdgesOnCell": ("nCells", (ROWS >= 0).sum(axis=1)),
            "x": ("nCells", VALUES),
        }
    )
    for kind, dim, places in (("Vertex", "nVertices", POINTS), ("Cell", "nCells", CENTERS)):
        made[f"lon{kind}"] = (dim, np.radians(places[:, 0]))
        made[f"lat{kind}"] = (dim, np.radians(places[:, 1]))
    return made


def scrip():
    filled = np.where(ROWS < 0, ROWS[:, :1], ROWS)
    made = xarray.Dataset({"x": ("grid_size", VALUES), "grid_dims": ("grid_rank", [N])})
    made["grid_imask"] = ("grid_size", np.ones(N, np.int32))
    for k, (kind, units) in enumerate((("lon", EAST), ("lat", NORTH))):
        attrs = {"units": "degrees"} if k == 0 else units
        made[f"grid_corner_{kind}"] = (("grid_size", "grid_corners"), POINTS[filled, k], attrs)
        made[f"grid_center_{kind}"] = ("grid_size", CENTERS[:, k], attrs)
    return made


def esmf():
    return xarray.Dataset(
        {
            "nodeCoords": (("nodeCount", "coordDim"), POINTS, {"units": "degrees"}),
            "elementConn": (
                ("elementCount", "maxNodePElement"),
                np.where(ROWS < 0, -1, ROWS + 1),
                {"_FillValue": -1},
            ),
            "numElementConn": ("elementCount", (ROWS >= 0).sum(axis=1)),
            "centerCoords": (("elementCount", "coordDim"), CENTERS, {"units": "degrees"}),
            "x": ("elementCount", VALUES),
        }
    )


FORMS = [ugrid, ugrid_without_centers, mpas, scrip, esmf]
MEANS = rondel.Regridder(CELLS, "grid:30", "conservative_normed")(VALUES)


@pytest.mark.parametrize("make", FORMS)
def test_means_are_those_of_the_cells(make):
    data = make()
    for found in (rondel.regrid(data, "grid:30"), data.rondel.regrid("grid:30")):
        np.testing.assert_allclose(found.x, MEANS, rtol=0, atol=1e-12)
        assert set(found.data_vars) == {"x"}
    table = rondel.zonal_statistics(data, "grid:30")
    np.testing.assert_allclose(table.x_mean, MEANS.ravel(), rtol=0, atol=1e-12)


@pytest.mark.parametrize("make", FORMS)
@pytest.mark.parametrize("how", [{}, {"decode_coords": "all"}, {"mask_and_scale": False}])
def test_files_are_read_the_same(tmp_path, make, how):
    pytest.importorskip("netCDF4")
    make().to_netcdf(tmp_path / "mesh.nc")
    rondel.regrid_file(tmp_path / "mesh.nc", "grid:30", tmp_path / "out.nc", names=["x"])
    with (
        xarray.open_dataset(tmp_path / "mesh.nc", **how) as data,
        xarray.open_dataset(tmp_path / "out.nc") as of_file,
    ):
        np.testing.assert_array_equal(rondel.regrid(data, "grid:30").x, of_file.x)


@pytest.mark.parametrize("make", FORMS)
def test_cells_are_those_of_the_arrays(make):
    data = make()
    dim = data.x.dims[0]
    turned = rondel.regrid(data.isel({dim: slice(None, None, -1)}), "grid:30")
    np.testing.assert_allclose(turned.x, MEANS, rtol=0, atol=1e-12)
    few = rondel.regrid(data.isel({dim: slice(0, 20)}), "grid:30", max_missing=1)
    rings = CELLS.rings
    some = rondel.CellSet.polygons(rings[0][:21], rings[1][:21], rings[2][: rings[1][20]], rings[3])
    expected = rondel.Regridder(some, "grid:30", "conservative_normed")(VALUES[:20])
    np.testing.assert_allclose(few.x, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("make", FORMS)
def test_meshes_are_targets(make):
    lon, lat = np.arange(-175.0, 180, 10), np.arange(-85.0, 90, 10)
    field = xarray.DataArray(
        np.random.default_rng(8).random((18, 36)), {"lat": lat, "lon": lon}, ("lat", "lon"), "t"
    )
    mesh = make().drop_vars("x")
    expected = rondel.regrid(field, CELLS)
    found = rondel.regrid(field.to_dataset(), mesh)
    np.testing.assert_allclose(found.t, expected, rtol=0, atol=1e-12)
    bounds = [found[name] for name in found.coords if str(name).endswith("_bnds")]
    assert len(bounds) == 2
    assert {item.dims[0] for item in bounds} == {*found.t.dims}
    # The fields at the mesh are a source with cells themselves.
    back = rondel.regrid(found, "grid:30")
    of_cells = rondel.Regridder(CELLS, "grid:30", "conservative_normed")(expected.values)
    np.testing.assert_allclose(back.t, of_cells, rtol=0, atol=1e-9)


def test_masked_cells_take_no_part():
    data = scrip()
    data.grid_imask[:] = VALUES > 0.3
    with pytest.warns(UserWarning, match="masked"):
        found = rondel.regrid(data, "grid:30", max_missing=1)
    with pytest.warns(UserWarning, match="masked"):
        target = rondel.regrid(found.x.to_dataset().assign(x=found.x.fillna(0)), data)
    assert np.array_equal(np.isnan(target.x), VALUES <= 0.3)
    assert float(found.x.min()) > 0.3


def test_places_that_are_named_are_not_replaced():
    data = ugrid()
    named = rondel.regrid(data, "grid:30", lon="face_lon", lat="face_lat")
    np.testing.assert_allclose(named.x, MEANS, rtol=0, atol=1e-12)
    with pytest.raises(ValueError, match="no corners of cells"):
        rondel.regrid(data, "grid:30", lon=NODES[0], lat=NODES[1])


def test_a_mesh_that_is_wrong_or_in_the_plane_is_refused():
    broken = ugrid()
    broken["corners"] = broken.corners + 1000
    with pytest.raises(ValueError, match=r'the data: cell 0 has a corner .* in "corners"'):
        rondel.regrid(broken, "grid:30")
    with pytest.raises(ValueError, match="the mesh is in the plane"):
        rondel.regrid(mpas().assign_attrs(on_a_sphere="NO"), "grid:30")


def test_advice_for_a_target_names_its_arguments():
    source = xarray.DataArray(np.ones((2, 3)), {"lat": [0, 1], "lon": [0, 1, 2]}, ("lat", "lon"))
    nowhere = xarray.Dataset({"height": ("place", [1.0])})
    with pytest.raises(ValueError, match=r"say lon_out=NAME and lat_out=NAME"):
        rondel.Regridder(source, nowhere, "bilinear")
    with pytest.raises(ValueError, match=r"no variable 'east' \(lon_out=\)"):
        rondel.Regridder(source, nowhere, "bilinear", lon_out="east", lat_out="height")
    with pytest.raises(ValueError, match=r"say lon=NAME and lat=NAME"):
        rondel.Regridder(nowhere, source, "bilinear")


@pytest.mark.parametrize("method", ["nearest", "linear", "native", "conservative"])
def test_values_are_at_the_faces_of_a_mesh_whose_nodes_have_places_too(method):
    data = ugrid()
    for name, item in (("longitude", "lon"), ("latitude", "lat")):
        for kind in ("node", "face"):
            data[f"{kind}_{item}"].attrs["standard_name"] = name
    wanted = rondel.regrid(data, "grid:30", method, lon="face_lon", lat="face_lat").x
    for found in (data, data.assign(depth=("node", POINTS[:, 0], {"location": "node"}))):
        np.testing.assert_array_equal(rondel.regrid(found, "grid:30", method).x, wanted)


def test_values_are_at_the_nodes_of_a_mesh_if_all_of_them_are():
    data = ugrid().drop_vars("x")
    data["depth"] = ("node", POINTS[:, 0], {"mesh": "mesh", "location": "node"})
    wanted = rondel.regrid(data, "grid:30", "nearest", lon="node_lon", lat="node_lat").depth
    np.testing.assert_array_equal(rondel.regrid(data, "grid:30", "nearest").depth, wanted)


def test_data_that_name_another_order_of_pixels_are_refused():
    ring = {"grid_mapping_name": "healpix", "refinement_level": 1, "indexing_scheme": "ring"}
    data = xarray.Dataset({"t": ("cell", np.arange(48.0), {"grid_mapping": "crs"})})
    data = data.assign_coords(crs=((), 0, ring))
    regridder = rondel.Regridder("healpix:1", "grid:30", "conservative")
    with pytest.raises(ValueError, match="the data name the grid healpix:1:ring, whose places are"):
        regridder(data)
    wanted = rondel.Regridder("healpix:1:ring", "grid:30", "conservative")(data).t
    np.testing.assert_array_equal(rondel.regrid(data, "grid:30").t, wanted)
