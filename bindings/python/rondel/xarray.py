# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""``ds.rondel``: interpolation of what `xarray` holds.

``import rondel.xarray`` gives every Dataset and DataArray the accessor `rondel`. Longitudes and
latitudes are found by their attributes (CF conventions: `standard_name` or `units`), then by their
names, as the tool finds them in files; of cells, curvilinear or as the two axes of a grid.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import TYPE_CHECKING, Any

import xarray

from ._arrays import point_set_hash
from ._carried import carried
from ._errors import warn_caller
from ._interpolation import Method
from ._places import Places
from ._plot_field import plot_field
from ._regrid import regrid
from ._regrid_files import FieldMethod
from ._weights import Weights, require_share

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["RondelAccessor"]


_OF_CALLS = {"threads", "progress"}  # options that change no result


def __dir__() -> list[str]:
    return list(__all__)


class RondelAccessor:
    """The accessor ``ds.rondel`` of a Dataset and ``da.rondel`` of a DataArray."""

    def __init__(self, data: Any) -> None:
        self._data = data

    def weights(
        self,
        target: Any,
        method: Method = "sibson",
        *,
        grid: bool = False,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        **options: Any,
    ) -> Weights:
        """Computes the weights that `interpolate` applies, for use in several calls.

        Parameters
        ----------
        target, method, grid, lon, lat, **options
            As in `interpolate`.

        Returns
        -------
        Weights
            The argument `weights` of `interpolate`.

        """
        target = _target(target, grid=grid)
        return _weights_between(Places(self._data, lon, lat), target, method, options)

    def interpolate(
        self,
        target: Any,
        method: Method | None = None,
        *,
        grid: bool = False,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        weights: Weights | None = None,
        skipna: bool = False,
        max_missing: float = 1.0,
        **options: Any,
    ) -> Any:
        """Interpolates values at other places.

        Attributes and other dimensions, such as time, are kept; the attributes that hold at the
        source alone, such as `valid_range`, are not, nor `flag_values` where means are made.

        Parameters
        ----------
        target : Dataset, DataArray, DataFrame or tuple of array_like
            What has the longitudes and latitudes of the result: of points, of a curvilinear grid,
            or as axes; or a tuple (lon, lat) in degrees, whose arrays are pairs, broadcast against
            each other as in `rondel.interpolate`. Two of different lengths are no pairs, but axes:
            a grid whose axes may have equal lengths needs `grid`.
        method : str, optional
            As in `SphericalDelaunay.weights`, by default 'sibson'.
        grid : bool, optional
            Whether the two arrays of a tuple are the axes of a grid, which has a value for each
            longitude with each latitude.
        lon, lat : str, optional
            The names of the longitudes and latitudes of the source, if they are not found.
        weights : Weights, optional
            Those of a former call of `weights`, with the same source and target places. Method and
            options are then theirs; others are without effect, which a warning tells.
        skipna : bool, optional
            Whether to leave out missing values, as in `Weights.apply`; by default False.
        max_missing : float, optional
            With `skipna`, the largest share of weights for which values may be missing, as in
            `Weights.apply`; by default 1.
        **options
            The options of `SphericalDelaunay.weights`.

        Returns
        -------
        Dataset or DataArray
            As the source: numbers are interpolated, in their type if it is a floating one, and
            booleans as 0 and 1; what does not depend on place stays; other variables of the
            places, such as texts, those whose attribute `coordinates` names other places, and
            coordinates of the places, such as areas, are left out with a warning that names them.
            What describes a mesh, as the numbers of neighbors, is left out. Arrays of Dask stay
            lazy.

        Warns
        -----
        UserWarning
            If variables are left out, or places are given several times and `duplicates` is not,
            as after times were stacked: only the first value counts at each of them.

        Raises
        ------
        ValueError
            If longitudes or latitudes are not found, or are those of a rotated pole, a projection
            or a mesh in the plane (``on_a_sphere = NO``), the weights are of other places, or
            data and target share a dimension, such as the time of a track: rename the target's.
        InvalidInput
            If a value is infinite, with its index in the source; arrays of Dask raise it when they
            are computed.

        """
        require_share(max_missing, "max_missing", skipna)
        source, wanted = Places(self._data, lon, lat), _target(target, grid=grid)
        if weights is None:
            weights = _weights_between(source, wanted, method or "sibson", options)
        elif not isinstance(weights, Weights):
            raise TypeError(
                f"weights must be Weights, not {type(weights).__name__}; rondel.read_weights() "
                "reads those of a file"
            )
        elif not _fits(weights, source, wanted):
            raise ValueError("the weights are of other places")
        else:
            idle = sorted({*options, *(() if method is None else ("method",))} - _OF_CALLS)
            if idle:
                warn_caller(f"weights are given, so these change nothing: {', '.join(idle)}")
        return carried(
            self._data,
            weights,
            source,
            wanted,
            skipna=skipna,
            max_missing=max_missing,
            are_chosen=weights._choose_values(),
        )

    def regrid(self, target: Any, method: FieldMethod | None = None, **options: Any) -> Any:
        """Brings the data to another grid.

        Parameters
        ----------
        target, method, **options
            As in `rondel.regrid`.

        Returns
        -------
        Dataset or DataArray
            The fields at the target.

        """
        return regrid(self._data, target, method, **options)

    def plot(
        self,
        name: Hashable | None = None,
        ax: Any = None,
        *,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        label: str | None = None,
        **options: Any,
    ) -> Axes:
        """Draws a field on its cells, as colors on a map.

        Cells are those of the grid or mesh: by the bounds of the coordinates, half way between
        longitudes and latitudes along axes, or those of a named grid such as HEALPix. Places
        without cells, such as stations, have their Voronoi cells; those without a longitude or
        latitude are left out. A warning says so where attributes name cells that are not there,
        as in a DataArray without the grid mapping of its Dataset.

        Parameters
        ----------
        name : str, optional
            The variable of a Dataset; a DataArray needs none.
        ax : matplotlib.axes.Axes, optional
            By default new axes: of Cartopy where it is installed, otherwise longitude and latitude.
        lon, lat : str, optional
            The names of the longitudes and latitudes, if they are not found.
        label : str, optional
            The words beside the color bar; by default the attributes `long_name` and `units`.
        **options
            Those of `CellSet.plot`, such as `projection`, `coast`, `cmap`, `vmin`, `vmax`, `norm`
            and `colorbar`.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.
        ValueError
            If the field has several times or levels, of which one has to be chosen.

        """
        return plot_field(self._data, name, ax, lon, lat, label, options)


