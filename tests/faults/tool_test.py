#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The tool where files are too large, are cut, or memory runs out: one line, status 1, no file."""

import json
import os
import pathlib
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
MAX_SITES = 715_827_882
LONG = 100_000_000


def is_sanitized():
    """Whether the tool is built with a sanitizer."""
    return any(name in TOOL.read_bytes() for name in (b"__asan_init", b"__tsan_init"))


def npy_header(shape, dtype="<f8"):
    """The head of an array in NumPy's format, version 1.0."""
    header = f"{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}"
    header += " " * (63 - (10 + len(header)) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()


class Faults(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def write(self, name, content):
        """A file in the folder."""
        (self.folder / name).write_bytes(content)

    def write_sparse(self, name, head, size):
        """A file of which nothing but the head takes room on the disk."""
        with open(self.folder / name, "wb") as file:
            file.write(head)
            file.truncate(len(head) + size)

    def run_tool(self, *arguments, **options):
        """Runs the tool in the folder."""
        return subprocess.run([TOOL, *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, check=False, **options)

    def expect_failure(self, arguments, message, **options):
        """One line, status 1, no new file."""
        before = sorted(os.listdir(self.folder))
        done = self.run_tool(*arguments, **options)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (1, "", f"rondel: {message}\n"))
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    # --- Limits of 32 bits, told before any work ---

    def limit_memory(self):
        """Far less than the work itself would need; sanitizers need more for themselves."""
        if is_sanitized():
            return None
        return lambda: resource.setrlimit(resource.RLIMIT_DATA, (1 << 28, 1 << 28))

    def test_more_sites_than_one_triangulation_can_hold(self):
        for columns in (2, 3):
            self.write_sparse("sites.npy", npy_header((MAX_SITES + 1, columns)),
                              (MAX_SITES + 1) * columns * 8)
            for command in ("delaunay", "voronoi", "hull"):
                if (command, columns) == ("hull", 2):
                    continue  # points have three columns
                ending = "npz" if command == "voronoi" else "npy"
                self.expect_failure(
                    [command, "sites.npy", "-o", "out." + ending],
                    "sites.npy: 715827883 sites are more than the 715827882 that one "
                    "triangulation can hold", preexec_fn=self.limit_memory())

    def test_more_triangles_than_one_triangulation_can_have(self):
        self.write("sites.xyz", b"1 0 0\n0 1 0\n0 0 1\n")
        self.write_sparse("faces.npy", npy_header((2 * MAX_SITES + 1, 3), "<u4"),
                          (2 * MAX_SITES + 1) * 12)
        self.expect_failure(["check", "sites.xyz", "faces.npy"],
                            "faces.npy: 1431655765 triangles are more than the 1431655764 that one "
                            "triangulation can hold", preexec_fn=self.limit_memory())

    def test_a_header_that_claims_2_to_the_60_rows(self):
        self.write("sites.npy", npy_header((1 << 60, 3)))
        self.expect_failure(["delaunay", "sites.npy", "-o", "out.npy"],
                            "sites.npy: shape (1152921504606846976, 3) is too large")
        self.write("sites.npy", npy_header((1 << 59, 3)))
        self.expect_failure(["delaunay", "sites.npy", "-o", "out.npy"],
                            "sites.npy: shape (576460752303423488, 3) needs 13835058055282163712 "
                            "bytes, the file has 0")

    # --- Lines of 100 MB ---

    def test_long_lines_are_read_and_quoted_in_short(self):
        shown = "9" * 60 + "..."
        digits = b"9" * LONG
        self.write("long.csv", b"lon,lat\n0,0\n1," + digits + b"\n")
        self.expect_failure(["delaunay", "long.csv", "-o", "out.npy"],
                            f'long.csv:3: latitude "{shown}" is beyond the largest number')
        self.write("long.xyz", b"1 0 0\n" + digits + b" 0 0\n")
        self.expect_failure(["delaunay", "long.xyz", "-o", "out.npy"],
                            f'long.xyz:2: x "{shown}" is beyond the largest number')
        self.write("long.csv", digits + b",lat\n0,0\n")
        self.expect_failure(["delaunay", "long.csv", "-o", "out.npy"],
                            "long.csv:1: no column for the longitude (lon, lng, long, longitude); "
                            f"found: {shown}, lat")
        self.write("long.off", b"OFF\n" + digits + b"\n")
        self.write("sites.xyz", b"1 0 0\n0 1 0\n0 0 1\n")
        self.expect_failure(["check", "sites.xyz", "long.off"],
                            "long.off:2: no numbers of vertices and faces")

    def test_long_lines_of_names_are_data(self):
        self.write("long.csv", b"lon,lat,name\n0,0," + b"x" * LONG + b"\n90,0,b\n0,90,c\n")
        done = self.run_tool("delaunay", "long.csv", "--quiet", "-o", "out.npy")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_deep_json(self):
        self.write("deep.geojson", b"[" * LONG)
        self.expect_failure(["delaunay", "deep.geojson", "-o", "out.npy"],
                            "deep.geojson:1: values nested more than 512 deep")

    # --- A disk that is full ---

    def test_no_folder_is_left_without_its_files(self):
        ring = [[0, 0], [40, 0], [40, 40], [0, 40], [0, 0]]
        sea = {"type": "Polygon", "coordinates": [ring]}
        self.write("sea.geojson", json.dumps(sea).encode())

        def limit_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024))

        self.expect_failure(["mesh", "triangles", "--area", "sea.geojson", "--spacing", "100",
                             "--format", "fesom", "-o", "mesh"],
                            "mesh/nod2d.out: File too large", preexec_fn=limit_files)

    # --- Less memory than needed ---

    def test_too_little_memory_is_one_line(self):
        if is_sanitized():
            self.skipTest("a sanitizer needs address space without a limit")
        done = self.run_tool("generate", "uniform", "-n", "30000", "--quiet", "-o", "sites.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        commands = [["delaunay", "sites.csv", "-o", "out.geojson"],
                    ["voronoi", "sites.csv", "-o", "out.npz"],
                    ["plot", "sites.csv", "-o", "out.png"],
                    ["nearest", "sites.csv", "sites.csv", "-o", "out.csv"]]
        for command in commands:
            seen = set()
            for megabytes in range(16, 160, 8):
                size = megabytes << 20
                done = self.run_tool(
                    *command, "--quiet", "--threads", "2",
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)))
                if "while loading shared libraries" in done.stderr:
                    continue  # nothing of the tool has run
                seen.add(done.returncode)
                with self.subTest(command=command[0], megabytes=megabytes):
                    if done.returncode == 0:
                        self.assertEqual(done.stderr, "")
                        break
                    self.assertEqual(done.returncode, 1, done.stderr)
                    self.assertRegex(done.stderr, r"\Arondel: (not enough memory|"
                                     r".*: Cannot allocate memory|pthread_create has failed.*)\n\Z")
                    self.assertEqual(os.listdir(self.folder), ["sites.csv"])
            for made in self.folder.glob("out.*"):
                made.unlink()
            self.assertEqual(seen, {0, 1}, "no limit was tight, or none was wide enough")


if __name__ == "__main__":
    unittest.main()
