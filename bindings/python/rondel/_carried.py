# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of what xarray holds, carried from one set of places to another."""

from __future__ import annotations

from functools import partial
from typing import Any, Literal, TypeAlias

import numpy as np
import xarray

from ._blocks import OutputChunks, in_blocks
from ._coordinates import describes_places, lies_elsewhere, parts_of_grids
from ._errors import warn_caller
from ._places import Places
from ._values import OF_VALUES, missing_marker, unpacked
from ._weights import Weights

# Sums, the value of the largest part of a target, or the latter for flags alone.
How: TypeAlias = Literal["sum", "largest_share", "by_kind"]

_AWAY = "as their longitudes and latitudes are not those of the source"


def carried(
    data: Any,
    weights: Weights,
    source: Places,
    wanted: Places,
    *,
    skipna: bool,
    max_missing: float,
    unmapped: float = np.nan,
    keep_attrs: bool = True,
    how: How = "sum",
    output_chunks: OutputChunks = None,
) -> Any:
    """A Dataset or DataArray at other places; `unmapped` is the value of targets that no source
    contributes to, while those that need a missing value have NaN. With the
    `how` "by_kind" arrays of flags get the value of the largest part. Arrays of Dask stay lazy, in
    blocks of the targets as `output_chunks` says.
    """
    data = unpacked(data)
    source.require_same(data)

    def applied(values: Any, marker: Any, is_largest: bool) -> Any:
        apply = partial(
            _applied_rows,
            num_dims=len(source.dims),
            marker=marker,
            unmapped=unmapped,
            skipna=skipna,
            max_missing=max_missing,
            how="largest_share" if is_largest else "sum",
        )
        if not hasattr(values, "__dask_graph__"):
            found = apply(values, weights)
            return found.reshape((*found.shape[:-1], *wanted.shape))
        return in_blocks(
            values,
            weights,
            len(source.dims),
            wanted.shape,
            wanted.dims,
            output_chunks,
            apply,
            _kind(values),
        )

    def moved(array: xarray.DataArray) -> xarray.DataArray:
        _require_dimensions(array, source, wanted)
        if "scale_factor" in array.attrs or "add_offset" in array.attrs:
            name = "data" if array.name is None else array.name
            warn_caller(
                f"{name} are packed: their attribute scale_factor or add_offset is not applied"
            )
        found = xarray.apply_ufunc(
            applied,
            array,
            input_core_dims=[source.dims],
            output_core_dims=[wanted.dims],
            exclude_dims=set(source.dims),
            keep_attrs=keep_attrs,
            dask="allowed",
            kwargs={
                "marker": missing_marker(array),
                "is_largest": how == "largest_share" or (how == "by_kind" and _has_flags(array)),
            },
        )
        # These are of the numbers in a file, and may be of packed ones.
        found.attrs = {name: text for name, text in found.attrs.items() if name not in OF_VALUES}
        return found.assign_coords(wanted.coordinates)

    _tell_of_coordinates(data, source)
    _tell_of_chunks(data, output_chunks)
    if isinstance(data, xarray.DataArray):
        return moved(data)
    lost = [str(dim) for dim in source.dims if dim not in data.dims]
    if lost:
        raise ValueError(
            f"the data have no dimension {' and no '.join(lost)}, which the source has"
        )
    own_names = source.own_names | parts_of_grids(data)
    fields = {name: data[name] for name in data.data_vars if str(name) not in own_names}
    _tell_of_others(data, fields, source)
    taken = {
        name: moved(array)
        for name, array in fields.items()
        if _is_field(array, source) and not source.is_away(data, name)
    }
    rest = data.drop_vars([name for name in own_names if name in data.variables])
    rest = rest.drop_dims(source.dims)
    whole = _without_other_places(rest, data, wanted)
    whole = whole.assign(taken).assign_coords(wanted.coordinates)
    if not keep_attrs:
        whole = whole.drop_attrs(deep=False)
    return whole[[name for name in data.data_vars if name in whole.data_vars]]


def _applied_rows(
    values: Any,
    weights: Weights,
    *,
    num_dims: int,
    marker: Any,
    unmapped: float,
    **rules: Any,
) -> Any:
    """The values at the targets of some rows, in one axis, of fields whose last axes, so many, are
    those of the source.
    """
    dtype = _kind(values)
    if marker is not None:
        values = marker(values)
    leading = values.shape[: values.ndim - num_dims]
    found = weights.apply(values.reshape(*leading, weights.shape[1]), **rules)
    if not np.isnan(unmapped):
        found[..., np.diff(weights.indptr) == 0] = unmapped
    return found.astype(dtype, copy=False)


