#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/regions.png: cells of the weather stations on land, the same joined by country, and the waters nearest
to each country. Needs the package `rondel`, and GeoPandas:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/regions.py
"""

import csv

import geopandas
import matplotlib.pyplot as plt
import numpy as np
import rondel

from common import ROOT, save

LAND = ROOT / "data/land-110m.geojson"
COUNTRIES = ROOT / "data/countries-110m.geojson"
VIEW = (-12, 30, 34, 62)  # west, east, south, north


def color_of(number):
    """Neighbors in the alphabet are unlike each other."""
    return plt.cm.tab20(number * 7 % 20)


def draw(ax, regions, numbers, title, width, alpha=1.0):
    frame = regions.to_geopandas()
    colors = [color_of(numbers[label]) for label in regions.labels[frame.index]]
    frame.plot(ax=ax, color=colors, edgecolor="white", linewidth=width, alpha=alpha)
    ax.set_title(title)


def main():
    with open(ROOT / "data/stations.csv", encoding="utf-8") as file:
        rows = [(float(row["longitude"]), float(row["latitude"])) for row in csv.DictReader(file)]
    lon, lat = np.array(rows).T
    countries = geopandas.read_file(COUNTRIES)
    places = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(lon, lat), crs=4326)
    nearest = geopandas.sjoin_nearest(places.to_crs(3857), countries[["name", "geometry"]].to_crs(3857))
    names = nearest["name"][~nearest.index.duplicated()].to_numpy()
    number = {name: k for k, name in enumerate(sorted(countries["name"]))}
    clipped = rondel.SphericalVoronoi.from_lonlat(lon, lat).clip(LAND)
    # Three that cross each other in the source are far from the picture.
    disjoint = countries[~countries["name"].isin(["Sudan", "S. Sudan", "Ethiopia"])]
    waters = rondel.feature_cells(disjoint, 5)
    fig, axes = plt.subplots(1, 3, figsize=(13.5, 4.6), dpi=100, layout="constrained")
    draw(axes[0], clipped, {k: number[name] for k, name in enumerate(names)}, "clip: cells on land", 0.4)
    axes[0].plot(lon, lat, ".", color="black", markersize=1.2)
    draw(axes[1], clipped.dissolve(names), number, "dissolve: cells joined by country", 0.8)
    of_feature = {k: number[name] for k, name in enumerate(disjoint["name"])}
    draw(axes[2], waters, of_feature, "feature_cells: to which country places are nearest", 0.8, 0.45)
    countries.plot(ax=axes[2], color=[color_of(number[name]) for name in countries["name"]])
    for ax in axes:
        ax.set(xlim=VIEW[:2], ylim=VIEW[2:], xticks=[], yticks=[], aspect=1.45)
    save(fig, "regions.png")


if __name__ == "__main__":
    main()
