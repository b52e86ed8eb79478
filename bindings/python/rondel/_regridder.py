# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regridding of model fields with the interface of xESMF."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from . import _core
from ._amounts import OverCells, WeightsOfSums, weights_of_sums
from ._arrays import as_floats, as_threads, point_set_hash
from ._blocks import AnyWeights, OutputChunks
from ._cell_set import CellSet
from ._errors import warn_caller
from ._geo import Path
from ._geometries import Corners, Invalid, require_rules
from ._native import Extrapolation, GapFiller, esmf_name, limits_of_xesmf
from ._remap import CellOverlap, Remap, SlopeLimiter, remapped
from ._repr import Described, count
from ._reuse import reused, said_method
from ._second_order import SecondOrderWeights
from ._types import BoolArray, FloatArray, Progress
from ._weight_files import netcdf_name
from ._weights import Weights, require_share
from ._zarr_weights import ENTRIES, write_between_places

if TYPE_CHECKING:
    from ._places import Places

RegridMethod: TypeAlias = Literal[
    "bilinear",
    "conservative",
    "conservative_normed",
    "conservative_2nd",
    "conservative_2nd_normed",
    "nearest_s2d",
    "nearest_d2s",
    "linear",
    "laplace",
    "sibson",
    "hermite",
    "cubic",
    "native",
]
_CONSERVATIVE: dict[str, tuple[int, Literal["destarea", "fracarea"]]] = {
    "conservative": (1, "destarea"),
    "conservative_normed": (1, "fracarea"),
    "conservative_2nd": (2, "destarea"),
    "conservative_2nd_normed": (2, "fracarea"),
}
_INTERPOLATING = ("linear", "laplace", "sibson", "hermite", "cubic")
_METHODS = ("bilinear", *_CONSERVATIVE, "nearest_s2d", "nearest_d2s", *_INTERPOLATING, "native")
_NEEDLESS = ("periodic", "ignore_degenerate", "parallel")


