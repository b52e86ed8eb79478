# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Centroidal tessellations, and power cells with prescribed areas."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from . import _core
from ._arrays import as_floats, as_points, as_threads, frozen
from ._errors import warn_caller
from ._geometries import Edges
from ._mesh_parts import Lines, fixed_points
from ._types import ArrayLike, FloatArray, IntArray, Progress

Spacing: TypeAlias = float | Callable[[FloatArray], ArrayLike]
Density: TypeAlias = Callable[[FloatArray], ArrayLike]


class Defects(NamedTuple):
    """The defects of a mesh, on which models fail or run badly.

    Attributes
    ----------
    odd_cells : int
        The number of cells with other than 5, 6 or 7 sides.
    short_edges : int
        The number of edges that are shorter than 0.0505 times the distance of their cells.
    obtuse_triangles : int
        The number of obtuse triangles.
    min_edge_ratio : float
        The least ratio of the length of an edge to the distance of its cells.

    """

    odd_cells: int
    short_edges: int
    obtuse_triangles: int
    min_edge_ratio: float


class ScvtReport(NamedTuple):
    """How the work on a centroidal tessellation ended: `Mesh.report`.

    Attributes
    ----------
    end : str
        "converged", "iterations" (`max_steps` was reached), or "stuck" (rounding allows no further
        progress).
    steps : int
        The number of steps of the last level.
    mean_offset, largest_offset : float
        The mean and largest distance of sites from the centroids of their cells before the repair,
        in units of the spacing.
    defects_before, defects_after : Defects
        The defects before and after the repair.
    moved : int
        The number of sites that the repair moved.
    left_out : int
        The number of places on lines and beside them that were too close to others.

    """

    end: str
    steps: int
    mean_offset: float
    largest_offset: float
    defects_before: Defects
    defects_after: Defects
    moved: int
    left_out: int = 0


class EqualArea(NamedTuple):
    """The result of `equal_area`.

    Attributes
    ----------
    points : ndarray of float64, shape (n, 3)
        Weighted sites for ``rondel.delaunay(points, model="weighted")``, whose power cells have the
        areas.
    weights : ndarray of float64, shape (n,)
        The lengths of the points.
    areas : ndarray of float64, shape (n,)
        The areas of the power cells in steradians.
    end : str
        "converged", "rounded" (doubles allow no smaller error), "iterations" or "infeasible".
    steps : int
        The number of steps.
    largest_error : float
        The largest relative error of an area.
    reason : str
        Why the areas are not those that were prescribed; empty if they are.

    """

    points: FloatArray
    weights: FloatArray
    areas: FloatArray
    end: str
    steps: int
    largest_error: float
    reason: str = ""


def _whole(value: float, name: str) -> int:
    if isinstance(value, (int, np.integer)):
        return int(value)
    if not float(value).is_integer():
        raise ValueError(f"{name} must be a whole number, not {value}")
    return int(value)


def _require_positive(value: float, name: str) -> None:
    if not (np.isfinite(value) and value > 0):
        raise ValueError(f"{name} must be positive and finite, not {value}")


def slope_of(gradient: float | None) -> float:
    """The gradient; 0 where there is no limit."""
    if gradient is None:
        return 0.0
    _require_positive(float(gradient), "gradient")
    return float(gradient)


def raster_of(spacing: Spacing | None, steps: int, area: Any = None) -> FloatArray:
    """The spacings at the nodes of the raster of an area; empty where none is given."""
    if spacing is None:
        return np.empty(0)
    if isinstance(spacing, str | bytes | bool | np.bool_):
        raise TypeError(f"spacing is {spacing!r}, neither a number nor a function of places")
    places = _core.raster_places(steps, area)
    if not callable(spacing):
        return np.full(len(places), float(spacing))
    values = as_floats(spacing(frozen(places)), "spacing")
    if values.shape != (len(places),):
        raise ValueError(f"spacing has the shape {values.shape}, not ({len(places)},)")
    return np.ascontiguousarray(values)


def spacing_of_density(density: Density) -> Callable[[FloatArray], FloatArray]:
    """The spacings of a tessellation of this density, the largest 1."""

    def spacing(places: FloatArray) -> FloatArray:
        values = as_floats(density(places), "density")
        if not (np.isfinite(values).all() and (values > 0).all()):
            raise ValueError("density is not positive and finite everywhere")
        return np.asarray((values / values.min()) ** -0.25)

    return spacing


