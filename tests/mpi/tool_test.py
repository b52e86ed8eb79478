# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""rondel-mpi: the bytes of rondel's files, whatever the number of processes, and errors in one line.

tool_test.py MPIEXEC... -- RONDEL_MPI RONDEL
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

split = sys.argv.index("--")
MPIEXEC = sys.argv[1:split]
RONDEL_MPI, RONDEL = sys.argv[split + 1 :]
del sys.argv[1:]


class Tool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.sites = self.folder / "sites.npy"

    def run_ranks(self, num_ranks, *arguments):
        return subprocess.run(
            [*MPIEXEC, "-n", str(num_ranks), RONDEL_MPI, *map(str, arguments)],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )

    def files(self, name):
        arrays = ("faces", "neighbors", "duplicates", "areas", "circumcenters")
        return [self.folder / f"{name}-{array}.npy" for array in arrays]

    def delaunay(self, files):
        faces, neighbors, duplicates, areas, circumcenters = files
        return [
            "delaunay",
            str(self.sites),
            "-o",
            str(faces),
            "--neighbors",
            str(neighbors),
            "--duplicates",
            str(duplicates),
            "--areas",
            str(areas),
            "--circumcenters",
            str(circumcenters),
        ]

    def assert_error(self, result, line):
        self.assertNotEqual(result.returncode, 0)
        lines = [each for each in result.stderr.splitlines() if each.startswith("rondel-mpi: ")]
        self.assertEqual(lines, ["rondel-mpi: " + line], result.stderr)

    def test_files_are_those_of_rondel(self):
        random = np.random.default_rng(1)
        points = random.normal(size=(5000, 3))
        angles = np.column_stack([random.uniform(-180, 180, 3000), random.uniform(-90, 90, 3000)])
        inputs = (points, np.vstack([points, points[:100]]), angles, points[:2], points[:0])
        models = ["projected"] * len(inputs) + ["weighted"]
        for sites, model in zip((*inputs, points), models, strict=True):
            np.save(self.sites, sites)
            expected = self.files("expected")
            subprocess.run(
                [RONDEL, *self.delaunay(expected), "--model", model, "--quiet"], check=True
            )
            for num_ranks in (1, 3):
                found = self.files("found")
                result = self.run_ranks(
                    num_ranks, *self.delaunay(found), "--model", model, "--json"
                )
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(f'"sites": {len(sites)},', result.stdout)
                for a, b in zip(expected, found, strict=True):
                    self.assertEqual(a.read_bytes(), b.read_bytes(), b.name)
                self.assertEqual(list(self.folder.glob("*.tmp")), [])

    def test_a_file_that_is_replaced_keeps_its_permissions_and_its_link(self):
        np.save(self.sites, np.eye(3))
        faces = self.folder / "faces.npy"
        target = self.folder / "target.npy"
        target.write_text("what was there")
        target.chmod(0o640)
        faces.symlink_to(target)
        result = self.run_ranks(2, "delaunay", self.sites, "-o", faces)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(faces.is_symlink())
        self.assertEqual(target.stat().st_mode & 0o777, 0o640)
        self.assertEqual(np.load(target).shape, (2, 3))

    def test_a_file_that_cannot_be_replaced(self):
        np.save(self.sites, np.eye(3))
        folder = self.folder / "folder"
        folder.mkdir()
        result = self.run_ranks(2, "delaunay", self.sites, "-o", folder)
        self.assert_error(result, f"rank 0, write: {folder}: Is a directory")
        result = self.run_ranks(2, "delaunay", self.sites, "-o", "/dev/null")
        self.assert_error(result, "rank 0, write: /dev/null: Operation not supported")

    def test_no_file_is_read_and_written_or_written_twice(self):
        np.save(self.sites, np.eye(3))
        before = self.sites.read_bytes()
        faces = self.folder / "faces.npy"
        other = self.folder / "." / "other" / ".." / "faces.npy"
        (self.folder / "other").mkdir()
        for arguments, message in (
            (["-o", self.sites], f"{self.sites}: the file of the sites, too"),
            (["-o", faces, "--areas", other], f"{other}: the file of another result, too"),
            (["-o", ""], "the file of the faces has no name"),
            (["-o", "faces.off"], "faces.off: results are .npy files"),
            (["-o", faces, "--areas", "areas.txt"], "areas.txt: results are .npy files"),
        ):
            result = self.run_ranks(2, "delaunay", self.sites, *arguments)
            self.assert_error(result, f"rank 0, read: {message}")
        self.assertEqual(self.sites.read_bytes(), before)
        self.assertFalse(faces.exists())

    def test_arguments_that_one_rank_alone_has(self):
        np.save(self.sites, np.eye(3))
        faces = self.folder / "faces.npy"
        command = ["delaunay", self.sites, "-o", faces]
        for more, message in (
            (["--bogus"], "The following argument was not expected: --bogus"),
            (["--threads", "0"], "--threads"),
            (["--model", "weighted"], "rank 1 has other arguments than rank 0"),
        ):
            result = self.run_ranks(1, *command, ":", "-n", "1", RONDEL_MPI, *command, *more)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(f"rondel-mpi: {message}", result.stderr)
            self.assertFalse(faces.exists())

    def test_a_row_that_is_not_valid(self):
        sites = np.ones((100, 3))
        sites[[60, 80]] = np.nan
        np.save(self.sites, sites)
        found = self.files("found")
        for num_ranks, rank in ((1, 0), (4, 2)):
            result = self.run_ranks(num_ranks, *self.delaunay(found))
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(f"rondel-mpi: rank {rank}, read: {self.sites}: row 60", result.stderr)
            self.assertEqual(list(self.folder.iterdir()), [self.sites])
        sites[[60, 80]] = 0
        np.save(self.sites, sites)
        said = subprocess.run([RONDEL, *self.delaunay(found)], capture_output=True, text=True)
        for num_ranks, rank in ((1, 0), (4, 2)):
            result = self.run_ranks(num_ranks, *self.delaunay(found))
            text = said.stderr.removeprefix("rondel: ").strip()
            self.assertTrue(text.startswith(f"{self.sites}: "), text)
            self.assert_error(result, f"rank {rank}, read: {text}")

    def test_files_that_are_not_there(self):
        result = self.run_ranks(2, *self.delaunay(self.files("found")))
        self.assert_error(result, f"rank 0, read: {self.sites}: No such file or directory")
        np.save(self.sites, np.eye(3))
        nowhere = self.folder / "nowhere" / "faces.npy"
        result = self.run_ranks(2, "delaunay", self.sites, "-o", nowhere)
        self.assert_error(result, f"rank 0, write: {nowhere}: No such file or directory")
        group = self.folder / "mesh.zarr"
        result = self.run_ranks(2, "delaunay", self.sites, "-o", group)
        self.assert_error(
            result,
            f"rank 0, read: {group}: Zarr groups are written in Python, by "
            "rondel.out_of_core.delaunay; here results are .npy files",
        )

    def test_what_is_written_does_not_appear_when_another_file_fails(self):
        np.save(self.sites, np.eye(3))
        faces = self.folder / "faces.npy"
        nowhere = self.folder / "nowhere" / "neighbors.npy"
        result = self.run_ranks(2, "delaunay", self.sites, "-o", faces, "--neighbors", nowhere)
        self.assert_error(result, f"rank 0, write: {nowhere}: No such file or directory")
        self.assertEqual(list(self.folder.iterdir()), [self.sites])

    def test_wrong_usage(self):
        result = self.run_ranks(2, "delaunay", self.sites)
        self.assert_error(result, "--output is required (see rondel-mpi --help)")


if __name__ == "__main__":
    unittest.main()
