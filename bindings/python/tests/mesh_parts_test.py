# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes without some of their cells, with sites that stay, along lines; pictures of them."""

import json

import numpy as np
import pytest

import rondel
import rondel.mesh

pytestmark = pytest.mark.filterwarnings("ignore:.* is not converged")
SQUARE = {
    "type": "Polygon",
    "coordinates": [[[-30, -40], [110, -40], [110, 50], [-30, 50], [-30, -40]]],
}


@pytest.fixture(scope="module")
def mesh():
    points = np.random.default_rng(11).normal(size=(800, 3))
    return rondel.mesh.from_points(points, radius=2.0)


def lonlat(points):
    x, y, z = points.T
    return np.degrees(np.arctan2(y, x)), np.degrees(np.arctan2(z, np.hypot(x, y)))


def test_a_mask_removes_what_no_kept_cell_touches(mesh):
    removed = np.random.default_rng(3).random(800) < 0.4
    culled = mesh.cull(removed)
    kept = np.flatnonzero(~removed)
    assert (culled.mesh.points == mesh.points[kept]).all()
    assert (culled.cells[kept] == np.arange(len(kept))).all()
    assert (culled.cells[removed] == -1).all()
    touched = np.flatnonzero((~removed)[mesh.cells_on_edge].any(axis=1))
    assert (np.flatnonzero(culled.edges >= 0) == touched).all()
    touched = np.flatnonzero((~removed)[mesh.cells_on_vertex].any(axis=1))
    assert (np.flatnonzero(culled.vertices >= 0) == touched).all()
    # Cells of kept vertices, -1 where they are gone.
    assert (culled.mesh.cells_on_vertex == culled.cells[mesh.cells_on_vertex[touched]]).all()
    assert (culled.mesh.cells_on_edge[:, 0] >= 0).all()
    assert culled.mesh.quality["num_border_edges"] == (culled.mesh.cells_on_edge[:, 1] == -1).sum()
    with pytest.raises(ValueError, match="shape"):
        mesh.cull(removed[1:])
    with pytest.raises(ValueError, match="other values"):
        mesh.cull(np.full(800, 2))
    with pytest.raises(TypeError, match="mask, inside or outside"):
        mesh.cull()
    with pytest.raises(rondel.InvalidInput, match="no cell"):
        mesh.cull(np.ones(800))


def test_polygons_of_every_kind_remove_the_same_cells(mesh, tmp_path):
    lon, lat = lonlat(mesh.points)
    is_inside = (lon > -30) & (lon < 110) & (lat > -40) & (lat < 50)
    path = tmp_path / "square.geojson"
    path.write_text(json.dumps(SQUARE))
    for polygons in (SQUARE, path, str(path), [SQUARE], rondel.CellSet.read(path)):
        assert (mesh.points[~is_inside] == mesh.cull(inside=polygons).mesh.points).all()
        assert (mesh.points[is_inside] == mesh.cull(outside=polygons).mesh.points).all()
    both = mesh.cull(lat > 0, outside=SQUARE).mesh
    assert (both.points == mesh.points[is_inside & ~(lat > 0)]).all()
    with pytest.raises(rondel.InvalidInput, match="between parallels"):
        mesh.cull(inside=rondel.CellSet.lonlat_grid([0, 90, 180], [-90, 0, 90]))


def test_land_of_the_earth_by_shapely(mesh):
    shapely = pytest.importorskip("shapely")
    lon = np.linspace(0, 350, 36)
    rings = [np.column_stack([lon, 40 + 25 * np.sin(3 * np.radians(lon))])]
    area = shapely.Polygon(np.concatenate([rings[0], [[360, 90], [0, 90]]]))
    found = mesh.cull(outside=area).cells >= 0
    at, height = lonlat(mesh.points)
    expected = shapely.contains_xy(area, at % 360, height)
    # Between 350 and 360 degrees both go straight to the pole's side.
    assert (found == expected).mean() > 0.99


