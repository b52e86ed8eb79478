# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pages of `rondel plot` in a browser without a screen.

    globe_test.py TOOL CHROMIUM AXE TEST

AXE is axe.min.js of the npm package axe-core, or empty; TEST a class of this file.
"""

import argparse
import json
import math
import sys
import unittest

sys.dont_write_bytecode = True
from pages import NONE, PageTest, directions  # noqa: E402 (after the line above)

# The ends of the color map, and the backgrounds.
DARKEST, LIGHTEST = (23, 46, 97), (251, 245, 219)
LIGHT_SKY, DARK_SKY = (244, 246, 249), (11, 15, 23)


class Opens(PageTest):
    """Any input has a page that opens from file:// and says what is there."""

    def test_every_input(self):
        inputs = {
            "none": ([], "of 0 sites. There is no site."),
            "one": ([[1, 0, 0]], "of 1 site. All sites are in one place"),
            "two": ([[1, 0, 0], [0, 1, 0]], "on one great circle"),
            "antipodes": ([[1, 0, 0], [-1, 0, 0]], "on one great circle"),
            "circle": ([[1, 0, 0], [0, 1, 0], [-1, 0.5, 0], [1, 0, 0]], "3 vertices, 1 duplicate"),
            "patch": ([[1, 0, 0], [1, 0.1, 0], [1, 0, 0.1], [1, 0.2, 0.1]], "2 ghost faces"),
            "huge": ([[1e200, 0, 0], [0, 1e-200, 0], [0, 0, 1], [-1, -1, -1]], "4 sites, 4 triangles."),
        }
        for name, (rows, text) in inputs.items():
            with self.subTest(name):
                page = self.page(self.table(f"{name}.csv", rows), "--show", "both", "--fill", "area")
                self.assertEqual(page.run("document.documentElement.dataset.state"), "ready")
                self.assertIn(text, page.run("document.getElementById('summary').textContent"))
                page.click(400, 300)
                page.wait_until_drawn()

    def test_hidden_sites_and_circles(self):
        sites = self.generated("circles", 60, "--angle", 30)
        page = self.page(sites, "--radius", "radius", "--circles", "--show", "both")
        self.assertIn("hidden", page.run("document.getElementById('summary').textContent"))
        hidden = page.run("[...rondelGlobe.surface.faceAbove.keys()][0]")
        page.run(f"rondelGlobe.goTo({hidden})")
        page.wait_until_drawn()
        self.assertIn("Hidden", page.run("document.getElementById('card').textContent"))

    def test_light_and_dark(self):
        sites = self.generated("uniform", 50)
        corner = "pixels(5, 595)[0]"
        page = self.page(sites, dark=True)
        self.assertEqual(tuple(read(page, corner)), DARK_SKY)
        page.run("document.getElementById('theme').click()")
        page.wait_until_drawn()
        self.assertEqual(tuple(read(page, corner)), LIGHT_SKY)
        page.set_dark(False)
        page.run("new Promise(requestAnimationFrame).then(() => 0)")
        page.set_dark(True)
        page.wait("document.documentElement.dataset.theme === 'dark'")

    def test_a_page_reaches_nothing_else(self):
        page = self.page(self.generated("uniform", 50))
        refused = "fetch('data:,').then(() => 'taken', () => 'refused')"
        page.run(f"{refused}.then((answer) => {{ window.answer = answer; }})")
        self.assertEqual(page.run("window.answer"), "refused")
        page.browser.events.clear()  # the refusal is on the console


def read(page, expression):
    """An expression that may use pixels(x, y, width): rows of colors of the picture as it is now."""
    return page.run(
        "(() => { const { gl } = rondelGlobe.canvas; rondelGlobe.drawNow();"
        " const pixels = (x, y, width = 1) => { const bytes = new Uint8Array(4 * width);"
        " gl.readPixels(x, gl.drawingBufferHeight - 1 - y, width, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);"
        " return Array.from({ length: width }, (_, i) => Array.from(bytes.subarray(4 * i, 4 * i + 3))); };"
        f" return {expression}; }})()"
    )


