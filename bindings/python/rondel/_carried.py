# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of what xarray holds, carried from one set of places to another."""

from __future__ import annotations

from functools import partial
from typing import Any, Literal, TypeAlias

import numpy as np
import xarray

from . import _core
from ._amounts import OverCells
from ._arrays import require_finite_or_nan
from ._blocks import AnyWeights, OutputChunks, in_blocks
from ._coordinates import (
    at_places,
    describes_places,
    mappings,
    measures_of_cells,
    parts_of_grids,
    with_places,
)
from ._errors import warn_caller
from ._native import GapFiller
from ._places import Places
from ._sites import feature_type
from ._types import IntArray
from ._values import OF_VALUES, missing_marker, unpacked

# Sums, the value of the largest part of a target, or the latter for flags alone.
How: TypeAlias = Literal["sum", "largest_share", "by_kind"]

_AWAY = "as their longitudes and latitudes are not those of the source"
_ELSEWHERE = "as they are at other places than the source"
_MEASURES = "as they are areas or volumes of cells"
# The attribute of files whose cells have such corners, too.
_MADE_CORNERS = "made half way between the centers, as the file has none"
# The attributes that name variables of a Dataset, or `compress` its dimensions; and the one that
# xarray understands.
_LISTED = "coordinates"
NAMING = (
    "ancillary_variables",
    "bounds",
    "climatology",
    "compress",
    "formula_terms",
)


