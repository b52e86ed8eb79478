#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""netCDF-4: what netCDF4-python and xarray write is read as the same content in a classic format is, and they read what is
written.

Without them ctest says "Skipped".
"""

import ctypes.util
import importlib.util
import itertools
import json
import os
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import unittest

if any(importlib.util.find_spec(name) is None for name in ("netCDF4", "xarray")):
    sys.exit(77)
import netCDF4
import numpy as np
import xarray
from tool_in_folder import TOOL, ToolInFolder

LIBRARIES = sorted(
    pathlib.Path(netCDF4.__file__).parent.parent.glob("net[cC][dD][fF]4.libs/libnetcdf-*")
)
if not LIBRARIES:
    sys.exit(77)
ENVIRONMENT = {**os.environ, "RONDEL_NETCDF": str(LIBRARIES[0])}
TYPES = ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8")


def add_grid(data, num_lon=12, num_lat=6):
    """Longitudes and latitudes of a grid of the sphere."""
    for name, count, start, step, unit in (
        ("lat", num_lat, -90, 180 / num_lat, "degrees_north"),
        ("lon", num_lon, -180, 360 / num_lon, "degrees_east"),
    ):
        data.createDimension(name, count)
        axis = data.createVariable(name, "f8", (name,))
        axis.units = unit
        axis[:] = start + step * (np.arange(count) + 0.5)


class Netcdf4(ToolInFolder):
    environment = ENVIRONMENT

    def run_tool(self, *arguments, status=0, environment=None, stdin=None):
        environment = {**ENVIRONMENT, **(environment or {})}
        done = self.tool(*arguments, text=False, env=environment, stdin=stdin)
        self.assertEqual(done.returncode, status, done.stderr.decode())
        return done.stderr.decode()

    def values(self, name, variable):
        with netCDF4.Dataset(self.folder / name) as data:
            data.set_auto_mask(False)
            return data[variable][:].copy()

    def weights(self, source, target="grid:60"):
        self.run_tool("remap", source, target, "-o", "w.nc", "--quiet")
        return "w.nc"

    def test_all_types_are_those_of_classic(self):
        """Chunks, compression, an unlimited time, every type of numbers: the same bytes come out as from CDF-5."""
        generator = np.random.default_rng(1)
        for kind in ("NETCDF4", "NETCDF3_64BIT_DATA"):
            with netCDF4.Dataset(self.folder / f"{kind}.nc", "w", format=kind) as data:
                add_grid(data)
                data.createDimension("time", None)
                axis = data.createVariable("time", "f8", ("time",))
                axis.units = "days since 2000-01-01"
                axis[:] = [0.5, 1.5, 2.5]
                generator = np.random.default_rng(1)
                for letter in TYPES:
                    packing = {"zlib": True, "chunksizes": (2, 4, 5)} if kind == "NETCDF4" else {}
                    field = data.createVariable(
                        f"of_{letter}", letter, ("time", "lat", "lon"), **packing
                    )
                    field.units = "K"
                    field[:] = generator.integers(0, 100, (3, 6, 12))
        weights = self.weights("NETCDF4.nc")
        for kind in ("NETCDF4", "NETCDF3_64BIT_DATA"):
            self.run_tool("apply", weights, f"{kind}.nc", "-o", f"{kind}-out.nc", "--quiet")
        first, second = (
            (self.folder / f"{kind}-out.nc").read_bytes()
            for kind in ("NETCDF4", "NETCDF3_64BIT_DATA")
        )
        self.assertEqual(first, second)
        with netCDF4.Dataset(self.folder / "NETCDF4-out.nc") as data:
            self.assertEqual(
                {name for name in data.variables if name.startswith("of_")},
                {f"of_{t}" for t in TYPES},
            )
            self.assertEqual(list(data["time"][:]), [0.5, 1.5, 2.5])

    def test_orders_of_dimensions_in_chunks_of_any_form(self):
        """Against sums over the entries of the weights."""
        generator = np.random.default_rng(2)
        lengths = {"time": 5, "lat": 6, "lon": 12}
        values = generator.normal(size=tuple(lengths.values()))
        with netCDF4.Dataset(self.folder / "grid.nc", "w") as data:
            add_grid(data)
        weights = self.weights("grid.nc")
        row, col, s = (self.values(weights, name) for name in ("row", "col", "S"))
        expected = np.zeros((5, row.max()))
        for time in range(5):
            np.add.at(expected[time], row - 1, s * values[time].ravel()[col - 1])
        for order in itertools.permutations(lengths):
            for chunks in (None, (1, 1, 1), (5, 6, 12), (2, 5, 7), (3, 1, 2)):
                packing = {} if chunks is None else {"chunksizes": chunks, "zlib": True}
                if chunks is not None:
                    packing["chunksizes"] = [min(c, lengths[d]) for c, d in zip(chunks, order)]
                with netCDF4.Dataset(self.folder / "field.nc", "w") as data:
                    add_grid(data)
                    data.createDimension("time", 5 if chunks is None else None)
                    field = data.createVariable("t", "f8", order, **packing)
                    field[:] = values.transpose([list(lengths).index(name) for name in order])
                self.run_tool("apply", weights, "field.nc", "-o", "out.npy", "--quiet")
                found = np.load(self.folder / "out.npy")
                np.testing.assert_allclose(found, expected, atol=1e-14)
        self.run_tool("apply", weights, "field.nc:t[-2]", "-o", "out.npy", "--quiet")
        np.testing.assert_allclose(np.load(self.folder / "out.npy"), expected[3], atol=1e-14)

    def test_one_of_several_times_is_chosen(self):
        """Contours and figures are those of a table with the values of that time."""
        lon, lat = np.meshgrid(np.arange(-165.0, 180, 30), np.arange(-75.0, 90, 30))
        values = np.stack([lat + 10 * k * np.cos(np.radians(lon)) for k in range(3)])
        with netCDF4.Dataset(self.folder / "model.nc", "w") as data:
            add_grid(data)
            data.createDimension("time", 3)
            axis = data.createVariable("time", "f8", ("time",))
            axis.units = "hours since 2000-01-01"
            axis[:] = [0, 6, 12]
            data.createVariable("tas", "f8", ("lat", "lon", "time"))[:] = np.moveaxis(values, 0, 2)
        places = zip(*(array.ravel().tolist() for array in (lon, lat, values[1])))
        rows = [",".join(map(repr, place)) for place in places]
        commands = {
            "lines.geojson": ("contours", "--value", ("--levels", "-30,0,30")),
            "field.svg": ("plot", "--values", ("--contours", "20")),
        }
        for name, (command, option, more) in commands.items():
            for chosen in ("tas[1]", "tas[-2]", "tas_2000-01-01T06:00:00"):
                made = []
                (self.folder / "t.csv").write_text("\n".join([f"lon,lat,{chosen}", *rows]) + "\n")
                for source in ("t.csv", "model.nc", f"model.nc:{chosen}"):
                    self.run_tool(command, source, option, chosen, *more, "-o", name, "--quiet")
                    made.append((self.folder / name).read_bytes())
                self.assertEqual(made[1:], made[:1] * 2)
            said = self.run_tool(
                command, "model.nc", option, "tas", *more, "-o", f"not-{name}", status=2
            )
            self.assertIn(
                f"{option}: 'tas' of model.nc has several fields (time 3); one of them is "
                "'tas[0]', or 'tas_2000-01-01T00:00:00'",
                said,
            )
        said = self.run_tool("info", "model.nc")
        self.assertIn('"tas" has several fields (time 3) and is no column', said)
        self.run_tool("interpolate", "model.nc:tas[1]", "--to", "t.csv", "-o", "at.csv", "--quiet")
        header, *lines = (self.folder / "at.csv").read_text().splitlines()
        self.assertEqual(header, "lon,lat,tas_2000-01-01T06:00:00_,tas_2000-01-01T06:00:00")
        found = [float(line.split(",")[3]) for line in lines]
        np.testing.assert_allclose(found, values[1].ravel(), atol=1e-12)

    def test_what_is_more_than_numbers_costs_nothing_else(self):
        """Strings, a group, an enumeration, a compound: the field beside them is read, and that of the group by its name."""
        with netCDF4.Dataset(self.folder / "rich.nc", "w") as data:
            add_grid(data)
            data.setncattr_string("institution", "Météo")
            names = data.createVariable("name", str, ("lat",))
            names[:] = np.array([f"row {i}" for i in range(6)], dtype=object)
            pair = data.createCompoundType(np.dtype([("a", "f8"), ("b", "i4")]), "pair")
            data.createVariable("pairs", pair, ("lat",))
            color = data.createEnumType(np.uint8, "color", {"red": 0, "blue": 1})
            data.createVariable("colors", color, ("lat",), fill_value=0)
            field = data.createVariable("t", "f4", ("lat", "lon"))
            field.setncattr_string("long_name", ["Température", "de l'air"])
            field[:] = np.arange(72).reshape(6, 12)
            group = data.createGroup("model")
            inner = group.createVariable("t", "f4", ("lat", "lon"))
            inner[:] = 5
        weights = self.weights("rich.nc", "grid:30")
        self.run_tool("apply", weights, "rich.nc", "-o", "out.nc", "--value", "t", "--quiet")
        np.testing.assert_allclose(
            self.values("out.nc", "t"), np.arange(72).reshape(6, 12), rtol=1e-12
        )
        with netCDF4.Dataset(self.folder / "out.nc") as data:
            self.assertEqual(data["t"].long_name, "Température de l'air")
        self.run_tool(
            "apply", weights, "rich.nc", "-o", "group.nc", "--value", "model/t", "--quiet"
        )
        np.testing.assert_allclose(self.values("group.nc", "model_t"), 5, rtol=1e-12)

    def test_xarray(self):
        """xarray writes texts as variables of strings, and NaN as fill values."""
        lat, lon = np.arange(-75.0, 90, 30), np.arange(-165.0, 180, 30)
        dataset = xarray.Dataset(
            {
                "t": (("time", "lat", "lon"), np.random.default_rng(2).random((2, 6, 12))),
                "label": (("lat",), [f"row {i}" for i in range(6)]),
            },
            {
                "lat": ("lat", lat, {"units": "degrees_north"}),
                "lon": ("lon", lon, {"units": "degrees_east"}),
            },
        )
        dataset["t"][1, 2, 3] = np.nan
        dataset.to_netcdf(self.folder / "x.nc", engine="netcdf4")
        self.run_tool("apply", self.weights("x.nc", "grid:30"), "x.nc", "-o", "out.nc4", "--quiet")
        with xarray.open_dataset(self.folder / "out.nc4", engine="netcdf4") as back:
            np.testing.assert_allclose(back["t"], dataset["t"], rtol=1e-12)

    def test_what_is_written_is_compressed_and_the_same(self):
        """Weights, fields and meshes: equal to the classic ones for netCDF4-python, smaller, and the same bytes twice."""

        def same(classic, packed):
            with (
                netCDF4.Dataset(self.folder / classic) as one,
                netCDF4.Dataset(self.folder / packed) as other,
            ):
                self.assertEqual(other.data_model, "NETCDF4")
                self.assertEqual(list(one.variables), list(other.variables))
                self.assertEqual(one.__dict__, other.__dict__)
                for name, variable in one.variables.items():
                    self.assertEqual(variable.dimensions, other[name].dimensions)
                    self.assertEqual(variable.dtype, other[name].dtype)
                    self.assertEqual(str(variable.__dict__), str(other[name].__dict__))
                    np.testing.assert_array_equal(variable[:], other[name][:])
                    if variable.ndim > 0:
                        self.assertEqual(other[name].filters()["complevel"], 1)
                        self.assertTrue(other[name].filters()["shuffle"])

        self.run_tool("mesh", "icosahedral", "3", "-o", "m.nc", "--quiet")
        for name in ("n.nc4", "again.nc4"):
            self.run_tool("mesh", "convert", "m.nc", "-o", name, "--quiet")
        same("m.nc", "n.nc4")
        self.assertLess(
            (self.folder / "n.nc4").stat().st_size, (self.folder / "m.nc").stat().st_size
        )
        self.assertEqual(
            (self.folder / "n.nc4").read_bytes(), (self.folder / "again.nc4").read_bytes()
        )
        self.run_tool("mesh", "convert", "n.nc4", "-o", "back.nc", "--quiet")
        self.assertEqual(
            (self.folder / "m.nc").read_bytes(), (self.folder / "back.nc").read_bytes()
        )
        for extra, name in (((), "w.nc"), (("--kind", "nc4"), "v.nc")):
            self.run_tool("remap", "m.nc", "grid:15", "-o", name, *extra, "--quiet")
        same("w.nc", "v.nc")
        self.run_tool("remap", "m.nc", "grid:15", "-o", "plain.nc4", "--deflate", "0", "--quiet")
        self.assertGreater(
            (self.folder / "plain.nc4").stat().st_size, (self.folder / "v.nc").stat().st_size
        )
        self.run_tool("apply", "v.nc", "m.nc", "--value", "areaCell", "-o", "a.nc", "--quiet")
        self.run_tool("apply", "w.nc", "n.nc4", "--value", "areaCell", "-o", "a.nc4", "--quiet")
        same("a.nc", "a.nc4")
        self.assertEqual(sorted(path.suffix for path in self.folder.glob(".*")), [])

    def test_names_and_pipes(self):
        """Content counts before the ending, meshes of any convention are read from a pipe, and a file written to one."""
        self.run_tool("mesh", "icosahedral", "3", "-o", "m.nc", "--quiet")
        for convention in ("ugrid", "scrip", "esmf"):
            self.run_tool(
                "mesh", "convert", "m.nc", "--format", convention, "-o", "u.nc", "--quiet"
            )
            self.run_tool("mesh", "convert", "u.nc", "-o", "direct.nc", "--quiet")
            self.run_tool(
                "mesh",
                "convert",
                "m.nc",
                "--format",
                convention,
                "--kind",
                "nc4",
                "-o",
                "u.h5",
                "--quiet",
            )
            for name in ("u.nc", "u.h5"):
                with open(self.folder / name, "rb") as pipe:
                    self.run_tool(
                        "mesh",
                        "convert",
                        "-",
                        "--input-format",
                        "nc",
                        "-o",
                        "piped.nc",
                        "--quiet",
                        stdin=pipe,
                    )
                self.assertEqual(
                    (self.folder / "direct.nc").read_bytes(),
                    (self.folder / "piped.nc").read_bytes(),
                )
        for ending in ("nc4", "cdf", "ncf", "ug", "exo", "e", "g", "h5", "unknown"):
            (self.folder / f"named.{ending}").write_bytes((self.folder / "u.nc").read_bytes())
            self.run_tool("mesh", "convert", f"named.{ending}", "-o", "piped.nc", "--quiet")
            self.assertEqual(
                (self.folder / "direct.nc").read_bytes(), (self.folder / "piped.nc").read_bytes()
            )

    def test_values_at_places_of_netcdf(self):
        """interpolate from a grid to a grid, along time; oracle: the nearest values by brute force."""
        generator = np.random.default_rng(3)
        with netCDF4.Dataset(self.folder / "f.nc", "w") as data:
            add_grid(data)
            data.createDimension("time", 2)
            data.createVariable("time", "f8", ("time",))[:] = [3, 4]
            field = data.createVariable("t", "f4", ("time", "lat", "lon"), fill_value=-99)
            field.units = "K"
            values = generator.random((2, 6, 12)).astype("f4")
            values[1, 2, 3] = -99
            field[:] = values
        with netCDF4.Dataset(self.folder / "g.nc", "w") as data:
            add_grid(data, 20, 10)
        self.run_tool(
            "interpolate",
            "f.nc:t",
            "--to",
            "g.nc",
            "--method",
            "nearest",
            "-o",
            "out.nc4",
            "--quiet",
        )
        found = self.values("out.nc4", "t")
        self.assertEqual(found.shape, (2, 10, 20))
        with netCDF4.Dataset(self.folder / "out.nc4") as data:
            self.assertEqual((data["t"].units, data["t"].dimensions), ("K", ("time", "lat", "lon")))
            self.assertEqual(list(data["time"][:]), [3, 4])
            places = np.radians(np.meshgrid(data["lon"][:], data["lat"][:]))
        sources = np.radians(np.meshgrid(self.values("f.nc", "lon"), self.values("f.nc", "lat")))

        def vectors(lon, lat):
            return np.stack(
                [np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], -1
            ).reshape(-1, 3)

        cosines = vectors(*places) @ vectors(*sources).T
        for time in range(2):
            known = values[time].ravel() != -99
            nearest = np.where(known, cosines, -2)
            allowed = (
                nearest >= nearest.max(1, keepdims=True) - 1e-12
            )  # several are as near as each other
            hits = np.isclose(
                found[time].reshape(-1, 1), values[time].reshape(1, -1), rtol=0, atol=1e-7
            )
            self.assertTrue((hits & allowed).any(1).all())
        for command in (("info", "f.nc"), ("plot", "f.nc", "-o", "f.svg"), ("info", "g.nc")):
            self.run_tool(*command)

    def test_damage_is_told(self):
        """A file that is cut anywhere, or has other bytes, gives a message of one line with its name, or the answer."""
        with netCDF4.Dataset(self.folder / "ok.nc", "w") as data:
            add_grid(data)
            data.createVariable("t", "f4", ("lat", "lon"), zlib=True)[:] = np.arange(72).reshape(
                6, 12
            )
        content = (self.folder / "ok.nc").read_bytes()
        source = random.Random(4)
        cases = [content[:size] for size in (8, 100, 1000, len(content) // 2, len(content) - 100)]
        for _ in range(15):
            changed = bytearray(content)
            for _ in range(source.randrange(1, 20)):
                changed[source.randrange(len(changed))] = source.randrange(256)
            cases.append(bytes(changed))
        for case in cases:
            (self.folder / "bad.nc").write_bytes(case)
            done = self.tool("remap", "bad.nc", "grid:60", "-o", "w.nc", "--quiet", text=False)
            self.assertIn(done.returncode, (0, 1))
            if done.returncode == 1:
                lines = done.stderr.decode().splitlines()
                self.assertEqual(len(lines), 1, lines)
                self.assertTrue(lines[0].startswith("rondel: bad.nc: "), lines)

    def test_integers_of_64_bits_are_compared_exactly(self):
        """Fill values and bounds that are no doubles; the oracle is what Python's integers say."""
        large = 2**62

        def values(kind, numbers, fill=None, **attributes):
            with netCDF4.Dataset(self.folder / "i.nc", "w", format=kind) as data:
                data.createDimension("p", 6)
                for name, unit, places in (
                    ("lon", "degrees_east", [0, 90, 180, 270, 0, 0]),
                    ("lat", "degrees_north", [0, 0, 0, 0, 90, -90]),
                ):
                    axis = data.createVariable(name, "f8", ("p",))
                    axis.units = unit
                    axis[:] = places
                field = data.createVariable("t", "i8", ("p",), fill_value=fill)
                field.set_auto_maskandscale(False)
                for name, value in attributes.items():
                    field.setncattr(name, np.int64(value))
                field[:] = [*numbers, 1, 2, 3, 4]
            run = ("interpolate", "i.nc:t", "--to", "i.nc", "--method", "nearest")
            self.run_tool(*run, "-o", "o.npy", "--outside", "nearest", "--quiet")
            return [int(value) for value in np.load(self.folder / "o.npy").ravel()[:2]]

        for kind in ("NETCDF4", "NETCDF3_64BIT_DATA"):
            # The missing second value takes that of another site.
            self.assertEqual(values(kind, [large, large + 4], fill=large + 4)[0], large)
            self.assertLess(values(kind, [large, large + 4], fill=large + 4)[1], 5)
            bounded = values(kind, [large, large + 1024], valid_max=large + 1023)
            self.assertEqual(bounded[0], large)
            self.assertLess(bounded[1], 5)
            never_written = values(kind, [-(2**63), -(2**63) + 2])
            self.assertEqual(never_written[0], -(2**63))
            self.assertGreater(never_written[1], 0)
            with self.assertRaisesRegex(
                AssertionError, 'variable "t": 4611686018427387907 is no double'
            ):
                values(kind, [large + 3, large + 4], fill=large + 4)

    def test_no_room_is_told(self):
        """A limit of the size of files, as a full disk: status 1, the file's name, the system's reason, nothing left behind. Also
        with the system's netCDF-C, whose HDF5 may be one that crashes where it cannot write."""
        self.run_tool("generate", "fibonacci", "-n", "60", "-o", "p.csv", "--quiet")
        rows = (self.folder / "p.csv").read_text().splitlines()
        named = [rows[0] + ",v", *(f"{row},{k / 7}" for k, row in enumerate(rows[1:]))]
        (self.folder / "v.csv").write_text("\n".join(named) + "\n")
        self.run_tool("mesh", "convert", "p.csv", "-o", "m.nc", "--quiet")
        self.run_tool("remap", "p.csv", "grid:3", "-o", "w.nc", "--quiet")
        self.run_tool(
            "interpolate", "v.csv", "--value", "v", "--to", "p.csv", "-o", "f.nc", "--quiet"
        )
        commands = (
            ("interpolate", "v.csv", "--value", "v", "--to", "grid:2"),
            ("interpolate", "v.csv", "--to", "grid:3", "--weights"),
            ("remap", "p.csv", "grid:3"),
            ("apply", "w.nc", "f.nc"),
            ("mesh", "convert", "m.nc"),
            ("mesh", "scvt", "-n", "200"),
            ("mesh", "cull", "m.nc", "--inside", "half.geojson"),
        )
        ring = [[0, -80], [90, -80], [170, -80], [170, 80], [90, 80], [0, 80], [0, -80]]
        half = {"type": "Polygon", "coordinates": [ring]}
        (self.folder / "half.geojson").write_text(json.dumps(half))
        libraries = [ENVIRONMENT]
        system = {name: value for name, value in os.environ.items() if name != "RONDEL_NETCDF"}
        if ctypes.util.find_library("netcdf") is not None:
            libraries.append(system)
        before = sorted(path.name for path in self.folder.iterdir())
        for environment, command in itertools.product(libraries, commands):
            option = () if command[-1] == "--weights" else ("-o",)
            words = (*command, *option, "full.nc4", "--quiet")
            for limit in (1 << 12, 1 << 28):

                def limited(limit=limit):
                    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

                done = self.tool(*words, env=environment, preexec_fn=limited)
                said = done.stderr
                if limit == 1 << 28:
                    self.assertEqual(done.returncode, 0, said)
                    (self.folder / "full.nc4").unlink()
                else:
                    self.assertEqual(
                        (done.returncode, said), (1, "rondel: full.nc4: File too large\n"), command
                    )
                self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)

    def test_names_that_netcdf_refuses_are_named(self):
        """NetCDF-4 has no name twice once letters and accents are composed."""
        first, second = "\u00e9", "e\u0301"
        (self.folder / "t.csv").write_text(
            f"lon,lat,{first},{second}\n" + "".join(f"{k},{k},1,2\n" for k in range(5))
        )
        named = ("--value", first, "--value", second)
        said = self.run_tool("interpolate", "t.csv", *named, "--to", "t.csv", "-o", "t.nc4", status=1)
        self.assertIn(f'rondel: t.nc4: variable "{second}": netCDF-C says: ', said)

    @unittest.skipUnless(sys.platform == "linux", "the loader of Linux tells what it loads")
    def test_the_library_of_the_environment_that_the_tool_is_in(self):
        """pip installs the command beside the packages, whose wheel of netCDF4 has the library."""
        packages = self.folder / "lib/python3.11/site-packages"
        packages.mkdir(parents=True)
        (packages / LIBRARIES[0].parent.name).symlink_to(LIBRARIES[0].parent)
        (self.folder / "bin").mkdir()
        tool = self.folder / "bin/rondel"
        shutil.copy(TOOL, tool)
        with netCDF4.Dataset(self.folder / "ok.nc", "w") as data:
            add_grid(data)
        environment = {k: v for k, v in os.environ.items() if k != "RONDEL_NETCDF"}
        done = subprocess.run(
            [tool, "remap", "ok.nc", "grid:60", "-o", "w.nc"],
            cwd=self.folder,
            env={**environment, "LD_DEBUG": "files"},
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(done.returncode, 0)
        self.assertIn(str(packages / LIBRARIES[0].parent.name / LIBRARIES[0].name), done.stderr)

    def test_without_the_library_it_says_what_to_install(self):
        with netCDF4.Dataset(self.folder / "ok.nc", "w") as data:
            add_grid(data)
        nowhere = {"RONDEL_NETCDF": str(self.folder / "nowhere.so")}
        message = self.run_tool(
            "remap", "ok.nc", "grid:60", "-o", "w.nc", status=1, environment=nowhere
        )
        for word in ("rondel: ok.nc: ", "nowhere.so", "libnetcdf19", "netCDF4", "RONDEL_NETCDF"):
            self.assertIn(word, message)
        message = self.run_tool(
            "remap", "grid:60", "grid:60", "-o", "w.nc4", status=1, environment=nowhere
        )
        self.assertIn("rondel: w.nc4: ", message)
        self.assertFalse((self.folder / "w.nc4").exists())


if __name__ == "__main__":
    unittest.main()
