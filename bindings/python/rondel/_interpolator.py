# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values between points in one call, and in the manner of `scipy.interpolate`."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import as_fields, as_floats, as_points, target_vectors, values_by_names
from ._delaunay import SphericalDelaunay, delaunay, delaunay_lonlat
from ._interpolation import METHODS, Method
from ._repr import Described, count
from ._types import ArrayLike, FloatArray


def _triangulated(points: Any) -> SphericalDelaunay:
    """The triangulation of a tuple (lon, lat), of rows of two degrees or three coordinates."""
    if isinstance(points, SphericalDelaunay):
        return points
    if isinstance(points, tuple):
        if len(points) != 2:
            raise ValueError(f"a tuple of points is (lon, lat), not {len(points)} arrays")
        return delaunay_lonlat(*points)
    array = as_floats(points, "points")
    if array.ndim == 2 and array.shape[1] == 2:
        return delaunay_lonlat(array[:, 0], array[:, 1])
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"points must have shape (n, 2), in degrees, or (n, 3), not {array.shape}")
    return delaunay(as_points(array))


def _as_rays(xi: tuple[Any, ...], center: FloatArray) -> FloatArray:
    """The targets of f(points), f((lon, lat)) or f(lon, lat), which are seen from the center."""
    if len(xi) == 1 and isinstance(xi[0], tuple):
        xi = xi[0]
    if len(xi) == 2:
        return target_vectors(*xi, center)
    if len(xi) != 1:
        raise TypeError(f"targets are points, or longitudes and latitudes, not {len(xi)} arrays")
    array = as_floats(xi[0], "targets")
    if array.ndim and array.shape[-1] == 2:
        return target_vectors(array[..., 0], array[..., 1], center)
    return array


class SphericalInterpolator(Described):
    """An interpolator on the sphere, called like `scipy.interpolate.LinearNDInterpolator`.

    Parameters
    ----------
    points : tuple of array_like, array_like or SphericalDelaunay
        The n sites: a tuple (lon, lat) or an array of shape (n, 2) in degrees; an array of shape
        (n, 3) of points in space; or a triangulation.
    values : array_like, shape (..., n)
        A value for each site; further axes, such as time, come first.
    method : {'nearest', 'linear', 'laplace', 'sibson', 'hermite', 'cubic'}, optional
        As in `SphericalDelaunay.weights`; by default 'sibson'.
    fill_value : float, optional
        The value at targets that lie in no face, which exist only if the sites do not surround the
        center of the sphere; by default NaN.
    **options
        The options `gradients`, `outside`, `duplicates`, `normalization`, `rings`, `threads` and
        `progress` of `SphericalDelaunay.interpolate`.

    Raises
    ------
    InvalidInput
        If a coordinate of a site is not finite, or a latitude is outside [-90, 90].
    ValueError
        If shapes do not match, or there is no such method.

    Notes
    -----
    Methods and their sources are those of `SphericalDelaunay.weights`.

    Examples
    --------
    >>> import rondel
    >>> lon, lat = [0, 120, 240, 0, 180], [-30, -30, -30, 90, -90]
    >>> f = rondel.SphericalInterpolator((lon, lat), [10, 20, 30, 0, 5], method="linear")
    >>> f
    <rondel.SphericalInterpolator: 5 points, linear>
    >>> f([60, 180], 0).round(2)
    array([10.  , 16.67])

    """

    def __init__(
        self,
        points: Any,
        values: ArrayLike,
        method: Method = "sibson",
        *,
        fill_value: float = np.nan,
        **options: Any,
    ) -> None:
        if method not in METHODS:
            raise ValueError(f"method must be one of {', '.join(METHODS)}, not {method!r}")
        self._triangulation = _triangulated(points)
        if isinstance(points, tuple):
            values = values_by_names(values, points[0])
        self._values = as_fields(values, self._triangulation.npoints)
        self._method = method
        self._fill = float(fill_value)
        self._options = options

    @property
    def triangulation(self) -> SphericalDelaunay:
        """SphericalDelaunay: the triangulation of the sites."""
        return self._triangulation

    def __call__(self, *xi: Any) -> FloatArray:
        """Interpolates the values at targets.

        Parameters
        ----------
        *xi : array_like
            The targets: ``f(lon, lat)`` in degrees, broadcast against each other; or one array of
            shape (..., 2) in degrees, or (..., 3) in space.

        Returns
        -------
        ndarray of float64
            An array whose shape is that of the values without the last axis, then that of the
            targets.

        Raises
        ------
        InvalidInput
            If a target is not finite, is the center, or has a latitude outside [-90, 90].

        """
        tri, method, options = self._triangulation, self._method, self._options
        rays = _as_rays(xi, tri.center)
        found = np.asarray(tri.interpolate(self._values, rays, method, **options))
        if not np.isnan(self._fill) and np.isnan(found).any():
            suspects = np.isnan(found).any(axis=tuple(range(self._values.ndim - 1)))
            same = {name: value for name, value in options.items() if name != "gradients"}
            has_row = np.diff(tri.weights(rays[suspects], method, **same).indptr) > 0
            outside = np.array(suspects)
            outside[suspects] = ~has_row
            found[..., outside] = self._fill
        return found[()]

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("points", count(self._triangulation.npoints, "point")),
            ("method", self._method),
        ]


