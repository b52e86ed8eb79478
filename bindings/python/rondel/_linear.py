# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values between points, linear in the faces of a triangulation with given edges."""

from __future__ import annotations

from . import _core
from ._arrays import as_fields, as_threads, require_finite_or_nan
from ._interpolation import (
    USUAL_RINGS,
    Normalization,
    Outside,
    SharedPlace,
    as_targets,
    at_targets,
    options_of,
)
from ._types import ArrayLike, FloatArray, Progress
from ._weights import Weights


class LinearInterpolation:
    """Linear interpolation in the faces of a constrained triangulation."""

    @property
    def npoints(self) -> int:
        raise NotImplementedError

    def _linear_interpolator(self) -> _core.ConstrainedInterpolator:
        raise NotImplementedError

    def weights(
        self,
        targets: ArrayLike,
        *,
        outside: Outside = "nan",
        duplicates: SharedPlace = "first",
        normalization: Normalization = "unity",
        threads: int | None = None,
        progress: Progress = None,
    ) -> Weights:
        """Computes the weights that interpolate any number of fields linearly at targets.

        Parameters
        ----------
        targets : array_like, shape (..., 3)
            Where values are wanted; only directions from the center of the sphere are used. For
            degrees use ``rondel.unit_vectors(lon, lat)``.
        outside : {'nan', 'nearest', 'error'}, optional
            What to do with a target that lies in no face: 'nan' (default) leaves its row empty,
            'nearest' takes the nearest point, 'error' raises `InvalidInput`.
        duplicates : {'first', 'mean', 'error'}, optional
            Which value counts if several points share a place: that of the first one (default),
            the mean of all, or none, which is an error.
        normalization : {'unity', 'homogeneous'}, optional
            As in `SphericalDelaunay.weights`.
        threads : int, optional
            The largest number of threads; by default one for each core.
        progress : callable or bool, optional
            Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
            True shows a `ProgressBar`.

        Returns
        -------
        Weights
            A sparse matrix with a row for each target, in C order, and a column for each point.

        Raises
        ------
        InvalidInput
            If a target is not finite or is the center, or because of 'error', with its `index`.

        Notes
        -----
        The weights of a target are those of the corners of the face that has it (Renka, ACM TOMS
        23, 1997). As constraints are edges of faces, no weight is beyond a constraint, and on a
        constraint the weights are those of its own points. Where all faces are Delaunay, they are
        those of ``SphericalDelaunay.weights(targets, "linear")``, bit by bit.

        Examples
        --------
        >>> import rondel
        >>> points = rondel.unit_vectors([0, 20, 10, 10, 10], [0, 0, 2, -9, 80])
        >>> tri = rondel.constrained_delaunay(points, [[0, 1]])
        >>> tri.weights(rondel.unit_vectors(10, -1)).indices.tolist()
        [0, 3, 1]

        """
        rays, _ = as_targets(targets)
        options = options_of("linear", outside, duplicates, normalization, USUAL_RINGS)
        return Weights._of(
            self._linear_interpolator().weights(rays, options, as_threads(threads), progress)
        )

    def interpolate(
        self,
        values: ArrayLike,
        targets: ArrayLike,
        *,
        outside: Outside = "nan",
        duplicates: SharedPlace = "first",
        normalization: Normalization = "unity",
        threads: int | None = None,
        progress: Progress = None,
    ) -> FloatArray:
        """Interpolates values linearly at targets, and mixes none across a constraint.

        If the same targets are used for many calls, `weights` is faster.

        Parameters
        ----------
        values : array_like, shape (..., n)
            A value for each point, those that were added where constraints cross too; further
            axes, such as time, come first.
        targets : array_like, shape (..., 3)
            Where values are wanted; only directions from the center of the sphere are used.
        outside, duplicates, normalization, threads, progress
            As in `weights`, which also says what is computed.

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
            If the last axis of the values is not n.

        Examples
        --------
        A dike: south of it the water stands at -1, north of it at 1.

        >>> import rondel
        >>> points = rondel.unit_vectors([0, 20, 10, 10, 10], [0, 0, 2, -9, 80])
        >>> level = [0, 0, 1, -1, 1]
        >>> just_south = rondel.unit_vectors([9, 10, 11], -0.5)
        >>> dike = rondel.constrained_delaunay(points, [[0, 1]])
        >>> dike.interpolate(level, just_south).round(2).tolist()
        [-0.05, -0.05, -0.05]
        >>> rondel.delaunay(points).interpolate(level, just_south, "linear").round(2).tolist()
        [0.48, 0.54, 0.48]

        """
        fields = as_fields(values, self.npoints)
        require_finite_or_nan(fields, "values")
        rays, shape = as_targets(targets)
        options = options_of("linear", outside, duplicates, normalization, USUAL_RINGS)
        return at_targets(
            fields,
            shape,
            lambda flat: self._linear_interpolator().values(
                flat, rays, options, as_threads(threads), progress
            ),
        )
