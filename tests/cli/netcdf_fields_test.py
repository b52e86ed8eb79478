#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of netCDF are read at their own places and in their own order, or it is told.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import itertools
import json
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder

SQUARE_LON, SQUARE_LAT = np.arange(0.0, 360, 60), np.linspace(75.0, -75, 6)
EAST, NORTH = {"units": "degrees_east"}, {"units": "degrees_north"}


def add(data, name, dimensions, values, fill=None, **attributes):
    values = np.asarray(values)
    variable = data.createVariable(name, values.dtype, dimensions, fill_value=fill)
    variable.set_auto_maskandscale(False)
    variable.setncatts(attributes)
    variable[...] = values
    return variable


class Fields(ToolInFolder):
    def new(self, name, kind="NETCDF4"):
        data = netCDF4.Dataset(self.folder / name, "w", format=kind)
        self.addCleanup(lambda: data.isopen() and data.close())
        return data

    def read(self, name, variable):
        with netCDF4.Dataset(self.folder / name) as data:
            data.set_auto_mask(False)
            return data[variable][:]

    def table(self, name):
        return np.genfromtxt(self.folder / name, delimiter=",", names=True)

    def grid(self, name, lon=SQUARE_LON, lat=SQUARE_LAT, **fields):
        data = self.new(name, "NETCDF3_64BIT_OFFSET")
        for axis, values, units in (("lat", lat, NORTH), ("lon", lon, EAST)):
            data.createDimension(axis, len(values))
            add(data, axis, (axis,), values, **units)
        for field, (values, fill) in fields.items():
            add(data, field, ("lat", "lon"), values, fill=fill)
        data.close()

    def square_weights(self):
        self.grid("square.nc", v=(np.zeros((6, 6)), None))
        self.said("interpolate", "square.nc", "--to", "grid:60", "--weights", "w.nc")

    def test_fill_that_is_a_value_marks_nothing(self):
        self.square_weights()
        rain, heat = np.zeros((6, 6)), np.full((6, 6), 5.0)
        rain[0], rain[2, 3], heat[4, 1] = 7, -1, -1
        self.grid("in.nc", rain=(rain, -1.0), heat=(heat, -1.0))
        self.said("apply", "w.nc", "in.nc", "-o", "nan.nc")
        missing = {name: np.isnan(self.read("nan.nc", name)) for name in ("rain", "heat")}
        number = sum(int(gaps.sum()) for gaps in missing.values())
        self.assertGreater(number, 0)
        said = self.said("apply", "w.nc", "in.nc", "--fill", "0", "-o", "zero.nc")
        self.assertIn("zero.nc: values that are not missing are the number of --fill, too", said)
        self.assertIn(f"{number} values missing", said)
        for name, gaps in missing.items():
            with netCDF4.Dataset(self.folder / "zero.nc") as out:
                self.assertNotIn("_FillValue", out[name].ncattrs())
                self.assertFalse(np.ma.getmaskarray(out[name][:]).any())
            right = np.where(gaps, 0, self.read("nan.nc", name))
            np.testing.assert_array_equal(self.read("zero.nc", name), right)
        said = self.said("apply", "w.nc", "in.nc", "--fill", "-7", "-o", "seven.nc")
        self.assertNotIn("--fill", said)
        with netCDF4.Dataset(self.folder / "seven.nc") as out:
            np.testing.assert_array_equal(np.ma.getmaskarray(out["rain"][:]), missing["rain"])

    def test_a_square_is_turned_by_names_and_axes(self):
        self.square_weights()
        values = np.random.default_rng(7).normal(size=(6, 6))
        self.grid("right.nc", t=(values, None))
        self.said("apply", "w.nc", "right.nc", "-o", "right_out.nc")
        right = self.read("right_out.nc", "t")
        for names, axes, turned in itertools.product(
            (("lat", "lon"), ("latitude", "Longitude"), ("y", "x"), ("j", "i"), ("ny", "nx"), ("rlat", "rlon"), ("eta_rho", "xi_rho"),
             ("south_north", "west_east")),
            ((), ("lat",), ("lon",)),
            (False, True),
        ):
            if names == ("j", "i") and not axes:
                continue
            with self.subTest(names=names, axes=axes, turned=turned):
                data = self.new("one.nc")
                for name in names:
                    data.createDimension(name, 6)
                if "lat" in axes:
                    add(data, "y_axis", (names[0],), SQUARE_LAT, **NORTH)
                if "lon" in axes:
                    add(data, "x_axis", (names[1],), SQUARE_LON - 360, **EAST)
                add(data, "t", names[::-1] if turned else names, values.T if turned else values)
                data.close()
                said = self.said("apply", "w.nc", "one.nc", "-o", "one_out.nc")
                self.assertNotIn("nothing says", said)
                np.testing.assert_array_equal(self.read("one_out.nc", "t"), right)

    def test_a_square_of_which_nothing_is_known_is_told(self):
        self.square_weights()
        data = self.new("plain.nc")
        data.createDimension("a", 6)
        data.createDimension("b", 6)
        add(data, "t", ("a", "b"), np.ones((6, 6)))
        data.close()
        said = self.said("apply", "w.nc", "plain.nc", "-o", "o.nc")
        self.assertIn('nothing says which of the dimensions "a" and "b" has the longitudes', said)

    def test_faces_of_a_cubed_sphere_are_turned_by_names(self):
        self.grid("in.nc", t=(np.random.default_rng(3).random((6, 6)), None))
        self.run_tool("regrid", "in.nc", "C4", "-o", "cube.nc")
        values = self.read("cube.nc", "t")
        to_grid = ("regrid", "turned.nc", "grid:30", "--source", "C4", "-o", "out.nc")
        self.run_tool("regrid", "cube.nc", "grid:30", "-o", "out.nc")
        wanted = self.read("out.nc", "t")
        for names in (("tile", "y", "x"), ("nf", "Ydim", "Xdim"), ("face", "lat", "lon")):
            for order in ((0, 1, 2), (0, 2, 1), (1, 2, 0), (2, 1, 0)):
                with self.subTest(names=names, order=order):
                    data = self.new("turned.nc")
                    turned = values.transpose(order)
                    for k, length in zip(order, turned.shape):
                        data.createDimension(names[k], length)
                    add(data, "t", [names[k] for k in order], turned)
                    data.close()
                    self.assertEqual(self.run_tool(*to_grid, "--quiet"), [])
                    np.testing.assert_array_equal(self.read("out.nc", "t"), wanted)
        data = self.new("turned.nc")
        for name, length in (("a", 6), ("b", 4), ("c", 4)):
            data.createDimension(name, length)
        add(data, "t", ("a", "b", "c"), values)
        data.close()
        self.assertIn('nothing says which of the dimensions "b" and "c" has the longitudes', self.said(*to_grid))

    def test_weights_of_the_largest_area_fraction_give_values_of_sources(self):
        values = np.random.default_rng(5).integers(1, 4, (6, 6)).astype(float)
        self.grid("classes.nc", t=(values, None))
        self.run_tool("regrid", "classes.nc", "grid:45", "--method", "largest-share", "-o", "wanted.nc")
        self.run_tool("remap", "classes.nc", "grid:45", "--format", "scrip", "-o", "w.nc")
        self.run_tool("apply", "w.nc", "classes.nc", "-o", "means.nc")
        with netCDF4.Dataset(self.folder / "w.nc", "a") as weights:
            weights.map_method = "Largest area fraction"
            weights.delncattr("rondel_method")
        said = self.said("apply", "w.nc", "classes.nc", "-o", "out.nc")
        self.assertIn('w.nc: the weights are of the method "Largest area fraction"', said)
        np.testing.assert_array_equal(self.read("out.nc", "t"), self.read("wanted.nc", "t"))
        self.assertFalse(np.array_equal(self.read("means.nc", "t"), self.read("wanted.nc", "t")))

    def test_weights_without_lengths_take_names_and_places(self):
        lat = SQUARE_LAT[:5]
        values = np.random.default_rng(8).normal(size=(5, 6))
        self.grid("right.nc", SQUARE_LON, lat, t=(values, None))
        for weights in ("w.npz", "w.nc"):
            self.said("interpolate", "right.nc", "--to", "grid:60", "--weights", weights)
        with netCDF4.Dataset(self.folder / "w.nc", "a") as data:
            data.renameVariable("src_grid_dims", "unknown")
        self.said("apply", "w.nc", "right.nc", "-o", "right_out.csv")
        right = self.table("right_out.csv")["t"]
        for names, turned in itertools.product((("lat", "lon"), ("a", "b")), (False, True)):
            data = self.new("bare.nc")
            for name, length in zip(names, (5, 6), strict=True):
                data.createDimension(name, length)
            add(data, "t", names[::-1] if turned else names, values.T if turned else values)
            data.close()
            for weights in ("w.npz", "w.nc"):
                with self.subTest(names=names, turned=turned, weights=weights):
                    said = self.said("apply", weights, "bare.nc", "-o", "o.npy")
                    is_unknown = weights == "w.npz" and names == ("a", "b")
                    self.assertEqual("nothing says" in said, is_unknown)
                    if not is_unknown:
                        np.testing.assert_array_equal(np.load(self.folder / "o.npy"), right)

    def test_one_axis_with_other_numbers_is_refused(self):
        self.square_weights()
        self.grid("oblong.nc", SQUARE_LON, SQUARE_LAT[:5], v=(np.zeros((5, 6)), None))
        self.said("interpolate", "oblong.nc", "--to", "grid:60", "--weights", "w5.nc")
        for weights, lat in (("w.nc", SQUARE_LAT), ("w5.nc", SQUARE_LAT[:5])):
            data = self.new("turned.nc")
            data.createDimension("lat", len(lat))
            data.createDimension("lon", 6)
            add(data, "lat", ("lat",), lat[::-1], **NORTH)
            add(data, "t", ("lat", "lon"), np.ones((len(lat), 6)))
            data.close()
            said = self.said("apply", weights, "turned.nc:t", "-o", "n.nc", status=1)
            self.assertIn('has "lat", which is not the axis of the places that are wanted', said)

    def test_names_in_groups(self):
        lon, lat = np.meshgrid(np.arange(10.0, 50, 10), np.arange(-20.0, 30, 10))
        corners = np.array([-5, 5, 5, -5]), np.array([-5, -5, 5, 5])
        data = self.new("groups.nc4")
        for name, length in (("y", 5), ("x", 4), ("corner", 4)):
            data.createDimension(name, length)
        geo, observed = data.createGroup("geo"), data.createGroup("obs")
        inner = geo.createGroup("sides")
        for group, suffix, moved in ((geo, "", 0), (geo, "_two", 3)):
            add(group, "lon" + suffix, ("y", "x"), lon + moved, **EAST, bounds="/geo/sides/lon_c")
            add(group, "lat" + suffix, ("y", "x"), lat + moved, **NORTH, bounds="sides/lat_c")
        add(inner, "lon_c", ("y", "x", "corner"), lon[..., None] + corners[0])
        add(inner, "lat_c", ("y", "x", "corner"), lat[..., None] + corners[1])
        add(observed, "bt", ("y", "x"), lon + 3, coordinates="/geo/lon_two /geo/lat_two")
        add(observed, "bu", ("y", "x"), lon, coordinates="../geo/lon ../geo/lat")
        add(observed, "same", ("y", "x"), lon)
        add(geo, "same", ("y", "x"), lon)
        data.close()
        said = self.said("remap", "groups.nc4:geo/lon", "grid:10", "-o", "w.nc")
        self.assertIn("20 cells to 648 cells", said)
        self.assertNotIn("there is no variable", said)
        # The nearest site of each target is known.
        (self.folder / "to.csv").write_text("lon,lat\n10,-20\n23,13\n40.5,20.5\n")
        for name in ("obs/bt", "/obs/bt", "bt", "obs/bu", "/obs/bu", "bu"):
            self.said(
                *("interpolate", f"groups.nc4:{name}", "--to", "to.csv", "--method", "nearest"),
                *("-o", "o.csv"),
            )
            column = self.table("o.csv")["obs_" + name[-2:]]
            np.testing.assert_array_equal(column, [13, 23, 43] if "bt" in name else [10, 20, 40])
        said = self.said(
            "interpolate", "groups.nc4:same", "--to", "to.csv", "-o", "n.csv", status=1
        )
        self.assertIn('several groups have a variable "same": "geo/same", "obs/same"', said)
        self.said("interpolate", "groups.nc4:bu", "--to", "grid:30", "--weights", "wg.nc")
        said = self.said("apply", "wg.nc", "groups.nc4", "-o", "o.nc")
        with netCDF4.Dataset(self.folder / "o.nc") as out:
            self.assertNotIn("geo_sides_lon_c", out.variables)
            self.assertIn("obs_bu", out.variables)

    def test_values_at_nodes_and_edges(self):
        points = np.random.default_rng(3).normal(size=(60, 3))
        np.savetxt(self.folder / "s.xyz", points)
        for form, file in (("ugrid", "u.nc"), ("mpas", "m.nc")):
            self.said("mesh", "convert", "s.xyz", "-o", file, "--format", form)
        places = {}
        with netCDF4.Dataset(self.folder / "u.nc", "a") as data:
            for kind in ("node", "edge", "face"):
                places[kind] = data[kind + "_lon"][:].data, data[kind + "_lat"][:].data
                add(
                    *(data, "at_" + kind, ("n_" + kind,), np.arange(len(places[kind][0])) * 1.0),
                    location=kind,
                    mesh="mesh",
                )
        with netCDF4.Dataset(self.folder / "m.nc", "a") as data:
            for kind, of_mpas in (("node", "Vertex"), ("edge", "Edge"), ("face", "Cell")):
                dimension = data["lon" + of_mpas].dimensions
                count = len(data["lon" + of_mpas])
                add(data, "at_" + kind, dimension, np.arange(count) * 1.0)
                places[kind + "m"] = [np.degrees(data[c + of_mpas][:].data) for c in ("lon", "lat")]
        for file, suffix in (("u.nc", ""), ("m.nc", "m")):
            for kind in ("node", "edge", "face"):
                lon, lat = places[kind + suffix]
                lines = [f"{x!r},{y!r}" for x, y in zip(lon.tolist(), lat.tolist(), strict=True)]
                (self.folder / "at.csv").write_text("\n".join(["lon,lat", *lines]) + "\n")
                self.said(
                    *("interpolate", f"{file}:at_{kind}", "--to", "at.csv", "--method", "nearest"),
                    *("-o", "o.csv"),
                )
                found = self.table("o.csv")["at_" + kind]
                np.testing.assert_array_equal(found, np.arange(len(lon)))
        said = self.said("remap", "u.nc:at_node", "grid:30", "-o", "n.nc", status=1)
        self.assertIn('variable "at_node" is at the nodes of mesh "mesh", which are no cells', said)
        self.said("remap", "m.nc:at_edge", "grid:30", "-o", "n.nc", status=1)
        self.said("remap", "u.nc:at_face", "grid:30", "-o", "w.nc")
        said = self.said("mesh", "convert", "m.nc", "-o", "again.nc")
        self.assertIn("m.nc: left out, as they are no part of the mesh: at_node, at_edge", said)
        for form in ("mpas", "ugrid", "scrip", "esmf"):
            self.said("mesh", "convert", "s.xyz", "-o", "plain.nc", "--format", form)
            said = self.said("mesh", "convert", "plain.nc", "-o", "again.nc")
            self.assertNotIn("left out", said)

    def test_fields_at_nodes_alone_are_carried_and_told(self):
        np.savetxt(self.folder / "s.xyz", np.random.default_rng(3).normal(size=(60, 3)))
        (self.folder / "to.csv").write_text("lon,lat\n10,20\n-70,5\n")
        for form in ("ugrid", "scrip"):
            self.said("mesh", "convert", "s.xyz", "-o", form + ".nc", "--format", form)
        with netCDF4.Dataset(self.folder / "ugrid.nc", "a") as data:
            count = len(data.dimensions["n_node"])
            for name in ("a", "b"):
                values = np.arange(count) * 1.0
                add(data, name, ("n_node",), values, location="node", mesh="mesh")
        for method in ("sibson", "native"):
            to = ("--to", "to.csv", "--method", method, "-o")
            said = self.said("interpolate", "ugrid.nc", *to, "all.csv")
            self.assertIn("no field is at the 60 centers of cells; sites are the "
                          f"{count} places of a", said)
            self.said(
                "interpolate", "ugrid.nc", "--value", "a", "--value", "b", *to, "named.csv"
            )
            for name in ("a", "b"):
                found = self.table("all.csv")[name]
                np.testing.assert_array_equal(found, self.table("named.csv")[name])
        said = self.said("info", "ugrid.nc")
        self.assertIn(f"at {count} other places, such as nodes:\nfields: a, b\n", said)
        self.assertIn("and with --value a: interpolate, contours", said)
        facts = json.loads(self.said("info", "ugrid.nc", "--json"))
        self.assertEqual(facts["elsewhere"]["places"], count)
        self.assertEqual([each["name"] for each in facts["elsewhere"]["fields"]], ["a", "b"])
        self.assertNotIn("other places", self.said("info", "scrip.nc"))

    def test_two_places_of_one_cell_are_refused(self):
        np.savetxt(self.folder / "s.xyz", np.random.default_rng(4).normal(size=(40, 3)))
        for kind, value in (("Cell", 0.3), ("Vertex", 0.1), ("Edge", -0.2)):
            self.said("mesh", "convert", "s.xyz", "-o", "m.nc", "--kind", "cdf2")
            with netCDF4.Dataset(self.folder / "m.nc", "a") as data:
                data["lat" + kind][5] = value
            said = self.said("mesh", "quality", "m.nc", status=1)
            self.assertIn(f'm.nc: value 5 of "lon{kind}" and "lat{kind}", ', said)
            self.assertIn(f'is another place than that of "x{kind}"', said)
        self.said("mesh", "convert", "s.xyz", "-o", "m.nc", "--kind", "cdf2")
        with netCDF4.Dataset(self.folder / "m.nc", "a") as data:
            data["latCell"].units = "degrees"
        for command in (
            ("interpolate", "m.nc:areaCell", "--to", "grid:30", "-o", "n.nc"),
            ("remap", "m.nc", "grid:30", "-o", "n.nc"),
            ("mesh", "convert", "m.nc", "-o", "n.nc"),
        ):
            self.assertIn("another place", self.said(*command, status=1))
        self.said("mesh", "convert", "s.xyz", "-o", "m.nc", "--kind", "cdf2")
        with netCDF4.Dataset(self.folder / "m.nc", "a") as data:
            data.sphere_radius = "6371229"
        said = self.said("mesh", "quality", "m.nc", status=1)
        self.assertIn('the attribute sphere_radius is the text "6371229"', said)

    def test_what_is_left_out_is_named(self):
        self.square_weights()
        data = self.new("more.nc")
        for name, values, units in (("lat", SQUARE_LAT, NORTH), ("lon", SQUARE_LON, EAST)):
            data.createDimension(name, 6)
            add(data, name, (name,), values, **units, bounds=name + "_bnds")
        data.createDimension("time", 2)
        data.createDimension("two", 2)
        add(data, "lat_bnds", ("lat", "two"), SQUARE_LAT[:, None] + [-15, 15])
        add(data, "lon_bnds", ("lon", "two"), SQUARE_LON[:, None] + [-30, 30])
        add(data, "time", ("time",), [15.0, 45], units="days since 2000-1-1", bounds="time_bnds")
        add(data, "time_bnds", ("time", "two"), [[0.0, 31], [31, 59]])
        add(data, "height", (), 2.0)
        add(data, "crs", (), 0, grid_mapping_name="latitude_longitude")
        kind = data.createEnumType(np.uint8, "kind", {"sea": 0, "land": 1})
        data.createVariable("surface", kind, ("lat", "lon"), fill_value=0)
        add(data, "t", ("time", "lat", "lon"), np.ones((2, 6, 6)))
        data.close()
        said = self.said("apply", "w.nc", "more.nc", "-o", "o.nc")
        self.assertIn("types are those that the file defines itself: surface", said)
        self.assertIn("no values at the points: time_bnds, height\n", said)

    def test_bounds_of_latitudes_and_of_others(self):
        lat = np.linspace(-75.0, 75, 6)
        for moved in (0, 30, -31):
            data = self.new("bounds.nc")
            for name, values, units in (("lat", lat, NORTH), ("lon", SQUARE_LON, EAST)):
                data.createDimension(name, 6)
                add(data, name, (name,), values, **units, bounds=name + "_bnds")
            data.createDimension("two", 2)
            lats = lat[:, None] + [-15, 15] + (moved if moved < 0 else 0)
            add(data, "lat_bnds", ("lat", "two"), lats)
            add(
                data,
                "lon_bnds",
                ("lon", "two"),
                SQUARE_LON[:, None] + [-30, 30] + 2 * max(moved, 0),
            )
            add(data, "t", ("lat", "lon"), np.ones((6, 6)))
            data.close()
            said = self.said(
                "remap", "bounds.nc", "grid:60", "-o", "w.nc", status=int(moved < 0)
            )
            if moved == 0:
                self.assertNotIn("outside", said)
            elif moved > 0:
                self.assertIn(
                    '6 of 6 coordinates of "lon" are outside of their cells in "lon_bnds", the '
                    "first one 0 beside 30 to 90",
                    said,
                )
            else:
                self.assertIn(
                    'bounds.nc: variable "lat_bnds": bound of latitudes -121 is beyond a pole', said
                )

    def test_cells_that_overlap_are_those_of_a_file(self):
        data = self.new("cells.nc")
        data.createDimension("grid_size", 2)
        data.createDimension("grid_corners", 4)
        square = np.array([[0.0, 10, 10, 0], [0, 0, 10, 10]])
        for k, name in enumerate(("lon", "lat")):
            corners = np.stack([square[k], square[k] + 5])
            add(
                data, f"grid_corner_{name}", ("grid_size", "grid_corners"), corners, units="degrees"
            )
        data.close()
        for pair in (("cells.nc", "grid:30"), ("grid:30", "cells.nc")):
            said = self.said("remap", *pair, "-o", "n.nc", status=1)
            self.assertRegex(said, r"^rondel: cells.nc: (source|target) cells 0 and 1 overlap")


if __name__ == "__main__":
    unittest.main()
