#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What the plugin for QGIS does without QGIS: it finds the tool, writes its input, and knows its options.

    tool_test.py TOOL
"""

import ast
import configparser
import importlib.util
import json
import os
import pathlib
import sys
import tempfile
import time
import unittest
from unittest import mock

sys.dont_write_bytecode = True
from stations import LAND, PLUGIN, stations  # noqa: E402 (after the line above)

TOOL = str(pathlib.Path(sys.argv.pop(1)).resolve())
description = importlib.util.spec_from_file_location("tool", PLUGIN / "tool.py")
tool = importlib.util.module_from_spec(description)
description.loader.exec_module(tool)


class Tool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.sites = self.folder / "sites.geojson"
        tool.write_features(self.sites, stations())

    def made(self, arguments):
        """The features that the tool makes."""
        tool.run_tool(TOOL, arguments)
        return json.loads(pathlib.Path(arguments[arguments.index("-o") + 1]).read_text(encoding="utf-8"))["features"]

    def test_options_are_those_of_the_tool(self):
        output = self.folder / "out.geojson"
        self.assertGreater(len(self.made(tool.delaunay(self.sites, output))), 11000)
        self.assertGreater(len(self.made(tool.voronoi(self.sites, output))), 5600)
        clipped = self.made(tool.voronoi(self.sites, output, clip=LAND))
        self.assertLess(sum(f["properties"]["area"] for f in clipped), 4)  # steradians of land: 29 % of the sphere
        joined = self.made(tool.voronoi(self.sites, output, clip=LAND, group="area"))
        self.assertEqual(len(joined), len({properties["area"] for _, properties in stations()}))
        lines = self.made(tool.contours(self.sites, output, "t", step=5.0))
        self.assertEqual({f["geometry"]["type"] for f in lines}, {"MultiLineString"})
        self.assertEqual([f["properties"]["level"] for f in lines], [5, 10, 15, 20, 25, 30])
        bands = self.made(tool.contours(self.sites, output, "t", levels=[0.1, 20], bands=True))
        self.assertEqual([f["properties"]["high"] for f in bands], [0.1, 20, None])
        for method in tool.METHODS:
            grid = self.folder / f"{method}.npy"
            tool.run_tool(TOOL, tool.interpolate(self.sites, grid, "t", 30.0, method))
            self.assertGreater(grid.stat().st_size, 8 * 12 * 6)

    def test_what_the_tool_refuses_is_an_error(self):
        told = []
        with self.assertRaisesRegex(tool.ToolError, "rondel: .*no column.*'q'|rondel: .*q"):
            tool.run_tool(TOOL, tool.contours(self.sites, self.folder / "x.geojson", "q", step=1.0), tell=told.append)
        self.assertIn("contours", told[0])

    def test_the_tool_is_found(self):
        with mock.patch.dict(os.environ, {"RONDEL_TOOL": "", "PATH": ""}):
            self.assertEqual(tool.find_tool(TOOL), TOOL)
            self.assertRaisesRegex(tool.ToolError, "pip install rondel", tool.find_tool)
            self.assertRaisesRegex(tool.ToolError, "/nowhere/rondel is not a program", tool.find_tool, "/nowhere/rondel")
        with mock.patch.dict(os.environ, {"RONDEL_TOOL": TOOL}):
            self.assertEqual(tool.find_tool(), TOOL)
        with mock.patch.dict(os.environ, {"RONDEL_TOOL": "", "PATH": str(pathlib.Path(TOOL).parent)}):
            self.assertEqual(tool.find_tool(), TOOL)

    def test_a_run_is_stopped(self):
        start = time.monotonic()
        with self.assertRaisesRegex(tool.ToolError, "stopped"):
            tool.run_tool(sys.executable, ["-c", "import time; time.sleep(60)"], is_stopped=lambda: True)
        self.assertLess(time.monotonic() - start, 30)

    def test_input_keeps_digits_texts_and_nothing(self):
        point = {"type": "Point", "coordinates": [0.1 + 0.2, -1e-300]}
        tool.write_features(self.sites, [(point, {"a": "ä\"\n", "b": None, "c": 2**60 + 1}), (None, {})])
        first, second = json.loads(self.sites.read_text(encoding="utf-8"))["features"]
        self.assertEqual((first["geometry"], first["properties"]), (point, {"a": "ä\"\n", "b": None, "c": 2**60 + 1}))
        self.assertIsNone(second["geometry"])
        self.assertRaises(ValueError, tool.write_features, self.sites, [(point, {"x": float("inf")})])

    def test_files_are_python_and_metadata_is_complete(self):
        metadata = configparser.ConfigParser()
        metadata.read(PLUGIN / "metadata.txt", encoding="utf-8")
        self.assertEqual(metadata["general"]["hasProcessingProvider"], "yes")
        sources = sorted(PLUGIN.glob("*.py"))
        self.assertEqual([s.stem for s in sources], ["__init__", "algorithms", "plugin", "provider", "tool"])
        names = {node.name for node in ast.parse((PLUGIN / "algorithms.py").read_text(encoding="utf-8")).body
                 if isinstance(node, ast.ClassDef)}
        self.assertTrue({"Delaunay", "Voronoi", "Dissolve", "Interpolate", "Contours"} <= names)


if __name__ == "__main__":
    unittest.main()
