# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The places and cells of what xarray holds."""

from __future__ import annotations

import contextlib
import copy
import os
from collections.abc import Hashable, Iterable, Mapping
from typing import Any

import numpy as np
import xarray

from . import _core
from ._arrays import as_threads, half_turn, in_words, point_set_hash, unit_vectors, unmasked
from ._cell_set import CellSet, axis_lines
from ._coordinates import (
    MARKS,
    NORTH_POLE,
    Coordinates,
    Repeats,
    are_away,
    grid_in_words,
    grid_of,
    has_mesh,
    lack_of_pixels,
    names_in_mesh,
    pairs_of_values,
    with_dimensions,
)
from ._delaunay import SphericalDelaunay, delaunay_lonlat
from ._errors import InvalidInput, warn_caller
from ._geometries import Corners, in_degrees, is_of_geopandas
from ._mesh_bytes import mesh_bytes
from ._sites import METHODS_FOR_POINTS, columns_of, described
from ._types import BoolArray, FloatArray, IntArray
from ._values import mask_of_convention, mask_of_variable, unpacked
from ._weight_files import MAX_APART, are_near, side_of
from ._weights import Weights

# The names of columns that tables usually have.
_COLUMNS = {"lon": ("lon", "lng", "long", "longitude"), "lat": ("lat", "latitude")}


def _spread(found: Coordinates) -> tuple[xarray.DataArray, xarray.DataArray]:
    """The latitudes and longitudes of all places, as arrays of one shape."""
    south, west = xarray.broadcast(xarray.DataArray(found.lat), xarray.DataArray(found.lon))
    return south, west


def _found(
    data: Any,
    lon: Hashable | None,
    lat: Hashable | None,
    repeats: Repeats,
    arguments: tuple[str, str],
) -> Coordinates:
    """The coordinates, of several in a mesh those of its faces or of all fields; errors advise the
    arguments that the caller has for their names.
    """
    try:
        try:
            return Coordinates(data, lon, lat, repeats)
        except InvalidInput:
            raise
        except ValueError:
            names = names_in_mesh(data) if lon is None and lat is None else None
            if names is None:
                raise
            return Coordinates(data, *names, repeats)
    except InvalidInput:
        raise
    except ValueError as error:
        text = str(error)
        for kind, argument in zip(("lon", "lat"), arguments, strict=True):
            text = text.replace(f"{kind}=NAME", f"{argument}=NAME")
            text = text.replace(f"({kind}=)", f"({argument}=)")
        raise ValueError(text) from None


def _pairs_of(found: Coordinates) -> FloatArray:
    """Longitudes and latitudes of all places, shape (n, 2)."""
    south, west = _spread(found)
    pairs = np.stack([west.values, south.values], axis=-1).reshape(-1, 2)
    return np.ascontiguousarray(pairs, np.float64)


def _require_latitudes(lat: Any, name: str) -> None:
    """Refuses the first latitude beyond a pole; one that is there by rounding was moved to it."""
    flat = np.asarray(lat, np.float64).reshape(-1)
    beyond = np.flatnonzero((np.abs(flat) > NORTH_POLE) & np.isfinite(flat))
    if len(beyond):
        at = int(beyond[0])
        text = str(flat[at]).removesuffix(".0")
        raise InvalidInput(f"{name!r}: latitude {text} is beyond a pole, at index {at}", at)


