#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What netCDF files mean is heeded by all commands, or it is told that it is not.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
LON, LAT = np.arange(-170.0, 180, 20), np.arange(-80.0, 81, 20)


def height(lon, lat):
    """A linear function of the place in space: that of a grid is known everywhere."""
    return np.sin(np.radians(lat)) + 0 * lon


def add(data, name, dimensions, values, fill=None, **attributes):
    """A variable of doubles, or of the type of `values`."""
    values = np.asarray(values)
    variable = data.createVariable(name, values.dtype, dimensions, fill_value=fill)
    variable.set_auto_maskandscale(False)
    variable.setncatts(attributes)
    variable[...] = values
    return variable


def add_axes(data, lon=LON, lat=LAT, suffix="", units=("degrees_east", "degrees_north")):
    for name, values, unit in (("lon", lon, units[0]), ("lat", lat, units[1])):
        data.createDimension(name + suffix, len(values))
        add(data, name + suffix, (name + suffix,), values, units=unit)


class Meaning(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "to.csv").write_text("lon,lat\n10,0\n50,40\n")

    def new(self, name):
        data = netCDF4.Dataset(self.folder / name, "w", format="NETCDF3_64BIT_OFFSET")
        self.addCleanup(lambda: data.isopen() and data.close())
        return data

    def grid(self, name="grid.nc", **attributes):
        """A file with v(lat, lon), closed."""
        data = self.new(name)
        add_axes(data)
        add(data, "v", ("lat", "lon"), height(LON[None, :], LAT[:, None]), **attributes)
        data.close()

    def run_tool(self, *arguments, status=0):
        """What the tool says."""
        done = subprocess.run(
            [TOOL, *arguments], cwd=self.folder, capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def table(self, name):
        return (self.folder / name).read_text().splitlines()

    def test_variable_chooses_its_grid(self):
        self.grid()
        data = self.new("two.nc")
        add_axes(data)
        add_axes(data, LON[:4], LAT[:3], "2")
        add(data, "v", ("lat", "lon"), np.ones((len(LAT), len(LON))))
        add(data, "w", ("lat2", "lon2"), np.ones((3, 4)))
        data.close()
        for name, shape in (("v", (len(LAT), len(LON))), ("w", (3, 4))):
            self.run_tool("interpolate", "grid.nc", "--to", f"two.nc:{name}", "-o", "o.nc")
            with netCDF4.Dataset(self.folder / "o.nc") as out:
                self.assertEqual(out["v"].shape, shape)
        for command in (
            ("interpolate", "grid.nc", "--to", "two.nc:nosuch", "-o", "n.csv"),
            ("interpolate", "two.nc:nosuch", "--to", "to.csv", "-o", "n.csv"),
            ("nearest", "grid.nc", "two.nc:nosuch", "-o", "n.csv"),
            ("nearest", "two.nc:nosuch", "to.csv", "-o", "n.csv"),
            ("delaunay", "two.nc:nosuch", "-o", "n.npy"),
            ("voronoi", "two.nc:nosuch", "-o", "n.geojson"),
            ("plot", "two.nc:nosuch", "-o", "n.svg"),
        ):
            with self.subTest(command):
                said = self.run_tool(*command, status=1)
                self.assertEqual(said, 'rondel: two.nc: no variable "nosuch"\n')
                self.assertFalse(list(self.folder.glob("n.*")))

    def test_dimensions_of_points_are_those_of_their_coordinates(self):
        data = self.new("grid.nc")
        add_axes(data)
        count = len(LON) * len(LAT)
        data.createDimension("bin", count)
        data.createDimension("i", len(LAT))
        data.createDimension("j", len(LON))
        add(data, "v", ("lat", "lon"), height(LON[None, :], LAT[:, None]))
        add(data, "histogram", ("bin",), np.arange(count) * 1.0)
        add(data, "table", ("i", "j"), np.ones((len(LAT), len(LON))))
        data.close()
        said = self.run_tool("interpolate", "grid.nc", "--to", "to.csv", "-o", "o.csv")
        self.assertIn("left out, as they have no values at the points: histogram, table", said)
        self.assertEqual(self.table("o.csv")[0], "lon,lat,v")
        self.run_tool("interpolate", "grid.nc", "--to", "to.csv", "--weights", "w.nc")
        said = self.run_tool("apply", "w.nc", "grid.nc", "-o", "o.csv")
        self.assertIn("histogram, table", said)
        self.assertEqual(self.table("o.csv")[0], "lon,lat,v")
        for name in ("histogram", "table"):
            self.run_tool("apply", "w.nc", f"grid.nc:{name}", "-o", "n.csv", status=1)

    def test_fill_is_said_and_counted(self):
        self.grid()
        self.run_tool("interpolate", "grid.nc", "--to", "to.csv", "--weights", "w.nc")
        values = height(LON[None, :], LAT[:, None])
        values[LAT < 20] = -1e30
        data = self.new("gaps.nc")
        add_axes(data)
        add(data, "v", ("lat", "lon"), values, fill=-1e30)
        data.close()
        said = self.run_tool("apply", "w.nc", "gaps.nc", "--fill", "-999", "-o", "o.nc")
        self.assertIn("1 values missing", said)
        with netCDF4.Dataset(self.folder / "o.nc") as out:
            self.assertEqual(out["v"].getncattr("_FillValue"), -999)
            self.assertEqual(list(np.ma.getmaskarray(out["v"][:])), [True, False])


if __name__ == "__main__":
    unittest.main()
