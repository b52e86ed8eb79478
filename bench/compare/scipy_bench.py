#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""SciPy's SphericalVoronoi of the sites in a file: its constructor, which computes the convex hull
(by Qhull) and the Voronoi vertices, without the sorting of regions. Its default threshold takes
sites within 1e-6 of each other for duplicates and stops, which 2^20 uniform sites are enough for.

    scipy_bench.py FILE.npy
"""

import sys

import numpy
from scipy.spatial import SphericalVoronoi

from measure import measure, print_build

THRESHOLD = 1e-13  # also the largest distance from the sphere, so it cannot be 0


def main():
    points = numpy.load(sys.argv[1])
    try:
        diagram, *cost = measure(lambda: SphericalVoronoi(points, threshold=THRESHOLD))
    except ValueError as error:
        raise SystemExit(str(error)) from None
    vertices = len(numpy.unique(diagram._simplices))
    print_build(len(points), vertices, len(diagram._simplices), *cost)


if __name__ == "__main__":
    main()
