# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values between sites, against formulas that share nothing with the library."""

import clouds
import numpy as np
import pytest
import scipy.spatial

import rondel

SITES = clouds.uniform(200)
TARGETS = clouds.uniform(60, seed=1)
TRI = rondel.delaunay(SITES)
METHODS = ["nearest", "linear", "laplace", "sibson", "hermite", "cubic"]
GRADUAL = METHODS[1:]
every_method = pytest.mark.parametrize("method", METHODS)


def f0(p):
    """Renka's function."""
    x, y, z = np.moveaxis(p, -1, 0)
    return 1 + x**8 + np.exp(2 * y**3) + np.exp(2 * z**2) + 10 * x * y * z


def slope(p):
    """The tangent gradient of f0."""
    x, y, z = np.moveaxis(p, -1, 0)
    g = np.stack(
        [
            8 * x**7 + 10 * y * z,
            6 * y**2 * np.exp(2 * y**3) + 10 * x * z,
            4 * z * np.exp(2 * z**2) + 10 * x * y,
        ],
        axis=-1,
    )
    return g - (g * p).sum(axis=-1, keepdims=True) * p


def matrix(weights):
    """The weights as rows of numpy."""
    rows = np.repeat(np.arange(weights.shape[0]), np.diff(weights.indptr))
    dense = np.zeros(weights.shape)
    np.add.at(dense, (rows, weights.indices), weights.data)
    return dense


def barycentric(sites, targets):
    """The weights of the hull's triangle that the ray from the center meets, by linear systems."""
    dense = np.zeros((len(targets), len(sites)))
    for row, u in zip(dense, targets, strict=True):
        for corners in scipy.spatial.ConvexHull(sites).simplices:
            shares = np.linalg.solve(sites[corners].T, u)
            if shares.min() >= -1e-12:
                row[corners] = shares / shares.sum()
    return dense


def laplace(sites, u):
    """By the cell of u in the hull that has it: borders in the tangent plane over distances."""
    hull = scipy.spatial.ConvexHull(np.vstack([sites, u]))
    around = hull.simplices[(hull.simplices == len(sites)).any(axis=1)]
    shares = np.zeros(len(sites))
    for i in np.unique(around[around < len(sites)]):
        ends = []
        for corners in around[(around == i).any(axis=1)]:
            a, b, c = np.vstack([sites, u])[corners]
            normal = np.cross(b - a, c - a)
            ends.append(normal / (normal @ u))
        shares[i] = np.linalg.norm(ends[0] - ends[1]) / np.linalg.norm(np.cross(u, sites[i]))
    return shares / shares.sum()


def test_nearest_is_the_nearest():
    expected = f0(SITES)[(TARGETS @ SITES.T).argmax(axis=1)]
    assert np.array_equal(TRI.interpolate(f0(SITES), TARGETS, "nearest"), expected)


def test_linear_is_barycentric():
    found = matrix(TRI.weights(TARGETS, "linear"))
    assert np.allclose(found, barycentric(SITES, TARGETS), atol=1e-12)


def test_laplace_is_borders_over_distances():
    found = matrix(TRI.weights(TARGETS[:10], "laplace"))
    expected = [laplace(SITES, u) for u in TARGETS[:10]]
    assert np.allclose(found, expected, atol=1e-12)


def test_sibson_is_the_share_of_stolen_area():
    """Counts points of the tangent plane that are closer to the target than to every site."""
    random = np.random.default_rng(5)
    for u in TARGETS[:3]:
        a = np.cross(u, SITES[0])
        a /= np.linalg.norm(a)
        plane = random.uniform(-0.35, 0.35, (100_000, 2))
        points = u + plane[:, :1] * a + plane[:, 1:] * np.cross(u, a)
        scores = points @ SITES.T
        stolen = points @ u > scores.max(axis=1)
        assert not stolen[np.abs(plane).max(axis=1) > 0.34].any()  # the cell is in the square
        counts = np.bincount(scores[stolen].argmax(axis=1), minlength=len(SITES))
        found = matrix(TRI.weights(u, "sibson"))[0]
        assert np.abs(found - counts / counts.sum()).max() < 2.5 / np.sqrt(counts.sum())


