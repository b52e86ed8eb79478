# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Formulas in running text, as the site sets them."""

import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "site"))
from formulas import with_formulas  # noqa: E402 (after the line above)


class Formulas(unittest.TestCase):
    def assert_set(self, cases):
        for text, wanted in cases.items():
            with self.subTest(text):
                self.assertEqual(with_formulas(text), wanted)

    def test_operators_exponents_and_indices_are_set(self):
        self.assert_set({
            "so u = 2^-53.": "so $u = 2^{-53}$.",
            "at most 4.4e-16 and 1e-15": r"at most $4.4\cdot 10^{-16}$ and $10^{-15}$",
            "|w|^2 <= (4/3) |C|^2 |D|^2.": r"$\lvert w \rvert ^{2} \le (\tfrac{4}{3})\lvert C \rvert ^{2}\lvert D \rvert ^{2}$.",
            "sqrt(2a^2 + 1) holds": r"$\sqrt{2a^{2} + 1}$ holds",
            "w_0 … w_k−1 are": r"$w_{0}\dots w_{k-1}$ are",
            "s = -1, so": "$s = -1$, so",
            "= 81u a^2. Half": "= $81ua^{2}$. Half",
            "5/16 e^3": r"$\tfrac{5}{16}e^{3}$",
        })  # fmt: skip

    def test_products_of_vectors_are_told_apart(self):
        self.assert_set({
            "N = B x C, m": r"$N = B \times C$, $m$",
            "e_x x x (y-z), and": r"$e_{x}x \times (y - z)$, and",
            "(A - C).(B - C) is": r"$(A - C) \cdot (B - C)$ is",
            "p.N. Then": r"$p \cdot N$. Then",
        })  # fmt: skip

    def test_a_remark_in_brackets_is_no_factor(self):
        self.assert_set({
            "1 * H (4 eta H);": r"$1 \cdot H$ $(4\eta H)$;",
            "2u (P + Q) more": "$2u(P + Q)$ more",
            "is 1.4e-15 (of 2 sites)": r"is $1.4\cdot 10^{-15}$ (of 2 sites)",
        })  # fmt: skip

    def test_articles_and_units_are_no_letters(self):
        self.assert_set({
            "a site a is above a face": "a site $a$ is above a face",
            "take 12 s of time": "take 12 s of time",
            "on an x-axis, e.g. a plane": "on an $x$-axis, e.g. a plane",
            "the 51 of 100, 1996 and 5,634": "the 51 of 100, 1996 and 5,634",
        })  # fmt: skip

    def test_code_links_headings_and_blocks_are_left_alone(self):
        for text in ("`u = 2^-53`", "[u](x.md#y)", "# u = 2^-53", "```math\nu = 2^-53\n```", "    u = 2^-53", "| --- | --- |"):
            with self.subTest(text):
                self.assertEqual(with_formulas(text), text)

    def test_cells_of_tables_are_set_one_by_one(self):
        self.assertEqual(with_formulas(r"| a | 1/\|p\| | p |"), r"| $a$ | $1 / \lvert p \rvert$ | $p$ |")

    def test_what_is_set_has_all_letters_and_digits_of_the_documents(self):
        """Setting a document moves, adds and loses no symbol."""
        written = {"sum": "", "abs(": "(", "mix_k": "mixk", "β": "beta", "γ": "gamma", "λ": "lambda", "π": "pi", "²": "2", "ᵢ": "i"}
        commands = r"\\(?:operatorname|mathrm|mathbin|tfrac|times|cdot|le|ge|ne|gg|to|dots|lvert|rvert|sum|circ)(?![a-z])"

        def symbols(text):
            for sign, word in [*written.items(), *zip("₀₁₂₃₄", "01234", strict=True)]:
                text = text.replace(sign, word)
            text = re.sub(r"(?<=\d)e(?=-?\d)", "10", re.sub(r"(?<![\d.])1e(?=-?\d)", "10", text))
            return re.sub(r"[\W_x]", "", re.sub(commands, "", text))

        for document in sorted((ROOT / "docs/theory").glob("*.md")):
            source = document.read_text(encoding="utf-8")
            for before, after in zip(source.split("\n\n"), with_formulas(source).split("\n\n"), strict=True):
                self.assertEqual(symbols(before), symbols(after), document.name)


if __name__ == "__main__":
    unittest.main()
