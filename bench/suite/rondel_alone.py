# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Rondel by itself: beside its limit, over threads, and over the number of sites."""

from . import plots
from .runs import SEED, run_in_turns
from .tables import Table, number, power, spread


def rondel(settings, kind, n, *options):
    return [settings.programs / "rondel_bench", kind, n, *options, "--seed", SEED]


def run(settings, cases):
    """Results, none of them a failure."""
    results = run_in_turns(cases, settings.limits)
    for name in cases:
        if failure := results.failure(name):
            raise SystemExit(f"{name}: {failure}")
    return results


def beside_the_limit(settings):
    rows = []
    for n in settings.sizes(settings.peers_max_log2):
        results = run(settings, {
            "build": rondel(settings, "uniform", n, "projected"),
            "limit": [settings.programs / "limit_bench", "uniform", n, "--seed", SEED],
        })
        parts = (number(results.ns_each("limit", key)[0]) for key in ("sort", "verify", "write"))
        rows.append([power(n), spread(results.ns_each("build")), spread(results.ns_each("limit")),
                     *parts, spread(results.ratio("build", "limit"))])
    return [Table("Rondel beside its limit, one thread, uniform, ns a site",
                  ["sites", "Rondel", "limit", "sort", "verify", "write", "Rondel / limit"], rows,
                  ["The limit is the time to sort the sites, to verify the finished triangulation "
                   "with one conflict test for each edge, and to write its arrays."])]


def over_threads(settings):
    tables = []
    for n in (2**20, 2**22):
        n = settings.size(n)
        if n > 2**settings.max_log2:
            continue
        threads = settings.threads()
        results = run(settings, {
            f"{power(n)}, {t} threads":
                rondel(settings, "uniform", n, "projected", "--threads", t, "--dual")
            for t in threads
        })
        names = list(results.of)
        rows = [[str(t), spread(results.ns_each(name)), spread(results.ratio(names[0], name)),
                 number(results.ns_each(name, "dual")[0]),
                 number(results.median(name, "bytes_per_site"))]
                for t, name in zip(threads, names)]
        tables.append(Table(f"Threads, {power(n)} uniform sites",
                            ["threads", "ns a site", "faster than 1 thread",
                             "cells and areas, ns a site", "bytes a site"], rows))
    return tables


def over_growing_sizes(settings):
    """Cost and memory a site; the largest sizes as often as the budget allows."""
    rows, points = [], []
    last = settings.threads()[-1]
    one, more = "1 thread", f"{last} threads"
    for n in settings.sizes(settings.max_log2):
        results = run(settings, {
            one: rondel(settings, "uniform", n, "projected"),
            more: rondel(settings, "uniform", n, "projected", "--threads", last),
        })
        times = {name: results.ns_each(name) for name in (one, more)}
        memory = {name: results.median(name, "bytes_per_site") for name in (one, more)}
        rows.append([power(n), *(cell for name in (one, more)
                                 for cell in (spread(times[name]), number(memory[name])))])
        points.append((n, {name: (times[name][0], memory[name]) for name in (one, more)}))
    plots.cost_and_memory(settings.out / "growth.svg", points)
    head = ["sites", *(cell for name in (one, more) for cell in (f"{name}: ns a site",
                                                                 "bytes a site"))]
    return [Table("Cost and memory a site, uniform", head, rows, _growth(points, one))]


def _growth(points, name):
    """What a site costs beyond 2^20 sites, beside its cost there."""
    costs = {n: of[name][0] for n, of in points}
    return [f"{power(n)} / 2^20, {name}, per site: {number(cost / costs[2**20])}"
            for n, cost in costs.items() if n > 2**20]
