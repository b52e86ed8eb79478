# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import rondel
import stripy

random = np.random.default_rng(0)
lon = random.uniform(-np.pi, np.pi, 1000)
lat = np.arcsin(random.uniform(-1, 1, 1000))
where = random.normal(size=(1000, 3))
where_lon, where_lat = np.radians(rondel.lonlat(where)).T

# stripy
theirs = stripy.sTriangulation(lon, lat, tree=True)
their_faces = theirs.simplices[theirs.containing_triangle(where_lon, where_lat)]
their_distances, their_nearest = theirs.nearest_vertices(where_lon, where_lat, k=3)

# Rondel
ours = rondel.delaunay_lonlat(np.degrees(lon), np.degrees(lat))
our_faces = ours.simplices[ours.find_simplex(where)]
our_nearest = ours.k_nearest(where, 3)


def sets(simplices):
    return [frozenset(corners.tolist()) for corners in simplices]


same = {
    "triangles": set(sets(theirs.simplices)) == set(sets(ours.simplices)),
    "triangle at a place": sets(their_faces) == sets(our_faces),
    "nearest sites": np.array_equal(their_nearest, our_nearest),
    "edges": {frozenset(pair) for pair in theirs.identify_segments().tolist()} == {frozenset(pair) for pair in ours.edges.tolist()},
}
for what, is_same in same.items():
    print(f"{what}: {'the same' if is_same else 'different'}")
assert all(same.values())


def answer(function, *arguments):
    try:
        return f"{len(function(*arguments).simplices)} triangles"
    except ValueError as error:
        return str(error).replace("\n", " ")


twice = np.append(lon, lon[0]), np.append(lat, lat[0])
print("a site twice, stripy:", answer(stripy.sTriangulation, *twice))
print("a site twice, Rondel:", answer(rondel.delaunay_lonlat, *np.degrees(twice)))
equator = np.array([0, 1, 2, 3, 1.0]), np.array([0, 0, 0, 0, 1.0])
print("first three on the equator, stripy:", answer(stripy.sTriangulation, *equator))
print("first three on the equator, Rondel:", answer(rondel.delaunay_lonlat, *np.degrees(equator)))
