# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of weights, by themselves and against the areas that cells have in common."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from ._arrays import as_name, as_threads
from ._cell_set import CellSet
from ._errors import warn_caller
from ._geo import Path
from ._geometries import Corners, Edges, Invalid, Sides
from ._remap import CellOverlap, Remap, as_cell_set
from ._repr import Described, count
from ._types import IntArray, Progress
from ._weights import Weights


@dataclass(frozen=True)
class WeightFault:
    """A kind of fault in weights.

    Attributes
    ----------
    kind : str
        'missing piece', 'needless weight', 'wrong weight', 'normalization', 'row sum' ...: the
        lists are in `check_weights`.
    count : int
        How often it occurs: weights, rows, or cells.
    what : str
        One line: the number, the fault, and the first place with its value.

    """

    kind: str
    count: int
    what: str


@dataclass(frozen=True)
class ComparedRow:
    """A target whose weights are wrong.

    Attributes
    ----------
    target : int
        The row.
    lon, lat : float
        The place of the target's cell, in degrees.
    error : float
        The sum of the differences' absolute values.
    wrong : int
        How many weights of the row are wrong.
    sum, exact_sum : float
        What the weights add up to, and what they should.
    source : int
        The source whose weight is off most.
    given, exact : float
        This weight as it is given, and the right one; 0 if there is none.

    """

    target: int
    lon: float
    lat: float
    error: float
    wrong: int
    sum: float
    exact_sum: float
    source: int
    given: float
    exact: float


@dataclass(frozen=True, eq=False)
class WeightComparison:
    """Weights beside the areas that cells of both sides have in common.

    Attributes
    ----------
    norm : {'unknown', 'either', 'destarea', 'fracarea', 'area'}
        What areas are divided by in most rows: the area of the target, the part of it that sources
        cover, or nothing; 'either' if sources cover all targets.
    sums_only : bool
        Whether the weights are of second order, so that sums alone are compared.
    pieces : int
        How many pairs of cells have an area in common.
    wrong, missing, needless : int
        How many weights are other numbers, are not there, and are of cells without a common area.
    max_error, mean_error, rms_error : float
        The largest difference of a weight, the mean of their absolute values and the root of their
        mean square.
    errors : ndarray of int64, shape (18,)
        How many differences are below 1e-16, from there to 1e-15, and so on, and from 1 on.
    row_sums : float
        The largest difference of the sum of a row.
    local_conservation, global_conservation : float
        The largest difference of the area that a source gives away, relative to its own; and that
        of all sources together, relative to the area in common.
    source_areas, target_areas : float or None
        The largest relative difference of areas that come with the weights.
    worst_rows : tuple of ComparedRow
        The rows with the largest errors, ten at most.

    """

    norm: str
    sums_only: bool
    pieces: int
    wrong: int
    missing: int
    needless: int
    max_error: float
    mean_error: float
    rms_error: float
    errors: IntArray
    row_sums: float
    local_conservation: float
    global_conservation: float
    source_areas: float | None
    target_areas: float | None
    worst_rows: tuple[ComparedRow, ...]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, WeightComparison) and self._values() == other._values()

    def __hash__(self) -> int:
        return hash(self._values())

    def _values(self) -> tuple[Any, ...]:
        """All members in a form that can be compared."""
        return tuple({**vars(self), "errors": tuple(self.errors.tolist())}.values())


@dataclass(frozen=True, repr=False)
class WeightReport(Described):
    """The result of `check_weights`; it is true if nothing is wrong.

    Attributes
    ----------
    faults : tuple of WeightFault
        One for each kind that occurs.
    rows, columns, entries, empty_rows : int
        The numbers of targets, of sources, of weights, and of targets without weights.
    least, greatest : float
        The range of the weights.
    row_sums : float
        The largest difference of the sum of a row from what the file says it should be.
    column_sums : float or None
        The largest relative difference of the area that a source gives away, by the areas that
        come with the weights.
    method, normalization : str
        What the file says of them.
    comparison : WeightComparison or None
        What the cells say of the weights, if they are given.

    """

    faults: tuple[WeightFault, ...]
    rows: int
    columns: int
    entries: int
    empty_rows: int
    least: float
    greatest: float
    row_sums: float
    column_sums: float | None
    method: str
    normalization: str
    comparison: WeightComparison | None

    def __bool__(self) -> bool:
        return not self.faults

    def count(self, kind: str) -> int:
        """How often a kind of fault occurs.

        Parameters
        ----------
        kind : str
            One of those of `check_weights`.

        """
        return sum(fault.count for fault in self.faults if fault.kind == kind)

    def _facts(self) -> list[tuple[str, str]]:
        wrong = "; ".join(fault.what for fault in self.faults)
        return [("weights", count(self.entries, "weight")), ("faults", wrong or "no fault")]


