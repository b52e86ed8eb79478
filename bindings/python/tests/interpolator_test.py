# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values between points as SciPy is asked for them, and in one call."""

import clouds
import numpy as np
import pytest
import scipy.interpolate

import rondel

POINTS = clouds.uniform(150)
LON, LAT = rondel.lonlat(POINTS).T
VALUES = POINTS[:, 0] + 2 * POINTS[:, 2] ** 2
TO_LON, TO_LAT = np.linspace(-180, 540, 12), np.array([[-90], [0], [45], [90]])
GRID = rondel.unit_vectors(TO_LON, TO_LAT)


@pytest.mark.parametrize("method", ["nearest", "linear", "sibson", "cubic"])
def test_all_ways_to_ask(method):
    expected = rondel.delaunay_lonlat(LON, LAT).interpolate(VALUES, GRID, method)
    assert expected.shape == (4, 12)
    degrees = np.stack(np.broadcast_arrays(TO_LON, TO_LAT), axis=-1)
    f = rondel.SphericalInterpolator((LON, LAT), VALUES, method)
    for found in (f(TO_LON, TO_LAT), f((TO_LON, TO_LAT)), f(degrees), f(GRID)):
        assert np.array_equal(found, expected)
    g = rondel.SphericalInterpolator(np.column_stack([LON, LAT]), VALUES, method)
    assert np.array_equal(g(TO_LON, TO_LAT), expected)
    h = rondel.SphericalInterpolator(f.triangulation, VALUES, method)
    assert np.array_equal(h(TO_LON, TO_LAT), expected)
    space = rondel.SphericalInterpolator(POINTS, VALUES, method)
    assert np.allclose(space(TO_LON, TO_LAT), expected, atol=1e-6)
    assert np.array_equal(rondel.interpolate(LON, LAT, VALUES, TO_LON, TO_LAT, method), expected)
    folded = rondel.interpolate(
        LON.reshape(10, 15), LAT.reshape(10, 15), VALUES.reshape(10, 15), TO_LON, TO_LAT, method
    )
    assert np.array_equal(folded, expected)
    assert float(f(10, 20)) == f([[10]], [20])[0, 0]


def test_time_comes_first():
    times = np.stack([VALUES, 2 * VALUES, 3 * VALUES])
    f = rondel.SphericalInterpolator((LON, LAT), times)
    assert f(TO_LON, TO_LAT).shape == (3, 4, 12)
    assert f(0, 0).shape == (3,)
    folded = rondel.interpolate(
        LON.reshape(10, 15), LAT.reshape(10, 15), times.reshape(3, 10, 15), TO_LON, TO_LAT
    )
    assert np.array_equal(folded, f(TO_LON, TO_LAT))
    masked = np.ma.masked_invalid(np.where(np.arange(150) == 3, np.nan, times))
    found = rondel.interpolate(LON, LAT, masked, LON[3], LAT[3])
    assert np.isnan(found).all()


def test_small_regions_agree_with_scipy():
    """A patch of a tenth of a degree is flat to nine digits."""
    random = np.random.default_rng(0)
    lon, lat = random.uniform(0, 0.1, (2, 80))
    values = random.normal(size=80)
    theirs = scipy.interpolate.LinearNDInterpolator((lon, lat), values)
    ours = rondel.SphericalInterpolator((lon, lat), values, "linear")
    grid = np.meshgrid(np.linspace(0, 0.1, 15), np.linspace(0, 0.1, 15))
    inside = ~np.isnan(theirs(*grid))
    assert inside.any()
    assert not inside.all()
    assert np.allclose(ours(*grid)[inside], theirs(*grid)[inside], atol=1e-4)
    assert np.isnan(ours(*grid)[~inside]).mean() > 0.9  # parallels are no great circles


def test_fill_value_is_for_what_is_outside():
    patch = clouds.patch(60, 0.1)
    values = np.arange(60.0)
    values[7] = np.nan
    f = rondel.SphericalInterpolator(patch, values, fill_value=-9)
    found = f(np.stack([patch[7], patch[8], [0, 0, -1], [1, 0, 0]]))
    assert np.isnan(found[0])
    assert found[1:].tolist() == [8, -9, -9]
    many = rondel.SphericalInterpolator(patch, np.stack([values, values]), fill_value=-9)
    assert np.array_equal(many([[0, 0, -1.0]]), [[-9], [-9]])
    assert f([0, 0, -1.0]) == -9
    near = rondel.SphericalInterpolator(patch, values, fill_value=-9, outside="nearest")
    assert near([0, 0, -1]) >= 0
    slopes = np.zeros((60, 3))
    given = rondel.SphericalInterpolator(patch, values, "cubic", fill_value=-9, gradients=slopes)
    assert given([0, 0, -1]) == -9


def test_wrong_input():
    for wrong, message in (
        (lambda: rondel.SphericalInterpolator((LON, LAT), VALUES, "spline"), "method must be one"),
        (lambda: rondel.SphericalInterpolator((LON, LAT, LAT), VALUES), r"a tuple .* \(lon, lat\)"),
        (lambda: rondel.SphericalInterpolator(LON, VALUES), r"points must have shape \(n, 2\)"),
        (lambda: rondel.SphericalInterpolator((LON, LAT), VALUES[:5]), r"\(..., 150\)"),
        (lambda: rondel.SphericalInterpolator((LON, LAT), VALUES)(0, 91), "latitude"),
        (lambda: rondel.SphericalInterpolator((LON, LAT), VALUES)(3.0), "targets must have shape"),
        (lambda: rondel.interpolate(LON, LAT[:3], VALUES, 0, 0), "differ in shape"),
    ):
        with pytest.raises(ValueError, match=message):
            wrong()
    with pytest.raises(TypeError, match="not 3 arrays"):
        rondel.SphericalInterpolator((LON, LAT), VALUES)(0, 0, 0)
    assert repr(rondel.SphericalInterpolator((LON, LAT), VALUES)).endswith("150 points, sibson>")


def test_longitudes_and_latitudes_are_seen_from_the_center():
    center = np.array([10.0, -3.0, 0.5])
    points = clouds.uniform(200, 3)
    around = rondel.delaunay(points + center, center=center)
    plain = rondel.delaunay(points)
    lon, lat = rondel.lonlat(clouds.uniform(50, 4)).T
    values = points[:, 2] + points[:, 0]
    for method in ("nearest", "linear", "sibson", "cubic"):
        found = rondel.SphericalInterpolator(around, values, method)
        wanted = rondel.SphericalInterpolator(plain, values, method)
        np.testing.assert_allclose(found(lon, lat), wanted(lon, lat), atol=1e-12)
        np.testing.assert_allclose(
            found(np.stack([lon, lat], axis=1)), wanted(lon, lat), atol=1e-12
        )
    at_sites = rondel.SphericalInterpolator(around, values, "nearest")(*around.lonlat.T)
    np.testing.assert_array_equal(at_sites, values)
    east, north = np.cos(points[:, 0]), points[:, 1]
    for found, wanted in zip(
        around.interpolate_winds(east, north, lon, lat),
        plain.interpolate_winds(east, north, lon, lat),
        strict=True,
    ):
        np.testing.assert_allclose(found, wanted, atol=1e-12)
