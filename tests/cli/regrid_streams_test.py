#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""`rondel regrid` where it is cut short: killed, on a full disk, with a damaged input, in little memory.

Without netCDF4-python ctest says "Skipped".
"""

import errno
import importlib.util
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
NLON, NLAT, TIMES = 360, 180, 120


def open_bytes(process, folder):
    """How many bytes the process has written to files of the folder, with a name or without."""
    total = 0
    for link in pathlib.Path(f"/proc/{process.pid}/fd").iterdir():
        try:
            if os.readlink(link).startswith(str(folder)):
                total += link.stat().st_size
        except OSError:
            continue  # closed meanwhile
    return total


class RegridStreams(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.inputs = tempfile.TemporaryDirectory()
        cls.input = pathlib.Path(cls.inputs.name).resolve() / "in.nc"
        cls.chunks = cls.input.with_name("chunks.nc")
        values = np.random.default_rng(3).normal(size=(TIMES, NLAT, NLON)).astype("f4")
        for path, kind in ((cls.input, "NETCDF3_64BIT_OFFSET"), (cls.chunks, "NETCDF4")):
            with netCDF4.Dataset(path, "w", format=kind) as file:
                for name, size in (("time", TIMES), ("lat", NLAT), ("lon", NLON)):
                    file.createDimension(name, size)
                for name, centers, units in (("lat", np.arange(-89.5, 90), "degrees_north"), ("lon", np.arange(0.5, 360), "degrees_east")):
                    axis = file.createVariable(name, "f8", (name,))
                    axis.units = units
                    axis[:] = centers
                file.createVariable("t", "f4", ("time", "lat", "lon"))[:] = values
        cls.few = cls.input.with_name("few.nc")
        with netCDF4.Dataset(cls.few, "w", format="NETCDF3_CLASSIC") as file:
            file.createDimension("lat", 45)
            file.createDimension("lon", 90)
            for name, centers, units in (("lat", np.arange(-88, 90, 4.0), "degrees_north"), ("lon", np.arange(2, 360, 4.0), "degrees_east")):
                axis = file.createVariable(name, "f8", (name,))
                axis.units = units
                axis[:] = centers
            file.createVariable("t", "f8", ("lat", "lon"))[:] = values[0, ::4, ::4]
        cls.expected = cls.input.with_name("expected.nc")
        subprocess.run([TOOL, "regrid", cls.input, "healpix:6", "-o", cls.expected, "--quiet"], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.inputs.cleanup()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()
        self.out = self.folder / "out.nc"

    def regrid(self, *arguments, **options):
        return subprocess.run([TOOL, "regrid", *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, check=False, **options)

    def expect_refusal(self, arguments, message, status=1, **options):
        """One line, another status than 0, and no new file."""
        before = sorted(os.listdir(self.folder))
        done = self.regrid(*arguments, **options)
        self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
        self.assertRegex(done.stderr, rf"\Arondel: {message}\n\Z")
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def start(self, command, size):
        """A process that has written so many bytes and runs; one that ended before it was looked at is started again."""
        old = self.out.read_bytes() if self.out.exists() else None
        for _ in range(10):
            process = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True)
            while process.poll() is None and open_bytes(process, self.folder) < size:
                time.sleep(0.0005)
            if process.poll() is None:
                return process
            self.assertEqual((process.returncode, process.communicate()[1]), (0, ""))
            self.out.unlink()
            if old is not None:
                self.out.write_bytes(old)
        self.fail("each run ended before it could be disturbed")

    def interrupt(self, number, *options, size):
        """Sends the signal when so many bytes are written; tells the exit status."""
        command = [TOOL, "regrid", self.input, "healpix:6", "-o", self.out, "--quiet", "--threads", "1", *options]
        process = self.start(command, size)
        try:
            process.send_signal(number)
            process.communicate(timeout=30)
        finally:
            process.kill()
            process.wait()
        return process.returncode

    def signals(self):
        """SIGKILL leaves no file only where files can be made without a name."""
        signals = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
        signal.signal(signal.SIGHUP, signal.SIG_DFL)  # programs would inherit what nohup ignores
        if not os.path.isdir("/proc/self/fd"):
            self.skipTest("needs /proc to see what is being written")
        try:
            os.close(os.open(self.folder, os.O_TMPFILE | os.O_WRONLY))
        except OSError:
            return signals
        return [*signals, signal.SIGKILL]

    # --- killed ---

    def test_a_run_that_is_killed_leaves_nothing(self):
        for number in self.signals():
            with self.subTest(signal=number.name):
                self.assertEqual(self.interrupt(number, size=1 << 20), -number)
                self.assertEqual(os.listdir(self.folder), [])
        self.out.write_text("old", encoding="ascii")
        self.assertEqual(self.interrupt(signal.SIGTERM, size=1 << 20), -signal.SIGTERM)
        self.assertEqual(self.out.read_text(encoding="ascii"), "old")
        self.assertEqual(os.listdir(self.folder), ["out.nc"])

    def test_a_run_that_is_killed_goes_on(self):
        for number in self.signals():
            with self.subTest(signal=number.name):
                for size in (8 << 20, 24 << 20, 48 << 20):
                    self.assertEqual(self.interrupt(number, "--resume", size=size), -number)
                    self.assertEqual(os.listdir(self.folder), ["out.nc.partial"])
                done = self.regrid(self.input, "healpix:6", "-o", "out.nc", "--resume", "--json")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertGreater(json.loads(done.stdout)["resumed"], 49152)
                self.assertEqual(os.listdir(self.folder), ["out.nc"])
                self.assertTrue(self.same_values())
                self.out.unlink()

    def same_values(self):
        """Whether the output is what a run without a break has written, but for the command in its history."""
        def without_history(path):
            return re.sub(rb"rondel regrid [^\0]*", b"", path.read_bytes())
        return without_history(self.out) == without_history(self.expected)

    def test_two_runs_do_not_share_what_they_keep(self):
        command = [TOOL, "regrid", self.input, "healpix:6", "-o", self.out, "--quiet", "--resume"]
        first = subprocess.Popen(command)
        try:
            # The file is locked before anything is written to it.
            partial = self.out.with_name("out.nc.partial")
            while first.poll() is None and not (partial.exists() and partial.stat().st_size > 0):
                time.sleep(0.0005)
            self.assertIsNone(first.poll())
            first.send_signal(signal.SIGSTOP)
            self.expect_refusal([self.input, "healpix:6", "-o", self.out, "--resume"],
                                rf"{self.out}\.partial: another process works with it")
            first.send_signal(signal.SIGCONT)
            self.assertEqual(first.wait(timeout=60), 0)
        finally:
            first.kill()
            first.wait()

    # --- full disks ---

    def test_a_full_disk_is_told_and_left_clean(self):
        if os.geteuid() != 0 or shutil.which("mount") is None:
            self.skipTest("needs the right to mount")
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "none", self.folder],
                                 capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("mounting is not allowed here")
        try:
            for name in ("out.nc", "out.nc4", "out.csv", "out.npy"):
                self.expect_refusal([self.input, "healpix:6", "-o", name, "--threads", "1"],
                                    f"{name}: No space left on device")
            # The disk is full with what is kept; with more room the run goes on.
            done = self.regrid(self.input, "healpix:6", "-o", "out.nc", "--resume")
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, r"\Arondel: out\.nc(\.partial)?: No space left on device\n\Z")
            self.assertEqual(os.listdir(self.folder), ["out.nc.partial"])
            subprocess.run(["mount", "-o", "remount,size=200m", self.folder], check=True)
            done = self.regrid(self.input, "healpix:6", "-o", "out.nc", "--resume")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(self.same_values())
            self.assertEqual(os.listdir(self.folder), ["out.nc"])
        finally:
            subprocess.run(["umount", self.folder], check=True)

    def test_files_that_grow_too_large(self):
        def limited():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 20, 1 << 20))
        for name in ("out.nc", "out.nc4", "out.csv"):
            self.expect_refusal([self.input, "healpix:6", "-o", name],
                                f"{name}: {os.strerror(errno.EFBIG)}", preexec_fn=limited)

    def test_a_device_without_room(self):
        for kind in ("nc", "nc4", "csv"):
            self.expect_refusal([self.input, "healpix:3", "-o", "/dev/full", "--format", kind],
                                "/dev/full: No space left on device")

    # --- inputs and names ---

    def test_an_input_that_is_cut(self):
        for path in (self.input, self.chunks):
            whole = path.read_bytes()
            for size in (0, 3, 200, len(whole) // 3, len(whole) - 1):
                (self.folder / "cut.nc").write_bytes(whole[:size])
                self.expect_refusal(["cut.nc", "healpix:3", "-o", "out.nc"], "cut.nc: .*")
        self.expect_refusal([self.input, "cut.nc", "-o", "out.nc"], "cut.nc: .*")

    def test_an_input_that_is_cut_while_it_is_read(self):
        for path in (self.input, self.chunks):
            shutil.copy(path, self.folder / "in.nc")
            command = [TOOL, "regrid", "in.nc", "healpix:6", "-o", self.out, "--quiet", "--threads", "1"]
            process = self.start(command, path.stat().st_size + (1 << 20))
            os.truncate(self.folder / "in.nc", path.stat().st_size // 2)
            said = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 1)
            self.assertRegex(said, r"\Arondel: in\.nc: [^\n]*\n\Z")
            self.assertEqual(os.listdir(self.folder), ["in.nc"])

    def test_an_input_that_is_replaced_while_it_is_read(self):
        shutil.copy(self.input, self.folder / "in.nc")
        command = [TOOL, "regrid", "in.nc", "healpix:6", "-o", self.out, "--quiet", "--threads", "1"]
        process = self.start(command, self.input.stat().st_size + (1 << 20))
        shutil.copy(self.expected, self.folder / "new.nc")
        os.replace(self.folder / "new.nc", self.folder / "in.nc")
        said = process.communicate(timeout=60)[1]
        self.assertEqual((process.returncode, said), (1, "rondel: in.nc: changed while it was read\n"))
        self.assertEqual(os.listdir(self.folder), ["in.nc"])

    def test_outputs_that_cannot_be(self):
        self.expect_refusal([self.input, "healpix:3", "-o", "none/out.nc"],
                            "none/out.nc: No such file or directory")
        shutil.copy(self.input, self.folder / "in.nc")
        self.expect_refusal(["in.nc", "healpix:3", "-o", "in.nc"], r"--output: 'in\.nc' is the input.*", status=2)
        self.expect_refusal(["in.nc:t", "healpix:3", "-o", "./in.nc"], r"--output: '\./in\.nc' is the input.*", status=2)
        self.expect_refusal(["in.nc", "healpix:3", "--resume", "-o", "-", "--format", "nc"],
                            "-: a run can be resumed if its output is a file")

    # --- meshes and polygons of a region ---

    def write_mesh(self):
        """Quadrilaterals between 10 and 70 degrees north as UGRID, with a field and gaps in it."""
        lon, lat = np.meshgrid(np.linspace(-40, 60, 51), np.linspace(10, 70, 31))
        corner = np.arange(lon.size).reshape(lon.shape)
        faces = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], -1).reshape(-1, 4)
        faces = np.delete(faces, np.arange(400, 430), 0)
        with netCDF4.Dataset(self.folder / "mesh.nc", "w", format="NETCDF3_CLASSIC") as file:
            for name, size in (("node", lon.size), ("face", len(faces)), ("four", 4), ("time", 3)):
                file.createDimension(name, size)
            mesh = file.createVariable("mesh", "i4", ())
            mesh.setncatts({"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "node_x node_y",
                            "face_node_connectivity": "corners"})
            for name, values, units in (("node_x", lon, "degrees_east"), ("node_y", lat, "degrees_north")):
                file.createVariable(name, "f8", ("node",))[:] = values.ravel()
                file[name].units = units
            file.createVariable("corners", "i4", ("face", "four"))[:] = faces
            file["corners"].start_index = 0
            field = file.createVariable("t", "f8", ("time", "face"), fill_value=-9.0)
            field.setncatts({"mesh": "mesh", "location": "face"})
            values = np.random.default_rng(5).normal(size=(3, len(faces)))
            field[:] = np.ma.masked_where(values > 1.5, values)

    def write_polygons(self):
        """Polygons with a hole, with two parts, and around the pole."""
        def box(west, south, east, north):
            return [[west, south], [east, south], [east, north], [west, north], [west, south]]
        shapes = ([[box(-10, 0, 40, 50), box(0, 10, 20, 30)[::-1]]], [[box(0, 10, 20, 30)]],
                  [[box(-90, -40, -60, -20)], [box(-50, -10, -20, 15)]], [[box(-180, -90, 180, -65)]])
        features = [{"type": "Feature", "properties": {"name": str(k)}, "geometry": {"type": "MultiPolygon", "coordinates": shape}}
                    for k, shape in enumerate(shapes)]
        (self.folder / "areas.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}), encoding="ascii")

    def test_regions_have_the_same_bytes_in_tiles(self):
        self.write_mesh()
        self.write_polygons()
        self.regrid(self.few, "healpix:3", "-o", "pixels.nc", "--quiet")
        for source, target in (("mesh.nc", "healpix:4"), ("mesh.nc", "grid:4"), (self.few, "mesh.nc"), ("pixels.nc", "mesh.nc"),
                               (self.few, "areas.geojson"), ("pixels.nc", "areas.geojson")):
            for ending in ("nc", "csv"):
                whole = self.regrid(source, target, "-o", f"whole.{ending}", "--json")
                self.assertEqual((whole.returncode, whole.stderr), (0, ""), (source, target))
                for tile in ("60", "900", "20000"):
                    done = self.regrid(source, target, "-o", f"tiles.{ending}", "--tile", tile, "--json")
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
                    told = json.loads(done.stdout)
                    self.assertGreater(told["tiles"], 1 if tile == "60" else 0)
                    self.assertEqual(told["missing"], json.loads(whole.stdout)["missing"])
                    self.assertEqual((self.folder / f"tiles.{ending}").read_bytes(),
                                     (self.folder / f"whole.{ending}").read_bytes(), (source, target, tile))

    def test_what_has_no_tiles_is_told(self):
        self.write_mesh()
        self.write_polygons()
        done = self.regrid("mesh.nc", "areas.geojson", "-o", "out.csv", "--tile", "100", "--quiet")
        self.assertEqual((done.returncode, done.stderr),
                         (0, "rondel: mesh.nc: the number of cells of a tile has no effect: cells overlap, or neither side "
                             "covers the sphere or is between parallels\n"))
        self.out.with_suffix(".csv").unlink()
        self.expect_refusal(["mesh.nc", "areas.geojson", "-o", "out.csv", "--memory", "100K"],
                            r"memory of 102400 bytes is too small: \d+M are enough for 1470 sources and 4 targets, whose "
                            "weights have no tiles")

    # --- memory, and options without effect ---

    def test_memory_that_is_too_small_is_told_with_what_is_enough(self):
        for method in ("conservative", "conservative-2nd", "nearest", "sibson", "bilinear"):
            command = [self.few, "healpix:5", "-o", "out.nc", "--method", method]
            done = self.regrid(*command, "--memory", "100K")
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            told = re.fullmatch(r"rondel: memory of 102400 bytes is too small: (\d+M) are enough for 4050 sources "
                                r"and 12288 targets(, whose weights have no tiles)?\n", done.stderr)
            self.assertTrue(told, done.stderr)
            self.assertFalse(told[2])
            self.assertEqual(os.listdir(self.folder), [])
            done = self.regrid(*command, "--memory", told[1], "--quiet")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.out.unlink()

    def test_options_without_effect_are_told(self):
        self.expect_refusal([self.input, "healpix:3", "-o", "out.nc", "--method", "conservative-2nd", "--limiter",
                             "bounds", "--tile", "9"],
                            "--tile has no effect with --limiter, which needs whole fields.*", status=2)
        self.expect_refusal([self.input, "healpix:3", "-o", "out.nc", "--method", "largest-share", "--norm", "destarea"],
                            "--norm has no effect with --method largest-share, which compares the parts of a target.*",
                            status=2)


if __name__ == "__main__":
    unittest.main()
