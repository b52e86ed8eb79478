#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What netCDF files mean is heeded by all commands, or it is told that it is not.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import json
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder

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


class Files(ToolInFolder):
    """A folder with files of netCDF, and the tool in it."""

    def setUp(self):
        super().setUp()
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

    def table(self, name):
        return (self.folder / name).read_text().splitlines()


class Meaning(Files):
    def test_variable_chooses_its_grid(self):
        self.grid()
        data = self.new("two.nc")
        add_axes(data)
        add_axes(data, LON[:4], LAT[:3], "2")
        add(data, "v", ("lat", "lon"), np.ones((len(LAT), len(LON))))
        add(data, "w", ("lat2", "lon2"), np.ones((3, 4)))
        data.close()
        for name, shape in (("v", (len(LAT), len(LON))), ("w", (3, 4))):
            self.said("interpolate", "grid.nc", "--to", f"two.nc:{name}", "-o", "o.nc")
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
                said = self.said(*command, status=1)
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
        said = self.said("interpolate", "grid.nc", "--to", "to.csv", "-o", "o.csv")
        self.assertIn("left out, as they have no values at the points: histogram, table", said)
        self.assertEqual(self.table("o.csv")[0], "lon,lat,v")
        self.said("interpolate", "grid.nc", "--to", "to.csv", "--weights", "w.nc")
        said = self.said("apply", "w.nc", "grid.nc", "-o", "o.csv")
        self.assertIn("histogram, table", said)
        self.assertEqual(self.table("o.csv")[0], "lon,lat,v")
        for name in ("histogram", "table"):
            self.said("apply", "w.nc", f"grid.nc:{name}", "-o", "n.csv", status=1)

    def test_weights_that_are_not_finite_are_refused(self):
        self.grid()
        for bad in (np.inf, np.nan):
            self.said("interpolate", "grid.nc", "--to", "to.csv", "--weights", "w.nc")
            with netCDF4.Dataset(self.folder / "w.nc", "a") as weights:
                weights["S"][1] = bad
            said = self.said("apply", "w.nc", "grid.nc", "-o", "n.csv", status=1)
            self.assertEqual(said, f"rondel: w.nc: weight 1 is {bad}\n")
            self.assertFalse(list(self.folder.glob("n.*")))

    def test_areas_of_scrip_are_divided_by_those_of_targets(self):
        self.grid()
        self.said("remap", "grid.nc", "grid:60", "--format", "scrip", "-o", "w.nc")
        self.said("apply", "w.nc", "grid.nc", "-o", "right.csv")
        with netCDF4.Dataset(self.folder / "w.nc", "a") as weights:
            weights.delncattr("rondel_method")
            weights.normalization = "none"
            rows = weights["dst_address"][:] - 1
            weights["remap_matrix"][:, 0] *= weights["dst_grid_area"][:][rows]
        said = self.said("apply", "w.nc", "grid.nc", "-o", "o.csv")
        self.assertIn('w.nc: the normalization is "none": its weights, which are areas,', said)
        right, found = (
            np.loadtxt(self.folder / name, delimiter=",", skiprows=1)
            for name in ("right.csv", "o.csv")
        )
        np.testing.assert_allclose(found, right, rtol=1e-14)
        self.assertIn("divided by those of the targets", self.said("check-weights", "w.nc"))
        with netCDF4.Dataset(self.folder / "w.nc", "a") as weights:
            weights["dst_grid_area"][:] = 0
        said = self.said("apply", "w.nc", "grid.nc", "-o", "n.csv", status=1)
        self.assertIn("there are no areas of targets, dst_grid_area, to divide them by", said)

    def test_axes_of_cells_are_in_order(self):
        for name, lon, lat, reason in (
            ("lat", LON, LAT[[0, 2, 1, 3]], "latitude 2, -60, is not north of latitude 1, -40,"),
            ("lat", LON, LAT[[0, 1, 1, 3]], "latitude 2, -60, repeats latitude 1, -60,"),
            ("lon", LON[[0, 2, 1, 3]], LAT, "longitude 2, -150, is not east of longitude 1, -130,"),
            ("lon", LON[[0, 1, 1, 3]], LAT, "longitude 2, -150, repeats longitude 1, -150,"),
        ):
            data = self.new("wrong.nc")
            add_axes(data, lon, lat)
            add(data, "v", ("lat", "lon"), np.ones((len(lat), len(lon))))
            data.close()
            for sides in (("wrong.nc", "grid:60"), ("grid:60", "wrong.nc")):
                with self.subTest(f"{reason} {sides}"):
                    said = self.said("remap", *sides, "-o", "n.nc", status=1)
                    self.assertIn(f'wrong.nc: variable "{name}": {reason}', said)
                    self.assertFalse(list(self.folder.glob("n.*")))

    def test_tables_may_be_off_by_what_they_round(self):
        text = "lon,lat,v\n" + "".join(
            f"{30 * i + 0.123456789},{10 * (i % 5) + 0.987654321},{i}\n" for i in range(12)
        )
        (self.folder / "s.csv").write_text(text)
        self.said("interpolate", "s.csv", "--to", "to.csv", "--weights", "w.nc")
        self.said("apply", "w.nc", "s.csv", "--value", "v", "-o", "right.csv")
        rounded = text.replace("123456789", "12346").replace("987654321", "98765")
        (self.folder / "rounded.csv").write_text(rounded)
        self.said("apply", "w.nc", "rounded.csv", "--value", "v", "-o", "o.csv")
        self.assertEqual(self.table("o.csv"), self.table("right.csv"))
        (self.folder / "far.csv").write_text(text.replace("123456789", "1237"))
        said = self.said("apply", "w.nc", "far.csv", "--value", "v", "-o", "n.csv", status=1)
        self.assertIn("far.csv: its points are not the sources of w.nc", said)

    def staggered(self):
        """cos(lon) at two kinds of points: t(lat, lon), u(lat, lon_u), and their values at times."""
        data = self.new("c.nc")
        add_axes(data)
        data.createDimension("lon_u", len(LON))
        data.createDimension("time", 2)
        add(data, "lon_u", ("lon_u",), LON + 10, units="degrees_east")
        shape = (len(LAT), len(LON))
        for name, axis in (("t", LON), ("u", LON + 10)):
            dims = ("lat", "lon" if name == "t" else "lon_u")
            values = np.broadcast_to(np.cos(np.radians(axis)), shape)
            add(data, name, dims, values)
            add(data, name + "s", ("time", *dims), np.stack([values, 2 * values]))
        data.close()

    def test_values_are_at_their_own_places_whatever_is_named(self):
        self.staggered()
        (self.folder / "at.csv").write_text("lon,lat\n20,0\n")
        nearest = ("--to", "at.csv", "--method", "nearest", "-o", "o.csv")
        self.said("interpolate", "c.nc", "--value", "u", *nearest)
        self.assertAlmostEqual(float(self.table("o.csv")[1].split(",")[2]), np.cos(np.pi / 9))
        said = self.said("interpolate", "c.nc", *nearest)
        self.assertIn(
            "at other places than lon and lat: u (lon_u and lat), us (lon_u and lat)", said
        )
        self.assertEqual(self.table("o.csv")[0], "lon,lat,t,ts_0,ts_1")
        for names in (("t", "u"), ("u", "t")):
            options = [word for name in names for word in ("--value", name)]
            said = self.said("interpolate", "c.nc", *options, *nearest, status=1)
            self.assertIn('"t"', said)
            self.assertIn('"u"', said)
        self.said("remap", "c.nc:t", "grid:60", "-o", "w.nc")
        self.assertIn("u (lon_u and lat)", self.said("apply", "w.nc", "c.nc", "-o", "o.csv"))
        self.assertEqual(self.table("o.csv")[0], "lon,lat,t,ts_0,ts_1")
        self.said("apply", "w.nc", "c.nc:u", "-o", "n.csv", status=1)
        self.assertIn("fields: t, ts (time 2)", self.said("info", "c.nc"))
        self.assertFalse(list(self.folder.glob("n.*")))

    def test_columns_are_one_of_several_fields(self):
        self.staggered()
        (self.folder / "at.csv").write_text("lon,lat\n20,0\n")
        for name, factor in (("us[0]", 1), ("us[-1]", 2), ("us_1", 2), ("u", 1)):
            self.said("nearest", "c.nc", "at.csv", "--column", name, "-o", "o.csv")
            self.assertEqual(self.table("o.csv")[0].split(",")[-1], name)
            value = float(self.table("o.csv")[1].split(",")[-1])
            self.assertAlmostEqual(value, factor * np.cos(np.pi / 9))
        self.said("nearest", "c.nc:ts", "at.csv", "--column", "ts[1]", "-o", "o.csv")
        said = self.said("nearest", "c.nc", "at.csv", "--column", "us", "-o", "n.csv", status=2)
        self.assertIn("us[0]", said)
        data = self.new("h.nc")
        add_axes(data)
        data.createDimension("time", 2)
        sizes = np.full((2, len(LAT), len(LON)), 4000.0)
        sizes[1] = 2000
        add(data, "h", ("time", "lat", "lon"), sizes, units="km")
        data.close()
        counts = []
        for name in ("h[0]", "h[1]"):
            self.said(
                "mesh", "scvt", "--spacing", f"h.nc:{name}", "--max-steps", "1", "-o", "m.nc"
            )
            with netCDF4.Dataset(self.folder / "m.nc") as mesh:
                counts.append(len(mesh.dimensions["nCells"]))
        self.assertGreater(counts[1], 3 * counts[0])
        self.said(
            "mesh", "scvt", "--spacing", "h.nc:h", "--max-steps", "1", "-o", "n.nc", status=1
        )

    def test_grids_that_are_targets_are_told(self):
        self.grid()
        self.staggered()
        said = self.said("interpolate", "grid.nc", "--to", "c.nc", "-o", "o.nc")
        self.assertIn("that of lon and lat is read, not that of lon_u and lat", said)
        data = self.new("curved.nc")
        for name, length in (("y", 3), ("x", 4), ("yu", 3), ("xu", 3)):
            data.createDimension(name, length)
        for kind, dims in (("rho", ("y", "x")), ("u", ("yu", "xu"))):
            shape = tuple(len(data.dimensions[name]) for name in dims)
            lon, lat = np.meshgrid(10.0 * np.arange(shape[1]), 10.0 * np.arange(shape[0]))
            add(data, "lon_" + kind, dims, lon, units="degrees_east")
            add(data, "lat_" + kind, dims, lat, units="degrees_north")
            add(data, "v" + kind, dims, lon, coordinates=f"lon_{kind} lat_{kind}")
        data.close()
        said = self.said("interpolate", "grid.nc", "--to", "curved.nc", "-o", "o.nc")
        self.assertIn("that of lon_rho and lat_rho is read, not that of lon_u and lat_u", said)
        said = self.said("interpolate", "grid.nc", "--to", "curved.nc:vu", "-o", "o.nc")
        self.assertNotIn("several grids", said)
        self.assertIn("to 9 targets", said)

    def test_types_of_the_file_itself_are_told(self):
        data = netCDF4.Dataset(self.folder / "enum.nc", "w")
        self.addCleanup(lambda: data.isopen() and data.close())
        add_axes(data)
        kind = data.createEnumType(np.uint8, "kind", {"sea": 0, "land": 1})
        data.createVariable("surface", kind, ("lat", "lon"), fill_value=0)
        data.close()
        said = self.said(
            "interpolate", "enum.nc:surface", "--to", "to.csv", "-o", "n.csv", status=1
        )
        self.assertIn('variable "surface" has a type that the file defines itself', said)

    def test_fill_is_said_and_counted(self):
        self.grid()
        self.said("interpolate", "grid.nc", "--to", "to.csv", "--weights", "w.nc")
        values = height(LON[None, :], LAT[:, None])
        values[LAT < 20] = -1e30
        data = self.new("gaps.nc")
        add_axes(data)
        add(data, "v", ("lat", "lon"), values, fill=-1e30)
        data.close()
        said = self.said("apply", "w.nc", "gaps.nc", "--fill", "-999", "-o", "o.nc")
        self.assertIn("1 values missing", said)
        with netCDF4.Dataset(self.folder / "o.nc") as out:
            self.assertEqual(out["v"].getncattr("_FillValue"), -999)
            self.assertEqual(list(np.ma.getmaskarray(out["v"][:])), [True, False])

    def test_axes_along_which_nothing_lies_are_no_grid(self):
        lon, lat = (grid.ravel() for grid in np.meshgrid(LON, LAT))
        data = self.new("cells.nc")
        data.createDimension("cell", len(lon))
        data.createDimension("level", 3)
        add(data, "clon", ("cell",), lon, units="degrees_east")
        add(data, "clat", ("cell",), lat, units="degrees_north")
        add(data, "level", ("level",), np.arange(3.0), units="degrees_north")
        add(data, "zm", ("level",), np.arange(3.0))
        add(data, "v", ("cell",), height(lon, lat), coordinates="clon clat")
        data.close()
        said = self.said("interpolate", "cells.nc", "--to", "to.csv", "-o", "o.csv")
        self.assertIn(f"{len(lon)} sites", said)
        self.assertEqual(self.table("o.csv")[0], "lon,lat,v")

    def test_masked_cells_are_no_sites(self):
        lon, lat = (grid.ravel() for grid in np.meshgrid(LON, LAT))
        mask = np.arange(len(lon)) % 5 != 3
        data = self.new("scrip.nc")
        data.createDimension("grid_size", len(lon))
        data.createDimension("grid_corners", 4)
        add(data, "grid_center_lon", ("grid_size",), lon, units="degrees")
        add(data, "grid_center_lat", ("grid_size",), lat, units="degrees")
        corners = ("grid_size", "grid_corners")
        add(data, "grid_corner_lon", corners, lon[:, None] + [-1, 1, 1, -1], units="degrees")
        add(data, "grid_corner_lat", corners, lat[:, None] + [-1, -1, 1, 1], units="degrees")
        add(data, "grid_imask", ("grid_size",), mask * 1.0)
        data.close()
        said = self.said("nearest", "scrip.nc", "scrip.nc", "-o", "o.csv")
        self.assertIn(f"left out {len(lon) - mask.sum()} masked sites", said)
        self.assertEqual(len(self.table("o.csv")), 1 + mask.sum())
        for command in (
            ("delaunay", "scrip.nc", "-o", "t.npy"),
            ("check", "scrip.nc", "t.npy"),
            ("voronoi", "scrip.nc", "-o", "v.geojson"),
            ("graph", "scrip.nc", "--kind", "gabriel", "-o", "g.npy"),
            ("plot", "scrip.nc", "-o", "p.svg"),
            ("contours", "scrip.nc", "--value", "grid_imask", "--levels", "1", "-o", "c.geojson"),
        ):
            with self.subTest(command):
                self.assertIn("masked sites", self.said(*command))

    def test_infinite_values_are_refused(self):
        values = height(LON[None, :], LAT[:, None])
        values[4, 9] = np.inf
        data = self.new("inf.nc")
        add_axes(data)
        add(data, "v", ("lat", "lon"), values)
        data.close()
        said = self.said("interpolate", "inf.nc", "--to", "to.csv", "-o", "n.csv", status=1)
        place = 4 * len(LON) + 9
        self.assertEqual(
            said, f'rondel: inf.nc: variable "v": value inf at point {place} is not finite\n'
        )
        self.assertFalse((self.folder / "n.csv").exists())

    def test_ranges_that_are_texts(self):
        values = height(LON[None, :], LAT[:, None])
        values[4, 9] = 99
        for text, is_heeded in (("-5 5", True), ("-5, 5", True), ("some", False)):
            with self.subTest(text):
                data = self.new("range.nc")
                add_axes(data)
                add(data, "v", ("lat", "lon"), values, valid_range=text)
                data.close()
                said = self.said("interpolate", "range.nc", "--to", "to.csv", "-o", "o.csv")
                value = float(self.table("o.csv")[1].split(",")[2])
                self.assertEqual(value < 2, is_heeded)
                self.assertEqual("valid_range is not heeded" in said, not is_heeded)

    def test_units_that_are_no_degrees_are_named(self):
        for units in ("m", "gon"):
            data = self.new("units.nc")
            add_axes(data, units=(units, units))
            add(data, "v", ("lat", "lon"), np.ones((len(LAT), len(LON))))
            data.close()
            for command in (
                ("interpolate", "units.nc", "--to", "to.csv", "-o", "n.csv"),
                ("delaunay", "units.nc", "-o", "n.npy"),
                ("remap", "units.nc", "grid:90", "-o", "n.nc"),
            ):
                with self.subTest(command, units=units):
                    said = self.said(*command, status=1)
                    self.assertIn(f"'lon' has the units '{units}'", said)
                    self.assertIn(f"'lat' has the units '{units}'", said)

    def test_radius_of_a_mesh_that_is_read(self):
        sites = np.random.default_rng(1).normal(size=(92, 3))
        np.save(self.folder / "sites.npy", sites / np.linalg.norm(sites, axis=1)[:, None])
        self.said("mesh", "convert", "sites.npy", "-o", "unit.nc")
        radius = 6371229.0
        (self.folder / "none.csv").write_text("remove\n" + "0\n" * 92)
        for command in (
            ("convert", "unit.nc", "-o", "o.nc"),
            ("cull", "unit.nc", "-o", "o.nc", "--mask", "none.csv:remove"),
        ):
            with self.subTest(command):
                self.said("mesh", *command, "--sphere-radius", str(radius))
                with (
                    netCDF4.Dataset(self.folder / "unit.nc") as unit,
                    netCDF4.Dataset(self.folder / "o.nc") as out,
                ):
                    self.assertEqual(out.sphere_radius, radius)
                    for name, power in (
                        ("xCell", 1),
                        ("zVertex", 1),
                        ("yEdge", 1),
                        ("dcEdge", 1),
                        ("dvEdge", 1),
                        ("areaCell", 2),
                        ("areaTriangle", 2),
                        ("kiteAreasOnVertex", 2),
                        ("lonCell", 0),
                        ("angleEdge", 0),
                        ("weightsOnEdge", 0),
                    ):
                        wanted = unit[name][:] * radius**power
                        np.testing.assert_allclose(out[name][:], wanted, 1e-12, 1e-9 * power)
                # Without the option the mesh keeps its own.
                self.said("mesh", "convert", "o.nc", "-o", "again.nc")
                with netCDF4.Dataset(self.folder / "again.nc") as again:
                    self.assertEqual(again.sphere_radius, radius)

    def test_masks_and_fields_of_any_number_type(self):
        sites = np.random.default_rng(2).normal(size=(50, 3))
        np.save(self.folder / "sites.npy", sites / np.linalg.norm(sites, axis=1)[:, None])
        self.said("mesh", "convert", "sites.npy", "-o", "mesh.nc")
        self.said("interpolate", "sites.npy", "--to", "to.csv", "--weights", "w.npz")
        mask = np.zeros(50)
        mask[7] = 1
        results = set()
        for dtype in ("f8", "f4", "?", "u1", "i1", "<i2", ">u2", "i4", ">i4", "u4", "i8", "u8"):
            with self.subTest(dtype):
                np.save(self.folder / "mask.npy", mask.astype(dtype))
                self.said("mesh", "cull", "mesh.nc", "--mask", "mask.npy", "-o", "o.nc")
                with netCDF4.Dataset(self.folder / "o.nc") as out:
                    self.assertEqual(out.dimensions["nCells"].size, 49)
                values = np.array([np.arange(50), mask]).astype(dtype)
                np.save(self.folder / "values.npy", values)
                self.said("apply", "w.npz", "values.npy", "-o", "o.npy")
                found = np.load(self.folder / "o.npy")
                if dtype != "?":
                    results.add(found.tobytes())
        self.assertEqual(len(results), 1)
        np.save(self.folder / "values.npy", np.full(50, 2**53 + 1))
        said = self.said("apply", "w.npz", "values.npy", "-o", "n.npy", status=1)
        self.assertIn("9007199254740993 is no double", said)
        np.save(self.folder / "values.npy", np.zeros(50, complex))
        said = self.said("apply", "w.npz", "values.npy", "-o", "n.npy", status=1)
        self.assertIn('dtype "<c16"', said)

    def test_masked_cells_of_scrip_are_no_sites(self):
        lon, lat = (grid.ravel() for grid in np.meshgrid(LON, LAT))
        mask = np.ones(len(lon), "i4")
        mask[::5] = 0
        data = self.new("scrip.nc")
        for name, size in (("grid_size", len(lon)), ("grid_corners", 4), ("grid_rank", 2)):
            data.createDimension(name, size)
        add(data, "grid_dims", ("grid_rank",), np.array([len(LON), len(LAT)], "i4"))
        add(data, "grid_imask", ("grid_size",), mask)
        for name, values, around in (
            ("lon", lon, np.array([-10, 10, 10, -10])),
            ("lat", lat, np.array([-10, -10, 10, 10])),
        ):
            add(data, f"grid_center_{name}", ("grid_size",), values, units="degrees")
            corners = values[:, None] + around
            dimensions = ("grid_size", "grid_corners")
            add(data, f"grid_corner_{name}", dimensions, corners, units="degrees")
        add(data, "v", ("grid_size",), np.where(mask == 1, height(lon, lat), 1e6))
        data.close()
        (self.folder / "kept.csv").write_text(
            "lon,lat,v\n"
            + "".join(
                f"{x!r},{y!r},{v!r}\n"
                for x, y, v, m in zip(
                    lon.tolist(), lat.tolist(), height(lon, lat).tolist(), mask, strict=True
                )
                if m
            )
        )
        said = self.said("interpolate", "scrip.nc:v", "--to", "to.csv", "-o", "o.csv")
        self.assertIn("left out", said)
        self.said(
            "interpolate", "kept.csv", "--value", "v", "--to", "to.csv", "-o", "kept.o.csv"
        )
        self.assertEqual(self.table("o.csv"), self.table("kept.o.csv"))
        self.said("interpolate", "scrip.nc:v", "--to", "to.csv", "--weights", "w.nc")
        with netCDF4.Dataset(self.folder / "w.nc") as weights:
            self.assertEqual(list(weights["src_grid_dims"][:]), [len(LON), len(LAT)])
            self.assertEqual(list(weights["mask_a"][:]), list(mask))
        self.said("apply", "w.nc", "scrip.nc:v", "-o", "o.csv")
        self.assertEqual(
            [row.split(",")[-1] for row in self.table("o.csv")],
            [row.split(",")[-1] for row in self.table("kept.o.csv")],
        )

    def test_weights_have_the_shape_of_the_grid(self):
        self.grid()
        self.said("interpolate", "grid.nc", "--to", "to.csv", "--weights", "w.nc")
        with netCDF4.Dataset(self.folder / "w.nc") as weights:
            self.assertEqual(list(weights["src_grid_dims"][:]), [len(LON), len(LAT)])

    def test_units_of_spacings(self):
        def cells(units, factor):
            data = self.new("spacing.nc")
            add_axes(data)
            values = np.full((len(LAT), len(LON)), 2500.0 * factor)
            add(data, "h", ("lat", "lon"), values, **({"units": units} if units else {}))
            data.close()
            command = ("mesh", "scvt", "--spacing", "spacing.nc:h", "--max-steps", "1")
            return *command, "-o", "mesh.nc"

        expected = None
        for units, factor in (("", 1), ("m", 1000)):
            with self.subTest(units):
                self.said(*cells(units, factor), "--quiet")
                with netCDF4.Dataset(self.folder / "mesh.nc") as mesh:
                    number = mesh.dimensions["nCells"].size
                expected = expected or number
                self.assertEqual(number, expected)
        for units in ("degrees", "1"):
            with self.subTest(units):
                said = self.said(*cells(units, 1), "--quiet", status=1)
                self.assertIn(f"the spacings have the units '{units}'", said)

    def test_weights_without_entries_are_read_by_others(self):
        """Polygons that do not meet: the dimension of entries has length 0, as classic netCDF allows for one."""
        for name, west in (("a.geojson", 0), ("b.geojson", 90)):
            ring = [[west, 0], [west + 10, 0], [west + 10, 10], [west, 10], [west, 0]]
            geometry = {"type": "Polygon", "coordinates": [ring]}
            feature = {"type": "Feature", "properties": {}, "geometry": geometry}
            (self.folder / name).write_text(json.dumps(feature))
        for options in ([], ["--kind", "cdf2"], ["--kind", "cdf5"], ["--format", "scrip"]):
            self.said("remap", "a.geojson", "b.geojson", "-o", "w.nc", *options)
            with netCDF4.Dataset(self.folder / "w.nc") as data:
                lengths = {name: data[name][:].shape for name in data.variables}
                area = data["src_grid_area" if "scrip" in options else "area_a"][:]
            self.assertIn((0,), lengths.values(), options)
            self.assertEqual(area.shape, (1,))
            self.assertGreater(area[0], 0.03)
            self.said("check-weights", "w.nc")
        (self.folder / "none.geojson").write_text('{"type":"FeatureCollection","features":[]}')
        said = self.said("remap", "none.geojson", "b.geojson", "-o", "n.nc", status=1)
        self.assertEqual(said, "rondel: none.geojson: there are no cells\n")
        self.assertFalse((self.folder / "n.nc").exists())

    def test_cells_that_change_where_their_centers_repeat_are_refused(self):
        for name, second, status in (("same.nc", 5.0, 0), ("moves.nc", 2.5, 1)):
            with self.new(name) as data:
                for dimension, size in (("time", 2), ("x", 2), ("corner", 4)):
                    data.createDimension(dimension, size)
                centers = np.array([[20.0, 40.0], [20.0, 40.0]])
                half = np.array([5.0, second])[:, None, None] * np.array([[-1, 1, 1, -1], [-1, -1, 1, 1]])[:, None, None]
                for k, (axis, unit) in enumerate((("lon", "degrees_east"), ("lat", "degrees_north"))):
                    add(data, axis, ("time", "x"), centers, units=unit, bounds=axis + "_bnds")
                    add(data, axis + "_bnds", ("time", "x", "corner"), centers[..., None] + half[k])
            said = self.said("remap", name, "grid:30", "-o", "w.nc", status=status)
            if status:
                self.assertIn('the bounds "lon_bnds" are 15 and 17.5 for one place', said)


if __name__ == "__main__":
    unittest.main()
