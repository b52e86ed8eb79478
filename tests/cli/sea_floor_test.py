#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Depths, heights and spacings of meshes of triangles in netCDF files: direction, names, units, reach and detail.

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

BOX = {"type": "Polygon", "coordinates": [[[0, 0], [10, 0], [10, 8], [0, 8], [0, 0]]]}


class Files(ToolInFolder):
    """A folder with a box in which a mesh is, and the tool in it."""

    def setUp(self):
        super().setUp()
        (self.folder / "box.geojson").write_text(json.dumps(BOX))

    def run_tool(self, *arguments):
        done = self.tool(*arguments)
        return done.returncode, done.stderr

    def depths_in(self, name):
        """The depths of a file of ADCIRC."""
        lines = (self.folder / name).read_text().splitlines()
        return [round(float(line.split()[3]), 9) for line in lines[2:2 + int(lines[1].split()[1])]]

    def grid(self, name, value, lon=(-5.0, 15.0), lat=(-5.0, 15.0), **attributes):
        """A file with a value that is the same everywhere, or `values` on the axes."""
        with netCDF4.Dataset(self.folder / name, "w", format="NETCDF3_CLASSIC") as data:
            for axis, values, unit in (("lon", lon, "degrees_east"), ("lat", lat, "degrees_north")):
                data.createDimension(axis, len(values))
                variable = data.createVariable(axis, "f8", (axis,))
                variable.units = unit
                variable[:] = values
            variable = data.createVariable("v", "f8", ("lat", "lon"))
            variable.setncatts(attributes)
            variable[:] = value


class DirectionsOfHeights(Files):
    def mesh(self, option, name="f.nc:v"):
        return self.run_tool("mesh", "triangles", "--area", "box.geojson", "--spacing", "300", option, name,
                             "-o", "d.14", "--quiet")

    def test_are_what_the_attributes_say(self):
        up = ({"positive": "up"}, {"standard_name": "height_above_mean_sea_level"}, {"standard_name": "altitude"},
              {"standard_name": "surface_altitude"}, {"standard_name": "Height above Geoid"},
              {"positive": "Up", "standard_name": "sea_floor_depth_below_geoid"})
        down = ({"positive": "down"}, {"standard_name": "sea_floor_depth_below_geoid"}, {"standard_name": "depth"},
                {"standard_name": "depth below geoid"}, {"positive": "down", "standard_name": "altitude"})
        for cases, value, right, wrong in ((up, -100, "--elevation", "--depth"), (down, 100, "--depth", "--elevation")):
            for attributes in cases:
                with self.subTest(**attributes):
                    self.grid("f.nc", value, units="m", **attributes)
                    self.assertEqual(self.mesh(right), (0, ""))
                    self.assertEqual(set(self.depths_in("d.14")), {100})
                    (self.folder / "d.14").unlink()
                    status, text = self.mesh(wrong)
                    self.assertEqual(status, 1)
                    self.assertIn('rondel: f.nc: variable "v" has ', text)
                    self.assertIn(f": {right} reads it\n", text)
                    self.assertFalse((self.folder / "d.14").exists())

    def test_of_numbers_are_told_where_no_attribute_has_them(self):
        self.grid("f.nc", -100, units="m")
        self.assertEqual(self.mesh("--elevation"), (0, ""))
        self.assertEqual(self.mesh("--depth"),
                         (0, "rondel: f.nc: --depth: all depths are negative; --elevation reads heights\n"))
        self.grid("f.nc", 100, units="m")
        self.assertEqual(self.mesh("--depth"), (0, ""))
        self.assertEqual(self.mesh("--elevation"),
                         (0, "rondel: f.nc: --elevation: all nodes are above the sea; --depth reads depths\n"))
        (self.folder / "f.csv").write_text("lon,lat,z\n-5,-5,-9\n15,-5,-9\n15,15,-9\n-5,15,-9\n")
        self.assertIn("all depths are negative", self.mesh("--depth", "f.csv:z")[1])

    def test_units_are_in_letters_of_either_case(self):
        for units, metres in (("M", 1), ("Meters", 1), ("METRE", 1), ("KM", 1000), ("Kilometers", 1000), (" km ", 1000)):
            self.grid("f.nc", 2, units=units)
            self.assertEqual(self.mesh("--depth"), (0, ""))
            self.assertEqual(set(self.depths_in("d.14")), {2 * metres}, units)
        for units in ("fathom", "mm", "m2", "k m"):
            self.grid("f.nc", 2, units=units)
            self.assertIn("neither kilometers nor meters", self.mesh("--depth")[1], units)

    def test_have_a_least_depth(self):
        self.grid("f.nc", [[-150, 150], [-150, 150]], units="m")
        arguments = ("mesh", "triangles", "--area", "box.geojson", "--spacing", "300", "--depth", "f.nc:v", "--quiet")
        status, text = self.run_tool(*arguments, "-o", "f", "--format", "fesom")
        self.assertEqual(status, 1)
        self.assertRegex(text, r"node \d+ \(from 1\) has a negative depth, .* --least-depth makes such nodes deeper\n")
        status, text = self.run_tool(*arguments, "--least-depth", "5", "-o", "f", "--format", "fesom")
        self.assertEqual(status, 0)
        self.assertRegex(text, r"\Arondel: f.nc: --least-depth: \d+ nodes are less deep in it\n"
                               r"rondel: f: open segments are left out: FESOM takes all nodes of the border for coast\n\Z")
        self.assertEqual(self.run_tool(*arguments, "-o", "as-it-is.14"), (0, ""))
        for least in ("5", "-2"):
            self.assertEqual(self.run_tool(*arguments, "--least-depth", least, "-o", "d.14")[0], 0)
            depths = self.depths_in("d.14")
            status, text = self.run_tool("mesh", "convert", "as-it-is.14", "--least-depth", least, "-o", "c.14", "--quiet")
            number = sum(depth < float(least) for depth in self.depths_in("as-it-is.14"))
            self.assertEqual((status, text),
                             (0, f"rondel: as-it-is.14: --least-depth: {number} nodes are less deep in it\n"))
            self.assertEqual((self.folder / "c.14").read_bytes(), (self.folder / "d.14").read_bytes())
            self.assertEqual(min(depths), float(least))
            self.assertGreater(max(depths), 50)
        self.assertEqual(self.run_tool(*arguments, "--least-depth", "-90", "-o", "d.14"), (0, ""))
        self.assertLess(min(self.depths_in("d.14")), -5)
        self.assertEqual(self.run_tool(*arguments, "--least-depth", "nan", "-o", "d.14")[0], 2)
        status, text = self.run_tool(*arguments[:6], "--least-depth", "5", "-o", "d.14")
        self.assertIn("--least-depth", text)
        self.assertIn("without --depth or --elevation", text)


