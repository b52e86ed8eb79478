#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Standard input is read wherever a file may be; numbers and places that are none are refused; contradictions are told."""

import csv
import json
import math
import re
import unittest

from told_test import Told, box, netcdf_file

SITES = "lon,lat,v\n0,0,1\n90,5,2\n180,0,3\n-90,0,4\n0,80,5\n3,-70,6\n"


class WithSites(Told):
    def setUp(self):
        super().setUp()
        (self.folder / "s.csv").write_text(SITES)
        self.write("b.geojson", box(0, 0, 30, 30, {"name": "b"}))

    def pipe(self, name, *arguments, status=0, told=""):
        with open(self.folder / name, "rb") as file:
            done = self.tool(*arguments, "--quiet", stdin=file)
        self.assertEqual((done.returncode, done.stderr), (status, told), arguments)

    def require_equal(self, a, b):
        self.assertEqual((self.folder / a).read_bytes(), (self.folder / b).read_bytes())


class Pipes(WithSites):
    def test_have_the_format_that_is_named(self):
        self.succeed("remap", "s.csv", "b.geojson", "-o", "file.nc")
        for name in ("-", "/dev/stdin"):
            self.pipe(
                "b.geojson", "remap", "s.csv", name, "--input-format", "geojson", "-o", "pipe.nc"
            )
            self.require_equal("file.nc", "pipe.nc")
        self.pipe("s.csv", "remap", "-", "b.geojson", "-o", "pipe.nc")
        self.require_equal("file.nc", "pipe.nc")
        self.succeed("generate", "uniform", "-n", "5", "-o", "t.npy")
        self.succeed("interpolate", "s.csv", "--to", "t.npy", "--value", "v", "-o", "file.csv")
        self.pipe(
            "t.npy",
            "interpolate",
            "s.csv",
            "--to",
            "-",
            "--input-format",
            "npy",
            "--value",
            "v",
            "-o",
            "pipe.csv",
        )
        self.require_equal("file.csv", "pipe.csv")

    def test_have_values(self):
        self.succeed("remap", "s.csv", "grid:30", "-o", "w.nc")
        (self.folder / "bare.csv").write_text(
            "v,u\n" + "".join(f"{k},\n" for k in range(1, 7))
        )  # the same, without places
        (self.folder / "v.tsv").write_text(SITES.replace(",", "\t"))
        self.succeed("apply", "w.nc", "s.csv", "--value", "v", "-o", "file.npy")
        for name, form in (
            ("s.csv", ()),
            ("s.csv", ("--input-format", "csv")),
            ("bare.csv", ()),
            ("v.tsv", ("--input-format", "tsv")),
        ):
            self.pipe(name, "apply", "w.nc", "-", "--value", "v", "-o", "pipe.npy", *form)
            self.require_equal("file.npy", "pipe.npy")
        self.pipe(
            "file.npy",
            "apply",
            "w.nc",
            "-",
            "--input-format",
            "npy",
            "-o",
            "x.npy",
            status=1,
            told="rondel: <stdin>: shape (72,) where (n,) or (fields, n) in C order is needed, n being 6\n",
        )
        self.succeed("remap", "grid:30", "b.geojson", "-o", "back.nc")
        self.succeed("apply", "back.nc", "file.npy", "-o", "back.csv")
        self.pipe("file.npy", "apply", "back.nc", "-", "--input-format", "npy", "-o", "pipe.csv")
        self.require_equal("back.csv", "pipe.csv")
        self.succeed("apply", "w.nc", "s.csv", "--value", "v", "-o", "grid.nc")
        self.succeed("apply", "back.nc", "grid.nc", "--value", "v", "-o", "back.csv")
        self.pipe(
            "grid.nc",
            "apply",
            "back.nc",
            "-",
            "--input-format",
            "nc",
            "--value",
            "v",
            "-o",
            "pipe.csv",
        )
        self.require_equal("back.csv", "pipe.csv")

    def test_with_other_sources_are_refused(self):
        self.succeed("remap", "s.csv", "grid:30", "-o", "w.nc")
        lines = SITES.splitlines()
        (self.folder / "turned.csv").write_text("\n".join([lines[0], *lines[2:], lines[1]]) + "\n")
        (self.folder / "few.csv").write_text("\n".join(lines[:-1]) + "\n")
        (self.folder / "text.csv").write_text(SITES.replace(",4\n", ",four\n"))
        for name, fault in (
            ("turned.csv", "-: its points are not the sources of w.nc, or not in this order"),
            ("few.csv", "<stdin>: 5 rows for 6 points"),
            ("text.csv", "<stdin>:5: v 'four' is not a number"),
        ):
            self.pipe(
                name,
                "apply",
                "w.nc",
                "-",
                "--value",
                "v",
                "-o",
                "x.npy",
                status=1,
                told=f"rondel: {fault}\n",
            )
        self.assertFalse((self.folder / "x.npy").exists())


    def test_rows_without_a_place_are_no_sources(self):
        """Weights of a table count the rows that have places; so do its values, from either input."""
        lines = SITES.splitlines()
        (self.folder / "gaps.csv").write_text("\n".join([*lines[:3], ",,1000", *lines[3:], ",,"]) + "\n")
        self.succeed("interpolate", "gaps.csv", "--to", "grid:30", "--weights", "w.nc")
        self.succeed("interpolate", "s.csv", "--to", "grid:30", "--value", "v", "-o", "wanted.csv")
        told = "left out 2 rows without a place, as the weights do\n"
        found = self.tool("apply", "w.nc", "gaps.csv", "--value", "v", "-o", "file.csv")
        self.assertEqual(found.returncode, 0)
        self.assertIn(f"rondel: gaps.csv: {told}", found.stderr)
        self.pipe("gaps.csv", "apply", "w.nc", "-", "--value", "v", "-o", "pipe.csv", told=f"rondel: <stdin>: {told}")
        self.require_equal("wanted.csv", "file.csv")
        self.require_equal("wanted.csv", "pipe.csv")
        # The rows must be those of the weights.
        (self.folder / "other.csv").write_text("\n".join([lines[0], ",,1000", *lines[2:], lines[1], ",,"]) + "\n")
        found = self.tool("apply", "w.nc", "other.csv", "--value", "v", "-o", "x.csv")
        self.assertEqual(found.returncode, 1)
        self.assertIn("its points are not the sources of w.nc", found.stderr)


