#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What the commands that carry fields write of attributes: those that no longer hold are left out, so that the next
reader does not misread the values; axes without fields, lists of coordinates and the history stay.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import shlex
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder, add

LON, LAT = np.arange(-180.0, 180, 20) + 10, np.arange(-90.0, 90, 20) + 10
SHAPE = len(LAT), len(LON)
FLAGS = {"flag_values": np.array([0, 1], np.int8), "flag_meanings": "sea land"}


class Attributes(ToolInFolder):
    def new(self, name, kind="NETCDF4"):
        """A file with the axes of a grid, and a field of categories."""
        file = netCDF4.Dataset(self.folder / name, "w", format=kind)
        for axis, units, values in (("lat", "degrees_north", LAT), ("lon", "degrees_east", LON)):
            file.createDimension(axis, len(values))
            add(file, axis, (axis,), values, units=units)
        kinds = np.add.outer(np.arange(SHAPE[0]) // 2, np.arange(SHAPE[1]) // 3) % 2
        add(file, "kind", ("lat", "lon"), kinds, "i1", long_name="a mask", **FLAGS)
        return file

    def attributes(self, name, variable):
        with netCDF4.Dataset(self.folder / name) as file:
            return {key: file[variable].getncattr(key) for key in file[variable].ncattrs()}

    def test_types_of_readers_are_those_of_the_values(self):
        """xarray casts what it reads to `dtype`: shares of True would all become True."""
        with self.new("in.nc") as file:
            file.createDimension("step", 2)
            add(file, "step", ("step",), [6, 12], "i8", units="hours", dtype="timedelta64[ns]")
            file["kind"].setncatts({"dtype": "bool", "minimum": 0, "maximum": np.int8(1), "valid_count": 162, "comment": ""})
            add(file, "age", ("step", "lat", "lon"), 5, "i8", units="days", dtype="timedelta64[ns]")
        self.run_tool("remap", "in.nc", "grid:30", "-o", "w.nc")
        for command in (
            ("regrid", "in.nc", "grid:30"),
            ("regrid", "in.nc", "grid:30", "--method", "nearest"),
            ("regrid", "in.nc", "grid:30", "--statistics", "mean"),
            ("interpolate", "in.nc", "--to", "grid:30", "--method", "nearest"),
            ("apply", "w.nc", "in.nc"),
        ):
            self.run_tool(*command, "-o", "out.nc")
            end = "_mean" if "--statistics" in command else ""
            for name in ("kind", "age"):
                known = self.attributes("out.nc", name + end)
                self.assertFalse({"dtype", "minimum", "maximum", "valid_count"} & {*known}, (command, known))
            self.assertEqual(self.attributes("out.nc", "kind" + end)["comment"], "")
            # The numbers of an axis are those of the input.
            self.assertEqual(self.attributes("out.nc", "step")["dtype"], "timedelta64[ns]")

    def test_flags_are_those_of_values_of_sources(self):
        self.new("in.nc").close()
        self.run_tool("remap", "in.nc", "grid:30", "-o", "means.nc")
        self.run_tool("interpolate", "in.nc", "--to", "grid:30", "--method", "nearest", "--weights", "choices.nc")
        of_methods = [("--method", m) for m in ("conservative", "conservative-2nd", "linear", "cubic", "bilinear")]
        means = [("regrid", "in.nc", "grid:30", *options) for options in of_methods]
        means += [("regrid", "in.nc", "grid:30", "--extrapolate", "idw"), ("apply", "means.nc", "in.nc")]
        means += [("interpolate", "in.nc", "--to", "grid:30", *options) for options in of_methods[2:]]
        means += [("interpolate", "in.nc", "--to", "grid:30", "--method", "nearest", *options)
                  for options in (("--extrapolate", "creep"), ("--duplicates", "mean"))]
        choices = [("regrid", "in.nc", "grid:30", *options)
                   for options in ((), ("--method", "largest-share"), ("--method", "nearest", "--extrapolate", "nearest"))]
        choices += [("interpolate", "in.nc", "--to", "grid:30", "--method", "nearest"), ("apply", "choices.nc", "in.nc")]
        for commands, kept in ((means, set()), (choices, {*FLAGS})):
            for command in commands:
                self.run_tool(*command, "-o", "out.nc")
                known = self.attributes("out.nc", "kind")
                self.assertEqual({*known} & {*FLAGS}, kept, command)
                self.assertEqual(known["long_name"], "a mask")

    def test_shares_of_flags_are_means_to_the_next_command(self):
        self.new("in.nc").close()
        self.run_tool("regrid", "in.nc", "grid:30", "--method", "conservative", "-o", "shares.nc")
        self.run_tool("regrid", "shares.nc", "grid:60", "-o", "twice.nc")
        self.run_tool("regrid", "in.nc", "grid:60", "--method", "conservative", "-o", "once.nc")
        with netCDF4.Dataset(self.folder / "twice.nc") as twice, netCDF4.Dataset(self.folder / "once.nc") as once:
            np.testing.assert_allclose(twice["kind"][:], once["kind"][:], rtol=1e-12)

    def test_files_do_not_tell_of_other_grids(self):
        lost = {"featureType": "timeSeries", "geospatial_lat_min": -90.0, "geospatial_lon_max": 360.0,
                "geospatial_bounds": "POLYGON ((0 0, 1 0, 1 1, 0 0))", "nominal_resolution": "100 km", "grid_label": "gn",
                "MAP_PROJ": np.int32(1), "DX": np.float32(9000), "WEST-EAST_GRID_DIMENSION": np.int32(19)}
        kept = {"title": "x", "geospatial_vertical_min": 0.0, "BOTTOM-TOP_GRID_DIMENSION": np.int32(40)}
        with self.new("in.nc") as file:
            file.setncatts({**lost, **kept})
            file["kind"].setncatts({"stagger": "X", "MemoryOrder": "XY "})
        for options in ((), ("--statistics", "max")):
            self.run_tool("regrid", "in.nc", "grid:30", *options, "-o", "out.nc4")
            with netCDF4.Dataset(self.folder / "out.nc4") as out:
                self.assertEqual({*out.ncattrs()}, {*kept, "Conventions", "history", "rondel_grid"} & {*out.ncattrs()})
                self.assertEqual({name: out.getncattr(name) for name in kept}, kept)
                name = "kind_max" if options else "kind"
                self.assertFalse({"stagger", "MemoryOrder"} & {*out[name].ncattrs()})

    def test_the_history_repeats_the_command(self):
        with self.new("in put.nc") as file:
            file.history = "made"
            for name in "uv":
                add(file, name, ("lat", "lon"), np.cos(np.radians(LAT))[:, None] + 0 * LON)
        for options in (
            (),
            ("--value", "u", "--norm", "destarea", "--max-missing", "1"),
            ("--method", "conservative-2nd", "--limiter", "bounds", "--sides", "great-circles", "--overlap", "first"),
            ("--value", "u", "--value", "v", "--vector", "u,v", "--extrapolate", "idw", "--extrapolate-sources", "3"),
            ("--source", "grid:20", "--statistics", "mean,quantile:0.1", "--weigh-by", "fraction"),
        ):
            self.run_tool("regrid", "in put.nc", "healpix:1", *options, "-o", "out.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                line, former = out.history.split("\n")
            self.assertEqual(former, "made")
            words = shlex.split(line)
            self.assertEqual(words[:4], ["rondel", "regrid", "in put.nc", "healpix:1"])
            self.assertEqual(sorted(words[4:]), sorted(options))
            self.run_tool(*words[1:], "-o", "again.nc", "--memory", "1G", "--threads", "1")
            self.assertEqual((self.folder / "again.nc").read_bytes(), (self.folder / "out.nc").read_bytes())

    def test_longitudes_of_another_meridian_are_refused(self):
        for meridian, status in ((0.0, 0), (106.5, 1)):
            with self.new("in.nc") as file:
                add(file, "crs", (), 0, "i4", grid_mapping_name="latitude_longitude", longitude_of_prime_meridian=meridian)
                file["kind"].grid_mapping = "crs"
            for command in (
                ("regrid", "in.nc", "grid:30"),
                ("regrid", "grid.nc", "in.nc"),
                ("regrid", "in.nc", "grid:30", "--method", "nearest"),
                ("regrid", "in.nc", "grid:30", "--statistics", "mean"),
                ("interpolate", "in.nc", "--to", "grid:30"),
                ("remap", "in.nc", "grid:30"),
            ):
                if not (self.folder / "grid.nc").exists():
                    self.run_tool("regrid", "in.nc", "grid:30", "-o", "grid.nc")
                said = self.run_tool(*command, "-o", "out.nc", "--quiet", status=status)
                why = ("the longitudes count from the meridian at 106.5 degrees east of Greenwich "
                       '(longitude_of_prime_meridian of variable "crs"): add 106.5 to them, and set the attribute to 0 or '
                       "remove it")
                self.assertEqual(len(said), status, command)
                self.assertTrue(all(line.startswith("in.nc: ") and line.endswith(why) for line in said), said)

    def test_axes_that_no_field_has_are_carried(self):
        for kind in ("NETCDF3_CLASSIC", "NETCDF4"):
            with self.new("in.nc", kind) as file:
                for name, size in (("lev", 3), ("time", None)):
                    file.createDimension(name, size)
                add(file, "lev", ("lev",), [1.0, 5, 9], units="hPa", positive="down")
                add(file, "time", ("time",), [0.0, 6], units="hours since 2000-01-01")
            self.assertEqual(self.run_tool("regrid", "in.nc", "grid:30", "-o", "out.nc"), [])
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                np.testing.assert_array_equal(out["lev"][:], [1, 5, 9])
                self.assertEqual(out["lev"].positive, "down")
                np.testing.assert_array_equal(out["time"][:], [0, 6])
                self.assertTrue(out.dimensions["time"].isunlimited())
            # A table, and a variable that is named, have none of them.
            self.assertEqual(self.run_tool("regrid", "in.nc", "grid:30", "--value", "kind", "-o", "out.nc"), [])
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                self.assertEqual({*out.variables}, {"lat", "lon", "lat_bnds", "lon_bnds", "kind"} & {*out.variables})
            said = self.run_tool("interpolate", "in.nc", "--to", "grid:30", "-o", "out.nc")
            self.assertEqual(said, ["in.nc: left out, as they have no values at the points: lev, time"])

    def test_integers_that_are_no_doubles_are_told(self):
        large = np.int64(2**60 + 1)
        with self.new("in.nc") as file:
            file.setncatts({"run_id": large, "number": np.int64(7)})
            file.createDimension("lev", 2)
            add(file, "lev", ("lev",), [1.0, 5], own=large)
            add(file, "of_lev", ("lev",), [1.0, 5], its=large)
            file["kind"].other = large
        end = "has integers that are no doubles; it is left out"
        said = self.run_tool("regrid", "in.nc", "grid:30", "-o", "out.nc4")
        self.assertEqual(sorted(said), sorted(
            [f'in.nc: attribute "run_id" of the file {end}']
            + [f'in.nc: attribute "{a}" of variable "{v}" {end}' for a, v in (("own", "lev"), ("its", "of_lev"), ("other", "kind"))]
        ))
        with netCDF4.Dataset(self.folder / "out.nc4") as out:
            self.assertEqual(out.number, 7)
            self.assertNotIn("run_id", out.ncattrs())

    def test_coordinates_that_the_file_lists_stay_coordinates(self):
        with self.new("in.nc") as file:
            file.createDimension("time", 2)
            add(file, "season", ("time",), [1.0, 2])
            add(file, "lat_", (), 7.0)
            file.coordinates = "season lat_ lost"
        for options in ((), ("--statistics", "mean")):
            self.run_tool("regrid", "in.nc", "grid:30", *options, "-o", "out.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                self.assertEqual(out.coordinates.split(), ["season", "lat_"])
                self.assertLessEqual({*out.coordinates.split()}, {*out.variables})

    def test_what_tells_of_targets_alone_is_kept_or_told(self):
        self.new("in.nc").close()
        with netCDF4.Dataset(self.folder / "track.nc", "w") as file:
            for name, size in (("time", 3), ("length", 4), ("lev", 2)):
                file.createDimension(name, size)
            add(file, "lon", ("time",), [1.0, 40, 170], units="degrees_east")
            add(file, "lat", ("time",), [1.0, 40, -80], units="degrees_north")
            add(file, "time", ("time",), [0.0, 1, 2], units="hours since 2000-01-01")
            add(file, "ship", ("time", "length"), np.full((3, 4), b"a"), "S1")
            add(file, "deep", ("time",), 5.0)
            add(file, "heat", ("time",), 5.0, coordinates="lon lat deep")
            add(file, "lev", ("lev",), [1.0, 2])
            add(file, "wide", ("time", "lev", "length"), np.full((3, 2, 4), b"b"), "S1")
        why = ["track.nc: left out, as they describe the places of the target: wide"]
        for command in (("regrid", "in.nc", "track.nc", "--method", "nearest"), ("interpolate", "in.nc", "--to", "track.nc")):
            self.assertEqual(self.run_tool(*command, "-o", "out.nc"), why)
            with netCDF4.Dataset(self.folder / "out.nc") as file:
                self.assertEqual(file["time"].units, "hours since 2000-01-01")
                self.assertEqual(file["time"][:].tolist(), [0, 1, 2])
                self.assertEqual(file["ship"][:].tolist(), ["aaaa"] * 3)
                self.assertEqual(file["deep"][:].tolist(), [5, 5, 5])
                self.assertNotIn("heat", file.variables)
        # Axes and named grids have nothing of the kind.
        for target in ("in.nc", "healpix:1"):
            self.assertEqual(self.run_tool("regrid", "in.nc", target, "--method", "nearest", "-o", "out.nc"), [])


if __name__ == "__main__":
    unittest.main()
