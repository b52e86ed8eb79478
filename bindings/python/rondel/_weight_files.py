# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files of weights: ESMF's and SCRIP's netCDF, and SciPy's matrices.

The functions that take `self` are methods of `Weights`.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from . import _core
from ._arrays import as_floats, as_name, degrees_of
from ._errors import InvalidInput
from ._geo import Path
from ._types import ArrayLike, BoolArray, FloatArray

# How far a place may be from the same in a file, in degrees: float32 is off by up to 8e-6.
MAX_APART = 1e-4
_ENDINGS = (".nc", ".nc4", ".cdf", ".ncf")


def weights_to_netcdf(
    self: Any,
    path: Path,
    format: Literal["esmf", "scrip"] = "esmf",
    *,
    sites: ArrayLike | None = None,
    targets: ArrayLike | None = None,
    site_areas: ArrayLike | None = None,
    target_areas: ArrayLike | None = None,
    method: str = "",
) -> None:
    """Writes a netCDF file that other programs (ESMF, uxarray, CDO, NCO) apply.

    Parameters
    ----------
    path : path-like
        Ends in .nc or .nc4 (netCDF-4), .cdf or .ncf. The file appears when it is complete, and
        replaces the one that is there.
    format : {'esmf', 'scrip'}, optional
        The names of variables: those of ESMF (`row`, `col`, `S`; default), or those of SCRIP, which
        CDO reads.
    sites : array_like, shape (n, 3), optional
        The places of the sites, which the file stores as longitudes and latitudes; only directions
        from the origin are used.
    targets : array_like, shape (..., 3), optional
        The places of the targets. With the shape (nlat, nlon, 3) the file describes a grid.
    site_areas : array_like, shape (n,), optional
        Areas of the sites in steradians, such as those of their Voronoi cells.
    target_areas : array_like, shape (m,), optional
        Areas of the targets in steradians; of a grid also of the shape (nlat, nlon). With both
        areas other programs can compute integrals.
    method : str, optional
        The name of the method in the file.

    Raises
    ------
    ValueError
        If the points are not those of the weights, an area is negative, or the ending is another.
    OSError
        If the file cannot be written; then nothing is left of it.

    """
    rows, columns = self.shape
    for name, points, count, known in (
        ("sites", sites, columns, self.sites_hash),
        ("targets", targets, rows, self.targets_hash),
    ):
        if points is None:
            continue
        if np.shape(points)[-1:] != (3,) or np.size(points) != 3 * count:
            raise ValueError(f"{name} must be {count} points, not of shape {np.shape(points)}")
        if known and not self.is_of(**{name: points}):
            raise ValueError(f"the {name} are not those of the weights")
    for name, areas, points in (
        ("site_areas", site_areas, sites),
        ("target_areas", target_areas, targets),
    ):
        if areas is None or points is None or np.ndim(areas) == 1:
            continue
        if np.shape(areas) != np.shape(points)[:-1]:
            raise ValueError(
                f"{name} have the shape {np.shape(areas)}, not {np.shape(points)[:-1]}"
            )
    shape: tuple[int, ...] = () if targets is None else np.shape(targets)[:-1]
    source = side_of(_degrees(sites), _areas(site_areas, "site_areas"))
    target = side_of(_degrees(targets), _areas(target_areas, "target_areas"), shape)
    name = netcdf_name(path, format)
    _core.write_weights(name, format, self._weights, source, target, method, "none")


def are_near(a: FloatArray, b: FloatArray) -> BoolArray:
    """Whether places, shape (n, 2), are the same, in degrees, but for what files lose."""
    near: BoolArray = _core.are_same_places(
        np.ascontiguousarray(a, np.float64), np.ascontiguousarray(b, np.float64), MAX_APART
    ).view(bool)
    return near


def netcdf_name(path: Path, format: str) -> str:
    """The name of a file that is written in a format; refuses others than netCDF."""
    if format not in ("esmf", "scrip"):
        raise ValueError(f"format must be 'esmf' or 'scrip', not {format!r}")
    name = as_name(path)
    if not name.lower().endswith(_ENDINGS):
        hint = "; Weights.save() writes .npz" if name.lower().endswith(".npz") else ""
        raise ValueError(f"{name}: netCDF is written to {' '.join(_ENDINGS)}{hint}")
    return name


def side_of(
    degrees: FloatArray,
    areas: FloatArray | None = None,
    shape: tuple[int, ...] = (),
    mask: BoolArray | None = None,
) -> _core.WeightSide:
    """What a file says of the sources, or of the targets; a shape is that of a grid."""
    numbers = np.zeros(0) if areas is None else areas
    kept = np.zeros(0) if mask is None or mask.all() else mask.reshape(-1)
    grid = shape if len(shape) > 1 else ()
    return _core.weight_side(degrees, numbers, grid, kept.astype(np.int32))


def _degrees(points: ArrayLike | None) -> FloatArray:
    if points is None:
        return np.zeros((0, 2))
    return degrees_of(as_floats(points, "points").reshape(-1, 3))


def _areas(values: ArrayLike | None, name: str) -> FloatArray:
    if values is None:
        return np.zeros(0)
    areas = np.ascontiguousarray(as_floats(values, "areas").reshape(-1))
    bad = np.flatnonzero(~(areas >= 0))
    if bad.size:
        first = int(bad[0])
        raise InvalidInput(f"{name}[{first}] is {areas[first]}, which is no area", first)
    return areas
