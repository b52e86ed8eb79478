# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of the fields of xarray."""

from __future__ import annotations

from collections.abc import Hashable
from typing import TYPE_CHECKING, Any

import xarray

from ._errors import warn_caller
from ._places import Places
from ._values import unpacked
from ._voronoi import SphericalVoronoi

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_field(
    data: Any,
    name: Hashable | None,
    ax: Any,
    lon: Hashable | None,
    lat: Hashable | None,
    label: str | None,
    options: dict[str, Any],
) -> Axes:
    """Draws a field of a Dataset or DataArray on its cells, or on the Voronoi cells of its places:
    ``data.rondel.plot``.
    """
    array = data
    if isinstance(data, xarray.Dataset):
        if name is None:
            fields = [
                str(each) for each, item in data.data_vars.items() if item.dtype.kind in "biuf"
            ]
            raise TypeError(f"plot() needs the name of a field, for example one of {fields}")
        array = data[name]
    elif name is not None:
        raise TypeError("a DataArray is one field: plot() takes no name")
    places = Places(data if isinstance(data, xarray.Dataset) else array, lon, lat)
    others = [str(dim) for dim in array.dims if dim not in places.dims]
    missing = [str(dim) for dim in places.dims if dim not in array.dims]
    if missing:
        raise ValueError(f"{array.name!r} has no dimension {' and '.join(missing)} of the places")
    array = unpacked(array)
    if long := [dim for dim in others if array.sizes[dim] > 1]:
        chosen = ", ".join(f"{dim}=0" for dim in long)
        raise ValueError(
            f"a picture shows one field, and {array.name!r} has {' and '.join(long)}: choose one, "
            f"as by .isel({chosen})"
        )
    field = array.isel(dict.fromkeys(others, 0)).transpose(*places.dims)
    label = _label(array) if label is None else label
    if places.have_cells:
        return places.cells(None).plot(field.values, ax, label=label, **options)
    _tell_of_lost_cells(data, array, places)
    pairs, numbers = places.located()
    values = field.values.reshape(-1)
    diagram = SphericalVoronoi.from_lonlat(pairs[:, 0], pairs[:, 1], duplicates="merge")
    return diagram.plot(values if numbers is None else values[numbers], ax, label=label, **options)


def _tell_of_lost_cells(data: Any, array: Any, places: Places) -> None:
    """Warns if attributes say where the cells are, and what they name is not there, as where a
    variable is taken out of a Dataset.
    """
    named = [(array, "grid_mapping"), (array, "mesh")]
    named += [(item, "bounds") for item in places.coordinates.values()]
    known = data.variables if isinstance(data, xarray.Dataset) else array.coords
    texts = [str({**item.encoding, **item.attrs}.get(key, "")) for item, key in named]
    words = " ".join(texts).replace(":", " ").split()
    if lost := [word for word in words if word not in known]:
        warn_caller(
            f"the cells of {array.name!r} are not known, as there is no {', '.join(lost)}, which "
            "its attributes name: the Voronoi cells of its places are drawn; "
            f"dataset.rondel.plot({array.name!r}) of its Dataset knows them"
        )


def _label(array: Any) -> str:
    """What a field is, with its unit, as its attributes say it."""
    words = array.attrs.get("long_name") or array.attrs.get("standard_name") or array.name or ""
    units = array.attrs.get("units")
    return f"{words} ({units})" if units not in (None, "", "1") else str(words)
