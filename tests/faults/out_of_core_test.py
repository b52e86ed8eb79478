#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Runs out of core that are killed, or for which the disk is too small: one line, no result, and another run goes on."""

import filecmp
import json
import math
import os
import pathlib
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
IS_SANITIZED = any(name in TOOL.read_bytes() for name in (b"__asan_init", b"__tsan_init"))
NUM_SITES = 40_000 if IS_SANITIZED else 1_500_000
MEMORY = 128 << 20


def limit_files(size):
    """No file may be longer; a write beyond is an error and not a signal."""

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return limit


class OutOfCore(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name).resolve()
        cls.run_tool("generate", "uniform", "-n", str(NUM_SITES), "-o", "sites.npy")
        start = time.monotonic()
        cls.run_tool("delaunay", "sites.npy", "-o", "expected.npy", "--neighbors", "expected_neighbors.npy")
        cls.seconds = time.monotonic() - start

    @classmethod
    def run_tool(cls, *arguments, **options):
        """Runs the tool in the folder."""
        return subprocess.run([TOOL, *arguments], cwd=cls.folder, capture_output=True, text=True, timeout=300,
                              check=False, **options)

    def setUp(self):
        self.command = ["delaunay", "sites.npy", "-o", "faces.npy", "--neighbors", "neighbors.npy",
                        "--memory", str(MEMORY), "--scratch", "scratch"]
        self.addCleanup(self.remove_all)

    def write_at(self, place, some):
        """Into the file of the sites."""
        with open(self.folder / "sites.npy", "r+b") as file:
            file.seek(place)
            file.write(some)

    def remove_all(self):
        """What a run leaves."""
        for name in ("faces.npy", "neighbors.npy"):
            (self.folder / name).unlink(missing_ok=True)
        shutil.rmtree(self.folder / "scratch", ignore_errors=True)

    def end_after(self, seconds, end):
        """Ends a run after this time; returns whether it came to its end before."""
        with subprocess.Popen([TOOL, *self.command, "--quiet"], cwd=self.folder) as process:
            time.sleep(seconds)
            end(process)
        return (self.folder / "faces.npy").exists()  # the last one that gets its name

    def expect_no_result(self):
        self.assertEqual(sorted(path.name for path in self.folder.glob("*.npy")),
                         ["expected.npy", "expected_neighbors.npy", "sites.npy"])

    def expect_result(self, *options):
        """Equal bytes, no scratch directory, and no more memory than was promised."""
        done = self.run_tool(*self.command, "--json", *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name in ("faces.npy", "neighbors.npy"):
            expected = self.folder / ("expected.npy" if name == "faces.npy" else "expected_" + name)
            self.assertTrue(filecmp.cmp(self.folder / name, expected, shallow=False), name)
            (self.folder / name).unlink()
        self.assertFalse((self.folder / "scratch").exists())
        report = json.loads(done.stdout)
        if not IS_SANITIZED:
            self.assertLess(report["peak_memory_bytes"], MEMORY)
        return report

    def test_killed_at_any_time(self):
        """Until one comes to its end before it would be killed, a little later each time. A machine with other work may
        be slower at one time than at another, so that no run had begun or all had ended: then once more.
        """
        num_resumed = [0]
        for attempt in range(1, 6):
            delay = self.seconds / 8 / attempt
            while not self.end_after(delay, subprocess.Popen.kill):
                num_resumed.append(self.expect_result("--resume")["resumed_buckets"])
                delay *= 1.25
            self.remove_all()
            if IS_SANITIZED or max(num_resumed) > 0:
                return
        self.fail("no run that was killed had anything to resume")

    def test_killed_by_a_signal_that_is_handled(self):
        """No temporary file is left beside the scratch directory."""
        if self.end_after(self.seconds / 2, subprocess.Popen.terminate):
            return
        left = {path.name for path in self.folder.iterdir()} - {"scratch"}
        self.assertEqual(left - {"neighbors.npy"}, {"expected.npy", "expected_neighbors.npy", "sites.npy"})
        self.expect_result("--resume")

    def test_no_room(self):
        """What is needed is asked for before work begins, and the last files grow without much notice."""
        for size in (1000, 12 * NUM_SITES, 25 * NUM_SITES, 40 * NUM_SITES):
            with self.subTest(size=size):
                done = self.run_tool(*self.command, preexec_fn=limit_files(size))
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assertRegex(done.stderr, r"^rondel: [^\n]*: File too large\n$")
                self.expect_no_result()
                self.expect_result("--resume")

    def test_no_room_is_known_before_the_sites_are_read(self):
        """The last one of which is no number."""
        with open(self.folder / "sites.npy", "r+b", buffering=0) as file:  # what Python reads, children count as theirs
            place = file.seek(-8, os.SEEK_END)
            last = file.read(8)
            self.addCleanup(self.write_at, place, last)
        self.write_at(place, struct.pack("<d", math.nan))
        done = self.run_tool(*self.command)
        self.assertRegex(done.stderr, f"^rondel: sites.npy: row {NUM_SITES - 1}: [^\n]*\n$")
        for size, name in ((30, "sites"), (40, "faces")):  # bytes of a site
            done = self.run_tool(*self.command, preexec_fn=limit_files(size * NUM_SITES))
            self.assertEqual((done.returncode, done.stderr), (1, f"rondel: scratch/{name}: File too large\n"))
            self.assertFalse((self.folder / "scratch").exists())

    @unittest.skipIf(IS_SANITIZED, "takes memory of its own")
    def test_sites_on_a_curve(self):
        """All of them are open. What is said to be enough is enough, and a run that ends for it keeps its promise, too."""
        sites = self.folder / "curve.npy"
        self.addCleanup(sites.unlink)
        self.run_tool("generate", "great-circle", "-n", "1000000", "-o", sites)
        command = [TOOL, "delaunay", sites, "-o", "faces.npy", "--areas", "neighbors.npy", "--scratch", "scratch", "--quiet"]
        said = self.expect_memory(96, command)
        enough = int(re.search(r"reach beyond every bucket; to join them (\d+) MB of memory are needed", said)[1])
        self.assertEqual(self.expect_memory(enough, [*command, "--resume"]), "")
        self.assertTrue((self.folder / "faces.npy").exists())

    def expect_memory(self, megabytes, command):
        """What a run says that has no more than so much in memory."""
        with subprocess.Popen([*command, "--memory", f"{megabytes}M"], cwd=self.folder, stderr=subprocess.PIPE,
                              text=True) as run:
            said = run.stderr.read()
            _, status, usage = os.wait4(run.pid, 0)
            run.returncode = os.waitstatus_to_exitcode(status)
        self.assertLess(usage.ru_maxrss, megabytes << 10)
        return said

    def test_cut_scratch_files(self):
        """They are found, and what they had is done again."""
        for name in ("sites", "faces", "borders", "journal"):
            with self.subTest(name=name):
                if self.end_after(0.7 * self.seconds, subprocess.Popen.kill):
                    self.remove_all()
                    continue
                path = self.folder / "scratch" / name
                if path.exists():
                    with open(path, "r+b") as file:
                        file.truncate(path.stat().st_size // 2)
                self.expect_result("--resume")

    def test_files_of_others_in_the_scratch_directory(self):
        """Nothing of theirs is written over or removed."""
        scratch = self.folder / "scratch"
        for name in ("sites", "faces", "borders", "areas", "journal"):
            with self.subTest(name=name):
                scratch.mkdir()
                (scratch / name).write_text("something precious, and longer than a mark")
                done = self.run_tool(*self.command)
                self.assertEqual((done.returncode, done.stderr), (1, f"rondel: scratch/{name}: not of a run; the "
                                                                     "scratch directory must be one of its own\n"))
                self.assertEqual((scratch / name).read_text(), "something precious, and longer than a mark")
                shutil.rmtree(scratch)
        for results, name in ((["-o", "scratch/faces"], "faces"),
                              (["-o", "faces.npy", "--areas", "scratch/../scratch/areas"], "../scratch/areas")):
            scratch.mkdir()
            done = self.run_tool("delaunay", "sites.npy", *results, "--format", "npy", "--scratch", "scratch")
            self.assertEqual((done.returncode, done.stderr),
                             (1, f"rondel: scratch/{name}: a file of the scratch directory, too\n"))
            self.assertEqual(list(scratch.iterdir()), [])
            scratch.rmdir()

    def test_two_runs_at_once(self):
        """One of them comes to its end, or both do so one after the other."""
        runs = [subprocess.Popen([TOOL, *self.command, "--quiet"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
                for _ in range(2)]
        said = [run.communicate()[1] for run in runs]
        self.assertIn(0, [run.returncode for run in runs], said)
        self.assertTrue(filecmp.cmp(self.folder / "faces.npy", self.folder / "expected.npy", shallow=False))

    def test_arguments(self):
        """What does not go together is said before work begins."""
        for arguments, message in (
            (["--memory", "2G"], "--memory requires --scratch"),
            (["--resume"], "--resume requires --scratch"),
            (["--scratch", ""], "--scratch: no name"),
            *((["--scratch", "scratch", "--memory", text], f"'{text}' is not a number of bytes, as 2G or 500M")
              for text in ("2X", "2GB", "1.5", "1.5.1G", "G", "0", "17e9", "16777216T", "16777216.1T", "0.0001K")),
        ):
            with self.subTest(arguments=arguments):
                done = self.run_tool("delaunay", "sites.npy", "-o", "faces.npy", *arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)
        done = self.run_tool("delaunay", "sites.npy", "-o", "faces.ply", "--scratch", "scratch")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "rondel: --output: with --scratch 'faces.ply' must be a .npy file\n"))
        for memory in ("1M", "1m", "1024k", "1048576", "1.5M", "0.0015g", "0.0000015T"):
            found = 2 if "." in memory else 1
            done = self.run_tool("delaunay", "sites.npy", "-o", "faces.npy", "--scratch", "scratch", "--memory", memory)
            self.assertEqual((done.returncode, done.stderr),
                             (1, f"rondel: {found} MB of memory are less than the 96 MB that are needed at least\n"))


if __name__ == "__main__":
    unittest.main()
