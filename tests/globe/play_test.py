# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The page to play, which scripts/build-js makes, in a browser without a screen.

    play_test.py TOOL CHROMIUM AXE PAGE TEST

AXE is axe.min.js of the npm package axe-core; TEST a class of this file.
"""

import argparse
import json
import random
import sys
import unittest

sys.dont_write_bytecode = True
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


class Edits(PlayTest):
    """Mouse and tools: sites are dragged, added, removed; undo and redo."""

    def test_a_dragged_site_is_where_it_was_let_go(self):
        page = self.play()
        before = self.sites(page)
        view = page.run("rondelGlobe.camera.forward")
        site = self.site_near(page, 430, 265)
        x, y = self.pixel(page, site)
        page.run("rondelGlobe.history.past.length = 0; document.getElementById('hint').hidden = false")
        self.drag(page, x + 2, y - 1, 70, -40)
        self.assertTrue(page.run("document.getElementById('hint').hidden"))
        x_now, y_now = self.pixel(page, site)
        self.assertLess(abs(x_now - x - 70) + abs(y_now - y + 40), 1e-6)
        self.assertEqual(page.run("rondelGlobe.camera.forward"), view)
        after = self.sites(page)
        self.assertEqual([key for key in range(len(before)) if before[key] != after[key]], [site])
        self.compare(page)
        page.run("rondelGlobe.undo()")
        self.compare(page)
        self.assertEqual(self.sites(page), before)
        page.run("rondelGlobe.redo()")
        self.compare(page)
        self.assertEqual(self.sites(page), after)

    def test_elsewhere_the_globe_turns(self):
        page = self.play("spiral", 12)
        before = self.sites(page)
        view = page.run("rondelGlobe.camera.forward")
        x, y = next(
            (x, y)
            for x in range(310, 510, 10)
            for y in range(185, 385, 10)
            if page.run(f"rondelGlobe.siteAt({x}, {y}, 'mouse')") == 0xFFFFFFFF
        )
        self.drag(page, x, y, 60, 30)
        self.assertNotEqual(page.run("rondelGlobe.camera.forward"), view)
        self.assertEqual(self.sites(page), before)

    def test_double_clicks_add_and_remove(self):
        page = self.play("spiral", 50)
        x, y = 410.0, 275.0
        while page.run(f"rondelGlobe.siteAt({x}, {y}, 'mouse')") != 0xFFFFFFFF:
            x += 7
        page.double_click(x, y)
        page.wait("rondelGlobe.about.sites === 51")
        self.compare(page)
        self.assertEqual(page.run("rondelGlobe.picked.site"), 50)
        self.assertLess(sum(abs(a - b) for a, b in zip(self.pixel(page, 50), (x, y))), 1e-6)
        page.double_click(x, y)
        page.wait("rondelGlobe.about.sites === 50")
        self.compare(page)
        for count in (51, 50):
            page.run("rondelGlobe.undo()")
            page.wait(f"rondelGlobe.about.sites === {count}")
            self.compare(page)

    def test_tools(self):
        page = self.play("empty")
        page.run("document.getElementById('tool-add').click()")
        places = [(410, 285), (470, 235), (340, 225), (380, 355), (500, 345)]
        for number, place in enumerate(places, 1):
            page.click(*place)
            page.wait(f"rondelGlobe.about.sites === {number}")
            self.compare(page)
        page.run("document.getElementById('tool-remove').click()")
        for number, place in zip((4, 3, 2, 1, 0), places):
            page.click(*place)
            page.wait(f"rondelGlobe.about.sites === {number}")
            self.compare(page)
        for _ in range(10):
            page.run("document.getElementById('undo').click()")
        self.settle(page)
        self.assertTrue(all(row is None for row in self.sites(page)))
        for _ in range(5):
            page.run("document.getElementById('redo').click()")
        self.settle(page)
        self.assertEqual(page.run("rondelGlobe.about.sites"), 5)
        self.compare(page)

    def test_many_changes_in_every_preset(self):
        page = self.play()
        source = random.Random(7)
        for preset in PRESETS:
            with self.subTest(preset):
                self.choose(page, "preset", preset)
                self.compare(page)
                for i in range(20):
                    place = [source.gauss(0, 1) for _ in range(3)]
                    length = sum(x * x for x in place) ** 0.5
                    place = [x / length for x in place]
                    there = [key for key, row in enumerate(self.sites(page)) if row is not None]
                    kind = source.choice(("insert", "move", "move", "remove")) if there else "insert"
                    if kind == "insert":
                        page.run(f"rondelGlobe.insert({place})")
                    elif kind == "remove":
                        page.run(f"rondelGlobe.remove({source.choice(there)})")
                    else:
                        page.run(f"rondelGlobe.set('move', {source.choice(there)}, {place})")
                    if i % 4 == 0:
                        self.settle(page)
                self.compare(page)

    def test_circles_grow_and_shrink(self):
        page = self.play("circles", 50)
        page.run("rondelGlobe.goTo(rondelGlobe.finder.nearest(rondelGlobe.camera.forward))")
        self.settle(page)
        site = page.run("rondelGlobe.picked.site")
        before = page.run(f"rondelGlobe.radii[{site}]")
        area = page.run(f"rondelGlobe.surface.areas[{site}]")
        page.run("document.getElementById('globe').focus()")
        page.key("]", "]")
        page.wait(f"rondelGlobe.radii[{site}] > 1.05 * {before}")
        self.assertAlmostEqual(page.run(f"rondelGlobe.radii[{site}]") / before, 1.1, places=9)
        self.assertGreater(page.run(f"rondelGlobe.surface.areas[{site}]"), area)
        self.compare(page)
        page.key("[", "[")
        page.wait(f"rondelGlobe.radii[{site}] < 1.05 * {before}")
        self.compare(page)

    def test_sites_relax(self):
        page = self.play("random", 200)
        self.choose(page, "fill", "area")
        before = self.sites(page)
        spread = "Math.max(...rondelGlobe.surface.areas) / Math.min(...rondelGlobe.surface.areas)"
        uneven = page.run(spread)
        page.run("document.getElementById('relax').click()")
        page.wait(f"{spread} < {uneven / 4}")
        page.run("document.getElementById('relax').click()")
        self.compare(page)
        low, high = page.run("rondelGlobe.layers.range")
        self.assertEqual(page.run("Math.min(...rondelGlobe.surface.areas)"), low)
        self.assertEqual(page.run("Math.max(...rondelGlobe.surface.areas)"), high)
        page.run("document.getElementById('undo').click()")
        self.settle(page)
        self.assertEqual(self.sites(page), before)


class Drawing(PlayTest):
    """What is sent to the screen is the triangulation as it is, and only what changed is sent."""

    COUNTS = (
        "(() => { const { chunks } = rondelGlobe.scene; const counts = {};"
        " for (const { parts } of chunks) for (const [name, part] of Object.entries(parts ?? {}))"
        " counts[name] = (counts[name] ?? 0) + part.count; return counts; })()"
    )

    def everything(self, page):
        """Lines and corners in all buffers, those of the far side too, which the page makes when they are seen."""
        page.run(
            "for (const chunk of rondelGlobe.scene.chunks) { chunk.isUrgent = true;"
            " for (const name of rondelGlobe.scene.wanted) rondelGlobe.scene.part(chunk, name); }"
        )
        return page.run(self.COUNTS)

    def test_buffers_after_changes_are_those_of_the_sites(self):
        page = self.play("random", 2000)
        page.run("document.getElementById('show-circles').click()")
        self.choose(page, "fill", "neighbors")
        self.everything(page)
        source = random.Random(3)
        for i in range(12):
            there = [key for key, row in enumerate(self.sites(page)) if row is not None]
            key = source.choice(there)
            place = [source.uniform(-1, 1) for _ in range(3)]
            page.run(f"rondelGlobe.set('{'remove' if i % 4 == 0 else 'move'}', {key}, {place if i % 4 else 'null'})")
            self.settle(page)
        changed = self.everything(page)
        self.assertEqual(set(changed), {"cells", "edges", "borders", "circles"})
        sites = json.dumps([row for row in self.sites(page) if row is not None])
        page.run(f"rondelGlobe.start({{ xyz: {sites}.flat() }})")
        self.settle(page)
        fresh = self.everything(page)
        for name in ("edges", "borders", "cells"):
            self.assertEqual(changed[name], fresh[name], name)
        # The chords of a circle depend on its radius in its last digit.
        self.assertLess(abs(changed["circles"] - fresh["circles"]), 0.001 * fresh["circles"])

    def test_a_move_leaves_most_buffers_alone(self):
        page = self.play("spiral", 2000)
        self.everything(page)
        page.run("window.kept = new Set(rondelGlobe.scene.chunks.map((chunk) => chunk.parts))")
        page.run("rondelGlobe.set('move', 1000, rondelGlobe.surface.direction(1001).map((x, k) => x + 1e-3 * k))")
        self.settle(page)
        total, same = page.run(
            "[rondelGlobe.scene.chunks.length, rondelGlobe.scene.chunks.filter(({ parts }) => parts && kept.has(parts)).length]"
        )
        self.assertGreater(total, 10)
        self.assertGreater(same, 0.5 * total)
        self.assertLess(same, total)

    def test_circles_and_cell_below_the_pointer(self):
        page = self.play("spiral", 200)
        site = self.site_near(page, 430, 265)
        x, y = self.pixel(page, site)
        page.mouse("mouseMoved", x, y)
        page.wait("rondelGlobe.scene.circled.length > 0")
        circles = page.run("rondelGlobe.scene.circled")
        self.assertEqual(len(circles), page.run(f"rondelGlobe.surface.neighborsOf({site}).length"))
        # No site is inside a circle of the triangulation.
        nearest = page.run(
            "rondelGlobe.scene.circled.map(({ axis, radius }) => Math.min(...rondelGlobe.points.map((p) =>"
            " 2 * Math.asin(Math.hypot(p[0] - axis[0], p[1] - axis[1], p[2] - axis[2]) / 2))) / radius)"
        )
        for ratio in nearest:
            self.assertAlmostEqual(ratio, 1, places=9)
        self.assertIn("km\u00b2", page.run("document.getElementById('stat-cell').textContent"))

    def test_a_lost_context_comes_back(self):
        page = self.play("spiral", 200)
        row = (
            "(() => { const { gl } = rondelGlobe.canvas; rondelGlobe.drawNow(); const bytes = new Uint8Array(3280);"
            " gl.readPixels(0, 285, 820, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes); return [...bytes]; })()"
        )
        before = page.run(row)
        page.run("window.loss = rondelGlobe.canvas.gl.getExtension('WEBGL_lose_context'); loss.loseContext()")
        page.wait("rondelGlobe.canvas.gl.isContextLost()")
        page.run("rondelGlobe.set('move', 0, rondelGlobe.points[0])")
        self.settle(page)
        page.run("loss.restoreContext()")
        page.wait("!rondelGlobe.canvas.gl.isContextLost()")
        self.settle(page)
        self.assertEqual(page.run(row), before)


class Hands(PlayTest):
    """Keys and fingers."""

    def test_keys(self):
        page = self.play("spiral", 50)
        page.run("document.getElementById('globe').focus()")
        page.key("a", "a")
        page.wait("rondelGlobe.about.sites === 51")
        page.key("Delete")
        page.wait("rondelGlobe.about.sites === 50")
        page.call("Input.dispatchKeyEvent", type="keyDown", key="z", modifiers=2)
        page.wait("rondelGlobe.about.sites === 51")
        self.compare(page)
        before = self.sites(page)
        page.key("Enter")
        page.wait("rondelGlobe.isHeldByKeys && rondelGlobe.isSettled")
        held = page.run("rondelGlobe.held.site")
        self.assertEqual(self.sites(page), before)
        page.key("ArrowRight")
        page.wait(f"rondelGlobe.points[{held}].some((x, k) => x !== {json.dumps(before[held])}[k])")
        page.key("Enter")
        page.wait("!rondelGlobe.isHeldByKeys")
        self.compare(page)
        at = self.pixel(page, held)
        self.assertLess(abs(at[0] - 410) + abs(at[1] - 285), 1e-6)
        page.call("Input.dispatchKeyEvent", type="keyDown", key="z", modifiers=2)
        self.settle(page)
        self.assertEqual(self.sites(page), before)

    def test_every_control_is_reached_by_tab(self):
        page = self.play("spiral", 50)
        page.run("document.activeElement.blur()")
        reached = []
        for _ in range(30):
            page.call("Input.dispatchKeyEvent", type="keyDown", key="Tab", code="Tab", windowsVirtualKeyCode=9)
            page.call("Input.dispatchKeyEvent", type="keyUp", key="Tab", code="Tab", windowsVirtualKeyCode=9)
            reached.append(page.run("document.activeElement.id"))
        shown = page.run(
            "[...document.querySelectorAll('canvas, button, input, select')]"
            ".filter((e) => e.offsetParent !== null && !e.disabled).map((e) => e.id)"
        )
        self.assertGreater(len(shown), 20)
        self.assertEqual(reached[: len(shown)], shown)

    def test_fingers(self):
        page = self.play("spiral", 50, size=(390, 780), touch=True)
        site = self.site_near(page, 190, 380)
        x, y = self.pixel(page, site)
        page.touch("touchStart", (x + 8, y + 8))
        for d in range(6, 50, 6):
            page.touch("touchMove", (x + 8 + d, y + 8))
        page.touch("touchEnd")
        self.settle(page)
        x_now, y_now = self.pixel(page, site)
        self.assertLess(abs(x_now - x - 48) + abs(y_now - y), 1)
        self.compare(page)
        zoom = page.run("rondelGlobe.camera.zoom")
        page.touch("touchStart", (x_now, y_now))
        page.touch("touchStart", (x_now, y_now), (x_now + 60, y_now))
        for d in range(10, 70, 10):
            page.touch("touchMove", (x_now, y_now), (x_now + 60 + d, y_now))
        page.touch("touchEnd")
        self.settle(page)
        self.assertAlmostEqual(page.run("rondelGlobe.camera.zoom") / zoom, 2, delta=0.01)
        free = next(
            (a, b)
            for a in range(100, 300, 7)
            for b in range(300, 380, 7)
            if page.run(f"rondelGlobe.siteAt({a}, {b}, 'touch')") == 0xFFFFFFFF
        )
        page.double_tap(*free)
        page.wait("rondelGlobe.about.sites === 51")
        self.compare(page)


class Files(PlayTest):
    """Tables in and out."""

    def read(self, page, text, name="sites.csv"):
        page.run(
            f"(() => {{ const data = new DataTransfer(); data.items.add(new File([{json.dumps(text)}], {json.dumps(name)}));"
            " document.dispatchEvent(new DragEvent('drop', { dataTransfer: data })); })()"
        )
        page.run("new Promise((resolve) => setTimeout(resolve, 50))")
        self.settle(page)

    def saved(self, page):
        page.run(
            "window.saved = new Promise((resolve) => { const real = URL.createObjectURL;"
            " URL.createObjectURL = (blob) => { blob.text().then(resolve); URL.createObjectURL = real;"
            " return real.call(URL, blob); }; }); document.getElementById('save-table').click()"
        )
        return page.run("saved")

    def test_longitude_and_latitude(self):
        page = self.play("empty")
        rows = ["name;Latitude;lng"] + [f'"Place ""{i}""; here";{i * 13 % 170 - 85};{i * 37 % 360}' for i in range(60)]
        self.read(page, "\ufeff" + "\r\n".join(rows) + "\r\n")
        self.assertEqual(page.run("rondelGlobe.about.sites"), 60)
        self.compare(page)
        table = self.table("places.csv", [[i * 37 % 360, i * 13 % 170 - 85] for i in range(60)], "lon,lat")
        self.tool("voronoi", table, "-o", self.folder / "places.npz", "--quiet")
        import numpy

        areas = numpy.load(self.folder / "places.npz")["areas"].tolist()
        self.assertEqual(page.run("[...rondelGlobe.surface.areas]"), areas)

    def test_what_is_saved_is_what_there_is(self):
        page = self.play("metre")
        page.run("rondelGlobe.remove(17)")
        self.settle(page)
        sites = [row for row in self.sites(page) if row is not None]
        text = self.saved(page)
        self.read(page, text)
        self.assertEqual(self.sites(page), sites)
        path = self.folder / "saved.csv"
        path.write_text(text, encoding="utf-8")
        self.assertIn('"sites":499', self.tool("delaunay", path, "-o", self.folder / "saved.npy", "--json").replace(" ", ""))
        page.run("rondelGlobe.undo()")
        self.settle(page)
        self.assertEqual(len(self.sites(page)), 500)

    def test_circles(self):
        page = self.play("empty")
        self.read(page, "lon,lat,radius\n" + "\n".join(f"{i * 37 % 360},{i * 13 % 170 - 85},{5 + i % 20}" for i in range(80)))
        self.assertEqual(page.run("rondelGlobe.about.model"), "weighted")
        self.compare(page)

    def test_the_address_says_what_to_begin_with(self):
        page = self.play()
        page.run("location.hash = '#preset=spiral&number=50'; location.reload()")
        page.wait("document.readyState === 'complete' && window.rondelGlobe?.about.sites === 50")
        self.assertEqual(page.run("document.getElementById('preset').value"), "spiral")

    def test_mistakes_are_told(self):
        page = self.play("spiral", 12)
        before = self.sites(page)
        for text, message in [
            ("a,b\n1,2\n", "columns lon and lat"),
            ("lon,lat\n1,2\n3,north\n", 'line 3: "north" is no number'),
            ("lon,lat\n1,2\n3,91\n", "91"),
            ("x,y,z\n1,2,3\n0,0,0\n", "site 1"),
            ("lon,lat,radius\n1,2,95\n", "95"),
        ]:
            with self.subTest(text):
                self.read(page, text)
                self.assertFalse(page.run("document.getElementById('failure').hidden"))
                self.assertIn(message, page.run("document.getElementById('failure').textContent"))
                self.assertEqual(self.sites(page), before)
                self.compare(page)


class Access(PlayTest):
    """axe finds nothing serious; light and dark, on a phone."""

    def test_light_and_dark(self):
        for dark in (False, True):
            page = self.play("random", 200, dark=dark)
            self.choose(page, "fill", "neighbors")
            page.click(410, 285)
            self.settle(page)
            self.check_access(page)
            page.run("document.getElementById('help-open').click(); document.querySelector('details').open = true")
            self.check_access(page)

    def test_on_a_phone(self):
        page = self.play("random", 50, size=(390, 780), touch=True)
        page.run("document.getElementById('fold').click()")
        self.check_access(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("tool", "chromium", "axe", "page", "test"):
        parser.add_argument(name)
    PageTest.settings = parser.parse_args()
    unittest.main(argv=[sys.argv[0], "-v", PageTest.settings.test])


if __name__ == "__main__":
    main()
