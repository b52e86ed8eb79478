#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/constrained.png: weather stations and the corners of a coast, triangulated without and with the coast as edges, and the triangles
on land. Needs the package `rondel`, and GeoPandas:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/constrained.py
"""

import csv

import geopandas
import matplotlib.pyplot as plt
import numpy as np
import rondel
import shapely
from matplotlib.collections import LineCollection, PolyCollection

from common import ROOT, save

MIDDLE = 15, 43  # longitude and latitude
EDGE = 0.2  # of the picture, in radii of the globe
LAND, SEA, LOST, KEPT = "#e4dcc4", "#d7e6f0", "#d62728", "#1f4e79"


def seen_from_above(points):
    """In the plane of the orthographic projection."""
    lon, lat = np.radians(MIDDLE)
    east = [-np.sin(lon), np.cos(lon), 0]
    north = [-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)]
    return points @ np.transpose([east, north])


def seen(points, rows):
    """The rows whose places are all on the side that is seen."""
    return rows[(points[rows] @ rondel.unit_vectors(*MIDDLE) > 0).all(axis=1)]


def draw(ax, flat, rows, **options):
    ax.add_collection(LineCollection(flat[rows], **options))


def main():
    land = geopandas.read_file(ROOT / "data/land-110m.geojson").geometry
    with open(ROOT / "data/stations.csv", encoding="utf-8") as file:
        stations = [(float(row["longitude"]), float(row["latitude"])) for row in csv.DictReader(file)]
    coast = rondel.constrained_delaunay([*land, shapely.MultiPoint(stations)], "geodesic", crossings="split")
    plain = rondel.delaunay(coast.points)
    flat = seen_from_above(coast.points)
    borders = coast.constrained_edges
    is_kept = (borders[:, None] == plain.edges[None]).all(axis=2).any(axis=1)
    fig, axes = plt.subplots(1, 3, figsize=(13.5, 4.9), dpi=100, layout="constrained")

    draw(axes[0], flat, seen(coast.points, plain.edges), color="0.6", linewidth=0.6)
    draw(axes[0], flat, seen(coast.points, borders[is_kept]), color=KEPT, linewidth=1.3)
    draw(axes[0], flat, seen(coast.points, borders[~is_kept]), color=LOST, linewidth=1.8)
    axes[0].set_title("Delaunay: the red sides of the coast are no edges")

    draw(axes[1], flat, seen(coast.points, coast.edges), color="0.6", linewidth=0.6)
    draw(axes[1], flat, seen(coast.points, borders), color=KEPT, linewidth=1.3)
    axes[1].set_title("constrained Delaunay: each side is an edge")

    axes[2].set_facecolor(SEA)
    faces = seen(coast.points, coast.simplices[coast.inside])
    axes[2].add_collection(PolyCollection(flat[faces], facecolor=LAND, edgecolor="0.6", linewidth=0.6))
    draw(axes[2], flat, seen(coast.points, borders), color=KEPT, linewidth=1.3)
    axes[2].set_title("the triangles inside")

    for ax in axes:
        ax.set(xlim=(-EDGE, EDGE), ylim=(-EDGE, EDGE), aspect=1, xticks=[], yticks=[])
    save(fig, "constrained.png")


if __name__ == "__main__":
    main()
