# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Conservative remapping: means over target cells from means over source cells."""

from __future__ import annotations

import operator
from typing import Any, Literal, TypeAlias

import numpy as np

from . import _core
from ._arrays import as_mask, as_threads
from ._cell_set import CellSet
from ._delaunay import SphericalDelaunay
from ._diagram import Diagram
from ._geo import Path
from ._regions import Regions
from ._repr import Described, count
from ._types import ArrayLike, FloatArray, IntArray, Progress
from ._voronoi_mesh import Mesh
from ._weight_files import are_near, netcdf_name
from ._weights import Weights
from ._zarr_weights import remap_in_group, remap_to_zarr

CellOverlap: TypeAlias = Literal["error", "first", "share", "each"]
RemapLimiter: TypeAlias = Literal["none", "bounds", "slopes"]
# That of weights which may be applied to some targets at a time.
SlopeLimiter: TypeAlias = Literal["none", "slopes"]


class Remap(Described):
    """The result of `remap`: weights between two sets of cells, and a description of both sets.

    Attributes
    ----------
    weights : Weights
        A sparse matrix with a row for each target cell and a column for each source cell;
        ``weights.apply(means)`` computes the means over target cells.
    source, target : CellSet
        The cells of both sides, with the masks that count.
    source_areas, target_areas : ndarray of float64, shape (n,) and (m,)
        The areas of the cells in steradians.
    source_fractions, target_fractions : ndarray of float64, shape (n,) and (m,)
        The share of each cell that the other side covers, from 0 to 1.

    """

    def __init__(
        self,
        made: _core.Remap,
        source: CellSet,
        target: CellSet,
        norm: str,
        order: int,
    ) -> None:
        self.weights = Weights._of(made.take_weights())
        self.source = source
        self.target = target
        self.source_areas: FloatArray = made.source_areas.copy()
        self.target_areas: FloatArray = made.target_areas.copy()
        self.source_fractions: FloatArray = made.source_fractions.copy()
        self.target_fractions: FloatArray = made.target_fractions.copy()
        self._norm = norm
        self._order = order

    def to_netcdf(self, path: Path, format: Literal["esmf", "scrip"] = "esmf") -> None:
        """Writes a file of weights that other programs can apply.

        It contains centers, areas, masks and corners of the cells of both sides, and the properties
        of polygons, so that ``rondel apply`` gives values their names.

        Parameters
        ----------
        path : path-like
            Ends in .nc or .nc4 (netCDF-4), .cdf or .ncf. The file appears when it is complete,
            and replaces the one that is there.
        format : {'esmf', 'scrip'}, optional
            The names of variables: those of ESMF (default), or those of SCRIP, which CDO reads.

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.

        See Also
        --------
        Weights.to_netcdf : the same with centers that the caller gives.

        """
        _core.write_remap(netcdf_name(path, format), format, self._made())

    to_zarr = remap_to_zarr

    @classmethod
    def from_zarr(
        cls, path: Path, source: Any = None, target: Any = None, *, threads: int | None = None
    ) -> Remap:
        """Reads what `to_zarr` wrote. `Weights.from_zarr` reads the weights alone, or some rows.

        Parameters
        ----------
        path : path_like
            The folder.
        source, target : CellSet or what `remap` takes, optional
            The cells of both sides, which the group does not have; by default the grids that it
            names (`CellSet.named`).
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        Remap
            The weights, areas and fractions are equal to the bit, and the masks are those of the
            group.

        Raises
        ------
        ImportError
            If zarr-python 3 or later is not installed.
        OSError
            If there is no such folder, or no group in it.
        ValueError
            If the group has no remapping, names no grid of a side whose cells are not given, or
            the cells have other centers than there.

        Examples
        --------
        >>> import rondel
        >>> remap = rondel.remap("grid:90", "healpix:0")
        >>> remap.to_zarr("weights.zarr")  # doctest: +SKIP
        >>> rondel.Remap.from_zarr("weights.zarr")  # doctest: +SKIP
        <rondel.Remap: 8 cells to 12 cells, 24 weights>
        >>> rondel.Weights.from_zarr("weights.zarr", rows=slice(0, 4))  # doctest: +SKIP
        <rondel.Weights: 4 targets, 8 sites, 8 entries>

        """
        found = remap_in_group(path)
        sides = []
        for k, (what, given) in enumerate((("source", source), ("target", target))):
            grid, places, mask = found.grids[k], found.places[k], found.masks[k]
            if given is None and grid is None:
                raise ValueError(f"{found.path}: it names no grid of the {what}: give its cells")
            cells = as_cell_set(grid if given is None else given, threads)
            own = cells._degrees()
            if len(own) != len(places) or not are_near(own, places).all():
                raise ValueError(f"{found.path}: the {what} has other cells")
            same = np.array_equal(cells.mask, mask)
            sides.append(cells if same else cells._with(mask=mask.astype(np.int32)))
        self = cls.__new__(cls)
        self.weights = Weights.from_zarr(path)
        self.source, self.target = sides
        self.source_areas, self.target_areas = found.areas
        self.source_fractions, self.target_fractions = found.fractions
        self._norm, self._order = found.norm, found.order
        return self

    def _made(self) -> _core.Remap:
        """The same as the library has it."""
        made = _core.Remap()
        made.source, made.target = self.source._placed(), self.target._placed()
        made.order, made.norm, made.weights = self._order, self._norm, self.weights._weights
        for member in ("source_areas", "target_areas", "source_fractions", "target_fractions"):
            setattr(made, member, getattr(self, member))
        return made

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("source", count(self.source.num_cells, "cell")),
            ("target", count(self.target.num_cells, "cell")),
            ("weights", count(len(self.weights.data), "weight")),
        ]

    def _summary(self) -> str:
        source, target, weights = (text for _, text in self._facts())
        return f"{source} to {target}, {weights}"


