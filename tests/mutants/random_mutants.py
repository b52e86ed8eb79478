# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Random changes of a layer, all in one build (switches.py), and the cases of tests that find them."""

import os
import sys
import time

import built_tests
import random_changes
import switches

REACHED = built_tests.BUILD / "reached"
PATIENCE = 20  # times as much computing as without a mutant, which may never end
LEAST_PATIENCE = 5  # seconds of computing
MAX_BUILDS = 12


class Changes:
    """The changes of a layer in the order in which they are drawn, and its files."""

    def __init__(self, layer, seed):
        self.layer = layer
        self.texts = {f"src/{layer}/{path.name}": path.read_bytes().decode("latin-1")  # a letter is a byte
                      for pattern in ("*.cpp", "*.h") for path in (built_tests.ROOT / "src" / layer).glob(pattern)}
        self.drawn = random_changes.drawn(self.texts, seed)
        self.arguments = switches.compiler_arguments(built_tests.BUILD, layer)
        self.sources = {}

    def source(self, file):
        """Where libclang has read it."""
        if file not in self.sources:
            texts = {str(built_tests.TREE / name): text for name, text in self.texts.items()}
            self.sources[file] = switches.Source(str(built_tests.TREE / file), texts, self.arguments)
        return self.sources[file]

    def span(self, number):
        """The lines of the expression that a change replaces, (file, first, last), None if there is none."""
        file, _, begin, end, new = self.drawn[number]
        around = self.source(file).switched_range(begin, end, new)
        return around and (file, *(self.texts[file].count("\n", 0, place) + 1 for place in around))

    def name(self, number):
        file, line, begin, end, new = self.drawn[number]
        shown = self.texts[file].splitlines()[line - 1].strip()
        return f"{file}:{line}: {self.texts[file][begin:end]} -> {new or 'nothing'} in: {shown}"

    def texts_with(self, numbers):
        """The files with the changes of these numbers behind switches, {name: bytes}."""
        result = {}
        for number in numbers:
            file, _, begin, end, new = self.drawn[number]
            result.setdefault(file, {})[number] = (begin, end, new)
        result = {file: switches.switched(self.source(file), changes) for file, changes in result.items()}
        home = min(file for file in self.texts if file.endswith(".cpp"))
        original = self.texts[home].encode("latin-1")
        result[home] = result.get(home, original) + switches.DEFINITION % len(self.drawn)
        return result


def built(changes, count, tests):
    """The numbers of the first `count` changes that the compiler takes, all of which are in the build."""
    spans = {}
    num_tried = 0
    for _ in range(MAX_BUILDS):
        while len(spans) < count + count // 10 and num_tried < len(changes.drawn):
            span = changes.span(num_tried)
            if span is not None:
                spans[num_tried] = span
            num_tried += 1
        built_tests.copy_tree(changes.texts_with(spans))
        is_built, message = built_tests.build(tests)
        if is_built:
            return sorted(spans)[:count]
        bad = switches.refused(message, changes.layer, spans)
        if not bad:
            break
        print(f"the compiler refuses {len(bad)} of {len(spans)} changes", flush=True)
        spans = {number: span for number, span in spans.items() if number not in bad}
    sys.exit(f"the code with switches cannot be built: {built_tests.LOG} says why")


def reach(cases, num_changes):
    """How long each case computes without a mutant, and the numbers of the changes that it reaches: {case: (time, set)},
    the quickest first."""
    os.environ["RONDEL_REACHED"] = str(REACHED)
    result = {}
    for case in cases:
        REACHED.write_bytes(bytes(num_changes))
        seconds = built_tests.time_without_mutant(case)
        result[case] = seconds, {number for number, byte in enumerate(REACHED.read_bytes()) if byte != 0}
    del os.environ["RONDEL_REACHED"]
    return dict(sorted(result.items(), key=lambda item: item[1][0]))


def first_to_fail(number, reached):
    """The first case that fails with a mutant, None if there is none, and how many reach it."""
    cases = [(case, seconds) for case, (seconds, numbers) in reached.items() if number in numbers]
    os.environ["RONDEL_MUTANT"] = str(number)
    found = next((case for case, seconds in cases
                  if not built_tests.passes(case, built_tests.SCALES[0], max(LEAST_PATIENCE, PATIENCE * seconds))), None)
    del os.environ["RONDEL_MUTANT"]
    return found, len(cases)


def killed_and_survivors(layer, seed, count, tests):
    """How many of `count` random changes of a layer tests kill, and the names of those that survive."""
    changes = Changes(layer, seed)
    numbers = built(changes, count, tests)
    reached = reach([case for test in tests for case in built_tests.cases_of(test)], len(changes.drawn))
    num_killed = 0
    survivors = []
    for number in numbers:
        start = time.monotonic()
        found, num_cases = first_to_fail(number, reached)
        name = changes.name(number)
        if found is None:
            survivors.append(name)
            print(f"survived {name}, which {num_cases} tests reach ({time.monotonic() - start:.0f} s)", flush=True)
        else:
            num_killed += 1
            print(f"killed   {name} by {found} ({time.monotonic() - start:.0f} s)", flush=True)
    return num_killed, survivors
