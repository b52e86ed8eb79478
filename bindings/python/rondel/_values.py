# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Packed and missing values of what xarray holds, by the rules of the C++ library, and masks:
a variable `mask`, and those of conventions, which say what places take part.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np
import xarray

from . import _core
from ._arrays import EXACT, as_mask
from ._errors import InvalidInput, warn_caller
from ._types import BoolArray


def unpacked(data: Any) -> Any:
    """The Dataset or DataArray with integers unpacked whose attributes say that they are packed or
    of the other sign, as after ``open_dataset(mask_and_scale=False)``.
    """
    is_array = isinstance(data, xarray.DataArray)
    variables = data.coords.variables if is_array else data.variables
    packed = {name: item for name, item in variables.items() if _is_packed(item)}
    own = [data.variable] if is_array and _is_packed(data) else []
    if not packed and not own:
        return data
    parts = {f"packed_{k}": part for k, part in enumerate((*packed.values(), *own))}
    found = list(
        xarray.decode_cf(
            xarray.Dataset(parts), decode_times=False, decode_coords=False, concat_characters=False
        ).variables.values()
    )
    if own:
        data = data.copy(data=found[-1].data)
        data.attrs, data.encoding = found[-1].attrs, found[-1].encoding
    taken = {name: found[k] for k, name in enumerate(packed)}
    coords = {name: taken.pop(name) for name in list(taken) if name in data.coords}
    data = data.assign_coords(coords) if coords else data
    return data.assign(taken) if taken else data


def _is_packed(item: Any) -> bool:
    """Whether numbers of a file are integers that xarray can unpack and has not."""
    factors = [np.asarray(item.attrs[name]) for name in _PACKING if name in item.attrs]
    are_numbers = all(f.size == 1 and f.dtype.kind in "iuf" and np.isfinite(f) for f in factors)
    return item.dtype.kind in "iu" and are_numbers and (bool(factors) or "_Unsigned" in item.attrs)


_BOUNDS = ("valid_min", "valid_max", "valid_range")
OF_VALUES = ("_FillValue", "missing_value", *_BOUNDS, "_Unsigned")
_PACKING = ("scale_factor", "add_offset")


def _code(dtype: Any) -> str | None:
    """The name of a type that netCDF has, such as "f4"."""
    is_known = dtype.kind in "iu" or (dtype.kind == "f" and dtype.itemsize in (4, 8))
    return f"{dtype.kind}{dtype.itemsize}" if is_known else None


def missing_marker(array: xarray.DataArray) -> Any:
    """A function that makes NaN of what the attributes call missing, or None; xarray heeds
    `_FillValue` and `missing_value` when it opens a file, but no `valid_range`, nor the numbers
    that netCDF writes where nobody wrote.
    """
    of_file = array.encoding.get("dtype")
    stored = np.dtype(of_file if isinstance(of_file, (np.dtype, type)) else array.dtype)
    texts = {**array.encoding, **array.attrs}
    # xarray remembers in `encoding` how it unpacked the values.
    known = {name: texts[name] for name in OF_VALUES if texts.get(name) is not None}
    known |= {name: array.encoding[name] for name in _PACKING if name in array.encoding}
    if of_file is None and array.dtype.kind == "f":
        _drop_packed_bounds(array, known)
    stored_kind = _code(stored)
    if stored_kind is None or (of_file is None and not known and not _is_wide(stored)):
        return None
    if of_file is None and "_FillValue" not in known:
        known["_FillValue"] = np.nan
    name = _name(array)
    without_bounds = {key: text for key, text in known.items() if key not in _BOUNDS}

    def marked(values: Any) -> Any:
        values = np.asarray(values)
        if _is_wide(stored) and values.dtype.kind == "f":
            _tell_of_rounding(values, name)
        found = _marked(values, stored_kind, known, name)
        if np.isnan(found).all() and len(without_bounds) < len(known):
            others = _marked(values, stored_kind, without_bounds, name)
            if not np.isnan(others).all():
                bounds = " and ".join(name for name in _BOUNDS if name in known)
                warn_caller(
                    f"{name}: no number is within {bounds}, so that all are missing; "
                    "remove the attribute if the numbers were changed"
                )
        return found

    return marked


def _is_wide(dtype: Any) -> bool:
    """Whether the type is one of integers that may be no doubles."""
    return dtype.kind in "iu" and dtype.itemsize == 8


def _tell_of_rounding(values: Any, name: str) -> None:
    """Warns of floating-point numbers that have been made of 64-bit integers with rounding."""
    count = int(np.count_nonzero(np.abs(values) >= EXACT))
    if count:
        warn_caller(
            f"{name}: {count} of {values.size} numbers were 64-bit integers from 2**53 on, which "
            "may have been rounded when they became floating-point numbers; "
            "open_dataset(mask_and_scale=False) keeps them"
        )


