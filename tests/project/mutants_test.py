# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The errors of tests/mutants can be put into the code: each quoted line stands there once, and random changes are changes."""

import os
import pathlib
import random
import subprocess
import sys
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests" / "mutants"))
import random_changes  # noqa: E402 (after the line above)

try:
    import switches  # which wants scripts/tools/packages/mutants.txt
except ImportError:
    switches = None

SOURCE = """#include <a < b>
// 1 < 2 in a comment
std::vector<int> f(const std::array<int, 3>& a) {  // and 5 here
  if (!g(a) && x < 3.5) return "7 < 8";
  std::size_t count = 4;
  ask(a, &count);
  int left = 6;
  take(left, &left);
}
"""

SWITCHED = """// A file's first line
#include <algorithm>
#include <compare>
#include <cstdio>
constexpr int few = 3;
struct Pair {
  static constexpr double half = 0.5;
  int a, b;
  auto operator<=>(const Pair& o) const { return a + b <=> o.a + o.b; }
};
template <class T>
constexpr int f(T x, T y) {
  int sum = 0;
  for (int i = 0; i < 5; ++i) {
    if (i == few) break;
    if (!(x < y) || (x < y &&  // in the middle of an expression
                     i > 1))
      sum += std::min(i + 2, 3);
  }
  return sum;
}
int main() { std::printf("%d %g\\n", f(1, 2) + 10 * f(Pair{3, 1}, Pair{1, 2}), Pair::half); }
"""


class Mutants(unittest.TestCase):
    def test_each_quotes_a_text_that_its_file_has_once(self):
        with open(ROOT / "tests/mutants/mutants.toml", "rb") as file:
            mutants = tomllib.load(file)["mutant"]
        self.assertIn(len(mutants), range(40, 61))
        for mutant in mutants:
            with self.subTest(mutant=mutant["name"]):
                text = (ROOT / mutant["file"]).read_text(encoding="utf-8")
                self.assertEqual(text.count(mutant["old"]), 1)
                self.assertNotEqual(mutant["old"], mutant["new"])

    def test_random_changes_leave_what_changes_nothing_alone(self):
        changed = {(SOURCE[begin:end], line) for line, begin, end, _ in random_changes.changes(SOURCE, random.Random(1))}
        self.assertEqual(changed, {("3", 3), ("!", 4), ("&&", 4), ("<", 4), ("3.5", 4), ("6", 7)})

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

    @unittest.skipIf(switches is None, "libclang is not installed")
    def test_switches_change_what_a_program_of_its_own_changes(self):
        changes = {number: (begin, end, new) for number, (_, begin, end, new)
                   in enumerate(random_changes.changes(SWITCHED, random.Random(3)))}
        self.assertGreater(len(changes), 25)
        with tempfile.TemporaryDirectory() as folder:
            def compiled(text):
                (pathlib.Path(folder) / "a.cpp").write_bytes(text)
                subprocess.run(["g++", "-std=c++20", "-w", "-o", "a", "a.cpp"], cwd=folder, check=True)

            def printed(**environment):
                return subprocess.run([f"{folder}/a"], env={**os.environ, **environment}, capture_output=True, check=True,
                                      timeout=60).stdout

            source = switches.Source("/a.cpp", {"/a.cpp": SWITCHED}, ["-xc++", "-std=c++20"])
            compiled(switches.switched(source, changes) + switches.DEFINITION % len(changes))
            reached = pathlib.Path(folder) / "reached"
            reached.write_bytes(bytes(len(changes)))
            without = printed(RONDEL_REACHED=str(reached))
            found = {number: printed(RONDEL_MUTANT=str(number)) for number in changes}
            self.assertEqual(reached.read_bytes(), bytes([1]) * len(changes))
            compiled(SWITCHED.encode())
            self.assertEqual(printed(), without)
            self.assertGreater(sum(text != without for text in found.values()), len(changes) / 2)
            for number in random.Random(4).sample(sorted(changes), 4):
                begin, end, new = changes[number]
                compiled((SWITCHED[:begin] + new + SWITCHED[end:]).encode())
                self.assertEqual(printed(), found[number], SWITCHED[begin:end + 20])


if __name__ == "__main__":
    unittest.main()
