# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How builds by many ranks or threads would scale: a model, from a ledger of measured parts.

The ledger has what each phase costs each of simulated ranks (ranks_bench), and what simulated threads
share and what one of them does alone (threads_bench), in processor time of one thread. The time of a phase
of ranks is fitted by terms that its work consists of, N = n / P sites of a rank and sqrt(n P) sites that
rank 0 joins; a message costs its latency for each other rank and its bytes at the bandwidth. A loop that
threads share takes as long as its longest piece, or a thread's share of all pieces if that is more. Nothing
else is in it: not the memory bandwidth that cores share, not the file system, nobody who waits for noise.
"""

import argparse
import dataclasses
import json
import math
import pathlib
import re
import subprocess
import sys

from . import environment
from .settings import ROOT
from .tables import Table, number, power

LEDGER = pathlib.Path(__file__).with_name("ledger.json")
# Of a rank, of rank 0 for each site that it joins (docs/guide/distributed.md).
BYTES_OF_SITE = 130
BYTES_OF_OPEN_SITE = 330

# The terms of the time of rank 0 and of the others, by phase; n sites on P ranks.
TERMS = {
    "N": lambda n, ranks: n / ranks,
    "sqrt N": lambda n, ranks: math.sqrt(n / ranks),
    "sqrt nP": lambda n, ranks: math.sqrt(n * ranks),
    "P": lambda n, ranks: ranks,
}
WORK = {
    "count": {"first": ("N", "P"), "max": ("N", "P")},
    "scatter": {"first": ("N",), "max": ("N",)},
    "triangulate": {"first": ("N", "sqrt N"), "max": ("N", "sqrt N")},
    "join": {"first": ("sqrt nP", "P"), "max": ("sqrt N", "P")},
    "number": {"first": ("sqrt nP", "sqrt N"), "max": ("sqrt N", "P")},
    "finish": {"first": ("N", "P"), "max": ("N", "P")},
}


def fit(rows, terms):
    """Factors, none negative, of one or two terms, with the least sum of squared relative errors.
    `rows`: (values of the terms, result)."""
    rows = [([v / y for v in values], 1.0) for values, y in rows if y > 0]

    def alone(i):
        square = sum(v[i] * v[i] for v, _ in rows)
        return sum(v[i] * y for v, y in rows) / square if square else 0.0

    def error(factors):
        return sum((sum(f * x for f, x in zip(factors, v)) - y) ** 2 for v, y in rows)

    if len(terms) == 1:
        return [alone(0)]
    (a, b, d), (s, t) = _normal_equations(rows)
    candidates = [[alone(0), 0.0], [0.0, alone(1)]]
    determinant = a * d - b * b
    if determinant > 1e-12 * a * d:
        both = [(s * d - b * t) / determinant, (a * t - b * s) / determinant]
        if min(both) >= 0:
            candidates.append(both)
    return min(candidates, key=error)


def _normal_equations(rows):
    matrix = [sum(v[i] * v[j] for v, _ in rows) for i, j in ((0, 0), (0, 1), (1, 1))]
    return matrix, [sum(v[i] * y for v, y in rows) for i in (0, 1)]


@dataclasses.dataclass(frozen=True)
class Network:
    latency: float  # seconds a message
    bandwidth: float  # bytes a second of a rank, in and out


class RanksModel:
    def __init__(self, runs):
        """`runs`: what ranks_bench printed, some of more than one rank."""
        self.runs = runs
        phases = {name: [(run["sites"], run["ranks"], phase) for run in runs
                         for phase in run["phases"] if phase["phase"] == name] for name in WORK}
        self.seconds_ = {}
        self.bytes_ = {}
        for name, of in phases.items():
            for who, terms in WORK[name].items():
                rows = [([TERMS[t](n, p) for t in terms], phase[who + "_seconds"])
                        for n, p, phase in of if who == "first" or p > 1]
                self.seconds_[name, who] = fit(rows, terms)
            self.bytes_[name] = self._fit_bytes(name, of)
            self.seconds_[name, "calls"] = max(phase["calls"] for _, _, phase in of)
        self.open_ = fit([([math.sqrt(r["sites"] * r["ranks"])], r["open_sites"]) for r in runs],
                         ("sqrt nP",))[0]
        self.in_memory_ = fit([([r["sites"], math.sqrt(r["sites"])], r["seconds_in_memory"])
                               for r in runs], ("N", "sqrt N"))

    @staticmethod
    def _fit_bytes(name, of):
        """What goes through the busiest link: out of a rank, or all of the others into rank 0."""
        terms = ("N",) if name == "scatter" else ("sqrt nP", "P")
        rows = []
        for n, p, phase in of:
            if p == 1:
                continue
            busiest = max(phase["first_bytes"], phase["max_bytes"],
                          phase["all_bytes"] - phase["first_bytes"] if name == "join" else 0)
            rows.append(([TERMS[t](n, p) * (1 - 1 / p) for t in terms], busiest))
        return terms, fit(rows, terms)

    def in_memory(self, n):
        """Seconds of one thread."""
        return self.in_memory_[0] * n + self.in_memory_[1] * math.sqrt(n)

    def num_open_sites(self, n, ranks):
        return self.open_ * math.sqrt(n * ranks)

    def seconds(self, name, n, ranks):
        """Of the rank that takes longest, without the network."""
        return max(sum(f * TERMS[t](n, ranks) for f, t in zip(self.seconds_[name, who], terms))
                   for who, terms in WORK[name].items() if who == "first" or ranks > 1)

    def network_seconds(self, name, n, ranks, network):
        if ranks == 1:
            return 0.0
        terms, factors = self.bytes_[name]
        sent = sum(f * TERMS[t](n, ranks) for f, t in zip(factors, terms)) * (1 - 1 / ranks)
        return (self.seconds_[name, "calls"] * (ranks - 1) * network.latency +
                sent / network.bandwidth)

    def wall(self, n, ranks, network):
        return sum(self.seconds(name, n, ranks) + self.network_seconds(name, n, ranks, network)
                   for name in WORK)

    def worst_error(self):
        """The largest relative error of the fits, of the sum of phases of a run."""
        def measured(run):
            return sum(max(p["first_seconds"], p["max_seconds"]) for p in run["phases"])

        def modelled(run):
            return sum(self.seconds(name, run["sites"], run["ranks"]) for name in WORK)

        return max(abs(modelled(run) / measured(run) - 1) for run in self.runs)


class ThreadsModel:
    """Of one build in memory."""

    def __init__(self, run):
        """`run`: what threads_bench printed."""
        self.sites = run["sites"]
        self.loops = run["shared"]
        self.alone = run["alone"] + sum(loop["alone"] for loop in self.loops)
        self.all = self.wall(1)

    def wall(self, threads):
        return self.alone + sum(max(loop["longest"], loop["seconds"] / threads)
                                for loop in self.loops)

    def waiting(self, threads):
        """How long all wait for the longest pieces of loops."""
        return self.wall(threads) - self.alone - (self.all - self.alone) / threads

    def speed_up(self, threads):
        return self.all / self.wall(threads)


def ranks_table(ledger, n, all_ranks, threads, network):
    model = RanksModel(ledger["ranks"]["runs"])
    largest = max(ledger["threads"]["runs"], key=lambda run: run["sites"])
    speed_up = ThreadsModel(largest).speed_up(threads)
    rows = []
    for ranks in all_ranks:
        phases = [model.seconds(name, n, ranks) / (speed_up if name == "triangulate" else 1)
                  for name in WORK]
        waits = sum(model.network_seconds(name, n, ranks, network) for name in WORK)
        wall = sum(phases) + waits
        open_sites = model.num_open_sites(n, ranks)
        memory = BYTES_OF_SITE * n / ranks + BYTES_OF_OPEN_SITE * open_sites
        rows.append([f"{ranks:,}", f"{n / ranks:,.0f}", *map(number, phases), number(waits),
                     number(wall), number(model.in_memory(n) / wall),
                     number(100 * model.in_memory(n) / wall / ranks / threads) + " %",
                     number(memory / 1e9) + " GB"])
    return Table(f"{power(n)} uniform sites, seconds by phase",
                 ["ranks", "sites of each", *WORK, "network", "all", "speed-up", "efficiency",
                  "memory of rank 0"], rows,
                 [f"A model, not a measurement: processor time of simulated ranks on "
                  f"{ledger['ranks']['processor']}, fitted to {100 * model.worst_error():.0f} % at worst; "
                  f"{threads} thread{'s' * (threads > 1)} a rank, which share the triangulation alone; "
                  f"a network of {network.latency * 1e6:g} microseconds and "
                  f"{network.bandwidth / 1e9:g} GB/s."])


def threads_table(ledger, all_threads):
    rows = []
    for run in ledger["threads"]["runs"]:
        model = ThreadsModel(run)
        for threads in all_threads:
            wall = model.wall(threads)
            rows.append([power(model.sites), threads, number(wall), number(1e3 * model.alone),
                         number(100 * model.alone / wall) + " %",
                         number(100 * model.waiting(threads) / wall) + " %",
                         number(model.speed_up(threads))])
    return Table("Threads in one memory",
                 ["sites", "threads", "seconds", "one thread alone, ms", "of the time",
                  "waiting for the longest pieces", "speed-up"], rows,
                 [f"A model, not a measurement: processor time of simulated threads on "
                  f"{ledger['threads']['processor']}; a loop that they share takes as long as its longest "
                  "piece, or a thread's share of all pieces."])


def measure(folder, sizes, all_ranks, threads_sizes, repeats):
    """The parts of a new ledger for which there are sizes; of repeated runs the one with the least sum."""
    def best(program, *words, key):
        runs = []
        for seed in range(1, repeats + 1):
            command = [folder / program, "uniform", *map(str, words), "--seed", str(seed)]
            done = subprocess.run(command, check=True, capture_output=True, text=True)
            runs.append(json.loads(done.stdout))
        return min(runs, key=key)

    def of_ranks(run):
        return sum(phase["all_seconds"] for phase in run["phases"])

    ledger = {}
    for part, all_words in (("ranks", [(n, p) for n in sizes for p in all_ranks]),
                            ("threads", [(n,) for n in threads_sizes])):
        runs = []
        for words in all_words:
            print(f"{part}: {' '.join(map(str, words))} ...", file=sys.stderr)
            key = of_ranks if part == "ranks" else lambda run: ThreadsModel(run).all
            runs.append(best(f"{part}_bench", *words, key=key))
        if runs:
            ledger[part] = {"processor": environment.processor(), "runs": runs}
    return ledger


def text_of(ledger):
    """The text of a ledger's file: a line for each phase of a run and for each loop."""
    text = json.dumps(ledger, indent=1)
    return re.sub(r"\{[^{}\[\]]*\}", lambda innermost: " ".join(innermost[0].split()), text) + "\n"