class Regridder(Described):
    """Regrids fields from one grid to another; it replaces `xesmf.Regridder`.

    It needs xarray. A grid is a Dataset as xESMF or the CF conventions have it, a dictionary of
    arrays, a tuple (lon, lat) of axes, or a `CellSet`, which any mesh can be converted to.

    Parameters
    ----------
    ds_in, ds_out : Dataset, DataArray, dict, tuple, CellSet or str
        The source and the target grid; a text is the name of one (`CellSet.named`). Longitudes and
        latitudes are found by their attributes or names (docs/guide/formats.md); they are axes of a
        grid, curvilinear coordinates, or those of points, in degrees, or in radians if the
        attribute `units` says so. Conservative methods take the cells from the coordinates'
        attribute `bounds`, or from `lon_b` and `lat_b`, or else those of the mesh that a Dataset
        has by UGRID, SCRIP, ESMF, MPAS, ICON or Exodus, as files have them; cells of axes without
        these end half way between their centers. A variable `mask`, also among the coordinates of a
        DataArray, is 0 or missing where places take no part. The masks of SCRIP (`grid_imask`) and
        OASIS are heeded, too. Masked elements of NumPy arrays count as NaN. Places without
        longitude or latitude, and cells with a missing corner, are left out with a warning that
        counts them; with conservative methods cells that have bounds need no longitude and latitude
        of their own.
    method : str
        'bilinear', 'conservative', 'conservative_normed', 'conservative_2nd', 'nearest_s2d' or
        'nearest_d2s' as in ESMF; 'conservative_2nd_normed', whose weights are divided by the
        covered part of a target, as those of 'conservative_normed' are (`rondel.regrid` calls
        these two 'conservative_2nd' and 'conservative'); or 'linear', 'laplace', 'sibson',
        'hermite' or 'cubic' as in `SphericalDelaunay.weights`. Unless the source has axes,
        'bilinear' means 'linear'. With 'native' values are interpolated in the cells of the
        mesh of `ds_in` (`native_weights`): a Dataset with a mesh of UGRID, MPAS, ICON, ESMF or
        Exodus, whose nodes or faces `lon` and
        `lat` are, or a `CellSet`, with values at its cells.
    locstream_in, locstream_out : bool, optional
        Whether a dictionary or tuple has the coordinates of points instead of axes; by default
        False.
    lon, lat, lon_out, lat_out : str, optional
        The names of the longitudes and latitudes of `ds_in` and of `ds_out`, if they are not found
        or there are several.
    extrap_method : {None, 'nearest_s2d', 'inverse_dist', 'creep_fill'}, optional
        The value of targets to which no source contributes: none (default); that of the nearest
        source that takes part; the mean of several by inverse distance; or the mean of the
        neighboring targets with weights, level by level. 'nearest', 'idw' and 'creep' are the same.
        Weights know masks only: `regrid` and `regrid_file` fill each field by its own gaps.
    extrap_dist_exponent, extrap_num_src_pnts : int, optional
        With 'inverse_dist' the power of the distance (2), from 1 to 100, and the number of sources
        (8). As in xESMF, None is the default, and a whole number may be a float.
    extrap_num_levels : int, optional
        With 'creep_fill' the number of levels; 0 (default): all that can be filled.
    extrap_distance : float, optional
        How far sources may be from a target that is extrapolated, in kilometers; by default any.
    corners : {'error', 'made'}, optional
        With conservative methods, what to do where longitudes and latitudes of two dimensions have
        no bounds: 'error' (default), or 'made', which makes corners half way between the centers,
        extrapolated at the border, and warns of it.
    max_uncovered : float, optional
        With conservative methods, the share of a target that may lie outside of the source, from 0
        to 1; targets with less in it are unmapped. By default 1, as in xESMF. It is refused beside
        weights that are given (`weights`, `reuse_weights`).
    unmapped_to_nan : bool, optional
        Whether targets to which no source contributes are NaN (default True) or 0. As in xESMF, a
        target that needs a missing value is NaN in any case, and so are all targets without a value
        where a mask leaves out some; unlike there, 0 stays 0 with `skipna`, too.
    weights : path-like or Weights, optional
        Those of `to_netcdf` of a former one, with the same grids, masks, method and
        `extrap_method`; others are refused where the file or the entries say so: the places of both
        sides, and with conservative methods the corners of the cells, may be 1e-4 degrees off.
        Those without extrapolation get the one that is wanted.
    overlap : {'error', 'first', 'share', 'each'}, optional
        What conservative methods do if cells of one grid overlap; as in `remap`, by default
        'error'. Like `invalid` it is refused beside weights that are given.
    invalid : {'error', 'repair'}, optional
        What conservative methods do if a cell crosses or overlaps itself: 'error' (default) raises
        `InvalidInput`, 'repair' replaces it as `CellSet.repaired` does.
    limiter : {'none', 'slopes'}, optional
        With 'slopes' the gradients of 'conservative_2nd' and 'conservative_2nd_normed' are limited
        in each field: no value is beyond those of the sources of a target and of the sources around
        them, and each source keeps its integral (monotone slopes: Barth and Jespersen 1989). Values
        are then no weighted sums, so `weights` are those without a limiter; it is refused beside
        weights that are given, and beside 'creep_fill'. 'bounds' of `regrid_file` needs all targets
        at a time, and is not one of these.
    filename : path-like, optional
        The file that `to_netcdf` writes and `reuse_weights` reads, as in xESMF.
    reuse_weights : bool, optional
        Whether to read the weights from `filename` (or `weights`), as in xESMF; by default False.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.
    **needless
        `periodic`, `ignore_degenerate` and `parallel` are accepted and have no effect.

    Attributes
    ----------
    weights : Weights
        The sparse matrix that is applied.
    method : str
        The method.
    filename : path-like or None
        The argument `filename`.
    shape_in, shape_out : tuple of int
        The shapes of the source and the target grid.

    Raises
    ------
    ValueError
        If there is no such method, coordinates are not found, or weights do not belong to the
        grids; `InvalidInput` if cells are invalid or overlap.
    OSError
        If a file of weights cannot be read.

    Notes
    -----
    These differences from xESMF are deliberate: the sphere is always periodic and always has its
    poles; cells of axes end at meridians and parallels, where those of ESMF end at great circles;
    missing values never count as zeros, and unmapped targets are NaN. Gradients of
    'conservative_2nd' end at missing values, as those of `regrid_file` do; weights that are given
    (`weights`, `reuse_weights`) have the gradients of fields without gaps.

    Examples
    --------
    >>> import numpy as np
    >>> import rondel
    >>> fine = {"lon": np.arange(0.5, 360), "lat": np.arange(-89.5, 90)}
    >>> coarse = {"lon": np.arange(5, 360, 10), "lat": np.arange(-85, 90, 10)}
    >>> regridder = rondel.Regridder(fine, coarse, "conservative")  # doctest: +SKIP
    >>> regridder(np.ones((12, 180, 360))).shape  # doctest: +SKIP
    (12, 18, 36)

    """

    def __init__(
        self,
        ds_in: Any,
        ds_out: Any,
        method: RegridMethod,
        locstream_in: bool = False,
        locstream_out: bool = False,
        *,
        lon: Hashable | None = None,
        lat: Hashable | None = None,
        lon_out: Hashable | None = None,
        lat_out: Hashable | None = None,
        extrap_method: Extrapolation | None = None,
        extrap_dist_exponent: float | None = 2,
        extrap_num_src_pnts: int | None = 8,
        extrap_num_levels: int | None = 0,
        extrap_distance: float | None = None,
        corners: Corners = "error",
        max_uncovered: float = 1.0,
        unmapped_to_nan: bool = True,
        weights: Path | Weights | None = None,
        overlap: CellOverlap = "error",
        invalid: Invalid = "error",
        limiter: SlopeLimiter = "none",
        filename: Path | None = None,
        reuse_weights: bool = False,
        threads: int | None = None,
        progress: Progress = None,
        **needless: Any,
    ) -> None:
        from ._places import Places

        if method not in _METHODS:
            raise ValueError(f"method must be one of {', '.join(_METHODS)}, not {method!r}")
        if reuse_weights and weights is None:
            if filename is None:
                raise ValueError(
                    "reuse_weights needs filename or weights, which say where they are"
                )
            weights = filename
        require_rules(invalid=invalid)
        if corners not in ("error", "made"):
            raise ValueError(f"corners must be 'error' or 'made', not {corners!r}")
        limits = limits_of_xesmf(
            extrap_method,
            extrap_distance,
            extrap_dist_exponent,
            extrap_num_src_pnts,
            extrap_num_levels,
        )
        if not 0 <= max_uncovered <= 1:
            raise ValueError(f"max_uncovered must be from 0 to 1, not {max_uncovered}")
        if max_uncovered < 1 and (method not in _CONSERVATIVE or weights is not None):
            raise ValueError(
                "max_uncovered has no effect on given weights"
                if method in _CONSERVATIVE
                else f"max_uncovered has no effect with the method {method!r}"
            )
        if limiter not in ("none", "slopes"):
            raise ValueError(f"limiter must be 'none' or 'slopes', not {limiter!r}")
        if limiter != "none":
            is_second = method in _CONSERVATIVE and _CONSERVATIVE[method][0] == 2
            if not is_second:
                raise ValueError(f"limiter has no effect with the method {method!r}")
            if weights is not None:
                raise ValueError("limiter has no effect on given weights")
            if extrap_method in ("creep", "creep_fill"):
                raise ValueError("creep_fill has weights of neighbors, which no limiter changes")
        of_cells = {"overlap": overlap, "invalid": invalid, "corners": corners}
        for name, rule in of_cells.items():
            if method not in _CONSERVATIVE and rule != "error":
                raise ValueError(f"{name} has no effect with the method {method!r}")
            # Corners are compared with those of the weights.
            if weights is not None and name != "corners" and rule != "error":
                raise ValueError(f"{name} has no effect on given weights")
        for name in needless:
            if name not in _NEEDLESS:
                raise TypeError(f"Regridder() got an unexpected keyword argument {name!r}")
        self.filename = filename
        self._extrap_method = extrap_method
        self._remap: Remap | None = None  # what a file says of conservative weights
        self.method = method
        rules: Any = {"are_cells": method in _CONSERVATIVE, "corners": corners, "threads": threads}
        self._source = Places(ds_in, lon, lat, are_points=locstream_in, **rules)
        self._target = Places(
            ds_out,
            lon_out,
            lat_out,
            are_points=locstream_out,
            are_targets=True,
            arguments=("lon_out", "lat_out"),
            **rules,
        )
        mask = self._target.mask()
        is_nan = unmapped_to_nan or (mask is not None and not mask.all())
        self._unmapped = np.nan if is_nan else 0.0
        second: tuple[_core.Remap, CellSet, BoolArray] | None = None
        if weights is None:
            found, pieces = _made(
                self._source, self._target, method, overlap, invalid, threads, progress
            )
            made = found.weights if isinstance(found, Remap) else found
            is_whole = True
            if isinstance(found, Remap) and max_uncovered < 1:
                covered = _are_covered(found.target_fractions, max_uncovered)
                is_whole = bool(covered.all())
                if not is_whole:
                    made = made._with_rows(covered)
            if extrap_method is None and isinstance(found, Remap) and is_whole:
                self._remap = found
            if isinstance(found, Remap) and pieces is not None and pieces.order == 2:
                second = pieces, found.source, np.diff(made.indptr) > 0
        else:
            made = reused(weights, method, extrap_method, self._source, self._target, threads)
        if extrap_method is not None:
            made = _filled(made, self._source, self._target, extrap_method, limits, threads)
        self._coincident = self._source.coincident
        if number := self._source.num_repeated():
            warn_caller(
                f"{number} of {self._source.lon.size} places are those of others before them; at "
                "each place the first value that is there counts"
            )
        if weights is None:
            hashes = [point_set_hash(side.points()) for side in (self._source, self._target)]
            made._weights.know_places(*hashes)
        self.weights = made
        # Each field of order 2 is applied by the weights that its missing values need.
        self._applied: AnyWeights = (
            made if second is None else SecondOrderWeights.of(*second[:2], made, second[2], limiter)
        )
        self._sums: WeightsOfSums | None = None  # what keeps sums over cells, if it is wanted
        if weights is None and isinstance(found, Remap) and pieces is not None:
            self._sums = weights_of_sums(pieces, found.weights, self._applied)
        # As xESMF, unless rondel.regrid says otherwise.
        self._keeps_sums = False
        self._describes = False
        self._gaps: GapFiller | None = None

    def _fill_gaps(
        self, method: Extrapolation | None, distance: float | None, threads: int | None
    ) -> None:
        """Fills each field by its own gaps from now on, as files are."""
        limits = limits_of_xesmf(method, distance)
        if method is None:
            return
        source, target = self._source, self._target
        places = source.pairs(), target.pairs()
        masks = source.mask_with_places(), target.mask_with_places()
        self._extrap_method = method
        self._gaps = GapFiller(*places, target.shape, masks, method, limits, threads)

    @property
    def shape_in(self) -> tuple[int, ...]:
        """Tuple of int: the shape of the source grid, which fields have as their last axes."""
        return self._source.shape

    @property
    def shape_out(self) -> tuple[int, ...]:
        """Tuple of int: the shape of the target grid."""
        return self._target.shape

    def __call__(
        self,
        data: Any,
        *,
        keep_attrs: bool = False,
        skipna: bool = False,
        na_thres: float = 1.0,
        how: Literal["sum", "largest_share", "by_kind"] = "sum",
        output_chunks: OutputChunks = None,
        vectors: Iterable[tuple[str, str]] = (),
    ) -> Any:
        """Regrids fields to the target grid.

        Parameters
        ----------
        data : array_like, DataArray or Dataset
            Fields on the source grid; integers that their attributes call packed are unpacked. The
            last axes of an array have the shape `shape_in`; a
            DataArray has the dimensions of the source, or last dimensions of that shape. Data for
            the cells of a `CellSet` may have them along one dimension of any name.
        keep_attrs : bool, optional
            Whether to keep attributes, but for those that hold at the source alone: which numbers
            are missing, the grid, the range of the values, and flags of which means are made; by
            default False. After conservative methods `cell_methods` says that there is a mean.
        skipna : bool, optional
            Whether to leave out missing values; by default False, with which a target that needs a
            missing value is missing.
        na_thres : float, optional
            With `skipna`, the share of missing values above which a target is missing, from 0 to 1;
            by default 1. It is a share of the target's area with 'conservative_2nd', and of its
            weights otherwise; 1e-9 more is the same.
        how : {'sum', 'largest_share', 'by_kind'}, optional
            The weighted sum (default); the value that the largest part of a target has, for
            categories; or the latter for arrays with the attribute `flag_values`, `flag_masks` or
            `flag_meanings`, and sums for the others.
        output_chunks : int, tuple, dict or str, optional
            The lengths of the blocks along the dimensions of the target, for arrays of Dask: one
            for all, one for each, by their names, or 'auto' (default): as Dask's option
            ``array.chunk-size`` allows. A block needs the weights of its own targets and whole
            fields at the source, whose other dimensions keep their chunks. No chunks change a
            value.
        vectors : iterable of (str, str), optional
            Pairs of variables of a Dataset that are the eastward and northward components of
            vectors, such as winds: their components in space are carried, which none of the methods
            turns, also near poles, and the parts along the sphere at the targets are the result.
            They have no 'largest_share'. Units, standard_names and flags of the data must not say
            that they are no such components.

        Returns
        -------
        ndarray, DataArray or Dataset
            The fields on the target grid, as what `data` are, with their floating-point type or, of
            integers and booleans, as float64. Variables
            of a Dataset that depend on place and are no numbers, or have only some of the source's
            dimensions, and coordinates of the places are left out with a warning that names them.
            Arrays of Dask stay lazy.

        Raises
        ------
        ValueError
            If the data have another shape, their own longitudes and latitudes are not those of
            the source, whatever their names are, or square data without coordinates have
            dimensions of names in the other order (lon, lat); if they share a dimension with
            the target, such as the time of a track; then rename the target's dimension; or if the
            data say that vectors are none, by swapped or other standard_names, different units or
            flags.
        InvalidInput
            If a value is infinite, with its index in the source; arrays of Dask raise it when they
            are computed.

        """
        import xarray

        from ._carried import carried
        from ._coordinates import with_dimensions
        from ._values import unpacked
        from ._vectors import in_space, on_sphere, pairs_of

        if how not in ("sum", "largest_share", "by_kind"):
            raise ValueError(f"how must be 'sum', 'largest_share' or 'by_kind', not {how!r}")
        require_share(na_thres, "na_thres", skipna)
        vectors = list(vectors)
        if vectors and how == "largest_share":
            raise ValueError(
                "vectors have no largest share: each component would be of its own source"
            )
        options: Any = {
            "skipna": skipna,
            "max_missing": na_thres,
            "unmapped": self._unmapped,
            "keep_attrs": keep_attrs,
            "how": how,
            "are_chosen": self._are_chosen(),
            "output_chunks": output_chunks,
            "coincident": self._coincident,
            "gaps": self._gaps,
            "describes": self._describes,
            "over_cells": OverCells(
                "mean" if self.method in _CONSERVATIVE else "",
                self._sums if self._keeps_sums else None,
                frozenset(str(name) for pair in vectors for name in pair),
                is_extrapolated=self._extrap_method is not None,
            ),
        }
        source = self._source
        if isinstance(data, xarray.Dataset):
            data, source = source.along_cells(data)
            pairs = pairs_of(data, vectors, source)
            if not pairs:
                return carried(data, self._applied, source, self._target, **options)
            parts = in_space(data, pairs, source)
            found = carried(parts, self._applied, source, self._target, **options)
            return on_sphere(found, data, pairs, self._target)
        if vectors:
            raise TypeError("vectors are variables of a Dataset, and the data are none")
        is_labeled = isinstance(data, xarray.DataArray)
        if not is_labeled and not hasattr(data, "__dask_graph__"):
            data = np.ma.asanyarray(data) if np.ma.isMaskedArray(data) else np.asarray(data)
        if is_labeled:
            data, source = source.along_cells(data)
        dims = source.dims
        _require_shape(data, source, is_labeled)
        if not is_labeled:
            leading = tuple(f"axis_{k}" for k in range(data.ndim - len(dims)))
            data = _labeled(data, (*leading, *dims))
        elif not set(dims) <= set(data.dims):
            _require_order(data, source)
            names = dict(zip(data.dims[-len(dims) :], dims, strict=True))
            source.require_places_of(with_dimensions(data, names))
            data = data.rename(names)
        if is_labeled:
            data = unpacked(data)
            source.require_same(data)
            source.require_places_of(data)
        found = carried(data, self._applied, source, self._target, **options)
        return found if is_labeled else found.data

    def _are_chosen(self) -> bool:
        """Whether each target has the value of one source, so that flags stay flags."""
        filling = self._extrap_method
        is_single = filling is None or esmf_name(filling) == "nearest_s2d"
        return self.method == "nearest_s2d" and is_single

    def to_netcdf(self, path: Path | None = None) -> None:
        """Writes the weights in the format of ESMF, which `weights` and other programs read.

        Parameters
        ----------
        path : path-like, optional
            Ends in .nc or .nc4; by default `filename`. The file appears when it is complete, and
            replaces the one that is there.

        """
        path = self.filename if path is None else path
        if path is None:
            raise ValueError("to_netcdf() needs the name of a file: the Regridder has no filename")
        if self._remap is not None:
            self._remap.to_netcdf(path)
        else:
            source, target = self._source.side(), self._target.side()
            method, norm = self._said()
            name, weights = netcdf_name(path, "esmf"), self.weights._weights
            _core.write_weights(name, "esmf", weights, source, target, method, norm)

    def to_zarr(self, path: Path, *, entries_per_chunk: int = ENTRIES) -> None:
        """Writes the weights as a group of Zarr arrays (version 3), a folder, with ESMF's names.

        `Weights.from_zarr` reads them, and another `Regridder` takes what it reads as `weights`.

        Parameters
        ----------
        path : path-like
            The folder; a name that ends in `.zarr` is usual. The group appears complete or not at
            all, and replaces one that Rondel made.
        entries_per_chunk : int, optional
            As in `Weights.to_zarr`.

        Raises
        ------
        ImportError
            If zarr-python 3 or later is not installed.
        OSError
            If the folder cannot be written, or is one that must not be replaced; then nothing is
            changed.

        """
        if self._remap is not None:
            self._remap.to_zarr(path, entries_per_chunk=entries_per_chunk)
        else:
            method, norm = self._said()
            sides = self._source, self._target
            write_between_places(path, self.weights, sides, method, norm, entries_per_chunk)

    def _said(self) -> tuple[str, str]:
        """What files say of the method and of the normalization."""
        norm = _CONSERVATIVE[self.method][1] if self.method in _CONSERVATIVE else "none"
        return said_method(self.method, self._extrap_method), norm

    def _facts(self) -> list[tuple[str, str]]:
        def text(shape: tuple[int, ...]) -> str:
            return " x ".join(f"{length:,}" for length in shape)

        return [
            ("shapes", f"{text(self.shape_in)} to {text(self.shape_out)}"),
            ("method", self.method),
            ("entries", count(len(self.weights.data), "weight")),
        ]


