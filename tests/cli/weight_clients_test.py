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
    run(TOOL, "remap", "sites.csv", "grid:5", "-o", "cells.nc", folder=folder)
    text = run("ncks", "--chk_map", "cells.nc", folder=folder)
    for name in ("frac_a avg", "frac_a min", "frac_a max", "frac_b min", "frac_b max", "area_a sum/4*pi",
                 "area_b sum/4*pi"):
        line = next(line for line in text.splitlines() if line.startswith(name))
        assert abs(float(line.split()[2]) - 1) < 1e-12, line


def numbers_of(name, variable, folder, form="%.17g"):
    """The values of a variable, as ncks prints them."""
    return [float(text) for text in run("ncks", "-H", "-C", "-s", form + "\n", "-v", variable, name, folder=folder).split()]


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
    """Every kind that netCDF-C makes of a file is read."""
    wanted = run(TOOL, "check-weights", "w.nc", "--json", folder=folder)
    for kind in ("classic", "64-bit-offset", "cdf5", "netCDF-4", "netCDF-4 classic model"):
        run("nccopy", "-k", kind, "w.nc", "copy.nc", folder=folder)
        got = run(TOOL, "check-weights", "copy.nc", "--json", folder=folder)
        assert json.loads(got) == json.loads(wanted), got


def check_cdo(folder, values):
    """CDO's remap with these weights."""
    sites_with_values(folder)
    text = run("cdo", "-s", "outputf,%.17g,1", "-remap,grid.txt,scrip.nc", "in.nc", folder=folder)
    got = [float(number) for number in text.split()]
    assert len(got) == len(values)
    assert max(abs(a - b) for a, b in zip(got, values)) <= 1e-12
    check_conservative(folder)


def entries_of(name, folder):
    """The matrix of a SCRIP file, by target and source."""
    rows = numbers_of(name, "dst_address", folder, "%d")
    columns = numbers_of(name, "src_address", folder, "%d")
    values = numbers_of(name, "remap_matrix", folder)
    return {(row, column): value for row, column, value in zip(rows, columns, values)}


def check_planted(sides, folder):
    """A weight of CDO's that is changed in its file is found, with its target and its source."""
    text = run("ncdump", "-p", "9,17", "cdo.nc", folder=folder)
    begin = text.index("remap_matrix =") + len("remap_matrix =")
    end = text.index(";", begin)
    numbers = text[begin:end].split(",")
    numbers[77] = " " + repr(float(numbers[77]) + 0.125)
    (folder / "planted.cdl").write_text(text[:begin] + ",".join(numbers) + text[end:], encoding="utf-8")
    run("ncgen", "-k", "nc6", "-o", "planted.nc", "planted.cdl", folder=folder)
    done = subprocess.run([TOOL, "check-weights", "planted.nc", *sides, "--json"], cwd=folder, capture_output=True,
                          text=True, check=False)
    assert done.returncode == 1, done.stderr
    (row,) = json.loads(done.stdout)["exact"]["worst_rows"]
    assert row["target"] == numbers_of("cdo.nc", "dst_address", folder, "%d")[77] - 1, row
    assert row["worst"]["source"] == numbers_of("cdo.nc", "src_address", folder, "%d")[77] - 1, row
    assert abs(row["error"] - 0.125) < 1e-9, row


def check_conservative(folder):
    """CDO's conservative weights, which it computes with cells between parallels too, from its own files of cells."""
    run("cdo", "-s", "-f", "nc", "-const,1,global_9", "grid.nc", folder=folder)
    run("cdo", "-s", "-f", "nc", "-setgridtype,unstructured", "-const,1,gme12", "hexagons.nc", folder=folder)
    for source, target in (("hexagons", "grid"), ("grid", "hexagons")):
        run("cdo", "-s", f"gencon,{target}.nc", f"{source}.nc", "cdo.nc", folder=folder)
        run(TOOL, "remap", f"{source}.nc", f"{target}.nc", "--norm", "fracarea", "-o", "own.nc",
            "--format", "scrip", folder=folder)
        theirs = entries_of("cdo.nc", folder)
        ours = entries_of("own.nc", folder)
        assert len(ours) > 1400
        for entry in theirs.keys() | ours.keys():
            difference = abs(theirs.get(entry, 0) - ours.get(entry, 0))
            assert difference <= 1e-11, (source, entry, difference)
        sides = ("--source", f"{source}.nc", "--target", f"{target}.nc")
        report = json.loads(run(TOOL, "check-weights", "cdo.nc", *sides, "--json", folder=folder))
        exact = report["exact"]
        assert report["valid"], report["reason"]
        assert exact["pieces"] == len(ours), exact
        assert exact["max_error"] <= 1e-11, exact
        check_planted(sides, folder)
    # And CDO applies ours.
    run("cdo", "-s", "-f", "nc", "-setgridtype,unstructured", "-random,gme12,7", "random.nc", folder=folder)
    run(TOOL, "remap", "hexagons.nc", "grid.nc", "--order", "2", "-o", "own.nc", "--format", "scrip",
        folder=folder)
    text = run("cdo", "-s", "outputf,%.17g,1", "-remap,grid.nc,own.nc", "random.nc", folder=folder)
    run(TOOL, "apply", "own.nc", "random.nc", "--input-format", "scrip", "-o", "out.csv", folder=folder)
    rows = (folder / "out.csv").read_text(encoding="utf-8").splitlines()[1:]
    values = [float(row.split(",")[2]) for row in rows]
    assert len(values) == len(text.split()) == 40 * 20
    assert max(abs(float(a) - b) for a, b in zip(text.split(), values)) <= 1e-6  # CDO's file has single precision


CHECKS = {"ncks": check_ncks, "ncremap": check_ncremap, "nccopy": check_nccopy, "cdo": check_cdo}


def main():
    programs = sys.argv[2:]
    missing = [program for program in programs if not shutil.which(program)]
    if missing:
        print(f"not installed: {' '.join(missing)}; scripts/install test installs ncks, ncremap and nccopy,\n"
              "scripts/install cdo the last")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        values = make(folder)
        for program in programs:
            CHECKS[program](folder, values)


if __name__ == "__main__":
    main()
