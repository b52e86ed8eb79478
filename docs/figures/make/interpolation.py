#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/interpolation.png: the made-up climate of docs/guide/interpolation.md at the weather stations, carried
to a grid; and what several methods make of it where stations are few. Needs the package `rondel`:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/interpolation.py
"""

import csv

import matplotlib.pyplot as plt
import numpy as np
import rondel

from common import ROOT, save

METHODS = ["nearest", "linear", "sibson", "hermite", "the formula"]
SOUTH_PACIFIC = (-180, -70, -62, 0)  # west, east, south, north
LEVELS = np.arange(-28, 37, 4)


def climate(lon, lat):
    """The formula of the guide."""
    a, b = np.radians(lon), np.radians(lat)
    return 28 - 48 * np.sin(b) ** 2 + 6 * np.sin(b) + 4 * np.cos(3 * a) * np.cos(b) ** 3


def draw_coasts(ax):
    """The curves of data/coast.txt: a first point and steps, in hundredths of a degree."""
    for line in (ROOT / "data/coast.txt").read_text("utf-8").splitlines():
        curve = np.cumsum(np.array(line.split(), float).reshape(-1, 2), axis=0) / 100
        for turn in (-360, 0, 360):
            ax.plot(curve[:, 0] + turn, curve[:, 1], color="black", linewidth=0.5)


def draw(ax, sites, region, step, method, **dots):
    west, east, south, north = region
    lon, lat = np.arange(west, east + step, step), np.arange(south, north + step, step)
    if method == "the formula":
        found = climate(lon, lat[:, None])
    else:
        found = rondel.interpolate(*sites, climate(*sites), lon, lat[:, None], method)
    drawn = ax.contourf(lon, lat, found, LEVELS, cmap="RdYlBu_r", extend="both")
    draw_coasts(ax)
    ax.plot(*sites, ".", color="black", **dots)
    ax.set(xlim=(west, east), ylim=(south, north), xticks=[], yticks=[], aspect="equal")
    return drawn


def main():
    with open(ROOT / "data/stations.csv", encoding="utf-8") as file:
        rows = [(float(s["longitude"]), float(s["latitude"])) for s in csv.DictReader(file)]
    sites = np.array(rows).T
    fig = plt.figure(figsize=(9, 6), dpi=110, layout="constrained")
    above, below = fig.subfigures(2, 1, height_ratios=[3.3, 1])
    ax = above.subplots()
    drawn = draw(ax, sites, (-180, 180, -90, 90), 0.5, "sibson", markersize=1)
    ax.set_title("sibson, 5,634 stations")
    above.colorbar(drawn, ax=ax, label="°C, made up", shrink=0.8)
    for ax, method in zip(below.subplots(1, 5), METHODS, strict=True):
        draw(ax, sites, SOUTH_PACIFIC, 0.25, method, markersize=2)
        ax.set_title(method)
    save(fig, "interpolation.png")


if __name__ == "__main__":
    main()
