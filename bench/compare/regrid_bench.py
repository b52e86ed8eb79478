# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regridding of whole files: `rondel regrid`, CDO's `remapcon`, and xarray with stored sparse weights.

    regrid_bench.py RONDEL make DEG VARIABLES TIMES FILE     a file to regrid: floats on a grid of DEG degrees
    regrid_bench.py RONDEL peers FILE TARGET                 the programs in turns, each with a copy of the file
    regrid_bench.py RONDEL alone FILE TARGET [OPTIONS]       rondel once, with further options of `rondel regrid`

CDO gets the target as a description of its cells that `rondel remap --format scrip` has written. Prints a JSON object a run:
the program, the seconds of the wall clock, the largest memory in MB and, for peers, the largest difference from rondel's
values. Needs netCDF4, xarray, SciPy and, if it is there, the program cdo.
"""

import json
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import netCDF4
import numpy as np

TURNS = 3


def make(degrees, variables, times, path):
    """Floats on a grid along longitudes and latitudes, written row by row: a file may be larger than memory."""
    nlat, nlon = round(180 / degrees), round(360 / degrees)
    lat = -90 + (np.arange(nlat) + 0.5) * 180 / nlat
    lon = (np.arange(nlon) + 0.5) * 360 / nlon
    kind = "NETCDF4" if path.endswith(".nc4") else "NETCDF3_64BIT_DATA"
    with netCDF4.Dataset(path, "w", format=kind) as file:
        for name, size in (("time", times), ("lat", nlat), ("lon", nlon)):
            file.createDimension(name, size)
        time_axis = file.createVariable("time", "f8", ("time",))
        time_axis.units = "hours since 2000-01-01"
        time_axis[:] = np.arange(times) * 24.0
        for name, values, units in (("lat", lat, "degrees_north"), ("lon", lon, "degrees_east")):
            axis = file.createVariable(name, "f8", (name,))
            axis.units = units
            axis[:] = values
        fields = [
            file.createVariable(f"v{k}", "f4", ("time", "lat", "lon"), zlib=kind == "NETCDF4", complevel=1)
            for k in range(variables)
        ]
        rows = max(1, (1 << 23) // nlon)
        waves = np.cos(np.radians(3 * lon)).astype("f4")
        for number, field in enumerate(fields):
            for at in range(times):
                for first in range(0, nlat, rows):
                    part = lat[first : first + rows].astype("f4")
                    south = np.round(280 + 20 * np.cos(np.radians(part)) + number + at % 7, 1)
                    field[at, first : first + rows] = south[:, None] + np.round(4 * waves, 1)


def run(command):
    """The seconds and the largest memory of a program, in MB."""
    start = time.perf_counter()
    child = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        raise RuntimeError(f"{command[0]} failed")
    return time.perf_counter() - start, usage.ru_maxrss / 1024


def values_of(path):
    with netCDF4.Dataset(path) as file:
        names = [name for name in file.variables if name.startswith("v")]
        return np.stack([file[name][-1].filled(np.nan).ravel() for name in sorted(names)])


def by_xarray(weights, source, out):
    """In a process of its own, so that its memory is told."""
    program = (
        "import sys, numpy as np, scipy.sparse, xarray\n"
        "matrix = scipy.sparse.load_npz(sys.argv[1])\n"
        "data = xarray.open_dataset(sys.argv[2], chunks=None)\n"
        "made = {}\n"
        "for name in data.data_vars:\n"
        "    field = data[name]\n"
        "    parts = [(matrix @ field[t].values.ravel()).astype('f4') for t in range(field.sizes['time'])]\n"
        "    made[name] = (('time', 'cell'), np.stack(parts))\n"
        "xarray.Dataset(made).to_netcdf(sys.argv[3], format='NETCDF4')\n"
    )
    return run([sys.executable, "-c", program, weights, source, out])


def peers(rondel, path, target):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        source = folder / pathlib.Path(path).name
        shutil.copy(path, source)
        weights = folder / "weights.npz"
        subprocess.run([rondel, "remap", source, target, "-o", weights, "--quiet"], check=True)
        programs = {
            "rondel": lambda: run([rondel, "regrid", source, target, "-o", folder / "rondel.nc4", "--quiet"]),
            "xarray and SciPy, weights stored": lambda: by_xarray(weights, source, folder / "xarray.nc4"),
        }
        if shutil.which("cdo"):
            scrip = folder / "scrip.nc"
            subprocess.run([rondel, "remap", target, "grid:90", "-o", scrip, "--format", "scrip", "--quiet"], check=True)
            grid = folder / "target.nc"
            with netCDF4.Dataset(scrip) as given, netCDF4.Dataset(grid, "w", format="NETCDF3_64BIT_OFFSET") as made:
                cells = given.dimensions["src_grid_size"].size
                corners = given.dimensions["src_grid_corners"].size
                for dimension, size in (("grid_size", cells), ("grid_corners", corners), ("grid_rank", 1)):
                    made.createDimension(dimension, size)
                made.createVariable("grid_dims", "i4", ("grid_rank",))[:] = [cells]
                for axis in ("lat", "lon"):
                    center = made.createVariable(f"grid_center_{axis}", "f8", ("grid_size",))
                    corner = made.createVariable(f"grid_corner_{axis}", "f8", ("grid_size", "grid_corners"))
                    center.units = corner.units = "degrees"
                    for variable, part in ((center, "center"), (corner, "corner")):
                        values = given[f"src_grid_{part}_{axis}"]
                        factor = 180 / np.pi if values.units.startswith("radian") else 1
                        variable[:] = values[:] * factor
                made.createVariable("grid_imask", "i4", ("grid_size",))[:] = 1
            programs["cdo"] = lambda: run(
                ["cdo", "-s", "-P", "2", "-f", "nc4", "-z", "zip_1", f"remapcon,{grid}", source, folder / "cdo.nc4"]
            )
        times = {program: [] for program in programs}
        for _ in range(TURNS):
            for program, work in programs.items():
                times[program].append(work())
        own = values_of(folder / "rondel.nc4")
        for program, found in times.items():
            file = folder / {"rondel": "rondel.nc4", "cdo": "cdo.nc4"}.get(program, "xarray.nc4")
            print(json.dumps({
                "program": program,
                "seconds": [round(seconds, 3) for seconds, _ in found],
                "median": round(statistics.median(seconds for seconds, _ in found), 3),
                "MB": round(max(memory for _, memory in found)),
                "difference": float(np.nanmax(np.abs(values_of(file) - own))),
            }))


def alone(rondel, path, target, *options):
    with tempfile.TemporaryDirectory() as folder:
        seconds, memory = run([rondel, "regrid", path, target, "-o", pathlib.Path(folder) / "out.nc", "--quiet", *options])
        print(json.dumps({"program": "rondel", "target": target, "seconds": round(seconds, 2), "MB": round(memory)}))


if __name__ == "__main__":
    _, program, action, *rest = sys.argv
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if action == "make":
        make(float(rest[0]), int(rest[1]), int(rest[2]), rest[3])
    elif action == "peers":
        peers(program, *rest)
    else:
        alone(program, *rest)