class Numbers(WithSites):
    def test_beyond_all_numbers_are_no_fill(self):
        self.succeed("remap", "s.csv", "b.geojson", "-o", "w.nc")
        for text in ("1e400", "-1e400", "inf", "none", "0x10"):
            done = self.tool(
                "apply", "w.nc", "s.csv", "--value", "v", f"--fill={text}", "-o", "x.npy"
            )
            self.assertEqual(done.returncode, 2, text)
            self.assertRegex(done.stderr, f"\\Arondel: --fill: '{text}' is not .*\n\\Z")
        for text in ("nan", "NaN", "-1e300", "0"):
            self.succeed("apply", "w.nc", "s.csv", "--value", "v", f"--fill={text}", "-o", "x.npy")

    def test_of_cells_are_named(self):
        self.refuse(
            1,
            "--spacing 20000: spacings of 2e+04 to 2e+04 kilometers are those of 1.5 cells, fewer than 12: are they "
            "kilometers?",
            "mesh",
            "scvt",
            "--spacing",
            "20000",
            "-o",
            "m.nc",
        )

    @unittest.skipIf(netcdf_file is None, "scipy is not installed")
    def test_that_are_no_places_are_no_targets(self):
        self.succeed("remap", "s.csv", "grid:90", "-o", "w.nc", "--kind", "cdf2")
        (self.folder / "n.nc").write_bytes((self.folder / "w.nc").read_bytes())
        for name, index, value, text in (
            ("yc_b", 7, 115, "135 and 115"),
            ("xc_b", 2, math.inf, "45 and -45"),
            ("yc_a", 3, -91, "-90 and -91"),
        ):
            (self.folder / "n.nc").write_bytes((self.folder / "w.nc").read_bytes())
            with netcdf_file(self.folder / "n.nc", "a", mmap=False) as file:
                file.variables[name][index] = value
            shown = text if value != math.inf else "inf and -45"
            side = name[-2:]
            fault = (
                f'n.nc: value {index} of "xc{side}" and "yc{side}", {shown} degrees, is no place'
            )
            self.refuse(1, fault, "apply", "n.nc", "s.csv", "--value", "v", "-o", "x.csv")
            self.refuse(1, fault, "check-weights", "n.nc")
        self.assertFalse((self.folder / "x.csv").exists())
        with netcdf_file(
            self.folder / "w.nc", "a", mmap=False
        ) as file:  # no place, as of a feature without geometry
            file.variables["yc_b"][7] = math.nan
        self.succeed("apply", "w.nc", "s.csv", "--value", "v", "-o", "x.csv")
        self.assertTrue((self.folder / "x.csv").read_text().splitlines()[8].startswith(",,"))


