# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Rondel as a backend of UXarray's remapping.

The import adds the backend to the accessors `remap` of `UxDataArray` and `UxDataset`:

    import uxarray as ux
    import uxarray_remap  # this file

    uxds.remap.nearest_neighbor(grid, backend="rondel")
    uxds.remap(grid, backend="rondel", rondel_method="conservative", rondel_options={"order": 2})

| rondel_method | rondel_options |
| --- | --- |
| nearest | |
| linear, laplace, sibson, hermite, cubic | those of `rondel.SphericalDelaunay.weights` |
| native: in the faces of the mesh for values at nodes, in its dual for values at faces | outside |
| inverse_distance | power, k |
| conservative: from faces to faces | those of `rondel.remap`: order, norm, masks, overlap |

Targets that a method gives no value, such as those outside of a regional mesh, are NaN. With
`use_by_default()` calls without `backend` use Rondel, too.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import rondel
import uxarray as ux
import xarray as xr
from uxarray.errors import DataCenteringError
from uxarray.remap import accessor, structured, utils
from uxarray.utils.coords import _preserve_valid_coords
from xarray.core.utils import UncachedAccessor

NATIVE = ("n_node", "n_face")
BETWEEN_SITES = ("linear", "laplace", "sibson", "hermite", "cubic")
METHODS = ("nearest", *BETWEEN_SITES, "native", "inverse_distance", "conservative")

default_backend = "uxarray"


def use_by_default(backend: str = "rondel") -> None:
    """Sets the backend of calls that name none."""
    global default_backend
    default_backend = backend


def require_none(options: Mapping[str, Any]) -> None:
    """Refuses arguments that are another backend's."""
    for name, value in options.items():
        if value is not None:
            raise TypeError(f"{name} has no effect with the backend 'rondel'")


def corners_of(grid: ux.Grid) -> np.ndarray:
    """The nodes of each face, shape (n, k); faces with fewer nodes end with -1."""
    faces = np.asarray(grid.face_node_connectivity.values, np.int64).copy()
    faces[np.arange(faces.shape[1]) >= np.asarray(grid.n_nodes_per_face.values)[:, None]] = -1
    return faces


def cells_of(grid: Any) -> rondel.CellSet:
    """The faces of a grid, or the cells of a target along axes, as cells for `rondel.remap`."""
    if isinstance(grid, structured.RectilinearGridSpec):
        return rondel.CellSet.lonlat_grid(grid.lon_edges, np.clip(grid.lat_edges, -90, 90))
    faces = corners_of(grid)
    last = np.take_along_axis(faces, (faces >= 0).sum(axis=1)[:, None] - 1, axis=1)
    faces = np.where(faces < 0, last, faces)
    lon, lat = np.asarray(grid.node_lon.values), np.asarray(grid.node_lat.values)
    return rondel.CellSet.corners(lon[faces], lat[faces])


def points_of(grid: Any, dim: str) -> np.ndarray:
    """Unit vectors to the nodes, edges or faces of a grid, or to the places of a target."""
    if isinstance(grid, structured.RectilinearGridSpec):
        lon, lat = np.meshgrid(grid.lon.values, grid.lat.values)
        return rondel.unit_vectors(lon.ravel(), lat.ravel())
    return utils._prepare_points(grid, dim)


def weights_of(
    source: ux.Grid, target: Any, dims: tuple[str, str], method: str, options: Mapping[str, Any]
) -> rondel.Weights:
    """The weights from one dimension of the source to one of the target."""
    if method == "conservative":
        if dims != ("n_face", "n_face"):
            raise DataCenteringError(
                "conservative remapping needs face-centered data and remap_to='faces', not "
                f"{dims[0]} to {dims[1]}"
            )
        return rondel.remap(cells_of(source), cells_of(target), **options).weights
    targets = points_of(target, dims[1])
    if method == "native":
        return native_weights(source, dims[0], targets, **options)
    sites = rondel.delaunay(points_of(source, dims[0]))
    if method == "inverse_distance":
        return inverse_distance_weights(sites, targets, **options)
    return sites.weights(targets, method, **options)