def _require_shape(data: Any, source: Places, is_labeled: bool) -> None:
    shape = tuple(data.shape[-len(source.shape) :])
    if is_labeled and set(source.dims) <= set(data.dims):
        shape = tuple(data.sizes[name] for name in source.dims)
    if shape != source.shape:
        raise ValueError(f"data must have shape (..., {str(source.shape)[1:]}, not {data.shape}")


def _require_order(data: Any, source: Places) -> None:
    """Refuses a square field whose dimensions have names of the other order."""
    last = [str(dim).lower() for dim in data.dims[-2:]]
    is_turned = last[0] in ("lon", "longitude", "x") or last[-1] in ("lat", "latitude", "y")
    if source.are_axes and len(set(source.shape)) == 1 and is_turned:
        raise ValueError(
            f"the last dimensions of the data are {data.dims[-2]} and {data.dims[-1]}, those "
            f"of the source are {' and '.join(map(str, source.dims))}: rename "
            "or transpose them"
        )


def _labeled(data: Any, dims: tuple[Any, ...]) -> Any:
    import xarray

    if np.ma.isMaskedArray(data):
        kind = data.dtype if data.dtype.kind == "f" else np.float64
        data = np.ma.filled(data.astype(kind), np.nan)
    return xarray.DataArray(data, dims=dims)


