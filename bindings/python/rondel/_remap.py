# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Conservative remapping: means over the cells of one partition from those over another's."""

from __future__ import annotations

import operator
from typing import Literal, NamedTuple

import numpy as np

from . import _core
from ._arrays import as_threads
from ._partition import Partition
from ._types import ArrayLike, FloatArray, IntArray, Progress
from ._weights import Weights


class Remap(NamedTuple):
    """What `remap` gives: weights with a row for each target and a column for each source, the
    cells' areas in steradians, and which share of each is covered by the other partition.
    """

    weights: Weights
    source_areas: FloatArray
    target_areas: FloatArray
    source_fractions: FloatArray
    target_fractions: FloatArray


def remap(
    source: Partition,
    target: Partition,
    *,
    order: int = 1,
    norm: Literal["destarea", "fracarea"] = "destarea",
    source_mask: ArrayLike | None = None,
    target_mask: ArrayLike | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Remap:
    """Weights that carry means over cells to means over other cells, and keep the integral.

    Jones, Mon. Weather Rev. 127, 1999, section 2.

    Parameters
    ----------
    source, target : Partition
        Parts of the sphere, or all of it.
    order : {1, 2}, optional
        1: the field is constant in each source cell. 2: it has a gradient there, by least squares
        over the neighbors.
    norm : {'destarea', 'fracarea'}, optional
        What the sum over a target is divided by: its area, so that the integral is kept, or the
        part that sources cover, so that constants are.
    source_mask, target_mask : array_like of bool, optional
        Which cells take part; by default what the partition's file says.
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    Remap
        Targets that no source covers have empty rows, so NaN.

    Raises
    ------
    InvalidInput
        If a mask has another length, or, where neither partition covers the sphere or is a grid
        of parallels, cells of both overlap.

    Examples
    --------
    >>> import numpy as np
    >>> import rondel
    >>> fine = rondel.Partition.lonlat_grid(np.linspace(-180, 180, 5), [-90, 0, 90])
    >>> coarse = rondel.Partition.lonlat_grid([-180, 0, 180], [-90, 90])
    >>> remap = rondel.remap(fine, coarse)
    >>> remap.weights.apply([1, 2, 3, 4, 5, 6, 7, 8])
    array([3.5, 5.5])

    """
    if norm not in ("destarea", "fracarea"):
        raise ValueError(f"norm must be 'destarea' or 'fracarea', not {norm!r}")
    if operator.index(order) not in (1, 2):
        raise ValueError(f"order must be 1 or 2, not {order}")
    weights, *others = _core.remap(
        source._partition,
        target._partition,
        order,
        norm == "fracarea",
        _as_mask(source_mask, source),
        _as_mask(target_mask, target),
        as_threads(threads),
        progress,
    )
    return Remap(Weights._of(weights), *others)


# An empty one: all take part.
def _as_mask(mask: ArrayLike | None, partition: Partition) -> IntArray:
    if mask is None:
        return partition._mask
    return np.ascontiguousarray(np.asarray(mask, bool).reshape(-1), np.int32)