def carried(
    data: Any,
    weights: AnyWeights,
    source: Places,
    wanted: Places,
    *,
    skipna: bool,
    max_missing: float,
    unmapped: float = np.nan,
    keep_attrs: bool = True,
    how: How = "sum",
    are_chosen: bool = False,
    output_chunks: OutputChunks = None,
    coincident: IntArray | None = None,
    over_cells: OverCells | None = None,
    describes: bool = False,
    gaps: GapFiller | None = None,
) -> Any:
    """A Dataset or DataArray at other places; `unmapped` is the value of targets that no source
    contributes to, while those that need a missing value have NaN. `coincident` has pairs of
    sources in one place, which have the first value that is there. With the
    `how` "by_kind" arrays of flags get the value of the largest part. Flags stay flags there, and
    where `are_chosen` says that each target has the value of one source. Arrays of Dask stay lazy,
    in blocks of the targets as `output_chunks` says. `over_cells` says what becomes of sums over
    cells and what the result says of its cells. With `describes` it has what a list of targets
    says of itself, such as names of stations. `gaps` fills targets without values, but
    of sums.
    """
    cells = OverCells(are_told=False) if over_cells is None else over_cells
    data = unpacked(data)
    source.require_same(data)

    def applied(values: Any, name: str, marker: Any, is_largest: bool, are_sums: bool) -> Any:
        used = cells.sums if are_sums and cells.sums is not None else weights
        apply = partial(
            _applied_rows,
            name=name,
            num_dims=len(source.dims),
            marker=marker,
            unmapped=unmapped,
            skipna=skipna,
            max_missing=max_missing,
            how="largest_share" if is_largest else "sum",
            coincident=coincident,
            gaps=None if are_sums else gaps,
        )
        if not hasattr(values, "__dask_graph__"):
            found = apply(values, used)
            return found.reshape((*found.shape[:-1], *wanted.shape))
        return in_blocks(
            values,
            used,
            len(source.dims),
            wanted.shape,
            wanted.dims,
            output_chunks if gaps is None else (-1,) * len(wanted.dims),
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
        is_largest = how == "largest_share" or (how == "by_kind" and _has_flags(array))
        are_sums = cells.has_sums(array, source.dims, is_largest=is_largest)
        found = xarray.apply_ufunc(
            applied,
            array,
            input_core_dims=[source.dims],
            output_core_dims=[wanted.dims],
            exclude_dims=set(source.dims),
            keep_attrs=keep_attrs,
            dask="allowed",
            kwargs={
                "name": "the data" if array.name is None else f"the values of {array.name!r}",
                "marker": missing_marker(array),
                "is_largest": is_largest,
                "are_sums": are_sums,
            },
        )
        are_flags = are_chosen or (is_largest and (gaps is None or gaps.is_nearest))
        found.attrs = {
            name: text
            for name, text in found.attrs.items()
            if _holds_at_targets(str(name), are_flags=are_flags)
        }
        given = str(array.attrs.get("cell_methods", ""))
        done = "mode" if is_largest else "sum" if are_sums else cells.method
        if methods := cells.methods(given, done, source.dims) if keep_attrs else "":
            found.attrs["cell_methods"] = methods
        found = found.drop_vars(mappings(found)).assign_coords(wanted.coordinates)
        if not mapping:
            return found
        found.encoding["grid_mapping"] = mapping_name
        return found.assign_coords({mapping_name: ((), np.int32(0), mapping)})

    mapping, _ = wanted.mapping
    mapping_name = _free_name(data, "crs")
    lists = source.lists_in(data)
    _tell_of_coordinates(data, source.own_names | lists, source)
    _tell_of_chunks(data, output_chunks)
    if isinstance(data, xarray.DataArray):
        name = names_apart([data.name], data, wanted).get(data.name, data.name)
        found = _without_bounds(moved(data), wanted).rename(name)
        return _with_descriptions(found, wanted) if describes else found
    lost = [str(dim) for dim in source.dims if dim not in data.dims]
    if lost:
        raise ValueError(
            f"the data have no dimension {' and no '.join(lost)}, which the source has"
        )
    parts = parts_of_grids(data)
    measures_there = measures_of_cells(data)
    measures = [str(name) for name in data.data_vars if str(name) in measures_there]
    measures = [name for name in measures if name not in source.own_names | parts]
    own_names = source.own_names | lists | parts | {*measures}
    given, fields_of = data, [name for name in data.data_vars if str(name) not in own_names]
    apart = names_apart(fields_of, data, wanted)
    data = data.rename_vars(apart)
    fields = {apart.get(name, name): data[apart.get(name, name)] for name in fields_of}
    if measures:
        warn_caller(f"left out, {_MEASURES}: {', '.join(measures)}")
    at_source = {str(name) for name, array in fields.items() if _is_field(array, source)}
    away = source.are_away(data, at_source)
    _tell_of_others(fields, source, away)
    here = at_source - away
    taken = {name: moved(array) for name, array in fields.items() if str(name) in here}
    lost_names = {*own_names, *map(str, mappings(data))}
    lost_names -= _bounds_of_others(data, own_names)
    rest = data.drop_vars([name for name in lost_names if name in data.variables])
    rest = rest.drop_dims(source.dims, errors="ignore")
    whole = _without_other_places(rest, data, wanted)
    whole = whole.assign(taken).assign_coords(wanted.coordinates)
    if keep_attrs:
        whole.attrs = {
            name: text
            for name, text in whole.attrs.items()
            if not _core.is_attribute_of_places(str(name))
        }
        for name, side in (("source_corners", source), ("target_corners", wanted)):
            if side.are_corners_made:
                whole.attrs[name] = _MADE_CORNERS
    else:
        whole = whole.drop_attrs(deep=False)
    whole = in_order(whole, data)
    former = {apart.get(name, name): given.variables[name] for name in given.variables}
    others = {*wanted.coordinates} if keep_attrs else {*wanted.coordinates, *taken}
    former = {name: item for name, item in former.items() if name not in others}
    whole = _named_again(whole, former, {str(n): str(apart.get(n, n)) for n in given.variables})
    limits = whole.encoding.get("unlimited_dims")
    if limits:
        whole.encoding["unlimited_dims"] = {dim for dim in limits if dim in whole.dims}
    whole = _with_bounds(whole, wanted)
    if not describes:
        return whole
    whole = _with_descriptions(whole, wanted)
    return _with_feature_type(whole, wanted) if keep_attrs and wanted.are_sites else whole


def in_order(made: xarray.Dataset, data: xarray.Dataset) -> xarray.Dataset:
    """The variables in the order of the data, and then those that have another name there, with all
    coordinates.
    """
    names = [name for name in data.data_vars if name in made.data_vars]
    chosen = made[names + [name for name in made.data_vars if name not in data.data_vars]]
    chosen = chosen.assign_coords(made.coords)
    chosen.encoding = dict(made.encoding)
    return chosen


def names_apart(names: list[Any], data: Any, wanted: Places) -> dict[Any, Any]:
    """Other names for those of variables that coordinates, bounds or dimensions of the target have,
    as files get them: with underscores.
    """
    others = {str(name) for name in (*wanted.coordinates, *wanted.dims, *wanted.bounds())}
    taken = {str(name) for name in (*data.coords, *getattr(data, "data_vars", ()), *data.dims)}
    apart: dict[Any, Any] = {}
    for name in names:
        if str(name) not in others:
            continue
        new = f"{name}_"
        while new in others | taken | {*apart.values()}:
            new += "_"
        apart[name] = new
    return apart


def _named_again(
    made: xarray.Dataset,
    former: dict[Any, xarray.Variable],
    names: dict[str, str],
) -> xarray.Dataset:
    """The same with attributes that name the variables that are there, by their names; `former` are
    the variables before, by their new names.
    """
    known = {old: new for old, new in names.items() if new in made.variables}
    dims = {str(dim): str(dim) for dim in made.dims}

    def renamed(
        before: dict[Any, Any], now: dict[Any, Any], keys: tuple[str, ...]
    ) -> dict[Any, Any]:
        found = {key: item for key, item in now.items() if key not in keys}
        for key in keys:
            if isinstance(before.get(key), str):
                of = dims if key == "compress" else known
                found[key] = _core.with_names(key, before[key], of)
        return {key: item for key, item in found.items() if key not in keys or item}

    changed = {}
    for name in [name for name in made.variables if name in former]:
        old, item = former[name], made.variables[name].copy(deep=False)
        # xarray itself writes the coordinates that it has understood.
        item.attrs = renamed(old.attrs, item.attrs, (*NAMING, _LISTED))
        item.encoding = renamed(old.encoding, item.encoding, NAMING)
        given = made.variables[name]
        if item.attrs != given.attrs or item.encoding != given.encoding:
            changed[name] = item
    coordinates = {name: item for name, item in changed.items() if name in made.coords}
    fields = {name: item for name, item in changed.items() if name not in coordinates}
    return made.assign(fields).assign_coords(coordinates)


def _applied_rows(
    values: Any,
    weights: AnyWeights,
    *,
    name: str,
    num_dims: int,
    marker: Any,
    unmapped: float,
    coincident: IntArray | None,
    gaps: GapFiller | None,
    **rules: Any,
) -> Any:
    """The values at the targets of some rows, in one axis, of fields whose last axes, so many, are
    those of the source. Infinite values are an error, as in files.
    """
    dtype = _kind(values)
    if marker is not None:
        values = marker(values)
    leading = values.shape[: values.ndim - num_dims]
    flat = values.reshape(*leading, weights.shape[1])
    if flat.dtype.kind == "f":
        require_finite_or_nan(flat, name)
    if coincident is not None and flat.dtype.kind == "f":
        flat = _with_values_that_are_there(flat, coincident)
    found = weights.apply(flat, **rules)
    if not np.isnan(unmapped):
        found[..., np.diff(weights.indptr) == 0] = unmapped
    if gaps is not None:
        found = gaps.fill(flat, found)
    return found.astype(dtype, copy=False)


def _with_values_that_are_there(values: Any, coincident: IntArray) -> Any:
    """The values, where a place that is given several times has the first one that is not missing.
    Rows of `coincident` are a site and the one before it in its place, in increasing order.
    """
    if not np.isnan(values[..., np.unique(coincident)]).any():
        return values
    values = values.copy()
    for taking, giving in (coincident.T[::-1], coincident.T):
        for site, other in zip(taking, giving, strict=True):
            own = values[..., site]
            values[..., site] = np.where(np.isnan(own), values[..., other], own)
    return values


def _holds_at_targets(name: str, *, are_flags: bool) -> bool:
    """Whether an attribute of a field holds for its values at other places. Those of OF_VALUES are
    of the numbers in a file, and may be of packed ones.
    """
    if _core.is_attribute_of_places(name) or _core.is_attribute_of_values(name):
        return False
    return name not in OF_VALUES and (are_flags or not _core.is_attribute_of_flags(name))


def _has_flags(array: xarray.DataArray) -> bool:
    """Whether the numbers stand for categories, by CF (section 3.5)."""
    return any(str(array.attrs[n]) for n in array.attrs if _core.is_attribute_of_flags(str(n)))


def _is_field(array: xarray.DataArray, source: Places) -> bool:
    return set(source.dims) <= set(array.dims) and array.dtype.kind in "biuf"


def _tell_of_others(
    fields: dict[Any, xarray.DataArray], source: Places, are_away: set[str]
) -> None:
    """Warns of variables that depend on place and cannot be carried, as they have only some of its
    dimensions, are texts, or are away.
    """
    dims = set(source.dims)
    names = ", ".join(map(str, source.dims))
    texts = [str(n) for n, a in fields.items() if dims <= set(a.dims) and not _is_field(a, source)]
    parts = [str(n) for n, a in fields.items() if dims & set(a.dims) and not dims <= set(a.dims)]
    away = [str(n) for n in fields if str(n) in are_away]
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


def _tell_of_coordinates(data: Any, own_names: set[str], source: Places) -> None:
    """Warns of coordinates of the places, such as their areas, which are no fields to carry."""
    lost = [
        str(name)
        for name, array in data.coords.items()
        if set(source.dims) & set(array.dims)
        and str(name) not in own_names
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
    there = with_places(data, map(str, rest.data_vars))
    away = [str(name) for name in rest.data_vars if str(name) in there]
    placed = at_places(data)
    elsewhere = [str(name) for name in rest.data_vars if str(name) in placed and name not in away]
    gathered = [name for name in elsewhere if _is_gathered(data, name)]
    elsewhere = [name for name in elsewhere if name not in gathered]
    known = {*away, *elsewhere, *gathered}
    taken = [
        str(name)
        for name, array in rest.data_vars.items()
        if set(others) & set(array.dims) and str(name) not in known
    ]
    for names, why in (
        (away, _AWAY),
        (elsewhere, _ELSEWHERE),
        (gathered, "as they are compressed by gathering"),
        (taken, f"as the targets have another dimension {' or '.join(map(str, others))}"),
    ):
        if names:
            warn_caller(f"left out, {why}: {', '.join(names)}")
    # Coordinates of other places, such as the index of places that are gathered, mean nothing now.
    coordinates = [
        name
        for name, item in rest.coords.items()
        if str(name) in placed and not set(item.dims) <= set(wanted.dims)
    ]
    return rest.drop_vars([*known, *taken, *coordinates]).drop_dims(others)


def _is_gathered(data: xarray.Dataset, name: str) -> bool:
    """Whether places are gathered in a dimension of the variable, by the index along it."""
    indices = [data.variables[dim] for dim in data[name].dims if dim in data.variables]
    return any("compress" in {**index.encoding, **index.attrs} for index in indices)


def _bounds_of_others(data: xarray.Dataset, own_names: set[str]) -> set[str]:
    """The variables that are bounds of what does not depend on place, such as a time."""
    lost = own_names | at_places(data)
    others = [item for name, item in data.variables.items() if str(name) not in lost]
    return {str({**item.encoding, **item.attrs}.get("bounds")) for item in others}


def _is_same_dimension(rest: xarray.Dataset, dim: Any, size: int, index: Any) -> bool:
    """Whether it has the targets' length and, where its places have labels, theirs."""
    if rest.sizes[dim] != size:
        return False
    return dim not in rest.indexes or (index is not None and rest.indexes[dim].equals(index))


def _free_name(data: Any, name: str) -> str:
    """A name that no variable has which is carried on; mappings of the source are not."""
    known = data.variables if isinstance(data, xarray.Dataset) else data.coords
    taken = {str(other) for other in known} - {str(other) for other in mappings(data)}
    while name in taken:
        name += "_"
    return name


def _with_bounds(made: xarray.Dataset, wanted: Places) -> xarray.Dataset:
    """The same with the bounds of the target, which its coordinates name."""
    bounds = wanted.bounds()
    if not bounds or any(name in made.variables for name in bounds):
        return _without_bounds(made, wanted)
    coordinates = {}
    for name in wanted.coordinates:
        item = made[name].variable.copy(deep=False)
        own = f"{name}_bnds"
        if own in bounds and "bounds" not in {**item.attrs, **item.encoding}:
            item.attrs = {**item.attrs, "bounds": own}
            coordinates[name] = item
    return made.assign_coords({**bounds, **coordinates})


def _without_bounds(made: Any, wanted: Places) -> Any:
    """The same if no coordinate of the target names bounds, which are not there."""
    coordinates = {}
    for name in wanted.coordinates:
        item = made[name].variable.copy(deep=False)
        item.attrs = {key: text for key, text in item.attrs.items() if key != "bounds"}
        item.encoding = {key: text for key, text in item.encoding.items() if key != "bounds"}
        coordinates[name] = item
    return made.assign_coords(coordinates)


def _with_descriptions(made: Any, wanted: Places) -> Any:
    """The same with what a list of targets says of itself, as coordinates. They give way to what
    has their names, as in files.
    """
    taken = {str(name) for name in (*getattr(made, "variables", made.coords), *made.dims)}
    taken.add(str(getattr(made, "name", "")))
    renamed = {}
    found = {}
    for name, item in wanted.described().items():
        is_there = name in made.coords and made.coords[name].dims == item.dims
        if is_there and name not in wanted.coordinates:
            continue  # it came with the longitudes and latitudes
        new = str(name)
        while new in taken and (new,) != item.dims:
            new += "_"
        if new != str(name):
            renamed[str(name)] = new
        taken.add(new)
        found[new] = item
    if renamed:
        texts = ", ".join(f"{name} is {new}" for name, new in renamed.items())
        warn_caller(f"what describes places gave way to fields: {texts}")
    return made.assign_coords(found)


def _with_feature_type(made: xarray.Dataset, wanted: Places) -> xarray.Dataset:
    """The same with CF's `featureType`, if its fields have one, for which names have their role."""
    feature = feature_type(made, wanted.dims[0])
    if not feature:
        return made
    roles = {"profile": "profile_id", "point": None}
    named = {}
    for name, item in made.coords.items():
        if item.dims != wanted.dims or "cf_role" not in item.attrs:
            continue
        role = roles.get(feature, "timeseries_id")
        attrs = {key: text for key, text in item.attrs.items() if key != "cf_role"}
        named[name] = item.variable.copy(deep=False)
        named[name].attrs = attrs if role is None else {**attrs, "cf_role": role}
    return made.assign_attrs(featureType=feature).assign_coords(named)


def _kind(array: Any) -> Any:
    return array.dtype if array.dtype.kind == "f" else np.dtype(np.float64)