def _made(
    source: Places,
    target: Places,
    method: str,
    overlap: CellOverlap,
    invalid: Invalid,
    threads: int | None,
    progress: Progress,
) -> tuple[Weights | Remap, _core.Remap | None]:
    """The weights, and of conservative ones the pieces of which they are."""
    if method in _CONSERVATIVE:
        order, norm = _CONSERVATIVE[method]
        sides = [side.cells(threads) for side in (source, target)]
        if invalid == "repair":
            sides = [side.repaired(threads=threads) for side in sides]
        found, pieces = remapped(
            *sides,
            order=order,
            norm=norm,
            overlap=overlap,
            threads=threads,
            progress=progress,
        )
        return found, pieces
    if method == "nearest_s2d":
        made = _nearest(source, target)
    elif method == "nearest_d2s":
        made = _nearest_d2s(source, target, threads)
    elif method == "native":
        made = _native(source, target, threads)
        mask = source.mask()
        if mask is not None:
            made = made._without_columns(mask)
    else:
        if method == "bilinear" and source.are_axes:
            made = _bilinear(source, target)
        else:
            kind: Any = "linear" if method == "bilinear" else method
            made = source.weights_to(target, kind, threads=threads, progress=progress)
        mask = source.mask()
        if mask is not None:
            made = made._without_columns(mask)
    mask = target.mask()
    return made if mask is None else made._with_rows(mask), None


