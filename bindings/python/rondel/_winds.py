# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Interpolation of tangent vectors, such as winds, for triangulations."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import (
    as_fields,
    as_floats,
    as_threads,
    by_names,
    require_finite_or_nan,
    target_vectors,
    unit_vectors,
    values_by_names,
)
from ._interpolation import (
    Interpolation,
    Method,
    Outside,
    SharedPlace,
    as_targets,
    as_vectors,
    options_of,
)
from ._types import ArrayLike, FloatArray, Progress


def directions(lon: FloatArray, lat: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The unit vectors to the east and to the north at some places, shape (..., 3)."""
    along_equator = unit_vectors(lon, np.zeros_like(lat))
    up = unit_vectors(np.zeros_like(lon), lat)
    cosine, sine = along_equator[..., 0], along_equator[..., 1]
    east = np.stack([-sine, cosine, np.zeros_like(sine)], axis=-1)
    north = np.stack([-up[..., 2] * cosine, -up[..., 2] * sine, up[..., 0]], axis=-1)
    return east, north


class VectorInterpolation(Interpolation):
    """Interpolation of vectors, besides that of values."""

    def interpolate_vectors(
        self,
        vectors: ArrayLike,
        targets: ArrayLike,
        method: Method = "sibson",
        *,
        outside: Outside = "nan",
        duplicates: SharedPlace = "first",
        rings: int = 2,
        threads: int | None = None,
        progress: Progress = None,
    ) -> FloatArray:
        """Interpolates tangent vectors, such as winds, at targets.

        The interpolation is done in space, so that poles are no special places: the wind of a solid
        rotation is reproduced by 'linear', 'laplace' and 'sibson', and nearly so by 'hermite' and
        'cubic'.

        Parameters
        ----------
        vectors : array_like, shape (..., n, 3)
            A Cartesian vector for each site; further axes, such as time, come first. For eastward
            and northward components use `interpolate_winds`.
        targets : array_like, shape (..., 3)
            Where vectors are wanted; only directions from the center of the sphere are used.
        method, outside, duplicates, rings, threads, progress
            As in `weights`; the default method is 'sibson'.

        Returns
        -------
        ndarray of float64, shape (..., 3)
            Tangent vectors. The shape is that of the vectors without the last two axes, then that
            of the targets.

        Raises
        ------
        InvalidInput
            As in `weights`.

        """
        fields = as_vectors(vectors, self.npoints, "vectors")
        rays, shape = as_targets(targets)
        options = options_of(method, outside, duplicates, "homogeneous", rings)
        leading = fields.shape[:-2]
        if not fields.size:
            return np.full((*leading, *shape, 3), np.nan)
        found = self._interpolator().vectors(
            fields.reshape(-1, self.npoints, 3), rays, options, as_threads(threads), progress
        )
        return found.reshape((*leading, *shape, 3))

    def interpolate_winds(
        self,
        east: ArrayLike,
        north: ArrayLike,
        lon: ArrayLike,
        lat: ArrayLike,
        method: Method = "sibson",
        **options: Any,
    ) -> tuple[FloatArray, FloatArray]:
        """Interpolates eastward and northward components of winds, also across poles.

        Parameters
        ----------
        east, north : array_like, shape (..., n)
            The components at the sites, in any unit. At a pole they refer to the longitude by which
            the site was given, or else to longitude 0.
        lon, lat : array_like
            Longitudes and latitudes of the targets in degrees, broadcast against each other as in
            `unit_vectors`: arrays of xarray by the names of their dimensions.
        method : {'nearest', 'linear', 'laplace', 'sibson', 'hermite', 'cubic'}, optional
            As in `weights`; by default 'sibson'.
        **options
            The options `outside`, `duplicates`, `rings`, `threads` and `progress` of
            `interpolate_vectors`.

        Returns
        -------
        east, north : ndarray of float64
            The components at the targets, in the unit of the input. At a pole they refer to its
            longitude in `lon`.

        Raises
        ------
        InvalidInput
            If a component is infinite, an angle is not finite or a latitude is outside [-90, 90].

        """
        u = as_fields(east, self.npoints, "east")
        v = as_fields(values_by_names(north, east), self.npoints, "north")
        if u.shape != v.shape:
            raise ValueError(f"east and north differ in shape: {u.shape} and {v.shape}")
        require_finite_or_nan(u, "east")
        require_finite_or_nan(v, "north")
        to_east, to_north = directions(*np.moveaxis(self.lonlat, -1, 0))
        vectors = u[..., None] * to_east + v[..., None] * to_north
        lon, lat = by_names(lon, lat)
        lon, lat = np.broadcast_arrays(as_floats(lon, "lon"), as_floats(lat, "lat"))
        found = self.interpolate_vectors(
            vectors, target_vectors(lon, lat, self.center), method, **options
        )
        to_east, to_north = directions(lon, lat)
        return (found * to_east).sum(axis=-1), (found * to_north).sum(axis=-1)
