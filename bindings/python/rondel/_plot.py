# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures with Matplotlib, on a map of Cartopy where that is installed."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import as_colors
from ._lonlat import LonLatTriangles, arcs, flat_triangles
from ._map_axes import add_colors, draw_coast_lines, draw_sites, line_options, make_map, take_norm
from ._projection import LonLatMap
from ._rings import FILLED, draw_rings, draw_triangles
from ._types import ArrayLike, Divided, FloatArray, IntArray, Triangulated

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
        values: ArrayLike | None = None,
        edges: ArrayLike | None = None,
        projection: Any = None,
        sites: bool | None = None,
        coast: bool | None = None,
        cmap: Any = None,
        vmin: float | None = None,
        vmax: float | None = None,
        label: str | None = None,
        colorbar: bool = True,
        **options: Any,
    ) -> Axes:
        """Draws the edges as arcs of great circles, the sites, and values as colors of triangles.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            By default new axes: of Cartopy where it is installed, otherwise longitude and latitude.
            They show the globe or, if all sites are within 60 degrees of their middle, the sites.
        values : array_like, shape (n,), optional
            A number for each site; a triangle has the color of the mean of its corners, or none if
            one of them is missing. Edges are then drawn only if `edges` are given.
        edges : array_like of int, shape (k, 2), optional
            The edges to draw, for example those of ``graph("mst")``; by default all.
        projection : cartopy.crs.CRS, optional
            That of new axes, which then show the globe; by default Robinson, or Lambert's azimuthal
            one, which keeps areas, for sites within 60 degrees.
        sites : bool, optional
            Whether to draw the sites; by default if there are no values.
        coast : bool, optional
            Whether to draw the coasts of the Earth (Natural Earth, 1:110 million) below; by default
            where sites were given as longitudes and latitudes.
        cmap, vmin, vmax
            The colors of the values and their limits, as everywhere in Matplotlib; by default all
            values are within the limits.
        label : str, optional
            What the values are, with their unit, beside the color bar.
        colorbar : bool, optional
            Whether values have a color bar, by default True.
        **options
            `norm`, a `matplotlib.colors.Normalize` or its name such as 'log', for the colors in
            place of `vmin` and `vmax`; others are options of the
            `matplotlib.collections.LineCollection` of the edges.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. ``ax.collections[0]`` has the colors of the values.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import rondel
        >>> tri = rondel.delaunay_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> ax = tri.plot(values=[15, 20, 18, 22, -20, -40], label="mean temperature (°C)")

        """
        solid = self.simplices[~self.ghost]
        shown = None if values is None else _means(values, solid, len(self.points))
        norm = take_norm(options, shown, vmin, vmax)
        drawn = make_map(ax, projection, _rays(self))
        if shown is not None:
            colored = draw_triangles(drawn, solid, _rays(self), shown, cmap)
            add_colors(drawn, colored, shown, norm, label, colorbar)
        _draw_coast(self, drawn, coast)
        if values is None or edges is not None:
            ends = self.edges if edges is None else _as_edges(edges, len(self.points))
            chosen = line_options(drawn, len(self.vertices), options)
            drawn.draw_lines(_arcs_between(self, ends), chosen)
        if sites if sites is not None else values is None:
            draw_sites(drawn, self.lonlat[self.vertices])
        return drawn.ax


def _means(values: ArrayLike, triangles: IntArray, num_sites: int) -> FloatArray:
    """The mean of the values at the corners of each triangle."""
    at_sites = as_colors(values, "values", num_sites)
    means: FloatArray = at_sites[triangles].mean(axis=1)
    return means


def _rays(self: Triangulated) -> FloatArray:
    """The directions of the sites, unit vectors; (0, 0, 0) for one at the center."""
    rays = self.points - self.center
    lengths = np.linalg.norm(rays, axis=1, keepdims=True)
    return rays / np.where(lengths > 0, lengths, 1)


def _arcs_between(self: Triangulated, ends: IntArray) -> list[FloatArray]:
    rays = _rays(self)[ends]
    return arcs(rays[:, 0], rays[:, 1])


def _as_edges(edges: ArrayLike, num_sites: int) -> IntArray:
    given = np.asarray(edges)
    if given.ndim != 2 or given.shape[1] != 2 or given.dtype.kind not in "iu":
        raise ValueError(f"edges must be integers of shape (k, 2), not {given.dtype} {given.shape}")
    if given.size and not (given.min() >= 0 and given.max() < num_sites):
        raise ValueError(f"edges name sites that are not from 0 to {num_sites - 1}")
    return given.astype(np.int32)


