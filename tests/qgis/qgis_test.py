#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The plugin in QGIS: each algorithm, by qgis_process, makes of the stations what the tool makes.

    qgis_test.py TOOL

Needs Debian's qgis and python3-qgis: scripts/test --qgis installs them.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from osgeo import gdal, ogr  # noqa: E402 (after the line above)
from stations import LAND, PLUGIN, ROOT, stations  # noqa: E402

gdal.UseExceptions()
TOOL = str(pathlib.Path(sys.argv.pop(1)).resolve())
PROGRAM = "/usr/bin/qgis_process.bin"  # qgis_process passes options of Debian that it does not know itself


def features_of(path):
    """Geometries as text with all digits, and properties, of a file that GDAL reads."""
    data = gdal.OpenEx(str(path))
    found = []
    for feature in data.GetLayer(0):
        geometry = feature.GetGeometryRef()
        text = None if geometry is None else ogr.ForceTo(geometry.Clone(), multi_of(geometry)).ExportToJson(["COORDINATE_PRECISION=15"])
        found.append((text, {key: plain(value) for key, value in feature.items().items() if value is not None}))
    return found


def plain(value):
    """A value as GeoPackage has it: lists are texts."""
    return ",".join(map(str, value)) if isinstance(value, list) else value


def multi_of(geometry):
    return {ogr.wkbPolygon: ogr.wkbMultiPolygon, ogr.wkbLineString: ogr.wkbMultiLineString}.get(
        geometry.GetGeometryType(), geometry.GetGeometryType())


class Algorithms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        runtime = cls.folder / "runtime"
        runtime.mkdir(mode=0o700)
        cls.environment = {**os.environ, "HOME": str(cls.folder), "XDG_RUNTIME_DIR": str(runtime), "QT_QPA_PLATFORM": "offscreen",
                           "QGIS_PLUGINPATH": str(PLUGIN.parent), "RONDEL_TOOL": TOOL, "PYTHONDONTWRITEBYTECODE": "1"}
        cls.sites = cls.folder / "stations.geojson"
        rows = [{"type": "Feature", "geometry": g, "properties": p} for g, p in stations()]
        cls.sites.write_text(json.dumps({"type": "FeatureCollection", "features": rows}), encoding="utf-8")
        done = cls.qgis("plugins", "enable", PLUGIN.name)
        assert done.returncode == 0, done.stdout + done.stderr

    @classmethod
    def qgis(cls, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cls.folder, env=cls.environment, text=True,
                              capture_output=True, check=False)

    def run_algorithm(self, name, output, **parameters):
        """The file that an algorithm makes."""
        path = self.folder / output
        options = [f"--{key}={value}" for key, value in {"INPUT": self.sites, "OUTPUT": path, **parameters}.items()]
        done = self.qgis("run", f"rondel:{name}", *options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return path

    def run_tool(self, output, *arguments):
        path = self.folder / output
        subprocess.run([TOOL, *map(str, arguments), "-o", path, "--quiet"], cwd=self.folder, check=True)
        return path

    def compare(self, ours, theirs, least):
        a, b = features_of(ours), features_of(theirs)
        for _, properties in a:
            properties.pop("fid", None)
        self.assertGreaterEqual(len(a), least)
        self.assertEqual(len(a), len(b))
        for found, expected in zip(a, b):
            self.assertEqual(found, expected)

    def test_delaunay(self):
        self.compare(self.run_algorithm("delaunay", "d.gpkg"), self.run_tool("d.geojson", "delaunay", self.sites), 11000)

    def test_voronoi(self):
        theirs = self.run_tool("v.geojson", "voronoi", self.sites, "--earth-radius", 6371.0088)
        self.compare(self.run_algorithm("voronoi", "v.gpkg"), theirs, 5600)

    def test_voronoi_clipped_to_land(self):
        theirs = self.run_tool("c.geojson", "voronoi", self.sites, "--earth-radius", 6371.0088, "--clip", LAND)
        self.compare(self.run_algorithm("voronoi", "c.gpkg", CLIP=LAND), theirs, 5000)

    def test_dissolve(self):
        theirs = self.run_tool("g.geojson", "voronoi", self.sites, "--earth-radius", 6371.0088, "--group", "area", "--clip", LAND)
        self.compare(self.run_algorithm("dissolve", "g.gpkg", FIELD="area", CLIP=LAND), theirs, 15)

    def test_contours(self):
        theirs = self.run_tool("i.geojson", "contours", self.sites, "--value", "t", "--step", 5)
        self.compare(self.run_algorithm("contours", "i.gpkg", FIELD="t", STEP=5), theirs, 5)
        theirs = self.run_tool("b.geojson", "contours", self.sites, "--value", "t", "--levels", "0.1,10,20", "--bands")
        self.compare(self.run_algorithm("contours", "b.gpkg", FIELD="t", LEVELS="0.1,10,20", BANDS="true"), theirs, 4)

    def test_interpolate(self):
        for number, method in enumerate(("sibson", "linear")):
            raster = gdal.Open(str(self.run_algorithm("interpolate", f"{method}.tif", FIELD="t", DEGREES=5, METHOD=number)))
            self.assertEqual(raster.GetGeoTransform(), (-180, 5, 0, 90, 0, -5))
            self.assertEqual(raster.GetSpatialRef().GetAuthorityCode(None), "4326")
            values = raster.ReadAsArray()
            table = self.run_tool(f"{method}.csv", "interpolate", self.sites, "--value", "t", "--to", "grid:5", "--method", method)
            expected = [line.split(",")[-1] for line in table.read_text().splitlines()[1:]]
            self.assertEqual(values.shape, (36, 72))
            for k, text in enumerate(expected):  # from the south
                found = values[35 - k // 72][k % 72]
                self.assertTrue(found == float(text) if text not in ("", "nan") else not abs(found) < 1e30, (k, found, text))

    def test_projected_sites_are_brought_to_degrees(self):
        projected = self.folder / "p.gpkg"
        gdal.VectorTranslate(str(projected), str(self.sites), dstSRS="ESRI:54009", reproject=True)  # Mollweide
        cells = features_of(self.run_algorithm("voronoi", "p_cells.gpkg", INPUT=projected))
        plain = features_of(self.run_tool("plain.geojson", "voronoi", self.sites, "--earth-radius", 6371.0088))
        areas = [{properties["site"]: properties["area"] for _, properties in every} for every in (cells, plain)]
        self.assertGreater(len(areas[0]), 5600)
        close = sum(abs(areas[0].get(site, 0) - area) < 1e-6 for site, area in areas[1].items())
        self.assertGreater(close, 0.99 * len(areas[1]))

    def test_commands_of_the_guide(self):
        shutil.copy(LAND, self.folder)
        text = (ROOT / "docs" / "guide" / "qgis.md").read_text(encoding="utf-8")
        commands = re.findall(r"^qgis_process (run .*)", text, re.MULTILINE)
        self.assertEqual(len(commands), 5)
        for command in commands:
            done = self.qgis(*shlex.split(command))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertTrue((self.folder / command.split("--OUTPUT=")[1]).exists(), command)

    def test_what_the_tool_refuses_is_told(self):
        done = self.qgis("run", "rondel:contours", f"--INPUT={self.sites}", "--OUTPUT=x.gpkg", "--FIELD=t", "--LEVELS=5,x")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("could not convert string to float", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