def remap(
    source: Any,
    target: Any,
    *,
    order: int = 1,
    norm: Literal["destarea", "fracarea"] = "destarea",
    source_mask: ArrayLike | None = None,
    target_mask: ArrayLike | None = None,
    overlap: CellOverlap = "error",
    threads: int | None = None,
    progress: Progress = None,
) -> Remap:
    """Computes conservative weights from the cells of one side to those of another.

    The weights turn means over source cells into means over target cells, such that the integral
    is kept.

    Parameters
    ----------
    source, target : CellSet, SphericalVoronoi, PowerDiagram, SphericalDelaunay, Mesh or Regions
        The n source cells and the m target cells, which cover the sphere or parts of it; or the
        name of a grid (`CellSet.named`). The cells of a triangulation are its triangles.
    order : {1, 2}, optional
        The order of the reconstruction. 1 (default): the field is constant in each source cell.
        2: it has a gradient, which is estimated by least squares over the neighbors; across
        neighbors that are nearly on a line it is 0.
    norm : {'destarea', 'fracarea'}, optional
        What the sum over a target is divided by. 'destarea' (default): its area, so that the
        integral is kept. 'fracarea': the area that sources cover, so that constants are
        reproduced.
    source_mask, target_mask : array_like of bool, shape (n,) and (m,), optional
        Which cells take part; by default the mask of the cells. For a grid also of its shape.
        Numbers other than 0 are true; a missing value (NaN, NA, None, or masked) is false.
    overlap : {'error', 'first', 'share', 'each'}, optional
        What to do with a place that several cells of one side contain. 'error' (default): raise an
        error that names two of the cells and the place. 'first': the place belongs to the cell with
        the lowest index. 'share': each cell gets an equal part. 'each': each target has all of its
        places, as if it were alone, and sources that overlap are an error. Cells that take no part
        do not count.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    Remap
        The weights, with areas and covered fractions of the cells. A target that no source covers
        has an empty row, and so the value NaN.

    Raises
    ------
    InvalidInput
        If a mask has another length or shape, cells of one side overlap and `overlap` is 'error',
        or a cell crosses or overlaps itself. It is a `ValueError` whose `index` is the cell.
    TypeError
        If a mask has elements that are neither numbers nor booleans, or an argument has no cells.

    Notes
    -----
    The weights are those of Jones, "First- and Second-Order Conservative Remapping Schemes for
    Grids in Spherical Coordinates", Mon. Weather Rev. 127, 1999, section 2, with exact decisions
    about which sides cross (docs/theory/overlay.md).

    Examples
    --------
    >>> import rondel
    >>> remap = rondel.remap(rondel.lonlat_grid(4, 2), rondel.lonlat_grid(2, 1))
    >>> remap
    <rondel.Remap: 8 cells to 2 cells, 8 weights>
    >>> remap.weights.apply([1, 2, 3, 4, 5, 6, 7, 8])
    array([3.5, 5.5])

    """
    return remapped(
        source,
        target,
        order=order,
        norm=norm,
        source_mask=source_mask,
        target_mask=target_mask,
        overlap=overlap,
        threads=threads,
        progress=progress,
    )[0]


