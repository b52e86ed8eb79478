#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds and meshes that files repeat along time or another dimension, as those have that were joined: equal records
count once, and records that differ are an error.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder

LON, LAT = np.arange(-165.0, 180, 30), np.arange(-75.0, 90, 30)
EAST, NORTH = np.arange(5.0, 45, 10), np.arange(-10.0, 20, 10)
RECORDS = 3


def write(path, sizes, variables, unlimited=(), kind="NETCDF3_64BIT_OFFSET"):
    """A file with variables: dimensions, values and attributes."""
    with netCDF4.Dataset(path, "w", format=kind) as data:
        for name, size in sizes.items():
            data.createDimension(name, None if name in unlimited else size)
        for name, (dimensions, values, attributes) in variables.items():
            made = data.createVariable(name, np.asarray(values).dtype, dimensions)
            made.setncatts(attributes)
            made[...] = values


def repeated(values, dimensions, record, order):
    """Values with a record in front, in the order of dimensions that is asked for."""
    all_dims = (record, *dimensions)
    values = np.broadcast_to(values, (RECORDS, *np.shape(values))).copy()
    return values.transpose([all_dims.index(name) for name in order])


def axes(record, order, change=0.0):
    """A field on axes with bounds, the last record of which changes."""
    made = {}
    sizes = {record: RECORDS, "lat": len(LAT), "lon": len(LON), "two": 2}
    for name, centers, unit in (("lat", LAT, "degrees_north"), ("lon", LON, "degrees_east")):
        own = [name if dim == "cell" else dim for dim in order]
        bounds = np.stack([centers - 15, centers + 15], -1)
        found = repeated(bounds, (name, "two"), record, own)
        inner = [slice(None)] * found.ndim
        inner[own.index(record)] = RECORDS - 1
        inner[own.index(name)] = 1
        inner[own.index("two")] = 0
        found[tuple(inner)] += change if name == "lat" else 0
        made[name] = ((name,), centers, {"units": unit, "bounds": name + "_bnds"})
        made[name + "_bnds"] = (own, found, {})
    values = np.random.default_rng(1).random((RECORDS, len(LAT), len(LON)))
    made["t"] = ((record, "lat", "lon"), values, {})
    return sizes, made


def curvilinear(record, order, change=0.0):
    """The same with coordinates of two dimensions."""
    lon, lat = np.meshgrid(EAST, NORTH)
    sizes = {record: RECORDS, "y": len(NORTH), "x": len(EAST), "v": 4}
    made = {}
    for name, centers, unit, sides in (
        ("lat", lat, "degrees_north", (-1, -1, 1, 1)),
        ("lon", lon, "degrees_east", (-1, 1, 1, -1)),
    ):
        bounds = centers[..., None] + 5 * np.array(sides)
        found = repeated(bounds, ("y", "x", "v"), record, order)
        last = np.moveaxis(found, order.index(record), 0)[-1]
        last += change if name == "lon" else 0
        made[name] = (("y", "x"), centers, {"units": unit, "bounds": name + "_v"})
        made[name + "_v"] = (order, found, {})
    values = np.random.default_rng(2).random((RECORDS, *lon.shape))
    made["t"] = ((record, "y", "x"), values, {"coordinates": "lon lat"})
    return sizes, made


