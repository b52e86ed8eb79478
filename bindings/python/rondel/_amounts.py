# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sums over cells, such as people per cell, of which each target gets its share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from . import _core
from ._errors import warn_caller
from ._second_order import SecondOrderWeights
from ._types import ArrayLike, FloatArray
from ._weights import Weights


class WeightsOfSums:
    """Conservative weights that are applied to the densities of sums over cells; the densities at
    targets become sums again. A part of a target with a value is enough, so that sums are kept.
    """

    def __init__(
        self, weights: Weights | SecondOrderWeights, sources: FloatArray, targets: FloatArray
    ) -> None:
        # `sources` are the areas of the sources, `targets` those that weights were divided by.
        self._weights, self._sources, self._targets = weights, sources, targets

    @property
    def shape(self) -> tuple[int, int]:
        return self._weights.shape

    @property
    def indptr(self) -> Any:
        return self._weights.indptr

    def _of_rows(self, rows: Any) -> WeightsOfSums:
        """The weights of some targets."""
        return WeightsOfSums(self._weights._of_rows(rows), self._sources, self._targets[rows])

    def apply(
        self,
        values: ArrayLike,
        *,
        skipna: bool = False,
        max_missing: float = 1.0,
        how: Literal["sum", "largest_share"] = "sum",
    ) -> FloatArray:
        """As `Weights.apply`; rules for missing values have no effect."""
        areas = np.where(self._sources > 0, self._sources, np.nan)
        found = self._weights._apply_sums(np.asarray(values, np.float64) / areas)
        found *= self._targets
        return found


def weights_of_sums(made: _core.Remap, weights: Weights, applied: Any) -> WeightsOfSums:
    """Those of a remapping, whose weights for all targets these are; those that are applied to
    other fields have the pieces of order 2.
    """
    targets = np.array(made.target_areas, np.float64)
    if made.norm == "fracarea":
        targets *= made.target_fractions
    sources = np.array(made.source_areas, np.float64)
    if isinstance(applied, SecondOrderWeights):
        return WeightsOfSums(applied._with_rows_of(weights), sources, targets)
    return WeightsOfSums(weights, sources, targets)


@dataclass
class OverCells:
    """What is done over the cells of fields, which their attribute `cell_methods` tells."""

    method: str = ""  # "mean" for conservative weights; empty for values at places
    sums: WeightsOfSums | None = None  # what keeps sums; None if nothing does
    vectors: frozenset[str] = field(default_factory=frozenset)  # components, which are no sums
    are_told: bool = True  # whether a warning tells of sums that are not kept
    is_extrapolated: bool = False  # whether targets without values get some, but no sums

    def has_sums(self, array: Any, dims: Iterable[Any], *, is_largest: bool) -> bool:
        """Whether the array has sums over cells that are kept, which values of the largest part do
        not; a warning tells of others.
        """
        name = str(array.name)
        text = str(array.attrs.get("cell_methods", ""))
        if not self.are_told or not _core.are_sums_over_cells(text, [str(dim) for dim in dims]):
            return False
        are_kept = self.sums is not None and name not in self.vectors and not is_largest
        about = f"{'the data' if array.name is None else name} has sums over cells, by cell_methods"
        if not are_kept:
            warn_caller(
                f"{about}: only rondel.regrid with conservative methods keeps them, of scalars"
            )
        elif self.is_extrapolated:
            warn_caller(f"{about}, which are not extrapolated")
        return are_kept

    def methods(self, text: str, method: str, dims: Iterable[Any]) -> str:
        """The attribute `cell_methods` after a method; a `Regridder` adds none."""
        if not self.method or (self.sums is None and not text):
            return text
        return str(_core.with_cell_method(text, method, [str(dim) for dim in dims]))
