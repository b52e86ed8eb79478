#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangle (Shewchuk) of a stereographic projection of the sites from the last one: a hint of what
a planar program does, since the rounded projection is another set of sites. The projection is not
measured. Faces beside the last site are those that the outer edges have.

    triangle_bench.py FILE.npy
"""

import sys

import numpy
import triangle

from measure import measure, print_build


def stereographic(points):
    """Planar coordinates of all points but the last, seen from the last."""
    pole = points[-1] / numpy.linalg.norm(points[-1])
    other = numpy.eye(3)[numpy.argmin(numpy.abs(pole))]
    u = numpy.cross(pole, other)
    u /= numpy.linalg.norm(u)
    v = numpy.cross(pole, u)
    rest = points[:-1]
    distance = 1 - rest @ pole
    if numpy.any(distance <= 0):
        raise SystemExit("a site is a duplicate of the pole")
    return numpy.ascontiguousarray(numpy.stack([rest @ v, rest @ u], axis=1) / distance[:, None])


def main():
    points = numpy.load(sys.argv[1])
    plane = {"vertices": stereographic(points)}
    # z: count from 0; N: do not return the vertices; e: the edges, with marks where they are outer.
    result, *cost = measure(lambda: triangle.triangulate(plane, "zNe"))
    corners = result["triangles"]
    outer = int(numpy.sum(result["edge_markers"]))
    print_build(len(points), len(numpy.unique(corners)) + 1, len(corners) + outer, *cost)


if __name__ == "__main__":
    main()
