# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Weights that a `Regridder` made before: whether they are of the same places, method and masks."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import numpy as np

from . import _core
from ._arrays import as_name, degrees_of, point_set_hash
from ._errors import warn_caller
from ._geo import Path
from ._native import esmf_name
from ._types import BoolArray, FloatArray, IntArray
from ._weight_files import are_near
from ._weights import Weights

if TYPE_CHECKING:
    from ._places import Places


_EXTRAPOLATED = "extrapolated by"


def said_method(method: str, extrap_method: str | None) -> str:
    """What a file says of the method of its weights."""
    return method if extrap_method is None else f"{method}, {_EXTRAPOLATED} {extrap_method}"


def reused(
    weights: Path | Weights,
    method: str,
    extrap_method: str | None,
    source: Places,
    target: Places,
    threads: int | None,
) -> Weights:
    """The weights, or those of a file, if they fit."""
    text, norm = "", ""
    of_file = [_FileSide()] * 2
    name = "the weights"
    if isinstance(weights, Weights):
        made = weights
        of_file = [_FileSide(centers=centers) for centers in made._places]
    else:
        name = as_name(weights)
        file = _core.read_weight_file(name)
        text, norm = file.method, file.normalization
        for remark in file.remarks:
            warn_caller(f"{name}: {remark}")
        of_file = [
            _FileSide(side.mask, side.centers, side.corners) for side in (file.source, file.target)
        ]
        made = Weights._of(file.take_weights())
        bad = np.flatnonzero(~np.isfinite(made.data))
        if len(bad):
            raise ValueError(f"{name}: weight {bad[0]} is {made.data[bad[0]]}")
    shape = (target.lon.size, source.lon.size)
    hashes = made.sites_hash, made.targets_hash
    made, of_file, is_spread = _with_all_places(made, of_file, source, target)
    if made.shape != shape:
        raise ValueError(f"the weights have shape {made.shape}, the grids {shape}")
    known = _methods_of(text, norm, source.are_axes)
    if known is not None and method not in known:
        raise ValueError(
            f"{name} holds weights of the method {_said(text, norm)!r}, not {method!r}; "
            "read_weights() reads them as those of any method"
        )
    if _EXTRAPOLATED in text and extrap_method is None:
        raise ValueError(
            f"{name} holds weights of the method {text!r}, but extrap_method is None: the values "
            "outside of the source would be extrapolated"
        )
    said = text.partition(_EXTRAPOLATED)[2].strip()
    if said and extrap_method is not None and esmf_name(said) != esmf_name(extrap_method):
        raise ValueError(
            f"{name} holds weights that are extrapolated by {said!r}, not by {extrap_method!r}"
        )
    masks = source.mask(), target.mask()
    for k, (places, what) in enumerate(((source, "source"), (target, "target"))):
        # A hash of masked points in an old file is that of the points that are left.
        is_told = isinstance(weights, Weights) or (masks[0] is None and masks[1] is None)
        is_all = is_told and hashes[k] != 0 and not len(of_file[k].centers)
        points = places.points()
        if is_spread[k]:
            points = points[places.have_places]
        if is_all and point_set_hash(points) != hashes[k]:
            _refuse_places(name, "")
        _require_places(places, of_file[k], "conserv" in method, name, what, threads)
    used = np.zeros(shape[1], bool), np.diff(made.indptr) > 0
    used[0][made.indices] = True
    for k, (places, what) in enumerate(((source, "sources"), (target, "targets"))):
        mask = masks[k]
        if mask is not None:
            _require_none(used[k] & ~mask, name, f"have entries of {what} that the mask leaves out")
        if len(of_file[k].mask):
            left_out = of_file[k].mask == 0
            if np.any(left_out if mask is None else left_out & mask) and "conserv" in method:
                mask = places.cells(threads).mask  # also without cells whose corners are missing
            left_out = left_out if mask is None else left_out & mask
            _require_none(left_out, name, f"are of another mask, without {what} that take part")
    return made


class _FileSide(NamedTuple):
    """What a file says of sources or targets: an empty array is not there."""

    mask: IntArray = np.zeros(0, np.int32)
    centers: FloatArray = np.zeros((0, 2))
    corners: FloatArray = np.zeros((0, 2))

    def spread(self, located: BoolArray) -> _FileSide:
        """The same with an entry for each place, of which these are there."""

        def filled(values: Any, otherwise: Any) -> Any:
            if not len(values):
                return values
            number = int(np.count_nonzero(located))
            every = values.reshape(number, -1, *values.shape[1:])
            out = np.full((len(located), *every.shape[1:]), otherwise, values.dtype)
            out[located] = every
            return out.reshape(-1, *values.shape[1:])

        return _FileSide(
            filled(self.mask, 1), filled(self.centers, np.nan), filled(self.corners, np.nan)
        )


