# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Ratios of medians of few programs in turns: what to quote, and what a change must not spoil."""

import math

from . import environment
from . import peers as peers_module
from .against_peers import expected_vertices, hard_inputs, verdict
from .peers import CGAL_GIVEN, CGAL_PROJECTED, QHULL, RONDEL, STRIPACK, STRIPACK_TRMESH
from .rondel_alone import rondel, run
from .runs import SEED, run_in_turns
from .tables import Table, number, power, spread

HEAD = ["ratio", "input", "of medians (single turns)"]


NARROW = "Rondel, narrow vectors"


def _command(peer, settings, kind, n):
    """Other sites in each turn, where the program makes them."""
    command = peers_module.command(peer, settings, kind, n, None)
    return command if peer.is_script else [*command, "--seed", SEED]


def _against(settings, name, kind, n, peers, threads=1):
    """Peers that are not there are left out; failures stand in the place of the ratio. With one
    thread also the first build of a process, and Rondel without wide vectors."""
    peers = [p for p in peers if not peers_module.missing(p, settings)]
    if not peers:
        return []
    expected = expected_vertices(settings, kind, n)
    model = {p.label: p.model for p in (RONDEL, *peers)} | {NARROW: RONDEL.model}
    cases = {p.label: _command(p, settings, kind, n) for p in (RONDEL, *peers)}
    cases[RONDEL.label] += ["--threads", threads]
    narrow = settings.narrow_programs / RONDEL.program
    if threads == 1 and CGAL_PROJECTED in peers and narrow.exists():
        cases[NARROW] = [narrow, *cases[RONDEL.label][1:]]
    results = run_in_turns(
        cases, settings.limits, lambda label, outcome: verdict(outcome, expected[model[label]]))
    rondel_label = RONDEL.label + (f", {threads} threads" if threads > 1 else "")
    return [row for p in peers for row in _rows(results, p, name, rondel_label, threads)]


def _rows(results, peer, name, rondel_label, threads):
    def row(label, of_rondel, key="seconds"):
        return [f"{peer.label} / {label}", name,
                results.failure(peer.label) or results.failure(of_rondel)
                or spread(results.ratio(peer.label, of_rondel, key))]

    yield row(rondel_label, RONDEL.label)
    if peer is CGAL_PROJECTED and threads == 1:
        yield row(f"{RONDEL.label}, first build of a process", RONDEL.label, "first_seconds")
        if NARROW in results.of:
            yield row(NARROW, NARROW)


def against_peers(settings):
    cgal = (CGAL_PROJECTED, CGAL_GIVEN)
    stripack = (STRIPACK, STRIPACK_TRMESH)
    last = settings.threads()[-1]
    wanted = [(10, (*cgal, *stripack), 1), (14, cgal, 1), (18, stripack, 1),
              (20, (*cgal, QHULL), 1), (20, cgal, last), (22, cgal, 1)]
    rows = []
    for log2, peers, threads in wanted:
        if log2 <= settings.peers_max_log2:
            rows += _against(settings, f"uniform 2^{log2}", "uniform", 2**log2, peers, threads)
    for path in settings.stations:
        rows += _against(settings, path.name, path, 0, cgal)
    return rows


def of_threads(settings, n):
    last = settings.threads()[-1]
    results = run(settings, {t: rondel(settings, "uniform", n, "projected", "--threads", t)
                             for t in sorted({1, last})})
    return [f"1 thread / {last} threads", f"uniform {power(n)}", spread(results.ratio(1, last))]


def of_rondel(settings):
    n = settings.size(2**20)
    uniform = f"uniform {power(n)}"
    hard = {name: rondel(settings, kind, size, "projected")
            for name, kind, size in hard_inputs(settings)}
    results = run(settings, {
        uniform: rondel(settings, "uniform", n, "projected"),
        "weighted": rondel(settings, "uniform", n, "weighted"),
        "limit": [settings.programs / "limit_bench", "uniform", n, "--seed", SEED],
        "dual": rondel(settings, "uniform", n, "projected", "--dual"),
        **hard,
    })
    error = max(abs(area / (4 * math.pi) - 1) for area in results.all("dual", "total_area"))
    return [
        ["projected / weighted", uniform, spread(results.ratio(uniform, "weighted"))],
        *(of_threads(settings, size) for size in (n, 4 * n)),
        ["Rondel / its limit", uniform, spread(results.ratio(uniform, "limit"))],
        ["cells and areas / triangulation", uniform,
         spread(results.ratio("dual", "dual", "dual", "seconds"))],
        ["relative error of the sum of areas", uniform, f"{error:.1e}"],
        *(["hard / uniform, per site", name,
           number(results.ns_each(name)[0] / results.ns_each(uniform)[0])] for name in hard),
    ]


def tables(settings):
    return [Table("Ratios", HEAD, [*against_peers(settings), *of_rondel(settings)],
                  [f"{environment.processor()}. Every build has sites of its own."])]