def test_gradients_are_close_to_those_of_the_function():
    tri = rondel.delaunay(clouds.uniform(3000))
    found = tri.gradient(f0(tri.points))
    assert np.abs((found * tri.points).sum(axis=1)).max() < 1e-12
    error = np.linalg.norm(found - slope(tri.points), axis=1)
    assert np.sqrt(np.mean(error**2)) < 0.05
    many = tri.gradient(np.stack([f0(tri.points), np.ones(3000)]))
    assert many.shape == (2, 3000, 3)
    assert np.array_equal(many[0], found)
    assert np.abs(many[1]).max() < 1e-11


def test_hermite_with_exact_gradients_gives_back_linear_functions():
    g = np.array([0.3, -2, 0.7])
    slopes = g - (SITES @ g)[:, None] * SITES
    found = TRI.interpolate(5 + SITES @ g, TARGETS, "hermite", gradients=slopes)
    assert np.allclose(found, 5 + TARGETS @ g, rtol=0, atol=1e-13)


@pytest.mark.parametrize("method", ["hermite", "cubic"])
def test_smooth_methods_are_more_accurate(method):
    def error(tri, **gradients):
        found = tri.interpolate(f0(tri.points), TARGETS, method, **gradients)
        return np.sqrt(np.mean((found - f0(TARGETS)) ** 2))

    tri = rondel.delaunay(clouds.uniform(3200, seed=3))
    linear = tri.interpolate(f0(tri.points), TARGETS, "linear")
    estimated = error(tri)
    assert estimated < 0.1 * np.sqrt(np.mean((linear - f0(TARGETS)) ** 2))
    assert error(tri, gradients=slope(tri.points)) < 1.2 * estimated
    ones = tri.interpolate(np.ones(3200), TARGETS, method, gradients=np.zeros((3200, 3)))
    assert np.abs(ones - 1).max() < 1e-15


@every_method
def test_sums_and_directions(method):
    weights = TRI.weights(TARGETS, method)
    assert np.abs(matrix(weights).sum(axis=1) - 1).max() < 1e-13
    if method in ("linear", "laplace", "sibson"):
        there = weights @ SITES
        assert np.abs(np.cross(there, TARGETS)).max() < 1e-14
        same = TRI.weights(TARGETS, method, normalization="homogeneous") @ SITES
        assert np.allclose(same, TARGETS, rtol=0, atol=1e-14)


@every_method
def test_at_sites_values_are_those_of_the_sites(method):
    assert np.array_equal(TRI.interpolate(f0(SITES), SITES, method), f0(SITES))
    weights = TRI.weights(4 * SITES, method)
    assert weights.indices.tolist() == list(range(200))
    assert (weights.data == 1).all()


@every_method
def test_values_are_those_of_the_weights(method):
    values = np.stack([f0(SITES), SITES[:, 0]])
    found = TRI.interpolate(values, TARGETS, method)
    assert np.allclose(found, values @ matrix(TRI.weights(TARGETS, method)).T, atol=1e-12)


@every_method
def test_threads_and_orders_give_the_same_bytes(method):
    targets = clouds.uniform(20_000, seed=2)
    found = TRI.interpolate(f0(SITES), targets, method, threads=1)
    assert np.array_equal(TRI.interpolate(f0(SITES), targets, method, threads=3), found)
    order = np.random.default_rng(0).permutation(200)
    other = rondel.delaunay(SITES[order])
    assert np.array_equal(other.interpolate(f0(SITES)[order], targets, method), found)


@every_method
def test_shapes(method):
    def shape(values, targets):
        return TRI.interpolate(np.ones(values), np.ones(targets), method).shape

    assert shape(200, 3) == ()
    assert shape((5, 200), 3) == (5,)
    assert shape((4, 5, 200), (6, 7, 3)) == (4, 5, 6, 7)
    assert shape(200, (0, 3)) == (0,)
    assert shape((0, 200), (6, 3)) == (0, 6)
    assert TRI.weights([], method).shape == (0, 200)


