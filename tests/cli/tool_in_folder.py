# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Tests that run the tool in a folder of their own and look at its remarks."""

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

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_tool(self, *arguments, status=0):
        """The lines of standard error, without the name of the tool."""
        done = subprocess.run([TOOL, *arguments], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return [line.removeprefix("rondel: ") for line in done.stderr.splitlines()]
