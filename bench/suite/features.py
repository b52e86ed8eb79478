# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Hulls of points in space, queries, and changes one by one."""

from .rondel_alone import run
from .runs import SEED, run_in_turns
from .tables import Table, number, power, spread

HULLS = {"ball": "uniform in a ball", "cube": "uniform in a cube", "gaussian": "Gaussian",
         "uniform": "uniform on a sphere"}


def _there(settings, cases):
    return {name: command for name, command in cases.items() if command[0].exists()}


def hulls(settings):
    n = settings.size(2**20)
    rows = []
    for kind, what in HULLS.items():
        cases = _there(settings, {
            name: [settings.programs / program, kind, n, *options, "--seed", SEED]
            for name, program, *options in (("Rondel", "rondel_bench", "hull"),
                                            ("Qhull", "qhull_bench"), ("CGAL", "cgal_hull_bench"))
        })
        results = run_in_turns(cases, settings.limits)
        vertices = {v for name in cases for v in results.all(name, "vertices")[:1]}
        cells = [results.failure(name) or spread(results.ns_each(name)) if name in cases else ""
                 for name in ("Rondel", "Qhull", "CGAL")]
        ratios = [number(results.ratio(name, "Rondel")[0]) if results.has(name) else ""
                  for name in ("Qhull", "CGAL")]
        rows.append([what, " or ".join(f"{v:,}" for v in sorted(vertices)), *cells, *ratios])
    return [Table(f"Convex hulls of {power(n)} points, ns a point",
                  ["points", "vertices", "Rondel", "Qhull", "CGAL", "Qhull / Rondel",
                   "CGAL / Rondel"], rows)]


def queries(settings):
    n = settings.size(2**20)
    seed = ["--seed", SEED]
    rondel = [settings.programs / "query_bench", n, n, *seed]
    results = run(settings, _there(settings, {
        "projected": [*rondel, "projected"],
        f"projected, {settings.threads()[-1]} threads":
            [*rondel, "projected", settings.threads()[-1]],
        "weighted": [*rondel, "weighted"],
        "nanoflann": [settings.programs / "nanoflann_bench", n, n, *seed],
    }))
    if any(len(set(sums)) != 1 for sums in zip(*(results.all(name, "sum") for name in results.of))):
        raise SystemExit("the nearest sites differ")

    def cell(name, *keys):
        times = next((t for key in keys if (t := results.ns_each(name, key, "queries"))), ())
        return number(times[0]) if times else ""

    rows = [[name, cell(name, "locator", "build"), cell(name, "seconds"), cell(name, "single"),
             cell(name, "k_nearest_8"), cell(name, "locate")] for name in results.of]
    notes = ["nearest / bulk build: "
             + spread(results.ratio("projected", "projected", "seconds", "build"))]
    if "nanoflann" in results.of:
        notes.append(f"nanoflann / nearest: {spread(results.ratio('nanoflann', 'projected'))}")
    return [Table(f"Nearest of {power(n)} sites to as many other points, ns a query",
                  ["", "index, per site", "nearest, in one range", "one by one", "8 nearest",
                   "locate"], rows, notes)]


def changes(settings):
    n = settings.size(2**20)
    smaller = settings.size(2**16)  # for CGAL, whose insertions take longer the more there are
    program = settings.programs / "dynamic_bench"
    peer = f"CGAL, {power(smaller)}, insert"
    small = f"projected, {power(smaller)}"
    results = run(settings, _there(settings, {
        f"projected, {power(n)}": [program, "uniform", n, "projected", "--seed", SEED],
        f"weighted, {power(n)}": [program, "uniform", n, "weighted", "--seed", SEED],
        small: [program, "uniform", smaller, "projected", "--seed", SEED],
        peer: [settings.programs / "cgal_bench", "uniform", smaller, "insert", "--seed", SEED],
    }))
    rows = [[name, *(number(results.ns_each(name, key)[0]) for key in ("bulk", "insert", "remove")),
             number(results.median(name, "insert_by_bulk")),
             number(results.median(name, "remove_by_bulk")),
             number(results.median(name, "bytes_per_site"))]
            for name in results.of if name != peer]
    notes = []
    if peer in results.of:
        ratio = results.median(peer) / results.median(small, "insert")
        notes.append(f"{power(smaller)} insertions, CGAL / Rondel: {number(ratio)}")
    return [Table("Changes one by one, in random order and without hints, ns each",
                  ["", "bulk build", "insert", "remove", "insert / bulk", "remove / bulk",
                   "bytes a site"], rows, notes)]
