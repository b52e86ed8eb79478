# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Conservative weights from Voronoi cells of uniform sites to a grid in longitude and latitude: YAC and Rondel.

    yac_bench.py N NLON [TURNS]

Weights of order 1 from N cells to a grid of NLON x NLON/2 cells between true parallels, in memory, one process, one thread.
Both get the same corners as doubles, in arrays. Programs run in turns, with sites of their own each time. Prints a
JSON object: medians of the seconds in which each takes the cells (YAC's basic grids; Rondel's sets of cells, with areas) and
makes weights of them (YAC: its exchange, search and weights, which its interface does not separate); the number of weights;
of pairs that both have, how much they differ at most; of others, how many there are and the greatest weight. Needs rondel,
yac, netCDF4, SciPy.
"""

import json
import pathlib
import statistics
import sys
import tempfile
import time

import netCDF4
import numpy as np
import scipy.sparse
from yac import core as yac

import rondel


def voronoi_cells(count, seed):
    """The cells' offsets, corners, and the corners' positions, each cell with one ring."""
    random = np.random.default_rng(seed)
    sites = random.normal(size=(count, 3))
    sites /= np.linalg.norm(sites, axis=1)[:, None]
    return rondel.CellSet.voronoi(rondel.SphericalDelaunay(sites)).rings


def seconds_of(work):
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def yac_fields(rings, corners, lon, lat, meridians, parallels):
    source = yac.BasicGrid.unstruct_new("source", np.diff(rings).astype(np.intc), lon, lat, corners.astype(np.intc))
    target = yac.BasicGrid.reg_2d_new("target", meridians[:-1], parallels, [True, False])
    cells = yac.yac_location.YAC_LOC_CELL
    source.set_global_index(cells, np.arange(len(rings) - 1, dtype=np.intc))  # otherwise it makes numbers of its own
    target.set_global_index(cells, np.arange((len(meridians) - 1) * (len(parallels) - 1), dtype=np.intc))
    return [yac.InterpField(grid.add_coordinates(cells)) for grid in (source, target)]


def yac_weights(fields):
    stack = yac.InterpolationStack()
    stack.add_conservative(1)
    return yac.compute_weights(stack, *fields)


def read_yac(weights, shape):
    with tempfile.TemporaryDirectory() as folder:
        path = str(pathlib.Path(folder) / "weights.nc")
        weights.write_to_file(path, "source", "target")
        with netCDF4.Dataset(path) as file:
            columns, rows = (file[name][:] - 1 for name in ("src_address", "dst_address"))
            return scipy.sparse.csr_array((file["remap_matrix"][:, 0], (rows, columns)), shape=shape)


def main():
    count, nlon = int(sys.argv[1]), int(sys.argv[2])
    turns = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    meridians = np.linspace(0, 2 * np.pi, nlon + 1)
    parallels = np.linspace(-np.pi / 2, np.pi / 2, nlon // 2 + 1)
    times = {"yac_grids": [], "yac_weights": [], "rondel_partitions": [], "rondel_weights": []}
    for turn in range(turns + 1):
        cells, rings, corners, points = voronoi_cells(count, turn)
        lon, lat = np.arctan2(points[:, 1], points[:, 0]), np.arcsin(np.clip(points[:, 2], -1, 1))
        grids, fields = seconds_of(lambda: yac_fields(rings, corners, lon, lat, meridians, parallels))
        search, theirs = seconds_of(lambda: yac_weights(fields))
        taken, cell_sets = seconds_of(lambda: (
            rondel.CellSet.polygons(cells, rings, corners, points, threads=1),
            rondel.CellSet.lonlat_grid(np.degrees(meridians), np.degrees(parallels), threads=1)))
        overlay, ours = seconds_of(lambda: rondel.remap(*cell_sets, threads=1).weights)
        if turn > 0:  # the first one has waited for memory
            for name, seconds in zip(times, (grids, search, taken, overlay), strict=True):
                times[name].append(seconds)
    ours, theirs = scipy.sparse.csr_array(ours.tocsr()), read_yac(theirs, ours.shape)
    difference = abs(ours - theirs)
    of_common = difference.multiply(ours != 0).multiply(theirs != 0)
    of_one = difference - of_common
    of_one.eliminate_zeros()
    medians = {name: statistics.median(seconds) for name, seconds in times.items()}
    print(json.dumps({"cells": count, "targets": nlon * (nlon // 2), "weights": ours.nnz} | medians
                     | {"ratio": medians["yac_weights"] / medians["rondel_weights"],
                        "greatest_difference": of_common.max(), "of_one_alone": of_one.nnz,
                        "greatest_of_one_alone": of_one.max()}))


if __name__ == "__main__":
    main()
