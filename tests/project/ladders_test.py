# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Each predicate's rungs are composed in one file, and nothing else calls a rung.

A rung is a function of src/predicates that returns a sign (or, for ties, whether there is a
conflict) and whose name ends like one of Tally's members.
"""

import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))

ENDS = "filter|extended|double_double|close|exact|perturbed"
DECLARATION = re.compile(rf"^(?:\[\[.*\]\] )?(?:inline )?(?:Sign|bool|std::optional<Sign>) (\w+_(?:{ENDS}))\(", re.MULTILINE)
# The file that composes the rungs whose names begin so.
LADDERS = {
    "side_of_circle_": "conflict.h",
    "side_of_plane_": "conflict.h",
    "is_in_conflict_": "conflict.h",
    "conflict_": "conflict.h",
    "orientation_": "orientation.h",
    "compare_": "compare_distance.h",
    "is_within_": "within_angle.h",
}


def rungs(root):
    """The names of all rungs, each with the stem of the file that declares it."""
    return {
        name: path.stem
        for path in sorted((root / "src" / "predicates").glob("*.h"))
        for name in DECLARATION.findall(path.read_text(encoding="utf-8"))
    }


def problems(root):
    """One line for each call of a rung outside the file that declares it and its ladder."""
    declared = rungs(root)
    calls = re.compile(r"\b(" + "|".join(declared) + r")\(")
    for path in sorted((root / "src").rglob("*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for name in calls.findall(line.split("//")[0]):
                ladder = next(file for begin, file in LADDERS.items() if name.startswith(begin))
                is_home = path.parent.name == "predicates" and (
                    path.stem.startswith(declared[name]) or path.name == ladder
                )
                if not is_home:
                    yield f"{path.relative_to(root)}:{number}: calls {name}, a rung of {ladder}"


class Ladders(unittest.TestCase):
    def test_every_predicate_has_its_rungs(self):
        found = rungs(ROOT)
        for begin in LADDERS:
            self.assertTrue(any(name.startswith(begin) for name in found), begin)

    def test_nobody_else_calls_a_rung(self):
        self.assertEqual(list(problems(ROOT)), [])

    def test_a_call_from_elsewhere_is_found(self):
        files = {
            "src/predicates/side_of_circle.h": "inline Sign side_of_circle_filter(int a);\n",
            "src/predicates/conflict.h": "s = side_of_circle_filter(1);\n",
            "src/bulk/a.cpp": "// side_of_circle_filter(\nx = predicates::side_of_circle_filter(2);\n",
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            found = list(problems(pathlib.Path(folder)))
        self.assertEqual(
            found, ["src/bulk/a.cpp:2: calls side_of_circle_filter, a rung of conflict.h"]
        )


if __name__ == "__main__":
    unittest.main()
