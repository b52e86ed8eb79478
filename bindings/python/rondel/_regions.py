# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Cells of regions: clipped by polygons, and joined by group."""

from __future__ import annotations

import io
import os
from collections.abc import Hashable, Sequence
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from . import _core
from ._arrays import as_threads
from ._geo import Path, Properties, polygon_frame, written
from ._geometries import (
    Edges,
    Groups,
    PolygonOverlap,
    features_of,
    is_file,
    polygons_of,
    read_polygons,
)
from ._partition import Partition
from ._plot import plot_regions
from ._properties import checked_properties, is_missing, json_cells
from ._repr import Described, count
from ._types import ArrayLike, Divided, FloatArray, Progress

if TYPE_CHECKING:
    import geopandas


EARTH_RADIUS_KM = 6371.0088  # the mean of WGS 84, (2 a + b) / 3
AREA_NAMES = ("area", "area_km2")


class Regions(Described):
    """Polygons with holes on the sphere: cells that were clipped, or joined.

    `SphericalVoronoi.clip`, `dissolve` and those of `PowerDiagram` make them, and `feature_cells`.

    Attributes
    ----------
    labels : ndarray
        What each region is: of clipped cells the site, of joined ones the group, of those of lines
        and polygons the feature.
    values : ndarray or None
        Of cells that were cut by the value of polygons, that value.

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

    def __len__(self) -> int:
        return self._rings.num_cells

    @property
    def areas(self) -> FloatArray:
        """Ndarray of float64, shape (n,): steradians; 0 where nothing is left."""
        return self._rings.areas()

    def areas_km2(self, radius_km: float = EARTH_RADIUS_KM) -> FloatArray:
        """The areas on a sphere of this radius, by default the Earth's mean one (WGS 84).

        Raises
        ------
        ValueError
            If the radius is not positive, or the sphere's area is no finite number.

        """
        radius_km = float(radius_km)
        squared = radius_km * radius_km
        if not (radius_km > 0 and np.finfo(float).tiny <= 4 * np.pi * squared < np.inf):
            raise ValueError(f"radius_km is {radius_km}, not positive with a finite area")
        return self.areas * squared

    def partition(self, *, threads: int | None = None) -> Partition:
        """The regions as cells, to be laid over others by `remap`."""
        return Partition._of(self._rings.partition(as_threads(threads)))

    def dissolve(
        self, groups: ArrayLike, *, threads: int | None = None, progress: Progress = None
    ) -> Regions:
        """Regions joined by group.

        Parameters
        ----------
        groups : sequence, shape (n,)
            As in `SphericalVoronoi.dissolve`.
        threads : int, optional
        progress : callable, optional

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
        path: Path | io.IOBase,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
        radius_km: float | None = None,
    ) -> None: ...
    def to_geojson(
        self,
        path: Path | io.IOBase | None = None,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
        radius_km: float | None = None,
    ) -> Any:
        """The regions as GeoJSON (RFC 7946): counterclockwise, cut at the antimeridian, with holes.

        A feature for each region that has an area, with the properties `area` (steradians) and
        `site`, `group` or `feature`, and `value` if there are any.

        Parameters
        ----------
        path : path-like or file object, optional
            Where to write the text; otherwise it is returned, parsed.
        properties : mapping of str to sequence, optional
            More properties: for each a value for every region.
        tolerance_deg : float, optional
            How far the straight lines of a polygon may be from its arcs, in degrees.
        radius_km : float, optional
            Adds areas on a sphere of this radius, `area_km2`; the Earth's mean radius is 6371.0088.

        Returns
        -------
        dict or None

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        values = checked_properties(properties, (*self._own, *AREA_NAMES), len(self))
        named = {**self._own, **values}
        if radius_km is not None:
            named["area_km2"] = self.areas_km2(radius_km)
        columns = [(name, json_cells(column)) for name, column in named.items()]
        tolerance = float(tolerance_deg)
        return written(path, lambda name: self._rings.write(name, columns, tolerance))

    def to_geopandas(
        self,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
        radius_km: float | None = None,
    ) -> geopandas.GeoDataFrame:
        """The regions as a GeoDataFrame in longitudes and latitudes (EPSG:4326).

        Its `to_file` and `to_parquet` write GeoPackage, FlatGeobuf, shapefiles and GeoParquet.

        Parameters
        ----------
        properties : mapping of str to sequence, optional
            More columns: for each a value for every region.
        tolerance_deg : float, optional
            How far the straight lines of a polygon may be from its arcs, in degrees.
        radius_km : float, optional
            Adds areas on a sphere of this radius, `area_km2`; the Earth's mean radius is 6371.0088.

        Returns
        -------
        geopandas.GeoDataFrame
            A row for each region that has an area, with the columns `site`, `group` or `feature`,
            `value` if there are any, and `area` (steradians). The index is the number of the
            region.

        Raises
        ------
        ImportError
            If GeoPandas is not installed.

        """
        import pandas

        given = checked_properties(properties, (*self._own, *AREA_NAMES, "geometry"), len(self))
        polygons = self._rings.polygons(float(tolerance_deg), 0)
        owners = polygons[3]
        rows = owners[np.diff(owners, prepend=-1) > 0]
        columns: dict[str, Any] = {name: labels[rows] for name, labels in self._own.items()}
        columns["area"] = self.areas[rows]
        if radius_km is not None:
            columns["area_km2"] = self.areas_km2(radius_km)[rows]
        for name, values in given.items():
            columns[name] = pandas.Series(values).array[rows]
        return polygon_frame(columns, polygons, rows)

    plot = plot_regions

    @property
    def _own(self) -> dict[str, Any]:
        named = {self._kind: self.labels}
        return named if self.values is None else {**named, "value": self.values}

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        return self.to_geojson()

    def _facts(self) -> list[tuple[str, str]]:
        empty = int(np.count_nonzero(self.areas == 0))
        facts = [("regions", count(len(self), "region"))]
        if empty:
            facts.append(("empty", f"{empty:,} empty"))
        return facts


def clip_cells(
    self: Divided,
    regions: Any,
    *,
    values: ArrayLike | None = None,
    edges: Edges = "lonlat",
    overlap: Literal["error", "first"] = "error",
    threads: int | None = None,
    progress: Progress = None,
) -> Regions:
    """The parts of the cells that lie in regions: on land, in a country, within a border.

    Parameters
    ----------
    regions : path-like, geometries or Partition
        A file of GeoJSON; a GeoDataFrame or GeoSeries; a geometry of shapely, a mapping of
        GeoJSON, whatever has `__geo_interface__`, or a sequence of these; a box of west, south,
        east and north in degrees; or a partition.
    values : sequence, one for each of `regions`, optional
        Names of countries, kinds of soil: cells are cut where these change. None, NaN and NA: what
        is there is left out.
    edges : {'lonlat', 'geodesic'}, optional
        What joins positions of polygons: straight lines in longitude and latitude (RFC 7946), or
        great circles.
    overlap : {'error', 'first'}, optional
        What becomes of a place that several of the regions have, if there are `values`: it is
        refused with two of them, or it belongs to the first one. Without values that makes no
        difference.
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    Regions
        One for each site, empty where nothing is left; with `values` one for each site and value
        that have something in common, sorted by site. Which lines cross is decided exactly;
        where two parts meet they have the same corners, bit by bit.

    Raises
    ------
    ValueError
        If a geometry is no polygon, not valid, or no place on the sphere, or geometries with values
        overlap.
    OSError
        If the file cannot be read.

    """
    cells = Partition.voronoi(self, threads=threads)._partition
    shared: PolygonOverlap = "keep" if values is None else overlap  # clip() unites
    if values is None:
        within = as_partition(regions, edges, shared, threads)._partition
        found = _core.clip(cells, within, as_threads(threads), progress)
        return Regions._of(found, np.arange(len(self.points)), "site")
    numbers, names = _numbered(values)
    within = as_partition(regions, edges, shared, threads, numbers)._partition
    _require_size(numbers, within.num_cells, "values", "regions")
    found, sites, groups = _core.intersection(cells, within, numbers, as_threads(threads), progress)
    return Regions._of(found, sites, "site", names[groups])


def dissolve_cells(
    self: Divided, groups: ArrayLike, *, threads: int | None = None, progress: Progress = None
) -> Regions:
    """The cells joined by group: by country, office, nearest airport.

    Parameters
    ----------
    groups : sequence, shape (n,)
        The group of each site: numbers, texts, or what else has a hash. None, NaN and NA: none.
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    Regions
        One for each group, in the order in which they come; `labels` are the groups. Two that
        meet have the same corners there, bit by bit.

    """
    rings = _core.cell_rings(Partition.voronoi(self, threads=threads)._partition)
    return _dissolved(rings, groups, threads, progress)


def feature_cells(
    features: Any,
    tolerance_km: float,
    *,
    radius_km: float = EARTH_RADIUS_KM,
    edges: Edges = "lonlat",
    overlap: Literal["error", "first"] = "error",
    within: Any = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Regions:
    """The Voronoi cells of lines, polygons and points: to which of them places are nearest.

    Parameters
    ----------
    features : path-like or geometries
        A file of GeoJSON; a GeoDataFrame or GeoSeries; geometries of shapely, mappings of GeoJSON,
        or whatever has `__geo_interface__`.
    tolerance_km : float
        A place belongs to a feature that is at most so much farther than the nearest one. What is
        in a polygon belongs to it, exactly.
    radius_km : float, optional
        Of the sphere on which that is measured.
    edges : {'lonlat', 'geodesic'}, optional
        What joins positions: straight lines in longitude and latitude (RFC 7946), or great circles.
    overlap : {'error', 'first'}, optional
        What becomes of a place that several polygons have: it is refused with two of them, or it
        belongs to the first one.
    within : path-like, geometries or Partition, optional
        Regions to which the cells are cut, as `SphericalVoronoi.clip` takes them.
    threads : int, optional
    progress : callable, optional

    Returns
    -------
    Regions
        One for each feature; `labels` are their numbers. A feature has an area of 0 if it has no
        place, or if features before it have all of its places. A single one that is not cut has
        no border.

    Raises
    ------
    ValueError
        If something is no geometry, polygons are not valid or overlap, or the tolerance is not
        positive.
    OSError
        If the file cannot be read.

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
    tolerance = float(tolerance_km) / float(radius_km)
    area = None if within is None else as_partition(within, edges, "keep", threads)._partition
    found = features_of(
        features,
        edges,
        overlap,
        lambda name, is_geodesic, rule: _core.feature_cells(
            name, tolerance, is_geodesic, rule, area, as_threads(threads), progress
        ),
    )
    return Regions._of(found, np.arange(found.num_cells), "feature")