def _are_covered(fractions: FloatArray, max_uncovered: float) -> BoolArray:
    """Which targets have enough of the source, as `regrid_file` decides it."""
    covered: BoolArray = _core.covered_enough(fractions, max_uncovered) != 0
    return covered


def _nearest(source: Places, target: Places) -> Weights:
    """For each target the nearest source that takes part; no row if none does."""
    tri, numbers = source.triangulated(source.mask_with_places())
    shape = (target.lon.size, source.lon.size)
    if len(numbers) == 0:
        return Weights(np.zeros(shape[0] + 1, np.int64), [], [], shape)
    return tri.weights(target.points(), "nearest")._renumbered(None, numbers, shape)


def _nearest_d2s(source: Places, target: Places, threads: int | None) -> Weights:
    """Each source that takes part gives its value to the nearest target that does."""
    tri, numbers = target.triangulated(target.mask())
    shape = (target.lon.size, source.lon.size)
    if len(numbers) == 0:
        return Weights(np.zeros(shape[0] + 1, np.int64), [], [], shape)
    mask = source.mask()
    used = np.arange(shape[1]) if mask is None else np.flatnonzero(mask)
    points = source.points().reshape(-1, 3)[used]
    made = tri._interpolator().nearest_d2s_weights(points, as_threads(threads))
    return Weights._of(made)._renumbered(numbers, used, shape)


