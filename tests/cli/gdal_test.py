#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Cells as GeoPackage and FlatGeobuf: what GDAL reads of them is what GeoJSON has. Sites and features, which are also read.

The library is that of pyogrio's wheel; without it ctest says "Skipped".
"""

import contextlib
import csv
import importlib.util
import json
import os
import pathlib
import shutil
import sqlite3
import sys
import unittest

if any(importlib.util.find_spec(name) is None for name in ("pyogrio", "geopandas")):
    sys.exit(77)
import geopandas
import numpy as np
import pyogrio
import shapely
from tool_in_folder import ToolInFolder

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
WHEEL = pathlib.Path(pyogrio.__file__).parent
LIBRARIES = sorted(WHEEL.parent.glob("pyogrio.libs/libgdal*"))
if not LIBRARIES:
    sys.exit(77)
ENVIRONMENT = {**os.environ, "RONDEL_GDAL": str(LIBRARIES[0])}


class Folder(ToolInFolder):
    environment = ENVIRONMENT

    def run_tool(self, *arguments):
        return self.tool(*arguments, "--quiet")

    def voronoi(self, *arguments, **options):
        return self.tool("voronoi", *arguments, "--quiet", **options)


class FilesOfGdal(Folder):
    def written(self, name, *arguments):
        done = self.voronoi(*arguments, "-o", name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return geopandas.read_file(self.folder / name)

    def test_hold_what_geojson_holds(self):
        """Bit by bit; of 5,634 stations, three of which share a place with another, on land."""
        options = (DATA / "stations.csv", "--clip", DATA / "land-110m.geojson", "--earth-radius", "6371.0088")
        expected = self.written("cells.geojson", *options).set_index("site").sort_index()
        self.assertGreater(len(expected), 5000)
        for name in ("cells.gpkg", "cells.fgb"):
            found = self.written(name, *options).set_index("site").sort_index()
            self.assertEqual(found.crs, "EPSG:4326")
            self.assertTrue(found.geometry.is_valid.all())
            for column in ("area", "area_km2", "id", "name", "longitude", "latitude"):
                self.assertTrue((found[column] == expected[column]).all(), column)
                self.assertEqual(found[column].dtype, expected[column].dtype)
            for ours, theirs in zip(found.geometry, expected.geometry):
                parts = getattr(theirs, "geoms", [theirs])
                self.assertTrue(all(p.equals_exact(q, 0) for p, q in zip(ours.geoms, parts)))
                self.assertEqual(len(ours.geoms), len(parts))

    def test_hold_points_and_lines(self):
        """Each kind alone, and all of them; a feature without a place is left out."""
        kinds = {"point": {"type": "Point", "coordinates": [3, 4]},
                 "line": {"type": "LineString", "coordinates": [[170, 5], [190, 5]]},
                 "polygon": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}}
        everything = {"type": "GeometryCollection", "geometries": [*kinds.values()]}
        cases = {kind: [geometry, None] for kind, geometry in kinds.items()}
        cases["all"] = [*kinds.values(), everything, None]
        for case, geometries in cases.items():
            (self.folder / "in.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [
                {"type": "Feature", "properties": {"k": k}, "geometry": g} for k, g in enumerate(geometries)]}))
            found = {}
            for name in ("out.geojson", "out.gpkg", "out.fgb"):
                done = self.run_tool("repair", "in.geojson", "-o", name)
                self.assertEqual((done.returncode, bool(done.stderr)), (0, name != "out.geojson"), done.stderr)
                found[name] = geopandas.read_file(self.folder / name).set_index("k").sort_index()
            expected = found.pop("out.geojson")
            self.assertEqual(len(expected), len(geometries))
            for name, frame in found.items():
                self.assertEqual(len(frame), len(geometries) - 1, name)
                self.assertEqual([*frame.columns], [*expected.columns])
                for ours, theirs in zip(frame.geometry, expected.geometry):
                    self.assertTrue(ours.normalize().equals(theirs.normalize()), (case, name, ours, theirs))
            if case != "all":
                self.assertEqual(pyogrio.read_info(self.folder / "out.gpkg")["geometry_type"],
                                 {"point": "MultiPoint", "line": "MultiLineString",
                                  "polygon": "MultiPolygon"}[case])

    def test_names_that_are_taken_get_underscores(self):
        (self.folder / "s.csv").write_text("lon,lat,site,site_,area,Area,fid,geom,Name,name\n"
                                           "0,0,a,b,c,d,1.5,e,f,g\n90,10,h,i,j,k,2.5,l,m,n\n")
        for name, own in (("s.geojson", "Area fid geom Name name"), ("s.fgb", "Area fid geom Name name"),
                          ("s.gpkg", "Area__ fid_ geom_ Name name_")):
            found = self.written(name, "s.csv").set_index("site").sort_index()
            self.assertEqual("".join(found[["site_", "site__", "area_"]].loc[0]), "abc", name)
            self.assertEqual([*found[own.split()].loc[1]], ["k", 2.5, "l", "m", "n"], name)
            self.assertAlmostEqual(found["area"].sum(), 4 * np.pi, 12)

    def test_integers_that_are_no_doubles_are_texts(self):
        wide = [2**63 + 2**15, 2**63 + 2**15 + 1, 7, 2**53 + 1]
        (self.folder / "s.csv").write_text("lon,lat,hash,big,mixed\n" + "".join(
            f"{90 * k},{k},{value},{2**62 + k},{value % 2**53 + 0.5}\n" for k, value in enumerate(wide)))
        for name in ("s.gpkg", "s.fgb"):
            found = self.written(name, "s.csv").set_index("site").sort_index()
            self.assertEqual([*found["hash"]], [*map(str, wide)], name)
            self.assertEqual([*found["big"]], [2**62 + k for k in range(4)])
            self.assertEqual(found["big"].dtype, np.int64)
            self.assertEqual(found["mixed"].dtype, np.float64)

    def test_empty_texts_are_not_null(self):
        points = [{"type": "Feature", "properties": {"t": text, "b": True},
                   "geometry": {"type": "Point", "coordinates": [90 * k, 0]}} for k, text in enumerate(("", None, "x"))]
        (self.folder / "p.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": points}))
        for name in ("p.gpkg", "p.fgb"):
            found = self.written(name, "p.geojson").set_index("site").sort_index()
            self.assertEqual(["" if t == "" else t or None for t in found["t"].where(found["t"].notna(), None)],
                             ["", None, "x"], name)
            self.assertEqual(set(found["b"]), {"true"})

    def test_are_the_same_bytes_again(self):
        for name in ("cells.gpkg", "cells.fgb"):
            self.written(name, DATA / "stations.csv")
            first = (self.folder / name).read_bytes()
            self.written(name, DATA / "stations.csv")
            self.assertEqual((self.folder / name).read_bytes(), first)

    def test_groups_have_their_column(self):
        rows = "lon,lat,kind,zone\n" + "".join(
            f"{lon},{lat},{'wet' if lon < 0 else 'dry'},{'' if lat == 60 else lat + 0.5}\n"
            for lon in range(-170, 180, 20) for lat in range(-60, 61, 30))
        (self.folder / "sites.csv").write_text(rows, encoding="utf-8")
        found = self.written("kinds.fgb", "sites.csv", "--group", "kind")
        self.assertEqual(sorted(found["kind"]), ["dry", "wet"])
        self.assertAlmostEqual(found["area"].sum(), 4 * np.pi, 12)
        cells = self.written("cells.gpkg", "sites.csv").set_index("site").sort_index()
        self.assertTrue(np.isnan(cells["zone"][4]))  # no text, no value
        self.assertEqual(cells["zone"][0], -59.5)
        self.assertEqual(cells["lon"].dtype, np.int64 if cells["lon"].dtype.kind == "i" else np.int32)

    def test_what_cannot_be_written_is_told_in_one_line(self):
        for name in ("nowhere/cells.fgb", "nowhere/cells.gpkg"):
            done = self.voronoi(DATA / "stations.csv", "-o", name)
            self.assertEqual((done.returncode, done.stderr), (1, f"rondel: {name}: No such file or directory\n"))
        if "Parquet" not in pyogrio.list_drivers():
            done = self.voronoi(DATA / "stations.csv", "-o", "cells.parquet")
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"\Arondel: cells.parquet: GDAL [0-9.]+ has no driver 'Parquet'; .*\n\Z")
        self.assertEqual(list(self.folder.iterdir()), [])

class SitesOfGdal(Folder):
    """Sites in files that geopandas has written, or reads."""

    def frame(self, **columns):
        points = [shapely.Point(lon, lat) for lon, lat in ((0, 0), (90, 10), (-180, -33.25), (12.1, 90), (0.1, -89.9))]
        return geopandas.GeoDataFrame(columns, geometry=points, crs="EPSG:4326")

    def cells(self, name, *options):
        """The cells of a file of sites, by site, as GeoJSON."""
        done = self.voronoi(name, *options, "-o", "cells.geojson")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        features = json.loads((self.folder / "cells.geojson").read_text())["features"]
        return {feature["properties"].pop("site"): feature for feature in features}

    def refused(self, name, message, *options):
        done = self.voronoi(name, *options, "-o", "cells.geojson")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, rf"\Arondel: {message}\n\Z")
        self.assertFalse((self.folder / "cells.geojson").exists())

    def test_are_those_of_geojson(self):
        """All stations, with texts, numbers and missing values: the same cells and columns, byte by byte."""
        with open(DATA / "stations.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        points = [shapely.Point(float(row["longitude"]), float(row["latitude"])) for row in rows]
        columns = {"id": [row["id"] for row in rows], "name": [row["name"] if i % 7 else None for i, row in enumerate(rows)],
                   "value": [None if i % 11 == 0 else i / 7 for i in range(len(rows))],
                   "count": np.arange(len(rows), dtype=np.int64) + 2**40}
        frame = geopandas.GeoDataFrame(columns, geometry=points, crs="EPSG:4326")
        features = [{"type": "Feature", "properties": {**{key: values[i] for key, values in columns.items()}, "count": int(columns["count"][i])},
                     "geometry": {"type": "Point", "coordinates": [points[i].x, points[i].y]}} for i in range(len(rows))]
        (self.folder / "s.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        expected = self.cells("s.geojson")
        self.assertGreater(len(expected), 5600)
        for name in ("s.gpkg", "s.fgb", "s.shp"):
            options = {"SPATIAL_INDEX": "NO"} if name == "s.fgb" else {}  # which would sort them
            frame.to_file(self.folder / name, engine="pyogrio", **options)
            found = self.cells(name)
            self.assertEqual([*found], [*expected])
            for site, feature in expected.items():
                wanted = dict(feature["properties"])
                if name == "s.shp":  # its texts have no null, its numbers 15 digits
                    wanted["value"] = found[site]["properties"]["value"]
                    wanted["name"] = found[site]["properties"]["name"]
                self.assertEqual(found[site]["properties"], wanted, (name, site))
                self.assertEqual(found[site]["geometry"], feature["geometry"], (name, site))
        self.cells("s.fgb")
        with open(self.folder / "s.fgb", "rb") as file:
            done = self.voronoi("-", "--input-format", "fgb", "-o", "c.geojson", stdin=file)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.folder / "c.geojson").read_bytes(), (self.folder / "cells.geojson").read_bytes())

    def test_info_says_what_gdal_says_of_a_damaged_file(self):
        for name in ("s.gpkg", "s.fgb", "s.shp"):
            (self.folder / name).write_bytes(b"no such file")
            done = self.run_tool("info", name)
            self.assertEqual((done.returncode, done.stdout), (1, ""), name)
            self.assertIn("GDAL", done.stderr)
            self.assertNotIn("unknown ending", done.stderr)

    def test_values_are_interpolated(self):
        frame = self.frame(t=[1.5, 2.5, 3.5, np.nan, 5.5])
        frame.to_file(self.folder / "s.gpkg")
        table = frame.assign(lon=frame.geometry.x, lat=frame.geometry.y).drop(columns="geometry")
        table.to_csv(self.folder / "s.csv", index=False)
        for name in ("s.gpkg", "s.csv"):
            done = self.run_tool("interpolate", name, "--value", "t", "--to", "grid:30", "-o", f"{name}.npy")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        ours, theirs = (np.load(self.folder / f"{name}.npy") for name in ("s.gpkg", "s.csv"))
        self.assertTrue(np.array_equal(ours, theirs, equal_nan=True))
        self.assertGreater(np.isfinite(ours).sum(), 10)

    def test_multipoints_and_features_without_a_place(self):
        geometry = [shapely.MultiPoint([(0, 0), (90, 0), (0, 90)]), None, shapely.Point(), shapely.Point(-120, -40)]
        geopandas.GeoDataFrame({"k": [1, 2, 3, 4]}, geometry=geometry, crs="EPSG:4326").to_file(self.folder / "m.gpkg")
        done = self.finished("voronoi", "m.gpkg", "-o", "cells.geojson", "--json")
        report = json.loads(done.stdout)
        self.assertEqual((report["sites"], report["unlocated"]), (4, 2))
        features = json.loads((self.folder / "cells.geojson").read_text())["features"]
        self.assertEqual([feature["properties"]["k"] for feature in features], [1, 1, 1, 4])

    def test_circles(self):
        frame = self.frame(r=[5.0, 10, 15, 20, 25], t=["5", "10", "15", "20", "x"])
        frame.to_file(self.folder / "c.fgb", SPATIAL_INDEX="NO")
        table = frame.assign(lon=frame.geometry.x, lat=frame.geometry.y).drop(columns="geometry")
        table.to_csv(self.folder / "c.csv", index=False)
        areas = [[cell["properties"]["area"] for cell in self.cells(name, "--radius", "r").values()] for name in ("c.fgb", "c.csv")]
        self.assertEqual(*areas)
        (self.folder / "cells.geojson").unlink()
        self.refused("c.fgb", "c.fgb: feature 4: radius .x. .*", "--radius", "t")
        self.refused("c.fgb", 'c.fgb: no field "q"', "--radius", "q")

    def test_what_is_not_sites_is_refused(self):
        frame = self.frame(k=[1, 2, 3, 4, 5])
        frame.iloc[:2].to_crs("EPSG:3857").to_file(self.folder / "p.gpkg")
        self.refused("p.gpkg", r'p.gpkg: the coordinate system "WGS 84 / Pseudo-Mercator" is not longitude and latitude .*')
        frame.to_crs("EPSG:4807").to_file(self.folder / "paris.gpkg")  # grads from Paris
        self.refused("paris.gpkg", "paris.gpkg: the coordinate system .* is not longitude and latitude in degrees; .*")
        for layer in ("a", "b"):
            frame.to_file(self.folder / "two.gpkg", layer=layer)
        self.refused("two.gpkg", "two.gpkg: it has several layers: a, b; .*")
        frame.set_geometry([point.buffer(1) for point in frame.geometry]).to_file(self.folder / "areas.fgb", SPATIAL_INDEX="NO")
        self.refused("areas.fgb", "areas.fgb: feature 0: it has lines or polygons where a Point is needed")
        (self.folder / "no.gpkg").write_text("this is no database")
        self.refused("no.gpkg", "no.gpkg: GDAL: .*")
        self.refused("nothere.shp", "nothere.shp: No such file or directory")
        bad = geopandas.GeoDataFrame({"k": [1, 2]}, geometry=[shapely.Point(0, 0), shapely.Point(0, 91)], crs="EPSG:4326")
        bad.to_file(self.folder / "bad.gpkg")
        self.refused("bad.gpkg", r"bad.gpkg: feature 1: latitude 91 is outside \[-90, 90\]")
        frame.iloc[:0].to_file(self.folder / "none.gpkg", geometry_type="Point")
        self.assertEqual(self.voronoi("none.gpkg", "-o", "cells.geojson").returncode, 0)

    def test_are_written(self):
        """Points with the digits of the table, and the radii of circles."""
        for kind, options in (("uniform", ()), ("circles", ("--angle", "20"))):
            for name in ("w.csv", "w.gpkg", "w.fgb"):
                done = self.run_tool("generate", kind, "-n", "200", *options, "-o", name)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(self.folder / "w.csv", encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            if "lon" not in rows[0]:
                for name in ("w.gpkg", "w.fgb"):
                    faces = [self.run_tool("delaunay", f, "-o", f"{f}.npy").returncode for f in ("w.csv", name)]
                    self.assertEqual(faces, [0, 0])
                    ours, theirs = (np.load(self.folder / f"{f}.npy") for f in (name, "w.csv"))
                    self.assertTrue(np.array_equal(ours, theirs), name)
                continue
            expected = [(float(row["lon"]), float(row["lat"])) for row in rows]
            for name in ("w.gpkg", "w.fgb"):
                found = geopandas.read_file(self.folder / name)
                self.assertEqual(found.crs, "EPSG:4326")
                self.assertEqual(set(found.geom_type), {"Point"})
                self.assertEqual([*zip(found.geometry.x, found.geometry.y)], expected)
                if options:
                    self.assertEqual([*found["radius"]], [float(row["radius"]) for row in rows])


class FeaturesOfGdal(Folder):
    """Lines and polygons, which are read as those of GeoJSON."""

    ENDINGS = ("gpkg", "fgb", "shp")

    def write(self, geometries, endings=ENDINGS, **columns):
        frame = geopandas.GeoDataFrame(columns, geometry=geometries, crs="EPSG:4326")
        for ending in endings:
            frame.to_file(self.folder / f"f.{ending}", engine="pyogrio", **({"SPATIAL_INDEX": "NO"} if ending == "fgb" else {}))
        features = [{"type": "Feature", "properties": {key: values[i] for key, values in columns.items()},
                     "geometry": None if geometry is None else shapely.geometry.mapping(geometry)}
                    for i, geometry in enumerate(geometries)]
        (self.folder / "f.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))

    # GDAL gives each shapefile a column.
    MESHES_TELL = {"shp": "rondel: f.shp: properties that the output does not have: FID\n"}

    def same(self, *arguments, endings=ENDINGS, told=None):
        """The output of a command whose arguments have {} where a file is named."""
        found = []
        for ending in ("geojson", *endings):
            done = self.run_tool(*[argument.format(f"f.{ending}") for argument in arguments])
            self.assertEqual((done.returncode, done.stderr), (0, (told or {}).get(ending, "")), ending)
            output = arguments[arguments.index("-o") + 1]
            found.append((self.folder / output).read_bytes())
        for ending, text in zip(endings, found[1:]):
            self.assertEqual(text, found[0], ending)

    def test_are_coasts_areas_and_lines(self):
        shutil.copy(DATA / "land-110m.geojson", self.folder / "f.geojson")
        frame = geopandas.read_file(self.folder / "f.geojson")
        for ending in self.ENDINGS:
            frame.to_file(self.folder / f"f.{ending}", engine="pyogrio")
        self.same("mesh", "triangles", "--coast", "{}", "--spacing", "800", "-o", "o.14", told=self.MESHES_TELL)
        self.same("triangulate", "{}", "--inside", "-o", "o.msh", told=self.MESHES_TELL)
        self.same("mesh", "scvt", "-n", "500", "--fixed", "{}", "-o", "o.csv")
        self.same("mesh", "triangles", "--area", "{}", "--spacing", "800", "-o", "o.14", told=self.MESHES_TELL)

    def test_have_holes_parts_and_columns(self):
        holes = shapely.box(0, 0, 9, 9) - shapely.box(1, 1, 2, 2) - shapely.box(3, 3, 4.1, 4.7)
        parts = shapely.MultiPolygon([shapely.box(20, 0, 21, 1), shapely.box(22, 0, 23, 1 / 3)])
        self.write([holes, parts, None], k=[1, 2, 3], name=["a \"b\"", None, "c"], h=[0.1, 1e300, 2.5], endings=("gpkg", "fgb"))
        self.same("repair", "{}", "-o", "o.geojson", endings=("gpkg", "fgb"))
        self.same("simplify", "{}", "--tolerance", "1", "-o", "o.geojson", endings=("gpkg", "fgb"))
        lines = [shapely.LineString([(0, 0), (170, 5.1), (190, 7)]),
                 shapely.MultiLineString([[(0, 10), (1, 11)], [(3, 10), (4, 12)]])]
        for geometries in (lines, [shapely.Point(3, 4.5), shapely.MultiPoint([(5, 6), (7, 8)])]):
            self.write(geometries, k=[*range(len(geometries))], endings=("gpkg", "fgb"))
            self.same("buffer", "{}", "--distance", "100", "-o", "o.geojson", endings=("gpkg", "fgb"))
        everything = shapely.GeometryCollection([lines[0], shapely.Point(1, 2), parts])
        self.write([everything], k=[1], endings=("gpkg",))
        self.same("buffer", "{}", "--distance", "100", "-o", "o.geojson", endings=("gpkg",))

    def test_are_cells_of_regridding(self):
        """Polygons are targets and sources of regrid and remap; points are sites of remap."""
        rows = "".join(f"{lon},{lat},{lon * lat}\n" for lon in range(-170, 180, 20) for lat in range(-80, 90, 20))
        (self.folder / "t.csv").write_text("lon,lat,t\n" + rows)
        done = self.run_tool("interpolate", "t.csv", "--value", "t", "--to", "grid:10", "-o", "t.nc")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        boxes = [None, shapely.box(0, 0, 20, 9), shapely.box(30, 0, 40, 20) - shapely.box(32, 3, 38, 12)]
        self.write(boxes, zone=[1, 2, 3], name=["none", "a", "b"])
        for options in ((), ("--edges", "geodesic"), ("--statistics", "mean,max"), ("--invalid", "repair")):
            self.same("regrid", "t.nc", "{}", *options, "-o", "o.csv")
        self.same("remap", "t.nc", "{}", "-o", "o.npz")
        self.same("remap", "{}", "grid:10", "--edges", "geodesic", "-o", "o.npz")
        for ending in ("geojson", *self.ENDINGS):
            sides = ("--source", f"f.{ending}", "--target", "grid:10", "--edges", "geodesic")
            done = self.run_tool("check-weights", "o.npz", *sides)
            self.assertEqual((done.returncode, done.stderr), (0, ""), ending)
        for ending in self.ENDINGS:
            done = self.run_tool("regrid", "t.nc", f"f.{ending}", "--method", "nearest", "-o", "o.csv")
            self.assertIn(f"f.{ending}: it has polygons, which are no places", done.stderr)
            info = self.finished("info", f"f.{ending}")
            self.assertIn("regrid and remap as a target", info.stdout)
        self.write([shapely.Point(0, 0), shapely.Point(90, 0), shapely.Point(0, 90), shapely.Point(180, -45)], k=[1, 2, 3, 4])
        for ending in self.ENDINGS:
            done = self.run_tool("remap", f"f.{ending}", "grid:30", "-o", "o.npz")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            done = self.run_tool("regrid", "t.nc", f"f.{ending}", "-o", "o.csv")
            self.assertIn(f"rondel: f.{ending}: points have no cells, which conservative methods", done.stderr)
            done = self.run_tool("regrid", "t.nc", f"f.{ending}", "--method", "nearest", "-o", "o.csv")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            rows = [line.split(",") for line in (self.folder / "o.csv").read_text().splitlines()]
            self.assertEqual([row[:3] for row in rows], [["lon", "lat", "k"], ["0", "0", "1"], ["90", "0", "2"], ["0", "90", "3"], ["180", "-45", "4"]])
        self.write([], k=[])
        for ending in self.ENDINGS:
            done = self.run_tool("regrid", "t.nc", f"f.{ending}", "-o", "o.csv")
            self.assertEqual((done.returncode, done.stderr), (1, f"rondel: f.{ending}: there are no cells\n"))

    def test_without_a_coordinate_system_are_in_degrees(self):
        """GeoPackage has three systems that stand for an unknown one."""
        (self.folder / "t.csv").write_text("lon,lat,t\n0,0,1\n120,0,2\n-120,10,3\n0,90,4\n0,-90,5\n")
        self.run_tool("interpolate", "t.csv", "--value", "t", "--method", "nearest", "--to", "grid:10", "-o", "t.nc")
        frame = geopandas.GeoDataFrame({"k": [1]}, geometry=[shapely.box(0, 0, 20, 9)])
        frame.to_file(self.folder / "f.geojson")
        self.run_tool("regrid", "t.nc", "f.geojson", "-o", "wanted.csv")
        for number in (None, -1, 0):
            frame.to_file(self.folder / "f.gpkg")
            if number is not None:
                with contextlib.closing(sqlite3.connect(self.folder / "f.gpkg")) as base:
                    for table in ("gpkg_contents", "gpkg_geometry_columns"):
                        base.execute(f"update {table} set srs_id = {number}")
                    base.commit()
            done = self.run_tool("regrid", "t.nc", "f.gpkg", "-o", "o.csv")
            self.assertEqual((done.returncode, done.stderr), (0, ""), number)
            self.assertEqual((self.folder / "o.csv").read_bytes(), (self.folder / "wanted.csv").read_bytes())
        frame.set_geometry(frame.scale(5, 5000)).to_file(self.folder / "f.gpkg")
        done = self.run_tool("regrid", "t.nc", "f.gpkg", "-o", "o.csv")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Arondel: f.gpkg.*latitude .* is outside \[-90, 90\]\n\Z")

    def test_are_known_to_info(self):
        self.write([shapely.box(0, 0, 9, 9), shapely.LineString([(0, 0), (1, 1)])], k=[1, 2], endings=("gpkg",))
        for name in ("f.gpkg", "f.geojson"):
            done = self.finished("info", name, "--json")
            report = json.loads(done.stdout)
            self.assertEqual((report["features"], report["polygons"], report["lines"]), (2, 1, 1), report)

    def test_that_are_not_valid_are_named(self):
        bow = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
        self.write([shapely.box(5, 5, 6, 6), bow], k=[1, 2])
        for ending in self.ENDINGS:
            done = self.run_tool("mesh", "triangles", "--coast", f"f.{ending}", "--spacing", "500", "-o", "o.14")
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, rf"\Arondel: f.{ending}.*feature 1.*\n\Z")
        frame = geopandas.GeoDataFrame({"k": [1]}, geometry=[bow], crs="EPSG:3857")
        frame.to_file(self.folder / "p.gpkg", engine="pyogrio")
        done = self.run_tool("repair", "p.gpkg", "-o", "o.geojson")
        self.assertIn("is not longitude and latitude in degrees", done.stderr)


if __name__ == "__main__":
    unittest.main()
