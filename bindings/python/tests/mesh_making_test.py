# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Centroidal meshes and cells of prescribed areas."""

import numpy as np
import pytest

import rondel
import rondel.mesh


def test_uniform_mesh_has_twelve_pentagons():
    mesh = rondel.mesh.scvt(642)
    assert len(mesh.points) == 642
    assert mesh.report.end == "converged"
    assert mesh.report.mean_offset <= 1e-4
    quality = mesh.quality
    assert quality["sides"] == {"5": 12, "6": 630}
    assert 1 < quality["energy"] < 1.01
    assert quality["num_obtuse"] == 0


def test_spacing_of_a_function_is_met():
    def spacing(points):
        return 0.15 + 0.05 * points[:, 2]

    calls = []
    mesh = rondel.mesh.scvt(
        spacing=spacing, raster_steps=128, progress=lambda stage, part: calls.append((stage, part))
    )
    found = np.sqrt(mesh.cell_areas * 2 / np.sqrt(3)) / spacing(mesh.points)
    assert np.percentile(abs(found - 1), 90) < 0.05
    assert mesh.density.max() <= 1
    assert mesh.density.min() < 0.1
    parts = [part for _, part in calls]
    assert parts == sorted(parts)
    assert parts[-1] == 1


def test_one_spacing_and_the_radius():
    mesh = rondel.mesh.scvt(spacing=0.2, radius=10)
    assert abs(len(mesh.points) - 4 * np.pi / (np.sqrt(0.75) * 0.04)) < 1
    assert np.allclose(np.linalg.norm(mesh.points, axis=1), 10)


def test_bytes_do_not_depend_on_threads():
    one = rondel.mesh.scvt(5000, threads=1)
    two = rondel.mesh.scvt(5000, threads=2)
    assert one.points.tobytes() == two.points.tobytes()


def test_repair_mends_what_it_says():
    def spacing(points):
        return np.clip(0.015 + 0.1 * (0.7 - points[:, 0]), 0.015, 0.06)

    as_is = rondel.mesh.scvt(7000, spacing=spacing, raster_steps=64, repair=False)
    assert as_is.quality["min_edge_ratio"]["value"] < 0.05
    assert as_is.report.moved == 0
    mesh = rondel.mesh.scvt(7000, spacing=spacing, raster_steps=64)
    report = mesh.report
    assert report.defects_before.short_edges > 0
    assert report.defects_after == (0, 0, 0, report.defects_after.min_edge_ratio)
    assert 0 < report.moved < 1000
    quality = mesh.quality
    assert quality["min_edge_ratio"]["value"] >= 0.05
    assert quality["num_obtuse"] == 0
    assert set(quality["sides"]) <= {"5", "6", "7"}


def test_what_is_no_request_is_refused():
    with pytest.raises(TypeError, match="n or spacing"):
        rondel.mesh.scvt()
    with pytest.raises(rondel.InvalidInput, match="from 12"):
        rondel.mesh.scvt(5)
    with pytest.raises(rondel.InvalidInput, match="not between 0 and pi"):
        rondel.mesh.scvt(spacing=lambda p: -p[:, 0], raster_steps=8)
    with pytest.raises(ValueError, match="shape"):
        rondel.mesh.scvt(spacing=lambda p: p, raster_steps=8)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"n": 200.5}, "n must be a whole number, not 200.5"),
        ({"n": np.nan}, "n must be a whole number, not nan"),
        ({"tolerance": np.nan}, "tolerance must be positive and finite, not nan"),
        ({"tolerance": -1}, "tolerance must be positive and finite, not -1"),
        ({"largest_tolerance": 0}, "largest_tolerance must be positive"),
        ({"max_steps": 1.5}, "max_steps must be a whole number"),
        ({"max_steps": -1}, "max_steps must not be negative, like -1"),
    ],
)
def test_numbers_that_are_none_are_named(options, message):
    with pytest.raises(ValueError, match=message):
        rondel.mesh.scvt(**{"n": 100, **options})


def test_tolerances_that_are_not_met_are_told():
    told = r"scvt\(\) is not converged \(iterations after 1 steps\): .* \(tolerance 0.0001\), the"
    with pytest.warns(UserWarning, match=told):
        mesh = rondel.mesh.scvt(300, max_steps=1)
    assert mesh.report.end == "iterations"
    points = np.random.default_rng(1).normal(size=(100, 3))
    with pytest.warns(UserWarning, match=r"ended as 'rounded', .* \(tolerance 1e-18\)"):
        found = rondel.mesh.equal_area(points, tolerance=1e-18)
    assert found.end == "rounded"


def test_whole_numbers_of_every_kind_are_taken():
    assert len(rondel.mesh.scvt(np.int64(42), max_steps=1).points) == 42
    assert len(rondel.mesh.scvt(42.0, max_steps=1).points) == 42


@pytest.mark.parametrize("tolerance", [np.nan, -1, 0, np.inf])
def test_a_tolerance_of_areas_is_positive(tolerance):
    points = np.random.default_rng(1).normal(size=(20, 3))
    with pytest.raises(ValueError, match="tolerance must be positive and finite"):
        rondel.mesh.equal_area(points, tolerance=tolerance)


def test_lunes_are_as_wanted():
    turns = np.radians([10, 95, 170, 185, 300])
    points = np.column_stack([np.cos(turns), 0.6 * np.sin(turns), 0.8 * np.sin(turns)])
    found = rondel.mesh.equal_area(points)
    assert found.end in ("converged", "rounded")
    cells = rondel.delaunay(found.points, "weighted").voronoi()
    assert np.allclose(cells.areas, 4 * np.pi / 5, rtol=1e-11)


def test_areas_are_as_wanted():
    points = np.random.default_rng(3).normal(size=(400, 3))
    wanted = 1 + 0.5 * np.sign(points[:, 0])
    found = rondel.mesh.equal_area(points, wanted)
    assert found.end in ("converged", "rounded")
    assert np.allclose(found.areas, wanted * 4 * np.pi / wanted.sum(), rtol=1e-10)
    assert found.weights.min() == 1
    with pytest.warns(UserWarning, match="ended as 'infeasible', with areas off by up to"):
        octant = rondel.mesh.equal_area(np.abs(points))
    assert octant.end == "infeasible"
    assert "surround the center" in octant.reason
    assert found.reason == ""
    with pytest.raises(rondel.InvalidInput, match="not positive"):
        rondel.mesh.equal_area(points, points[:, 0] + 1)
    large = rondel.mesh.equal_area(points, 1e308 * wanted / 2)  # in any unit
    assert np.allclose(large.areas, found.areas, rtol=1e-10)


@pytest.mark.parametrize("bad", [np.nan, np.inf, 0.0, -1.0])
def test_the_first_bad_area_is_named(bad):
    points = np.random.default_rng(4).normal(size=(50, 3))
    areas = np.ones(50)
    areas[[7, 9]] = bad
    with pytest.raises(rondel.InvalidInput, match="the area of site 7 is not positive") as caught:
        rondel.mesh.equal_area(points, areas)
    assert caught.value.index == 7
    with pytest.raises(rondel.InvalidInput, match="site 0"):
        rondel.mesh.equal_area(points, -np.ones(50))
    with pytest.raises(ValueError, match=r"areas has shape \(50, 1\), not \(50,\)"):
        rondel.mesh.equal_area(points, np.ones((50, 1)))
