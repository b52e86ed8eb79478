# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regridding of files, as the command `rondel regrid` does it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from . import _core
from ._arrays import as_bytes, as_count, as_name, as_number, as_text, as_threads
from ._geo import Path
from ._geometries import Corners, Edges, Invalid, Sides
from ._native import Extrapolation, require_limits
from ._remap import CellOverlap, RemapLimiter
from ._types import Progress

FieldMethod: TypeAlias = Literal[
    "conservative",
    "conservative_2nd",
    "largest_share",
    "nearest",
    "linear",
    "laplace",
    "sibson",
    "hermite",
    "cubic",
    "bilinear",
    "native",
]


@dataclass(frozen=True)
class RegridReport:
    """What `regrid_file` did.

    Attributes
    ----------
    sources, targets : int
        The numbers of places of both sides.
    fields : int
        The number of fields: variables times their times and levels.
    missing : int
        The number of values of targets that are missing.
    tiles : int
        The number of tiles in which weights were computed, or 0 if all were in memory.
    remarks : tuple of str
        What was left out or copied as it is, and why; each begins with the name of its file.
    resumed : int
        The number of values that an earlier run had computed.
    extrapolated : int
        The number of values of targets that this run extrapolated.

    """

    sources: int
    targets: int
    fields: int
    missing: int
    tiles: int
    remarks: tuple[str, ...]
    resumed: int = 0
    extrapolated: int = 0


