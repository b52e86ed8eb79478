# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The table of tests/fuzz/README.md: every public function has a fuzzer, which calls it.

    fuzzers_test.py SOURCE_FOLDER NAME:SOURCE_FILE...

The fuzzers are named as CMake knows them.
"""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
FUZZERS = dict(argument.split(":") for argument in sys.argv[1:])
del sys.argv[1:]

# What only a program can ask for, once; and the memory of vectors, which calls of others use.
NOT_CALLED = {
    "operator",
    "void",  # a member that is a pointer to a function
    "remove_temporaries",
    "allocate_large",
    "free_large",
    "allocate",
    "deallocate",
    "construct",
}


# Headers for programs that link what no fuzzer does: MPI.
LEFT_OUT = {"mpi.h"}


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def public_names(text):
    """The functions that a header declares: `name`, and `Class::name` for members."""
    names = set()
    scopes = []  # of the open braces: the class, "()" for a function's body, None for others
    statement = ""
    for character in re.sub(r"template <[^<>]*>", "", without_comments(text)):
        statement += character
        if character not in "{};":
            continue
        inside = next((s for s in reversed(scopes) if s not in (None, "()")), None)
        is_private = inside is not None and inside.endswith(" private")
        label = re.search(r"\b(private|public):", statement)
        if label and scopes:
            scopes[-1] = scopes[-1].split()[0] + (" private" if label[1] == "private" else "")
            is_private = label[1] == "private"
            statement = statement[label.end() :]
        opened = re.search(r"\b(?:class|struct) (?:RONDEL_API )?(\w+)[^;()]*\{$", statement)
        found = re.search(r"([~\w]+) ?\(", re.sub(r"\boperator[^\w\s(]+", "operator", statement))
        is_body = "()" in scopes
        if found and not (opened or is_private or is_body or re.search(r"\b(friend|using)\b", statement)):
            names.add(f"{inside}::{found[1]}" if inside else found[1])
        if character == "{":
            scopes.append(opened[1] if opened else "()" if found else None)
        elif character == "}" and scopes:
            scopes.pop()
        statement = ""
    return names


def is_counted(name):
    """Not constructors, which are called like their class, nor what NOT_CALLED lists."""
    last = name.split("::")[-1]
    return last not in NOT_CALLED and last.islower()


def rows():
    """(names in the first column, fuzzers in the second) of the table."""
    text = (ROOT / "tests/fuzz/README.md").read_text(encoding="utf-8")
    lines = text.partition("| public function |")[2].partition("\n\n")[0].splitlines()[2:]
    for line in lines:
        cells = line.split("|")
        yield re.findall(r"`([\w:]+)", cells[1]), re.findall(r"`(\w+)`", cells[2])


class Fuzzers(unittest.TestCase):
    def test_the_reader_of_headers_finds_functions(self):
        found = set()
        for header in (ROOT / "include/rondel").glob("*.h"):
            found |= public_names(header.read_text(encoding="utf-8"))
        for name in ("delaunay", "Locator::k_nearest", "DynamicTriangulation::insert", "write_cells"):
            self.assertIn(name, found)
        self.assertNotIn("Triangulation::arrays_", found)

    def test_every_public_function_is_in_the_table(self):
        listed = {name for names, _ in rows() for name in names}
        for header in sorted((ROOT / "include/rondel").glob("*.h")):
            if header.name in LEFT_OUT:
                continue
            for name in filter(is_counted, public_names(header.read_text(encoding="utf-8"))):
                self.assertIn(name, listed, f"{header.name} has no fuzzer in the table")

    def test_every_fuzzer_exists_and_is_in_the_table(self):
        listed = {fuzzer for _, fuzzers in rows() for fuzzer in fuzzers}
        self.assertEqual(listed, set(FUZZERS))

    def test_a_fuzzer_calls_the_function(self):
        folder = ROOT / "tests/fuzz"
        fuzzers_of = {}
        for names, fuzzers in rows():
            for name in names:
                fuzzers_of.setdefault(name, set()).update(fuzzers)
        for name, fuzzers in fuzzers_of.items():
            sources = (folder / FUZZERS[fuzzer] for fuzzer in fuzzers)
            text = " ".join(without_comments(s.read_text(encoding="utf-8")) for s in sources)
            call = rf"\b{name.split('::')[-1]}(<[\w:]+>)?\("
            self.assertIsNotNone(re.search(call, text), f"{fuzzers} do not call {name}")


if __name__ == "__main__":
    unittest.main()
