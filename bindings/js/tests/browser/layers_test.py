# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The layers for MapLibre and deck.gl in Chromium without a screen: the pages of examples/web as they are.

    layers_test.py FOLDER EXAMPLES CHROMIUM TEST [--update]

FOLDER is where the package and what its tests need are installed (build/js), EXAMPLES the pages, TEST a class of this
file. With --update the recorded pictures are those of this run.
"""

import contextlib
import json
import math
import pathlib
import shutil
import sys
import unittest
import zlib

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[3] / "tests" / "globe"))
from browser import Browser  # noqa: E402 (after the lines above)
from server import Server  # noqa: E402

UPDATE = "--update" in sys.argv
FOLDER, EXAMPLES, CHROMIUM, TEST = [argument for argument in sys.argv[1:] if argument != "--update"]
RECORDED = HERE / "layers.json"
SIZE = (600, 450)
STOPS = ["172e61", "265e8f", "35909f", "6fbf9c", "c5dfa5", "fbf5db"]  # default colors of the layers
GROUND = {"maplibre": (0x26, 0x32, 0x4A), "deck": (0x10, 0x15, 0x1F)}


def ramp(t):
    """The color of a value from 0 to 1."""
    place = min(max(t, 0), 1) * (len(STOPS) - 1)
    k = min(int(place), len(STOPS) - 2)
    low, high = ([int(stop[i : i + 2], 16) for i in (0, 2, 4)] for stop in STOPS[k : k + 2])
    return [a + (place - k) * (b - a) for a, b in zip(low, high)]


def decoded(png):
    """The rows of a PNG with 8 bits a color, as bytes, and the bytes of a pixel."""
    position, data, header = 8, b"", b""
    while position < len(png):
        length = int.from_bytes(png[position : position + 4], "big")
        kind = png[position + 4 : position + 8]
        part = png[position + 8 : position + 8 + length]
        header = part if kind == b"IHDR" else header
        data += part if kind == b"IDAT" else b""
        position += 12 + length
    width, height = (int.from_bytes(header[i : i + 4], "big") for i in (0, 4))
    step = {2: 3, 6: 4}[header[9]]
    data = zlib.decompress(data)
    rows, before = [], bytearray(width * step)
    for y in range(height):
        begin = y * (width * step + 1)
        before = unfiltered(data[begin], bytearray(data[begin + 1 : begin + 1 + width * step]), before, step)
        rows.append(before)
    return rows, step


def unfiltered(kind, row, above, step):
    """A row of a PNG as it was before its filter."""
    for i in range(len(row)):
        a = row[i - step] if i >= step else 0
        b, c = above[i], above[i - step] if i >= step else 0
        nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
        row[i] = (row[i] + [0, a, b, (a + b) // 2, nearest][kind]) & 255
    return row


class Picture:
    """What is on the screen."""

    def __init__(self, png):
        self.rows, self.step = decoded(png)
        self.width = len(self.rows[0]) // self.step

    def at(self, x, y):
        """The color of the pixel in which a place is; None outside of the picture."""
        if not (0 <= x < self.width and 0 <= y < len(self.rows)):
            return None
        begin = int(x) * self.step
        return tuple(self.rows[int(y)][begin : begin + 3])

    def means(self, columns=4, rows=3):
        """The mean colors of parts of the picture."""
        found = []
        for r in range(rows):
            for c in range(columns):
                ys = range(r * len(self.rows) // rows, (r + 1) * len(self.rows) // rows)
                xs = range(c * self.width // columns, (c + 1) * self.width // columns)
                pixels = [self.at(x, y) for y in ys for x in xs]
                found.append([round(sum(color[k] for color in pixels) / len(pixels), 1) for k in range(3)])
        return found


class LayersTest(unittest.TestCase):
    """Has a server and a browser, and the pages beside the packages."""

    host = ""

    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(FOLDER).resolve() / "web"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(EXAMPLES, folder)
        (folder / "node_modules").symlink_to("../node_modules")
        with contextlib.ExitStack() as stack:
            cls.server = stack.enter_context(Server(FOLDER))
            cls.browser = stack.enter_context(Browser(CHROMIUM))
            cls.addClassCleanup(stack.pop_all().close)

    def page(self, name, size=SIZE):
        """A page that has drawn; it fails where the console has errors or WebGL complains when the test ends."""
        page = self.browser.open(f"{self.server.address}/web/{name}", *size)
        self.addCleanup(page.close)
        self.addCleanup(lambda: self.assertEqual(page.errors() + complaints(page), []))
        page.wait("Boolean(globalThis.example)")
        self.settle(page)
        return page

    def settle(self, page):
        """Waits until some frames were drawn, and hides the line of text."""
        page.run("document.getElementById('told').hidden = true")
        page.run("new Promise((resolve) => { let n = 8; const next = () => n-- ? requestAnimationFrame(next) : resolve(0);"
                 f" {self.redraw}; next(); }})")

    def compare_with_recorded(self, name, picture):
        """The mean colors of parts are those that were recorded, but for the last digits of another renderer."""
        recorded = json.loads(RECORDED.read_text(encoding="utf-8")) if RECORDED.exists() else {}
        found = picture.means()
        if UPDATE:
            recorded[name] = found
            RECORDED.write_text(json.dumps(recorded, indent=None).replace("]], ", "]],\n") + "\n", encoding="utf-8")
        for part, (ours, theirs) in enumerate(zip(found, recorded[name], strict=True)):
            for a, b in zip(ours, theirs, strict=True):
                self.assertAlmostEqual(a, b, delta=4, msg=f"{name}, part {part}")

    def check_sites(self, page, picture, project):
        """At the pixels of sites is the color of their value, unless another cell begins there."""
        sites = page.run(
            "(() => { const { lon, lat, values } = example.field;"
            f" const place = {project};"
            " return Array.from(lon, (x, i) => [...place(x, lat[i]), values[i]]).filter(([, , seen]) => seen); })()"
        )
        checked = wrong = 0
        for x, y, _, value in sites:
            color = picture.at(x, y)
            if color is None:
                continue
            checked += 1
            wrong += max(abs(a - b) for a, b in zip(color, ramp((value + 1) / 2))) > 6
        self.assertGreater(checked, 300)
        self.assertLessEqual(wrong, checked // 20)

    def check_no_hole(self, picture, cx, cy, radius):
        """No pixel of a disc shows what is behind the layer."""
        holes = [
            (x, y)
            for y in range(int(cy - radius), int(cy + radius))
            for x in range(int(cx - radius), int(cx + radius))
            if math.hypot(x - cx, y - cy) < radius
            and max(abs(a - b) for a, b in zip(picture.at(x, y), GROUND[self.host])) < 8
        ]
        self.assertEqual(holes, [])


def complaints(page):
    """Warnings of WebGL, which the browser writes to its log."""
    entries = [event["params"]["entry"] for event in page.browser.events
               if event.get("sessionId") == page.session and event["method"] == "Log.entryAdded"]
    return [entry["text"] for entry in entries if "WebGL" in entry["text"] and "ReadPixels" not in entry["text"]]


# Whether a place is on the near side of a globe whose middle is at lon0, lat0, well before the horizon.
NEAR = ("((lon, lat, lon0, lat0) => { const r = Math.PI / 180; return Math.sin(lat * r) * Math.sin(lat0 * r) +"
        " Math.cos(lat * r) * Math.cos(lat0 * r) * Math.cos((lon - lon0) * r) > 0.6; })")


class MapLibre(LayersTest):
    """Layers on MapLibre's globe and map."""

    host = "maplibre"
    redraw = "example.map.triggerRepaint()"
    globe = (f"(lon, lat) => {{ const p = example.map.project([lon, lat]); const c = example.map.getCenter();"
             f" return [p.x, p.y, {NEAR}(lon, lat, c.lng, c.lat)]; }}")
    flat = "(lon, lat) => { const p = example.map.project([lon, lat]); return [p.x, p.y, Math.abs(lat) < 84]; }"

    def test_cells_on_the_globe(self):
        page = self.page("maplibre.html?sites=2000")
        page.run("example.map.removeLayer('lines'); 0")
        self.settle(page)
        picture = Picture(page.picture())
        self.check_sites(page, picture, self.globe)
        self.compare_with_recorded("maplibre cells", picture)

    def test_the_poles_are_closed(self):
        for lat in (90, -90):
            for show in ("cells", "triangles"):
                page = self.page(f"maplibre.html?sites=300&show={show}")
                page.run(f"example.map.removeLayer('lines'); example.map.jumpTo({{ center: [0, {lat}], zoom: 1.2 }}); 0")
                self.settle(page)
                radius = page.run("(() => { const a = example.map.project([0, 60 * Math.sign(example.map.getCenter().lat)]);"
                                  " return Math.hypot(a.x - 300, a.y - 225); })()")
                self.check_no_hole(Picture(page.picture()), SIZE[0] / 2, SIZE[1] / 2, min(radius, 220))

    def test_map(self):
        page = self.page("maplibre.html?sites=2000&projection=mercator")
        page.run("example.map.removeLayer('lines'); example.map.jumpTo({ center: [180, 0], zoom: 0.5 }); 0")
        self.settle(page)
        picture = Picture(page.picture())
        self.check_sites(page, picture, self.flat)
        self.compare_with_recorded("maplibre map", picture)
        middle = [picture.at(300, y) for y in range(450)]  # the antimeridian
        self.assertFalse(any(max(abs(a - b) for a, b in zip(c, GROUND["maplibre"])) < 8 for c in middle))

    def test_triangles_and_isolines(self):
        page = self.page("maplibre.html?sites=2000&show=triangles")
        picture = Picture(page.picture())
        self.compare_with_recorded("maplibre triangles", picture)
        dark = sum(max(picture.at(x, y)) < 45 and min(picture.at(x, y)) < 25 for y in range(150, 300) for x in range(225, 375))
        self.assertGreater(dark, 100)  # pixels of isolines

    def test_values_at_places_and_new_values(self):
        page = self.page("maplibre.html?sites=2000")
        found = page.run("Promise.all([[0, 90], [0, -90], [179.999, 12], [-179.999, 12]].map((p) => example.sites.at(...p)))")
        self.assertEqual([found[0]["site"], found[1]["site"]], [0, 1])
        lon, lat = page.run("[[...example.field.lon], [...example.field.lat]]")
        for place, answer in zip(((179.999, 12), (-179.999, 12)), found[2:]):
            best = max(range(len(lon)), key=lambda i: cosine(place, (lon[i], lat[i])))
            self.assertEqual(answer["site"], best)
            self.assertEqual(answer["value"], page.run(f"example.field.values[{best}]"))
        page.run("example.map.removeLayer('lines'); example.sites.setValues(example.field.values.map((v, i) => i % 2 ? NaN : 1)); 0")
        self.settle(page)
        picture = Picture(page.picture())
        inside = [picture.at(x, y) for y in range(150, 300) for x in range(225, 375)]
        filled = sum(max(abs(a - b) for a, b in zip(color, ramp(1))) < 6 for color in inside)
        empty = sum(max(abs(a - b) for a, b in zip(color, GROUND["maplibre"])) < 6 for color in inside)
        self.assertGreater(filled, len(inside) // 4)
        self.assertGreater(empty, len(inside) // 4)
        self.assertGreater(filled + empty, 0.95 * len(inside))

    def test_a_layer_is_taken_away_and_put_back(self):
        page = self.page("maplibre.html?sites=500")
        page.run("example.map.removeLayer('lines'); 0")
        self.settle(page)
        before = Picture(page.picture()).means()
        page.run("example.map.removeLayer('cells'); 0")
        self.settle(page)
        self.assertNotEqual(Picture(page.picture()).means(), before)
        page.run("example.map.addLayer(example.cells); 0")
        self.settle(page)
        self.assertEqual(Picture(page.picture()).means(), before)

    def test_a_million_sites_do_not_stop_the_page(self):
        page = self.page("maplibre.html?sites=100")
        total, longest, number = page.run(
            "(async () => { const { makeField } = await import('./field.js');"
            " const { SphereSites, SphereLayer } = await import('rondel/maplibre'); const field = makeField(1e6);"
            " await new Promise((done) => setTimeout(done, 100)); let last = performance.now(), longest = 0; const start = last;"
            " const timer = setInterval(() => { const now = performance.now(); longest = Math.max(longest, now - last); last = now; }, 5);"
            " const sites = await SphereSites.open(field);"
            " const layer = new SphereLayer({ id: 'million', sites, domain: [-1, 1] }); await layer.loaded; clearInterval(timer);"
            " const total = performance.now() - start; example.map.addLayer(layer); example.field = field;"
            " return [total, longest, sites.numSites]; })()",
            timeout=180,
        )
        print(f"a million sites: {total:.0f} ms in the worker, the page stood still for {longest:.0f} ms at most")
        self.assertEqual(number, 1_000_000)
        self.assertLess(longest, total / 2)
        self.settle(page)
        self.check_no_hole(Picture(page.picture()), SIZE[0] / 2, SIZE[1] / 2, 140)


class Deck(LayersTest):
    """Layers on deck.gl's globe and map."""

    host = "deck"
    redraw = "example.deck.redraw('test')"
    globe = ("(lon, lat) => { const v = example.deck.getViewports()[0]; const p = v.project([lon, lat]);"
             f" return [p[0], p[1], {NEAR}(lon, lat, v.longitude, v.latitude)]; }}")
    flat = ("(lon, lat) => { const v = example.deck.getViewports()[0]; const p = v.project([lon, lat]);"
            " return [p[0], p[1], Math.abs(lat) < 84]; }")

    def without_lines(self, page):
        page.run("example.deck.setProps({ layers: [example.cells] }); 0")
        self.settle(page)
        return Picture(page.picture())

    def test_cells_on_the_globe(self):
        page = self.page("deck.html?sites=2000")
        picture = self.without_lines(page)
        self.check_sites(page, picture, self.globe)
        self.compare_with_recorded("deck cells", picture)

    def test_map(self):
        page = self.page("deck.html?sites=2000&view=map")
        picture = self.without_lines(page)
        self.check_sites(page, picture, self.flat)
        self.compare_with_recorded("deck map", picture)

    def test_the_poles_are_closed(self):
        for lat in (90, -90):
            page = self.page("deck.html?sites=300")
            page.run(f"example.deck.setProps({{ initialViewState: {{ longitude: 0, latitude: {lat}, zoom: 0.5 }} }}); 0")
            self.check_no_hole(self.without_lines(page), SIZE[0] / 2, SIZE[1] / 2, 80)

    def test_picking(self):
        """What deck.gl picks is the nearest site."""
        page = self.page("deck.html?sites=2000")
        lon, lat, values = page.run("[[...example.field.lon], [...example.field.lat], [...example.field.values]]")
        for x, y in ((300, 225), (250, 180), (340, 260)):
            picked = page.run(f"example.deck.pickObjectAsync({{ x: {x}, y: {y} }}).then(({{ index, object, coordinate }}) =>"
                              " [index, object, coordinate])")
            index, found, coordinate = picked
            place = page.run(f"example.deck.getViewports()[0].unproject([{x} + 0.5, {y} + 0.5])")
            best = max(range(len(lon)), key=lambda i: cosine(place, (lon[i], lat[i])))
            self.assertEqual(index, best, coordinate)
            self.assertEqual([found["site"], found["value"]], [best, values[best]])
        self.assertIsNone(page.run("example.deck.pickObject({ x: 5, y: 5 })"))


class Three(LayersTest):
    """Surfaces and polygons as geometries of three.js."""

    redraw = "0"

    def test_page(self):
        picture = Picture(self.page("three.html").picture())
        self.compare_with_recorded("three", picture)
        red = sum(picture.at(x, y) == (0xD6, 0x27, 0x28) for y in range(450) for x in range(600))
        self.assertGreater(red, 2000)


def cosine(a, b):
    """The cosine of the angle between two places in degrees."""
    (lon, lat), (x, y) = [[math.radians(part) for part in place[:2]] for place in (a, b)]
    return math.sin(lat) * math.sin(y) + math.cos(lat) * math.cos(y) * math.cos(lon - x)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", TEST])
