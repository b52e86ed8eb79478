# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values between sites, for triangulations."""

from __future__ import annotations

import operator
from typing import Any, Literal, TypeAlias

import numpy as np

from . import _core
from ._arrays import HINT_OF_DEGREES, as_fields, as_floats, as_threads
from ._types import ArrayLike, FloatArray, Progress
from ._weights import Weights

Method: TypeAlias = Literal["nearest", "linear", "laplace", "sibson", "hermite", "cubic"]
Outside: TypeAlias = Literal["nan", "nearest", "error"]
SharedPlace: TypeAlias = Literal["first", "mean", "error"]
Normalization: TypeAlias = Literal["unity", "homogeneous"]
Undetermined: TypeAlias = Literal["zero", "missing"]

METHODS, _OUTSIDE, _SHARED_PLACE, _NORMALIZATION, _UNDETERMINED = _core.interpolation_names()


def _position(name: str, value: Any, known: tuple[str, ...]) -> int:
    if value not in known:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, known))}, not {value!r}")
    return known.index(value)


def choices_of(
    method: Method,
    outside: Outside,
    duplicates: SharedPlace,
    normalization: Normalization,
    rings: int,
) -> tuple[int, int, int, int, int]:
    return (
        _position("method", method, METHODS),
        _position("outside", outside, _OUTSIDE),
        _position("duplicates", duplicates, _SHARED_PLACE),
        _position("normalization", normalization, _NORMALIZATION),
        _as_rings(rings),
    )


def _as_rings(rings: int) -> int:
    rings = operator.index(rings)
    if not 1 <= rings <= 100:
        raise ValueError(f"rings must be from 1 to 100, not {rings}")
    return rings


def as_targets(targets: ArrayLike) -> tuple[FloatArray, tuple[int, ...]]:
    """Targets as (m, 3), and the shape of the answers."""
    array = as_floats(targets, "targets")
    if array.shape == (0,):
        array = array.reshape(0, 3)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"targets must have shape (..., 3), not {array.shape}; {HINT_OF_DEGREES}")
    return array.reshape(-1, 3), array.shape[:-1]


def as_vectors(values: ArrayLike, num_sites: int, name: str) -> FloatArray:
    array = as_floats(values, name)
    if array.ndim < 2 or array.shape[-2:] != (num_sites, 3):
        raise ValueError(f"{name} must have shape (..., {num_sites}, 3), not {array.shape}")
    return array


