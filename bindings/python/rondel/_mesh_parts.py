# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Removed cells and fixed sites of meshes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias, cast

import numpy as np

from . import _core
from ._arrays import as_points, as_threads, require_unmasked
from ._geometries import Edges, Invalid, features_of, is_file
from ._regions import as_cell_set
from ._types import ArrayLike, FloatArray, Path

Lines: TypeAlias = Path | Sequence[ArrayLike] | Any


def removed_cells(
    points: FloatArray,
    mask: ArrayLike | None,
    inside: Any,
    outside: Any,
    edges: Edges,
    invalid: Invalid,
    threads: int | None,
) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """Returns 1 for each cell that is removed, else 0."""
    if mask is None and inside is None and outside is None:
        raise TypeError("cull() needs mask, inside or outside")
    removed = np.zeros(len(points), bool)
    if mask is not None:
        require_unmasked(mask, "mask")
        given = np.asarray(mask)
        if given.shape != removed.shape:
            raise ValueError(f"mask has the shape {given.shape}, not {removed.shape}")
        if not np.isin(given, (0, 1)).all():
            raise ValueError("mask has other values than 0 and 1")
        removed |= given.astype(bool)
    for regions, value in ((inside, 1), (outside, 0)):
        if regions is None:
            continue
        polygons = as_cell_set(regions, edges, "keep", invalid, threads)._cells
        found = _core.points_inside(points, polygons, as_threads(threads))
        removed |= found == value
    return removed.astype(np.uint8)


def fixed_points(
    fixed: ArrayLike | Lines | None,
    along: Lines | None,
    edges: Edges,
    count: int,
    spacings: FloatArray,
    steps: int,
    gradient: float,
    threads: int | None,
) -> tuple[FloatArray, int]:
    """Returns the fixed places, and the number of those on and beside lines that are left out."""
    rules = count, spacings, steps, gradient, as_threads(threads)

    def read(features: Any, places: Callable[[str | bytes, Edges, int], list[FloatArray]]) -> Any:
        return features_of(features, edges, lambda name: places(name, edges, rules[-1]))

    found = []
    left_out = 0
    if fixed is not None and not _are_features(fixed):
        found.append(as_points(cast(ArrayLike, fixed), "fixed"))
    elif fixed is not None:
        sites, left_out = _core.sites_on(read(fixed, _core.read_places), *rules)
        found.append(sites)
    if along is not None:
        if _are_features(along):
            lines = read(along, _core.read_lines)
        else:
            lines = [as_points(line, "a line") for line in cast(Sequence[ArrayLike], along)]
        rows, beside = _core.sites_along(lines, *rules)
        found.append(rows)
        left_out += beside
    return np.ascontiguousarray(np.concatenate(found or [np.empty((0, 3))])), left_out


def _are_features(lines: Any) -> bool:
    """Whether they are a file or geometries, rather than points or the points of each line."""
    if is_file(lines) or _is_geometry(lines) or hasattr(lines, "__arrow_c_stream__"):
        return True
    return isinstance(lines, Sequence) and any(map(_is_geometry, lines))


def _is_geometry(item: Any) -> bool:
    return isinstance(item, Mapping) or hasattr(item, "__geo_interface__")
