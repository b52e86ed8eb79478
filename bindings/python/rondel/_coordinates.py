# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Coordinates and bounds of a Dataset, as the C++ library finds them."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
import xarray

from . import _core
from ._arrays import half_turn
from ._errors import InvalidInput
from ._types import FloatArray, IntArray

# What to do with dimensions along which places do not change: drop all, those called time, or none.
Repeats: TypeAlias = Literal["drop", "drop_times", "keep"]
NORTH_POLE = 90.0
SAME = 1e-3  # degrees, between axes and coordinates of two dimensions of the same places
MARKS = {"lon": ("longitude", "degrees_east"), "lat": ("latitude", "degrees_north")}


def _headers(data: Any) -> list[tuple[Any, ...]]:
    """The headers of the variables of a Dataset, or of a DataArray and its coordinates."""
    variables = dict(data.variables if isinstance(data, xarray.Dataset) else data.coords)
    if isinstance(data, xarray.DataArray):
        variables[_VALUES if data.name is None else data.name] = data
    headers = []
    for name, variable in variables.items():
        # xarray moves what it has understood of a file to `encoding`.
        texts = {**variable.encoding, **variable.attrs}
        # Integers with a _FillValue are decoded to floating-point numbers.
        stored = variable.encoding.get("dtype") or variable.dtype
        headers.append(
            (
                str(name),
                variable.dtype.kind in "iuf",
                [str(dim) for dim in variable.dims],
                list(variable.shape),
                [(str(key), text) for key, text in texts.items() if isinstance(text, str)],
                variable.dtype.kind in "iu" or getattr(stored, "kind", "") in "iu",
            )
        )
    return headers


def _require_greenwich(data: Any, headers: list[tuple[Any, ...]], lon: str) -> None:
    """Refuses longitudes that a grid mapping counts from another meridian than Greenwich."""
    known = data.variables if isinstance(data, xarray.Dataset) else data.coords.variables
    name = "longitude_of_prime_meridian"
    meridians = [
        (str(mapping), float(np.atleast_1d(item.attrs[name])[0]))
        for mapping, item in known.items()
        if np.atleast_1d(item.attrs.get(name, "")).dtype.kind in "iuf"
    ]
    if why := _core.remark_on_meridian(headers, lon, meridians) if meridians else "":
        raise ValueError(why)


_VALUES = "values of a DataArray"


