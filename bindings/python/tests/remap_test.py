# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Cell sets and conservative weights, against closed forms and the laws of conservation."""

import json
import warnings

import clouds
import numpy as np
import pytest

import rondel
import rondel.mesh

TRI = rondel.delaunay(clouds.uniform(300, 3))
CELLS = rondel.CellSet.voronoi(TRI)
LON = np.linspace(-180, 180, 25)
LAT = np.linspace(-90, 90, 13)
GRID = rondel.CellSet.lonlat_grid(LON, LAT)


def test_cell_sets_are_those_of_their_owners():
    voronoi = rondel.SphericalVoronoi(TRI.points)
    for owner in (TRI, voronoi):
        assert np.allclose(rondel.CellSet.voronoi(owner).areas, voronoi.areas, atol=1e-14)
    assert CELLS.covers_sphere
    assert CELLS.shape == (300,)
    assert rondel.CellSet.triangles(TRI).num_cells == np.count_nonzero(~TRI.ghost)
    with pytest.raises(TypeError, match="not ndarray"):
        rondel.CellSet.voronoi(TRI.points)
    assert np.allclose(np.linalg.norm(CELLS.centers, axis=1), 1)


def test_a_grid_has_the_areas_between_its_lines():
    assert GRID.shape == (12, 24)
    expected = np.outer(np.diff(np.sin(np.radians(LAT))), np.diff(np.radians(LON)))
    assert np.allclose(GRID.areas.reshape(GRID.shape), expected, rtol=1e-13)
    arcs = rondel.CellSet.lonlat_grid(LON, LAT, sides="great_circles")
    assert arcs.covers_sphere
    assert abs(arcs.areas.sum() - 4 * np.pi) < 1e-13
    assert not np.allclose(arcs.areas, GRID.areas, rtol=1e-4)
    with pytest.raises(rondel.InvalidInput, match="no sides on great circles"):
        _ = GRID.rings


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(("source", "target"), [(CELLS, GRID), (GRID, CELLS), (GRID, GRID)])
def test_integrals_and_constants_are_kept(source, target, order):
    found = rondel.remap(source, target, order=order)
    values = np.random.default_rng(1).normal(size=(3, source.num_cells))
    carried = found.weights.apply(values)
    before = values @ found.source_areas
    assert np.allclose(carried @ found.target_areas, before, atol=1e-13)
    assert np.allclose(found.weights.apply(np.ones(source.num_cells)), 1, atol=1e-13)
    assert np.allclose(found.source_fractions, 1, atol=1e-12)
    assert np.allclose(found.target_fractions, 1, atol=1e-12)
    if source is target:
        assert np.array_equal(found.weights.tocsr().toarray(), np.eye(source.num_cells))
        assert np.array_equal(carried, values)


def test_rings_come_back():
    again = rondel.CellSet.polygons(*CELLS.rings)
    assert np.allclose(again.areas, CELLS.areas, rtol=1e-14, atol=0)
    with pytest.raises(rondel.InvalidInput, match="cell 0 has a ring of 2 corners"):
        rondel.CellSet.polygons([0, 1], [0, 2], [0, 1], np.eye(3))


def test_masks():
    mask = np.arange(300) % 2 == 0
    found = rondel.remap(CELLS, GRID, source_mask=mask)
    assert set(found.weights.indices) == set(np.flatnonzero(mask))
    assert np.allclose(found.target_fractions @ GRID.areas, CELLS.areas[mask].sum())
    with pytest.raises(rondel.InvalidInput, match="mask of the source has 2 values"):
        rondel.remap(CELLS, GRID, source_mask=[True, False])


def test_masks_of_grids_have_their_shape():
    grid = rondel.lonlat_grid(36, 18)
    mask = np.ones(grid.shape, bool)
    mask[:9] = False
    found = rondel.remap(grid, grid, source_mask=mask)
    assert np.array_equal(np.unique(found.weights.indices), np.flatnonzero(mask.reshape(-1)))
    for wrong in (mask.T, mask.reshape(-1, 1), mask[None], True):
        for side in ("source_mask", "target_mask"):
            with pytest.raises(ValueError, match=rf"{side} must have the shape \(18, 36\) or"):
                rondel.remap(grid, grid, **{side: wrong})
    with pytest.raises(ValueError, match=r"must have the shape \(300,\), not \(2, 150\)"):
        rondel.remap(CELLS, GRID, source_mask=np.ones((2, 150)))


