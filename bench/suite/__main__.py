# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Measures Rondel and its peers, and writes tables (Markdown, CSV) and plots (SVG)."""

import argparse
import os
import pathlib
import sys

from . import (accuracy, against_peers, environment, features, hostile, interpolation, ratios,
               rondel_alone)
from .runs import Limits
from .settings import ROOT, Settings

TABLES = {
    "ratios": ratios.tables,
    "peers": against_peers.over_sizes,
    "stations": against_peers.on_stations,
    "hard": against_peers.on_hard_inputs,
    "hostile": hostile.beside_uniform,
    "limit": rondel_alone.beside_the_limit,
    "threads": rondel_alone.over_threads,
    "growth": rondel_alone.over_growing_sizes,
    "hulls": features.hulls,
    "queries": features.queries,
    "changes": features.changes,
    "accuracy": accuracy.of_values,
    "interpolation": interpolation.methods,
}

# How large and how often: (peers up to 2^k, Rondel up to 2^k, division of fixed sizes, limits).
EXTENTS = {
    "quick": (14, 18, 64, Limits(seconds=10, runs=3, budget=4)),
    "normal": (20, 22, 1, Limits(seconds=90, runs=5, budget=20)),
    "full": (23, 27, 1, Limits(seconds=600, runs=7, budget=60)),
}


def parse(words):
    parser = argparse.ArgumentParser(prog="bench", description=__doc__)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/bench/bin",
                        help="the folder of the built programs")
    parser.add_argument("--narrow-programs", type=pathlib.Path,
                        default=ROOT / "build/bench-narrow/bin",
                        help="the folder of rondel_bench built with RONDEL_WIDE_VECTORS=OFF")
    parser.add_argument("--packages", type=pathlib.Path, default=ROOT / "build/bench/packages",
                        help="the folder that holds node_modules and Python modules")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/bench-results")
    extent = parser.add_mutually_exclusive_group()
    extent.add_argument("--quick", dest="extent", action="store_const", const="quick",
                        default="normal", help="a few minutes: 2^14 sites, fixed sizes / 64")
    extent.add_argument("--full", dest="extent", action="store_const", const="full",
                        help="hours: peers to 2^23, Rondel to 2^27, limit 10 minutes")
    parser.add_argument("--max-log2", type=int, help="Rondel alone: up to 2^K sites")
    parser.add_argument("--peers-max-log2", type=int, help="with peers: up to 2^K sites")
    parser.add_argument("--limit", type=float, help="seconds that one run may take")
    parser.add_argument("--runs", type=int, help="how often each case is run, at most")
    parser.add_argument("--stations", type=pathlib.Path, nargs="+", default=[],
                        help="more files of real data (CSV with longitudes and latitudes)")
    parser.add_argument("--tables", nargs="+", choices=TABLES, default=list(TABLES))
    parser.add_argument("--markdown", action="store_true", help="print the tables, too")
    return parser.parse_args(words)


def settings_of(arguments):
    peers_log2, log2, shrink, limits = EXTENTS[arguments.extent]
    return Settings(
        programs=arguments.programs.resolve(),
        narrow_programs=arguments.narrow_programs.resolve(), out=arguments.out.resolve(),
        node_packages=arguments.packages.resolve(),
        limits=Limits(arguments.limit or limits.seconds, arguments.runs or limits.runs,
                      limits.budget),
        max_log2=arguments.max_log2 or log2,
        peers_max_log2=arguments.peers_max_log2 or min(peers_log2, arguments.max_log2 or 99),
        shrink=shrink,
        stations=(*Settings.stations, *(path.resolve() for path in arguments.stations)))


def main(words):
    arguments = parse(words)
    settings = settings_of(arguments)
    if not (settings.programs / "rondel_bench").exists():
        raise SystemExit(f"{settings.programs}: there is no rondel_bench; run scripts/bench")
    modules = str(settings.node_packages / "python")
    sys.path.append(modules)
    os.environ["PYTHONPATH"] = modules
    settings.out.mkdir(parents=True, exist_ok=True)
    report = settings.out / "report.md"
    report.write_text("")
    for name in ["machine", *arguments.tables]:
        print(f"{name} ...", file=sys.stderr)
        tables = [environment.table(settings)] if name == "machine" else TABLES[name](settings)
        for i, table in enumerate(tables):
            table.write_csv(settings.out / (f"{name}-{i + 1}.csv" if i else f"{name}.csv"))
            with open(report, "a", encoding="utf-8") as file:
                file.write(table.markdown() + "\n")
            if arguments.markdown:
                print(table.markdown(), flush=True)
    print(f"tables and plots are in {settings.out}", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1:])
