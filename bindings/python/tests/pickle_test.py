# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Copies and pickles are equal, and whole."""

import copy
import pickle

import clouds
import numpy as np
import pytest

import rondel
import rondel.mesh

OBJECTS = {
    "triangulation": lambda: rondel.delaunay(clouds.uniform(50)),
    "degrees": lambda: rondel.delaunay_lonlat([0, 90, 180, 10], [0, 0, 0, 80]),
    "patch": lambda: rondel.delaunay(clouds.patch(50, 0.1)),
    "circle": lambda: rondel.delaunay(np.eye(3)[:2]),
    "weighted": lambda: rondel.delaunay(2 * clouds.uniform(50) ** 3, "weighted", radius=2),
    "voronoi": lambda: rondel.SphericalVoronoi(clouds.uniform(50)),
    "on a circle": lambda: rondel.SphericalVoronoi(np.array([[1.0, 0], [0, 1], [-1, 0]])),
    "power": lambda: rondel.power_diagram(clouds.uniform(50), 5.0),
    "hull": lambda: rondel.convex_hull(clouds.uniform(50)),
}
COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{
        f"pickle {p}": lambda thing, p=p: pickle.loads(pickle.dumps(thing, p))
        for p in range(pickle.HIGHEST_PROTOCOL + 1)
    },
}
ARRAYS = (
    *("points", "simplices", "neighbors", "duplicates", "hidden", "ghost", "ring"),
    *("edges", "vertices", "areas", "lonlat"),
)


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("build", OBJECTS.values(), ids=OBJECTS)
def test_a_copy_is_equal(build, make):
    thing = build()
    copied = make(thing)
    assert type(copied) is type(thing)
    assert repr(copied) == repr(thing)
    for name in ARRAYS:
        if hasattr(thing, name):
            assert np.array_equal(getattr(copied, name), getattr(thing, name)), name
    if hasattr(thing, "nearest"):
        assert np.array_equal(copied.nearest(clouds.cube()), thing.nearest(clouds.cube()))
    if isinstance(thing, rondel.SphericalVoronoi):
        assert copied.regions == thing.regions


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
def test_the_copy_of_a_changing_triangulation_has_the_same_ids(make):
    sites = rondel.DynamicTriangulation(
        clouds.uniform(30), "weighted", radius=2, center=(0, 0, 0.5)
    )
    sites.remove([0, 7, 8, 29])
    copied = make(sites)
    assert copied.ids.tolist() == sites.ids.tolist()
    assert repr(copied) == repr(sites)
    assert np.array_equal(copied.snapshot().delaunay.simplices, sites.snapshot().delaunay.simplices)
    sites.remove(sites.ids)
    assert len(make(sites)) == 0
    assert len(copied) == 26


def sample(name):
    box = {"type": "Polygon", "coordinates": [[[0, -30], [70, -30], [70, 60], [0, 60], [0, -30]]]}
    points = clouds.uniform(60)
    return {
        "diagram": lambda: rondel.CellSet.voronoi(rondel.SphericalVoronoi(points)),
        "duplicates": lambda: rondel.CellSet.voronoi(
            rondel.delaunay(np.concatenate([points, points[:3]]))
        ),
        "power": lambda: rondel.CellSet.voronoi(rondel.power_diagram(points, 5.0)),
        "triangles": lambda: rondel.CellSet.triangles(rondel.delaunay(points)),
        "grid": lambda: rondel.lonlat_grid(12, 6),
        "arcs": lambda: rondel.lonlat_grid(12, 6, sides="great_circles"),
        "axes": lambda: rondel.CellSet.lonlat_centers(np.arange(0.0, 360, 30), [-60, 0, 60]),
        "corners": lambda: rondel.CellSet.corners([[[0, 9, 9, 0]]], [[[0, 0, 7, 7]]]),
        "polygons": lambda: rondel.polygons(
            [{"type": "Feature", "properties": {"name": "ä", "n": 3}, "geometry": box}]
        ),
        "whole": lambda: rondel.CellSet.polygons([0, 0], [0], [], np.zeros((0, 3)), whole=[0]),
        "clipped": lambda: rondel.SphericalVoronoi(points).clip(box).cell_set(),
        "disks": lambda: rondel.polygons(disks()),
    }[name]


SAMPLES = ("diagram", "duplicates", "power", "triangles", "grid", "arcs", "axes", "corners")
SAMPLES = (*SAMPLES, "polygons", "whole", "clipped", "disks")