def test_files(tmp_path):
    box = [[[10, 20], [40, 20], [40, 50], [10, 50], [10, 20]]]
    geometry = {"type": "Polygon", "coordinates": box}
    (tmp_path / "box.geojson").write_text(json.dumps(geometry), "utf-8")
    polygons = rondel.CellSet.read(tmp_path / "box.geojson")
    assert polygons.num_cells == 1
    assert not polygons.covers_sphere
    height = np.sin(np.radians(50)) - np.sin(np.radians(20))
    assert abs(polygons.areas[0] - np.radians(30) * height) < 1e-6
    found = rondel.remap(polygons, GRID, norm="fracarea")
    assert np.isnan(found.weights.apply([5.0])[0])
    assert np.nanmax(found.weights.apply([5.0])) == 5
    arcs = rondel.CellSet.read(tmp_path / "box.geojson", edges="geodesic")
    assert arcs.areas[0] != polygons.areas[0]
    with pytest.raises(FileNotFoundError):
        rondel.CellSet.read(tmp_path / "none.nc")


def test_meshes_of_xarray(tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("scipy")
    middles = [(lines[1:] + lines[:-1]) / 2 for lines in (LAT, LON)]
    grid = xarray.Dataset(
        coords={
            "lat": ("lat", middles[0], {"units": "degrees_north"}),
            "lon": ("lon", middles[1], {"units": "degrees_east"}),
        }
    )
    grid.to_netcdf(tmp_path / "grid.nc", engine="scipy")
    read = rondel.CellSet.read(tmp_path / "grid.nc")
    assert read.shape == GRID.shape
    assert np.array_equal(read.areas, GRID.areas)
    assert read.mask.all()


def test_cells_are_those_of_their_owners():
    voronoi = TRI.voronoi()
    expected = rondel.remap(CELLS, GRID).weights
    for source, target in ((voronoi, GRID), (CELLS, rondel.lonlat_grid(24, 12))):
        found = rondel.remap(source, target).weights
        assert np.array_equal(found.data, expected.data)
    triangles = rondel.remap(TRI, GRID)
    assert triangles.source.num_cells == np.count_nonzero(~TRI.ghost)
    mesh = rondel.mesh.from_points(TRI.points)
    same = rondel.remap(mesh, voronoi).weights.tocsr()
    assert abs(same - np.eye(300)).max() < 1e-12
    box = {"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [90, 45], [0, 45], [0, 0]]]}
    clipped = voronoi.clip(box)
    assert rondel.remap(clipped, rondel.polygons(box)).target_fractions == pytest.approx(1)
    with pytest.raises(TypeError, match="ndarray has no cells"):
        rondel.remap(TRI.points, GRID)


def test_a_grid_by_its_size():
    grid = rondel.lonlat_grid(360, 180)
    assert grid.shape == (180, 360)
    lines = rondel.CellSet.lonlat_grid(np.arange(-180, 181), np.arange(-90, 91))
    assert np.array_equal(grid.areas, lines.areas)
    with pytest.raises(ValueError, match="nlat must be at least 1"):
        rondel.lonlat_grid(4, 0)


def test_polygons_of_files_and_mappings(tmp_path):
    geometry = {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]]}
    (tmp_path / "box.geojson").write_text(json.dumps(geometry), "utf-8")
    for edges in ("lonlat", "geodesic"):
        read = rondel.polygons(tmp_path / "box.geojson", edges=edges)
        assert np.array_equal(read.areas, rondel.polygons(geometry, edges=edges).areas)


