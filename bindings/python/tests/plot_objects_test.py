# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of each object: what is drawn, in which colors, with which words."""

import functools
import sys
import warnings

import clouds
import numpy as np
import pytest

import rondel
import rondel.mesh

matplotlib = pytest.importorskip("matplotlib")
plt = pytest.importorskip("matplotlib.pyplot")

LON = np.array([0.0, 90, 180, -90, 0, 0, 45])
LAT = np.array([0.0, 0, 0, 0, 90, -90, 30])
HEIGHTS = np.array([1.0, 2, 3, 4, 10, -10, 5])


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")


@pytest.fixture(params=["plain", "cartopy"])
def axes(request):
    """Makes axes of each kind."""
    if request.param == "plain":
        return lambda: plt.figure().add_subplot()
    crs = pytest.importorskip("cartopy.crs")
    return lambda: plt.figure().add_subplot(projection=crs.Mollweide())


def bar_of(ax):
    """The axes of the color bar, or None."""
    (bar,) = [each for each in ax.figure.axes if each is not ax] or [None]
    return bar


def kinds_of(ax):
    return [type(each).__name__ for each in ax.collections]


def grid_cells():
    return rondel.CellSet.lonlat_grid(np.arange(0.0, 361, 60), np.arange(-90.0, 91, 45))


@functools.cache
def mesh():
    return rondel.mesh.scvt(30, max_steps=5)


def box_mesh():
    lonlat = [[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]]
    triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    coast, depths = [[0, 1], [1, 2]], [5.0, 6, 7, 8, 9]
    return rondel.mesh.TriangleMesh(lonlat, triangles, coast=coast, depths=depths)


TRI = rondel.delaunay_lonlat(LON, LAT)
CELLS = rondel.SphericalVoronoi.from_lonlat(LON, LAT)
# Each object here draws one number for each of its parts; the numbers stand beside it.
COLORED = {
    "triangles": (
        lambda **more: TRI.plot(values=HEIGHTS, **more),
        HEIGHTS[TRI.simplices].mean(axis=1),
    ),
    "cells": (lambda **more: CELLS.plot(HEIGHTS, **more), HEIGHTS),
    "regions": (lambda **more: CELLS.dissolve("aabbccd").plot([1, 2, 3, 9], **more), [1, 2, 3, 9]),
    "grid": (lambda **more: grid_cells().plot(np.arange(24), **more), np.arange(24)),
    "pixels": (
        lambda **more: rondel.CellSet.named("healpix:0").plot(np.arange(12), **more),
        np.arange(12),
    ),
}


@pytest.mark.parametrize("name", COLORED)
def test_values_are_the_colors_and_the_bar_says_what_they_are(axes, name):
    draw, values = COLORED[name]
    ax = axes()
    assert draw(ax=ax, label="height (m)", coast=False) is ax
    ax.figure.canvas.draw()
    colored = ax.collections[0]
    drawn = np.ma.compressed(colored.get_array())
    assert set(np.round(drawn, 9)) == set(np.round(np.asarray(values, float), 9))
    assert colored.get_clim() == (np.min(values), np.max(values))
    bar = bar_of(ax)
    assert bar.get_xlabel() == "height (m)"
    assert bar.get_xlim() == pytest.approx((np.min(values), np.max(values)))


@pytest.mark.parametrize("name", COLORED)
def test_limits_and_colors_are_those_that_are_asked_for(name):
    draw, values = COLORED[name]
    middle = float(np.median(values))
    ax = draw(ax=plt.figure().add_subplot(), vmin=middle, vmax=100, cmap="magma", coast=False)
    ax.figure.canvas.draw()
    assert ax.collections[0].get_clim() == (middle, 100)
    assert ax.collections[0].get_cmap().name == "magma"
    assert bar_of(ax)._colorbar.extend == "min"  # some values are below the limits
    ax = draw(ax=plt.figure().add_subplot(), colorbar=False, coast=False)
    assert bar_of(ax) is None


