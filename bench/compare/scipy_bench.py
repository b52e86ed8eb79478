#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""SciPy's SphericalVoronoi of the sites in a file: its constructor, which computes the convex hull
(by Qhull) and the Voronoi vertices, without the sorting of regions.

    scipy_bench.py FILE.npy
"""

import sys

import numpy
from scipy.spatial import SphericalVoronoi

from measure import measure, print_build


def main():
    points = numpy.load(sys.argv[1])
    try:
        diagram, seconds, memory = measure(lambda: SphericalVoronoi(points))
    except ValueError as error:
        raise SystemExit(str(error)) from None
    vertices = len(numpy.unique(diagram._simplices))
    print_build(len(points), vertices, len(diagram._simplices), seconds, memory)


if __name__ == "__main__":
    main()