def remapped(
    source: Any,
    target: Any,
    *,
    order: int,
    norm: Literal["destarea", "fracarea"],
    overlap: CellOverlap,
    threads: int | None,
    progress: Progress,
    source_mask: ArrayLike | None = None,
    target_mask: ArrayLike | None = None,
) -> tuple[Remap, _core.Remap]:
    """The result of `remap`, and all that the library made but the weights."""
    if operator.index(order) not in (1, 2):
        raise ValueError(f"order must be 1 or 2, not {order}")
    cells = [as_cell_set(side, threads) for side in (source, target)]
    masks = (
        _as_mask(source_mask, "source_mask", cells[0]),
        _as_mask(target_mask, "target_mask", cells[1]),
    )
    made = _core.remap(
        *(side._cells for side in cells),
        order=order,
        norm=norm,
        source_mask=masks[0],
        target_mask=masks[1],
        overlap=overlap,
        threads=as_threads(threads),
        progress=progress,
    )
    source, target = (
        side if len(mask) == 0 else CellSet._of(masked, side._origin)
        for side, mask, masked in zip(cells, masks, (made.source, made.target), strict=True)
    )
    return Remap(made, source, target, norm, int(order)), made


def as_cell_set(cells: Any, threads: int | None) -> CellSet:
    """The cells of what has cells: of diagrams, the faces of triangulations, those of meshes."""
    if isinstance(cells, CellSet):
        return cells
    if isinstance(cells, str):
        return CellSet.named(cells, threads=threads)
    if isinstance(cells, Mesh):
        each = np.arange(len(cells.offsets))
        points = cells.vertex_points / cells.radius
        return CellSet.polygons(
            each, cells.offsets, cells.vertices_on_cell, points, threads=threads
        )
    if isinstance(cells, Diagram):
        return CellSet.voronoi(cells, threads=threads)
    if isinstance(cells, SphericalDelaunay):
        return CellSet.triangles(cells, threads=threads)
    if isinstance(cells, Regions):
        return cells.cell_set(threads=threads)
    raise TypeError(f"{type(cells).__name__} has no cells: a CellSet, diagram or mesh is wanted")


def _as_mask(mask: ArrayLike | None, name: str, cells: CellSet) -> IntArray:
    """The mask; an empty one if none is given: that of the cells counts."""
    if mask is None:
        return np.zeros(0, np.int32)
    shape = np.shape(mask)
    if len(shape) != 1 and shape != cells.shape:
        wanted = {f"({cells.num_cells},)", str(cells.shape)}
        raise ValueError(f"{name} must have the shape {' or '.join(sorted(wanted))}, not {shape}")
    return np.ascontiguousarray(as_mask(mask, name).reshape(-1), np.int32)
