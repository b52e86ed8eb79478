# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Geometries of another CRS in degrees, whose sides stay what they are in that CRS.

Conversion gives each position a longitude from -180 to 180, so a line that crosses the antimeridian
would jump. Here longitudes go on beyond 180 instead, by whole turns, and a ring around a pole is
led to it along a meridian. Longitudes are multiples of 2^-43 degrees, 13 nanometers, so that a turn
more or less is exact and neighbors share their corners wherever they begin.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ._types import BoolArray, FloatArray, IntArray

TOLERANCE_DEG = 1e-4
MAX_PIECES = 4096
WIDEST_DEG = 90  # of a piece of a side; less than half a turn, so that its way is known
LONGITUDES_PER_DEG = 2.0**43  # exact up to 1024 degrees
ROUNDING = 2.0**-48  # of positions, as a part of the largest coordinate
POLE_DEG = 1e-9  # a position that is so close to a pole, 0.1 mm, is there


def in_lonlat(geometries: Any, crs: Any, target: Any, is_geodesic: bool) -> Any:
    """Converts geometries to longitudes and latitudes.

    A side that is straight in a projection gets corners where it bends: each piece of it lies
    within 1e-4 degrees of what will join its ends, unless the side already has
    4096 pieces, as may happen next to a pole. A side is divided alike from both directions, and at
    each corner of other lines and rings that lies on it, so that neighbors still share it.

    Parameters
    ----------
    geometries : geopandas.GeoSeries or geopandas.GeoDataFrame
        Geometries with coordinates in `crs`.
    crs : pyproj.CRS
        A projection, with planar coordinates, or a geographic system.
    target : pyproj.CRS or int
        The system to convert to, in degrees; an int is its EPSG code.
    is_geodesic : bool
        Whether great circles will join positions, rather than straight lines in longitude and
        latitude.

    Returns
    -------
    geopandas.GeoSeries or geopandas.GeoDataFrame
        Geometries in degrees. Longitudes of a line or ring may be beyond 180.

    Raises
    ------
    ValueError
        If a ring goes around the sphere and around neither pole.

    """
    import shapely

    shapes = geometries.geometry
    kinds = shapely.get_type_id(np.asarray(shapes.array))
    if np.isin(kinds, [-1, 0, 4]).all():  # none, Point, MultiPoint
        return geometries.to_crs(target)
    if not crs.is_projected:
        return _of_the_same_turn(geometries, crs, target)
    convert = _Conversion(
        crs, target, is_geodesic, shapely.get_coordinates(np.asarray(shapes.array))
    )
    made = []
    for k, shape in enumerate(shapes):
        try:
            made.append(convert(shape))
        except _AroundNoPole:
            raise ValueError(
                f"geometry {k} has a ring that goes around the sphere, but around neither pole; "
                f"its CRS is {crs.name!r}"
            ) from None
    series = type(shapes)(made, index=shapes.index, name=shapes.name, crs=target)
    return series if geometries is shapes else geometries.set_geometry(series)


def _of_the_same_turn(geometries: Any, crs: Any, target: Any) -> Any:
    """Geometries of a geographic CRS, in degrees that differ by less than half a turn from it."""
    import shapely

    converted = geometries.to_crs(target)
    shapes = np.asarray(converted.geometry.array)
    east = next((a for a in crs.axis_info if a.direction in ("east", "west")), None)
    if east is None:
        return converted
    scale = np.degrees(east.unit_conversion_factor) * (1 if east.direction == "east" else -1)
    meridian = crs.prime_meridian
    first = (
        0 if meridian is None else np.degrees(meridian.longitude * meridian.unit_conversion_factor)
    )
    given = shapely.get_coordinates(np.asarray(geometries.geometry.array))[:, 0] * scale + first
    positions = shapely.get_coordinates(shapes)
    with np.errstate(invalid="ignore"):
        turns = np.rint((given - positions[:, 0]) / 360)
    if not np.any(turns[np.isfinite(turns)]):
        return converted
    positions[:, 0] = _rounded(positions[:, 0]) + 360 * turns
    series = type(converted.geometry)(
        shapely.set_coordinates(shapely.force_2d(shapes), positions),
        index=converted.index,
        name=converted.geometry.name,
        crs=target,
    )
    return series if geometries is geometries.geometry else converted.set_geometry(series)


