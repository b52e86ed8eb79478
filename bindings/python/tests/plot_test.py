# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Maps: lines and triangles end where the map does."""

import clouds
import numpy as np
import pytest

import rondel

LON = np.array([0.0, 90, 180, -180, 30, -60, 170, 20, 5, -100])
LAT = np.array([0.0, 0, 0, 30, 60, 45, -50, 90, -90, 10])

SITES = {
    "random": lambda: rondel.delaunay(clouds.uniform(80)),
    "poles and antimeridian": lambda: rondel.delaunay_lonlat(LON, LAT),
    "longitudes to 360": lambda: rondel.delaunay_lonlat(LON % 360, LAT),
    "few": lambda: rondel.delaunay(clouds.cube()),
}


@pytest.mark.parametrize("make", SITES.values(), ids=SITES)
def test_triangles_cover_the_map_once(make):
    geometry = pytest.importorskip("shapely.geometry")
    tri = make()
    flat = tri.lonlat_triangles()
    window = geometry.box(-180, -90, 180, 90)
    corners = np.stack([flat.lon[flat.triangles], flat.lat[flat.triangles]], axis=-1)
    area = sum(geometry.Polygon(t).intersection(window).area for t in corners)
    assert abs(area - 360 * 180) < 1e-6
    assert np.ptp(corners[..., 0], axis=1).max() <= 180
    sides = corners[:, 1:] - corners[:, :1]
    assert (np.linalg.det(sides) > -1e-9).all()
    assert np.unique(flat.faces).tolist() == list(range(len(tri.simplices)))


@pytest.mark.parametrize("make", SITES.values(), ids=SITES)
def test_nodes_are_at_their_sites(make):
    tri = make()
    flat = tri.lonlat_triangles()
    assert np.array_equal(flat.sites[: tri.npoints], np.arange(tri.npoints))
    used = np.unique(flat.triangles)
    used = used[np.abs(flat.lat[used]) < 90]
    there = rondel.unit_vectors(flat.lon[used], flat.lat[used])
    assert np.allclose(there, rondel.unit_vectors(*tri.lonlat[flat.sites[used]].T), atol=1e-12)


def test_a_patch_has_no_ghosts_on_the_map():
    tri = rondel.delaunay(clouds.patch(30, 0.2))
    assert not tri.ghost[tri.lonlat_triangles().faces].any()


def lines_of(ax):
    from matplotlib.collections import LineCollection

    (lines,) = (c for c in ax.collections if isinstance(c, LineCollection))
    return [path.vertices for path in lines.get_paths()]


@pytest.fixture
def ax():
    plt = pytest.importorskip("matplotlib.pyplot")
    figure, ax = plt.subplots()
    yield ax
    figure.canvas.draw()
    plt.close(figure)


@pytest.mark.parametrize("make", SITES.values(), ids=SITES)
def test_lines_do_not_cross_the_map(ax, make):
    tri = make()
    assert tri.plot(ax, colors="red") is ax
    lines = lines_of(ax)
    assert len(lines) >= len(tri.edges)
    assert all(np.abs(np.diff(line[:, 0])).max() <= 180 for line in lines)
    assert all(np.abs(line[:, 0]).max() <= 180 for line in lines)


def test_cells_are_drawn_with_their_values(ax):
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    diagram.plot(LAT, ax, cmap="magma", vmin=-90, vmax=90)
    cells = ax.collections[0]
    assert set(cells.get_array()) == set(LAT)
    assert cells.get_clim() == (-90, 90)
    borders = {tuple(np.round(p, 6)) for line in lines_of(ax) for p in line[[0, -1]]}
    assert len(borders) >= len(diagram.vertices)
    with pytest.raises(ValueError, match="10 sites"):
        diagram.plot([1, 2], ax)


def test_matplotlib_takes_the_triangles(ax):
    tri = rondel.delaunay_lonlat(LON, LAT)
    flat = tri.lonlat_triangles()
    ax.tricontourf(flat.triangulation(), LAT[flat.sites])
    ax.tripcolor(flat.triangulation(), facecolors=tri.simplices[flat.faces, 0].astype(float))


def test_new_axes():
    plt = pytest.importorskip("matplotlib.pyplot")
    ax = rondel.delaunay_lonlat(LON, LAT).plot()
    ax.figure.canvas.draw()
    plt.close(ax.figure)


def test_on_a_map_of_cartopy():
    crs = pytest.importorskip("cartopy.crs")
    plt = pytest.importorskip("matplotlib.pyplot")
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    for projection in (None, crs.Orthographic(170, 40), crs.PlateCarree(180)):
        ax = diagram.plot(LAT, projection=projection)
        ax.figure.canvas.draw()
        plt.close(ax.figure)