class Spacings(Files):
    def test_of_a_region_are_told_where_the_mesh_goes_beyond(self):
        self.grid("h.nc", 900, units="km")
        inside = ("mesh", "triangles", "--area", "box.geojson", "--spacing", "h.nc:v", "-o", "d.14", "--quiet")
        self.assertEqual(self.run_tool(*inside), (0, ""))
        beyond = "rondel: h.nc: places with values surround 0.97 % of the sphere, and the mesh goes beyond: there the value " \
                 "of the nearest place counts\n"
        self.assertEqual(self.run_tool("mesh", "triangles", "--spacing", "h.nc:v", "-o", "d.14", "--quiet"), (0, beyond))
        self.assertEqual(self.run_tool("mesh", "scvt", "--spacing", "h.nc:v", "-o", "s.csv", "--max-steps", "1", "--quiet")[1]
                         .splitlines()[0] + "\n", beyond)
        self.grid("h.nc", 900, lon=(1.0, 15.0), units="km")
        self.assertIn("the mesh goes beyond", self.run_tool(*inside)[1])
        self.grid("h.nc", 900, lon=np.arange(0.0, 360, 30), lat=np.arange(-75.0, 76, 30), units="km")
        self.assertEqual(self.run_tool("mesh", "triangles", "--spacing", "h.nc:v", "-o", "d.14", "--quiet"), (0, ""))

    def test_of_refinements_are_told_where_the_raster_is_too_coarse(self):
        (self.folder / "p.csv").write_text("lon,lat\n5,4\n")
        sphere = ("mesh", "triangles", "--spacing", "2000", "-o", "d.14", "--quiet")
        self.assertEqual(self.run_tool(*sphere, "--refine", "p.csv:20"), (0, ""))
        status, text = self.run_tool(*sphere, "--refine", "p.csv:0.1")
        self.assertEqual(status, 0)
        self.assertRegex(text, r"\Arondel: p.csv: --refine: the spacing there is up to 0.\d+ kilometers, since spacings are "
                               r"kept on a raster with steps of up to 7 km\n\Z")
        # An area has a raster of its own.
        area = ("mesh", "triangles", "--area", "box.geojson", "--spacing", "50", "-o", "d.14", "--quiet")
        self.assertEqual(self.run_tool(*area, "--refine", "p.csv:0.1"), (0, ""))