NORMED = {
    "triangles": lambda **more: TRI.plot(values=10**HEIGHTS, **more),
    "cells": lambda **more: CELLS.plot(10**HEIGHTS, **more),
    "regions": lambda **more: CELLS.dissolve("aabbccd").plot([1, 10, 100, 1000], **more),
    "grid": lambda **more: grid_cells().plot(10.0 ** np.arange(24), **more),
    "pixels": lambda **more: rondel.CellSet.named("healpix:0").plot(10.0 ** np.arange(12), **more),
    "mesh": lambda **more: mesh().plot(10.0 ** np.arange(30), **more),
    "triangle mesh": lambda **more: box_mesh().plot([1, 10, 100, 1e3, 1e4], **more),
}


@pytest.mark.parametrize("norm", [lambda: "log", lambda: matplotlib.colors.LogNorm()])
@pytest.mark.parametrize("name", NORMED)
def test_a_norm_is_that_of_the_colors(axes, name, norm):
    ax = NORMED[name](ax=axes(), norm=norm(), cmap="viridis", coast=False)
    ax.figure.canvas.draw()
    colored = ax.collections[0]
    values = np.ma.compressed(colored.get_array())
    # The colors of equal ratios are equally far apart.
    logs = np.log(values)
    parts = (logs - logs.min()) / np.ptp(logs)
    expected = matplotlib.colormaps["viridis"](parts)
    assert np.allclose(colored.to_rgba(values), expected, atol=0.01)
    assert bar_of(ax).get_xscale() == "log"
    assert bar_of(ax).get_xlim() == pytest.approx((values.min(), values.max()))


@pytest.mark.parametrize("name", NORMED)
def test_what_would_change_the_colors_otherwise_is_refused(name):
    draw = NORMED[name]
    for options, words in (
        ({"norm": matplotlib.colors.LogNorm(), "vmin": 1}, "norm has limits"),
        ({"clim": (1, 2)}, "no option 'clim': vmin and vmax"),
        ({"array": [1]}, "no option 'array': values"),
    ):
        with pytest.raises(TypeError, match=words):
            draw(ax=plt.figure().add_subplot(), **options)


def test_classes_have_their_colors():
    norm = matplotlib.colors.BoundaryNorm([0, 4, 8], 256)
    ax = CELLS.plot(HEIGHTS, plt.figure().add_subplot(), norm=norm, coast=False)
    assert ax.collections[0].norm is norm
    assert bar_of(ax)._colorbar.extend == "neither"
    with pytest.raises(TypeError, match="norm is that of the colors of values, and there are none"):
        CELLS.plot(norm=norm)
    bands = TRI.bands(HEIGHTS, [0, 4, 8]).plot(plt.figure().add_subplot(), norm=norm, coast=False)
    assert bands.collections[0].norm is norm
    assert bar_of(bands)._colorbar.norm is norm


def test_projections_are_those_of_cartopy():
    pytest.importorskip("cartopy")
    with pytest.raises(TypeError, match=r"one of Cartopy, such as .*, not 'mollweide'"):
        CELLS.plot(projection="mollweide")
    assert not plt.get_fignums()
    with pytest.raises(TypeError, match="Matplotlib's projection 'mollweide'"):
        CELLS.plot(ax=plt.figure().add_subplot(projection="mollweide"))


@pytest.mark.parametrize("name", COLORED)
def test_coasts_can_be_drawn_on_all(name):
    draw, _ = COLORED[name]
    with_coast = draw(ax=plt.figure().add_subplot(), coast=True, colorbar=False)
    without = draw(ax=plt.figure().add_subplot(), coast=False, colorbar=False)
    lines = [c for c in with_coast.collections if len(c.get_paths()) > 4000]
    assert len(lines) == 1
    assert len(with_coast.collections) == len(without.collections) + 1


