#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Fine spacings in areas, read back from the meshes and compared with formulas.

Without NumPy ctest says "Skipped".
"""

import importlib.util
import json
import math
import sys
import unittest

if importlib.util.find_spec("numpy") is None:
    sys.exit(77)
import numpy as np
from tool_in_folder import ToolInFolder

RADIUS_KM = 6371.229


def vectors(lonlat):
    """Unit vectors of degrees."""
    lon, lat = np.radians(np.asarray(lonlat, float)).T
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=1)


def box(west, south, east, north):
    return [[west, south], [east, south], [east, north], [west, north], [west, south]]


def island(lon, lat, radius_deg, corners=60):
    """A ring around a place, counterclockwise."""
    turns = [2 * math.pi * (k % corners) / corners for k in range(corners + 1)]
    return [[lon + radius_deg * math.cos(t) / math.cos(math.radians(lat)), lat + radius_deg * math.sin(t)]
            for t in turns]


class Meshes(ToolInFolder):
    def write(self, name, geometry, coordinates):
        (self.folder / name).write_text(json.dumps({"type": geometry, "coordinates": coordinates}))

    def mesh(self, *options):
        """The nodes as unit vectors, the edges and what the tool says on standard error."""
        done = self.tool("mesh", "triangles", *options, "-o", "mesh.14", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = (self.folder / "mesh.14").read_text().splitlines()
        triangles, nodes = (int(word) for word in lines[1].split())
        points = vectors([line.split()[1:3] for line in lines[2:2 + nodes]])
        corners = np.array([line.split()[2:] for line in lines[2 + nodes:2 + nodes + triangles]], int) - 1
        edges = np.unique(np.sort(corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        return points, edges, done.stderr

    def ratios(self, points, edges, wanted):
        """The lengths of edges over the smaller one of the wanted spacings at their ends, all in kilometers."""
        chords = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
        return 2 * np.arcsin(chords / 2) * RADIUS_KM / wanted[edges].min(axis=1)


def kilometers_to(line, points, part_km=0.05):
    """The distances of points from a ring, by places on it that are less than part_km apart."""
    ends = vectors(line)
    places = []
    for a, b in zip(ends[:-1], ends[1:]):
        number = max(1, math.ceil(np.linalg.norm(b - a) * RADIUS_KM / part_km))
        share = np.arange(number)[:, None] / number
        places.append(a + share * (b - a))
    places = np.concatenate(places)
    places /= np.linalg.norm(places, axis=1)[:, None]
    nearest = np.full(len(points), np.inf)
    for some in np.array_split(places, max(1, len(places) // 64)):
        np.minimum(nearest, np.linalg.norm(points[:, None] - some[None], axis=2).min(axis=1), out=nearest)
    return 2 * np.arcsin(nearest / 2) * RADIUS_KM


class Refinement(Meshes):
    def grown(self, points, lines, near, wide, slope=0.05):
        distances = np.minimum.reduce([kilometers_to(line, points) for line in lines])
        return distances, np.minimum(wide, near + slope * distances)

    def test_coast_of_a_hundred_metres_in_an_area_of_five_degrees(self):
        ring = island(2.5, 42.5, 0.02)
        self.write("area.geojson", "Polygon", [box(0, 40, 5, 45)])
        self.write("coast.geojson", "Polygon", [ring])
        points, edges, said = self.mesh("--area", "area.geojson", "--coast", "coast.geojson",
                                        "--spacing", "50", "--refine", "coast.geojson:0.1")
        self.assertEqual(said, "")
        distances, wanted = self.grown(points, [ring], 0.1, 50)
        ratios = self.ratios(points, edges, wanted)
        self.assertLessEqual(ratios.max(), 1.6)
        at_coast = (distances[edges] < 0.1).all(axis=1)
        self.assertGreater(at_coast.sum(), 100)
        self.assertLessEqual(self.ratios(points, edges, np.full(len(points), 0.1))[at_coast].max(), 1.55)
        # Far away the mesh is coarse: it does not have the fine spacing everywhere.
        self.assertGreater(np.median(ratios), 0.6)

    def test_places_everywhere_around_the_globe(self):
        for name, area, center in (("pole", box(-180, 89, 180, 90), None),
                                   ("antimeridian", box(179, -18, 181, -16), (180, -17)),
                                   ("meridian", box(-1, 50, 1, 52), (0, 51))):
            with self.subTest(name):
                ring = island(*center, 0.05) if center else [[lon, 89.9] for lon in range(-180, 181, 5)]
                self.write("area.geojson", "Polygon", [area])
                self.write("line.geojson", "LineString", ring)
                points, edges, said = self.mesh("--area", "area.geojson", "--spacing", "20",
                                                "--lines", "line.geojson", "--refine", "line.geojson:0.5")
                self.assertEqual(said, "")
                distances, wanted = self.grown(points, [ring], 0.5, 20)
                self.assertLess(distances.min(), 0.01)
                self.assertLessEqual(self.ratios(points, edges, wanted).max(), 1.6)

    def test_what_is_outside_of_the_area_counts_by_its_distance(self):
        inside, outside = island(10.5, 0.5, 0.01), island(11.1, 0.5, 0.01)
        self.write("area.geojson", "Polygon", [box(10, 0, 11, 1)])
        self.write("coast.geojson", "MultiPolygon", [[inside], [outside], [island(-120, 40, 5)]])
        points, edges, said = self.mesh("--area", "area.geojson", "--spacing", "10", "--refine",
                                        "coast.geojson:0.5")
        self.assertEqual(said, "")
        _, wanted = self.grown(points, [inside, outside], 0.5, 10)
        ratios = self.ratios(points, edges, wanted)
        self.assertLessEqual(ratios.max(), 1.6)
        # Beside the island that is outside, edges are shorter than without it.
        _, alone = self.grown(points, [inside], 0.5, 10)
        is_beside = (kilometers_to(outside, points)[edges] < 15).all(axis=1)
        self.assertTrue(is_beside.any())
        self.assertLess(self.ratios(points, edges, alone)[is_beside].max(), 0.8)

    def test_areas_of_a_hundred_metres(self):
        metre = 1e-3 / 111.2
        area = box(7, 60, 7 + 200 * metre, 60 + 100 * metre)
        self.write("area.geojson", "Polygon", [area])
        points, edges, said = self.mesh("--area", "area.geojson", "--spacing", "0.005", "--refine",
                                        "area.geojson:0.001", "--gradient", "0.2")
        self.assertEqual(said, "")
        distances = kilometers_to(area, points, 1e-4)
        wanted = np.minimum(0.005, 0.001 + 0.2 * distances)
        self.assertLessEqual(self.ratios(points, edges, wanted).max(), 1.6)

    def test_spacing_that_the_raster_is_too_coarse_for_is_told(self):
        self.write("area.geojson", "Polygon", [box(-25, -25, 25, 25)])
        self.write("buoy.geojson", "Point", [1, 1])
        _, _, said = self.mesh("--area", "area.geojson", "--spacing", "1000", "--refine", "buoy.geojson:0.02")
        self.assertRegex(said, r"^rondel: buoy.geojson: --refine: the spacing there is up to 0.\d+ kilometers, "
                               r"since spacings are kept on a raster with steps of up to 1.\d+ km\n$")

    def test_areas_that_have_no_region_are_meshed_as_before(self):
        # Two boxes at opposite places, and a hemisphere.
        self.write("far.geojson", "MultiPolygon", [[box(0, 0, 5, 5)], [box(178, 0, 182, 5)]])
        self.write("half.geojson", "Polygon", [box(-90, -89, 90, 89)])
        self.write("buoy.geojson", "Point", [2, 2])
        for name in ("far.geojson", "half.geojson"):
            points, edges, _ = self.mesh("--area", name, "--spacing", "500", "--refine", "buoy.geojson:100")
            _, wanted = self.grown(points, [[[2, 2], [2, 2]]], 100, 500)
            self.assertLessEqual(self.ratios(points, edges, wanted).max(), 1.6)


class FilesOfSpacings(Meshes):
    def test_channel_of_a_hundred_metres(self):
        # A channel of 600 m across, in a grid of about 100 m.
        lon = np.linspace(3, 3.3, 334)
        lat = np.linspace(50, 50.2, 223)
        x, y = np.meshgrid(lon, lat)

        def wanted_at(x, y):
            distances = np.abs(y - 50.1 - 0.02 * np.sin(40 * (x - 3))) * 111.2
            return np.clip(0.1 + 0.3 * (distances - 0.3), 0.1, 3)

        rows = np.stack([x.ravel(), y.ravel(), wanted_at(x, y).ravel()], axis=1)
        text = "lon,lat,h\n" + "\n".join(",".join(f"{v:.9g}" for v in row) for row in rows) + "\n"
        (self.folder / "h.csv").write_text(text)
        self.write("area.geojson", "Polygon", [box(3.01, 50.01, 3.29, 50.19)])
        points, edges, said = self.mesh("--area", "area.geojson", "--spacing", "h.csv:h")
        self.assertEqual(said, "")
        lon = np.degrees(np.arctan2(points[:, 1], points[:, 0]))
        wanted = wanted_at(lon, np.degrees(np.arcsin(points[:, 2])))
        ratios = self.ratios(points, edges, wanted)
        self.assertLessEqual(ratios.max(), 1.8)
        self.assertLessEqual(ratios[(wanted[edges] == 0.1).all(axis=1)].max(), 1.55)
        self.assertGreater((wanted == 0.1).sum(), 1000)

    def test_places_that_do_not_cover_the_area_are_told(self):
        (self.folder / "h.csv").write_text("lon,lat,h\n0,0,5\n1,0,5\n1,1,20\n0,1,20\n0.5,0.5,10\n")
        self.write("area.geojson", "Polygon", [box(0.2, 0.2, 3, 0.8)])
        points, edges, said = self.mesh("--area", "area.geojson", "--spacing", "h.csv:h")
        self.assertIn("the mesh goes beyond: there the value of the nearest place counts", said)
        self.assertNotIn("raster", said)
        self.write("area.geojson", "Polygon", [box(50, 0, 51, 1)])
        points, edges, said = self.mesh("--area", "area.geojson", "--spacing", "h.csv:h")
        self.assertIn("the mesh goes beyond", said)
        self.assertLessEqual(self.ratios(points, edges, np.full(len(points), 20)).max(), 1.55)


if __name__ == "__main__":
    unittest.main(verbosity=2)
