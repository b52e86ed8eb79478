# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The axes of pictures: maps, what of the globe they show, coasts, color bars and sizes of dots."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from ._arrays import degrees_of, half_turn
from ._lonlat import arcs
from ._projection import LonLatMap, ProjectedMap
from ._types import FloatArray

REGIONAL = 60.0  # degrees around the middle of all points: a map of a region shows them larger
MARGIN = 0.05  # of a map of a region, as a part of its size
BAND = 0.12  # of the largest width of a line, as a part of the distance of sites on the map


def pyplot() -> Any:
    """Matplotlib's pyplot, or an error that says how to get it."""
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError(
            "pictures are drawn by Matplotlib, which is not installed: pip install 'rondel[plot]', "
            "or matplotlib and, for map projections, cartopy"
        ) from error
    return plt


def make_map(ax: Any, projection: Any, points: FloatArray | None = None) -> LonLatMap:
    """What draws on the axes. New ones, and plain ones, show the region of the points, unit
    vectors of shape (n, 3), if they are within 60 degrees; by default the globe.
    """
    plt = pyplot()
    try:
        import cartopy.crs
    except ImportError:
        cartopy = None
    _require_map(ax, projection, cartopy)
    region = _region(points)
    if ax is None and cartopy is not None:
        ax = plt.figure(constrained_layout=True).add_subplot(
            projection=projection or _projection_of(region)
        )
        if region is None or projection is not None:
            ax.set_global()
    elif ax is None:
        if projection is not None:
            raise ImportError(
                "map projections are those of Cartopy, which is not installed: pip install cartopy"
            )
        ax = plt.figure(constrained_layout=True).add_subplot()
    elif cartopy is not None and hasattr(ax, "projection"):
        region = None  # the caller's map shows what it shows
    if cartopy is not None and hasattr(ax, "projection"):
        drawn = ProjectedMap(ax)
        if region is not None and projection is None:
            _show_region(drawn, points)
        return drawn
    _show_plain(ax, region, points)
    return LonLatMap(ax)


def _require_map(ax: Any, projection: Any, cartopy: Any) -> None:
    """Refuses the projections that Matplotlib itself has, which neither cut nor fill polygons."""
    from matplotlib.projections.geo import GeoAxes

    if isinstance(ax, GeoAxes):
        raise TypeError(f"ax has Matplotlib's projection {ax.name!r}; maps are those of Cartopy")
    is_known = projection is None or cartopy is None
    if not is_known and not isinstance(projection, cartopy.crs.Projection):
        raise TypeError(
            "projection must be one of Cartopy, such as cartopy.crs.Mollweide(), not "
            f"{projection!r}"
        )


def _region(points: FloatArray | None) -> tuple[float, float] | None:
    """The middle of the points in degrees, if all of them are near it."""
    if points is None or len(points) == 0:
        return None
    middle = points.sum(axis=0)
    length = np.linalg.norm(middle)
    if not length > 0 or (points @ middle / length).min() < np.cos(np.radians(REGIONAL)):
        return None
    lon, lat = degrees_of(middle[None])[0]
    return float(lon), float(lat)


def _projection_of(region: tuple[float, float] | None) -> Any:
    """Of the globe Robinson, of a region one that keeps areas."""
    import cartopy.crs

    if region is None:
        return cartopy.crs.Robinson()
    lon, lat = region
    return cartopy.crs.LambertAzimuthalEqualArea(central_longitude=lon, central_latitude=lat)


def _show_region(drawn: ProjectedMap, points: Any) -> None:
    there = drawn.project(degrees_of(points))
    low, high = there.min(axis=0), there.max(axis=0)
    margin = max(MARGIN * float((high - low).max()), 1.0)  # in meters
    drawn.ax.set_xlim(low[0] - margin, high[0] + margin)
    drawn.ax.set_ylim(low[1] - margin, high[1] + margin)


def _show_plain(ax: Any, region: tuple[float, float] | None, points: Any) -> None:
    ax.set(xlim=(-180, 180), ylim=(-90, 90), aspect="equal")
    ax.set(xlabel="longitude [degrees]", ylabel="latitude [degrees]")
    if region is None:
        return
    degrees = degrees_of(points)
    lon = region[0] + half_turn(degrees[:, 0] - region[0])
    lat = degrees[:, 1]
    margin = max(MARGIN * max(float(np.ptp(lon)), float(np.ptp(lat))), 1e-6)
    if np.abs(lon).max() + margin < 180 and np.abs(lat).max() + margin < 90:
        ax.set(xlim=(lon.min() - margin, lon.max() + margin))
        ax.set(ylim=(lat.min() - margin, lat.max() + margin))
        ax.set_aspect(1 / np.cos(np.radians(region[1])))