@pytest.mark.parametrize("name", COLORED)
def test_the_number_of_values_is_checked(name):
    wrong = {
        "triangles": lambda: TRI.plot(values=HEIGHTS[1:]),
        "cells": lambda: CELLS.plot(HEIGHTS[1:]),
        "regions": lambda: CELLS.dissolve("aabbccd").plot([1]),
        "grid": lambda: grid_cells().plot(np.arange(25)),
        "pixels": lambda: rondel.CellSet.named("healpix:0").plot([1, 2]),
    }
    with pytest.raises(ValueError, match=r"values"):
        wrong[name]()


def test_the_shape_of_values_is_checked():
    values, grid = np.arange(24.0), grid_cells()
    assert grid.shape == (4, 6)
    for right in (values, values.reshape(4, 6)):
        grid.plot(right)
    regions = CELLS.dissolve("aabbccd")
    for wrong in (
        lambda: grid.plot(values.reshape(4, 6).T),
        lambda: grid.plot(values.reshape(1, 24)),
        lambda: grid.plot(3.0),
        lambda: rondel.CellSet.named("healpix:0").plot(np.ones((12, 1))),
        lambda: TRI.plot(values=HEIGHTS[:, None]),
        lambda: CELLS.plot(HEIGHTS[:, None]),
        lambda: CELLS.plot(3.0),
        lambda: regions.plot(np.ones((len(regions), 1))),
        lambda: mesh().plot(np.ones((30, 1))),
        lambda: box_mesh().plot(np.ones((5, 1))),
        lambda: TRI.save_html("never.html", HEIGHTS[:, None]),
    ):
        with pytest.raises(ValueError, match=r"values must have shape \(\d+,\)"):
            wrong()
    with pytest.raises(ValueError, match=r"levels must have shape \(n,\), not \(1, 2\)"):
        TRI.isolines(HEIGHTS, [[1.0, 2.0]])


def test_a_triangle_has_the_mean_of_its_corners_where_it_is():
    """The polygon of each triangle contains its middle, seen from the center of the sphere."""
    tri = rondel.delaunay(clouds.uniform(40))
    values = np.arange(40.0)
    ax = tri.plot(plt.figure().add_subplot(), values=values, sites=False)
    polygons = ax.collections[0]
    numbers = polygons.get_array()
    middles = tri.points[tri.simplices].sum(axis=1)
    lonlat = rondel.lonlat(middles / np.linalg.norm(middles, axis=1, keepdims=True))
    for place, corners in zip(lonlat, tri.simplices, strict=True):
        (found,) = {
            numbers[k] for k, path in enumerate(polygons.get_paths()) if path.contains_point(place)
        }
        assert found == pytest.approx(values[corners].mean())
    assert kinds_of(ax) == ["PathCollection"]  # edges and sites only without values


def test_triangles_without_a_value_have_no_color():
    values = HEIGHTS.copy()
    values[4] = np.nan
    ax = TRI.plot(plt.figure().add_subplot(), values=values, coast=False)
    is_known = np.isfinite(values[TRI.simplices]).all(axis=1)
    assert np.count_nonzero(np.isnan(ax.collections[0].get_array().filled(np.nan))) >= 1
    assert ax.collections[0].get_clim()[1] == values[TRI.simplices][is_known].mean(axis=1).max()


def test_edges_are_those_of_a_graph():
    tri = rondel.delaunay(clouds.uniform(50))
    tree = tri.graph("mst").edges
    ax = tri.plot(plt.figure().add_subplot(), edges=tree, sites=False)
    (lines,) = ax.collections
    ends = np.concatenate([path.vertices[[0, -1]] for path in lines.get_paths()])
    there = rondel.unit_vectors(*ends[np.abs(ends[:, 0]) < 180 - 1e-9].T)
    sites = tri.nearest(there)
    assert set(sites) == set(range(50))
    assert len(lines.get_paths()) >= len(tree) == 49
    for wrong in ([[0, 50]], [[0.5, 1]], [0, 1]):
        with pytest.raises(ValueError, match="edges"):
            tri.plot(edges=wrong)


