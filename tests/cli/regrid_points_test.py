#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""`rondel regrid` to points: tables, features, and lists of places in netCDF.

Values are compared with a function that `bilinear` keeps, with the nearest source by NumPy, and with what `rondel
interpolate` has at the same points. Without netCDF4-python ctest says "Skipped".
"""

import csv
import importlib.util
import json
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder, add

LON, LAT = np.arange(0.0, 360, 10), np.arange(-90.0, 91, 10)
TIMES, LEVELS = np.array([0.0, 6, 30]), np.array([850.0, 500])
# Beside the seam, where the function is none of places; a pole, two duplicates, one turn more.
POINTS = [(1.5, 2.25), (355, 90), (349.75, -89.5), (10, 20), (10, 20), (540, -33.3), (-181, 12)]
NAMES = ["Oslo", "pole", "Ürümqi, east", "a", "b", "a turn", ""]
METHODS = ("nearest", "linear", "laplace", "sibson", "hermite", "cubic", "bilinear")


def unit(lon, lat):
    lon, lat = np.radians(lon), np.radians(lat)
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], -1)


def function(lon, lat):
    """A function that is linear in longitude, from 0 to 350, and in latitude; one value at each pole."""
    return (np.asarray(lon, float) % 360) * (1 - np.abs(lat) / 90) + 3 * np.asarray(lat, float)


def write_table(path, rows=POINTS, names=NAMES, header="lon,lat,name,height"):
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.write(header + "\n")
        csv.writer(file).writerows([lon, lat, name, "" if name == "a" else 7 + k] for k, ((lon, lat), name) in enumerate(zip(rows, names, strict=True)))


class Points(ToolInFolder):
    def setUp(self):
        super().setUp()
        with netCDF4.Dataset(self.folder / "in.nc", "w", format="NETCDF3_CLASSIC") as file:
            for name, values, marks in (
                ("time", TIMES, {"units": "hours since 2000-01-01"}),
                ("lev", LEVELS, {"units": "hPa"}),
                ("lat", LAT, {"units": "degrees_north"}),
                ("lon", LON, {"units": "degrees_east"}),
            ):
                file.createDimension(name, len(values))
                add(file, name, (name,), values, **marks)
            base = function(*np.meshgrid(LON, LAT))
            add(file, "t", ("time", "lat", "lon"), base + TIMES[:, None, None], units="K")
            add(file, "oro", ("lat", "lon"), base)
            add(file, "cloud", ("time", "lev", "lat", "lon"), base + TIMES[:, None, None, None] + LEVELS[:, None, None])
        write_table(self.folder / "sites.csv")

    def values(self, name, variable):
        with netCDF4.Dataset(self.folder / name) as file:
            return np.ma.filled(file[variable][...].astype(float), np.nan)

    def attributes(self, name, variable=None):
        with netCDF4.Dataset(self.folder / name) as file:
            owner = file if variable is None else file[variable]
            return {key: owner.getncattr(key) for key in owner.ncattrs()}

    def test_bilinear_values_are_those_of_the_function(self):
        said = self.run_tool("regrid", "in.nc", "sites.csv", "--method", "bilinear", "-o", "out.nc")
        self.assertEqual(said, [])
        lon, lat = np.transpose(POINTS)
        # Bilinear in each cell, of the values at its corners; the rows at the poles are one place each.
        column, row = (lon % 360) / 10, (lat + 90) / 10
        i, j = np.floor(column).astype(int), np.minimum(np.floor(row), len(LAT) - 2).astype(int)
        a, b = column - i, row - j
        grid = function(*np.meshgrid(LON, LAT))
        east = (i + 1) % len(LON)
        wanted = (1 - b) * ((1 - a) * grid[j, i] + a * grid[j, east]) + b * ((1 - a) * grid[j + 1, i] + a * grid[j + 1, east])
        np.testing.assert_allclose(self.values("out.nc", "oro"), wanted, rtol=0, atol=1e-11)
        np.testing.assert_allclose(self.values("out.nc", "t"), wanted + TIMES[:, None], rtol=0, atol=1e-11)
        np.testing.assert_allclose(self.values("out.nc", "cloud"), wanted + (TIMES[:, None] + LEVELS)[..., None], rtol=0, atol=1e-11)

    def test_nearest_values_are_those_of_the_nearest_source(self):
        points = np.random.default_rng(7).uniform((-180, -90), (180, 90), (300, 2))
        write_table(self.folder / "many.csv", points.tolist(), [f"s{k}" for k in range(300)])
        self.run_tool("regrid", "in.nc", "many.csv", "--method", "nearest", "-o", "out.nc")
        lon, lat = np.meshgrid(LON, LAT)
        near = np.argmax(unit(*points.T) @ unit(lon.ravel(), lat.ravel()).T, axis=1)
        np.testing.assert_array_equal(self.values("out.nc", "oro"), function(lon, lat).ravel()[near])

    def test_all_methods_give_what_interpolate_gives(self):
        for method in METHODS:
            with self.subTest(method=method):
                self.run_tool("regrid", "in.nc", "sites.csv", "--method", method, "-o", "a.nc")
                self.run_tool("interpolate", "in.nc", "--to", "sites.csv", "--method", method, "-o", "b.nc")
                # Gradients are taken of values there, and are parts of the weights here.
                rounding = 1e-13 if method in ("hermite", "cubic") else 0
                for name in ("t", "oro", "cloud"):
                    np.testing.assert_allclose(self.values("a.nc", name), self.values("b.nc", name), rtol=rounding)

    def test_columns_stand_beside_the_values(self):
        for ending in ("nc", "nc4"):
            self.run_tool("regrid", "in.nc", "sites.csv", "--method", "linear", "-o", f"out.{ending}")
            with netCDF4.Dataset(self.folder / f"out.{ending}") as file:
                self.assertEqual(file["t"].dimensions, ("time", "point"))
                self.assertEqual(file["cloud"].dimensions, ("time", "lev", "point"))
                self.assertEqual(file["name"][:].tolist(), NAMES)
                self.assertEqual(np.ma.filled(file["height"][:], np.nan)[[0, 1, 6]].tolist(), [7, 8, 13])
                self.assertTrue(np.isnan(file["height"][3]))
                np.testing.assert_array_equal(np.stack([file["lon"][:], file["lat"][:]], -1), POINTS)
                self.assertEqual(file["t"].coordinates, "lon lat")
        self.run_tool("regrid", "in.nc", "sites.csv", "--method", "linear", "--value", "oro", "-o", "out.csv")
        with open(self.folder / "out.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["name"] for row in rows], NAMES)
        np.testing.assert_array_equal([float(row["oro"]) for row in rows], self.values("out.nc", "oro"))

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "needs xarray")
    def test_xarray_opens_the_output(self):
        import xarray

        self.run_tool("regrid", "in.nc", "sites.csv", "--method", "linear", "-o", "out.nc")
        with xarray.open_dataset(self.folder / "out.nc") as data:
            self.assertEqual(dict(data.t.sizes), {"time": 3, "point": len(POINTS)})
            self.assertEqual([text.decode() if isinstance(text, bytes) else text for text in data["name"].values], NAMES)
            self.assertEqual(set(data.t.coords), {"time", "lon", "lat"})

    def test_the_type_of_features_is_that_of_all_series(self):
        write_table(self.folder / "named.csv", names=[f"s{k}" for k in range(len(POINTS))])
        for names, feature, role in (
            (("t", "oro"), "timeSeries", "timeseries_id"),
            (("cloud",), "timeSeriesProfile", "timeseries_id"),
            (("oro",), "point", None),
            (("t", "cloud"), None, None),
        ):
            with self.subTest(names=names):
                chosen = [word for name in names for word in ("--value", name)]
                self.run_tool("regrid", "in.nc", "named.csv", "--method", "linear", *chosen, "-o", "out.nc")
                self.assertEqual(self.attributes("out.nc").get("featureType"), feature)
                self.assertEqual(self.attributes("out.nc", "name").get("cf_role"), role)
        # Names that are not those of one place each have no role.
        self.run_tool("regrid", "in.nc", "sites.csv", "--method", "linear", "--value", "t", "-o", "out.nc")
        self.assertNotIn("cf_role", self.attributes("out.nc", "name"))

    def test_columns_with_the_names_of_fields_give_way(self):
        write_table(self.folder / "taken.csv", header="lon,lat,t,time")
        said = self.run_tool("regrid", "in.nc", "taken.csv", "--method", "linear", "-o", "out.nc")
        self.assertEqual(said, [])
        with netCDF4.Dataset(self.folder / "out.nc") as file:
            self.assertEqual(file["t_"][:].tolist(), NAMES)

    def test_features_are_points_or_polygons(self):
        point = {"type": "Feature", "properties": {"name": "x", "n": 2.5}, "geometry": {"type": "Point", "coordinates": [10, 20]}}
        multi = {"type": "Feature", "properties": {"name": "y"}, "geometry": {"type": "MultiPoint", "coordinates": [[0, 90], [540, 0]]}}
        area = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [0, 9], [0, 0]]]}}
        for name, features in (("points", [point, multi]), ("areas", [area]), ("mixed", [point, area]), ("none", [])):
            (self.folder / f"{name}.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        (self.folder / "points.json").write_text((self.folder / "points.geojson").read_text())
        for ending in ("geojson", "json"):
            self.assertEqual(self.run_tool("regrid", "in.nc", f"points.{ending}", "--method", "bilinear", "-o", "out.nc"), [])
            np.testing.assert_allclose(self.values("out.nc", "oro"), [function(10, 20), 270, 180], rtol=0, atol=1e-12)
            with netCDF4.Dataset(self.folder / "out.nc") as file:
                self.assertEqual(file["name"][:].tolist(), ["x", "y", "y"])
        for name, why in (
            ("areas", "areas.geojson: it has polygons, which are no places"),
            ("mixed", 'mixed.geojson:1: feature 1: type "Polygon" where a Point is needed'),
        ):
            said = self.run_tool("regrid", "in.nc", f"{name}.geojson", "--method", "linear", "-o", "out.nc", status=1)
            self.assertTrue(said[0].startswith(why), said)
        self.assertEqual(self.run_tool("regrid", "in.nc", "none.geojson", "--method", "linear", "-o", "out.nc4"), ["none.geojson: there are no points"])
        said = self.run_tool("regrid", "in.nc", "points.geojson", "--method", "linear", "--edges", "geodesic", "-o", "out.nc", status=2)
        self.assertEqual(said, ["--edges has no effect with a method between places"])

    def test_methods_over_cells_are_refused(self):
        why = (
            "sites.csv: points have no cells, which conservative methods, largest_share and statistics need; nearest, linear, "
            "laplace, sibson, hermite, cubic, bilinear and native are the methods for points"
        )
        for options in ((), ("--method", "conservative-2nd"), ("--method", "largest-share"), ("--statistics", "mean")):
            self.assertEqual(self.run_tool("regrid", "in.nc", "sites.csv", *options, "-o", "out.nc", status=1), [why])
            self.assertFalse((self.folder / "out.nc").exists())

    def test_tables_that_have_no_places_are_refused(self):
        for text, why in (
            ("", "the file is empty"),
            ("lon;lat\n1;2\n", '; is the delimiter ";"? A target has commas, or tabs in .tsv'),
            ("lon,longitude,lat\n1,2,3\n", '"longitude" (column 2); rename or remove one of them'),
            ("lon,lat,x,y,z\n1,2,3,4,5\n", "x, y, z; rename or remove those of one kind"),
            ("x,y\n1,2\n", "; if they are longitude and latitude, call them lon and lat"),
            ("x,y,z\n0,1,0\n0,0,0\n", "bad.csv:3: the point has no direction, so that it is no place"),
            ("a,b\n1,2\n", ":1: no columns for longitude and latitude (lon, lat) or for x, y, z; found: a, b"),
            ("lon,lat\n1,2\nnan,3\n", ':3: longitude "nan" is not finite'),
            ("lon,lat\n1,91\n", ":2: latitude"),
        ):
            (self.folder / "bad.csv").write_text(text)
            said = self.run_tool("regrid", "in.nc", "bad.csv", "--method", "linear", "-o", "out.nc", status=1)
            self.assertIn(why, said[0])
        self.run_tool("regrid", "in.nc", "nowhere.csv", "--method", "linear", "-o", "out.nc", status=1)
        (self.folder / "gap.csv").write_text("lon,lat,name\n10,20,a\n,,b\n0,90,c\n")
        said = self.run_tool("regrid", "in.nc", "gap.csv", "--method", "linear", "-o", "out.nc")
        self.assertEqual(said, ["gap.csv: left out 1 target without a place"])
        with netCDF4.Dataset(self.folder / "out.nc") as file:
            self.assertEqual(file["name"][:].tolist(), ["a", "c"])

    def test_points_beyond_the_source_have_no_value(self):
        with netCDF4.Dataset(self.folder / "region.nc", "w") as file:
            for name, values, units in (("lat", [0.0, 5, 10], "degrees_north"), ("lon", [0.0, 5, 10], "degrees_east")):
                file.createDimension(name, 3)
                add(file, name, (name,), values, units=units)
            add(file, "t", ("lat", "lon"), np.arange(9.0).reshape(3, 3))
        write_table(self.folder / "few.csv", [(2.5, 2.5), (50, 2.5)], ["in", "out"])
        self.run_tool("regrid", "region.nc", "few.csv", "--method", "bilinear", "-o", "out.nc")
        np.testing.assert_array_equal(self.values("out.nc", "t"), [2.0, np.nan])
        self.run_tool("regrid", "region.nc", "few.csv", "--method", "bilinear", "--extrapolate", "nearest", "-o", "out.nc")
        np.testing.assert_array_equal(self.values("out.nc", "t"), [2.0, 5.0])

    def test_tiles_memory_threads_and_resumed_runs_change_no_byte(self):
        points = np.random.default_rng(3).uniform((-180, -90), (180, 90), (5000, 2))
        write_table(self.folder / "many.csv", points.tolist(), [f"station {k}" for k in range(5000)])
        command = ("regrid", "in.nc", "many.csv", "--method", "sibson")
        self.run_tool(*command, "-o", "a.nc")
        wanted = (self.folder / "a.nc").read_bytes()
        for options in (("--tile", "700"), ("--threads", "1"), ("--memory", "6M"), ("--resume", "--tile", "999")):
            self.run_tool(*command, *options, "-o", "b.nc")
            self.assertEqual((self.folder / "b.nc").read_bytes(), wanted, options)
        self.run_tool(*command, "-o", "many.csv", "--format", "nc", status=2)

    def test_lists_of_netcdf_keep_what_they_say_of_their_places(self):
        for kind, ending in (("NETCDF4", "nc4"), ("NETCDF3_CLASSIC", "nc")):
            with netCDF4.Dataset(self.folder / "stations.nc", "w", format=kind) as file:
                file.createDimension("station", 3)
                file.createDimension("length", 5)
                file.featureType = "timeSeries"
                add(file, "lon", ("station",), [10.0, 0, 180], units="degrees_east")
                add(file, "lat", ("station",), [20.0, 90, 0], units="degrees_north")
                texts = np.array(["a", "bcdef", "é"], object)
                if kind == "NETCDF4":
                    add(file, "name", ("station",), texts, str, cf_role="timeseries_id", long_name="where")
                else:
                    chars = np.array([list(t.encode().ljust(5, b"\0")) for t in texts], np.uint8).view("S1")
                    add(file, "name", ("station", "length"), chars, "S1", cf_role="timeseries_id", long_name="where")
                add(file, "alt", ("station",), [1.5, -999, 3], units="m", positive="up", missing_value=-999.0)
                add(file, "number", ("station",), [7, 8, 9], "i4", cf_role="timeseries_id")
                add(file, "both", ("station", "length"), 1.0)
                file["name"].coordinates = "lon lat alt"
            said = self.run_tool("regrid", "in.nc", "stations.nc", "--method", "bilinear", "--value", "t", "-o", f"out.{ending}")
            self.assertEqual(said, [])
            with netCDF4.Dataset(self.folder / f"out.{ending}") as file:
                self.assertEqual(file.featureType, "timeSeries")
                self.assertEqual(file["t"].dimensions, ("time", "point"))
                file["name"].set_auto_chartostring(True)
                self.assertEqual(file["name"][:].tolist(), ["a", "bcdef", "é"])
                self.assertEqual((file["name"].cf_role, file["name"].long_name), ("timeseries_id", "where"))
                self.assertEqual((file["alt"].units, file["alt"].positive), ("m", "up"))
                np.testing.assert_array_equal(np.ma.filled(file["alt"][:], np.nan), [1.5, np.nan, 3])
                self.assertEqual(file["number"][:].tolist(), [7, 8, 9])
                self.assertNotIn("cf_role", file["number"].ncattrs())
            np.testing.assert_allclose(self.values(f"out.{ending}", "t")[0], [function(10, 20), 270, 180], atol=1e-12)

    def test_a_list_needs_no_fields(self):
        with netCDF4.Dataset(self.folder / "track.nc", "w") as file:
            file.createDimension("time", 2)
            add(file, "time", ("time",), [5.0, 6], units="days since 2001-01-01")
            add(file, "lon", ("time",), [10.0, 0], units="degrees_east")
            add(file, "lat", ("time",), [20.0, 90], units="degrees_north")
        said = self.run_tool("regrid", "in.nc", "track.nc", "--method", "bilinear", "-o", "out.nc")
        self.assertEqual(said, ["out.nc: what describes places gave way to fields: time is time_"])
        with netCDF4.Dataset(self.folder / "out.nc") as file:
            self.assertEqual(file["time_"][:].tolist(), [5, 6])
            self.assertEqual(file["time_"].units, "days since 2001-01-01")
            np.testing.assert_array_equal(file["time"][:], TIMES)
        self.run_tool("interpolate", "in.nc", "--to", "track.nc", "--method", "bilinear", "--value", "oro", "-o", "out.nc")
        with netCDF4.Dataset(self.folder / "out.nc") as file:
            self.assertEqual(file["time"].units, "days since 2001-01-01")

    def test_points_can_be_the_source(self):
        with netCDF4.Dataset(self.folder / "values.nc", "w") as file:
            file.createDimension("station", len(POINTS))
            add(file, "t", ("station",), np.arange(float(len(POINTS))))
        self.run_tool("regrid", "values.nc", "sites.csv", "--source", "sites.csv", "--method", "nearest", "-o", "out.nc")
        # Of two sources in one place the first one counts.
        np.testing.assert_array_equal(self.values("out.nc", "t"), [0, 1, 2, 3, 3, 5, 6])


if __name__ == "__main__":
    unittest.main()
