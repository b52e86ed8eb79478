# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Interpolation and contours in the cells of a mesh, and extrapolation."""

from __future__ import annotations

from threading import Lock
from typing import Any, Literal, TypeAlias

import numpy as np

from . import _core
from ._arrays import as_count, as_fields, as_lonlat, as_number, as_threads, as_vector
from ._contours import Bands, Isolines
from ._types import ArrayLike, BoolArray, FloatArray
from ._weights import Weights

Extrapolation: TypeAlias = Literal[
    "nearest", "idw", "creep", "nearest_s2d", "inverse_dist", "creep_fill"
]
EXTRAPOLATIONS = ("nearest_s2d", "inverse_dist", "creep_fill", "nearest", "idw", "creep")


def esmf_name(method: str) -> str:
    """The name that ESMF has for a method of extrapolation; other texts as they are."""
    names = dict(zip(EXTRAPOLATIONS[3:], EXTRAPOLATIONS[:3], strict=True))
    return names.get(method, method)


def limits_of_xesmf(
    method: str | None,
    distance: float | None,
    exponent: float | None = None,
    sources: float | None = None,
    levels: float | None = None,
) -> dict[str, Any]:
    """The limits of a `Regridder` for a method of extrapolation; None is the default, and a float
    may be a whole number.
    """
    if method not in (None, *EXTRAPOLATIONS):
        raise ValueError(
            f"extrap_method must be None, 'nearest_s2d', 'inverse_dist' or 'creep_fill', not "
            f"{method!r}"
        )
    made: dict[str, Any] = {"distance": None}
    if distance is not None:
        made["distance"] = as_number(distance, "extrap_distance")
        if not made["distance"] >= 0:
            raise ValueError(f"extrap_distance must not be negative, but is {distance}")
    for key, name, value, usual, (least, most) in (
        ("exponent", "extrap_dist_exponent", exponent, 2, (1, 100)),
        ("sources", "extrap_num_src_pnts", sources, 8, (1, 2**31 - 1)),
        ("levels", "extrap_num_levels", levels, 0, (0, 2**31 - 1)),
    ):
        is_whole = isinstance(value, (float, np.floating)) and float(value).is_integer()
        number = usual if value is None else int(value) if is_whole else value
        made[key] = as_count(number, name)  # type: ignore[arg-type]
        if not least <= made[key] <= most:
            raise ValueError(f"{name} must be from {least} to {most}, not {value}")
    require_limits(
        method,
        "extrap_method",
        {
            "extrap_distance": ("", made["distance"], None),
            "extrap_num_src_pnts": ("inverse_dist", made["sources"], 8),
            "extrap_dist_exponent": ("inverse_dist", made["exponent"], 2),
            "extrap_num_levels": ("creep_fill", made["levels"], 0),
        },
    )
    return made


def require_limits(
    method: str | None, argument: str, limits: dict[str, tuple[str, Any, Any]]
) -> None:
    """Refuses limits that differ from their default and have no effect: each has the method that it
    is for (ESMF's name; "" for any), its value and its default.
    """
    for name, (wanted, value, usual) in limits.items():
        is_meant = method is not None and (not wanted or esmf_name(method) == wanted)
        if value == usual or is_meant:
            continue
        has = f"{argument}={wanted!r}" if wanted else argument
        raise ValueError(f"{name} has no effect without {has}")


