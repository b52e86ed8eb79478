#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Other programs read Rondel's files of weights, and Rondel theirs (weight_clients_test.py TOOL PROGRAM...).

The programs are ncks, ncremap, nccopy and cdo (Debian: nco, netcdf-bin, cdo). Returns 77 if one is not installed.
"""

import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

TOOL = pathlib.Path(sys.argv[1]).resolve()
GRID = "gridtype=lonlat\nxsize=72\nysize=36\nxfirst=-177.5\nxinc=5\nyfirst=-87.5\nyinc=5\n"


def run(*command, folder):
    """What a command prints."""
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout


def make(folder):
    """Sites with a value, their weights for a grid, and the values there."""
    source = random.Random(3)
    lines = ["lon,lat,t"]
    for _ in range(500):
        lat = math.degrees(math.asin(source.uniform(-1, 1)))
        lines.append(f"{source.uniform(-180, 180)!r},{lat!r},{source.uniform(-9, 9)!r}")
    (folder / "sites.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (folder / "grid.txt").write_text(GRID, encoding="utf-8")
    for name, form in (("w.nc", "esmf"), ("scrip.nc", "scrip")):
        run(TOOL, "interpolate", "sites.csv", "--to", "grid:5", "--weights", name, "--weight-format", form,
            folder=folder)
    run(TOOL, "apply", "w.nc", "sites.csv", "--value", "t", "-o", "out.csv", folder=folder)
    rows = (folder / "out.csv").read_text(encoding="utf-8").splitlines()[1:]
    return [float(row.split(",")[2]) for row in rows]


def sites_with_values(folder):
    """in.nc: the values at the sites."""
    run(TOOL, "interpolate", "sites.csv", "--value", "t", "--to", "sites.csv", "--method", "nearest", "-o", "in.nc",
        folder=folder)


def check_ncks(folder, _):
    """NCO's own check of a map-file: it reads it, the rows sum up to 1, and the areas to the sphere's."""
    text = run("ncks", "--chk_map", "w.nc", folder=folder)
    assert "Sparse-matrix size n_s" in text, text
    for name in ("avg", "min", "max"):
        line = next(line for line in text.splitlines() if line.startswith(f"frac_b {name}"))
        assert abs(float(line.split()[2]) - 1) < 1e-12, line
    for name in ("area_a", "area_b"):
        line = next(line for line in text.splitlines() if line.startswith(f"{name} sum/4*pi"))
        assert abs(float(line.split()[2]) - 1) < 1e-12, line


def numbers_of(name, variable, folder):
    """The values of a variable, as ncks prints them."""
    return [float(text) for text in run("ncks", "-H", "-C", "-s", "%.17g\n", "-v", variable, name, folder=folder).split()]


def check_ncremap(folder, values):
    """NCO's regridding applies ESMF's kind, and takes the grid's cells from their corners."""
    sites_with_values(folder)
    run("ncremap", "-m", "w.nc", "in.nc", "out.nc", folder=folder)
    got = numbers_of("out.nc", "t", folder)
    assert len(got) == len(values)
    assert max(abs(a - b) for a, b in zip(got, values)) <= 1e-12
    bounds = numbers_of("out.nc", "lat_bnds", folder)
    assert bounds == [-90 + 5 * (i // 2 + i % 2) for i in range(72)], bounds
    run(TOOL, "interpolate", "sites.csv", "--to", "sites.csv", "--weights", "points.nc", folder=folder)
    run("ncremap", "-m", "points.nc", "in.nc", "out.nc", folder=folder)
    assert numbers_of("out.nc", "t", folder) == numbers_of("in.nc", "t", folder)


def check_nccopy(folder, _):
    """Every classic kind that netCDF-C makes of a file is read; netCDF-4 is refused, with a way out."""
    wanted = run(TOOL, "check-weights", "w.nc", "--json", folder=folder)
    for kind in ("classic", "64-bit-offset", "cdf5"):
        run("nccopy", "-k", kind, "w.nc", "copy.nc", folder=folder)
        got = run(TOOL, "check-weights", "copy.nc", "--json", folder=folder)
        assert json.loads(got) == json.loads(wanted), got
    run("nccopy", "-k", "netCDF-4", "w.nc", "copy.nc", folder=folder)
    done = subprocess.run([TOOL, "check-weights", "copy.nc"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "nccopy -k cdf5" in done.stderr, done.stderr


def check_cdo(folder, values):
    """CDO's remap with these weights."""
    sites_with_values(folder)
    text = run("cdo", "-s", "outputf,%.17g,1", "-remap,grid.txt,scrip.nc", "in.nc", folder=folder)
    got = [float(number) for number in text.split()]
    assert len(got) == len(values)
    assert max(abs(a - b) for a, b in zip(got, values)) <= 1e-12


CHECKS = {"ncks": check_ncks, "ncremap": check_ncremap, "nccopy": check_nccopy, "cdo": check_cdo}


def main():
    programs = sys.argv[2:]
    missing = [program for program in programs if not shutil.which(program)]
    if missing:
        print(f"not installed: {' '.join(missing)}; scripts/install-deps test installs ncks, ncremap and nccopy,\n"
              "scripts/install-deps cdo the last")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        values = make(folder)
        for program in programs:
            CHECKS[program](folder, values)


if __name__ == "__main__":
    main()
