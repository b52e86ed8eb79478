# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The areas of cells as weights of points, against SciPy and against random places."""

import numpy as np
import pytest
from clouds import uniform

import rondel

scipy_spatial = pytest.importorskip("scipy.spatial")

RADIANS = np.pi / 180


def lattice(lat, lon):
    return np.meshgrid(lat, lon, indexing="ij")


def conic(n, spacing):
    """A square grid of a conic projection: borders are curved, convex and concave."""
    x, y = lattice(np.arange(n) * spacing - n * spacing / 2, np.arange(n) * spacing)
    return 60 - (np.hypot(x, 1 - y) - 1) / RADIANS, np.arctan2(x, 1 - y) / 0.7 / RADIANS


def of_scipy(points):
    return scipy_spatial.SphericalVoronoi(points).calculate_areas()


@pytest.mark.parametrize("edge", ["sphere", "mirror"])
def test_random_points_have_the_areas_of_scipy(edge):
    lon, lat = rondel.lonlat(uniform(2000, 3)).T
    weights = rondel.area_weights(lat, lon, edge=edge)
    expected = of_scipy(rondel.unit_vectors(lon, lat))
    np.testing.assert_allclose(weights, expected, rtol=1e-9)
    assert weights.sum() == pytest.approx(4 * np.pi, rel=1e-14)


@pytest.mark.parametrize("edge", ["sphere", "mirror"])
@pytest.mark.parametrize("lat", [np.arange(-89.5, 90, 1), np.arange(-90, 90.5, 1)])
def test_global_grids_are_covered(edge, lat):
    lat, lon = lat[:, None], np.arange(0, 360, 2)
    weights = rondel.area_weights(lat, lon, edge=edge)
    assert weights.shape == (len(lat), 180)
    assert weights.sum() == pytest.approx(4 * np.pi, rel=1e-13)
    np.testing.assert_allclose(weights, np.repeat(weights[:, :1], 180, axis=1), rtol=1e-9)


def test_a_fine_grid_inside_of_a_coarse_one_leaves_no_gap():
    coarse = np.stack(lattice(np.arange(-88, 90, 4.0), np.arange(0, 360, 4.0)), -1).reshape(-1, 2)
    fine = np.stack(lattice(np.arange(40, 60, 0.25), np.arange(10, 30, 0.25)), -1).reshape(-1, 2)
    is_outside = np.any(np.abs(coarse - [50, 20]) > 11, axis=1)
    lat, lon = np.concatenate([coarse[is_outside], fine]).T
    weights = rondel.area_weights(lat, lon, edge="mirror")
    assert weights.sum() == pytest.approx(4 * np.pi, rel=1e-13)


@pytest.mark.parametrize("step", [(0.1, 0.1), (0.5, 0.1), (0.1, 1.0)])
def test_cells_of_a_lattice_have_one_size_up_to_its_corners(step):
    lat, lon = lattice(np.arange(-10, 10) * step[0], np.arange(-20, 20) * step[1])
    weights = rondel.area_weights(lat, lon, edge="mirror")
    expected = np.prod(step) * RADIANS**2 * np.cos(lat * RADIANS)
    np.testing.assert_allclose(weights, expected, rtol=0.002 if max(step) < 1 else 0.02)


def test_curved_borders():
    lat, lon = conic(80, 0.002)
    weights = rondel.area_weights(lat, lon, edge="mirror")
    for border, inner in ((0, 1), (-1, -2)):
        np.testing.assert_allclose(weights[border], weights[inner], rtol=0.01)
        np.testing.assert_allclose(weights[:, border], weights[:, inner], rtol=0.01)
    assert rondel.area_weights(lat, lon).max() > 100 * weights.max()