class Picks(PageTest):
    """What is picked is what the library's nearest and locate tell."""

    def compare(self, sites, queries, *options):
        page = self.page(sites, *options)
        picked = page.run(f"{json.dumps(queries)}.map((q) => rondelGlobe.pick(q)).map((p) => [p.site, p.face])")
        nearest = [int(row["site"]) for row in self.queries(queries, "nearest", sites, *options)]
        faces = [int(row["face"] or NONE) for row in self.queries(queries, "locate", sites, *options)]
        self.assertEqual([site for site, _ in picked], nearest)
        self.assertEqual([face for _, face in picked], faces)
        return faces

    def test_all_over_the_sphere(self):
        self.compare(self.generated("uniform", 3000), directions(200))

    def test_of_circles(self):
        self.compare(self.generated("circles", 1000, "--angle", 8), directions(200), "--radius", "radius")

    def test_in_ten_metres(self):
        around = [0.6, 0.48, 0.64]
        sites = self.table("metres.csv", directions(300, 2, around, 1e-6) + directions(300, 3))
        self.compare(sites, directions(200, 4, around, 1e-6))

    def test_on_one_side_of_the_globe(self):
        sites = self.table("side.csv", directions(200, 5, [0.0, 0.6, 0.8], 0.2))
        faces = self.compare(sites, directions(200, 6))
        self.assertIn(NONE, faces)

    def test_by_the_mouse(self):
        sites = self.generated("uniform", 500)
        page = self.page(sites)
        for x, y in [(400, 300), (450, 200), (500, 420), (330, 480)]:
            page.click(x, y)
            page.wait_until_drawn()
            place = page.run("rondelGlobe.picked.place")
            (nearest,) = self.queries([place], "nearest", sites)
            (located,) = self.queries([place], "locate", sites)
            self.assertEqual(page.run("document.querySelector('#card h2').textContent"), f"Site {nearest['site']}")
            self.assertIn(f"Triangle {located['face']}", page.run("document.getElementById('card').textContent"))
            at = page.run("rondelGlobe.camera.pixelOf(rondelGlobe.picked.place)")
            self.assertLess(math.hypot(at["x"] - x, at["y"] - y), 1e-6)

    def test_the_points_are_those_of_the_library_bit_for_bit(self):
        sites = self.generated("circles", 300, "--angle", 8)
        cells = self.folder / "cells.npz"
        self.tool("voronoi", sites, "--radius", "radius", "-o", cells, "--quiet")
        page = self.page(sites, "--radius", "radius")
        import numpy

        points = numpy.array(page.run("Array.from(rondelGlobe.surface.points)")).reshape(-1, 3)
        self.assertTrue(numpy.array_equal(points, numpy.load(cells)["points"]))


