# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The share of the sphere that belongs to each point, as its weight."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._arrays import as_floats, by_names
from ._delaunay import SphericalDelaunay, delaunay_lonlat
from ._diagram import Cells
from ._errors import InvalidInput
from ._types import ArrayLike, FloatArray, IntArray, Progress
from ._voronoi import SphericalVoronoi

# A cell is at a border if it reaches this many times as far as its corners do when their mirror
# images must lie in the cell too (in a lattice just as far, also if cells are long), and this many
# times as far as the spacing around it. About one in 50,000 cells of random sites does both.
BORDER_RATIO = 3.0
# Beside such a cell this much is enough, for borders are jagged.
BESIDE_RATIO = 1.5

# A pole may have any number of neighbors, and its cell as many corners: so many of them, evenly
# along its border, tell what all do. Corners are looked at in blocks, which bounds the memory.
MOST_CORNERS = 16
BLOCK = 1 << 16


def area_weights(
    lat: ArrayLike,
    lon: ArrayLike,
    *,
    edge: Any = "sphere",
    normalize: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> FloatArray:
    """Computes a weight for each point: the area of its Voronoi cell on the sphere.

    Such weights turn sums over points into integrals over the sphere or a domain; graphs of
    weather models have them as an attribute of their nodes.

    Parameters
    ----------
    lat, lon : array_like, shape (...)
        Latitudes and longitudes of the points in degrees, broadcast against each other as in
        `unit_vectors`. Latitudes, from -90 to 90, come first.
    edge : {'sphere', 'mirror'} or regions, optional
        What a cell is at the border of a domain. 'sphere' (default): cells are not cut, so that
        they cover the sphere; right for points all over the globe. 'mirror': the cell of a point
        at a border is cut as if each of its neighbors had a mirror image on the opposite side of
        the point, so that it is about as large as the cells further inside. Anything else is a
        domain that cells are clipped to, as in `SphericalVoronoi.clip`: a box of west, south, east
        and north, polygons, a file or a `CellSet`; the areas add up to that of the domain.
    normalize : bool, optional
        Whether the weights are divided by their sum, which is then 1. By default they are areas in
        steradians.
    threads, progress
        As in `delaunay`.

    Returns
    -------
    ndarray of float64, shape (...)
        The weights. Points in the same place have equal shares of their cell.

    Raises
    ------
    InvalidInput
        If an angle is not finite or a latitude is outside [-90, 90]; its `index` is the first bad
        point. If the weights cannot be normalized because no point has an area.
    ValueError
        If the shapes do not fit, there is no such `edge`, or a domain is not valid.

    Notes
    -----
    The diagram is exact and areas are those of `SphericalVoronoi.areas`. With 'mirror', a cell is
    at a border if it reaches, from its point, more than three times as far as the spacing, and more
    than three times as far as its corners do when each is moved towards the point until its mirror
    image lies in the cell too. The spacing is the largest distance that the point or one of its
    neighbors has to the second nearest point. Beside such cells half as much is enough. That finds
    borders of any shape and holes, and leaves alone lattices of any aspect ratio, rows near a pole,
    and random points but for about one in 10,000. Where fine and coarse grids meet it may cut some
    cells: 'sphere' is for all grids that cover the globe.

    A cell that is cut is the intersection of the Voronoi cell with its image under half a turn
    about the point; it never overlaps others. Cells of lattices keep the size that they have
    inside, at sides and corners too; the sum over a part of a Gaussian, HEALPix, cubed-sphere or
    ICON grid is within 1 percent of that of its cells.

    Examples
    --------
    >>> import numpy as np, rondel
    >>> lat, lon = np.arange(45, 50)[:, None], np.arange(0, 10)
    >>> weights = rondel.area_weights(lat, lon, edge="mirror")
    >>> weights.shape
    (5, 10)
    >>> bool(abs(weights[0, 0] / weights[0, 5] - 1) < 0.01)  # a corner of the domain
    True
    >>> float((rondel.area_weights(lat, lon).sum() / np.pi).round(12))  # the whole sphere
    4.0
    >>> rondel.area_weights([90, 0, 0, -90, -90], [0, 0, 180, 0, 7], normalize=True).tolist()
    [0.25, 0.25, 0.25, 0.125, 0.125]

    """
    if isinstance(edge, str) and edge not in ("sphere", "mirror"):
        hint = "a path of a file is a pathlib.Path"
        raise ValueError(f"edge must be 'sphere', 'mirror' or regions, not {edge!r}; {hint}")
    lon, lat = by_names(lon, lat)
    lats, lons = as_floats(lat, "lat"), as_floats(lon, "lon")
    lats, lons = np.broadcast_arrays(lats, lons)
    if lats.size == 0:
        return np.zeros(lats.shape)
    tri = delaunay_lonlat(lons, lats, threads=threads, progress=progress)
    diagram = SphericalVoronoi._from_delaunay(tri)
    if isinstance(edge, str):
        areas = diagram.areas.copy()
        if edge == "mirror":
            _cut_at_borders(areas, tri, diagram.cells)
    else:
        areas = diagram.clip(edge, threads=threads, progress=progress).areas.copy()
    _share(areas, tri.duplicates)
    if normalize:
        total = areas.sum()
        if total == 0:
            raise InvalidInput("no point has an area, so that weights cannot be normalized")
        areas /= total
    return areas.reshape(lats.shape)


def _share(areas: FloatArray, duplicates: IntArray) -> None:
    """Gives points in the same place equal parts of the cell that the first of them has."""
    if len(duplicates) == 0:
        return
    members = np.bincount(duplicates[:, 1], minlength=len(areas)) + 1
    areas /= members
    areas[duplicates[:, 0]] = areas[duplicates[:, 1]]


def _cut_at_borders(areas: FloatArray, tri: SphericalDelaunay, cells: Cells) -> None:
    """Replaces the areas of cells at borders by those of their symmetric parts."""
    starts, neighbors = tri.vertex_neighbor_vertices
    for site in _border_sites(tri.points, starts, neighbors, cells):
        point = tri.points[site]
        others = tri.points[neighbors[starts[site] : starts[site + 1]]]
        images = _dot(others, point)[:, None] * (2 * point) - others
        around = np.concatenate([point[None], others, images])
        areas[site] = SphericalVoronoi(around, duplicates="merge", threads=1).areas[0]


def _border_sites(
    points: FloatArray, starts: npt.NDArray[np.int64], neighbors: IntArray, cells: Cells
) -> IntArray:
    """The sites whose cells reach much farther than the part that is symmetric about the site."""
    owners = np.repeat(np.arange(len(points)), np.diff(cells.offsets))
    corners = cells.points[cells.rings]
    reach = np.zeros(len(points))
    np.maximum.at(reach, owners, _distance(corners, points[owners]))
    spacing = _spacing(points, starts, neighbors)
    suspects = np.flatnonzero((np.diff(starts) > 0) & (reach > BESIDE_RATIO * spacing))
    rows, of_row = _rows(suspects, cells.offsets)
    sites = suspects[of_row]
    every = -(-np.diff(cells.offsets)[sites] // MOST_CORNERS)
    is_kept = (rows - cells.offsets[sites]) % every == 0
    rows, sites = rows[is_kept], sites[is_kept]
    inner = np.zeros(len(points))
    for begin in range(0, len(rows), BLOCK):
        block = slice(begin, begin + BLOCK)
        found = _symmetric_reach(points, starts, neighbors, sites[block], corners[rows[block]])
        np.maximum.at(inner, sites[block], found)
    scale = np.maximum(spacing, inner)[suspects]
    is_border = np.zeros(len(points), bool)
    is_border[suspects[reach[suspects] > BORDER_RATIO * scale]] = True
    is_beside = np.zeros(len(points), bool)
    is_beside[neighbors[_rows(np.flatnonzero(is_border), starts)[0]]] = True
    is_odd = reach[suspects] > BESIDE_RATIO * scale
    return suspects[is_odd & (is_border | is_beside)[suspects]]


def _spacing(points: FloatArray, starts: npt.NDArray[np.int64], neighbors: IntArray) -> FloatArray:
    """The largest distance that each site or one of its neighbors has to the second nearest."""
    centers = np.repeat(np.arange(len(points)), np.diff(starts))
    distances = _distance(points[neighbors], points[centers])
    nearest, second = np.full((2, len(points)), np.inf)
    np.minimum.at(nearest, centers, distances)
    is_nearest = distances == nearest[centers]
    np.minimum.at(second, centers, np.where(is_nearest, np.inf, distances))
    is_alone = np.bincount(centers[is_nearest], minlength=len(points)) == 1
    second = np.where(is_alone & (second < np.inf), second, nearest)
    spacing = second.copy()
    np.maximum.at(spacing, centers, second[neighbors])
    return spacing


def _symmetric_reach(
    points: FloatArray,
    starts: npt.NDArray[np.int64],
    neighbors: IntArray,
    sites: IntArray,
    corners: FloatArray,
) -> FloatArray:
    """How far each corner is from its site once it is moved towards it until its mirror image is in
    the cell too; 0 for corners that are 90 degrees away or more.

    In the plane that touches the sphere at site s, a neighbor n bounds the cell by
    p . n <= 1 - s . n, and the mirror image of p is -p.
    """
    places = points[sites]
    along = _dot(corners, places)
    is_near = along > 0
    plane = corners / np.where(is_near, along, 1.0)[:, None] - places
    rows, of_corner = _rows(sites, starts)
    others = points[neighbors[rows]]
    gap = others - places[of_corner]
    bound = _dot(gap, gap) / 2  # 1 - s . n, without cancellation
    ratio = np.abs(_dot(plane[of_corner], others)) / bound
    excess = np.ones(len(sites))
    np.maximum.at(excess, of_corner, ratio)
    length = np.sqrt(_dot(plane, plane)) / excess
    cosine = 1 / np.sqrt(1 + length * length)
    chord: FloatArray = length * cosine * np.sqrt(2 / (1 + cosine))
    chord[~is_near] = 0
    return chord


def _rows(items: IntArray, offsets: Any) -> tuple[Any, Any]:
    """The positions of the items' entries in compressed rows, and whose each of them is."""
    sizes = offsets[items + 1] - offsets[items]
    owners = np.repeat(np.arange(len(items)), sizes)
    firsts = np.cumsum(sizes) - sizes
    return np.arange(len(owners)) - firsts[owners] + offsets[items][owners], owners


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Scalar products of rows, added in the same order on every machine."""
    product: Any = a[..., 0] * b[..., 0]
    return product + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


def _distance(a: FloatArray, b: FloatArray) -> FloatArray:
    gap = a - b
    length: FloatArray = np.sqrt(_dot(gap, gap))
    return length
