# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that the theorems are about all that the filters compare.

    check_formulas.py FORMULAS PROOFS

FORMULAS is what extract.cpp writes, PROOFS the folder of the theorems and of constants.toml. A comparison is one of

    a guard       against a constant other than 0: listed with that constant in constants.toml
    a choice      of a formula: listed there, too
    a sign        the value against 0: a theorem names the value
    acceptance    the value, its square or its size against a limit: a theorem names the limit, and so the left side
                  unless it is made of the value that the theorem names
"""

import pathlib
import re
import sys

import tomllib
from make_scripts import factor, read_formulas

ZERO = ["Constant", "0", "0"]


def comparisons_of(formulas):
    """For each filter the comparisons of its run: name, left, right."""
    found = {}
    for name in formulas:
        match = re.fullmatch(r"(\w+?)_(\d+)_right", name)
        if match:
            place = f"{match[1]}_{match[2]}"
            found.setdefault(match[1], []).append((place, formulas[f"{place}_left"], formulas[name]))
    return found


def is_constant(term):
    return term[0] == "Constant"


def number_of(term):
    """A constant as constants.toml writes it."""
    digits = [item[0] if isinstance(item, list) else item for item in term[1:]]
    return f"{digits[0]}b{digits[1]}"


def forms_of(value):
    """What a filter may compare of a value."""
    return value, ["Opposite", value], ["Times", value, value], ["Absolute", value]


def values_named(comparisons, named):
    """The values whose signs are asked and which a theorem names; without a sign, what a theorem compares."""
    signs = [left for place, left, right in comparisons if right == ZERO and f"{place}_left" in named]
    sides = [left for place, left, _ in comparisons if {f"{place}_left", f"{place}_right"} <= named]
    return signs or sides


def what_is_wrong(comparison, comparisons, named, guards):
    """Why a comparison is not that of a theorem, or None."""
    place, left, right = comparison
    if left[0] == "Opposite" and any(left[1] == limit for _, _, limit in comparisons):
        # -limit > value is -value > limit.
        left, right = ["Opposite", right], left[1]
    values = values_named(comparisons, named)
    # The same limit may be compared more than once.
    same_limit = {name for name, _, other in comparisons if other == right}
    if ZERO in (left, right):
        value = right if left == ZERO else left
        known = any(value in forms_of(named_value) for named_value in values)
        return None if known else "asks the sign of a value that no theorem names"
    constant = left if is_constant(left) else right
    if place in guards:
        expected = guards[place]
        if not is_constant(constant):
            return None if expected == "choice" else "is no guard"
        return None if number_of(constant) == expected else f"guards with {number_of(constant)} and not {expected}"
    if is_constant(constant):
        return f"is a guard with {number_of(constant)} that constants.toml does not list"
    if not any(f"{name}_right" in named for name in same_limit):
        return "accepts by a limit that no theorem names"
    if any(left in forms_of(value) for value in values):
        return None
    return "accepts by something else than the value that the theorem names"


def mistakes(formulas, proofs):
    theorems = "".join(path.read_text(encoding="utf-8") for path in sorted(proofs.glob("*.v")))
    named = set(re.findall(r"\b\w+_(?:left|right)\b", theorems))
    listed = tomllib.loads((proofs / "constants.toml").read_text(encoding="utf-8"))
    guards = {place: guard["constant"] for guard in listed["guard"] for place in guard["places"]}
    found, seen = [], set()
    runs = comparisons_of(formulas)
    for name, comparisons in runs.items():
        # The first tries of a filter, where another run is about them.
        others = [item for other in listed.get("first_try", []) if other["of"] == name for item in runs[other["run"]]]
        for comparison in comparisons:
            if any(comparison[1:] == other[1:] for other in others):
                continue
            wrong = what_is_wrong(comparison, comparisons, named, guards)
            if wrong:
                found.append(f"{comparison[0]} {wrong}")
        seen.update(place for place, _, _ in comparisons)
    for place, other in listed["same_constant"]:
        if factor(formulas[f"{place}_right"]) != factor(formulas[f"{other}_right"]):
            found.append(f"{place} has another constant than {other}")
    return found + [f"{place} is listed as a guard and is none" for place in sorted(set(guards) - seen)]


def main():
    found = mistakes(read_formulas(pathlib.Path(sys.argv[1])), pathlib.Path(sys.argv[2]))
    if found:
        sys.exit("\n".join(found))


if __name__ == "__main__":
    main()
