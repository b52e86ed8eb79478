# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures with Matplotlib, on a map of Cartopy where that is installed."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import unmasked
from ._lonlat import LonLatTriangles, arcs, flat_triangles
from ._projection import LonLatMap, ProjectedMap
from ._types import ArrayLike, Divided, FloatArray, Triangulated

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "CellPictures",
    "LonLatTriangles",
    "RegionPictures",
    "TrianglePictures",
]


class TrianglePictures:
    """Pictures of triangulations: methods of `SphericalDelaunay`."""

    def lonlat_triangles(self: Triangulated) -> LonLatTriangles:
        """The solid faces as triangles of the plane of longitude and latitude.

        For `matplotlib.tri`, which knows nothing of the antimeridian: triangles that cross it are
        there twice, at both ends of the map, and those at a pole reach up to its latitude.

        Returns
        -------
        LonLatTriangles
            ``.triangulation()`` is for ``tripcolor`` and ``tricontourf``, with ``values[.sites]``
            of values at sites or ``facecolors=values[.faces]`` of values on faces. Limit the axes
            to longitudes from -180 to 180.

        """
        return flat_triangles(self.lonlat, self.simplices, np.flatnonzero(~self.ghost))

    def plot(
        self: Triangulated,
        ax: Any = None,
        *,
        projection: Any = None,
        sites: bool = True,
        coast: bool | None = None,
        **options: Any,
    ) -> Axes:
        """Draws the edges as arcs of great circles, and the sites.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            By default new axes: of Cartopy where it is installed, otherwise longitude and latitude.
        projection : cartopy.crs.CRS, optional
            Of new axes; by default Robinson.
        sites : bool, optional
            Whether to draw the sites.
        coast : bool, optional
            Whether to draw the coasts of the Earth (Natural Earth, 1:110 million) below; by default
            where sites were given as longitudes and latitudes.
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
        rays = self.points - self.center
        ends = (rays / np.linalg.norm(rays, axis=1, keepdims=True))[self.edges]
        drawn = make_map(ax, projection)
        _draw_coast(self, drawn, coast)
        drawn.draw_lines(arcs(ends[:, 0], ends[:, 1]), line_options(options))
        if sites:
            drawn.draw_points(self.lonlat[self.vertices])
        return drawn.ax


def draw_arcs(ends: FloatArray, ax: Any, projection: Any, options: dict[str, Any]) -> Any:
    """Arcs between unit vectors, shape (k, 2, 3), on axes as `plot_triangles` makes them."""
    drawn = make_map(ax, projection)
    drawn.draw_lines(arcs(ends[:, 0], ends[:, 1]), line_options(options))
    return drawn.ax


class CellPictures:
    """Pictures of diagrams: a method of `SphericalVoronoi` and `PowerDiagram`."""

    def plot(
        self: Divided,
        values: ArrayLike | None = None,
        ax: Any = None,
        *,
        projection: Any = None,
        sites: bool = True,
        coast: bool | None = None,
        cmap: Any = None,
        vmin: float | None = None,
        vmax: float | None = None,
        **options: Any,
    ) -> Axes:
        """Draws the borders of the cells as arcs of great circles, the sites, and values as colors.

        Parameters
        ----------
        values : array_like, shape (n,), optional
            A number for each site, shown as the color of its cell.
        ax, projection, sites, coast
            As in `SphericalDelaunay.plot`.
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
        drawn = make_map(ax, projection)
        if values is not None:
            _draw_diagram(self, drawn, np.asarray(unmasked(values)), (vmin, vmax), cmap)
        _draw_coast(self.delaunay, drawn, coast)
        ends = ((self.cells[2] - self.center) / self.radius)[self.ridge_vertices]
        drawn.draw_lines(arcs(ends[:, 0], ends[:, 1]), line_options(options))
        if sites:
            drawn.draw_points(self.delaunay.lonlat[self.delaunay.vertices])
        return drawn.ax