def regrid_file(
    path: Path,
    target: Path,
    out: Path,
    *,
    names: str | Iterable[str] = (),
    source: Path | None = None,
    method: FieldMethod | None = None,
    norm: Literal["destarea", "fracarea"] = "fracarea",
    limiter: RemapLimiter = "none",
    max_missing: float = 0.5,
    sides: Sides = "parallels",
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    corners: Corners = "error",
    overlap: CellOverlap = "error",
    memory: int | str = 2 << 30,
    tile: int = 0,
    deflate: int = 1,
    history: str = "",
    statistics: str | Iterable[str] = (),
    weigh_by: Literal["area", "fraction"] = "area",
    extrapolate: Extrapolation | None = None,
    extrapolate_distance: float | None = None,
    extrapolate_sources: int = 8,
    extrapolate_exponent: int = 2,
    extrapolate_levels: int = 0,
    vectors: Iterable[tuple[str, str]] = (),
    threads: int | None = None,
    progress: Progress = None,
    resume: bool = False,
) -> RegridReport:
    """Brings the fields of a file to another grid.

    All variables at the places of the source are carried, for all times and levels, with their
    attributes, their axes, and variables without places such as the bounds of times. Files may be
    larger than memory.

    Parameters
    ----------
    path : path-like
        netCDF with fields; ``"FILE.nc:NAME"`` is one of them, or one of several grids.
    target : path-like
        The name of a grid (`CellSet.named`), netCDF with cells or places, or polygons: .geojson,
        and with GDAL installed .gpkg, .fgb, .shp or .parquet. Or points, with methods between
        places: in these formats, or .csv, .tsv, .xyz, .txt or .npy; their columns and properties,
        and what netCDF says of its places, stand beside the values.
    out : path-like
        Ends in .nc or .nc4 (netCDF-4), .csv, .tsv or .npy. The file appears when it is complete.
    names : str or iterable of str, optional
        The variables; by default all that are at the places of the source.
    source : path-like, optional
        Where the fields are: the name of a grid, or a file with cells; by default `path`.
    method : str, optional
        'conservative', 'conservative_2nd' (with gradients), 'largest_share' (the value with
        the largest share of the area), 'nearest', 'linear', 'laplace', 'sibson', 'hermite',
        'cubic', 'bilinear' on a grid along axes, or 'native' in the cells of the mesh of the
        fields, at its nodes or its faces (`native_weights`). Hyphens, as of the command, are
        underscores. By default fields with the attribute `flag_values`, `flag_masks` or
        `flag_meanings` get 'largest_share', and all others 'conservative'; a method that is named
        is that of all fields.
    norm : {'fracarea', 'destarea'}, optional
        What conservative sums are divided by: the part that sources cover, so that constants are
        kept (default), or the target's area, so that integrals are.
    limiter : {'none', 'bounds', 'slopes'}, optional
        With 'bounds' no value of 'conservative_2nd' is beyond those of its sources, and the
        integral is kept. With 'slopes' the gradient in a source leads to no value beyond those of
        this source and of the sources around it, and each source keeps its integral (Barth and
        Jespersen 1989). Both need the weights of all targets at a time.
    max_missing : float, optional
        The share of a target that no source may cover, and of its covered part in which values
        may be missing, from 0 to 1; by default 0.5. A target at the limit, up to 1e-9, has a value.
    sides : {'parallels', 'great_circles'}, optional
        The northern and southern sides of cells of grids, as in `CellSet.lonlat_grid`.
    edges, invalid, corners
        How polygons, cells that cross themselves, and grids without corners are read, as in
        `CellSet.read`; with 'repair' also cells of netCDF are repaired. Corners that were
        made are told by the attribute `source_corners` or `target_corners` of the file.
    overlap : {'error', 'first', 'share', 'each'}, optional
        What becomes of cells of one side that overlap, as in `remap`.
    memory : int or str, optional
        About how many bytes may be in use, beside those of the process, also as "1G" or "500M"; by
        default 2 GiB. Weights
        that need more are computed tile by tile, with the same values; those of cells that
        overlap, and between two regions are not, nor those of 'conservative_2nd' for sources
        that are neither a named grid nor between parallels.
    tile : int, optional
        The number of cells of a tile, or of targets with a method between places; by default as
        `memory` says.
    deflate : int, optional
        The effort of compression in netCDF-4, from 0 to 9; by default 1.
    history : str, optional
        A line for the attribute `history` of the file.
    statistics : str or iterable of str, optional
        Statistics of the values in each target instead of one value by a method, as in
        `zonal_statistics`: each variable becomes one for each, such as 'tas_mean'.
    weigh_by : {'area', 'fraction'}, optional
        The weight of a value in them, as `weights` in `zonal_statistics`.
    extrapolate : str, optional
        How targets without a value get one, field by field: 'nearest' (ESMF's 'nearest_s2d'), of
        the nearest source with a value; 'idw' ('inverse_dist'), of several by inverse distance; or
        'creep' ('creep_fill'), the mean of their neighbors with values, level by level.
    extrapolate_distance : float, optional
        How far sources with values may be from a target, in kilometers; by default any distance.
    extrapolate_sources, extrapolate_exponent : int, optional
        With 'idw' the number of sources (8) and the power of the distance (2).
    extrapolate_levels : int, optional
        With 'creep' the number of levels; 0 (default): all that can be filled.
    vectors : iterable of (str, str), optional
        Pairs of variables that are the eastward and northward components of vectors, such as winds:
        their components in space are carried, which none of the methods turns, also near poles, and
        the parts along the sphere at the centers of the targets are written.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.
    resume : bool, optional
        Whether to keep what is computed in a file beside the output, ``out + ".partial"``, until
        the output is complete, and to begin with what a run that ended early left there; by
        default False. The output is the same. `threads`, `memory`, `tile` and `deflate` may
        differ between the runs.

    Returns
    -------
    RegridReport
        The numbers of places, fields and missing values.

    Raises
    ------
    OSError
        If a file cannot be read or written, is read and written, or changes while it is read; or if
        what is to be resumed is a run with other files or options.
    ValueError
        If there is no such grid, the file has no fields at the source's places, or the method does
        not fit it; `InvalidInput` if cells overlap, or if `memory` is too small, with the number
        of bytes that are enough.

    Examples
    --------
    >>> import rondel
    >>> report = rondel.regrid_file("era5.nc", "healpix:7", "pixels.nc")  # doctest: +SKIP
    >>> report.fields  # doctest: +SKIP
    365

    """
    options = as_options(
        names=names,
        source=source,
        method=method,
        norm=norm,
        limiter=limiter,
        max_missing=max_missing,
        sides=sides,
        edges=edges,
        invalid=invalid,
        corners=corners,
        overlap=overlap,
        memory=memory,
        tile=tile,
        deflate=deflate,
        history=history,
        statistics=statistics,
        weigh_by=weigh_by,
        extrapolate=extrapolate,
        extrapolate_distance=extrapolate_distance,
        extrapolate_sources=extrapolate_sources,
        extrapolate_exponent=extrapolate_exponent,
        extrapolate_levels=extrapolate_levels,
        vectors=vectors,
        resume=resume,
    )
    path, target, out = map(as_name, (path, target, out))
    return report_of(_core.regrid_file(path, target, out, options, as_threads(threads), progress))


