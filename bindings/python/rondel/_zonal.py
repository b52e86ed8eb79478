# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Statistics of fields in polygons and other zones, as a table."""

from __future__ import annotations

import math
import os
from collections.abc import Hashable, Iterable
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core
from ._arrays import as_fields, as_threads
from ._cell_set import CellSet
from ._cells import polygons
from ._geometries import Corners, Edges, Invalid
from ._pickled import with_arrays
from ._regrid import without_mask
from ._remap import CellOverlap
from ._types import Progress
from ._weights import require_share

if TYPE_CHECKING:
    import pandas


def zonal_statistics(
    data: Any,
    zones: Any,
    statistics: str | Iterable[str] = "mean",
    *,
    weights: Literal["area", "fraction"] = "area",
    include_cols: str | Iterable[str] = (),
    max_missing: float = 1.0,
    lon: Hashable | None = None,
    lat: Hashable | None = None,
    corners: Corners = "error",
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    overlap: CellOverlap = "each",
    threads: int | None = None,
    progress: Progress = None,
) -> pandas.DataFrame:
    """Computes statistics of fields in polygons, or in any other cells.

    Which part of which cell a polygon has is exact, on the sphere. It needs xarray and pandas.

    Parameters
    ----------
    data : Dataset or DataArray
        Fields with their longitudes and latitudes, and any other dimensions such as time. Cells are
        those of the coordinates' bounds or of the mesh that a Dataset has or, along axes, half way
        between the centers, as for `Regridder`. A variable `mask` is a field as others and masks
        nothing, as in `regrid`; a warning says so.
    zones : GeoDataFrame, GeoSeries, sequence, mapping, path-like, str or CellSet
        The polygons, as `rondel.polygons` takes them; the name of a grid; or cells.
    statistics : str or iterable of str, optional
        'mean' (default), 'sum', 'count', 'min', 'max', 'fraction', 'variance', 'stdev', 'median',
        'quantile:Q' with Q from 0 to 1, 'majority', 'minority' or 'variety'; several as an
        iterable, or with commas between them.
    weights : {'area', 'fraction'}, optional
        The weight of a cell's value: the area that the cell has in common with the zone (default),
        or the share of the cell that is in the zone, whatever the size of the cell.
    include_cols : str or iterable of str, optional
        Columns of a GeoDataFrame that the table gets; by default none.
    max_missing : float, optional
        The share of a zone that no cell may cover, and of the covered part that values may be
        missing in, from 0 to 1. By default 1: any value is enough.
    lon, lat : str, optional
        The names of the longitudes and latitudes of `data`, if they are not found.
    corners : {'error', 'made'}, optional
        What to do where longitudes and latitudes of two dimensions have no bounds, as those of WRF,
        ROMS and swaths: 'error' (default), or 'made', which makes corners half way between the
        centers, extrapolated at the border, and warns of it.
    edges, invalid
        How polygons are read, as in `CellSet.read`.
    overlap : {'each', 'error', 'first', 'share'}, optional
        What becomes of a place in several zones. By default each of them has it.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    pandas.DataFrame
        A row for each zone and, within it, for each time, level and so on; the index has the index
        of a GeoDataFrame or GeoSeries, or else the numbers of the zones, and the names of the other
        dimensions. Columns are the statistics ('mean', 'quantile_0.1') of an array, and with the
        name of the variable ('tas_mean') those of a Dataset.

    Raises
    ------
    ValueError
        If there is no such statistic, coordinates are not found, no variable of a Dataset is a
        field, a polygon is not valid, or `include_cols` names a column that the zones do not have,
        one twice, or one with the name of a statistic's column; `InvalidInput` if cells of the data
        overlap, or zones where `overlap` is 'error'.
    TypeError
        If an array has no numbers, or `include_cols` is given for zones without columns.

    Notes
    -----
    With v the values, w their weights and f the shares of cells: mean and variance are weighted by
    w; sum is that of f v, and count that of f; fraction is the share of the zone's area with
    values; majority and minority are the values of the greatest and least weight, the least of
    several; quantiles are weighted, and with equal weights NumPy's. A zone without values has NaN,
    and a count, fraction and variety of 0. Cells that have less than a thousandth in common with a
    zone, both of the cell and of the zone, count in sums, but not in min, max, variety, majority,
    minority and quantiles.

    Examples
    --------
    >>> import rondel
    >>> import xarray  # doctest: +SKIP
    >>> data = xarray.DataArray(  # doctest: +SKIP
    ...     [[1.0, 2.0], [3.0, 4.0]], {"lat": [0.5, 1.5], "lon": [0.5, 1.5]}, ("lat", "lon")
    ... )
    >>> box = {"type": "Polygon", "coordinates": [[[0, 0], [1.5, 0], [1.5, 1], [0, 1], [0, 0]]]}
    >>> rondel.zonal_statistics(data, box, "max,count").round(9)  # doctest: +SKIP
          max  count
    zone
    0     2.0    1.5

    """
    import xarray

    from ._carried import carried
    from ._places import Places
    from ._values import unpacked

    listed = statistics if isinstance(statistics, str) else ",".join(statistics)
    names = _core.names_of_statistics(listed)
    require_share(max_missing, "max_missing", skipna=True)
    if corners not in ("error", "made"):
        raise ValueError(f"corners must be 'error' or 'made', not {corners!r}")
    source = Places(
        without_mask(data, "data"), lon, lat, are_cells=True, corners=corners, threads=threads
    )
    if isinstance(zones, str) and _core.is_grid_name(zones):
        zones = CellSet.named(zones, threads=threads)
    is_set = isinstance(zones, CellSet)
    cells = zones if is_set else polygons(zones, edges=edges, invalid=invalid, threads=threads)
    data, source = source.along_cells(data)
    data = _in_doubles(unpacked(data))
    nothing = np.zeros(0, np.int32)
    made = _core.remap(
        source.cells(threads)._cells,
        cells._cells,
        order=1,
        norm="destarea",
        source_mask=nothing,
        target_mask=nothing,
        overlap=overlap,
        threads=as_threads(threads),
        progress=progress,
    )
    rules = listed, weights, max_missing, as_threads(threads)
    found = carried(
        data,
        _OfZones(made, (cells.num_cells, len(names)), source.shape, rules),  # type: ignore[arg-type]
        source,
        _Zones(cells.num_cells, names),  # type: ignore[arg-type]
        skipna=True,
        max_missing=1.0,
        output_chunks=-1 if _is_lazy(data) else None,  # all zones are one block
    )
    index = getattr(zones, "index", None) if hasattr(zones, "geometry") else None
    if isinstance(found, xarray.DataArray):
        table = _table({"": found}, index, cells.num_cells, names)
    else:
        fields = {f"{name}_": array for name, array in found.items() if _ZONE in array.dims}
        if not fields:
            raise ValueError("no variable of the data is a field of numbers at their places")
        table = _table(fields, index, cells.num_cells, names)
    return _with_columns(table, zones, include_cols, cells.num_cells)


