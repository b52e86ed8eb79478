# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Rondel and its peers on the same sites: the paper's figure 4, its table 1, real data as in its
figure 5, and the inputs on which peers break."""

import contextlib
import statistics
import subprocess

from . import peers as peers_module
from . import plots
from .peers import RONDEL, RONDEL_WEIGHTED
from .runs import Outcome, run_in_turns, run_once
from .tables import Table, number, power, spread


@contextlib.contextmanager
def sites_file(settings, kind, n):
    """The sites as .npy, for programs in other languages."""
    path = settings.out / "sites.npy"
    subprocess.run([settings.programs / "write_input", kind, str(n), path], check=True)
    try:
        yield path
    finally:
        path.unlink()


def verdict(outcome, expected):
    """A result with other vertices than expected, or no closed surface, is a failure."""
    if outcome.failure:
        return outcome
    vertices, faces = outcome.values["vertices"], outcome.values["faces"]
    failure = ""
    if vertices != expected:
        failure = f"{vertices:,} vertices instead of {expected:,}"
    elif faces != 2 * vertices - 4:
        failure = f"{faces:,} faces instead of {2 * vertices - 4:,}"
    return Outcome(outcome.values, failure)


def expected_vertices(settings, kind, n):
    """Of both models, by Rondel: `rondel check` and the tests are why it is the measure."""
    found = {}
    for peer in (RONDEL, RONDEL_WEIGHTED):
        outcome = run_once([settings.programs / peer.program, kind, n, peer.model],
                           settings.limits.seconds)
        if outcome.failure:
            raise SystemExit(f"{peer.label}, {kind} {n}: {outcome.failure}")
        found[peer.model] = outcome.values["vertices"]
    return found


def measure(settings, kind, n, those):
    """Results by label of the peer."""
    expected = expected_vertices(settings, kind, n)
    models = {peer.label: peer.model for peer in those}
    with sites_file(settings, kind, n) as file:
        cases = {peer.label: peers_module.command(peer, settings, kind, n, file)
                 for peer in those}
        return run_in_turns(cases, settings.limits,
                            lambda name, outcome: verdict(outcome, expected[models[name]]))


def text(results, label):
    return results.failure(label) or spread(results.ns_each(label))


def over_sizes(settings):
    """Figure 4 and table 1. A peer that ran out of time is not run on more sites."""
    those = peers_module.available(settings)
    by_size, lost = {}, {}
    for n in settings.sizes(settings.peers_max_log2):
        results = measure(settings, "uniform", n, [p for p in those if p.label not in lost])
        for label, failure in lost.items():
            results.of[label] = [Outcome(failure=failure)]
        by_size[n] = results
        for peer in those:
            failure = results.failure(peer.label)
            if failure.startswith("over ") and peer.label not in lost:
                lost[peer.label] = f"{failure} at {power(n)}"
    table = Table(
        "Time against the number of uniform sites (the paper's figure 4)",
        ["ns a site: median (least to greatest)", *map(power, by_size)],
        [[p.label, *(text(results, p.label) for results in by_size.values())] for p in those])
    plots.time_against_n(settings.out / "figure4.svg", those, by_size, settings.limits.seconds)
    return [table, memory_table(those, by_size)]


def memory_table(those, by_size):
    """The paper's table 1, from the runs with more than 2^16 sites; where a peer has none, from its
    largest."""
    rows = []
    for peer in those:
        good = {n: r for n, r in by_size.items() if not r.failure(peer.label)}
        sizes = [n for n in good if n > 2**16] or list(good)[-1:]
        each = [bytes_per_vertex(good[n], peer.label) for n in sizes]
        rows.append([peer.label, number(statistics.mean(each)) if each else "",
                     ", ".join(map(power, sizes))])
    return Table("Bytes per vertex (the paper's table 1)",
                 ["program", "bytes per vertex", "mean of"], rows,
                 ["Growth of the peak of resident memory above the input, which is in memory."])


def bytes_per_vertex(results, label):
    return (results.median(label, "bytes_per_site") * results.first(label, "sites")
            / results.first(label, "vertices"))


def hard_inputs(settings):
    """(name, kind, n) of the inputs on which peers break."""
    grid, million = settings.size(500_000), settings.size(2**20)
    patch, paper = settings.size(2**18), settings.size(100_000)
    return [
        ("grid 500 x 1000" if grid == 500_000 else f"grid of about {grid:,}", "grid", grid),
        (f"Fibonacci {power(million)}", "fibonacci", million),
        (f"S_{paper}", "paper-s", paper),
        (f"{power(patch)}, all but 1000 in a patch of 1e-6 rad", "patch-and-globe", patch),
    ]


def on_hard_inputs(settings):
    those = peers_module.available(settings)
    columns = [(name, measure(settings, kind, n, those)) for name, kind, n in
               hard_inputs(settings)]
    return [Table("Inputs on which programs break",
                  ["ns a site: median (least to greatest)", *(name for name, _ in columns)],
                  [[p.label, *(text(results, p.label) for _, results in columns)] for p in those])]


def draw_stations(settings):
    """The pictures of figure 5, by the tool."""
    for show in ("delaunay", "voronoi"):
        picture = settings.out / f"figure5-{show}.svg"
        subprocess.run([settings.programs / "rondel", "plot", settings.stations[0], "--show", show,
                        "-o", picture, "--quiet"], check=True)


def on_stations(settings):
    """Real data, duplicates included, as in the paper's figure 5."""
    draw_stations(settings)
    those = peers_module.available(settings)
    tables = []
    for path in settings.stations:
        results = measure(settings, path, 0, those)
        rows = []
        for peer in those:
            times = [1e3 * value for value in results.all(peer.label)]
            milliseconds = (spread((statistics.median(times), min(times), max(times)))
                            if times else "")
            rows.append([peer.label, milliseconds, results.failure(peer.label) or "right"])
        sites = results.first(RONDEL.label, "sites")
        vertices = results.first(RONDEL.label, "vertices")
        tables.append(Table(
            f"{path.name}: {sites:,} stations in {vertices:,} places (the paper's figure 5)",
            ["program", "milliseconds: median (least to greatest)", "result"], rows))
    return tables
