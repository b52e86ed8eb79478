#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/remapping.png: means over the Voronoi cells of scattered sites, carried to a grid to first and to second
order, and what is off. Needs the package `rondel`:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/remapping.py
"""

import matplotlib.pyplot as plt
import numpy as np
import rondel
from matplotlib.collections import PolyCollection

from common import save

VIEW = (-60, 60, -45, 45)  # west, east, south, north
STEP = 1.5


def field_of(points):
    """A wave on a slope."""
    x, y, z = points.T
    return z + 0.6 * np.sin(5 * y) * np.cos(4 * z) * x


def main():
    random = np.random.default_rng(4)
    points = random.normal(size=(1200, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    cells = rondel.SphericalVoronoi(points)
    source = rondel.CellSet.voronoi(cells)
    lon, lat = np.arange(-180, 180 + STEP, STEP), np.arange(-90, 90 + STEP, STEP)
    grid = rondel.CellSet.lonlat_grid(lon, lat)
    values = field_of(points)
    found = {order: rondel.remap(source, grid, order=order).weights.apply(values) for order in (1, 2)}
    middles = np.meshgrid(lon[:-1] + STEP / 2, lat[:-1] + STEP / 2)
    truth = field_of(rondel.unit_vectors(*middles).reshape(-1, 3))
    fig, axes = plt.subplots(2, 2, figsize=(10, 7), dpi=100, layout="constrained")
    colors = {"cmap": "RdYlBu_r", "vmin": -1.2, "vmax": 1.2}
    frame = cells.to_geopandas().explode()
    polygons = [np.array(polygon.exterior.coords) for polygon in frame.geometry]
    drawn = PolyCollection(polygons, array=values[frame["site"]], edgecolors="face", linewidths=0.2, cmap=colors["cmap"])
    drawn.set_clim(colors["vmin"], colors["vmax"])
    axes[0, 0].add_collection(drawn)
    axes[0, 0].set_title("1,200 cells")
    for ax, order in ((axes[0, 1], 1), (axes[1, 0], 2)):
        ax.pcolormesh(lon, lat, found[order].reshape(grid.shape), **colors)
        ax.set_title(f"on a grid, order={order}")
    off = {order: np.abs(found[order] - truth).reshape(grid.shape) for order in found}
    inside = (np.abs(middles[0]) < VIEW[1]) & (np.abs(middles[1]) < VIEW[3])
    bins = np.geomspace(1e-4, 1, 60)
    for order in found:
        axes[1, 1].hist(off[order][inside], bins, histtype="step", label=f"order={order}, median {np.median(off[order][inside]):.3f}")
    axes[1, 1].set(xscale="log", yticks=[], title="how far grid cells are from the field")
    axes[1, 1].legend(loc="upper left")
    fig.colorbar(drawn, ax=axes[:, 0], location="left", shrink=0.6)
    for ax in axes.flat[:3]:
        ax.set(xlim=VIEW[:2], ylim=VIEW[2:], xticks=[], yticks=[], aspect="equal")
    save(fig, "remapping.png")


if __name__ == "__main__":
    main()
