# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights that a `Regridder` made before: whether they are of the same places, method and masks."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._geo import Path
from ._types import BoolArray, IntArray
from ._weights import Weights

if TYPE_CHECKING:
    from ._places import Places


def reused(
    weights: Path | Weights, method: str, source: Places, target: Places, threads: int | None
) -> Weights:
    """The weights, or those of a file, if they fit."""
    text, norm = "", ""
    of_file: list[IntArray] = [np.zeros(0, np.int32)] * 2
    name = "the weights"
    if isinstance(weights, Weights):
        made = weights
    else:
        name = os.fspath(weights)
        found, text, norm, *of_file = _core.read_weight_file(name)
        made = Weights._of(found)
    shape = (target.lon.size, source.lon.size)
    if made.shape != shape:
        raise ValueError(f"the weights have shape {made.shape}, the grids {shape}")
    known = _methods_of(text, norm, source.are_axes)
    if known is not None and method not in known:
        raise ValueError(
            f"{name} holds weights of the method {_said(text, norm)!r}, not {method!r}; "
            "read_weights() reads them as those of any method"
        )
    masks = source.mask(), target.mask()
    # Weights of masked points have the hash of the points that are left.
    if all(mask is None for mask in masks) and not made.is_of(
        source.points() if made.sites_hash else None,
        target.points() if made.targets_hash else None,
    ):
        raise ValueError("the weights are of other places, or of these in another order")
    used = np.zeros(shape[1], bool), np.diff(made.indptr) > 0
    used[0][made.indices] = True
    for k, (places, what) in enumerate(((source, "sources"), (target, "targets"))):
        mask = masks[k]
        if mask is not None:
            _require_none(used[k] & ~mask, name, f"have entries of {what} that the mask leaves out")
        if len(of_file[k]):
            left_out = of_file[k] == 0
            if np.any(left_out if mask is None else left_out & mask) and "conserv" in method:
                mask = places.cells(threads)[1]  # also without cells whose corners are missing
            left_out = left_out if mask is None else left_out & mask
            _require_none(left_out, name, f"are of another mask, without {what} that take part")
    return made


def _require_none(wrong: BoolArray, name: str, what: str) -> None:
    places = np.flatnonzero(wrong)
    if len(places):
        owner = name if name == "the weights" else f"{name}: the weights"
        raise ValueError(f"{owner} {what}: {len(places)}, the first is {places[0]}")


def _said(text: str, norm: str) -> str:
    return f"{text}, {norm}" if norm in ("fracarea", "destarea") else text


def _methods_of(text: str, norm: str, are_axes: bool) -> Any:
    """The methods of a `Regridder` that the words of a file can mean; None if they say nothing."""
    words = text.lower()
    is_second = any(word in words for word in ("second", "2nd", "higher", "order 2"))
    first = re.split(r"[^a-z0-9_]", words)[0]
    if first in ("conservative_normed", "conservative_2nd", "nearest_d2s", "nearest_s2d"):
        return (first,)
    if "conserv" in words:
        if is_second:
            return ("conservative_2nd",)
        known = {"destarea": ("conservative",), "fracarea": ("conservative_normed",)}
        return known.get(norm, ("conservative", "conservative_normed"))
    if "distance weighted" in words:  # what programs write for many methods
        return None
    if any(word in words for word in ("d2s", "dtos", "destination to source")):
        return ("nearest_d2s",)
    if "nearest" in words:
        return ("nearest_s2d",)
    if "bilinear" in words or first == "linear":
        # On anything but axes of a grid, 'bilinear' is 'linear'.
        return (("bilinear",) if "bilinear" in words else ("linear",)) if are_axes else _LINEAR
    if first in ("laplace", "sibson", "hermite", "cubic", "patch", "bicubic", "largest"):
        return (first,)
    return None


_LINEAR = ("bilinear", "linear")
