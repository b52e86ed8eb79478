# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Tests that run the tool in a folder of their own and look at what it says."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

# The first argument of the program.
TOOL = pathlib.Path(sys.argv.pop(1)).resolve()


def add(file, name, dimensions, values, kind="f8", **attributes):
    """Adds a variable to a file of netCDF4."""
    variable = file.createVariable(name, kind, dimensions)
    variable.setncatts(attributes)
    variable[...] = values
    return variable


class ToolInFolder(unittest.TestCase):
    """`folder` is empty at the beginning of each test, and gone behind it."""

    environment = None  # that of the tool; None: that of the test

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def tool(self, *arguments, text=True, **options):
        """The process of the tool, which has ended; the options are those of `subprocess.run`."""
        options = {"env": self.environment, **options}
        return subprocess.run([TOOL, *arguments], cwd=self.folder, capture_output=True, text=text, check=False, **options)

    def finished(self, *arguments, status=0):
        """The same; the test fails if it ends with another status."""
        done = self.tool(*arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def said(self, *arguments, status=0):
        """What the tool says, on both outputs."""
        done = self.finished(*arguments, status=status)
        return done.stdout + done.stderr

    def run_tool(self, *arguments, status=0):
        """The lines of standard error, without the name of the tool."""
        done = self.finished(*arguments, status=status)
        return [line.removeprefix("rondel: ") for line in done.stderr.splitlines()]
