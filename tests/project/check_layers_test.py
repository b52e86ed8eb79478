# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The layer check finds each kind of violation in a small tree, and nothing in a clean one."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKER = pathlib.Path(__file__).parents[2] / "scripts" / "tools" / "check_layers"

CLEAN = {
    "src/LAYERS": "low\nhigh\n",
    "src/low/a.h": "#include <vector>\n",
    "src/high/b.cpp": '#include "low/a.h"\n#include "high/b.h"\n#include "rondel/r.h"\n#include <zlib.h>\n',
    "include/rondel/r.h": '#include <span>\n#include "rondel/other.h"\n',
    "cli/main.cpp": '#include <CLI/CLI.hpp>\n#include "rondel/r.h"\n#include "options.h"\n',
}


class CheckLayers(unittest.TestCase):
    def run_on(self, changes):
        """Exit status and output of the check on the clean tree with some files replaced."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**CLEAN, **changes}.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            done = subprocess.run(
                [sys.executable, CHECKER, folder], capture_output=True, text=True, check=False
            )
        return done.returncode, done.stdout

    def expect(self, changes, message):
        self.assertEqual(self.run_on(changes), (1, message + "\n"))

    def test_accepts_a_clean_tree(self):
        self.assertEqual(self.run_on({})[0], 0)

    def test_refuses_a_higher_layer(self):
        self.expect(
            {"src/low/a.h": '#include <vector>\n  #  include "high/b.h"\n'},
            'src/low/a.h:2: layer low includes "high/b.h" of the higher layer high',
        )

    def test_refuses_a_higher_layer_in_angle_brackets(self):
        self.expect(
            {"src/low/a.h": "#include <high/b.h>\n"},
            'src/low/a.h:1: layer low includes "high/b.h" of the higher layer high',
        )

    def test_refuses_an_include_without_folder(self):
        self.expect(
            {"src/low/a.h": '#include "c.h"\n'}, 'src/low/a.h:1: "c.h" does not name its folder'
        )

    def test_refuses_what_is_no_layer(self):
        self.expect(
            {"src/low/a.h": '#include "cli/main.h"\n'},
            'src/low/a.h:1: "cli/main.h" is neither a layer nor a public header',
        )

    def test_refuses_a_private_include_in_a_public_header(self):
        self.expect(
            {"include/rondel/r.h": '#include "low/a.h"\n'},
            'include/rondel/r.h:1: public header includes the private "low/a.h"',
        )

    def test_refuses_a_third_party_in_a_public_header(self):
        self.expect(
            {"include/rondel/r.h": "#include <boost/version.hpp>\n"},
            "include/rondel/r.h:1: public header includes the third-party <boost/version.hpp>",
        )

    def test_refuses_a_tool_that_reaches_inside(self):
        self.expect(
            {"cli/main.cpp": '#include "low/a.h"\n'},
            'cli/main.cpp:1: a user of the library includes the private "low/a.h"',
        )

    def test_refuses_a_folder_that_is_no_layer(self):
        self.expect({"src/new/n.h": ""}, "src/new: not listed in src/LAYERS")

    def test_refuses_a_layer_without_folder(self):
        self.expect(
            {"src/LAYERS": "low\nhigh\ntop\n"}, "src/LAYERS: layer top has no folder"
        )

    def test_refuses_a_file_outside_the_layers(self):
        self.expect({"src/stray.cpp": ""}, "src/stray.cpp: lies in no layer")


if __name__ == "__main__":
    unittest.main()
