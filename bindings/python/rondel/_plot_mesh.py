# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of meshes: of Voronoi cells, and of triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from . import _core
from ._arrays import as_colors, degrees_of
from ._lonlat import arcs
from ._map_axes import (
    add_colors,
    draw_coast_lines,
    draw_sites,
    line_options,
    make_map,
    take_norm,
)
from ._plot import draw_cells
from ._projection import LonLatMap
from ._rings import draw_triangles
from ._types import ArrayLike, FloatArray, IntArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Each word for `values` has a label, which says what it measures.
QUALITIES = {
    "centroid_offset": "distance of the center of mass from the site (spacings)",
    "edge_ratio": "dv/dc, the worst of each cell's edges",
    "side_ratio": "shortest side / longest side",
    "distance_ratio": "farthest neighbor / nearest neighbor",
    "gradient": "difference of neighbors' spacings / mean, the worst of each cell",
}
# Segments of the border: color and words.
BORDERS = {
    "open": ("tab:blue", "open water"),
    "land": ("black", "land"),
    "island": ("tab:orange", "island"),
}


class Drawn(Protocol):
    """The parts of a `rondel.mesh.Mesh` from which a picture is drawn."""

    _arrays: _core.VoronoiMesh

    @property
    def radius(self) -> float: ...
    @property
    def points(self) -> FloatArray: ...
    @property
    def cell_areas(self) -> FloatArray: ...
    @property
    def cell_quality(self) -> Any: ...
    @property
    def vertex_points(self) -> FloatArray: ...
    @property
    def vertices_on_edge(self) -> IntArray: ...


def plot_mesh(
    self: Drawn,
    values: ArrayLike | str | None = None,
    ax: Any = None,
    *,
    projection: Any = None,
    sites: bool = False,
    coast: bool = False,
    cmap: Any = None,
    vmin: float | None = None,
    vmax: float | None = None,
    label: str | None = None,
    colorbar: bool = True,
    **options: Any,
) -> Axes:
    """Draws the edges as arcs of great circles, and values or the quality as colors of cells.

    Parameters
    ----------
    values : array_like, shape (n,), or str, optional
        A number for each cell, shown as its color; by default cells are not filled. A word is a
        measure of the mesh: 'spacing', that of regular hexagons with the areas of the cells, or
        a name of `CellQuality`, such as 'edge_ratio'.
    ax, projection, sites, coast, cmap, vmin, vmax, label, colorbar
        As in `SphericalVoronoi.plot`; by default neither sites nor coasts are drawn, and new axes
        show the mesh if all of it is within 60 degrees. A word for `values` has a label.
    **options
        `norm`, as in `SphericalDelaunay.plot`, and options of the
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
    >>> import rondel.mesh
    >>> mesh = rondel.mesh.scvt(200, max_steps=20, radius=6371229.0)
    >>> ax = mesh.plot("spacing", coast=True)
    >>> ax.figure.axes[1].get_xlabel()
    'spacing of cells (km)'

    """
    if isinstance(values, str):
        values, words = _measured(self, values)
        label = label or words
    colors = None if values is None else as_colors(values, "values", len(self.points))
    norm = take_norm(options, colors, vmin, vmax)
    drawn = make_map(ax, projection, self.vertex_points / self.radius)
    if colors is not None:

        def owner_at(degrees: Any) -> int:
            return int(np.argmax(self.points @ _core.unit_vectors(np.array([degrees], float))[0]))

        polygons = _core.mesh_polygons(self._arrays, 0.1)
        cells = draw_cells(drawn, polygons, owner_at, colors, cmap)
        add_colors(drawn, cells, colors, norm, label, colorbar)
    if coast:
        draw_coast_lines(drawn)
    ends = (self.vertex_points / self.radius)[self.vertices_on_edge]
    is_filled = colors is not None
    chosen = line_options(drawn, len(self.points), options, over_colors=is_filled)
    drawn.draw_lines(arcs(ends[:, 0], ends[:, 1]), chosen)
    if sites:
        draw_sites(drawn, degrees_of(self.points))
    return drawn.ax


def _measured(self: Drawn, word: str) -> tuple[FloatArray, str]:
    """A measure of each cell, and what it is."""
    if word == "spacing":
        spacings = np.sqrt(2 / np.sqrt(3) * self.cell_areas)  # of hexagons of these areas
        if self.radius > 1000:  # meters
            return spacings / 1000, "spacing of cells (km)"
        return np.degrees(spacings / self.radius), "spacing of cells (degrees)"
    if word not in QUALITIES:
        known = ", ".join(map(repr, ("spacing", *QUALITIES)))
        raise ValueError(f"values is {word!r}; a word for it is one of {known}")
    return getattr(self.cell_quality, word), QUALITIES[word]


