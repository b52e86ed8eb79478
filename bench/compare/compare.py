#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Measures Rondel and its peers in turns, each run in its own process, and prints medians.

    compare.py BIN_FOLDER [--runs N]

BIN_FOLDER holds rondel_bench, query_bench and the peers (cmake -DRONDEL_BUILD_BENCHMARKS=ON). Ratios are
of medians from the same turns, so that they survive a machine whose speed drifts.
"""

import argparse
import json
import pathlib
import statistics
import subprocess

UNIFORM = ["uniform", str(2**20)]
CASES = {
    "projected": ["rondel_bench", *UNIFORM, "projected"],
    "projected, with cells and areas": ["rondel_bench", *UNIFORM, "projected", "dual"],
    "projected, with cells and areas, 2 threads": ["rondel_bench", *UNIFORM, "projected", "dual", "2"],
    "weighted": ["rondel_bench", *UNIFORM, "weighted"],
    "CGAL, points as given": ["cgal_bench", *UNIFORM, "kernel"],
    "CGAL, projected": ["cgal_bench", *UNIFORM, "projection"],
    "grid 500 x 1000": ["rondel_bench", "grid", "500000", "projected"],
    "Fibonacci 2^20": ["rondel_bench", "fibonacci", str(2**20), "projected"],
    "patch 2^18 + 1000": ["rondel_bench", "patch", str(2**18), "projected"],
    "S_100000": ["rondel_bench", "paper-s", "100000", "projected"],
    "S_100000, weighted": ["rondel_bench", "paper-s", "100000", "weighted"],
}

QUERIES = [str(2**20), str(2**20)]
QUERY_CASES = {
    "projected": ["query_bench", *QUERIES],
    "projected, 2 threads": ["query_bench", *QUERIES, "projected", "2"],
    "weighted": ["query_bench", *QUERIES, "weighted"],
    "nanoflann": ["nanoflann_bench", *QUERIES],
}


def measure(folder, runs, cases):
    results = {name: [] for name in cases}
    for _ in range(runs):
        for name, (program, *arguments) in cases.items():
            output = subprocess.run([folder / program, *arguments], check=True,
                                    capture_output=True, text=True).stdout
            results[name].append(json.loads(output))
    return results


def compare_queries(folder, runs):
    """The nearest of 2^20 sites to 2^20 other points."""
    results = measure(folder, runs, QUERY_CASES)
    if len({run["sum"] for name in results for run in results[name]}) != 1:
        raise SystemExit("the nearest sites differ")

    def median(name, key):
        values = [run[key] / run["queries"] * 1e9 for run in results[name] if key in run]
        return f"{statistics.median(values):.0f}" if values else ""

    print()
    print("| queries, ns each: medians | index | nearest | min | one by one | 8 nearest | locate |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, runs_of in results.items():
        best = min(run["seconds"] / run["queries"] * 1e9 for run in runs_of)
        index = median(name, "locator") or median(name, "build")
        print(f"| {name} | {index} | {median(name, 'seconds')} | {best:.0f} "
              f"| {median(name, 'single')} | {median(name, 'k_nearest_8')} | {median(name, 'locate')} |")
    ratio = statistics.median(run["seconds"] / run["build"] for run in results["projected"])
    print()
    print(f"nearest / bulk build, per site:    {ratio:.2f}")
    print(f"nanoflann / nearest:               "
          f"{float(median('nanoflann', 'seconds')) / float(median('projected', 'seconds')):.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=7)
    arguments = parser.parse_args()
    results = measure(arguments.folder, arguments.runs, CASES)

    def median(name, key="seconds"):
        return statistics.median(run[key] for run in results[name])

    print("| input | sites | vertices | ns a site: median | min | max | bytes a site |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, runs in results.items():
        sites = runs[0]["sites"]
        times = [run["seconds"] / sites * 1e9 for run in runs]
        print(f"| {name} | {sites} | {runs[0]['vertices']} | {statistics.median(times):.0f} "
              f"| {min(times):.0f} | {max(times):.0f} | {median(name, 'bytes_per_site'):.0f} |")
    projected = median("projected")
    dual = results["projected, with cells and areas"]
    dual_2 = results["projected, with cells and areas, 2 threads"]

    def dual_ratio(results):
        return statistics.median(run["dual"] / run["seconds"] for run in results)

    per_site = projected / results["projected"][0]["sites"]

    def of_uniform(name):
        return median(name) / results[name][0]["sites"] / per_site

    print()
    print(f"CGAL, points as given / projected: {median('CGAL, points as given') / projected:.2f}")
    print(f"CGAL, projected / projected:       {median('CGAL, projected') / projected:.2f}")
    print(f"projected / weighted:              {projected / median('weighted'):.2f}")
    for name in ("grid 500 x 1000", "Fibonacci 2^20", "patch 2^18 + 1000", "S_100000"):
        print(f"{name} / uniform, per site: {of_uniform(name):.2f}")
    print(f"cells and areas / triangulation:   {dual_ratio(dual):.2f}, "
          f"with two threads {dual_ratio(dual_2):.2f}")
    error = max(abs(run["total_area"] / 12.566370614359172954 - 1) for run in dual)
    print(f"sum of areas, relative error:      {error:.1e}")
    compare_queries(arguments.folder, arguments.runs)


if __name__ == "__main__":
    main()
