# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of models: the same cells and weights from tool, file and Dataset."""

import itertools
import subprocess
import warnings

import clouds
import numpy as np
import pytest
from netcdf_cases import NORTH, OTHER, TOOL, check, netCDF4, same_weights, write, xarray

import rondel


def mesh_of_voronoi(n=40):
    cells = rondel.CellSet.voronoi(rondel.delaunay(clouds.uniform(n, 3)))
    offsets, _, corners, points = cells.rings
    return cells, offsets, corners, rondel.lonlat(points)


def rows_of(rings, corners, first, fill):
    sizes = np.diff(rings)
    rows = np.full((len(sizes), sizes.max()), fill, np.int64)
    rows[np.arange(rows.shape[1]) < sizes[:, None]] = corners + first
    return rows


UGRID = list(
    itertools.product(
        ("i4", "f8"), (0, 1), (-1, -999, 2**31 - 1), (False, True), ("degrees_east", "radians")
    )
)


def test_ugrid(tmp_path):
    cells, _, _, nodes = mesh_of_voronoi()
    _, rings, corners, _ = cells.rings
    for number, (dtype, first, fill, turned, unit) in enumerate(UGRID):
        scale = np.pi / 180 if unit == "radians" else 1
        path = tmp_path / f"{number}.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
            rows = rows_of(rings, corners, first, fill)
            for name, size in (("face", len(rows)), ("corner", rows.shape[1])):
                file.createDimension(name, size)
            file.createDimension("node", len(nodes))
            mesh = file.createVariable("mesh", "i4")
            mesh.cf_role, mesh.topology_dimension = "mesh_topology", 2
            mesh.node_coordinates = "there that"  # latitudes first
            mesh.face_node_connectivity, mesh.face_dimension = "faces", "face"
            for name, column, text in (("that", 0, unit), ("there", 1, NORTH.get(unit, unit))):
                variable = file.createVariable(name, "f8", ("node",))
                variable.units = text
                variable.standard_name = ("longitude", "latitude")[column]
                variable[:] = nodes[:, column] * scale
            dims = ("corner", "face") if turned else ("face", "corner")
            faces = file.createVariable("faces", dtype, dims, fill_value=fill)
            faces.start_index = np.int32(first)
            faces[:] = rows.T if turned else rows
        check(path, None, cells.areas, tmp_path)


def test_ugrid_without_fill_or_start(tmp_path):
    """Negative numbers are told; numbers from 1 that nobody announced get a hint."""
    for first, fill, text in ((0, -7, "are less than 0 and taken"), (1, 0, "start_index = 1")):
        path = tmp_path / f"{first}.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC") as file:
            file.createDimension("face", 2)
            file.createDimension("corner", 4)
            file.createDimension("node", 4)
            mesh = file.createVariable("mesh", "i4")
            mesh.cf_role, mesh.topology_dimension = "mesh_topology", 2
            mesh.node_coordinates, mesh.face_node_connectivity = "x y", "faces"
            file.createVariable("x", "f8", ("node",))[:] = [0, 10, 10, 0]
            file.createVariable("y", "f8", ("node",))[:] = [0, 0, 10, 10]
            rows = np.array([[0, 1, 2, -1], [0, 2, 3, -1]])
            if first == 1:
                rows[:, 3] = rows[:, 2]
            rows = np.where(rows < 0, fill, rows + first)
            file.createVariable("faces", "i4", ("face", "corner"))[:] = rows
        if first == 0:
            with pytest.warns(UserWarning, match=text):
                assert len(rondel.CellSet.read(path).areas) == 2
        else:
            with pytest.raises(OSError, match=text):
                rondel.CellSet.read(path)


@pytest.mark.parametrize("unit", ["degrees", "radians"])
def test_scrip(tmp_path, unit):
    cells, _, _, nodes = mesh_of_voronoi()
    _, rings, corners, points = cells.rings
    scale = np.pi / 180 if unit == "radians" else 1
    padded = rows_of(rings, corners, 0, -1)
    centers = rondel.lonlat(points[padded[:, :3]].mean(axis=1))
    cases = itertools.product(("repeated", "missing"), (False, True), ("none", "nan", "far"))
    for number, (ends, turned, hole) in enumerate(cases):
        rows = padded.copy()
        if ends == "repeated":
            last = corners[rings[1:] - 1]
            rows = np.where(rows < 0, last[:, None], rows)
        values = np.where(rows[..., None] < 0, np.nan, nodes[rows] * scale)
        areas, mask = cells.areas.copy(), np.ones(len(rows), int)
        if hole != "none":  # masked cells may have anything for corners
            values[[3, 8]] = np.nan if hole == "nan" else 1e4
            mask[[3, 8]], areas[[3, 8]] = 0, 0
        path = tmp_path / f"{number}.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_DATA") as file:
            file.createDimension("grid_size", len(rows))
            file.createDimension("grid_corners", rows.shape[1])
            for name, column in (("lon", 0), ("lat", 1)):
                center = file.createVariable(f"grid_center_{name}", "f8", ("grid_size",))
                center.units = unit
                center[:] = centers[:, column] * scale
                dims = ("grid_size", "grid_corners")
                corner = file.createVariable(
                    f"grid_corner_{name}", "f8", dims[::-1] if turned else dims
                )
                corner.units = unit
                corner[:] = values[..., column].T if turned else values[..., column]
            file.createVariable("grid_imask", "i4", ("grid_size",))[:] = mask
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            said = check(path, None, areas, tmp_path)
        assert bool(told) == (hole != "none")
        if hole != "none":
            assert TOOL is None or "2 of 40 cells are masked by" in said


