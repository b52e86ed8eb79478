#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/coast-rows.png: cells on land and at sea, without and with rows of sites along the coast. Needs the
package `rondel`:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/coast-rows.py
"""


import matplotlib.pyplot as plt
import numpy as np
import rondel.mesh

from common import ROOT, save

LAND = ROOT / "data/land-110m.geojson"
VIEW = (-14, 9, 33, 51)  # west, east, south, north
CELLS = 40962


def main():
    fig, axes = plt.subplots(1, 2, figsize=(11, 5.6), dpi=100, layout="constrained")
    for ax, along, title in zip(axes, (None, LAND), ("relaxed alone", "rows along the coast"), strict=True):
        mesh = rondel.mesh.scvt(CELLS, along=along, largest_tolerance=0.1)
        is_land = mesh.cull(inside=LAND).cells < 0
        mesh.plot(is_land.astype(float), ax=ax, coast=True, cmap="YlGnBu_r", vmin=-0.5, vmax=1.4, colors="0.55",
                  linewidths=0.4)
        border = is_land[mesh.cells_on_edge].sum(axis=1) == 1
        ends = mesh.vertex_points[mesh.vertices_on_edge[border]]
        lon, lat = np.degrees(np.arctan2(ends[..., 1], ends[..., 0])), np.degrees(np.arcsin(ends[..., 2]))
        ax.plot(lon.T, lat.T, color="black", linewidth=1.4, solid_capstyle="round")
        ax.collections[1].set(color="tab:red", linewidth=1.2, zorder=4)
        ax.set(title=title, xlim=VIEW[:2], ylim=VIEW[2:], xlabel="", ylabel="", xticks=[], yticks=[], aspect=1.35)
    save(fig, "coast-rows.png")


if __name__ == "__main__":
    main()
