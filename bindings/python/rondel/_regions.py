# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Regions: cells that are clipped by polygons or joined by group."""

from __future__ import annotations

import os
from collections.abc import Hashable, Sequence
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from . import _core
from ._arrays import as_threads
from ._cell_set import CellSet
from ._errors import warn_caller
from ._geo import File, Path, arrow_of, polygon_frame, written
from ._geometries import (
    Edges,
    Groups,
    Invalid,
    PolygonOverlap,
    features_of,
    is_file,
    polygons_of,
    read_cells,
    require_rules,
)
from ._pickled import arrays_of, with_arrays
from ._plot import RegionPictures
from ._properties import (
    are_labeled,
    checked_properties,
    frame_column,
    is_missing,
    json_columns,
    with_gaps,
)
from ._repr import Described, count
from ._types import ArrayLike, Divided, FloatArray, Progress, Properties

if TYPE_CHECKING:
    import geopandas


EARTH_RADIUS_KM = 6371.0088  # the mean of WGS 84, (2 a + b) / 3
AREA_NAMES = ("area", "area_km2")


class Regions(Described, RegionPictures):
    """Regions of the sphere as polygons with holes: clipped cells or joined cells.

    `SphericalVoronoi.clip`, `SphericalVoronoi.dissolve`, the same methods of `PowerDiagram`, and
    `feature_cells` make them.

    Attributes
    ----------
    labels : ndarray, shape (n,)
        What each region belongs to: the site of a clipped cell, the group of joined cells, or the
        feature.
    values : ndarray, shape (n,), or None
        The value of each region, if cells were divided by the values of polygons.
    areas : ndarray of float64, shape (n,)
        The areas of the regions in steradians.

    Examples
    --------
    >>> import rondel
    >>> cells = rondel.SphericalVoronoi([[0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0],
    ...                                  [0, -1, 0]])
    >>> box = {"type": "Polygon", "coordinates": [[[0, -9], [9, -9], [9, 9], [0, 9], [0, -9]]]}
    >>> cells.clip(box)
    <rondel.Regions: 6 regions, 5 empty>
    >>> halves = cells.dissolve(["polar", "polar", "side", "side", "side", "side"])
    >>> halves.labels.tolist(), (3 * halves.areas / 3.141592653589793).round(9).tolist()
    (['polar', 'side'], [4.0, 8.0])

    """

    labels: np.ndarray[Any, Any]
    values: np.ndarray[Any, Any] | None
    _rings: _core.CellRings
    _kind: str

    @classmethod
    def _of(cls, rings: _core.CellRings, labels: Any, kind: str, values: Any = None) -> Regions:
        self = cls.__new__(cls)
        self._rings = rings
        self.labels = labels
        self.values = values
        self._kind = kind
        return self

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_rings": arrays_of(self._rings)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        rings = with_arrays(_core.CellRings(), state["_rings"])
        self.__dict__.update({**state, "_rings": rings})

    def __len__(self) -> int:
        return self._rings.num_cells

    @property
    def areas(self) -> FloatArray:
        """Ndarray of float64, shape (n,): the areas in steradians; 0 for empty regions."""
        return self._rings.areas()

    def areas_km2(self, radius_km: float = EARTH_RADIUS_KM) -> FloatArray:
        """Returns the areas in square kilometers.

        Parameters
        ----------
        radius_km : float, optional
            The radius of the sphere in kilometers; by default 6371.0088, the mean radius of the
            Earth (WGS 84).

        Returns
        -------
        ndarray of float64, shape (n,)
            The areas in square kilometers; 0 for empty regions.

        Raises
        ------
        ValueError
            If the radius is not positive, or the area of the sphere is not finite.

        """
        radius_km = float(radius_km)
        squared = radius_km * radius_km
        if not (radius_km > 0 and np.finfo(float).tiny <= 4 * np.pi * squared < np.inf):
            raise ValueError(f"radius_km is {radius_km}, not positive with a finite area")
        return self.areas * squared

    def cell_set(self, *, threads: int | None = None) -> CellSet:
        """Returns the regions as cells for `remap`.

        Parameters
        ----------
        threads : int, optional
            The largest number of threads; by default one for each core.

        Returns
        -------
        CellSet
            A cell for each region; empty regions have empty cells.

        """
        return CellSet._of(_core.CellSet.polygons(self._rings, as_threads(threads)))

    def dissolve(
        self, groups: ArrayLike, *, threads: int | None = None, progress: Progress = None
    ) -> Regions:
        """Joins regions by group.

        Parameters
        ----------
        groups : sequence, shape (n,)
            The group of each region, as in `SphericalVoronoi.dissolve`.
        threads, progress
            As in `SphericalVoronoi.dissolve`.

        Returns
        -------
        Regions
            One region for each group, in the order of first occurrence; `labels` are the groups.

        Raises
        ------
        ValueError
            If the number of groups is not n.

        """
        return _dissolved(self._rings, groups, threads, progress)

    @overload
    def to_geojson(
        self,
        path: None = None,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
        radius_km: float | None = None,
    ) -> dict[str, Any]: ...
    @overload
    def to_geojson(
        self,
        path: Path | File,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
        radius_km: float | None = None,
    ) -> None: ...
    def to_geojson(
        self,
        path: Path | File | None = None,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
        radius_km: float | None = None,
    ) -> Any:
        """Converts the regions to GeoJSON (RFC 7946).

        There is a feature for each region that has an area, with the properties `area`
        (steradians), `site`, `group` or `feature`, and `value` if the regions have values. Polygons
        are counterclockwise, have holes, and are cut at the antimeridian.

        Parameters
        ----------
        path : path-like or file object, text or binary, optional
            Where to write the text; by default it is parsed and returned.
        properties : mapping of str to sequence, optional
            Further properties: for each name a value for every region.
        tolerance_deg : float, optional
            The largest distance of a polygon's straight lines from its arcs, in degrees; by default
            0.01.
        radius_km : float, optional
            The radius of a sphere in kilometers, which adds the property `area_km2`; the mean
            radius of the Earth is 6371.0088.

        Returns
        -------
        dict or None
            The FeatureCollection, or None if `path` is given.

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        values = checked_properties(properties, (*self._own, *AREA_NAMES), len(self), as_json=True)
        named = {**self._own, **values}
        if radius_km is not None:
            named["area_km2"] = self.areas_km2(radius_km)
        columns = json_columns(named)
        tolerance = float(tolerance_deg)
        return written(path, lambda name: self._rings.write(name, columns, tolerance))

    def to_geopandas(
        self,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
        radius_km: float | None = None,
    ) -> geopandas.GeoDataFrame:
        """Converts the regions to a GeoDataFrame in longitudes and latitudes (EPSG:4326).

        The methods `to_file` and `to_parquet` of the result write GeoPackage, FlatGeobuf,
        shapefiles and GeoParquet.

        Parameters
        ----------
        properties, tolerance_deg, radius_km
            As in `to_geojson`, for columns in place of properties.

        Returns
        -------
        geopandas.GeoDataFrame
            A row for each region that has an area, with the columns `site`, `group` or `feature`,
            `value` if the regions have values, and `area` (steradians). The index is the number of
            the region.

        Raises
        ------
        ImportError
            If GeoPandas is not installed.

        """
        given = checked_properties(properties, (*self._own, *AREA_NAMES, "geometry"), len(self))
        polygons = self._rings.polygons(float(tolerance_deg), 0)
        owners = polygons.owners
        rows = owners[np.diff(owners, prepend=-1) > 0]
        columns: dict[str, Any] = {name: labels[rows] for name, labels in self._own.items()}
        columns["area"] = self.areas[rows]
        if radius_km is not None:
            columns["area_km2"] = self.areas_km2(radius_km)[rows]
        for name, values in given.items():
            columns[name] = frame_column(values)[rows]
        return polygon_frame(columns, polygons, polygons.polygons, rows)

    @property
    def _own(self) -> dict[str, Any]:
        named = {self._kind: self.labels}
        return named if self.values is None else {**named, "value": self.values}

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        return self.to_geojson()

    def __arrow_c_array__(self, requested_schema: Any = None) -> tuple[Any, Any]:
        """Hands the regions to another library as an array of geoarrow.multipolygon: the polygons
        of `to_geojson`, and an empty one for each region that has no area.
        """
        return arrow_of(self._rings, "together")

    def _facts(self) -> list[tuple[str, str]]:
        empty = int(np.count_nonzero(self.areas == 0))
        facts = [("regions", count(len(self), "region"))]
        if empty:
            facts.append(("empty", f"{empty:,} empty"))
        return facts


class CellRegions:
    """Regions of the cells of diagrams."""

    def clip(
        self: Divided,
        regions: Any,
        *,
        values: ArrayLike | None = None,
        edges: Edges = "lonlat",
        overlap: Literal["error", "first"] = "error",
        invalid: Invalid = "error",
        threads: int | None = None,
        progress: Progress = None,
    ) -> Regions:
        """Clips the cells to regions such as land, a country or a border.

        Parameters
        ----------
        regions : path-like, geometries or CellSet
            The regions: a GeoJSON file; a GeoDataFrame or GeoSeries; a geometry of shapely, a
            mapping of GeoJSON, any object with `__geo_interface__`, or a sequence of these; a box
            of west, south, east and north in degrees; or cells.
        values : sequence, shape (m,), optional
            A value for each of the m regions, such as a country or a kind of soil, by which cells
            are divided. Regions whose value is None, NaN or NA are left out. By default cells are
            clipped to the union of the regions.
        edges : {'lonlat', 'geodesic'}, optional
            What joins positions of polygons: straight lines in longitude and latitude as in RFC
            7946 (default), or great circles.
        overlap : {'error', 'first'}, optional
            What to do, if there are `values`, with a place that several regions contain: 'error'
            (default) raises an error that names two of them, 'first' gives it to the first one. It
            has no effect without values.
        invalid
            As in `CellSet.read`.
        threads : int, optional
            The largest number of threads; by default one for each core.
        progress : callable or bool, optional
            Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
            True shows a `ProgressBar`.

        Returns
        -------
        Regions
            A region for each site, empty if nothing of its cell is left. With `values`: a region
            for each site and value whose intersection is not empty, sorted by site.

        Raises
        ------
        ValueError
            If a geometry is not a polygon, is not valid, or has positions that are no longitudes
            and latitudes; or if regions with values overlap.
        OSError
            If the file cannot be read.

        Warns
        -----
        UserWarning
            If polygons were repaired, or have no area but for rounding.

        Notes
        -----
        Which sides cross is decided exactly, and two regions that meet have the same corners there,
        bit by bit (docs/theory/overlay.md).

        Examples
        --------
        >>> import rondel
        >>> lon, lat = [0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90]
        >>> cells = rondel.SphericalVoronoi.from_lonlat(lon, lat)
        >>> north = cells.clip([-180, 0, 180, 90])
        >>> (12 * north.areas / 3.141592653589793).round(6).tolist()
        [4.0, 4.0, 4.0, 4.0, 8.0, 0.0]

        """
        require_rules(edges, overlap, invalid)
        cells = CellSet.voronoi(self, threads=threads)._cells
        shared: PolygonOverlap = "keep" if values is None else overlap  # clip() unites
        if values is None:
            within = as_cell_set(regions, edges, shared, invalid, threads)._cells
            found = _core.clip(cells, within, as_threads(threads), progress)
            return Regions._of(found, np.arange(len(self.points)), "site")
        numbers, names = _numbered(values, "values")
        within = as_cell_set(regions, edges, shared, invalid, threads, numbers)._cells
        _require_size(numbers, within.num_cells, "values", "regions")
        found, sites, groups = _core.intersection(
            cells, within, numbers, as_threads(threads), progress
        )
        return Regions._of(found, sites, "site", names[groups])

    def dissolve(
        self: Divided, groups: ArrayLike, *, threads: int | None = None, progress: Progress = None
    ) -> Regions:
        """Joins the cells by group, such as a country, an office or the nearest airport.

        Parameters
        ----------
        groups : sequence, shape (n,)
            The group of each site: a number, a text, a time, or any hashable object. A site whose
            group is None, NaN, NaT or NA belongs to no group.
        threads : int, optional
            The largest number of threads; by default one for each core.
        progress : callable or bool, optional
            Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
            True shows a `ProgressBar`.

        Returns
        -------
        Regions
            A region for each group, in the order of first occurrence; `labels` are the groups. Two
            regions that meet have the same corners there, bit by bit.

        Raises
        ------
        ValueError
            If the number of groups is not n.

        Examples
        --------
        >>> import rondel
        >>> lon, lat = [0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90]
        >>> cells = rondel.SphericalVoronoi.from_lonlat(lon, lat)
        >>> cells.dissolve(["side", "side", "side", "side", "cap", "cap"]).labels.tolist()
        ['side', 'cap']

        """
        rings = CellSet.voronoi(self, threads=threads)._cells.rings()
        return _dissolved(rings, groups, threads, progress)


def feature_cells(
    features: Any,
    tolerance_km: float,
    *,
    radius_km: float = EARTH_RADIUS_KM,
    edges: Edges = "lonlat",
    overlap: Literal["error", "first"] = "error",
    invalid: Invalid = "error",
    within: Any = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Regions:
    """Computes the Voronoi cells of lines, polygons and points.

    The cell of a feature contains the places that are nearer to it than to any other feature.

    Parameters
    ----------
    features : path-like or geometries
        The n features: a GeoJSON file; a GeoDataFrame or GeoSeries; geometries of shapely, mappings
        of GeoJSON, or any object with `__geo_interface__`.
    tolerance_km : float
        The accuracy in kilometers: a place may belong to a feature that is at most this much
        farther away than the nearest one. The inside of a polygon belongs to it exactly.
    radius_km : float, optional
        The radius of the sphere on which kilometers are measured; by default 6371.0088, the mean
        radius of the Earth.
    edges
        As in `SphericalVoronoi.clip`.
    overlap : {'error', 'first'}, optional
        What to do with a place that several polygons contain: 'error' (default) raises an error
        that names two of them, 'first' gives it to the first one.
    invalid
        As in `CellSet.read`, for the polygons of the features and of `within`.
    within : path-like, geometries or CellSet, optional
        Regions to which the cells are clipped, as `SphericalVoronoi.clip` takes them; by default
        cells are not clipped.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    Regions
        A region for each feature; `labels` are the numbers of the features. A region has the area 0
        if its feature has no coordinates, or if all its places belong to features before it. A
        single feature that is not clipped has the whole sphere, without a border.

    Raises
    ------
    ValueError
        If an object is not a geometry, polygons are not valid or overlap, the tolerance is not
        positive, or so small that an arc could be replaced by more than 524,288 points.
    OSError
        If the file cannot be read.

    Warns
    -----
    UserWarning
        If the file has no features, or polygons of it are not quite as they should be.

    Notes
    -----
    Lines and outlines are replaced by points so dense that the cells have the accuracy
    `tolerance_km`; the cells of the points of a feature are joined.

    Examples
    --------
    >>> import rondel
    >>> meridian = {"type": "LineString", "coordinates": [[0, -60], [0, 60]]}
    >>> place = {"type": "Point", "coordinates": [180, 0]}
    >>> rondel.feature_cells([meridian, place], 5).areas_km2().round(-5).tolist()
    [340000000.0, 170000000.0]

    """
    for name, value in (("tolerance_km", tolerance_km), ("radius_km", radius_km)):
        if not float(value) > 0:
            raise ValueError(f"{name} must be positive, not {float(value):g}")
    require_rules(edges, overlap, invalid)
    tolerance = float(tolerance_km) / float(radius_km)
    area = None if within is None else as_cell_set(within, edges, "keep", invalid, threads)._cells
    found, remarks = features_of(
        features,
        edges,
        lambda name: _core.feature_cells(
            name, tolerance, edges, overlap, invalid, area, as_threads(threads), progress
        ),
    )
    for remark in remarks:
        warn_caller(f"{os.fspath(features)}: {remark}" if is_file(features) else remark)
    return Regions._of(found, np.arange(found.num_cells), "feature")


def as_cell_set(
    regions: Any,
    edges: Edges,
    overlap: PolygonOverlap,
    invalid: Invalid,
    threads: int | None,
    groups: Groups = None,
) -> CellSet:
    """The regions as cells; polygons whose group is below 0 are left out."""
    if isinstance(regions, CellSet):
        return regions
    rules = edges, overlap, invalid, as_threads(threads), groups
    if is_file(regions):
        return CellSet._of(read_cells(os.fspath(regions), *rules))
    return CellSet._of(polygons_of(regions, *rules))


def _dissolved(
    rings: _core.CellRings, groups: Any, threads: int | None, progress: Progress
) -> Regions:
    numbers, labels = _numbered(groups, "groups")
    _require_size(numbers, rings.num_cells, "groups", "cells")
    joined = rings.dissolve(numbers, len(labels), as_threads(threads), progress)
    return Regions._of(joined, labels, "group")


def _require_size(numbers: Any, num_cells: int, what: str, of: str) -> None:
    if len(numbers) != num_cells:
        raise ValueError(f"there are {len(numbers)} {what} for {num_cells} {of}")


# The groups as numbers, -1 for none, and what each of them is.
def _numbered(groups: Any, what: str) -> tuple[Any, np.ndarray[Any, Any]]:
    given = groups.values if are_labeled(groups) else groups
    if getattr(given, "ndim", 1) != 1:
        raise ValueError(f"{what} must have shape (n,), not {given.shape}")
    if isinstance(given, np.ndarray) and given.dtype.kind in "mM":
        given = list(with_gaps(given))  # tolist() makes integers of nanoseconds
    values: Sequence[Hashable] = given.tolist() if hasattr(given, "tolist") else list(given)
    known: dict[Hashable, int] = {}
    numbers = np.full(len(values), -1, np.int32)
    for i, value in enumerate(values):
        if is_missing(value) or value != value:
            continue
        numbers[i] = known.setdefault(value, len(known))
    labels = np.empty(len(known), object)
    labels[:] = list(known)
    if known and len({type(value) for value in known}) == 1:
        plain = np.array(list(known))
        labels = plain if plain.ndim == 1 else labels
    return numbers, labels
