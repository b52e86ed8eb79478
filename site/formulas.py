# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sets the formulas in the running text of a document.

Documents have them as plain text, |B|^2 + 3u say, which reads well where Markdown is not rendered. with_formulas() finds what
can only be a formula and writes it between dollars, symbol by symbol; what it is not sure of stays as it is. Code, links,
headings and blocks between fences are left alone.

A formula is a row of operands and operators. An operand is a number, a letter with its index and prime, a named function, or
something in brackets or bars, with an exponent perhaps. Two operands side by side are a product.
"""

import dataclasses
import re

GREEK = {"alpha", "beta", "gamma", "delta", "eta", "pi"}
# Words that are numbers, and pairs of letters: products, arcs, chords.
LONGEST = 26  # signs of a formula in one line
NAMES = {"size", "next", "link"}
PAIRS = {"AB", "ab", "ac", "hn", "qp", "tx", "tK", "uH"}
FUNCTIONS = {
    **{name: rf"\{name}" for name in ("det", "sin", "cos", "tan", "cot", "arccos", "log", "max", "min")},
    **{name: rf"\operatorname{{{name}}}" for name in ("conv", "fl", "floor", "bits", "sign")},
    "mix_k": r"\operatorname{mix}_k",
    "sum": r"\sum",
}
OPERATORS = {
    "!=": r"\ne",
    "<=": r"\le",
    ">=": r"\ge",
    "≤": r"\le",
    "≥": r"\ge",
    "→": r"\to",
    ">>": r"\gg",
    "->": r"\to",
    "*": r"\cdot",
    "·": r"\cdot",
    "×": r"\times",
    "−": "-",
    **{sign: sign for sign in ("=", "<", ">", "+", "-", "/")},
    **{word: rf"\mathbin{{\mathrm{{{word}}}}}" for word in ("op", "xor")},
}
SUMS = ("+", "-", "−")
BREAK = "\x01"  # where a line may end
BRACKETS = {"(": ")", "[": "]"}
SMALL = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹₀₁₂₃₄₅₆₇₈₉ᵢⱼₖ", "01234567890123456789ijk")
LETTERS = {letter: rf"\{name}" for letter, name in zip("αβγδεηλπ", "alpha beta gamma delta varepsilon eta lambda pi".split(), strict=True)}
# What may follow the point a, but not the article.
AFTER_A_POINT = {"and", "or", "is", "has", "to", "in", "of", "by", "from", "with", "for", "as", "on", "if", "at", "are", "was", "then",
                 "comes", "goes", "lies", "when", "where", "that", "adds", "the", "than", "which", "below", "above",
                 "without", "off", "be", "remain", "may", "must", "can", "but", "itself"}  # fmt: skip

TOKEN = re.compile(
    r"""
    (?P<number>\d+x\d+|\d{1,3}(?:,\d{3})+(?!\d)|\d+(?:\.\d+)?(?:e-?\d+)?)
  | (?P<word>[A-Za-z]{2}[A-Za-z0-9_'-]*)
  | (?P<letter>[A-Za-zα-ωA-Z](?:_[A-Za-z0-9]+(?:−\d)?|[0-9](?![\w])|[₀-₉ᵢⱼₖ]+)?(?:'(?![A-Za-z]))?)
  | (?P<dots>\.\.\.|…)
  | (?P<operator>!=|<=|>=|>>|->|[≤≥→=<>+\-−·×*/])
  | (?P<dot>\.)
  | (?P<mark>\\\||[()\[\]|,^²³°'_])
  | (?P<other>\S)
    """,
    re.X,
)


@dataclasses.dataclass
class Token:
    kind: str
    text: str
    start: int
    end: int
    spaced: bool  # there is space before it


class NoFormula(Exception):
    """Here is none."""


def tokens_of(text):
    found, end = [], 0
    for match in re.finditer(TOKEN, text):
        found.append(Token(match.lastgroup, match[0].replace("\\|", "|"), match.start(), match.end(), match.start() > end or match.start() == 0))
        end = match.end()
    return found


def number(text):
    if "x" in text:
        return text.replace("x", r"\times ")
    if "e" not in text:
        return text.replace(",", "{,}")
    digits, exponent = text.split("e")
    power = f"10^{{{exponent}}}"
    return power if digits == "1" else rf"{digits}\cdot {power}"


def letter(text):
    match = re.fullmatch(r"(.)(?:_?([^']+))?('?)", text)
    name, index, prime = match[1], match[2] or "", match[3]
    if index:
        index = index.translate(SMALL).replace("−", "-")
        index = "_" + (rf"{{\mathrm{{{index}}}}}" if re.fullmatch(r"[A-Za-z]{2,}", index) else f"{{{index}}}")
    return LETTERS.get(name, name) + prime + index


class Parser:
    """The longest formula from a token on: parse() gives its TeX and the token behind it."""

    def __init__(self, tokens, first):
        self.tokens, self.at, self.bars, self.depth = tokens, first, 0, 0

    def now(self, ahead=0):
        at = self.at + ahead
        return self.tokens[at] if at < len(self.tokens) else Token("other", "", 0, 0, True)

    def parse(self):
        parts = self.row()
        return "".join(parts), self.at

    def row(self):
        """Operands and operators in turns, as long as they are such."""
        parts = []
        parts += self.sign() + self.operand()
        while True:
            mark = self.at
            try:
                operator = self.operator()
                related = operator and operator[0].strip(BREAK + " ") not in SUMS
                parts += [*operator, *(self.sign() if related else []), *self.operand()]
            except NoFormula:
                self.at = mark
                return parts

    def sign(self):
        if self.now().kind == "operator" and self.now().text in "+-−" and not self.now(1).spaced:
            self.at += 1
            return [OPERATORS[self.tokens[self.at - 1].text]]
        return []

    def operator(self):
        token, following = self.now(), self.now(1)
        if token.kind == "operator":
            # A list or an emphasis is no product, and a hyphen no difference.
            if token.text in "*-−" and token.spaced != following.spaced:
                raise NoFormula
            self.at += 1
            can_end = self.depth == self.bars == 0 and token.text not in "-−*·×/->→"
            return [f"{BREAK if can_end else ''} {OPERATORS[token.text]} "]
        if token.kind == "word" and token.text in ("op", "xor"):
            self.at += 1
            return [f" {OPERATORS[token.text]} "]
        if token.kind == "dot" and not token.spaced and not following.spaced:
            self.at += 1
            return [r" \cdot "]
        vector = following.text == "x" and self.now(2).spaced and self.starts(self.now(2))  # x x y: the first is a point
        if token.text == "x" and token.spaced and following.spaced and self.starts(following) and not vector:
            self.at += 1
            return [r" \times "]
        if not self.starts(token) or (token.kind == "number" and token.spaced and following.text != "^" and not self.depth):
            raise NoFormula
        if token.spaced and token.text in BRACKETS and not self.is_factor():
            raise NoFormula
        if token.spaced and (self.is_article() or (token.text in "sm" and self.tokens[self.at - 1].kind == "number" and not self.goes_on())):
            raise NoFormula  # an article, a unit
        if token.kind == "word" and self.tokens[self.at - 1].text in ("a", "A"):
            raise NoFormula
        return [r"\,"] if token.kind == "number" or token.text in NAMES or self.tokens[self.at - 1].text in NAMES else []

    def is_article(self):
        following = self.now(1)
        return self.now().text in "aA" and following.kind not in ("operator", "letter") and following.text not in ("^", ")")

    def is_factor(self):
        """Whether the brackets that open here hold a sum, and are no remark."""
        depth, texts = 0, []
        for token in self.tokens[self.at :]:
            depth += (token.text in BRACKETS) - (token.text in BRACKETS.values())
            if depth == 0:
                return any(text in SUMS for text in texts) and not any(text in (",", "=", "<", ">", "<=", ">=") for text in texts)
            if depth == 1:
                texts.append(token.text)
        return False

    def goes_on(self):
        """Whether a formula continues behind the token here."""
        return self.now(1).kind in ("operator", "letter") or self.now(1).text in "|(^"

    def starts(self, token):
        if token.kind in ("number", "letter", "dots"):
            return True
        if token.kind == "word":
            if token.text == "sum":
                at = self.tokens.index(token) + 1
                return at < len(self.tokens) and (self.tokens[at].text == "|" or "_" in self.tokens[at].text)
            return token.text.split("_")[0] in GREEK or token.text in FUNCTIONS or token.text in ("sqrt", "abs", "size") or self.is_short(token)
        return token.text in ("(", "[") or (token.text == "|" and not self.bars)

    def is_short(self, token):
        """A pair of letters; in bars, where it is a distance, any, and some words."""
        return token.text in PAIRS or (self.bars and re.fullmatch("[A-Za-z]{2}|value|place", token.text))

    def operand(self):
        token = self.now()
        if not self.starts(token) and not (token.text == "|" and self.bars) and token.text not in NAMES:
            raise NoFormula
        self.at += 1
        if token.kind == "number":
            parts = [number(token.text)]
        elif token.kind == "letter":
            parts = [letter(token.text)]
        elif token.kind == "dots":
            parts = [r"\dots "]
        elif token.kind == "word":
            parts = self.named(token.text)
        else:
            parts = self.group(token.text)
        return parts + self.behind()

    def named(self, name):
        greek, _, index = name.partition("_")
        if greek in GREEK:
            return [rf"\{greek}_{{{index}}}" if index else rf"\{greek} "]
        if name in ("sqrt", "abs"):
            if self.now().text != "(" or self.now().spaced:
                raise NoFormula
            self.at += 1
            inside = "".join(self.group("(")[1:-1])
            return [rf"\sqrt{{{inside}}}"] if name == "sqrt" else [rf"\lvert {inside} \rvert"]
        if name not in FUNCTIONS:
            return [name if len(name) == 2 else rf"\mathrm{{{name}}}"]
        if name == "sum":
            return [r"\sum "]
        power = self.behind() if self.now().text in ("^", "²", "³") else []
        if self.now().text == "(" and not self.now().spaced:
            return [FUNCTIONS[name], *power]
        if name not in ("sin", "cos", "tan", "cot", "log") or self.now().kind not in ("letter", "number", "word"):
            raise NoFormula
        return [FUNCTIONS[name], *power, " ", *self.operand()]

    def group(self, opening):
        """What is in brackets or bars, which are open."""
        if opening == "|":
            self.bars += 1
            if self.now().text == "det" and self.now(1).text == "|":
                self.at += 1
                inside = [FUNCTIONS["det"]]
            else:
                inside = self.row()
            self.bars -= 1
            self.close("|")
            return [r"\lvert ", *inside, r" \rvert "]
        bars, self.bars = self.bars, 0
        self.depth += 1
        inside = self.row()
        while self.now().text == ",":
            self.at += 1
            inside += [", ", *self.row()]
        self.close(BRACKETS[opening])
        self.bars = bars
        self.depth -= 1
        return [opening, *inside, BRACKETS[opening]]

    def close(self, closing):
        if self.now().text != closing:
            raise NoFormula
        self.at += 1

    def behind(self):
        """Exponents, indices, primes and degrees of an operand."""
        parts = []
        while not self.now().spaced and self.now().text in ("^", "²", "³", "°", "'", "_"):
            sign = self.now()
            if sign.text == "'":
                if self.now(1).kind in ("word", "letter") and not self.now(1).spaced:
                    return parts
                self.at += 1
                parts.append("'")
            elif sign.text in "^_":
                parts.append(f"{sign.text}{{{self.exponent()}}}")
            else:
                self.at += 1
                parts.append(r"^\circ" if sign.text == "°" else f"^{{{sign.text.translate(SMALL)}}}")
        return parts

    def exponent(self):
        """An exponent or index behind its sign: a number or letter with a sign perhaps, or something in brackets."""
        mark = self.at
        self.at += 1
        minus = ""
        if self.now().text in "-−" and not self.now(1).spaced:
            minus = "-"
            self.at += 1
        token = self.now()
        self.at += 1
        if token.kind == "number":
            return minus + number(token.text)
        if token.kind == "letter":
            return minus + letter(token.text)
        if token.text == "(":
            return minus + "".join(self.group("(")[1:-1])
        self.at = mark
        raise NoFormula


def is_formula(tokens, following):
    """Whether a row of tokens that can be a formula is one; `following` is the word behind it."""
    if all(token.kind in ("number", "mark", "dot", "other") for token in tokens):
        return any("e" in token.text or token.text in "^²³" for token in tokens) and tokens[0].kind != "mark"
    if all(token.kind in ("number", "mark", "dot", "other", "dots", "operator") for token in tokens):
        return any("e" in token.text or token.text in "^²³*" for token in tokens)
    if len(tokens) == 1:
        token = tokens[0]
        if token.kind == "word":
            return token.text not in NAMES
        if token.text in ("a", "A"):
            return following.text in AFTER_A_POINT or (not following.spaced and following.text in (",", ".", ")", ";", ":"))
        return token.kind == "letter" and token.text != "I"
    return not (len(tokens) == 3 and tokens[0].text == "(" and tokens[2].text == ")")  # a label


def in_text(text):
    """The running text of a paragraph, an item or a cell with its formulas set."""
    if text.strip() == "a":
        return text.replace("a", "$a$")  # a cell
    tokens = tokens_of(text)
    result, copied, at = [], 0, 0
    while at < len(tokens):
        token = tokens[at]
        before = text[token.start - 1] if token.start else " "
        try:
            is_unit = token.text in ("s", "m") and at and tokens[at - 1].kind == "number"
            if is_unit or re.match(r"[\w'`$-]", before) or (before == "." and not token.spaced):
                raise NoFormula
            tex, end = Parser(tokens, at).parse()
            following = tokens[end] if end < len(tokens) else Token("other", "", 0, 0, True)
            if tokens[end - 1].text == "a" and end - at > 1 and following.kind == "word" and following.text not in AFTER_A_POINT:
                raise NoFormula
            if not following.spaced and following.kind in ("word", "letter", "number") or not is_formula(tokens[at:end], following):
                raise NoFormula
        except NoFormula:
            at += 1
            continue
        tex = re.sub(r" +", " ", tex).strip()
        tex = re.sub(r"(?<![\w.}^])(\d+(?:\.\d+)?) / (\d+)(?![\d.]| *\^)", r"\\tfrac{\1}{\2}", tex)
        result += [text[copied : token.start], in_pieces(tex)]
        copied = tokens[end - 1].end
        at = end
    return "".join(result) + text[copied:]


def in_pieces(tex):
    """A formula between dollars, a long one in several, between which a line may end."""

    def signs(part):
        part = re.sub(r"\\(operatorname|mathrm|mathbin|sqrt|tfrac)", "", part)
        return len(re.sub(r"[{}^_ ]", "", re.sub(r"\\[a-z]+", "x", part)))

    pieces = [""]
    for part in tex.split(BREAK):
        if pieces[-1] and signs(pieces[-1]) + signs(part) > LONGEST:
            pieces.append("{}")
        pieces[-1] += part
    return " ".join(f"${piece.strip()}$" for piece in pieces)


KEPT = re.compile(r"`[^`]*`|!?\[[^\]\n]*\]\([^)\s]*\)|\*\*|(?<!\w)\*(?=\S)|(?<=\S)\*(?!\w)|<[a-z/][^>]*>|\b(?:e\.g\.|i\.e\.)|C\+\+|SIAM J\.|\bet al\.")


def with_formulas(document):
    """A document with its formulas set."""
    result, paragraph, fenced = [], [], False

    def in_paragraph(text):
        # What is kept is no token, and separates formulas.
        kept = []
        text = re.sub(KEPT, lambda match: kept.append(match[0]) or f"\x00{chr(0xE000 + len(kept) - 1)}\x00", text)
        return re.sub("\x00(.)\x00", lambda match: kept[ord(match[1]) - 0xE000], in_text(text))

    def finish():
        if paragraph:
            result.append(in_paragraph("\n".join(paragraph)))
            paragraph.clear()

    for line in document.split("\n"):
        fenced ^= line.startswith("```")
        if fenced or re.match(r"```|#|    (?! *[-*] )", line) or not line.strip() or re.fullmatch(r"[|\s:-]+", line):
            finish()
            result.append(line)
        elif line.startswith("| "):
            finish()
            result.append("|".join(in_paragraph(cell) for cell in re.split(r"(?<!\\)\|", line)))
        else:
            if re.match(r"\s*([-*]|\d+\.) ", line):
                finish()
            paragraph.append(line)
    finish()
    return "\n".join(result)
