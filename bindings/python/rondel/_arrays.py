# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Conversion of arguments to the arrays that the C++ library takes."""

from __future__ import annotations

import operator
import os
import re
from fractions import Fraction
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import InvalidInput
from ._properties import are_labeled, is_double, is_missing, plain, stacked
from ._types import ArrayLike, BoolArray, FloatArray, IntArray, Model, Path

Number = TypeVar("Number", bound=np.generic)

MODELS = ("projected", "weighted")
ORIGIN = (0.0, 0.0, 0.0)
EXACT = 2**53  # up to this number all integers are doubles

HINT_OF_DEGREES = "rondel.unit_vectors(lon, lat) makes them of longitudes and latitudes"


def as_floats(values: ArrayLike, name: str) -> FloatArray:
    """C-contiguous float64, the same memory if it is that already."""
    require_unmasked(values, name)
    if hasattr(type(values), "geom_type"):
        hint = "; points have x (longitude) and y (latitude)"
        raise TypeError(f"{name} must be real numbers, not geometries{hint}")
    array = np.asarray(values)
    if array.dtype.kind not in "biufO" or _has_text(array):
        raise TypeError(f"{name} must be real numbers, not {in_words(array)}")
    is_list = isinstance(values, (list, tuple)) and array.dtype.kind == "f"
    if is_list and np.any(np.abs(array) >= EXACT):  # NumPy has rounded integers beside others
        require_doubles(np.asarray(values, object), name)
    require_doubles(array, name)
    try:
        return np.require(array, np.float64, ["C", "A"])
    except (TypeError, ValueError) as error:
        if array.dtype.kind != "O":
            raise
        raise TypeError(f"{name} must be real numbers: {error}") from None


def require_doubles(array: npt.NDArray[Any], name: str, verb: str = "have") -> None:
    """Refuses integers of 64 bits, or more in arrays of objects, that no double is equal to."""
    for index in _large_integers(array):
        value = int(array.flat[index])
        if not is_double(value):
            at = int(np.unravel_index(index, array.shape)[-1]) if array.ndim else 0
            raise InvalidInput(f"{name} {verb} the integer {value}, which is no double", at)


def _large_integers(array: npt.NDArray[Any]) -> list[int]:
    """Where the integers are that may be no doubles, in the flat array."""
    if array.dtype.kind == "O":
        return [k for k, value in enumerate(array.flat) if _is_large(value)]
    if array.dtype.kind not in "iu" or array.dtype.itemsize < 8 or array.size == 0:
        return []
    if int(array.max()) <= EXACT and int(array.min()) >= -EXACT:
        return []
    found: list[int] = np.flatnonzero((array > EXACT) | (array < -EXACT)).tolist()
    return found


def _is_large(value: Any) -> bool:
    return isinstance(value, (int, np.integer)) and abs(int(value)) > EXACT


def require_finite_or_nan(array: FloatArray, name: str) -> None:
    """Refuses infinite numbers, by the index of the first one along the last axis."""
    infinite = np.isinf(array)
    if infinite.any():
        index = int(np.unravel_index(int(np.argmax(infinite)), array.shape)[-1])
        raise InvalidInput(f"{name} have an infinite number at index {index}", index)


def require_unmasked(values: Any, name: str) -> None:
    """Refuses masked values, also those of masked arrays in a list, by the first one's name."""
    if isinstance(values, (list, tuple)):
        for row, value in enumerate(values):
            if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
                raise InvalidInput(f"{name}[{row}] is masked", row)
    elif np.ma.is_masked(values):
        first = int(np.flatnonzero(np.ma.getmaskarray(np.ma.asarray(values)))[0])
        row = first // max(1, int(np.prod(np.shape(values)[1:])))
        raise InvalidInput(f"{name}[{row}] is masked", row)


