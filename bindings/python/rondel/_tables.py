# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations and diagrams in files of other libraries: NetCDF (UGRID) and Parquet."""

from __future__ import annotations

import contextlib
import errno
import importlib.util
import itertools
import os
from collections.abc import Callable, Iterator
from typing import Any, Literal

import numpy as np

from ._geo import Path
from ._properties import checked_properties
from ._types import Divided, Properties, Triangulated

_numbers = itertools.count()
_ROWS = 1 << 20  # of a row group


class TriangleTables:
    """Files of triangulations: methods of `SphericalDelaunay`."""

    def to_netcdf(self: Triangulated, path: Path) -> None:
        """Writes the Dataset of `to_xarray`, a UGRID mesh, as a file of NetCDF 4.

        Parameters
        ----------
        path : path-like
            A file appears when it is complete, and replaces the one that is there.

        Raises
        ------
        ImportError
            If xarray is not installed, or neither netCDF4 nor h5netcdf is.
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        _write_netcdf(path, self.to_xarray())

    def to_parquet(
        self: Triangulated, path: Path, *, table: Literal["faces", "sites"] = "faces"
    ) -> None:
        """Writes a table of the faces, or of the sites, as a file of Parquet.

        Parameters
        ----------
        path : path-like
            A file appears when it is complete, and replaces the one that is there.
        table : {'faces', 'sites'}, optional
            All faces, in their order: the corners `site_0`, `site_1`, `site_2`, the faces opposite
            to them, `neighbor_0` ..., and `ghost`. Or all sites, in their order: `lon`, `lat`
            (degrees), `x`, `y`, `z`, `representative` (of a duplicate the site in its place that
            stands for it, else the site itself) and `vertex`, whether it is one.

        Raises
        ------
        ImportError
            If pyarrow is not installed.
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        columns: dict[str, Any]
        if table == "faces":
            columns = {f"site_{k}": self.simplices[:, k] for k in range(3)}
            columns |= {f"neighbor_{k}": self.neighbors[:, k] for k in range(3)}
            columns["ghost"] = self.ghost
        elif table == "sites":
            columns = dict(zip(("lon", "lat"), self.lonlat.T, strict=True))
            columns |= dict(zip("xyz", self.points.T, strict=True))
            representative = np.arange(len(self.points), dtype=np.int32)
            representative[self.duplicates[:, 0]] = self.duplicates[:, 1]
            vertex = np.zeros(len(self.points), bool)
            vertex[self.vertices] = True
            columns |= {"representative": representative, "vertex": vertex}
        else:
            raise ValueError(f"table is {table!r}, which is neither 'faces' nor 'sites'")
        _write_parquet(path, len(self.simplices if table == "faces" else self.points), columns)


class CellTables:
    """Files of diagrams: methods of `SphericalVoronoi` and `PowerDiagram`."""

    def to_netcdf(self: Divided, path: Path, *, properties: Properties | None = None) -> None:
        """Writes the Dataset of `to_xarray`, a UGRID mesh, as a file of NetCDF 4.

        Parameters
        ----------
        path : path-like
            A file appears when it is complete, and replaces the one that is there.
        properties : mapping of str to sequence, optional
            More variables of faces: for each a value for every site.

        Raises
        ------
        ImportError
            If xarray is not installed, or neither netCDF4 nor h5netcdf is.
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        _write_netcdf(path, self.to_xarray(properties=properties))

    def to_parquet(self: Divided, path: Path, *, properties: Properties | None = None) -> None:
        """Writes a table of the cells, without their polygons, as a file of Parquet.

        With polygons it is GeoParquet: ``to_geopandas().to_parquet(path)``.

        Parameters
        ----------
        path : path-like
            A file appears when it is complete, and replaces the one that is there. Its columns are
            `site`, `lon` and `lat` of the site in degrees, and `area` in steradians; duplicates and
            hidden sites have no row.
        properties : mapping of str to sequence, optional
            More columns: for each a value for every site. They keep their types.

        Raises
        ------
        ImportError
            If pyarrow is not installed.
        OSError
            If the file cannot be written; then nothing is left of it.

        """
        import pyarrow

        given = checked_properties(properties, ("site", "lon", "lat", "area"), len(self.points))
        sites = self.delaunay.vertices
        lon, lat = self.delaunay.lonlat[sites].T
        columns = {"site": sites, "lon": lon, "lat": lat, "area": self._diagram.areas[sites]}
        for name, values in given.items():
            columns[name] = pyarrow.array(values, from_pandas=True).take(pyarrow.array(sites))
        _write_parquet(path, len(sites), columns)


def _write_netcdf(path: Path, mesh: Any) -> None:
    known = ("netCDF4", "h5netcdf")
    found = [library for library in known if importlib.util.find_spec(library)]
    if not found:
        raise ImportError("NetCDF is written by netCDF4 or h5netcdf: install one of them")
    with _replaced(path) as name:
        mesh.to_netcdf(name, engine=found[0].lower(), format="NETCDF4")


def _write_parquet(path: Path, num_rows: int, columns: dict[str, Any]) -> None:
    """A row group at a time, so that nothing is copied as a whole."""
    import pyarrow
    import pyarrow.parquet

    def rows(begin: int) -> Any:
        return pyarrow.table(
            {name: column[begin : begin + _ROWS] for name, column in columns.items()}
        )

    first = rows(0)
    with _replaced(path) as name, pyarrow.parquet.ParquetWriter(name, first.schema) as writer:
        for begin in range(0, num_rows, _ROWS):
            writer.write_table(rows(begin) if begin else first)


@contextlib.contextmanager
def _replaced(path: Path) -> Iterator[str]:
    """A file to write, which gets its name when all is done; of what fails nothing is left."""
    target = os.path.realpath(os.fspath(path))
    if os.path.isdir(target):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), os.fspath(path))
    folder = os.path.dirname(target)
    name = os.path.join(folder, f".rondel-{os.getpid()}-py{next(_numbers)}.tmp")

    def told(work: Callable[[], Any]) -> None:
        try:
            work()
        except OSError as error:
            raise OSError(error.errno, error.strerror, os.fspath(path)) from None

    mode = os.stat(target).st_mode & 0o777 if os.path.exists(target) else 0o666
    flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY
    told(lambda: os.close(os.open(name, flags, mode)))
    try:
        yield name
        told(lambda: os.replace(name, target))
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise
