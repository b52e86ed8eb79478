# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Simplification beside GEOS: corners that are left, seconds, and the greatest distance.

    python3 simplify_bench.py coasts.npz          (of gshhg.py)

Islands of GSHHG within 12 degrees of the equator, where plane and sphere agree to 2 %, with the same
tolerance. GEOS' coverage_simplify, whose tolerance is of areas, gets the one that leaves as many
corners. Distances are in tolerances, between the corners of one line and the other line.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import shapely

import rondel

EARTH = 6371.0088
LAND = 1


def islands(path: str) -> np.ndarray[Any, Any]:
    rings = np.load(path)
    lonlat, offsets = rings["lonlat"], rings["rings"]
    found = []
    for k in np.flatnonzero(rings["level"] == LAND):
        ring = lonlat[offsets[k] : offsets[k + 1]]
        if len(ring) > 200 and abs(ring[:, 1]).max() < 12 and np.ptp(ring[:, 0]) < 20:
            found.append(shapely.Polygon(ring))
    return np.array([shape for shape in found if shape.is_valid])


def timed(call: Callable[[], Any]) -> tuple[Any, float]:
    begin = time.perf_counter()
    return call(), time.perf_counter() - begin


def with_as_many(given: Any, wanted: int, most: float) -> tuple[Any, float]:
    low, high = 0.0, most
    made, seconds = given, 0.0
    for _ in range(12):
        middle = (low + high) / 2
        made, seconds = timed(lambda: shapely.coverage_simplify(given, middle))
        if shapely.get_num_coordinates(made).sum() > wanted:
            low = middle
        else:
            high = middle
    return made, seconds


def main(path: str) -> None:
    given = islands(path)
    cells = rondel.CellSet.from_geometries(list(given), edges="geodesic")
    print(f"{len(given)} islands, {shapely.get_num_coordinates(given).sum()} positions")
    print("| km | | positions | invalid | distance | s |\n| --- | --- | --- | --- | --- | --- |")
    for km in (0.2, 1.0, 5.0):
        degrees = np.degrees(km / EARTH)
        # Polygons in degrees get 14 sixteenths of the tolerance.
        made = rondel.simplify(given, km * 16 / 14, EARTH, edges="geodesic")
        _, seconds = timed(lambda: rondel.simplify(cells, km, EARTH))
        rows = {"Rondel, cells": (made, seconds)}
        for name, keeps in (("GEOS, topology", True), ("GEOS", False)):
            rows[name] = timed(lambda: shapely.simplify(given, degrees, preserve_topology=keeps))
        number = shapely.get_num_coordinates(made).sum()
        rows["GEOS, coverage"] = with_as_many(given, number, 4 * degrees)
        for name, (shapes, seconds) in rows.items():
            far = shapely.hausdorff_distance(given, shapes).max() / degrees
            count = shapely.get_num_coordinates(shapes).sum()
            invalid = np.count_nonzero(~shapely.is_valid(shapes))
            print(f"| {km} | {name} | {count} | {invalid} | {far:.2f} | {seconds:.2f} |")


if __name__ == "__main__":
    main(sys.argv[1])
