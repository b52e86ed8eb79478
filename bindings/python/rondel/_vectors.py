# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Vectors on the sphere as three fields of their components in space, and back."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray

from . import _core
from ._carried import NAMING, in_order, names_apart
from ._places import Places
from ._values import OF_VALUES, missing_marker, unpacked
from ._winds import directions

_AXES = "xyz"


def pairs_of(
    data: xarray.Dataset, vectors: Iterable[tuple[str, str]], source: Places
) -> list[tuple[str, str]]:
    """The pairs of names, which must be those of variables with the same dimensions, of which the
    data do not say that they are no components of vectors.
    """
    pairs = [(east, north) for east, north in vectors]
    names = [name for pair in pairs for name in pair]
    for name in names:
        if name not in data.data_vars:
            raise ValueError(f"{name!r}, a component of vectors, is no variable of the data")
        if names.count(name) > 1:
            raise ValueError(f"{name!r} is a component of vectors twice")
    for east, north in pairs:
        if set(data[east].dims) != set(data[north].dims):
            raise ValueError(f"{east!r} and {north!r} have different dimensions")
        first, second = _component(east, data[east]), _component(north, data[north])
        if lack := _core.lack_of_vectors(first, second, source.are_axes):
            raise ValueError(
                f"{east!r} and {north!r} are no eastward and northward components: {lack}"
            )
    return pairs


def _component(name: str, array: xarray.DataArray) -> tuple[str, str, str, bool]:
    """The name, standard_name and units of a component, and whether it has flags."""
    attrs = {**array.encoding, **array.attrs}
    has_flags = any(str(key).startswith("flag_") for key in attrs)
    return name, str(attrs.get("standard_name", "")), str(attrs.get("units", "")), has_flags


def in_space(data: xarray.Dataset, pairs: list[tuple[str, str]], source: Places) -> xarray.Dataset:
    """The data with the components in space of each pair: two of them in place of its variables,
    with their attributes, and one more.
    """
    data = unpacked(data)
    frames = _frames(source)
    made = {}
    for east, north in pairs:
        given = data[east], data[north]
        u, v = (_marked(array).astype(np.float64) for array in given)
        for axis, name, array in zip(_AXES, _parts(east, north), (*given, None), strict=True):
            part = u * frames[0][axis] + v * frames[1][axis]
            made[name] = part.transpose(*data[east].dims)
            if array is None:
                continue
            # Missing values are NaN in the parts, whatever marks them in the data.
            made[name].attrs = {k: text for k, text in array.attrs.items() if k not in OF_VALUES}
            made[name].encoding = {k: array.encoding[k] for k in NAMING if k in array.encoding}
    return data.assign(made)


def on_sphere(
    found: xarray.Dataset, data: xarray.Dataset, pairs: list[tuple[str, str]], target: Places
) -> xarray.Dataset:
    """What was carried, with the parts along the sphere to the east and to the north."""
    frames = _frames(target)
    apart = names_apart([name for pair in pairs for name in pair], data, target)
    made, lost = {}, []
    for east, north in pairs:
        names = [apart.get(name, name) for name in _parts(east, north)]
        if gone := [name for name in names if name not in found.data_vars]:
            raise ValueError(
                f"{gone[0]!r}, a component of vectors, is not at the places of the source"
            )
        parts = [found[name] for name in names]
        lost.append(names[-1])
        for name, of_part, given, to in zip(names, parts, (east, north), frames, strict=False):
            x, y, z = (part * to[axis] for axis, part in zip(_AXES, parts, strict=True))
            kind = data[given].dtype if data[given].dtype.kind == "f" else np.dtype(np.float64)
            made[name] = (x + y + z).transpose(*parts[0].dims).astype(kind)
            made[name].attrs = dict(of_part.attrs)
            made[name].encoding = dict(of_part.encoding)
    return in_order(found.drop_vars(lost).assign(made), data)


def _parts(east: str, north: str) -> tuple[str, str, str]:
    """The names of the components in space."""
    return east, north, f"{east}, z in space"


def _marked(array: xarray.DataArray) -> xarray.DataArray:
    """The values with NaN where they are missing."""
    marker = missing_marker(array)
    if marker is None:
        return array
    marked: xarray.DataArray = xarray.apply_ufunc(
        marker, array, dask="parallelized", output_dtypes=[np.float64]
    )
    return marked


def _frames(places: Places) -> list[dict[str, xarray.DataArray]]:
    """The components of the directions to the east and to the north."""
    lon, lat = (np.asarray(each, np.float64) for each in places.degrees())
    return [
        {axis: xarray.DataArray(to[..., k], dims=places.dims) for k, axis in enumerate(_AXES)}
        for to in directions(lon, lat)
    ]