def _has_flags(array: xarray.DataArray) -> bool:
    """Whether the numbers stand for categories, by CF (section 3.5)."""
    return "flag_values" in array.attrs or "flag_meanings" in array.attrs


def _is_field(array: xarray.DataArray, source: Places) -> bool:
    return set(source.dims) <= set(array.dims) and array.dtype.kind in "biuf"


def _tell_of_others(
    data: xarray.Dataset, fields: dict[Any, xarray.DataArray], source: Places
) -> None:
    """Warns of variables that depend on place and cannot be carried."""
    dims = set(source.dims)
    names = ", ".join(map(str, source.dims))
    texts = [str(n) for n, a in fields.items() if dims <= set(a.dims) and not _is_field(a, source)]
    parts = [str(n) for n, a in fields.items() if dims & set(a.dims) and not dims <= set(a.dims)]
    away = [str(n) for n, a in fields.items() if _is_field(a, source) and source.is_away(data, n)]
    if away:
        warn_caller(f"left out, {_AWAY}: {', '.join(away)}")
    if texts:
        warn_caller(f"left out, as they are no real numbers: {', '.join(texts)}")
    if parts:
        warn_caller(
            f"left out, as they have only some of the dimensions {names}: {', '.join(parts)}"
        )


def _tell_of_chunks(data: Any, output_chunks: OutputChunks) -> None:
    """Warns of blocks that are wanted of arrays that are in memory."""
    arrays = [data] if isinstance(data, xarray.DataArray) else data.data_vars.values()
    if output_chunks is None or any(a.chunks is not None for a in arrays):
        return
    warn_caller("output_chunks has no effect on arrays that are not of Dask")


def _tell_of_coordinates(data: Any, source: Places) -> None:
    """Warns of coordinates of the places, such as their areas, which are no fields to carry."""
    lost = [
        str(name)
        for name, array in data.coords.items()
        if set(source.dims) & set(array.dims)
        and str(name) not in source.own_names
        and name not in data.indexes
    ]
    own = describes_places(data, lost) if lost else set()
    lost = [name for name in lost if name not in own]
    if lost:
        warn_caller(
            "left out, as they are coordinates of the source's places (reset_coords() makes them "
            f"variables): {', '.join(lost)}"
        )


def _require_dimensions(array: xarray.DataArray, source: Places, wanted: Places) -> None:
    """Refuses other lengths than the source's, and a field that has, beside its dimensions, one of
    the targets', as a time of both: whether each target wants all of its values is not known.
    """
    name = "the data" if array.name is None else repr(array.name)
    for dim, length in zip(source.dims, source.shape, strict=True):
        if array.sizes[dim] != length:
            raise ValueError(
                f"{name} and the source differ in the length of {dim}: {array.sizes[dim]}, {length}"
            )
    for dim in wanted.dims:
        if dim in array.dims and dim not in source.dims:
            raise ValueError(
                f"{name} and the targets both have the dimension {dim!r}: rename that of the "
                f"targets for the values of every {dim} at each of them"
            )


def _without_other_places(rest: xarray.Dataset, data: xarray.Dataset, wanted: Places) -> Any:
    """Leaves out fields that are elsewhere, and dimensions with the names of the target's."""
    others = [
        dim
        for dim, size in zip(wanted.dims, wanted.shape, strict=True)
        if dim in rest.sizes and not _is_same_dimension(rest, dim, size, wanted.index(dim))
    ]
    away = [str(name) for name in rest.data_vars if lies_elsewhere(data, str(name))]
    taken = [
        str(name)
        for name, array in rest.data_vars.items()
        if set(others) & set(array.dims) and str(name) not in away
    ]
    for names, why in (
        (away, _AWAY),
        (taken, f"as the targets have another dimension {' or '.join(map(str, others))}"),
    ):
        if names:
            warn_caller(f"left out, {why}: {', '.join(names)}")
    return rest.drop_vars([*away, *taken]).drop_dims(others)


def _is_same_dimension(rest: xarray.Dataset, dim: Any, size: int, index: Any) -> bool:
    """Whether it has the targets' length and, where its places have labels, theirs."""
    if rest.sizes[dim] != size:
        return False
    return dim not in rest.indexes or (index is not None and rest.indexes[dim].equals(index))


def _kind(array: Any) -> Any:
    return array.dtype if array.dtype.kind == "f" else np.dtype(np.float64)