def test_files_of_a_part_come_back(mesh, tmp_path):
    culled = mesh.cull(outside=SQUARE).mesh
    culled.to_mpas(tmp_path / "m.nc")
    again = rondel.mesh.read(tmp_path / "m.nc")
    for name in ("points", "cells_on_edge", "cells_on_vertex", "edges_on_vertex", "kite_areas"):
        assert (getattr(again, name) == getattr(culled, name)).all(), name
    for write in ("to_ugrid", "to_scrip", "to_esmf"):
        getattr(culled, write)(tmp_path / "other.nc")
        cells = rondel.CellSet.read(tmp_path / "other.nc")
        assert np.allclose(cells.areas, culled.cell_areas / 4, rtol=1e-11)
        again = rondel.mesh.read(tmp_path / "other.nc", radius=mesh.radius)
        assert (again.cells_on_cell == culled.cells_on_cell).all()
        assert again.quality["num_border_edges"] == culled.quality["num_border_edges"]
        assert np.allclose(again.cell_areas, culled.cell_areas, rtol=1e-11)


def test_other_programs_read_a_part(mesh, tmp_path):
    uxarray = pytest.importorskip("uxarray")
    culled = mesh.cull(outside=SQUARE).mesh
    culled.to_mpas(tmp_path / "m.nc", kind="cdf2")
    culled.to_ugrid(tmp_path / "u.nc", kind="cdf2")
    for name in ("m.nc", "u.nc"):
        grid = uxarray.open_grid(tmp_path / name)
        assert (grid.n_face, grid.n_node) == (len(culled.points), len(culled.vertex_points))
        assert np.allclose(grid.face_areas, culled.cell_areas / 4, rtol=1e-6)


def test_a_dataset_has_0_for_none(mesh):
    pytest.importorskip("xarray")
    culled = mesh.cull(outside=SQUARE).mesh
    dataset = culled.to_xarray()
    assert ((dataset.cellsOnEdge.values[:, 1] == 0) == (culled.cells_on_edge[:, 1] == -1)).all()
    assert dataset.cellsOnEdge.values.min() == 0


def test_fixed_lines_have_sites_on_them(tmp_path):
    parallel = {"type": "LineString", "coordinates": [[-100, 60], [100, 60]]}
    point = {"type": "Point", "coordinates": [10, -20]}
    mesh = rondel.mesh.scvt(1000, fixed=[parallel, point], largest_tolerance=0.1)
    lon, lat = lonlat(mesh.points[mesh.fixed])
    assert (round(lon[0], 12), round(lat[0], 12)) == (10, -20)
    assert np.allclose(lat[1:], 60, atol=1e-3)  # of lines
    assert np.allclose(lon[[1, -1]], [-100, 100], atol=1e-12)
    spacing = np.degrees(np.sqrt(8 * np.pi / np.sqrt(3) / 1000))
    assert np.allclose(np.diff(lon[1:]) * np.cos(np.radians(60)), spacing, rtol=0.07)
    arc = rondel.mesh.scvt(1000, fixed=parallel, edges="geodesic", largest_tolerance=0.1)
    assert lonlat(arc.points[arc.fixed])[1].max() > 65  # a great circle goes north
    name = tmp_path / "parallel.geojson"
    name.write_text(json.dumps(parallel))
    same = rondel.mesh.scvt(1000, fixed=name, edges="geodesic", largest_tolerance=0.1)
    assert (same.points == arc.points).all()


def test_fixed_points_stay():
    places = np.random.default_rng(5).normal(size=(9, 3))
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    mesh = rondel.mesh.scvt(500, fixed=places)
    assert mesh.report.end == "converged"
    assert abs(mesh.points[mesh.fixed] - places).max() < 3e-16
    with pytest.raises(rondel.InvalidInput, match="500 sites"):
        rondel.mesh.scvt(500, fixed=np.random.default_rng(5).normal(size=(501, 3)))


def test_edges_follow_a_line(tmp_path):
    angle = np.radians(np.arange(361) % 360)
    circle = np.column_stack([np.cos(angle), np.sin(angle), np.full(361, 0.5)])
    mesh = rondel.mesh.scvt(1500, along=[circle], largest_tolerance=1.0)
    assert mesh.report.left_out == 0
    north = mesh.points[:, 2] > 0.5 / np.sqrt(1.25)
    between = north[mesh.cells_on_edge[:, 0]] != north[mesh.cells_on_edge[:, 1]]
    ends = mesh.vertex_points[mesh.vertices_on_edge[between]].reshape(-1, 3)
    away = abs(np.arcsin(ends[:, 2]) - np.arctan(0.5))
    assert away.max() < 0.18 * np.sqrt(8 * np.pi / np.sqrt(3) / 1500)
    path = tmp_path / "line.geojson"
    degrees = [[float(d), 26.565] for d in range(0, 181, 5)]
    path.write_text(json.dumps({"type": "LineString", "coordinates": degrees}))
    half = rondel.mesh.scvt(
        spacing=lambda p: np.full(len(p), 0.1), raster_steps=8, along=path, max_steps=3
    )
    assert 20 < len(half.fixed) < 80


