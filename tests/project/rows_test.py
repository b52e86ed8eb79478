# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Compressed rows have few types, and one file assembles them.

1. Few structs of the public headers have members that are offsets.
2. Only src/system/row_assembly.h sums counts up to offsets.
3. Only the types of rows append an offset; other code calls their functions.
"""

import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))

MAKER = "src/system/row_assembly.h"
# The structs that have offsets, and why there is more than one of them.
TYPES = {
    "CompressedRows": "rows of values",
    "RowGroups": "groups of rows",
    "CellRings": "cells, their rings and corners, which index points",
    "Weights": "a sparse matrix as SciPy has it",
}
# Offsets begin with 0, whatever they are called.
OFFSETS = re.compile(r"std::vector<std::uint64_t> (?:(\w*offsets)\b|(\w+) = \{\s*0\};)")
STRUCT = re.compile(r"^struct (\w+) \{$(.*?)^\};$", re.MULTILINE | re.DOTALL)
SUMS = re.compile(
    r"\b(?:partial_sum|(?:in|ex)clusive_scan)\b"
    r"|(\w*(?:offsets|ends|starts|begins|firsts)_?)\[\w+ \+ 1\] \+?= .*\b\1\[\w+\]"
)
APPENDS = re.compile(r"\boffsets_?\.(?:push|emplace)_back\(")


def code(path):
    """The text of a file without comments."""
    return re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))


def structs(root):
    """The structs of public headers that have offsets."""
    return {
        name
        for path in sorted((root / "include").rglob("*.h"))
        for name, body in STRUCT.findall(code(path))
        if OFFSETS.search(body)
    }


def problems(root):
    """One line for each place of the library or of a binding that assembles rows by itself."""
    for folder in ("src", "bindings"):
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix not in {".h", ".cpp"} or name == MAKER:
                continue
            is_type = re.search(r"void end_row\(\)", code(path)) is not None
            for number, line in enumerate(code(path).splitlines(), 1):
                if SUMS.search(line):
                    yield f"{name}:{number}: counts are summed by {MAKER}"
                if APPENDS.search(line) and not is_type:
                    yield f"{name}:{number}: rows are ended by end_row()"


class Rows(unittest.TestCase):
    def test_few_types_have_offsets(self):
        self.assertEqual(structs(ROOT), set(TYPES))
        self.assertLessEqual(len(TYPES), 4)

    def test_one_file_assembles_rows(self):
        self.assertEqual(list(problems(ROOT)), [])

    def test_other_assemblies_are_found(self):
        for text, wrong in {
            "std::partial_sum(a.begin(), a.end(), a.begin());": True,
            "for (i) rows.offsets[i + 1] += rows.offsets[i];": True,
            "offsets[c + 1] = offsets[c] + size;": True,
            "rows.offsets.push_back(rows.values.size());": True,
            "rows.end_row();  // offsets.push_back(1)": False,
            "const auto size = offsets[i + 1] - offsets[i];": False,
        }.items():
            with tempfile.TemporaryDirectory() as folder, self.subTest(text):
                path = pathlib.Path(folder, "src", "map", "a.cpp")
                path.parent.mkdir(parents=True)
                path.write_text(text + "\n", encoding="utf-8")
                self.assertEqual(len(list(problems(pathlib.Path(folder)))), int(wrong))


if __name__ == "__main__":
    unittest.main()
