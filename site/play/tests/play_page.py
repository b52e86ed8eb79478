# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of the page to play have in common."""

import argparse
import json
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tests" / "globe"))
from pages import PageTest  # noqa: E402 (after the line above)

PRESETS = ("spiral", "random", "circles", "grid", "circle", "metre", "empty")


class PlayTest(PageTest):
    """Opens the page, and compares what it shows with what the tool computes of its sites."""

    def play(self, preset="random", number=200, size=(820, 570), **more):
        page = self.browser.open(self.settings.page, *size, **more)
        self.addCleanup(page.close)
        self.addCleanup(lambda: self.assertEqual(page.errors(), []))
        page.wait("['ready', 'failed'].includes(document.documentElement?.dataset.state)")
        self.assertEqual(page.run("document.documentElement.dataset.state"), "ready")
        self.choose(page, "number", number)
        self.choose(page, "preset", preset)
        return page

    def choose(self, page, name, value):
        self.assertTrue(page.run(f"[...document.getElementById('{name}').options].some((o) => o.value === {json.dumps(str(value))})"))
        page.run(
            f"document.getElementById('{name}').value = {json.dumps(str(value))};"
            f"document.getElementById('{name}').dispatchEvent(new Event('change'))"
        )
        self.settle(page)

    def settle(self, page):
        page.wait("rondelGlobe.isSettled")

    def sites(self, page):
        """The sites by key, None where there is none any more."""
        return page.run("rondelGlobe.points")

    def compare(self, page):
        """Faces, areas and hidden sites are those of a build from nothing of the sites as they are."""
        import numpy

        self.settle(page)
        rows = self.sites(page)
        keys = numpy.array([key for key, row in enumerate(rows) if row is not None], dtype=numpy.uint32)
        path = self.table("now.csv", [row for row in rows if row is not None])
        model = page.run("rondelGlobe.about.model")
        cells = self.folder / "now.npz"
        self.tool("voronoi", path, "--model", model, "-o", cells, "--quiet")
        fresh = numpy.load(cells)
        seen = page.run(
            "(({ faces, areas, faceAbove, numSites }) => ({ faces: [...faces], areas: [...areas],"
            " hidden: [...faceAbove.keys()] }))(rondelGlobe.surface)"
        )
        self.assertEqual(seen["faces"], keys[fresh["faces"]].reshape(-1).tolist())
        self.assertEqual([seen["areas"][key] for key in keys], fresh["areas"].tolist())
        self.assertEqual(sorted(seen["hidden"]), sorted(keys[fresh["hidden"][:, 0]].tolist()))
        text = page.run("document.getElementById('stat-sum').textContent")
        self.assertEqual(text, "1.000000000000" if len(keys) else "\u2013")

    def pixel(self, page, site):
        at = page.run(f"rondelGlobe.camera.pixelOf(rondelGlobe.surface.direction({site}))")
        self.assertTrue(at["isFront"])
        return at["x"], at["y"]

    def site_near(self, page, x, y):
        return page.run(f"rondelGlobe.finder.nearest(rondelGlobe.camera.placeAt({x}, {y}))")

    def drag(self, page, x, y, dx, dy, steps=8):
        page.mouse("mousePressed", x, y, button="left", clickCount=1)
        for i in range(1, steps + 1):
            page.mouse("mouseMoved", x + dx * i / steps, y + dy * i / steps, button="left", buttons=1)
        page.mouse("mouseReleased", x + dx, y + dy, button="left", clickCount=1)
        self.settle(page)


def main(about):
    """Runs the tests of a file, or of the classes and methods that the command line names."""
    parser = argparse.ArgumentParser(description=about)
    for name in ("tool", "chromium", "axe", "page"):
        parser.add_argument(name)
    parser.add_argument("tests", nargs="*")
    PageTest.settings = parser.parse_args()
    unittest.main(argv=[sys.argv[0], "-v", *PageTest.settings.tests])
