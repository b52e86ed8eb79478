#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""An option that would change nothing is a usage error; where it changes something, it is taken."""

import re
import unittest

from tool_in_folder import ToolInFolder

ON_NETCDF = "has no effect on netCDF"
NOT_RANDOM = "on sites that are not random"
# Each line is a command, the option that has no effect there, and the beginning of the reason.
WITHOUT_EFFECT = [
    ("info mesh.nc --radius r", "radius", ON_NETCDF),
    ("nearest mesh.nc sites.csv --radius r", "radius", ON_NETCDF),
    ("interpolate mesh.nc --method nearest --radius r --to grid:90 -o x.csv", "radius", ON_NETCDF),
    ("plot mesh.nc --radius r --circles -o x.svg", "radius", ON_NETCDF),
    ("info mesh.nc --lon east --lat north", "lon", ON_NETCDF),
    ("interpolate mesh.nc --to grid:90 --lon a --lat b -o x.csv", "lon", ON_NETCDF),
    ("contours mesh.nc --value v --step 1 --lon a --lat b -o x.geojson", "lon", ON_NETCDF),
    ("mesh convert mesh.nc --lon a --lat b -o x.nc", "lon", ON_NETCDF),
    ("mesh quality mesh.nc --x a --y b --z c", "x", ON_NETCDF),
    ("mesh cull mesh.nc --mask m.npy --radians -o x.nc", "radians", ON_NETCDF),
    ("voronoi mesh.nc --delimiter ; -o x.geojson", "delimiter", ON_NETCDF),
    ("apply weights.nc mesh.nc --delimiter ; -o x.csv", "delimiter", ON_NETCDF),
    ("remap grid:90 mesh.nc --radians -o x.nc", "radians", ON_NETCDF),
    ("delaunay points.npy --delimiter ; -o x.npy", "delimiter", "on files other than .csv and"),
    ("apply weights.nc points.npy --delimiter ; -o x.csv", "delimiter", "on files other than"),
    ("remap grid:90 sites.csv --overlap first -o x.nc", "overlap", "on grids and cells of sites"),
    ("info space.csv --radians", "radians", "has no effect on x, y, z"),
    ("nearest space.csv space.csv --radians", "radians", "has no effect on x, y, z"),
    (
        "interpolate space.csv --value v --radians --to grid:90 -o x.csv",
        "radians",
        "has no effect on x, y, z",
    ),
    ("delaunay space.csv --squared-radius 4 -o x.npy", "squared-radius", "without --model"),
    (
        "nearest circles.csv sites.csv --radius r --squared-radius 4",
        "squared-radius",
        "without --model weighted, and on circles",
    ),
    ("mesh points healpix --size 2 --seed 3 -o x.csv", "seed", NOT_RANDOM),
    ("graph sites.csv --kind mst --count 3 -o x.csv", "count", "without --kind circles"),
    ("graph sites.csv --kind hull --anywhere -o x.geojson", "anywhere", "without --kind circles"),
    ("graph sites.csv --kind mst --tolerance 1 -o x.csv", "tolerance", "without lines"),
    ("graph sites.csv --kind circles --tolerance 1 -o x.geojson", "tolerance", "without lines"),
    ("interpolate sites.csv --value v --to grid:90 --kind nc4 -o x.csv", "kind", "on files"),
    ("interpolate sites.csv --value v --to grid:90 --deflate 2 -o x.nc", "deflate", "without"),
    (
        "interpolate sites.csv --value v --to grid:90 --kind cdf2 --deflate 2 -o x.nc",
        "deflate",
        "without",
    ),
    ("interpolate sites.csv --to grid:90 --weights x.npz --kind cdf2", "kind", "on files"),
    (
        "interpolate sites.csv --value v --to grid:90 --weight-format scrip -o x.csv",
        "weight-format",
        "without --weights",
    ),
    ("interpolate sites.csv --to grid:90 --weights x.nc --format csv", "format", "without --out"),
    ("apply weights.nc sites.csv --value v --kind cdf5 -o x.csv", "kind", "on files"),
    ("remap grid:90 grid:60 --deflate 1 -o x.npz", "deflate", "without"),
    ("remap grid:90 grid:60 --edges geodesic -o x.nc", "edges", "without polygons"),
    ("remap grid:90 sites.csv --invalid repair -o x.nc", "invalid", "without cells in netCDF"),
    (
        "regrid mesh.nc grid:90 --method nearest --invalid repair -o x.nc",
        "invalid",
        "with a method between places",
    ),
    (
        "regrid mesh.nc grid:90 --source healpix:0 --invalid repair -o x.nc",
        "invalid",
        "between grids with names",
    ),
    ("remap sites.csv sites.csv --sides parallels -o x.nc", "sides", "without a grid"),
    ("remap grid:90 mesh.nc --model weighted -o x.nc", "model", "without sites"),
    ("remap grid:90 mesh.nc --center 0 0 0 -o x.nc", "center", "without sites"),
    ("mesh scvt -n 42 --edges geodesic -o x.csv", "edges", "without --refine"),
    ("mesh scvt -n 42 --gradient 0.1 -o x.csv", "gradient", "without --refine"),
    ("mesh scvt --spacing 3000 --gradient 0.1 -o x.csv", "gradient", "without --refine"),
    ("mesh scvt -n 42 --sphere-radius 6371229 -o x.csv", "sphere-radius", "on sites"),
    ("mesh scvt -n 42 --kind cdf2 -o x.csv", "kind", "on files"),
    ("mesh icosahedral 1 --deflate 4 -o x.nc", "deflate", "without"),
    ("mesh cull mesh.nc --mask m.npy --edges geodesic -o x.nc", "edges", "without --inside"),
    ("plot sites.csv --values v --fill area -o x.png", "values", "with --fill none and area"),
    ("plot sites.csv --values v --fill none -o x.svg", "values", "with --fill none and area"),
    ("plot sites.csv --show none --line-width 4 -o x.png", "line-width", "without lines"),
    ("voronoi sites.csv --tolerance 1 -o x.npz", "tolerance", "on .vtp and .npz"),
]
WITH_EFFECT = [
    "info circles.csv --radius r",
    "info space.csv --squared-radius 4",
    "nearest mesh.nc angles.csv --lon east --lat north --radians",
    "nearest angles.csv mesh.nc --lon east --lat north --radians",
    "interpolate mesh.nc:areaCell --to angles.csv --lon east --lat north --radians -o x.csv",
    "delaunay space.csv --squared-radius 4 --model weighted -o x.npy",
    "delaunay angles.csv --radius r --radians --lon east --lat north -o x.npy",
    "graph sites.csv --kind circles --count 3 --anywhere -o x.csv",
    "graph sites.csv --kind mst --tolerance 1 -o x.geojson",
    "interpolate sites.csv --value v --to grid:90 --kind cdf2 -o x.nc",
    "interpolate sites.csv --value v --to grid:90 --weights w.nc --kind cdf2 -o x.csv",
    "interpolate sites.csv --to grid:90 --weights x --weight-format scrip --kind cdf2",
    "remap grid:90 grid:60 --sides great-circles --kind cdf2 --format scrip -o x.nc",
    "remap grid:90 square.geojson --edges geodesic -o x.nc",
    "remap grid:90 square.geojson --overlap first -o x.nc",
    "regrid mesh.nc grid:90 --invalid repair -o x.nc",
    "remap mesh.nc grid:90 --overlap share -o x.nc",
    "remap grid:90 space.csv --model projected --center 0 0 0 -o x.nc",
    "mesh scvt --spacing 4000 --refine square.geojson:2000 --gradient 0.2 --edges lonlat -o x.csv",
    "mesh scvt -n 42 --sphere-radius 6371229 --report x.json -o x.csv",
    "mesh points poisson --radius 3000 --seed 4 -o x.csv",
    "plot sites.csv --values v --fill none --contours 1 --show none --line-width 2 -o x.svg",
    "plot circles.csv --radius r --circles --show none --line-width 2 -o x.svg",
    "plot sites.csv --values v --fill area -o x.html",
    "voronoi sites.csv --tolerance 1 -o x.geojson",
]
FILES = {
    "sites.csv": "lon,lat,v\n0,0,1\n90,0,2\n180,0,3\n-90,0,4\n0,90,5\n0,-90,6\n",
    "space.csv": "x,y,z,v\n1,0,0,1\n0,1,0,2\n-1,0,0,3\n0,-1,0,4\n0,0,1,5\n0,0,-1,6\n",
    "circles.csv": "lon,lat,r\n0,0,10\n90,0,20\n180,0,5\n-90,0,4\n0,90,5\n0,-90,6\n",
    "angles.csv": "east,north,r\n0,0,0.1\n1.5,0,0.2\n3,0,0.1\n-1.5,0,0.1\n0,1.5,0.1\n0,-1.5,0.1\n",
    "square.geojson": '{"type":"Polygon","coordinates":[[[0,0],[30,0],[30,30],[0,30],[0,0]]]}',
}


