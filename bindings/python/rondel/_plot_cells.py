# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of sets of cells."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from . import _core
from ._arrays import as_colors
from ._map_axes import add_colors, draw_coast_lines, line_options, make_map, take_norm
from ._projection import LonLatMap
from ._rings import FILLED, draw_rings
from ._types import ArrayLike, FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STEP = 2.0  # degrees between the positions of a line of a grid


class Drawn(Protocol):
    """The parts of a `rondel.CellSet` from which a picture is drawn."""

    _cells: _core.CellSet

    @property
    def num_cells(self) -> int: ...
    @property
    def shape(self) -> tuple[int, ...]: ...


def plot_cells(
    self: Drawn,
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
    """Draws the cells, and values as colors.

    Parameters
    ----------
    values : array_like, shape (n,) or `shape`, optional
        A number for each cell, shown as its color; missing ones have none. By default the borders
        of the cells are drawn.
    ax, projection, coast, cmap, vmin, vmax, label, colorbar
        As in `SphericalDelaunay.plot`; by default the coasts are drawn on top. New axes show the
        globe.
    **options
        `norm`, as in `SphericalDelaunay.plot`, and options of the collection: of Matplotlib's
        ``pcolormesh`` for grids of longitudes and latitudes, of
        `matplotlib.collections.PathCollection` for other cells.

    Returns
    -------
    matplotlib.axes.Axes
        The axes. ``ax.collections[0]`` are the cells if the axes are new.

    Raises
    ------
    ImportError
        If Matplotlib is not installed.
    ValueError
        If the values have another shape, such as that of a field whose longitudes come first.

    Examples
    --------
    >>> import rondel
    >>> cells = rondel.CellSet.named("healpix:2")
    >>> ax = cells.plot(cells.areas, label="area (steradians)")

    """
    numbers = None
    if values is not None:
        numbers = as_colors(values, "values", self.num_cells, self.shape)
    norm = take_norm(options, numbers, vmin, vmax)
    drawn = make_map(ax, projection)
    lines = self._cells.lines()
    if lines is not None and numbers is not None:
        look = {"cmap": cmap, "norm": norm, "rasterized": True, **options}
        shape = len(lines[1]) - 1, len(lines[0]) - 1
        colored = drawn.draw_grid(lines[0], lines[1], numbers.reshape(shape), look)
    elif lines is not None:
        pieces = _grid_lines(*lines[:2])
        drawn.draw_lines(pieces, line_options(drawn, self.num_cells, options))
    elif numbers is not None:
        look = {**FILLED, "cmap": cmap, **options}
        colored = draw_rings(drawn, self._cells.rings(), numbers, look)
    else:
        _draw_borders(self, drawn, options)
    if numbers is not None:
        add_colors(drawn, colored, numbers, norm, label, colorbar)
    if coast:
        draw_coast_lines(drawn)
    return drawn.ax


def _draw_borders(self: Drawn, drawn: LonLatMap, options: dict[str, Any]) -> None:
    look = line_options(drawn, self.num_cells, {})
    edges = {"edgecolors": look["colors"], "linewidths": look["linewidths"]}
    draw_rings(drawn, self._cells.rings(), None, {"facecolors": "none", **edges, **options})


def _grid_lines(lon: FloatArray, lat: FloatArray) -> list[FloatArray]:
    """The meridians and parallels of a grid, which end where the map does."""
    found = []
    south, north = sorted((lat[0], lat[-1]))
    along = np.linspace(south, north, max(2, int((north - south) / STEP) + 1))
    for meridian in (lon + 180) % 360 - 180:
        found.append(np.stack([np.full(len(along), meridian), along], axis=1))
    west, east = sorted((lon[0], lon[-1]))
    for turn in (-360.0, 0.0, 360.0):
        ends = max(west + turn, -180.0), min(east + turn, 180.0)
        if ends[0] < ends[1]:
            along = np.linspace(*ends, max(2, int((ends[1] - ends[0]) / STEP) + 1))
            found += [np.stack([along, np.full(len(along), each)], axis=1) for each in lat]
    return found
