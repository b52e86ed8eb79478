# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The two files of scripts/amalgamate are small, and other compilers that are there take them without a warning; without
exceptions, or with -ffast-math, each refuses them in one clear line. The script takes no option for a folder.

    compilers_test.py FOLDER COMPILER
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "amalgamate"
FOLDER = pathlib.Path(sys.argv.pop(1))
SOURCE = FOLDER / "rondel_all.cpp"
COMPILER = sys.argv.pop(1)
# The test says which of these it has found; what COMPILER says of the file, the build has told.
OTHERS = list(filter(shutil.which, ("clang++-14", "x86_64-w64-mingw32-g++-posix", "x86_64-w64-mingw32-g++-win32")))


def compile_source(compiler, *options):
    return subprocess.run([compiler, "-std=c++20", "-Wall", "-Wextra", "-Werror", *options, SOURCE],
                          capture_output=True, text=True, check=False)


class Amalgamation(unittest.TestCase):
    def test_is_smaller_than_a_megabyte(self):
        self.assertLess(sum(path.stat().st_size for path in FOLDER.iterdir()), 1_000_000)

    def test_includes_only_the_standard_library_and_itself(self):
        quoted = re.findall(r'#include "(.*)"', (FOLDER / "rondel_all.h").read_text() + SOURCE.read_text())
        self.assertEqual(quoted, ["rondel_all.h"])
        self.assertNotIn("boost", SOURCE.read_text().lower())

    def test_compiles_without_a_warning(self):
        for compiler in OTHERS:
            with self.subTest(compiler=compiler):
                done = compile_source(compiler, "-fsyntax-only")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
        print("compiled by", *OTHERS)

    def test_compiles_with_threads_of_the_standard_library(self):
        done = compile_source(COMPILER, "-fsyntax-only", "-DRONDEL_HAS_THREADS")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def expect_refusal(self, option, message):
        for compiler in [COMPILER, *OTHERS]:
            with self.subTest(compiler=compiler):
                done = compile_source(compiler, "-E", "-o", "/dev/null", option)
                self.assertNotEqual(done.returncode, 0)
                self.assertRegex(done.stderr, message)

    def test_is_refused_without_exceptions(self):
        self.expect_refusal("-fno-exceptions", r"error.*Rondel needs C\+\+ exceptions")

    def test_is_refused_with_fast_math(self):
        self.expect_refusal("-ffast-math", "error.*Rondel does not compile with -ffast-math")


class Script(unittest.TestCase):
    """What the script does with words that are no folder."""

    def run_script(self, *words):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([SCRIPT, *words], cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])
            return done

    def test_helps(self):
        for option in ("--help", "-h"):
            done = self.run_script(option)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("rondel_all.h", done.stdout)

    def test_refuses_unknown_options(self):
        for words in (["--hlep"], ["-x"], ["one", "two"]):
            done = self.run_script(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("unrecognized arguments", done.stderr)


if __name__ == "__main__":
    unittest.main()
