# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures with Matplotlib, on a map of Cartopy where that is installed.

The functions are methods of `SphericalDelaunay`, `SphericalVoronoi` and `PowerDiagram`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ._lonlat import LonLatTriangles, arcs, flat_triangles
from ._types import ArrayLike, FloatArray

if TYPE_CHECKING:
    from ._delaunay import SphericalDelaunay
    from ._diagram import Diagram

__all__ = ["LonLatTriangles", "lonlat_triangles", "plot_cells", "plot_triangles"]


class _Map(NamedTuple):
    """Axes, and what tells Cartopy that coordinates are degrees."""

    ax: Any
    options: dict[str, Any]


def lonlat_triangles(self: SphericalDelaunay) -> LonLatTriangles:
    """The solid faces as triangles of the plane of longitude and latitude.

    For `matplotlib.tri`, which knows nothing of the antimeridian: triangles that cross it are
    there twice, at both ends of the map, and those at a pole reach up to its latitude.

    Returns
    -------
    LonLatTriangles
        ``.triangulation()`` is for ``tripcolor`` and ``tricontourf``, with ``values[.sites]`` of
        values at sites or ``facecolors=values[.faces]`` of values on faces. Limit the axes to
        longitudes from -180 to 180.

    """
    return flat_triangles(self.lonlat, self.simplices, np.flatnonzero(~self.ghost))


def plot_triangles(
    self: SphericalDelaunay,
    ax: Any = None,
    *,
    projection: Any = None,
    sites: bool = True,
    **options: Any,
) -> Any:
    """Draws the edges as arcs of great circles, and the sites.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        By default new axes: of Cartopy where it is installed, otherwise longitude and latitude.
    projection : cartopy.crs.CRS, optional
        Of new axes; by default Robinson.
    sites : bool, optional
        Whether to draw the sites.
    **options
        For `matplotlib.collections.LineCollection`.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ImportError
        If Matplotlib is not installed.

    """
    drawn = _make_map(ax, projection)
    ends = _directions(self)[self.edges]
    _draw_lines(drawn, arcs(ends[:, 0], ends[:, 1]), options)
    if sites:
        _draw_sites(drawn, self.lonlat[self.vertices])
    return drawn.ax


def plot_cells(
    self: Diagram,
    values: ArrayLike | None = None,
    ax: Any = None,
    *,
    projection: Any = None,
    sites: bool = True,
    cmap: Any = None,
    vmin: float | None = None,
    vmax: float | None = None,
    **options: Any,
) -> Any:
    """Draws the borders of the cells as arcs of great circles, the sites, and values as colors.

    Parameters
    ----------
    values : array_like, shape (n,), optional
        A number for each site, shown as the color of its cell.
    ax : matplotlib.axes.Axes, optional
        By default new axes: of Cartopy where it is installed, otherwise longitude and latitude.
    projection : cartopy.crs.CRS, optional
        Of new axes; by default Robinson.
    sites : bool, optional
        Whether to draw the sites.
    cmap, vmin, vmax
        Colors of the values, as everywhere in Matplotlib. ``ax.collections[0]`` is what
        ``colorbar`` takes.
    **options
        For the `matplotlib.collections.LineCollection` of the borders.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ImportError
        If Matplotlib is not installed.

    """
    drawn = _make_map(ax, projection)
    if values is not None:
        _draw_cells(self, drawn, np.asarray(values), {"cmap": cmap}, (vmin, vmax))
    offsets, rings, points = self.cells
    following = np.arange(1, len(rings) + 1)
    ends = np.asarray(offsets[1:][np.diff(offsets) > 0])
    following[ends - 1] = np.asarray(offsets[:-1][np.diff(offsets) > 0])
    a, b = rings, rings[following]
    once = a < b  # every border belongs to two cells
    directions = (points - self.center) / self.radius
    _draw_lines(drawn, arcs(directions[a[once]], directions[b[once]]), options)
    if sites:
        _draw_sites(drawn, self.delaunay.lonlat[self.delaunay.vertices])
    return drawn.ax


def _directions(self: SphericalDelaunay) -> FloatArray:
    rays = self.points - self.center
    return rays / np.linalg.norm(rays, axis=1, keepdims=True)


def _make_map(ax: Any, projection: Any) -> _Map:
    """The axes to draw on."""
    import matplotlib.pyplot as plt

    try:
        import cartopy.crs
    except ImportError:
        cartopy = None
    if ax is None and cartopy is not None:
        ax = plt.figure().add_subplot(projection=projection or cartopy.crs.Robinson())
        ax.set_global()
    elif ax is None:
        if projection is not None:
            raise ImportError("a projection needs Cartopy, which is not installed")
        ax = plt.figure().add_subplot()
    if cartopy is not None and hasattr(ax, "projection"):
        return _Map(ax, {"transform": cartopy.crs.PlateCarree()})
    ax.set(xlim=(-180, 180), ylim=(-90, 90), aspect="equal")
    ax.set(xlabel="longitude [degrees]", ylabel="latitude [degrees]")
    return _Map(ax, {})


def _draw_lines(drawn: _Map, lines: list[FloatArray], options: dict[str, Any]) -> None:
    from matplotlib.collections import LineCollection

    options = {"colors": "tab:blue", "linewidths": 0.6, **options}
    drawn.ax.add_collection(LineCollection(lines, **options, **drawn.options), autolim=False)


def _draw_sites(drawn: _Map, degrees: FloatArray) -> None:
    drawn.ax.scatter(degrees[:, 0], degrees[:, 1], s=4, color="black", zorder=3, **drawn.options)


def _draw_cells(
    self: Diagram,
    drawn: _Map,
    values: Any,
    options: dict[str, Any],
    limits: tuple[float | None, float | None],
) -> None:
    from matplotlib.collections import PolyCollection

    if len(values) != len(self.points):
        raise ValueError(f"{len(values)} values for {len(self.points)} sites")
    polygons, colors = [], []
    for feature in self.to_geojson(tolerance_deg=0.1)["features"]:
        parts = feature["geometry"]["coordinates"]
        if feature["geometry"]["type"] == "Polygon":
            parts = [parts]
        polygons += [np.array(part[0])[:, :2] for part in parts]
        colors += [values[feature["properties"]["site"]]] * len(parts)
    cells = PolyCollection(
        polygons,
        array=np.array(colors),
        edgecolors="face",
        linewidths=0.2,
        **options,
        **drawn.options,
    )
    cells.set_clim(*limits)
    drawn.ax.add_collection(cells, autolim=False)
