# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Random small changes of C++ sources: another operator, another constant, a condition turned around.

The sources are laid out by clang-format, so a binary operator has a space on both sides, and a template's brackets have
none. Comments, literals of text, directives, and lines that cannot change a result stay as they are.
"""

import random
import re

OPERATORS = {
    "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!="], "!=": ["=="],
    "&&": ["||"], "||": ["&&"], "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["/"],
    "+=": ["-="], "-=": ["+="], "*=": ["/="], "|=": ["&="], "&=": ["|="], "<<": [">>"], ">>": ["<<"],
}
WORDS = {"true": "false", "false": "true", "break": "continue", "min": "max", "max": "min",
         "lower_bound": "upper_bound", "upper_bound": "lower_bound", "any_of": "all_of", "all_of": "any_of",
         "front": "back", "back": "front"}
BINARY = re.compile(r"(?<= )(<=|>=|==|!=|&&|\|\||\+=|-=|\*=|\|=|&=|<<|>>|[-<>+*/%])(?= )")
NUMBER = re.compile(r"(?<![\w.\"'])(0x[\da-f.]+p-?\d+|\d+\.\d+(?:e-?\d+)?|\d+e-?\d+|\d+)(?![\w.'])")
WORD = re.compile(r"\b(" + "|".join(WORDS) + r")\b(?=[;(,) ])")
NEGATION = re.compile(r"(?<=[( ])!(?=[\w(])")
# Streams, prefetches and sizes of pieces of work change no result; what the first of these lines declare is known to the
# compiler alone.
WITHOUT_EFFECT = re.compile(r"^\s*#|^\s*(using|namespace|template|static_assert|friend)\b|prefetch|reserve\(|assert\(|^\}"
                            r"|(grain|_per_(piece|block|task|step|wave)|of_a_piece) = ")
# A variable whose initial value nobody reads: the next mention of it is its address, where a call puts the value.
INITIAL = re.compile(r"^\s*[\w:]+ (\w+) = [\w.]+;$")
TEXT = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'", re.S)


def blanked(source):
    """The source with comments and literals of text replaced by as many letters, which no pattern takes."""
    return TEXT.sub(lambda found: re.sub(r"[^\n]", "_", found[0]), source)


def other_number(text, generator):
    """A number in the place of another one."""
    if set(text) & set(".ep"):
        value = float.fromhex(text) if "p" in text else float(text)
        return "1.0" if value == 0 else generator.choice([f"(2 * {text})", f"({text} / 2)", "0.0"])
    value = int(text)
    return str(generator.choice([value + 1, value - 1] if value > 0 else [1]))


def is_overwritten(line, rest):
    """Whether the line gives a variable a value that the rest of the code replaces first."""
    found = INITIAL.match(line)
    if found is None:
        return False
    mention = re.search(rf"(&?)\b{found[1]}\b", rest)
    return mention is not None and mention[1] == "&"


def changes(source, generator):
    """All changes of a source, (line number from 1, begin, end, new text), one for each place."""
    code = blanked(source)
    begins = [0, *(found.end() for found in re.finditer(r"\n", code))]
    result = []
    for number, begin in enumerate(begins, 1):
        line = code[begin:code.find("\n", begin) if "\n" in code[begin:] else len(code)]
        if WITHOUT_EFFECT.search(line) or is_overwritten(line, code[begin + len(line):]):
            continue
        for pattern, other in (
            (BINARY, lambda text: generator.choice(OPERATORS[text])),
            (NUMBER, lambda text: other_number(text, generator)),
            (WORD, lambda text: WORDS[text]),
            (NEGATION, lambda text: ""),
        ):
            for found in pattern.finditer(line):
                result.append((number, begin + found.start(), begin + found.end(), other(found[0])))
    return result


def drawn(files, seed):
    """All changes of files, a dictionary of sources by name, in an order that the seed decides: (file, line, begin, end,
    new text)."""
    generator = random.Random(seed)
    places = [(file, *change) for file, source in sorted(files.items()) for change in changes(source, generator)]
    generator.shuffle(places)
    return places
