# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Axes of Matplotlib on which lines and polygons of longitude and latitude are drawn.

Cartopy can draw them itself, but takes about 2 ms for each: it looks where a line of any kind
leaves the map. Most lines here do not, as they are cut at the antimeridian, and are made of short
pieces. So all positions are projected at once, and Cartopy gets what is torn, because the map ends
elsewhere, or bent.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ._types import BoolArray, FloatArray, IntArray

Lines = list[FloatArray]

LARGEST_BEND = 0.02  # of a projected piece, at its middle, as a part of its length
ROUNDING = 1e-9  # of positions on the map, as a part of its size


class LonLatMap:
    """Plain axes of longitude and latitude."""

    def __init__(self, ax: Any) -> None:
        self.ax = ax
        self.options: dict[str, Any] = {}  # what tells Cartopy that coordinates are degrees

    def draw_lines(self, lines: Lines, options: dict[str, Any]) -> None:
        """Lines, each a list of positions."""
        from matplotlib.collections import LineCollection

        self.ax.add_collection(LineCollection(lines, **options), autolim=False)

    def draw_points(self, degrees: FloatArray) -> None:
        """Small black dots."""
        self.ax.scatter(degrees[:, 0], degrees[:, 1], s=4, color="black", zorder=3, **self.options)

    def draw_polygons(
        self,
        polygons: Lines,
        owners: IntArray,
        owner_at: Callable[[Any], int],
        options: dict[str, Any],
        values: npt.NDArray[Any],
    ) -> Any:
        """Polygons in the colors of their owners' values; `owner_at` tells whose a position is."""
        from matplotlib.collections import PolyCollection

        cells = PolyCollection(polygons, array=values[owners], **options)
        return self.ax.add_collection(cells, autolim=False)

    def draw_areas(self, areas: list[Lines], values: Any, options: dict[str, Any]) -> Any:
        """Polygons with holes, each a list of rings, the outer one first; in the colors of values,
        if there are any.
        """
        return self._add_areas([(rings, k) for k, rings in enumerate(areas)], values, options)

    def _add_areas(self, areas: list[tuple[Any, int]], values: Any, options: dict[str, Any]) -> Any:
        from matplotlib.collections import PathCollection
        from matplotlib.path import Path

        paths = [Path.make_compound_path(*map(Path, rings)) for rings, _ in areas]
        if values is not None:
            options = {"array": values[[k for _, k in areas]], **options}
        return self.ax.add_collection(PathCollection(paths, **options), autolim=False)


