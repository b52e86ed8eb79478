#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The published benchmark of regridding: its four functions on generated grids, by Rondel, CDO and YAC, in one table.

    regrid_accuracy.py RONDEL [--json] [SOURCE TARGET]...

The functions are those of Valcke, Piacentini and Jonville (Math. Comput. Appl. 27, 31, 2022, doi 10.3390/mca27020031), sampled
at the centers of cells; the measures are those of MIRA (Mahadevan, Guerra, Jiao, Kuberry, Li and Ullrich, Geosci. Model Dev. 15,
6601, 2022), with the exact areas of the cells:

L2, Linf        the norms of the error at the targets, divided by the function's
global          the difference of both integrals, divided by that of the absolute values at the sources
over, under     by how much a value is above the largest or below the least one of the sources, divided by the largest absolute value
local           of conservative weights: the largest relative difference of the area that a source gives away (check-weights)
weights         of conservative weights: the largest difference of a weight from the exact one (check-weights); - for second order

Grids are names (healpix:6, N80, F80, C64, R2B4); all programs read the same two files. Every error is a share, 0 to 1. CDO is
used if it is installed, YAC if its Python package is there. CDO's second order is left out: it is SCRIP's, which draws sides as
lines in longitude and latitude and so goes wrong where a corner is at a pole. Nothing is timed. Needs rondel, NumPy, netCDF4.
"""

import importlib.util
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import netCDF4
import numpy as np

import rondel

PAIRS = [("N80", "R2B4"), ("R2B4", "F80"), ("C64", "N80"), ("F80", "healpix:6")]
CONSERVATIVE = "conservative"
# The options of `rondel regrid`, and those of `rondel remap` that makes the same weights.
RONDEL = {
    "conservative": (["--method", "conservative"], ["--norm", "fracarea"]),
    "conservative, order 2": (["--method", "conservative-2nd"], ["--norm", "fracarea", "--order", "2"]),
    "conservative, order 2, bounds": (["--method", "conservative-2nd", "--limiter", "bounds"], None),
    "linear": (["--method", "linear"], None),
    "sibson": (["--method", "sibson"], None),
    "hermite": (["--method", "hermite"], None),
    "cubic": (["--method", "cubic"], None),
    "nearest": (["--method", "nearest"], None),
}
# The operators of CDO, and those that write the same weights in files that have one weight a link.
CDO = {
    "conservative": ("remapcon", "gencon"),
    "bilinear": ("remapbil", None),
    "bicubic": ("remapbic", None),
    "distance": ("remapdis", None),
    "nearest": ("remapnn", None),
}


def sinusoid(lon, lat):
    return 2 - np.cos(np.pi * np.arccos(np.clip(np.cos(lat) * np.cos(lon), -1, 1)) / (1.2 * np.pi))


def harmonic(lon, lat):
    return 2 + np.sin(2 * lat) ** 16 * np.cos(16 * lon)


def vortex(lon, lat):
    """Two whirls of Nair and Jablonowski around a turned pole."""
    pole_lon, pole_lat, radius, width, time = 5.5, 0.2, 3.0, 5.0, 6.0
    along = np.cos(lat) * np.cos(lon - pole_lon)
    x = np.sin(pole_lat) * along - np.cos(pole_lat) * np.sin(lat)
    y = np.cos(lat) * np.sin(lon - pole_lon)
    z = np.sin(pole_lat) * np.sin(lat) + np.cos(pole_lat) * along
    rho = radius * np.sqrt(np.maximum(1 - z**2, 0))
    speed = 3 * np.sqrt(3) / 2 / np.cosh(rho) ** 2 * np.tanh(rho)
    turn = np.divide(speed, rho, out=np.zeros_like(rho), where=rho > 0)
    return 2 * (1 + np.tanh(rho / width * np.sin(np.arctan2(y, x) - turn * time)))


def gulfstream(lon, lat):
    """The sinusoid with a narrow stream from Florida to Europe."""
    degree = np.pi / 180
    west, south = -80 * degree, 25 * degree
    to_end = np.hypot(-1.8 * degree - west, 50 * degree - south)
    to_fading = np.hypot(-25.5 * degree - west, 55.5 * degree - south)
    dx = np.remainder(lon + np.pi, 2 * np.pi) - np.pi - west
    dy = lat - south
    distance, angle = np.hypot(dx, dy), np.arctan2(dy, dx)
    fading = np.cos(np.pi / 2 * (distance - to_fading) / (to_end - to_fading))
    strength = 1.3 * (distance <= to_end) * np.where(distance > to_fading, fading, 1)
    wave = 1000 * np.sin(0.4 * (0.5 * distance + angle) + 0.007 * np.cos(50 * angle) + 0.37 * np.pi)
    return sinusoid(lon, lat) + (np.maximum(wave, 999) - 999) * strength


FUNCTIONS = {f.__name__: f for f in (sinusoid, harmonic, vortex, gulfstream)}


class Grid:
    """A grid by its name, and its file with the four functions."""

    def __init__(self, name, folder):
        self.name = name
        self.cells = rondel.CellSet.named(name)
        self.areas = self.cells.areas
        self.are_axes = name[0] == "F" or name.startswith("grid")
        self.path = folder / f"{name.replace(':', '-')}.nc"
        self.lon, self.lat = np.radians(self._write())
        self.values = {name: f(self.lon, self.lat) for name, f in FUNCTIONS.items()}

    def _write(self):
        """CF: axes with bounds, or cells with corners. Returns the degrees of all centers."""
        with netCDF4.Dataset(self.path, "w", format="NETCDF3_64BIT_OFFSET") as file:
            file.Conventions = "CF-1.8"
            dims = self._write_axes(file) if self.are_axes else self._write_cells(file)
            lon, lat = np.array(file["lon"][:]), np.array(file["lat"][:])
            if self.are_axes:
                lat, lon = (part.ravel() for part in np.meshgrid(lat, lon, indexing="ij"))
            for name, function in FUNCTIONS.items():
                field = file.createVariable(name, "f8", dims)
                if not self.are_axes:
                    field.coordinates = "lon lat"
                    field.CDI_grid_type = "unstructured"
                field[:] = function(np.radians(lon), np.radians(lat)).reshape(field.shape)
        return np.stack([lon, lat])

    def _write_axes(self, file):
        lines_lon, lines_lat = self.cells._cells.lines()[:2]
        file.createDimension("nv", 2)
        for name, lines, units in (("lat", lines_lat, "degrees_north"), ("lon", lines_lon, "degrees_east")):
            file.createDimension(name, len(lines) - 1)
            axis = file.createVariable(name, "f8", (name,))
            axis.units, axis.bounds = units, f"{name}_bnds"
            axis.standard_name = "longitude" if name == "lon" else "latitude"
            axis[:] = (lines[1:] + lines[:-1]) / 2
            file.createVariable(f"{name}_bnds", "f8", (name, "nv"))[:] = np.stack([lines[:-1], lines[1:]], axis=1)
        return ("lat", "lon")

    def corners(self):
        """The numbers of the corners of each cell, the last one repeated, and their degrees."""
        _, rings, corners, points = self.cells.rings
        sizes = np.diff(rings)
        columns = np.minimum(np.arange(sizes.max())[None, :], sizes[:, None] - 1)
        lon, lat = rondel.lonlat(points).T
        return corners[rings[:-1, None] + columns], lon, lat

    def _write_cells(self, file):
        lon, lat = rondel.lonlat(self.cells.centers).T
        corners, corner_lon, corner_lat = self.corners()
        file.createDimension("cell", len(lon))
        file.createDimension("nv", corners.shape[1])
        for name, values, bounds, units in (
            ("lon", lon, corner_lon, "degrees_east"),
            ("lat", lat, corner_lat, "degrees_north"),
        ):
            center = file.createVariable(name, "f8", ("cell",))
            center.units, center.bounds = units, f"{name}_bnds"
            center.standard_name = "longitude" if name == "lon" else "latitude"
            center[:] = values
            file.createVariable(f"{name}_bnds", "f8", ("cell", "nv"))[:] = bounds[corners]
        return ("cell",)


def run(*command):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def values_in(path):
    with netCDF4.Dataset(path) as file:
        return {name: np.ma.filled(file[name][:], np.nan).astype("f8").ravel() for name in FUNCTIONS}


def measures(source, target, found):
    """The measures of each function."""
    made = {}
    for name, values in found.items():
        exact, given = target.values[name], source.values[name]
        error = values - exact
        made[name] = {
            "missing": int(np.isnan(values).sum()),
            "L1": np.nansum(target.areas * abs(error)) / (target.areas @ abs(exact)),
            "L2": np.sqrt(np.nansum(target.areas * error**2) / (target.areas @ exact**2)),
            "Linf": np.nanmax(abs(error)) / abs(exact).max(),
            "global": abs(np.nansum(target.areas * values) - source.areas @ given) / (source.areas @ abs(given)),
            "over": max(np.nanmax(values) - given.max(), 0) / abs(given).max(),
            "under": max(given.min() - np.nanmin(values), 0) / abs(given).max(),
        }
    return made


def judged(weights, source, target):
    """What exact areas say of a file of weights."""
    report = rondel.check_weights(weights, source.path, target.path)
    of = report.comparison
    return {
        "local": of.local_conservation,
        "weights": None if of.sums_only else of.max_error,
        "wrong": of.wrong + of.missing + of.needless,
        "norm": of.norm,
    }


def by_rondel(tool, source, target, folder):
    for name, (options, weights) in RONDEL.items():
        run(tool, "regrid", source.path, target.path, "-o", folder / "out.nc", "--quiet", *options)
        row = {"program": "Rondel", "method": name, "functions": measures(source, target, values_in(folder / "out.nc"))}
        if weights:
            run(tool, "remap", source.path, target.path, "-o", folder / "w.nc", "--quiet", *weights)
            row |= judged(folder / "w.nc", source, target)
        yield row


def by_cdo(source, target, folder):
    for name, (remap, gen) in CDO.items():
        try:
            run("cdo", "-s", "-b", "F64", "-f", "nc", f"{remap},{target.path}", source.path, folder / "out.nc")
        except subprocess.CalledProcessError as error:
            print(f"cdo {remap}: {error.stderr.decode().strip().splitlines()[-1]}", file=sys.stderr)
            continue
        row = {"program": "CDO", "method": name, "functions": measures(source, target, values_in(folder / "out.nc"))}
        if gen:
            run("cdo", "-s", f"{gen},{target.path}", source.path, folder / "w.nc")
            row |= judged(folder / "w.nc", source, target)
        yield row


def yac_grid(grid, name):
    from yac import core as yac

    cell = yac.yac_location.YAC_LOC_CELL
    if grid.are_axes:
        lon, lat = (np.radians(lines) for lines in grid.cells._cells.lines()[:2])
        made = yac.BasicGrid.reg_2d_new(name, lon[:-1], lat, [True, False])
    else:
        _, rings, corners, points = grid.cells.rings
        lon, lat = np.radians(rondel.lonlat(points)).T
        made = yac.BasicGrid.unstruct_new(name, np.diff(rings).astype(np.intc), lon, lat, corners.astype(np.intc))
    made.set_global_index(cell, np.arange(len(grid.areas), dtype=np.intc))  # otherwise it makes numbers of its own
    return yac.InterpField(made.add_coordinates(cell))


def by_yac(source, target, folder):
    from yac import core as yac

    sides = [yac_grid(source, "source"), yac_grid(target, "target")]
    for order in (1, 2):
        stack = yac.InterpolationStack()
        stack.add_conservative(order)
        path = folder / f"yac-{order}.nc"  # a file that exists would end the program
        yac.compute_weights(stack, *sides).write_to_file(str(path), "source", "target")
        with netCDF4.Dataset(path) as file:
            columns, rows = (np.array(file[name][:]) - 1 for name in ("src_address", "dst_address"))
            weights = np.array(file["remap_matrix"][:, 0])
        found = {
            name: np.bincount(rows, weights * values[columns], len(target.areas)) for name, values in source.values.items()
        }
        row = {"program": "YAC", "method": CONSERVATIVE + (", order 2" if order == 2 else "")}
        row["functions"] = measures(source, target, found)
        yield row | (judged(path, source, target) if order == 1 else {})


def table(rows):
    """Markdown: a row for each pair of grids and method."""
    names = list(FUNCTIONS)
    yield "| from, to | program | method | " + " | ".join(f"L2 {n}" for n in names) + " | Linf gulfstream | global | local | weights | over | under |"
    yield "| --- " * (len(names) + 9) + "|"
    for row in rows:
        of = row["functions"]
        numbers = [of[n]["L2"] for n in names] + [of["gulfstream"]["Linf"], max(f["global"] for f in of.values())]
        numbers += [row.get("local"), row.get("weights")] + [max(f[k] for f in of.values()) for k in ("over", "under")]
        cells = ["-" if number is None else f"{number:.1e}" for number in numbers]
        yield f"| {row['from']}, {row['to']} | {row['program']} | {row['method']} | " + " | ".join(cells) + " |"


def main():
    words = [word for word in sys.argv[1:] if word != "--json"]
    tool, names = words[0], words[1:]
    rows = []
    for source_name, target_name in list(zip(names[::2], names[1::2], strict=True)) or PAIRS:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            source, target = (Grid(grid, folder) for grid in (source_name, target_name))
            made = list(by_rondel(tool, source, target, folder))
            made += by_cdo(source, target, folder) if shutil.which("cdo") else []
            made += by_yac(source, target, folder) if importlib.util.find_spec("yac") else []
            rows += [{"from": source_name, "to": target_name} | row for row in made]
    print(json.dumps(rows, indent=1) if "--json" in sys.argv else "\n".join(table(rows)))


if __name__ == "__main__":
    main()