def spacing(drawn: LonLatMap, count: int) -> float:
    """The distance of neighbors in points (1/72 inch) if so many things fill the axes."""
    box = drawn.ax.get_position()
    width, height = drawn.ax.figure.get_size_inches() * 72 * (box.width, box.height)
    return float(np.sqrt(width * height / max(1, count)))


def draw_sites(drawn: LonLatMap, degrees: FloatArray) -> None:
    """Black dots, smaller where there are many."""
    size = np.clip(0.25 * spacing(drawn, len(degrees)), 0.2, 2.0)
    drawn.draw_points(degrees, size**2)


def draw_coast_lines(drawn: LonLatMap) -> None:
    """The coasts of the Earth (Natural Earth, 1:110 million)."""
    degrees, offsets = _core.coast_lines()
    points = _core.unit_vectors(degrees)
    is_last = np.zeros(len(points), bool)
    is_last[offsets[1:] - 1] = True
    first = np.flatnonzero(~is_last)
    drawn.draw_lines(arcs(points[first], points[first + 1]), {"colors": "0.45", "linewidths": 0.5})


def line_options(
    drawn: LonLatMap, count: int, options: dict[str, Any], *, over_colors: bool = False
) -> dict[str, Any]:
    """How so many lines are drawn: thinner where there are many, pale over colors."""
    width = np.clip(BAND * spacing(drawn, count), 0.1, 0.6)
    is_pale = over_colors and not {"colors", "color"} & options.keys()
    look = {"colors": "black", "alpha": 0.3} if is_pale else {"colors": "tab:blue"}
    return {**look, "linewidths": width, **options}


def limits(values: Any, vmin: float | None, vmax: float | None) -> tuple[Any, Any]:
    """Those of the colors: of all values, also of what the map does not show."""
    known = values[np.isfinite(values)]
    if known.size:
        vmin = known.min() if vmin is None else vmin
        vmax = known.max() if vmax is None else vmax
    return vmin, vmax


# Options of collections that would change the colors behind the color bar, and what to say instead.
_OF_COLORS = {"array": "values are its argument", "clim": "vmin and vmax are the limits"}


def take_norm(options: dict[str, Any], values: Any, vmin: float | None, vmax: float | None) -> Any:
    """The norm of the colors, which the options lose; by default it is linear. Its limits are those
    of all values unless they are given. None if there are no values.
    """
    for name, words in _OF_COLORS.items():
        if name in options:
            raise TypeError(f"plot() takes no option {name!r}: {words}")
    norm = options.pop("norm", None)
    if values is None:
        if norm is not None:
            raise TypeError("norm is that of the colors of values, and there are none")
        return None
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    if norm is None:
        return Normalize(*limits(values, vmin, vmax))
    if vmin is not None or vmax is not None:
        raise TypeError("norm has limits, so that vmin and vmax cannot be given beside it")
    norm = ScalarMappable(norm=norm).norm  # It may be a name, such as "log".
    norm.autoscale_None(values[np.isfinite(values)])
    return norm


def add_colors(
    drawn: LonLatMap,
    colored: Any,
    values: Any,
    norm: Any,
    label: str | None,
    colorbar: bool,
) -> None:
    """Sets the norm of the colors, and adds a bar with the label below the map; its ends are
    pointed where values are beyond the limits.
    """
    colored.set_norm(norm)
    if not colorbar:
        return
    known = values[np.isfinite(values)]
    is_below = known.size > 0 and known.min() < norm.vmin
    is_above = known.size > 0 and known.max() > norm.vmax
    ends = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
    # A norm of classes has colors of its own beyond its limits, or none.
    extend = getattr(norm, "extend", ends[int(is_below), int(is_above)])
    add_bar(drawn, colored, label, extend=extend)


def add_bar(drawn: LonLatMap, colored: Any, label: str | None, **options: Any) -> None:
    """A color bar below the map."""
    is_plain = not isinstance(drawn, ProjectedMap)  # with numbers and words below
    place = {"orientation": "horizontal", "shrink": 0.6, "pad": 0.17 if is_plain else 0.05}
    bar = drawn.ax.figure.colorbar(colored, ax=drawn.ax, aspect=30, **place, **options)
    if label:
        bar.set_label(label)