class ProjectedMap(LonLatMap):
    """Axes of Cartopy."""

    def __init__(self, ax: Any) -> None:
        import cartopy.crs

        super().__init__(ax)
        self.degrees = cartopy.crs.PlateCarree()
        self.options = {"transform": self.degrees}

    def draw_lines(self, lines: Lines, options: dict[str, Any]) -> None:
        """Lines, each a list of positions."""
        from shapely.geometry import LineString

        drawn, is_whole, is_seen = self._project(lines)
        parts = [drawn[k] for k in np.flatnonzero(is_whole)]
        for k in np.flatnonzero(is_seen & ~is_whole):
            found = self.ax.projection.project_geometry(LineString(lines[k]), self.degrees)
            parts += [np.array(part.coords) for part in found.geoms]
        super().draw_lines(parts, options)

    def draw_polygons(
        self,
        polygons: Lines,
        owners: IntArray,
        owner_at: Callable[[Any], int],
        options: dict[str, Any],
        values: npt.NDArray[Any],
    ) -> Any:
        """Polygons in the colors of their owners' values; `owner_at` tells whose a position is.

        A cell without a visible corner is invisible, or surrounds all that the map shows.
        """
        from matplotlib.collections import PathCollection
        from matplotlib.path import Path
        from shapely.geometry import Polygon
        from shapely.geometry.polygon import orient

        drawn, is_whole, is_seen = self._project(polygons)
        whole = np.flatnonzero(is_whole)
        parts, whose = [Path(drawn[k]) for k in whole], [owners[whole]]
        for k in np.flatnonzero(is_seen & ~is_whole):
            found = self.ax.projection.project_geometry(Polygon(polygons[k]), self.degrees)
            for part in map(orient, found.geoms):
                rings = (part.exterior, *part.interiors)
                parts.append(Path.make_compound_path(*(Path(ring.coords) for ring in rings)))
            whose.append(np.full(len(found.geoms), owners[k]))
        if not is_seen.all():
            domain = self.ax.projection.domain
            middle = domain.representative_point()
            owner = owner_at(self.degrees.transform_point(middle.x, middle.y, self.ax.projection))
            if not is_seen[owners == owner].any():
                parts.append(Path(domain.exterior.coords))
                whose.append(np.array([owner]))
        cells = PathCollection(parts, array=values[np.concatenate(whose)], **options)
        return self.ax.add_collection(cells, autolim=False)

    def draw_areas(self, areas: list[Lines], values: Any, options: dict[str, Any]) -> Any:
        """Polygons with holes, each a list of rings, the outer one first; in the colors of values,
        if there are any.
        """
        from shapely.geometry import Point, Polygon
        from shapely.geometry.polygon import orient

        begin = np.cumsum([0, *map(len, areas)])
        drawn, is_whole, is_seen = self._project([ring for rings in areas for ring in rings])
        domain = self.ax.projection.domain
        middle = domain.representative_point()
        middle = Point(self.degrees.transform_point(middle.x, middle.y, self.ax.projection))
        parts: list[tuple[Any, int]] = []
        for k, rings in enumerate(areas):
            own = slice(begin[k], begin[k + 1])
            if is_whole[own].all():
                parts.append((drawn[own], k))
            elif is_seen[own].any():
                area = Polygon(rings[0], rings[1:])
                found = self.ax.projection.project_geometry(area, self.degrees)
                for part in map(orient, found.geoms):
                    bounds = (part.exterior, *part.interiors)
                    parts.append(([np.array(ring.coords) for ring in bounds], k))
            elif Polygon(rings[0], rings[1:]).contains(middle):
                parts.append(([np.array(domain.exterior.coords)], k))
        return self._add_areas(parts, values, options)

    def _project(self, lines: Lines) -> tuple[Lines, BoolArray, BoolArray]:
        """The lines on the map; whether each is there in one piece, and whether any of it is."""
        if not lines:
            return [], np.zeros(0, bool), np.zeros(0, bool)
        sizes = np.array([len(line) for line in lines])
        first = np.cumsum(sizes) - sizes
        positions = np.concatenate(lines)
        there = self._transform(positions)
        middle = self._transform((positions[:-1] + positions[1:]) / 2)
        limits = np.array([self.ax.projection.x_limits, self.ax.projection.y_limits])
        size = np.abs(limits).max()
        slack = ROUNDING * size
        is_visible = ((there >= limits[:, 0] - slack) & (there <= limits[:, 1] + slack)).all(axis=1)
        with np.errstate(invalid="ignore"):
            length = np.linalg.norm(np.diff(there, axis=0), axis=1)
            bend = np.linalg.norm(middle - (there[:-1] + there[1:]) / 2, axis=1)
            is_straight = bend <= LARGEST_BEND * length + slack
        is_straight = np.append(is_straight, True)
        is_straight[first + sizes - 1] = True  # from one line to the next
        is_whole = np.logical_and.reduceat(is_visible & is_straight, first)
        is_seen = np.logical_or.reduceat(is_visible, first)
        return np.split(there, first[1:]), is_whole, is_seen

    def _transform(self, degrees: FloatArray) -> FloatArray:
        return self.ax.projection.transform_points(self.degrees, degrees[:, 0], degrees[:, 1])[
            :, :2
        ]
