#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How long stripy (STRIPACK and SSRFPACK) takes to interpolate, nanoseconds a target: linear with targets
as they are and sorted by bands of latitude, and cubic with the gradients that it estimates.

    stripy_bench.py SITES.npy TARGETS.npy ...

Each set of targets is one repetition; the sites are triangulated before the clock starts.
"""

import json
import statistics
import sys
import time

import numpy
import stripy


def lonlat(points):
    return numpy.arctan2(points[:, 1], points[:, 0]), numpy.arcsin(points[:, 2])


def in_bands(lon, lat):
    """Bands as high as targets are apart, there and back: what a user of stripy can do at little cost."""
    height = 2 / numpy.sqrt(len(lon))
    band = numpy.floor(lat / height).astype(int)
    order = numpy.lexsort((numpy.where(band % 2, lon, -lon), band))
    return lon[order], lat[order]


def main():
    sites, *sets = (numpy.load(path) for path in sys.argv[1:])
    triangulation = stripy.sTriangulation(*lonlat(sites), permute=True)
    field = sites[:, 0] * sites[:, 1] + sites[:, 2]
    times = {"linear": [], "linear_sorted": [], "cubic": []}
    for targets in sets:
        lon, lat = lonlat(targets)
        for name, interpolate, places in (
                ("linear", triangulation.interpolate_linear, (lon, lat)),
                ("linear_sorted", triangulation.interpolate_linear, in_bands(lon, lat)),
                ("cubic", triangulation.interpolate_cubic, (lon, lat))):
            start = time.perf_counter()
            interpolate(*places, field)
            times[name].append((time.perf_counter() - start) / len(targets))
    print(json.dumps({"sites": len(sites), "targets": len(sets[0])} |
                     {name: 1e9 * statistics.median(t) for name, t in times.items()}))


if __name__ == "__main__":
    main()