def test_lines_are_files_geometries_or_points(tmp_path):
    parallel = {"type": "LineString", "coordinates": [[-180, 50], [180, 50]]}
    path = tmp_path / "parallel.geojson"
    path.write_text(json.dumps(parallel))
    turns = np.radians(np.linspace(-180, 180, 721))
    turns[-1] = turns[0]
    lat = np.radians(50)
    points = [
        np.cos(turns) * np.cos(lat),
        np.sin(turns) * np.cos(lat),
        np.full(721, np.sin(lat)),
    ]

    def rows(along, edges="lonlat"):
        mesh = rondel.mesh.scvt(1500, along=along, edges=edges, max_steps=1)
        return mesh.points[mesh.fixed]

    by_file = rows(path)
    assert abs(np.degrees(np.arcsin(by_file[:, 2])) - 50).max() < 3
    assert np.array_equal(rows(parallel), by_file)
    assert np.array_equal(rows([parallel]), by_file)
    by_points = rows([np.column_stack(points)])
    assert len(by_points) == len(by_file)
    assert abs(by_points - by_file).max() < 1e-4
    over_the_pole = {"type": "LineString", "coordinates": [[-90, 50], [80, 50]]}
    assert rows(over_the_pole, "geodesic")[:, 2].max() > 0.98
    assert rows(over_the_pole)[:, 2].max() < 0.85
    with pytest.raises(ValueError, match="edges must be"):
        rows(path, "straight")


def test_a_coast_goes_on_across_the_antimeridian():
    def box(west, east):
        corners = [[west, -20], [east, -20], [east, 20], [west, 20], [west, -20]]
        return {"type": "Polygon", "coordinates": [corners]}

    mesh = rondel.mesh.scvt(2000, along=[box(150, 180), box(-180, -150)], max_steps=1)
    fixed = mesh.points[mesh.fixed]
    lat = np.degrees(np.arcsin(fixed[:, 2]))
    beside = (abs(np.arctan2(fixed[:, 1], -fixed[:, 0])) < 0.3) & (abs(lat) < 14)
    assert len(fixed) > 60
    assert not beside.any()


def test_a_density_is_the_spacing_to_the_power_of_minus_4():
    def spacing(points):
        return 0.1 + 0.05 * points[:, 0]

    by_spacing = rondel.mesh.scvt(400, spacing=spacing, raster_steps=64)
    by_density = rondel.mesh.scvt(400, density=lambda p: 3 * spacing(p) ** -4, raster_steps=64)
    ratio = np.sort(by_density.cell_areas) / np.sort(by_spacing.cell_areas)
    assert abs(ratio - 1).max() < 0.05
    with pytest.raises(TypeError, match="density with n"):
        rondel.mesh.scvt(density=lambda p: p[:, 0] + 2)
    with pytest.raises(ValueError, match="not positive"):
        rondel.mesh.scvt(400, density=lambda p: p[:, 0], raster_steps=8)


def test_a_picture_has_edges_and_colors(mesh):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    part = mesh.cull(outside=SQUARE).mesh
    ax = part.plot(part.points[:, 2], ax=plt.figure().add_subplot(), sites=True, coast=True)
    cells, coast, edges, sites = ax.collections
    assert len(cells.get_array()) >= len(part.points)
    assert cells.get_clim() == (part.points[:, 2].min(), part.points[:, 2].max())
    assert len(edges.get_segments()) >= len(part.edge_points)
    assert len(coast.get_segments()) > 1000
    assert len(sites.get_offsets()) == len(part.points)
    assert len(mesh.plot(ax=plt.figure().add_subplot()).collections) == 1
    with pytest.raises(ValueError, match="shape"):
        part.plot(np.ones(3), ax=ax)
    plt.close("all")