class RegionPictures:
    """Pictures of `Regions`."""

    def plot(
        self: Any,
        values: ArrayLike | None = None,
        ax: Any = None,
        *,
        projection: Any = None,
        coast: bool = True,
        cmap: Any = None,
        vmin: float | None = None,
        vmax: float | None = None,
        **options: Any,
    ) -> Axes:
        """Draws the regions, and values as colors.

        Parameters
        ----------
        values : array_like, shape (n,), optional
            A number for each region, shown as its color.
        ax, projection, coast, cmap, vmin, vmax
            As in `SphericalVoronoi.plot`; by default the coasts are drawn.
        **options
            For the `matplotlib.collections.PathCollection` of the regions.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        """
        numbers = None if values is None else np.asarray(unmasked(values))
        if numbers is not None and len(numbers) != len(self):
            raise ValueError(f"{len(numbers)} values for {len(self)} regions")
        drawn = make_map(ax, projection)
        drawings = self._rings.polygons(0.1, 0)
        lines = np.split(drawings.positions, drawings.rings[1:-1])
        areas = [lines[a:b] for a, b in pairwise(drawings.polygons)]
        options = {"edgecolors": "white", "linewidths": 0.4, **options}
        if numbers is None:
            drawn.draw_areas(areas, None, {"facecolors": "tab:blue", **options})
        else:
            colored = drawn.draw_areas(areas, numbers[drawings.owners], {"cmap": cmap, **options})
            colored.set_clim(*limits(numbers, vmin, vmax))
        if coast:
            draw_coast_lines(drawn)
        return drawn.ax


def limits(values: Any, vmin: float | None, vmax: float | None) -> tuple[Any, Any]:
    """Those of the colors: of all values, also of what the map does not show."""
    known = values[np.isfinite(values)]
    if known.size:
        vmin = known.min() if vmin is None else vmin
        vmax = known.max() if vmax is None else vmax
    return vmin, vmax


def _draw_coast(self: Triangulated, drawn: LonLatMap, coast: bool | None) -> None:
    """The coasts, if they are wanted, or by default if sites have longitudes and latitudes."""
    if self._degrees is not None if coast is None else coast:
        draw_coast_lines(drawn)


def draw_coast_lines(drawn: LonLatMap) -> None:
    degrees, offsets = _core.coast_lines()
    points = _core.unit_vectors(degrees)
    is_last = np.zeros(len(points), bool)
    is_last[offsets[1:] - 1] = True
    first = np.flatnonzero(~is_last)
    drawn.draw_lines(arcs(points[first], points[first + 1]), {"colors": "0.45", "linewidths": 0.5})


def line_options(options: dict[str, Any]) -> dict[str, Any]:
    return {"colors": "tab:blue", "linewidths": 0.6, **options}


def make_map(ax: Any, projection: Any) -> LonLatMap:
    """What draws on the axes."""
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
        return ProjectedMap(ax)
    ax.set(xlim=(-180, 180), ylim=(-90, 90), aspect="equal")
    ax.set(xlabel="longitude [degrees]", ylabel="latitude [degrees]")
    return LonLatMap(ax)


def draw_cells(
    drawn: LonLatMap,
    polygons: Any,
    owner_at: Callable[[Any], int],
    values: Any,
    cmap: Any,
) -> Any:
    """The collection of polygons, in the colors of their owners' values."""
    lines = np.split(polygons.positions, polygons.rings[1:-1])
    options = {"edgecolors": "face", "linewidths": 0.2, "cmap": cmap}
    return drawn.draw_polygons(lines, polygons.owners, owner_at, options, values)


def _draw_diagram(
    self: Divided, drawn: LonLatMap, values: Any, limits_given: tuple[Any, Any], cmap: Any
) -> None:
    if len(values) != len(self.points):
        raise ValueError(f"{len(values)} values for {len(self.points)} sites")
    polygons = _core.cell_polygons(self.delaunay._triangulation, self._diagram, 0.1)

    def owner_at(degrees: Any) -> int:
        there = _core.unit_vectors(np.array([degrees], float)) * self.radius + self.center
        return int(self.delaunay.nearest(there[0]))

    cells = draw_cells(drawn, polygons, owner_at, values, cmap)
    cells.set_clim(*limits(values[polygons.owners], *limits_given))
