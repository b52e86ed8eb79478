# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sparse weights, which map values at sites to values at targets."""

from __future__ import annotations

import operator
import os
import zipfile
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import (
    as_fields,
    as_floats,
    as_name,
    as_threads,
    as_vector,
    point_set_hash,
    require_unmasked,
)
from ._errors import warn_caller
from ._geo import Path
from ._repr import Described, count
from ._tables import _replaced
from ._types import ArrayLike, BoolArray, FloatArray, IntArray
from ._weight_files import weights_to_netcdf
from ._zarr_weights import weights_from_zarr, weights_to_zarr


class Weights(Described):
    """A sparse matrix with a row for each target and a column for each site.

    The value of target r is the sum of ``data[k] * values[indices[k]]`` over
    ``indptr[r] <= k < indptr[r + 1]``; a target whose row is empty has no value.
    `SphericalDelaunay.weights` and `remap` make weights. They depend only on the places of sites
    and targets, so that they serve for every field and every time step.

    Parameters
    ----------
    indptr : array_like of int, shape (m + 1,)
        Where the rows of a matrix in compressed rows begin, and the end, as in
        `scipy.sparse.csr_matrix`.
    indices : array_like of int, shape (k,)
        The column (site or source cell) of each entry.
    data : array_like, shape (k,)
        The weight of each entry.
    shape : tuple of int
        The number of targets m and of sites n.
    sites_hash, targets_hash : int, optional
        The `point_set_hash` of sites and targets, which `is_of` compares; 0 (default) if it is not
        known.

    Raises
    ------
    InvalidInput
        If they are no matrix in compressed rows, or not finite.

    Examples
    --------
    >>> import rondel
    >>> tri = rondel.delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
    >>> weights = tri.weights([[1, 1, 0], [1, 1, 1]], method="linear")
    >>> weights
    <rondel.Weights: 2 targets, 4 sites, 5 entries>
    >>> weights.apply([10, 20, 60, 0])
    array([15., 30.])

    """

    # Longitudes and latitudes of sites and targets, shape (n, 2), of a file; empty if not known.
    _places: tuple[FloatArray, FloatArray] = (np.zeros((0, 2)), np.zeros((0, 2)))

    def __init__(
        self,
        indptr: ArrayLike,
        indices: ArrayLike,
        data: ArrayLike,
        shape: tuple[int, int],
        *,
        sites_hash: int = 0,
        targets_hash: int = 0,
    ) -> None:
        if len(shape) != 2 or not all(hasattr(number, "__index__") for number in shape):
            raise TypeError(f"shape must be two integers, not {tuple(shape)}")
        rows, columns = map(operator.index, shape)
        most = np.iinfo(np.int32).max
        if not 0 <= columns <= most:
            raise ValueError(f"shape {tuple(shape)} must have from 0 to {most} columns")
        offsets = _as_integers(indptr, np.int64, "indptr")
        if len(offsets) != rows + 1:
            raise ValueError(f"indptr must have shape ({rows + 1},), not {offsets.shape}")
        self._weights = _core.Weights.from_arrays(
            offsets,
            _as_integers(indices, np.int32, "indices"),
            as_vector(data, "data"),
            columns,
            sites_hash,
            targets_hash,
        )
        self.apply(np.zeros(columns), threads=1)  # says what is wrong with them

    @classmethod
    def _of(cls, weights: _core.Weights) -> Weights:
        self = cls.__new__(cls)
        self._weights = weights
        return self

    def __reduce__(self) -> Any:
        hashes = {"sites_hash": self.sites_hash, "targets_hash": self.targets_hash}
        arrays = self.indptr, self.indices, self.data, self.shape
        return _unpickled, (*arrays, hashes, self._places)

    @property
    def indptr(self) -> npt.NDArray[np.int64]:
        """Ndarray of int64, shape (m + 1,): where the rows begin and end, read-only."""
        return self._weights.offsets

    @property
    def indices(self) -> IntArray:
        """Ndarray of int32, shape (k,): the site of each entry, read-only. The order within a row
        depends only on the places of the sites, and so do sums along it.
        """
        return self._weights.columns

    @property
    def data(self) -> FloatArray:
        """Ndarray of float64, shape (k,): the weight of each entry, read-only."""
        return self._weights.values

    @property
    def shape(self) -> tuple[int, int]:
        """Tuple of int: the number of targets and of sites."""
        return len(self.indptr) - 1, self._weights.num_columns

    @property
    def sites_hash(self) -> int:
        """int: `point_set_hash` of the sites; 0 where it is not known."""
        return self._weights.sites_hash

    @property
    def targets_hash(self) -> int:
        """int: `point_set_hash` of the targets; 0 where it is not known."""
        return self._weights.targets_hash

    def is_of(self, sites: ArrayLike | None = None, targets: ArrayLike | None = None) -> bool:
        """Tells whether these weights belong to given points in the same order.

        Parameters
        ----------
        sites : array_like, shape (n, 3), optional
            Sites to compare; by default they are not compared.
        targets : array_like, shape (..., 3), optional
            Targets to compare; by default they are not compared.

        Returns
        -------
        bool
            True if the hashes of the given points are those of the weights; False also if the
            weights have no hash.

        """
        given = ((sites, self.sites_hash), (targets, self.targets_hash))
        return all(p is None or point_set_hash(p) == known for p, known in given)

    def apply(
        self,
        values: ArrayLike,
        *,
        skipna: bool = False,
        max_missing: float = 1.0,
        fill: float = np.nan,
        how: Literal["sum", "largest_share"] = "sum",
        threads: int | None = None,
    ) -> FloatArray:
        """Computes the values at the targets.

        Parameters
        ----------
        values : array_like, shape (..., n)
            A value for each site; further axes, such as time, come first. An infinite value makes
            targets infinite, or NaN.
        skipna : bool, optional
            What to do with missing values (NaN, or masked). False (default): a target that needs a
            missing value has none. True: missing values are left out, and the remaining weights
            are scaled up to the same sum.
        max_missing : float, optional
            With `skipna`, the largest share of its absolute weights for which a target may lack
            values, from 0 to 1; by default 1, with which one present value suffices. A target at
            the limit, up to 1e-9, has a value.
        fill : float, optional
            The value of targets that have none; by default NaN.
        how : {'sum', 'largest_share'}, optional
            The weighted sum (default), or, for categories such as flags and land use, the value
            that the largest part of a target's weights has; of equal parts the smallest value.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        ndarray of float64, shape (..., m)
            A value for each target.

        Raises
        ------
        ValueError
            If the last axis of the values is not n, or `max_missing` is out of range or given
            without `skipna`.
        InvalidInput
            If a weight is infinite or NaN, with its index in `data`.

        """
        rows, columns = self.shape
        fields = as_fields(values, columns)
        leading = fields.shape[:-1]
        if how not in ("sum", "largest_share"):
            raise ValueError(f"how must be 'sum' or 'largest_share', not {how!r}")
        require_share(max_missing, "max_missing", skipna)
        found = self._weights.apply(
            fields.reshape(int(np.prod(leading)), columns),
            float(fill),
            float(max_missing) if skipna else 0.0,
            how == "largest_share",
            as_threads(threads),
        )
        return found.reshape((*leading, rows))

    def _apply_sums(self, values: FloatArray) -> FloatArray:
        """The sums of the values that are there; NaN for targets without any."""
        fields = as_fields(values, self.shape[1])
        leading = fields.shape[:-1]
        flat = fields.reshape(int(np.prod(leading)), self.shape[1])
        found = self._weights.apply(flat, np.nan, 1.0, False, as_threads(None), True)
        return found.reshape((*leading, self.shape[0]))

    def __matmul__(self, other: ArrayLike) -> FloatArray:
        """The product with a vector (n,) or with matrices (..., n, k)."""
        if np.ndim(other) < 2:
            return self.apply(other)
        return np.swapaxes(self.apply(np.swapaxes(as_floats(other, "values"), -1, -2)), -1, -2)

    def tocsr(self) -> Any:
        """Returns a `scipy.sparse.csr_matrix` with copies of the arrays."""
        import scipy.sparse

        arrays = (self.data, self.indices, self.indptr)
        return scipy.sparse.csr_matrix(arrays, shape=self.shape, copy=True)

    def save(self, path: Path) -> None:
        """Writes a file that `load` and `scipy.sparse.load_npz` read.

        Parameters
        ----------
        path : path-like
            The file to write. It appears when it is complete, and replaces an existing one.

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        with _replaced(path) as name, open(name, "wb") as file:
            np.savez(
                file,
                indices=self.indices,
                indptr=self.indptr,
                format=np.array(b"csr"),
                shape=np.array(self.shape),
                data=self.data,
                hashes=np.array([self.sites_hash, self.targets_hash], np.uint64),
            )

    @classmethod
    def load(cls, path: Path) -> Weights:
        """Reads a file of `save`, or a matrix in compressed rows of `scipy.sparse.save_npz`.

        Parameters
        ----------
        path : path-like
            The .npz file.

        Returns
        -------
        Weights
            The weights.

        Raises
        ------
        OSError
            If the file cannot be read.
        ValueError
            If the file has no matrix in compressed rows.

        """
        if (
            isinstance(path, (str, os.PathLike))
            and os.path.isfile(path)
            and not zipfile.is_zipfile(path)
        ):
            raise ValueError(
                f"{os.fspath(path)}: no .npz file; rondel.read_weights() reads netCDF, too"
            )
        with np.load(path, allow_pickle=False) as file:
            names = ("indptr", "indices", "data", "shape", "format")
            if any(name not in file for name in names) or file["format"].item() != b"csr":
                raise ValueError(f"{path}: no matrix in compressed rows (csr)")
            hashes = file["hashes"].tolist() if "hashes" in file else [0, 0]
            rows, columns = file["shape"].tolist()
            arrays = (file["indptr"], file["indices"], file["data"])
        try:
            return cls(*arrays, (rows, columns), sites_hash=hashes[0], targets_hash=hashes[1])
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)}: {error}") from None

    to_netcdf = weights_to_netcdf
    to_zarr = weights_to_zarr
    from_zarr = classmethod(weights_from_zarr)

    def _renumbered(self, rows: Any, columns: Any, shape: tuple[int, int]) -> Weights:
        """The weights of a part of targets and sites as those of all: the numbers of its rows and
        columns, None where they are all.
        """
        numbers = [
            np.ascontiguousarray(np.arange(size) if given is None else given, np.int32)
            for given, size in zip((rows, columns), self.shape, strict=True)
        ]
        return Weights._of(self._weights.renumbered(numbers[0], shape[0], numbers[1], shape[1]))

    def _with_rows(self, is_kept: BoolArray, others: Weights | None = None) -> Weights:
        """The same with the rows of others, or empty ones, where `is_kept` is false."""
        mask = np.ascontiguousarray(is_kept, np.int32)
        return Weights._of(
            self._weights.with_rows(mask, None if others is None else others._weights)
        )

    def _choose_values(self) -> bool:
        """Whether each target has the value of one site, or none."""
        return bool(self._weights.choose_values())

    def _without_columns(self, is_kept: BoolArray) -> Weights:
        """The same with empty rows where a column is needed for which `is_kept` is false."""
        return Weights._of(self._weights.without_columns(np.ascontiguousarray(is_kept, np.int32)))

    def _of_rows(self, rows: Any) -> Weights:
        indptr, entries = rows_of(self.indptr, rows)
        kept = self.indices[entries], self.data[entries]
        return Weights(indptr, *kept, (len(rows), self.shape[1]))

    def _facts(self) -> list[tuple[str, str]]:
        rows, columns = self.shape
        return [
            ("targets", count(rows, "target")),
            ("sites", count(columns, "site")),
            ("entries", count(len(self.data), "entry", "entries")),
        ]


def _unpickled(
    indptr: Any,
    indices: Any,
    data: Any,
    shape: tuple[int, int],
    hashes: dict[str, int],
    places: Any = Weights._places,
) -> Weights:
    made = Weights(indptr, indices, data, shape, **hashes)
    made._places = places
    return made


def require_share(share: float, name: str, skipna: bool) -> None:
    """Refuses a share of missing values that is out of range or has no effect."""
    if not 0 <= share <= 1:
        raise ValueError(f"{name} must be from 0 to 1, not {share}")
    if share < 1 and not skipna:
        raise ValueError(f"{name} has no effect without skipna=True")


def rows_of(indptr: Any, rows: Any) -> tuple[Any, Any]:
    """Where some rows begin and end among their own entries, and the numbers of these."""
    sizes = np.diff(indptr)[rows]
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    return offsets, np.repeat(indptr[rows] - offsets[:-1], sizes) + np.arange(offsets[-1])


def _as_integers(values: ArrayLike, kind: Any, name: str) -> Any:
    require_unmasked(values, name)
    array = np.asarray(values)
    if array.size == 0:
        array = array.astype(kind)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    if array.ndim > 1:
        raise ValueError(f"{name} must have shape (n,), not {array.shape}")
    if array.size and not 0 <= array.min() <= array.max() <= np.iinfo(kind).max:
        raise ValueError(f"{name} has numbers that are negative or too large")
    return np.require(array, kind, ["C", "A"]).reshape(-1)


def read_weights(path: Path) -> Weights:
    """Reads weights from a file of `Weights.to_netcdf` or of another program.

    Parameters
    ----------
    path : path-like
        A netCDF file with the names of ESMF or of SCRIP, or an .npz file of
        `scipy.sparse.save_npz`.

    Returns
    -------
    Weights
        The weights. Entries may have any order in the file; within a row they keep it. They know
        the places that the file has: `ds.rondel.interpolate` and `Regridder` refuse others.

    Raises
    ------
    OSError
        If the file cannot be read, or has no weights.

    Warns
    -----
    UserWarning
        Where conservative weights of SCRIP are areas (normalization 'none'): they are divided by
        those of the targets.

    """
    name = as_name(path)
    file = _core.read_weight_file(name)
    for remark in file.remarks:
        warn_caller(f"{name}: {remark}")
    made = Weights._of(file.take_weights())
    made._places = file.source.centers.copy(), file.target.centers.copy()
    return made
