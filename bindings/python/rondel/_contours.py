# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Isolines and filled bands of values at the sites of a triangulation."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import as_fields, as_floats, as_threads, frozen
from ._geo import written
from ._plot import draw_arcs
from ._repr import Described, count
from ._types import ArrayLike, BoolArray, FloatArray, Triangulated

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OffsetArray = npt.NDArray[np.int64]


def isolines(
    self: Triangulated, values: ArrayLike, levels: ArrayLike, *, threads: int | None = None
) -> Isolines:
    """Lines of equal value, of the field that is linear in each triangle.

    Parameters
    ----------
    values : array_like, shape (n,)
        Triangles with a corner whose value is nan or masked are left out.
    levels : array_like
        A level, or several that increase.
    threads : int, optional

    Returns
    -------
    Isolines

    Raises
    ------
    InvalidInput
        If a value is infinite, the levels do not increase, or the sites are weighted.

    Examples
    --------
    >>> import rondel
    >>> tri = rondel.delaunay([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    >>> tri.isolines([0, 0, 0, 0, 1, -1], 0.5)
    <rondel.Isolines: 1 level, 1 line>

    """
    return Isolines(_core.isolines(self._triangulation, *_as_input(self, values, levels, threads)))


def bands(
    self: Triangulated, values: ArrayLike, levels: ArrayLike, *, threads: int | None = None
) -> Bands:
    """The regions between levels, of the field of `isolines`.

    Together they are the triangles with values, without gaps: where two of them meet, both have
    the same points, which are those of the isolines.

    Parameters
    ----------
    values, levels, threads
        As of `isolines`.

    Returns
    -------
    Bands

    """
    return Bands(_core.bands(self._triangulation, *_as_input(self, values, levels, threads)))


def _as_input(
    self: Triangulated, values: ArrayLike, levels: ArrayLike, threads: int | None
) -> tuple[FloatArray, FloatArray, int]:
    numbers = as_fields(values, len(self.points))
    if numbers.ndim != 1:
        raise ValueError(f"values must have shape ({len(self.points)},), not {numbers.shape}")
    return (
        np.ascontiguousarray(numbers),
        np.ascontiguousarray(as_floats(levels, "levels").reshape(-1)),
        as_threads(threads),
    )


class Isolines(Described):
    """Lines of equal value.

    Line i has the ``points[line_offsets[i]:line_offsets[i + 1]]``, unit vectors, with higher
    values to its left; consecutive ones are joined by arcs of great circles. The lines of
    ``levels[k]`` are ``level_offsets[k]`` to ``level_offsets[k + 1]``.
    """

    def __init__(self, found: _core.Isolines) -> None:
        self._found = found
        self.levels: FloatArray = found.levels
        self.level_offsets: OffsetArray = found.level_offsets
        self.line_offsets: OffsetArray = found.line_offsets
        self.is_closed: BoolArray = frozen(found.is_closed.astype(bool))
        self.points: FloatArray = found.points

    def lines(self, level: int) -> list[FloatArray]:
        """The lines of a level, each of shape (k, 3); a closed one ends where it begins."""
        found = []
        for i in range(*_rows(self.level_offsets, level)):
            line = self.points[slice(*_rows(self.line_offsets, i))]
            found.append(np.concatenate([line, line[:1]]) if self.is_closed[i] else line)
        return found

    @overload
    def to_geojson(self, path: None = None, *, tolerance: float = 0.01) -> dict[str, Any]: ...
    @overload
    def to_geojson(
        self, path: str | os.PathLike[str] | io.IOBase, *, tolerance: float = 0.01
    ) -> None: ...
    def to_geojson(
        self, path: str | os.PathLike[str] | io.IOBase | None = None, *, tolerance: float = 0.01
    ) -> Any:
        """A feature for each level: a MultiLineString, or null, with the property `level`.

        Parameters
        ----------
        path : path-like or file object, optional
            Where to write the text; otherwise it is returned, parsed.
        tolerance : float, optional
            How far a line may be from its arc, in degrees.

        Returns
        -------
        dict or None

        """
        return written(path, lambda name: _core.write_isolines(name, self._found, tolerance, 0))

    def plot(self, ax: Any = None, *, projection: Any = None, **options: Any) -> Axes:
        """Draws the lines, on axes as those of `SphericalDelaunay.plot`.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
        projection : cartopy.crs.CRS, optional
        **options
            For `matplotlib.collections.LineCollection`.

        Returns
        -------
        matplotlib.axes.Axes

        """
        lines = [line for k in range(len(self.levels)) for line in self.lines(k)]
        pieces = [np.stack([line[:-1], line[1:]], axis=1) for line in lines]
        ends = np.concatenate([np.zeros((0, 2, 3)), *pieces])
        return draw_arcs(ends, ax, projection, {"colors": "black", **options})

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("levels", count(len(self.levels), "level")),
            ("lines", count(len(self.is_closed), "line")),
        ]


class Bands(Described):
    """Regions between levels: band k has the values from ``levels[k - 1]`` to below ``levels[k]``.

    It consists of the polygons ``band_offsets[k]`` to ``band_offsets[k + 1]``; polygon i of the
    rings ``polygon_offsets[i]`` to ``polygon_offsets[i + 1]``, ring j of the points
    ``points[ring_offsets[j]:ring_offsets[j + 1]]``. Inside is to the left of all rings.
    """

    def __init__(self, found: _core.Bands) -> None:
        self._found = found
        self.levels: FloatArray = found.levels
        self.band_offsets: OffsetArray = found.band_offsets
        self.polygon_offsets: OffsetArray = found.polygon_offsets
        self.ring_offsets: OffsetArray = found.ring_offsets
        self.points: FloatArray = found.points

    def polygons(self, band: int) -> list[list[FloatArray]]:
        """The polygons of a band, each a list of rings (k, 3); without rings it is the sphere."""
        return [
            [
                self.points[slice(*_rows(self.ring_offsets, j))]
                for j in range(*_rows(self.polygon_offsets, i))
            ]
            for i in range(*_rows(self.band_offsets, band))
        ]

    @overload
    def to_geojson(self, path: None = None, *, tolerance: float = 0.01) -> dict[str, Any]: ...
    @overload
    def to_geojson(
        self, path: str | os.PathLike[str] | io.IOBase, *, tolerance: float = 0.01
    ) -> None: ...
    def to_geojson(
        self, path: str | os.PathLike[str] | io.IOBase | None = None, *, tolerance: float = 0.01
    ) -> Any:
        """A feature for each band: a MultiPolygon with `low` and `high`, null at the open ends.

        Parameters
        ----------
        path, tolerance
            As of `Isolines.to_geojson`.

        Returns
        -------
        dict or None

        """
        return written(path, lambda name: _core.write_bands(name, self._found, tolerance, 0))

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("bands", count(len(self.levels) + 1, "band")),
            ("polygons", count(len(self.polygon_offsets) - 1, "polygon")),
        ]


def _rows(offsets: OffsetArray, row: int) -> tuple[int, int]:
    if not 0 <= row < len(offsets) - 1:
        raise IndexError(f"{row} is not in 0 to {len(offsets) - 2}")
    return int(offsets[row]), int(offsets[row + 1])