_REGISTERS: tuple[Any, ...] = (
    xarray.register_dataset_accessor,
    xarray.register_dataarray_accessor,
)
for _register in _REGISTERS:
    _register("rondel")(RondelAccessor)


def _target(target: Any, *, grid: bool) -> Places:
    return Places(target, are_pairs=not grid, are_targets=True)


def _weights_between(
    source: Places, wanted: Places, method: Method, options: dict[str, Any]
) -> Weights:
    """The weights; a warning tells of places that are given several times, unless `duplicates` says
    what to do with them.
    """
    made = source.weights_to(wanted, method, **options)
    number = source.num_repeated()
    if number and "duplicates" not in options:
        warn_caller(
            f"{number} of {source.lon.size} places are those of others before them; at each place "
            "the first value counts (duplicates='first'; 'mean' takes the mean)"
        )
    return made


def _fits(weights: Weights, source: Places, wanted: Places) -> bool:
    """Whether they have the shape and, where these are known, the hashes, or else the places that
    their file has.
    """
    if weights.shape != (wanted.lon.size, source.lon.size):
        return False
    hashes = weights.sites_hash, weights.targets_hash
    for places, known, pairs in zip((source, wanted), hashes, weights._places, strict=True):
        if known:
            if point_set_hash(places.points()) != known:
                return False
        elif not places.are_at(pairs):
            return False
    return True
