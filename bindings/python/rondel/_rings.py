# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons of flat arrays on maps."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from . import _core
from ._pickled import with_arrays
from ._projection import LonLatMap
from ._types import ArrayLike, FloatArray, IntArray

BEND = 0.1  # degrees: the largest distance of what is drawn from arcs
# Filled areas hide the seams between them.
FILLED: dict[str, Any] = {"edgecolors": "face", "linewidths": 0.2}


def polygon_rings(
    rings: ArrayLike, corners: ArrayLike, points: FloatArray, cells: ArrayLike | None = None
) -> _core.CellRings:
    """Cells for `draw_rings`, as `CellSet.polygons` takes them; by default each ring is one."""
    rings = np.asarray(rings, np.int64)
    each = np.arange(len(rings)) if cells is None else cells
    given = {
        "cells": np.asarray(each, np.int64),
        "rings": rings,
        "corners": np.asarray(corners, np.int32),
        "points": np.ascontiguousarray(points),
    }
    return with_arrays(_core.CellRings(), given)


def draw_rings(
    drawn: LonLatMap, rings: _core.CellRings, values: Any, options: dict[str, Any]
) -> Any:
    """The collection of the cells as polygons with holes, cut where the map ends; in the colors of
    values, one a cell, if there are any.
    """
    drawings = rings.polygons(BEND, 0)
    lines = np.split(drawings.positions, drawings.rings[1:-1])
    areas = [lines[a:b] for a, b in pairwise(drawings.polygons)]
    numbers = None if values is None else np.asarray(values)[drawings.owners]
    return drawn.draw_areas(areas, numbers, options)


def draw_triangles(
    drawn: LonLatMap, triangles: IntArray, points: FloatArray, values: Any, cmap: Any
) -> Any:
    """The collection of triangles of unit vectors, in the colors of values, one each."""
    rings = polygon_rings(3 * np.arange(len(triangles) + 1), triangles.ravel(), points)
    return draw_rings(drawn, rings, values, {**FILLED, "cmap": cmap})
