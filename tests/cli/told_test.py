#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What files hold is written as it is, under names that mean one thing, or a line says what is not."""

import csv
import json
import math
import unittest

from tool_in_folder import ToolInFolder

try:
    from scipy.io import netcdf_file
except ImportError:
    netcdf_file = None



def point(lon, lat, properties, **members):
    geometry = {"type": "Point", "coordinates": [lon, lat]}
    return {"type": "Feature", "properties": properties, "geometry": geometry, **members}


def box(west, south, east, north, properties, **members):
    ring = [[west, south], [east, south], [east, north], [west, north], [west, south]]
    geometry = {"type": "Polygon", "coordinates": [ring]}
    return {"type": "Feature", "properties": properties, "geometry": geometry, **members}


class Told(ToolInFolder):
    def succeed(self, *arguments, told=""):
        done = self.tool(*arguments, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, told), arguments)

    def refuse(self, status, message, *arguments):
        done = self.tool(*arguments)
        self.assertEqual((done.returncode, done.stderr), (status, f"rondel: {message}\n"), arguments)

    def write(self, name, *features):
        text = json.dumps({"type": "FeatureCollection", "features": features})
        (self.folder / name).write_text(text, "utf-8")

    def features(self, name):
        return json.loads((self.folder / name).read_text("utf-8"))["features"]


class Properties(Told):
    PROPERTIES = (
        {"b": True, "n": None, "e": "", "l": [1, {"a": "x"}], "o": {}, "m": "1", "w": 2**64 - 1, "d": 0.25},
        {"b": False, "n": "t", "e": None, "l": [], "o": {"k": [None]}, "m": 1, "w": 10**30, "d": -1e-300},
        {"b": "true", "n": 0, "e": "", "m": None, "w": -(2**63), "d": 3},
    )

    def check(self, found, number):
        for feature, given in zip(found, self.PROPERTIES, strict=True):
            own = {name: value for name, value in feature["properties"].items() if name not in ("area", number)}
            wanted = {**dict.fromkeys("lo"), **given}
            self.assertEqual(own, wanted)
            self.assertEqual({k: type(v) for k, v in own.items()}, {k: type(v) for k, v in wanted.items()})

    def test_of_geojson_keep_their_types(self):
        places = ((0, 0), (120, 10), (-120, 30))
        self.write("points.geojson", *(point(*at, p) for at, p in zip(places, self.PROPERTIES)))
        self.write("boxes.geojson", *(box(*at, at[0] + 9, at[1] + 9, p) for at, p in zip(places, self.PROPERTIES)))
        self.write("all.geojson", box(-180, -90, 180, 90, {}))
        for options in ((), ("--clip", "all.geojson")):
            self.succeed("voronoi", "points.geojson", "-o", "cells.geojson", *options)
            self.check(self.features("cells.geojson"), "site")
        self.succeed("voronoi", "boxes.geojson", "--densify", "90", "-o", "cells.geojson")
        self.check(self.features("cells.geojson"), "feature")

    def test_ids_are_those_of_the_features(self):
        several = {"type": "MultiPoint", "coordinates": [[10, 20], [30, -40]]}
        self.write("points.geojson", point(0, 0, {}, id="a"), point(90, 0, {}),
                   {**point(0, 0, {}, id="two"), "geometry": several}, point(-90, 50, {}, id=7))
        self.write("boxes.geojson", box(0, 0, 9, 9, {}, id=2**53 + 1), box(50, 0, 59, 9, {"id": "own"}))
        self.write("all.geojson", box(-180, -90, 180, 90, {"v": 1}))
        for options in ((), ("--clip", "all.geojson")):
            self.succeed("voronoi", "points.geojson", "-o", "cells.geojson", *options)
            ids = [feature.get("id") for feature in self.features("cells.geojson")]
            self.assertEqual(ids, ["a", None, None, None, 7])
        self.succeed("voronoi", "points.geojson", "-o", "cut.geojson", "--clip", "all.geojson", "--clip-value", "v")
        self.assertFalse(any("id" in feature for feature in self.features("cut.geojson")))
        self.succeed("voronoi", "boxes.geojson", "--densify", "90", "-o", "cells.geojson")
        found = self.features("cells.geojson")
        self.assertEqual([feature.get("id") for feature in found], [2**53 + 1, None])
        self.assertEqual([feature["properties"]["id"] for feature in found], [None, "own"])

    def test_that_meshes_do_not_have_are_told(self):
        self.write("sea.geojson", box(0, 0, 20, 10, {"basin": "A", "kind": 1}))
        self.write("island.geojson", box(5, 4, 7, 6, {f"p{k:02}": k for k in range(20)}))
        self.write("bare.geojson", box(0, 0, 20, 10, {}))
        names = ", ".join(f"p{k:02}" for k in range(12))
        lost = "properties that the output does not have:"
        of_island = f"rondel: island.geojson: {lost} {names} and 8 more\n"
        of_sea = f"rondel: sea.geojson: {lost} basin, kind\n"
        mesh = ("mesh", "triangles", "-o", "mesh.14", "--spacing", "500", "--area")
        self.succeed(*mesh, "sea.geojson", "--coast", "island.geojson", told=of_island + of_sea)
        self.succeed(*mesh, "bare.geojson")
        message = "sea.geojson: nothing is left for triangles: the land covers the area"
        self.refuse(1, message, *mesh, "sea.geojson", "--coast", "sea.geojson")
        for ending in ("14", "ply", "geojson"):
            told = of_sea
            if ending == "14":  # the northern side is a parallel, north of which the hull goes
                told = ("rondel: sea.geojson: 63 triangles on the border are left out, which have no area in "
                        "degrees, as the sites are on one line\n" + of_sea)
            self.succeed("triangulate", "sea.geojson", "-o", f"mesh.{ending}", told=told)
        self.succeed("triangulate", "sea.geojson", "-o", "faces.npy")

    def test_with_a_zero_are_refused(self):
        fault = "has the character \\u0000, at which texts end in other formats"
        self.write("p.geojson", point(0, 0, {"a": "x"}), point(9, 9, {"a": "x\0y"}))
        self.write("b.geojson", box(0, 0, 9, 9, {"k\0": 1}))
        (self.folder / "t.csv").write_text("lon,lat,a\n0,0,x\n9,9,x\0\n")
        self.refuse(1, f'p.geojson:1: feature 1: the text in column "a" {fault}', "voronoi", "p.geojson", "-o", "o.geojson")
        for command in (("remap", "grid:90", "b.geojson", "-o", "o.nc"),
                        ("voronoi", "b.geojson", "--densify", "9", "-o", "o.geojson")):
            self.refuse(1, f'b.geojson:1: feature 0: the name of the column "k?" {fault}', *command)
        self.refuse(1, f't.csv:3: the text in column "a" {fault}', "voronoi", "t.csv", "-o", "o.geojson")
        self.assertFalse(list(self.folder.glob("o.*")))