def report_of(made: _core.RegridFileReport) -> RegridReport:
    """What users get."""
    return RegridReport(
        made.sources,
        made.targets,
        made.fields,
        made.missing,
        made.tiles,
        tuple(made.remarks),
        made.resumed,
        made.extrapolated,
    )


def as_options(
    *,
    names: str | Iterable[str] = (),
    source: Path | None = None,
    method: FieldMethod | None = None,
    norm: Literal["destarea", "fracarea"] = "fracarea",
    limiter: RemapLimiter = "none",
    max_missing: float = 0.5,
    sides: Sides = "parallels",
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    corners: Corners = "error",
    overlap: CellOverlap = "error",
    memory: int | str = 2 << 30,
    tile: int = 0,
    deflate: int = 1,
    history: str = "",
    statistics: str | Iterable[str] = (),
    weigh_by: Literal["area", "fraction"] = "area",
    extrapolate: Extrapolation | None = None,
    extrapolate_distance: float | None = None,
    extrapolate_sources: int = 8,
    extrapolate_exponent: int = 2,
    extrapolate_levels: int = 0,
    vectors: Iterable[tuple[str, str]] = (),
    resume: bool = False,
) -> _core.RegridFileOptions:
    """The options of `regrid_file`, as the library has them."""
    require_limits(
        extrapolate,
        "extrapolate",
        {
            "extrapolate_distance": ("", extrapolate_distance, None),
            "extrapolate_sources": ("inverse_dist", extrapolate_sources, 8),
            "extrapolate_exponent": ("inverse_dist", extrapolate_exponent, 2),
            "extrapolate_levels": ("creep_fill", extrapolate_levels, 0),
        },
    )
    return _core.regrid_options(
        _as_texts(names, "names"),
        None if source is None else as_name(source),
        as_method(method),
        norm,
        as_number(max_missing, "max_missing"),
        sides,
        edges,
        invalid,
        overlap,
        as_bytes(memory),
        as_count(tile, "tile"),
        as_count(deflate, "deflate"),
        as_text(history, "history"),
        ",".join(_as_texts(statistics, "statistics")),
        weigh_by,
        corners,
        None if extrapolate is None else as_text(extrapolate, "extrapolate"),
        None
        if extrapolate_distance is None
        else as_number(extrapolate_distance, "extrapolate_distance"),
        as_count(extrapolate_sources, "extrapolate_sources"),
        as_count(extrapolate_exponent, "extrapolate_exponent"),
        as_count(extrapolate_levels, "extrapolate_levels"),
        _as_pairs(vectors),
        bool(resume),
        limiter,
    )


def as_method(method: str | None) -> str | None:
    """A method, which the command spells with hyphens."""
    return method.replace("-", "_") if isinstance(method, str) else method


def _as_texts(given: str | Iterable[str], name: str) -> list[str]:
    if isinstance(given, str):
        return [given] if given else []
    return [as_text(each, name) for each in given]


def _as_pairs(vectors: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    pairs = []
    for pair in vectors:
        if isinstance(pair, str) or len(tuple(pair)) != 2:
            raise TypeError(f"vectors are pairs of names, not {pair!r}")
        east, north = pair
        pairs.append((as_text(east, "vectors"), as_text(north, "vectors")))
    return pairs
