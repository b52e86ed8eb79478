# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Fills in what the scripts for Gappa take from the code.

    make_scripts.py FORMULAS SCRIPTS OUTPUT

FORMULAS is what extract.cpp writes. In a script stand for numbers of the code:

    @factor TERM@                   the constant by which a term begins
    @twice TERM@                    two times that
    @most BITS TERM [SUM PRODUCT]@  the largest relative error of a term, k u + (k u)^2 for the k roundings that it
                                    counts, u = 2^-BITS (a sum counts SUM of them, a product PRODUCT)
    @most_of_part BITS TERM PART..@ the same of an operand of a term (1 or 2), an operand of that, ...
    @factor_of_part TERM PART@      the constant by which an operand of a term begins

rounding.v counts once more, and a certificate for another number proves nothing there.
"""

import pathlib
import re
import sys

TOKEN = re.compile(r"[()]|[^\s()]+")


def parsed(text):
    """A term of Coq as nested lists."""
    stack = [[]]
    for token in TOKEN.findall(text):
        if token == "(":
            stack.append([])
        elif token == ")":
            last = stack.pop()
            stack[-1].append(last)
        else:
            stack[-1].append(token)
    return stack[0][0]


def number(item):
    return int(item[0] if isinstance(item, list) else item)


def count(term, of_sum=1, of_product=1):
    """The roundings of a term."""
    name, *operands = term
    if name in ("Given", "Constant"):
        return 0
    if name == "Scaled":
        return count(operands[0], of_sum, of_product)
    counts = [count(operand, of_sum, of_product) for operand in operands]
    if name in ("Plus", "Minus"):
        return max(counts) + of_sum
    if name == "Times":
        return sum(counts) + of_product
    return max(counts)


def read_formulas(path):
    text = path.read_text(encoding="utf-8")
    definition = r"Definition (\w+)(?: \(shift : nat -> Z\))? : term := (.*)\.\n"
    return {name: parsed(body) for name, body in re.findall(definition, text)}


def factor(term):
    """The constant by which a product begins, as Gappa writes numbers."""
    while term[0] == "Times":
        term = term[1]
    if term[0] != "Constant":
        raise ValueError("the term does not begin with a constant")
    return f"{number(term[1])}b{number(term[2])}"


def most(bits, k):
    """k u + (k u)^2."""
    return f"{k * 2**bits + k * k}b-{2 * bits}"


def filled(script, formulas):
    """A script with the numbers of the code in it."""

    def replaced(match):
        word, *arguments = match.group(1).split()
        if word == "factor":
            return factor(formulas[arguments[0]])
        if word == "twice":
            mantissa, exponent = factor(formulas[arguments[0]]).split("b")
            return f"{mantissa}b{int(exponent) + 1}"
        if word == "factor_of_part":
            return factor(formulas[arguments[0]][int(arguments[1])])
        bits, name, *rest = arguments
        term = formulas[name]
        if word == "most_of_part":
            for part in rest:
                term = term[int(part)]
            rest = []
        return most(int(bits), count(term, *map(int, rest)))

    return re.sub(r"@([^@]*)@", replaced, script)


def main():
    formulas = read_formulas(pathlib.Path(sys.argv[1]))
    output = pathlib.Path(sys.argv[3])
    wrong = []
    for path in sorted(pathlib.Path(sys.argv[2]).glob("*.g")):
        try:
            script = filled(path.read_text(encoding="utf-8"), formulas)
            (output / path.name).write_text(script, encoding="utf-8")
        except (KeyError, ValueError) as error:
            wrong.append(f"{path.name} cannot be filled in: {error}")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
