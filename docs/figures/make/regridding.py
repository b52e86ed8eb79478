#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/figures/regridding.png: values of the sea on a grid of two degrees, their means over pixels of HEALPix, the same
with values that creep ashore, and the means of what is on land over countries. Needs the package `rondel`, xarray and GeoPandas:

    PYTHONPATH=build/release/python build/python/bin/python docs/figures/make/regridding.py
"""

import pathlib
import tempfile

import geopandas
import matplotlib.pyplot as plt
import numpy as np
import rondel
import shapely
import xarray
from matplotlib.collections import PolyCollection

from common import ROOT, save

VIEW = (-30, 70, -40, 60)  # west, east, south, north
COLORS = {"cmap": "RdYlBu_r", "vmin": -5, "vmax": 30}
PIXELS = "healpix:4"


def draw(ax, shapes, values):
    """Polygons in the colors of their values; those without one are gray."""
    parts, owners = shapely.get_parts(shapes, return_index=True)
    rings = [shapely.get_coordinates(shapely.get_exterior_ring(part)) for part in parts]
    colors = plt.get_cmap(COLORS["cmap"]).with_extremes(bad="lightgray")
    drawn = PolyCollection(rings, array=np.ma.masked_invalid(values[owners]), cmap=colors, edgecolors="gray", linewidths=0.3)
    drawn.set_clim(COLORS["vmin"], COLORS["vmax"])
    return ax.add_collection(drawn)


def main():
    lon, lat = np.arange(-179, 180, 2.0), np.arange(-89, 90, 2.0)
    x, y = np.meshgrid(lon, lat)
    warmth = 30 * np.cos(np.radians(y)) ** 2 - 3 + 3 * np.sin(np.radians(3 * x)) * np.cos(np.radians(2 * y))
    land = geopandas.read_file(ROOT / "data/land-110m.geojson").union_all()
    is_land = shapely.contains_xy(land, x, y)
    data = xarray.Dataset(coords={"lat": ("lat", lat, {"units": "degrees_north"}), "lon": ("lon", lon, {"units": "degrees_east"})})
    data["sea"] = (("lat", "lon"), np.where(is_land, np.nan, warmth))
    data["land"] = (("lat", "lon"), np.where(is_land, warmth, np.nan))
    countries = geopandas.read_file(ROOT / "data/countries-110m.geojson")
    pixels = np.asarray(geopandas.GeoSeries.from_arrow(rondel.CellSet.named(PIXELS)))
    with tempfile.TemporaryDirectory() as folder:
        before, after = pathlib.Path(folder, "sea.nc"), pathlib.Path(folder, "filled.nc")
        data[["sea"]].to_netcdf(before)
        rondel.regrid_file(before, PIXELS, after, extrapolate="creep", extrapolate_levels=1)
        filled = xarray.load_dataset(after)["sea"].values
    means = rondel.zonal_statistics(data["land"], countries, statistics="mean")

    fig, axes = plt.subplots(1, 4, figsize=(14, 4.2), dpi=100, layout="constrained")
    axes[0].pcolormesh(lon, lat, np.ma.masked_invalid(data["sea"]), **COLORS)
    axes[0].set_title("a field of the sea, 2 degrees")
    draw(axes[1], pixels, rondel.regrid(data, PIXELS)["sea"].values)
    axes[1].set_title("means over healpix:4")
    draw(axes[2], pixels, filled)
    axes[2].set_title("one level of creeping fill")
    drawn = draw(axes[3], np.asarray(countries.geometry), np.asarray(means["mean"], float))
    axes[3].set_title("means over countries")
    fig.colorbar(drawn, ax=axes, shrink=0.7)
    for ax in axes:
        ax.set(xlim=VIEW[:2], ylim=VIEW[2:], xticks=[], yticks=[], aspect="equal", facecolor="lightgray" if ax is axes[0] else "white")
    save(fig, "regridding.png")


if __name__ == "__main__":
    main()
