# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights as groups of Zarr arrays (version 3) with ESMF's names, by zarr-python.

A chunk has the entries of consecutive targets, as many as have room, so that a block of targets is
read from the chunks of its own entries alone, and chunks can be read beside each other. What is
left of a chunk are entries of the weight 0 at a pair that has an entry, which change no value:
programs that read `S`, `row` and `col` need not know of chunks.

The functions that take `self` or `cls` are methods of `Weights` and `Remap`; `Regridder` has one
that calls the last writer.
"""

from __future__ import annotations

import dataclasses
import operator
import os
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import _core
from ._arrays import as_floats, degrees_of
from ._types import ArrayLike, BoolArray, FloatArray, Path
from ._ugrid import MAKER
from ._zarr import chunk_rows, require_zarr
from ._zarr_folder import replaced

ENTRIES = 1 << 20  # of a chunk
_SIDES = ("a", "b")  # ESMF's letters of sources and targets


def weights_to_zarr(
    self: Any,
    path: Path,
    *,
    sites: ArrayLike | None = None,
    targets: ArrayLike | None = None,
    method: str = "",
    entries_per_chunk: int = ENTRIES,
) -> None:
    """Writes a group of Zarr arrays (version 3), a folder, with ESMF's names.

    `S`, `row` and `col` (from 1) have the entries, target by target; `row_begin`, shape (m + 1,),
    counts those before each target, and `chunk_row` has the first target of each chunk, and m. A
    chunk has the entries of whole targets, and ends with entries of the weight 0. The group appears
    complete or not at all, and replaces one that Rondel made.

    Parameters
    ----------
    path : path_like
        The folder; a name that ends in `.zarr` is usual.
    sites, targets : array_like, shape (n, 3) and (m, 3), optional
        The places of both sides, which are stored as longitudes and latitudes in degrees, `xc_a`,
        `yc_a`, `xc_b`, `yc_b`; only directions from the origin are used.
    method : str, optional
        The name of the method in the group.
    entries_per_chunk : int, optional
        The number of entries of a chunk, 2^20 by default, or as many as a target has, if these are
        more.

    Raises
    ------
    ImportError
        If zarr-python 3 or later is not installed.
    ValueError
        If the points are not those of the weights, or a chunk has no entries.
    OSError
        If the folder cannot be written, or is one that must not be replaced; then nothing is
        changed.

    """
    arrays: dict[str, Any] = {}
    for letter, name, points, number, known in (
        ("a", "sites", sites, self.shape[1], self.sites_hash),
        ("b", "targets", targets, self.shape[0], self.targets_hash),
    ):
        if points is None:
            places = self._places["ab".index(letter)]
        else:
            if np.shape(points)[-1:] != (3,) or np.size(points) != 3 * number:
                raise ValueError(f"{name} must be {number} points, not of shape {np.shape(points)}")
            if known and not self.is_of(**{name: points}):
                raise ValueError(f"the {name} are not those of the weights")
            places = degrees_of(as_floats(points, name).reshape(-1, 3))
        arrays |= _arrays_of_places(letter, places)
    _write(path, self, arrays, {"map_method": method, "normalization": "none"}, entries_per_chunk)


def remap_to_zarr(self: Any, path: Path, *, entries_per_chunk: int = ENTRIES) -> None:
    """Writes a group of Zarr arrays (version 3), a folder, with ESMF's names.

    The entries are those of `Weights.to_zarr`. Beside them are the centers of the cells of both
    sides in degrees (`xc_a`, `yc_a`, `xc_b`, `yc_b`), areas in steradians, covered fractions, masks
    and the lengths of grids.

    Parameters
    ----------
    path : path_like
        The folder; a name that ends in `.zarr` is usual.
    entries_per_chunk : int, optional
        As in `Weights.to_zarr`.

    Raises
    ------
    ImportError
        If zarr-python 3 or later is not installed.
    OSError
        If the folder cannot be written, or is one that must not be replaced; then nothing is
        changed.

    """
    sides = (
        ("a", "src", self.source, self.source_areas, self.source_fractions),
        ("b", "dst", self.target, self.target_areas, self.target_fractions),
    )
    arrays: dict[str, Any] = {}
    says: dict[str, Any] = {"map_method": "Conservative remapping", "normalization": self._norm}
    for letter, name, cells, areas, fractions in sides:
        arrays |= _arrays_of_places(letter, cells._degrees())
        arrays[f"area_{letter}"] = _core.told_areas(cells._cells, areas), {"units": "steradian"}
        arrays[f"frac_{letter}"] = fractions, {"units": "1"}
        arrays[f"mask_{letter}"] = cells.mask.astype(np.int32), {"units": "1"}
        arrays[f"{name}_grid_dims"] = np.array(cells.shape[::-1], np.int32), {}
        grid = cells._cells.facts.name
        if _core.is_grid_name(grid):
            says[f"rondel_grid_{letter}"] = grid
    _write(path, self.weights, arrays, {**says, "order": self._order}, entries_per_chunk)


def write_between_places(
    path: Path,
    weights: Any,
    sides: tuple[Any, Any],
    method: str,
    norm: str,
    entries_per_chunk: int,
) -> None:
    """Writes the weights of a `Regridder`; `sides` are the `Places` of sources and targets."""
    arrays: dict[str, Any] = {}
    for letter, name, places in zip(_SIDES, ("src", "dst"), sides, strict=True):
        arrays |= _arrays_of_places(letter, places.pairs())
        mask = places.mask()
        kept = np.ones(places.lon.size, np.int32) if mask is None else mask.reshape(-1)
        arrays[f"mask_{letter}"] = kept.astype(np.int32), {"units": "1"}
        arrays[f"{name}_grid_dims"] = np.array(places.shape[::-1], np.int32), {}
    says = {"map_method": method, "normalization": norm}
    _write(path, weights, arrays, says, entries_per_chunk)


def _arrays_of_places(letter: str, places: FloatArray) -> dict[str, Any]:
    if len(places) == 0:
        return {}
    degrees = np.ascontiguousarray(places)
    return {
        f"{axis}c_{letter}": (degrees[:, k], {"units": "degrees"}) for k, axis in enumerate("xy")
    }


def _blocks(indptr: Any, most: int) -> list[int]:
    """The first target of each chunk, and the number of targets: whole rows of `most` entries."""
    begins = [0]
    while begins[-1] < len(indptr) - 1:
        begin = begins[-1]
        end = int(np.searchsorted(indptr, indptr[begin] + most, side="right")) - 1
        begins.append(max(end, begin + 1))
    return begins


def _write(
    path: Path, weights: Any, arrays: dict[str, Any], says: dict[str, Any], per_chunk: int
) -> None:
    zarr = require_zarr()
    per_chunk = operator.index(per_chunk)
    if per_chunk < 1:
        raise ValueError(f"entries_per_chunk must be 1 or more, not {per_chunk}")
    indptr = weights.indptr
    number = len(weights.data)
    longest = int(np.diff(indptr).max(initial=1))
    length = max(longest, min(per_chunk, max(number, 1)))
    begins = _blocks(indptr, length)
    num_chunks = len(begins) - 1 if number else 0
    attributes = {
        **says,
        "title": "weights on the sphere",
        "history": MAKER + _core.version,
        "shape": list(weights.shape),
        # Numbers of 64 bits, which JSON may round.
        "sites_hash": str(weights.sites_hash),
        "targets_hash": str(weights.targets_hash),
    }
    with replaced(path) as folder:
        root = zarr.create_group(folder, zarr_format=3, attributes=attributes)
        entries = {
            name: _created(root, name, kind, num_chunks * length, "n_s", length)
            for name, kind in (("S", "float64"), ("row", "int32"), ("col", "int32"))
        }
        for chunk in range(num_chunks):
            some = slice(chunk * length, (chunk + 1) * length)
            for name, values in _chunk_of(weights, begins[chunk : chunk + 2], length).items():
                entries[name][some] = values
        arrays = {
            "row_begin": (indptr, {}),
            "chunk_row": (np.array(begins, np.int64), {}),
            **arrays,
        }
        for name, (values, says) in arrays.items():
            dim = f"n_{name[-1]}" if name[-2:] in ("_a", "_b") else f"n_{name}"
            size = len(values)
            made = _created(root, name, values.dtype.name, size, dim, chunk_rows(size), says)
            if size:
                made[...] = np.ascontiguousarray(values)
        with warnings.catch_warnings():  # that version 3 does not specify it; xarray asks for it
            warnings.simplefilter("ignore")
            zarr.consolidate_metadata(root.store)


def _created(
    root: Any, name: str, kind: str, size: int, dim: str, chunk: int, says: Any = None
) -> Any:
    """A new array along one dimension, of which each chunk is written."""
    zarr = require_zarr()
    return root.create_array(
        name,
        dtype=kind,
        shape=(size,),
        chunks=(chunk,),
        fill_value=0,
        attributes=says or {},
        dimension_names=[dim],
        chunk_key_encoding={"name": "default", "separator": "."},
        compressors=zarr.codecs.ZstdCodec(checksum=True),
        config={"write_empty_chunks": True},
    )


def _chunk_of(weights: Any, rows: list[int], length: int) -> dict[str, Any]:
    """The entries of the targets of a chunk, and as many of the weight 0 as fill it up: they are at
    the last pair of the chunk, or the first pair of all where it has none.
    """
    indptr = weights.indptr
    begin, end = int(indptr[rows[0]]), int(indptr[rows[1]])
    last = end - 1 if end > begin else 0
    number = end - begin
    row = np.full(length, np.searchsorted(indptr, last, side="right"), np.int32)
    col = np.full(length, weights.indices[last] + 1, np.int32)
    values = np.zeros(length)
    row[:number] = (
        np.repeat(np.arange(rows[0], rows[1]), np.diff(indptr[rows[0] : rows[1] + 1])) + 1
    )
    col[:number] = weights.indices[begin:end] + 1
    values[:number] = weights.data[begin:end]
    return {"S": values, "row": row, "col": col}


class _Group:
    """A group that is read."""

    def __init__(self, path: Path) -> None:
        zarr = require_zarr()
        self.path = os.fsdecode(path)
        if not os.path.isdir(self.path):
            raise FileNotFoundError(2, os.strerror(2), self.path)
        try:
            self._root = zarr.open_group(self.path, mode="r")
        except Exception as error:
            raise OSError(f"{self.path}: no group of Zarr arrays: {error}") from error
        self.attrs: dict[str, Any] = dict(self._root.attrs)
        missing = [
            name for name in ("S", "row", "col", "row_begin", "chunk_row") if name not in self._root
        ]
        if missing or "shape" not in self.attrs:
            lack = ", ".join([*missing, *(() if "shape" in self.attrs else ("shape",))])
            raise ValueError(f"{self.path}: no weights that to_zarr() wrote: it has no {lack}")
        self.shape: tuple[int, int] = (int(self.attrs["shape"][0]), int(self.attrs["shape"][1]))

    def array(self, name: str, some: slice = slice(None)) -> Any:
        if name not in self._root:
            raise ValueError(f"{self.path}: it has no {name}")
        array = self._root[name]
        begin, end, _ = some.indices(array.shape[0])
        length = array.chunks[0]
        for k in range(begin // length, -(-end // length) if end > begin else 0):
            key = array.metadata.encode_chunk_key((k,))
            if not os.path.exists(os.path.join(self.path, name, key)):
                raise OSError(f"{self.path}: the chunk {key} of {name} is lost")
        try:
            return np.asarray(array[some])
        except Exception as error:  # which the decompression has of its own
            raise OSError(f"{self.path}: a chunk of {name} is damaged: {error}") from error

    def places(self, letter: str, some: slice = slice(None)) -> FloatArray:
        """Longitudes and latitudes, shape (n, 2), or none."""
        if f"xc_{letter}" not in self._root:
            return np.zeros((0, 2))
        parts = [self.array(f"{axis}c_{letter}", some) for axis in "xy"]
        return np.ascontiguousarray(np.stack(parts, axis=-1))

    def _damaged(self) -> ValueError:
        return ValueError(f"{self.path}: the numbers of entries and chunks contradict each other")

    def entries(self, begin: int, end: int) -> tuple[Any, Any, Any]:
        """Where the rows of some targets begin among their entries, and these: columns, weights."""
        indptr = self.array("row_begin", slice(begin, end + 1))
        chunk_row = self.array("chunk_row")
        is_right = len(indptr) == end - begin + 1 and len(chunk_row) > 0
        if not is_right or (np.diff(indptr) < 0).any() or (np.diff(chunk_row) <= 0).any():
            raise self._damaged()
        if indptr[0] < 0 or (begin == 0 and indptr[0] != 0):
            raise self._damaged()
        number = int(indptr[-1] - indptr[0])
        columns, values = np.empty(number, np.int32), np.empty(number)
        length = int(self._root["S"].chunks[0])
        done = 0
        for chunk, first, last in _parts(chunk_row, begin, end):
            own = self.array("row_begin", slice(int(chunk_row[chunk]), last + 1))
            before, upto = int(own[first - chunk_row[chunk]] - own[0]), int(own[-1] - own[0])
            if before == upto:
                continue
            if upto > length:
                raise self._damaged()
            some = slice(chunk * length + before, chunk * length + upto)
            here = slice(done, done + upto - before)
            read = self.array("S", some), self.array("col", some)
            if len(read[0]) != upto - before or here.stop > number:
                raise self._damaged()
            values[here], columns[here] = read[0], read[1] - 1
            done = here.stop
        if done != number:
            raise self._damaged()
        return indptr - indptr[0], columns, values


def _parts(chunk_row: Any, begin: int, end: int) -> Iterator[tuple[int, int, int]]:
    """The chunks that have entries of some targets: their number, and which of the targets."""
    first = int(np.searchsorted(chunk_row, begin, side="right")) - 1
    for chunk in range(max(first, 0), len(chunk_row) - 1):
        if chunk_row[chunk] >= end:
            return
        yield chunk, max(begin, int(chunk_row[chunk])), min(end, int(chunk_row[chunk + 1]))


def weights_from_zarr(cls: Any, path: Path, rows: slice | None = None) -> Any:
    """Reads weights of `Weights.to_zarr` or `Remap.to_zarr`, whole or those of some targets.

    Parameters
    ----------
    path : path_like
        The folder.
    rows : slice, optional
        The targets, which follow each other; by default all. No chunks are read but those that have
        their entries, so that processes, or tasks of Dask, may each take a block of the targets.

    Returns
    -------
    Weights
        The weights, equal to the bit. They know the places that the group has:
        `ds.rondel.interpolate` and `Regridder` refuse others.

    Raises
    ------
    ImportError
        If zarr-python 3 or later is not installed.
    OSError
        If there is no such folder, or no group in it; or if a chunk is missing or damaged.
    ValueError
        If the group has no weights, or `rows` has a step.

    """
    group = _Group(path)
    some = slice(None) if rows is None else rows
    if not isinstance(some, slice):
        raise TypeError(f"rows must be a slice, not {type(rows).__name__}")
    begin, end, step = some.indices(group.shape[0])
    if step != 1:
        raise ValueError(f"rows must follow each other, not have the step {step}")
    end = max(begin, end)
    is_whole = (begin, end) == (0, group.shape[0])
    try:
        made = cls(
            *group.entries(begin, end),
            (end - begin, group.shape[1]),
            sites_hash=int(group.attrs.get("sites_hash", 0)),
            targets_hash=int(group.attrs.get("targets_hash", 0)) if is_whole else 0,
        )
    except ValueError as error:
        text = str(error)
        raise ValueError(text if text.startswith(group.path) else f"{group.path}: {text}") from None
    made._places = group.places("a"), group.places("b", slice(begin, end))
    return made


@dataclasses.dataclass(frozen=True)
class RemapInGroup:
    """What a group has of a remapping beside its weights: of the source, and of the target."""

    path: str
    norm: str
    order: int
    grids: tuple[str | None, str | None]  # the names of their grids
    areas: tuple[FloatArray, FloatArray]
    fractions: tuple[FloatArray, FloatArray]
    places: tuple[FloatArray, FloatArray]
    masks: tuple[BoolArray, BoolArray]


def remap_in_group(path: Path) -> RemapInGroup:
    group = _Group(path)
    if "order" not in group.attrs:
        raise ValueError(f"{group.path}: the weights are those of no remapping between cells")

    def both(name: str) -> Any:
        return tuple(group.array(f"{name}_{letter}") for letter in _SIDES)

    masks = both("mask")
    return RemapInGroup(
        group.path,
        str(group.attrs["normalization"]),
        int(group.attrs["order"]),
        (group.attrs.get("rondel_grid_a"), group.attrs.get("rondel_grid_b")),
        both("area"),
        both("frac"),
        (group.places("a"), group.places("b")),
        (masks[0] != 0, masks[1] != 0),
    )