def test_isolines_have_the_colors_of_their_levels(axes):
    tri = rondel.delaunay(clouds.uniform(300))
    lines = tri.isolines(tri.points[:, 2], [-0.5, 0, 0.5])
    ax = lines.plot(axes(), label="height (m)", cmap="magma")
    (drawn,) = ax.collections
    assert set(drawn.get_array()) == {-0.5, 0, 0.5}
    assert drawn.get_clim() == (-0.5, 0.5)
    assert drawn.get_cmap().name == "magma"
    assert bar_of(ax).get_xlabel() == "height (m)"
    assert bar_of(ax).get_xticks().tolist() == [-0.5, 0, 0.5]
    if not hasattr(ax, "projection"):
        for path, level in zip(drawn.get_paths(), drawn.get_array(), strict=True):
            latitude = np.degrees(np.arcsin(level))
            assert np.abs(path.vertices[:, 1] - latitude).max() < 10
    black = lines.plot(axes(), colors="black", coast=True)
    assert bar_of(black) is None
    assert len(black.collections) == 2


def test_bands_have_a_color_each(axes):
    tri = rondel.delaunay(clouds.uniform(300))
    levels = [-0.5, 0, 0.5]
    ax = tri.bands(tri.points[:, 2], levels).plot(axes(), label="height (m)", coast=False)
    ax.figure.canvas.draw()
    (drawn,) = ax.collections
    colors = drawn.to_rgba(drawn.get_array())
    assert len({tuple(color) for color in colors}) == 4
    assert bar_of(ax).get_xlabel() == "height (m)"
    assert bar_of(ax)._colorbar.extend == "both"
    if hasattr(ax, "projection"):
        return
    for lat, band in [(-60, 0), (-15, 1), (15, 2), (60, 3)]:
        (found,) = {
            value
            for path, value in zip(drawn.get_paths(), drawn.get_array(), strict=True)
            if path.contains_point((20, lat))
        }
        assert np.searchsorted(levels, found) == band


def test_a_band_may_be_the_whole_sphere():
    tri = rondel.delaunay(clouds.uniform(30))
    bands = tri.bands(np.ones(30), [0.0])
    ax = bands.plot(plt.figure().add_subplot(), coast=False)
    (path,) = ax.collections[0].get_paths()
    assert all(path.contains_point(place) for place in [(0, 0), (170, 80), (-170, -80)])


def test_a_grid_is_there_from_180_degrees_west_to_east():
    ax = grid_cells().plot(np.arange(24), plt.figure().add_subplot(), coast=False)
    ax.figure.canvas.draw()
    picture = np.asarray(ax.figure.canvas.buffer_rgba())[::-1, :, :3] / 255.0
    mesh = ax.collections[-1]
    for lon, lat, cell in [
        (30, -80, 0),
        (-30, -80, 5),
        (-170, -80, 3),
        (170, 10, 14),
        (-170, 80, 21),
    ]:
        column, row = ax.transData.transform((lon, lat)).astype(int)
        expected = mesh.cmap(mesh.norm(cell))[:3]
        assert np.abs(picture[row, column] - expected).max() < 0.02, (lon, lat)
    assert ax.get_xlim() == (-180, 180)


def test_without_values_cells_have_borders(axes):
    for cells in (grid_cells(), rondel.CellSet.named("healpix:1")):
        ax = cells.plot(ax=axes(), coast=False)
        assert bar_of(ax) is None
        (drawn,) = ax.collections
        assert len(drawn.get_paths()) >= 10
        ax.figure.canvas.draw()
    assert drawn.get_facecolor().size == 0 or drawn.get_facecolor()[0, 3] == 0


