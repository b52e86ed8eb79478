#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What stands beside the values at points: columns of tables, and what netCDF says of stations and tracks.

No column goes without a word: it is kept, it gives way to a field, or a line names it. Without netCDF4-python ctest
says "Skipped".
"""

import csv
import importlib.util
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder, add

LOST = "left out, as they describe the places of the target: "


class Columns(ToolInFolder):
    def setUp(self):
        super().setUp()
        with netCDF4.Dataset(self.folder / "in.nc", "w", format="NETCDF3_CLASSIC") as file:
            for name, values, units in (("lat", np.arange(-90.0, 91, 10), "degrees_north"), ("lon", np.arange(0.0, 360, 10), "degrees_east")):
                file.createDimension(name, len(values))
                add(file, name, (name,), values, units=units)
            file.createDimension("time", 2)
            add(file, "time", ("time",), [0.0, 6], units="hours since 2000-01-01")
            add(file, "oro", ("lat", "lon"), 1.0)
            add(file, "t", ("time", "lat", "lon"), 2.0)

    def list_of(self, name, lon=(10.0, 20, 30), lat=(0.0, 10, 20), feature="timeSeries", role="timeseries_id", names=None):
        """Writes stations with names, if there are any, and returns the open file."""
        file = netCDF4.Dataset(self.folder / name, "w")
        file.createDimension("station", len(lon))
        if feature:
            file.featureType = feature
        add(file, "lon", ("station",), np.array(lon, float), units="degrees_east")
        add(file, "lat", ("station",), np.array(lat, float), units="degrees_north")
        if names:
            add(file, "nm", ("station",), np.array(names, object), str, cf_role=role)
        return file

    def regrid(self, target, output="out.nc4", field="t", status=0):
        return self.run_tool("regrid", "in.nc", target, "--method", "bilinear", "--value", field, "-o", output, status=status)

    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.reader(file))

    def opened(self, name="out.nc4"):
        file = netCDF4.Dataset(self.folder / name)
        self.addCleanup(file.close)
        return file

    def test_columns_give_way_to_fields(self):
        (self.folder / "taken.csv").write_text("lon,lat,oro,t\n10,20,7,8\n")
        fields = ["oro", "t_2000-01-01T00:00:00", "t_2000-01-01T06:00:00"]
        for command in (("regrid", "in.nc", "taken.csv"), ("interpolate", "in.nc", "--to", "taken.csv")):
            for ending in ("csv", "nc"):
                self.assertEqual(self.run_tool(*command, "--method", "bilinear", "-o", f"out.{ending}"), [])
            header, row = self.rows("out.csv")
            # In a table the names of times are no other's, so that the column t stays.
            self.assertEqual(sorted(header[4:]), sorted(fields))
            self.assertEqual((header[:4], row[:4]), (["lon", "lat", "oro_", "t"], ["10", "20", "7", "8"]))
            file = self.opened("out.nc")
            self.assertEqual((file["oro_"][:].tolist(), file["t_"][:].tolist(), file["oro"][:].tolist()), ([7], [8], [1]))

    def test_values_of_sites_at_themselves_stand_in_place_of_their_columns(self):
        (self.folder / "sites.csv").write_text("lon,lat,oro,t\n10,20,7,8\n30,20,5,6\n")
        (self.folder / "others.csv").write_text("lon,lat,oro\n10,20,1\n")
        for target, expected in (("sites.csv", ["lon", "lat", "t", "oro"]), ("./sites.csv", ["lon", "lat", "t", "oro"]), ("others.csv", ["lon", "lat", "oro_", "oro"])):
            self.run_tool("interpolate", "sites.csv", "--value", "oro", "--to", target, "--method", "nearest", "-o", "out.csv")
            self.assertEqual(self.rows("out.csv")[0], expected)

    def test_numbers_of_sites_need_not_be_listed(self):
        with self.list_of("s.nc") as file:
            add(file, "wmo", ("station",), [7, 8, 9], "i4")
            add(file, "depth", ("station",), [1.5, 2, 3], units="m")
        self.assertEqual(self.regrid("s.nc"), [])
        file = self.opened()
        self.assertEqual((file["wmo"][:].tolist(), file["depth"][:].tolist(), file["depth"].units), ([7, 8, 9], [1.5, 2, 3], "m"))

    def test_names_and_times_of_tracks_are_named_where_they_are_no_columns(self):
        with self.list_of("track.nc", feature="trajectory") as file:
            file.createDimension("length", 3)
            add(file, "traj", ("length",), np.array(list("abc"), "S1"), "S1", cf_role="trajectory_id")
        self.assertEqual(self.regrid("track.nc"), [f"track.nc: {LOST}traj"])
        with netCDF4.Dataset(self.folder / "tracks.nc", "w") as file:
            file.featureType = "trajectory"
            for name, length in (("trajectory", 2), ("obs", 3), ("length", 1)):
                file.createDimension(name, length)
            both = ("trajectory", "obs")
            add(file, "lon", both, np.arange(6.0).reshape(2, 3), units="degrees_east")
            add(file, "lat", both, np.arange(6.0).reshape(2, 3), units="degrees_north")
            add(file, "time", both, 1.0, units="days since 2000-01-01")
            add(file, "tid", ("trajectory", "length"), np.array([["a"], ["b"]], "S1"), "S1", cf_role="trajectory_id")
            add(file, "v", both, 1.0, coordinates="lat lon tid time")
        self.assertIn(f"tracks.nc: {LOST}time, tid", self.regrid("tracks.nc"))

    def test_places_keep_their_names_where_one_has_no_place(self):
        with self.list_of("s.nc", lat=(0, np.nan, 20), names=["a", "b", "c"]) as file:
            add(file, "alt", ("station",), [1.0, 2, 3], units="m")
        self.assertEqual(self.regrid("s.nc"), ["s.nc: 1 of 3 places have no longitude or latitude and are left out"])
        file = self.opened()
        self.assertEqual((file["nm"][:].tolist(), file["nm"].cf_role, file["alt"][:].tolist()), (["a", "c"], "timeseries_id", [1, 3]))

    def test_names_that_name_no_single_site_lose_their_role_with_a_line(self):
        for names in (["a", "", "b"], ["a", "b", "a"]):
            self.list_of("s.nc", names=names).close()
            self.assertEqual(self.regrid("s.nc"), ["out.nc4: nm has no cf_role, as a name is empty or there more than once"])
            file = self.opened()
            self.assertEqual((file["nm"][:].tolist(), file.featureType), (names, "timeSeries"))
            self.assertNotIn("cf_role", file["nm"].ncattrs())
        # Without a role for the type of features there is nothing to lose.
        self.assertEqual(self.regrid("s.nc", field="oro"), [])

    def test_words_for_missing_numbers_leave_a_column_of_numbers(self):
        (self.folder / "gaps.csv").write_text("lon,lat,v,w,code,none\n10,20,nan,5,NA,NA\n10,30,5.5,null,x,NA\n10,40,,NaN,2,NA\n10,50,NA,-1,3,NA\n")
        for command in (("regrid", "in.nc", "gaps.csv"), ("interpolate", "in.nc", "--to", "gaps.csv")):
            self.run_tool(*command, "--method", "bilinear", "-o", "out.nc4")
            file = self.opened()
            np.testing.assert_array_equal(np.ma.filled(file["v"][:], np.nan), [np.nan, 5.5, np.nan, np.nan])
            np.testing.assert_array_equal(np.ma.filled(file["w"][:], np.nan), [5, np.nan, np.nan, -1])
            self.assertEqual((file["code"].dtype.kind, file["none"].dtype.kind), ("S", "S"))
            # A table has the words of the table.
            self.run_tool(*command, "--method", "bilinear", "--value", "oro", "-o", "out.csv")
            self.assertEqual([row[2] for row in self.rows("out.csv")], ["v", "nan", "5.5", "", "NA"])

    def test_no_points_give_an_output_without_rows(self):
        (self.folder / "none.csv").write_text("lon,lat,name\n")
        np.save(self.folder / "none.npy", np.zeros((0, 2)))
        for target, header in (("none.csv", ["lon", "lat", "name", "oro"]), ("none.npy", ["lon", "lat", "oro"])):
            for method in ("nearest", "linear", "bilinear"):
                for command in (("regrid", "in.nc", target), ("interpolate", "in.nc", "--to", target)):
                    said = self.run_tool(*command, "--method", method, "--value", "oro", "-o", "out.csv")
                    self.assertEqual((said, self.rows("out.csv")), ([f"{target}: there are no points"], [header]))
                    for ending, field, shape in (("nc", "oro", (0,)), ("nc4", "t", (2, 0))):
                        said = self.run_tool(*command, "--method", method, "--value", field, "-o", f"out.{ending}")
                        self.assertEqual(said, [f"{target}: there are no points"])
                        self.assertEqual(self.opened(f"out.{ending}")[field].shape, shape)
                    # A classic file has a dimension of length 0 in front of all others only.
                    said = self.run_tool(*command, "--method", method, "--value", "t", "-o", "out.nc", status=1)
                    self.assertTrue(said[-1].endswith("netCDF-4 can"), said)

    def test_points_without_a_direction_are_no_places_of_their_file(self):
        (self.folder / "zero.xyz").write_text("1 0 0\n0 1 0\n0 0 0\n")
        for command in (("regrid", "in.nc", "zero.xyz"), ("interpolate", "in.nc", "--to", "zero.xyz")):
            said = self.run_tool(*command, "--method", "bilinear", "-o", "out.csv", status=1)
            self.assertEqual(said, ["zero.xyz:3: the point has no direction, so that it is no place"])

    def test_names_that_are_too_long_are_shortened_with_a_line(self):
        names = ["a" * 300, "a" * 299, "é" * 130, "b" * 255]
        (self.folder / "long.csv").write_text(",".join(["lon", "lat", *names]) + "\n10,20,1,3,2,y\n", encoding="utf-8")
        for command in (("regrid", "in.nc", "long.csv"), ("interpolate", "in.nc", "--to", "long.csv")):
            for ending in ("nc", "nc4"):
                said = self.run_tool(*command, "--method", "bilinear", "-o", f"out.{ending}")
                shown = ", ".join(f'"{start}..."' for start in ("a" * 60, "a" * 60, "é" * 29))
                self.assertTrue(said[-1].endswith(f"names of more than 255 bytes are shortened: {shown}"), said)
                file = self.opened(f"out.{ending}")
                for name in ("a" * 239, "a" * 239 + "_", "é" * 119, "b" * 255):
                    self.assertIn(name, file.variables)
        for ending in ("nc", "nc4"):
            said = self.run_tool("interpolate", "long.csv", "--value", names[0], "--value", names[2], "--to", "grid:90",
                                 "--method", "nearest", "-o", f"values.{ending}", "--quiet")
            shown = ", ".join(f'"{start}..."' for start in ("a" * 60, "é" * 29))
            self.assertEqual(said, [f"values.{ending}: names of more than 255 bytes are shortened: {shown}"])
            file = self.opened(f"values.{ending}")
            self.assertEqual([float(file[name][0, 0]) for name in ("a" * 239, "é" * 119)], [1, 2])


if __name__ == "__main__":
    unittest.main()
