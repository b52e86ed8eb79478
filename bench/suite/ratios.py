# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Ratios of medians of few programs in turns: what to quote, and what a change must not spoil."""

from . import peers as peers_module
from .against_peers import expected_vertices, hard_inputs, verdict
from .peers import CGAL_GIVEN, CGAL_PROJECTED, QHULL, RONDEL, RONDEL_WEIGHTED, STRIPACK
from .peers import STRIPACK_TRMESH
from .rondel_alone import rondel, run
from .runs import run_in_turns
from .tables import Table, number, power, spread

HEAD = ["ratio", "input", "of medians (single turns)"]


def _against(settings, name, kind, n, peers):
    """Peers that are not there are left out; failures stand in the place of the ratio."""
    peers = [p for p in peers if not peers_module.missing(p, settings)]
    if not peers:
        return []
    expected = expected_vertices(settings, kind, n)
    model = {p.label: p.model for p in (RONDEL, *peers)}
    results = run_in_turns(
        {p.label: peers_module.command(p, settings, kind, n, None) for p in (RONDEL, *peers)},
        settings.limits, lambda label, outcome: verdict(outcome, expected[model[label]]))
    return [[f"{p.label} / {RONDEL.label}", name,
             results.failure(p.label) or spread(results.ratio(p.label, RONDEL.label))]
            for p in peers]


def against_peers(settings):
    largest = settings.peers_max_log2
    cgal = (CGAL_PROJECTED, CGAL_GIVEN)
    wanted = {10: (*cgal, STRIPACK, STRIPACK_TRMESH), 14: cgal,
              18: (STRIPACK, STRIPACK_TRMESH), 20: (*cgal, QHULL), 22: cgal}
    rows = []
    for log2, peers in wanted.items():
        if log2 <= largest:
            rows += _against(settings, f"uniform 2^{log2}", "uniform", 2**log2, peers)
    for path in settings.stations:
        rows += _against(settings, path.name, path, 0, cgal)
    return rows


def of_rondel(settings):
    n = settings.size(2**20)
    last = settings.threads()[-1]
    uniform = f"uniform {power(n)}"
    hard = {name: rondel(settings, kind, size, "projected")
            for name, kind, size in hard_inputs(settings)}
    results = run(settings, {
        uniform: rondel(settings, "uniform", n, "projected"),
        "weighted": rondel(settings, "uniform", n, "weighted"),
        "threads": rondel(settings, "uniform", n, "projected", "--threads", last),
        "limit": [settings.programs / "limit_bench", "uniform", n],
        "dual": rondel(settings, "uniform", n, "projected", "--dual"),
        **hard,
    })
    error = max(abs(area / 12.566370614359172954 - 1) for area in results.all("dual", "total_area"))
    return [
        ["projected / weighted", uniform, spread(results.ratio(uniform, "weighted"))],
        [f"1 thread / {last} threads", uniform, spread(results.ratio(uniform, "threads"))],
        ["Rondel / its limit", uniform, spread(results.ratio(uniform, "limit"))],
        ["cells and areas / triangulation", uniform, spread(results.ratio("dual", "dual", "dual",
                                                                          "seconds"))],
        ["relative error of the sum of areas", uniform, f"{error:.1e}"],
        *(["hard / uniform, per site", name,
           number(results.ns_each(name)[0] / results.ns_each(uniform)[0])] for name in hard),
    ]


def tables(settings):
    return [Table("Ratios", HEAD, [*against_peers(settings), *of_rondel(settings)])]
