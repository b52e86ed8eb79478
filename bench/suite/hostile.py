# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What a site of a hostile kind costs beside a uniform one, and whether it costs more among more."""

from .rondel_alone import rondel
from .runs import run_in_turns
from .tables import Table, number

KINDS = ("meridian", "meridian-rounded", "orbit", "rotated-circle-0", "rotated-circle-1",
         "rotated-circle-2", "equator-and-pole", "cocircular", "lonlat-grid", "wedge", "cap",
         "ulp-clusters", "falling-clusters", "falling-spiral", "exponents", "lengths")
SIZES = (40_000, 320_000)


def beside_uniform(settings):
    """One thread. The uniform sites come in the same turns, as many."""
    sizes = [settings.size(n) for n in SIZES]
    return [_table(settings, model, sizes) for model in ("projected", "weighted")]


def _table(settings, model, sizes):
    results = run_in_turns({(kind, n): rondel(settings, kind, n, model)
                            for kind in ("uniform", *KINDS) for n in sizes}, settings.limits)
    head = [text for n in sizes for text in (f"{n:,}: ns a site", "/ uniform")]
    return Table(f"Hostile kinds, one thread, {model}",
                 ["kind", *head, f"growth a site, {sizes[1]:,} / {sizes[0]:,}"],
                 [row(results, kind, sizes) for kind in ("uniform", *KINDS)])


def row(results, kind, sizes):
    """A failure stands in the place of a time."""
    costs = [results.ns_each((kind, n)) and results.ns_each((kind, n))[0] for n in sizes]
    cells = []
    for n, cost in zip(sizes, costs):
        uniform = results.ns_each(("uniform", n))
        cells += ([number(cost), number(cost / uniform[0])] if cost
                  else [results.failure((kind, n)), ""])
    return [kind, *cells, number(costs[1] / costs[0]) if all(costs) else ""]
