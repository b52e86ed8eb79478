# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Functions on polygons of shapely, from arrays of shapely to arrays of shapely or numbers.

    python3 shapes_bench.py coasts.npz [TURNS]          (of gshhg.py)

The polygons are islands of GSHHG within 12 degrees of the equator, each fourth one, and 20,000
boxes of which neighbors share sides. The second operand of `intersection`, `contains` and `relate`
are the same polygons, moved by 0.05 degrees. Rondel reads them with geodesic edges, as spherely (S2)
does; `rondel, text` gets them as GeoJSON, as those have to go that other libraries have. GEOS
computes in the plane. Prints medians of the turns in seconds of processors, which other work on the
machine changes less; what a program does not have is left out, and spherely if it is not installed.
"""

from __future__ import annotations

import importlib
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
from simplify_bench import islands

import rondel

Shapes = np.ndarray[Any, Any]
Calls = dict[str, Callable[[], Any]]

ARCS: dict[str, Any] = {"edges": "geodesic"}
SHIFT = 0.05  # degrees
TOLERANCE = 0.01  # degrees


def boxes() -> Shapes:
    west, south = np.meshgrid(np.arange(-100, 100) * 0.1, np.arange(-50, 50) * 0.1)
    made: Shapes = shapely.box(west, south, west + 0.1, south + 0.1).ravel()
    return made


def by_rondel(first: Any, second: Any) -> Calls:
    radians = np.radians(TOLERANCE)
    return {
        "area": lambda: rondel.area(first, **ARCS),
        "simplify": lambda: rondel.simplify(first, radians, **ARCS),
        "union_all": lambda: rondel.union_all(first, **ARCS),
        "intersection": lambda: rondel.intersection(first, second, **ARCS),
        "contains": lambda: rondel.contains(first, second, **ARCS),
        "relate": lambda: rondel.relate(first, second, **ARCS),
    }


def by_text(first: Shapes, second: Shapes) -> Calls:
    mapping = shapely.geometry.mapping
    return by_rondel([*map(mapping, first)], [*map(mapping, second)])


def by_geos(first: Shapes, second: Shapes) -> Calls:
    return {
        "area": lambda: shapely.area(first),
        "simplify": lambda: shapely.simplify(first, TOLERANCE),
        "union_all": lambda: shapely.union_all(first),
        "intersection": lambda: shapely.intersection(first, second),
        "contains": lambda: shapely.contains(first, second),
        "relate": lambda: shapely.relate(first, second),
    }


def by_spherely(first: Shapes, second: Shapes) -> Calls:
    spherely: Any = importlib.import_module("spherely")

    def taken(shapes: Shapes) -> Any:
        return spherely.from_wkb(shapely.to_wkb(shapes))

    def given(shapes: Any) -> Shapes:
        made: Shapes = shapely.from_wkb(spherely.to_wkb(shapes))
        return made

    return {
        "area": lambda: spherely.area(taken(first)),
        "intersection": lambda: given(spherely.intersection(taken(first), taken(second))),
        "contains": lambda: spherely.contains(taken(first), taken(second)),
    }


PROGRAMS = {
    "rondel": by_rondel,
    "rondel, text": by_text,
    "GEOS": by_geos,
    "spherely": by_spherely,
}


def seconds_of(call: Callable[[], Any]) -> float:
    begin = time.process_time()
    call()
    return time.process_time() - begin


def main(path: str, turns: int) -> None:
    print("| polygons | positions | function | program | processor s | least | most |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, first in (("islands", islands(path)[::4]), ("boxes", boxes())):
        second = shapely.transform(first, lambda positions: positions + SHIFT)
        calls: dict[tuple[str, str], Callable[[], Any]] = {}
        for program, make in PROGRAMS.items():
            try:
                made = make(first, second)
            except ImportError:
                continue
            calls.update({(function, program): call for function, call in made.items()})
        seconds: dict[tuple[str, str], list[float]] = {key: [] for key in calls}
        for _ in range(turns):
            for key, call in calls.items():
                seconds[key].append(seconds_of(call))
        count = shapely.get_num_coordinates(first).sum()
        for (function, program), found in sorted(seconds.items()):
            middle = statistics.median(found)
            print(
                f"| {name} | {count} | {function} | {program} | {middle:.3f} | {min(found):.3f} "
                f"| {max(found):.3f} |"
            )


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3)
