# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations and diagrams for other libraries: GeoJSON, GeoPandas, xarray (UGRID)."""

from __future__ import annotations

import io
import json
import os
import shutil
from collections.abc import Callable
from contextlib import suppress
from typing import IO, TYPE_CHECKING, Any, TypeAlias, overload

import numpy as np

from . import _core, _ugrid
from ._arrays import as_name, degrees_of
from ._properties import checked_properties, frame_column, json_columns, with_gaps
from ._types import Divided, FloatArray, IntArray, Properties, Triangulated

if TYPE_CHECKING:
    import geopandas
    import xarray

Path: TypeAlias = "str | os.PathLike[str]"
File: TypeAlias = "io.IOBase | IO[str] | IO[bytes]"  # open for writing


class TriangleShapes:
    """Conversions of triangulations: methods of `SphericalDelaunay`."""

    @overload
    def to_geojson(self: Triangulated, path: None = None) -> dict[str, Any]: ...
    @overload
    def to_geojson(self: Triangulated, path: Path | File) -> None: ...
    def to_geojson(self: Triangulated, path: Path | File | None = None) -> Any:
        """The faces as GeoJSON (RFC 7946): counterclockwise, cut at the antimeridian, poles closed.

        A feature for each solid face, with the property `sites`, the indices of its corners.

        Parameters
        ----------
        path : path-like or file object, text or binary, optional
            Where to write the text; otherwise it is returned, parsed.

        Returns
        -------
        dict or None

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        return written(
            path, lambda name: _core.write_triangles(name, self._triangulation, self.points)
        )

    def to_geopandas(self: Triangulated) -> geopandas.GeoDataFrame:
        """The solid faces as a GeoDataFrame in longitudes and latitudes (EPSG:4326).

        Returns
        -------
        geopandas.GeoDataFrame
            The polygons of `to_geojson`. The index is the face; the columns `site_0`, `site_1` and
            `site_2` are its corners. Polygons that cross the antimeridian are multipolygons, cut
            there.

        Raises
        ------
        ImportError
            If GeoPandas is not installed.

        """
        faces = np.flatnonzero(~self.ghost)
        corners = self.simplices[faces]
        columns = {f"site_{k}": corners[:, k] for k in range(3)}
        return _frame(columns, _core.face_polygons(self._triangulation), faces)

    def to_xarray(self: Triangulated) -> xarray.Dataset:
        """The triangulation as a UGRID mesh: sites are nodes, solid triangles faces.

        Returns
        -------
        xarray.Dataset
            With the UGRID 1.0 conventions; ``uxarray.Grid.from_dataset`` opens it.

        Raises
        ------
        ImportError
            If xarray is not installed.

        """
        return _mesh_of("Delaunay triangulation", self.lonlat, self.simplices[~self.ghost])


class CellShapes:
    """Conversions of diagrams: methods of `SphericalVoronoi` and `PowerDiagram`."""

    @overload
    def to_geojson(
        self: Divided,
        path: None = None,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
    ) -> dict[str, Any]: ...
    @overload
    def to_geojson(
        self: Divided,
        path: Path | File,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
    ) -> None: ...
    def to_geojson(
        self: Divided,
        path: Path | File | None = None,
        *,
        properties: Properties | None = None,
        tolerance_deg: float = 0.01,
    ) -> Any:
        """The cells as GeoJSON (RFC 7946): counterclockwise, cut at the antimeridian, poles closed.

        A feature for each cell, with the properties `site` (its index) and `area` (steradians).

        Parameters
        ----------
        path : path-like or file object, text or binary, optional
            Where to write the text; otherwise it is returned, parsed.
        properties : mapping of str to sequence, optional
            More properties: for each a value for every site. Numbers, booleans, texts and what else
            JSON has stay what they are; None, nan, what is masked and, with a warning, infinities
            are null, dates ISO 8601 texts. No property is called `site` or `area`.
        tolerance_deg : float, optional
            How far the straight lines of a polygon may be from its arcs, in degrees.

        Returns
        -------
        dict or None

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        values = checked_properties(properties, ("site", "area"), len(self.points), as_json=True)
        columns = json_columns(values)
        cells = self.delaunay._triangulation, self.points, self._diagram
        return written(
            path, lambda name: _core.write_cells(name, *cells, columns, float(tolerance_deg))
        )

    def to_geopandas(
        self: Divided, *, properties: Properties | None = None, tolerance_deg: float = 0.01
    ) -> geopandas.GeoDataFrame:
        """The cells as a GeoDataFrame in longitudes and latitudes (EPSG:4326).

        Parameters
        ----------
        properties : mapping of str to sequence, optional
            More columns: for each a value for every site. They keep their types. None of them is
            called `site`, `area` or `geometry`.
        tolerance_deg : float, optional
            How far the straight lines of a polygon may be from its arcs, in degrees.

        Returns
        -------
        geopandas.GeoDataFrame
            The polygons of `to_geojson`, with the columns `site` (also the index) and `area`
            (steradians). Polygons that cross the antimeridian are multipolygons, cut there.

        Raises
        ------
        ImportError
            If GeoPandas is not installed.

        """
        given = checked_properties(properties, ("site", "area", "geometry"), len(self.points))
        sites = self.delaunay.vertices
        columns: dict[str, Any] = {"site": sites, "area": self._diagram.areas[sites]}
        for name, values in given.items():
            columns[name] = frame_column(values)[sites]
        polygons = _core.cell_polygons(
            self.delaunay._triangulation, self._diagram, float(tolerance_deg)
        )
        return _frame(columns, polygons, sites)

    def to_xarray(self: Divided, *, properties: Properties | None = None) -> xarray.Dataset:
        """The diagram as a UGRID mesh: corners of cells are nodes, cells are faces.

        Parameters
        ----------
        properties : mapping of str to sequence, optional
            More variables of faces: for each a value for every site. What is masked is NaN, NaT or
            None.

        Returns
        -------
        xarray.Dataset
            With the UGRID 1.0 conventions; ``uxarray.Grid.from_dataset`` opens it. Faces are in the
            order of sites. Sites without a cell, as duplicates, have no face: the variable `site`
            says whose each face is. `face_lon` and `face_lat` are the sites, `face_area` the areas
            in steradians. Cells have different numbers of corners, and rows are filled up with -1.

        Raises
        ------
        ImportError
            If xarray is not installed.

        """
        offsets, rings, points = self.cells
        sizes = np.diff(offsets)
        sites = np.flatnonzero(sizes)
        faces = np.full((len(sites), sizes.max(initial=3)), -1, np.int32)
        faces[np.arange(faces.shape[1]) < sizes[sites, None]] = rings
        mesh = _mesh_of("Voronoi diagram", degrees_of(points, self.center), faces)
        taken = tuple(map(str, mesh.variables))
        given = checked_properties(
            properties, (*taken, "site", "face_lon", "face_lat", "face_area"), len(self.points)
        )
        _add_positions(mesh, "face", self.delaunay.lonlat[sites])
        face = _ugrid.values_at("face")
        about = _ugrid.values_at("face", "site of the cell")
        mesh["site"] = ("n_face", sites.astype(np.int32), about)
        about = {**_ugrid.values_at("face", "area of the cell"), "units": "sr"}
        mesh["face_area"] = ("n_face", self._diagram.areas[sites], about)
        mesh["face_area"].encoding["_FillValue"] = None
        for name, values in given.items():
            mesh[name] = ("n_face", with_gaps(values)[sites], face)
        return mesh