def test_meshes_without_units(tmp_path):
    """MPAS and ICON have radians where no attribute says anything; nCells + 1 is none."""
    points = clouds.uniform(60, 3)
    mesh = rondel.mesh.from_points(points)
    mesh.to_mpas(tmp_path / "mesh.nc")
    with xarray.open_dataset(tmp_path / "mesh.nc") as file:
        ds = file.load()
    for name in ds.variables:
        ds[name].attrs.pop("units", None)
    write(tmp_path / "plain.nc", ds, "NETCDF3_64BIT")
    areas = rondel.CellSet.read(tmp_path / "mesh.nc").areas
    assert np.isclose(areas.sum(), 4 * np.pi)
    check(tmp_path / "plain.nc", None, areas, tmp_path)
    found = rondel.Regridder(ds, OTHER, "nearest_s2d")
    assert same_weights(found.weights, rondel.Regridder(file, OTHER, "nearest_s2d").weights)


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_masks_of_regions(tmp_path):
    """MPAS-Tools' regionCellMasks(nCells, nRegions); of times nobody knows which is meant."""
    mesh = rondel.mesh.from_points(clouds.uniform(80, 3))
    mesh.to_mpas(tmp_path / "mesh.nc")
    masks = np.zeros((80, 3), np.int32)
    masks[[3, 5], 0] = masks[[5, 9], 2] = 1
    for name, dim, status in (("regions", "nRegions", 0), ("times", "Time", 1)):
        data = xarray.Dataset({"regionCellMasks": (("nCells", dim), masks)})
        write(tmp_path / f"{name}.nc", data, "NETCDF3_CLASSIC")
        command = ["mesh", "cull", tmp_path / "mesh.nc", "-o", tmp_path / "less.nc"]
        command += ["--mask", f"{tmp_path / name}.nc:regionCellMasks"]
        command += ["--cell-map", tmp_path / "map.npy"]
        found = subprocess.run([TOOL, *map(str, command)], capture_output=True, text=True)
        assert found.returncode == status, found.stderr
    assert np.flatnonzero(np.load(tmp_path / "map.npy") == 2**32 - 1).tolist() == [3, 5, 9]


def test_esmf_rows_of_different_lengths(tmp_path):
    """Padded, and one after the other; with numbers from 0, and broken rows."""
    cells, _, _, nodes = mesh_of_voronoi()
    _, rings, corners, _ = cells.rings
    sizes = np.diff(rings)
    for number, (first, ragged) in enumerate(itertools.product((0, 1), (False, True))):
        path = tmp_path / f"{number}.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
            rows = rows_of(rings, corners, first, -1)
            lengths = {"n": len(nodes), "two": 2, "cell": 40, "most": rows.shape[1]}
            for name, size in {**lengths, "entry": len(corners)}.items():
                file.createDimension(name, size)
            variable = file.createVariable("nodeCoords", "f8", ("n", "two"))
            variable.units = "degrees"
            variable[:] = nodes
            dims = ("entry",) if ragged else ("cell", "most")
            variable = file.createVariable("elementConn", "i4", dims, fill_value=-1)
            variable.start_index = np.int32(first)
            variable[:] = corners + first if ragged else rows
            file.createVariable("numElementConn", "i4", ("cell",))[:] = sizes
        check(path, None, cells.areas, tmp_path)
    with netCDF4.Dataset(path, "a") as file:
        file["numElementConn"][39] = sizes[39] - 1
    with pytest.raises(OSError, match=f"has {len(corners)} values instead of {len(corners) - 1}"):
        rondel.CellSet.read(path)
    with netCDF4.Dataset(path, "a") as file:
        file["numElementConn"][39] = sizes[39] + 1
    with pytest.raises(OSError, match=f"cell 39 has {sizes[39] + 1} corners of {sizes[39]}"):
        rondel.CellSet.read(path)


def test_meshes_tell_what_they_have_not(tmp_path):
    mesh = rondel.mesh.from_points(clouds.uniform(60, 3))
    path = tmp_path / "mesh.nc"
    mesh.to_scrip(path)
    with netCDF4.Dataset(path, "a") as file:
        file["grid_imask"][[3, 7]] = 0
    with pytest.warns(UserWarning, match="2 of 60 cells are masked by") as told:
        found = rondel.mesh.read(path)
    assert told[0].filename == __file__
    assert str(told[1].message).endswith("the mesh has the other 58 cells, in their order")
    assert np.allclose(found.points, np.delete(mesh.points, [3, 7], axis=0), atol=1e-14)
    if TOOL is not None:
        command = [TOOL, "mesh", "convert", path, "-o", tmp_path / "out.nc"]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        assert "2 of 60 cells are masked by" in done.stderr


@pytest.mark.parametrize("kind", ["mpas", "scrip", "esmf", "ugrid"])
def test_a_variable_on_its_cells_names_a_mesh(tmp_path, kind):
    mesh = rondel.mesh.from_points(clouds.uniform(60, 3))
    path = tmp_path / "mesh.nc"
    getattr(mesh, f"to_{kind}")(path)
    of_cells = {"mpas": "nCells", "scrip": "grid_size", "esmf": "elementCount"}.get(kind)
    with netCDF4.Dataset(path, "a") as file:
        if of_cells is None:
            (of_cells,) = (name for name, size in file.dimensions.items() if len(size) == 60)
        file.createDimension("lev", 2)
        file.createVariable("t", "f4", ("lev", of_cells))[:] = 0
        file.createVariable("profile", "f4", ("lev",))[:] = 0
    areas = rondel.CellSet.read(path).areas
    assert rondel.CellSet.read(f"{path}:t").areas.tolist() == areas.tolist()
    with pytest.raises(OSError, match='variable "profile"'):
        rondel.CellSet.read(f"{path}:profile")