def native_weights(
    lon: ArrayLike,
    lat: ArrayLike,
    faces: ArrayLike,
    to_lon: ArrayLike,
    to_lat: ArrayLike,
    *,
    centers: tuple[ArrayLike, ArrayLike] | None = None,
    threads: int | None = None,
) -> Weights:
    """Computes weights that interpolate in the faces of a mesh.

    Values are at the nodes, or with `centers` at the faces. In triangles they are linear, in
    convex polygons their weights are Wachspress coordinates, in others mean value coordinates.

    Parameters
    ----------
    lon, lat : array_like, shape (n,)
        The nodes, in degrees.
    faces : array_like of int, shape (m, k)
        The nodes of each face, in either direction around it; faces with fewer nodes end with
        negative or masked numbers.
    to_lon, to_lat : array_like, shape (t,)
        The targets, in degrees.
    centers : tuple of array_like, shape (m,), optional
        Longitudes and latitudes of the faces' centers. With them the values are those of the
        faces, and are interpolated in the cells of the dual mesh, which surround the inner nodes.
    threads : int, optional
        The largest number of threads; by default one for each core.

    Returns
    -------
    Weights
        Shape (t, n), or (t, m) with `centers`. A target in no cell has no entries. At a node, or
        at a center, the value is the one there, exactly.

    Raises
    ------
    ValueError
        If shapes do not fit; `InvalidInput` if a face has an index that is no node, or is as wide
        as a hemisphere.

    Notes
    -----
    The sum of weights times the unit vectors of their nodes has the direction of the target
    (Langer, Belyaev, Seidel 2006), so that fields that are linear in x, y and z are reproduced but
    for the shortening of that sum, which is of second order in the size of the cells.

    Examples
    --------
    >>> import rondel
    >>> lon, lat = [0, 10, 10, 0], [0, 0, 10, 10]
    >>> weights = rondel.native_weights(lon, lat, [[0, 1, 2, 3]], [0, 5, 20], [0, 0, 0])
    >>> (weights @ [1.0, 2.0, 3.0, 4.0]).tolist()
    [1.0, 1.5, nan]

    """
    nodes, offsets, corners, at = _as_cells(lon, lat, faces, centers)
    targets = as_lonlat(to_lon, to_lat)
    made = _core.native_weights(nodes, offsets, corners, at, targets, as_threads(threads))
    return Weights._of(made)


def native_isolines(
    lon: ArrayLike,
    lat: ArrayLike,
    faces: ArrayLike,
    values: ArrayLike,
    levels: ArrayLike,
    *,
    centers: tuple[ArrayLike, ArrayLike] | None = None,
    threads: int | None = None,
) -> Isolines:
    """Computes lines of equal value in the faces of a mesh, so that none crosses a gap of it.

    Values are at the nodes, or with `centers` at the faces. In triangles they are linear; other
    faces are divided into triangles from their middle, which has the value of `native_weights`.

    Parameters
    ----------
    lon, lat, faces, centers, threads
        As in `native_weights`.
    values : array_like, shape (n,), or (m,) with `centers`
        A value for each node or face. Cells with a corner whose value is NaN or masked are left
        out. Of nodes in one place the first one that has a value counts.
    levels : float or array_like, shape (k,)
        One level, or several in increasing order.

    Returns
    -------
    Isolines
        The lines of each level. A line ends at the border of the mesh.

    Raises
    ------
    ValueError
        If shapes do not fit; `InvalidInput` if a value is infinite, the levels do not increase, a
        face is not seen whole from its middle, or faces overlap beside a common side.

    Examples
    --------
    >>> import rondel
    >>> lon, lat = [0, 10, 10, 0, 20], [0, 0, 10, 10, 0]
    >>> lines = rondel.native_isolines(lon, lat, [[0, 1, 2], [0, 2, 3]], [0, 1, 1, 0, 5], 0.5)
    >>> lines
    <rondel.Isolines: 1 level, 1 line>
    >>> lines.points.shape
    (3, 3)

    """
    return Isolines(
        _core.native_isolines(*_as_contours(lon, lat, faces, values, levels, centers, threads))
    )


def native_bands(
    lon: ArrayLike,
    lat: ArrayLike,
    faces: ArrayLike,
    values: ArrayLike,
    levels: ArrayLike,
    *,
    centers: tuple[ArrayLike, ArrayLike] | None = None,
    threads: int | None = None,
) -> Bands:
    """Computes the regions between levels in the faces of a mesh.

    Together the regions are the faces with values. Where two regions meet, both have the same
    points, which are those of `native_isolines`.

    Parameters
    ----------
    lon, lat, faces, values, centers, threads
        As in `native_isolines`.
    levels : float or array_like, shape (k,)
        One level, or several in increasing order, which make k + 1 bands.

    Returns
    -------
    Bands
        The regions: band k has the values from ``levels[k - 1]`` to below ``levels[k]``.

    Raises
    ------
    ValueError
        As in `native_isolines`.

    Examples
    --------
    >>> import rondel
    >>> lon, lat = [0, 10, 10, 0], [0, 0, 10, 10]
    >>> rondel.native_bands(lon, lat, [[0, 1, 2, 3]], [0, 1, 1, 0], [0.25, 0.5])
    <rondel.Bands: 3 bands, 3 polygons>

    """
    return Bands(
        _core.native_bands(*_as_contours(lon, lat, faces, values, levels, centers, threads))
    )