class Pixels(PageTest):
    """The picture, at all zooms."""

    OCTAHEDRON = [[1, 0, 0, 0], [-1, 0, 0, 5], [0, 1, 0, 10], [0, -1, 0, "nan"], [0, 0, 1, 10], [0, 0, -1, 10]]

    def near(self, color, wanted, tolerance=6):
        self.assertLessEqual(max(abs(a - b) for a, b in zip(color, wanted)), tolerance, (color, wanted))

    def test_of_an_octahedron(self):
        rows = [[*row[:3], "" if row[3] == "nan" else float(row[3])] for row in self.OCTAHEDRON]
        sites = self.table("octahedron.csv", rows, "x,y,z,height")
        page = self.page(sites, "--values", "height", "--view", 0, 0, "--graticule", 0, "--no-sites")
        page.run("for (const id of ['show-coast', 'show-borders']) document.getElementById(id).click()")
        page.wait_until_drawn()
        radius = page.run("rondelGlobe.camera.zoom")
        row = read(page, "pixels(0, 300, 800)")
        at = {x: row[round(400 + x * radius)] for x in (-1.1, -0.9, -0.6, 0, 0.6, 0.9, 1.1)}
        for x in (-0.6, 0, 0.6):
            self.near(at[x], DARKEST)
        self.near(at[0.9], LIGHTEST)
        self.near(at[-0.9], (201, 208, 218))  # a cell without a value
        for x in (-1.1, 1.1):
            self.assertGreater(min(at[x]), 150)
        # The border between the cells is seen at 45 degrees.
        change = next(x for x in range(400, 800) if sum(row[x]) > 400)
        self.assertLessEqual(abs(change - (400 + radius * math.sqrt(0.5))), 1.5)

    def test_of_isolines(self):
        values = [1, 3, 3, 1, 2.5, 1.5]  # from 1 at longitude 0 to 3 at 90: 2 is at 45
        rows = [[*row[:3], value] for row, value in zip(self.OCTAHEDRON, values)]
        sites = self.table("isolines.csv", rows, "x,y,z,height")
        options = ["--values", "height", "--view", 45, 0, "--graticule", 0, "--no-sites"]
        plain = self.page(sites, *options)
        self.assertTrue(plain.run("document.getElementById('show-isolines').closest('label').hidden"))
        page = self.page(sites, *options, "--contours", 2)
        self.assertFalse(page.run("document.getElementById('show-isolines').closest('label').hidden"))
        page.run("for (const id of ['show-coast', 'show-borders']) document.getElementById(id).click()")
        for zoom in (1, 300_000):
            page.run(f"rondelGlobe.zoomBy({zoom} * 250 / rondelGlobe.camera.zoom)")
            page.wait_until_drawn()
            with_lines = read(page, "pixels(390, 300, 21)")
            page.run("document.getElementById('show-isolines').click()")
            page.wait_until_drawn()
            without = read(page, "pixels(390, 300, 21)")
            page.run("document.getElementById('show-isolines').click()")
            changed = [i for i, (a, b) in enumerate(zip(with_lines, without)) if sum(a) < sum(b) - 100]
            self.assertTrue(changed, zoom)
            self.assertLessEqual(max(abs(i - 10) for i in changed), 2)

    def test_a_lost_context_comes_back(self):
        page = self.page(self.generated("uniform", 300), "--fill", "area", "--show", "both")
        row = "pixels(0, 300, 800)"
        before = read(page, row)
        lose = "window.loss = rondelGlobe.canvas.gl.getExtension('WEBGL_lose_context')"
        page.run(f"{lose}; loss.loseContext(); rondelGlobe.redraw()")
        page.wait("rondelGlobe.canvas.gl.isContextLost()")
        page.wait_until_drawn()
        page.run("loss.restoreContext()")
        page.wait("!rondelGlobe.canvas.gl.isContextLost()")
        page.wait_until_drawn()
        self.assertGreater(len({tuple(color) for color in before}), 20)
        self.assertEqual(read(page, row), before)

    def test_does_not_shake_at_any_zoom(self):
        """The border of two sites a metre apart is where it is, while the globe is turned under it."""
        half = 0.5 / 6371008.8
        rows = [[1, half, 0, 0.0], [1, -half, 0, 1.0], [-1, 0.3, 0.2, 1.0], [0, 0, 1, 0.0], [0, 0.1, -1, 0.0]]
        sites = self.table("metre.csv", rows, "x,y,z,side")
        page = self.page(sites, "--values", "side", "--no-sites", "--graticule", 0, size=(400, 200))
        page.run("for (const id of ['show-coast', 'show-borders']) document.getElementById(id).click()")
        for zoom in (1e4, 1e6, 1e8, 1e10, 1e12):
            for pixels in (-120, -40.3, 0.4, 77.7):
                page.run(
                    f"rondelGlobe.camera.face([1, 0, 0], 0); rondelGlobe.camera.setZoom({zoom});"
                    f"rondelGlobe.camera.pan({pixels}, 0)"
                )
                row = read(page, "pixels(0, 100, 400)")
                while not page.run("rondelGlobe.scene.isSettled"):
                    row = read(page, "pixels(0, 100, 400)")
                change = next(x for x in range(400) if sum(row[x]) < 400)
                self.assertLessEqual(abs(change - (200 + pixels)), 1, (zoom, pixels))


