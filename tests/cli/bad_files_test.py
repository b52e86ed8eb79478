#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Every bad file of the corpus, through the tool: status 1, the recorded line that names file, line
and value, no output. The transcripts do the same for bad command lines; both sets are counted."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
CORPUS = HERE.parent / "corpus" / "io"
TOOL = pathlib.Path(sys.argv.pop(1)).resolve()


def messages(folder):
    """What is said of each bad file, by its name."""
    lines = (CORPUS / folder / "expected.txt").read_text(encoding="utf-8").splitlines()
    return {line.partition(":")[0]: line for line in lines}


class BadFiles(unittest.TestCase):
    def assert_refused(self, folder, name, line, *command):
        path = CORPUS / folder / name
        with tempfile.TemporaryDirectory() as empty, self.subTest(file=name):
            done = subprocess.run([TOOL, *command, path], cwd=empty, capture_output=True,
                                  timeout=60, check=False)
            expected = f"rondel: {path.parent}/{line}\n"
            self.assertEqual((done.returncode, done.stdout, done.stderr.decode()),
                             (1, b"", expected))
            self.assertEqual(os.listdir(empty), [])

    def test_sites(self):
        for name, line in messages("bad").items():
            self.assert_refused("bad", name, line, "voronoi", "-o", "cells.geojson")

    def test_triangles(self):
        for name, line in messages("bad_triangles").items():
            self.assert_refused("bad_triangles", name, line, "check",
                                HERE / "inputs" / "octahedron.xyz")

    def test_there_are_many(self):
        files = len(messages("bad")) + len(messages("bad_triangles"))
        failures = sum(len(re.findall(r"^\[\d+\]$", path.read_text(encoding="utf-8"), re.MULTILINE))
                       for path in (HERE / "golden").glob("*.txt"))
        self.assertGreaterEqual(files, 60)
        self.assertGreaterEqual(failures, 60)


if __name__ == "__main__":
    unittest.main()
