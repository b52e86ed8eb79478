#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""How far the weights of YAC and of Rondel are from those of the corners as they are, by integrals with 40 digits.

    yac_accuracy.py N NLON [SEED]

The pairs of yac_bench.py: Voronoi cells of N sites, and a grid of NLON x NLON/2 cells between parallels. Of the pairs whose
weights differ most, of those that one of the two lacks, and of as many random ones, prints a JSON object: how many, and the
greatest error of both. Rondel gets the corners as unit vectors, YAC as longitudes and latitudes, which are their roundings,
and so for lines in degrees and radians: each is held to its own. Needs rondel, yac, netCDF4, SciPy, mpmath.
"""

import json
import sys

import mpmath
import numpy as np
import scipy.sparse

import rondel
from yac_bench import read_yac, voronoi_cells, yac_fields, yac_weights

EACH = 40
mpmath.mp.dps = 40


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def dot(p, q):
    return sum(a * b for a, b in zip(p, q))


def left_of(ring, normal):
    """What of a convex ring lies where normal.q >= 0."""
    kept = []
    for p, q in zip(ring, ring[1:] + ring[:1]):
        at_p, at_q = dot(normal, p), dot(normal, q)
        if at_p >= 0:
            kept.append(p)
        if at_p * at_q < 0:
            kept.append([(a * at_q - b * at_p) / (at_q - at_p) for a, b in zip(p, q)])
    return kept


def area_below(ring, middle, sine):
    """The integral of min(sin(lat), sine) along the ring, clockwise: the area of what is south of that, but for a constant."""
    start = mpmath.atan2(middle[1], middle[0])

    def lon_of(p):
        """Relative to the middle's, so that none is cut."""
        return mpmath.atan2(middle[0] * p[1] - middle[1] * p[0], middle[0] * p[0] + middle[1] * p[1])

    def is_pole(p):
        return abs(p[0]) + abs(p[1]) < mpmath.mpf(10) ** -30

    total = mpmath.mpf(0)
    for p, q, r in zip(ring, ring[1:] + ring[:1], ring[2:] + ring[:2]):
        if is_pole(q):  # from meridian to meridian
            total -= min(mpmath.sign(q[2]), sine) * (lon_of(r) - lon_of(p))
        x, y, z = cross(p, q)
        if is_pole(p) or is_pole(q) or z == 0:
            continue
        west, east = lon_of(p), lon_of(q)

        def height(lon):
            slope = -(x * mpmath.cos(start + lon) + y * mpmath.sin(start + lon)) / z
            return slope / mpmath.sqrt(1 + slope**2)

        # Where the arc is at this height: x cos + y sin = -z tan(lat).
        cuts = [west, east]
        if abs(sine) < 1:
            level = -z * sine / mpmath.sqrt(1 - sine**2) / mpmath.sqrt(x**2 + y**2)
            if abs(level) < 1:
                for sign in (1, -1):
                    lon = mpmath.atan2(y, x) + sign * mpmath.acos(level) - start
                    lon -= 2 * mpmath.pi * mpmath.nint(lon / (2 * mpmath.pi))
                    if min(west, east) < lon < max(west, east):
                        cuts.append(lon)
        cuts.sort(reverse=bool(west > east))
        for a, b in zip(cuts, cuts[1:]):
            is_below = height((a + b) / 2) < sine
            total -= mpmath.quad(height, [a, b]) if is_below else sine * (b - a)
    return total


def weight(ring, west, east, south, north):
    """Of a convex cell in a cell of the grid."""
    middle_lon = (west + east) / 2
    middle = [mpmath.cos(middle_lon), mpmath.sin(middle_lon), mpmath.mpf(0)]
    kept = left_of(ring, [-mpmath.sin(west), mpmath.cos(west), mpmath.mpf(0)])
    kept = left_of(kept, [mpmath.sin(east), -mpmath.cos(east), mpmath.mpf(0)]) if kept else kept
    kept = left_of(kept, middle) if kept else kept
    if len(kept) < 3:
        return mpmath.mpf(0)
    low, high = mpmath.sin(south), mpmath.sin(north)
    area = area_below(kept, middle, high) - area_below(kept, middle, low)
    return area / ((east - west) * (high - low))


def main():
    count, nlon = int(sys.argv[1]), int(sys.argv[2])
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    meridians = np.linspace(0, 2 * np.pi, nlon + 1)
    parallels = np.linspace(-np.pi / 2, np.pi / 2, nlon // 2 + 1)
    cells, rings, corners, points = voronoi_cells(count, seed)
    lon, lat = np.arctan2(points[:, 1], points[:, 0]), np.arcsin(np.clip(points[:, 2], -1, 1))
    fields = yac_fields(rings, corners, lon, lat, meridians, parallels)
    grid = rondel.CellSet.lonlat_grid(np.degrees(meridians), np.degrees(parallels))
    ours = scipy.sparse.csr_array(rondel.remap(rondel.CellSet.polygons(cells, rings, corners, points), grid).weights.tocsr())
    theirs = read_yac(yac_weights(fields), ours.shape)

    difference = scipy.sparse.coo_array(abs(ours - theirs))
    both = scipy.sparse.csr_array((ours != 0).multiply(theirs != 0))
    is_common = np.asarray(both[difference.row, difference.col]).ravel()
    pairs = np.stack([difference.row, difference.col], axis=1)
    order = np.argsort(-difference.data)
    far = pairs[order][is_common[order]][:EACH]
    alone = pairs[~is_common][:EACH]
    entries = scipy.sparse.coo_array(ours)
    drawn = np.random.default_rng(1).choice(ours.nnz, EACH, replace=False)
    result = {"cells": count, "targets": len(meridians[1:]) * len(parallels[1:]), "weights": ours.nnz}
    for name, chosen in (("farthest", far), ("of one alone", alone),
                         ("random", np.stack([entries.row[drawn], entries.col[drawn]], axis=1))):
        errors = []
        for row, column in chosen:
            j, i = divmod(int(row), nlon)
            sides = [float(v) for v in (meridians[i], meridians[i + 1], parallels[j], parallels[j + 1])]
            ring = corners[rings[column]:rings[column + 1]]
            exact = weight([[mpmath.mpf(float(v)) for v in points[c]] for c in ring],
                           *(mpmath.radians(mpmath.mpf(float(np.degrees(v)))) for v in sides))
            of_lonlat = weight([[mpmath.cos(float(lat[c])) * mpmath.cos(float(lon[c])),
                                 mpmath.cos(float(lat[c])) * mpmath.sin(float(lon[c])), mpmath.sin(float(lat[c]))]
                                for c in ring], *map(mpmath.mpf, sides))
            errors.append((abs(float(ours[row, column] - exact)), abs(float(theirs[row, column] - of_lonlat)),
                           float(exact)))
        if errors:
            greatest = np.max(np.array(errors), axis=0)
            result[name] = {"pairs": len(errors), "rondel": greatest[0], "yac": greatest[1], "greatest_weight": greatest[2]}
    print(json.dumps(result))


if __name__ == "__main__":
    main()
