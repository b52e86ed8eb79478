#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Packages of Python read Rondel's files of meshes (mesh_programs.py TOOL); scripts/test --mesh-clients installs them.

uxarray, VTK, YAC, gpuwm-hex, ugrid-checks; and of triangles meshio, Gmsh and xugrid. Prints a line for each.
"""

import contextlib
import io
import json
import pathlib
import subprocess
import sys
import tempfile

import gmsh
import meshio
import netCDF4
import numpy as np
import uxarray
import vtk
import xarray
import xugrid
import yac.core
from ugrid_checks.check import check_dataset

TOOL = pathlib.Path(sys.argv[1]).resolve()
FORMATS = ("mpas", "ugrid", "scrip", "esmf", "exodus")
KINDS = ("cdf2", "cdf5")
PART = [[-10, -30], [60, -30], [60, 40], [-10, 40], [-10, -30]]


def run(*command):
    """What a command prints."""
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def check_uxarray(folder):
    """All formats, of MPAS the triangles, too: so many faces, nodes and edges, which cover the sphere."""
    for kind in KINDS:
        for name in FORMATS:
            grid = uxarray.open_grid(folder / f"{name}-{kind}.nc")
            # SCRIP has corners without names; where rounding parts them there are edges twice.
            assert (grid.n_face, grid.n_node) == (642, 1280), (name, kind)
            assert grid.n_edge == 1920 or name == "scrip", (name, kind, grid.n_edge)
            assert abs(float(grid.face_areas.sum()) / (4 * np.pi) - 1) < 1e-7
            with contextlib.redirect_stdout(io.StringIO()):
                assert grid.validate()
        dual = uxarray.open_grid(folder / f"mpas-{kind}.nc", use_dual=True)
        assert (dual.n_face, dual.n_node, dual.n_edge) == (1280, 642, 1920)
        assert abs(float(dual.face_areas.sum()) / (4 * np.pi) - 1) < 1e-7
    areas = []
    for name in FORMATS:
        grid = uxarray.open_grid(folder / f"part-{name}.nc")
        areas.append(float(grid.face_areas.sum()))
        # Of a part that hangs together: Euler's formula without the face outside.
        assert name == "scrip" or grid.n_node + grid.n_face == grid.n_edge + 1, name
        with contextlib.redirect_stdout(io.StringIO()):
            assert grid.validate()
    assert max(areas) - min(areas) < 1e-7 < min(areas), areas
    return "all formats, with a border, too, and the triangles of MPAS"


class Complaints:
    """What VTK's objects say, line by line."""

    def __init__(self, reader):
        self.lines = []
        for event in ("ErrorEvent", "WarningEvent"):
            reader.AddObserver(event, self.add)

    def add(self, _caller, _event, text):
        """Called by VTK."""
        self.lines.append(text.strip().splitlines()[-1])

    add.CallDataType = vtk.VTK_STRING


def check_vtk(folder):
    """UGRID in silence; MPAS with what it says of MPAS-Tools' meshes, too, and of a scalar that MPAS-A wants."""
    for kind in KINDS:
        reader = vtk.vtkNetCDFUGRIDReader()
        said = Complaints(reader)
        reader.SetFileName(str(folder / f"ugrid-{kind}.nc"))
        reader.Update()
        grid = reader.GetOutput()
        assert (grid.GetNumberOfCells(), grid.GetNumberOfPoints()) == (642, 1280)
        assert said.lines == [], said.lines
        reader = vtk.vtkMPASReader()
        said = Complaints(reader)
        reader.SetFileName(str(folder / f"mpas-{kind}.nc"))
        reader.Update()
        # Its points are the cells and one that stands for none.
        assert (reader.GetOutput().GetNumberOfCells(), reader.GetOutput().GetNumberOfPoints()) == (1280, 643)
        assert len(said.lines) == 2, said.lines
        assert "Invalid dimension" in said.lines[0] and "nominalMinDc" in said.lines[1], said.lines
    return "UGRID; MPAS, missing nVertLevels and disliking the scalar nominalMinDc"


def field_of(path):
    """The cells of an MPAS file for YAC."""
    with netCDF4.Dataset(path) as file:
        counts = file["nEdgesOnCell"][:].data
        corners = file["verticesOnCell"][:].data
        rings = np.concatenate([row[:count] - 1 for row, count in zip(corners, counts, strict=True)])
        grid = yac.core.BasicGrid.unstruct_new(path.stem, counts.astype(np.intc), file["lonVertex"][:].data,
                                               file["latVertex"][:].data, rings.astype(np.intc))
    cells = yac.core.yac_location.YAC_LOC_CELL
    grid.set_global_index(cells, np.arange(len(counts), dtype=np.intc))
    return yac.core.InterpField(grid.add_coordinates(cells))