def _in_doubles(data: Any) -> Any:
    """The same with real numbers in double precision, which statistics are returned in."""
    import xarray

    if isinstance(data, xarray.DataArray):
        return data.astype("float64") if data.dtype.kind == "f" else data
    reals = {name: array for name, array in data.data_vars.items() if array.dtype.kind == "f"}
    return data.assign({name: array.astype("float64") for name, array in reals.items()})


def _is_lazy(data: Any) -> bool:
    import xarray

    arrays = data.data_vars.values() if isinstance(data, xarray.Dataset) else [data]
    return any(array.chunks is not None for array in arrays)


_ZONE, _STATISTIC = "rondel_zone", "rondel_statistic"
# What statistics need to know of the areas that zones and cells have in common.
_OF_PIECES = ("offsets", "columns", "areas", "source_areas", "target_areas")


class _Zones:
    """What `carried` asks of the places to which fields are brought."""

    def __init__(self, number: int, names: list[str]) -> None:
        self.dims = (_ZONE, _STATISTIC)
        self.shape = (number, len(names))
        self.coordinates: dict[str, Any] = {}
        self.are_corners_made = False
        self.mapping: tuple[dict[str, Any], dict[str, Any]] = ({}, {})

    def bounds(self) -> dict[Hashable, Any]:
        """There are no bounds."""
        return {}

    def index(self, dim: Hashable) -> None:
        """There are no labels."""


