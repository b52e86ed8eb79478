# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files by the conventions, and what the tool, `CellSet.read` and Datasets make of them.

Held against areas and sums that are computed here.
"""

import os
import subprocess

import numpy as np
import pytest

import rondel

netCDF4 = pytest.importorskip("netCDF4")  # noqa: N816
xarray = pytest.importorskip("xarray")
TOOL = os.environ.get("RONDEL")
DEGREES = ("degrees_east", "degree_E", "degreesE", "Degrees_East", "degrees", "arcdeg")
RADIANS = ("radian", "radians", "rad", "Radian")
NORTH = {"degrees_east": "degrees_north", "degree_E": "degree_N", "degreesE": "degreesN"}
NORTH["Degrees_East"] = "Degrees_North"
OTHER = rondel.lonlat_grid(8, 5)


def run(*arguments):
    found = subprocess.run([TOOL, *map(str, arguments)], capture_output=True, text=True)
    assert found.returncode == 0, found.stderr
    return found.stderr


def remapped(path, folder, name=""):
    """The weights and source areas that the tool writes, and what it says."""
    source = f"{path}:{name}" if name else path
    other = folder / "other.nc"
    if not other.exists():
        lon, lat = np.arange(-157.5, 180, 45), np.arange(-72.0, 90, 36)
        write(other, axes_file(lon, lat))
    said = run("remap", source, other, "-o", folder / "w.nc", "--quiet")
    with netCDF4.Dataset(folder / "w.nc") as file:
        areas = file["area_a"][:].data
    return rondel.read_weights(folder / "w.nc"), areas, said


def same_weights(a, b):
    def dense(weights):
        made = np.zeros(weights.shape)
        np.add.at(
            made,
            (np.repeat(np.arange(weights.shape[0]), np.diff(weights.indptr)), weights.indices),
            weights.data,
        )
        return made

    return a.shape == b.shape and np.allclose(dense(a), dense(b), atol=1e-12)


def axes_file(lon, lat):
    return xarray.Dataset(
        coords={
            "lon": ("lon", lon, {"units": "degrees_east"}),
            "lat": ("lat", lat, {"units": "degrees_north"}),
        }
    )


def write(path, dataset, form="NETCDF3_64BIT"):
    plain = {name: {"_FillValue": None} for name in dataset.variables}
    dataset.to_netcdf(path, format=form, encoding=plain)


def rectangles(west, east, south, north):
    """Of each latitude and longitude, in steradians."""
    height = np.sin(np.radians(north)) - np.sin(np.radians(south))
    return np.abs(height)[:, None] * np.radians(np.abs(east - west))


def polygon_area(lon, lat):
    """Of convex polygons of great circles, shape (n, k), in degrees."""
    lon, lat = np.radians(lon), np.radians(lat)
    p = np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=-1)
    total = np.zeros(len(p))
    for k in range(1, p.shape[1] - 1):
        a, b, c = p[:, 0], p[:, k], p[:, k + 1]
        along = (a * b).sum(-1) + (b * c).sum(-1) + (c * a).sum(-1)
        total += 2 * np.arctan2((a * np.cross(b, c)).sum(-1), 1 + along)
    return np.abs(total)


def check(path, dataset, areas, folder, tolerance=1e-13, name=""):
    """The same from the file and from the Dataset; returns what the tool says."""
    part = rondel.CellSet.read(f"{path}:{name}" if name else path)
    assert np.allclose(part.areas, areas.ravel(), rtol=1e-9, atol=tolerance)
    if dataset is not None:
        regridder = rondel.Regridder(dataset, OTHER, "conservative")
        assert same_weights(regridder.weights, rondel.remap(part, OTHER).weights)
    if TOOL is None:
        return ""
    weights, of_tool, said = remapped(path, folder, name)
    assert np.allclose(of_tool, areas.ravel(), rtol=1e-9, atol=tolerance)
    assert same_weights(weights, rondel.remap(part, OTHER).weights)
    return said


LON = np.array([5.0, 20.0, 50.0, 130.0, 250.0, 340.0])
LON_LINES = np.array([-5.0, 10.0, 30.0, 90.0, 190.0, 310.0, 355.0])
LAT = np.array([-70.0, -10.0, 0.0, 40.0])
LAT_LINES = np.array([-90.0, -20.0, -5.0, 10.0, 80.0])


def quadrilaterals():
    """Corners of a skewed grid of 5 x 7 cells, shape (6, 8), and centers."""
    j, i = np.meshgrid(np.arange(6.0), np.arange(8.0), indexing="ij")
    lon, lat = 170 + 4 * i + j, -30 + 5 * j - i
    middle = [(c[:-1, :-1] + c[1:, 1:]) / 2 for c in (lon, lat)]
    return lon, lat, *middle


def four(corners):
    return np.stack(
        [corners[:-1, :-1], corners[:-1, 1:], corners[1:, 1:], corners[1:, :-1]], axis=-1
    )
