# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The model of many ranks and threads: ledgers that were made by known formulas give these back.

    scale_model_test.py SOURCE_FOLDER
"""

import contextlib
import io
import json
import math
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
sys.path.insert(0, str(ROOT / "bench"))

from suite import scale_model  # noqa: E402
from suite.scale_model import Network, RanksModel, ThreadsModel  # noqa: E402


def run_of(n, ranks):
    """One nanosecond for each of N sites, and 100 for each of sqrt(n P) sites on rank 0 and of sqrt(N)."""
    joined = 1e-7 * math.sqrt(n * ranks)
    phases = []
    for name in scale_model.WORK:
        share = 1e-7 * math.sqrt(n / ranks) if name == "number" else 1e-9 * n / ranks
        first, most = (joined, 0.0) if name == "join" else (share, share)
        sent = 28 * n / ranks * (1 - 1 / ranks) if name == "scatter" else 0
        if name == "join":
            sent = 1000 * math.sqrt(n * ranks) * (1 - 1 / ranks)
        phases.append({"phase": name, "first_seconds": first, "max_seconds": most,
                       "all_seconds": first + most * (ranks - 1), "first_bytes": sent,
                       "max_bytes": sent if name == "scatter" else 0,
                       "all_bytes": sent * (ranks if name == "scatter" else 1), "calls": 2})
    return {"sites": n, "ranks": ranks, "open_sites": 11 * math.sqrt(n * ranks),
            "seconds_in_memory": 4e-9 * n, "phases": phases}


THREADS = {"sites": 2**20, "threads": 64, "alone": 0.25,
           "shared": [{"alone": 0.5, "pieces": 100, "seconds": 8, "longest": 0.5},
                      {"alone": 0.25, "pieces": 6, "seconds": 2, "longest": 1.5}]}
LEDGER = {"ranks": {"processor": "a processor",
                    "runs": [run_of(n, p) for n in (10**6, 10**8) for p in (1, 4, 64)]},
          "threads": {"processor": "another one", "runs": [THREADS]}}


class Fits(unittest.TestCase):
    def test_factors_are_found(self):
        rows = [((x, math.sqrt(x)), 3 * x + 2 * math.sqrt(x)) for x in (1, 10, 100)]
        self.assertTrue(all(math.isclose(f, g, rel_tol=1e-9) for f, g in
                            zip(scale_model.fit(rows, ("N", "sqrt N")), (3, 2))))

    def test_no_factor_is_negative(self):
        rows = [((x, math.sqrt(x)), 3 * x - 0.5 * math.sqrt(x)) for x in (1, 10, 100)]
        self.assertGreaterEqual(min(scale_model.fit(rows, ("N", "sqrt N"))), 0)

    def test_terms_that_say_the_same_are_one(self):
        rows = [((x, 2 * x), 3 * x) for x in (1, 10)]
        a, b = scale_model.fit(rows, ("N", "P"))
        self.assertAlmostEqual(a + 2 * b, 3)


class Ranks(unittest.TestCase):
    def setUp(self):
        self.model = RanksModel(LEDGER["ranks"]["runs"])

    def test_runs_of_the_ledger_come_back(self):
        self.assertLess(self.model.worst_error(), 1e-6)

    def test_time_beyond_the_ledger_is_that_of_the_formulas(self):
        n, ranks = 10**10, 1000
        seconds = 4e-9 * n / ranks + 1e-7 * (math.sqrt(n / ranks) + math.sqrt(n * ranks))
        free = Network(1e-30, 1e30)
        self.assertAlmostEqual(self.model.wall(n, ranks, free), seconds, places=6)
        self.assertAlmostEqual(self.model.in_memory(n), 40, places=6)
        self.assertAlmostEqual(self.model.num_open_sites(n, ranks), 11 * math.sqrt(n * ranks), places=3)

    def test_messages_cost_their_latency_and_their_bytes(self):
        n, ranks = 10**10, 1000
        free = self.model.wall(n, ranks, Network(1e-30, 1e30))
        late = self.model.wall(n, ranks, Network(1e-3, 1e30))
        self.assertAlmostEqual(late - free, 6 * 2 * 999 * 1e-3, places=6)
        slow = self.model.wall(n, ranks, Network(1e-30, 1e9))
        sent = (28 * 1e7 + 1000 * math.sqrt(n * ranks)) * (1 - 1e-3)
        self.assertAlmostEqual(slow - free, sent / 1e9, places=6)

    def test_one_rank_sends_nothing(self):
        self.assertEqual(self.model.network_seconds("scatter", 10**6, 1, Network(1, 1)), 0)


class Threads(unittest.TestCase):
    def test_loops_are_shared_as_far_as_their_pieces_go(self):
        model = ThreadsModel(THREADS)
        self.assertAlmostEqual(model.alone, 1)
        self.assertAlmostEqual(model.all, 11)
        self.assertAlmostEqual(model.wall(1), 11)
        self.assertAlmostEqual(model.wall(2), 1 + 4 + 1.5)
        self.assertAlmostEqual(model.waiting(2), 0.5)
        self.assertAlmostEqual(model.wall(math.inf), 1 + 0.5 + 1.5)


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.ledger = pathlib.Path(folder.name, "ledger.json")
        self.ledger.write_text(json.dumps(LEDGER))

    def run_command(self, *words):
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            try:
                scale_model.main(list(words))
            except SystemExit as end:
                return f"{output.getvalue()}{end.code}"
        return output.getvalue()

    def test_every_table_says_that_it_is_a_model(self):
        for words in (["ranks", "--sites", "1e9", "--ranks", "1", "1000"], ["threads"]):
            for ledger in ([], ["--ledger", str(self.ledger)]):
                text = self.run_command(*words, *ledger)
                self.assertIn("A model, not a measurement", text)

    def test_ranks_and_threads_are_rows(self):
        text = self.run_command("ranks", "--ranks", "7", "--ledger", str(self.ledger))
        self.assertIn("\n| 7 | 1,428,571,429 |", text)
        text = self.run_command("threads", "--threads", "1", "2", "--ledger", str(self.ledger))
        self.assertIn("\n| 2^20 | 2 | 6.50 | 1,000 |", text)

    def test_the_ledger_is_kept_as_it_is_written(self):
        text = scale_model.LEDGER.read_text(encoding="utf-8")
        self.assertEqual(scale_model.text_of(json.loads(text)), text)

    def test_what_is_wrong_is_named(self):
        self.assertIn("'0' is not a number of", self.run_command("ranks", "--ranks", "0"))
        self.assertIn("'many' is not a number of", self.run_command("threads", "--threads", "many"))
        self.assertIn("no-file: ", self.run_command("threads", "--ledger", "no-file"))
        self.ledger.write_text("[]")
        self.assertIn("not a ledger", self.run_command("threads", "--ledger", str(self.ledger)))


if __name__ == "__main__":
    unittest.main()
