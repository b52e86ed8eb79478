# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Partitions that are wanted most: grids of the whole sphere, and polygons of anything."""

from __future__ import annotations

import operator
import os
from typing import Any

import numpy as np

from ._geometries import Edges, PolygonOverlap
from ._partition import Partition
from ._partition_files import Sides
from ._types import FloatArray


def lonlat_grid(
    nlon: int, nlat: int, *, sides: Sides = "parallels", threads: int | None = None
) -> Partition:
    """The cells of a grid of the whole sphere, equal in degrees.

    Parameters
    ----------
    nlon, nlat : int
        The number of cells around, from longitude -180 eastward, and from the south pole
        northward.
    sides, threads
        As in `Partition.lonlat_grid`, which takes any lines.

    Returns
    -------
    Partition
        Of shape (nlat, nlon). Lines have the digits of an exact division, rounded once.

    Examples
    --------
    >>> import rondel
    >>> rondel.lonlat_grid(360, 180).shape
    (180, 360)

    """

    def lines(cells: int, half: int, name: str) -> FloatArray:
        if operator.index(cells) < 1:
            raise ValueError(f"{name} must be at least 1, not {cells}")
        return (2 * np.arange(cells + 1) - cells) * half / cells

    return Partition.lonlat_grid(
        lines(nlon, 180, "nlon"), lines(nlat, 90, "nlat"), sides=sides, threads=threads
    )


def polygons(
    areas: Any,
    *,
    edges: Edges = "lonlat",
    overlap: PolygonOverlap = "keep",
    threads: int | None = None,
) -> Partition:
    """Polygons as cells, with holes and in several parts, from a file or from another library.

    Parameters
    ----------
    areas : path-like, GeoDataFrame, GeoSeries, sequence or mapping
        The name of a file, as `Partition.read` takes it, or what `Partition.from_geometries`
        takes.
    edges, overlap
        As in `Partition.read`.
    threads : int, optional

    Examples
    --------
    >>> import rondel
    >>> box = [[[0, 0], [90, 0], [90, 45], [0, 45], [0, 0]]]
    >>> rondel.polygons({"type": "Polygon", "coordinates": box})
    <rondel.Partition: 1 cell>

    """
    if isinstance(areas, (str, os.PathLike)):
        return Partition.read(areas, edges=edges, overlap=overlap, threads=threads)
    return Partition.from_geometries(areas, edges=edges, overlap=overlap, threads=threads)