class Places:
    """Places of a Dataset, a DataArray, a CellSet, a mapping or a tuple (lon, lat) of arrays."""

    def __init__(
        self,
        data: Any,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        *,
        are_points: bool = False,
        are_pairs: bool = False,
        are_targets: bool = False,
        are_cells: bool = False,
        corners: Corners = "error",
        threads: int | None = None,
        arguments: tuple[str, str] = ("lon", "lat"),
    ) -> None:
        # With `are_cells` cells that have bounds take part where their centers are missing, too.
        if isinstance(data, (str, os.PathLike)):
            data = CellSet.named(os.fsdecode(data))
        given = data
        self._corners = corners
        # A table with the names of its coordinates; and what a list has in place of its dimension.
        self._table: tuple[Any, set[str]] | None = None
        self._other_dim: Hashable | None = None
        self._named_cells: CellSet | None = None  # those of the grid that the data name
        self._mesh_cells: CellSet | None = None  # those of a mesh, at the centers of which data are
        # Places that have been triangulated, each with the one before it in the same place.
        self.coincident: IntArray = np.zeros((0, 2), np.int64)
        self._cells = data if isinstance(data, CellSet) else None
        self._bounds_of_cells: dict[Hashable, Any] | None = None  # which are found once
        if self._cells is not None:
            data = _centers(self._cells)
        elif isinstance(data, Mapping) and not isinstance(data, xarray.Dataset):
            data = _dataset(dict(data), are_points)
        elif isinstance(data, tuple):
            if len(data) != 2:
                raise ValueError(f"a tuple is (lon, lat), not {len(data)} arrays")
            if are_pairs:
                data = _paired(*data)
            else:
                data = _dataset({"lon": data[0], "lat": data[1]}, are_points)
        elif hasattr(type(data), "columns") and hasattr(data, "to_numpy"):
            data, taken = _of_table(data)
            self._table = given, taken
        elif not isinstance(data, (xarray.Dataset, xarray.DataArray)):
            raise TypeError(
                "places are a Dataset, a DataArray, a dictionary or table with lon and lat, a "
                f"tuple (lon, lat) or a CellSet, not {type(data).__name__}"
            )
        # Places of a Dataset may repeat along time; in arrays each of them counts.
        repeats: Repeats = "drop_times" if are_targets else "drop"
        is_labeled = data is given
        if not is_labeled:
            lon, lat, repeats = "lon", "lat", "keep"
        data = unpacked(data)
        self._grid = ""
        self._list: str | None = None  # the variable with the numbers of pixels
        if self._cells is not None:
            self._grid = self._cells._cells.facts.name
        elif is_labeled and lon is None and lat is None:
            data = self._with_grid(data)
        is_known = self._cells is not None or self._named_cells is not None
        if are_cells and is_labeled and not is_known and isinstance(data, xarray.Dataset):
            data = self._with_mesh(data, lon, lat, threads) if has_mesh(data) else data
            if self._cells is not None:
                lon, lat, repeats = "lon", "lat", "keep"
        self._data = data
        self._found = _found(data, lon, lat, repeats, arguments)
        lons, lats = self._found.lon, self._found.lat
        # Two axes of a grid: the latitudes come first, as usual.
        south, west = xarray.broadcast(xarray.DataArray(lats), xarray.DataArray(lons))
        self.coordinates = {self._found.lat_name: lats, self._found.lon_name: lons}
        self.dims = south.dims
        self.shape = south.shape
        is_told = isinstance(given, xarray.Dataset) and "featureType" in given.attrs
        self.are_sites = self._table is not None or are_points or (is_told and len(self.dims) == 1)
        self.lon, self.lat = west.values, south.values
        if of_grid := self.mapping[1]:
            self.coordinates = {
                name: item.copy(deep=False) for name, item in self.coordinates.items()
            }
            for item in self.coordinates.values():
                item.attrs = {**item.attrs, **of_grid}
        for name, values in zip(self.coordinates, (self.lat, self.lon), strict=True):
            if values.dtype.kind not in "biuf":
                raise TypeError(f"{name!r} must be numbers, not {in_words(values)}")
        located = np.isfinite(self.lon) & np.isfinite(self.lat)
        self._located = None if located.all() else located.reshape(-1)
        self._used = self._located
        self._cells_need_places = not (are_cells and self._found.have_bounds)
        # Axes of cells are judged by their lines.
        if self._cells_need_places and not (are_cells and self._found.are_axes):
            _require_latitudes(lats.values, str(self._found.lat_name))
        if self._located is not None and self._cells_need_places:
            count = int(np.count_nonzero(~self._located))
            warn_caller(
                f"{count} of {self.lon.size} places have no longitude or latitude and are left out"
            )
        self._masked: BoolArray | None = None  # those that a mask of a convention leaves out
        if self._mesh_cells is not None:
            self._masked = self._mesh_cells.mask
            self._used = self._masked & self.have_places
            return
        found = mask_of_convention(data, self._found.lon_name, self.dims)
        if found is not None:
            name, self._masked = found
            mask = self._masked
            count = int(np.count_nonzero(~mask))
            warn_caller(f"{count} of {mask.size} cells are masked by {name!r}")
            self._used = mask if self._located is None else mask & self._located

    def _with_grid(self, data: Any) -> Any:
        """The data, or the centers of a named grid, or of some of its cells, that they have without
        coordinates.
        """
        found = grid_of(data)
        if found is None:
            return self._with_some_cells(data)
        name, pixels = found
        numbers = None if pixels is None else pixels.numbers
        cells = CellSet.named(name) if numbers is None else CellSet._some(name, numbers)
        try:
            own = Coordinates(data, None, None)
        except ValueError:
            self._cells, self._grid = cells, name if numbers is None else ""
            self._list = None if pixels is None else pixels.name
            placed = _centers(cells)
            return placed if pixels is None else placed.rename({"cell": pixels.dim})
        pairs = _pairs_of(own)
        # Points that were put into another order are no longer those of the grid.
        centers = cells._degrees()
        if len(pairs) == len(centers) and are_near(pairs, centers).all():
            self._grid, self._named_cells = name if numbers is None else "", cells
            self._list = None if pixels is None else pixels.name
            return data
        return self._with_some_cells(data)

    def _with_some_cells(self, data: Any) -> Any:
        """The data, whose places may be centers of some cells of the grid that they name."""
        try:
            own = Coordinates(data, None, None)
        except ValueError:
            if lack := lack_of_pixels(data):
                raise ValueError(lack) from None
            return data  # of which the error will tell
        if own.are_axes or own.have_bounds or not (grid := grid_in_words(data)):
            return data
        numbers = _core.numbers_at(grid, _pairs_of(own), MAX_APART)
        if len(numbers):
            self._named_cells = CellSet._some(grid, numbers)
        return data

    def _with_mesh(
        self, data: xarray.Dataset, lon: Hashable | None, lat: Hashable | None, threads: int | None
    ) -> Any:
        """The data, which may be at the centers of the cells of their mesh, or these centers. By
        `bounds` or along axes cells need no mesh.
        """
        is_chosen = lon is not None or lat is not None
        own: Coordinates | None = None
        with contextlib.suppress(ValueError):
            own = Coordinates(data, lon, lat)
        if own is None and is_chosen:
            return data  # of which the error will tell
        if own is not None and (own.are_axes or own.have_bounds):
            return data
        cells = self._read_mesh(data, own, is_chosen, threads)
        pairs = np.zeros((0, 2)) if own is None else _pairs_of(own)
        centers = cells._degrees()
        if len(pairs) == len(centers) and are_near(pairs, centers).all():
            self._mesh_cells = cells
        elif not is_chosen:
            self._cells = cells
            return _centers(cells)
        return data

    @staticmethod
    def _read_mesh(
        data: xarray.Dataset, own: Coordinates | None, is_chosen: bool, threads: int | None
    ) -> CellSet:
        """The cells of the mesh of a Dataset, as the library reads them from a file."""
        names = () if own is None else (own.lon_name, own.lat_name)
        planar = data.attrs.get("on_a_sphere")
        is_told = isinstance(planar, str) and not is_chosen
        attributes = {"on_a_sphere": str(planar)} if is_told else {}
        # Some cells of SCRIP still have the shape of all; dimensions of the data say what counts.
        cells = data.drop_vars("grid_dims", errors="ignore")
        content = mesh_bytes(cells, *names, attributes=attributes)
        try:
            made = _core.CellSet.of_mesh(content, as_threads(threads))
        except OSError as error:
            raise ValueError(str(error)) from None
        for remark in made.facts.remarks:
            warn_caller(remark)
        return CellSet._of(made)

    @property
    def mapping(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """What data at these places say of their grid: the attributes of a grid mapping, and
        those of the longitudes and latitudes.
        """
        texts, numbers = _core.grid_mapping(self._grid)
        _, shape = _core.grid_named_by(texts, numbers)
        if not texts or np.prod(shape) != self.lon.size:
            return {}, {}
        whole = {key: int(number) for key, number in numbers}
        is_mapping = texts[0][0] == "grid_mapping_name"
        return ({**dict(texts), **whole}, {}) if is_mapping else ({}, dict(texts))

    def bounds(self) -> dict[Hashable, Any]:
        """The variables that have the bounds of the coordinates, which of cells are lat_bnds and
        lon_bnds.
        """
        cells = self._cells if self._cells is not None else self._mesh_cells
        if cells is None:
            return {name: self._along(item) for name, item in self._found.bounds_once().items()}
        if self._bounds_of_cells is None:
            found = _bounds_of(cells, self._grid, self.dims, self.shape)
            if self._mesh_cells is not None:
                own = {"lon_bnds": self._found.lon_name, "lat_bnds": self._found.lat_name}
                found = {f"{own[str(name)]}_bnds": item for name, item in found.items()}
            self._bounds_of_cells = found
        return dict(self._bounds_of_cells)

    def described(self) -> dict[Hashable, xarray.Variable]:
        """What a list of places says of itself: columns of a table, names of stations."""
        if len(self.dims) != 1 or self._cells is not None:
            return {}
        own = {*map(str, self.coordinates), *map(str, self._found.bounds_names), "mask"}
        found = described(self._data, self._found.lon.dims[0], own)
        if self._table is not None:
            found |= columns_of(*self._table, self._found.lon.dims[0])
        return {name: self._along(item) for name, item in found.items()}

    def apart_from(self, data: Any, source: Places) -> Places:
        """The same, along another dimension if that of a list is one of the data, too, as a time of
        both; a warning says so.
        """
        others = {*data.dims} - {*source.dims}
        if len(self.dims) != 1 or self.dims[0] not in others:
            return self
        made, old, new = copy.copy(self), self.dims[0], "point"
        while new in others or new in self._data.dims:
            new += "_"
        warn_caller(
            f"the dimension {old!r} of the targets is {new!r} in the result, as the data have one "
            "of that name"
        )
        made._other_dim, made.dims = new, (new,)
        made.coordinates = {name: made._along(item) for name, item in self.coordinates.items()}
        return made

    def _along(self, item: xarray.Variable) -> xarray.Variable:
        """The variable along the dimension of these places."""
        if self._other_dim is None:
            return item
        names = {self._found.lon.dims[0]: self._other_dim}
        made = item.to_base_variable().copy(deep=False)
        made.dims = tuple(names.get(dim, dim) for dim in made.dims)
        return made

    def require_same(self, data: Any) -> None:
        """Refuses data that have coordinates of the same names with other values."""
        known = data.variables if isinstance(data, xarray.Dataset) else data.coords
        try:
            there = Coordinates(data, self._found.lon_name, self._found.lat_name).in_degrees()
        except ValueError:
            there = {}  # the data have one of them, or none
        for name, own in self._found.in_degrees().items():
            if name not in known or (own.dims, own.shape) != (known[name].dims, known[name].shape):
                continue
            other = there.get(name, known[name])
            away = half_turn(np.asarray(other.values, float) - np.asarray(own.values, float))
            if not np.all((np.abs(away) <= MAX_APART) | np.isnan(away)):
                raise ValueError(
                    f"the coordinate {name!r} of the data is not that of the source, or in another "
                    "order"
                )

    def lists_in(self, data: Any) -> set[str]:
        """The variable of the data with the numbers of their pixels, or none; refuses
        pixels, or a grid that the data name, at other places than these.
        """
        try:
            name, pixels = grid_of(data) or ("", None)
        except ValueError:
            name, pixels = "", None  # numbers that are none of pixels
        if pixels is None:
            self._require_named(data, name)
            return set()
        own, dim, numbers = pixels
        if (dim,) == self.dims and own != self._list:
            cells = CellSet.named(name) if numbers is None else CellSet._some(name, numbers)
            centers = cells._degrees()
            if len(centers) == self.lon.size and not self.are_at(centers):
                raise ValueError(
                    f"{own!r} of the data has the numbers of pixels that are at other places than "
                    "the source"
                )
        return {own}

    def _require_named(self, data: Any, name: str) -> None:
        """Refuses data without coordinates that name a grid of as many places as these, if they are
        others.
        """
        if name in ("", self._grid):
            return
        try:
            Coordinates(data, None, None)
        except ValueError:
            centers = CellSet.named(name)._degrees()
            if len(centers) == self.lon.size and not self.are_at(centers):
                raise ValueError(
                    f"the data name the grid {name}, whose places are others than the source's"
                ) from None

    def require_places_of(self, data: xarray.DataArray) -> None:
        """Refuses data whose own longitudes and latitudes are others, whatever their names are."""
        elsewhere = ""
        for lon, lat in pairs_of_values(data):
            try:
                found = Coordinates(data, lon, lat)
            except ValueError:
                continue  # no longitudes and latitudes
            south, west = _spread(found)
            if set(south.dims) != set(self.dims):
                continue
            south, west = south.transpose(*self.dims), west.transpose(*self.dims)
            if south.shape != self.shape or self._are_here(west.values, south.values):
                return
            elsewhere = elsewhere or f"{lon} and {lat}"
        if elsewhere:
            name = "the data" if data.name is None else repr(data.name)
            raise ValueError(
                f"{name} are at {elsewhere}, which are not the places of the source "
                f"({self._found.lon_name} and {self._found.lat_name})"
            )

    def are_at(self, pairs: FloatArray) -> bool:
        """Whether the places are those of a file, shape (n, 2) in degrees, NaN for none; true if
        the file has none.
        """
        if len(pairs) == 0:
            return True
        used = np.isfinite(pairs).all(axis=1)
        if self._used is not None:
            used &= self._used
        return bool(are_near(self.pairs(), pairs)[used].all())

    def along_cells(self, data: Any) -> tuple[Any, Places]:
        """The data and these places, or, if the places are the cells of a set, which the data
        have along one dimension of any name, both along that.
        """
        n = self.lon.size
        if self._cells is None or set(self.dims) <= set(data.dims):
            return data, self
        is_array = isinstance(data, xarray.DataArray)
        if is_array and len(self.shape) > 1 and data.shape[-len(self.shape) :] == self.shape:
            return data, self
        if not is_array and len(self.shape) == 2:
            data = self._with_own_dimensions(data)
            if set(self.dims) <= set(data.dims):
                return data, self
        names = list(data.sizes)
        lengths = list(data.sizes.values())
        found = [names[k] for k in _core.dimensions_of_cells(list(map(str, names)), lengths, n)]
        if len(found) > 1:
            raise ValueError(
                f"{' and '.join(map(repr, found))} are dimensions of {n:,}, as many as the source "
                "has cells: rename the one of the cells to 'cell'"
            )
        if not found:
            return data, self
        flat = self._cells._with(shape=(), centers=self.pairs())
        places = Places(flat)
        return with_dimensions(data, {found[0]: places.dims[0]}), places

    def _with_own_dimensions(self, data: xarray.Dataset) -> xarray.Dataset:
        """A Dataset with the names of these dimensions, if its own places are these."""
        try:
            found = Coordinates(data, None, None)
        except ValueError:
            return data
        south, west = _spread(found)
        if south.shape != self.shape:
            return data
        if not self._are_here(west.values, south.values):
            raise ValueError(
                f"the data are at {found.lon_name} and {found.lat_name}, which are not the places "
                "of the source"
            )
        return with_dimensions(data, dict(zip(south.dims, self.dims, strict=True)))

    def _are_here(self, lon: Any, lat: Any) -> bool:
        there = np.stack([lon, lat], axis=-1).reshape(-1, 2)
        return bool(are_near(there, self._pairs_with_gaps(None)).all())

    def are_away(self, data: xarray.Dataset, names: Iterable[str]) -> set[str]:
        """Those of the variables with the dimensions of the places that have others."""
        return are_away(data, names, self._found)

    @property
    def own_names(self) -> set[str]:
        """Variables that are coordinates or bounds, and so no fields."""
        lists = set() if self._list is None else {self._list}
        return {*map(str, self.coordinates), *self._found.bounds_names} | lists

    def index(self, dim: Hashable) -> Any:
        """The labels along a dimension, or None."""
        return self._data.indexes.get(dim)

    @property
    def have_places(self) -> BoolArray:
        """Which places have a longitude and a latitude, shape (n,)."""
        return np.ones(self.lon.size, bool) if self._located is None else self._located

    def points(self) -> FloatArray:
        """Unit vectors; anywhere for places without longitude or latitude."""
        return unit_vectors(*self.degrees())

    def degrees(self) -> tuple[FloatArray, FloatArray]:
        """Longitudes and latitudes; 0 for places that have none."""
        if self._located is None:
            return self.lon, self.lat
        located = self._located.reshape(self.shape)
        return np.where(located, self.lon, 0), np.where(located, self.lat, 0)

    def pairs(self) -> FloatArray:
        """Longitudes and latitudes, shape (n, 2), as `degrees`."""
        pairs = np.stack(self.degrees(), axis=-1).reshape(-1, 2)
        return np.ascontiguousarray(pairs, np.float64)

    @property
    def data(self) -> Any:
        """What was given, with its numbers unpacked."""
        return self._data

    @property
    def names(self) -> tuple[str, str]:
        """The names of the longitudes and the latitudes."""
        return self._found.lon_name, self._found.lat_name

    @property
    def named_cells(self) -> CellSet | None:
        """The cells whose centers the places are: those of a set, or of the grid that data name."""
        return self._cells if self._cells is not None else self._named_cells

    def located(self) -> tuple[FloatArray, Any]:
        """Longitudes and latitudes, shape (n, 2), of the places that have both, and the numbers of
        these, or None if all have.
        """
        if self._located is None:
            return self.pairs(), None
        numbers = np.flatnonzero(self._located)
        return np.ascontiguousarray(self.pairs()[numbers]), numbers

    @property
    def are_axes(self) -> bool:
        return self._found.are_axes

    @property
    def axes(self) -> tuple[FloatArray, FloatArray]:
        return self._found.lon.values, self._found.lat.values

    def mask(self) -> BoolArray | None:
        """Which take part: those with a place, or a cell with bounds, where no mask of a convention
        leaves it out and `mask` is neither 0 nor missing.
        """
        if self._cells is not None:
            return self._cells.mask
        return self._mask_with(self._used if self._cells_need_places else self._masked)

    def mask_with_places(self) -> BoolArray | None:
        """Those of `mask` that have a longitude and a latitude."""
        return self._cells.mask if self._cells is not None else self._mask_with(self._used)

    def _mask_with(self, used: BoolArray | None) -> BoolArray | None:
        mask = mask_of_variable(self._data, self.dims)
        if mask is None or used is None:
            return used if mask is None else mask
        return mask & used

    def side(self) -> _core.WeightSide:
        """What a file of weights says of the places."""
        return side_of(self.pairs(), shape=self.shape, mask=self.mask())

    def triangulated(
        self, mask: BoolArray | None = None, threads: int | None = None
    ) -> tuple[SphericalDelaunay, Any]:
        """The places that take part, and their numbers among all."""
        numbers = np.arange(self.lon.size) if mask is None else np.flatnonzero(mask)
        lon, lat = self.lon.reshape(-1)[numbers], self.lat.reshape(-1)[numbers]
        tri = delaunay_lonlat(lon, lat, threads=threads)
        self.coincident = numbers[tri.duplicates].reshape(-1, 2)
        return tri, numbers

    def num_repeated(self) -> int:
        """How many places are those of others before them, but for those at the poles of a grid,
        and the columns of axes that are repeated a turn later.
        """
        pairs = self.coincident
        lon, lat = self.lon.reshape(-1)[pairs], self.lat.reshape(-1)[pairs[:, 0]]
        is_usual = (np.abs(lat) == 90) & (lon[:, 0] != lon[:, 1])
        if self.are_axes:
            is_usual = (np.abs(lat) == 90) | (np.abs(lon[:, 0] - lon[:, 1]) > 180)
        return int(np.count_nonzero(~is_usual))

    def weights_to(self, target: Places, method: Any, **options: Any) -> Weights:
        """Weights of the places that take part; targets that are nowhere have no entries."""
        tri, numbers = self.triangulated(self._used, options.get("threads"))
        made = tri.weights(target.points(), method, **options)
        if self._used is None and target._located is None:
            return made
        if target._located is not None:
            made = made._with_rows(target._located)
        made = made._renumbered(None, numbers, (target.lon.size, self.lon.size))
        made._weights.know_places(point_set_hash(self.points()), point_set_hash(target.points()))
        return made

    @property
    def have_cells(self) -> bool:
        """Whether there are cells around the places: bounds, axes, or a set of cells."""
        have_bounds = self._found.have_bounds or self._corners == "made"
        is_known = any(
            cells is not None for cells in (self._cells, self._named_cells, self._mesh_cells)
        )
        return self.are_axes or is_known or have_bounds

    def cells(self, threads: int | None) -> CellSet:
        """The cells around the places, by their bounds or, of a grid, half way between them."""
        if self._cells is not None:
            return self._cells
        for remark in self._found.remarks:
            warn_caller(remark)
        lon, lat = self._found.bounds()
        mask = self.mask()
        known = self._mesh_cells if self._mesh_cells is not None else self._named_cells
        if known is not None and not self._found.have_bounds:
            return self._described(known, mask)
        if self.are_axes:
            names = self._found.lon_name, self._found.lat_name
            lines = [
                axis_lines(name, axis, bounds, is_longitude)
                for name, axis, bounds, is_longitude in zip(
                    names, self.axes, (lon, lat), (True, False), strict=True
                )
            ]
            made = CellSet.lonlat_grid(*lines, threads=threads)
            return self._described(made, mask)
        if (lon is None or lat is None) and self._corners == "made":
            lon, lat = self._made_nodes()
        if lon is None or lat is None:
            if self.are_sites:
                raise ValueError(
                    f"points have no cells, which conservative methods need; {METHODS_FOR_POINTS}"
                )
            way_out = "; corners='made' makes them from the centers"
            raise ValueError(
                "there are no corners of cells: name them lon_b and lat_b, or in the attribute "
                f"bounds of the coordinates{way_out if self._is_grid_of_rows else ''}"
            )
        if lon.shape[: len(self.shape)] != self.shape:
            lon, lat = _four(lon, lat, self.shape, self._pairs_with_gaps(None))
        centers = self._pairs_with_gaps(mask)
        made, mask, outside = _cells_of_corners(lon, lat, mask, centers, threads)
        self._require_inside(*outside)
        return self._described(made, mask)

    @property
    def _is_grid_of_rows(self) -> bool:
        """Whether there are two rows and two columns or more, between which corners can be made."""
        return len(self.shape) == 2 and min(self.shape) > 1

    def _made_nodes(self) -> tuple[FloatArray, FloatArray]:
        """The nodes between the centers of a grid of two dimensions, one row and column more."""
        if not self._is_grid_of_rows:
            raise ValueError(
                "corners of cells are made of grids with two rows and two columns or more, not of "
                f"shape {self.shape}"
            )
        warn_caller("there are no corners of cells; they are made half way between the centers")
        nodes = _core.nodes_between(self._pairs_with_gaps(None), *self.shape)
        rows, columns = self.shape[0] + 1, self.shape[1] + 1
        nodes = nodes.reshape(rows, columns, 2)
        return nodes[..., 0], nodes[..., 1]

    @property
    def are_corners_made(self) -> bool:
        """Whether the corners of cells are none that the data have, but made from the centers."""
        if self._cells is not None:
            return bool(self._cells._cells.facts.are_corners_made)
        has_cells = self._named_cells is not None or self._mesh_cells is not None
        has_cells = has_cells or self.are_axes or self._found.have_bounds
        return self._corners == "made" and not has_cells

    def _described(self, cells: CellSet, mask: BoolArray | None) -> CellSet:
        """The cells with these places as their centers, and which of them take part."""
        kept = np.zeros(0) if mask is None else mask.reshape(-1)
        facts = {"mask": kept.astype(np.int32), "are_corners_made": self.are_corners_made}
        centers = self.pairs()
        if self._located is not None and not self._cells_need_places:
            own = np.asarray(cells._degrees())
            centers = np.where(self._located[:, None], centers, own)
        return cells._with(centers=np.ascontiguousarray(centers), **facts)

    def _pairs_with_gaps(self, mask: BoolArray | None) -> FloatArray:
        """Longitudes and latitudes, shape (n, 2); NaN where there is none or no part is taken."""
        centers = np.stack([self.lon, self.lat], axis=-1).reshape(-1, 2).astype(np.float64)
        if mask is not None:
            centers[~mask] = np.nan
        return np.ascontiguousarray(centers)

    def _require_inside(self, number: int, of: int, first: int, are_most: bool) -> None:
        """Refuses cells most of which do not contain their centers: their corners are others'."""
        if number == 0:
            return
        text = (
            f"{number} of {of} cells with the corners {' and '.join(self._found.corner_names)} do "
            f"not contain their centers, the first one cell {first} with the center "
            f"{self.lon.flat[first]:g} {self.lat.flat[first]:g}"
        )
        if are_most:
            raise ValueError(f"{text}: corners and centers are of different places or orders")
        warn_caller(text)


def _paired(lon: Any, lat: Any) -> xarray.Dataset:
    """Longitudes and latitudes of points, broadcast against each other; of arrays with names of
    their dimensions by these. Two arrays of different lengths can only be axes of a grid.
    """
    if isinstance(lon, xarray.DataArray) and isinstance(lat, xarray.DataArray):
        return _marked({"lon": lon.variable, "lat": lat.variable})
    lons, lats = np.asarray(unmasked(lon)), np.asarray(unmasked(lat))
    try:
        lons, lats = np.broadcast_arrays(lons, lats)
    except ValueError:
        if lons.ndim == lats.ndim == 1:
            return _dataset({"lon": lons, "lat": lats}, are_points=False)
        raise ValueError(
            f"lon and lat have shapes {lons.shape} and {lats.shape}, but are pairs; grid=True "
            "takes them as the axes of a grid"
        ) from None
    lons, lats = np.atleast_1d(lons, lats)
    dims = {1: ("point",), 2: ("y", "x")}.get(lons.ndim)
    if dims is None:
        raise ValueError(f"lon and lat must have at most 2 dimensions, not shape {lons.shape}")
    return _marked({"lon": (dims, lons), "lat": (dims, lats)})


def _of_table(table: Any) -> tuple[xarray.Dataset, set[str]]:
    """The points of a GeoDataFrame, whatever columns it has, or of a DataFrame by its columns; and
    the names of the columns that have them.
    """
    if is_of_geopandas(table) and getattr(table, "_geometry_column_name", None) in table.columns:
        points = in_degrees(table.geometry)
        if not points.geom_type[points.notna()].eq("Point").all():  # a missing one is nowhere
            raise TypeError(
                "geometries that are places must be points; rondel.polygons() makes cells"
            )
        return _paired(points.x.to_numpy(), points.y.to_numpy()), {str(table.geometry.name)}
    found = {}
    taken = set()
    for kind, names in _COLUMNS.items():
        columns = [name for name in table.columns if str(name).lower() in names]
        if len(columns) > 1:
            texts = " and ".join(map(str, columns))
            raise ValueError(f"the columns {texts} may be the {kind}: leave one")
        found[kind] = table[columns[0]].to_numpy() if columns else None
        taken |= {*map(str, columns)}
    for kind, column in found.items():
        if column is None:
            raise ValueError(f"no column of the table has the {MARKS[kind][0]}s ({kind})")
    return _paired(found["lon"], found["lat"]), taken


def _cells_of_corners(
    lon: FloatArray,
    lat: FloatArray,
    mask: BoolArray | None,
    centers: FloatArray,
    threads: int | None,
) -> tuple[CellSet, BoolArray | None, tuple[int, int, int, bool]]:
    """Cells with a corner that is nowhere are left out, with a warning unless they are masked.
    Tells of centers that are outside, too.
    """
    missing = ~(np.isfinite(lon) & np.isfinite(lat))
    if lon.ndim == 2:  # Cells with fewer corners than others end with missing ones.
        lon, lat, missing = _filled_up(lon, lat, missing)
    lacking = missing.any(axis=-1).reshape(-1)
    if not lacking.any():
        made, outside = CellSet._around(lon, lat, centers, threads)
        return made, mask, outside
    untold = int(np.count_nonzero(lacking if mask is None else lacking & mask))
    if lacking.all():
        raise ValueError("no cell has corners: they are missing")
    if untold:
        warn_caller(
            f"{untold} of {lacking.size} cells have corners that are missing and are left out"
        )
    nowhere = lacking.reshape(lon.shape[:-1])[..., None]
    made, outside = CellSet._around(
        np.where(nowhere, 0, lon), np.where(nowhere, 0, lat), centers, threads
    )
    return made, ~lacking if mask is None else mask & ~lacking, outside


def _filled_up(lon: FloatArray, lat: FloatArray, missing: BoolArray) -> tuple[Any, Any, Any]:
    last = lon.shape[1] - 1 - np.argmin(missing[:, ::-1], axis=1)  # the last one that is there
    column = np.arange(lon.shape[1])
    ends = missing & (column > last[:, None]) & (last >= 2)[:, None]
    source = np.where(ends, last[:, None], column)
    rows = np.arange(len(lon))[:, None]
    return lon[rows, source], lat[rows, source], missing[rows, source]


def _centers(cells: CellSet) -> xarray.Dataset:
    """The places of the cells: those of the file or the axes, or else the centers of mass."""
    lons, lats = cells._cells.facts.axes
    if len(lons):
        return _marked({"lat": ("lat", np.array(lats)), "lon": ("lon", np.array(lons))})
    # In files, too: a cubed sphere has six tiles.
    dims = ("tile", "y", "x")[-len(cells.shape) :] if len(cells.shape) in (2, 3) else ("cell",)
    degrees = cells._degrees().reshape(*(cells.shape if len(dims) > 1 else (-1,)), 2)
    return _marked({"lon": (dims, degrees[..., 0]), "lat": (dims, degrees[..., 1])})


def _bounds_of(
    cells: CellSet, grid: str, dims: tuple[Hashable, ...], shape: tuple[int, ...]
) -> dict[Hashable, Any]:
    """The bounds of cells, if they are not those of a grid with a name, which says it all, and have
    not too many corners.
    """
    lines = cells._cells.lines()
    if _core.is_grid_name(grid):
        return {}
    if lines is not None:
        sides = {"lat": lines[1], "lon": lines[0]}
        return {
            f"{name}_bnds": xarray.Variable((name, "bnds"), np.stack([each[:-1], each[1:]], -1))
            for name, each in sides.items()
        }
    bounds = cells._cells.bounds()
    if bounds.size == 0:
        return {}
    bounds = bounds.reshape(*shape, -1, 2)
    return {
        f"{name}_bnds": xarray.Variable((*dims, "nv"), bounds[..., k])
        for k, name in ((1, "lat"), (0, "lon"))
    }


def _named(arrays: dict[Any, Any]) -> dict[Any, Any]:
    """The same with the names lon and lat for the longitudes and latitudes."""
    made = dict(arrays)
    for kind, names in _COLUMNS.items():
        found = [name for name in arrays if str(name).lower() in names]
        if len(found) != 1:
            texts = ", ".join(map(str, arrays)) or "nothing"
            raise ValueError(f"a dictionary of a grid has {kind}, in degrees; this one has {texts}")
        made[kind] = made.pop(found[0])
    return made


def _dataset(arrays: dict[Any, Any], are_points: bool) -> xarray.Dataset:
    """Longitudes and latitudes (and lon_b, lat_b, mask), as axes, of points, or curvilinear."""
    arrays = _named(arrays)
    rank = np.ndim(arrays["lon"])
    for kind in ("lat", "lon"):
        if rank not in (1, 2) or np.ndim(arrays[kind]) != rank:
            raise ValueError(f"{kind} of a grid must have shape (n,), not {np.shape(arrays[kind])}")
    dims: dict[str, tuple[str, ...]]
    if rank == 2:
        dims = {"lon": ("y", "x"), "lat": ("y", "x"), "mask": ("y", "x")}
    elif are_points:
        dims = {"lon": ("point",), "lat": ("point",), "mask": ("point",)}
    else:
        dims = {"lon": ("lon",), "lat": ("lat",), "mask": ("lat", "lon")}
    variables = {}
    shapes = {
        dim: length
        for kind in ("lat", "lon")
        for dim, length in zip(dims[kind], np.shape(arrays[kind]), strict=True)
    }
    wanted = tuple(shapes[dim] for dim in dims["mask"])
    if "mask" in arrays and np.shape(arrays["mask"]) != wanted:
        raise ValueError(f"mask must have shape {wanted}, not {np.shape(arrays['mask'])}")
    for name, values in arrays.items():
        # xarray makes NaN of what is masked.
        array = np.ma.asarray(values) if np.ma.is_masked(values) else np.asarray(values)
        own = tuple(f"{name}_{k}" for k in range(array.ndim))
        variables[name] = (dims.get(name, own), array)
    return _marked(variables)


def _marked(variables: dict[Any, Any]) -> xarray.Dataset:
    made = xarray.Dataset(variables)
    made = made.set_coords([name for name in ("lon", "lat") if name in made])
    for kind, (standard_name, units) in MARKS.items():
        made[kind].attrs.update(standard_name=standard_name, units=units)
    return made


def _four(
    lon: FloatArray, lat: FloatArray, shape: tuple[int, ...], centers: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The corners of each cell, from arrays of the corners of a curvilinear grid."""
    wanted = tuple(length + 1 for length in shape[-2:])
    for corners in (lon, lat):
        fits = corners.shape[:-2] == shape[:-2] and corners.shape[-2:] in (wanted, wanted[::-1])
        if len(shape) < 2 or not fits or lon.shape != lat.shape:
            raise ValueError(f"corners of cells of shape {shape} cannot have shape {corners.shape}")
    nodes = np.ascontiguousarray(np.stack([lon, lat], axis=-1).reshape(-1, 2))
    found = _core.corners_of_grid(nodes, lon.shape[-2:], centers, shape[-2:])
    corners = found.reshape(*shape, 4, 2)
    return corners[..., 0], corners[..., 1]
