# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Plots as SVG. Without matplotlib there are none, and one line says so."""

import sys

PAGES_MATTER = 2**14  # below, memory in whole pages says little


def _pyplot():
    try:
        import matplotlib
        matplotlib.use("svg")
        from matplotlib import pyplot
    except ImportError:
        print("skipped: plots: matplotlib is not installed", file=sys.stderr)
        return None
    return pyplot


def _save(figure, path):
    figure.tight_layout()
    figure.savefig(path)
    figure.clf()


def time_against_n(path, peers, by_size, limit):
    """Seconds against n, both logarithmic. The first failure is a cross: at the limit of time, or
    for other failures at the last time that there is or the lower edge."""
    pyplot = _pyplot()
    if pyplot is None:
        return
    figure, axes = pyplot.subplots(figsize=(8, 8))
    failures = []
    for peer in peers:
        good = [(n, results.median(peer.label)) for n, results in by_size.items()
                if not results.failure(peer.label)]
        axes.plot(*zip(*good), peer.line, color=peer.color, label=peer.label, marker=".") if good \
            else axes.plot([], [], peer.line, color=peer.color, label=peer.label)
        bad = [n for n, results in by_size.items() if results.failure(peer.label)]
        if bad:
            too_long = by_size[bad[0]].failure(peer.label).startswith("over ")
            last = good[-1][1] if good else None
            failures.append(([*good[-1:], (bad[0], limit if too_long else last)], peer.color))
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    lowest = axes.get_ylim()[0]
    for points, color in failures:
        sizes, seconds = zip(*((n, s or lowest) for n, s in points))
        axes.plot(sizes, seconds, ":", color=color, linewidth=0.8)
        axes.plot(sizes[-1:], seconds[-1:], "x", color=color, markersize=9, markeredgewidth=2)
    axes.set_xticks(list(by_size))
    axes.set_xlabel("uniform sites")
    axes.set_ylabel("seconds; x: fails from here on")
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize=8, ncol=2, loc="upper center", bbox_to_anchor=(0.5, -0.1))
    _save(figure, path)
    pyplot.close(figure)


def cost_and_memory(path, points):
    """`points`: (n, {name: (ns a site, bytes a site)})."""
    pyplot = _pyplot()
    if pyplot is None:
        return
    figure, panels = pyplot.subplots(1, 2, figsize=(10, 4.5))
    for panel, i, title in zip(panels, (0, 1), ("ns a site", "bytes a site")):
        shown = [(n, of) for n, of in points if i == 0 or n >= PAGES_MATTER]
        for name in points[0][1]:
            panel.plot([n for n, _ in shown], [of[name][i] for _, of in shown], marker=".",
                       label=name)
        panel.set_xscale("log", base=2)
        panel.set_ylim(bottom=0)
        panel.set_xlabel("uniform sites")
        panel.set_ylabel(title)
        panel.grid(True, alpha=0.3)
        panel.legend()
    _save(figure, path)
    pyplot.close(figure)