def test_patches_have_an_outside():
    tri = rondel.delaunay(clouds.patch(50, 0.1))
    targets = [[0, 0, 1.0], [0, 0, -1.0], [1.0, 0, 0]]
    values = tri.points[:, 0]
    for method in GRADUAL:
        found = tri.interpolate(values, targets, method)
        assert np.isnan(found).tolist() == [False, True, True]
        found = tri.interpolate(values, targets, method, outside="nearest")
        assert np.array_equal(found[1:], values[tri.nearest(targets[1:])])
        with pytest.raises(rondel.InvalidInput, match="target 1 is outside") as caught:
            tri.weights(targets, method, outside="error")
        assert caught.value.index == 1
    assert not np.isnan(tri.interpolate(values, targets, "nearest")).any()


def test_few_sites():
    none = rondel.delaunay([])
    assert np.isnan(none.interpolate([], TARGETS, "nearest")).all()
    one = rondel.delaunay(SITES[:1])
    assert one.interpolate([7.0], TARGETS[:2], "nearest").tolist() == [7, 7]
    assert np.isnan(one.interpolate([7.0], TARGETS[:2])).all()
    assert one.interpolate([7.0], SITES[0]) == 7
    ring = rondel.delaunay([[1, 0, 0], [0, 1, 0], [-1, -1, 0]])
    found = ring.interpolate([1, 2, 3], [[1, 1, 0], [1, 0, 0], [0, 0, 1]], "cubic")
    assert np.array_equal(found, [1.5, 1, np.nan], equal_nan=True)
    assert np.isnan(ring.gradient([1, 2, 3])).all()


def test_duplicates():
    tri = rondel.delaunay(np.concatenate([SITES, SITES[:3]]))
    values = np.concatenate([f0(SITES), [100, 200, 300]])

    def at(duplicates):
        return tri.interpolate(values, SITES[:4], "linear", duplicates=duplicates)

    assert np.array_equal(at("first"), values[:4])
    mean = (values[:3] + values[200:]) / 2
    assert np.allclose(at("mean"), [*mean, values[3]], rtol=1e-15)
    with pytest.raises(rondel.InvalidInput, match="site 200 is in the place of site 0") as caught:
        at("error")
    assert caught.value.index == 200


def test_missing_values_are_missing_where_they_count():
    values = f0(SITES)
    values[17] = np.nan
    weights = matrix(TRI.weights(TARGETS, "sibson"))
    found = TRI.interpolate(values, TARGETS)
    assert np.array_equal(np.isnan(found), weights[:, 17] > 0)
    masked = np.ma.masked_invalid(values)
    assert np.array_equal(TRI.interpolate(masked, TARGETS), found, equal_nan=True)
    whole = np.ma.masked_array(np.arange(200), np.arange(200) == 17)  # of integers, too
    assert np.isnan(TRI.interpolate(whole, SITES[17]))


def test_spheres_that_lie_elsewhere():
    center = np.array([3.0, -5, 2])
    tri = rondel.delaunay(7 * SITES + center, radius=7, center=center)
    found = tri.interpolate(f0(SITES), 2 * TARGETS + center, "linear")
    assert np.allclose(found, TRI.interpolate(f0(SITES), TARGETS, "linear"), atol=1e-10)


def test_weighted_sites_have_nearest_alone():
    power = rondel.power_diagram([[0, 0], [90, 0], [180, 0], [-90, 0]], [30, 5, 5, 5])
    targets = rondel.unit_vectors([29, 89], [0, 0])
    values = [1, 2, 3, 4]
    assert power.delaunay.interpolate(values, targets, "nearest").tolist() == [1, 2]
    with pytest.raises(rondel.InvalidInput, match="no method but nearest"):
        power.delaunay.interpolate(values, targets)