@pytest.mark.parametrize("name", ["R2B5", "healpix:6", "N80", "O96", "C48"])
def test_parts_of_the_grids_of_models(name):
    lon, lat = rondel.lonlat(rondel.CellSet.named(name).centers).T
    whole = rondel.area_weights(lat, lon)
    np.testing.assert_array_equal(rondel.area_weights(lat, lon, edge="mirror"), whole)
    is_kept = (np.abs(lon - 10) < 25) & (np.abs(lat - 50) < 15)
    weights = rondel.area_weights(lat[is_kept], lon[is_kept], edge="mirror")
    assert weights.sum() == pytest.approx(whole[is_kept].sum(), rel=0.01)
    ratio = weights / whole[is_kept]
    assert ratio.min() > 0.75
    assert ratio.max() < 2.1
    assert np.mean(np.abs(ratio - 1) > 0.05) < 0.1


def test_a_hole_is_a_border():
    lat, lon = lattice(np.arange(0, 4, 0.1), np.arange(0, 4, 0.1))
    is_kept = np.hypot(lat - 2, lon - 2) > 1
    whole = rondel.area_weights(lat, lon, edge="mirror")[is_kept]
    weights = rondel.area_weights(lat[is_kept], lon[is_kept], edge="mirror")
    assert weights.sum() == pytest.approx(whole.sum(), rel=0.005)
    assert np.all((weights > 0.7 * whole) & (weights < 2 * whole))
    assert rondel.area_weights(lat[is_kept], lon[is_kept]).max() > 10 * weights.max()


def symmetric_shares(sites, is_border, places):
    """The part of random places that lies in the cell of each site; at borders, the image of a
    place under half a turn about the site must lie there too.
    """
    tree = scipy_spatial.cKDTree(sites)
    owners = tree.query(places)[1]
    own = sites[owners]
    images = 2 * np.sum(own * places, axis=1)[:, None] * own - places
    counts = ~is_border[owners] | (tree.query(images)[1] == owners)
    return np.bincount(owners[counts], minlength=len(sites)) / len(places)


def test_irregular_borders_against_random_places():
    random = np.random.default_rng(7)
    lon, lat = random.uniform(0, 40, 300), random.uniform(30, 60, 300)
    is_kept = (lon < 15) | (lat < 45)  # an L
    lon, lat = lon[is_kept], lat[is_kept]
    weights = rondel.area_weights(lat, lon, edge="mirror")
    is_cut = weights < rondel.area_weights(lat, lon) * (1 - 1e-9)
    assert 0 < is_cut.sum() < len(lon) / 2
    z = random.uniform(0, 1, 2_000_000)
    places = rondel.unit_vectors(random.uniform(-60, 100, z.size), np.degrees(np.arcsin(z)))
    domain = 160 * RADIANS
    shares = symmetric_shares(rondel.unit_vectors(lon, lat), is_cut, places) * domain
    error = 6 * np.sqrt(weights * domain / z.size) + 1e-5
    assert np.all(np.abs(shares - weights) < error)


def test_a_cell_that_is_cut_is_no_larger_and_none_is_empty():
    lon, lat = rondel.lonlat(uniform(3000, 5)).T
    is_kept = (np.abs(lat) < 30) & (np.abs(lon) < 50)
    sphere = rondel.area_weights(lat[is_kept], lon[is_kept])
    mirror = rondel.area_weights(lat[is_kept], lon[is_kept], edge="mirror")
    assert np.all(mirror <= sphere * (1 + 1e-12))
    assert np.all(mirror > 0)
    is_inside = (np.abs(lat[is_kept]) < 22) & (np.abs(lon[is_kept]) < 42)
    np.testing.assert_array_equal(mirror[is_inside], sphere[is_inside])


def test_a_domain_has_the_sum():
    lat, lon = lattice(np.arange(40, 50, 0.5), np.arange(5, 15, 0.5))
    box = [4.75, 39.75, 14.75, 49.75]
    weights = rondel.area_weights(lat, lon, edge=box)
    cells = rondel.CellSet.lonlat_grid(np.arange(4.75, 15, 0.5), np.arange(39.75, 50, 0.5))
    assert weights.sum() == pytest.approx(cells.areas.sum(), rel=1e-5)
    np.testing.assert_allclose(weights, cells.areas.reshape(20, 20), rtol=0.01)
    square = rondel.CellSet.corners([[4.75, 14.75, 14.75, 4.75]], [[39.75, 39.75, 49.75, 49.75]])
    clipped = rondel.area_weights(lat, lon, edge=square)
    assert clipped.sum() == pytest.approx(square.areas.sum(), rel=1e-12)


