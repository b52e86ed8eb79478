# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Small files for first steps: weather stations, land and countries.

They come with the package, so that examples run without anything else. ``python -m rondel.data``
copies them to the folder ``data`` below the current one, where the examples of the guide for the
command line look for them.
"""

from __future__ import annotations

import csv
import json
import os
import pathlib
import shutil
import sys
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._types import FloatArray, Path

__all__ = ["Stations", "copy_to", "countries", "land", "path", "stations"]

FOLDER = pathlib.Path(__file__).parent / "samples"


def __dir__() -> list[str]:
    return list(__all__)


class Stations(NamedTuple):
    """Weather stations; entry i of each array belongs to station i.

    Attributes
    ----------
    id : ndarray of str, shape (n,)
        The codes of the stations, in alphabetical order.
    name : ndarray of str, shape (n,)
        Name, place and country, as the source has them.
    lon, lat : ndarray of float64, shape (n,)
        Longitudes and latitudes in degrees.

    """

    id: npt.NDArray[np.str_]
    name: npt.NDArray[np.str_]
    lon: FloatArray
    lat: FloatArray


def stations() -> Stations:
    """Reads 5,634 weather stations of the world.

    Three pairs of them share a place, and one is the South Pole, so that they show what happens to
    duplicates and at a pole.

    Returns
    -------
    Stations
        Codes, names, longitudes and latitudes.

    See Also
    --------
    path : the name of the file, for functions and commands that read files.

    Notes
    -----
    The stations report METAR. They are from Debian's package weather-util-data; where they come
    from, and their license (ISC), is in ``path("README.md")``.

    Examples
    --------
    >>> import rondel.data
    >>> stations = rondel.data.stations()
    >>> len(stations.lon)
    5634
    >>> tri = rondel.delaunay_lonlat(stations.lon, stations.lat)
    >>> str(stations.name[tri.nearest(rondel.unit_vectors(2.35, 48.86))])
    'Paris / Le Bourget, France'

    """
    with path("stations.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return Stations(
        np.array([row["id"] for row in rows]),
        np.array([row["name"] for row in rows]),
        np.array([float(row["longitude"]) for row in rows]),
        np.array([float(row["latitude"]) for row in rows]),
    )


def land() -> dict[str, Any]:
    """Reads the land of the Earth at a scale of 1:110 million.

    Returns
    -------
    dict
        A FeatureCollection of GeoJSON with one MultiPolygon, as `SphericalVoronoi.clip` and other
        functions take it.

    Notes
    -----
    The land is that of Natural Earth, which is in the public domain.

    Examples
    --------
    >>> import math
    >>> import rondel.data
    >>> share = rondel.area(rondel.data.land()) / (4 * math.pi)
    >>> print(f"{share[0]:.0%} of the Earth is land")
    29% of the Earth is land

    """
    return _geojson("land-110m.geojson")


def countries() -> dict[str, Any]:
    """Reads the countries of the Earth at a scale of 1:110 million.

    Returns
    -------
    dict
        A FeatureCollection of GeoJSON with 177 features, whose properties are ``name`` and ``id``
        (ISO 3166-1, three digits).

    Notes
    -----
    The countries are those of Natural Earth, which are in the public domain. They share their
    borders, but those of Sudan, South Sudan and Ethiopia overlap.

    Examples
    --------
    >>> import rondel.data
    >>> countries = rondel.data.countries()["features"]
    >>> largest = rondel.area(countries).argmax()
    >>> countries[largest]["properties"]["name"]
    'Russia'

    """
    return _geojson("countries-110m.geojson")


def path(name: str) -> pathlib.Path:
    """Returns where a file lies.

    Parameters
    ----------
    name : str
        ``"stations.csv"``, ``"land-110m.geojson"``, ``"countries-110m.geojson"`` or
        ``"README.md"``, which says where they come from.

    Returns
    -------
    pathlib.Path
        The file, which is to be read only.

    Raises
    ------
    FileNotFoundError
        If there is no such file. The message has the names of all files.

    Examples
    --------
    >>> import rondel.data
    >>> rondel.data.path("stations.csv").name
    'stations.csv'

    """
    found = FOLDER / name
    if pathlib.PurePath(name).name != name or not found.is_file():
        raise FileNotFoundError(f"there is no sample {name!r}, but {', '.join(_names())}")
    return found


def copy_to(folder: Path) -> list[pathlib.Path]:
    """Copies the files into a folder, which is made if there is none.

    Parameters
    ----------
    folder : path-like
        Where to put them.

    Returns
    -------
    list of pathlib.Path
        The copies.

    Raises
    ------
    FileExistsError
        If the folder has a file of one of the names with another content. Then nothing is copied.

    Examples
    --------
    >>> import rondel.data, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [copy.name for copy in rondel.data.copy_to(folder)]
    ['README.md', 'countries-110m.geojson', 'land-110m.geojson', 'stations.csv']

    """
    target = pathlib.Path(os.fsdecode(folder))
    copies = [target / name for name in _names()]
    for copy in copies:
        if copy.exists() and copy.read_bytes() != path(copy.name).read_bytes():
            raise FileExistsError(f"{copy} has another content than the sample; nothing was copied")
    target.mkdir(parents=True, exist_ok=True)
    for copy in copies:
        shutil.copyfile(path(copy.name), copy)
    return copies


def _names() -> list[str]:
    return sorted(file.name for file in FOLDER.iterdir())


def _geojson(name: str) -> dict[str, Any]:
    with path(name).open(encoding="utf-8") as file:
        return json.load(file)


def _main(arguments: list[str]) -> int:
    """Runs ``python -m rondel.data [FOLDER]``."""
    if len(arguments) > 1 or (arguments and arguments[0].startswith("-")):
        print("usage: python -m rondel.data [FOLDER]     copies the sample files to FOLDER (data)")
        return 0 if arguments in (["-h"], ["--help"]) else 2
    try:
        for copy in copy_to(arguments[0] if arguments else "data"):
            print(copy)
    except OSError as error:
        print(f"rondel.data: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(_main(sys.argv[1:]))
