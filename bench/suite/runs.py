# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Processes: each run in one of its own, in turns, with a limit of time and memory."""

import dataclasses
import json
import os
import resource
import signal
import statistics
import subprocess
import sys
import time


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What one process printed, or why there is nothing."""

    values: dict = dataclasses.field(default_factory=dict)
    failure: str = ""


@dataclasses.dataclass(frozen=True)
class Limits:
    """How long one process may run, how often it is repeated, and when repeating stops early."""

    seconds: float = 60
    runs: int = 5
    budget: float = 20  # seconds of one case after which it is not repeated


def _keep_below(memory_bytes):
    """A process that wants more memory than there is fails alone, instead of the machine."""
    return lambda: resource.setrlimit(resource.RLIMIT_DATA, (memory_bytes, memory_bytes))


def machine_memory():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def run_once(command, seconds):
    command = [str(word) for word in command]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          start_new_session=True,
                          preexec_fn=_keep_below(machine_memory() * 9 // 10)) as process:
        try:
            output, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return Outcome(failure=f"over {seconds:g} s")
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    if process.returncode < 0:
        return Outcome(failure=f"ended by {signal.Signals(-process.returncode).name}")
    if process.returncode > 0:
        lines = errors.strip().splitlines() or [f"exit status {process.returncode}"]
        return Outcome(failure="stops: " + lines[0][:100].rstrip("."))
    return Outcome(values=json.loads(output))


class Results:
    """The outcomes of each case, in the order of the turns."""

    def __init__(self):
        self.of = {}

    def failure(self, name):
        return next((o.failure for o in self.of[name] if o.failure), "")

    def all(self, name, key="seconds"):
        return [o.values[key] for o in self.of[name] if key in o.values]

    def has(self, name, key="seconds"):
        return name in self.of and bool(self.all(name, key))

    def median(self, name, key="seconds"):
        return statistics.median(self.all(name, key))

    def first(self, name, key):
        return self.all(name, key)[0]

    def ns_each(self, name, key="seconds", per="sites"):
        """Median, least and greatest; nothing if the program does not print the key."""
        values = [v / n * 1e9 for v, n in zip(self.all(name, key), self.all(name, per))]
        return (statistics.median(values), min(values), max(values)) if values else ()

    def ratio(self, over, under, key="seconds", under_key=None):
        """The ratio of medians, and the least and greatest of single turns."""
        a, b = self.all(over, key), self.all(under, under_key or key)
        turns = [x / y for x, y in zip(a, b)]
        return statistics.median(a) / statistics.median(b), min(turns), max(turns)


SEED = "{seed}"  # a word of a command


def with_seed(command, turn):
    """Each turn has other inputs; a program takes the seeds from this one on."""
    return [1_000_000 * turn + 1 if word == SEED else word for word in command]


def run_in_turns(cases, limits, check=lambda name, outcome: outcome):
    """`cases` maps names to commands, in which SEED is a number of the turn. `check` may turn an
    outcome into a failure. A case that failed is not run again."""
    results = Results()
    spent = dict.fromkeys(cases, 0.0)
    results.of = {name: [] for name in cases}
    for turn in range(limits.runs):
        for name, command in cases.items():
            if spent[name] > limits.budget or results.failure(name):
                continue
            _show(f"[{turn + 1}/{limits.runs}] {name}")
            start = time.monotonic()
            results.of[name].append(check(name, run_once(with_seed(command, turn), limits.seconds)))
            spent[name] += time.monotonic() - start
    _show("")
    return results


def _show(text):
    """Progress, on a terminal only."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
