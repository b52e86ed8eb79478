#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/ocean-mesh.png: triangles in the sea around Europe, smaller along the coasts. Needs the package `rondel`, and GeoPandas:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/ocean-mesh.py
"""

import geopandas
import matplotlib.pyplot as plt
import numpy as np
import rondel
import rondel.mesh
from matplotlib.collections import LineCollection, PolyCollection

from common import ROOT, save

MIDDLE = 8, 52  # longitude and latitude
EDGE = 0.32  # of the picture, in radii of the globe
LAND, SEA, COAST = "#e4dcc4", "#eef4f8", "#1f4e79"
NEAR, FAR = 40 / 6371.229, 300 / 6371.229  # spacings at the coast and far from it


def seen_from_above(points):
    """In the plane of the orthographic projection."""
    lon, lat = np.radians(MIDDLE)
    east = [-np.sin(lon), np.cos(lon), 0]
    north = [-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)]
    return points @ np.transpose([east, north])


def main():
    land = geopandas.read_file(ROOT / "data/land-110m.geojson").geometry
    coast = rondel.constrained_delaunay(land)
    near = rondel.delaunay(coast.points[coast.constrained_edges.ravel()])

    def spacing(places):
        chords = np.linalg.norm(places - near.points[near.nearest(places)], axis=1)
        return np.clip(NEAR + 0.2 * 2 * np.arcsin(chords / 2), NEAR, FAR)

    mesh = rondel.mesh.triangles(land, spacing=spacing, gradient=0.2)
    flat = seen_from_above(mesh.points)
    is_seen = mesh.points @ rondel.unit_vectors(*MIDDLE) > 0
    triangles = mesh.triangles[is_seen[mesh.triangles].all(axis=1)]
    fig, ax = plt.subplots(figsize=(9, 9), dpi=100, layout="constrained")
    ax.set_facecolor(LAND)
    ax.add_collection(PolyCollection(flat[triangles], facecolor=SEA, edgecolor="0.45", linewidth=0.5))
    for segment in mesh.boundary:
        chain = np.append(segment.nodes, segment.nodes[0])
        edges = np.column_stack([chain[:-1], chain[1:]])
        ax.add_collection(LineCollection(flat[edges[is_seen[edges].all(axis=1)]], color=COAST, linewidth=1.2))
    ax.set(xlim=(-EDGE, EDGE), ylim=(-EDGE, EDGE), aspect=1, xticks=[], yticks=[])
    save(fig, "ocean-mesh.png")


if __name__ == "__main__":
    main()
