# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The errors of tests/mutants can be put into the code: each quoted line stands there once, and random changes are changes."""

import pathlib
import random
import sys
import tomllib
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests" / "mutants"))
import random_changes  # noqa: E402 (after the line above)

SOURCE = """#include <a < b>
// 1 < 2 in a comment
std::vector<int> f(const std::array<int, 3>& a) {  // and 5 here
  if (!g(a) && x < 3.5) return "7 < 8";
}
"""


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

    def test_random_changes_leave_comments_texts_and_brackets_of_templates_alone(self):
        changed = {(SOURCE[begin:end], line) for line, begin, end, _ in random_changes.changes(SOURCE, random.Random(1))}
        self.assertEqual(changed, {("3", 3), ("!", 4), ("&&", 4), ("<", 4), ("3.5", 4)})

    def test_random_changes_depend_on_the_seed_alone(self):
        files = {str(path): path.read_text(encoding="utf-8") for path in (ROOT / "src/map").glob("*.cpp")}
        first = random_changes.drawn(files, 1)
        self.assertEqual(first, random_changes.drawn(dict(reversed(files.items())), 1))
        self.assertNotEqual(first, random_changes.drawn(files, 2))
        self.assertEqual(len({(file, begin) for file, _, begin, _, _ in first}), len(first))

    def test_layers_of_random_changes_are_layers(self):
        with open(ROOT / "tests/mutants/layers.toml", "rb") as file:
            layers = tomllib.load(file)
        self.assertLessEqual(set(layers), set((ROOT / "src/LAYERS").read_text(encoding="utf-8").split()))


if __name__ == "__main__":
    unittest.main()
