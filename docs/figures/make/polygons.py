#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/polygons.png: a buffer of land, countries divided by meridians, and simplified countries, around the north
pole. Needs the package `rondel`, and GeoPandas:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/polygons.py
"""

import geopandas
import matplotlib.pyplot as plt
import numpy as np
import rondel
import shapely

from common import ROOT, save

SOUTH = 45  # degrees, where the pictures end
EARTH = 6371.0088  # kilometers


def seen_from_above(geometries):
    """In the plane of Lambert's equal-area projection of the north."""
    def projected(positions):
        lon, lat = np.radians(positions).T
        radius = 2 * np.sin((np.pi / 2 - lat) / 2)
        return np.column_stack([radius * np.sin(lon), -radius * np.cos(lon)])
    return geopandas.GeoSeries(shapely.transform(shapely.segmentize(np.asarray(geometries), 1), projected))


def colors(count):
    return [plt.cm.tab20(number * 7 % 20) for number in range(count)]


def main():
    countries = geopandas.read_file(ROOT / "data/countries-110m.geojson")
    cap = shapely.box(-180, SOUTH, 180, 90)
    north = countries[~countries["name"].isin(["Antarctica"])].reset_index(drop=True)
    land = rondel.union_all(north)
    north = north.set_geometry(rondel.intersection(north.geometry, cap))
    north = north[~north.geometry.is_empty].reset_index(drop=True)
    fig, axes = plt.subplots(1, 3, figsize=(13.5, 4.9), dpi=100, layout="constrained")

    near = rondel.intersection(rondel.buffer(land, 300, EARTH), cap)
    seen_from_above([near]).plot(ax=axes[0], color="#9ecae1")
    seen_from_above(north.geometry).plot(ax=axes[0], color="#d9d2bf")
    axes[0].set_title("buffer: within 300 km of land")

    hours = geopandas.GeoDataFrame(geometry=[shapely.box(west, SOUTH, west + 30, 90) for west in range(-180, 180, 30)], crs=4326)
    pieces = rondel.overlay(north[["name", "geometry"]], hours, "intersection")
    seen_from_above(pieces.geometry).plot(ax=axes[1], color=colors(len(pieces)), edgecolor="white", linewidth=0.4)
    axes[1].set_title("overlay: countries divided by meridians")

    few = rondel.simplify(north, 150, EARTH)
    seen_from_above(few.geometry).plot(ax=axes[2], color=colors(len(few)), edgecolor="white", linewidth=0.4)
    seen_from_above(north.geometry).boundary.plot(ax=axes[2], color="black", linewidth=0.4)
    axes[2].set_title("simplify: within 150 km, borders stay common")

    edge = 2 * np.sin(np.radians(90 - SOUTH) / 2)
    for ax in axes:
        ax.add_patch(plt.Circle((0, 0), edge, fill=False, color="gray", linewidth=0.6))
        ax.set(xlim=(-1.02 * edge, 1.02 * edge), ylim=(-1.02 * edge, 1.02 * edge), aspect=1)
        ax.set_axis_off()
    save(fig, "polygons.png")


if __name__ == "__main__":
    main()