def native_weights(
    source: ux.Grid, dim: str, targets: np.ndarray, outside: str = "nan"
) -> rondel.Weights:
    """Weights in the faces of the mesh, or in those of its dual; what lies in no face is NaN, or
    has the value of the nearest place.
    """
    if dim not in NATIVE:
        raise DataCenteringError(f"native interpolation needs values at nodes or faces, not {dim}")
    if outside not in ("nan", "nearest"):
        raise ValueError(f"outside must be 'nan' or 'nearest', not {outside!r}")
    nodes = rondel.lonlat(points_of(source, "n_node")).T
    centers = rondel.lonlat(points_of(source, "n_face")).T if dim == "n_face" else None
    places = rondel.lonlat(targets).T
    made = rondel.native_weights(*nodes, corners_of(source), *places, centers=centers)
    if outside == "nan":
        return made
    sites = rondel.delaunay(points_of(source, dim))
    given, nearest = made.tocsr(), sites.weights(targets, "nearest").tocsr()
    is_empty = np.diff(given.indptr) == 0
    from scipy import sparse

    both = (given + sparse.diags(is_empty.astype(float)) @ nearest).tocsr()
    return rondel.Weights(both.indptr, both.indices, both.data, both.shape)


def inverse_distance_weights(
    sites: rondel.SphericalDelaunay, targets: np.ndarray, power: float = 2, k: int = 8
) -> rondel.Weights:
    """The weights of UXarray's formula, with chords as distances, for the k nearest sites."""
    from uxarray.remap.inverse_distance_weighted import _idw_weights

    near = sites.k_nearest(targets, min(k, len(sites.points)))
    distances = np.linalg.norm(sites.points[near] - targets[:, None], axis=2)
    data = np.ones(near.shape) if k == 1 else _idw_weights(distances, power)
    rows = np.arange(0, near.size + 1, near.shape[1])
    return rondel.Weights(rows, near.ravel(), data.ravel(), (len(targets), len(sites.points)))


def carried(
    array: Any, dim: str, target_dim: str, weights: rondel.Weights, **of_ux: Any
) -> xr.DataArray:
    """An array on the target; arrays of Dask stay lazy, in whole chunks along the source."""
    others = [d for d in array.dims if d != dim]
    ordered = array.transpose(*others, dim).variable
    if ordered.chunks is None:
        values = weights.apply(ordered.values)
    else:
        values = xr.apply_ufunc(
            weights.apply,
            ordered.chunk({dim: -1}),
            input_core_dims=[[dim]],
            output_core_dims=[[target_dim]],
            exclude_dims={dim},  # both may be faces, of different numbers
            dask="parallelized",
            output_dtypes=[np.float64],
            dask_gufunc_kwargs={"output_sizes": {target_dim: weights.shape[0]}},
        ).data
    kind = ux.UxDataArray if of_ux else xr.DataArray
    coords = _preserve_valid_coords(array, dim, others)
    dims = [*others, target_dim]
    return kind(values, dims=dims, coords=coords, name=array.name, attrs=array.attrs, **of_ux)


def remapped(
    source: Any, target: Any, remap_to: str, method: str | None, options: Mapping[str, Any] | None
) -> Any:
    """A `UxDataArray` or `UxDataset` on a grid, or a Dataset of xarray on a target along axes."""
    if method not in METHODS:
        raise ValueError(f"rondel_method must be one of {METHODS}, not {method!r}")
    utils._assert_dimension(remap_to)
    target_dim = utils.LABEL_TO_COORD[remap_to]
    dataset, is_array, name = utils._to_dataset(source)
    weights = {
        dim: weights_of(dataset.uxgrid, target, (dim, target_dim), method, options or {})
        for dim in sorted(utils._get_remap_dims(dataset))
    }
    is_grid = not isinstance(target, structured.RectilinearGridSpec)
    of_ux = {"uxgrid": target} if is_grid else {}
    variables = {}
    for key, array in dataset.data_vars.items():
        dim = next((d for d in array.dims if d in weights), None)
        if dim is not None:
            array = carried(array, dim, target_dim, weights[dim], **of_ux)
        variables[key] = array if is_grid else xr.DataArray(array)
    if is_grid:
        result = utils._construct_remapped_ds(source, variables, target, remap_to)
    else:
        flat = xr.Dataset(variables, attrs=dataset.attrs)
        result = structured._reshape_to_rectilinear(flat, target)
    return result[name] if is_array else result