def test_meshes_show_their_quality():
    mesh = rondel.mesh.scvt(120, max_steps=3, radius=6371229.0)
    for word, extremum, find in [
        ("edge_ratio", "min_edge_ratio", np.min),
        ("side_ratio", "min_side_ratio", np.min),
        ("distance_ratio", "max_distance_ratio", np.max),
        ("gradient", "max_gradient", np.max),
        ("centroid_offset", "max_centroid_offset", np.max),
    ]:
        ax = mesh.plot(word, plt.figure().add_subplot())
        cells = getattr(mesh.cell_quality, word)
        assert find(cells) == mesh.quality[extremum]["value"]
        assert set(ax.collections[0].get_array()) == set(cells)
        assert len(bar_of(ax).get_xlabel()) > 10
    ax = mesh.plot("spacing", plt.figure().add_subplot(), label="km")
    spacings = ax.collections[0].get_array()
    assert spacings.min() == pytest.approx(mesh.quality["min_spacing"] * 6371.229)
    assert bar_of(ax).get_xlabel() == "km"
    unit = rondel.mesh.scvt(120, max_steps=3).plot("spacing", plt.figure().add_subplot())
    assert "degrees" in bar_of(unit).get_xlabel()
    assert unit.collections[0].get_array().max() == pytest.approx(
        np.degrees(mesh.quality["max_spacing"])
    )
    with pytest.raises(ValueError, match="'ratio'; a word for it is one of 'spacing'"):
        mesh.plot("ratio")


def test_triangle_meshes_show_depths_angles_and_the_border(axes):
    mesh = box_mesh()
    ax = mesh.plot("depth", axes())
    assert bar_of(ax).get_xlabel() == "depth (m)"
    means = mesh.depths[mesh.triangles].mean(axis=1)
    assert ax.collections[0].get_array().tolist() == pytest.approx(means.tolist())
    ax = mesh.plot(ax=axes(), triangle_values="angle")
    assert "degrees" in bar_of(ax).get_xlabel()
    angles = ax.collections[0].get_array()
    assert angles.min() == pytest.approx(mesh.quality.smallest_angle)
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert words == ["open water", "land"]
    coast, land = ax.collections[-2], ax.collections[-1]
    assert len(coast.get_paths()) == 2
    assert len(land.get_paths()) == 2
    assert mesh.plot(ax=axes(), border=False).get_legend() is None
    with pytest.raises(TypeError, match="both"):
        mesh.plot("depth", triangle_values="angle")
    for wrong in ({"values": np.ones(4)}, {"triangle_values": np.ones(5)}, {"values": "height"}):
        with pytest.raises(ValueError, match="values"):
            mesh.plot(ax=axes(), **wrong)
    with pytest.raises(ValueError, match="no depths"):
        rondel.mesh.TriangleMesh(mesh.points, mesh.triangles).plot("depth", axes())


def test_an_island_is_closed():
    ring = np.linspace(0, 2 * np.pi, 9)[:-1]
    inner, outer = (
        np.stack([np.cos(ring), np.sin(ring)], axis=1),
        3 * np.stack([np.cos(ring), np.sin(ring)], axis=1),
    )
    k = np.arange(8)
    after = (k + 1) % 8
    triangles = np.concatenate(
        [np.stack([k, 8 + k, 8 + after], axis=1), np.stack([k, 8 + after, after], axis=1)]
    )
    mesh = rondel.mesh.TriangleMesh(np.concatenate([inner, outer]), triangles)
    ax = mesh.plot(ax=plt.figure().add_subplot())
    found = dict(
        zip([t.get_text() for t in ax.get_legend().get_texts()], ax.collections[1:], strict=True)
    )
    assert len(found["island"].get_paths()) == 8


def test_maps_show_the_region_of_what_is_drawn():
    lon, lat = np.meshgrid(np.linspace(2, 12, 8), np.linspace(40, 55, 8))
    tri = rondel.delaunay_lonlat(lon.ravel(), lat.ravel())
    ax = tri.plot(plt.figure().add_subplot())
    limits = [*ax.get_xlim(), *ax.get_ylim()]
    assert limits == pytest.approx([1, 13, 39, 56], abs=0.9)
    assert limits[0] < 2 < 12 < limits[1]
    assert limits[2] < 40 < 55 < limits[3]
    assert TRI.plot(plt.figure().add_subplot()).get_xlim() == (-180, 180)
    over_the_antimeridian = rondel.delaunay_lonlat([178.0, -178, 180], [0.0, 0, 3])
    assert over_the_antimeridian.plot(plt.figure().add_subplot()).get_xlim() == (-180, 180)


