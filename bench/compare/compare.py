#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Measures Rondel and its peers in turns, each run in its own process, and prints medians.

    compare.py BIN_FOLDER [--runs N] [--tables build hulls queries changes]

BIN_FOLDER holds the programs (cmake -DRONDEL_BUILD_BENCHMARKS=ON; scripts/packages/bench.txt has
the peers). Ratios are of medians from the same turns, so that they survive a machine whose speed
drifts.
"""

import argparse
import json
import pathlib
import statistics
import subprocess

MILLION = str(2**20)
UNIFORM = ["uniform", MILLION]

BUILD = {
    "uniform, projected": ["rondel_bench", *UNIFORM, "projected"],
    "uniform, projected, with cells and areas": ["rondel_bench", *UNIFORM, "projected", "dual"],
    "the same with 2 threads": ["rondel_bench", *UNIFORM, "projected", "dual", "2"],
    "uniform, weighted": ["rondel_bench", *UNIFORM, "weighted"],
    "uniform, CGAL, points as given": ["cgal_bench", *UNIFORM, "kernel"],
    "uniform, CGAL, projected": ["cgal_bench", *UNIFORM, "projection"],
    "grid 500 x 1000": ["rondel_bench", "grid", "500000", "projected"],
    "Fibonacci 2^20": ["rondel_bench", "fibonacci", MILLION, "projected"],
    "2^18 in a patch of 1e-6 rad + 1000": ["rondel_bench", "patch", str(2**18), "projected"],
    "S_100000": ["rondel_bench", "paper-s", "100000", "projected"],
    "S_100000, weighted": ["rondel_bench", "paper-s", "100000", "weighted"],
    "circles, radii 0 to 30 degrees": ["rondel_bench", "circles", MILLION, "weighted"],
    "circles, radii 0 to 0.3 degrees": ["rondel_bench", "small-circles", MILLION, "weighted"],
}

HULLS = {
    f"{kind}, {program}": [binary, kind, MILLION, *options]
    for kind in ("ball", "uniform", "cube", "gaussian")
    for program, binary, options in (
        ("Rondel", "rondel_bench", ["hull"]),
        ("Qhull", "qhull_bench", []),
        ("CGAL", "cgal_hull_bench", []),
    )
}

QUERIES = {
    "projected": ["query_bench", MILLION, MILLION],
    "projected, 2 threads": ["query_bench", MILLION, MILLION, "projected", "2"],
    "weighted": ["query_bench", MILLION, MILLION, "weighted"],
    "nanoflann": ["nanoflann_bench", MILLION, MILLION],
}

SMALLER = str(2**16)  # for CGAL, whose insertions take longer the more there are
CHANGES = {
    "projected": ["dynamic_bench", *UNIFORM, "projected"],
    "weighted": ["dynamic_bench", *UNIFORM, "weighted"],
    "projected, 2^16": ["dynamic_bench", "uniform", SMALLER, "projected"],
    "CGAL, 2^16, insert": ["cgal_bench", "uniform", SMALLER, "insert"],
}


class Results:
    """The JSON objects that the programs printed, by the name of the case."""

    def __init__(self, folder, runs, cases):
        self.of = {name: [] for name in cases}
        for _ in range(runs):
            for name, (program, *arguments) in cases.items():
                output = subprocess.run([folder / program, *arguments], check=True,
                                        capture_output=True, text=True).stdout
                self.of[name].append(json.loads(output))

    def median(self, name, key="seconds"):
        return statistics.median(run[key] for run in self.of[name])

    def ns_each(self, name, key="seconds", per="sites"):
        """Median, least and greatest; None if the program does not print the key."""
        values = [run[key] / run[per] * 1e9 for run in self.of[name] if key in run]
        return (statistics.median(values), min(values), max(values)) if values else None

    def ratio(self, over, under, key="seconds"):
        return self.median(over, key) / self.median(under, key)


def print_table(*rows):
    """The first row is the head."""
    rows = [rows[0], ["---"] * len(rows[0]), *rows[1:]]
    print("\n" + "\n".join("| " + " | ".join(row) + " |" for row in rows) + "\n")


def print_times(results):
    head = ["input", "sites", "vertices", "ns a site: median", "min", "max", "bytes a site"]
    print_table(head, *(
        [name, str(runs[0]["sites"]), str(runs[0]["vertices"]),
         *(f"{value:.0f}" for value in results.ns_each(name)),
         f"{results.median(name, 'bytes_per_site'):.0f}"]
        for name, runs in results.of.items()))


def build(folder, runs):
    results = Results(folder, runs, BUILD)
    print_times(results)
    uniform = "uniform, projected"
    for peer in ("uniform, CGAL, points as given", "uniform, CGAL, projected"):
        print(f"{peer} / Rondel: {results.ratio(peer, uniform):.2f}")
    print(f"projected / weighted: {results.ratio(uniform, 'uniform, weighted'):.2f}")
    for name in list(BUILD)[6:11]:
        print(f"{name} / uniform, per site: "
              f"{results.ns_each(name)[0] / results.ns_each(uniform)[0]:.2f}")
    for name in list(BUILD)[1:3]:
        ratio = statistics.median(run["dual"] / run["seconds"] for run in results.of[name])
        error = max(abs(run["total_area"] / 12.566370614359172954 - 1) for run in results.of[name])
        print(f"{name}: cells and areas / triangulation {ratio:.2f}, "
              f"relative error of the sum of areas {error:.1e}")


def hulls(folder, runs):
    results = Results(folder, runs, HULLS)
    print_times(results)
    for kind in ("ball", "uniform", "cube", "gaussian"):
        vertices = {run["vertices"] for peer in ("Rondel", "Qhull", "CGAL")
                    for run in results.of[f"{kind}, {peer}"]}
        for peer in ("Qhull", "CGAL"):
            print(f"{kind}: {peer} / Rondel: "
                  f"{results.ratio(f'{kind}, {peer}', f'{kind}, Rondel'):.2f}")
        print(f"{kind}: " + ("the same number of vertices" if len(vertices) == 1
                             else f"numbers of vertices {sorted(vertices)}"))


def queries(folder, runs):
    results = Results(folder, runs, QUERIES)
    if len({run["sum"] for of in results.of.values() for run in of}) != 1:
        raise SystemExit("the nearest sites differ")

    def text(name, key):
        values = results.ns_each(name, key, "queries")
        return f"{values[0]:.0f}" if values else ""

    print_table(
        ["queries, ns each: medians", "index", "nearest", "one by one", "8 nearest", "locate"],
        *([name, text(name, "locator") or text(name, "build"), text(name, "seconds"),
           text(name, "single"), text(name, "k_nearest_8"), text(name, "locate")]
          for name in QUERIES))
    ratio = statistics.median(run["seconds"] / run["build"] for run in results.of["projected"])
    print(f"nearest / bulk build: {ratio:.2f}")
    print(f"nanoflann / nearest: {results.ratio('nanoflann', 'projected'):.2f}")


def changes(folder, runs):
    results = Results(folder, runs, CHANGES)
    rondel = list(CHANGES)[:3]
    print_table(
        ["changes, ns each: medians", "bulk build", "insert", "remove", "bytes a site"],
        *([name, *(f"{results.ns_each(name, key)[0]:.0f}" for key in ("bulk", "insert", "remove")),
           f"{results.median(name, 'bytes_per_site'):.0f}"] for name in rondel))
    for name in rondel:
        print(f"{name}: insert / bulk build {results.median(name, 'insert_by_bulk'):.2f}, "
              f"remove / bulk build {results.median(name, 'remove_by_bulk'):.2f}")
    peer = results.median("CGAL, 2^16, insert") / results.median("projected, 2^16", "insert")
    print(f"2^16 insertions, CGAL / Rondel: {peer:.1f}")


TABLES = {"build": build, "hulls": hulls, "queries": queries, "changes": changes}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--tables", nargs="+", choices=TABLES, default=list(TABLES))
    arguments = parser.parse_args()
    for name in arguments.tables:
        TABLES[name](arguments.folder, arguments.runs)


if __name__ == "__main__":
    main()
