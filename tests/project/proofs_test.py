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


class Proofs(unittest.TestCase):
    def setUp(self):
        self.page = read("docs/theory/proofs.md")
        self.constants = tomllib.loads(read("tests/proofs/constants.toml"))["constant"]

    def test_the_page_says_of_each_bound_whether_it_is_proved(self):
        names = re.findall(r"constexpr double (\w+) =", read("src/predicates/bounds.h"))
        self.assertGreater(len(names), 15)
        for name in names:
            if name != "unit_roundoff":
                self.assertIn(f"`{name}`", self.page)

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


@unittest.skipUnless(shutil.which("g++"), "the extraction is compiled by g++")
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
