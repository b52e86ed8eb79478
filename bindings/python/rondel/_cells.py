# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The cells that are wanted most: grids of the whole sphere, and polygons of anything."""

from __future__ import annotations

import operator
import os
from typing import Any

from . import _core
from ._arrays import as_threads
from ._cell_set import CellSet
from ._geometries import Edges, Invalid, PolygonOverlap, Sides


def lonlat_grid(
    nlon: int, nlat: int, *, sides: Sides = "parallels", threads: int | None = None
) -> CellSet:
    """Makes the cells of a regular longitude-latitude grid of the whole sphere.

    Parameters
    ----------
    nlon, nlat : int
        The number of cells in a row, from longitude -180 eastward, and of rows, from the south pole
        northward. Cells are 360 / nlon by 180 / nlat degrees large.
    sides, threads
        As in `CellSet.lonlat_grid`.

    Returns
    -------
    CellSet
        Cells of the shape (nlat, nlon), in C order. Lines and centers are exact
        quotients, rounded once.

    Raises
    ------
    ValueError
        If a number is not positive.

    See Also
    --------
    CellSet.lonlat_grid : the same with any lines.

    Examples
    --------
    >>> import rondel
    >>> rondel.lonlat_grid(360, 180).shape
    (180, 360)

    """
    for cells, name in ((nlon, "nlon"), (nlat, "nlat")):
        if operator.index(cells) < 1:
            raise ValueError(f"{name} must be at least 1, not {cells}")
    return CellSet._of(_core.CellSet.global_grid(nlon, nlat, sides, as_threads(threads)))


def polygons(
    areas: Any,
    *,
    edges: Edges = "lonlat",
    overlap: PolygonOverlap = "keep",
    invalid: Invalid = "error",
    threads: int | None = None,
) -> CellSet:
    """Makes cells of polygons in a file or of another library.

    Parameters
    ----------
    areas : path-like, GeoDataFrame, GeoSeries, sequence or mapping
        The polygons, one a cell, which may have holes and several parts: the name of a GeoJSON
        file; or a GeoDataFrame, a GeoSeries, geometries of shapely, mappings of GeoJSON, or a box
        of west, south, east and north in degrees, as `CellSet.from_geometries` takes them.
    edges, overlap, invalid, threads
        As in `CellSet.read`.

    Returns
    -------
    CellSet
        A cell for each polygon, for `remap` or `SphericalVoronoi.clip`.

    Raises
    ------
    ValueError
        If a geometry is not a polygon, is not valid, or has positions that are no longitudes and
        latitudes; the message has its number.
    OSError
        If the file cannot be read, or one of its polygons is not valid.

    Examples
    --------
    >>> import rondel
    >>> box = [[[0, 0], [90, 0], [90, 45], [0, 45], [0, 0]]]
    >>> rondel.polygons({"type": "Polygon", "coordinates": box})
    <rondel.CellSet: 1 cell>

    """
    make: Any = CellSet.read if isinstance(areas, (str, os.PathLike)) else CellSet.from_geometries
    cells: CellSet = make(areas, edges=edges, overlap=overlap, invalid=invalid, threads=threads)
    return cells
