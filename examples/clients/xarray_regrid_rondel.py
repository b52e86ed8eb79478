# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Rondel behind the accessor `regrid` of xarray-regrid.

The import adds a method to the accessor of DataArrays and Datasets, whose target is any grid that
`rondel.Regridder` takes: axes, curvilinear coordinates, meshes, points, and grids by their names.

    import xarray_regrid_rondel  # this file

    data.regrid.rondel("healpix:6")
    data.regrid.rondel(target, "conservative_2nd", nan_threshold=0.5)

After `use_by_default()` the methods `linear`, `nearest` and `conservative` of the accessor compute
on the sphere, too, where longitude and latitude are all that is regridded. For other coordinates
they do what they did.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from typing import Any

import numpy as np
import rondel
import xarray as xr
from xarray_regrid.regrid import Regridder, validate_input

LONGITUDES = ("lon", "longitude")
LATITUDES = ("lat", "latitude")

# The accessor's own methods, and their names in Rondel.
METHODS = {"linear": "bilinear", "nearest": "nearest_s2d", "conservative": "conservative_normed"}

own_methods = {name: getattr(Regridder, name) for name in METHODS}


def regridded(
    data: Any,
    target: Any,
    method: str = "conservative_normed",
    *,
    skipna: bool = True,
    nan_threshold: float = 1.0,
    output_chunks: dict[Hashable, int] | None = None,
    **options: Any,
) -> Any:
    """Data on the target grid.

    Parameters
    ----------
    data : DataArray or Dataset
        Fields with longitudes and latitudes.
    target : Dataset, dict, tuple, CellSet or str
        As in `rondel.Regridder`.
    method : str
        As in `rondel.Regridder`.
    skipna : bool
        Whether a target needs no more than the share of values that `nan_threshold` leaves; all of
        them where it is False.
    nan_threshold : float
        The share of a target that may be missing.
    output_chunks : dict, optional
        The chunks of the result, if `data` is lazy.
    **options
        Those of `rondel.Regridder`.

    """
    if not 0.0 <= nan_threshold <= 1.0:
        raise ValueError(f"nan_threshold must be from 0 to 1, not {nan_threshold}")
    regridder = rondel.Regridder(data, target, method, **options)
    made = regridder(
        data,
        keep_attrs=True,
        skipna=skipna,
        na_thres=nan_threshold if skipna else 1.0,
        output_chunks=output_chunks,
    )
    for name in set(made.coords).intersection(data.coords):
        made[name].attrs = data[name].attrs
    return made


def common_axes(data: Any, target: xr.Dataset) -> list[Hashable]:
    """The axes that both have."""
    return [
        name
        for name, coordinate in target.coords.items()
        if coordinate.dims == (name,) and name in data.coords
    ]


def is_one_of(name: Hashable, names: tuple[str, ...]) -> bool:
    """True if the name is one of these, in small or capital letters."""
    return str(name).lower() in names


def are_lonlat(axes: list[Hashable], target: xr.Dataset) -> bool:
    """True if the axes are a longitude and a latitude, of more than one place each, so that cells
    have a width.
    """
    return (
        sum(is_one_of(name, LONGITUDES) for name in axes) == 1
        and sum(is_one_of(name, LATITUDES) for name in axes) == 1
        and len(axes) == 2
        and all(target.sizes[name] > 1 for name in axes)
    )


def once_around(grid: xr.Dataset, lon: Hashable) -> Iterator[xr.Dataset]:
    """Parts of a grid whose cells do not overlap, as those of 164 columns of 2.2 degrees do."""
    centers = grid[lon].values.astype(float)
    middles = (centers[1:] + centers[:-1]) / 2
    west, east = 2 * centers[0] - middles[0], 2 * centers[-1] - middles[-1]
    sides = np.concatenate([[west], middles, [east]])
    begin = 0
    while begin < len(centers):
        is_within = np.abs(sides[begin + 1 :] - sides[begin]) <= 360 + 1e-9
        end = begin + np.count_nonzero(is_within)
        part = grid.isel({lon: slice(begin, end)})
        pairs = np.stack([sides[begin:end], sides[begin + 1 : end + 1]], axis=1)
        part = part.assign_coords({f"{lon}_sides": ((lon, "side"), pairs)})
        part[lon].attrs = {**grid[lon].attrs, "bounds": f"{lon}_sides"}
        yield part
        begin = end


def replacement(name: str) -> Any:
    """A method of the accessor that asks Rondel where it can."""

    def method(self: Regridder, ds_target_grid: xr.Dataset, *arguments: Any, **options: Any) -> Any:
        data = self._obj
        target = validate_input(data, ds_target_grid, options.get("time_dim", "time"))
        axes = common_axes(data, target)
        if arguments or not are_lonlat(axes, target):
            return own_methods[name](self, ds_target_grid, *arguments, **options)
        rest = {
            key: value
            for key, value in options.items()
            if key not in ("time_dim", "latitude_coord")
        }
        grid = xr.Dataset(coords={axis: target[axis] for axis in axes})
        parts = [grid]
        lon = next(axis for axis in axes if is_one_of(axis, LONGITUDES))
        if name == "conservative":
            parts = list(once_around(grid, lon))
        made = [regridded(data, part, METHODS[name], **rest) for part in parts]
        whole = made[0] if len(made) == 1 else xr.concat(made, dim=lon)
        return whole.drop_vars(f"{lon}_sides", errors="ignore").transpose(*data.dims)

    method.__doc__ = own_methods[name].__doc__
    return method


def use_by_default(wanted: bool = True) -> None:
    """Sets whether the accessor's own methods ask Rondel."""
    for name, own in own_methods.items():
        setattr(Regridder, name, replacement(name) if wanted else own)


Regridder.rondel = lambda self, target, *arguments, **options: regridded(
    self._obj, target, *arguments, **options
)
