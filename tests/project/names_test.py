# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""No two types of the library share a name, and no two files of different layers.

A type is what `struct`, `class`, `union` or `enum` defines, nested ones included; within one file a
name may be used again. A file's name is without its ending.
"""

import collections
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))

DEFINITION = re.compile(
    r"^ *(?:class|struct|union|enum(?: class)?)\s+(?:RONDEL_API\s+)?(?:\w+::)*(\w+)(?:\s+final)?"
    r"\s*(?::(?!:)[^;{]*)?\{",
    re.MULTILINE,
)

# Types that have one name because they are one idea, and why they are several types.
TYPES = {
    "Impl": "what a public class holds",
}
# Files that have one name because they are about one thing.
FILES = {
    "cells": "computed in dual, written in io",
    "sites": "kept in api, read and written in io",
    "triangulate": "the same task for each of the builders",
}


def files(root):
    """All C++ files of the library."""
    for folder in ("include", "src"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in {".h", ".cpp"}:
                yield path


def homes_of_types(root):
    """The files that define each type."""
    homes = collections.defaultdict(set)
    for path in files(root):
        for name in DEFINITION.findall(path.read_text(encoding="utf-8")):
            homes[name].add(str(path.relative_to(root)))
    return homes


def layers_of_files(root):
    """The layers that have a file of each name."""
    layers = collections.defaultdict(set)
    for path in (root / "src").rglob("*"):
        if path.suffix in {".h", ".cpp"}:
            layers[path.stem].add(path.parent.name)
    return layers


def shared(homes):
    """The names with several homes."""
    return {name: sorted(where) for name, where in homes.items() if len(where) > 1}


class Names(unittest.TestCase):
    def test_types_share_no_name(self):
        self.assertEqual(
            set(shared(homes_of_types(ROOT))), set(TYPES), shared(homes_of_types(ROOT))
        )

    def test_files_of_different_layers_share_no_name(self):
        self.assertEqual(
            set(shared(layers_of_files(ROOT))), set(FILES), shared(layers_of_files(ROOT))
        )

    def test_shared_names_are_found(self):
        texts = {
            "include/rondel/a.h": "class RONDEL_API A {\n};\nstruct Forward;\n",
            "src/low/b.h": "template <class T>\nclass B final : public A {\n  struct Inner {\n  };\n};\n",
            "src/low/c.h": "enum class Inner : int { one };\nstruct Other {\n};\n",
            "src/high/c.cpp": "struct Forward;\nstruct B::Other {\n};\n",
        }
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in texts.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            self.assertEqual(
                shared(homes_of_types(root)),
                {
                    "Inner": ["src/low/b.h", "src/low/c.h"],
                    "Other": ["src/high/c.cpp", "src/low/c.h"],
                },
            )
            self.assertEqual(shared(layers_of_files(root)), {"c": ["high", "low"]})


if __name__ == "__main__":
    unittest.main()
