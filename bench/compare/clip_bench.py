# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Voronoi cells of sites on land, clipped to land, as a GeoDataFrame: Rondel, srai, libpysal.

    clip_bench.py N [PROGRAM...]

From longitudes and latitudes of N sites, uniform on the sphere where data/land-110m.geojson is, to polygons. srai's cells are
spherical, libpysal's those of the plane of longitude and latitude. Programs run in turns, in one process, with sites of
their own each time. Prints a JSON object a program: the seconds of each turn, what the cells' areas in square degrees add
up to beside that of land, and how many cells are not valid. Needs rondel, srai, libpysal, geopandas.
"""

import json
import pathlib
import statistics
import sys
import time
import warnings

import geopandas
import numpy as np
import shapely

LAND = pathlib.Path(__file__).resolve().parents[2] / "data/land-110m.geojson"
TURNS = 3


def sites_on_land(count, land, seed):
    """Longitudes and latitudes."""
    random = np.random.default_rng(seed)
    shapely.prepare(land)
    found = np.zeros((0, 2))
    while len(found) < count:
        lon = random.uniform(-180, 180, 4 * count)
        lat = np.degrees(np.arcsin(random.uniform(-1, 1, 4 * count)))
        there = shapely.contains_xy(land, lon, lat)
        found = np.concatenate([found, np.column_stack([lon, lat])[there]])
    return found[:count]


def by_rondel(sites, land):
    import rondel

    return rondel.SphericalVoronoi.from_lonlat(*sites.T, threads=1).clip(land, threads=1).to_geopandas()


def by_srai(sites, land):
    from srai.regionalizers import VoronoiRegionalizer

    seeds = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*sites.T), crs=4326)
    area = geopandas.GeoDataFrame(geometry=[land], crs=4326)
    return VoronoiRegionalizer(seeds=seeds).transform(area)


def by_libpysal(sites, land):
    from libpysal.cg import voronoi_frames

    points = geopandas.GeoSeries(geopandas.points_from_xy(*sites.T))
    return voronoi_frames(points, clip=land, return_input=False, as_gdf=True)


PROGRAMS = {"rondel": by_rondel, "srai": by_srai, "libpysal": by_libpysal}


def main():
    warnings.simplefilter("ignore")
    count, names = int(sys.argv[1]), sys.argv[2:] or list(PROGRAMS)
    land = geopandas.read_file(LAND).union_all()
    for name in names:  # imports, and what is done once
        PROGRAMS[name](sites_on_land(100, land, 1), land)
    seconds, cells = {name: [] for name in names}, {}
    for turn in range(TURNS):
        sites = sites_on_land(count, land, 2 + turn)
        for name in names:
            start = time.perf_counter()
            cells[name] = PROGRAMS[name](sites, land).geometry
            seconds[name].append(time.perf_counter() - start)
    for name in names:
        found = cells[name].set_crs(None, allow_override=True)
        print(json.dumps({"program": name, "sites": count, "median": statistics.median(seconds[name]),
                          "seconds": seconds[name], "cells": len(found),
                          "area": found.area.sum() / land.area, "invalid": int((~found.is_valid).sum())}))


if __name__ == "__main__":
    main()
