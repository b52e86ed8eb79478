# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The npm package in Chromium without a screen.

    browser_test.py FOLDER NODE CHROMIUM TEST

FOLDER is where the package and what its tests need are installed (build/js), its folder tests a copy of
bindings/js/tests; TEST a class of this file.
"""

import base64
import contextlib
import json
import pathlib
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).parents[4] / "tests" / "globe"))
from browser import Browser  # noqa: E402 (after the lines above)
from server import Server  # noqa: E402

FOLDER, NODE, CHROMIUM = sys.argv[1:4]
TESTS = pathlib.Path(FOLDER) / "tests" / "browser"


class PackageTest(unittest.TestCase):
    """Has a server, a browser and what Node.js computes."""

    @classmethod
    def setUpClass(cls):
        with contextlib.ExitStack() as stack:
            cls.server = stack.enter_context(Server(FOLDER))
            cls.browser = stack.enter_context(Browser(CHROMIUM))
            cls.addClassCleanup(stack.pop_all().close)
        cls.expected = json.loads(run(NODE, TESTS / "in_node.mjs"))

    def page(self, name):
        """A page whose script has run; it fails where the console has errors when the test ends."""
        page = self.browser.open(f"{self.server.address}/tests/browser/{name}")
        self.addCleanup(page.close)
        self.addCleanup(lambda: self.assertEqual(page.errors(), []))
        page.wait("document.readyState === 'complete'")
        return page

    def compare(self, page):
        """All results are those of Node.js: bytes of typed arrays, and GeoJSON but for last digits of degrees."""
        self.maxDiff = 2000
        self.assertEqual(page.run("rondelTest.typedArrays()"), self.expected["typedArrays"])
        self.compare_close(page.run("rondelTest.geoJson()"), self.expected["geoJson"])

    def compare_close(self, found, expected):
        """Values of JSON, numbers to 1e-9: Math.sin() and its like are not the same in all engines."""
        if isinstance(expected, float) and isinstance(found, (int, float)):
            self.assertAlmostEqual(found, expected, delta=1e-9)
        elif isinstance(expected, list) and isinstance(found, list):
            self.assertEqual(len(found), len(expected))
            for pair in zip(found, expected):
                self.compare_close(*pair)
        elif isinstance(expected, dict) and isinstance(found, dict):
            self.assertEqual(list(found), list(expected))
            for name in expected:
                self.compare_close(found[name], expected[name])
        else:
            self.assertEqual(found, expected)


def run(*command):
    """What a command prints."""
    done = subprocess.run([*map(str, command)], cwd=TESTS, text=True, capture_output=True, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stdout + done.stderr)
    return done.stdout


def bundle(*arguments):
    """Calls esbuild."""
    esbuild = pathlib.Path(FOLDER) / "node_modules" / "esbuild" / "bin" / "esbuild"
    run(NODE, esbuild, "--bundle", "--log-level=warning", f"--outdir={TESTS / 'made'}", *arguments)


class Modules(PackageTest):
    """The files of the package as they are, from a server that knows nothing but files."""

    def test_results_are_those_of_node(self):
        page = self.page("modules.html")
        self.assertEqual(page.run("rondelTest.first.numFaces"), 8)
        self.compare(page)

    def test_worker(self):
        self.assertEqual(self.page("modules.html").run("rondelTest.fromWorker()"), self.expected["worker"])

    def test_loading_without_blocking(self):
        self.assertIsNone(self.page("modules.html").run("rondelTest.init()"))


class Bundle(PackageTest):
    """Bundles of esbuild."""

    def test_module_and_its_worker_under_a_narrow_policy(self):
        worker = pathlib.Path(FOLDER) / "node_modules" / "rondel" / "src" / "worker" / "browser.js"
        bundle("--format=esm", "--splitting", "--entry-names=[name]", TESTS / "main.mjs", worker)
        page = self.page("bundle.html?strict")
        self.compare(page)
        self.assertEqual(page.run("rondelTest.fromWorker()"), self.expected["worker"])
        self.assertEqual(page.run("fetch('main.mjs').then(() => 'taken', () => 'refused')"), "refused")
        page.browser.events.clear()  # the refusal is on the console

    def test_plain_script_is_ready_at_once(self):
        bundle("--format=iife", "--entry-names=script", TESTS / "main.mjs")
        page = self.page("script.html")
        self.assertEqual(page.run("rondelTest.first"), {"numFaces": 8, "state": "loading"})
        self.compare(page)

    def test_modules_of_8_mb_are_compiled_at_once(self):
        page = self.page("modules.html")
        compiled = "rondelTest.compileAtOnce({})"
        self.assertEqual(page.run(compiled.format(8 << 20)), "compiled")

class Globes(PackageTest):
    """Packages that call d3-geo-voronoi, bundled with it and with the drop-in in its place."""

    def test_pictures_are_those_with_d3(self):
        pages = {}
        for name, options in {"d3": [], "rondel": ["--alias:d3-geo-voronoi=rondel/d3"]}.items():
            bundle("--format=iife", f"--entry-names=globes_{name}", *options, TESTS / "globes.mjs")
            pages[name] = self.page(f"globes.html?{name}")
        self.assertGreater(pages["d3"].run("globesTest.trianglesOnEquator()"), 0)
        self.assertEqual(pages["rondel"].run("globesTest.trianglesOnEquator()"), 0)
        for package in ("conicPolygons", "threeGlobe", "globeGl"):
            pictures = [page.run(f"globesTest.{package}()") for page in pages.values()]
            for view in pictures[0]:
                with self.subTest(f"{package}, {view}"):
                    self.compare_pictures(*(base64.b64decode(picture[view]) for picture in pictures))

    def test_polygons_by_geo_triangulate_cover_the_same_pixels(self):
        bundle("--format=iife", "--entry-names=globes_d3", TESTS / "globes.mjs")
        page = self.page("globes.html?d3")
        for ours, theirs in (("triangulatedThreeGlobe", "threeGlobe"), ("triangulatedGlobeGl", "globeGl")):
            pictures = [page.run(f"globesTest.{name}()") for name in (ours, theirs)]
            for view in pictures[0]:
                with self.subTest(f"{ours}, {view}"):
                    pixels = [list(zip(*[iter(base64.b64decode(picture[view]))] * 4)) for picture in pictures]
                    a, b = ({i for i, (*rgb, _) in enumerate(every) if max(rgb) - min(rgb) > 40} for every in pixels)
                    self.assertGreater(len(a), len(pixels[0]) // 20)
                    self.assertGreater(len(a & b), 0.9 * len(a | b))  # theirs have sides and black borders, too

    def compare_pictures(self, *pictures):
        """At most one pixel of a thousand differs by more than 8 of 255; polygons cover a twentieth or more."""
        a, b = (list(zip(*[iter(picture)] * 4)) for picture in pictures)
        self.assertEqual([len(a), len(b)], [300 * 300] * 2)
        different = sum(max(abs(x - y) for x, y in zip(*pair)) > 8 for pair in zip(a, b))
        self.assertLessEqual(different, len(a) // 1000)
        self.assertGreater(sum(max(rgb) - min(rgb) > 40 for *rgb, _ in a), len(a) // 20)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
