#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How far values of stripy (STRIPACK and SSRFPACK) are from Renka's function, as accuracy_bench.cpp
says, by its linear and its cubic interpolation; or what either raises.

    stripy_accuracy.py SITES.npy TARGETS.npy
"""

import json
import sys

import numpy
import stripy


def f0(points):
    x, y, z = points.T
    return 1 + x**8 + numpy.exp(2 * y**3) + numpy.exp(2 * z**2) + 10 * x * y * z


def lonlat(points):
    return numpy.arctan2(points[:, 1], points[:, 0]), numpy.arcsin(points[:, 2])


def main():
    sites, targets = (numpy.load(path) for path in sys.argv[1:3])
    triangulation = stripy.sTriangulation(*lonlat(sites), permute=True)
    result = {"sites": len(sites), "targets": len(targets)}
    for name, interpolate in (("linear", triangulation.interpolate_linear),
                              ("cubic", triangulation.interpolate_cubic)):
        values = interpolate(*lonlat(targets), f0(sites))[0]
        error = numpy.sqrt(numpy.mean((values - f0(targets)) ** 2))
        result[name] = None if numpy.isnan(error) else error
    print(json.dumps(result))


if __name__ == "__main__":
    main()
