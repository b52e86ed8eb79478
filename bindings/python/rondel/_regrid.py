# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regridding of what xarray holds, in one call."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from typing import Any, cast, get_args

from ._blocks import OutputChunks
from ._errors import warn_caller
from ._geometries import Corners, Invalid
from ._native import Extrapolation
from ._regrid_files import FieldMethod, as_method
from ._regridder import Regridder, RegridMethod
from ._remap import CellOverlap, SlopeLimiter
from ._types import Progress
from ._weights import require_share

# The names of `Regridder` for the methods of `regrid_file`. Categories are told by the fields.
_OF_REGRIDDER = {
    "conservative": "conservative_normed",
    "conservative_2nd": "conservative_2nd_normed",
    "largest_share": "conservative_normed",
    "nearest": "nearest_s2d",
}


def without_mask(grid: Any, what: str) -> Any:
    """The same places without the variable that a `Regridder` would take for a mask."""
    import xarray

    is_labeled = isinstance(grid, (xarray.Dataset, xarray.DataArray))
    known = grid.coords if isinstance(grid, xarray.DataArray) else grid
    if not (is_labeled or isinstance(grid, Mapping)) or "mask" not in known:
        return grid
    warn_caller(
        f"the variable 'mask' of the {what} masks nothing here; rondel.Regridder takes it for one"
    )
    if is_labeled:
        return grid.drop_vars("mask")
    return {name: values for name, values in grid.items() if name != "mask"}


