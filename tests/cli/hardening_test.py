#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The tool is built so that a mistake in it is hard to make use of."""

import re
import subprocess
import sys
import unittest

TOOL = sys.argv.pop(1)


def readelf(*options):
    """What binutils tell of the tool."""
    return subprocess.run(["readelf", "--wide", *options, TOOL], check=True, capture_output=True,
                          text=True).stdout


class Hardening(unittest.TestCase):
    def test_lies_at_a_random_address(self):
        self.assertRegex(readelf("--file-header"), r"Type:\s+DYN \(Position-Independent")

    def test_tables_of_addresses_are_read_only(self):
        self.assertIn("GNU_RELRO", readelf("--program-headers"))
        self.assertRegex(readelf("--dynamic"), r"BIND_NOW|FLAGS.*NOW")

    def test_the_stack_is_not_executable(self):
        stack = re.search(r"GNU_STACK.*", readelf("--program-headers")).group()
        self.assertRegex(stack, r" RW +0x")

    def test_frames_are_guarded_and_calls_checked(self):
        symbols = readelf("--dyn-syms")
        self.assertIn("__stack_chk_fail", symbols)
        self.assertIn("_chk@", symbols.replace("__stack_chk_fail@", ""))


if __name__ == "__main__":
    unittest.main()