def scvt_points(
    n: int | None,
    spacing: Spacing | None,
    density: Density | None,
    fixed: ArrayLike | Lines | None,
    along: Lines | None,
    edges: Edges,
    gradient: float | None,
    tolerance: float,
    largest_tolerance: float,
    max_steps: int,
    raster_steps: int,
    repair: bool,
    threads: int | None,
    progress: Progress,
) -> tuple[FloatArray, FloatArray, IntArray, ScvtReport]:
    """Points, densities, the sites of fixed places and report of `rondel.mesh.scvt`."""
    if density is not None:
        if n is None or spacing is not None:
            raise TypeError("scvt() takes density with n, and without spacing")
        spacing = spacing_of_density(density)
    if n is None and spacing is None:
        raise TypeError("scvt() needs n or spacing")
    count = 0 if n is None else _whole(n, "n")
    most_steps = _whole(max_steps, "max_steps")
    if most_steps < 0:
        raise ValueError(f"max_steps must not be negative, like {max_steps}")
    _require_positive(tolerance, "tolerance")
    _require_positive(largest_tolerance, "largest_tolerance")
    steps = _whole(raster_steps, "raster_steps") if callable(spacing) else 1
    spacings = raster_of(spacing, steps)
    slope = slope_of(gradient)
    places, left_out = fixed_points(fixed, along, edges, count, spacings, steps, slope, threads)
    made, densities = _core.make_scvt(
        count=count,
        spacings=spacings,
        steps=steps,
        gradient=slope,
        mean_tolerance=float(tolerance),
        largest_tolerance=float(largest_tolerance),
        max_steps=most_steps,
        repair=bool(repair),
        fixed=places,
        threads=as_threads(threads),
        listener=progress,
    )
    is_met = made.mean_offset <= tolerance and made.largest_offset <= largest_tolerance
    if made.end != "converged" and not is_met:
        warn_caller(
            f"scvt() is not converged ({made.end} after {made.steps} steps): the mean offset is "
            f"{made.mean_offset:.2g} (tolerance {tolerance:.2g}), the largest "
            f"{made.largest_offset:.2g} (largest_tolerance {largest_tolerance:.2g})"
        )
    said = {name: getattr(made, name) for name in ScvtReport._fields[:-1]}
    for name in ("defects_before", "defects_after"):
        said[name] = Defects(*(getattr(said[name], field) for field in Defects._fields))
    return made.points, densities, made.fixed, ScvtReport(**said, left_out=left_out)


def equal_area(
    points: ArrayLike,
    areas: ArrayLike | None = None,
    *,
    tolerance: float = 1e-12,
    threads: int | None = None,
) -> EqualArea:
    """Computes weights of points whose power cells have prescribed areas.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        The sites; only their directions from the origin are used.
    areas : array_like, shape (n,), optional
        The wanted areas in any unit; they are scaled such that their sum is the area of the sphere.
        By default all are equal.
    tolerance : float, optional
        The largest relative error of an area; by default 1e-12.
    threads : int, optional
        The largest number of threads; by default one for each core.

    Returns
    -------
    EqualArea
        Weighted sites, the areas of their cells, and how the work ended.

    Raises
    ------
    InvalidInput
        If two points are in one place, or an area is not positive and finite. Its `index` is the
        site.
    ValueError
        If the tolerance is not positive and finite, or `areas` has another shape than (n,).

    Warns
    -----
    UserWarning
        If the cells have other areas, because there are none of these areas ('infeasible'), the
        steps did not suffice ('iterations'), or doubles allow none that are within the tolerance
        ('rounded').

    Examples
    --------
    >>> import numpy as np
    >>> import rondel.mesh
    >>> points = np.random.default_rng(1).normal(size=(500, 3))
    >>> found = rondel.mesh.equal_area(points)
    >>> found.end in ("converged", "rounded")
    True
    >>> cells = rondel.delaunay(found.points, "weighted").voronoi()
    >>> bool(np.ptp(cells.areas) < 1e-10)
    True

    """
    _require_positive(tolerance, "tolerance")
    sites = as_points(points)
    targets = np.empty(0)
    if areas is not None:
        targets = np.ascontiguousarray(as_floats(areas, "areas"))
        if targets.shape != (len(sites),):
            raise ValueError(f"areas has shape {targets.shape}, not ({len(sites)},)")
        if np.all((targets > 0) & np.isfinite(targets)):  # the library names the first that is not
            targets = targets / targets.max()
            targets *= 4 * np.pi / targets.sum()
    found = _core.make_equal_area(sites, targets, float(tolerance), as_threads(threads))
    is_met = found.end == "rounded" and found.largest_error <= tolerance
    if found.end != "converged" and not is_met:
        warn_caller(
            f"equal_area() ended as {found.end!r}, with areas off by up to "
            f"{found.largest_error:.3g} (tolerance {tolerance:.3g})"
            + (f": {found.reason}" if found.reason else "")
        )
    return EqualArea(*(getattr(found, name) for name in EqualArea._fields))
