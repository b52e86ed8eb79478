#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The JSON object of --json: its keys, types and sums are a contract."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

INPUTS = pathlib.Path(__file__).resolve().parent / "inputs"
TOOL = pathlib.Path(sys.argv.pop(1)).resolve()

KEYS = ["sites", "vertices", "faces", "solid_faces", "ghost_faces", "duplicates", "hidden",
        "dimension", "model", "builder", "threads", "seconds", "peak_memory_bytes", "rungs",
        "unlocated"]
SECONDS = ["read", "order", "triangulate", "dual", "write", "total"]
RUNGS = ["filter", "extended", "double_double", "close", "exact", "perturbed"]


class JsonReport(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def report(self, *arguments, status=0):
        done = subprocess.run([TOOL, *arguments, "--json"], cwd=self.folder.name, text=True,
                              capture_output=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (status, ""))
        return json.loads(done.stdout)

    def build(self, command, name, output, *options):
        return self.report(command, INPUTS / name, "-o", output, *options)

    def assert_contract(self, report, keys=KEYS):
        self.assertEqual(list(report), keys)
        self.assertEqual(list(report["seconds"]), SECONDS)
        self.assertEqual(list(report["rungs"]), RUNGS)
        self.assertEqual(report["sites"],
                         report["vertices"] + report["duplicates"] + report["hidden"])
        self.assertEqual(report["faces"], report["solid_faces"] + report["ghost_faces"])
        if report["dimension"] == 2:
            self.assertEqual(report["faces"], 2 * report["vertices"] - 4)
        seconds = report["seconds"]
        self.assertTrue(all(value >= 0 for value in seconds.values()))
        self.assertLessEqual(sum(seconds[key] for key in SECONDS[:-1]), seconds["total"] + 1e-3)
        self.assertGreater(report["peak_memory_bytes"], 1 << 20)
        self.assertTrue(all(isinstance(value, int) for value in report["rungs"].values()))

    def test_delaunay_has_exactly_the_keys_of_the_contract(self):
        report = self.build("delaunay", "towns.csv", "out.npy", "--threads", "1")
        self.assert_contract(report)
        self.assertEqual([report[key] for key in KEYS[:11]],
                         [10, 9, 14, 14, 0, 1, 0, 2, "projected", "incremental", 1])
        self.assertGreater(report["rungs"]["filter"], 0)
        self.assertEqual(report["seconds"]["dual"], 0)

    def test_queries_count_their_answers(self):
        keys = ["sites", "vertices", "faces", "dimension", "model", "threads", "queries", "answers",
                "seconds", "peak_memory_bytes"]
        seconds = ["read", "order", "triangulate", "locator", "query", "write", "total"]
        for command, options, answers in (
                ("nearest", ["-k", "2"], {"found": 6}),
                ("nearest", ["--within", "40"], {"found": 5}),
                ("locate", [], {"vertex": 1, "edge": 0, "face": 2, "outside": 0})):
            report = self.report(command, INPUTS / "towns.csv", INPUTS / "ships.csv",
                                 "-o", "out.csv", *options)
            self.assertEqual(list(report), keys)
            self.assertEqual(list(report["seconds"]), seconds)
            self.assertEqual([report[key] for key in keys[:8] if key != "threads"],
                             [10, 9, 14, 2, "projected", 3, answers])

    def test_hull_has_these_keys_and_more(self):
        report = self.build("hull", "cube.xyz", "out.off")
        self.assertEqual([report.pop(key) for key in ("flat", "volume", "area")], [False, 8, 24])
        self.assert_contract(report, KEYS[:-1])
        flat = self.build("hull", "square.csv", "out.off")
        self.assertEqual([flat.pop(key) for key in ("flat", "volume", "area")], [True, 0, 8])
        self.assert_contract(flat, KEYS[:-1])
        self.assertEqual((flat["dimension"], flat["vertices"], flat["faces"]), (1, 4, 0))

    def test_voronoi_has_the_same_keys_and_times_the_dual(self):
        report = self.build("voronoi", "towns.csv", "out.geojson")
        self.assert_contract(report)
        self.assertGreater(report["seconds"]["dual"], 0)

    def test_plot_has_the_same_keys(self):
        self.assert_contract(self.build("plot", "towns.csv", "out.png"))

    def test_hidden_sites_are_counted(self):
        report = self.build("delaunay", "hidden.csv", "out.npy", "--model", "weighted")
        self.assert_contract(report)
        self.assertEqual((report["model"], report["hidden"], report["vertices"]),
                         ("weighted", 1, 7))

    def test_ghost_faces_are_counted_when_the_center_is_outside(self):
        report = self.build("delaunay", "octahedron.xyz", "out.npy", "--center", "10", "1", "2",
                            "--model", "weighted")
        self.assert_contract(report)
        self.assertGreater(report["ghost_faces"], 0)

    def test_low_dimensions(self):
        for name, dimension, vertices, duplicates in [
                ("one.csv", 0, 1, 0), ("one-thrice.csv", 0, 1, 2), ("equator.csv", 1, 5, 0)]:
            report = self.build("delaunay", name, "out.npy")
            self.assert_contract(report)
            self.assertEqual((report["dimension"], report["vertices"], report["duplicates"],
                              report["faces"]), (dimension, vertices, duplicates, 0))

    def test_features_without_a_place_are_counted(self):
        done = subprocess.run([TOOL, "delaunay", INPUTS / "unlocated.geojson", "-o", "out.npy",
                               "--json"], cwd=self.folder.name, text=True, capture_output=True,
                              timeout=60, check=True)
        report = json.loads(done.stdout)
        self.assert_contract(report)
        self.assertEqual((report["sites"], report["unlocated"]), (1, 2))
        self.assertIn("left out 2 features without a place", done.stderr)

    def test_quiet_does_not_silence_json(self):
        self.assert_contract(self.build("delaunay", "towns.csv", "out.npy", "--quiet"))

    def test_check_tells_its_verdict(self):
        self.build("delaunay", "towns.csv", "faces.npy")
        report = self.report("check", INPUTS / "towns.csv", "faces.npy")
        self.assertEqual(list(report), ["valid", "reason", "sites", "vertices", "edges", "faces",
                                        "duplicates", "hidden", "model", "seconds",
                                        "peak_memory_bytes"])
        self.assertEqual((report["valid"], report["reason"], report["vertices"], report["edges"],
                          report["faces"], report["duplicates"]), (True, "", 9, 21, 14, 1))

    def test_check_tells_why_not_and_fails(self):
        self.build("delaunay", "towns.csv", "faces.npy")
        report = self.report("check", INPUTS / "octahedron.xyz", "faces.npy", status=1)
        self.assertFalse(report["valid"])
        self.assertNotEqual(report["reason"], "")

    def test_info_tells_the_facts(self):
        report = self.report("info", INPUTS / "towns.csv")
        self.assertEqual((report["sites"], report["coordinates"], report["duplicates"]),
                         (10, "lonlat", 1))
        self.assertEqual(report["bounds"], {"lon": {"min": -157.9, "max": 178},
                                            "lat": {"min": -90, "max": 82.5}})
        self.assertLess(report["distance_from_sphere"]["max"], 1e-15)
        self.assertEqual([column["kind"] for column in report["columns"]],
                         ["text", "text", "number", "number", "number"])

    def test_generate_tells_what_it_wrote(self):
        report = self.report("generate", "paper-s", "-n", "100", "-o", "out.csv")
        self.assertEqual((report["kind"], report["sites"], report["seed"]), ("paper-s", 105, 1))


if __name__ == "__main__":
    unittest.main()
