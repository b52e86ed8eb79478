# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Comments open with a subject: what a function returns or does, what a field is.

A comment that opens with one of the words below has no noun that it is about. Checked is the first
line of each block of whole-line comments, and the line after a `file` command.
"""

import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))

FOLDERS = ["src", "cli", "include", "bindings"]
ENDINGS = {".h", ".hpp", ".c", ".cpp"}

COMMENT = re.compile(r"^\s*//[/!]?<?\s*(?P<text>.*?)\s*$")
HEADLESS = re.compile(r"^(Of|Those|The same|None|As)\b")


def openings(text):
    """The number and the text of the line with which each block of comments opens."""
    is_inside = False
    for number, line in enumerate(text.splitlines(), 1):
        comment = COMMENT.match(line)
        if comment is None:
            is_inside = False
        elif not is_inside and comment["text"] != r"\file":
            is_inside = True
            yield number, comment["text"]


def problems(root):
    """One line for each comment without a subject."""
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in ENDINGS:
                continue
            for number, text in openings(path.read_text(encoding="utf-8")):
                if HEADLESS.match(text):
                    yield f"{path.relative_to(root)}:{number}: {text}"


class Comments(unittest.TestCase):
    def test_each_opens_with_a_subject(self):
        found = list(problems(ROOT))
        if found:
            self.fail("\n".join(["comments open without a subject:", *found]))

    def test_openings_without_a_subject_are_found(self):
        files = {
            "include/rondel/a.h": "/// \\file\n/// The same for sites.\n\n/// Offers a.\n/// As b.\n",
            "src/low/b.h": "int a;  // As above.\n  // Those of a site.\nint b;\n// None: it is empty.\n",
            "src/low/c.cpp": "// Official names.\n\n//! Of a ring, the corner.\n/// As delaunay() does.\n",
            "cli/d.cpp": "// Ask once.\nint f();\n// The samples.\n",
            "bindings/e.c": "// As in Python.\n",
            "bindings/e.py": "# Of a list.\n",
        }
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            self.assertEqual(
                list(problems(root)),
                [
                    "src/low/b.h:2: Those of a site.",
                    "src/low/b.h:4: None: it is empty.",
                    "src/low/c.cpp:3: Of a ring, the corner.",
                    "include/rondel/a.h:2: The same for sites.",
                    "bindings/e.c:1: As in Python.",
                ],
            )


if __name__ == "__main__":
    unittest.main()
