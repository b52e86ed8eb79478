# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What is wrong with polygons in a file of GeoJSON, by shapely (GEOS), which shares no code with rondel."""

import math
import re

import numpy as np
import shapely

THIN = 1e-8  # steradians
NOTHING = '{"type":"Polygon","coordinates":[]}'


class Sides:
    """The sides of all rings of geometries, (m, 2, 2), and the numbers of their geometries."""

    def __init__(self, geometries):
        polygons, of_polygons = shapely.get_parts(geometries, return_index=True)
        rings, of_rings = shapely.get_rings(polygons, return_index=True)
        places, of_places = shapely.get_coordinates(rings, return_index=True)
        is_side = of_places[1:] == of_places[:-1]
        places = places + 0.0  # no negative zeros
        self.places = np.stack([places[:-1], places[1:]], axis=1)[is_side]
        self.owners = of_polygons[of_rings[of_places[:-1][is_side]]]
        self.num_polygons = np.bincount(of_polygons, minlength=len(geometries))

    def spherical_areas(self, count):
        """The areas inside straight lines in longitude and latitude: -sin(lat) d lon around rings."""
        (from_lon, from_lat), (to_lon, to_lat) = np.radians(self.places).transpose(1, 2, 0)
        half = (to_lat - from_lat) / 2
        below = (from_lon - to_lon) * np.sin((to_lat + from_lat) / 2) * np.sinc(half / np.pi)
        return np.bincount(self.owners, below, minlength=count)

    def without_partner(self):
        """Those which are not there in the other direction, those along the border of the map apart."""
        (from_lon, from_lat), (to_lon, to_lat) = self.places.transpose(1, 2, 0)
        on_border = ((from_lon == to_lon) & (np.abs(from_lon) == 180)) | (
            (from_lat == to_lat) & (np.abs(from_lat) == 90)
        )
        sides = self.places[~on_border]
        if not len(sides):
            return sides
        both = np.ascontiguousarray(np.concatenate([sides, sides[:, ::-1]]))
        keys = both.reshape(len(both), 4).view(np.dtype((np.void, 32))).ravel()
        numbers = np.unique(keys, return_inverse=True)[1].ravel()
        forward, back = numbers[: len(sides)], numbers[len(sides) :]
        surplus = np.bincount(forward, minlength=len(both)) - np.bincount(back, minlength=len(both))
        return sides[surplus[forward] != 0]


class Outline:
    """That of what geometries cover: lines, which are so near to the true ones (degrees)."""

    def __init__(self, lines, tolerance):
        self.lines = shapely.multilinestrings(shapely.get_parts(lines))
        self.tolerance = tolerance
        shapely.prepare(self.lines)

    def is_far(self, sides, tolerance):
        """Whether the middles of sides are farther away than the tolerance of either allows."""
        middles = sides.mean(axis=1)
        scale = np.maximum(np.cos(np.radians(middles[:, 1])), 1e-9)
        reach = 2 * max(tolerance, self.tolerance) / scale
        return ~shapely.dwithin(self.lines, shapely.points(middles), reach)


def read_features(path):
    """The geometries of a file, None where there is none, and the properties `area`."""
    text = path.read_text("utf-8").replace('"geometry":null', f'"geometry":{NOTHING}')
    geometries = shapely.get_parts(shapely.from_geojson(text)).copy()
    geometries[shapely.is_empty(geometries)] = None
    if len(geometries) != text.count('{"type":"Feature",'):
        raise ValueError(f"{path}: GEOS reads {len(geometries)} features")
    return geometries, np.array([float(area) for area in re.findall(r'"area":([^,}]*)', text)])


def faults_of(geometries, tolerance, areas=None, whole=False, outline=None, seems_whole=False):
    """What is wrong with polygons that are within a tolerance (degrees) of arcs.

    `areas` are what they should have; `whole` says that they cover the map, `seems_whole` that they have no gaps; `outline`
    is that of what they cover, where it is not the whole map.
    """
    is_there = ~shapely.is_missing(geometries)
    for i in np.flatnonzero(~is_there):
        if areas is not None and areas[i] > THIN:
            yield f"feature {i} of {areas[i]} steradians has no geometry"
    for i in np.flatnonzero(is_there & ~shapely.is_valid(geometries)):
        yield f"feature {i}: {shapely.is_valid_reason(geometries[i])}"
    sides = Sides(geometries)
    if areas is not None:
        drawn = sides.spherical_areas(len(geometries))
        bounds = 1e-9 + math.radians(tolerance) * 2 * math.pi * (1 + sides.num_polygons)
        for i in np.flatnonzero(is_there & (np.abs(drawn - areas) > bounds)):
            yield f"feature {i} has an area of {areas[i]}, its polygons of {drawn[i]}"
    geometries = geometries[is_there]
    alone = sides.without_partner()
    if seems_whole:  # unless the sites are on a hemisphere
        whole = abs(math.fsum(shapely.area(geometries)) - 360 * 180) < 1e-6
    if whole:
        if len(alone):
            yield f"{len(alone)} sides are none of a neighbor, the first {alone[0].tolist()}"
        total = math.fsum(shapely.area(geometries))
        if len(geometries) and abs(total - 360 * 180) > 1e-6:
            yield f"the map has {total} square degrees"
    elif outline is not None and len(alone):
        far = outline.is_far(alone, tolerance)
        if far.any():
            yield f"{far.sum()} sides are none of a neighbor, as {alone[far][0].tolist()}"
    # A map of which the sides are paired is covered equally often everywhere, and its area says that this is once.
    if not whole and len(geometries) > 1 and not shapely.coverage_is_valid(geometries):
        yield from faults_beside(geometries, alone)
        yield from faults_of_coverage(geometries)


def faults_beside(geometries, alone):
    """Sides that are not there in the other direction, though a geometry lies beyond: it has other corners."""
    far = 1e-11  # than the rounding of corners is; gaps of triangles without values may be narrow, too
    along = alone[:, 1] - alone[:, 0]
    length = np.hypot(*along.T)
    alone, along, length = (of_sides[length > 1000 * far] for of_sides in (alone, along, length))
    right = np.stack([along[:, 1], -along[:, 0]], axis=1) / length[:, np.newaxis]
    beyond = alone.mean(axis=1) + far * right
    sides, _ = shapely.STRtree(geometries).query(shapely.points(beyond), predicate="within")
    if len(sides):
        yield f"{len(set(sides))} sides have other corners in a neighbor, as {alone[sides[0]].tolist()}"


def faults_of_coverage(geometries):
    """GEOS also refuses borders of the whole in whose ends several geometries meet: do geometries overlap?"""
    try:
        union = union_of(geometries)
    except shapely.errors.GEOSException as error:
        yield f"GEOS cannot unite the geometries: {error}"
        return
    twice = math.fsum(shapely.area(geometries)) - shapely.area(union)
    if twice > 1e-7:
        yield f"{twice} square degrees belong to several geometries"


def union_of(geometries):
    try:
        return shapely.union_all(geometries)
    except shapely.errors.GEOSException:  # lines nearer to each other than its rounding
        return shapely.union_all(geometries, grid_size=1e-10)