def check_yac(folder):
    """Conservative weights between two meshes: rows sum up to 1."""
    stack = yac.core.InterpolationStack()
    stack.add_conservative(1)
    source, target = folder / "mpas-cdf2.nc", folder / "other.nc"
    path = folder / "weights.nc"
    yac.core.compute_weights(stack, field_of(source), field_of(target)).write_to_file(str(path), source.stem, target.stem)
    with netCDF4.Dataset(path) as file:
        sums = np.bincount(file["dst_address"][:].data - 1, file["remap_matrix"][:, 0].data)
    assert len(sums) == 300 and np.abs(sums - 1).max() < 1e-10, sums
    return f"conservative weights, rows within {np.abs(sums - 1).max():.1g} of 1"


def check_gpuwm(folder):
    """Its strict check of MPAS meshes."""
    for kind in KINDS:
        program = pathlib.Path(sys.executable).with_name("gpuwm-hex")
        found = json.loads(run(program, "mesh-check", "--grid", folder / f"mpas-{kind}.nc", "--grid-only"))
        assert found["passed"] and found["dimensions"]["nCells"] == 642, found
    return "mesh-check passes"


def check_ugrid(folder):
    """The rules of UGRID."""
    for kind in KINDS:
        report = check_dataset(str(folder / f"ugrid-{kind}.nc"), print_summary=False).checking_report()
        assert "No problems found" in report, report
    report = check_dataset(str(folder / "part-ugrid.nc"), print_summary=False).checking_report()
    assert "No problems found" in report, report
    return "no problems found"


def check_triangles(folder):
    """Land: meshio, Gmsh, xugrid and uxarray find the same nodes, triangles and groups; what Gmsh writes is read."""
    land = pathlib.Path(__file__).parents[2] / "data" / "countries-110m.geojson"
    for name in ("land4.msh", "land2.msh", "land.nc"):
        form = ["--format", "gmsh2"] if name == "land2.msh" else []
        run(TOOL, "triangulate", land, "--inside", "--split", "-o", folder / name, *form)
    facts = json.loads(run(TOOL, "info", folder / "land4.msh", "--json"))
    counts = (facts["nodes"], facts["triangles"])
    for name in ("land4.msh", "land2.msh"):
        mesh = meshio.read(folder / name)
        assert (len(mesh.points), len(mesh.cells_dict["triangle"])) == counts, name
        assert set(mesh.field_data) == {"land", "island", "domain"}, mesh.field_data
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(folder / name))
        groups = {gmsh.model.getPhysicalName(*group) for group in gmsh.model.getPhysicalGroups()}
        assert groups == {"land", "island", "domain"}, groups
        assert len(gmsh.model.mesh.getNodes()[0]) == counts[0], name
        gmsh.write(str(folder / "gmsh.msh"))
        gmsh.finalize()
        assert json.loads(run(TOOL, "info", folder / "gmsh.msh", "--json"))["segments"] == facts["segments"]
    with xarray.open_dataset(folder / "land.nc") as dataset:
        grid = xugrid.Ugrid2d.from_dataset(dataset)
        assert (grid.n_node, grid.n_face) == counts
    grid = uxarray.open_grid(folder / "land.nc")
    assert (grid.n_node, grid.n_face) == counts
    report = check_dataset(str(folder / "land.nc"), print_summary=False).checking_report()
    assert "No problems found" in report, report
    return f"{counts[1]} triangles of land"


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mesh = folder / "mesh.nc"
        run(TOOL, "mesh", "icosahedral", "3", "-o", mesh)
        for kind in KINDS:
            for form in FORMATS:
                run(TOOL, "mesh", "convert", mesh, "-o", folder / f"{form}-{kind}.nc", "--format", form, "--kind", kind)
        (folder / "part.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [PART]}))
        for form in FORMATS:
            run(TOOL, "mesh", "cull", mesh, "-o", folder / f"part-{form}.nc", "--format", form, "--outside",
                folder / "part.geojson")
        run(TOOL, "generate", "uniform", "-n", "300", "-o", folder / "sites.csv")
        run(TOOL, "mesh", "convert", folder / "sites.csv", "-o", folder / "other.nc", "--kind", "cdf2")
        for client, check in (("uxarray", check_uxarray), ("vtk", check_vtk), ("yac", check_yac),
                              ("gpuwm-hex", check_gpuwm), ("ugrid-checks", check_ugrid),
                              ("meshio, gmsh, xugrid", check_triangles)):
            print(f"{client}: {check(folder)}", flush=True)


if __name__ == "__main__":
    main()
