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

    def draw_lines(self, lines: Lines, options: dict[str, Any], values: Any = None) -> Any:
        """Lines, each a list of positions; in the colors of values, if there are any."""
        from matplotlib.collections import LineCollection

        if values is not None:
            options = {"array": values, **options}
        return self.ax.add_collection(LineCollection(lines, **options), autolim=False)

    def draw_points(self, degrees: FloatArray, size: float) -> None:
        """Black dots; their size is the square of their width in points."""
        look = {"s": size, "color": "black", "linewidths": 0, "zorder": 3}
        self.ax.scatter(degrees[:, 0], degrees[:, 1], **look, **self.options)

    def draw_grid(
        self, lon: FloatArray, lat: FloatArray, values: FloatArray, options: dict[str, Any]
    ) -> Any:
        """The cells between meridians and parallels, values of shape (nlat, nlon)."""
        # Cells beyond 180 degrees are on the other side of the map, too.
        for turn in (-360.0, 360.0):
            moved = lon + turn
            if moved.max() > -180 and moved.min() < 180:
                self.ax.pcolormesh(moved, lat, values, **options)
        return self.ax.pcolormesh(lon, lat, values, **options)

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

    def project(self, degrees: FloatArray) -> FloatArray:
        """Positions on the map, shape (n, 2)."""
        return self._transform(degrees)

    def draw_grid(
        self, lon: FloatArray, lat: FloatArray, values: FloatArray, options: dict[str, Any]
    ) -> Any:
        """The cells between meridians and parallels, values of shape (nlat, nlon)."""
        return self.ax.pcolormesh(lon, lat, values, transform=self.degrees, **options)

    def draw_lines(self, lines: Lines, options: dict[str, Any], values: Any = None) -> Any:
        """Lines, each a list of positions; in the colors of values, if there are any."""
        from shapely.geometry import LineString

        drawn, is_whole, is_seen = self._project(lines)
        whole = np.flatnonzero(is_whole)
        parts, whose = [drawn[k] for k in whole], [whole]
        for k in np.flatnonzero(is_seen & ~is_whole):
            found = self.ax.projection.project_geometry(LineString(lines[k]), self.degrees)
            parts += [_positions(part) for part in found.geoms]
            whose.append(np.full(len(found.geoms), k))
        of_parts = None if values is None else values[np.concatenate(whose)]
        return super().draw_lines(parts, options, of_parts)

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
            found = self._project_area(Polygon(polygons[k]))
            for part in map(orient, found.geoms):
                rings = (part.exterior, *part.interiors)
                parts.append(Path.make_compound_path(*(Path(_positions(ring)) for ring in rings)))
            whose.append(np.full(len(found.geoms), owners[k]))
        if not is_seen.all():
            domain = self.ax.projection.domain
            middle = domain.representative_point()
            owner = owner_at(self.degrees.transform_point(middle.x, middle.y, self.ax.projection))
            if not is_seen[owners == owner].any():
                parts.append(Path(_positions(domain.exterior)))
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
                found = self._project_area(area)
                for part in map(orient, found.geoms):
                    bounds = (part.exterior, *part.interiors)
                    parts.append(([_positions(ring) for ring in bounds], k))
            elif Polygon(rings[0], rings[1:]).contains(middle):
                parts.append(([_positions(domain.exterior)], k))
        return self._add_areas(parts, values, options)

    def _project_area(self, area: Any) -> Any:
        """A polygon of degrees on the map. Of two kinds Cartopy gives what is outside: of polygons
        around a pole that is infinitely far away, as on maps of one hemisphere, and of slivers
        that cross themselves there.
        """
        from shapely.geometry import MultiPolygon, Point, box
        from shapely.validation import make_valid

        found = self.ax.projection.project_geometry(area, self.degrees)
        domain = self.ax.projection.domain
        pole = np.copysign(90.0, area.bounds[1] + area.bounds[3])
        is_polar = abs(area.bounds[1 if pole < 0 else 3]) >= 90
        if is_polar and not _is_in(domain, self._transform(np.array([[0.0, pole]]))[0]):
            inside = area.intersection(box(-180, -80, 180, 80)).representative_point()
            if inside.is_empty:
                return found
            there = Point(self.ax.projection.transform_point(inside.x, inside.y, self.degrees))
            is_outside = domain.contains(there) and not make_valid(found).contains(there)
        else:
            is_outside = found.area > 0.5 * domain.area and _share_of_sphere(area) < 0.01
        if not is_outside:
            return found
        rest = domain.difference(make_valid(found))
        parts = getattr(rest, "geoms", [rest])
        return MultiPolygon([part for part in parts if part.geom_type == "Polygon"])

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


def _positions(line: Any) -> FloatArray:
    """The positions of a line of shapely; Cartopy gives some of them a height."""
    return np.asarray(line.coords, np.float64)[:, :2]


def _is_in(domain: Any, place: FloatArray) -> bool:
    """Whether a map has a place, at its border, too, which Cartopy draws a little inside."""
    west, south, east, north = domain.bounds
    slack = 1e-3 * max(east - west, north - south)
    x, y = place
    return bool(west - slack <= x <= east + slack and south - slack <= y <= north + slack)


def _share_of_sphere(area: Any) -> float:
    """The area of a polygon of degrees, holes filled, as a part of the sphere."""
    lon, lat = np.radians(_positions(area.exterior)).T
    heights = np.sin(lat)
    doubled = np.sum(np.diff(lon) * (heights[1:] + heights[:-1]))
    return float(abs(doubled) / 2 / (4 * np.pi))
