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

    *_, lines = (c for c in ax.collections if isinstance(c, LineCollection))
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


def num_line_collections(ax):
    from matplotlib.collections import LineCollection

    return sum(isinstance(c, LineCollection) for c in ax.collections)


@pytest.mark.parametrize("coast", [None, True, False])
def test_coasts_are_below_longitudes_and_latitudes(ax, coast):
    of_degrees = [rondel.delaunay_lonlat(LON, LAT), rondel.SphericalVoronoi.from_lonlat(LON, LAT)]
    of_points = [rondel.delaunay(clouds.cube()), rondel.SphericalVoronoi(clouds.cube())]
    for what, is_default in [(thing, True) for thing in of_degrees] + [
        (thing, False) for thing in of_points
    ]:
        ax.clear()
        what.plot(ax=ax, coast=coast)
        assert num_line_collections(ax) == 1 + (is_default if coast is None else coast)


def test_coasts_are_where_they_are(ax):
    rondel.delaunay_lonlat(LON, LAT).plot(ax)
    coast = np.concatenate([path.vertices for path in ax.collections[0].get_paths()])
    assert np.abs(coast[:, 0]).max() <= 180
    assert np.hypot(coast[:, 0] + 32.6, coast[:, 1] - 83.6).min() < 3  # Greenland's north
    assert np.hypot(coast[:, 0] + 140, coast[:, 1] + 30).min() > 15  # the Pacific


def test_cells_are_drawn_with_their_values(ax):
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    diagram.plot(LAT, ax, cmap="magma", vmin=-90, vmax=90)
    cells = ax.collections[0]
    assert set(cells.get_array()) == set(LAT)
    assert cells.get_clim() == (-90, 90)
    borders = {tuple(np.round(p, 6)) for line in lines_of(ax) for p in line[[0, -1]]}
    assert len(borders) >= len(diagram.vertices)
    with pytest.raises(ValueError, match=r"values must have shape \(10,\)"):
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


PROJECTIONS = {
    "Robinson": {},
    "Robinson elsewhere": {"central_longitude": 150},
    "Mollweide": {},
    "Orthographic": {"central_longitude": 170, "central_latitude": 40},
    "PlateCarree": {"central_longitude": 180},
    "NorthPolarStereo": {},
    "InterruptedGoodeHomolosine": {},
    "NearsidePerspective": {"satellite_height": 1e5},
}


@pytest.mark.parametrize("count", [1, 2, 3, 20, 200])
@pytest.mark.parametrize("name", PROJECTIONS)
def test_on_maps_of_cartopy_every_place_has_the_color_of_its_site(name, count):
    """Where the picture is not another color, that of a border, of a dot or between two."""
    crs = pytest.importorskip("cartopy.crs")
    plt = pytest.importorskip("matplotlib.pyplot")
    from matplotlib import colormaps

    projection = getattr(crs, name.split()[0])(**PROJECTIONS[name])
    diagram = rondel.SphericalVoronoi(clouds.uniform(count))
    values = np.arange(count)
    ax = diagram.plot(values, projection=projection, colors="red", sites=False, colorbar=False)
    ax.figure.canvas.draw()
    picture = np.asarray(ax.figure.canvas.buffer_rgba())[::-1, :, :3] / 255.0
    lonlat = rondel.lonlat(clouds.uniform(4000, seed=1))
    if name == "NearsidePerspective":
        lonlat = lonlat / [30, 15]
    there = projection.transform_points(crs.PlateCarree(), *lonlat.T)[:, :2]
    shown = np.isfinite(there).all(axis=1)
    pixels = ax.transData.transform(there[shown])
    inside = ax.patch.get_path().contains_points(ax.transData.inverted().transform(pixels))
    columns, rows = pixels[inside].astype(int).T
    nearest = diagram.delaunay.nearest(rondel.unit_vectors(*lonlat[shown][inside].T))
    expected = colormaps["viridis"](values / max(1, count - 1))[nearest, :3]
    found = picture[rows, columns]
    is_border = found[:, 0] > np.maximum(found[:, 1], found[:, 2]) + 0.2
    same = np.abs(found - expected).max(axis=1) < 0.1
    plt.close(ax.figure)
    if count > 1 or name in ("Robinson", "Robinson elsewhere", "Mollweide"):
        assert len(same) > 100
        assert (same | is_border).mean() > 0.9


