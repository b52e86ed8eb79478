#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""netCDF-4 in chunks of all kinds has the values that netCDF4-python reads, with any number of threads, and chunks that
are written are read by it.

Without netCDF4-python ctest says "Skipped".
"""

import ctypes
import importlib.util
import itertools
import os
import pathlib
import random
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder

SITE = pathlib.Path(netCDF4.__file__).parent.parent
LIBRARIES = sorted(SITE.glob("net[cC][dD][fF]4.libs/libnetcdf-*"))
if not LIBRARIES:
    sys.exit(77)
# The library of netCDF4-python, with zlib alone, and the system's, which is older, if there is one, with libdeflate.
ENVIRONMENTS = [
    {**os.environ, "RONDEL_NETCDF": str(LIBRARIES[0]), "RONDEL_LIBDEFLATE": "none"},
    {name: value for name, value in os.environ.items() if name != "RONDEL_NETCDF"},
]
LENGTHS = {"time": 12, "lat": 36, "lon": 72}
TYPES = ("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8")


def add_grid(data, num_times=12):
    for name, start in (("lat", -90), ("lon", -180)):
        data.createDimension(name, LENGTHS[name])
        axis = data.createVariable(name, "f8", (name,))
        axis.units = {"lat": "degrees_north", "lon": "degrees_east"}[name]
        axis[:] = start + 5 * (np.arange(LENGTHS[name]) + 0.5)
    data.createDimension("time", num_times)


class Chunks(ToolInFolder):
    def run_tool(self, *arguments, environment=ENVIRONMENTS[0]):
        return self.tool(*arguments, "--quiet", env=environment)

    def carried(self, name, *options, environment=ENVIRONMENTS[0]):
        """The fields of a file on its own grid, by its nearest places: each value where it was."""
        done = self.run_tool(
            "regrid",
            name,
            "grid:5",
            "--method",
            "nearest",
            "-o",
            "out.nc4",
            *options,
            environment=environment,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        with netCDF4.Dataset(self.folder / "out.nc4") as data:
            return {
                key: data[key][:].filled(np.nan) for key in data.variables if key.startswith("v")
            }

    def given(self, name):
        with netCDF4.Dataset(self.folder / name) as data:
            found = {}
            for key, field in data.variables.items():
                if key.startswith("v"):
                    order = [field.dimensions.index(d) for d in LENGTHS]
                    found[key] = field[:].astype("f8").filled(np.nan).transpose(order)
            return found

    def compare(self, name, *options, environment=ENVIRONMENTS[0]):
        wanted = self.given(name)
        found = self.carried(name, *options, environment=environment)
        self.assertEqual(list(found), list(wanted))
        for key, values in wanted.items():
            np.testing.assert_array_equal(found[key], values, key)

    def test_types_filters_and_forms(self):
        generator = np.random.default_rng(3)
        filters = (
            {"zlib": True},
            {"zlib": True, "shuffle": False, "complevel": 9},
            {"zlib": True, "fletcher32": True},
            {"shuffle": False},
            {"zlib": False, "fletcher32": True},
        )
        forms = ((1, 36, 72), (12, 36, 72), (5, 20, 33), (12, 9, 24), (3, 36, 10), (1, 1, 72))
        orders = list(itertools.permutations(LENGTHS))
        with netCDF4.Dataset(self.folder / "all.nc", "w") as data:
            add_grid(data)
            cases = itertools.product(TYPES, ("little", "big"), filters, forms)
            for number, (letter, endian, packing, form) in enumerate(cases):
                if number % 3 != 0 and letter not in ("i2", "f4"):
                    continue
                order = orders[number % len(orders)]
                chunk = [form[list(LENGTHS).index(d)] for d in order]
                field = data.createVariable(
                    f"v{number}", letter, order, endian=endian, chunksizes=chunk, **packing
                )
                values = generator.integers(0, 100, [LENGTHS[d] for d in order])
                field[:] = values - 50 * (letter[0] != "u") if letter[0] != "f" else values / 7
        for environment, threads in itertools.product(ENVIRONMENTS, ("1", "2")):
            with self.subTest(library=environment.get("RONDEL_NETCDF"), threads=threads):
                self.compare("all.nc", "--threads", threads, environment=environment)

    def test_chunks_of_many_times_are_read_a_few_times_at_a_time(self):
        generator = np.random.default_rng(5)
        with netCDF4.Dataset(self.folder / "many.nc", "w") as data:
            add_grid(data, 50)
            for number, (letter, form) in enumerate(
                itertools.product(("f4", "i2", "f8"), ((50, 36, 72), (23, 20, 33), (7, 36, 5), (1, 36, 72)))
            ):
                field = data.createVariable(
                    f"v{number}", letter, tuple(LENGTHS), zlib=True, chunksizes=form
                )
                field[:] = generator.integers(0, 100, (50, 36, 72))
        for memory, threads in itertools.product(("2M", "2300K", "3M", "6M", "2G"), ("1", "2")):
            with self.subTest(memory=memory, threads=threads):
                self.compare("many.nc", "--memory", memory, "--threads", threads)

    def test_chunks_beyond_the_memory_are_told(self):
        for name, order, chunk in (
            ("chunk.nc", ("time", "lat", "lon"), (400, 36, 72)),
            ("mixed.nc", ("lat", "lon", "time"), None),
        ):
            with netCDF4.Dataset(self.folder / name, "w") as data:
                add_grid(data, 400)
                field = data.createVariable("v", "f8", order, zlib=chunk is not None, chunksizes=chunk)
                field[:] = 1.0
            told = f"{name}: reading takes 8M beside the memory of 7M, as a chunk is uncompressed as a whole"
            for memory, is_told in (("7M", True), ("9M", False)):
                with self.subTest(name=name, memory=memory):
                    done = self.run_tool("regrid", name, "grid:9", "-o", "out.nc", "--memory", memory)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(told in done.stderr, is_told, done.stderr)

    def test_numbers_of_fewer_bits_than_their_bytes(self):
        """HDF5 has integers of any number of bits and floats with any exponent, which netCDF4-python cannot make."""
        hdf5 = ctypes.CDLL(str(LIBRARIES[0]))
        number = ctypes.c_int64
        for name in ("H5Fopen", "H5Dopen2", "H5Dcreate2", "H5Tcopy", "H5Screate_simple", "H5Pcreate"):
            getattr(hdf5, name).restype = number

        def of_library(name):
            return number.in_dll(hdf5, name)

        kinds = {
            "v_short": ("H5T_STD_I16LE_g", lambda kind: hdf5.H5Tset_precision(kind, ctypes.c_size_t(12))),
            "v_int": ("H5T_STD_I32LE_g", lambda kind: hdf5.H5Tset_precision(kind, ctypes.c_size_t(24))),
            "v_float": ("H5T_IEEE_F32LE_g", lambda kind: hdf5.H5Tset_ebias(kind, ctypes.c_size_t(100))),
        }
        values = np.arange(36 * 72, dtype="f8").reshape(36, 72) % 2000 - 1000
        lengths = (ctypes.c_ulonglong * 2)(36, 72)
        with netCDF4.Dataset(self.folder / "odd.nc", "w") as data:
            add_grid(data)
        file = number(hdf5.H5Fopen(str(self.folder / "odd.nc").encode(), 1, number(0)))
        for name, (base, change) in kinds.items():
            kind = number(hdf5.H5Tcopy(of_library(base)))
            self.assertGreaterEqual(change(kind), 0)
            chunks = number(hdf5.H5Pcreate(of_library("H5P_CLS_DATASET_CREATE_ID_g")))
            hdf5.H5Pset_chunk(chunks, 2, lengths)
            hdf5.H5Pset_deflate(chunks, 1)
            space = number(hdf5.H5Screate_simple(2, lengths, None))
            array = number(
                hdf5.H5Dcreate2(file, name.encode(), kind, space, number(0), chunks, number(0))
            )
            native = of_library("H5T_NATIVE_DOUBLE_g")
            pointer = values.ctypes.data_as(ctypes.c_void_p)
            self.assertEqual(hdf5.H5Dwrite(array, native, number(0), number(0), number(0), pointer), 0)
            for axis, scale in enumerate(("lat", "lon")):
                places = number(hdf5.H5Dopen2(file, scale.encode(), number(0)))
                self.assertEqual(hdf5.H5DSattach_scale(array, places, axis), 0)
                hdf5.H5Dclose(places)
            hdf5.H5Dclose(array)
        hdf5.H5Fclose(file)
        for environment in ENVIRONMENTS:
            found = self.carried("odd.nc", environment=environment)
            self.assertEqual(set(found), set(kinds))
            for name, array in found.items():
                np.testing.assert_array_equal(array, values, name)

    def test_packed_missing_and_unwritten_values(self):
        generator = np.random.default_rng(4)
        with netCDF4.Dataset(self.folder / "gaps.nc", "w") as data:
            add_grid(data, None)
            for number, (letter, times) in enumerate(
                (("i2", 12), ("i2", 7), ("f4", 12), ("f4", 5), ("f8", 1))
            ):
                field = data.createVariable(
                    f"v{number}",
                    letter,
                    tuple(LENGTHS),
                    zlib=True,
                    chunksizes=(4, 36, 72),
                    fill_value=-9,
                )
                if letter == "i2":
                    field.scale_factor = 0.25
                    field.add_offset = 3.0
                values = generator.integers(0, 90, (times, 36, 72)) * 0.25 + 3.0
                field[:times] = np.ma.masked_less(values, 6)
            sparse = data.createVariable(
                "v9", "f4", tuple(LENGTHS), zlib=True, chunksizes=(1, 36, 36)
            )
            sparse[3] = generator.normal(size=(36, 72))
            sparse[11, :, 40:] = 1.5
        for environment in ENVIRONMENTS:
            self.compare("gaps.nc", environment=environment)

    def test_variables_shorter_than_their_dimensions(self):
        """Values are those that were written, and what lacks is missing; netCDF-C, asked for all, mixes them up."""
        generator = np.random.default_rng(8)
        for number, order in enumerate(itertools.permutations(LENGTHS)):
            for packing in ({}, {"zlib": True, "chunksizes": [min(LENGTHS[d], 5) for d in order]}):
                name = f"short{number}.nc"
                wanted = np.full(tuple(LENGTHS.values()), np.nan)
                wanted[:5, :, :] = generator.integers(0, 1000, (5, 36, 72))
                if number % 2 == 0:  # a second dimension without an end
                    wanted[:, 20:, :] = np.nan
                with netCDF4.Dataset(self.folder / name, "w") as data:
                    for dimension, length in LENGTHS.items():
                        is_endless = dimension == "time" or (number % 2 == 0 and dimension == "lat")
                        data.createDimension(dimension, None if is_endless else length)
                    for axis, start in (("lat", -90), ("lon", -180)):
                        places = data.createVariable(axis, "f8", (axis,))
                        places.units = {"lat": "degrees_north", "lon": "degrees_east"}[axis]
                        places[:] = start + 5 * (np.arange(LENGTHS[axis]) + 0.5)
                    data.createVariable("time", "f8", ("time",))[:] = np.arange(12)
                    for letter in ("f4", "i2", "f8"):
                        field = data.createVariable(f"v_{letter}", letter, order, **packing)
                        turned = wanted.transpose([list(LENGTHS).index(d) for d in order])
                        there = ~np.isnan(turned)
                        box = tuple(slice(0, np.nonzero(there)[axis].max() + 1) for axis in range(3))
                        field[box] = turned[box]
                for environment in ENVIRONMENTS:
                    for key, values in self.carried(name, environment=environment).items():
                        np.testing.assert_array_equal(values, wanted, f"{key} {order} {packing}")

    def test_times_are_appended_to_what_is_written(self):
        """Beyond the last time is what the file says of values that were never written."""
        with netCDF4.Dataset(self.folder / "in.nc", "w") as data:
            add_grid(data, None)
            data.createVariable("v", "f4", tuple(LENGTHS))[:] = np.ones((30, 36, 72))
        for environment, deflate in itertools.product(ENVIRONMENTS, ("0", "1")):
            done = self.run_tool(
                "regrid",
                "in.nc",
                "grid:5",
                "--method",
                "nearest",
                "-o",
                "out.nc4",
                "--deflate",
                deflate,
                environment=environment,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            with netCDF4.Dataset(self.folder / "out.nc4", "a") as data:
                self.assertEqual(data["v"].chunking(), [25, 36, 72])
                data["v"][30, :3] = 5
                data["v"][32] = 5
            with netCDF4.Dataset(self.folder / "out.nc4") as data:
                found = data["v"][:].filled(np.nan)
            self.assertEqual(found.shape, (33, 36, 72))
            self.assertTrue((found[:30] == 1).all() and (found[30, :3] == 5).all())
            self.assertTrue(np.isnan(found[30, 3:]).all() and np.isnan(found[31]).all())

    def test_a_pipe_is_refused_where_files_are_read_more_than_once(self):
        with netCDF4.Dataset(self.folder / "in.nc", "w") as data:
            add_grid(data)
            data.createVariable("v", "f4", tuple(LENGTHS))[:] = 1.0
        os.mkfifo(self.folder / "pipe.nc")
        for command in (
            ("regrid", "pipe.nc", "grid:30", "-o", "out.nc"),
            ("regrid", "in.nc", "pipe.nc", "-o", "out.nc"),
            ("interpolate", "pipe.nc", "--value", "v", "--to", "grid:30", "-o", "out.nc"),
            ("info", "pipe.nc"),
        ):
            done = self.tool(*command, timeout=60)
            self.assertEqual(
                (done.returncode, done.stderr),
                (1, "rondel: pipe.nc: a pipe, and this file is read more than once; copy it to a file first\n"),
                command,
            )

    def test_more_chunks_than_are_looked_up(self):
        with netCDF4.Dataset(self.folder / "many.nc", "w") as data:
            add_grid(data, 4100)
            field = data.createVariable(
                "v", "i2", tuple(LENGTHS), zlib=True, chunksizes=(1, 18, 72)
            )
            field[:] = np.arange(4100 * 36 * 72, dtype="i8").reshape(4100, 36, 72) % 30011
        self.compare("many.nc")

    def test_bytes_before_the_file(self):
        """HDF5 counts from its signature, which may come behind other bytes."""
        with netCDF4.Dataset(self.folder / "plain.nc", "w") as data:
            add_grid(data)
            data.createVariable("v", "f4", tuple(LENGTHS), zlib=True, chunksizes=(12, 36, 24))[
                :
            ] = np.random.default_rng(5).normal(size=tuple(LENGTHS.values()))
        (self.folder / "behind.nc").write_bytes(
            bytes(512) + (self.folder / "plain.nc").read_bytes()
        )
        try:
            wanted = self.given("behind.nc")
        except OSError:
            self.skipTest("netCDF-C does not open it")
        np.testing.assert_array_equal(self.carried("behind.nc")["v"], wanted["v"])

    def test_damage_is_told_or_does_no_harm(self):
        source = random.Random(6)
        with netCDF4.Dataset(self.folder / "whole.nc", "w") as data:
            add_grid(data)
            data.createVariable("v", "f4", tuple(LENGTHS), zlib=True, chunksizes=(6, 18, 36))[:] = (
                np.random.default_rng(6).normal(size=tuple(LENGTHS.values()))
            )
        content = (self.folder / "whole.nc").read_bytes()
        wanted = self.given("whole.nc")["v"]
        num_refused = 0
        for _ in range(12):
            place = source.randrange(len(content) // 3, len(content) - 8)
            (self.folder / "bad.nc").write_bytes(content[:place] + b"rondel" + content[place + 6 :])
            done = self.run_tool(
                "regrid", "bad.nc", "grid:5", "--method", "nearest", "-o", "bad-out.nc"
            )
            if done.returncode == 0:
                with netCDF4.Dataset(self.folder / "bad-out.nc") as data:
                    np.testing.assert_array_equal(data["v"][:], wanted)
                (self.folder / "bad-out.nc").unlink()
                continue
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"\Arondel: bad\.nc: .*\n\Z")
            self.assertFalse((self.folder / "bad-out.nc").exists())
            num_refused += 1
        self.assertGreater(num_refused, 6)

    def test_chunks_that_are_written_are_those_of_netcdf(self):
        """Equal bytes with any number of threads; chunks that a dimension cuts, times without an end, and --deflate."""
        generator = np.random.default_rng(7)
        with netCDF4.Dataset(self.folder / "in.nc", "w") as data:
            add_grid(data, None)
            for name, letter in (("v", "f4"), ("v2", "f8")):
                data.createVariable(name, letter, tuple(LENGTHS))[:] = generator.normal(
                    size=(12, 36, 72)
                )
        for environment, deflate in itertools.product(ENVIRONMENTS, ("0", "1", "9")):
            results = []
            for threads in ("1", "2"):
                out = f"{threads}.nc4"
                done = self.run_tool(
                    "regrid",
                    "in.nc",
                    "grid:0.9",
                    "--method",
                    "bilinear",
                    "-o",
                    out,
                    "--deflate",
                    deflate,
                    "--threads",
                    threads,
                    environment=environment,
                )
                self.assertEqual(done.returncode, 0, done.stderr)
                with netCDF4.Dataset(self.folder / out) as data:
                    self.assertTrue(data.dimensions["time"].isunlimited())
                    self.assertEqual(len(data.dimensions["time"]), 12)
                    results.append({key: data[key][:].filled(np.nan) for key in ("v", "v2")})
                    self.assertEqual(data["v"].filters()["complevel"], int(deflate))
                    self.assertNotEqual(data["v"].chunking(), "contiguous")
                    self.assertNotEqual(200 % data["v"].chunking()[1], 0)
            done = self.run_tool(
                "regrid",
                "in.nc",
                "grid:0.9",
                "--method",
                "bilinear",
                "-o",
                "classic.nc",
                environment=environment,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            with netCDF4.Dataset(self.folder / "classic.nc") as data:
                for key in ("v", "v2"):
                    for found in results:
                        np.testing.assert_array_equal(found[key], data[key][:].filled(np.nan))


if __name__ == "__main__":
    unittest.main()
