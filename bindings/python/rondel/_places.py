# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The places and cells of what xarray holds, and fields that are carried from one to another."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np
import xarray

from ._arrays import lonlat, unit_vectors
from ._partition import Partition
from ._types import BoolArray, FloatArray
from ._weights import Weights

_MARKS = {
    "lon": ("longitude", ("degrees_east", "degree_east"), ("lon", "longitude", "lons")),
    "lat": ("latitude", ("degrees_north", "degree_north"), ("lat", "latitude", "lats")),
}
_CORNERS = ("_b", "_bnds", "_bounds", "_corners", "_vertices")


def _coordinate(data: Any, kind: str, name: Hashable | None) -> xarray.DataArray:
    """The longitudes or latitudes of a Dataset or DataArray."""
    if name is not None:
        return data[name]
    standard_name, units, names = _MARKS[kind]
    known = {
        key: data[key]
        for key in (*data.coords, *getattr(data, "data_vars", ()))
        if not str(key).endswith(_CORNERS)
    }
    for found in (
        [k for k, v in known.items() if v.attrs.get("standard_name") == standard_name],
        [k for k, v in known.items() if v.attrs.get("units") in units],
        [k for k in known if str(k).lower() in names],
    ):
        if len(found) == 1:
            return known[found[0]]
        if found:
            texts = " and ".join(map(str, found))
            raise ValueError(f"{texts} may be the {standard_name}s: say {kind}=NAME")
    raise ValueError(f"no coordinate has the {standard_name}s: say {kind}=NAME")


class Places:
    """Places of a Dataset, a DataArray, a Partition, a mapping or a tuple (lon, lat) of arrays."""

    def __init__(
        self,
        data: Any,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        *,
        are_points: bool = False,
    ) -> None:
        self._partition = data if isinstance(data, Partition) else None
        if self._partition is not None:
            data = _centers(self._partition)
        elif isinstance(data, Mapping) and not isinstance(data, xarray.Dataset):
            data = _dataset(dict(data), are_points)
        elif isinstance(data, tuple):
            if len(data) != 2:
                raise ValueError(f"a tuple is (lon, lat), not {len(data)} arrays")
            data = _dataset({"lon": data[0], "lat": data[1]}, are_points)
        self._data = data
        self._lons, self._lats = _coordinate(data, "lon", lon), _coordinate(data, "lat", lat)
        # Two axes of a grid: the latitudes come first, as usual.
        south, west = xarray.broadcast(_bare(self._lats), _bare(self._lons))
        self.coordinates = {
            self._lats.name: self._lats.variable,
            self._lons.name: self._lons.variable,
        }
        self.dims = south.dims
        self.shape = south.shape
        self.lon, self.lat = west.values, south.values

    def points(self) -> FloatArray:
        return unit_vectors(self.lon, self.lat)

    @property
    def are_axes(self) -> bool:
        return self._lons.ndim == self._lats.ndim == 1 and self._lons.dims != self._lats.dims

    @property
    def axes(self) -> tuple[FloatArray, FloatArray]:
        return self._lons.values, self._lats.values

    def mask(self) -> BoolArray | None:
        """Which places take part: those where the variable `mask` is not 0, as of xESMF."""
        if self._partition is not None:
            return self._partition.mask
        if isinstance(self._data, xarray.DataArray) or "mask" not in self._data:
            return None
        return np.asarray(self._data["mask"].transpose(*self.dims) != 0).reshape(-1)

    def cells(self, threads: int | None) -> Partition:
        """The cells around the places, by their bounds or, of a grid, half way between them."""
        if self._partition is not None:
            return self._partition
        lon, lat = self._corners(self._lons), self._corners(self._lats)
        if lon is None or lat is None:
            if self.are_axes:
                return Partition.lonlat_centers(*self.axes, threads=threads)
            raise ValueError(
                "there are no corners of cells: name them lon_b and lat_b, or in the attribute "
                "bounds of the coordinates"
            )
        if self.are_axes:
            lines = (_lines(lon, len(self.axes[0])), _lines(lat, len(self.axes[1])))
            return Partition.lonlat_grid(np.unwrap(lines[0], period=360), lines[1], threads=threads)
        if lon.shape != self.shape and lon.shape[: len(self.shape)] != self.shape:
            lon, lat = _four(lon, self.shape), _four(lat, self.shape)
        return Partition.corners(lon, lat, threads=threads)

    def _corners(self, coordinate: xarray.DataArray) -> Any:
        names = (coordinate.attrs.get("bounds"), f"{coordinate.name}_b", f"{coordinate.name}_bnds")
        for name in names:
            if name is not None and name in self._data:
                return np.asarray(self._data[name].values, np.float64)
        return None


def _bare(coordinate: xarray.DataArray) -> xarray.DataArray:
    return xarray.DataArray(coordinate.variable)


