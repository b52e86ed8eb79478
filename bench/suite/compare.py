# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Whether one commit is slower than another on this machine.

Both are built from detached worktrees with the same compiler and options, and run in turns on the
same inputs, other ones in each turn, each run in its own process. Any commit that has the program rondel_bench will do; its
own rules of measuring count (bench/measure.h), so two commits with different ones tell little.
"""

import argparse
import dataclasses
import pathlib
import subprocess
import sys

from .runs import SEED, Limits, run_in_turns
from .settings import ROOT
from .tables import Table, number, power, spread

KINDS = ("uniform", "grid", "fibonacci", "patch", "paper-s")
MODELS = ("projected", "weighted")


@dataclasses.dataclass(frozen=True)
class Build:
    commit: str
    program: pathlib.Path


def _git(*words):
    done = subprocess.run(["git", "-C", ROOT, *words], check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"git {' '.join(map(str, words))}: {done.stderr.strip()}")
    return done.stdout.strip()


def _run_quietly(command, log):
    with open(log, "w", encoding="utf-8") as file:
        if subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, check=False).returncode:
            raise SystemExit(f"{' '.join(map(str, command))} failed: see {log}")


def build(name, folder):
    """Builds rondel_bench of a commit; a build that is there is used again."""
    commit = _git("rev-parse", "--verify", "--end-of-options", f"{name}^{{commit}}")
    place = folder / commit[:12]
    program = place / "build" / "bin" / "rondel_bench"
    if not program.exists():
        print(f"building {name} ({commit[:12]}) ...", file=sys.stderr)
        place.mkdir(parents=True, exist_ok=True)
        tree = place / "tree"
        _git("worktree", "prune")
        _git("worktree", "add", "--force", "--detach", tree, commit)
        try:
            _run_quietly(["cmake", "-S", tree, "-B", place / "build", "-G", "Ninja",
                          "-DCMAKE_BUILD_TYPE=Release", "-DRONDEL_BUILD_BENCHMARKS=ON",
                          "-DRONDEL_BUILD_TOOL=OFF"], place / "configure.log")
            _run_quietly(["cmake", "--build", place / "build", "--target", "rondel_bench"],
                         place / "build.log")
        finally:
            _git("worktree", "remove", "--force", tree)
    return Build(commit[:12], program)


def is_slower(ratio, percent):
    """`ratio`: of medians, the least and the greatest of single turns."""
    return ratio[0] > 1 + percent / 100


def makes_other_inputs(results, before, after):
    """Whether two programs that were given the same words counted different sites or vertices."""
    return any(results.has(before, key) and results.has(after, key)
               and results.all(before, key) != results.all(after, key)
               for key in ("sites", "vertices"))


def takes_seed(program):
    """Older programs make one input, whatever the turn."""
    usage = subprocess.run([program], check=False, capture_output=True, text=True).stderr
    return "--seed" in usage


def cases_of(kinds, models, sites, threads, seed=()):
    """Options by name. Older programs take the word before the number for the wish for cells, too,
    which they do not count."""
    options = [*(["--threads", threads] if threads > 1 else []), *seed]
    return {f"{kind}, {model}": [kind, sites, model, *options]
            for kind in kinds for model in models}


def parse(words):
    parser = argparse.ArgumentParser(prog="scripts/bench --compare", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", help="a commit")
    parser.add_argument("after", help="another; exit status 1 if it is slower")
    parser.add_argument("--percent", type=float, default=5, help="what is allowed (5)")
    parser.add_argument("--runs", type=int, default=9)
    parser.add_argument("--sites", type=int, default=2**19)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--kinds", nargs="+", default=KINDS,
                        help=f"of inputs/kinds.h ({' '.join(KINDS)})")
    parser.add_argument("--models", nargs="+", choices=MODELS, default=MODELS)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build" / "compare")
    return parser.parse_args(words)


def main(words):
    arguments = parse(words)
    before, after = (build(name, arguments.folder.resolve())
                     for name in (arguments.before, arguments.after))
    if before.commit == after.commit:
        raise SystemExit(f"both are {before.commit}")
    seed = ["--seed", SEED] if takes_seed(before.program) and takes_seed(after.program) else []
    cases = cases_of(arguments.kinds, arguments.models, arguments.sites, arguments.threads, seed)
    commands = {(name, side.commit): [side.program, *options]
                for name, options in cases.items() for side in (before, after)}
    results = run_in_turns(commands, Limits(runs=arguments.runs, budget=float("inf")))
    rows, slower, others = [], [], []
    for name in cases:
        pair = [(name, side.commit) for side in (before, after)]
        for key in pair:
            if failure := results.failure(key):
                raise SystemExit(f"{name}, {key[1]}: {failure}")
        ratio = results.ratio(pair[1], pair[0])
        if makes_other_inputs(results, *pair):
            others.append(name)
        elif is_slower(ratio, arguments.percent):
            slower.append(name)
        rows.append([name, *(spread(results.ns_each(key)) for key in pair), spread(ratio),
                     *(number(results.median(key, "bytes_per_site")) for key in pair)])
    threads = f", {arguments.threads} threads" if arguments.threads > 1 else ""
    print(Table(f"{before.commit} and {after.commit}, {power(arguments.sites)} sites{threads}",
                ["input", "before: ns a site", "after: ns a site", "after / before",
                 "before: bytes a site", "after"], rows).markdown())
    if others:
        print(f"other inputs, whose times do not compare: {'; '.join(others)}")
    if slower:
        print(f"slower by more than {arguments.percent:g} %: {'; '.join(slower)}")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