def as_mask(values: Any, name: str) -> BoolArray:
    """Returns which elements are true: numbers but 0 that are not missing (NaN, NA, None)."""
    missing = np.ma.getmaskarray(values) if np.ma.isMaskedArray(values) else np.False_
    array = np.asarray(values)
    if array.dtype.kind == "O":
        missing = missing | np.array(np.frompyfunc(is_missing, 1, 1)(array), bool)
        array = np.where(missing, False, array)
        for value in array.flat:
            if not isinstance(value, (bool, int, float, np.bool_, np.number)):
                raise TypeError(f"{name} must be numbers or booleans, not {type(value).__name__}")
        array = array.astype(np.float64)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} must be numbers or booleans, not {in_words(array)}")
    if array.dtype.kind == "f":
        missing = missing | np.isnan(array)
    return (array != 0) & ~missing


def _has_text(array: npt.NDArray[Any]) -> bool:
    """Whether an array of objects has a text or bytes, which NumPy would read as a number."""
    if array.dtype.kind != "O":
        return False
    return any(isinstance(value, (str, bytes, bytearray)) for value in array.flat)


def in_words(array: npt.NDArray[Any]) -> str:
    if _has_text(array):
        return "text" if any(isinstance(value, str) for value in array.flat) else "bytes"
    words = {"U": "text", "S": "bytes", "T": "text", "c": "complex numbers", "M": "times"}
    return words.get(array.dtype.kind, str(array.dtype))


def as_vector(values: ArrayLike, name: str, count: int | None = None) -> FloatArray:
    """One-dimensional float64, of that length if one is given; a number is one element."""
    array = np.atleast_1d(as_floats(values, name))
    if array.ndim != 1 or count not in (None, len(array)):
        wanted = "(n,)" if count is None else f"({count},)"
        raise ValueError(f"{name} must have shape {wanted}, not {array.shape}")
    return array


def as_rows(values: ArrayLike, columns: int, name: str) -> FloatArray:
    """Rows of that many numbers; an empty list is no row."""
    array = as_floats(values, name)
    if array.shape == (0,):
        array = array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        are_degrees = columns == 3 and array.ndim == 2 and array.shape[1] == 2
        hint = f"; {HINT_OF_DEGREES}" if are_degrees else ""
        raise ValueError(f"{name} must have shape (n, {columns}), not {array.shape}{hint}")
    return array


def as_points(points: ArrayLike, name: str = "points") -> FloatArray:
    """An array of shape (n, 3)."""
    return as_rows(points, 3, name)


def as_name(path: Path) -> str:
    """The name of a file, as the library takes it."""
    name = os.fsdecode(path)
    if "\0" in name:
        raise ValueError(f"the name of a file has a NUL: {name!r}")
    try:
        name.encode()
    except UnicodeEncodeError:
        raise ValueError(f"the name of a file is not UTF-8: {name!r}") from None
    return name


def as_result_name(path: Path | None, argument: str) -> str:
    """That of a file of results, empty for None. Its ending is that of what is written, if any."""
    name = "" if path is None else as_name(path)
    if os.path.splitext(name.rstrip("/"))[1].lower() not in ("", ".npy"):
        raise ValueError(f"{argument} is {name!r}, whose ending is not .npy")
    return name


def frozen(array: npt.NDArray[Number]) -> npt.NDArray[Number]:
    """Returns a read-only view of the array."""
    array = array.view()
    array.flags.writeable = False
    return array


def as_kept(points: ArrayLike, *, copy: bool, columns: int = 3) -> FloatArray:
    """The points that an object keeps: a copy of what the caller may change, if `copy` is true."""
    array = as_rows(points, columns, "points")
    is_theirs = not isinstance(points, (list, tuple))
    if copy and is_theirs and np.may_share_memory(array, np.asarray(points)):
        array = array.copy()
    return frozen(array)


