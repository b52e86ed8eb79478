#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangle (Shewchuk), PyPI `triangle`, as a peer of constrained_bench: the constrained Delaunay
triangulation of the plane of longitudes and latitudes. What it computes is less: nothing is joined
across the antimeridian or around the poles, and constraints across the antimeridian are left out.

    write_input uniform N SITES.npy CONSTRAINTS EDGES.csv
    triangle_constrained_bench.py SITES.npy EDGES.csv

Prints seconds, medians, as one JSON object.
"""

import json
import sys

import numpy
import triangle

from measure import measure


def lonlat(points):
    """Longitudes and latitudes in degrees."""
    lon = numpy.degrees(numpy.arctan2(points[:, 1], points[:, 0]))
    lat = numpy.degrees(numpy.arctan2(points[:, 2], numpy.hypot(points[:, 0], points[:, 1])))
    return numpy.stack([lon, lat], axis=1)


def main():
    places = lonlat(numpy.load(sys.argv[1]))
    edges = numpy.loadtxt(sys.argv[2], delimiter=",", dtype=numpy.int32, ndmin=2)
    edges = edges[numpy.abs(places[edges[:, 0], 0] - places[edges[:, 1], 0]) < 180]
    # z: count from 0; N: do not return the vertices; c: up to the convex hull; p: with segments.
    plain = measure(lambda: triangle.triangulate({"vertices": places}, "zN"))
    graph = {"vertices": places, "segments": edges}
    made = measure(lambda: triangle.triangulate(graph, "pczNP"))
    print(json.dumps({"sites": len(places), "constraints": len(edges),
                      "faces": len(made[0]["triangles"]), "delaunay_seconds": plain[1],
                      "constrained_seconds": made[1]}))


if __name__ == "__main__":
    main()
