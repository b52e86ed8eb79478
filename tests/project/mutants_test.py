# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The errors of tests/mutants/mutants.toml can be put into the code: each quotes a line that is there once."""

import pathlib
import tomllib
import unittest

ROOT = pathlib.Path(__file__).parents[2]


class Mutants(unittest.TestCase):
    def test_each_quotes_a_text_that_its_file_has_once(self):
        with open(ROOT / "tests/mutants/mutants.toml", "rb") as file:
            mutants = tomllib.load(file)["mutant"]
        self.assertGreater(len(mutants), 50)
        for mutant in mutants:
            with self.subTest(mutant=mutant["name"]):
                text = (ROOT / mutant["file"]).read_text(encoding="utf-8")
                self.assertEqual(text.count(mutant["old"]), 1)
                self.assertNotEqual(mutant["old"], mutant["new"])


if __name__ == "__main__":
    unittest.main()
