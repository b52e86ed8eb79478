# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values between sites, for triangulations."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np

from . import _core
from ._arrays import as_fields, as_floats, as_queries, as_threads, require_finite_or_nan
from ._types import ArrayLike, FloatArray, Progress
from ._weights import Weights

Method: TypeAlias = Literal["nearest", "linear", "laplace", "sibson", "hermite", "cubic"]
Outside: TypeAlias = Literal["nan", "nearest", "error"]
SharedPlace: TypeAlias = Literal["first", "mean", "error"]
Normalization: TypeAlias = Literal["unity", "homogeneous"]
Undetermined: TypeAlias = Literal["zero", "missing"]

METHODS: tuple[str, ...] = _core.METHODS
USUAL_RINGS = 2


def options_of(
    method: Method,
    outside: Outside,
    duplicates: SharedPlace,
    normalization: Normalization,
    rings: int,
) -> _core.InterpolationOptions:
    """The options of the library; raises ValueError for names that it does not know."""
    if _as_rings(rings) != USUAL_RINGS and method not in ("hermite", "cubic"):
        raise ValueError(f"rings are of the methods 'hermite' and 'cubic', not of {method!r}")
    return _core.InterpolationOptions(
        method=method,
        outside=outside,
        duplicates=duplicates,
        normalization=normalization,
        rings=_as_rings(rings),
    )


def _as_rings(rings: int) -> int:
    rings = operator.index(rings)
    if not 1 <= rings <= 100:
        raise ValueError(f"rings must be from 1 to 100, not {rings}")
    return rings


def as_targets(targets: ArrayLike) -> tuple[FloatArray, tuple[int, ...]]:
    """Targets as (m, 3), and the shape of the answers."""
    array = as_floats(targets, "targets")
    return as_queries(array.reshape(0, 3) if array.shape == (0,) else array, "targets")


def as_vectors(values: ArrayLike, num_sites: int, name: str) -> FloatArray:
    array = as_floats(values, name)
    if array.ndim < 2 or array.shape[-2:] != (num_sites, 3):
        raise ValueError(f"{name} must have shape (..., {num_sites}, 3), not {array.shape}")
    require_finite_or_nan(array, name)
    return array


def at_targets(
    fields: FloatArray, shape: tuple[int, ...], values_of: Callable[[FloatArray], FloatArray]
) -> FloatArray:
    """The values of fields (..., n) at targets of a shape, from a function of fields (k, n)."""
    leading = fields.shape[:-1]
    if not fields.size:
        return np.full((*leading, *shape), np.nan)
    return values_of(fields.reshape(-1, fields.shape[-1])).reshape((*leading, *shape))[()]


