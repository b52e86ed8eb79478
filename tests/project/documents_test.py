# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What the documents say is what the repository holds.

    documents_test.py SOURCE_FOLDER
"""

import hashlib
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
PARTS_OF = {"cpp": sorted(ROOT.glob("examples/*.cpp")), "c": sorted(ROOT.glob("examples/*.c")),
            "cmake": [ROOT / "examples/CMakeLists.txt"]}


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


def documents():
    """The Markdown files of the repository."""
    folders = [ROOT, *(ROOT / name for name in ("docs", "data", "bench", "bindings"))]
    return sorted(set(folders[0].glob("*.md")).union(*(f.rglob("*.md") for f in folders[1:])))


def blocks(path):
    """(language, text) of the fenced blocks of a document."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", path.read_text(encoding="utf-8"), re.M | re.S)


class Documents(unittest.TestCase):
    def test_every_code_block_is_a_part_of_an_example(self):
        found = [
            (path, language, text)
            for path in documents()
            for language, text in blocks(path)
            if language in PARTS_OF
        ]
        self.assertGreater(len(found), 0)
        for path, language, text in found:
            examples = [example.read_text(encoding="utf-8") for example in PARTS_OF[language]]
            self.assertTrue(any(text in example for example in examples), f"{path}:\n{text}")

    def test_every_local_link_leads_to_a_file(self):
        for path in documents():
            for target in re.findall(r"\]\(([^)#]+)[^)]*\)", path.read_text(encoding="utf-8")):
                if not re.match(r"[a-z]+:", target):
                    self.assertTrue((path.parent / target).exists(), f"{path}: {target}")

    def test_every_decision_is_in_the_index(self):
        index = read("docs/decisions/README.md")
        for path in ROOT.glob("docs/decisions/[0-9]*.md"):
            self.assertIn(f"({path.name})", index)

    def test_the_version_is_the_same_everywhere(self):
        version = read("VERSION").strip()
        self.assertRegex(read("CHANGELOG.md"), rf"(?m)^## {re.escape(version)}\b")
        self.assertRegex(read("CITATION.cff"), rf"(?m)^version: {re.escape(version)}$")

    def test_the_provenance_of_the_stations_is_theirs(self):
        data = (ROOT / "data/stations.csv").read_bytes()
        self.assertIn(hashlib.sha256(data).hexdigest(), read("data/README.md"))
        rows = data.count(b"\n") - 1
        self.assertIn(f"{rows:,} weather stations", read("data/README.md"))

    def test_the_provenance_of_the_coasts_is_theirs(self):
        data = (ROOT / "data/coast.txt").read_bytes()
        text = read("data/README.md")
        self.assertIn(hashlib.sha256(data).hexdigest(), text)
        curves = [line.split() for line in data.decode().splitlines()]
        steps = sum(len(numbers) // 2 - 1 for numbers in curves)
        self.assertIn(f"{len(curves)} closed curves of {steps:,} steps", text)

    def test_the_layers_of_the_architecture_are_those_of_the_sources(self):
        named = re.findall(r"^\| `src/(\w+)/`", read("ARCHITECTURE.md"), re.M)
        self.assertEqual(named, read("src/LAYERS").split())

    def test_every_script_that_a_document_names_exists(self):
        for path in documents():
            if path.name == "CHANGELOG.md" or path.parent.name == "history":
                continue  # they tell what once was
            text = path.read_text(encoding="utf-8")
            for name in re.findall(r"(?:\./)?((?:scripts/|\.ci/)(?:[\w.-]+/)*[\w.-]*\w)(?![\w*-])", text):
                self.assertTrue((ROOT / name).exists(), f"{path}: {name}")


if __name__ == "__main__":
    unittest.main()