class Events(PageTest):
    """Mouse, wheel, fingers, keys, search, and the picture that is saved."""

    def test_mouse(self):
        page = self.page(self.generated("uniform", 300), "--view", 0, 0)
        grabbed = page.run("rondelGlobe.camera.placeAt(420, 300)")
        page.mouse("mousePressed", 420, 300, button="left", clickCount=1)
        for x in range(430, 540, 10):
            page.mouse("mouseMoved", x, 320, button="left", buttons=1)
        page.mouse("mouseReleased", 530, 320, button="left", clickCount=1)
        page.wait_until_drawn()
        at = page.run(f"rondelGlobe.camera.pixelOf({json.dumps(grabbed)})")
        self.assertLess(math.hypot(at["x"] - 530, at["y"] - 320), 0.01)
        self.assertLess(abs(page.run("rondelGlobe.camera.bearing")), 1e-6)
        zoom = page.run("rondelGlobe.camera.zoom")
        held = page.run("rondelGlobe.camera.placeAt(300, 250)")
        page.mouse("mouseWheel", 300, 250, deltaX=0, deltaY=-120)
        page.wait(f"rondelGlobe.camera.zoom > {zoom} * 1.1")
        at = page.run(f"rondelGlobe.camera.pixelOf({json.dumps(held)})")
        self.assertLess(math.hypot(at["x"] - 300, at["y"] - 250), 0.01)

    def test_keys(self):
        page = self.page(self.generated("uniform", 300), "--view", 0, 0)
        page.run("document.getElementById('globe').focus()")
        middle = "rondelGlobe.camera.forward"
        page.key("ArrowRight")
        page.wait(f"{middle}[1] > 0.1")
        page.key("ArrowUp")
        page.wait(f"{middle}[2] > 0.1")
        zoom = page.run("rondelGlobe.camera.zoom")
        page.key("+", "+")
        page.wait(f"rondelGlobe.camera.zoom > 1.3 * {zoom}")
        page.key("-", "-")
        page.wait(f"Math.abs(rondelGlobe.camera.zoom - {zoom}) < 1e-9 * {zoom}")
        page.key("Enter")
        page.wait("!document.getElementById('card').hidden")
        page.key("Escape")
        page.wait("document.getElementById('card').hidden")
        page.run("rondelGlobe.camera.roll(30)")
        page.key("n", "n")
        page.wait("Math.abs(rondelGlobe.camera.bearing) < 1e-9")
        page.key("Home")
        page.wait(f"Math.hypot({middle}[1], {middle}[2]) < 1e-12")
        page.key("?", "?")
        page.wait("document.getElementById('help').open")

    def test_every_control_is_reached_by_tab(self):
        page = self.page(self.generated("uniform", 300))
        self.check_tab(page, 14)

    def test_fingers(self):
        page = self.page(self.generated("uniform", 300), "--view", 0, 0, size=(390, 780), touch=True)
        self.assertTrue(page.run("document.getElementById('panel-content').hidden"))
        grabbed = page.run("rondelGlobe.camera.placeAt(200, 400)")
        page.touch("touchStart", (200, 400))
        for x in range(210, 260, 10):
            page.touch("touchMove", (x, 410))
        page.touch("touchEnd")
        page.wait_until_drawn()
        at = page.run(f"rondelGlobe.camera.pixelOf({json.dumps(grabbed)})")
        self.assertLess(math.hypot(at["x"] - 250, at["y"] - 410), 0.01)
        zoom = page.run("rondelGlobe.camera.zoom")
        page.touch("touchStart", (150, 400), (250, 400))
        for d in range(10, 60, 10):
            page.touch("touchMove", (150 - d, 400), (250 + d, 400))
        page.touch("touchEnd")
        page.wait_until_drawn()
        self.assertAlmostEqual(page.run("rondelGlobe.camera.zoom") / zoom, 2, delta=0.01)
        page.touch("touchStart", (195, 390))
        page.touch("touchEnd")
        page.wait("!document.getElementById('card').hidden")

    def test_search(self):
        rows = [[i * 7 % 360, (i * 13 % 170) - 85, f"Place {i}"] for i in range(200)]
        rows[123][2] = '"Köln, ""Dom"""'
        page = self.page(self.table("places.csv", rows, "lon,lat,name"))
        page.run("document.getElementById('search').focus()")
        page.call("Input.insertText", text="köln")
        page.wait("document.querySelectorAll('#found li').length === 1")
        page.key("Enter")
        page.wait("document.querySelector('#card h2').textContent === 'Site 123'")
        self.assertIn('Köln, "Dom"', page.run("document.getElementById('card').textContent"))
        page.wait_until_drawn()
        lon, lat = page.run("((p) => [Math.atan2(p[1], p[0]), Math.asin(p[2])])(rondelGlobe.camera.forward)")
        self.assertAlmostEqual((math.degrees(lon) - rows[123][0]) % 360, 0, places=6)
        self.assertAlmostEqual(math.degrees(lat), rows[123][1], places=6)

    def test_the_picture_is_saved(self):
        page = self.page(self.generated("uniform", 300))
        page.run(
            "window.saved = new Promise((resolve) => { const real = URL.createObjectURL;"
            " URL.createObjectURL = (blob) => { blob.arrayBuffer().then((b) => resolve(Array.from(new Uint8Array(b, 0, 24))));"
            " return real.call(URL, blob); }; }); document.getElementById('save').click()"
        )
        head = bytes(page.run("window.saved"))
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(int.from_bytes(head[16:20], "big"), 800)