class Coordinates:
    """Longitudes and latitudes of a Dataset or DataArray, by the rules of the C++ library."""

    def __init__(
        self,
        data: Any,
        lon: Hashable | None,
        lat: Hashable | None,
        repeats: Repeats = "drop",
    ) -> None:
        headers = _headers(data)
        attributes = [(str(key), text) for key, text in data.attrs.items() if isinstance(text, str)]
        if lon is None and lat is None and _core.is_planar(attributes):
            raise ValueError(
                "the mesh is in the plane: on_a_sphere is NO; lon=NAME and lat=NAME name true "
                "longitudes and latitudes, if there are any"
            )
        for kind, name in (("lon", lon), ("lat", lat)):
            if name is not None and str(name) not in [header[0] for header in headers]:
                raise ValueError(f"there is no variable {name!r} ({kind}=)")
        values = ""
        if isinstance(data, xarray.DataArray) and lon is None and lat is None:
            values = str(_VALUES if data.name is None else data.name)
        chosen = ("" if lon is None else str(lon), "" if lat is None else str(lat))
        pairs, remarks = _core.find_coordinates(headers, *chosen, values)
        names = [header[0] for header in headers]
        if not pairs:
            raise ValueError(_not_found(headers, lon, lat))
        for place, (kind, (standard_name, _)) in enumerate(MARKS.items()):
            found = list(dict.fromkeys(names[pair[0][place]] for pair in pairs))
            if len(found) > 1:
                texts = " and ".join(found)
                raise ValueError(f"{texts} may be the {standard_name}s: say {kind}=NAME")
        indices, units, self.are_axes, _ = pairs[0]
        self.lon_name, self.lat_name = names[indices[0]], names[indices[1]]
        _require_greenwich(data, headers, self.lon_name)
        self._data = data
        self._bounds = [None if k < 0 else names[k] for k in indices[2:]]
        self._units = units
        self.remarks = [text for text in remarks if self.lon_name in text or self.lat_name in text]
        self._repeated: list[str] = []  # dimensions in which the places come again
        self.lon = self._read(self.lon_name, units[0])
        self.lat = self._read(self.lat_name, units[1])
        if not self.are_axes and self.lon.ndim >= 2:
            self.lat = self.lat.transpose(*self.lon.dims)
            if repeats != "keep":
                self._drop_repeated(are_times=repeats == "drop_times")
        if lon is None and lat is None:
            self._take_axes_of_same_places()

    def _take_axes_of_same_places(self) -> None:
        """Takes axes along the dimensions of coordinates that have two and no bounds, if they are
        the same places: axes have cells.
        """
        if self.are_axes or self.have_bounds or self.lon.ndim != 2:
            return
        first, second = self.lon.dims
        for lon, lat in ((second, first), (first, second)):
            try:
                axes = Coordinates(self._data, lon, lat)
            except ValueError:
                continue
            if not axes.are_axes or (axes.lon.dims, axes.lat.dims) != ((lon,), (lat,)):
                continue
            own = [array.transpose(lat, lon).values for array in (self.lon, self.lat)]
            east = half_turn(np.asarray(own[0] - axes.lon.values[None, :], np.float64))
            if (np.abs(east) <= SAME).all() and np.allclose(
                own[1], axes.lat.values[:, None], rtol=0, atol=SAME
            ):
                self.__dict__.update(axes.__dict__)
                return

    def _read(self, name: str, unit: float) -> xarray.Variable:
        variable = self._data[name].variable
        is_lat = name == self.lat_name and variable.dtype.kind in "iuf"
        is_beyond = is_lat and bool((np.abs(variable.values * unit) > NORTH_POLE).any())
        if unit == 1 and not is_beyond:
            return variable
        degrees = np.array(variable.values, np.float64, order="C") * unit
        if is_beyond:
            _core.clamp_at_poles(degrees.reshape(-1))
        standard_name, units = MARKS["lat" if name == self.lat_name else "lon"]
        attrs = {**variable.attrs, "standard_name": standard_name, "units": units}
        return xarray.Variable(variable.dims, degrees, attrs)

    def in_degrees(self) -> dict[Hashable, xarray.Variable]:
        """The longitudes and latitudes with all dimensions that they have in the data, by name."""
        names = (self.lon_name, self.lat_name)
        return {name: self._read(name, self._units[k]) for k, name in enumerate(names)}

    def _drop_repeated(self, *, are_times: bool) -> None:
        """Takes the first along dimensions in which places do not change, as time of WRF."""
        flat = [
            np.ascontiguousarray(array.values, np.float64).reshape(-1)
            for array in (self.lon, self.lat)
        ]
        names = [str(dim) for dim in self.lon.dims]
        repeated = _core.repeated_dimensions(names, list(self.lon.shape), *flat)
        first = {
            dim: 0
            for dim, is_same in zip(self.lon.dims, repeated, strict=True)
            if is_same and (_core.is_name_of_time(str(dim)) or not are_times)
        }
        self._repeated = [str(dim) for dim in first]
        self.lon, self.lat = self.lon.isel(first), self.lat.isel(first)

    def is_same(self, other: Coordinates) -> bool:
        """Whether the other ones are of the same places, but for the rounding of float32."""
        for own, its, turn in ((self.lon, other.lon, 360), (self.lat, other.lat, np.inf)):
            if own.dims != its.dims or own.shape != its.shape:
                return False
            away = np.asarray(its.values, np.float64) - np.asarray(own.values, np.float64)
            if np.isfinite(turn):
                away -= turn * np.round(away / turn)
            is_single = own.dtype.itemsize < 8 or its.dtype.itemsize < 8
            if not np.all((np.abs(away) <= (1e-4 if is_single else 1e-9)) | np.isnan(away)):
                return False
        return True

    @property
    def bounds_names(self) -> set[str]:
        """Variables that are bounds of these coordinates, or that any attribute calls so."""
        named = {header[0]: dict(header[4]).get("bounds") for header in _headers(self._data)}
        return {name for name in (*self._bounds, *named.values()) if name is not None}

    @property
    def corner_names(self) -> list[str]:
        """The quoted names of the bounds."""
        return [repr(name) for name in self._bounds if name is not None]

    @property
    def have_bounds(self) -> bool:
        """Whether both have bounds."""
        return None not in self._bounds

    def bounds(self) -> list[FloatArray | None]:
        """Bounds of longitudes and of latitudes in degrees; the dimensions of places come first."""
        made: list[FloatArray | None] = []
        found = self.bounds_once()
        first_dims: tuple[Hashable, ...] | None = None  # those of the longitudes' bounds
        for name, unit, own in zip(
            self._bounds, self._units[2:], (self.lon, self.lat), strict=True
        ):
            if name is None:
                made.append(None)
                continue
            variable = found[name]
            if set(own.dims) <= set(variable.dims):
                dims = [dim for dim in variable.dims if dim not in own.dims]
                variable = variable.transpose(*own.dims, *dims)
            elif first_dims is not None and set(first_dims) == set(variable.dims):
                variable = variable.transpose(*first_dims)
            first_dims = variable.dims
            made.append(np.asarray(variable.values, np.float64) * unit)
        return made

    def bounds_once(self) -> dict[Hashable, xarray.Variable]:
        """The variables that are bounds, without dimensions in which all bounds only come again."""
        made: dict[Hashable, xarray.Variable] = {}
        places = (self.lon, self.lat)
        for name, unit, own in zip(self._bounds, self._units[2:], places, strict=True):
            if name is None:
                continue
            variable = self._data[name].variable
            values = np.asarray(variable.values, np.float64) * unit
            try:
                are_records = _core.record_dimensions(
                    [str(dim) for dim in variable.dims],
                    list(variable.shape),
                    [str(dim) for dim in own.dims],
                    list(own.shape),
                    self._repeated,
                    np.ascontiguousarray(values).reshape(-1),
                )
            except InvalidInput as error:
                raise InvalidInput(f"the bounds {name!r} {error}", error.index) from None
            dims = zip(variable.dims, are_records, strict=True)
            made[name] = variable.isel({dim: 0 for dim, is_record in dims if is_record})
        return made


