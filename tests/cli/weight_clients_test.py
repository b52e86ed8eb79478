#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Other programs read Rondel's files of weights, and Rondel theirs (weight_clients_test.py TOOL).

Runs those of ncks, nccopy and cdo that are installed (Debian: nco, netcdf-bin, cdo), and says which are not.
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


def check_ncks(folder, _):
    """NCO's own check of a map-file: it reads it, and the rows sum up to 1."""
    text = run("ncks", "--chk_map", "w.nc", folder=folder)
    assert "Sparse-matrix size n_s" in text, text
    for name in ("avg", "min", "max"):
        line = next(line for line in text.splitlines() if line.startswith(f"frac_b {name}"))
        assert abs(float(line.split()[2]) - 1) < 1e-12, line


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
    run(TOOL, "interpolate", "sites.csv", "--value", "t", "--to", "sites.csv", "--method", "nearest", "-o", "in.nc",
        folder=folder)
    text = run("cdo", "-s", "outputf,%.17g,1", "-remap,grid.txt,scrip.nc", "in.nc", folder=folder)
    got = [float(number) for number in text.split()]
    assert len(got) == len(values)
    assert max(abs(a - b) for a, b in zip(got, values)) <= 1e-12


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        values = make(folder)
        for program, check in (("ncks", check_ncks), ("nccopy", check_nccopy), ("cdo", check_cdo)):
            if shutil.which(program):
                check(folder, values)
            print(f"{program}: {'accepted' if shutil.which(program) else 'not installed'}")


if __name__ == "__main__":
    main()
