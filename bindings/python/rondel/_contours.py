# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Isolines and filled bands of values at the sites of a triangulation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import as_fields, as_threads, as_vector, frozen
from ._geo import File, Path, written
from ._pickled import arrays_of, with_arrays
from ._plot_contours import plot_bands, plot_isolines
from ._repr import Described, count
from ._types import ArrayLike, BoolArray, FloatArray, Triangulated

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OffsetArray = npt.NDArray[np.int64]


class Contours:
    """Contours of values: methods of `SphericalDelaunay`."""

    def isolines(
        self: Triangulated, values: ArrayLike, levels: ArrayLike, *, threads: int | None = None
    ) -> Isolines:
        """Computes lines of equal value of the field that is linear in each triangle.

        Parameters
        ----------
        values : array_like, shape (n,)
            A value for each site. Triangles with a corner whose value is NaN or masked are left
            out. Of sites in one place the first one that has a value counts.
        levels : float or array_like, shape (k,)
            One level, or several in increasing order.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        Isolines
            The lines of each level.

        Raises
        ------
        InvalidInput
            If a value is infinite, the levels do not increase, or the sites are weighted.

        Notes
        -----
        Lines pass edges where linear interpolation between their ends has the level; values equal
        to the level belong to the higher side. No line visits a point twice.

        Examples
        --------
        >>> import rondel
        >>> x = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
        >>> tri = rondel.delaunay(x)
        >>> tri.isolines([0, 0, 0, 0, 1, -1], 0.5)
        <rondel.Isolines: 1 level, 1 line>

        """
        return Isolines(
            _core.isolines(self._triangulation, *_as_input(self, values, levels, threads))
        )

    def bands(
        self: Triangulated, values: ArrayLike, levels: ArrayLike, *, threads: int | None = None
    ) -> Bands:
        """Computes the regions between levels of the field that is linear in each triangle.

        Together the regions are the triangles with values, without gaps: where two regions meet,
        both have the same points, which are those of the isolines.

        Parameters
        ----------
        values, threads
            As in `isolines`.
        levels : float or array_like, shape (k,)
            One level, or several in increasing order, which make k + 1 bands.

        Returns
        -------
        Bands
            The regions: band k has the values from ``levels[k - 1]`` to below ``levels[k]``.

        Raises
        ------
        InvalidInput
            As in `isolines`.

        Examples
        --------
        >>> import rondel
        >>> x = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
        >>> tri = rondel.delaunay(x)
        >>> len(tri.bands([0, 0, 0, 0, 1, -1], [-0.5, 0.5]).band_offsets) - 1
        3

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
        as_vector(levels, "levels"),
        as_threads(threads),
    )


class Traced(Described):
    """What `Isolines` and `Bands` have in common."""

    _found: Any

    def _write(self, name: str | None, tolerance: float) -> bytes | None:
        raise NotImplementedError

    def __getstate__(self) -> dict[str, Any]:
        return arrays_of(self._found)

    @overload
    def to_geojson(self, path: None = None, *, tolerance: float = 0.01) -> dict[str, Any]: ...
    @overload
    def to_geojson(self, path: Path | File, *, tolerance: float = 0.01) -> None: ...
    def to_geojson(self, path: Path | File | None = None, *, tolerance: float = 0.01) -> Any:
        """Converts the lines or bands to GeoJSON (RFC 7946).

        There is a feature for each level: a MultiLineString, or null, with the property `level`.
        Or there is a feature for each band: a MultiPolygon with the properties `low` and `high`,
        which are null at the open ends.

        Parameters
        ----------
        path : path-like or file object, text or binary, optional
            Where to write the text; by default it is parsed and returned.
        tolerance : float, optional
            The largest distance of a straight line from its arc, in degrees; by default 0.01.

        Returns
        -------
        dict or None
            The FeatureCollection, or None if `path` is given.

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        return written(path, lambda name: self._write(name, tolerance))