def read_ledger(path):
    try:
        ledger = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise SystemExit(f"scale-model: {path}: {error}") from None
    if not isinstance(ledger, dict) or not {"ranks", "threads"} <= ledger.keys():
        raise SystemExit(f"scale-model: {path}: not a ledger")
    return ledger


def count(text):
    """A number, as 1e9, 1048576 or 2^20."""
    try:
        base, caret, exponent = text.partition("^")
        value = float(base) ** int(exponent) if caret else float(text)
    except (ValueError, OverflowError):
        value = 0.0
    if not 1 <= value < 2**63 or value != int(value):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of sites, ranks or threads")
    return int(value)


def positive(text):
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is not positive")
    return value


def parse(words):
    parser = argparse.ArgumentParser(prog="scripts/bench --scale-model", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    ranks = commands.add_parser("ranks", help="builds by many ranks")
    ranks.add_argument("--sites", type=count, default=10**10)
    ranks.add_argument("--ranks", type=count, nargs="+", default=[1, 16, 64, 256, 1024])
    ranks.add_argument("--threads", type=count, default=1, help="of each rank")
    ranks.add_argument("--latency", type=positive, default=2e-6, help="seconds a message")
    ranks.add_argument("--bandwidth", type=positive, default=10e9,
                       help="bytes a second, of each rank")
    threads = commands.add_parser("threads", help="builds in one memory, by many threads")
    threads.add_argument("--threads", type=count, nargs="+", default=[1, 4, 16, 64])
    for command in (ranks, threads):
        command.add_argument("--ledger", type=pathlib.Path, default=LEDGER)
    new = commands.add_parser("measure", help="writes new parts of a ledger; minutes")
    new.add_argument("--output", "-o", type=pathlib.Path, default=LEDGER)
    new.add_argument("--programs", type=pathlib.Path, default=ROOT / "build" / "release" / "bin",
                     help="the folder with ranks_bench and threads_bench")
    new.add_argument("--sites", type=count, nargs="*", default=[2**20, 2**22, 2**24],
                     help="of ranks; without a number, the ledger keeps what it has")
    new.add_argument("--ranks", type=count, nargs="+", default=[1, 2, 4, 16, 64])
    new.add_argument("--threads-sites", type=count, nargs="*", default=[2**24, 2**26],
                     help="of threads, the same")
    new.add_argument("--repeats", type=count, default=3)
    return parser.parse_args(words)


def main(words=None):
    task = parse(words)
    if task.command == "measure":
        ledger = measure(task.programs, task.sites, task.ranks, task.threads_sites, task.repeats)
        if not {"ranks", "threads"} <= ledger.keys():
            ledger = read_ledger(task.output) | ledger
        task.output.write_text(text_of(ledger), encoding="utf-8")
    elif task.command == "ranks":
        network = Network(task.latency, task.bandwidth)
        print(ranks_table(read_ledger(task.ledger), task.sites, task.ranks, task.threads,
                          network).markdown())
    else:
        print(threads_table(read_ledger(task.ledger), task.threads).markdown())


if __name__ == "__main__":
    main()