class Effects(ToolInFolder):
    def setUp(self):
        super().setUp()
        for name, text in FILES.items():
            (self.folder / name).write_text(text)
        for words in (
            "mesh icosahedral 1 -o mesh.nc",
            "generate uniform -n 6 -o points.npy",
            "interpolate sites.csv --to grid:90 --weights weights.nc",
        ):
            done = self.tool(*words.split())
            self.assertEqual(done.returncode, 0, done.stderr)
        self.names = {path.name for path in self.folder.iterdir()}

    def test_without_effect_is_a_usage_error(self):
        for words, option, reason in WITHOUT_EFFECT:
            done = self.tool(*words.split())
            self.assertEqual((done.returncode, done.stdout), (2, ""), (words, done.stderr))
            reason = reason if "effect" in reason else f"has no effect {reason}"
            self.assertTrue(
                done.stderr.startswith(f"rondel: --{option} {reason}"), (words, done.stderr)
            )
            self.assertEqual({path.name for path in self.folder.iterdir()}, self.names, words)

    def test_with_effect_is_taken(self):
        for words in WITH_EFFECT:
            done = self.tool(*words.split())
            if "plot" in words and "not a command" in done.stderr:
                continue  # it was built without plots
            self.assertEqual(done.returncode, 0, (words, done.stderr))

    def test_names_of_columns_change_nothing_of_netcdf_which_is_told(self):
        done = self.tool("nearest", "mesh.nc", "angles.csv", "--lon", "east", "--lat", "north")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("mesh.nc: names of columns are for tables; mesh.nc:NAME", done.stderr)

    def test_a_seed_is_refused_where_it_changes_nothing(self):
        text = self.tool("generate", "--help").stdout
        kinds = re.findall(
            r"^  ([a-z][\w-]+) ", text[text.index("Kinds:") : text.index("Examples:")], re.M
        )
        self.assertGreater(len(kinds), 30)
        numbers = {"icosahedral": 42, "healpix": 48, "reduced-gaussian": 40, "cubed-sphere": 54}
        num_fixed = 0
        for kind in kinds:
            size = ["--angle", "30"] if kind == "poisson" else ["-n", str(numbers.get(kind, 50))]
            first = self.tool("generate", kind, *size, "-o", "-")
            self.assertEqual(first.returncode, 0, first.stderr)
            second = self.tool("generate", kind, *size, "--seed", "2", "-o", "-")
            if second.returncode == 0:
                self.assertNotEqual(first.stdout, second.stdout, kind)
            else:
                num_fixed += 1
                self.assertIn("--seed has no effect on sites that are not random", second.stderr)
        self.assertEqual(num_fixed, 8)


if __name__ == "__main__":
    unittest.main()