def regrid(
    data: Any,
    target: Any,
    method: FieldMethod | None = None,
    *,
    lon: Hashable | None = None,
    lat: Hashable | None = None,
    lon_out: Hashable | None = None,
    lat_out: Hashable | None = None,
    locstream_out: bool = False,
    max_missing: float = 0.5,
    output_chunks: OutputChunks = None,
    extrap_method: Extrapolation | None = None,
    extrap_distance: float | None = None,
    corners: Corners = "error",
    overlap: CellOverlap = "error",
    invalid: Invalid = "error",
    limiter: SlopeLimiter = "none",
    vectors: Iterable[tuple[str, str]] = (),
    threads: int | None = None,
    progress: Progress = None,
) -> Any:
    """Brings a Dataset or DataArray to another grid, or to points.

    It needs xarray. A `Regridder` does the same in two steps, for many data on one grid, and
    `regrid_file` for files that do not fit into memory.

    Parameters
    ----------
    data : Dataset or DataArray
        Fields with their longitudes and latitudes, or at the cells of a mesh that the Dataset has
        (UGRID, SCRIP, ESMF, MPAS, ICON or Exodus); arrays of Dask stay lazy. A variable `mask` is a
        field as others here, and masks nothing, as with `regrid_file`; a warning says so. A
        `Regridder` takes it for a mask, as xESMF does.
    target : str, Dataset, DataArray, DataFrame, GeoDataFrame, dict, tuple or CellSet
        The name of a grid (`CellSet.named`), or a grid as `Regridder` takes it. Or points, with
        methods between places: a DataFrame with columns `lon` and `lat` in degrees, a GeoDataFrame
        of points, a Dataset whose longitudes and latitudes have one dimension, or, with
        `locstream_out`, a dictionary or tuple (lon, lat) of arrays of shape (n,). Other columns,
        and coordinates and texts along the dimension of the points, become coordinates of the
        result. A dimension that the data have, too, as a time of both, becomes `point`, with a
        warning.
    method : str, optional
        'conservative' and 'conservative_2nd': means over cells, divided by the covered area of a
        target, as those of 'conservative_normed' and 'conservative_2nd_normed' of a `Regridder`;
        'largest_share': the value that the largest part of a target has; 'nearest', 'linear',
        'laplace', 'sibson', 'hermite', 'cubic' and 'bilinear': between the centers; 'native': in
        the cells of the mesh of `data` itself, as a `Regridder` does it. Hyphens, as of the
        command, are underscores. By default arrays with the attribute `flag_values`, `flag_masks`
        or `flag_meanings` get 'largest_share', and all others 'conservative', as in `regrid_file`
        and the command; a method that is named is that of all arrays. Of arrays that are sums over
        cells by their attribute `cell_methods` ("area: sum") each target gets its share of each
        source's sum with 'conservative' and 'conservative_2nd', whatever `max_missing` is.
    lon, lat, lon_out, lat_out : str, optional
        The names of the longitudes and latitudes of both sides, if they are not found.
    locstream_out : bool, optional
        Whether a dictionary or tuple has the coordinates of points instead of axes, as in
        `Regridder`; by default False.
    max_missing : float, optional
        The share of a target that no source may cover, with conservative methods, and of its
        covered part in which values may be missing, from 0 to 1; by default 0.5 for both, as in
        `regrid_file`; with 'conservative_2nd' gradients end at missing values, as there.
    output_chunks : int, tuple, dict or str, optional
        The lengths of the blocks along the dimensions of the target, for arrays of Dask, as a
        `Regridder` takes them; by default 'auto'.
    extrap_method : {None, 'nearest_s2d', 'inverse_dist', 'creep_fill'}, optional
        The value of targets without one: none (default); that of the nearest source with a value;
        the mean of the 8 nearest ones by the inverse square of the distance; or the mean of the
        neighboring targets with values, level by level. 'nearest', 'idw' and 'creep' are the same.
        As in `regrid_file`, each field is filled by its own gaps, but for sums over cells; arrays
        of Dask have one block for all targets then.
    extrap_distance : float, optional
        How far sources may be from a target that is extrapolated, in kilometers; by default any.
    corners : {'error', 'made'}, optional
        As in `Regridder`: corners of cells where the coordinates have no bounds.
    overlap : {'error', 'first', 'share', 'each'}, optional
        As in `Regridder`: what conservative methods do if cells of one grid overlap.
    invalid : {'error', 'repair'}, optional
        As in `Regridder`: what they do if a cell crosses or overlaps itself.
    limiter : {'none', 'slopes'}, optional
        What limits 'conservative_2nd', as in `Regridder`: with 'slopes' no value is beyond those of
        the sources around.
    vectors : iterable of (str, str), optional
        Pairs of variables that are the eastward and northward components of vectors, such as winds,
        as in a call of a `Regridder`.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    Dataset or DataArray
        The fields at the target, with their attributes. With means over cells `cell_methods` says
        so; a Dataset at points has the attribute `featureType` of CF, if all of its fields are of
        one type.

    Raises
    ------
    ValueError
        If there is no such method or grid, or coordinates are not found; `InvalidInput` if cells
        are invalid or overlap.

    Examples
    --------
    >>> import numpy as np
    >>> import rondel
    >>> import xarray  # doctest: +SKIP
    >>> lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
    >>> data = xarray.DataArray(  # doctest: +SKIP
    ...     np.ones((18, 36)), {"lat": lat, "lon": lon}, ("lat", "lon")
    ... )
    >>> rondel.regrid(data, "healpix:1").shape  # doctest: +SKIP
    (48,)

    """
    require_share(max_missing, "max_missing", skipna=True)
    is_by_kind = method is None
    method = cast("FieldMethod", as_method("conservative" if is_by_kind else method))
    if method not in get_args(FieldMethod):
        names = ", ".join(map(repr, get_args(FieldMethod)))
        raise ValueError(f"method must be one of {names}, not {method!r}")
    is_of_cells = method in ("conservative", "conservative_2nd")
    regridder = Regridder(
        without_mask(data, "data"),
        without_mask(target, "target"),
        cast("RegridMethod", _OF_REGRIDDER.get(method, method)),
        locstream_out=locstream_out,
        lon=lon,
        lat=lat,
        lon_out=lon_out,
        lat_out=lat_out,
        corners=corners,
        overlap=overlap,
        invalid=invalid,
        limiter=limiter,
        max_uncovered=max_missing if is_of_cells or method == "largest_share" else 1.0,
        threads=threads,
        progress=progress,
    )
    regridder._keeps_sums = regridder._describes = True
    regridder._fill_gaps(extrap_method, extrap_distance, threads)
    regridder._target = regridder._target.apart_from(data, regridder._source)
    return regridder(
        data,
        keep_attrs=True,
        skipna=True,
        na_thres=max_missing,
        output_chunks=output_chunks,
        vectors=vectors,
        how="by_kind" if is_by_kind else "largest_share" if method == "largest_share" else "sum",
    )