class CellPictures:
    """Pictures of diagrams: a method of `SphericalVoronoi` and `PowerDiagram`."""

    def plot(
        self: Divided,
        values: ArrayLike | None = None,
        ax: Any = None,
        *,
        projection: Any = None,
        sites: bool | None = None,
        coast: bool | None = None,
        cmap: Any = None,
        vmin: float | None = None,
        vmax: float | None = None,
        label: str | None = None,
        colorbar: bool = True,
        **options: Any,
    ) -> Axes:
        """Draws the borders of the cells as arcs of great circles, the sites, and values as colors.

        Parameters
        ----------
        values : array_like, shape (n,), optional
            A number for each site, shown as the color of its cell; missing ones have none.
        ax, projection, sites, coast, cmap, vmin, vmax, label, colorbar
            As in `SphericalDelaunay.plot`. New axes always show the globe, as cells do.
        **options
            `norm`, as in `SphericalDelaunay.plot`, and options of the
            `matplotlib.collections.LineCollection` of the borders.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. ``ax.collections[0]`` has the colors of the values.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import rondel
        >>> lon, lat = [0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90]
        >>> cells = rondel.SphericalVoronoi.from_lonlat(lon, lat)
        >>> ax = cells.plot(cells.areas, label="area (steradians)", cmap="magma")

        """
        numbers = None
        if values is not None:
            numbers = as_colors(values, "values", len(self.points))
        # Hidden sites and duplicates have no cell that shows a color.
        seen = None if numbers is None else numbers[self.delaunay.vertices]
        norm = take_norm(options, seen, vmin, vmax)
        drawn = make_map(ax, projection)
        if numbers is not None:
            cells = _draw_diagram(self, drawn, numbers, cmap)
            add_colors(drawn, cells, seen, norm, label, colorbar)
        _draw_coast(self.delaunay, drawn, coast)
        ends = ((self.cells[2] - self.center) / self.radius)[self.ridge_vertices]
        is_filled = values is not None
        chosen = line_options(drawn, len(self.points), options, over_colors=is_filled)
        drawn.draw_lines(arcs(ends[:, 0], ends[:, 1]), chosen)
        if sites if sites is not None else values is None:
            draw_sites(drawn, self.delaunay.lonlat[self.delaunay.vertices])
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
        label: str | None = None,
        colorbar: bool = True,
        **options: Any,
    ) -> Axes:
        """Draws the regions, and values as colors.

        Parameters
        ----------
        values : array_like, shape (n,), optional
            A number for each region, shown as its color.
        ax, projection, coast, cmap, vmin, vmax, label, colorbar
            As in `SphericalDelaunay.plot`; by default the coasts are drawn.
        **options
            `norm`, as in `SphericalDelaunay.plot`, and options of the
            `matplotlib.collections.PathCollection` of the regions.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. ``ax.collections[0]`` has the colors of the values.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        """
        numbers = None if values is None else as_colors(values, "values", len(self))
        norm = take_norm(options, numbers, vmin, vmax)
        # Corners say where regions are unless they are all but the whole globe.
        is_small = self.areas.sum() < 2 * np.pi
        drawn = make_map(ax, projection, self._rings.points if is_small else None)
        look = {"edgecolors": "white", "linewidths": 0.4}
        if numbers is None:
            draw_rings(drawn, self._rings, None, {"facecolors": "tab:blue", **look, **options})
        else:
            colored = draw_rings(drawn, self._rings, numbers, {"cmap": cmap, **look, **options})
            add_colors(drawn, colored, numbers, norm, label, colorbar)
        if coast:
            draw_coast_lines(drawn)
        return drawn.ax


def _draw_coast(self: Triangulated, drawn: LonLatMap, coast: bool | None) -> None:
    """The coasts, if they are wanted, or by default if sites have longitudes and latitudes."""
    if self._degrees is not None if coast is None else coast:
        draw_coast_lines(drawn)


def draw_cells(
    drawn: LonLatMap,
    polygons: Any,
    owner_at: Callable[[Any], int],
    values: Any,
    cmap: Any,
) -> Any:
    """The collection of polygons, in the colors of their owners' values."""
    lines = np.split(polygons.positions, polygons.rings[1:-1])
    look = {**FILLED, "cmap": cmap}
    return drawn.draw_polygons(lines, polygons.owners, owner_at, look, values)


def _draw_diagram(self: Divided, drawn: LonLatMap, values: Any, cmap: Any) -> Any:
    polygons = _core.cell_polygons(self.delaunay._triangulation, self._diagram, 0.1)

    def owner_at(degrees: Any) -> int:
        there = _core.unit_vectors(np.array([degrees], float)) * self.radius + self.center
        return int(self.delaunay.nearest(there[0]))

    return draw_cells(drawn, polygons, owner_at, values, cmap)
