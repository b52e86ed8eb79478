#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/graphs.png: graphs, an alpha shape and empty circles of the weather stations around Iceland and
Scandinavia. Needs the package `rondel`:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/graphs.py
"""

import csv
import itertools

import matplotlib.pyplot as plt
import numpy as np
import rondel
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from common import ROOT, save

KINDS = ["delaunay", "urquhart", "gabriel", "relative", "mst"]
VIEW = (-26, 32, 53, 72)  # west, east, south, north


def arc(p, q):
    """Longitudes and latitudes from one unit vector to another."""
    steps = np.linspace(0, 1, 12)[:, np.newaxis]
    return rondel.lonlat(p + steps * (q - p)).T


def main():
    with open(ROOT / "data/stations.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lon, lat = (np.array([float(row[name]) for row in rows]) for name in ("longitude", "latitude"))
    tri = rondel.delaunay_lonlat(lon, lat)
    points = rondel.unit_vectors(lon, lat)
    fig, axes = plt.subplots(2, 3, figsize=(12, 6.4), dpi=100, layout="constrained")
    for ax, kind in zip(axes.flat, KINDS, strict=False):
        for a, b in tri.graph(kind).edges:
            ends = points[[a, b]]
            if max(lat[a], lat[b]) < 45 or ends[:, 0].max() < 0 or abs(lon[a] - lon[b]) > 180:
                continue
            ax.plot(*arc(*ends), color="tab:blue", linewidth=0.8)
        ax.set_title(kind)
    last = axes.flat[5]
    outlines = []  # holes turn the other way
    for ring in tri.alpha_shape(np.radians(2)).rings:
        closed = np.append(ring, ring[0])
        if lat[closed].max() < 50 or np.ptp(lon[closed]) > 90:
            continue
        sides = [arc(points[a], points[b]) for a, b in itertools.pairwise(closed)]
        outlines.append(Path(np.concatenate(sides, axis=1).T, closed=True))
    shape = Path.make_compound_path(*outlines)
    last.add_patch(PathPatch(shape, color="tab:orange", alpha=0.35, linewidth=0))
    last.set_title("alpha_shape, 2°")
    for ax in axes.flat:
        ax.plot(lon, lat, ".", color="black", markersize=2)
        ax.set(xlim=VIEW[:2], ylim=VIEW[2:], xticks=[], yticks=[], aspect=2)
    save(fig, "graphs.png")


if __name__ == "__main__":
    main()