class Vertices(PageTest):
    """A million cells: what is sent to the screen is bounded at any zoom."""

    def test_a_million_cells(self):
        page = self.page(self.generated("uniform", 1_000_000, ending=".npy"), "--show", "both", size=(640, 480))
        page.run("rondelGlobe.layers.setFill('area'); rondelGlobe.recolor()")
        ways = set()
        for zoom in (200, 1500, 4000, 30_000, 1e8):
            page.run(f"rondelGlobe.camera.setZoom({zoom}); rondelGlobe.redraw()")
            page.wait_until_drawn()
            seen = page.run("rondelGlobe.scene.statistics")
            self.assertLessEqual(seen["vertices"], 2_000_000, (zoom, seen))
            self.assertGreater(seen["full"] + seen["close"] + seen["coarse"], 0, (zoom, seen))
            ways |= {way for way in ("full", "close", "coarse") if seen[way] > 0}
        self.assertEqual(ways, {"full", "close", "coarse"})


class Access(PageTest):
    """axe finds nothing serious: names, roles, contrast, order."""

    def test_light_and_dark_with_everything_open(self):
        rows = [[i * 7 % 360, (i * 13 % 170) - 85, i] for i in range(200)]
        sites = self.table("places.csv", rows, "lon,lat,height")
        for dark in (False, True):
            page = self.page(sites, "--values", "height", dark=dark)
            page.click(400, 300)
            page.wait_until_drawn()
            self.check_access(page)
            page.run("document.getElementById('help-open').click()")
            self.check_access(page)

    def test_on_a_phone(self):
        page = self.page(self.generated("uniform", 100), size=(390, 780), touch=True)
        page.run("document.getElementById('fold').click()")
        self.check_access(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("tool", "chromium", "axe", "test"):
        parser.add_argument(name)
    PageTest.settings = parser.parse_args()
    unittest.main(argv=[sys.argv[0], "-v", PageTest.settings.test])


if __name__ == "__main__":
    main()
