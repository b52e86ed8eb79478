# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark suite: its arithmetic, its tables, and what it makes of programs that fail. The
programs here are one-line scripts.

    bench_suite_test.py SOURCE_FOLDER
"""

import csv
import json
import pathlib
import platform
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
sys.path.insert(0, str(ROOT / "bench"))

from suite import (  # noqa: E402
    accuracy,
    against_peers,
    compare,
    environment,
    hostile,
    ratios,
    rondel_alone,
)
from suite.peers import CGAL_PROJECTED, RONDEL, Peer  # noqa: E402
from suite.runs import SEED, Limits, Outcome, Results, run_in_turns, run_once  # noqa: E402
from suite.tables import Table, number, power, spread  # noqa: E402


def python(code):
    return [sys.executable, "-c", code]


def printing(**values):
    return python(f"print({json.dumps(json.dumps(values))})")


def results_of(**seconds):
    results = Results()
    for name, values in seconds.items():
        results.of[name] = [Outcome({"seconds": s, "sites": 1000}) for s in values]
    return results


class Accuracy(unittest.TestCase):
    def test_means_are_of_squares_and_ratios_of_sets_with_values(self):
        ours = [{key: 3.0 for key in accuracy.OURS}, {key: 4.0 for key in accuracy.OURS}]
        cells = accuracy.row("both", ours, [{"cubic": 6.0}, {"cubic": 8.0}])
        self.assertEqual(cells, ["both", *["3.54e+00"] * 7, "7.07e+00", "2", "2"])
        cells = accuracy.row("one", ours, [{"cubic": None}, {"cubic": 8.0}])
        self.assertEqual(cells[-3:], ["8.00e+00, 1 of 2", "2", "2"])

    def test_a_peer_that_fails_has_no_value(self):
        ours = [{key: 3.0 for key in accuracy.OURS}]
        self.assertEqual(accuracy.row("none", ours, [{}])[-3:], ["no value", "", ""])


class Processes(unittest.TestCase):
    def test_what_is_printed_is_the_outcome(self):
        outcome = run_once(printing(seconds=0.5, sites=2), 60)
        self.assertEqual(outcome, Outcome({"seconds": 0.5, "sites": 2}))

    def test_a_status_is_a_failure_with_the_first_line_of_the_errors(self):
        outcome = run_once(python("import sys; sys.exit('no such site.\\nmore')"), 60)
        self.assertEqual(outcome.failure, "stops: no such site")

    def test_a_signal_is_a_failure_with_its_name(self):
        outcome = run_once(python("import os; os.abort()"), 60)
        self.assertEqual(outcome.failure, "ended by SIGABRT")

    def test_a_run_that_takes_too_long_is_ended(self):
        start = time.monotonic()
        outcome = run_once(python("import time; time.sleep(60)"), 0.5)
        self.assertEqual(outcome.failure, "over 0.5 s")
        self.assertLess(time.monotonic() - start, 30)

    def test_cases_run_in_turns_and_failures_once(self):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder, "log")

            def case(name, then):
                return python(f"open({str(log)!r}, 'a').write({name!r}); {then}")

            results = run_in_turns({"a": case("a", "print('{}')"), "b": case("b", "exit(1)")},
                                   Limits(seconds=60, runs=3, budget=60))
            self.assertEqual(log.read_text(), "abaa")
        self.assertEqual(results.failure("a"), "")
        self.assertEqual(results.failure("b"), "stops: exit status 1")

    def test_each_turn_has_a_seed_of_its_own(self):
        show = "import json, sys; print(json.dumps({'seed': int(sys.argv[1])}))"
        results = run_in_turns({"a": [*python(show), SEED]}, Limits(seconds=60, runs=3, budget=60))
        self.assertEqual(results.all("a", "seed"), [1, 1_000_001, 2_000_001])

    def test_a_program_says_whether_it_takes_a_seed(self):
        with tempfile.TemporaryDirectory() as folder:
            for usage, wanted in (("KIND N [--seed S]", True), ("KIND N", False)):
                program = pathlib.Path(folder, "program")
                program.write_text(f"#!/bin/sh\necho 'usage: {usage}' >&2; exit 2\n")
                program.chmod(0o755)
                self.assertEqual(compare.takes_seed(program), wanted)

    def test_a_case_beyond_its_budget_is_not_repeated(self):
        results = run_in_turns({"a": printing(seconds=1)}, Limits(seconds=60, runs=3, budget=0))
        self.assertEqual(len(results.of["a"]), 1)


class Arithmetic(unittest.TestCase):
    def test_medians_and_extremes_are_per_site(self):
        results = results_of(a=[3e-6, 1e-6, 2e-6, 8e-6])
        for got, wanted in zip(results.ns_each("a"), (2.5, 1, 8), strict=True):
            self.assertAlmostEqual(got, wanted)

    def test_a_ratio_is_of_medians_and_has_those_of_single_turns(self):
        results = results_of(a=[4, 9, 6], b=[2, 3, 1])
        self.assertEqual(results.ratio("a", "b"), (3, 2, 6))

    def test_a_result_with_other_vertices_or_an_open_surface_is_a_failure(self):
        def failure(vertices, faces):
            values = {"vertices": vertices, "faces": faces}
            return against_peers.verdict(Outcome(values), 1000).failure

        self.assertEqual(failure(1000, 1996), "")
        self.assertEqual(failure(997, 1990), "997 vertices instead of 1,000")
        self.assertEqual(failure(1000, 1995), "1,995 faces instead of 1,996")

    def test_growth_is_beside_the_cost_at_a_million(self):
        points = [(2**k, {"1 thread": (ns, 90)}) for k, ns in ((18, 180), (20, 200), (22, 260))]
        self.assertEqual(rondel_alone._growth(points, "1 thread"),
                         ["2^22 / 2^20, 1 thread, per site: 1.30"])
        self.assertEqual(rondel_alone._growth(points[:1], "1 thread"), [])

    def test_a_hostile_kind_is_beside_as_many_uniform_sites_of_the_same_turns(self):
        def outcome(sites, us_each):
            return Outcome({"seconds": sites * us_each * 1e-6, "sites": sites})

        results = Results()
        results.of = {("uniform", 10): [outcome(10, 2)], ("uniform", 80): [outcome(80, 4)],
                      ("wedge", 10): [outcome(10, 5), outcome(10, 7), outcome(10, 6)],
                      ("wedge", 80): [outcome(80, 9)],
                      ("cap", 10): [outcome(10, 1)], ("cap", 80): [Outcome(failure="over 2 s")]}
        self.assertEqual(hostile.row(results, "wedge", (10, 80)),
                         ["wedge", "6,000", "3.00", "9,000", "2.25", "1.50"])
        self.assertEqual(hostile.row(results, "cap", (10, 80)),
                         ["cap", "1,000", "0.50", "over 2 s", "", ""])

    def test_memory_is_of_large_inputs_or_of_the_largest_that_went_well(self):
        def results(**bytes_or_failure):
            made = Results()
            for name, value in bytes_or_failure.items():
                values = {"bytes_per_site": value, "sites": 10, "vertices": 5}
                made.of[name] = [Outcome(failure=value) if isinstance(value, str)
                                 else Outcome(values)]
            return made

        by_size = {2**14: results(a=1, b=30), 2**18: results(a=10, b="over 2 s"),
                   2**20: results(a=20, b="over 2 s at 2^18")}
        those = [Peer("a", ""), Peer("b", ""), Peer("c", "")]
        for r in by_size.values():
            r.of["c"] = [Outcome(failure="stops")]
        self.assertEqual(against_peers.memory_table(those, by_size).rows,
                         [["a", "30.0", "2^18, 2^20"], ["b", "60.0", "2^14"], ["c", "", ""]])

    def test_a_commit_is_slower_when_the_ratio_is_beyond_what_is_allowed(self):
        self.assertTrue(compare.is_slower((1.06, 0.9, 1.2), 5))
        self.assertFalse(compare.is_slower((1.04, 0.9, 1.2), 5))

    def test_commits_that_make_other_inputs_do_not_compare(self):
        made = Results()
        made.of = {"a": [Outcome({"sites": 9, "vertices": 9})],
                   "b": [Outcome({"sites": 9, "vertices": 5})],
                   "c": [Outcome({"sites": 9})]}
        self.assertTrue(compare.makes_other_inputs(made, "a", "b"))
        self.assertFalse(compare.makes_other_inputs(made, "a", "c"))
        self.assertFalse(compare.makes_other_inputs(made, "a", "a"))


class Environment(unittest.TestCase):
    def test_a_processor_is_named_with_its_model_and_its_widest_vectors(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "cpuinfo")
            path.write_text("cpu family\t: 6\nmodel\t\t: 85\nmodel name\t: Xeon\n"
                            "flags\t\t: fpu avx2 avx512vl\n\n")
            self.assertEqual(environment.processor(path), "Xeon (cpu family 6, model 85, avx512vl)")
            path.write_text("processor: 0\n")
            self.assertEqual(environment.processor(path), platform.machine())


class Ratios(unittest.TestCase):
    def test_first_builds_and_narrow_vectors_have_rows_of_their_own(self):
        def outcome(warm, first):
            return [Outcome({"seconds": warm, "first_seconds": first})]

        results = Results()
        results.of = {CGAL_PROJECTED.label: outcome(6, 12), RONDEL.label: outcome(2, 3),
                      ratios.NARROW: outcome(3, 4)}
        rows = list(ratios._rows(results, CGAL_PROJECTED, "uniform", RONDEL.label, 1))
        self.assertEqual([row[2] for row in rows], ["3.00", "4.00", "2.00"])
        rows = list(ratios._rows(results, CGAL_PROJECTED, "uniform", RONDEL.label, 2))
        self.assertEqual(len(rows), 1)


class Tables(unittest.TestCase):
    def test_numbers_have_the_digits_that_matter(self):
        self.assertEqual([number(x) for x in (0.126, 9.5, 45.67, 1234.5)],
                         ["0.13", "9.50", "45.7", "1,234"])
        self.assertEqual([power(2**20), power(1000)], ["2^20", "1,000"])
        self.assertEqual(spread((2, 1, 3)), "2.00 (1.00 to 3.00)")
        self.assertEqual(spread((2, 2, 2)), "2.00")

    def test_a_table_is_markdown_and_csv(self):
        table = Table("Title", ["a", "b"], [["1", "2|3"]], ["A note."])
        self.assertEqual(table.markdown(), "### Title\n\n| a | b |\n| --- | --- |\n"
                                           "| 1 | 2\\|3 |\n\nA note.\n")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "table.csv")
            table.write_csv(path)
            with open(path, newline="", encoding="utf-8") as file:
                self.assertEqual(list(csv.reader(file)), [["a", "b"], ["1", "2|3"]])


if __name__ == "__main__":
    unittest.main()