def _centers(partition: Partition) -> xarray.Dataset:
    """The cells' centers of mass; dimensions as the partition has them."""
    dims = ("y", "x") if len(partition.shape) == 2 else ("cell",)
    degrees = lonlat(partition.centers).reshape(*partition.shape, 2)
    return _marked({"lon": (dims, degrees[..., 0]), "lat": (dims, degrees[..., 1])})


def _dataset(arrays: dict[Any, Any], are_points: bool) -> xarray.Dataset:
    """Longitudes and latitudes (and lon_b, lat_b, mask), as axes, of points, or curvilinear."""
    rank = np.ndim(arrays["lon"])
    for kind in ("lat", "lon"):
        if rank not in (1, 2) or np.ndim(arrays[kind]) != rank:
            raise ValueError(f"{kind} of a grid must have shape (n,), not {np.shape(arrays[kind])}")
    dims: dict[str, tuple[str, ...]]
    if rank == 2:
        dims = {"lon": ("y", "x"), "lat": ("y", "x"), "mask": ("y", "x")}
    elif are_points:
        dims = {"lon": ("point",), "lat": ("point",), "mask": ("point",)}
    else:
        dims = {"lon": ("lon",), "lat": ("lat",), "mask": ("lat", "lon")}
    variables = {}
    for name, values in arrays.items():
        array = np.asarray(values)
        own = tuple(f"{name}_{k}" for k in range(array.ndim))
        variables[name] = (dims.get(name, own), array)
    return _marked(variables)


def _marked(variables: dict[Any, Any]) -> xarray.Dataset:
    made = xarray.Dataset(variables)
    made = made.set_coords([name for name in ("lon", "lat") if name in made])
    for kind, (standard_name, units, _) in _MARKS.items():
        made[kind].attrs.update(standard_name=standard_name, units=units[0])
    return made


def _lines(bounds: Any, count: int) -> FloatArray:
    """The lines of a grid, from these or from the two of each cell."""
    if bounds.shape == (count + 1,):
        return bounds
    if bounds.shape != (count, 2):
        raise ValueError(
            f"bounds must have shape ({count + 1},) or ({count}, 2), not {bounds.shape}"
        )
    if not np.allclose(bounds[1:, 0], bounds[:-1, 1], atol=1e-5):
        raise ValueError("bounds leave gaps between cells")
    return np.append(bounds[:, 0], bounds[-1, 1])


def _four(corners: Any, shape: tuple[int, ...]) -> FloatArray:
    """Those of each cell, of an array of all of a curvilinear grid."""
    if len(shape) != 2 or corners.shape != (shape[0] + 1, shape[1] + 1):
        raise ValueError(f"corners of cells of shape {shape} cannot have shape {corners.shape}")
    around = (corners[:-1, :-1], corners[:-1, 1:], corners[1:, 1:], corners[1:, :-1])
    return np.stack(around, axis=-1)


def carried(
    data: Any,
    weights: Weights,
    source: Places,
    wanted: Places,
    *,
    skipna: bool,
    most_missing: float,
    fill: float = np.nan,
    keep_attrs: bool = True,
) -> Any:
    """A Dataset or DataArray at other places."""

    def applied(values: Any) -> Any:
        fields = values.reshape(*values.shape[: values.ndim - len(source.dims)], -1)
        found = weights.apply(fields, skipna=skipna, most_missing=most_missing, fill=fill)
        shape = (*found.shape[:-1], *wanted.shape)
        return found.reshape(shape).astype(_kind(values), copy=False)

    def moved(array: xarray.DataArray) -> xarray.DataArray:
        found = xarray.apply_ufunc(
            applied,
            array,
            input_core_dims=[source.dims],
            output_core_dims=[wanted.dims],
            exclude_dims=set(source.dims),
            keep_attrs=keep_attrs,
            dask="parallelized",
            output_dtypes=[_kind(array)],
            dask_gufunc_kwargs={
                "output_sizes": dict(zip(wanted.dims, wanted.shape, strict=True)),
                "allow_rechunk": True,
            },
        )
        return found.assign_coords(wanted.coordinates)

    if isinstance(data, xarray.DataArray):
        return moved(data)
    taken = {
        name: moved(array)
        for name, array in data.data_vars.items()
        if set(source.dims) <= set(array.dims)
        and array.dtype.kind in "iuf"
        and name not in source.coordinates
    }
    rest = data.drop_dims(source.dims)
    whole = rest.assign(taken).assign_coords(wanted.coordinates)
    if not keep_attrs:
        whole = whole.drop_attrs(deep=False)
    return whole[[name for name in data.data_vars if name in whole.data_vars]]


def _kind(array: Any) -> Any:
    return array.dtype if array.dtype.kind == "f" else np.dtype(np.float64)
