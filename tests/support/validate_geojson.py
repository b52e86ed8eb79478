#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Proves that a file of cells is a map of the whole sphere by RFC 7946.

    validate_geojson.py cells.geojson [--power | --lon COLUMN --lat COLUMN]

1. Every ring is closed, counterclockwise and simple, and lies in [-180, 180] x [-90, 90].
2. No ring crosses the antimeridian: no side is longer than 180 degrees of longitude, the sides
   along lat = +-90 apart.
3. The planar areas sum to 360 * 180 and the `area` properties to 4 pi; both poles are covered.
4. Each site lies in its own cell, if the features have its longitude and latitude (columns found
   by the names that rondel knows, or named). Not so the circles of power cells: --power.
5. Each feature's `area` is the area of its polygons on the sphere, up to the tolerance of the arcs.

Exit status 0 if so, else 1 with a line for each fault (the first 20).
"""

import argparse
import json
import math
import sys

from shapely.geometry import Point, shape
from shapely.geometry.polygon import Polygon
from shapely.validation import explain_validity

AREA_TOLERANCE = 2e-3  # steradians for a cell; the arcs are within 0.01 degrees


def spherical_area(ring):
    """The area inside straight sides in longitude and latitude: -sin(lat) d lon around the ring."""
    terms = []
    for (lon, lat), (next_lon, next_lat) in zip(ring, ring[1:]):
        half = math.radians(next_lat - lat) / 2
        sinc = math.sin(half) / half if half else 1
        middle = math.radians(lat + next_lat) / 2
        terms.append(-math.radians(next_lon - lon) * math.sin(middle) * sinc)
    return math.fsum(terms)


def polygons_of(geometry):
    if geometry["type"] == "Polygon":
        return [geometry["coordinates"]]
    if geometry["type"] == "MultiPolygon":
        return geometry["coordinates"]
    raise ValueError("a geometry of type " + geometry["type"])


def ring_faults(ring):
    if len(ring) < 4 or ring[0] != ring[-1]:
        yield "a ring is not closed"
        return
    if any(len(p) != 2 or not (-180 <= p[0] <= 180 and -90 <= p[1] <= 90) for p in ring):
        yield "a position is outside"
    for (lon, lat), (next_lon, next_lat) in zip(ring, ring[1:]):
        if abs(lon - next_lon) > 180 and not (abs(lat) == 90 and lat == next_lat):
            yield f"a side from {lon},{lat} to {next_lon},{next_lat} crosses the antimeridian"
    polygon = Polygon(ring)
    if not polygon.exterior.is_ccw:
        yield "a ring is clockwise"
    if not polygon.is_valid:
        yield "a ring is not valid: " + explain_validity(polygon)


def first_known(properties, names):
    return next((properties[name] for name in names if name in properties), None)


def feature_faults(feature, lon_names, lat_names):
    geometry = feature["geometry"]
    properties = feature["properties"]
    polygons = polygons_of(geometry)
    for polygon in polygons:
        if len(polygon) != 1:
            yield "a polygon with holes"
        for ring in polygon:
            yield from ring_faults(ring)
    region = shape(geometry)
    if not region.is_valid:
        yield "the geometry is not valid: " + explain_validity(region)
    lon = first_known(properties, lon_names)
    lat = first_known(properties, lat_names)
    if lon is not None and lat is not None:
        own_lon = math.remainder(lon, 360)
        place = Point(own_lon, lat)
        mirrored = Point(-own_lon, lat)  # of a site on the antimeridian
        is_on_cut = abs(own_lon) == 180 and region.intersects(mirrored)
        if abs(lat) != 90 and not (region.intersects(place) or is_on_cut):
            yield f"the site at {own_lon},{lat} is outside its cell"
    area = math.fsum(spherical_area(polygon[0]) for polygon in polygons)
    if abs(area - properties["area"]) > AREA_TOLERANCE:
        yield f"the area is {properties['area']}, its polygons have {area}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("--lon")
    parser.add_argument("--lat")
    parser.add_argument("--power", action="store_true")
    options = parser.parse_args()
    with open(options.file, encoding="utf-8") as file:
        collection = json.load(file)
    lon_names = [options.lon] if options.lon else ["lon", "lng", "long", "longitude"]
    lat_names = [options.lat] if options.lat else ["lat", "latitude"]
    if options.power:
        lon_names = lat_names = []
    faults = [] if collection["type"] == "FeatureCollection" else ["not a FeatureCollection"]
    planar = []
    areas = []
    poles = {90: 0.0, -90: 0.0}  # how many degrees of longitude of each pole's side are covered
    num_null = 0
    last_site = -1
    for feature in collection["features"]:
        site = feature["properties"]["site"]
        areas.append(feature["properties"]["area"])
        if site <= last_site:
            faults.append(f"site {site} is out of order")
        last_site = site
        if feature["geometry"] is None:
            num_null += 1
            continue
        own_faults = feature_faults(feature, lon_names, lat_names)
        faults += [f"site {site}: {fault}" for fault in own_faults]
        for (ring,) in polygons_of(feature["geometry"]):
            planar.append(Polygon(ring).area)
            for (lon, lat), (next_lon, next_lat) in zip(ring, ring[1:]):
                if lat == next_lat and lat in poles:
                    poles[lat] += abs(lon - next_lon)
    if abs(math.fsum(planar) - 360 * 180) > 1e-6:
        faults.append(f"the planar areas sum to {math.fsum(planar)}, not 64800")
    if abs(math.fsum(areas) / (4 * math.pi) - 1) > 1e-12:
        faults.append(f"the areas sum to {math.fsum(areas)}, not 4 pi")
    for lat, width in poles.items():
        if abs(width - 360) > 1e-6:
            faults.append(f"{width} of 360 degrees at latitude {lat} are covered")
    for fault in faults[:20]:
        print(f"{options.file}: {fault}")
    verdict = "valid" if not faults else f"{len(faults)} faults"
    print(f"{options.file}: {len(areas)} cells, {num_null} without geometry, {verdict}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