def disks():
    """Polygons that overlap, one of them with a hole."""
    turn = np.radians(np.arange(0, 360, 10))

    def ring(lon, radius):
        corners = np.column_stack([lon + radius * np.cos(turn), radius * np.sin(turn)])
        return [*corners.tolist(), corners[0].tolist()]

    return [
        {"type": "Polygon", "coordinates": [ring(lon, 20), ring(lon, 10)[::-1]]}
        for lon in (0, 15, 170)
    ]


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("name", SAMPLES)
def test_the_copy_of_cells_has_the_same_bits(name, make, tmp_path):
    cells = sample(name)()
    copied = make(cells)
    assert repr(copied) == repr(cells)
    assert (copied.shape, copied.covers_sphere) == (cells.shape, cells.covers_sphere)
    assert copied.areas.tobytes() == cells.areas.tobytes()
    assert copied.centers.tobytes() == cells.centers.tobytes()
    if name not in ("grid", "axes"):
        for own, its in zip(copied.rings, cells.rings, strict=True):
            assert own.tobytes() == its.tobytes()
    grid = rondel.lonlat_grid(7, 5)
    weights = [rondel.remap(side, grid, overlap="share") for side in (cells, copied)]
    assert weights[1].weights.data.tobytes() == weights[0].weights.data.tobytes()
    for k, found in enumerate((weights[0], make(weights[0]), weights[1])):
        found.to_netcdf(tmp_path / f"{k}.nc")
    first = (tmp_path / "0.nc").read_bytes()
    assert (tmp_path / "1.nc").read_bytes() == (tmp_path / "2.nc").read_bytes() == first


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
def test_copies_of_cells_of_files(make, tmp_path):
    rondel.mesh.from_points(clouds.uniform(50)).to_scrip(tmp_path / "cells.nc")
    (tmp_path / "a.geojson").write_text(
        '{"type": "Feature", "properties": {"name": "a", "n": null}, "geometry": {"type": '
        '"Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]]}}'
    )
    for name in ("cells.nc", "a.geojson"):
        cells = rondel.CellSet.read(tmp_path / name)
        copied = make(cells)
        assert copied.areas.tobytes() == cells.areas.tobytes()
        for k, side in enumerate((cells, copied)):
            rondel.remap(side, rondel.lonlat_grid(4, 2)).to_netcdf(tmp_path / f"{k}.nc")
        assert (tmp_path / "0.nc").read_bytes() == (tmp_path / "1.nc").read_bytes()


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
def test_copies_of_regions_lines_bands_and_meshes(make, tmp_path):
    points = clouds.uniform(60)
    tri = rondel.delaunay(points)
    diagram = rondel.SphericalVoronoi(points)
    boxes = [[0, -30, 70, 60], [70, -30, 90, 60]]
    boxes = [
        {"type": "Polygon", "coordinates": [[[w, s], [e, s], [e, n], [w, n], [w, s]]]}
        for w, s, e, n in boxes
    ]
    for thing in (
        diagram.clip(boxes[0]),
        diagram.clip(boxes, values=["a", "b"]),
        diagram.dissolve(["a"] * 30 + [None] * 5 + ["b"] * 25),
        rondel.feature_cells([{"type": "Point", "coordinates": [0, 0]}], 5),
        tri.isolines(points[:, 2], [-0.5, 0.3]),
        tri.bands(points[:, 2], [-0.5, 0.3]),
        tri.bands(points[:, 2], [9.0]),
    ):
        copied = make(thing)
        assert repr(copied) == repr(thing)
        assert copied.to_geojson() == thing.to_geojson()
    mesh = rondel.mesh.from_points(points, radius=3.0, density=1 + points[:, 2] ** 2)
    for k, thing in enumerate((mesh, mesh.cull(points[:, 0] > 0).mesh, rondel.mesh.scvt(100))):
        copied = make(thing)
        assert repr(copied) == repr(thing)
        assert copied.radius == thing.radius
        assert repr(copied.report) == repr(thing.report)
        assert copied.fixed.tobytes() == thing.fixed.tobytes()
        for name, side in (("a", thing), ("b", copied)):
            side.to_mpas(tmp_path / f"{name}{k}.nc")
        assert (tmp_path / f"a{k}.nc").read_bytes() == (tmp_path / f"b{k}.nc").read_bytes()


def test_a_regridder_of_cells_can_be_pickled():
    pytest.importorskip("xarray")
    field = np.random.default_rng(1).normal(size=(6, 12))
    made = rondel.Regridder(rondel.lonlat_grid(12, 6), rondel.lonlat_grid(5, 3), "conservative")
    copied = pickle.loads(pickle.dumps(made))
    assert copied(field).tobytes() == made(field).tobytes()


def test_an_error_can_be_pickled():
    error = pickle.loads(pickle.dumps(rondel.InvalidInput("site 3: wrong", 3)))
    assert (str(error), error.index) == ("site 3: wrong", 3)


@pytest.mark.parametrize("make", COPIES.values(), ids=COPIES)
def test_what_the_user_changed_is_copied_too(make):
    for sphere in ({}, {"radius": 2.0, "center": (1, 2, 3)}):
        points = sphere.get("radius", 1) * clouds.uniform(50) + sphere.get("center", (0, 0, 0))
        diagram = rondel.SphericalVoronoi(points, **sphere)
        diagram.vertices *= 2
        diagram.regions[3].reverse()
        copied = make(diagram)
        assert np.array_equal(copied.vertices, diagram.vertices)
        assert copied.regions == diagram.regions
        diagram.vertices = diagram.vertices[:5]
        assert np.array_equal(make(diagram).vertices, diagram.vertices)


def test_what_can_be_found_again_is_not_pickled():
    diagram = rondel.SphericalVoronoi(clouds.uniform(1000))
    before = len(pickle.dumps(diagram))
    assert len(diagram.regions) == 1000
    assert diagram.vertices.sum() + diagram.areas.sum() + diagram.ridge_points.sum() != 0
    assert len(pickle.dumps(diagram)) == before
