#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons in files are valid for GEOS and equal along shared borders, for every kind of `rondel generate`.

    written_polygons_test.py RONDEL [--count N] [--kinds KIND,KIND] [--products PRODUCT,PRODUCT] [--seed S]
                             [--minutes M] [--sites N] [--keep FOLDER] [--bindings FOLDER --repeats R]

Writes, of each kind, N files each of Voronoi cells, of bands of a random field, of cells clipped to random polygons, of cells
cut by regions that share borders, and of triangles, and judges them by shapely, which shares no code with rondel:

1. Every geometry is valid. A cell without a geometry has an area below 1e-8 steradians.
2. Each side of a polygon inside of what is covered is, bit by bit, a side of one neighbor in the other direction. Cells
   cover the whole map, and so do triangles and bands of sites around the center, if all have a value; clipped cells and
   their parts cover the polygons to which they are clipped.
3. The areas in the plane add up to that of the map where that is covered, and no two geometries overlap (GEOS' coverages).
4. The property `area` is the area of the polygons on the sphere, but for what the tolerance allows.

With --bindings the Python package writes the files, in this process: a hundred a second, as many as --minutes allow. A fault
is told with seed, number, kind and product: --seed, --first, --kinds and --products repeat it.
Without shapely ctest says "Skipped".
"""

import argparse
import csv
import importlib.util
import itertools
import math
import pathlib
import random
import re
import sys
import tempfile
import time
import unittest

if any(importlib.util.find_spec(name) is None for name in ("numpy", "shapely")):
    sys.exit(77)
import numpy as np
import shapely
from written_polygons_judge import Outline, faults_of, read_features
from written_polygons_makers import Bindings, Tool

PARSER = argparse.ArgumentParser(description=__doc__.splitlines()[0])
PARSER.add_argument("tool", type=pathlib.Path)
PARSER.add_argument("--count", type=int, help="files of each product and kind (default: 1)")
PARSER.add_argument("--first", type=int, default=0, help="the number of the first of these files")
PARSER.add_argument("--kinds", default="", help="some kinds, with commas (default: all)")
PARSER.add_argument("--products", default="", help="some products, with commas (default: all)")
PARSER.add_argument("--seed", type=int, default=1)
PARSER.add_argument("--minutes", type=float, help="instead of --count: end after so long")
PARSER.add_argument("--sites", type=int, default=32, help="at most so many")
PARSER.add_argument(
    "--repeats", type=int, default=1, help="bands, clips and countries of the same sites"
)
PARSER.add_argument("--keep", type=pathlib.Path, help="a folder for inputs of faults")
PARSER.add_argument("--bindings", help="the folder of the Python package, which is to write")

# Numbers of sites of the sets that have no other ones, near --sites.
# Kinds of sites for the model "weighted", too.
IN_SPACE = ("ball", "cube", "gaussian", "mixed-weights", "integer")
TOLERANCES = (0.01, 0.3, 3.0)  # degrees
COUNTS = {"icosahedral": 42, "healpix": 48, "reduced-gaussian": 40, "cubed-sphere": 24}


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
    """Polygons that do not overlap: one or several, small or large, a few with holes, with round numbers or not."""
    found = []
    step = rng.choice([0, 0, 0.5, 5, 45])
    for _ in range(rng.choice([1, 1, 2, 4])):
        size = rng.choice([0.01, 1, 10, 40, 80])
        ring = star(
            rng, rng.uniform(-180, 180), rng.uniform(-90, 90), size, rng.randrange(3, 24), 0.9
        )
        polygon = shapely.Polygon(np.round(np.array(ring) / step) * step if step else ring)
        if not polygon.is_valid:
            continue
        if rng.random() < 0.3:
            polygon = polygon.difference(polygon.centroid.buffer(size / 8, quad_segs=2))
        parts = [p for p in shapely.get_parts(polygon) if p.geom_type == "Polygon"]
        if polygon.is_valid and polygon.area > 0 and not any(o.intersects(polygon) for o in found):
            found += parts
    return found


def random_boxes(rng):
    """Of a grid with round numbers, around both poles and along the antimeridian."""
    step = rng.choice([15, 30, 45, 90])
    lon = [x for x in range(-180, 181, step) if abs(x) == 180 or rng.random() < 0.7]
    lat = [y for y in range(-90, 91, step) if abs(y) == 90 or rng.random() < 0.7]
    lon, lat = (list(itertools.pairwise(lines)) for lines in (lon, lat))
    return [shapely.box(west, south, east, north) for west, east in lon for south, north in lat]


def feature(properties, geometry):
    return f'{{"type":"Feature","properties":{properties},"geometry":{geometry}}}'


def feature_of(geometry):
    return feature("{}", shapely.to_geojson(geometry))


class Products:
    """Random files of a kind, and what is wrong with them: lists, empty where all is right.

    Regions to which cells are clipped are the same for all kinds of a number.
    """

    def __init__(self, options, maker):
        self.options = options
        self.maker = maker
        self.folder = maker.folder
        self.number = None
        self.num_geometries = 0

    def begin(self, number):
        self.number = number
        self.regions = {}

    def generate(self, kind, rng, seed):
        self.model = "weighted" if kind in IN_SPACE and seed % 2 else "projected"
        number = COUNTS.get(kind, rng.randrange(4, self.options.sites + 1))
        arguments = ["--angle", "25"] if kind == "poisson" else ["-n", number]
        return self.maker.generate("sites.csv", kind, seed, *arguments)

    def regions_of(self, name, make):
        """The regions with this name, which `make` writes."""
        if name not in self.regions:
            rng = random.Random(f"{self.options.seed}/{self.number}/{name}")
            self.regions[name] = make(rng, f"{name}.geojson")
        return self.regions[name]

    def add_field(self, rng):
        with open(self.folder / "sites.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        which = rng.randrange(4)
        self.is_complete = rng.random() < 0.6
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
            is_known = self.is_complete or rng.random() < 0.95
            row += [numbers[which] if is_known else "", "abc"[rng.randrange(3)]]
        with open(self.folder / "field.csv", "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows(rows)

    def judge(self, why, tolerance, has_areas=True, **what):
        if why:
            return [why]
        geometries, areas = read_features(self.folder / "out.geojson")
        self.num_geometries += len(geometries)
        return list(faults_of(geometries, tolerance, areas if has_areas else None, **what))

    def cells(self, rng, _):
        tolerance = rng.choice(TOLERANCES)
        why = self.maker.voronoi("field.csv", "out.geojson", tolerance, self.model)
        return self.judge(why, tolerance, whole=True)

    def bands(self, rng, _):
        levels = sorted({round(rng.uniform(-1.5, 3), 1) for _ in range(rng.randrange(1, 6))})
        tolerance = rng.choice(TOLERANCES)
        why = self.maker.bands("field.csv", "out.geojson", tolerance, levels)
        return self.judge(why, tolerance, has_areas=False, seems_whole=self.is_complete)

    def triangles(self, *_):
        why = self.maker.delaunay("field.csv", "out.geojson")
        return self.judge(why, TOLERANCES[0], has_areas=False, seems_whole=True)

    def clips(self, rng, name):
        outline = self.regions_of(name, self.write_polygons)
        if outline is None:
            return []
        tolerance = rng.choice(TOLERANCES)
        is_grouped = rng.random() < 0.3
        rules = [self.model, f"{name}.geojson", is_grouped]
        why = self.maker.clip("field.csv", "out.geojson", tolerance, *rules)
        return self.judge(why, tolerance, outline=outline)

    def write_polygons(self, rng, file):
        polygons = random_polygons(rng)
        if not polygons:
            return None
        self.write_features(file, map(feature_of, polygons))
        return Outline(shapely.boundary(polygons), 0)

    def countries(self, rng, name):
        """Regions that share borders."""
        owners, edges, outline = self.regions_of(name, self.write_countries)
        if not owners:
            return []
        tolerance = rng.choice(TOLERANCES)
        rules = [self.model, f"{name}.geojson", owners, edges, rng.random() < 0.3]
        why = self.maker.cut("field.csv", "out.geojson", tolerance, *rules)
        return self.judge(why, tolerance, outline=outline)

    def write_countries(self, rng, file):
        """Most of some cells, or of the boxes of a grid, joined to three regions."""
        tolerance = rng.choice(TOLERANCES)
        edges = rng.choice(["lonlat", "geodesic", "geodesic", "geodesic", "boxes"])
        if edges == "boxes":
            edges = "lonlat"
            geometries = [shapely.to_geojson(box) for box in random_boxes(rng)]
        else:
            geometries = self.other_cells(rng, file, tolerance)
        geometries = [geometry for geometry in geometries if rng.random() < 0.8]
        owners = [rng.choice("xyz") for _ in geometries]
        properties = [f'{{"owner":"{owner}"}}' for owner in owners]
        self.write_features(file, map(feature, properties, geometries))
        borders = shapely.boundary(shapely.from_geojson(geometries))
        return owners, edges, Outline(borders, tolerance if edges == "geodesic" else 0)

    def other_cells(self, rng, file, tolerance):
        with open(self.folder / "others.csv", "w", encoding="utf-8") as others:
            others.write("x,y,z\n")
            for _ in range(rng.choice([6, 20, 60])):
                others.write(",".join(repr(rng.gauss(0, 1)) for _ in range(3)) + "\n")
        self.maker.voronoi("others.csv", file, tolerance)
        text = (self.folder / file).read_text("utf-8")
        return re.findall(r'"geometry":(\{.*?\})\}', text)

    def write_features(self, name, features):
        text = ",\n".join(features)
        (self.folder / name).write_text(f'{{"type":"FeatureCollection","features":[{text}]}}')


PRODUCTS = ("cells", "bands", "triangles", "clips", "countries")
RANDOM_PRODUCTS = ("bands", "clips", "countries")


def run_all(options, report):
    """Judges files until the count or the time is reached; reports each fault, and counts files and geometries."""
    counts = {}
    end = time.monotonic() + 60 * (options.minutes or math.inf)
    numbers = itertools.count(options.first)
    if options.count or not options.minutes:
        numbers = itertools.islice(numbers, options.count or 1)
    with tempfile.TemporaryDirectory() as folder:
        maker = Bindings if options.bindings else Tool
        products = Products(options, maker(options.tool, folder))
        kinds = options.kinds.split(",") if options.kinds else products.maker.kinds()
        for number in numbers:
            products.begin(number)
            for kind in kinds:
                seed = f"{options.seed}/{number}/{kind}"
                rng = random.Random(seed)
                why = products.generate(kind, rng, rng.randrange(1 << 30))
                if why:
                    report(f"{seed}: {why}")
                    continue
                products.add_field(rng)
                for product, name in names_of(options):
                    if time.monotonic() > end:
                        return counts, products.num_geometries
                    faults = getattr(products, product)(random.Random(f"{seed}/{name}"), name)
                    counts[kind, product] = counts.get((kind, product), 0) + 1
                    for fault in faults[:3]:
                        report(f"{seed}/{name}: {fault}")
                    if faults and options.keep:
                        keep(folder, options.keep / f"{seed}/{name}".replace("/", "_"))
    return counts, products.num_geometries


def names_of(options):
    """Pairs of a product and its name in messages, which has the number of the repetition."""
    for product in PRODUCTS:
        if options.products and product not in options.products.split(","):
            continue
        for k in range(options.repeats if product in RANDOM_PRODUCTS else 1):
            yield product, f"{product}{k or ''}"


def keep(folder, target):
    target.mkdir(parents=True, exist_ok=True)
    for path in pathlib.Path(folder).iterdir():
        (target / path.name).write_bytes(path.read_bytes())


class Written(unittest.TestCase):
    def test_all_kinds(self):
        faults = []
        _, num_geometries = run_all(OPTIONS, faults.append)
        self.assertGreater(num_geometries, 0)
        self.assertEqual(faults, [])

    def test_the_judge_sees_faults(self):
        def polygon(*ring):
            return shapely.Polygon(ring)

        def judge(*geometries, **what):
            return list(faults_of(np.array(geometries, dtype=object), 0.01, **what))

        outline = Outline(shapely.boundary([shapely.box(0, 0, 4, 2)]), 0)
        low = polygon([0, 0], [4, 0], [4, 1], [0, 1])
        high = polygon([0, 1], [4, 1], [4, 2], [0, 2])
        self.assertEqual(judge(low, high, outline=outline), [])
        corner = polygon([0, 1], [2, 1], [4, 1], [4, 2], [0, 2])
        self.assertNotEqual(judge(low, corner, outline=outline), [])
        apart = polygon([0, 1.00000000000001], [4, 1], [4, 2], [0, 2])
        self.assertNotEqual(judge(low, apart, outline=outline), [])
        away = polygon([0, 1], [2, 1.00000000000001], [4, 1], [4, 2], [0, 2])
        self.assertNotEqual(judge(low, away, outline=outline), [])
        bow_tie = polygon([0, 1], [4, 2], [4, 1], [0, 2])
        self.assertNotEqual(judge(low, bow_tie, outline=outline), [])
        self.assertNotEqual(judge(low, high, whole=True), [])
        west = polygon([-180, -90], [0, -90], [0, 90], [-180, 90])
        east = polygon([0, -90], [180, -90], [180, 90], [0, 90])
        self.assertEqual(judge(west, east, seems_whole=True), [])
        east = polygon([0, -90], [180, -90], [180, 90], [0, 90], [1e-14, 3])
        self.assertNotEqual(judge(west, east, seems_whole=True), [])
        self.assertNotEqual(judge(None, areas=np.array([1e-3])), [])
        self.assertEqual(judge(low, areas=np.array([4 * (math.pi / 180) ** 2])), [])
        self.assertNotEqual(judge(low, areas=np.array([0.1])), [])
        self.assertNotEqual(judge(low, polygon([1, 0.5], [3, 0.5], [2, 0.9])), [])


def main():
    start = time.monotonic()
    faults = []
    counts, num_geometries = run_all(
        OPTIONS, lambda fault: (faults.append(fault), print(fault, flush=True))
    )
    for kind in dict.fromkeys(kind for kind, _ in counts):
        numbers = ", ".join(f"{counts.get((kind, p), 0)} {p}" for p in PRODUCTS)
        print(f"{kind}: {numbers}")
    print(
        f"{sum(counts.values())} files of {num_geometries} geometries, {len(faults)} faults, "
        f"{time.monotonic() - start:.0f} s"
    )
    return 1 if faults else 0


if __name__ == "__main__":
    OPTIONS = PARSER.parse_args()
    if OPTIONS.bindings:
        sys.path.insert(0, OPTIONS.bindings)
    if OPTIONS.count or OPTIONS.minutes or OPTIONS.kinds:
        sys.exit(main())
    unittest.main(argv=sys.argv[:1])
