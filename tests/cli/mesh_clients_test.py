#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Other programs read Rondel's files of meshes (mesh_clients_test.py TOOL).

netCDF-C's ncdump reads all five; NCO's ncremap makes conservative weights of two SCRIP files, and ncks judges them.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

TOOL = pathlib.Path(sys.argv[1]).resolve()
FORMATS = ("mpas", "ugrid", "scrip", "esmf", "exodus")


def run(*command, folder):
    """What a command prints."""
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout


def check_headers(folder):
    """Every byte of the header is as netCDF-C wants it, and the values are where it says."""
    for kind, dumped in (("cdf5", "cdf5"), ("cdf2", "64-bit offset")):
        for name in FORMATS:
            run(TOOL, "mesh", "convert", "sites.csv", "-o", "m.nc", "--format", name, "--kind", kind, folder=folder)
            assert run("ncdump", "-k", "m.nc", folder=folder).strip() == dumped, (name, kind)
            assert "\ndata:\n" in run("ncdump", "m.nc", folder=folder), name
    text = run("ncdump", "-v", "connect1,elem_num_map", "m.nc", folder=folder)
    numbers = [int(n) for n in re.findall(r"\d+", text.split("elem_num_map =")[1].split(";")[0])]
    assert sorted(numbers) == list(range(1, 301)), numbers


def check_areas(folder):
    """The areas that netCDF-C reads are those of the sphere."""
    run(TOOL, "mesh", "convert", "sites.csv", "-o", "m.nc", folder=folder)
    for name in ("areaCell", "areaTriangle", "kiteAreasOnVertex"):
        text = run("ncdump", "-v", name, "-p", "9,17", "m.nc", folder=folder).split(f"\n {name} =")[1]
        total = sum(float(n) for n in text.split(";")[0].replace(",", " ").split())
        assert abs(total / 12.566370614359172 - 1) < 1e-13, (name, total)


def check_weights(folder):
    """Rows of NCO's conservative weights sum up to 1."""
    for name in ("sites", "others"):
        run(TOOL, "mesh", "convert", f"{name}.csv", "-o", f"{name}.nc", "--format", "scrip", folder=folder)
    run("ncremap", "--no_stdin", "-a", "nco", "-s", "sites.nc", "-g", "others.nc", "-m", "map.nc", folder=folder)
    text = run("ncks", "--chk_map", "map.nc", folder=folder)
    for name in ("avg", "min", "max"):
        line = next(line for line in text.splitlines() if line.startswith(f"frac_b {name}"))
        assert abs(float(line.split()[2]) - 1) < 1e-10, line
    for name in ("area_a", "area_b"):
        line = next(line for line in text.splitlines() if line.startswith(f"{name} sum/4*pi"))
        assert abs(float(line.split()[2]) - 1) < 1e-12, line


def check_part(folder):
    """A mesh with a border: every format, and weights from the whole sphere, which give each cell all of its area."""
    (folder / "area.geojson").write_text(
        '{"type":"Polygon","coordinates":[[[-20,-30],[100,-30],[100,60],[-20,60],[-20,-30]]]}')
    cull = (TOOL, "mesh", "cull", "others.csv", "--outside", "area.geojson", "-o", "m.nc", "--format")
    for name in FORMATS:
        run(*cull, name, folder=folder)
        assert "\ndata:\n" in run("ncdump", "m.nc", folder=folder), name
    run(*cull, "mpas", folder=folder)
    text = run("ncdump", "-v", "cellsOnEdge", "m.nc", folder=folder).split("\n cellsOnEdge =")[1]
    numbers = [int(n) for n in re.findall(r"\d+", text.split(";")[0])]
    assert 0 not in numbers[::2] and 10 < numbers[1::2].count(0) < 100, numbers
    text = run("ncdump", "-v", "areaCell", "-p", "9,17", "m.nc", folder=folder).split("\n areaCell =")[1]
    total = sum(float(n) for n in text.split(";")[0].replace(",", " ").split())
    run(*cull, "scrip", folder=folder)
    run("ncremap", "--no_stdin", "-a", "nco", "-s", "sites.nc", "-g", "m.nc", "-m", "part.nc", folder=folder)
    text = run("ncks", "--chk_map", "part.nc", folder=folder)
    for name in ("avg", "min", "max"):
        line = next(line for line in text.splitlines() if line.startswith(f"frac_b {name}"))
        assert abs(float(line.split()[2]) - 1) < 1e-10, line
    line = next(line for line in text.splitlines() if line.startswith("area_b sum/4*pi"))
    assert abs(float(line.split()[2]) - total / 12.566370614359172) < 1e-12, line


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(TOOL, "generate", "uniform", "-n", "300", "-o", "sites.csv", folder=folder)
        run(TOOL, "generate", "fibonacci", "-n", "200", "-o", "others.csv", folder=folder)
        for check in (check_headers, check_areas, check_weights, check_part):
            check(folder)


if __name__ == "__main__":
    main()