@pytest.mark.parametrize("name", [None, *PROJECTIONS])
def test_on_maps_every_place_has_the_color_of_its_region(name):
    """Regions with holes, as shapely sees them; where the picture shows no border."""
    plt = pytest.importorskip("matplotlib.pyplot")
    shapely = pytest.importorskip("shapely")
    from matplotlib import colormaps

    outer = [[-170, -60], [170, -60], [170, 80], [-170, 80], [-170, -60]]
    hole = [[-60, -30], [-60, 40], [90, 40], [90, -30], [-60, -30]]
    area = {"type": "Polygon", "coordinates": [outer, hole]}
    sites = clouds.uniform(30, 8)
    regions = rondel.SphericalVoronoi(sites).clip(area)
    with pytest.raises(ValueError, match=r"values must have shape \(30,\), not \(2,\)"):
        regions.plot([1, 2])
    projection, axes = None, plt.figure().add_subplot()
    if name is not None:
        crs = pytest.importorskip("cartopy.crs")
        projection, axes = getattr(crs, name.split()[0])(**PROJECTIONS[name]), None
    values = np.arange(30)
    ax = regions.plot(values, axes, projection=projection, coast=False, edgecolors="red")
    ax.figure.canvas.draw()
    picture = np.asarray(ax.figure.canvas.buffer_rgba())[::-1, :, :3] / 255.0
    points = clouds.uniform(4000, seed=1)
    lonlat = rondel.lonlat(points)
    there = lonlat
    if projection is not None:
        there = projection.transform_points(crs.PlateCarree(), *lonlat.T)[:, :2]
    shown = np.isfinite(there).all(axis=1)
    pixels = ax.transData.transform(there[shown])
    inside = ax.patch.get_path().contains_points(
        (ax.transData if projection is not None else ax.transAxes).inverted().transform(pixels)
    )
    columns, rows = pixels[inside].astype(int).T
    known = np.array([shapely.Polygon(outer, [hole]).contains(shapely.Point(p)) for p in lonlat])
    nearest = rondel.delaunay(sites).nearest(points)
    color = np.where(known[:, None], colormaps["viridis"](values / 29)[nearest, :3], 1.0)
    found, expected = picture[rows, columns], color[shown][inside]
    is_border = found[:, 0] > np.maximum(found[:, 1], found[:, 2]) + 0.2
    same = np.abs(found - expected).max(axis=1) < 0.1
    plt.close(ax.figure)
    if len(same):
        assert (same | is_border).mean() > 0.9


def test_maps_of_cartopy_are_drawn_at_once():
    """Cartopy draws only those lines and polygons itself that end with the map."""
    crs = pytest.importorskip("cartopy.crs")
    plt = pytest.importorskip("matplotlib.pyplot")
    diagram = rondel.SphericalVoronoi(clouds.uniform(2000))

    class Counting(crs.Robinson):
        asked = 0

        def project_geometry(self, *arguments):
            self.asked += 1
            return super().project_geometry(*arguments)

    projection = Counting()
    ax = diagram.plot(np.arange(2000), projection=projection)
    ax.figure.canvas.draw()
    plt.close(ax.figure)
    assert projection.asked < 200


def test_on_a_map_of_cartopy():
    crs = pytest.importorskip("cartopy.crs")
    plt = pytest.importorskip("matplotlib.pyplot")
    diagram = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
    for projection in (None, crs.Orthographic(170, 40), crs.PlateCarree(180)):
        ax = diagram.plot(LAT, projection=projection)
        ax.figure.canvas.draw()
        plt.close(ax.figure)
