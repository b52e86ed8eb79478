#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons in files are valid for GEOS and equal along shared borders, for every kind of `rondel generate`.

    written_polygons_test.py RONDEL [--count N] [--kinds KIND,KIND] [--seed S] [--minutes M] [--sites N]

Writes, of each kind, N files each of Voronoi cells, of bands of a random field, of cells clipped to random polygons, of cells
cut by regions that share borders, and of triangles, and judges them by shapely, which shares no code with rondel:

1. Every geometry is valid. A cell without a geometry has an area below 1e-8 steradians.
2. Each side of a polygon inside of what is covered is, bit by bit, a side of one neighbor in the other direction. Cells and
   bands cover the whole map; clipped cells and their parts the polygons to which they are clipped.
3. The areas in the plane add up to that of the map where that is covered, and no two geometries overlap (GEOS' coverages).
4. The property `area` is the area of the polygons on the sphere, but for what the tolerance allows.

Without shapely ctest says "Skipped".
"""

import argparse
import csv
import importlib.util
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import time
import unittest

if any(importlib.util.find_spec(name) is None for name in ("numpy", "shapely")):
    sys.exit(77)
import numpy as np
import shapely

PARSER = argparse.ArgumentParser(description=__doc__.splitlines()[0])
PARSER.add_argument("tool", type=pathlib.Path)
PARSER.add_argument("--count", type=int, default=1, help="files of each product and kind")
PARSER.add_argument("--kinds", default="", help="some kinds, with commas (default: all)")
PARSER.add_argument("--seed", type=int, default=1)
PARSER.add_argument("--minutes", type=float, default=math.inf, help="end after so long")
PARSER.add_argument("--sites", type=int, default=32, help="at most so many")
PARSER.add_argument("--keep", type=pathlib.Path, help="a folder for inputs of faults")

# Numbers of sites of the sets that have no other ones, near --sites.
COUNTS = {"icosahedral": 42, "healpix": 48, "reduced-gaussian": 40, "cubed-sphere": 24}
TOLERANCE = 0.01  # degrees, the tool's own
THIN = 1e-8  # steradians


def spherical_area(ring):
    """The area inside straight sides in longitude and latitude: -sin(lat) d lon around the ring."""
    lon, lat = np.radians(ring).T
    half = np.diff(lat) / 2
    middle = (lat[1:] + lat[:-1]) / 2
    return -math.fsum(np.diff(lon) * np.sin(middle) * np.sinc(half / np.pi))


def sides_without_partner(geometries):
    """The sides, (m, 2, 2), which are not there in the other direction, those along the border of the map apart."""
    sides = []
    for polygon in shapely.get_parts(geometries):
        for ring in shapely.get_rings(polygon):
            places = shapely.get_coordinates(ring)
            sides.append(np.stack([places[:-1], places[1:]], axis=1))
    if not sides:
        return np.empty((0, 2, 2))
    all_sides = np.concatenate(sides) + 0.0  # no negative zeros
    on_border = (
        (all_sides[:, 0, 0] == all_sides[:, 1, 0]) & (np.abs(all_sides[:, 0, 0]) == 180)
    ) | ((all_sides[:, 0, 1] == all_sides[:, 1, 1]) & (np.abs(all_sides[:, 0, 1]) == 90))
    all_sides = all_sides[~on_border]
    forward = [side.tobytes() for side in all_sides]
    counts = {}
    for key in forward:
        counts[key] = counts.get(key, 0) + 1
    for side in all_sides:
        back = np.ascontiguousarray(side[::-1]).tobytes()
        if back in counts:
            counts[back] -= 1
    alone = [
        i for i, side in enumerate(all_sides) if counts[forward[i]] > 0 or counts[forward[i]] < 0
    ]
    return all_sides[alone]


def faults_of(features, whole, outline=None, has_areas=True):
    """What is wrong with features; `outline` is that of what they cover, where it is not the whole map."""
    shapes = [None if f["geometry"] is None else json.dumps(f["geometry"]) for f in features]
    geometries = shapely.from_geojson(np.array(shapes, dtype=object))
    for i, (geometry, feature) in enumerate(zip(geometries, features)):
        area = feature["properties"].get("area", 0) if has_areas else 0
        if geometry is None:
            if area > THIN:
                yield f"feature {i} of {area} steradians has no geometry"
            continue
        if not shapely.is_valid(geometry):
            yield f"feature {i}: {shapely.is_valid_reason(geometry)}"
        if has_areas:
            rings = [
                shapely.get_coordinates(r)
                for p in shapely.get_parts(geometry)
                for r in shapely.get_rings(p)
            ]
            drawn = sum(spherical_area(ring) for ring in rings)
            bound = 1e-9 + math.radians(TOLERANCE) * 2 * math.pi * (
                1 + len(shapely.get_parts(geometry))
            )
            if abs(drawn - area) > bound:
                yield f"feature {i} has an area of {area}, its polygons of {drawn}"
    geometries = geometries[[g is not None for g in geometries]]
    alone = sides_without_partner(geometries)
    if whole:
        if len(alone):
            yield f"{len(alone)} sides are none of a neighbor, the first {alone[0].tolist()}"
        total = math.fsum(shapely.area(geometries))
        if len(geometries) and abs(total - 360 * 180) > 1e-6:
            yield f"the map has {total} square degrees"
    elif outline is not None and len(alone):
        middles = alone.mean(axis=1)
        scale = np.cos(np.radians(np.minimum(np.abs(alone[:, :, 1]).max(axis=1), 89.9)))
        away = shapely.distance(outline, shapely.points(middles)) * scale
        far = away > 2 * TOLERANCE
        if far.any():
            yield f"{far.sum()} sides are none of a neighbor, as {alone[far][0].tolist()}"
    if len(geometries) > 1 and not shapely.coverage_is_valid(geometries):
        yield from faults_of_coverage(geometries, alone)


def faults_of_coverage(geometries, alone):
    """GEOS also refuses borders of the whole in whose ends several geometries meet: are they what it says?"""
    try:
        union = shapely.union_all(geometries)
    except shapely.errors.GEOSException:  # numbers near the smallest double
        union = shapely.union_all(geometries, grid_size=1e-10)
    twice = math.fsum(shapely.area(geometries)) - shapely.area(union)
    if twice > 1e-7:
        yield f"{twice} square degrees belong to several geometries"
    along = alone[:, 1] - alone[:, 0]
    length = np.hypot(*along.T)[:, np.newaxis]
    right = np.stack([along[:, 1], -along[:, 0]], axis=1) / length
    beside = alone.mean(axis=1) + np.minimum(1e-7, length / 1000) * right
    inside = shapely.contains(union, shapely.points(beside))
    if inside.any():
        yield f"{inside.sum()} sides have other corners in a neighbor, as {alone[inside][0].tolist()}"


def star(rng, lon, lat, size, corners, spikes):
    """A polygon around a place, straight in longitude and latitude, within the map."""
    turns = sorted(rng.random() for _ in range(corners))
    ring = []
    for turn in turns:
        reach = size * (1 - spikes * rng.random())
        x = lon + reach * math.cos(2 * math.pi * turn)
        y = lat + reach * math.sin(2 * math.pi * turn)
        ring.append([min(max(x, -180), 180), min(max(y, -90), 90)])
    return [*ring, ring[0]]


def random_polygons(rng):
    """Polygons that do not overlap: one or several, small or large, a few with holes."""
    found = []
    for _ in range(rng.choice([1, 1, 2, 4])):
        size = rng.choice([0.01, 1, 10, 40, 80])
        ring = star(
            rng, rng.uniform(-180, 180), rng.uniform(-90, 90), size, rng.randrange(3, 24), 0.9
        )
        polygon = shapely.Polygon(ring)
        if not polygon.is_valid:
            continue
        if rng.random() < 0.3:
            polygon = polygon.difference(polygon.centroid.buffer(size / 8, quad_segs=2))
        parts = [p for p in shapely.get_parts(polygon) if p.geom_type == "Polygon"]
        if polygon.is_valid and polygon.area > 0 and not any(o.intersects(polygon) for o in found):
            found += parts
    return found


def collection(geometries, names=None):
    features = []
    for i, geometry in enumerate(geometries):
        properties = {"name": names[i]} if names else {}
        features.append(
            {
                "type": "Feature",
                "properties": properties,
                "geometry": json.loads(shapely.to_geojson(geometry)),
            }
        )
    return {"type": "FeatureCollection", "features": features}


class Maker:
    """Runs the tool in a folder."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = pathlib.Path(folder)

    def run(self, *arguments):
        return self.call(*arguments, "--threads", "1")

    def call(self, *arguments):
        done = subprocess.run(
            [self.options.tool.resolve(), *map(str, arguments), "--quiet"],
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )
        return (done.stderr.strip() or f"status {done.returncode}") if done.returncode else ""

    def features(self, name):
        with open(self.folder / name, encoding="utf-8") as file:
            return json.load(file)["features"]

    def generate(self, kind, rng, seed):
        number = COUNTS.get(kind, rng.randrange(4, self.options.sites + 1))
        arguments = ["--angle", "25"] if kind == "poisson" else ["-n", number]
        return self.call("generate", kind, "--seed", seed, "-o", "sites.csv", *arguments)

    def add_field(self, rng):
        with open(self.folder / "sites.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        which = rng.randrange(4)
        frequency = rng.choice([0.3, 2, 9])
        for i, row in enumerate(rows):
            if i == 0:
                row += ["value", "owner"]
                continue
            numbers = [
                str(rng.randrange(3)),
                repr(rng.uniform(-2, 4)),
                repr(round(2 * math.sin(frequency * i), 1)),
                repr(i / len(rows) * 3 - 1),
            ]
            row += [numbers[which] if rng.random() < 0.97 else "", "abc"[rng.randrange(3)]]
        with open(self.folder / "field.csv", "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows(rows)

    def cells(self, rng):
        why = self.run("voronoi", "field.csv", "-o", "out.geojson")
        return [why] if why else faults_of(self.features("out.geojson"), whole=True)

    def bands(self, rng):
        levels = sorted({round(rng.uniform(-1.5, 3), 1) for _ in range(rng.randrange(1, 6))})
        text = ",".join(map(repr, levels))
        why = self.run(
            "contours",
            "field.csv",
            "--value",
            "value",
            f"--levels={text}",
            "--bands",
            "-o",
            "out.geojson",
        )
        return (
            [why] if why else faults_of(self.features("out.geojson"), whole=False, has_areas=False)
        )

    def triangles(self, rng):
        why = self.run("delaunay", "field.csv", "-o", "out.geojson")
        return (
            [why] if why else faults_of(self.features("out.geojson"), whole=False, has_areas=False)
        )

    def clips(self, rng):
        polygons = random_polygons(rng)
        if not polygons:
            return []
        with open(self.folder / "clip.geojson", "w", encoding="utf-8") as file:
            json.dump(collection(polygons), file)
        more = ["--group", "owner"] if rng.random() < 0.3 else []
        why = self.run("voronoi", "field.csv", "--clip", "clip.geojson", "-o", "out.geojson", *more)
        outline = shapely.boundary(shapely.MultiPolygon(polygons))
        return (
            [why] if why else faults_of(self.features("out.geojson"), whole=False, outline=outline)
        )

    def countries(self, rng):
        """Regions that share borders: cells of other sites, which are joined to a few regions."""
        edges = rng.choice(["lonlat", "geodesic"])
        # Long sides are great circles or straight; short ones are both.
        self.make_regions(rng, rng.choice(["0.01", "1", "5"]) if edges == "lonlat" else "0.01")
        clip = ["--clip", "regions.geojson", "--clip-value", "owner", "--edges", edges]
        more = ["--group", "owner"] if rng.random() < 0.3 else []
        why = self.run("voronoi", "field.csv", *clip, "-o", "out.geojson", *more)
        if why:
            return [why]
        features = self.features("out.geojson")
        return faults_of(features, whole=False, outline=self.outline)

    def make_regions(self, rng, tolerance):
        seed = rng.randrange(1 << 30)
        kept = (self.folder / "sites.csv").rename(self.folder / "kept.csv")
        self.call("generate", "uniform", "--seed", seed, "-o", "sites.csv", "-n", rng.choice([6, 20, 60]))
        (self.folder / "sites.csv").rename(self.folder / "others.csv")
        kept.rename(self.folder / "sites.csv")
        self.run("voronoi", "others.csv", "-o", "others.geojson", "--tolerance", tolerance)
        features = [
            f for f in self.features("others.geojson") if f["geometry"] and rng.random() < 0.8
        ]
        for feature in features:
            feature["properties"] = {"owner": "xyz"[rng.randrange(3)]}
        with open(self.folder / "regions.geojson", "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "features": features}, file)
        shapes = [shapely.from_geojson(json.dumps(f["geometry"])) for f in features]
        self.outline = shapely.unary_union([shapely.boundary(s) for s in shapes])


PRODUCTS = ("cells", "bands", "triangles", "clips", "countries")


def kinds_of(tool):
    """All kinds that the tool lists in its help."""
    text = subprocess.run(
        [tool.resolve(), "generate", "--help"], capture_output=True, text=True, check=True
    ).stdout
    kinds = []
    is_list = False
    for line in text.splitlines():
        if line and not line.startswith(" "):
            is_list = line.startswith(("Kinds:", "Sets of", "Hostile"))
        elif is_list and line.startswith("  ") and not line.startswith("   "):
            kinds.append(line.split()[0])
    return kinds


def run_all(options, report):
    """Judges files until the count or the time is reached; reports each fault, and counts files."""
    kinds = options.kinds.split(",") if options.kinds else kinds_of(options.tool)
    counts = {}
    end = time.monotonic() + 60 * options.minutes
    with tempfile.TemporaryDirectory() as folder:
        maker = Maker(options, folder)
        for number in range(options.count):
            for kind in kinds:
                for product in PRODUCTS:
                    if time.monotonic() > end:
                        return counts
                    seed = f"{options.seed}/{number}/{kind}"
                    rng = random.Random(seed)
                    why = maker.generate(kind, rng, rng.randrange(1 << 30))
                    if why:
                        report(f"{seed}: {why}")
                        break
                    maker.add_field(rng)
                    rng = random.Random(f"{seed}/{product}")
                    faults = list(getattr(maker, product)(rng))
                    key = (kind, product)
                    counts[key] = counts.get(key, 0) + 1
                    for fault in faults[:3]:
                        report(f"{seed}/{product}: {fault}")
                    if faults and options.keep:
                        target = options.keep / f"{seed}/{product}".replace("/", "_")
                        target.mkdir(parents=True, exist_ok=True)
                        for path in maker.folder.iterdir():
                            (target / path.name).write_bytes(path.read_bytes())
    return counts


class Written(unittest.TestCase):
    def test_all_kinds(self):
        faults = []
        counts = run_all(OPTIONS, faults.append)
        self.assertGreater(len(counts), 0)
        self.assertEqual(faults, [])

    def test_the_judge_sees_faults(self):
        def feature(*ring, area=None):
            geometry = {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}
            return {"properties": {"area": area}, "geometry": geometry}

        low = feature([0, 0], [4, 0], [4, 1], [0, 1])
        high = feature([0, 1], [4, 1], [4, 2], [0, 2])
        outline = shapely.boundary(shapely.box(0, 0, 4, 2))
        judge = {"whole": False, "outline": outline, "has_areas": False}
        self.assertEqual(list(faults_of([low, high], **judge)), [])
        corner = feature([0, 1], [2, 1], [4, 1], [4, 2], [0, 2])
        self.assertNotEqual(list(faults_of([low, corner], **judge)), [])
        apart = feature([0, 1.00000000000001], [4, 1], [4, 2], [0, 2])
        self.assertNotEqual(list(faults_of([low, apart], **judge)), [])
        bow_tie = feature([0, 1], [4, 2], [4, 1], [0, 2])
        self.assertNotEqual(list(faults_of([bow_tie], **judge)), [])
        self.assertNotEqual(list(faults_of([low, high], whole=True, has_areas=False)), [])
        lost = {"properties": {"area": 1e-3}, "geometry": None}
        self.assertNotEqual(list(faults_of([lost], whole=False)), [])


def main():
    start = time.monotonic()
    faults = []
    counts = run_all(OPTIONS, lambda fault: (faults.append(fault), print(fault, flush=True)))
    for kind in dict.fromkeys(kind for kind, _ in counts):
        numbers = ", ".join(f"{counts.get((kind, p), 0)} {p}" for p in PRODUCTS)
        print(f"{kind}: {numbers}")
    print(f"{sum(counts.values())} files, {len(faults)} faults, {time.monotonic() - start:.0f} s")
    return 1 if faults else 0


if __name__ == "__main__":
    OPTIONS = PARSER.parse_args()
    if OPTIONS.count > 1 or OPTIONS.kinds or OPTIONS.minutes < math.inf:
        sys.exit(main())
    unittest.main(argv=sys.argv[:1])
