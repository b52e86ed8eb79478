# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""``ds.rondel``: interpolation of what `xarray` holds.

``import rondel.xarray`` gives every Dataset and DataArray the accessor `rondel`. Longitudes and
latitudes are found by their attributes (CF conventions: `standard_name` or `units`), then by their
names; in degrees, of cells, curvilinear or as the two axes of a grid.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np
import xarray

from ._arrays import unit_vectors
from ._delaunay import delaunay_lonlat
from ._interpolation import Method
from ._weights import Weights

__all__ = ["RondelAccessor"]

_MARKS = {
    "lon": ("longitude", ("degrees_east", "degree_east"), ("lon", "longitude", "lons")),
    "lat": ("latitude", ("degrees_north", "degree_north"), ("lat", "latitude", "lats")),
}


def _coordinate(data: Any, kind: str, name: Hashable | None) -> xarray.DataArray:
    """The longitudes or latitudes of a Dataset or DataArray."""
    if name is not None:
        return data[name]
    standard_name, units, names = _MARKS[kind]
    known = {key: data[key] for key in (*data.coords, *getattr(data, "data_vars", ()))}
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


class _Places:
    """Places of a Dataset, a DataArray or a tuple (lon, lat) of the axes of a grid."""

    def __init__(self, data: Any, lon: Hashable | None = None, lat: Hashable | None = None) -> None:
        if isinstance(data, tuple):
            data = _grid(*data)
        lons, lats = _coordinate(data, "lon", lon), _coordinate(data, "lat", lat)
        # Two axes of a grid: the latitudes come first, as usual.
        south, west = xarray.broadcast(_bare(lats), _bare(lons))
        self.coordinates = {lats.name: lats.variable, lons.name: lons.variable}
        self.dims = south.dims
        self.shape = south.shape
        self.lon, self.lat = west.values, south.values

    def points(self) -> Any:
        return unit_vectors(self.lon, self.lat)


def _bare(coordinate: xarray.DataArray) -> xarray.DataArray:
    return xarray.DataArray(coordinate.variable)


def _grid(lon: Any, lat: Any) -> xarray.Dataset:
    axes = {}
    for kind, degrees in (("lat", lat), ("lon", lon)):
        if np.ndim(degrees) != 1:
            raise ValueError(f"{kind} of a grid must have shape (n,), not {np.shape(degrees)}")
        standard_name, units, _ = _MARKS[kind]
        attributes = {"standard_name": standard_name, "units": units[0]}
        axes[kind] = (kind, np.asarray(degrees), attributes)
    return xarray.Dataset(coords=axes)


class RondelAccessor:
    """What ``ds.rondel`` and ``da.rondel`` are."""

    def __init__(self, data: Any) -> None:
        self._data = data

    def weights(
        self,
        target: Any,
        method: Method = "sibson",
        *,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        **options: Any,
    ) -> Weights:
        """What `interpolate` applies; to be kept, and given to it.

        Parameters
        ----------
        target, method, lon, lat, **options
            As in `interpolate`.

        Returns
        -------
        Weights

        """
        source = _Places(self._data, lon, lat)
        tri = delaunay_lonlat(source.lon, source.lat, threads=options.get("threads"))
        return tri.weights(_Places(target).points(), method, **options)

    def interpolate(
        self,
        target: Any,
        method: Method = "sibson",
        *,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        weights: Weights | None = None,
        skipna: bool = False,
        most_missing: float = 1.0,
        **options: Any,
    ) -> Any:
        """Values at other places. Attributes stay, and so do other dimensions, such as time.

        Parameters
        ----------
        target : Dataset, DataArray or tuple of array_like
            What has the longitudes and latitudes of the result: of points, of a curvilinear grid,
            or as axes; or a tuple (lon, lat) of axes, in degrees.
        method : str, optional
        lon, lat : str, optional
            The names of the longitudes and latitudes of the source, if they are not found.
        weights : Weights, optional
            Those of a former call of `weights`, with the same source and target places.
        skipna : bool, optional
        most_missing : float, optional
            As in `Weights.apply`.
        **options
            As in `SphericalDelaunay.weights`.

        Returns
        -------
        Dataset or DataArray
            As the source: numbers are interpolated, in their type if it is a floating one; what
            does not depend on place stays; other variables of the places, such as texts, are left
            out. Arrays of Dask stay lazy.

        Raises
        ------
        ValueError
            If longitudes or latitudes are not found, or the weights are of other places.

        """
        source, wanted = _Places(self._data, lon, lat), _Places(target)
        if weights is None:
            weights = self.weights(target, method, lon=lon, lat=lat, **options)
        elif not _fits(weights, source, wanted):
            raise ValueError("the weights are of other places")

        def applied(values: Any) -> Any:
            fields = values.reshape(*values.shape[: values.ndim - len(source.dims)], -1)
            found = weights.apply(fields, skipna=skipna, most_missing=most_missing)
            shape = (*found.shape[:-1], *wanted.shape)
            return found.reshape(shape).astype(_kind(values), copy=False)

        def moved(array: xarray.DataArray) -> xarray.DataArray:
            found = xarray.apply_ufunc(
                applied,
                array,
                input_core_dims=[source.dims],
                output_core_dims=[wanted.dims],
                exclude_dims=set(source.dims),
                keep_attrs=True,
                dask="parallelized",
                output_dtypes=[_kind(array)],
                dask_gufunc_kwargs={
                    "output_sizes": dict(zip(wanted.dims, wanted.shape, strict=True)),
                    "allow_rechunk": True,
                },
            )
            return found.assign_coords(wanted.coordinates)

        data = self._data
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
        return whole[[name for name in data.data_vars if name in whole.data_vars]]


_REGISTERS: tuple[Any, ...] = (
    xarray.register_dataset_accessor,
    xarray.register_dataarray_accessor,
)
for _register in _REGISTERS:
    _register("rondel")(RondelAccessor)


def _kind(array: Any) -> Any:
    return array.dtype if array.dtype.kind == "f" else np.dtype(np.float64)


def _fits(weights: Weights, source: _Places, wanted: _Places) -> bool:
    """Whether they have the shape and, where these are known, the hashes."""
    if weights.shape != (wanted.lon.size, source.lon.size):
        return False
    return weights.is_of(
        source.points() if weights.sites_hash else None,
        wanted.points() if weights.targets_hash else None,
    )
