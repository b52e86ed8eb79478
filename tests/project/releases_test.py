# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What a release says of itself is true: notes, bill of materials, recipes, workflows, the figures of the paper.

    releases_test.py SOURCE_FOLDER
"""

import configparser
import hashlib
import importlib.machinery
import importlib.util
import io
import json
import os
import pathlib
import re
import sys
import tarfile
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(sys.argv.pop(1))
VERSION = (ROOT / "VERSION").read_text(encoding="utf-8").strip()
TIME = "2027-01-31T12:00:00Z"


def module(name):
    """A script of scripts/tools as a module."""
    path = str(ROOT / "scripts" / "tools" / name)
    loader = importlib.machinery.SourceFileLoader(name, path)
    made = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    sys.dont_write_bytecode = True
    loader.exec_module(made)
    return made


release = module("release")
sbom = module("sbom")


class Changelog(unittest.TestCase):
    TEXT = "# Changelog\n\n## 0.2.0 (2027-01-31)\n\n### Added\n\n- a\n\n## 0.1.0 (not yet released)\n\n- b\n"
    CITATION = "title: x\nversion: 0.2.0\ndate-released: 2027-01-31\nlicense: y\n"

    def test_notes_are_the_section_of_the_version(self):
        self.assertEqual(release.section_of(self.TEXT, "0.2.0"), ("0.2.0 (2027-01-31)", "### Added\n\n- a\n"))
        self.assertEqual(release.section_of(self.TEXT, "0.1.0")[1], "- b\n")
        self.assertRaises(ValueError, release.section_of, self.TEXT, "0.2")

    def test_a_version_that_is_ready_has_no_problem(self):
        self.assertEqual(list(release.problems_of("v0.2.0", "0.2.0", self.TEXT, self.CITATION)), [])

    def test_each_problem_is_named(self):
        def problems(tag="v0.2.0", version="0.2.0", text=self.TEXT, citation=self.CITATION):
            return " ".join(release.problems_of(tag, version, text, citation))

        self.assertIn("the tag 0.2.0", problems(tag="0.2.0"))
        self.assertIn("has no date", problems("v0.1.0", "0.1.0"))
        self.assertIn("no section", problems("v0.3.0", "0.3.0"))
        self.assertIn("says nothing", problems(text=self.TEXT.replace("- a\n", "")))
        self.assertIn("another version", problems(citation=self.CITATION.replace("0.2.0", "0.2.1")))
        self.assertIn("date-released", problems(citation=self.CITATION.replace("-31", "-30")))

    def test_the_changelog_has_notes_of_this_version(self):
        changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
        self.assertIn("\n- ", release.section_of(changelog, VERSION)[1])


class Archives(unittest.TestCase):
    FILES = {"VERSION": b"1.2.3\n", "a.cpp": b"// SPDX-License-Identifier: Apache-2.0\n", "b/data.csv": b"1,2\n"}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.archive = self.folder / "rondel-1.2.3-source.tar.xz"
        with tarfile.open(self.archive, "w:xz") as tar:
            for name, content in self.FILES.items():
                member = tarfile.TarInfo(f"rondel-1.2.3/{name}")
                member.size = len(content)
                tar.addfile(member, io.BytesIO(content))

    def test_the_bill_of_materials_has_each_file_with_its_hashes(self):
        bill = sbom.document(self.archive, TIME)
        self.assertEqual(bill["spdxVersion"], "SPDX-2.3")
        found = {file["fileName"]: {c["algorithm"]: c["checksumValue"] for c in file["checksums"]} for file in bill["files"]}
        for name, content in self.FILES.items():
            sums = {"SHA1": hashlib.sha1(content).hexdigest(), "SHA256": hashlib.sha256(content).hexdigest()}
            self.assertEqual(found.pop(f"./{name}"), sums)
        self.assertEqual(found, {})
        self.assertEqual([file["licenseConcluded"] for file in bill["files"]], ["NOASSERTION", "Apache-2.0", "NOASSERTION"])
        package = bill["packages"][0]
        self.assertEqual((package["name"], package["versionInfo"]), ("rondel", "1.2.3"))
        self.assertEqual(package["checksums"][0]["checksumValue"], hashlib.sha256(self.archive.read_bytes()).hexdigest())
        self.assertEqual(json.dumps(bill), json.dumps(sbom.document(self.archive, TIME)))

    def test_the_bill_of_materials_names_what_is_needed(self):
        bill = sbom.document(self.archive, TIME)
        names = {package["name"] for package in bill["packages"]}
        packages = (ROOT / "scripts/tools/packages/build.txt").read_text(encoding="utf-8").split()
        words = {"libcairo2-dev": "cairo", "libcli11-dev": "CLI11", "libfast-float-dev": "fast_float",
                 "libtbb-dev": "oneTBB", "nlohmann-json3-dev": "JSON", "zlib1g-dev": "zlib"}
        self.assertEqual(set(words), {package for package in packages if package.endswith("-dev")})
        for word in words.values():
            self.assertTrue(any(name.startswith(word) for name in names), word)
        identifiers = {package["SPDXID"] for package in bill["packages"]} | {"SPDXRef-DOCUMENT"}
        for relation in bill["relationships"]:
            self.assertLessEqual({relation["spdxElementId"], relation["relatedSpdxElement"]}, identifiers)

    def test_recipes_name_the_archive_and_its_hashes(self):
        release.write_recipes("https://forge.example/owner/rondel", self.archive, self.folder, "1.2.3")
        data = self.archive.read_bytes()
        texts = {}
        for kind in ("conda", "vcpkg"):
            with tarfile.open(self.folder / f"rondel-1.2.3-{kind}.tar.gz") as tar:
                texts |= {pathlib.Path(m.name).name: tar.extractfile(m).read().decode() for m in tar.getmembers()}
        self.assertEqual(set(texts), {"recipe.yaml", "vcpkg.json", "portfile.cmake"})
        for text in texts.values():
            self.assertNotRegex(text, r"@\w+@")
        address = f"https://forge.example/owner/rondel/releases/download/v1.2.3/{self.archive.name}"
        self.assertIn(f"  url: {address}\n  sha256: {hashlib.sha256(data).hexdigest()}\n", texts["recipe.yaml"])
        self.assertIn("    - owner\n", texts["recipe.yaml"])
        self.assertIn(f'URLS "{address}"', texts["portfile.cmake"])
        self.assertIn(f"SHA512 {hashlib.sha512(data).hexdigest()}\n", texts["portfile.cmake"])
        port = json.loads(texts["vcpkg.json"])
        self.assertEqual((port["name"], port["version"]), ("rondel", "1.2.3"))
        self.assertRaises(ValueError, release.with_values, "@WHAT@", {"URL": "x"})

    def test_the_plugin_for_qgis_says_which_version_it_is(self):
        release.write_plugin("https://forge.example/owner/rondel", self.folder, "1.2.3")
        with zipfile.ZipFile(self.folder / "rondel-1.2.3-qgis.zip") as plugin:
            names = plugin.namelist()
            metadata = configparser.ConfigParser()
            metadata.read_string(plugin.read("rondel_processing/metadata.txt").decode())
        self.assertTrue({"rondel_processing/__init__.py", "rondel_processing/LICENSE"} <= set(names))
        self.assertFalse([name for name in names if "__pycache__" in name])
        general = metadata["general"]
        self.assertEqual((general["version"], general["repository"]), ("1.2.3", "https://forge.example/owner/rondel"))
        needed = {"name", "qgisMinimumVersion", "description", "about", "author", "email", "tracker", "hasProcessingProvider"}
        self.assertTrue({key.lower() for key in needed} <= set(general))

    def test_recipes_set_options_that_there_are(self):
        options = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        for path in (ROOT / "packaging").rglob("*"):
            if path.is_file():
                for option in re.findall(r"\bRONDEL_[A-Z_]+", path.read_text(encoding="utf-8")):
                    self.assertIn(option, options, path)


class Workflows(unittest.TestCase):
    def test_commands_are_scripts_of_the_project(self):
        paths = sorted((ROOT / ".github/workflows").glob("*.yml"))
        self.assertGreater(len(paths), 3)
        for path in paths:
            text = path.read_text(encoding="utf-8")
            for name in re.findall(r"(?<![\w/])((?:scripts|\.ci)/[\w./-]*\w)", text):
                self.assertTrue((ROOT / name).is_file(), f"{path.name}: {name}")
                if not name.endswith(".txt"):
                    self.assertTrue(os.access(ROOT / name, os.X_OK), f"{path.name}: {name}")

    def test_steps_and_kinds_are_those_of_the_scripts(self):
        check = (ROOT / ".github/workflows/check.yml").read_text(encoding="utf-8")
        steps = re.search(r"^\s+step: \[(.*)\]$", check, re.M)[1].split(", ")
        usage = re.search(r"usage: \.ci/run \[(.*?)\]", (ROOT / ".ci/run").read_text(encoding="utf-8"))[1].split("|")
        self.assertEqual(steps, usage)
        text = (ROOT / ".github/workflows/release.yml").read_text(encoding="utf-8")
        kinds = " ".join(re.findall(r"kinds: ([\w ]+),", text)).split()
        usage = re.search(r"usage: scripts/package \[(.*?)\]", (ROOT / "scripts/package").read_text(encoding="utf-8"))[1].split("|")
        self.assertEqual(sorted([*kinds, "wheels"]), sorted(usage))


class Paper(unittest.TestCase):
    def test_figures_are_those_of_the_measurements(self):
        paper = (ROOT / "paper/paper.md").read_text(encoding="utf-8")
        results = (ROOT / "bench/RESULTS.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| [^|]+ \| ([^|]+) \| ([\d.]+) \|$", paper, re.M)
        self.assertGreater(len(rows), 5)
        for peer, ratio in rows:
            self.assertIn(peer.split()[0], results)
            self.assertRegex(results, rf"\| {re.escape(ratio)}\b")
        for words in ("0.19 s in all", "2^32 + 2^20", "1,738 s"):
            self.assertIn(words, paper)
            self.assertIn(words, results)

    def test_works_that_are_cited_are_listed(self):
        cited = set(re.findall(r"@(\w+)", (ROOT / "paper/paper.md").read_text(encoding="utf-8")))
        listed = set(re.findall(r"^@\w+\{(\w+),", (ROOT / "paper/paper.bib").read_text(encoding="utf-8"), re.M))
        self.assertEqual(cited, listed)

    def test_figures_are_there(self):
        for name in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", (ROOT / "paper/paper.md").read_text(encoding="utf-8")):
            self.assertTrue((ROOT / "paper" / name).exists(), name)


if __name__ == "__main__":
    unittest.main()