def _with_all_places(
    weights: Weights, of_file: list[_FileSide], source: Places, target: Places
) -> tuple[Weights, list[_FileSide], list[bool]]:
    """The weights with empty rows and columns for places without longitude or latitude, where the
    weights count only the others, as those that `rondel interpolate` makes of tables do; and
    whether sources and targets were so.
    """
    sides, numbers, is_spread = [], [], []
    for places, side, size in zip((source, target), of_file, reversed(weights.shape), strict=True):
        located = places.have_places
        is_spread.append(size != len(located) and size == np.count_nonzero(located))
        numbers.append(np.flatnonzero(located) if is_spread[-1] else None)
        sides.append(side.spread(located) if is_spread[-1] else side)
    if any(is_spread):
        shape = [
            len(places.have_places) if spread else size
            for places, spread, size in zip(
                (target, source), reversed(is_spread), weights.shape, strict=True
            )
        ]
        weights = weights._renumbered(numbers[1], numbers[0], (shape[0], shape[1]))
    return weights, sides, is_spread


def _refuse_places(name: str, where: str) -> NoReturn:
    owner = "the weights" if name == "the weights" else f"{name}: the weights"
    raise ValueError(f"{owner} are of other places, or of these in another order{where}")


def _require_places(
    places: Places, side: _FileSide, are_cells: bool, name: str, what: str, threads: int | None
) -> None:
    """Refuses centers, and corners of cells, that are not those of the file."""
    mask = places.mask()
    used = np.ones(places.lon.size, bool) if mask is None else mask
    own, cells = places.pairs(), None
    if are_cells and places.have_cells and len(side.centers) + len(side.corners):
        cells = places.cells(threads)
        used = cells.mask
        own = cells._degrees()
    if len(side.centers):
        # Empty cells have no center, and those that have bounds need none.
        located = used & np.isfinite(side.centers).all(axis=1) & places.have_places
        apart = located & ~are_near(own, side.centers)
        if apart.any() and cells is not None:
            # Files of former versions have the centers of mass.
            masses = degrees_of(cells.centers)
            apart = apart if (located & ~are_near(masses, side.centers)).any() else used & False
        if apart.any():
            first = int(np.flatnonzero(apart)[0])
            here, there = own[first].tolist(), side.centers[first].tolist()
            _refuse_places(name, f": {what} {first} is at {here} here, at {there} there")
    if cells is not None and len(side.corners):
        corners = cells._cells.corners()
        if len(corners):
            shape = places.lon.size, -1, 2
            others = side.corners.reshape(shape)
            apart = used & ~_have_the_same(corners.reshape(shape), others)
            apart &= np.isfinite(others).all(axis=(1, 2))
            if apart.any():
                first = int(np.flatnonzero(apart)[0])
                _refuse_places(name, f": {what} {first} has other corners")


def _have_the_same(a: FloatArray, b: FloatArray) -> BoolArray:
    """Whether cells, shapes (n, k, 2) and (n, m, 2), have the same corners, wherever they begin."""
    near_a, near_b = np.zeros(a.shape[:2], bool), np.zeros(b.shape[:2], bool)
    for i in range(a.shape[1]):
        for j in range(b.shape[1]):
            near = are_near(a[:, i], b[:, j])
            near_a[:, i] |= near
            near_b[:, j] |= near
    return near_a.all(axis=1) & near_b.all(axis=1)


def _require_none(wrong: BoolArray, name: str, what: str) -> None:
    places = np.flatnonzero(wrong)
    if len(places):
        owner = name if name == "the weights" else f"{name}: the weights"
        raise ValueError(f"{owner} {what}: {len(places)}, the first is {places[0]}")


def _said(text: str, norm: str) -> str:
    return f"{text}, {norm}" if norm in ("fracarea", "destarea") else text


def _methods_of(text: str, norm: str, are_axes: bool) -> Any:
    """The methods of a `Regridder` that the words of a file can mean; None if they say nothing."""
    words = text.lower().split(_EXTRAPOLATED)[0]
    is_second = any(word in words for word in ("second", "2nd", "higher", "order 2"))
    first = re.split(r"[^a-z0-9_]", words)[0]
    if first in ("conservative_normed", "conservative_2nd_normed", "nearest_d2s", "nearest_s2d"):
        return (first,)
    if "conserv" in words:
        plain = "conservative_2nd" if is_second else "conservative"
        known = {"destarea": (plain,), "fracarea": (f"{plain}_normed",)}
        return known.get(norm, (plain, f"{plain}_normed"))
    if "distance weighted" in words:  # what programs write for many methods
        return None
    if any(word in words for word in ("d2s", "dtos", "destination to source")):
        return ("nearest_d2s",)
    if "nearest" in words:
        return ("nearest_s2d",)
    if "bilinear" in words or first == "linear":
        # On anything but axes of a grid, 'bilinear' is 'linear'.
        return (("bilinear",) if "bilinear" in words else ("linear",)) if are_axes else _LINEAR
    if first in ("laplace", "sibson", "hermite", "cubic", "native", "patch", "bicubic", "largest"):
        return (first,)
    return None


_LINEAR = ("bilinear", "linear")
