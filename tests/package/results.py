# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Prints hashes of what the installed package makes: results.py STATIONS. All print the same.

Sites are decimals, integers and Python's own random numbers: the same on every machine.
"""

import csv
import hashlib
import itertools
import pathlib
import random
import sys
import tempfile

import numpy as np

import rondel
import rondel.distributed
import rondel.out_of_core


def say(name, *arrays):
    digest = hashlib.sha256()
    for array in arrays:
        assert array.size, name
        digest.update(f"{array.dtype.str} {array.shape} ".encode())
        digest.update(array.tobytes())
    print(name, digest.hexdigest(), flush=True)


def say_diagram(name, diagram):
    mesh = diagram.delaunay
    say(f"{name} triangles", mesh.simplices, mesh.neighbors, mesh.circumcenters)
    say(f"{name} cells", *diagram.cells, diagram.vertices, diagram.areas, diagram.centroids)


with open(sys.argv[1], newline="", encoding="utf-8") as file:
    stations = list(csv.DictReader(file))
lon, lat = ([float(row[name]) for row in stations] for name in ("longitude", "latitude"))
grid = [point for point in itertools.product(range(-4, 5), repeat=3) if any(point)]
numbers = random.Random(17)
cloud = [[numbers.uniform(-1, 1) for _ in range(3)] for _ in range(70000)]

of_stations = rondel.SphericalVoronoi.from_lonlat(lon, lat)
say_diagram("stations", of_stations)
say("duplicates of stations", of_stations.duplicates)
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder, "cells.geojson")
    of_stations.to_geojson(path)
    print("file of stations", hashlib.sha256(path.read_bytes()).hexdigest())
circles = rondel.power_diagram(
    list(zip(lon, lat, strict=True)), [index % 7 / 4 for index in range(len(lon))]
)
say_diagram("circles", circles)
say("hidden circles", circles.hidden)
for model in ("projected", "weighted"):
    ties = rondel.delaunay(grid, model)
    say(f"{model} ties", ties.simplices, ties.neighbors, ties.circumcenters)
    for threads in (1, 3):
        many = rondel.delaunay(cloud, model, threads=threads)
        say(f"{model} cloud", many.simplices, many.neighbors)


class Alone:
    rank, size = 0, 1

    def allgather(self, message):
        return [message]

    def alltoall(self, messages):
        return messages


part = rondel.distributed.delaunay(cloud, Alone(), max_bucket_sites=10000)
say("rank", part.faces, part.neighbors, part.owned_sites)
with tempfile.TemporaryDirectory() as folder:
    sites, faces, neighbors, scratch = (
        pathlib.Path(folder, name) for name in ("sites.npy", "faces.npy", "neighbors.npy", "work")
    )
    np.save(sites, cloud)
    rondel.out_of_core.delaunay(sites, faces, scratch=scratch, memory="0.1g", neighbors=neighbors)
    say("files", np.load(faces), np.load(neighbors))
hull = rondel.convex_hull(cloud)
say("hull", hull.simplices)
print("volume", hull.volume.hex(), hull.area.hex())
