#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The manual pages have every command and option that the help pages name, and groff reads them without a warning.

    manual_test.py TOOL MAKE_CLI_REFERENCE
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

MAKER = pathlib.Path(sys.argv.pop(2)).resolve()
TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
WITH_DASHES = {"check-weights": ["check-weights"], "mesh-equal-area": ["mesh", "equal-area"]}


def run(*words):
    return subprocess.run(words, text=True, capture_output=True, check=True)


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        run(sys.executable, MAKER, "--man", cls.temporary.name, TOOL)
        cls.pages = sorted(pathlib.Path(cls.temporary.name).iterdir())

    def test_every_command_has_a_page(self):
        names = {page.name for page in self.pages}
        self.assertLessEqual({"rondel.1", "rondel-delaunay.1", "rondel-mesh.1", "rondel-mesh-scvt.1"}, names)
        for page in self.pages:  # each names the pages below it
            for other in re.findall(r"\\fB(rondel[\w\\-]*)\\fR\(1\)", page.read_text(encoding="utf-8")):
                self.assertIn(other.replace("\\", "") + ".1", names)

    def test_every_option_is_on_its_page(self):
        for page in self.pages:
            name = page.stem.removeprefix("rondel").removeprefix("-")
            words = WITH_DASHES.get(name) or name.split("-") if name else []
            text = page.read_text(encoding="utf-8").replace("\\-", "-")
            options = re.findall(r"^  (-[^ ]+)", run(TOOL, *words, "--help").stdout, re.M)
            self.assertGreater(len(options), 0, page.name)
            for option in options:
                self.assertRegex(text, rf"(?m)^\.TP\n\.B {re.escape(option)}( [^ ].*)?$", page.name)

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_groff_has_no_warning(self):
        for page in self.pages:
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", page], text=True, capture_output=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name)


if __name__ == "__main__":
    unittest.main()
