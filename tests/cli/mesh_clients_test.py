#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Other programs read Rondel's files of meshes (mesh_clients_test.py TOOL [cdo]).

netCDF-C's ncdump reads all five; NCO's ncremap makes conservative weights of two SCRIP files, and ncks judges them.
With `cdo` instead CDO alone, and returns 77 if it is not installed. scripts/test --mesh-clients has more.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TOOL = pathlib.Path(sys.argv[1]).resolve()
FORMATS = ("mpas", "ugrid", "scrip", "esmf", "exodus")


def run(*command, folder):
    """What a command prints."""
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout


def integers(text, name):
    """The values of a variable in what ncdump prints."""
    return [int(n) for n in re.findall(r"\d+", text.split(f"\n {name} =")[1].split(";")[0])]


def check_headers(folder):
    """Every byte of the header is as netCDF-C wants it, and the values are where it says."""
    for kind, dumped in (("cdf5", "cdf5"), ("cdf2", "64-bit offset")):
        for name in FORMATS:
            run(TOOL, "mesh", "convert", "sites.csv", "-o", "m.nc", "--format", name, "--kind", kind, folder=folder)
            assert run("ncdump", "-k", "m.nc", folder=folder).strip() == dumped, (name, kind)
            assert "\ndata:\n" in run("ncdump", "m.nc", folder=folder), name
    # What TempestRemap's reader wants: this version of 32 bits, all coordinates in one variable, the cells' numbers.
    text = run("ncdump", "m.nc", folder=folder)
    assert ":version = 8.f ;" in text and "double coord(num_dim, num_nodes) ;" in text, text
    blocks = int(re.search(r"num_el_blk = (\d+)", text)[1])
    of_blocks = [n for b in range(blocks) for n in integers(text, f"global_id{b + 1}")]
    assert sorted(of_blocks) == list(range(1, 301)), of_blocks
    assert integers(text, "elem_num_map") == of_blocks
    for block in range(blocks):
        corners = integers(text, f"connect{block + 1}")
        sides = int(re.search(rf"num_nod_per_el{block + 1} = (\d+)", text)[1])
        assert len(corners) == sides * len(integers(text, f"global_id{block + 1}"))
        assert min(corners) >= 1 and max(corners) <= 596 and f'elem_type = "SHELL{sides}"' in text


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


def check_cdo(folder):
    """CDO finds the cells' areas and conservative weights of two SCRIP files, which sum up to 1."""
    for kind in ("cdf2", "cdf5"):
        for name in ("sites", "others"):
            run(TOOL, "mesh", "convert", f"{name}.csv", "-o", f"{name}.nc", "--format", "scrip", "--kind", kind,
                folder=folder)
        run("cdo", "-s", "-f", "nc2", "const,1,sites.nc", "one.nc", folder=folder)
        described = run("cdo", "-s", "griddes", "one.nc", folder=folder)
        assert "gridtype  = unstructured" in described and "gridsize  = 300" in described, described
        assert "nvertex" in described, described
        total = float(run("cdo", "-s", "outputf,%.17g", "-fldsum", "-gridarea", "one.nc", folder=folder))
        assert abs(total / (12.566370614359172 * 6371000**2) - 1) < 1e-6, total
        run("cdo", "-s", "remapcon,others.nc", "one.nc", "remapped.nc", folder=folder)
        values = run("cdo", "-s", "outputf,%.17g,1", "remapped.nc", folder=folder).split()
        assert len(values) == 200 and all(abs(float(v) - 1) < 1e-12 for v in values), values


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
    is_cdo = sys.argv[2:] == ["cdo"]
    if is_cdo and shutil.which("cdo") is None:
        sys.exit(77)
    checks = (check_cdo,) if is_cdo else (check_headers, check_areas, check_weights, check_part)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(TOOL, "generate", "uniform", "-n", "300", "-o", "sites.csv", folder=folder)
        run(TOOL, "generate", "fibonacci", "-n", "200", "-o", "others.csv", folder=folder)
        for check in checks:
            check(folder)


if __name__ == "__main__":
    main()