def _marked(values: Any, stored_kind: str, known: dict[str, Any], name: str) -> Any:
    """The values as float64 with NaN where the attributes call them missing. Integers of 64 bits
    are compared exactly; one that is neither missing nor a double is an error.
    """
    if not _is_wide(values.dtype):
        found = np.array(values, np.float64, order="C")
        _core.mark_missing(found.reshape(-1), stored_kind, _attributes_of(known))
        return found
    bits = np.ascontiguousarray(values, values.dtype.newbyteorder("=")).reshape(-1).view(np.int64)
    own = {key: text for key, text in known.items() if key not in (*_PACKING, "_Unsigned")}
    kind = f"{values.dtype.kind}8"
    try:
        return _core.unpack_integers(bits, kind, _attributes_of(own)).reshape(values.shape)
    except InvalidInput as error:
        at = int(np.unravel_index(error.index or 0, values.shape)[-1]) if values.ndim else 0
        raise InvalidInput(f"{name} {error}", at) from None


def _name(array: xarray.DataArray) -> str:
    return "the data" if array.name is None else repr(array.name)


def _drop_packed_bounds(array: xarray.DataArray, known: dict[str, Any]) -> None:
    """Removes bounds that are integers where the values are none: a mean of a variable, for
    example, keeps them, but nothing says how the numbers that they bound were packed.
    """
    packed = [
        name
        for name in _BOUNDS
        if name in known
        and np.asarray(known[name]).dtype.kind in "iu"
        and not {*_PACKING} & {*known}
    ]
    for name in packed:
        del known[name]
    if packed:
        warn_caller(
            f"{_name(array)}: {' and '.join(packed)} are not heeded: they are integers, as of "
            f"packed numbers, while the values are {array.dtype} and no file says how they were "
            "packed; "
            "make them floating-point numbers, or remove them"
        )


def _attributes_of(
    known: dict[str, Any],
) -> list[tuple[str, str, str, list[float], list[int]]]:
    """Name, type, text, numbers and bits of 64-bit integers of each attribute, for the library."""
    attributes: list[tuple[str, str, str, list[float], list[int]]] = []
    for name, value in known.items():
        if isinstance(value, str):
            attributes.append((name, "", value, [], []))
            continue
        given = np.atleast_1d(np.asarray(value))
        kind = _code(given.dtype)
        if kind is None:
            continue
        bits = given.astype(f"{given.dtype.kind}8").view(np.int64) if _is_wide(given.dtype) else []
        attributes.append((name, kind, "", [float(n) for n in given], [int(n) for n in bits]))
    return attributes


def _variables(data: Any) -> Any:
    """The variables of a Dataset, or the coordinates of a DataArray, which is no mask itself."""
    return data.coords if isinstance(data, xarray.DataArray) else data


def mask_of_variable(data: Any, dims: tuple[Hashable, ...]) -> BoolArray | None:
    """Where `mask` is neither 0 nor missing, shape (n,); None if there is no such variable."""
    known = _variables(data)
    if "mask" not in known:
        return None
    given = known["mask"]
    others = [dim for dim in given.dims if dim not in dims]
    if len(given.dims) != len(others) + len(dims):
        raise ValueError(f"mask has the dimensions {given.dims}, not {dims}")
    masks = as_mask(given.transpose(*others, *dims).values, "mask")
    masks = masks.reshape(-1, np.prod(masks.shape[len(others) :], dtype=int))
    if len(masks) == 0 or not (masks == masks[0]).all():
        raise ValueError(f"mask changes along {', '.join(map(str, others))}: choose one")
    mask: BoolArray = masks[0]
    return mask


def mask_of_convention(
    data: Any, lon_name: str, dims: tuple[Hashable, ...]
) -> tuple[str, BoolArray] | None:
    """The mask of SCRIP (0 is masked) or OASIS (1 is masked) for these longitudes: its name, and
    which take part, shape (n,), as the tool reads it; None if no cell is masked.
    """
    is_scrip, is_oasis = lon_name == "grid_center_lon", lon_name.endswith(".lon")
    name = "grid_imask" if is_scrip else lon_name.removesuffix("lon") + "msk"
    known = _variables(data)
    if not (is_scrip or is_oasis) or name not in known:
        return None
    given = known[name]
    if set(given.dims) != set(dims):
        raise ValueError(f"{name} has the dimensions {given.dims}, not {dims}")
    given = given.transpose(*dims)
    marker = missing_marker(given)
    mask = as_mask(given.values if marker is None else marker(given.values), name).reshape(-1)
    if is_oasis:
        mask = ~mask
    return None if mask.all() else (name, mask)