def written(path: Path | File | None, write: Callable[[str | None], bytes | None]) -> Any:
    """What `write` makes, bytes of GeoJSON for None: in the file, or parsed."""
    if isinstance(path, (str, os.PathLike)):
        name = as_name(path)
        if not name.endswith(".geojson"):
            raise ValueError(f"the name of a GeoJSON file ends in .geojson: {name}")
        write(name)
        return None
    text = write(None) or b""
    if path is None:
        # A function is called for each object, so that Ctrl-C ends the reading.
        return json.loads(text, object_hook=lambda found: found)
    file: Any = path
    content: Any = io.BytesIO(text)
    with suppress(TypeError):  # of a binary file
        file.write("")
        content = io.TextIOWrapper(content, "utf-8", newline="")
    shutil.copyfileobj(content, file)
    return None


def _frame(columns: dict[str, Any], polygons: Any, rows: Any) -> geopandas.GeoDataFrame:
    """The same for polygons of one ring each."""
    return polygon_frame(columns, polygons, np.arange(len(polygons.rings)), rows)


def polygon_frame(
    columns: dict[str, Any], polygons: Any, parts: Any, rows: Any
) -> geopandas.GeoDataFrame:
    """A GeoDataFrame with a row for each owner of polygons, and for those that have none; `parts`
    are the offsets of the polygons' rings.
    """
    import geopandas

    row = np.searchsorted(rows, polygons.owners)
    geometry = polygon_shapes(polygons.positions, polygons.rings, parts, row, len(rows))
    return geopandas.GeoDataFrame(columns, geometry=geometry, index=rows, crs="EPSG:4326")


def polygon_shapes(
    positions: FloatArray, rings: Any, parts: Any, owners: IntArray, number: int
) -> np.ndarray[Any, Any]:
    """A polygon or multipolygon of shapely for each owner of polygons, None for those of `number`
    that have none; `rings` are offsets of positions, `parts` those of the polygons' rings.
    """
    import shapely

    made = shapely.from_ragged_array(shapely.GeometryType.POLYGON, positions, (rings, parts))
    is_single = np.bincount(owners, minlength=number)[owners] == 1
    shapes = np.full(number, None)
    shapes[owners[is_single]] = made[is_single]
    several, part = np.unique(owners[~is_single], return_inverse=True)
    shapes[several] = shapely.multipolygons(made[~is_single], indices=part)
    return shapes


def arrow_of(cells: _core.CellRings, drawing: str) -> tuple[Any, Any]:
    """The capsules of a schema and an array of geoarrow.multipolygon with the polygons of cells."""
    drawn = cells.polygons(0.01, 0, drawing)
    # Straight lines are right everywhere; a side from pole to pole is no arc.
    return _core.capsules_of(drawn, cells.num_cells, "lonlat")


def _mesh_of(title: str, nodes: FloatArray, faces: IntArray) -> xarray.Dataset:
    """A Dataset by UGRID 1.0: a topology, the positions of nodes, the corners of faces."""
    import xarray

    name = "face_node_connectivity"
    topology = {**_ugrid.topology(name), "topology_dimension": np.int32(2)}
    numbers = {"start_index": np.int32(0), "_FillValue": np.int32(-1)}
    corners = {**_ugrid.CORNERS, **numbers}
    mesh = xarray.Dataset(
        {
            "mesh": ((), np.int32(0), topology),
            name: (("n_face", "n_max_face_nodes"), faces, corners),
        },
        attrs=_ugrid.about(title),
    )
    _add_positions(mesh, "node", nodes)
    return mesh


def _add_positions(mesh: Any, what: str, degrees: FloatArray) -> None:
    """The longitudes and latitudes of the nodes or the faces."""
    for column, (name, says) in enumerate(_ugrid.angles(what).items()):
        mesh[name] = (f"n_{what}", np.array(degrees[:, column]), says)
        mesh[name].encoding["_FillValue"] = None  # every place is known
    mesh["mesh"].attrs[f"{what}_coordinates"] = f"{what}_lon {what}_lat"
