# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Formulas in the documents are TeX that every reader of Markdown leaves alone, and none stands there as plain text.

    mathematics_test.py SOURCE_FOLDER

Formulas stand between dollars in a line, or in a fenced block `math`. A code host takes the escapes, emphasis, tags and
columns of Markdown out of a line before it sees a formula in it, and sets a subset of MathJax's macros.
"""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
CODE = re.compile(r"^```(\S*)[^\n]*\n(.*?)^```$", re.M | re.S)
FORMULA = re.compile(r"\$([^$]*)\$")
# What code hosts set, too: \operatorname, for one, they refuse.
MACROS = set("""
    Bigl Bigr Delta alpha arccos arctan beta bigl bigr cdot circ cos cot delta det dfrac dots eta exp frac
    gamma ge gg in int lambda lbrace ldots le left lfloor log lvert mathbin mathrm max min ne phi pi
    prod qquad quad rbrace rfloor right rvert setminus sin sqrt sum tan text tfrac theta times to
""".split())


def documents():
    """The Markdown files that are pages of the site."""
    folders = [ROOT / "docs", ROOT / "site", ROOT / "bench"]
    return sorted(path for folder in folders for path in folder.rglob("*.md") if "node_modules" not in path.parts)


def paragraphs(text):
    """The paragraphs and the rows of tables, without code and the targets of links."""
    text = re.sub(CODE, "", text)
    text = re.sub(r"`[^`\n]*`", "code", text)
    text = re.sub(r"\]\([^)\s]*\)", "]", text)
    for paragraph in re.split(r"\n\s*\n", text):
        yield from re.split(r"\n(?=\|)", paragraph)


def emphasis_by_underscores(paragraph):
    """Whether CommonMark takes two underscores for marks of emphasis: one that may open it, and later one that may close it."""
    is_open = False
    for mark in re.finditer("_+", paragraph):
        before, after = (paragraph[at] if 0 <= at < len(paragraph) else " " for at in (mark.start() - 1, mark.end()))
        left = not after.isspace() and (after.isalnum() or not before.isalnum())
        right = not before.isspace() and (before.isalnum() or not after.isalnum())
        if right and is_open and (not left or not after.isalnum()):
            return True
        is_open |= left and (not right or not before.isalnum())
    return False


def faults(text):
    """What would not be set as it is meant, in the text of a document."""
    for language, formula in re.findall(CODE, text):
        if language == "math":
            yield from faults_of_tex(formula)
    for paragraph in paragraphs(text):
        if paragraph.count("$") % 2:
            yield f"a dollar without another one: {paragraph}"
            continue
        formulas = re.findall(FORMULA, paragraph)
        for formula in formulas:
            yield from faults_of_tex(formula)
            for pattern, reason in {
                r"^\s|\s$|^$": "begins or ends with a space, or is empty",
                r"\n": "is broken over lines",
                r"\\[^A-Za-z]": "has a backslash that Markdown removes",
                r"\*": "has an asterisk, which Markdown takes for emphasis",
                r"<[A-Za-z/!?]": "has what Markdown takes for a tag",
            }.items():
                if re.search(pattern, formula):
                    yield f"{reason}: {formula}"
            if paragraph.startswith("|") and "|" in formula:
                yield f"has a bar that ends a column of its table: {formula}"
        if formulas and emphasis_by_underscores(paragraph):
            yield f"has underscores that Markdown takes for emphasis: {paragraph}"


def faults_of_tex(formula):
    unknown = set(re.findall(r"\\([A-Za-z]+)", formula)) - MACROS
    if unknown:
        yield f"has macros that code hosts may not know, {', '.join(sorted(unknown))}: {formula}"
    depth = 0
    for brace in re.findall(r"(?<!\\)[{}]", formula):
        depth += 1 if brace == "{" else -1
        if depth < 0:
            break
    if depth != 0:
        yield f"has braces without a partner: {formula}"


def plain_formulas(text):
    """What looks like a formula, and is plain text."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    for paragraph in paragraphs(text):
        rest = re.sub(FORMULA, " ", paragraph)
        yield from re.findall(r"\S*(?:\w\^|[√∑∫⁻²³·≤≥]|\b[A-Za-z]_\w|\bsqrt\b|\b\d+e-?\d|(?:phi|lambda|alpha|beta)_\w)\S*", rest)


class Mathematics(unittest.TestCase):
    def test_formulas_are_set_as_they_are_meant(self):
        counted = 0
        for path in documents():
            text = path.read_text(encoding="utf-8")
            counted += sum(len(re.findall(FORMULA, paragraph)) for paragraph in paragraphs(text))
            self.assertEqual(list(faults(text)), [], path)
        self.assertGreater(counted, 2000)

    def test_the_theory_has_no_formula_as_plain_text(self):
        for path in sorted((ROOT / "docs/theory").glob("*.md")):
            self.assertEqual(list(plain_formulas(path.read_text(encoding="utf-8"))), [], path)

    def test_faults_are_found(self):
        for text in (
            "one $a",
            "$ a$",
            "$a\nb$",
            r"$a\,b$",
            r"$\{a\}$",
            "$2 * 3$",
            "$a<b$",
            "| $|a|$ | b |",
            r"$\operatorname{fl}(a)$",
            "$a^{2$",
            "$[x]_a$ and $d_{lo}$",
            "```math\n\\frac{a}{b\n```",
            "```math\n\\unknown\n```",
        ):
            with self.subTest(text):
                self.assertNotEqual(list(faults(text)), [])
        for text in ("$a < b$, $x_i$ and $y_{12}$", "`$a` and 5 m", "```sh\necho $HOME\n```", r"```math" "\n" r"a\,b" "\n```"):
            with self.subTest(text):
                self.assertEqual(list(faults(text)), [])
        for text in ("u = 2^-53", "x_i is", "sqrt(n)", "below 1e-15", "|B|²"):
            with self.subTest(text):
                self.assertNotEqual(list(plain_formulas(text)), [])


if __name__ == "__main__":
    unittest.main()