@pytest.mark.parametrize("edge", ["sphere", "mirror", [-10, -10, 30, 30]])
def test_points_in_one_place_share(edge):
    lat, lon = lattice(np.arange(0, 10.0), np.arange(0, 10.0))
    alone = rondel.area_weights(lat.ravel(), lon.ravel(), edge=edge)
    doubled = np.concatenate([lat.ravel(), [5, 5, 0]]), np.concatenate([lon.ravel(), [5, 365, 0]])
    weights = rondel.area_weights(*doubled, edge=edge)
    assert weights[55] == weights[100] == weights[101] == alone[55] / 3
    assert weights[0] == weights[102] == alone[0] / 2
    assert weights.sum() == pytest.approx(alone.sum(), rel=1e-13)


def test_normalized_weights_have_the_sum_1():
    lat, lon = lattice(np.arange(0, 10.0), np.arange(0, 10.0))
    weights = rondel.area_weights(lat, lon, edge="mirror")
    shares = rondel.area_weights(lat, lon, edge="mirror", normalize=True)
    assert shares.sum() == pytest.approx(1, rel=1e-14)
    np.testing.assert_allclose(shares, weights / weights.sum(), rtol=1e-14)


def test_few_points():
    assert rondel.area_weights([], [], edge="mirror").shape == (0,)
    assert rondel.area_weights(3, 4, edge="mirror") == pytest.approx(4 * np.pi)
    np.testing.assert_allclose(rondel.area_weights([0, 1], [3, 4], edge="mirror"), 2 * np.pi)
    line = rondel.area_weights(np.zeros(9), np.arange(9), edge="mirror")
    np.testing.assert_allclose(line, 2 * RADIANS, rtol=1e-12)  # from pole to pole


def test_a_point_with_many_neighbors():
    lon = np.linspace(0, 360, 20000, endpoint=False)
    lat, lon = np.append(np.full(20000, 80.0), 90), np.append(lon, 0)
    np.testing.assert_allclose(
        rondel.area_weights(lat, lon, edge="mirror")[-1], rondel.area_weights(lat, lon)[-1]
    )


def test_threads_and_order_do_not_matter():
    lat, lon = conic(60, 0.003)
    weights = rondel.area_weights(lat, lon, edge="mirror", threads=1).ravel()
    order = np.random.default_rng(1).permutation(weights.size)
    others = rondel.area_weights(lat.ravel()[order], lon.ravel()[order], edge="mirror", threads=3)
    np.testing.assert_allclose(others, weights[order], rtol=1e-10)
    again = rondel.area_weights(lat.ravel(), lon.ravel(), edge="mirror", threads=2)
    np.testing.assert_array_equal(again, weights)


@pytest.mark.parametrize(
    ("lat", "lon", "edge", "error", "said"),
    [
        ([0, np.nan], [0, 1], "sphere", rondel.InvalidInput, "site 1: latitude nan"),
        ([0, 95], [0, 1], "mirror", rondel.InvalidInput, "site 1: latitude 95"),
        ([0, 1], [np.inf, 1], "sphere", rondel.InvalidInput, "site 0: longitude"),
        ([0, 1], [0, 1, 2], "sphere", ValueError, "broadcast"),
        ([0, 1], [0, 1], "hull", ValueError, "edge must be 'sphere', 'mirror' or regions"),
        ([0, 1], [0, 1], 3.5, TypeError, "polygons must be geometries"),
    ],
)
def test_what_is_refused(lat, lon, edge, error, said):
    with pytest.raises(error, match=said):
        rondel.area_weights(lat, lon, edge=edge)


def test_a_domain_without_points_cannot_be_normalized():
    nothing = rondel.CellSet.polygons([0], [0], [], np.zeros((0, 3)))
    assert rondel.area_weights([-80, -81], [0, 90], edge=nothing).tolist() == [0, 0]
    with pytest.raises(rondel.InvalidInput, match="no point has an area"):
        rondel.area_weights([-80, -81], [0, 90], edge=nothing, normalize=True)
