#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Groups of Zarr arrays: what is in them, in memory and out of core, and runs that are cut short."""

import filecmp
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
SIZES = {"uint32": 4, "int64": 8, "float64": 8}
ALL = ["--neighbors", "mesh.zarr", "--areas", "mesh.zarr", "--duplicates", "mesh.zarr"]
OUT_OF_CORE = ["--scratch", "work", "--memory", "100M"]


def content_of(npy):
    """The numbers of a .npy file, as bytes."""
    whole = npy.read_bytes()
    return whole[10 + int.from_bytes(whole[8:10], "little"):]


def array_of(folder):
    """The numbers of a Zarr array, as bytes: its chunks, less the rows beyond its shape."""
    head = json.loads((folder / "zarr.json").read_text(encoding="utf-8"))
    shape, chunk = head["shape"], head["chunk_grid"]["configuration"]["chunk_shape"]
    row = SIZES[head["data_type"]] * (shape[1] if len(shape) == 2 else 1)
    numbers = b""
    for i in range(-(-shape[0] // chunk[0])):
        numbers += (folder / f"c.{i}{'.0' * (len(shape) - 1)}").read_bytes()
    return numbers[:shape[0] * row]


class Zarr(unittest.TestCase):
    def setUp(self):
        signal.signal(signal.SIGHUP, signal.SIG_DFL)  # programs would inherit what nohup ignores
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def run_tool(self, *arguments, **options):
        return subprocess.run([TOOL, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              check=False, **options)

    def succeed(self, *arguments):
        done = self.run_tool(*arguments, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def names(self):
        return sorted(os.listdir(self.folder))

    def test_has_what_files_have(self):
        self.succeed("generate", "grid", "-n", "30000", "-o", "sites.npy")
        self.succeed("delaunay", "sites.npy", "-o", "faces.npy", "--neighbors", "neighbors.npy", "--areas",
                     "areas.npy", "--duplicates", "duplicates.npy")
        for options in ([], OUT_OF_CORE):
            self.succeed("delaunay", "sites.npy", "-o", "mesh.zarr", *ALL, *options)
            for name in ("faces", "neighbors", "areas", "duplicates"):
                expected = content_of(self.folder / f"{name}.npy")
                self.assertEqual(array_of(self.folder / "mesh.zarr" / name), expected, name)

    def test_arrays_may_be_files(self):
        self.succeed("generate", "uniform", "-n", "1000", "-o", "sites.npy")
        for options in ([], OUT_OF_CORE):
            self.succeed("delaunay", "sites.npy", "-o", "mesh.zarr", "--areas", "areas.npy", *options)
            self.assertEqual(self.names(), ["areas.npy", "mesh.zarr", "sites.npy"])
            self.assertFalse((self.folder / "mesh.zarr" / "areas").exists())

    def test_names_that_make_no_group(self):
        self.succeed("generate", "uniform", "-n", "100", "-o", "sites.npy")
        for options, error in (
                (["-o", "-", "--format", "zarr"], "--output: .zarr is written into a folder, which standard output is not"),
                (["-o", "mesh.zarr", "--areas", "a.zarr"],
                 "--areas: 'a.zarr' is a Zarr group; it must be that of --output, or a .npy file"),
                (["-o", "mesh", "--format", "zarr", "--scratch", "work"],
                 "--output: with --scratch 'mesh' must be a .npy file or a .zarr group")):
            done = self.run_tool("delaunay", "sites.npy", *options)
            self.assertEqual((done.returncode, done.stderr), (2, f"rondel: {error}\n"))
        done = self.run_tool("delaunay", "sites.npy", "-o", "mesh.zarr", "--areas", "a.zarr", *OUT_OF_CORE)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "rondel: a.zarr: a Zarr group, but not that of the faces\n"))
        self.assertEqual(self.names(), ["sites.npy"])

    def test_what_is_not_ours_stays(self):
        self.succeed("generate", "uniform", "-n", "100", "-o", "sites.npy")
        self.succeed("delaunay", "sites.npy", "-o", "mesh.zarr")
        (self.folder / "mesh.zarr" / "temperature").mkdir()
        for options in ([], OUT_OF_CORE):
            done = self.run_tool("delaunay", "sites.npy", "-o", "mesh.zarr", *options)
            self.assertEqual((done.returncode, done.stderr),
                             (1, "rondel: mesh.zarr: 'temperature' in it is not ours; the folder is not replaced\n"))
            self.assertEqual(self.names(), ["mesh.zarr", "sites.npy"])
        self.assertTrue((self.folder / "mesh.zarr" / "temperature").exists())

    def test_signals_leave_the_older_group(self):
        self.succeed("generate", "uniform", "-n", "400000", "-o", "sites.npy")
        self.succeed("generate", "uniform", "-n", "100", "-o", "few.npy")
        self.succeed("delaunay", "few.npy", "-o", "mesh.zarr")
        shutil.copytree(self.folder / "mesh.zarr", self.folder / "copy")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            command = [TOOL, "delaunay", "sites.npy", "-o", "mesh.zarr", *ALL, *OUT_OF_CORE]
            with subprocess.Popen(command, cwd=self.folder, stderr=subprocess.DEVNULL) as process:
                while process.poll() is None and not list(self.folder.glob(".rondel-*.tmp/faces/c.0.0")):
                    time.sleep(0.001)
                process.send_signal(number)
            self.assertEqual(process.returncode, -number)
            self.assertEqual(self.names(), ["copy", "few.npy", "mesh.zarr", "sites.npy", "work"])
            compared = filecmp.dircmp(self.folder / "mesh.zarr", self.folder / "copy")
            self.assertEqual(compared.left_only + compared.right_only + compared.diff_files, [])
            shutil.rmtree(self.folder / "work")

    def test_a_full_file_system_is_told_and_left_clean(self):
        if os.geteuid() != 0 or shutil.which("mount") is None:
            self.skipTest("needs the right to mount")
        self.succeed("generate", "uniform", "-n", "20000", "-o", "sites.npy")
        small = self.folder / "small"
        small.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "none", small], capture_output=True,
                                 check=False)
        if mounted.returncode != 0:
            self.skipTest("mounting is not allowed here")
        try:
            for options in ([], OUT_OF_CORE):
                done = self.run_tool("delaunay", "sites.npy", "-o", "small/mesh.zarr", *options)
                self.assertEqual((done.returncode, done.stderr),
                                 (1, "rondel: small/mesh.zarr: No space left on device\n"))
                self.assertEqual(os.listdir(small), [])
        finally:
            subprocess.run(["umount", small], check=True)
        self.assertEqual(self.names(), ["sites.npy", "small"])


if __name__ == "__main__":
    unittest.main()