def as_queries(xi: ArrayLike, name: str = "xi") -> tuple[FloatArray, tuple[int, ...]]:
    """Query points as (q, 3), and the shape of the answers."""
    array = as_floats(xi, name)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"{name} must have shape (..., 3), not {array.shape}; {HINT_OF_DEGREES}")
    return array.reshape(-1, 3), array.shape[:-1]


def by_names(lon: Any, lat: Any) -> tuple[Any, Any]:
    """The same; of two arrays of xarray as broadcast by the names of their dimensions: in the order
    of the longitudes or, where these differ, those of the latitudes first.
    """
    if not are_labeled(lon, lat):
        return lon, lat
    import xarray

    lons, lats = lon.variable, lat.variable
    if set(lons.dims) == set(lats.dims):
        return lons, lats.transpose(*lons.dims)
    # Only the names of coordinates count, so that none is missing where they differ.
    lats, lons = xarray.broadcast(xarray.DataArray(lats), xarray.DataArray(lons))
    return lons.variable, lats.variable


def values_by_names(values: Any, lon: Any) -> Any:
    """The same; of arrays of xarray with the dimensions of the longitudes last, in their order."""
    if not are_labeled(values, lon) or not set(lon.dims) <= set(values.dims):
        return values
    return values.transpose(..., *lon.dims)


def as_lonlat(lon: ArrayLike, lat: ArrayLike) -> FloatArray:
    """Longitudes and latitudes as (n, 2) degrees."""
    if are_labeled(lon, lat):
        dims: list[Any] = [each.dims for each in (lon, lat)]  # type: ignore[union-attr]
        if set(dims[0]) != set(dims[1]):
            raise ValueError(
                f"lon and lat are pairs, but have the dimensions {dims[0]} and {dims[1]}: "
                "xarray.broadcast() makes a grid of two axes"
            )
    lon, lat = by_names(lon, lat)
    lon, lat = as_floats(lon, "lon"), as_floats(lat, "lat")
    if lon.shape != lat.shape:
        raise ValueError(f"lon and lat differ in shape: {lon.shape} and {lat.shape}")
    return np.stack([lon.ravel(), lat.ravel()], axis=1)