def plot_triangle_mesh(
    self: Any,
    values: ArrayLike | str | None = None,
    ax: Any = None,
    *,
    triangle_values: ArrayLike | str | None = None,
    projection: Any = None,
    border: bool = True,
    coast: bool = False,
    cmap: Any = None,
    vmin: float | None = None,
    vmax: float | None = None,
    label: str | None = None,
    colorbar: bool = True,
    **options: Any,
) -> Axes:
    """Draws the triangles, their border, and values or the quality as colors.

    Parameters
    ----------
    values : array_like, shape (n,), or 'depth', optional
        A number for each node; a triangle has the color of the mean of its corners. 'depth' are
        the `depths`, in meters.
    ax : matplotlib.axes.Axes, optional
        By default new axes, as of `SphericalDelaunay.plot`, which show the mesh if all of it is
        within 60 degrees, otherwise the globe.
    triangle_values : array_like, shape (m,), or 'angle', optional
        In place of `values` a number for each triangle. 'angle' is its smallest angle in degrees,
        on which the time step of models depends.
    projection : cartopy.crs.CRS, optional
        That of new axes, as in `SphericalDelaunay.plot`.
    border : bool, optional
        Whether to draw the segments of the border, with a legend that tells open water, land and
        islands; by default True.
    coast, cmap, vmin, vmax, label, colorbar
        As in `SphericalDelaunay.plot`; by default no coasts are drawn. A word for values has a
        label.
    **options
        `norm`, as in `SphericalDelaunay.plot`, and options of the
        `matplotlib.collections.LineCollection` of the edges.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    ImportError
        If Matplotlib is not installed.

    Examples
    --------
    >>> import rondel.mesh
    >>> lonlat = [[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]]
    >>> triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    >>> mesh = rondel.mesh.TriangleMesh(lonlat, triangles, coast=[[0, 1], [1, 2]])
    >>> ax = mesh.plot(triangle_values="angle")
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['open water', 'land']

    """
    points = self.points / np.linalg.norm(self.points, axis=1, keepdims=True)
    shown, words = _triangle_colors(self, values, triangle_values)
    norm = take_norm(options, shown, vmin, vmax)
    drawn = make_map(ax, projection, points)
    if shown is not None:
        colored = draw_triangles(drawn, self.triangles, points, shown, cmap)
        add_colors(drawn, colored, shown, norm, label or words, colorbar)
    if coast:
        draw_coast_lines(drawn)
    sides = np.sort(self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends = points[np.unique(sides, axis=0)]
    chosen = line_options(drawn, len(points), options, over_colors=shown is not None)
    drawn.draw_lines(arcs(ends[:, 0], ends[:, 1]), chosen)
    if border:
        _draw_border(self, drawn, points)
    return drawn.ax


def smallest_angles(points: FloatArray, triangles: IntArray) -> FloatArray:
    """The smallest angle of each triangle between its chords, in degrees."""
    corners = points[triangles]
    sides = np.roll(corners, -1, axis=1) - corners
    lengths = np.linalg.norm(sides, axis=2)
    before = np.roll(sides, 1, axis=1)
    turns = -(sides * before).sum(axis=2) / (lengths * np.roll(lengths, 1, axis=1))
    return np.degrees(np.arccos(np.clip(turns, -1, 1)).min(axis=1))


def _triangle_colors(self: Any, values: Any, of_triangles: Any) -> tuple[Any, str | None]:
    """The number of each triangle, or None, and what it is if a word said so."""
    if values is not None and of_triangles is not None:
        raise TypeError("values and triangle_values cannot both be given")
    if isinstance(of_triangles, str):
        if of_triangles != "angle":
            raise ValueError(f"triangle_values is {of_triangles!r}; the word for it is 'angle'")
        return smallest_angles(self.points, self.triangles), "smallest angle (degrees)"
    words = None
    if isinstance(values, str):
        if values != "depth":
            raise ValueError(f"values is {values!r}; the word for it is 'depth'")
        values, words = self.depths, "depth (m)"
        if values is None:
            raise ValueError("the mesh has no depths")
    given, name = (values, "values") if of_triangles is None else (of_triangles, "triangle_values")
    if given is None:
        return None, None
    wanted = len(self.points) if of_triangles is None else len(self.triangles)
    numbers = as_colors(given, name, wanted)
    return (numbers[self.triangles].mean(axis=1) if of_triangles is None else numbers), words


def _draw_border(self: Any, drawn: LonLatMap, points: FloatArray) -> None:
    """The segments of the border in a color for each kind, and a legend."""
    from matplotlib.lines import Line2D

    handles = []
    for kind, (color, words) in BORDERS.items():
        ends = [
            np.stack([nodes, np.roll(nodes, -1)] if kind == "island" else [nodes[:-1], nodes[1:]])
            for found, nodes, _ in self.boundary
            if found == kind
        ]
        if ends:
            a, b = np.concatenate(ends, axis=1)
            drawn.draw_lines(arcs(points[a], points[b]), {"colors": color, "linewidths": 1.2})
            handles.append(Line2D([], [], color=color, label=words))
    if handles:
        drawn.ax.legend(handles=handles, loc="best", fontsize="small")
