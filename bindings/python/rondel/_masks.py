# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Which places of what xarray holds take part: a variable `mask`, and the masks of conventions."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np
import xarray

from ._arrays import as_mask
from ._types import BoolArray
from ._values import missing_marker


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
