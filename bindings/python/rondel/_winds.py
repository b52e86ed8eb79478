# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Tangent vectors between sites, such as winds, for triangulations."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import as_fields, as_floats, as_threads, target_vectors
from ._interpolation import (
    Interpolation,
    Method,
    Outside,
    SharedPlace,
    as_targets,
    as_vectors,
    choices_of,
)
from ._types import ArrayLike, FloatArray, Progress


def directions(lon: FloatArray, lat: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The unit vectors to the east and to the north at some places, shape (..., 3)."""
    a, b = np.radians(lon), np.radians(lat)
    east = np.stack([-np.sin(a), np.cos(a), np.zeros_like(a)], axis=-1)
    north = np.stack([-np.sin(b) * np.cos(a), -np.sin(b) * np.sin(a), np.cos(b)], axis=-1)
    return east, north


class VectorInterpolation(Interpolation):
    """Vectors between the sites of a triangulation, beside values."""

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
        """Tangent vectors at the sites, such as winds, carried to tangent vectors at targets.

        In space, so that poles are places like all others: the wind of a turning globe comes back
        as it is with 'linear', 'laplace' and 'sibson', and nearly so with 'hermite' and 'cubic'.

        Parameters
        ----------
        vectors : array_like, shape (..., n, 3)
            Cartesian. For components to the east and the north see `interpolate_winds`.
        targets : array_like, shape (..., 3)
        method, outside, duplicates, rings, threads, progress
            As in `weights`.

        Returns
        -------
        ndarray of float64, shape (..., 3)
            The shape of the vectors without the last two axes, then that of the targets.

        """
        fields = as_vectors(vectors, self.npoints, "vectors")
        rays, shape = as_targets(targets)
        choices = choices_of(method, outside, duplicates, "homogeneous", rings)
        leading = fields.shape[:-2]
        if not fields.size:
            return np.full((*leading, *shape, 3), np.nan)
        found = self._interpolator().vectors(
            fields.reshape(-1, self.npoints, 3), rays, choices, as_threads(threads), progress
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
        """Winds to the east and the north, at longitudes and latitudes; across poles, too.

        Parameters
        ----------
        east, north : array_like, shape (..., n)
            The components at the sites. At a pole the east is that of the longitude by which the
            site was given, otherwise of longitude 0.
        lon, lat : array_like
            Where to, in degrees; broadcast against each other.
        method : str, optional
        **options
            As in `interpolate_vectors`.

        Returns
        -------
        tuple of ndarray of float64
            The two components there. At a pole they are those of its longitude in `lon`.

        """
        u = as_fields(east, self.npoints, "east")
        v = as_fields(north, self.npoints, "north")
        if u.shape != v.shape:
            raise ValueError(f"east and north differ in shape: {u.shape} and {v.shape}")
        to_east, to_north = directions(*np.moveaxis(self.lonlat, -1, 0))
        vectors = u[..., None] * to_east + v[..., None] * to_north
        lon, lat = np.broadcast_arrays(as_floats(lon, "lon"), as_floats(lat, "lat"))
        found = self.interpolate_vectors(vectors, target_vectors(lon, lat), method, **options)
        to_east, to_north = directions(lon, lat)
        return (found * to_east).sum(axis=-1), (found * to_north).sum(axis=-1)