def bilinear(source: Any, target: Any, remap_to: str, options: Mapping[str, Any] | None) -> Any:
    """Values at faces interpolated in the cells of the dual mesh, as UXarray's bilinear does."""
    utils._assert_dimension(remap_to)
    others = utils._get_remap_dims(utils._to_dataset(source)[0]) - {"n_face"}
    if others:
        raise DataCenteringError(f"bilinear remapping needs values at faces, not {sorted(others)}")
    return remapped(source, target, remap_to, "native", options)


class RemapAccessor(accessor.RemapAccessor):
    """The accessor `remap` of UXarray with the backend "rondel" beside its own."""

    def __call__(self, *args: Any, backend: str | None = None, **options: Any) -> Any:
        """As in UXarray; with the backend "rondel" by `rondel_method`, by default 'nearest'."""
        backend = backend or default_backend
        if backend != "rondel":
            return super().__call__(*args, backend=backend, **options)
        return self.nearest_neighbor(*args, backend=backend, **options)

    def nearest_neighbor(
        self,
        destination_grid: ux.Grid,
        remap_to: str = "faces",
        backend: str | None = None,
        rondel_method: str = "nearest",
        rondel_options: Mapping[str, Any] | None = None,
        **options: Any,
    ) -> Any:
        """As in UXarray, or by any `rondel_method`."""
        backend = backend or default_backend
        if backend != "rondel":
            return super().nearest_neighbor(destination_grid, remap_to, backend, **options)
        require_none(options)
        return remapped(self.ux_obj, destination_grid, remap_to, rondel_method, rondel_options)

    def inverse_distance_weighted(
        self,
        destination_grid: ux.Grid,
        remap_to: str = "faces",
        power: float = 2,
        k: int = 8,
        backend: str | None = None,
        **options: Any,
    ) -> Any:
        """As in UXarray."""
        backend = backend or default_backend
        if backend != "rondel":
            return super().inverse_distance_weighted(
                destination_grid, remap_to, power, k, backend, **options
            )
        require_none(options)
        near = {"power": power, "k": k}
        return remapped(self.ux_obj, destination_grid, remap_to, "inverse_distance", near)

    def bilinear(
        self,
        destination_grid: ux.Grid,
        remap_to: str = "faces",
        backend: str | None = None,
        rondel_options: Mapping[str, Any] | None = None,
        **options: Any,
    ) -> Any:
        """As in UXarray, for values at faces: in the cells of the dual mesh."""
        backend = backend or default_backend
        if backend != "rondel":
            return super().bilinear(destination_grid, remap_to, backend, **options)
        require_none(options)
        return bilinear(self.ux_obj, destination_grid, remap_to, rondel_options)

    def to_rectilinear(
        self,
        lon: Any,
        lat: Any,
        backend: str | None = None,
        rondel_method: str = "nearest",
        rondel_options: Mapping[str, Any] | None = None,
        **options: Any,
    ) -> Any:
        """As in UXarray, or by any `rondel_method`."""
        backend = backend or default_backend
        if backend != "rondel":
            return super().to_rectilinear(lon, lat, backend, **options)
        require_none(options)
        target = structured._normalize_rectilinear_target(lon, lat)
        return remapped(self.ux_obj, target, "faces", rondel_method, rondel_options)

    def to_structured(self, lon: Any, lat: Any, **options: Any) -> Any:
        """As `to_rectilinear`."""
        return self.to_rectilinear(lon, lat, **options)

    to_lonlat = to_structured


for kind in (ux.UxDataArray, ux.UxDataset):
    kind.remap = UncachedAccessor(RemapAccessor)
