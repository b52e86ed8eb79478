# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sets of cells on the sphere, prepared for remapping."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import (
    as_floats,
    as_indices,
    as_lonlat,
    as_name,
    as_points,
    as_threads,
    degrees_of,
    half_turn,
)
from ._errors import InvalidInput, warn_caller
from ._geo import Path, arrow_of
from ._geometries import (
    Corners,
    Edges,
    Invalid,
    PolygonOverlap,
    Sides,
    polygons_of,
    read_cells,
)
from ._pickled import arrays_of, with_arrays
from ._plot_cells import plot_cells
from ._repr import Described, count
from ._types import ArrayLike, BoolArray, FloatArray, IntArray

# The endings of files that users take for grids: their fields or polygons are on some.
_OF_FIELDS = (".nc", ".nc4", ".zarr", ".grib", ".grib2", ".csv")
_OF_POLYGONS = (".geojson", ".json", ".shp", ".gpkg", ".parquet")


class CellSet(Described):
    """Cells on the sphere: of a diagram, a triangulation, a grid, a model's mesh, or polygons.

    The class methods make it; `remap` and `SphericalVoronoi.clip` use it. Cells may cover the whole
    sphere or parts of it, and may overlap.

    Attributes
    ----------
    num_cells : int
        The number of cells, n.
    areas : ndarray of float64, shape (n,)
        The areas of the cells in steradians.
    centers : ndarray of float64, shape (n, 3)
        Unit vectors to the centers of mass.
    shape : tuple of int
        The shape of a grid, (nlat, nlon); otherwise (n,).
    mask : ndarray of bool, shape (n,)
        Which cells take part in remapping.

    Examples
    --------
    >>> import numpy as np
    >>> import rondel
    >>> grid = rondel.CellSet.lonlat_grid(np.linspace(-180, 180, 37), np.linspace(-90, 90, 19))
    >>> grid
    <rondel.CellSet: 648 cells, a cover of the sphere>
    >>> grid.shape
    (18, 36)

    """

    _cells: _core.CellSet
    # The name of the function of the library that made cells of sites, and the object that has the
    # sites; None for other cells.
    _origin: tuple[str, Any] | None
    # Whether it is known that no cell crosses itself.
    _is_sound: bool = False

    @classmethod
    def _of(cls, cells: _core.CellSet, origin: tuple[str, Any] | None = None) -> CellSet:
        self = cls.__new__(cls)
        self._cells = cells
        self._origin = origin
        return self

    def _with(self, **facts: Any) -> CellSet:
        """The same cells with some other facts."""
        made = with_arrays(_core.CellFacts(self._cells.facts), facts)
        return self._of(self._cells.with_facts(made), self._origin)

    # Cells of sites, a grid or pixels are made again, so that they are the same bit by bit.
    def __getstate__(self) -> dict[str, Any]:
        made: tuple[Any, ...]
        lines = self._cells.lines()
        if self._origin is not None:
            made = self._origin
        elif lines is not None:
            made = ("lonlat_grid", *lines)
        else:
            rings = arrays_of(self._cells.given_rings())
            sides = self._cells.sides()
            made = ("polygons", rings) if sides is None else ("straight_polygons", rings, *sides)
        return {"made": made, "facts": arrays_of(self._cells.facts)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        name, *given = state["made"]
        is_of_sites = name in ("voronoi", "triangles")
        self._origin = (name, given[0]) if is_of_sites or name == "named" else None
        if is_of_sites:
            given = [given[0]._triangulation]
        elif name == "named":
            given = [*given[0]]
        elif name in ("polygons", "straight_polygons"):
            given[0] = with_arrays(_core.CellRings(), given[0])
        cells = getattr(_core.CellSet, name)(*given, 0)
        self._cells = cells.with_facts(with_arrays(_core.CellFacts(), state["facts"]))

    @classmethod
    def voronoi(cls, sites: Any, *, threads: int | None = None) -> CellSet:
        """Makes the Voronoi cells, or power cells, of sites.

        Parameters
        ----------
        sites : SphericalDelaunay, SphericalVoronoi or PowerDiagram
            The sites: a triangulation or a diagram.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        CellSet
            Cell i belongs to site i; duplicates and hidden sites have empty cells. Corners are
            circumcenters rounded to doubles.

        Raises
        ------
        TypeError
            If `sites` is neither a triangulation nor a diagram.

        """
        owner = _triangulated_of(sites)
        made = _core.CellSet.voronoi(owner._triangulation, as_threads(threads))
        return cls._of(made, ("voronoi", owner))

    @classmethod
    def triangles(cls, sites: Any, *, threads: int | None = None) -> CellSet:
        """Makes the triangles of a triangulation: its faces without ghosts, in their order.

        Parameters
        ----------
        sites, threads
            As in `voronoi`; of a diagram its triangulation is taken.

        Returns
        -------
        CellSet
            A cell for each face that is no ghost.

        Raises
        ------
        TypeError
            As in `voronoi`.

        """
        owner = _triangulated_of(sites)
        made = _core.CellSet.triangles(owner._triangulation, as_threads(threads))
        return cls._of(made, ("triangles", owner))

    @classmethod
    def lonlat_grid(
        cls,
        lon: ArrayLike,
        lat: ArrayLike,
        *,
        sides: Sides = "parallels",
        threads: int | None = None,
    ) -> CellSet:
        """Makes the cells of a grid from its lines.

        Parameters
        ----------
        lon : array_like, shape (nlon + 1,)
            The meridians between cells in degrees, increasing or decreasing by at most 360 in all.
        lat : array_like, shape (nlat + 1,)
            The parallels between cells in degrees, increasing or decreasing.
        sides : {'parallels', 'great_circles'}, optional
            What the northern and southern sides of cells are: parallels (default), or arcs of great
            circles between the corners, as in ESMF.
        threads
            As in `voronoi`.

        Returns
        -------
        CellSet
            Cells of the shape (nlat, nlon), in C order.

        Raises
        ------
        InvalidInput
            If a line is out of order, is not finite, or is a latitude outside [-90, 90].

        Examples
        --------
        >>> import rondel
        >>> cells = rondel.CellSet.lonlat_grid([0, 90, 180], [-90, 0, 90])
        >>> cells.shape, (cells.areas / 3.141592653589793).round(9).tolist()
        ((2, 2), [0.5, 0.5, 0.5, 0.5])

        """
        lines = _as_lines(lon, "lon"), _as_lines(lat, "lat")
        return cls._of(_core.CellSet.lonlat_grid(*lines, sides, as_threads(threads)))

    @classmethod
    def named(cls, name: str, *, sides: Sides = "parallels", threads: int | None = None) -> CellSet:
        """Makes the cells of a grid from its name.

        Parameters
        ----------
        name : str
            ``'grid:0.25'`` and ``'grid:1440x720'``: between meridians and parallels, from longitude
            -180 eastward and from the south pole northward. ``'healpix:7'`` and
            ``'healpix:7:ring'``: the 12 * 4**7 pixels of HEALPix, in nested or in ring order.
            ``'F320'``, ``'N320'`` and ``'O320'``: ECMWF's Gaussian grids, regular, reduced and
            octahedral. ``'C384'``: the equiangular cubed sphere, of the shape (6, 384, 384).
            ``'R2B6'``: the triangles of an icosahedron whose sides are divided by 2 and then 6
            times by halves, as ICON's before its points are moved. ``'hexagons:R2B6'``: the cells
            around the corners of these triangles, 12 pentagons and hexagons. ``'tripolar:0.25'``:
            an ocean grid whose poles are on land, without the Antarctic, of the shape (rows,
            columns), rows from the south and columns from longitude 80 eastward.
        sides : {'parallels', 'great_circles'}, optional
            Those of ``'grid:'``, ``'F'`` and ``'healpix:'``. With 'great_circles' a pixel has four
            sides, which changes its area; otherwise chains that keep it.
        threads
            As in `voronoi`.

        Returns
        -------
        CellSet
            The cells, in the order that files of such grids have.

        Raises
        ------
        InvalidInput
            If there is no such grid.

        Examples
        --------
        >>> import rondel
        >>> pixels = rondel.CellSet.named("healpix:1")
        >>> pixels.shape, float(pixels.areas.min() * 48 / 3.141592653589793).__round__(9)
        ((48,), 4.0)

        """
        _refuse_file(name)
        made = _core.CellSet.named(name, sides, as_threads(threads))
        # Pixels of HEALPix have areas by definition, which their corners do not say.
        are_pixels = name.lower().startswith("healpix:")
        return cls._of(made, ("named", (name, sides)) if are_pixels else None)

    @classmethod
    def _some(cls, name: str, numbers: IntArray) -> CellSet:
        """Some cells of a named grid, by their numbers."""
        return cls._of(_core.CellSet.some_of_named(name, numbers, 0))._with(shape=())

    @classmethod
    def lonlat_centers(
        cls,
        lon: ArrayLike,
        lat: ArrayLike,
        *,
        sides: Sides = "parallels",
        threads: int | None = None,
    ) -> CellSet:
        """Makes the cells of a grid from the coordinates of their centers.

        Cells end half way between neighboring centers.

        Parameters
        ----------
        lon : array_like, shape (nlon,)
            Two or more longitudes in degrees, increasing or decreasing up to whole turns. If the
            last one is the first one again, each of them gets half of the cell.
        lat : array_like, shape (nlat,)
            Degrees, increasing or decreasing. The first and the last cell end half a step
            beyond, or at a pole that is less than a cell beyond that.
        sides, threads
            As in `lonlat_grid`.

        Raises
        ------
        InvalidInput
            If a coordinate is out of order or repeats the one before it.

        """
        axes = _as_lines(lon, "lon"), _as_lines(lat, "lat")
        lines = axis_lines("lon", axes[0], None, True), axis_lines("lat", axes[1], None, False)
        made = cls.lonlat_grid(*lines, sides=sides, threads=threads)
        return made._with(axes=axes)

    @classmethod
    def polygons(
        cls,
        cells: ArrayLike,
        rings: ArrayLike,
        corners: ArrayLike,
        points: ArrayLike,
        *,
        whole: ArrayLike = (),
        threads: int | None = None,
    ) -> CellSet:
        """Makes cells from flat arrays of rings; they may have holes and several parts.

        Parameters
        ----------
        cells : array_like of int, shape (n + 1,)
            Cell i has the rings ``cells[i]`` to ``cells[i + 1] - 1``.
        rings : array_like of int, shape (r + 1,)
            Ring j has the corners ``corners[rings[j]:rings[j + 1]]``; the first is not repeated.
        corners : array_like of int, shape (k,)
            Rows of `points`. The inside is to the left: seen from outside of the sphere, outer
            rings are counterclockwise and holes clockwise. Sides are the shorter arcs of great
            circles.
        points : array_like, shape (p, 3)
            Unit vectors. Cells that share a side use the same two rows.
        whole : array_like of int, optional
            The cells that are the whole sphere, in increasing order; by default none. Like empty
            cells they have no rings.
        threads
            As in `voronoi`.

        Returns
        -------
        CellSet
            The n cells.

        Raises
        ------
        InvalidInput
            If an index is out of range, a ring has fewer than three corners, a corner is no unit
            vector, or a cell that is the whole sphere has rings. Its `index` is the cell.

        """
        rings_of_cells = {
            "cells": as_indices(cells, "cells").astype(np.int64),
            "rings": as_indices(rings, "rings").astype(np.int64),
            "corners": as_indices(corners, "corners"),
            "points": as_points(points),
            "whole": as_indices(whole, "whole"),
        }
        made = with_arrays(_core.CellRings(), rings_of_cells)
        return cls._of(_core.CellSet.polygons(made, as_threads(threads)))

    @classmethod
    def corners(cls, lon: ArrayLike, lat: ArrayLike, *, threads: int | None = None) -> CellSet:
        """Makes cells from the coordinates of their corners, like bounds of the CF conventions.

        Parameters
        ----------
        lon, lat : array_like, shape (n, k) or (..., n, m, k)
            The corners of each cell in degrees, in either direction around it. Corners within 1e-10
            radians count as one; cells with fewer than k corners repeat some.
        threads
            As in `voronoi`.

        Returns
        -------
        CellSet
            Cells of the shape of `lon` without its last axis. Their sides are great circles.

        Raises
        ------
        InvalidInput
            If a corner is not finite, or has a latitude outside [-90, 90]. Its `index` is the cell.

        """
        return cls._around(lon, lat, np.zeros((0, 2)), threads)[0]

    @classmethod
    def _around(
        cls, lon: ArrayLike, lat: ArrayLike, centers: FloatArray, threads: int | None
    ) -> tuple[CellSet, tuple[int, int, int, bool]]:
        """Cells with these corners; and how many centers (n, 2), if there are some, are outside of
        them, of how many, the first of these cells, and whether most centers are.
        """
        degrees = as_lonlat(lon, lat)
        shape = np.shape(lon)
        if len(shape) < 2:
            raise ValueError(f"lon must have shape (..., k), not {shape}")
        made, (number, of, first), are_most = _core.corner_cells(
            degrees, shape[-1], centers, as_threads(threads)
        )
        cells = cls._of(made)._with(shape=shape[:-1] if len(shape) > 2 else ())
        return cells, (number, of, first, are_most)

    @classmethod
    def read(
        cls,
        path: Path,
        *,
        sides: Sides = "parallels",
        edges: Edges = "lonlat",
        overlap: PolygonOverlap = "keep",
        invalid: Invalid = "error",
        corners: Corners = "error",
        threads: int | None = None,
    ) -> CellSet:
        """Reads the cells of a file.

        Parameters
        ----------
        path : path-like
            A netCDF file with the conventions of UGRID, SCRIP, ESMF, MPAS, ICON or CF, or a
            ``.geojson`` file whose features are the cells, or with GDAL installed ``.gpkg``,
            ``.fgb``, ``.shp`` or ``.parquet`` with polygons. netCDF-4 is read by the library that
            the package netCDF4 brings. If the file has several grids, ``FILE.nc:NAME`` names a
            variable of a grid, or one with values on it.
        sides : {'parallels', 'great_circles'}, optional
            As in `lonlat_grid`, for grids whose coordinates are axes; by default 'parallels'.
        edges : {'lonlat', 'geodesic'}, optional
            What joins positions of polygons: straight lines in longitude and latitude as in RFC
            7946 (default), or great circles.
        overlap : {'keep', 'error', 'first'}, optional
            What to do with a place that several features contain: 'keep' (default) makes cells that
            overlap there, 'error' raises an error that names two of them, 'first' gives the place
            to the first one.
        invalid : {'error', 'repair'}, optional
            What to do with polygons that are not valid: 'error' (default) raises an error that
            names the first one, what is wrong with it, and a place; 'repair' makes them valid, as
            `rondel.make_valid` does, and warns of it. The cells of netCDF that cross themselves
            are kept by 'error' for the functions that refuse them, and `repaired` by 'repair'.
        corners : {'error', 'made'}, optional
            What to do where longitudes and latitudes of two dimensions have no bounds, as those of
            WRF, ROMS and swaths: 'error' (default), or 'made', which makes corners half way
            between the centers, extrapolated at the border, and warns of it.
        threads
            As in `voronoi`.

        Returns
        -------
        CellSet
            The cells, in the order of the file.

        Raises
        ------
        OSError
            If the file cannot be read. The message says what is wrong in it: rings that cross,
            holes outside of their polygon, parts that overlap.

        Warns
        -----
        UserWarning
            If cells are masked, or are left out because of missing corners (with their number), if
            polygons were repaired, or if one of several grids was read.

        """
        name = as_name(path)
        rules = edges, overlap, invalid, as_threads(threads)
        return cls._of(read_cells(name, *rules, sides=sides, corners=corners))

    @classmethod
    def from_geometries(
        cls,
        geometries: Any,
        *,
        edges: Edges = "lonlat",
        overlap: PolygonOverlap = "keep",
        invalid: Invalid = "error",
        threads: int | None = None,
    ) -> CellSet:
        """Makes cells of polygons of other libraries, which may have holes and several parts.

        Parameters
        ----------
        geometries : GeoDataFrame, GeoSeries, sequence or mapping
            The polygons, one a cell: a GeoDataFrame or GeoSeries; a sequence of geometries of
            shapely; a mapping of GeoJSON, or any object with `__geo_interface__`; arrays or tables
            of GeoArrow; or a box of west, south, east and north in degrees. Projected coordinates
            are converted to longitudes and latitudes by their `crs`; sides that are straight in the
            projection get corners in between, which follow them to about 1e-4 degrees.
        edges, overlap, invalid, threads
            As in `read`.

        Returns
        -------
        CellSet
            A cell for each geometry.

        Raises
        ------
        ValueError
            If a geometry is not a polygon, is not valid, or has positions that are no longitudes
            and latitudes. The message has its number.

        Warns
        -----
        UserWarning
            If polygons were repaired, or have no area but for rounding.

        Notes
        -----
        Arrays of the types geoarrow.polygon and geoarrow.multipolygon in EPSG:4326, OGC:CRS84 or
        without a CRS are read without another library, whoever made them; GeoPandas reads others.

        Examples
        --------
        >>> import rondel
        >>> tie = {"type": "Polygon", "coordinates": [[[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]]}
        >>> rondel.CellSet.from_geometries(tie)
        Traceback (most recent call last):
        ValueError: geometries: geometry 0: ring 0 of part 0 crosses itself at 1 1
        >>> import warnings
        >>> with warnings.catch_warnings(record=True):
        ...     cells = rondel.CellSet.from_geometries(tie, invalid="repair")
        >>> len(cells.rings[1]) - 1
        2

        """
        made = cls._of(polygons_of(geometries, edges, overlap, invalid, as_threads(threads)))
        made._is_sound = True
        return made

    @property
    def num_cells(self) -> int:
        """int: the number of cells."""
        return self._cells.num_cells

    @property
    def areas(self) -> FloatArray:
        """Ndarray of float64, shape (n,): the areas of the cells in steradians, read-only.
        `InvalidInput` is raised if a cell crosses or overlaps itself.
        """
        return self._cells.areas

    @property
    def centers(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): unit vectors to the centers of mass; (0, 0, 0) for
        empty cells. Rounding moves a center by about 1e-16 radians times the length of the border
        over the area, which is out of a square with sides below 1e-8 radians. `InvalidInput` is
        raised if a cell crosses or overlaps itself.
        """
        return self._cells.centers()

    @property
    def covers_sphere(self) -> bool:
        """bool: whether the cells cover the sphere and share their sides. Remapping is faster if
        this is true for one of the two sides.
        """
        return self._cells.covers_sphere

    @property
    def shape(self) -> tuple[int, ...]:
        """Tuple of int: the shape of a grid, (nlat, nlon); otherwise (n,)."""
        return tuple(self._cells.facts.shape) or (self.num_cells,)

    @property
    def mask(self) -> BoolArray:
        """Ndarray of bool, shape (n,): which cells take part in remapping, as their file says; all
        True if it says nothing.
        """
        mask = self._cells.facts.mask
        return mask != 0 if len(mask) else np.ones(self.num_cells, bool)

    @property
    def rings(self) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], IntArray, FloatArray]:
        """Tuple of ndarray: `cells`, `rings`, `corners` and `points` as `polygons` takes them.

        Raises
        ------
        InvalidInput
            If the cells have parallels as sides, so that they are no polygons.

        """
        made = self._cells.rings()
        return made.cells, made.rings, made.corners, made.points

    @property
    def whole(self) -> IntArray:
        """Ndarray of int32: the cells that are the whole sphere, which have no `rings`.

        Raises
        ------
        InvalidInput
            If the cells have parallels as sides.

        """
        return self._cells.rings().whole

    plot = plot_cells

    def repaired(self, *, threads: int | None = None) -> CellSet:
        """Repairs the cells that cross or overlap themselves, which `areas` refuses.

        Parameters
        ----------
        threads
            As in `voronoi`.

        Returns
        -------
        CellSet
            The same cells; those that cross or overlap themselves have the places that an odd
            number of their sides divides from the outside. Other cells stay bit by bit, and cells
            that overlap each other still do.

        Raises
        ------
        InvalidInput
            If a cell has a side that leads to the opposite point. Its `index` is the cell.

        Warns
        -----
        UserWarning
            If a cell was repaired, with the first one and what was wrong with it.

        See Also
        --------
        rondel.make_valid : the same for polygons.

        Examples
        --------
        >>> import rondel, warnings
        >>> tie = rondel.CellSet.corners([[0, 2, 2, 0]], [[0, 2, 0, 2]])
        >>> with warnings.catch_warnings(action="ignore"):
        ...     cells = tie.repaired()
        >>> print(f"{cells.areas[0]:.3e}")
        6.092e-04

        """
        made = self._cells.repaired(as_threads(threads))
        for remark in made.facts.remarks[len(self._cells.facts.remarks) :]:
            warn_caller(remark)
        cells = CellSet._of(made, self._origin)
        cells._is_sound = True
        return cells

    def __arrow_c_array__(self, requested_schema: Any = None) -> tuple[Any, Any]:
        """Hands the cells to another library as an array of geoarrow.multipolygon: polygons in
        longitude and latitude, cut at the antimeridian, with lines within 0.01 degrees of the arcs.

        Raises
        ------
        InvalidInput
            If the cells have parallels as sides.

        """
        return arrow_of(self._cells.rings(), "apart")

    def _placed(self) -> _core.CellSet:
        """The cells with the places that files have: those of Voronoi cells are the sites."""
        if self._origin is None or self._origin[0] != "voronoi" or len(self._cells.facts.centers):
            return self._cells
        sites = self._origin[1]._triangulation
        return self._with(centers=degrees_of(sites.points, sites.center))._cells

    def _degrees(self) -> FloatArray:
        """The places of the cells, longitudes and latitudes of shape (n, 2)."""
        return self._placed().places()

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("cells", count(self.num_cells, "cell"))]
        if self.covers_sphere:
            facts.append(("cover", "a cover of the sphere"))
        masked = int(np.count_nonzero(self._cells.facts.mask == 0))
        if masked:
            facts.append(("mask", f"{masked:,} masked"))
        return facts


def _refuse_file(name: str) -> None:
    """Refuses what is the name of a file and of no grid, and says what reads it."""
    if not isinstance(name, str):
        return  # The library says what it is.
    ending = os.path.splitext(name)[1].lower()
    are_fields, are_polygons = ending in _OF_FIELDS, ending in _OF_POLYGONS
    is_file = are_fields or are_polygons or os.path.exists(name)
    if _core.is_grid_name(name) or not is_file:
        return
    hint = "rondel.CellSet.read() reads its cells"
    if are_polygons:
        hint = (
            "rondel.polygons() reads its cells, and rondel.zonal_statistics() computes statistics "
            "of fields in them"
        )
    elif are_fields:
        hint += (
            ", xarray.open_dataset() its fields, and rondel.regrid_file() takes files as they are"
        )
    raise InvalidInput(f"{name!r} is a file, and no grid: {hint}")


def axis_lines(
    name: str, axis: FloatArray, bounds: FloatArray | None, is_longitude: bool
) -> FloatArray:
    """The lines between the cells along an axis; errors begin with its name."""
    sides = np.zeros(0) if bounds is None else np.ascontiguousarray(bounds).reshape(-1)
    try:
        lines = _core.axis_lines(np.ascontiguousarray(axis, np.float64), sides, is_longitude)
    except InvalidInput as error:
        raise InvalidInput(f"{name!r}: {error}", error.index) from None
    away = half_turn(np.asarray(axis, np.float64) - (lines[:-1] + lines[1:]) / 2)
    outside = int(np.count_nonzero(np.abs(away) > np.abs(np.diff(lines)) / 2 + 1e-4))
    if bounds is not None and outside:
        warn_caller(f"{outside} of {len(axis)} coordinates of {name!r} are outside of their cells")
    return lines


def _as_lines(values: ArrayLike, name: str) -> FloatArray:
    lines = np.atleast_1d(as_floats(values, name))
    if lines.ndim != 1:
        raise ValueError(f"{name} must have shape (n,), not {lines.shape}")
    return lines


def _triangulated_of(sites: Any) -> Any:
    """The object that holds the triangulation."""
    for owner in (sites, getattr(sites, "delaunay", None)):
        if isinstance(getattr(owner, "_triangulation", None), _core.Triangulation):
            return owner
    raise TypeError(f"sites must be a triangulation or a diagram, not {type(sites).__name__}")