class Interpolation:
    """Interpolation of values at the sites of a triangulation.

    Targets are points in space; only their directions from the center of the sphere are used.
    """

    @property
    def npoints(self) -> int:
        raise NotImplementedError

    @property
    def center(self) -> FloatArray:
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
        """Computes the weights that interpolate any number of fields at targets.

        Parameters
        ----------
        targets : array_like, shape (..., 3)
            Where values are wanted; only directions from the center of the sphere are used. For
            degrees use ``rondel.unit_vectors(lon, lat)``.
        method : {'nearest', 'linear', 'laplace', 'sibson', 'hermite', 'cubic'}, optional
            'nearest': the nearest site. 'linear': linear in each triangle. 'laplace' and 'sibson'
            (default): natural neighbors. 'hermite': natural neighbors with estimated gradients.
            'cubic': smooth cubic polynomials with estimated gradients.
        outside : {'nan', 'nearest', 'error'}, optional
            What to do with a target that lies in no face: 'nan' (default) leaves its row empty,
            'nearest' takes the nearest site, 'error' raises `InvalidInput`.
        duplicates : {'first', 'mean', 'error'}, optional
            Which value counts if several sites share a place: that of the first site (default),
            the mean of all, or none, which is an error.
        normalization : {'unity', 'homogeneous'}, optional
            'unity' (default): the weights of a target have the sum 1, so that constants are
            reproduced. 'homogeneous': the weights times the sites' unit vectors have the target's
            unit vector as their sum, so that x, y and z are reproduced; for 'linear', 'laplace'
            and 'sibson' only.
        rings : int, optional
            Gradients are estimated from the sites up to this many edges away; by default 2, at
            most 100.
        threads : int, optional
            The largest number of threads; by default one for each core.
        progress : callable or bool, optional
            Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
            True shows a `ProgressBar`.

        Returns
        -------
        Weights
            A sparse matrix with a row for each target, in C order, and a column for each site.

        Raises
        ------
        InvalidInput
            If a target is not finite or is the center, or because of 'error', with its `index`; or
            if the model is 'weighted' and the method is not 'nearest'.

        Notes
        -----
        'linear' is Renka, ACM TOMS 23, 1997; 'laplace' is Christ, Friedberg and Lee 1982; 'sibson'
        is Sibson 1981, on the sphere; 'cubic' is the Clough-Tocher element of Alfeld, Neamtu and
        Schumaker, J. Comput. Appl. Math. 73, 1996. See docs/theory/interpolation.md.

        Examples
        --------
        >>> import rondel
        >>> tri = rondel.delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
        >>> weights = tri.weights([[1, 1, 0], [1, 1, 1]], "linear")
        >>> weights.apply([10, 20, 30, 40]).round(9).tolist()
        [15.0, 20.0]

        """
        rays, _ = as_targets(targets)
        options = options_of(method, outside, duplicates, normalization, rings)
        return Weights._of(
            self._interpolator().weights(rays, options, as_threads(threads), progress)
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
        """Interpolates values at targets.

        If the same targets are used for many calls, `weights` is faster.

        Parameters
        ----------
        values : array_like, shape (..., n)
            A value for each site; further axes, such as time, come first.
        targets : array_like, shape (..., 3)
            Where values are wanted; only directions from the center of the sphere are used.
        method : {'nearest', 'linear', 'laplace', 'sibson', 'hermite', 'cubic'}, optional
            As in `weights`; by default 'sibson'.
        gradients : array_like, shape (..., n, 3), optional
            The tangent gradient of each value, in the unit of the values per radian, which
            'hermite' and 'cubic' use instead of an estimate.
        outside, duplicates, normalization, rings, threads, progress
            As in `weights`.

        Returns
        -------
        ndarray of float64
            An array whose shape is that of the values without the last axis, then that of the
            targets without theirs. It is NaN where there is no value, and where a value that is
            needed is NaN.

        Raises
        ------
        InvalidInput
            As in `weights`, and if a value is infinite, with its index along the last axis.
        ValueError
            If the last axis of the values is not n, or options do not fit the method.

        Examples
        --------
        >>> import rondel
        >>> tri = rondel.delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
        >>> tri.interpolate([10, 20, 30, 40], [[1, 1, 0], [0, 0, 5]], "linear").round(9).tolist()
        [15.0, 30.0]

        """
        fields = as_fields(values, self.npoints)
        require_finite_or_nan(fields, "values")
        rays, shape = as_targets(targets)
        options = options_of(method, outside, duplicates, normalization, rings)
        slopes = None
        if gradients is not None:
            slopes = np.broadcast_to(
                as_vectors(gradients, self.npoints, "gradients"), (*fields.shape, 3)
            )
            slopes = np.ascontiguousarray(slopes.reshape(-1, self.npoints, 3))
        return at_targets(
            fields,
            shape,
            lambda flat: self._interpolator().values(
                flat, slopes, rays, options, as_threads(threads), progress
            ),
        )

    def gradient(
        self,
        values: ArrayLike,
        *,
        rings: int = 2,
        undetermined: Undetermined = "zero",
        threads: int | None = None,
        progress: Progress = None,
    ) -> FloatArray:
        """Estimates the gradients at the sites from the values around them.

        Parameters
        ----------
        values : array_like, shape (..., n)
            A value for each site; further axes, such as time, come first.
        rings : int, optional
            The sites up to this many edges away are used; by default 2, at most 100.
        undetermined : {'zero', 'missing'}, optional
            What to do where the neighbors of a site do not determine the slope across a line, as
            on a track. 'zero' (default): the slope across the line is 0, that along it is
            estimated. 'missing': the gradient is NaN.
        threads : int, optional
            The largest number of threads; by default one for each core.
        progress : callable or bool, optional
            Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
            True shows a `ProgressBar`.

        Returns
        -------
        ndarray of float64, shape (..., n, 3)
            Tangent vectors in the unit of the values per radian; divide by the radius for a unit
            per length. They are NaN below dimension 2, around missing values, and as
            `undetermined` says.

        Notes
        -----
        The gradient is that of a polynomial of degree up to 3 that is fitted to the neighbors by
        weighted least squares; see docs/theory/cubic.md.

        Examples
        --------
        >>> import rondel
        >>> x = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]]
        >>> tri = rondel.delaunay(x)
        >>> tri.gradient([0, 0, 1, 0, 0, -1]).shape
        (6, 3)

        """
        fields = as_fields(values, self.npoints)
        require_finite_or_nan(fields, "values")
        weights = Weights._of(
            self._interpolator().gradient(
                self.npoints,
                _as_rings(rings),
                undetermined,
                as_threads(threads),
                progress,
            )
        )
        return weights.apply(fields, threads=threads).reshape(*fields.shape, 3)
