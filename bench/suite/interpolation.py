# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How long interpolation takes, beside stripy, MetPy and CGAL's natural neighbors."""

import importlib.util
import subprocess
import sys

from .peers import COMPARE
from .rondel_alone import run
from .runs import SEED, run_once
from .tables import Table, number, power, spread

METHODS = {"prepare": "prepare, a site", "nearest": "nearest", "linear": "linear",
           "laplace": "Laplace", "sibson": "Sibson", "hermite": "Hermite, gradients given",
           "cubic": "cubic, gradients given", "cubic_estimated": "cubic, gradients estimated",
           "gradient": "rows of gradients, a site"}
PEER_SITES = 20_000


def methods(settings):
    """Points to values, on one thread; and beside peers, with as many targets as sites."""
    n = settings.size(2**20)
    program = settings.programs / "interpolate_bench"
    cases = {power(n): [program, n, n, "--seed", SEED],
             f"{PEER_SITES:,}": [program, PEER_SITES, PEER_SITES, "--seed", SEED]}
    results = run(settings, cases)
    rows = [[name, *(number(results.median(name, key)) for key in METHODS)] for name in results.of]
    ours = {key: results.median(f"{PEER_SITES:,}", key) for key in METHODS}
    return [Table("Interpolation, one thread, uniform sites and as many targets, ns a target",
                  ["sites", *METHODS.values()], rows),
            Table(f"Interpolation beside peers, {PEER_SITES:,} uniform sites and as many targets",
                  ["peer", "ns a target", "Rondel", "peer / Rondel"],
                  [*_of_scripts(settings, ours), *_of_cgal(settings)],
                  ["Rondel has its targets in random order, stripy as it is said."])]


def _of_scripts(settings, ours):
    files = [settings.out / f"{name}.npy" for name in ("sites", "targets-1", "targets-2", "targets-3")]
    for seed, path in enumerate(files, 1):
        subprocess.run([settings.programs / "write_input", "uniform", str(PEER_SITES), path, "--seed",
                        str(seed)], check=True)
    rows = []
    for module, script, wanted in (
            ("stripy", "stripy_bench.py",
             {"linear": ("stripy, linear, random order", "linear"),
              "linear_sorted": ("stripy, linear, bands of latitude", "linear"),
              "cubic": ("stripy, cubic, gradients estimated", "cubic_estimated")}),
            ("metpy", "metpy_bench.py",
             {"natural_neighbor": ("MetPy, natural neighbors in the plane", "sibson")})):
        if importlib.util.find_spec(module) is None:
            print(f"skipped: no Python module {module}", file=sys.stderr)
            continue
        outcome = run_once([sys.executable, COMPARE / script, *files], settings.limits.seconds)
        for key, (name, method) in wanted.items():
            cells = ([number(outcome.values[key]), number(ours[method]),
                      number(outcome.values[key] / ours[method])] if not outcome.failure
                     else [outcome.failure, "", ""])
            rows.append([name, *cells])
    for path in files:
        path.unlink()
    return rows


def _of_cgal(settings):
    program = settings.programs / "cgal_natural_bench"
    if not program.exists():
        print("skipped: cgal_natural_bench was not built: its library is not installed",
              file=sys.stderr)
        return []
    results = run(settings, {"CGAL": [program, PEER_SITES, PEER_SITES, "--seed", SEED]})
    theirs, ours = (1e9 * results.median("CGAL", key) / PEER_SITES
                    for key in ("cgal_seconds", "seconds"))
    return [["CGAL, natural neighbors (Sibson)", number(theirs), number(ours),
             spread(results.ratio("CGAL", "CGAL", "cgal_seconds", "seconds"))]]