def _native(source: Places, target: Places, threads: int | None) -> Weights:
    """Weights in the cells of the source's own mesh, or between the cells of a set."""
    import xarray

    from ._mesh_bytes import mesh_bytes

    targets, limit = target.pairs(), as_threads(threads)
    cells = source.named_cells
    if cells is not None:
        if source.are_axes:
            raise ValueError(
                "the method 'native' needs cells with corners in common; 'bilinear' is for a grid "
                "along axes"
            )
        found = Weights._of(_core.native_weights_between(cells._placed(), targets, limit))
    elif isinstance(source.data, xarray.Dataset):
        content = mesh_bytes(source.data, *source.names)
        places, numbers = source.located()
        made = _core.native_weights_in_mesh(content, places, targets, limit)
        for remark in made.remarks:
            warn_caller(remark)
        found = Weights._of(made.take_weights())
        if numbers is not None:
            found = found._renumbered(None, numbers, (target.lon.size, source.lon.size))
    else:
        raise ValueError(
            "the method 'native' needs a Dataset with the mesh of the values, or a CellSet, not "
            f"{type(source.data).__name__}"
        )
    return found if target._located is None else found._with_rows(target._located)


def _bilinear(source: Places, target: Places) -> Weights:
    """Bilinear weights for the axes of the source; without entries for targets outside."""
    given = (*source.axes, *target.degrees())
    are_single = any(each.dtype.kind == "f" and each.dtype.itemsize < 8 for each in given)
    lon, lat = as_floats(given[0], "lon"), as_floats(given[1], "lat")
    source.coincident = np.reshape(_core.repeated_places(lon, lat), (-1, 2)).astype(np.int64)
    return Weights._of(_core.bilinear_weights(lon, lat, target.pairs(), are_single))


def _filled(
    weights: Weights,
    source: Places,
    target: Places,
    method: Extrapolation,
    limits: dict[str, Any],
    threads: int | None,
) -> Weights:
    """Entries where a target has nothing, but for those that take no part."""
    if method not in ("nearest", "nearest_s2d") or limits["distance"] is not None:
        places = source.pairs(), target.pairs()
        masks = source.mask_with_places(), target.mask_with_places()
        return GapFiller(*places, target.shape, masks, method, limits, threads).filled(weights)
    is_kept = np.diff(weights.indptr) > 0
    mask = target.mask_with_places()
    if mask is not None:
        is_kept |= ~mask
    return weights if is_kept.all() else weights._with_rows(is_kept, _nearest(source, target))
