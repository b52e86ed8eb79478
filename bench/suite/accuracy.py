# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How far interpolated values are from a smooth function, beside stripy's."""

import importlib.util
import math
import subprocess
import sys

from .peers import COMPARE
from .runs import run_once
from .tables import Table

SITES = (("uniform", 200, 10), ("uniform", 800, 10), ("uniform", 3200, 5), ("uniform", 12800, 2),
         ("fibonacci", 800, 1), ("fibonacci", 3200, 1), ("fibonacci", 12800, 1),
         ("fibonacci", 51200, 1))
TARGETS = 20_000
OURS = ("linear", "laplace", "sibson", "hermite", "cubic", "hermite_exact", "cubic_exact")
HEAD = ["sites", "linear", "Laplace", "Sibson", "Hermite", "cubic", "Hermite, exact gradients",
        "cubic, exact gradients", "stripy, cubic", "stripy / cubic", "worst of the sets"]


def of_values(settings):
    """Each set of sites and targets is a pair of files, which both programs read."""
    has_stripy = importlib.util.find_spec("stripy") is not None
    if not has_stripy:
        print("skipped: no Python module stripy", file=sys.stderr)
    rows = [_row(settings, kind, n, count, has_stripy) for kind, n, count in SITES]
    note = ("The root of the mean square of errors at 20,000 uniform targets, and of its mean over the "
            "sets of sites; the function is F0 = 1 + x^8 + exp(2 y^3) + exp(2 z^2) + 10 x y z (Renka). "
            "stripy's ratios are of the sets for which it has values everywhere.")
    return [Table("Errors of interpolation", HEAD, rows, [note])]


def _row(settings, kind, n, count, has_stripy):
    ours, theirs = [], []
    for seed in range(1, count + 1):
        files = [settings.out / "sites.npy", settings.out / "targets.npy"]
        for path, what, size, first in ((files[0], kind, n, seed),
                                        (files[1], "uniform", TARGETS, 1000 + seed)):
            subprocess.run([settings.programs / "write_input", what, str(size), path, "--seed",
                            str(first)], check=True)
        ours.append(run_once([settings.programs / "accuracy_bench", files[0], "0", files[1], "0"],
                             settings.limits.seconds).values)
        command = [sys.executable, COMPARE / "stripy_accuracy.py", *files]
        theirs.append(run_once(command, settings.limits.seconds).values if has_stripy else {})
        for path in files:
            path.unlink()
    return row(f"{kind} {n:,}" + (f", {count} sets" if count > 1 else ""), ours, theirs)


def row(name, ours, theirs):
    """`ours` and `theirs` are what the programs say of each set; nothing where one failed."""
    cells = [_error(_mean([o[key] for o in ours if key in o])) for key in OURS]
    pairs = [(o["cubic"], t["cubic"]) for o, t in zip(ours, theirs) if "cubic" in o and t.get("cubic")]
    ratio = _mean([t for _, t in pairs]) / _mean([o for o, _ in pairs]) if pairs else None
    found = f", {len(pairs)} of {len(theirs)}" if len(pairs) < len(theirs) else ""
    peer = [_error(_mean([t for _, t in pairs])) + found, f"{ratio:.3g}",
            f"{min(t / o for o, t in pairs):.3g}"] if pairs else ["no value", "", ""]
    return [name, *cells, *peer]


def _mean(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else None


def _error(value):
    return "" if value is None else f"{value:.2e}"
