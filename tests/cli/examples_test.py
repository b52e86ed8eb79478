#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Types every example of every help page, and every command of the tool in a document's shell blocks, as it stands.

    examples_test.py TOOL SOURCE_FOLDER

The examples of one page run one after the other in one folder. A file that an example reads and no example before it
has written is made by example_files.py; an example that names any other file fails.
"""

import importlib.util
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import example_files  # noqa: E402 (after the line above)

TOOL = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(sys.argv[2]).resolve()
del sys.argv[1:3]
ENVIRONMENT = dict(os.environ, LC_ALL="C.UTF-8", PATH=f"{TOOL.parent}:{os.environ['PATH']}")
# GDAL's library is in a wheel of the environment that scripts/install python makes.
WHEEL = importlib.util.find_spec("pyogrio")
if WHEEL is not None:
    LIBRARIES = sorted(pathlib.Path(WHEEL.origin).parents[1].glob("pyogrio.libs/libgdal*"))
    ENVIRONMENT.update({"RONDEL_GDAL": str(library) for library in LIBRARIES[:1]})
OUTPUTS = {"-o", "--output", "--report", "--graph", "--cell-map", "--weights"}
# Files of one name that only one example can mean.
BEFORE = {
    "rondel apply weights.nc temperature.nc": "rondel remap temperature.nc grid:10 -o weights.nc",
    "rondel apply weights.nc stations.csv": "rondel interpolate stations.csv --to grid:10 --weights weights.nc",
    "rondel check-weights weights.nc": "rondel remap ocean.nc grid:10 -o weights.nc",
    "rondel check stations.csv faces.npy": "rondel delaunay stations.csv -o faces.npy",
}


def run(line, folder):
    return subprocess.run(["/bin/sh", "-c", line], cwd=folder, env=ENVIRONMENT, text=True, capture_output=True,
                          timeout=300, check=False)


def help_of(command):
    return run(" ".join(["rondel", *command, "--help"]), ROOT).stdout


def listed(text):
    """The part of a help page that lists commands."""
    found = re.search(r"(?ms)^Commands.*?(?=^'rondel )", text)
    return found[0] if found else ""


def commands(command=()):
    """All commands that the help pages name, from the tool itself on."""
    yield command
    for name in re.findall(r"(?m)^  ([a-z-]+) ", listed(help_of(command))):
        yield from commands((*command, name))


def examples(text):
    """The lines below "Example:", "Examples:" or "A first try:", a line that ends in a backslash with the next one."""
    found = re.search(r"(?m)^(?:Examples?|A first try):\n((?:  .*\n?)+)", text)
    return [] if found is None else re.findall(r"(?m)^  (rondel .*)$", found[1].replace("\\\n", " "))


def documented(path):
    """The lines of a document's shell blocks that call the tool."""
    blocks = re.findall(r"(?ms)^```sh\n(.*?)^```$", path.read_text(encoding="utf-8"))
    lines = "".join(blocks).replace("\\\n", " ").splitlines()
    return [re.sub(r"\s+#.*", "", line) for line in lines if line.startswith("rondel ")]


class Examples(unittest.TestCase):
    def type_all(self, lines):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "data").symlink_to(ROOT / "data")
            for line in lines:
                with self.subTest(example=line):
                    self.type_one(line, folder)

    def type_one(self, line, folder):
        for begin, command in BEFORE.items():
            if line.startswith(begin):
                self.type_one(command, folder)
        words = shlex.split(line)
        written = {word for option, word in zip(words, words[1:]) if option in OUTPUTS}
        for file, make in example_files.makers(ROOT).items():
            is_read = any(word.partition(":")[0] == file and word not in written for word in words)
            if is_read and not (folder / file).exists():
                make(folder / file)
        if "RONDEL_GDAL" not in ENVIRONMENT and any(file.endswith(".gpkg") for file in written):
            self.skipTest("GDAL is not there")
        done = run(line, folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for file in written - {"-"}:
            self.assertTrue((folder / file).exists(), file)

    def test_every_example_of_the_help_does_what_it_says(self):
        os.environ["PATH"] = ENVIRONMENT["PATH"]  # makers of files call the tool
        count = 0
        for command in commands():
            lines = examples(help_of(command))
            if command not in [(), ("mesh",)]:
                self.assertTrue(lines, f"the help of {' '.join(command)} has no example")
            count += len(lines)
            self.type_all(lines)
        self.assertGreater(count, 50)

    def test_every_command_of_a_document_does_what_it_says(self):
        os.environ["PATH"] = ENVIRONMENT["PATH"]
        count = 0
        for path in [ROOT / "README.md", *sorted((ROOT / "docs" / "guide").glob("*.md"))]:
            lines = documented(path)
            count += len(lines)
            self.type_all(lines)
        self.assertGreater(count, 30)


if __name__ == "__main__":
    unittest.main()
