# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The part of `CellSet` that reads cells from files and from other libraries."""

from __future__ import annotations

import os
import warnings
from typing import Any, Literal, TypeAlias, TypeVar

import numpy as np

from . import _core
from ._arrays import as_threads
from ._geo import Path, write_named
from ._geometries import Edges, PolygonOverlap, Polygons, polygons_of, read_polygons
from ._pickled import arrays_of, with_arrays
from ._types import FloatArray, IntArray

Sides: TypeAlias = Literal["parallels", "great_circles"]
Made = TypeVar("Made", bound="FileCells")


class FileCells:
    """The data of a `CellSet`, and the functions that read it."""

    _cells: _core.CellSet
    _mask: IntArray
    _shape: tuple[int, ...]
    _axes: tuple[FloatArray, FloatArray] | None
    _file_centers: FloatArray | None
    _has_corners: bool  # which files of weights get
    _columns: _core.CellColumns | None  # the properties of polygons
    # The name of the function of the library that made the cells, and what it got; None if they are
    # made of their rings.
    _origin: tuple[Any, ...] | None

    @classmethod
    def _of(
        cls: type[Made],
        partition: _core.CellSet,
        mask: IntArray | None = None,
        shape: tuple[int, ...] = (),
        axes: tuple[FloatArray, FloatArray] | None = None,
        file_centers: FloatArray | None = None,
        has_corners: bool = True,
        columns: _core.CellColumns | None = None,
        origin: tuple[Any, ...] | None = None,
    ) -> Made:
        self = cls.__new__(cls)
        self._cells = partition
        self._mask = np.zeros(0, np.int32) if mask is None else mask
        self._shape = shape
        self._axes = axes
        self._file_centers = file_centers
        self._has_corners = has_corners
        self._columns = columns
        self._origin = origin
        return self

    # Cells of a triangulation or a grid are made again, so that they are the same bit by bit.
    def __getstate__(self) -> dict[str, Any]:
        state = dict(self.__dict__)
        state["_cells"] = None if self._origin else self._cells.given_rings()
        state["_columns"] = self._columns and arrays_of(self._columns)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        columns = state["_columns"]
        self._columns = columns and with_arrays(_core.CellColumns(), columns)
        if self._origin is None:
            cells, rings, corners, points, whole = state["_cells"]
            self._cells = _core.CellSet.from_rings(cells, rings, corners, points, whole, 0)
            return
        name, *given = self._origin
        if name != "lonlat_grid":
            given = [given[0]._triangulation]
        self._cells = getattr(_core.CellSet, name)(*given, 0)

    @classmethod
    def _of_polygons(cls: type[Made], polygons: Polygons) -> Made:
        return cls._of(polygons[0], columns=polygons[1])

    @classmethod
    def read(
        cls: type[Made],
        path: Path,
        *,
        sides: Sides = "parallels",
        edges: Edges = "lonlat",
        overlap: PolygonOverlap = "keep",
        threads: int | None = None,
    ) -> Made:
        """Reads the cells of a file.

        Parameters
        ----------
        path : path-like
            A netCDF file with the conventions of UGRID, SCRIP, ESMF, MPAS, ICON or CF, or a
            ``.geojson`` file whose features are the cells. netCDF-4 is read by the library that
            the package netCDF4 brings. If the file has several grids, ``FILE.nc:NAME`` names a
            variable of a grid, or one with values on it.
        sides : {'parallels', 'great_circles'}, optional
            As in `lonlat_grid`, for grids whose coordinates are axes; by default 'parallels'.
        edges : {'lonlat', 'geodesic'}, optional
            What joins positions of polygons: straight lines in longitude and latitude as in RFC
            7946 (default), or great circles.
        overlap : {'keep', 'error', 'first'}, optional
            What to do with a place that several features contain: 'keep' (default) makes cells that
            overlap there, 'error' raises an error that names two of them, 'first' gives the place
            to the first one.
        threads : int, optional
            The largest number of threads; by default one for each core. The result does not depend
            on it.

        Returns
        -------
        CellSet
            The cells, in the order of the file.

        Raises
        ------
        OSError
            If the file cannot be read. The message says what is wrong in it: rings that cross,
            holes outside of their polygon, parts that overlap.

        Warns
        -----
        UserWarning
            If cells are masked, or are left out because of missing corners (with their number), or
            if one of several grids was read.

        """
        name = os.fspath(path)
        count_of_threads = as_threads(threads)
        if name.lower().endswith((".geojson", ".json")):
            return cls._of_polygons(read_polygons(name, edges, overlap, count_of_threads))
        found: list[Any] = []
        write_named(
            name,
            lambda name: found.extend(_core.read_cell_set(name, sides, count_of_threads)),
        )
        partition, mask, shape, centers, remarks, *lines = found
        origin = ("lonlat_grid", *lines, sides) if len(lines[0]) else None
        for remark in remarks:
            warnings.warn(f"{name}: {remark}", UserWarning, stacklevel=2)
        places = centers if len(centers) else None
        return cls._of(partition, mask, shape, file_centers=places, origin=origin)

    @classmethod
    def from_geometries(
        cls: type[Made],
        geometries: Any,
        *,
        edges: Edges = "lonlat",
        overlap: PolygonOverlap = "keep",
        threads: int | None = None,
    ) -> Made:
        """Makes cells of polygons of other libraries, which may have holes and several parts.

        Parameters
        ----------
        geometries : GeoDataFrame, GeoSeries, sequence or mapping
            The polygons, one a cell: a GeoDataFrame or GeoSeries; a sequence of geometries of
            shapely; a mapping of GeoJSON, or any object with `__geo_interface__`; arrays or tables
            of GeoArrow; or a box of west, south, east and north in degrees. Projected coordinates
            are converted to longitudes and latitudes by their `crs`; sides that are straight in the
            projection get corners in between, which follow them to about 1e-4 degrees.
        edges, overlap
            As in `read`.
        threads : int, optional
            The largest number of threads; by default one for each core. The result does not depend
            on it.

        Returns
        -------
        CellSet
            A cell for each geometry.

        Raises
        ------
        ValueError
            If a geometry is not a polygon, is not valid, or has positions that are no longitudes
            and latitudes. The message has its number.

        """
        return cls._of_polygons(polygons_of(geometries, edges, overlap, as_threads(threads)))