class Remarks(WithSites):
    def test_of_spacings(self):
        rows = [(lon, lat, 5000) for lon in range(-180, 180, 60) for lat in (-60, 0, 60)]
        text = "lon,lat,h\n" + "".join(f"{lon},{lat},{h}\n" for lon, lat, h in rows)
        (self.folder / "h.csv").write_text(text + "360,0,4000\n10,10,\n")
        self.succeed(
            "mesh",
            "scvt",
            "--spacing",
            "h.csv:h",
            "-o",
            "m.nc",
            told="rondel: h.csv: 1 of 20 places has no value: it is interpolated between the others\n"
            "rondel: h.csv: 1 of 19 places is at the place of another one with another value: of each place the first value counts\n",
        )
        (self.folder / "h.csv").write_text(text)
        self.succeed("mesh", "scvt", "--spacing", "h.csv:h", "-o", "m.nc")

    def test_of_files_without_anything(self):
        self.write("e.geojson")
        (self.folder / "e.csv").write_text("lon,lat\n")
        self.succeed("mesh", "icosahedral", "1", "-o", "m.nc")
        points, features = "there are no points", "there are no features"
        for words, said in (
            ("delaunay e.geojson -o t.npy", points),
            ("delaunay e.csv -o t.npy", points),
            ("nearest s.csv e.csv -o o.csv", points),
            ("interpolate s.csv --value v --to e.geojson -o o.csv", points),
            ("voronoi s.csv --clip e.geojson -o o.geojson", features),
            ("regions e.geojson --densify 1 -o o.geojson", features),
            ("mesh cull m.nc --inside e.geojson -o o.nc", features),
        ):
            name = "e.csv" if "e.csv" in words else "e.geojson"
            self.succeed(*words.split(), told=f"rondel: {name}: {said}\n")
        for words in (
            "remap e.csv grid:90 -o o.nc",
            "remap grid:90 e.csv -o o.npz",
            "interpolate s.csv --to e.csv --weights o.npz",
        ):
            self.refuse(1, f"e.csv: {points}", *words.split())
        self.refuse(1, "e.geojson: there are no cells", *"remap e.geojson grid:90 -o o.nc".split())

    def test_of_sites_in_one_place(self):
        (self.folder / "two.csv").write_text(SITES + "90,5,7\n")
        (self.folder / "zero.csv").write_text("x,y,z\n1,0,0\n0,0,0\n")
        scvt = ("mesh", "scvt", "-o", "o.csv")
        cells = ("-n", "42", "--fixed", "s.csv")
        self.refuse(1, "two.csv:8: site 6 is in the place of site 1", *scvt, "--start", "two.csv")
        same = "two.csv:8: the place of two.csv:3, which cannot be two sites"
        self.refuse(1, same, *scvt, *cells[:3], "two.csv")
        same = "two.csv:2: the place of s.csv:2, which cannot be two sites"
        self.refuse(1, same, *scvt, *cells, "--fixed", "two.csv")
        zero = "zero.csv:3: a point is not finite or the center"
        self.refuse(1, zero, *scvt, *cells, "--fixed", "zero.csv")

    def test_of_masks_name_variable_and_value(self):
        self.succeed("mesh", "convert", "s.csv", "-o", "m.nc")
        done = self.tool("mesh", "cull", "m.nc", "--mask", "m.nc:nEdgesOnCell", "-o", "o.nc")
        self.assertRegex(
            done.stderr, r"\Arondel: m\.nc: 'nEdgesOnCell' of cell 0 is \d+, neither 0 nor 1\n\Z"
        )

    def test_of_tolerances_that_are_not_met(self):
        done = self.tool("mesh", "scvt", "-n", "300", "--max-steps", "1", "-o", "o.csv")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(
            done.stderr,
            r"\Arondel: o\.csv: not converged \(iterations after 1 step\): the mean offset is \S+"
            r" \(--tolerance 0.0001\), the largest \S+ \(--max-tolerance 0.01\)\n\Z",
        )
        done = self.tool("mesh", "equal-area", "o.csv", "--tolerance", "1e-18", "-o", "o.npy")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"\Arondel: o\.npy: areas are within \S+, not within --tol")

    def test_of_formats_that_are_named(self):
        self.succeed("interpolate", "s.csv", "--to", "grid:90", "--weights", "w.nc")
        for name, said in (
            ("npz", "the file is netCDF, not npz"),
            ("scrip", 'the weights are those of ESMF (variable "S"), not scrip'),
        ):
            words = ("check-weights", "w.nc", "--input-format", name)
            self.refuse(1, f"w.nc: {said}", *words)

    def test_of_standard_output_and_sizes(self):
        stream = "--output: a mesh is written to a file, not to standard output"
        self.refuse(2, stream, "mesh", "convert", "s.csv", "-o", "-")
        self.refuse(2, stream, "mesh", "scvt", "-n", "42", "-o", "-", "--format", "ugrid")
        points = ("mesh", "points", "-o", "o.csv")
        self.refuse(2, "healpix takes --size, not --radius", *points, "healpix", "--radius", "9")
        self.refuse(2, "poisson takes --radius, not --size", *points, "poisson", "--size", "9")

    def test_of_opposite_sites(self):
        for lon, lat in ((0, 0), (30, 90), (10, 20)):
            (self.folder / "o.csv").write_text(f"lon,lat\n{lon},{lat}\n{lon - 180},{-lat}\n")
            self.succeed("graph", "o.csv", "--kind", "delaunay", "-o", "o.geojson")
            (edge,) = self.features("o.geojson")
            self.assertEqual((edge["properties"]["length_deg"], edge["geometry"]), (180, None))
        (self.folder / "o.csv").write_text("lon,lat\n0,0\n179,0\n")
        self.succeed("graph", "o.csv", "--kind", "delaunay", "-o", "o.geojson")
        self.assertEqual(self.features("o.geojson")[0]["geometry"]["type"], "MultiLineString")

    @unittest.skipIf(netcdf_file is None, "scipy is not installed")
    def test_of_several_fields_are_one_line(self):
        with netcdf_file(self.folder / "t.nc", "w") as file:
            for name, size in (("time", 2), ("p", 4)):
                file.createDimension(name, size)
            for name, units, values in (
                ("lon", "degrees_east", (0, 90, 180, 270)),
                ("lat", "degrees_north", (0, 9, 0, 9)),
            ):
                variable = file.createVariable(name, "d", ("p",))
                variable[:] = values
                variable.units = units
            file.createVariable("t", "d", ("time", "p"))[:] = [[1, 2, 3, 4], [5, 6, 7, 8]]
        for command in (
            ("contours", "t.nc", "--value", "t", "--step", "1"),
            ("nearest", "t.nc", "s.csv", "--column", "t"),
        ):
            done = self.tool(
                *command, "-o", "o.csv" if command[0] == "nearest" else "o.geojson"
            )
            self.assertEqual(done.returncode, 2)
            self.assertRegex(
                done.stderr,
                r"\Arondel: --(value|column): 't' of t\.nc has several fields \(time 2\); .*'t\[0\]'.*\n\Z",
            )

    def test_of_mesh_edges_say_where(self):
        done = self.tool("mesh", "points", "healpix", "--size", "4", "-o", "m.nc")
        self.assertEqual(done.returncode, 1)
        fault = r"\Arondel: m\.nc: the mesh that was made: sites (\d+) \(at (\S+) (\S+)\), .* lie on one circle, .*\n\Z"
        self.assertRegex(done.stderr, fault)
        number, *place = re.match(fault, done.stderr).groups()
        self.succeed("mesh", "points", "healpix", "--size", "4", "-o", "m.csv")
        with open(self.folder / "m.csv", newline="") as file:
            x, y, z = (float(c) for c in list(csv.reader(file))[int(number) + 1])
        lon, lat = (math.radians(float(c)) for c in place)
        at = (math.cos(lon) * math.cos(lat), math.sin(lon) * math.cos(lat), math.sin(lat))
        self.assertLess(math.dist(at, (x, y, z)), 1e-9)

    def test_of_json(self):
        whole = json.dumps({"type": "Point", "coordinates": [1, 2]}).encode()
        for text in (
            whole + b"\0",
            whole + b"\0" + whole,
            b"\0" + whole,
            whole[:20] + b"\0" + whole[20:],
        ):
            (self.folder / "z.geojson").write_bytes(text)
            done = self.tool("voronoi", "z.geojson", "-o", "o.geojson")
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"\Arondel: z\.geojson:1: not JSON: .*\n\Z")


if __name__ == "__main__":
    unittest.main()