class Records(ToolInFolder):
    def means(self, name, target):
        said = self.run_tool("regrid", name, target, "-o", "out.nc", "--quiet")
        self.assertEqual(said, [])
        with netCDF4.Dataset(self.folder / "out.nc") as data:
            self.assertNotIn("lat_v", data.variables)
            return data["t"][:]

    def plain(self, given, corners):
        """The variables with the bounds of one record, and with the corners last."""
        sizes, variables = given
        made = dict(variables)
        for name in ("lat", "lon"):
            bounds = variables[name][2]["bounds"]
            dims, values, attributes = variables[bounds]
            centers = variables[name][0]
            record = next(dim for dim in dims if dim not in (*centers, corners))
            one = np.take(values, 0, axis=dims.index(record))
            left = [dim for dim in dims if dim != record]
            order = [*centers, corners]
            made[bounds] = (order, one.transpose([left.index(dim) for dim in order]), attributes)
        write(self.folder / "plain.nc", sizes, made)

    def test_bounds_of_axes_count_once(self):
        for record in ("time", "record", "level"):
            self.plain(axes(record, [record, "cell", "two"]), "two")
            expected = self.means("plain.nc", "grid:60")
            for order in ([record, "cell", "two"], ["cell", "two", record], ["two", record, "cell"]):
                write(self.folder / "many.nc", *axes(record, order), unlimited=[record] if order[0] == record else ())
                found = self.means("many.nc", "grid:60")
                np.testing.assert_array_equal(found, expected, str(order))

    def test_bounds_of_two_dimensions_count_once(self):
        for record in ("time", "member"):
            for kind in ("NETCDF3_64BIT_OFFSET", "NETCDF4"):
                self.plain(curvilinear(record, [record, "y", "x", "v"]), "v")
                expected = self.means("plain.nc", "grid:10")
                # Three rows of 10 degrees lie across four of the target, and four columns in as many.
                self.assertEqual(np.ma.count(expected[0]), 16)
                for order in ([record, "y", "x", "v"], ["y", "x", "v", record], ["x", record, "v", "y"]):
                    write(self.folder / "many.nc", *curvilinear(record, order), kind=kind)
                    found = self.means("many.nc", "grid:10")
                    np.testing.assert_array_equal(found, expected, str(order))

    def test_bounds_of_one_record(self):
        sizes, variables = axes("time", ["time", "cell", "two"])
        sizes["time"] = 1
        variables = {
            name: (dims, values[:1] if dims[0] == "time" else values, attributes)
            for name, (dims, values, attributes) in variables.items()
        }
        write(self.folder / "one.nc", sizes, variables, unlimited=["time"])
        self.assertEqual(self.means("one.nc", "grid:60").shape, (1, 3, 6))

    def test_cells_that_change_are_refused(self):
        for made, orders in (
            (axes, (["time", "cell", "two"], ["cell", "two", "time"], ["level", "cell", "two"])),
            (curvilinear, (["time", "y", "x", "v"], ["y", "x", "v", "time"], ["y", "member", "x", "v"])),
        ):
            for order in orders:
                record = next(name for name in order if name in ("time", "level", "member"))
                write(self.folder / "moves.nc", *made(record, order, change=0.5))
                for command in (["regrid", "moves.nc", "grid:30"], ["remap", "moves.nc", "grid:30"]):
                    said = self.run_tool(*command, "-o", "out.nc", status=1)
                    self.assertIn("cells that change are not read", said[0])
                    self.assertIn(f"along '{record}'", said[0])
                    self.assertFalse((self.folder / "out.nc").exists())

    def joined(self, name, made, change=""):
        """Writes a file all of whose numbers have times in front, of which the last one may change a variable."""
        with netCDF4.Dataset(self.folder / name) as given, netCDF4.Dataset(
            self.folder / made, "w", format=given.data_model
        ) as data:
            given.set_auto_maskandscale(False)
            data.setncatts(vars(given))
            unlimited = any(one.isunlimited() for one in given.dimensions.values())
            data.createDimension("time", RECORDS if unlimited else None)
            for dim, one in given.dimensions.items():
                data.createDimension(dim, None if one.isunlimited() else len(one))
            for variable_name, variable in given.variables.items():
                has_times = variable.ndim > 0 and variable.dtype.kind in "if"
                dims = (("time",) if has_times else ()) + variable.dimensions
                attributes = {key: value for key, value in vars(variable).items() if key != "_FillValue"}
                fill = getattr(variable, "_FillValue", None)
                new = data.createVariable(variable_name, variable.dtype, dims, fill_value=fill)
                new.set_auto_maskandscale(False)
                new.setncatts(attributes)
                if not has_times:
                    new[...] = variable[...]
                    continue
                for k in range(RECORDS):
                    values = variable[...]
                    new[k] = values[::-1] if variable_name == change and k == RECORDS - 1 else values

    def test_meshes_count_once(self):
        for form, cells, part in (
            ("ugrid", "n_face", "node_lon"),
            ("mpas", "nCells", "verticesOnCell"),
            ("scrip", "grid_size", "grid_corner_lat"),
            ("esmf", "elementCount", "elementConn"),
        ):
            for ending in ("nc", "nc4"):
                mesh = f"mesh.{ending}"
                self.run_tool("mesh", "points", "poisson", "--radius", "2000", "-o", mesh, "--format", form, "--quiet")
                with netCDF4.Dataset(self.folder / mesh, "a") as data:
                    made = data.createVariable("x", "f8", (cells,))
                    made[...] = np.arange(len(data.dimensions[cells]))
                    extra = {"mesh": "mesh", "location": "face", "coordinates": "face_lon face_lat"}
                    made.setncatts(extra if form == "ugrid" else {})
                self.run_tool("regrid", mesh, "grid:30", "-o", "one.nc", "--value", "x", "--quiet")
                self.joined(mesh, f"many.{ending}")
                self.run_tool("regrid", f"many.{ending}", "grid:30", "-o", "out.nc", "--value", "x", "--quiet")
                with netCDF4.Dataset(self.folder / "one.nc") as one, netCDF4.Dataset(self.folder / "out.nc") as many:
                    self.assertEqual(many["x"].shape, (RECORDS, 6, 12))
                    for k in range(RECORDS):
                        np.testing.assert_array_equal(many["x"][k], one["x"][:], form)
                self.joined(mesh, f"moves.{ending}", change=part)
                said = self.run_tool("regrid", f"moves.{ending}", "grid:30", "-o", "m.nc", "--value", "x", status=1)
                self.assertIn(f'variable "{part}" changes with time: meshes that move are not read', said[0])


if __name__ == "__main__":
    unittest.main()
