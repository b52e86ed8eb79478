# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pages made by the tool, and what the tests of pages share."""

import contextlib
import csv
import io
import math
import pathlib
import random
import subprocess
import tempfile
import unittest

from browser import Browser

NONE = 0xFFFFFFFF


class PageTest(unittest.TestCase):
    """Has a folder, the tool and a browser. `settings` is set by the main program."""

    settings = None

    @classmethod
    def setUpClass(cls):
        with contextlib.ExitStack() as stack:
            cls.folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
            cls.browser = stack.enter_context(Browser(cls.settings.chromium))
            cls.addClassCleanup(stack.pop_all().close)

    def tool(self, *arguments):
        """What the tool prints."""
        done = subprocess.run([self.settings.tool, *map(str, arguments)], text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def table(self, name, rows, header="x,y,z"):
        """A file of rows of numbers."""
        path = self.folder / name
        lines = [header, *(",".join(cell if isinstance(cell, str) else repr(cell) for cell in row) for row in rows)]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    def generated(self, kind, number, *options, ending=".csv"):
        path = self.folder / f"{kind}{ending}"
        self.tool("generate", kind, "-n", number, "-o", path, "--quiet", *options)
        return path

    def page(self, sites, *options, size=(800, 600), **more):
        """The page of a file of sites, drawn; it fails where the console has errors when the test ends."""
        html = self.folder / "page.html"
        self.tool("plot", sites, "-o", html, "--quiet", *options)
        page = self.browser.open(html, *size, **more)
        self.addCleanup(page.close)
        self.addCleanup(lambda: self.assertEqual(page.errors(), []))
        page.wait_until_drawn()
        return page

    def check_access(self, page):
        """axe finds nothing serious in the page as it is now."""
        page.run(pathlib.Path(self.settings.axe).read_text(encoding="utf-8") + ";0")
        passed, found = page.run(
            "axe.run().then(({ passes, violations }) =>"
            " [passes.length, violations.map((v) => [v.impact, v.id, v.nodes.map((n) => n.html)])])"
        )
        self.assertGreater(passed, 15)
        self.assertEqual([entry for entry in found if entry[0] in ("serious", "critical")], [])

    def check_tab(self, page, least, controls="canvas, button, input, select"):
        """More than so many controls are shown, and the tabulator key reaches all of them in their order."""
        page.run("document.activeElement.blur()")
        reached = []
        for _ in range(30):
            page.call("Input.dispatchKeyEvent", type="keyDown", key="Tab", code="Tab", windowsVirtualKeyCode=9)
            page.call("Input.dispatchKeyEvent", type="keyUp", key="Tab", code="Tab", windowsVirtualKeyCode=9)
            reached.append(page.run("document.activeElement.id"))
        shown = page.run(
            f"[...document.querySelectorAll('{controls}')].filter((e) => e.offsetParent !== null).map((e) => e.id)"
        )
        self.assertGreater(len(shown), least)
        self.assertEqual(reached[: len(shown)], shown)

    def queries(self, queries, command, sites, *options):
        """The rows that `rondel nearest` or `rondel locate` answers for points."""
        path = self.table("queries.csv", queries)
        return list(csv.DictReader(io.StringIO(self.tool(command, sites, path, *options))))


def directions(number, seed=1, around=None, width=0.0):
    """Random unit vectors, all over the sphere or about so far from `around` in radians."""
    source = random.Random(seed)
    result = []
    for _ in range(number):
        p = [source.gauss(0, 1) for _ in range(3)]
        if around is not None:
            p = [a + width * x for a, x in zip(around, p)]
        length = math.sqrt(sum(x * x for x in p))
        result.append([x / length for x in p])
    return result
