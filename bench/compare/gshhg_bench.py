# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Validity, repair, area and union of the coasts of GSHHG at full resolution, in seconds.

    python3 gshhg_bench.py binned_GSHHS_f.nc [THREADS]     (gshhg.py says where it is from)
    python3 gshhg_bench.py coasts.npz [THREADS]            (of gshhg.py)

Lands and islands in lakes, with lakes as holes. Areas are compared with those of the rings in
extended precision, of which each has a closed form: between arcs of great circles and a pole
(Eriksson 1990), or between straight lines in longitude and latitude, which Rondel replaces by
arcs within a tolerance. Prints the times and the differences of areas, relative to their sum;
fails if these are too large.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import gshhg
import numpy as np
import shapely

import rondel

Array = np.ndarray[Any, Any]

PI = np.longdouble(np.pi) + np.longdouble("1.2246467991473531772e-16")
MOST = {"geodesic": 1e-13, "lonlat": 1e-8}  # differences; that of lonlat is from arcs for lines


def timed(name: str, call: Callable[[], Any]) -> Any:
    """The result of a call, whose seconds are printed."""
    begin, busy = time.perf_counter(), time.process_time()
    made = call()
    print(
        f"  {name}: {time.perf_counter() - begin:.1f} s, "
        f"{time.process_time() - busy:.1f} s of the processor"
    )
    return made


def sum_of_edges(lonlat: Array, edges: str) -> np.longdouble:
    """The area that closed rings have to their left, but for what is around a pole."""
    lon, lat = (lonlat.astype(np.longdouble) * (PI / 180)).T
    width = np.diff(lon)
    if edges == "geodesic":
        width = (width + PI) % (2 * PI) - PI
        low, high = np.tan(lat[:-1] / 2), np.tan(lat[1:] / 2)
        return -2 * np.arctan2(np.tan(width / 2) * (low + high), 1 + low * high).sum()
    half = np.diff(lat) / 2
    mean = np.where(half == 0, 1, np.sin(half) / np.where(half == 0, 1, half))
    return -(width * np.sin((lat[:-1] + lat[1:]) / 2) * mean).sum()


def exact_areas(shapes: Array, edges: str) -> Array:
    """The areas of polygons and multipolygons in steradians, shells less holes."""
    areas = np.zeros(len(shapes), np.longdouble)
    polygons, shape_of = shapely.get_parts(shapes, return_index=True)
    rings, polygon_of = shapely.get_rings(polygons, return_index=True)
    positions, ring_of = shapely.get_coordinates(rings, return_index=True)
    ends = np.searchsorted(ring_of, np.arange(len(rings) + 1))
    is_shell = np.diff(polygon_of, prepend=-1) > 0
    for k, polygon in enumerate(polygon_of):
        ring = positions[ends[k] : ends[k + 1]]
        area = abs(sum_of_edges(ring, edges))
        steps = (np.diff(ring[:, 0]) + 180) % 360 - 180
        if edges == "geodesic" and abs(steps.sum()) > 1:  # around a pole
            area = 2 * PI - area
        areas[shape_of[polygon]] += area if is_shell[k] else -area
    return areas


def measure(shapes: Array, edges: str, threads: int) -> bool:
    """Prints what is measured with one kind of edges; whether areas agree."""
    print(f"{edges}: {len(shapes)} polygons, {shapely.get_num_coordinates(shapes).sum()} positions")
    options: dict[str, Any] = {"edges": edges, "threads": threads}
    begin = time.perf_counter()
    reasons = timed("validity", lambda: rondel.validity_reason(shapes, **options))
    wrong = reasons[reasons != "Valid Geometry"]
    print(f"    {len(wrong)} are not valid{'' if len(wrong) == 0 else ', the first: ' + wrong[0]}")
    repair: dict[str, Any] = {"invalid": "repair", **options}
    cells = timed("repair", lambda: rondel.CellSet.from_geometries(shapes, **repair))
    areas = timed("area", lambda: rondel.area(cells, radius=1))
    union = timed("union", lambda: rondel.union_all(cells, threads=threads))
    print(f"  all of it: {time.perf_counter() - begin:.1f} s")
    valid = timed("make_valid", lambda: rondel.make_valid(shapes, **options))
    exact = exact_areas(valid, edges)
    total = exact.sum()
    difference = float(abs(areas.astype(np.longdouble).sum() - total) / total)
    each = float(abs(areas - exact).max() / total)
    print(f"  areas differ by {difference:.1e} in sum, by {each:.1e} in one polygon at most")
    united = float(rondel.area(union, radius=1).sum())
    print(f"  the union has {united / float(total) - 1:+.1e} of their sum")
    return difference <= MOST[edges]


def main(source: str, threads: int) -> None:
    """Measures both kinds of edges."""
    rings = np.load(source) if source.endswith(".npz") else gshhg.joined(source)
    are_close = [
        measure(gshhg.shapes_of(dict(rings), edges == "lonlat"), edges, threads)
        for edges in ("geodesic", "lonlat")
    ]
    if not all(are_close):
        sys.exit("areas differ by more than they may")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 2)
