#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Cells as GeoPackage and FlatGeobuf: what GDAL reads of them is what GeoJSON has.

The library is that of pyogrio's wheel; without it ctest says "Skipped".
"""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

if any(importlib.util.find_spec(name) is None for name in ("pyogrio", "geopandas")):
    sys.exit(77)
import geopandas
import numpy as np
import pyogrio

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
WHEEL = pathlib.Path(pyogrio.__file__).parent
LIBRARIES = sorted(WHEEL.parent.glob("pyogrio.libs/libgdal*"))
if not LIBRARIES:
    sys.exit(77)
ENVIRONMENT = {**os.environ, "RONDEL_GDAL": str(LIBRARIES[0])}


class FilesOfGdal(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_tool(self, *arguments):
        return subprocess.run([TOOL, *arguments, "--quiet"], cwd=self.folder, env=ENVIRONMENT,
                              text=True, capture_output=True, check=False)

    def voronoi(self, *arguments):
        return self.run_tool("voronoi", *arguments)

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


if __name__ == "__main__":
    unittest.main()