class _OfZones:
    """What `carried` asks of weights: all statistics of each zone, one after the other."""

    def __init__(
        self, made: _core.Remap, shape: tuple[int, int], source_shape: tuple[int, ...], rules: Any
    ) -> None:
        self._made, self._rules = made, rules
        self._zones, self._statistics = shape
        self.shape = (math.prod(shape), math.prod(source_shape))
        self.indptr = np.arange(self._zones + 1)

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_made": {name: getattr(self._made, name) for name in _OF_PIECES}}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update({**state, "_made": with_arrays(_core.Remap(), state["_made"])})

    def apply(self, fields: Any, **_: Any) -> Any:
        """The statistics of fields, shape (..., cells), as (..., zones * statistics)."""
        leading = fields.shape[:-1]
        values = as_fields(np.reshape(fields, (-1, fields.shape[-1])), fields.shape[-1])
        listed, weights, max_missing, threads = self._rules
        found = _core.zonal_statistics(self._made, listed, values, weights, max_missing, threads)
        found = found.reshape(self._statistics, len(values), self._zones)
        return np.moveaxis(found, 0, -1).reshape(*leading, self._zones * self._statistics)


def _table(fields: dict[str, Any], index: Any, zones: int, names: list[str]) -> Any:
    """The statistics of arrays as columns: a row for each zone and place on the other axes."""
    import pandas
    import xarray

    arrays = xarray.broadcast(*fields.values())
    others = [dim for dim in arrays[0].dims if dim not in (_ZONE, _STATISTIC)]
    columns: dict[str, Any] = {}
    for prefix, array in zip(fields, arrays, strict=True):
        values = array.transpose(_ZONE, *others, _STATISTIC).values.reshape(-1, len(names))
        columns |= {f"{prefix}{name}": values[:, k] for k, name in enumerate(names)}
    if index is None:
        index = pandas.RangeIndex(zones)
    levels = [index.get_level_values(k) for k in range(index.nlevels)]
    titles = ["zone" if level.name is None else level.name for level in levels]
    inner = pandas.MultiIndex.from_product(
        [arrays[0].get_index(dim) for dim in others] or [[0]], names=others or [None]
    )
    repeated = [level.repeat(len(inner)) for level in levels]
    for k, dim in enumerate(others):
        level = inner.get_level_values(k)
        repeated.append(level[np.tile(np.arange(len(inner)), zones)])
        titles.append(str(dim))
    if len(repeated) == 1:
        return pandas.DataFrame(columns, repeated[0].rename(titles[0]))
    return pandas.DataFrame(columns, pandas.MultiIndex.from_arrays(repeated, names=titles))


def _with_columns(table: Any, zones: Any, names: str | Iterable[str], number: int) -> Any:
    """The table with columns of the zones in front."""
    wanted = [names] if isinstance(names, str) else list(names)
    if not wanted:
        return table
    if not hasattr(zones, "columns"):
        kind = "a file" if isinstance(zones, (str, os.PathLike)) else type(zones).__name__
        raise TypeError(f"include_cols needs a GeoDataFrame of zones, not {kind}")
    for k, name in enumerate(wanted):
        if name not in zones.columns:
            known = ", ".join(map(repr, zones.columns))
            raise ValueError(f"include_cols: the zones have no column {name!r}, but {known}")
        if name in wanted[:k]:
            raise ValueError(f"include_cols has the column {name!r} twice")
        if name in table.columns:
            raise ValueError(f"include_cols: {name!r} is the name of a statistic's column, too")
    rows = np.repeat(np.arange(number), len(table) // max(number, 1))
    for k, name in enumerate(wanted):
        table.insert(k, name, zones[name].take(rows).to_numpy())
    return table
