# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The page to play, in a browser without a screen: what a change does. scripts/site --test runs it.

    play_test.py TOOL CHROMIUM AXE PAGE [TEST ...]

AXE is axe.min.js of the npm package axe-core; a TEST is a class of this file or one of its methods.
"""

import json
import random
import sys

sys.dont_write_bytecode = True
from play_page import PRESETS, PlayTest, main  # noqa: E402 (after the line above)


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


if __name__ == "__main__":
    main(__doc__)