def as_partition(
    regions: Any,
    edges: Edges,
    overlap: PolygonOverlap,
    threads: int | None,
    groups: Groups = None,
) -> Partition:
    """The regions as a partition; polygons whose group is below 0 are left out."""
    if isinstance(regions, Partition):
        return regions
    rules = edges, overlap, as_threads(threads), groups
    if not is_file(regions):
        return Partition._of_polygons(polygons_of(regions, *rules))
    name = os.fspath(regions)
    if name.lower().endswith((".geojson", ".json")):
        return Partition._of_polygons(read_polygons(name, *rules))
    return Partition.read(regions, edges=edges, overlap=overlap, threads=threads)


def _dissolved(
    rings: _core.CellRings, groups: Any, threads: int | None, progress: Progress
) -> Regions:
    numbers, labels = _numbered(groups)
    _require_size(numbers, rings.num_cells, "groups", "cells")
    joined = rings.dissolve(numbers, len(labels), as_threads(threads), progress)
    return Regions._of(joined, labels, "group")


def _require_size(numbers: Any, num_cells: int, what: str, of: str) -> None:
    if len(numbers) != num_cells:
        raise ValueError(f"there are {len(numbers)} {what} for {num_cells} {of}")


# The groups as numbers, -1 for none, and what each of them is.
def _numbered(groups: Any) -> tuple[Any, np.ndarray[Any, Any]]:
    values: Sequence[Hashable] = groups.tolist() if hasattr(groups, "tolist") else list(groups)
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