class Interpolation:
    """Values between the sites of a triangulation. Targets stand for rays from the center."""

    @property
    def npoints(self) -> int:
        raise NotImplementedError

    @property
    def lonlat(self) -> FloatArray:
        raise NotImplementedError

    def _interpolator(self) -> _core.Interpolator:
        raise NotImplementedError

    def weights(
        self,
        targets: ArrayLike,
        method: Method = "sibson",
        *,
        outside: Outside = "nan",
        duplicates: SharedPlace = "first",
        normalization: Normalization = "unity",
        rings: int = 2,
        threads: int | None = None,
        progress: Progress = None,
    ) -> Weights:
        """What makes values at targets of values at the sites, for any number of fields.

        Parameters
        ----------
        targets : array_like, shape (..., 3)
            Only directions from the center of the sphere count. Of degrees:
            ``rondel.unit_vectors(lon, lat)``.
        method : str, optional
            'nearest'; 'linear' in the triangles; 'laplace' and 'sibson' of all natural neighbors;
            'hermite' (these, with gradients) and 'cubic' (smooth), which estimate gradients.
        outside : {'nan', 'nearest', 'error'}, optional
            What a target gets that no face of the sites has: nothing, what the nearest site has,
            or an `InvalidInput`.
        duplicates : {'first', 'mean', 'error'}, optional
            Which value counts where several sites are in one place.
        normalization : {'unity', 'homogeneous'}, optional
            Whether the weights of a target have the sum 1, so that constants come back, or give
            its unit vector if they are applied to those of the sites, so that x, y, z come back:
            'linear', 'laplace' and 'sibson' alone.
        rings : int, optional
            Gradients are estimated from sites up to so many edges away.
        threads : int, optional
            At most so many; by default one for each core. The result is the same.
        progress : callable, optional
            Called as ``progress(stage, fraction)`` some times a second.

        Returns
        -------
        Weights
            A row for each target, in C order.

        Raises
        ------
        InvalidInput
            If a target is not finite or is the center, with `index`, or because of 'error'; or if
            the model is 'weighted' and the method not 'nearest'.

        """
        rays, _ = as_targets(targets)
        choices = choices_of(method, outside, duplicates, normalization, rings)
        return Weights._of(
            self._interpolator().weights(rays, choices, as_threads(threads), progress)
        )

    def interpolate(
        self,
        values: ArrayLike,
        targets: ArrayLike,
        method: Method = "sibson",
        *,
        gradients: ArrayLike | None = None,
        outside: Outside = "nan",
        duplicates: SharedPlace = "first",
        normalization: Normalization = "unity",
        rings: int = 2,
        threads: int | None = None,
        progress: Progress = None,
    ) -> FloatArray:
        """Values at targets. For many calls with the same targets `weights` is faster.

        Parameters
        ----------
        values : array_like, shape (..., n)
            A value for each site; more axes are more fields, such as time steps.
        targets : array_like, shape (..., 3)
        method : str, optional
        gradients : array_like, shape (..., n, 3), optional
            For 'hermite' and 'cubic' the tangent gradient of each value, in its unit a radian,
            instead of an estimate.
        outside, duplicates, normalization, rings, threads, progress
            As in `weights`.

        Returns
        -------
        ndarray of float64
            The shape of the values without the last axis, then that of the targets without
            theirs. NaN where there is no value, and where it needs one that is NaN.

        Raises
        ------
        InvalidInput
            As `weights`.

        """
        fields = as_fields(values, self.npoints)
        rays, shape = as_targets(targets)
        choices = choices_of(method, outside, duplicates, normalization, rings)
        leading = fields.shape[:-1]
        slopes = None
        if gradients is not None:
            slopes = np.broadcast_to(
                as_vectors(gradients, self.npoints, "gradients"), (*fields.shape, 3)
            )
            slopes = np.ascontiguousarray(slopes.reshape(-1, self.npoints, 3))
        if not fields.size:
            return np.full((*leading, *shape), np.nan)
        found = self._interpolator().values(
            fields.reshape(-1, self.npoints), slopes, rays, choices, as_threads(threads), progress
        )
        return found.reshape((*leading, *shape))[()]

    def gradient(
        self,
        values: ArrayLike,
        *,
        rings: int = 2,
        undetermined: Undetermined = "zero",
        threads: int | None = None,
        progress: Progress = None,
    ) -> FloatArray:
        """The gradients at the sites, estimated from the values around them.

        Parameters
        ----------
        values : array_like, shape (..., n)
        rings : int, optional
            The sites up to so many edges away count.
        undetermined : {'zero', 'missing'}, optional
            Where the sites around one do not determine the slope across a line, as on a track, it
            is 0 across and estimated along the line, or the gradient is NaN.
        threads : int, optional
        progress : callable, optional

        Returns
        -------
        ndarray of float64, shape (..., n, 3)
            Tangent vectors, in units of the values a radian; divide by the radius for units a
            length. NaN where there is none: below dimension 2, around missing values, and as
            `undetermined` says.

        """
        fields = as_fields(values, self.npoints)
        weights = Weights._of(
            self._interpolator().gradient(
                self.npoints,
                _as_rings(rings),
                _position("undetermined", undetermined, _UNDETERMINED),
                as_threads(threads),
                progress,
            )
        )
        return weights.apply(fields, threads=threads).reshape(*fields.shape, 3)