class Names(Told):
    def test_computed_columns_keep_theirs(self):
        (self.folder / "s.csv").write_text("lon,lat,area,area_km2,site\n" + "".join(
            f"{lon},{lat},old,1,x\n" for lon, lat in ((0, 0), (90, 5), (180, 0), (-90, 0), (0, 80), (3, -70))))
        self.succeed("voronoi", "s.csv", "-o", "c.geojson", "--earth-radius", "6371.0088")
        found = [feature["properties"] for feature in self.features("c.geojson")]
        self.assertEqual([p["site"] for p in found], [0, 1, 2, 3, 4, 5])
        self.assertAlmostEqual(sum(p["area"] for p in found), 4 * math.pi, 9)
        self.assertAlmostEqual(sum(p["area_km2"] for p in found) / (4 * math.pi * 6371.0088**2), 1, 9)
        self.assertEqual({(p["area_"], p["area_km2_"], p["site_"]) for p in found}, {("old", 1, "x")})
        self.succeed("voronoi", "s.csv", "-o", "g.geojson", "--earth-radius", "2", "--group", "area_km2")
        self.assertAlmostEqual(self.features("g.geojson")[0]["properties"]["area_km2"], 16 * math.pi, 9)
        self.assertEqual(self.features("g.geojson")[0]["properties"]["area_km2_"], 1)
        self.succeed("nearest", "s.csv", "s.csv", "--column", "site", "-o", "n.csv")
        self.assertEqual((self.folder / "n.csv").read_text().splitlines()[:2], ["query,site,distance_deg,site_", "0,0,0,x"])

    def test_are_the_same_in_tables_and_netcdf(self):
        self.write("b.geojson", *(box(10 * k, 0, 10 * k + 9, 9, {"x": k + 0.5, "lat": f"t{k}", "lat_": 2**60 + 1 + k})
                                  for k in range(3)))
        self.succeed("remap", "grid:90", "b.geojson", "-o", "w.nc")
        (self.folder / "v.csv").write_text("x\n" + "".join(f"{k}\n" for k in range(8)))
        self.succeed("apply", "w.nc", "v.csv", "--value", "x", "-o", "o.csv")
        with open(self.folder / "o.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["lon", "lat", "x_", "lat_", "lat__", "x"])
        self.assertEqual([(r["x_"], r["x"], r["lat_"], r["lat__"]) for r in rows],
                         [(f"{k + 0.5}", "6", f"t{k}", f"{2**60 + 1 + k}") for k in range(3)])
        if netcdf_file is None:
            self.skipTest("scipy is not installed")
        self.succeed("apply", "w.nc", "v.csv", "--value", "x", "-o", "o.nc", "--kind", "cdf2")
        with netcdf_file(self.folder / "o.nc", mmap=False) as file:
            self.assertEqual(sorted(file.variables), ["lat", "lat_", "lat__", "lon", "x", "x_"])
            self.assertEqual(file.variables["x"][:].tolist(), [6, 6, 6])
            self.assertEqual(file.variables["x_"][:].tolist(), [0.5, 1.5, 2.5])
            texts = [b"".join(row).decode() for row in file.variables["lat__"][:]]  # no double has them
            self.assertEqual(texts, [f"{2**60 + 1 + k}" for k in range(3)])


class Orders(Told):
    def setUp(self):
        super().setUp()
        self.write("b.geojson", *(box(20 * k, 0, 20 * k + 9, 9, {}) for k in range(4)), {**box(0, 0, 1, 1, {}), "geometry": None})
        self.succeed("remap", "b.geojson", "grid:30", "-o", "w.nc")
        self.succeed("remap", "grid:30", "b.geojson", "-o", "back.nc")
        (self.folder / "v.csv").write_text("v\n" + "".join(f"{k}\n" for k in range(72)))
        self.succeed("apply", "back.nc", "v.csv", "--value", "v", "-o", "right.csv")
        self.rows = (self.folder / "right.csv").read_text().splitlines()
        self.assertEqual(self.rows[-1], ",,")

    def test_are_compared_where_places_are_known(self):
        self.succeed("apply", "w.nc", "right.csv", "--value", "v", "-o", "o.npy")
        fault = "its points are not the sources of w.nc, or not in this order"
        for name, order in (("reversed", [5, 4, 3, 2, 1]), ("swapped", [2, 1, 3, 4, 5]), ("turned", [2, 3, 4, 5, 1])):
            (self.folder / f"{name}.csv").write_text("\n".join([self.rows[0], *(self.rows[k] for k in order)]) + "\n")
            self.refuse(1, f"{name}.csv: {fault}", "apply", "w.nc", f"{name}.csv", "--value", "v", "-o", "x.npy")
        self.assertFalse((self.folder / "x.npy").exists())

    def test_of_places_that_are_none_are_told(self):
        (self.folder / "bad.csv").write_text("lon,lat,v\n" + "1,2,3\n" * 4 + "1,north,3\n")
        self.refuse(1, 'bad.csv:6: latitude "north" is not a number', "apply", "w.nc", "bad.csv", "--value", "v", "-o", "x.npy")
        (self.folder / "none.csv").write_text("x,v\n" + "1,3\n" * 5)  # no columns of places
        self.succeed("apply", "w.nc", "none.csv", "--value", "v", "-o", "o.npy")


class Messages(Told):
    def test_of_groups_without_a_cell(self):
        (self.folder / "s.csv").write_text("lon,lat,g\n0,0,a\n90,0,b\n90,0,c\n-90,10,a\n450,0,c\n0,0,a\n")
        told = "rondel: s.csv: 1 group of 'g' has no cell, as all sites are hidden or at the place of one before ('c')\n"
        self.succeed("voronoi", "s.csv", "--group", "g", "-o", "o.geojson", told=told)
        self.assertEqual([f["properties"]["g"] for f in self.features("o.geojson")], ["a", "b"])

    def test_of_features_without_a_cell(self):
        one = box(0, 0, 9, 9, {"name": "one"})
        nowhere = {**one, "geometry": None}
        self.write("f.geojson", one, one, nowhere, box(1, 1, 2, 2, {"name": "in"}), box(50, 0, 59, 9, {}), one)
        covered = "rondel: f.geojson: 3 features have no cell, as others before have all of their places (first 1 (one))\n"
        options = ("voronoi", "f.geojson", "--densify", "100", "--overlap", "first", "-o", "o.geojson")
        self.succeed(*options, told=covered)
        done = self.tool(*options)
        self.assertEqual(done.stderr, "rondel: f.geojson: left out 1 feature without a place\n" + covered)
        self.assertEqual([f["properties"]["feature"] for f in self.features("o.geojson")], [0, 4])
        self.write("all.geojson", box(-180, -90, 180, 90, {}))
        self.succeed(*options, "--clip", "all.geojson", told=covered)

    def test_of_areas_that_are_not_reached(self):
        rows = [(lon, lat) for lon in range(-170, 180, 20) for lat in range(-80, 90, 20)]
        text = "lon,lat,a\n" + "".join(f"{lon},{lat},{1000 if k == 0 else 1}\n" for k, (lon, lat) in enumerate(rows))
        (self.folder / "big.csv").write_text(text)
        for options in ((), ("--quiet",)):
            done = self.tool("mesh", "equal-area", "big.csv", "--area", "a", "-o", "o.csv", *options)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"\Arondel: big\.csv: the areas are not reached: \w+ after .* big\.csv:\d+\n\Z")
        results = []
        for unit in ("1", "1e308", "1e-320"):  # in any unit
            text = "lon,lat,a\n" + "".join(f"{lon},{lat},{unit}\n" for lon, lat in rows)
            (self.folder / "equal.csv").write_text(text)
            self.succeed("mesh", "equal-area", "equal.csv", "--area", "a", "-o", "o.csv")
            results.append((self.folder / "o.csv").read_text())
        self.assertEqual(results[0], results[1])

    def test_of_sums_whose_fractions_are_not_known(self):
        self.write("b.geojson", box(0, 0, 30, 30, {}))
        self.succeed("remap", "b.geojson", "grid:20", "-o", "w.nc")
        done = self.tool("check-weights", "w.nc")
        self.assertIn("sums of rows are the fractions to ", done.stdout)
        if netcdf_file is None:
            self.skipTest("scipy is not installed")
        data = bytearray((self.folder / "w.nc").read_bytes())
        with netcdf_file(self.folder / "w.nc", mmap=False) as file:
            fractions = file.variables["frac_b"][:].astype(">f8").tobytes()
            least = min(value for value in file.variables["frac_b"][:] if value > 0)
        at = bytes(data).index(fractions)
        data[at : at + len(fractions)] = bytes(len(fractions))
        (self.folder / "none.nc").write_bytes(data)
        done = self.tool("check-weights", "none.nc")
        self.assertEqual(done.returncode, 0)
        self.assertIn(f", the least {least:.3g} (the fractions of the targets are not known)\n", done.stdout)
        self.assertIn("sums of rows are at most 1 to ", done.stdout)


class Options(Told):
    def test_without_effect_are_refused(self):
        (self.folder / "s.csv").write_text("lon,lat\n0,0\n90,0\n180,0\n-90,0\n0,90\n0,-90\n")
        self.write("b.geojson", box(0, 0, 9, 9, {}))
        cells = ("voronoi", "s.csv", "-o", "o.geojson")
        features = ("voronoi", "b.geojson", "--densify", "9", "-o", "o.geojson")
        input_of_features = "with --densify, whose INPUT has lines and polygons"
        for command, option, where in (
            (cells, ("--edges", "geodesic"), "without --clip or --densify"),
            (cells, ("--overlap", "first"), "without --clip-value or --densify"),
            ((*cells, "--clip", "b.geojson"), ("--overlap", "error"), "without --clip-value or --densify"),
            (features, ("--radius", "r"), input_of_features),
            (features, ("--model", "projected"), input_of_features),
        ):
            with self.subTest(option=option, command=command):
                self.refuse(2, f"{option[0]} has no effect {where}", *command, *option)
        self.assertFalse(list(self.folder.glob("o.*")))


if __name__ == "__main__":
    unittest.main()