def _as_contours(
    lon: ArrayLike,
    lat: ArrayLike,
    faces: ArrayLike,
    values: ArrayLike,
    levels: ArrayLike,
    centers: tuple[ArrayLike, ArrayLike] | None,
    threads: int | None,
) -> tuple[Any, ...]:
    cells = _as_cells(lon, lat, faces, centers)
    places = cells[0] if cells[3] is None else cells[3]
    numbers = as_fields(values, len(places))
    if numbers.ndim != 1:
        raise ValueError(f"values must have shape ({len(places)},), not {numbers.shape}")
    limits = as_vector(levels, "levels")
    return (*cells, np.ascontiguousarray(numbers), limits, as_threads(threads))


def _as_cells(
    lon: ArrayLike,
    lat: ArrayLike,
    faces: ArrayLike,
    centers: tuple[ArrayLike, ArrayLike] | None,
) -> tuple[FloatArray, Any, Any, FloatArray | None]:
    """The nodes, the corners of faces and where each begins, and the centers."""
    nodes = as_lonlat(lon, lat)
    given = np.ma.asarray(faces)
    if given.ndim != 2 or (given.size and given.dtype.kind not in "iu"):
        raise ValueError(f"faces must be integers of shape (m, k), not {given.dtype} {given.shape}")
    indices = np.ma.filled(given.astype(np.int64), -1)
    is_node = indices >= 0
    if np.any(is_node[:, 1:] & ~is_node[:, :-1]):
        raise ValueError("numbers that are no nodes stand before nodes of a face")
    if np.any(indices >= len(nodes)):
        first = int(np.flatnonzero((indices >= len(nodes)).any(axis=1))[0])
        raise ValueError(f"face {first} has a corner that is none of {len(nodes)} nodes")
    offsets = np.concatenate([[0], np.cumsum(is_node.sum(axis=1))]).astype(np.int64)
    at = None
    if centers is not None:
        at = as_lonlat(*centers)
        if len(at) != len(indices):
            raise ValueError(f"there are {len(at)} centers for {len(indices)} faces")
    corners = np.ascontiguousarray(indices[is_node], np.int32)
    return nodes, offsets, corners, at


class GapFiller:
    """Values of fields at the targets where they have none, by the gaps of each field."""

    def __init__(
        self,
        sources: FloatArray,
        targets: FloatArray,
        shape: tuple[int, ...],
        masks: tuple[BoolArray | None, BoolArray | None],
        method: str,
        options: dict[str, Any],
        threads: int | None,
    ) -> None:
        kept = [
            np.zeros(0, np.int32) if mask is None else mask.reshape(-1).astype(np.int32)
            for mask in masks
        ]
        self._arguments = (
            sources,
            targets,
            list(shape),
            method,
            options["distance"],
            options["sources"],
            options["exponent"],
            options["levels"],
            *kept,
            as_threads(threads),
        )
        self.is_nearest = esmf_name(method) == "nearest_s2d"
        self.__setstate__(self.__getstate__())

    def __getstate__(self) -> dict[str, Any]:
        return {"_arguments": self._arguments, "is_nearest": self.is_nearest}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._threads = self._arguments[-1]
        self._made: _core.Extrapolator | None = None
        self._lock = Lock()  # the fields of several threads use the same memory one after the other

    @property
    def _extrapolator(self) -> _core.Extrapolator:
        if self._made is None:
            self._made = _core.extrapolator(*self._arguments)
        return self._made

    def filled(self, weights: Weights) -> Weights:
        """The weights with rows in place of the empty ones of targets that take part."""
        return Weights._of(self._extrapolator.filled(weights._weights, self._threads))

    def fill(self, values: Any, found: Any) -> Any:
        """The values at the targets, the last axis of `found`, of fields at the sources, the last
        axis of `values`, whose leading axes are the same.
        """
        if not np.isnan(found).any():
            return found
        rows = np.ascontiguousarray(values.reshape(-1, values.shape[-1]), np.float64)
        targets = np.ascontiguousarray(found.reshape(-1, found.shape[-1]), np.float64)
        made = np.empty_like(targets)
        with self._lock:
            for row, target, out in zip(rows, targets, made, strict=True):
                out[:] = self._extrapolator.filled_values(row, target, self._threads)
        return made.reshape(found.shape).astype(found.dtype, copy=False)
