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



def field(lon, lat):
    """Renka's function of the place."""
    x, y, z = rondel.unit_vectors(np.degrees(lon), np.degrees(lat)).T
    return 1 + x**8 + np.exp(2 * y**3) + np.exp(2 * z**2) + 10 * x * y * z


values = field(lon, lat)

# stripy
theirs = stripy.sTriangulation(lon, lat, tree=True)
their_faces = theirs.simplices[theirs.containing_triangle(where_lon, where_lat)]
their_distances, their_nearest = theirs.nearest_vertices(where_lon, where_lat, k=3)
their_linear, _ = theirs.interpolate_linear(where_lon, where_lat, values)
their_cubic, _ = theirs.interpolate_cubic(where_lon, where_lat, values)
their_gradients = np.stack(theirs.gradient_xyz(values), axis=1)

# Rondel
ours = rondel.delaunay_lonlat(np.degrees(lon), np.degrees(lat))
our_faces = ours.simplices[ours.find_simplex(where)]
our_nearest = ours.k_nearest(where, 3)
our_linear = ours.interpolate(values, where, "linear")
our_cubic = ours.interpolate(values, where, "cubic")
our_gradients = ours.gradient(values)


def sets(simplices):
    return [frozenset(corners.tolist()) for corners in simplices]


same = {
    "triangles": set(sets(theirs.simplices)) == set(sets(ours.simplices)),
    "triangle at a place": sets(their_faces) == sets(our_faces),
    "nearest sites": np.array_equal(their_nearest, our_nearest),
    "edges": {frozenset(pair) for pair in theirs.identify_segments().tolist()} == {frozenset(pair) for pair in ours.edges.tolist()},
    "linear values, to 12 digits": np.allclose(their_linear, our_linear, rtol=1e-12),
}
for what, is_same in same.items():
    print(f"{what}: {'the same' if is_same else 'different'}")
assert all(same.values())


def error(found):
    return np.sqrt(np.mean((found - field(where_lon, where_lat)) ** 2))


constant = np.full(1000, 273.15)
with np.errstate(over="ignore"):  # in stripy, single precision
    their_constant, _ = theirs.interpolate_cubic(where_lon, where_lat, constant)
our_constant = ours.interpolate(constant, where, "cubic")
print(f"root mean square error, cubic: stripy {error(their_cubic):.1e}, Rondel {error(our_cubic):.1e}; linear, both: {error(our_linear):.1e}")
print(f"the constant 273.15, cubic, off by: stripy {abs(their_constant - 273.15).max():.0e}, Rondel {abs(our_constant - 273.15).max():.0e}")
print(f"median difference of the gradients: {np.median(np.linalg.norm(their_gradients - our_gradients, axis=1)):.2f} of up to {np.linalg.norm(our_gradients, axis=1).max():.0f}")
assert error(our_cubic) <= error(their_cubic)


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