class _AroundNoPole(Exception):
    pass


class _Conversion:
    """Converts shapes from a projection."""

    def __init__(self, crs: Any, target: Any, is_geodesic: bool, corners: FloatArray) -> None:
        import shapely
        from pyproj import Transformer

        self._is_geodesic = is_geodesic
        corners = np.unique(corners[np.isfinite(corners).all(axis=1)], axis=0)
        self._corners = corners
        self._tree = shapely.STRtree(shapely.points(corners))
        self._rounding = ROUNDING * np.abs(corners).max(initial=0)

        self._transform = Transformer.from_crs(crs, target, always_xy=True).transform
        # The poles in the projection, where they may be points, lines or nothing.
        back = Transformer.from_crs(target, crs, always_xy=True).transform
        self._poles = {lat: np.array(back(0.0, lat)) for lat in (90.0, -90.0)}

    def __call__(self, shape: Any) -> Any:
        import shapely

        if shape is None or shape.is_empty:
            return shape
        if hasattr(shape, "geoms"):
            parts = [self(part) for part in shape.geoms]
            if shape.geom_type != "MultiPolygon":
                return type(shape)(parts)
            flat = [one for part in parts for one in getattr(part, "geoms", [part])]
            return type(shape)(flat)
        if hasattr(shape, "exterior"):
            return self._polygon(shape)
        if shape.geom_type == "Point":
            lon, lat = self._transform(shape.x, shape.y)
            return shapely.Point(float(_rounded(np.asarray(lon))), lat)
        return shapely.LineString(self._line(shape.coords))

    def _polygon(self, shape: Any) -> Any:
        """A polygon, or several where a hole of a polygon with a pole in it is cut."""
        from shapely import Polygon

        shell, has_pole = self._ring(shape.exterior)
        holes = [self._ring(ring)[0] for ring in shape.interiors]
        if not np.isfinite(shell).all() or not all(np.isfinite(hole).all() for hole in holes):
            return Polygon(shell, holes)
        shell[:, 0] -= 360 * np.floor((shell[:, 0].min() + 180) / 360)
        if not has_pole:
            return Polygon(shell, [_moved_into(hole, shell) for hole in holes])
        made = Polygon(shell)
        for hole in holes:
            for turns in range(-2, 3):
                copy = Polygon(_turned(hole, turns))
                if copy.intersects(made):
                    made = made.difference(copy)
        return made

    def _line(self, coords: Any) -> FloatArray:
        corners = self._divided(self._with_corners(np.asarray(coords)[:, :2]))
        lon, lat = self._transform(corners[:, 0], corners[:, 1])
        lon, lat = _led_through_poles(_rounded(lon), lat)
        return np.column_stack([_unwrapped(lon), lat])

    def _with_corners(self, line: FloatArray) -> FloatArray:
        """A line with the corners of others that lie on it."""
        import shapely

        if not np.isfinite(line).all():
            return line
        ends = np.stack([line[:-1], line[1:]], axis=1)
        side, corner = self._tree.query(
            shapely.linestrings(ends), predicate="dwithin", distance=self._rounding
        )
        places, first, step = self._corners[corner], line[side], line[side + 1] - line[side]
        square = (step**2).sum(axis=1)
        share = ((places - first) * step).sum(axis=1) / np.where(square > 0, square, 1)
        between = (share > 0) & (share < 1)
        between &= (places != first).any(axis=1) & (places != line[side + 1]).any(axis=1)
        side, share, places = side[between], share[between], places[between]
        order = np.lexsort((share, side))
        return np.insert(line, side[order] + 1, places[order], axis=0)

    def _divided(self, corners: FloatArray) -> FloatArray:
        a, b = corners[:-1], corners[1:]
        is_turned = (a[:, 0] > b[:, 0]) | ((a[:, 0] == b[:, 0]) & (a[:, 1] > b[:, 1]))
        first = np.where(is_turned[:, None], b, a)
        step = np.where(is_turned[:, None], a, b) - first
        counts = self._pieces(first, step)
        if (counts == 1).all():
            return corners
        side = np.repeat(np.arange(len(counts)), counts)
        within = np.arange(len(side)) - np.repeat(np.cumsum(counts) - counts, counts)
        from_first = np.where(is_turned[side], counts[side] - within, within)
        points = first[side] + step[side] * (from_first / counts[side])[:, None]
        points[within == 0] = a
        return np.concatenate([points, corners[-1:]])

    def _pieces(self, first: FloatArray, step: FloatArray) -> IntArray:
        """How many pieces each side has: a power of 2."""
        counts = np.ones(len(first), np.intp)
        bent = np.arange(len(first))
        pieces = 1
        is_bent = _is_off_arcs if self._is_geodesic else _is_off_lines
        while len(bent) > 0 and pieces < MAX_PIECES:
            finer = max(2, 16 // pieces)
            shares = np.arange(finer * pieces + 1) / (finer * pieces)
            points = first[bent, None] + step[bent, None] * shares[:, None]
            lon, lat = self._transform(points[..., 0], points[..., 1])
            at_pole = np.abs(lat) >= 90 - POLE_DEG  # where it has any longitude
            beside = np.concatenate([lon[:, 1:2], lon[:, :-1]], axis=1)
            lon = np.where(at_pole, beside, lon)
            with np.errstate(invalid="ignore"):
                bent = bent[is_bent(lon, lat, finer)]
            pieces *= 2
            counts[bent] = pieces
        return counts

    def _ring(self, ring: Any) -> tuple[FloatArray, bool]:
        """A closed ring, and whether it has a pole in it, to which it is led."""
        line = self._line(ring.coords)
        if not np.isfinite(line).all():
            return line, False
        turns = int(np.rint((line[-1, 0] - line[0, 0]) / 360))
        if turns == 0:
            return line, False
        polar = np.flatnonzero(np.abs(line[:-1, 1]) + np.abs(line[1:, 1]) == 180)
        if len(polar) > 0:  # at a pole a line may go either way
            step = np.diff(line[:, 0])[polar] * np.sign(turns)
            line[polar[np.argmax(step)] + 1 :, 0] -= 360 * turns
            return line, False
        pole = self._pole_in(ring)
        highest = int(np.argmax(line[:-1, 1] * np.sign(pole)))  # nothing is between it and the pole
        line = np.concatenate([line[highest:-1], _turned(line[: highest + 1], turns)])
        ends = [[line[-1, 0], pole], [line[0, 0], pole], line[0]]
        return np.concatenate([line, ends]), True

    def _pole_in(self, ring: Any) -> float:
        """The latitude of the pole in a ring, or on it but for rounding."""
        from shapely import Point, Polygon

        area = Polygon(ring)
        size = np.sqrt(area.area)
        for lat, place in self._poles.items():
            if np.isfinite(place).all() and area.distance(Point(place)) <= 1e-6 * size:
                return lat
        raise _AroundNoPole


def _rounded(lon: FloatArray) -> FloatArray:
    return np.asarray(np.rint(lon * LONGITUDES_PER_DEG) / LONGITUDES_PER_DEG)


def _unwrapped(lon: FloatArray) -> FloatArray:
    """Longitudes that go on by less than half a turn at each step."""
    with np.errstate(invalid="ignore"):
        turns = -np.cumsum(np.rint(np.diff(lon) / 360))
    return lon + 360 * np.concatenate([[0], turns])


def _led_through_poles(lon: FloatArray, lat: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lines through a pole come to it and leave it along meridians."""
    at_pole = np.abs(lat) >= 90 - POLE_DEG
    if not at_pole.any() or at_pole.all():
        return lon, lat
    is_closed = lon[0] == lon[-1] and lat[0] == lat[-1]
    if is_closed and at_pole[0]:  # begin elsewhere
        start = int(np.argmin(at_pole))
        lon, lat, at_pole = (
            np.concatenate([array[start:-1], array[: start + 1]]) for array in (lon, lat, at_pole)
        )
    new_lon: list[float] = []
    new_lat: list[float] = []
    for k in range(len(lon)):
        if not at_pole[k]:
            new_lon.append(lon[k])
            new_lat.append(lat[k])
            continue
        pole = float(np.copysign(90, lat[k]))
        if k > 0 and not at_pole[k - 1]:
            new_lon.append(lon[k - 1])
            new_lat.append(pole)
        if k + 1 < len(lon) and not at_pole[k + 1]:
            new_lon.append(lon[k + 1])
            new_lat.append(pole)
    return np.array(new_lon), np.array(new_lat)


def _turned(ring: FloatArray, turns: int) -> FloatArray:
    """A ring as many turns farther east."""
    return np.column_stack([ring[:, 0] + 360 * turns, ring[:, 1]])


def _moved_into(hole: FloatArray, shell: FloatArray) -> FloatArray:
    """A hole by as many turns to the east or west as it takes to be in the shell."""
    from shapely import Polygon

    outer, inside = Polygon(shell), Polygon(hole).representative_point()
    for turns in (0, 1, -1, 2, -2):
        if outer.intersects(type(inside)(inside.x + 360 * turns, inside.y)):
            return _turned(hole, turns)
    return hole  # outside of its shell, which is told when it is read


def _is_off_lines(lon: FloatArray, lat: FloatArray, finer: int) -> BoolArray:
    """Whether, in each row, a run of `finer` steps is off the line between its ends, or wide."""
    lon = np.unwrap(lon, period=360)
    shares = np.arange(1, finer) / finer
    lon_off, lat_off = (
        _within(x, finer) - (x[:, :-1:finer, None] + np.diff(x[:, ::finer])[..., None] * shares)
        for x in (lon, lat)
    )
    off = np.hypot(lon_off * np.cos(np.radians(_within(lat, finer))), lat_off)
    return (off > TOLERANCE_DEG).any(axis=(1, 2)) | _is_wide(lon, finer)


def _is_off_arcs(lon: FloatArray, lat: FloatArray, finer: int) -> BoolArray:
    """Whether, in each row, a run of `finer` steps is off the great circle of its ends, or wide."""
    east, north = np.radians(lon), np.radians(lat)
    unit = [np.cos(north) * np.cos(east), np.cos(north) * np.sin(east), np.sin(north)]
    ends = np.stack([x[:, ::finer] for x in unit], axis=-1)
    normals = np.cross(ends[:, :-1], ends[:, 1:])
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    normals = normals / np.where(length > 0, length, 1)
    off = sum(
        (_within(x, finer) - x[:, :-1:finer, None]) * normals[..., k, None]
        for k, x in enumerate(unit)
    )
    is_off = (np.abs(off) > np.radians(TOLERANCE_DEG)).any(axis=(1, 2))
    return np.asarray(is_off | _is_wide(np.unwrap(lon, period=360), finer))


def _within(values: FloatArray, finer: int) -> FloatArray:
    """The values between the ends of runs: an axis for runs, and one for what is in a run."""
    return np.asarray(values[:, :-1].reshape(len(values), -1, finer)[..., 1:])


def _is_wide(lon: FloatArray, finer: int) -> BoolArray:
    return np.asarray((np.abs(np.diff(lon[:, ::finer])) > WIDEST_DEG).any(axis=1))
