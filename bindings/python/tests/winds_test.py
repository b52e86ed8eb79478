# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Vectors between sites: the wind of a turning globe, which is known everywhere."""

import clouds
import numpy as np
import pytest

import rondel

AXIS = np.array([0.3, -0.8, 0.5])
SITES = clouds.uniform(300)
TARGETS = np.concatenate([clouds.uniform(100, seed=1), [[0, 0, 1], [0, 0, -1]]])
METHODS = ["linear", "laplace", "sibson", "hermite", "cubic"]


def components(lon, lat):
    """AXIS x place, to the east and the north: derivatives of the place by numeric differences."""

    def place(lon, lat):
        a, b = np.radians(lon), np.radians(lat)
        return np.stack([np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)], axis=-1)

    wind = np.cross(AXIS, place(lon, lat))
    a = np.radians(lon)
    east = np.stack([-np.sin(a), np.cos(a), 0 * a], axis=-1)
    north = np.cross(place(lon, lat), east)
    return (wind * east).sum(axis=-1), (wind * north).sum(axis=-1)


@pytest.mark.parametrize("method", METHODS)
def test_a_rotation_comes_back_across_the_poles(method):
    tri = rondel.delaunay(SITES)
    vectors = np.cross(AXIS, SITES)
    found = tri.interpolate_vectors(vectors, TARGETS, method)
    bound = 1e-13 if method in ("linear", "laplace", "sibson") else 1e-2
    assert np.allclose(found, np.cross(AXIS, TARGETS), rtol=0, atol=bound)
    many = tri.interpolate_vectors(np.stack([vectors, -vectors]), TARGETS.reshape(2, 51, 3), method)
    assert many.shape == (2, 2, 51, 3)
    assert np.array_equal(many[0].reshape(-1, 3), found)
    assert np.array_equal(many[1], -many[0])


def test_winds_by_degrees():
    random = np.random.default_rng(0)
    lon, lat = random.uniform(-180, 180, 300), np.degrees(np.arcsin(random.uniform(-1, 1, 300)))
    lat[0] = 90  # its longitude says what is east there
    tri = rondel.delaunay_lonlat(lon, lat)
    to_lon, to_lat = np.linspace(0, 350, 36), np.array([[-90], [-89.9], [0], [60], [89.9], [90]])
    east, north = tri.interpolate_winds(*components(lon, lat), to_lon, to_lat)
    assert east.shape == north.shape == (6, 36)
    expected = components(*np.broadcast_arrays(to_lon, to_lat))
    assert np.allclose([east, north], expected, rtol=0, atol=1e-13)


def test_winds_by_names_of_dimensions():
    xarray = pytest.importorskip("xarray")
    tri = rondel.delaunay(SITES)
    to_lon, to_lat = np.linspace(0, 350, 18), np.linspace(-80, 80, 18)
    lon, lat = xarray.DataArray(to_lon, dims="lon"), xarray.DataArray(to_lat, dims="lat")
    u, v = (np.stack([part, 2 * part]) for part in components(*tri.lonlat.T))
    wanted = tri.interpolate_winds(u, v, to_lon, to_lat[:, None])
    east = xarray.DataArray(u, dims=("time", "site"))
    north = xarray.DataArray(v.T, dims=("site", "time"))
    found = tri.interpolate_winds(east, north, lon, lat)
    np.testing.assert_array_equal(found, wanted)
    turned = tri.interpolate_winds(u, v, *xarray.broadcast(lon, lat))
    np.testing.assert_array_equal(turned, np.swapaxes(wanted, -1, -2))


def test_components_of_their_own_fail_at_the_pole():
    """Why winds are not two fields of numbers."""
    tri = rondel.delaunay(SITES)
    lon, lat = tri.lonlat.T
    u, v = components(lon, lat)
    wrong = tri.interpolate(u, [0, 0, 1])
    east, north = tri.interpolate_winds(u, v, 0, 90)
    assert np.allclose([east, north], components(0.0, 90.0), atol=1e-13)
    assert abs(wrong - east) > 0.1


def test_empty_and_missing():
    tri = rondel.delaunay(SITES)
    assert tri.interpolate_vectors(np.zeros((0, 300, 3)), TARGETS).shape == (0, 102, 3)
    assert tri.interpolate_vectors(SITES, []).shape == (0, 3)
    vectors = np.cross(AXIS, SITES)
    vectors[5] = np.nan
    assert np.isnan(tri.interpolate_vectors(vectors, SITES[5])).all()
    patch = rondel.delaunay(clouds.patch(30, 0.1))
    assert np.isnan(patch.interpolate_vectors(np.ones((30, 3)), [0, 0, -1])).all()
    with pytest.raises(ValueError, match="method must be one of"):
        tri.interpolate_winds(np.ones(300), np.ones(300), 0, 0, "spline")


def test_infinite_components_are_refused():
    tri = rondel.delaunay(SITES)
    u, v = np.ones(300), np.ones(300)
    v[7] = np.inf
    with pytest.raises(rondel.InvalidInput, match="north have an infinite number at index 7"):
        tri.interpolate_winds(u, v, 0, 0)
    vectors = np.cross(AXIS, SITES)
    vectors[5, 2] = -np.inf
    with pytest.raises(rondel.InvalidInput, match="vectors have an infinite number"):
        tri.interpolate_vectors(vectors, TARGETS)