def test_new_maps_of_cartopy_show_the_region_of_what_is_drawn():
    crs = pytest.importorskip("cartopy.crs")
    mesh = box_mesh()
    ax = mesh.plot("depth")
    assert isinstance(ax.projection, crs.LambertAzimuthalEqualArea)
    assert np.ptp(ax.get_xlim()) < 600e3  # meters: 4 degrees
    assert np.ptp(ax.get_ylim()) < 450e3
    assert isinstance(mesh.plot(projection=crs.PlateCarree()).projection, crs.PlateCarree)
    assert isinstance(TRI.plot().projection, crs.Robinson)
    assert isinstance(CELLS.plot().projection, crs.Robinson)


def test_dots_and_lines_are_finer_where_there_are_many():
    few = rondel.delaunay(clouds.uniform(50)).plot(plt.figure().add_subplot())
    many = rondel.delaunay(clouds.uniform(8000)).plot(plt.figure().add_subplot())
    for finer, coarser in zip(many.collections, few.collections, strict=True):
        assert finer.get_linewidths()[0] <= coarser.get_linewidths()[0]
    assert many.collections[-1].get_sizes()[0] < few.collections[-1].get_sizes()[0] / 2
    assert many.collections[0].get_linewidths()[0] < few.collections[0].get_linewidths()[0]


def test_what_is_missing_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    for draw in (TRI.plot, CELLS.plot, grid_cells().plot, box_mesh().plot):
        with pytest.raises(ImportError, match=r"pip install 'rondel\[plot\]'"):
            draw()


def test_a_projection_without_cartopy_is_refused(monkeypatch):
    monkeypatch.setitem(sys.modules, "cartopy", None)
    monkeypatch.setitem(sys.modules, "cartopy.crs", None)
    with pytest.raises(ImportError, match="pip install cartopy"):
        CELLS.plot(projection=object())
    ax = CELLS.plot(HEIGHTS)
    assert not hasattr(ax, "projection")
    assert ax.get_xlabel() == "longitude [degrees]"


def dataset():
    xarray = pytest.importorskip("xarray")
    import rondel.xarray  # noqa: F401 (the accessor)

    lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
    values = np.cos(np.radians(lat))[:, None] * np.ones(36)
    attrs = {"long_name": "air temperature", "units": "K"}
    field = xarray.DataArray(values, {"lat": lat, "lon": lon}, ("lat", "lon"), attrs=attrs)
    return xarray.Dataset({"t": field, "steps": field.expand_dims(time=3)})


def test_a_field_of_xarray_is_drawn_on_its_cells(axes):
    data = dataset()
    ax = data.rondel.plot("t", axes(), coast=False)
    ax.figure.canvas.draw()
    assert bar_of(ax).get_xlabel() == "air temperature (K)"
    found = np.ma.compressed(ax.collections[0].get_array())
    assert set(np.round(found, 12)) == set(np.round(np.unique(data.t), 12))
    alone = data.t.rondel.plot(ax=axes(), label="K", vmin=0)
    assert bar_of(alone).get_xlabel() == "K"
    assert alone.collections[0].get_clim()[0] == 0
    one = data.steps.isel(time=[1]).rondel.plot(ax=axes())
    assert one.collections[0].get_clim() == ax.collections[0].get_clim()
    with pytest.raises(ValueError, match=r"choose one, as by \.isel\(time=0\)"):
        data.rondel.plot("steps")
    with pytest.raises(TypeError, match="'t', 'steps'"):
        data.rondel.plot()
    with pytest.raises(TypeError, match="takes no name"):
        data.t.rondel.plot("t")


def test_a_regridded_field_is_drawn_on_the_cells_of_its_grid(axes):
    pixels = rondel.regrid(dataset().t, "healpix:2")
    ax = pixels.rondel.plot(ax=axes(), coast=False)
    found = ax.collections[0]
    assert set(found.get_array()) == set(pixels.values)
    assert bar_of(ax).get_xlabel() == "air temperature (K)"