class PixelList(NamedTuple):
    """The pixels of HEALPix that data are at: the variable with their numbers, its dimension, and
    the numbers, none if they are those of all pixels in order.
    """

    name: str
    dim: str
    numbers: IntArray | None


def grid_of(data: Any) -> tuple[str, PixelList | None] | None:
    """The name of the grid whose points a Dataset or DataArray says it has, as files that Rondel
    or tools for HEALPix wrote do (`CellSet.named`), and the list of pixels that they have.
    """
    lengths = [*data.sizes.values()]
    for owner, attributes in _mappings_in(data).items():
        name, shape = _core.grid_named_by(*attributes)
        if not name:
            continue
        pixels = _pixels_of(data, str(name), int(np.prod(shape)), owner)
        fits = np.prod(shape) in lengths or all(length in lengths for length in shape)
        if pixels is not None or fits:
            return str(name), pixels
    return None


def grid_in_words(data: Any) -> str:
    """The name of the grid that data say they are on, which they may have in part, or an empty
    text.
    """
    names = (_core.grid_named_by(*each)[0] for each in _mappings_in(data).values())
    return str(next(filter(None, names), ""))


def lack_of_pixels(data: Any) -> str:
    """Why data without longitudes and latitudes that say they are on pixels of HEALPix have none,
    or an empty text for other data.
    """
    for owner, attributes in _mappings_in(data).items():
        if lack := _core.lack_of_mapping(*attributes):
            return f"{owner!r} is the grid mapping of HEALPix, but has no {lack}"
    grid = grid_in_words(data)
    if not grid.startswith("healpix:"):
        return ""
    _, shape = _core.grid_named_by(*_core.grid_mapping(grid))
    return (
        f"the data are on {grid!r} with {shape[0]} pixels, but no dimension is as long, and no "
        "coordinate has the numbers of some of them, as one with the standard_name 'healpix_index'"
    )