def test_wrong_input():
    for wrong, message in (
        (lambda: TRI.weights(TARGETS, "natural"), "method must be one of 'nearest', 'linear'"),
        (lambda: TRI.weights(TARGETS, outside="raise"), "outside must be one of 'nan'"),
        (lambda: TRI.weights(TARGETS, duplicates="last"), "duplicates must be one of"),
        (lambda: TRI.weights(TARGETS, normalization=1), "normalization must be"),
        (lambda: TRI.weights(TARGETS, rings=0), "rings must be from 1 to 100, not 0"),
        (lambda: TRI.weights([[0, 50]]), r"targets must have shape \(..., 3\).*unit_vectors"),
        (lambda: TRI.weights([[1, 0, 0], [0, 0, 0]]), "target 1: .* center"),
        (lambda: TRI.weights([[1, 0, np.inf]]), "target 0: .* not finite"),
        (lambda: TRI.interpolate(np.ones(199), TARGETS), r"values must have shape \(..., 200\)"),
        (lambda: TRI.interpolate(np.ones((200, 5)), TARGETS), "the sites are the last axis"),
        (lambda: TRI.interpolate(f0(SITES), TARGETS, gradients=SITES), "hermite and cubic"),
        (
            lambda: TRI.interpolate(f0(SITES), TARGETS, "cubic", gradients=f0(SITES)),
            r"gradients must have shape \(..., 200, 3\)",
        ),
        (lambda: TRI.gradient(np.ones(3)), r"values must have shape \(..., 200\)"),
        (lambda: TRI.interpolate_vectors(SITES[:3], TARGETS), "vectors must have shape"),
        (lambda: TRI.interpolate_winds(np.ones(200), np.ones((2, 200)), 0, 0), "differ in shape"),
    ):
        with pytest.raises(ValueError, match=message):
            wrong()
    with pytest.raises(TypeError, match="real numbers"):
        TRI.interpolate(np.ones(200) * 1j, TARGETS)


def test_long_work_is_told_and_can_be_stopped():
    class Enough(Exception):
        pass

    def stop(stage, fraction):
        raise Enough

    targets = clouds.uniform(200_000)
    for work in (TRI.weights, lambda *a, **k: TRI.interpolate(f0(SITES), *a, **k)):
        with pytest.raises(Enough):
            work(targets, progress=stop)


@pytest.mark.parametrize("method", ["hermite", "cubic"])
def test_homogeneous_weights_are_refused_where_no_factor_makes_them(method):
    with pytest.raises(rondel.InvalidInput, match=f"{method} has no homogeneous"):
        TRI.weights(TARGETS, method, normalization="homogeneous")


def test_a_slope_across_a_track_is_zero_or_missing():
    lat = np.linspace(-60, 60, 100)
    track = rondel.unit_vectors(np.full(100, 20.0), lat)
    off = rondel.unit_vectors([20 + 1e-7], [3.3])
    tri = rondel.delaunay(np.concatenate([track, off]))
    field = tri.points @ [1.0, 2.0, 3.0]
    across = np.array([-np.sin(np.radians(20)), np.cos(np.radians(20)), 0])
    gradient = tri.gradient(field)[10:90]
    along = np.array([1.0, 2, 3]) - track[10:90] * field[10:90, None]
    along -= (along @ across)[:, None] * across
    assert abs(gradient @ across).max() < 1e-4
    assert abs(gradient - along).max() < 0.05
    assert np.isnan(tri.gradient(field, undetermined="missing")[10:90]).all()
    with pytest.raises(ValueError, match="undetermined must be"):
        tri.gradient(field, undetermined="none")


def test_what_pandas_misses_is_missing():
    pandas = pytest.importorskip("pandas")
    values = np.arange(200.0)
    expected = TRI.interpolate(np.where(values % 9 == 0, np.nan, values), TARGETS)
    assert np.isnan(expected).any()
    for kind in ("Int64", "Float64", "object"):
        series = pandas.Series(values, dtype=kind)
        series[values % 9 == 0] = pandas.NA
        for given in (series, series.array, series.to_list()):
            assert np.array_equal(TRI.interpolate(given, TARGETS), expected, equal_nan=True)
        whole = pandas.Series(values, dtype=kind)
        assert np.array_equal(
            TRI.interpolate(whole.array, TARGETS), TRI.interpolate(values, TARGETS), equal_nan=True
        )
    with pytest.raises(TypeError, match="values must be real numbers"):
        TRI.interpolate(pandas.Series(["1", "x"] * 100), TARGETS)


def test_negative_areas_are_not_written(tmp_path):
    weights = TRI.weights(TARGETS)
    for name, count in (("site_areas", len(SITES)), ("target_areas", len(TARGETS))):
        with pytest.raises(ValueError, match=name):
            weights.to_netcdf(tmp_path / "w.nc", **{name: np.full(count, -1.0)})
    assert not (tmp_path / "w.nc").exists()