def test_cells_that_are_not_there_are_told(axes):
    pixels = rondel.regrid(dataset()[["t"]], "healpix:2").reset_coords("crs")
    pixels.t.attrs["grid_mapping"] = "crs"
    lon, lat = np.meshgrid(np.arange(0.0, 40, 10), np.arange(0.0, 30, 10))
    corners = np.stack([lon - 5, lon + 5, lon + 5, lon - 5], -1)
    dims = ("y", "x")
    bounded = pixels.drop_vars(pixels.variables).assign(
        {
            "t": (dims, lon, {"coordinates": "lon lat"}),
            "lon": (dims, lon, {"units": "degrees_east", "bounds": "lon_corners"}),
            "lat": (dims, lat, {"units": "degrees_north", "bounds": "lat_corners"}),
            "lon_corners": ((*dims, "nv"), corners),
            "lat_corners": ((*dims, "nv"), np.stack([lat - 5, lat - 5, lat + 5, lat + 5], -1)),
        }
    )
    bounded = bounded.set_coords(["lon", "lat"])
    for data, lost in ((pixels, "crs"), (bounded, "lat_corners, lon_corners")):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            data.rondel.plot("t", axes(), coast=False)
        with pytest.warns(UserWarning, match=f"there is no {lost}, which its attributes name"):
            data.t.rondel.plot(ax=axes(), coast=False)


def test_stations_of_xarray_have_their_cells():
    xarray = pytest.importorskip("xarray")
    import rondel.xarray  # noqa: F401 (the accessor)

    places = {"lon": ("station", LON), "lat": ("station", LAT)}
    data = xarray.DataArray(HEIGHTS, places, "station", name="height")
    ax = data.rondel.plot(ax=plt.figure().add_subplot())
    assert set(ax.collections[0].get_array()) == set(HEIGHTS)
    assert bar_of(ax).get_xlabel() == "height"
    places = {"lon": ("station", np.append(LON + 7.0, np.nan)), "lat": ("station", [*LAT, 5.0])}
    with_gap = xarray.DataArray(np.append(HEIGHTS, 1e6), places, "station", name="height")
    with pytest.warns(UserWarning, match="1 of 8 places have no longitude or latitude"):
        found = with_gap.rondel.plot(ax=plt.figure().add_subplot())
    np.testing.assert_array_equal(found.collections[0].get_array(), ax.collections[0].get_array())


@pytest.mark.parametrize("name", ["Robinson", "Orthographic", "NorthPolarStereo"])
def test_on_maps_every_place_has_the_color_of_its_triangle(name):
    """Stations have slivers that cross themselves where a map is drawn, and one at a pole."""
    crs = pytest.importorskip("cartopy.crs")
    import rondel.data

    stations = rondel.data.stations()
    tri = rondel.delaunay_lonlat(stations.lon, stations.lat)
    values = np.sin(np.radians(stations.lat))
    projection = getattr(crs, name)()
    ax = tri.plot(values=values, projection=projection, coast=False, colorbar=False)
    ax.figure.set_dpi(300)
    ax.figure.canvas.draw()
    picture = np.asarray(ax.figure.canvas.buffer_rgba())[::-1, :, :3] / 255.0
    points = clouds.uniform(3000, seed=3)
    there = projection.transform_points(crs.PlateCarree(), *rondel.lonlat(points).T)[:, :2]
    shown = np.isfinite(there).all(axis=1)
    inside = ax.patch.get_path().contains_points(
        ax.transData.inverted().transform(ax.transData.transform(there[shown]))
    )
    columns, rows = ax.transData.transform(there[shown][inside]).astype(int).T
    colored = ax.collections[0]
    means = values[tri.simplices[tri.find_simplex(points[shown][inside])]].mean(axis=1)
    away = np.abs(picture[rows, columns] - colored.cmap(colored.norm(means))[:, :3]).max(axis=1)
    assert inside.sum() > 1000
    assert (away < 0.1).mean() > 0.93  # others are at borders of triangles