def _mappings_in(data: Any) -> dict[str, tuple[list[tuple[str, str]], list[tuple[str, float]]]]:
    """The attributes of the data and of their variables, texts and numbers, by their names."""
    known = data.variables if isinstance(data, xarray.Dataset) else data.coords.variables
    owners = {"": data.attrs}
    owners |= {str(name): {**item.encoding, **item.attrs} for name, item in known.items()}
    found = {}
    for owner, attrs in owners.items():
        texts = [(str(key), text) for key, text in attrs.items() if isinstance(text, str)]
        numbers = [
            (str(key), float(number))
            for key, number in attrs.items()
            if isinstance(number, (int, float, np.number)) and not isinstance(number, bool)
        ]
        found[owner] = texts, numbers
    return found


def _pixels_of(data: Any, grid: str, num_pixels: int, mapping: str) -> PixelList | None:
    """The list of pixels that the data have, if a variable is one."""
    if not grid.startswith("healpix:"):
        return None
    headers = _headers(data)

    def numbers_of(index: int) -> FloatArray:
        name = headers[index][0]
        is_own = isinstance(data, xarray.DataArray) and name not in data.coords
        return np.ascontiguousarray((data if is_own else data[name]).values, np.float64)

    found = _core.numbered_pixels(headers, grid, num_pixels, mapping, numbers_of)
    if found is None:
        return None
    name, _, dims, *_ = headers[found[0]]
    return PixelList(name, dims[0], np.asarray(found[1], np.int32) if found[1] else None)


def mappings(data: Any) -> list[Hashable]:
    """The variables that are mappings of grids."""
    known = data.variables if isinstance(data, xarray.Dataset) else data.coords.variables
    return [name for name, item in known.items() if "grid_mapping_name" in item.attrs]


def names_in_mesh(data: Any) -> tuple[Hashable, Hashable] | None:
    """The longitudes and latitudes of the faces of the only UGRID mesh of a Dataset, or those of
    its nodes or edges if all fields that say their location are there; None without such a mesh.
    """
    if not isinstance(data, xarray.Dataset):
        return None
    meshes = [
        item.attrs
        for item in data.variables.values()
        if item.attrs.get("cf_role") == "mesh_topology"
    ]
    if len(meshes) != 1:
        return None
    told = {str(item.attrs.get("location")) for item in data.data_vars.values()}
    kinds = told & {"node", "edge", "face"}
    kind = kinds.pop() if len(kinds) == 1 else "face"
    names = str(meshes[0].get(f"{kind}_coordinates", "")).split()
    if len(names) != 2 or not all(name in data.variables for name in names):
        return None
    lon, lat = names
    return (lat, lon) if data[lon].attrs.get("standard_name") == "latitude" else (lon, lat)


def has_mesh(data: Any) -> bool:
    """Whether variables describe a mesh, as in files of UGRID, SCRIP, ESMF, MPAS, ICON, Exodus."""
    return bool(_core.has_mesh(_headers(data)))


def parts_of_grids(data: Any) -> set[str]:
    """The variables that describe a mesh or grid, as the numbers of neighbors: no fields."""
    headers = _headers(data)
    parts = _core.parts_of_grids(headers)
    return {header[0] for header, is_part in zip(headers, parts, strict=True) if is_part}


def measures_of_cells(data: Any) -> set[str]:
    """The variables with the areas or volumes of cells, of which means are no areas."""
    headers = _headers(data)
    measures = _core.are_measures_of_cells(headers)
    return {header[0] for header, is_measure in zip(headers, measures, strict=True) if is_measure}


def at_places(data: xarray.Dataset) -> set[str]:
    """The variables whose values depend on place, on the nodes of a mesh or an axis x as well."""
    headers = _headers(data)
    depends = _core.are_at_places(headers)
    return {header[0] for header, is_there in zip(headers, depends, strict=True) if is_there}


def describes_places(data: Any, names: list[str]) -> set[str]:
    """Those of the variables that are longitudes or latitudes of any places, their bounds, or parts
    of a grid.
    """
    bounds = {dict(header[4]).get("bounds", "") for header in _headers(data)}
    found = (parts_of_grids(data) | bounds) & {*names}
    for name, pairs in _pairs_of(data, names).items():
        if any(name in pair for pair in pairs):
            found.add(name)
    return found