class Isolines(Traced):
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

    def _write(self, name: str | None, tolerance: float) -> bytes | None:
        return _core.write_isolines(name, self._found, tolerance)

    def __setstate__(self, state: dict[str, Any]) -> None:
        Isolines.__init__(self, with_arrays(_core.Isolines(), state))

    def lines(self, level: int) -> list[FloatArray]:
        """Returns the lines of a level, each of shape (k, 3); a closed one ends where it begins."""
        found = []
        for i in range(*_rows(self.level_offsets, level)):
            line = self.points[slice(*_rows(self.line_offsets, i))]
            found.append(np.concatenate([line, line[:1]]) if self.is_closed[i] else line)
        return found

    def plot(
        self,
        ax: Any = None,
        *,
        projection: Any = None,
        coast: bool = False,
        cmap: Any = None,
        label: str | None = None,
        colorbar: bool = True,
        **options: Any,
    ) -> Axes:
        """Draws the lines in the colors of their levels.

        Parameters
        ----------
        ax, projection
            As in `SphericalDelaunay.plot`; by default new axes.
        coast : bool, optional
            Whether to draw the coasts of the Earth below; by default False, as lines are often
            drawn on the axes of another picture.
        cmap : optional
            The colors of the levels, as everywhere in Matplotlib.
        label : str, optional
            What the levels are, with their unit, beside the color bar.
        colorbar : bool, optional
            Whether there is a color bar with a mark for each level, by default True.
        **options
            Options of `matplotlib.collections.LineCollection`; with ``colors="black"`` the lines
            have that color, and there is no color bar.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. The last one of ``ax.collections`` are the lines.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import rondel
        >>> x = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
        >>> lines = rondel.delaunay(x).isolines([0, 0, 0, 0, 1, -1], [-0.5, 0, 0.5])
        >>> ax = lines.plot(label="height (m)", coast=True)

        """
        return plot_isolines(self, ax, projection, coast, cmap, label, colorbar, options)

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("levels", count(len(self.levels), "level")),
            ("lines", count(len(self.is_closed), "line")),
        ]


class Bands(Traced):
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

    def _write(self, name: str | None, tolerance: float) -> bytes | None:
        return _core.write_bands(name, self._found, tolerance)

    def __setstate__(self, state: dict[str, Any]) -> None:
        Bands.__init__(self, with_arrays(_core.Bands(), state))

    def polygons(self, band: int) -> list[list[FloatArray]]:
        """The polygons of a band, each a list of rings (k, 3); without rings it is the sphere."""
        return [
            [
                self.points[slice(*_rows(self.ring_offsets, j))]
                for j in range(*_rows(self.polygon_offsets, i))
            ]
            for i in range(*_rows(self.band_offsets, band))
        ]

    def plot(
        self,
        ax: Any = None,
        *,
        projection: Any = None,
        coast: bool = True,
        cmap: Any = None,
        label: str | None = None,
        colorbar: bool = True,
        **options: Any,
    ) -> Axes:
        """Fills the bands with the colors of their values.

        Parameters
        ----------
        ax, projection
            As in `SphericalDelaunay.plot`; by default new axes.
        coast : bool, optional
            Whether to draw the coasts of the Earth on top, by default True.
        cmap : optional
            The colors of the bands, as everywhere in Matplotlib.
        label : str, optional
            What the levels are, with their unit, beside the color bar.
        colorbar : bool, optional
            Whether there is a color bar, by default True. Its ends are pointed: the first band is
            below all levels, the last one above.
        **options
            Options of the `matplotlib.collections.PathCollection` of the bands.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. ``ax.collections[0]`` are the bands if the axes are new.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import rondel
        >>> x = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
        >>> bands = rondel.delaunay(x).bands([0, 0, 0, 0, 1, -1], [-0.5, 0, 0.5])
        >>> ax = bands.plot(label="height (m)")

        """
        return plot_bands(self, ax, projection, coast, cmap, label, colorbar, options)

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("bands", count(len(self.levels) + 1, "band")),
            ("polygons", count(len(self.polygon_offsets) - 1, "polygon")),
        ]


def _rows(offsets: OffsetArray, row: int) -> tuple[int, int]:
    if not 0 <= row < len(offsets) - 1:
        raise IndexError(f"{row} is not in 0 to {len(offsets) - 2}")
    return int(offsets[row]), int(offsets[row + 1])
