# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The page on proofs, the scripts and the theorems name each other, and changed filters are noticed.

    proofs_test.py SOURCE_FOLDER
"""

import importlib.machinery
import importlib.util
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import tomllib

ROOT = pathlib.Path(sys.argv.pop(1))
PROOFS = ROOT / "tests" / "proofs"


def load_prove():
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("prove", str(ROOT / "scripts" / "tools" / "prove"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("prove", loader))
    loader.exec_module(module)
    return module


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


def without_comments(path):
    return re.sub(r"//.*", "", read(path))


# Constants of floating point that a filter could compare with.
NUMBER = re.compile(
    r"\b(?:extended_)?unit_roundoff\b|\b0x[\da-f.]+p[-+]?\d|\b\d[\d.]*e[-+]?\d|#define"
    r"|\bconstexpr (?:long )?(?:double|float|auto) \w+ ?[={]"
)

# What counts roundings, or asks a bound of the predicates.
ROUNDING = re.compile(r"\bunit_roundoff\b|\* 0x1p-53|predicates::\w+_bound\b|\bis_beyond(?:_longest)?\(value")


class Proofs(unittest.TestCase):
    def setUp(self):
        self.page = read("docs/theory/proofs.md")
        listed = tomllib.loads(read("tests/proofs/constants.toml"))
        self.constants, self.numbers = listed["constant"], listed["numbers"]

    def rows_of_what_is_not_proved(self):
        part = self.page.split("## What is not proved by machine", 1)[1]
        return [line.split(" | ")[0] for line in part.splitlines() if line.startswith("| ")]

    def test_each_bound_has_a_script_or_a_row_that_says_why_not(self):
        code = without_comments("src/predicates/bounds.h")
        inside = re.search(r"namespace rondel::predicates \{(.*)\}", code, re.S)[1]
        names = []
        for statement in filter(None, map(str.strip, inside.split(";"))):
            # Bounds are written in this form only, so that none is overlooked.
            definition = re.fullmatch(r"inline constexpr double (\w+) = [^{}]*", statement)
            self.assertIsNotNone(definition, f"bounds.h: {statement}")
            names.append(definition[1])
        self.assertEqual(re.findall(r"#\w+.*", code), ["#pragma once"])
        self.assertGreater(len(names), 15)
        with_script = {constant["name"] for constant in self.constants if constant["scripts"]}
        rows = self.rows_of_what_is_not_proved()
        for name in names:
            if name != "unit_roundoff":
                has_row = any(f"`{name}`" in row for row in rows)
                self.assertNotEqual(name in with_script, has_row, f"{name}: a script, or a row of what is not proved")

    def test_numbers_of_predicates_are_in_bounds_or_listed(self):
        listed = {(entry["file"], line) for entry in self.numbers for line in entry["lines"]}
        listed |= {(constant["file"], f"constexpr double {constant['text']};") for constant in self.constants}
        found = set()
        for path in sorted((ROOT / "src" / "predicates").iterdir()):
            if path.suffix in (".h", ".cpp") and path.name != "bounds.h":
                file = str(path.relative_to(ROOT))
                lines = map(str.strip, without_comments(file).splitlines())
                found |= {(file, line) for line in lines if NUMBER.search(line)}
        self.assertEqual(found - listed, set(), "neither in bounds.h nor in constants.toml")
        quoted = {(entry["file"], line) for entry in self.numbers for line in entry["lines"]}
        self.assertEqual(quoted - found, set(), "in constants.toml, and not in the sources")

    def test_files_that_count_roundings_are_on_the_page(self):
        named = self.page + "".join(constant["file"] for constant in self.constants)
        for path in sorted((ROOT / "src").rglob("*")):
            file = str(path.relative_to(ROOT))
            if path.suffix in (".h", ".cpp") and not file.startswith(("src/predicates/", "src/exact/")):
                self.assertTrue(file in named or not ROUNDING.search(without_comments(file)), file)

    def test_each_constant_is_quoted_from_its_file(self):
        for constant in self.constants:
            self.assertEqual(read(constant["file"]).count(constant["text"]), 1, constant["name"])

    def test_each_script_belongs_to_a_constant(self):
        named = {script for constant in self.constants for script in constant["scripts"]}
        self.assertEqual(named, {path.stem for path in (PROOFS / "scripts").glob("*.g")})

    def test_each_theorem_that_the_page_names_exists(self):
        theorems = set()
        for path in PROOFS.glob("*.v"):
            theorems.update(re.findall(r"^Theorem (\w+)", path.read_text(encoding="utf-8"), re.M))
        for name in re.findall(r"`(\w+_filter)`", self.page):
            self.assertIn(name, theorems)

    def test_no_proof_is_left_open(self):
        for path in PROOFS.glob("*.v"):
            self.assertNotRegex(path.read_text(encoding="utf-8"), r"\b(Admitted|Axiom|Abort|admit)\b", path.name)


@unittest.skipUnless(sys.platform == "linux" and shutil.which("g++"), "the extraction is compiled by g++ on Linux")
class Extraction(unittest.TestCase):
    """What `scripts/test --prove` takes from the sources, without the proofs: a few seconds."""

    def test_theorems_are_about_all_that_filters_compare_and_edits_are_noticed(self):
        prove = load_prove()
        edits = tomllib.loads(read("tests/proofs/edits.toml"))["edit"]
        with tempfile.TemporaryDirectory() as name:
            before, after = pathlib.Path(name) / "before", pathlib.Path(name) / "after"
            before.mkdir()
            self.assertEqual(prove.formulas_of(before), "")
            wrong = prove.formulas_of(after, prove.edited_copy(after, edits))
            for edit in edits:
                with self.subTest(edit["new"]):
                    if "says" in edit:
                        self.assertIn(edit["says"], wrong)
                    else:
                        # Gappa gets another inequality, which --prove --mutants sees it fail to prove.
                        script = f"{edit['script']}.g"
                        self.assertNotEqual((before / script).read_text(), (after / script).read_text())


if __name__ == "__main__":
    unittest.main()
