#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How long MetPy's natural neighbor interpolation takes, nanoseconds a target, in the plane of longitude and
latitude; it triangulates within the call.

    metpy_bench.py SITES.npy TARGETS.npy ...

Each set of targets is one repetition; its first thousand count, as MetPy takes a time to each.
"""

import json
import statistics
import sys
import time

import numpy
from metpy.interpolate import natural_neighbor_to_points

MOST_TARGETS = 1000


def plane(points):
    return numpy.degrees(numpy.stack((numpy.arctan2(points[:, 1], points[:, 0]),
                                      numpy.arcsin(points[:, 2])), axis=1))


def main():
    sites, *sets = (numpy.load(path) for path in sys.argv[1:])
    field = sites[:, 0] * sites[:, 1] + sites[:, 2]
    times = []
    for targets in sets:
        places = plane(targets[:MOST_TARGETS])
        start = time.perf_counter()
        natural_neighbor_to_points(plane(sites), field, places)
        times.append((time.perf_counter() - start) / len(places))
    print(json.dumps({"sites": len(sites), "natural_neighbor": 1e9 * statistics.median(times)}))


if __name__ == "__main__":
    main()