def check_weights(
    weights: Path | Weights | Remap,
    source: Any = None,
    target: Any = None,
    *,
    allow_negative: bool = False,
    tolerance: float = 1e-9,
    sides: Sides = "parallels",
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    corners: Corners = "error",
    overlap: CellOverlap = "error",
    threads: int | None = None,
    progress: Progress = None,
) -> WeightReport:
    """Finds what is wrong with weights of this library or of another program.

    Without cells, the sums of rows and columns, fractions, areas and masks are held against each
    other. With the cells of both sides, each conservative weight is compared with the area that
    its two cells have in common.

    Parameters
    ----------
    weights : path-like, Weights or Remap
        A file of ESMF, SCRIP (CDO), TempestRemap, SciPy (.npz) or, with cells, YAC; or weights in
        memory.
    source, target : CellSet, str, path-like or what `remap` takes, optional
        The cells for which the weights were made, in their order: objects, the name of a grid, or
        a file for `CellSet.read`. Both are given, or neither.
    allow_negative : bool, optional
        Whether negative weights are right for any method; by default False.
    tolerance : float, optional
        How far a weight may be from the right one, beside the rounding of areas; by default 1e-9.
    sides, edges, invalid, corners
        How cells of files are read, as in `CellSet.read`; `sides` also for names of grids.
    overlap : {'error', 'first', 'share', 'each'}, optional
        What becomes of cells of one side that overlap, as in `remap`. With 'each' fractions of
        sources may be above 1, since several targets have one place.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    WeightReport
        The faults and figures; it is true if nothing is wrong. Kinds of faults without cells: 'not
        finite', 'repeated', 'row sum', 'column sum', 'negative', 'target fraction', 'source
        fraction', 'target area', 'source area', 'masked target', 'masked source', 'missing row',
        'conservation', 'numbering'. With cells also 'missing piece', 'needless weight', 'wrong
        weight', 'normalization', 'target place', 'source place'.

    Raises
    ------
    OSError
        If a file cannot be read.
    ValueError
        If one side alone is given, the numbers of cells are not those of the weights, or the method
        is not conservative; `InvalidInput` if cells overlap.

    Notes
    -----
    A weight of a target of area A with m entries is wrong if it is off by more than
    ``tolerance + (m + 1) 8 pi 2**-52 / A``. Weights of second order depend on gradients: for these
    sums of rows and areas of sources are compared.

    Examples
    --------
    >>> import rondel
    >>> remap = rondel.remap("grid:30", "healpix:1")
    >>> report = rondel.check_weights(remap, "grid:30", "healpix:1")
    >>> report
    <rondel.WeightReport: 224 weights, no fault>
    >>> report.comparison.norm, report.comparison.max_error < 1e-15
    ('either', True)

    """
    if (source is None) != (target is None):
        raise ValueError("source and target are given together")
    cells = None
    if source is not None:
        cells = tuple(
            _cells_of(side, sides, edges, invalid, corners, overlap, threads)
            for side in (source, target)
        )
    if isinstance(weights, Weights):
        file = _core.WeightFile(weights._weights)
    elif isinstance(weights, Remap):
        file = _core.weight_file(weights._made())
    else:
        numbers = (0, 0) if cells is None else (cells[0].num_cells, cells[1].num_cells)
        file = _core.read_weights_to_check(as_name(weights), *numbers)
        for remark in file.remarks:
            warn_caller(f"{as_name(weights)}: {remark}")
    found = _core.check_weights(file, allow_negative, cells is not None, overlap == "each")
    faults = list(found.faults)
    comparison = None
    if cells is not None:
        compared = _core.compare_weights(
            file,
            cells[0]._cells,
            cells[1]._cells,
            tolerance,
            overlap,
            as_threads(threads),
            progress,
        )
        faults += compared.faults
        comparison = _comparison_of(compared)
    rows, columns, entries = file.shape
    return WeightReport(
        tuple(_fault_of(fault) for fault in faults),
        rows,
        columns,
        entries,
        found.empty_rows,
        found.least,
        found.greatest,
        found.row_sums,
        found.column_sums,
        file.method,
        file.normalization,
        comparison,
    )


def _fault_of(fault: _core.WeightFault) -> WeightFault:
    return WeightFault(fault.kind, fault.count, fault.what)


def _comparison_of(made: _core.WeightComparison) -> WeightComparison:
    def count_of(kind: str) -> int:
        return sum(fault.count for fault in made.faults if fault.kind == kind)

    rows = tuple(
        ComparedRow(*(getattr(row, name) for name in ComparedRow.__dataclass_fields__))
        for row in made.worst_rows
    )
    return WeightComparison(
        made.norm,
        made.sums_only,
        made.pieces,
        count_of("wrong weight"),
        count_of("missing piece"),
        count_of("needless weight"),
        made.max_error,
        made.mean_error,
        made.rms_error,
        np.array(made.errors, np.int64),
        made.row_sums,
        made.local_conservation,
        made.global_conservation,
        made.source_areas,
        made.target_areas,
        rows,
    )


def _cells_of(
    side: Any,
    sides: Sides,
    edges: Edges,
    invalid: Invalid,
    corners: Corners,
    overlap: str,
    threads: int | None,
) -> CellSet:
    """The cells of an object, of the name of a grid, or of a file."""
    if isinstance(side, str) and _core.is_grid_name(side):
        return CellSet.named(side, sides=sides, threads=threads)
    if not isinstance(side, (str, os.PathLike)):
        return as_cell_set(side, threads)
    return CellSet.read(
        side,
        sides=sides,
        edges=edges,
        overlap="error" if overlap == "error" else "keep",
        invalid=invalid,
        corners=corners,
        threads=threads,
    )
