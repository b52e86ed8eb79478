# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The page to play with keys, fingers and files: play_use_test.py TOOL CHROMIUM AXE PAGE [TEST ...]

As play_test.py.
"""

import json
import sys

sys.dont_write_bytecode = True
from play_page import PlayTest, main  # noqa: E402 (after the line above)


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
        self.check_tab(page, 20, "canvas, button:enabled, input:enabled, select:enabled")

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
        page.run("location.hash = '#preset=spiral&number=50'")
        page.call("Page.reload")
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


if __name__ == "__main__":
    main(__doc__)
