# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights of second order for fields that lack values, whose gradients end at the gaps."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from . import _core
from ._arrays import as_fields, as_threads
from ._cell_set import CellSet
from ._remap import SlopeLimiter
from ._types import ArrayLike, BoolArray, FloatArray
from ._weights import Weights, rows_of

# Arrays of the pieces of targets, and those of targets and of sources.
_PIECES = ("columns", "areas", "moments")
_TARGETS = ("target_areas", "target_fractions")
_SOURCES = ("source_areas", "source_fractions", "source_centers")


class SecondOrderWeights:
    """Weights that are applied as `Weights` where no value is missing, and otherwise as those of
    the fields with the same gaps (`SecondOrderRemap` of the library). With the limiter 'slopes' the
    slopes of each field are limited. Rows of targets that are not covered, which may be
    extrapolated, are applied as they are.
    """

    def __init__(
        self,
        weights: Weights,
        covered: BoolArray,
        source: CellSet,
        norm: str,
        arrays: dict[str, Any],
        limiter: SlopeLimiter = "none",
    ) -> None:
        self._weights, self._covered, self._limiter = weights, covered, limiter
        self._source, self._norm, self._arrays = source, norm, arrays
        self._made: _core.SecondOrderRemap | None = None

    @classmethod
    def of(
        cls,
        made: _core.Remap,
        source: CellSet,
        weights: Weights,
        covered: BoolArray,
        limiter: SlopeLimiter = "none",
    ) -> SecondOrderWeights:
        """Those of a remapping of order 2 of some cells, but for its weights."""
        names = ("offsets", *_PIECES, *_TARGETS, *_SOURCES)
        arrays = {name: getattr(made, name) for name in names}
        return cls(weights, covered, source, made.norm, arrays, limiter)

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_made": None}

    @property
    def shape(self) -> tuple[int, int]:
        return self._weights.shape

    @property
    def indptr(self) -> Any:
        return self._weights.indptr

    def _with_rows_of(self, weights: Weights) -> SecondOrderWeights:
        """The same with the weights of all targets, also those that are covered too little."""
        covered = np.diff(weights.indptr) > 0
        return self._with(weights, covered, self._arrays)

    def _with(
        self, weights: Weights, covered: BoolArray, arrays: dict[str, Any]
    ) -> SecondOrderWeights:
        source, norm, limiter = self._source, self._norm, self._limiter
        return SecondOrderWeights(weights, covered, source, norm, arrays, limiter)

    def _of_rows(self, rows: Any) -> SecondOrderWeights:
        """The weights of some targets."""
        offsets = self._arrays["offsets"]
        taken, entries = rows_of(offsets, rows)
        arrays = {"offsets": taken}
        arrays |= {name: self._arrays[name][entries] for name in _PIECES}
        arrays |= {name: self._arrays[name][rows] for name in _TARGETS}
        arrays |= {name: self._arrays[name] for name in _SOURCES}
        return self._with(self._weights._of_rows(rows), self._covered[rows], arrays)

    def apply(
        self,
        values: ArrayLike,
        *,
        skipna: bool = False,
        max_missing: float = 1.0,
        how: Literal["sum", "largest_share"] = "sum",
        threads: int | None = None,
    ) -> FloatArray:
        """As `Weights.apply`."""
        rules: Any = {"skipna": skipna, "max_missing": max_missing, "threads": threads}
        fields = as_fields(values, self.shape[1])
        if how != "sum" or self._are_for(fields):
            return self._weights.apply(fields, how=how, **rules)
        found = self._apply_with_gaps(fields, float(max_missing) if skipna else 0.0, threads)
        others = ~self._covered & (np.diff(self.indptr) > 0)
        if others.any():
            numbers = np.flatnonzero(others)
            found[..., numbers] = self._weights._of_rows(numbers).apply(fields, **rules)
        return found

    def _are_for(self, fields: FloatArray) -> bool:
        """Whether the weights are those of all of these fields."""
        return self._limiter == "none" and not np.isnan(fields).any()

    def _apply_sums(self, values: FloatArray) -> FloatArray:
        """As that of `Weights`."""
        fields = as_fields(values, self.shape[1])
        if self._are_for(fields):
            return self._weights._apply_sums(fields)
        return self._apply_with_gaps(fields, 1.0, None, keeps_sums=True)

    def _apply_with_gaps(
        self,
        fields: FloatArray,
        max_missing: float,
        threads: int | None,
        *,
        keeps_sums: bool = False,
    ) -> FloatArray:
        """The values at the targets of fields whose gradients end at missing values."""
        if self._made is None:
            covered = np.ascontiguousarray(self._covered, np.int32)
            weights = self._weights._weights
            self._made = _core.SecondOrderRemap(self._remap(), weights, covered, self._limiter)
        leading = fields.shape[:-1]
        found: FloatArray = self._made.apply(
            fields.reshape(int(np.prod(leading)), self.shape[1]),
            self.shape[0],
            np.nan,
            max_missing,
            as_threads(threads),
            keeps_sums,
        )
        return found.reshape((*leading, self.shape[0]))

    def _remap(self) -> _core.Remap:
        made = _core.Remap()
        made.source, made.order, made.norm = self._source._cells, 2, self._norm
        for name, array in self._arrays.items():
            setattr(made, name, np.ascontiguousarray(array))
        return made
