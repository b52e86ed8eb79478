# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What matplotlib's tricontour needs for the same smooth field: TriContourGenerator, without drawing.

    contours_bench.py SITES.npy FACES.npy

The triangles are Rondel's, those across the antimeridian left out; the plane is that of longitude and
latitude, which for matplotlib is as good as any. Prints one JSON object: nanoseconds a face.
"""

import json
import statistics
import sys
import time

import numpy
from matplotlib import _tri
from matplotlib.tri import Triangulation

LEVELS = numpy.linspace(-0.9, 0.9, 10)


def main():
    sites, faces = (numpy.load(path) for path in sys.argv[1:3])
    x, y, z = sites.T
    values = 16 * x * y * z * (x * x - y * y) + 0.4 * z
    lon, lat = numpy.degrees(numpy.arctan2(y, x)), numpy.degrees(numpy.arcsin(z))
    width = numpy.ptp(lon[faces], axis=1)
    plane = Triangulation(lon, lat, faces[width < 180].astype(numpy.int32))
    lines, bands = [], []
    for _ in range(4):
        start = time.perf_counter()
        generator = _tri.TriContourGenerator(plane.get_cpp_triangulation(), values)
        points = sum(len(part) for level in LEVELS for part in generator.create_contour(level)[0])
        lines.append(time.perf_counter() - start)
        start = time.perf_counter()
        generator = _tri.TriContourGenerator(plane.get_cpp_triangulation(), values)
        for low, high in zip([-1e9, *LEVELS], [*LEVELS, 1e9]):
            generator.create_filled_contour(low, high)
        bands.append(time.perf_counter() - start)
    nanoseconds = 1e9 / len(faces)
    print(json.dumps({"sites": len(sites), "points": points,
                      "isolines_ns_a_face": statistics.median(lines[1:]) * nanoseconds,
                      "bands_ns_a_face": statistics.median(bands[1:]) * nanoseconds}))


if __name__ == "__main__":
    main()
