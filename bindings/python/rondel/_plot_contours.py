# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of isolines and bands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._lonlat import arcs
from ._map_axes import add_bar, draw_coast_lines, make_map
from ._rings import FILLED, draw_rings, polygon_rings
from ._types import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_isolines(
    self: Any,
    ax: Any,
    projection: Any,
    coast: bool,
    cmap: Any,
    label: str | None,
    colorbar: bool,
    options: dict[str, Any],
) -> Axes:
    """Draws isolines: `Isolines.plot`."""
    drawn = make_map(ax, projection, self.points)
    if coast:
        draw_coast_lines(drawn)
    pieces: list[FloatArray] = []
    levels: list[FloatArray] = []
    for k, level in enumerate(self.levels):
        ends = [np.stack([line[:-1], line[1:]], axis=1) for line in self.lines(k)]
        if ends:
            joined = np.concatenate(ends)
            lines = arcs(joined[:, 0], joined[:, 1])
            pieces += lines
            levels.append(np.full(len(lines), level))
    if {"colors", "color"} & options.keys():
        drawn.draw_lines(pieces, options)
        return drawn.ax
    of_lines = np.concatenate([np.zeros(0), *levels])
    colored = drawn.draw_lines(pieces, {"cmap": cmap, **options}, of_lines)
    if len(self.levels):
        colored.set_clim(self.levels[0], self.levels[-1])
    if colorbar and len(self.levels):
        few = len(self.levels) <= 12
        add_bar(drawn, colored, label, **({"ticks": self.levels} if few else {}))
    return drawn.ax


def plot_bands(
    self: Any,
    ax: Any,
    projection: Any,
    coast: bool,
    cmap: Any,
    label: str | None,
    colorbar: bool,
    options: dict[str, Any],
) -> Axes:
    """Fills bands: `Bands.plot`."""
    drawn = make_map(ax, projection, self.points)
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm, Colormap

    colors = cmap if isinstance(cmap, Colormap) else colormaps[cmap or "viridis"]
    # A color for each band: one more than there are spaces between levels, with both open ends.
    levels = self.levels if len(self.levels) > 1 else np.append(self.levels, self.levels + 1)
    norm = options.pop("norm", None) or BoundaryNorm(levels, colors.N, extend="both")
    middles = np.concatenate(
        [self.levels[:1] - 1, (self.levels[1:] + self.levels[:-1]) / 2, self.levels[-1:] + 1]
    )
    polygons = self.polygon_offsets[self.band_offsets]
    corners = np.arange(len(self.points))
    rings = polygon_rings(self.ring_offsets, corners, self.points, polygons)
    # A polygon without rings is the whole sphere.
    is_empty = np.diff(self.polygon_offsets) == 0
    rings.whole = np.flatnonzero(
        [
            is_empty[a:b].any()
            for a, b in zip(self.band_offsets, self.band_offsets[1:], strict=False)
        ]
    ).astype(np.int32)
    look = {**FILLED, "cmap": colors, "norm": norm, **options}
    draw_rings(drawn, rings, middles, look)
    if coast:
        draw_coast_lines(drawn)
    if colorbar and len(self.levels):
        add_bar(drawn, ScalarMappable(norm, colors), label, ticks=_few(self.levels))
    return drawn.ax


def _few(levels: FloatArray) -> FloatArray:
    """At most twelve of the levels, in equal steps."""
    return levels[:: (len(levels) + 11) // 12]