class DepthsOfMeshes(Files):
    def mesh(self, name="depth", values=(7, 8, 9, 10), **attributes):
        """Writes m.nc, converts it, and returns its depths and what is told."""
        with netCDF4.Dataset(self.folder / "m.nc", "w", format="NETCDF3_CLASSIC") as data:
            for dimension, size in (("node", 4), ("face", 2), ("three", 3)):
                data.createDimension(dimension, size)
            topology = data.createVariable("adcirc_mesh", "i4", ())
            topology.setncatts({"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "x y",
                                "face_node_connectivity": "element"})
            for axis, values_of_axis, kind in (("x", [0, 1, 0, 1], "longitude"), ("y", [0, 0, 1, 1], "latitude")):
                variable = data.createVariable(axis, "f8", ("node",))
                variable.setncatts({"standard_name": kind, "units": "degrees_" + ("east" if axis == "x" else "north")})
                variable[:] = values_of_axis
            element = data.createVariable("element", "i4", ("face", "three"))
            element.start_index = 1
            element[:] = [[1, 2, 3], [2, 4, 3]]
            variable = data.createVariable(name, "f8", ("node",))
            variable.setncatts({"mesh": "adcirc_mesh", "location": "node", **attributes})
            variable[:] = values
        status, told = self.run_tool("mesh", "convert", "m.nc", "-o", "m.14", "--quiet")
        self.assertEqual(status, 0, told)
        return self.depths_in("m.14"), told

    def test_have_the_names_of_models(self):
        names = ("depth below geoid", "depth_below_geoid", "sea_floor_depth", "sea_floor_depth_below_geoid",
                 "model_sea_floor_depth_below_geoid", "Depth below geoid ", "depth")
        for name in names:
            self.assertEqual(self.mesh("h", standard_name=name, units="m"), ([7, 8, 9, 10], ""), name)
        self.assertEqual(self.mesh(long_name="distance below geoid", units="m"), ([7, 8, 9, 10], ""))
        self.assertEqual(self.mesh("Depth"), ([7, 8, 9, 10], ""))
        for name in ("altitude", "height_above_geoid", "height above mean sea level"):
            self.assertEqual(self.mesh("z", standard_name=name, units="m"), ([-7, -8, -9, -10], ""), name)
        self.assertEqual(self.mesh(positive="up", units="m"), ([-7, -8, -9, -10], ""))
        self.assertEqual(self.mesh(units="KM"), ([7000, 8000, 9000, 10000], ""))

    def test_of_triangles_are_known_to_info(self):
        self.mesh(units="m")
        self.assertEqual(self.run_tool("mesh", "convert", "m.nc", "-o", "again.nc", "--quiet"), (0, ""))
        for name in ("m.nc", "again.nc"):
            done = self.finished("info", name)
            self.assertIn("mesh convert", done.stdout, name)
        self.grid("g.nc", 1)
        done = self.finished("info", "g.nc")
        self.assertNotIn("mesh convert", done.stdout)

    def test_are_no_other_fields(self):
        for name, attributes in (("zeta", {"standard_name": "sea_surface_height_above_geoid"}),
                                 ("depth", {"standard_name": "ocean_mixed_layer_thickness"}),
                                 ("h", {"long_name": "depth"}), ("mld", {"standard_name": "mixed_layer_depth"})):
            depths, told = self.mesh(name, **attributes)
            self.assertEqual(depths, [0, 0, 0, 0], name)
            self.assertIn(name, told)


if __name__ == "__main__":
    unittest.main()
