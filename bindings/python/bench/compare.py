#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""SciPy's SphericalVoronoi against ours, and what Python costs over C++, on the same random points.

    compare.py [--log2 10 16 20] [--runs 5] [--program rondel_bench]

Both classes build, sort the regions and compute the areas, in turns in this process; SciPy on its
one thread, ours on one and on all. "with lists" is ours with the regions as lists of lists, which
SciPy makes in any case and ours only when they are asked for. The overhead is the time of
rondel.delaunay() over that of the C++ function inside of it; with --program, over that of the
benchmark program that calls the same function without Python, run in turns, too. Least times of
all runs. Needs SciPy.
"""

import argparse
import json
import subprocess
import time

import numpy as np

import rondel


def uniform(count):
    """Random points of the unit sphere."""
    points = np.random.default_rng(0).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def seconds(work):
    """How long a call takes."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def diagram(kind, points, lists=False, **options):
    """What a program does with the class."""
    sv = kind(points, **options)
    sv.sort_vertices_of_regions()
    sv.calculate_areas()
    return sv.regions if lists else sv


def min_times(contenders, runs):
    """The least time of each contender, in turns."""
    times = {name: [] for name in contenders}
    for _ in range(runs):
        for name, work in contenders.items():
            times[name].append(seconds(work))
    return {name: min(values) for name, values in times.items()}


def ratios(log2, runs):
    """A row of the table of ratios."""
    from scipy.spatial import SphericalVoronoi

    points = uniform(1 << log2)
    ours = rondel.SphericalVoronoi
    times = min_times(
        {
            "scipy": lambda: diagram(SphericalVoronoi, points),
            "one": lambda: diagram(ours, points, threads=1),
            "all": lambda: diagram(ours, points),
            "lists": lambda: diagram(ours, points, lists=True),
        },
        runs if log2 < 18 else min(runs, 2),
    )
    scipy = times.pop("scipy")
    cells = [f"{1e9 * scipy / len(points):,.0f}"]
    for value in times.values():
        cells.append(f"{1e9 * value / len(points):,.0f}")
        cells.append(f"{scipy / value:.1f}")
    return cells


def overhead(log2, runs, program):
    """The time of the binding over that of C++, with one thread, in percent."""
    points = uniform(1 << log2)
    inside, whole, outside = [], [], []
    for _ in range(runs):
        begin = time.perf_counter()
        tri = rondel.delaunay(points, threads=1)
        whole.append(time.perf_counter() - begin)
        inside.append(tri.report["order_seconds"] + tri.report["triangulate_seconds"])
        del tri
        if program:
            outside.append(seconds_of(program, log2))
    result = {"over the C++ function inside": min(whole) / min(inside)}
    if program:
        result["over the program"] = min(whole) / min(outside)
    return {name: 100 * (ratio - 1) for name, ratio in result.items()}


def seconds_of(program, log2):
    """The time that the C++ program measures for the same number of random points."""
    done = subprocess.run(
        [program, "uniform", str(1 << log2)], check=True, capture_output=True, text=True
    )
    return float(json.loads(done.stdout)["seconds"])


def main():
    """Prints two tables in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--log2", type=int, nargs="+", default=[10, 16, 20])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--program", help="rondel_bench of a Release build")
    arguments = parser.parse_args()
    print("| points | SciPy [ns/point] | one thread | ratio | all | ratio | with lists | ratio |")
    print("| --- " * 8 + "|")
    for log2 in arguments.log2:
        print("|", " | ".join([f"2^{log2}", *ratios(log2, arguments.runs)]), "|", flush=True)
    print("\n| overhead at 2^20 points | % |\n| --- | --- |")
    for name, percent in overhead(20, arguments.runs, arguments.program).items():
        print(f"| {name} | {percent:.1f} |")


if __name__ == "__main__":
    main()
