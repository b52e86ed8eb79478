# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files of weights of the tool and of Python: the same bytes for the same cells."""

import json
import os
import subprocess

import clouds
import numpy as np
import pytest

import rondel
import rondel.mesh

TOOL = os.environ.get("RONDEL")
pytestmark = pytest.mark.skipif(TOOL is None, reason="needs the tool")
POINTS = clouds.uniform(150, 5)


def box(west, south, east, north):
    ring = [[west, south], [east, south], [east, north], [west, north], [west, south]]
    return {"type": "Polygon", "coordinates": [ring]}


def features():
    """Two polygons with properties, one of which crosses the antimeridian."""
    named = (("Élan", 1.5, box(10, 20, 40, 50)), ('a,"b"', None, box(150, -30, 200, 10)))
    return {
        "type": "FeatureCollection",
        "features": [
            {"type": "Feature", "properties": {"name": name, "size": size}, "geometry": geometry}
            for name, size, geometry in named
        ],
    }


def masked_mesh(path):
    """A mesh in the convention of SCRIP, of which each third cell takes no part."""
    netcdf = pytest.importorskip("netCDF4")
    rondel.mesh.from_points(POINTS).to_scrip(path)
    with netcdf.Dataset(path, "a") as file:
        file["grid_imask"][::3] = 0


def grid_file(path):
    """A grid of CF whose coordinates are axes without bounds."""
    netcdf = pytest.importorskip("netCDF4")
    with netcdf.Dataset(path, "w") as file:
        for name, unit, values in (
            ("lat", "degrees_north", np.linspace(80, -80, 9)),
            ("lon", "degrees_east", np.arange(0, 360, 30.0)),
        ):
            file.createDimension(name, len(values))
            axis = file.createVariable(name, "f8", (name,))
            axis.units = unit
            axis[:] = values


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("cells")
    masked_mesh(made / "mesh.nc")
    grid_file(made / "grid.nc")
    (made / "two.geojson").write_text(json.dumps(features()), "utf-8")
    np.save(made / "sites.npy", POINTS)
    return made


# What the tool reads, and the same cells in Python.
SIDES = {
    "grid": ("grid:7x5", lambda _: rondel.lonlat_grid(7, 5)),
    "fine": ("grid:36x17", lambda _: rondel.lonlat_grid(36, 17)),
    "mesh": ("mesh.nc", lambda folder: rondel.CellSet.read(folder / "mesh.nc")),
    "axes": ("grid.nc", lambda folder: rondel.CellSet.read(folder / "grid.nc")),
    "polygons": ("two.geojson", lambda folder: rondel.polygons(folder / "two.geojson")),
    "voronoi": (
        "sites.npy",
        lambda folder: rondel.CellSet.voronoi(rondel.delaunay(np.load(folder / "sites.npy"))),
    ),
}
PAIRS = [("grid", "fine"), ("mesh", "fine"), ("fine", "polygons"), ("voronoi", "axes")]
PAIRS += [("polygons", "voronoi"), ("voronoi", "mesh")]


def assert_same_bytes(folder, names, remap, *options):
    for format in ("esmf", "scrip"):
        output = ("-o", "tool.nc", "--format", format, "--quiet")
        subprocess.run([TOOL, "remap", *names, *output, *options], cwd=folder, check=True)
        remap.to_netcdf(folder / "python.nc", format)
        assert (folder / "python.nc").read_bytes() == (folder / "tool.nc").read_bytes()


@pytest.mark.filterwarnings("ignore:.*cells are masked")
@pytest.mark.parametrize(("source", "target"), PAIRS)
@pytest.mark.parametrize(("order", "norm"), [(1, "destarea"), (2, "fracarea")])
def test_both_write_the_same_bytes(folder, source, target, order, norm):
    (a, source_of), (b, target_of) = SIDES[source], SIDES[target]
    found = rondel.remap(source_of(folder), target_of(folder), order=order, norm=norm)
    assert_same_bytes(folder, (a, b), found, "--order", str(order), "--norm", norm)


def test_grids_of_great_circles_have_the_same_bytes(folder):
    arcs = rondel.lonlat_grid(12, 6, sides="great_circles")
    mesh = rondel.CellSet.read(folder / "grid.nc", sides="great_circles")
    names = ("grid:12x6", "grid.nc")
    assert_same_bytes(folder, names, rondel.remap(arcs, mesh), "--sides", "great-circles")


def test_polygons_with_few_corners_have_the_same_bytes(folder):
    polygons = rondel.polygons(folder / "two.geojson", edges="geodesic")
    found = rondel.remap(rondel.lonlat_grid(12, 6), polygons)
    assert_same_bytes(folder, ("grid:12x6", "two.geojson"), found, "--edges", "geodesic")


def test_files_know_what_the_cells_are(folder):
    netcdf = pytest.importorskip("netCDF4")
    sites = rondel.CellSet.voronoi(rondel.delaunay(POINTS))
    polygons = rondel.polygons(features(), edges="geodesic")
    mask = np.arange(2) > 0
    found = rondel.remap(sites, polygons, target_mask=mask)
    assert found.source is sites
    assert found.target.mask.tolist() == mask.tolist()
    assert polygons.mask.all()
    found.to_netcdf(folder / "known.nc")
    with netcdf.Dataset(folder / "known.nc") as file:
        places = np.column_stack([file["xc_a"][:], file["yc_a"][:]])
        assert np.array_equal(places, rondel.lonlat(POINTS))
        assert "xv_a" not in file.variables
        assert file["xv_b"].shape == (2, 4)
        assert file["mask_b"][:].tolist() == [0, 1]


def test_errors_name_the_file(folder):
    two = [box(0, 0, 20, 20), box(10, 10, 30, 30)]
    collection = {"type": "GeometryCollection", "geometries": two}
    (folder / "twice.geojson").write_text(json.dumps(collection), "utf-8")
    twice = rondel.CellSet.read(folder / "twice.geojson")
    grid = rondel.lonlat_grid(8, 4)
    name = str(folder / "twice.geojson").replace("\\", "\\\\")
    with pytest.raises(rondel.InvalidInput, match=f"^{name}: source cells 0 and 1 overlap") as said:
        rondel.remap(twice, grid)
    assert said.value.index == 1
    with pytest.raises(rondel.InvalidInput, match=r"^target cells 0 and 1 overlap"):
        rondel.remap(grid, rondel.polygons(two))
