# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""rondel-mpi regrid: the bytes of rondel's files for 1 to 7 processes, and errors in one line.

regrid_test.py MPIEXEC... -- RONDEL_MPI RONDEL
"""

import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest

import numpy as np

split = sys.argv.index("--")
MPIEXEC = sys.argv[1:split]
RONDEL_MPI, RONDEL = sys.argv[split + 1 :]
del sys.argv[1:]


class Regrid(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder_of_input = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder_of_input.name)
        random = np.random.default_rng(2)
        table = np.column_stack(
            [random.uniform(-180, 180, 400), random.uniform(-90, 90, 400), random.normal(size=(400, 5))]
        )
        np.savetxt(folder / "sites.csv", table, delimiter=",", header="lon,lat,a,b,c,d,e", comments="")
        cls.input = folder / "in.nc"
        names = [part for name in "abcde" for part in ("--value", name)]
        # Values between northern sites alone leave gaps.
        cls.gaps = folder / "gaps.nc"
        np.savetxt(folder / "north.csv", table[table[:, 1] > 0], delimiter=",", header="lon,lat,a,b,c,d,e", comments="")
        for sites, out in (("sites.csv", cls.input), ("north.csv", cls.gaps)):
            subprocess.run(
                [RONDEL, "interpolate", folder / sites, "--to", "grid:4", *names, "-o", out, "--quiet"], check=True
            )
        # The second ring crosses itself, and both overlap.
        rings = ([[0, 0], [40, 0], [40, 40], [0, 40], [0, 0]], [[20, 0], [60, 40], [60, 0], [20, 40], [20, 0]])
        shapes = [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [r]}} for r in rings]
        cls.regions = folder / "regions.geojson"
        cls.regions.write_text(json.dumps({"type": "FeatureCollection", "features": shapes}))

    @classmethod
    def tearDownClass(cls):
        cls.folder_of_input.cleanup()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def regrid(self, name, *arguments, source=None, **options):
        subprocess.run(
            [RONDEL, "regrid", source or self.input, *arguments, "-o", self.folder / name, "--quiet"], check=True, **options
        )
        return (self.folder / name).read_bytes()

    def run_ranks(self, num_ranks, *arguments):
        return subprocess.run(
            [*MPIEXEC, "-n", str(num_ranks), RONDEL_MPI, "regrid", *map(str, arguments)],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )

    def assert_error(self, result, line):
        self.assertNotEqual(result.returncode, 0)
        lines = [each for each in result.stderr.splitlines() if each.startswith("rondel-mpi: ")]
        self.assertEqual(lines, ["rondel-mpi: " + line], result.stderr)

    def test_files_are_those_of_rondel(self):
        cases = (
            ("out.nc", ["healpix:4"]),
            ("out.csv", ["grid:3", "--tile", "500"]),
            ("out.nc", ["O16", "--method", "conservative-2nd"]),
            ("out.nc", ["healpix:4", "--method", "sibson"]),
            ("out.nc", ["healpix:4", "--method", "largest-share", "--value", "c"]),
            ("out.nc", ["O16", "--method", "conservative-2nd", "--limiter", "bounds", "--vector", "a,b"]),
            ("out.nc", ["O16", "--method", "conservative-2nd", "--limiter", "slopes"]),
            ("out.nc", ["healpix:4", "--vector", "a,b", "--vector", "c,d", "--tile", "500"]),
            ("out.nc", ["healpix:4", "--method", "linear", "--vector", "e,b", "--kind", "cdf5"]),
            ("out.csv", [self.regions, "--edges", "geodesic", "--invalid", "repair", "--overlap", "each"]),
        )
        filled = (
            ("out.nc", ["grid:3", "--extrapolate", "creep", "--extrapolate-levels", "2", "--vector", "a,b"]),
            ("out.nc", ["healpix:3", "--method", "bilinear", "--extrapolate", "idw", "--extrapolate-sources", "3",
                        "--extrapolate-exponent", "1", "--extrapolate-distance", "900"]),
            ("out.nc", ["healpix:3", "--method", "conservative-2nd"]),
        )
        every = [(*case, self.input) for case in cases] + [(*case, self.gaps) for case in filled]
        for name, arguments, source in every:
            expected = self.regrid("expected" + pathlib.Path(name).suffix, *arguments, source=source)
            for num_ranks in range(1, 8):
                result = self.run_ranks(num_ranks, source, *arguments, "-o", self.folder / name, "--json")
                self.assertEqual(result.returncode, 0, result.stderr)
                told = json.loads(result.stdout)
                self.assertEqual((told["ranks"], told["sources"]), (num_ranks, 4050))
                self.assertTrue((self.folder / name).read_bytes() == expected, (arguments, num_ranks))
                (self.folder / name).unlink()

    def test_a_run_that_was_cut_goes_on(self):
        # The table needs more bytes than what is kept of its values, so that it alone is too large.
        def limited():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))

        expected = self.regrid("expected.csv", "grid:3")
        result = subprocess.run(
            [RONDEL, "regrid", self.input, "grid:3", "-o", self.folder / "out.csv", "--resume", "--tile", "900"],
            preexec_fn=limited, capture_output=True, text=True, check=False,
        )
        self.assertEqual(result.returncode, 1, result.stderr)
        partial = self.folder / "out.csv.partial"
        kept = partial.read_bytes()
        self.assertGreater(len(kept), 100_000)
        for num_ranks in (1, 3):
            partial.write_bytes(kept[: len(kept) // 2])
            result = self.run_ranks(
                num_ranks, self.input, "grid:3", "-o", self.folder / "out.csv", "--resume", "--json"
            )
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertGreaterEqual(json.loads(result.stdout)["resumed"], 7200)
            self.assertTrue((self.folder / "out.csv").read_bytes() == expected)
            self.assertEqual(sorted(os.listdir(self.folder)), ["expected.csv", "out.csv"])

    def test_what_goes_wrong_is_told_once(self):
        out = self.folder / "out.nc"
        for arguments, message in (
            ([self.folder / "none.nc", "grid:3"], f"{self.folder}/none.nc: No such file or directory"),
            ([self.input, "grid:3", "--memory", "100"],
             "memory of 100 bytes is too small: 2M are enough for 4050 sources and 7200 targets"),
        ):
            result = self.run_ranks(3, *arguments, "-o", out)
            self.assert_error(result, "rank 0, regrid: " + message)
            self.assertEqual(os.listdir(self.folder), [])
        result = self.run_ranks(3, self.input, "grid:3", "-o", self.input)
        self.assert_error(result, f"rank 0, regrid: {self.input}: it is the file of the input, too")
        result = self.run_ranks(3, self.input, "grid:3", "-o", self.folder / "none" / "out.nc")
        self.assert_error(result, f"rank 0, regrid: {self.folder}/none/out.nc: No such file or directory")

    def test_arguments_that_one_rank_alone_has(self):
        command = [self.input, "grid:3", "-o", self.folder / "out.nc"]
        for more, message in (
            (["--method", "nearest"], "rank 1 has other arguments than rank 0"),
            (["--vector", "a,b"], "rank 1 has other arguments than rank 0"),
            (["--extrapolate", "idw"], "rank 1 has other arguments than rank 0"),
            (["--extrapolate-sources", "3"], "--extrapolate-sources"),
            (["--vector", "a"], "--vector"),
            (["--method", "bogus"], "--method"),
        ):
            result = self.run_ranks(1, *command, ":", "-n", "1", RONDEL_MPI, "regrid", *command, *more)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(f"rondel-mpi: {message}", result.stderr)
            self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
