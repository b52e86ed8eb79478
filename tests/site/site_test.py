# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The documentation site, read as files and opened in a browser from file://.

    site_test.py SITE CHROMIUM AXE [TEST ...]

SITE is what scripts/site made; AXE is axe.min.js of the npm package axe-core. Addresses outside the site are listed,
never asked for.
"""

import html.parser
import json
import pathlib
import re
import sys
import unittest
import urllib.parse

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "globe"))
from browser import Browser  # noqa: E402 (after the line above)

SITE, CHROMIUM, AXE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
del sys.argv[1:4]

# A page of each kind.
KINDS = [
    "index.html",
    "install.html",
    "gallery.html",
    "sphere.html",
    "coming-from/cgal.html",
    "coming-from/scipy.html",
    "coming-from/api.html",
    "coming-from/gmt.html",
    "docs/notebooks/stations.html",
    "notebook.html",
    "theory.html",
    "search.html",
    "genindex.html",
    "docs/guide/python.html",
    "docs/guide/cli.html",
    "docs/theory/filters.html",
    "reference/cpp/triangulation.html",
    "reference/python.html",
    "reference/javascript/index/classes/Triangulation.html",
    "reference/c.html",
]
LOADING = {("script", "src"), ("link", "href"), ("img", "src"), ("iframe", "src"), ("source", "src")}


class Reader(html.parser.HTMLParser):
    """The addresses in a page, the names that links may lead to, what it loads from elsewhere, its words and its formulas."""

    def __init__(self, path):
        super().__init__()
        self.links, self.names, self.loaded, self.words, self.formulas = [], set(), [], [], []
        self.inside = []  # elements that are open, and whether their text is words, a formula or neither
        self.feed(path.read_text(encoding="utf-8"))

    def handle_data(self, data):
        kinds = {kind for _, kind in self.inside}
        if "formula" in kinds:
            self.formulas.append(data)
        elif "code" not in kinds:
            self.words.append(data)

    def handle_endtag(self, tag):
        if tag in [name for name, _ in self.inside]:
            while self.inside.pop()[0] != tag:
                pass

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag not in ("area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"):
            is_formula = "math" in (attributes.get("class") or "").split()
            self.inside.append((tag, "formula" if is_formula else "code" if tag in ("code", "pre", "script", "style", "svg") else "words"))
        self.names.update(attributes[key] for key in ("id", "name") if attributes.get(key))
        for key in ("href", "src"):
            target = attributes.get(key)
            if target is None or (tag == "link" and attributes.get("rel") == "canonical"):
                continue
            self.links.append(target)
            if (tag, key) in LOADING and re.match(r"(https?:)?//", target):
                self.loaded.append(target)


def pages():
    """The pages that Sphinx made."""
    return [path for path in sorted(SITE.rglob("*.html")) if not {"_static", "globes"} & set(path.relative_to(SITE).parts)]


def name(path):
    return path.relative_to(SITE).as_posix()


class Files(unittest.TestCase):
    """What holds of the files alone."""

    @classmethod
    def setUpClass(cls):
        cls.readers = {path: Reader(path) for path in pages()}

    def test_there_is_a_page_of_each_kind(self):
        for kind in KINDS:
            self.assertTrue((SITE / kind).exists(), kind)

    def test_every_link_leads_to_a_file_and_every_anchor_to_a_name(self):
        outside, broken, local = set(), [], 0
        for path, reader in self.readers.items():
            for link in reader.links:
                parts = urllib.parse.urlsplit(link)
                if parts.scheme in ("http", "https"):
                    outside.add(link)
                if parts.scheme or parts.netloc:
                    continue
                local += 1
                target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
                anchor = urllib.parse.unquote(parts.fragment)
                if not target.is_file():
                    broken.append(f"{name(path)}: {link}")
                elif anchor and target in self.readers and anchor not in self.readers[target].names:
                    broken.append(f"{name(path)}: {link} (no such anchor)")
        print(f"{len(self.readers)} pages, {local} links inside; addresses outside:", *sorted(outside), sep="\n  ")
        self.assertGreater(local, 1000)
        self.assertEqual(sorted(set(broken)), [])

    def test_nothing_is_loaded_from_elsewhere(self):
        for path, reader in self.readers.items():
            self.assertEqual(reader.loaded, [], name(path))

    def test_no_formula_is_left_as_it_was_written(self):
        """Formulas are where MathJax finds them, and no dollar, macro, power or index of TeX is among the words."""
        counted = 0
        for path, reader in self.readers.items():
            counted += len(reader.formulas)
            if not name(path).startswith("reference/"):  # where comments of the sources have commands of Doxygen
                left = re.findall(r"\S*(?:\$|\\[A-Za-z]{2,}|\w[\^_]\{)\S*", "".join(reader.words))
                self.assertEqual(left, [], name(path))
            for formula in reader.formulas:
                self.assertTrue(re.fullmatch(r"\s*(\\\(.*\\\)|\\\[.*\\\])\s*", formula, re.S), f"{name(path)}: {formula}")
        self.assertGreater(counted, 2000)

    def test_every_document_is_a_page(self):
        for document in [*(ROOT / "docs").rglob("*.md"), *(ROOT / "site").rglob("*.md")]:
            folder = ROOT if (ROOT / "docs") in document.parents else ROOT / "site"
            self.assertTrue((SITE / document.relative_to(folder)).with_suffix(".html").exists(), document)

    def test_every_public_name_is_in_the_references(self):
        headers = "".join((ROOT / f"include/rondel/{h}.h").read_text(encoding="utf-8") for h in ("delaunay", "diagram", "hull"))
        functions = set(re.findall(r"^RONDEL_API [^;(]*?(\w+)\(", headers, re.M))
        self.assertGreater(len(functions), 10)
        cpp = "".join(path.read_text(encoding="utf-8") for path in (SITE / "reference/cpp").glob("*.html"))
        for function in functions:
            self.assertTrue(re.search(rf'<h2>{function}<', cpp), function)
        c_header = (ROOT / "bindings/c/include/rondel.h").read_text(encoding="utf-8")
        c = (SITE / "reference/c.html").read_text(encoding="utf-8")
        for function in set(re.findall(r"^RONDEL_C_API [^;(]*?(rondel_\w+)\(", c_header, re.M)):
            self.assertTrue(f'id="c.{function}"' in c, function)
        exported = (ROOT / "bindings/python/rondel/__init__.py").read_text(encoding="utf-8").split("__all__ = [")[1].split("]")[0]
        python = (SITE / "reference/python.html").read_text(encoding="utf-8")
        for word in re.findall(r'"(\w+)"', exported):
            self.assertTrue(f'id="rondel.{word}"' in python, word)

    def test_every_member_of_a_class_and_of_a_struct_has_an_anchor(self):
        counted = 0
        for header in sorted((ROOT / "include/rondel").glob("*.h")):
            page = SITE / "reference/cpp" / f"{header.stem}.html"
            if not page.exists():
                continue
            names = self.readers[page].names
            # What is declared before are structs of other specifications.
            text = re.sub(r"//.*", "", header.read_text(encoding="utf-8")).partition("\nnamespace rondel")[2]
            for name, body in re.findall(r"^(?:class|struct) (?:RONDEL_API )?(\w+)[^;{]*\{\n(.*?)^\};", text, re.M | re.S):
                public = body.split("private:")[0]
                functions = re.findall(r"^  (?:\[\[nodiscard\]\] |static )[^;(]*?(\w+)\(", public, re.M)
                fields = re.findall(r"^  [\w:<>]+(?:<.*>)? (\w+)(?: = [^;]*|\{\})?;", public, re.M)
                for member in {*functions, *fields} - {"Impl"}:
                    counted += 1
                    self.assertIn(f"{name}-{member}".lower().replace("_", "-"), names, header.name)
        self.assertGreater(counted, 100)

    def test_every_cell_of_a_notebook_was_run(self):
        written = [*((ROOT / "site", d) for d in (ROOT / "site").rglob("*.md")), *((ROOT, d) for d in (ROOT / "docs/notebooks").glob("*.md"))]
        documents = [(top, d) for top, d in written if "{code-cell}" in d.read_text(encoding="utf-8")]
        self.assertGreater(len(documents), 10)
        for top, document in documents:
            page = (SITE / document.relative_to(top)).with_suffix(".html").read_text(encoding="utf-8")
            cells = document.read_text(encoding="utf-8").count("{code-cell}")
            self.assertGreaterEqual(page.count('class="cell docutils container"') + page.count('class="cell '), cells, document)
            self.assertIn("cell_output", page)
            self.assertNotIn("Traceback (most recent call last)", page)


    def test_notebooks_have_pictures_and_files_for_jupyter(self):
        names = sorted(path.stem for path in (ROOT / "docs/notebooks").glob("*.md") if path.stem != "README")
        for name in names:
            page = (SITE / f"docs/notebooks/{name}.html").read_text(encoding="utf-8")
            self.assertGreaterEqual(len(re.findall(r'<img alt="[^"]*" (?:class="[^"]*" )?src="../../_images/', page)), 2, name)
            self.assertIn(f"../../notebooks/{name}.ipynb", page)
            book = json.loads((SITE / f"notebooks/{name}.ipynb").read_text(encoding="utf-8"))
            cells = ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]
            self.assertGreaterEqual(len(cells), 3)
            compile("\n".join(cells), name, "exec")


class InTheBrowser(unittest.TestCase):
    """What holds of pages that are open."""

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(str(CHROMIUM)).__enter__()
        cls.addClassCleanup(cls.browser.__exit__)

    def open(self, path, **more):
        page = self.browser.open(str(path), **more)
        self.addCleanup(page.close)
        page.wait("document.readyState === 'complete' && location.protocol === 'file:'")
        return page

    def test_no_page_has_errors_on_the_console_and_every_formula_is_set(self):
        """MathJax shows an error of TeX as such, and a macro that it does not know in red. Of pages that are made of
        declarations, and of decisions without formulas, each is made of the same parts."""
        with_formulas = {path for path in pages() if Reader(path).formulas}
        self.assertGreater(len(with_formulas), 15)
        of_one_make = [path for path in pages() if name(path).startswith(("reference/", "docs/decisions/")) and name(path) not in KINDS]
        for path in sorted(set(pages()) - set(of_one_make) | with_formulas):
            with self.subTest(name(path)):
                page = self.browser.open(str(path))
                page.wait("document.readyState === 'complete' && location.protocol === 'file:'")
                if path in with_formulas:
                    page.wait("document.querySelectorAll('.math').length === document.querySelectorAll('.math > mjx-container svg').length")
                    self.assertGreater(page.run("document.querySelectorAll('mjx-container svg').length"), 0)
                    broken = "'[data-mjx-error], mjx-merror, [data-mml-node=merror], mjx-container [fill=red], mjx-container [mathcolor=red]'"
                    self.assertEqual(page.run(f"[...document.querySelectorAll({broken})].map((e) => e.closest('.math').textContent)"), [])
                self.assertEqual(page.errors(), [])
                page.close()

    def test_search_finds_a_word(self):
        wanted_pages = {
            "perturbation": "perturbation.html",
            "Laguerre": "circles.html",
            "Thiessen": "notebooks/stations.html",
            "Dirichlet": "guide/regions.html",
            "TIN": "guide/interpolation.html",
            "natural neighbour": "guide/interpolation.html",
            "natural neighbor": "guide/interpolation.html",
            "first-order conservative": "guide/remapping.html",
            "xESMF": "coming-from/xesmf.html",
        }
        for word, wanted in wanted_pages.items():
            page = self.open(f"{SITE / 'search.html'}?q={urllib.parse.quote(word)}")
            page.wait("/Search finished/.test(document.getElementById('search-results').textContent)")
            found = page.run("[...document.querySelectorAll('#search-results li a')].map((a) => a.href).join(' ')")
            self.assertIn(wanted, found)
            self.assertEqual(page.errors(), [])

    def test_search_leads_to_a_member_of_a_class(self):
        page = self.open(f"{SITE / 'search.html'}?q=conflict_region")
        page.wait("/Search finished/.test(document.getElementById('search-results').textContent)")
        found = page.run("[...document.querySelectorAll('#search-results li a')].map((a) => a.href)")
        anchors = [link for link in found if "cpp/query.html#" in link]
        self.assertTrue(anchors, found)
        member = self.open(anchors[0])
        heading = "document.querySelector(':target').closest('section, span').parentElement.textContent"
        self.assertIn("conflict_region", member.run(heading))

    def globe_in(self, path):
        """A page, what is in its frame, and where the middle of the globe there is on the screen."""
        page = self.open(path, width=1280, height=900)
        page.run("document.querySelector('iframe').scrollIntoView({ block: 'center', behavior: 'instant' })")
        frame = page.frame()
        page.wait_until_drawn(frame=frame)
        self.assertEqual(page.run("document.documentElement.dataset.state", frame=frame), "ready")
        middle = "(({ x, y, width, height }) => [x + width / 2, y + height / 2])(document.querySelector('iframe').getBoundingClientRect())"
        return page, frame, page.run(middle)

    def test_the_first_globe_is_the_one_to_play_with(self):
        page, frame, (x, y) = self.globe_in(SITE / "index.html")
        sites = "document.getElementById('summary').textContent"
        self.assertIn("200 sites", page.run(sites, frame=frame))
        page.double_click(x + 7, y + 5)
        page.wait(f"/199 sites|201 sites/.test({sites})", frame=frame)
        self.assertEqual(page.errors(), [])

    def test_the_view_of_a_notebook_is_a_globe_that_answers(self):
        page, frame, (x, y) = self.globe_in(SITE / "notebook.html")
        page.click(x, y)
        page.wait("!document.getElementById('card').hidden", frame=frame)
        self.assertIn("log10 of the distance in km", page.run("document.getElementById('card').textContent", frame=frame))
        self.assertEqual(page.errors(), [])

    def test_no_page_is_wider_than_a_phone(self):
        for kind in KINDS:
            with self.subTest(kind):
                page = self.open(SITE / kind, width=390, height=800, touch=True)
                page.wait("document.querySelectorAll('span.math').length === document.querySelectorAll('span.math > mjx-container svg').length")
                self.assertLessEqual(page.run("document.documentElement.scrollWidth"), 391)

    def test_axe_finds_nothing_serious(self):
        """In the dark colors alone are others."""
        axe = AXE.read_text(encoding="utf-8")
        for dark in (False, True):
            options = {"iframes": False, "resultTypes": ["violations"]}  # frames are pages of their own, tested in tests/globe
            if dark:
                options["runOnly"] = {"type": "rule", "values": ["color-contrast"]}
            for kind in KINDS:
                with self.subTest(kind, dark=dark):
                    page = self.open(SITE / kind, dark=dark)
                    page.run(f"(() => {{ {axe} }})(), 0")
                    found = page.run(
                        f"axe.run(document, {json.dumps(options)}).then(({{ violations }}) => violations"
                        ".filter(({ impact }) => ['serious', 'critical'].includes(impact))"
                        ".map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.html)}`))"
                    )
                    self.assertEqual(found, [])


if __name__ == "__main__":
    unittest.main()