@pytest.mark.parametrize("norm", ["destarea", "fracarea"])
def test_files_of_weights_have_what_they_are_of(tmp_path, norm):
    netcdf = pytest.importorskip("scipy.io").netcdf_file
    land = rondel.CellSet.from_geometries(
        {"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [90, 45], [0, 45], [0, 0]]]}
    )
    remap = rondel.remap(land, GRID, norm=norm)
    remap.to_netcdf(tmp_path / "esmf.nc")
    remap.to_netcdf(tmp_path / "scrip.nc", format="scrip")
    for name, weights, fractions in (
        ("esmf.nc", "S", "frac_b"),
        ("scrip.nc", "remap_matrix", "dst_grid_frac"),
    ):
        with netcdf(tmp_path / name, mmap=False) as file:
            assert file.normalization == norm.encode()
            assert np.array_equal(file.variables[weights][:].ravel(), remap.weights.data)
            assert np.array_equal(file.variables[fractions][:], remap.target_fractions)
    with netcdf(tmp_path / "esmf.nc", mmap=False) as file:
        assert np.array_equal(file.variables["area_b"][:], remap.target_areas)
        assert np.array_equal(file.variables["xc_b"][:24], (LON[1:] + LON[:-1]) / 2)
        assert np.array_equal(file.variables["yc_b"][::24], (LAT[1:] + LAT[:-1]) / 2)
        assert file.variables["dst_grid_dims"][:].tolist() == [24, 12]
    again = rondel.read_weights(tmp_path / "esmf.nc")
    assert np.array_equal(again.data, remap.weights.data)
    with pytest.raises(ValueError, match="format must be"):
        remap.to_netcdf(tmp_path / "w.nc", format="npz")


def test_parts_of_the_sphere():
    part = rondel.CellSet.polygons([0, 1], [0, 3], [0, 1, 2], np.eye(3))
    assert rondel.remap(part, part).weights.data.tolist() == [1]


def test_uxarray_applies_weights(tmp_path):
    """Also where the last target has none, from which it would guess that the first index is 0."""
    uxarray = pytest.importorskip("uxarray")
    sites = clouds.uniform(100)
    source = rondel.SphericalVoronoi(sites)
    target = rondel.SphericalVoronoi(clouds.uniform(60, seed=1))
    around = np.flatnonzero(source.points @ target.points[-1] < 0.5)
    _, rings, corners, points = rondel.CellSet.voronoi(source).rings
    kept = [corners[rings[i] : rings[i + 1]] for i in around]
    offsets = np.concatenate([[0], np.cumsum([len(ring) for ring in kept])])
    part = rondel.CellSet.polygons(np.arange(len(kept) + 1), offsets, np.concatenate(kept), points)
    weights = rondel.remap(part, rondel.CellSet.voronoi(target), norm="fracarea").weights
    values = np.random.default_rng(2).normal(size=len(kept))
    expected = weights.apply(values)
    assert np.isnan(expected[-1])
    weights.to_netcdf(tmp_path / "w.nc")
    mesh = uxarray.Grid.from_dataset(source.to_xarray().isel(n_face=around))
    field = uxarray.UxDataArray(values, dims=["n_face"], uxgrid=mesh)
    onto = uxarray.Grid.from_dataset(target.to_xarray())
    found = field.remap.apply_weights(onto, tmp_path / "w.nc").values
    there = ~np.isnan(expected)
    assert 0 < there.sum() < 60
    assert np.abs(found[there] - expected[there]).max() < 1e-14


def test_cells_that_overlap():
    lon, lat = (
        np.array([0.0, 20, 20, 0, 10, 30, 30, 10]),
        np.array([0.0, 0, 20, 20, 10, 10, 30, 30]),
    )
    twice = rondel.CellSet.polygons(
        [0, 1, 2], [0, 4, 8], np.arange(8), rondel.unit_vectors(lon, lat)
    )
    grid = rondel.lonlat_grid(36, 18)
    with pytest.raises(rondel.InvalidInput, match=r"^source cells 0 and 1 overlap at 14"):
        rondel.remap(twice, grid)
    with pytest.raises(rondel.InvalidInput, match=r"^target cells 0 and 1 overlap at 14"):
        rondel.remap(grid, twice)
    with pytest.raises(ValueError, match="one of 'error', 'first', 'share', 'each', not 'last'"):
        rondel.remap(twice, grid, overlap="last")
    union = {rule: rondel.remap(twice, grid, overlap=rule) for rule in ("first", "share")}
    covered = {rule: found.target_fractions @ grid.areas for rule, found in union.items()}
    assert covered["first"] == pytest.approx(covered["share"], abs=1e-14)
    assert covered["first"] < twice.areas.sum() - 0.02
    assert union["first"].source_areas[0] == pytest.approx(twice.areas[0], abs=1e-15)
    assert union["share"].source_areas[0] < twice.areas[0] - 0.01
    masked = rondel.remap(twice, grid, source_mask=[True, False])
    assert masked.target_fractions @ grid.areas == pytest.approx(twice.areas[0], abs=1e-14)


def planar_area(ring):
    """The area of a polygon near the equator as shapely repairs it, in steradians."""
    shapely = pytest.importorskip("shapely")
    return shapely.make_valid(shapely.Polygon(ring)).area * np.radians(1) ** 2


def test_cells_that_cross_themselves_are_repaired(tmp_path):
    xarray = pytest.importorskip("xarray")
    # In a cell of a tenth of a degree, plane and sphere differ by less than a millionth.
    shapes = 0.1 * np.array(
        [
            [(0, 0), (1, 0), (1, 1), (0, 1)],
            [(2, 0), (3, 1), (3, 0), (2, 1)],
            [(4.1, 0), (5, 0.9), (4, 0.8), (4.9, 0.1)],
        ]
    )
    expected = [planar_area(ring) for ring in shapes]
    cells = rondel.CellSet.corners(shapes[..., 0], shapes[..., 1])
    with pytest.raises(rondel.InvalidInput, match=r"cell 1 crosses or overlaps itself at 0\.25"):
        cells.areas  # noqa: B018
    with pytest.warns(UserWarning, match=r"^cell 1 was repaired \(it crosses .*\), and 1 more$"):
        sound = cells.repaired()
    assert np.allclose(sound.areas, expected, rtol=1e-5)
    assert sound.rings[3].shape == (4 + 5 + 5, 3)
    with warnings.catch_warnings(action="error"):
        assert np.array_equal(sound.repaired().areas, sound.areas)
        assert GRID.repaired().shape == GRID.shape

    path = tmp_path / "cells.nc"
    dims = ("grid_size", "grid_corners")
    degrees = {"units": "degrees"}
    corners = {
        f"grid_corner_{name}": (dims, shapes[..., k], degrees)
        for k, name in enumerate(["lon", "lat"])
    }
    xarray.Dataset(corners).to_netcdf(path)
    with pytest.warns(UserWarning, match="cell 1 was repaired"):
        read = rondel.CellSet.read(path, invalid="repair")
    assert np.array_equal(read.areas, sound.areas)
    with pytest.raises(rondel.InvalidInput, match="cell 1 crosses or overlaps itself"):
        rondel.remap(rondel.CellSet.read(path), GRID)
    given = rondel.remap(read, GRID).target_fractions @ GRID.areas
    assert np.isclose(given, sum(expected), rtol=1e-5)


def test_regridders_repair_cells():
    xarray = pytest.importorskip("xarray")
    tie_lon, tie_lat = (
        np.array([[0, 1, 1, 0], [2, 3, 3, 2]]),
        np.array([[0, 0, 1, 1], [0, 1, 0, 1]]),
    )
    dims = ("cell", "corner")
    source = xarray.Dataset(
        {"lon_b": (dims, tie_lon), "lat_b": (dims, tie_lat)},
        coords={"lon": ("cell", [0.5, 2.5]), "lat": ("cell", [0.5, 0.5])},
    )
    with pytest.raises(rondel.InvalidInput, match="cell 1 crosses or overlaps itself"):
        rondel.Regridder(source, GRID, "conservative")
    with pytest.warns(UserWarning, match="cell 1 was repaired"):
        made = rondel.Regridder(source, GRID, "conservative", invalid="repair")
    assert np.nansum(made(np.ones(2)).ravel() * GRID.areas) > 0.0003
    with pytest.raises(ValueError, match="invalid must be 'error' or 'repair', not 'mend'"):
        rondel.Regridder(source, GRID, "conservative", invalid="mend")


def test_what_is_refused():
    with pytest.raises(ValueError, match="norm must be"):
        rondel.remap(CELLS, GRID, norm="none")
    with pytest.raises(ValueError, match="order must be 1 or 2"):
        rondel.remap(CELLS, GRID, order=3)
    with pytest.raises(ValueError, match="sides must be"):
        rondel.CellSet.lonlat_grid(LON, LAT, sides="straight")
    with pytest.raises(rondel.InvalidInput, match="meridian 1"):
        rondel.CellSet.lonlat_grid([0, 0], LAT)


def test_cells_that_are_the_whole_sphere():
    box = {"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [90, 45], [0, 45], [0, 0]]]}
    world = [[-180, -90], [180, -90], [180, 90], [-180, 90], [-180, -90]]
    cells = rondel.polygons([box, {"type": "Polygon", "coordinates": [world]}, box])
    assert cells.whole.tolist() == [1]
    again = rondel.CellSet.polygons(*cells.rings, whole=cells.whole)
    assert again.areas.tolist() == cells.areas.tolist()
    assert np.isclose(again.areas[1], 4 * np.pi)
    assert again.whole.tolist() == [1]
    assert rondel.CellSet.polygons(*cells.rings).areas[1] == 0
    with pytest.raises(rondel.InvalidInput, match="whole"):
        rondel.CellSet.polygons(*cells.rings, whole=[0])


@pytest.mark.parametrize("radius", [2.0, 6371229.0])
def test_meshes_of_any_radius_have_cells(radius):
    points = clouds.uniform(200)
    grid = rondel.lonlat_grid(12, 6)
    unit = rondel.remap(rondel.mesh.from_points(points), grid)
    mesh = rondel.mesh.from_points(points, radius=radius)
    for found in (rondel.remap(mesh, grid), rondel.remap(mesh.cull([0] * 200).mesh, grid)):
        np.testing.assert_allclose(found.source_areas, unit.source_areas, rtol=1e-12)
        assert found.weights.shape == unit.weights.shape
        np.testing.assert_allclose(
            found.weights.apply(points[:, 2]), unit.weights.apply(points[:, 2]), atol=1e-12
        )
    back = rondel.remap(grid, mesh)
    np.testing.assert_allclose(back.target_fractions, 1, rtol=1e-12)