def as_indices(values: ArrayLike, name: str) -> IntArray:
    """One-dimensional int32."""
    require_unmasked(values, name)
    array = np.asarray(values)
    if array.size == 0:
        return np.zeros(0, np.int32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    bad = np.flatnonzero((array < 0) | (array > np.iinfo(np.int32).max))
    if bad.size:
        raise InvalidInput(f"there is no site {array.ravel()[bad[0]]}", int(bad[0]))
    if array.ndim > 1:
        raise ValueError(f"{name} must have shape (n,), not {array.shape}")
    return np.require(array, np.int32, ["C", "A"]).reshape(-1)


def as_threads(threads: int | None) -> int:
    """The number of threads, 0 for one for each core."""
    if threads is None:
        return 0
    threads = operator.index(threads)
    if threads < 1:
        raise ValueError(f"threads must be at least 1, or None for all cores, not {threads}")
    return min(threads, 1024)


def as_count(number: int, name: str) -> int:
    """A number that counts something."""
    if isinstance(number, bool) or not hasattr(number, "__index__"):
        raise TypeError(f"{name} must be an integer, not {type(number).__name__}")
    number = operator.index(number)
    if not 0 <= number < 2**31:
        raise ValueError(f"{name} must be from 0 to {2**31 - 1}, not {number}")
    return number


def as_number(number: float, name: str) -> float:
    """A real number."""
    is_array = getattr(number, "ndim", 0) > 0
    is_other = is_array or isinstance(number, (str, bytes, bool))
    if is_other or not hasattr(number, "__float__"):
        raise TypeError(f"{name} must be a number, not {type(number).__name__}")
    return float(number)


def as_text(text: str, name: str) -> str:
    """A text."""
    if not isinstance(text, str):
        raise TypeError(f"{name} must be a text, not {type(text).__name__}")
    return str(text)


def as_bytes(memory: int | str) -> int:
    """A number of bytes."""
    number = -1
    if isinstance(memory, str):
        match = re.fullmatch(r"(\d+)|(\d*\.?\d+)([KMGT])", memory, re.IGNORECASE | re.ASCII)
        if match and match[1]:
            number = int(match[1])
        elif match:
            number = int(Fraction(match[2]) * 1024 ** (" KMGT".index(match[3].upper())))
    elif hasattr(memory, "__index__") and not isinstance(memory, bool):
        number = operator.index(memory)
    if number < 0:
        raise ValueError(f"memory is {memory!r}, which is not a number of bytes, as '2G' or '500M'")
    return min(number, 2**63)


def as_radius(radius: float) -> float:
    """The radius of the sphere."""
    radius = float(radius)
    if not radius > 0:
        raise InvalidInput(f"radius must be positive, not {radius}")
    return radius


def as_center(center: ArrayLike | None) -> tuple[float, float, float]:
    """The center of the sphere as three floats."""
    return ORIGIN if center is None else as_point(center, "center")


def as_point(point: ArrayLike, name: str = "point") -> tuple[float, float, float]:
    """A point as three floats."""
    array = as_floats(point, name)
    if array.shape != (3,):
        raise ValueError(f"{name} must have shape (3,), not {array.shape}")
    x, y, z = array.tolist()
    return x, y, z


def is_weighted(model: Model) -> bool:
    """Tells whether the model is "weighted"; raises ValueError for an unknown model."""
    if model not in MODELS:
        raise ValueError(f"model must be 'projected' or 'weighted', not {model!r}")
    return model == "weighted"


def unit_vectors(lon: ArrayLike, lat: ArrayLike) -> FloatArray:
    """Converts longitudes and latitudes to unit vectors.

    The result has the same bits on every platform, and multiples of 90 degrees are exact: every
    longitude at latitude 90 gives (0, 0, 1), and the longitudes -180, 180 and 540 give the same
    vector.

    Parameters
    ----------
    lon, lat : array_like, shape (...)
        Longitudes and latitudes in degrees, broadcast against each other; two arrays of xarray by
        the names of their dimensions, in the order of the longitudes or, of two axes, latitudes
        first. Longitudes may be any finite numbers, latitudes are from -90 to 90.

    Returns
    -------
    ndarray of float64, shape (..., 3)
        Unit vectors: x points to longitude 0 on the equator, z to the north pole.

    Raises
    ------
    InvalidInput
        If an angle is not finite or a latitude is outside [-90, 90].

    Examples
    --------
    >>> import rondel
    >>> rondel.unit_vectors([0, 90], [0, 90]).tolist()
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]

    """
    lon, lat = by_names(lon, lat)
    lon, lat = np.broadcast_arrays(as_floats(lon, "lon"), as_floats(lat, "lat"))
    return _core.unit_vectors(as_lonlat(lon, lat)).reshape(*lon.shape, 3)


def target_vectors(lon: ArrayLike, lat: ArrayLike, center: Any = ORIGIN) -> FloatArray:
    """Targets at a distance of 1 from the center of the sphere, from which longitudes and
    latitudes are seen: errors name a target, not a site.
    """
    try:
        rays = unit_vectors(lon, lat)
        return rays if tuple(center) == ORIGIN else rays + np.asarray(center)
    except InvalidInput as error:
        text = str(error)
        if text.startswith("site "):
            text = "target " + text.removeprefix("site ")
        raise InvalidInput(text, error.index) from None


def half_turn(degrees: Any) -> Any:
    """The same angle from -180 to 180."""
    return degrees - 360 * np.round(degrees / 360)


def lonlat(points: ArrayLike, center: ArrayLike = ORIGIN) -> FloatArray:
    """Converts points to longitudes and latitudes, those of the rays from `center` through them.

    Parameters
    ----------
    points : array_like, shape (..., 3)
        Points in space, at any distance from the center.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin.

    Returns
    -------
    ndarray of float64, shape (..., 2)
        Longitudes from -180 to 180 and latitudes from -90 to 90, in degrees; NaN for NaN.

    Raises
    ------
    InvalidInput
        If a point is infinite or the center, which has no direction (its index).

    Examples
    --------
    >>> import rondel
    >>> rondel.lonlat([0, 2, 0]).tolist()
    [90.0, 0.0]

    """
    rows, shape = as_queries(points, "points")
    xyz = rows.reshape(*shape, 3)
    relative = xyz - np.asarray(as_center(center))
    for bad, what in (
        (np.isinf(xyz).any(axis=-1), "infinite"),
        ((relative == 0).all(axis=-1), "the center of the sphere"),
    ):
        if bad.any():
            index = int(np.argmax(bad))
            raise InvalidInput(f"point {index} is {what}", index)
    return degrees_of(xyz, center)


def degrees_of(points: ArrayLike, center: ArrayLike = ORIGIN) -> FloatArray:
    """What `lonlat` returns, NaN for points without a direction."""
    xyz = as_floats(points, "points")
    origin = as_center(center)
    if any(origin):
        xyz = xyz - np.asarray(origin)
    rows = np.ascontiguousarray(xyz.reshape(-1, 3))
    return _core.lonlats(rows).reshape(*xyz.shape[:-1], 2)


def unmasked(values: Any, name: str = "values") -> Any:
    """The same; where numbers are masked, None or pandas' NA as float64 with NaN there."""
    if isinstance(values, (list, tuple)) and any(map(np.ma.isMaskedArray, values)):
        values = stacked(values)
    if np.ma.isMaskedArray(values):
        filled = np.ma.filled(values, 0) if values.dtype.kind in "iuOSU" else values
        if filled.dtype.kind in "SU" or _has_text(filled):
            raise TypeError(f"{name} must be real numbers, not {in_words(filled)}")
        require_doubles(filled, name)
        return np.ma.filled(np.ma.asarray(values).astype(np.float64), np.nan)
    array = plain(values)
    if array.dtype.kind != "O":
        # Arrays of pandas have a mask also where they miss nothing.
        return array if np.ma.is_masked(values) else values
    missing = np.array(np.frompyfunc(is_missing, 1, 1)(array), bool)
    if _has_text(array):
        return values
    require_doubles(array, name)
    try:
        return np.where(missing, np.nan, array).astype(np.float64)
    except (TypeError, ValueError):
        return values


def as_colors(values: ArrayLike, name: str, count: int, shape: Any = None) -> FloatArray:
    """So many numbers, also in an array of that shape; what is masked or missing is NaN."""
    array = as_floats(unmasked(values, name), name)
    if array.shape not in ((count,), shape):
        wanted = f"({count},)" if shape in (None, (count,)) else f"({count},) or {shape}"
        raise ValueError(f"{name} must have shape {wanted}, not {array.shape}")
    return array.reshape(-1)


def as_fields(values: ArrayLike, num_sites: int, name: str = "values") -> FloatArray:
    """Values of shape (..., n) as float64; what is masked or missing is NaN."""
    array = as_floats(unmasked(values, name), name)
    if array.ndim == 0 or array.shape[-1] != num_sites:
        shape = array.shape
        hint = "; the sites are the last axis" if num_sites in shape[:-1] else ""
        raise ValueError(f"{name} must have shape (..., {num_sites}), not {shape}{hint}")
    return array


def point_set_hash(points: ArrayLike) -> int:
    """Computes a hash of points in their order, which tells whether weights belong to them.

    Parameters
    ----------
    points : array_like, shape (..., 3)
        The points.

    Returns
    -------
    int
        A number of 64 bits, never 0; it is the same on every machine.

    """
    return _core.point_set_hash(as_queries(points, "points")[0])