def interpolate(
    lon: ArrayLike,
    lat: ArrayLike,
    values: ArrayLike,
    to_lon: ArrayLike,
    to_lat: ArrayLike,
    method: Method = "sibson",
    **options: Any,
) -> FloatArray:
    """Interpolates values from longitudes and latitudes to others in one call.

    Parameters
    ----------
    lon, lat : array_like, shape (n,)
        The sites of the values in degrees. Arrays of more dimensions are flattened; those of
        xarray, also the values, are put into the order of the longitudes' dimensions.
    values : array_like, shape (..., n)
        A value for each site; further axes, such as time, come first. If `lon` has more
        dimensions, the last axes of the values have its shape and are flattened too.
    to_lon, to_lat : array_like
        The targets in degrees, broadcast against each other as in `unit_vectors`: for a grid pass
        ``lon[None, :]`` and ``lat[:, None]``, or the axes as arrays of xarray.
    method : {'nearest', 'linear', 'laplace', 'sibson', 'hermite', 'cubic'}, optional
        As in `SphericalDelaunay.weights`; by default 'sibson'.
    **options
        The options `gradients`, `outside`, `duplicates`, `normalization`, `rings`, `threads` and
        `progress` of `SphericalDelaunay.interpolate`.

    Returns
    -------
    ndarray of float64
        An array whose shape is that of the other axes of the values, then that of the targets. It
        is NaN at targets that lie in no face, which exist only if the sites do not surround the
        sphere.

    Raises
    ------
    InvalidInput
        If an angle is not finite or a latitude is outside [-90, 90].
    ValueError
        If shapes do not match, or there is no such method.

    See Also
    --------
    SphericalInterpolator : for several calls with the same sites.
    Regridder : from grid to grid, with cells and masks.

    Examples
    --------
    >>> import rondel
    >>> lon, lat = [0, 120, 240, 0, 180], [-30, -30, -30, 90, -90]
    >>> float(rondel.interpolate(lon, lat, [10, 20, 30, 0, 5], 180, 0, method="linear").round(2))
    16.67

    """
    tri = delaunay_lonlat(lon, lat)
    values = values_by_names(values, lon)
    shape = np.shape(lon)
    if len(shape) > 1 and np.shape(values)[-len(shape) :] == shape:
        values = np.ma.asanyarray(values) if np.ma.isMaskedArray(values) else np.asarray(values)
        values = values.reshape(*values.shape[: -len(shape)], -1)
    return tri.interpolate(values, target_vectors(to_lon, to_lat), method, **options)