def _pairs_of(data: Any, names: Iterable[str]) -> dict[str, list[tuple[str, str]]]:
    """The names of the longitudes and latitudes at which each of the variables may be."""
    headers = _headers(data)
    known = [header[0] for header in headers]
    positions = {name: k for k, name in enumerate(known)}
    wanted = {name: positions[name] for name in names}
    found = _core.coordinates_of(headers, list(wanted.values()))
    return {
        name: [(known[lon], known[lat]) for lon, lat in pairs]
        for name, pairs in zip(wanted, found, strict=True)
    }


def pairs_of_values(data: xarray.DataArray) -> list[tuple[str, str]]:
    """The names of the longitudes and latitudes at which values may be."""
    values = str(_VALUES if data.name is None else data.name)
    return _pairs_of(data, [values])[values]


def are_away(data: xarray.Dataset, names: Iterable[str], found: Coordinates) -> set[str]:
    """The variables that, by their dimensions and their attributes `coordinates`, are elsewhere."""
    # Variables at the same pairs get the same answer.
    known: dict[tuple[tuple[str, str], ...], bool] = {}
    away = set()
    for name, pairs in _pairs_of(data, names).items():
        if tuple(pairs) not in known:
            known[tuple(pairs)] = _all_are_away(data, pairs, found)
        if known[tuple(pairs)]:
            away.add(name)
    return away


def _all_are_away(data: xarray.Dataset, pairs: list[tuple[str, str]], found: Coordinates) -> bool:
    """Whether there are pairs, and none of them is the coordinates that were found."""
    if not pairs or (found.lon_name, found.lat_name) in pairs:
        return False
    for lon, lat in pairs:
        try:
            if found.is_same(Coordinates(data, lon, lat)):
                return False
        except ValueError:
            continue  # no longitudes and latitudes
    return True


def with_places(data: xarray.Dataset, names: Iterable[str]) -> set[str]:
    """Those of the variables of which the Dataset has longitudes and latitudes."""
    return {name for name, pairs in _pairs_of(data, names).items() if pairs}


def _not_found(headers: list[tuple[Any, ...]], lon: Hashable | None, lat: Hashable | None) -> str:
    if lon is not None and lat is not None:
        return f"{lon} and {lat} must have the same dimensions, or one dimension each"
    # Only one of the two was found: the message names it.
    for kind, other in (("lon", "lat"), ("lat", "lon")):
        standard_name, units = MARKS[kind]
        is_there = any(
            standard_name == dict(header[4]).get("standard_name", standard_name)
            and ("standard_name" in dict(header[4]) or units in dict(header[4]).get("units", ""))
            for header in headers
        )
        if not is_there and (lon if kind == "lon" else lat) is None:
            names = ", ".join(header[0] for header in headers if header[1] and header[3])
            asked = f"say {kind}=NAME and {other}=NAME, of {names}"
            return f"no coordinate has the {standard_name}s: {asked}"
    return (
        "no longitudes and latitudes have the same dimensions, or one dimension each: "
        "say lon=NAME and lat=NAME"
    )


def with_dimensions(data: Any, names: dict[Hashable, Hashable]) -> Any:
    """The Dataset or DataArray with other names of dimensions, while coordinates keep theirs; those
    along several dimensions that have the new name of one are left out.
    """
    kept = set(data.dims) - set(names)
    for new in names.values():
        if new in kept:
            raise ValueError(
                f"the data have a dimension {new!r} that is not the source's: rename it"
            )

    def renamed(variable: Any) -> Any:
        made = variable.to_base_variable()
        made.dims = tuple(names.get(dim, dim) for dim in made.dims)
        return made

    known = (data.coords if isinstance(data, xarray.DataArray) else data).variables
    variables = {name: renamed(item) for name, item in known.items()}
    taken = {
        name: item
        for name, item in variables.items()
        if name not in names.values() or item.dims == (name,)
    }
    if isinstance(data, xarray.DataArray):
        return xarray.DataArray(renamed(data.variable), coords=taken, name=data.name)
    made = xarray.Dataset(taken, attrs=data.attrs)
    return made.set_coords([name for name in data.coords if name in made])
