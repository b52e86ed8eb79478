#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The tool on another machine: its files have the bytes of this machine's tool, and appear whole or not at all.

    tool_test.py NATIVE_TOOL COMMAND...     COMMAND runs the other tool: qemu-aarch64-static rondel
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
STATIONS = SOURCE / "data" / "stations.csv"
NATIVE, OTHER = [], []
TRIANGLES = ("npy", "off", "ply", "obj", "stl", "vtp", "geojson")
CELLS = ("geojson", "vtp", "npz")
READABLE = ("npy", "off", "ply", "obj", "vtp")
TOO_MANY = "20000000"  # sites: no emulator writes so many in the seconds that the test waits


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rondel-target-"))
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copy(STATIONS, self.folder / "stations.csv")

    def run_tool(self, tool, *arguments, **options):
        return subprocess.run([*tool, *arguments], cwd=self.folder, capture_output=True, check=False, **options)

    def succeed(self, *arguments, tool=None, **options):
        result = self.run_tool(tool or OTHER, *arguments, **options)
        self.assertEqual(result.returncode, 0, (arguments, result.stderr[-500:]))
        return result.stdout

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())


class Bytes(Folder):
    def expect_equal_files(self, *arguments, name):
        self.succeed(*arguments, "-o", f"native-{name}", tool=NATIVE)
        self.succeed(*arguments, "-o", name)
        self.assertEqual(self.bytes_of(name), self.bytes_of(f"native-{name}"), name)

    def test_triangles(self):
        for ending in TRIANGLES:
            self.expect_equal_files("delaunay", "stations.csv", name=f"triangles.{ending}")

    def test_cells(self):
        for ending in CELLS:
            self.expect_equal_files("voronoi", "stations.csv", name=f"cells.{ending}")

    def test_every_format_of_sites(self):
        for path in sorted((SOURCE / "tests" / "corpus" / "io" / "good").iterdir()):
            shutil.copy(path, self.folder / path.name)
            self.expect_equal_files("delaunay", path.name, name=f"of-{path.name}.npy")

    def test_nearest_sites_and_places(self):
        self.expect_equal_files("nearest", "stations.csv", "stations.csv", "-k", "3", name="nearest.csv")
        self.expect_equal_files("locate", "stations.csv", "stations.csv", name="places.csv")

    def test_streams(self):
        arguments = ("delaunay", "-", "--format", "ply", "-o", "-")
        text = STATIONS.read_bytes()
        self.assertEqual(self.succeed(*arguments, input=text), self.succeed(*arguments, input=text, tool=NATIVE))

    def test_check(self):
        for ending in READABLE:
            self.succeed("delaunay", "stations.csv", "-o", f"t.{ending}")
            self.succeed("check", "stations.csv", f"t.{ending}")
        (self.folder / "t.npy").write_bytes(self.bytes_of("t.npy")[:-12] + bytes(12))
        self.assertEqual(self.run_tool(OTHER, "check", "stations.csv", "t.npy").returncode, 1)

    def test_names_that_are_not_ascii(self):
        os.rename(self.folder / "stations.csv", self.folder / "Größe-δ.csv")
        self.succeed("delaunay", "Größe-δ.csv", "-o", "Dreiecke-Δ.npy")
        self.assertEqual(self.names(), ["Dreiecke-Δ.npy", "Größe-δ.csv"])

    def test_messages(self):
        for arguments in (("--version",), ("voronoi", "--help")):
            self.assertEqual(self.succeed(*arguments), self.succeed(*arguments, tool=NATIVE))
        for arguments in (("delaunay", "none.csv", "-o", "t.ply"), ("delaunay", ".", "-o", "t.ply"),
                          ("delaunay", "stations.csv", "-o", "none/t.ply"), ("delaunay", "stations.csv")):
            one, other = (self.run_tool(tool, *arguments) for tool in (NATIVE, OTHER))
            self.assertEqual((other.returncode, other.stderr), (one.returncode, one.stderr))


class AtomicFiles(Folder):
    def setUp(self):
        super().setUp()
        (self.folder / "old.csv").write_text("old")

    def expect_old(self):
        self.assertEqual(self.bytes_of("old.csv"), b"old")
        self.assertEqual(self.names(), ["bad.csv", "old.csv", "stations.csv"])

    def test_a_new_file_replaces_the_old_one(self):
        self.succeed("generate", "uniform", "-n", "3", "-o", "old.csv")
        self.assertEqual(len(self.bytes_of("old.csv").splitlines()), 4)
        self.assertEqual(self.names(), ["old.csv", "stations.csv"])

    def test_a_failure_leaves_the_old_file(self):
        (self.folder / "bad.csv").write_text("lon,lat\n1,2\n3,99\n")
        result = self.run_tool(OTHER, "delaunay", "bad.csv", "--format", "npy", "-o", "old.csv")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"bad.csv:3: latitude 99", result.stderr)
        self.expect_old()

    def test_a_killed_process_leaves_the_old_file_and_no_other(self):
        (self.folder / "bad.csv").write_text("")
        process = subprocess.Popen([*OTHER, "generate", "uniform", "-n", TOO_MANY, "-o", "old.csv"], cwd=self.folder)
        time.sleep(3)
        self.assertIsNone(process.poll())
        process.kill()
        process.wait()
        deadline = time.monotonic() + 30
        while len(self.names()) > 3 and time.monotonic() < deadline:
            time.sleep(0.1)
        self.expect_old()

    def test_a_full_device_is_an_error(self):
        result = self.run_tool(OTHER, "delaunay", "stations.csv", "--format", "npy", "-o", "/dev/full")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"rondel: /dev/full: ", result.stderr)  # the reason depends on the system


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    NATIVE[:] = [sys.argv[1]]
    OTHER[:] = sys.argv[2:]
    unittest.main(argv=sys.argv[:1], verbosity=2)
