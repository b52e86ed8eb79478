#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files that are regridded, against sums that NumPy computes: of packed numbers, in chunks, with times and levels.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import json
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder


def lines(centers, least, most):
    """The lines between cells of evenly spaced centers."""
    middles = (centers[1:] + centers[:-1]) / 2
    return np.concatenate([[least], middles, [most]])


def shares(source, target, period=None):
    """How much of each interval of the target each one of the source has, (target, source)."""
    found = np.zeros((len(target) - 1, len(source) - 1))
    for shift in (-period, 0, period) if period else (0,):
        low = np.maximum(target[:-1, None], source[None, :-1] + shift)
        high = np.minimum(target[1:, None], source[None, 1:] + shift)
        found += np.maximum(high - low, 0)
    return found


class Regrid(ToolInFolder):
    def setUp(self):
        super().setUp()
        generator = np.random.default_rng(1)
        self.lat = np.linspace(90, -90, 31)
        self.lon = np.arange(0, 360, 6.0)
        self.air = np.round(generator.uniform(250, 310, (4, 2, 31, 60)), 2)
        self.sea = generator.uniform(0, 30, (4, 31, 60)).astype("f4")
        self.sea[:, 5:15, 10:30] = np.nan

    def write(self, name, kind, chunks):
        with netCDF4.Dataset(self.folder / name, "w", format=kind) as file:
            for dimension, size in (("time", 4), ("level", 2), ("latitude", 31), ("longitude", 60), ("bnds", 2)):
                file.createDimension(dimension, size)
            file.setncatts({"title": "made", "history": "yesterday: made", "Conventions": "CF-1.7"})
            time = file.createVariable("time", "f8", ("time",))
            time.setncatts({"units": "hours since 2000-01-01", "bounds": "time_bnds", "calendar": "standard"})
            time[:] = np.arange(4) * 6
            file.createVariable("time_bnds", "f8", ("time", "bnds"))[:] = np.arange(8).reshape(4, 2)
            level = file.createVariable("level", "i4", ("level",))
            level.units = "hPa"
            level[:] = [850, 500]
            for axis, values, units in (("latitude", self.lat, "degrees_north"), ("longitude", self.lon, "degrees_east")):
                variable = file.createVariable(axis, "f4", (axis,))
                variable.units = units
                variable[:] = values
            options = {"chunksizes": (1, 1, 7, 9), "zlib": True} if chunks else {}
            air = file.createVariable("t", "i2", ("time", "level", "latitude", "longitude"), fill_value=-32767, **options)
            air.setncatts({"scale_factor": 0.01, "add_offset": 280.0, "units": "K", "cell_methods": "time: mean"})
            air[:] = self.air
            file.createVariable("sst", "f4", ("time", "latitude", "longitude"), fill_value=-9)[:] = np.ma.masked_invalid(self.sea)
            crs = file.createVariable("crs", "i4", ())
            crs.grid_mapping_name = "latitude_longitude"

    def regrid(self, *arguments, status=0):
        return self.finished("regrid", *arguments, status=status)

    def sums(self, nlon, nlat):
        """The means over a grid by NumPy, and the share of each cell that has values."""
        east = shares(lines(self.lon, -3, 357), np.linspace(-180, 180, nlon + 1), 360)
        height = [np.sin(np.radians(edge)) for edge in (lines(self.lat[::-1], -90, 90), np.linspace(-90, 90, nlat + 1))]
        north = shares(*height)[:, ::-1]
        weights = np.einsum("aj,bi->abji", north, east)
        weights /= weights.sum((2, 3), keepdims=True)
        air = np.einsum("abji,tlji->tlab", weights, self.air)
        known = np.isfinite(self.sea)
        share = np.einsum("abji,tji->tab", weights, known.astype(float))
        sea = np.einsum("abji,tji->tab", weights, np.where(known, self.sea.astype(float), 0))
        with np.errstate(invalid="ignore", divide="ignore"):
            return air, np.where(share >= 0.5 - 1e-9, sea / share, np.nan), share

    def test_values_are_those_of_numpy(self):
        air, sea, share = self.sums(12, 6)
        self.assertGreater(np.isnan(sea).sum(), 0)
        for kind, chunks in (("NETCDF3_64BIT_OFFSET", False), ("NETCDF4", False), ("NETCDF4", True)):
            self.write("in.nc", kind, chunks)
            self.regrid("in.nc", "grid:12x6", "-o", "out.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                self.assertEqual(out["t"].dtype, np.float32)
                self.assertEqual(out["t"].dimensions, ("time", "level", "lat", "lon"))
                np.testing.assert_allclose(out["t"][:].filled(np.nan), air, rtol=2e-7)
                found = out["sst"][:].filled(np.nan)
                clear = np.abs(share - 0.5) > 1e-6
                np.testing.assert_allclose(found[clear], sea[clear], rtol=1e-6)

    def test_integrals_of_the_values_that_are_there_are_kept_on_request(self):
        _, sea, share = self.sums(12, 6)
        self.write("in.nc", "NETCDF3_64BIT_OFFSET", False)
        for options in ((), ("--tile", "200")):
            self.regrid("in.nc", "grid:12x6", "-o", "out.nc", "--value", "sst", "--norm", "destarea", "--max-missing", "1", *options)
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                found = out["sst"][:].filled(np.nan)
            known = np.isfinite(sea)
            self.assertLess(share[known].min(), 0.9)
            np.testing.assert_allclose(found[known], (sea * share)[known], rtol=1e-6)

    def test_masked_targets_have_no_value(self):
        self.write("in.nc", "NETCDF3_64BIT_OFFSET", False)
        mask = np.arange(72) % 3 > 0
        lon, lat = (part.ravel() for part in np.meshgrid(np.arange(15.0, 360, 30), np.arange(-75.0, 80, 30)))
        with netCDF4.Dataset(self.folder / "target.nc", "w", format="NETCDF3_CLASSIC") as file:
            file.createDimension("grid_size", 72)
            file.createDimension("grid_corners", 4)
            for name, center, steps in (("lon", lon, (-15, 15, 15, -15)), ("lat", lat, (-15, -15, 15, 15))):
                for kind, values in (("center", center), ("corner", center[:, None] + np.array(steps))):
                    dimensions = ("grid_size", "grid_corners")[: values.ndim]
                    variable = file.createVariable(f"grid_{kind}_{name}", "f8", dimensions)
                    variable.units = "degrees"
                    variable[:] = values
            file.createVariable("grid_imask", "i4", ("grid_size",))[:] = mask
        for method in ("conservative", "nearest", "linear", "bilinear", "sibson"):
            for options in ((), ("--extrapolate", "nearest")):
                self.regrid("in.nc", "target.nc", "-o", "out.nc", "--value", "t", "--method", method, *options)
                with netCDF4.Dataset(self.folder / "out.nc") as out:
                    found = np.isfinite(out["t"][:].filled(np.nan))
                np.testing.assert_array_equal(found, np.broadcast_to(mask, found.shape), method)

    def test_statistics_are_not_extrapolated(self):
        self.write("in.nc", "NETCDF3_64BIT_OFFSET", False)
        self.regrid("in.nc", "grid:12x6", "--statistics", "mean", "--extrapolate", "nearest", "-o", "out.nc", status=2)

    def test_what_is_known_of_the_fields_is_kept(self):
        self.write("in.nc", "NETCDF4", True)
        said = self.regrid("in.nc", "healpix:2", "-o", "out.nc")
        self.assertEqual(said.stderr, "")
        with netCDF4.Dataset(self.folder / "out.nc") as out:
            self.assertEqual(out["t"].cell_methods, "time: mean area: mean")
            self.assertEqual(out["t"].units, "K")
            self.assertNotIn("scale_factor", out["t"].ncattrs())
            self.assertEqual(out["time"].bounds, "time_bnds")
            self.assertEqual(out["time"].calendar, "standard")
            np.testing.assert_array_equal(out["time_bnds"][:], np.arange(8).reshape(4, 2))
            np.testing.assert_array_equal(out["level"][:], [850, 500])
            self.assertEqual(out["crs"].grid_mapping_name, "healpix")
            self.assertEqual((out["crs"].refinement_level, out["crs"].healpix_nside), (2, 4))
            self.assertEqual(out["t"].grid_mapping, "crs")
            self.assertEqual(out["t"].dimensions, ("time", "level", "cell"))
            self.assertEqual(out.title, "made")
            self.assertEqual(out.history, "rondel regrid in.nc healpix:2\nyesterday: made")

    def test_pixels_are_known_by_their_file(self):
        self.write("in.nc", "NETCDF4", False)
        for grid in ("healpix:3", "healpix:2:ring"):
            self.regrid("in.nc", grid, "-o", "pixels.nc")
            self.regrid("pixels.nc", "grid:30", "-o", "known.nc")
            self.regrid("pixels.nc", "grid:30", "-o", "said.nc", "--source", grid)
            with netCDF4.Dataset(self.folder / "known.nc") as known, netCDF4.Dataset(self.folder / "said.nc") as said:
                np.testing.assert_array_equal(known["t"][:], said["t"][:])
            # As tools for HEALPix wrote it before CF had it.
            with netCDF4.Dataset(self.folder / "pixels.nc", "a") as file:
                file["crs"].delncattr("refinement_level")
                file["crs"].delncattr("indexing_scheme")
            self.regrid("pixels.nc", "grid:30", "-o", "before.nc")
            with netCDF4.Dataset(self.folder / "before.nc") as before, netCDF4.Dataset(self.folder / "said.nc") as said:
                np.testing.assert_array_equal(before["t"][:], said["t"][:])

    def test_tiles_have_the_same_bytes(self):
        self.write("in.nc", "NETCDF3_64BIT_OFFSET", False)
        for target in ("healpix:3", "grid:7.5", "O8"):
            self.regrid("in.nc", target, "-o", "whole.nc", "--json")
            for options in (("--tile", "200"), ("--tile", "900", "--memory", "1M", "--threads", "1")):
                said = self.regrid("in.nc", target, "-o", "tiles.nc", "--json", *options)
                self.assertGreater(json.loads(said.stdout)["tiles"], 2)
                self.assertEqual((self.folder / "tiles.nc").read_bytes(), (self.folder / "whole.nc").read_bytes())

    def test_tiles_are_extrapolated_as_whole_fields_are(self):
        self.write("in.nc", "NETCDF3_64BIT_OFFSET", False)
        for how in ("nearest", "creep"):
            common = ("in.nc", "grid:7.5", "--value", "sst", "--extrapolate", how, "--json")
            whole = json.loads(self.regrid(*common, "-o", "whole.nc").stdout)
            tiles = json.loads(self.regrid(*common, "-o", "tiles.nc", "--tile", "200").stdout)
            self.assertEqual((whole["tiles"], whole["missing"]), (0, 0))
            self.assertGreater(tiles["tiles"], 2)
            self.assertEqual(tiles["extrapolated"], whole["extrapolated"])
            self.assertEqual((self.folder / "tiles.nc").read_bytes(), (self.folder / "whole.nc").read_bytes())

    def lines_of(self, *arguments, **options):
        """What is written to standard error, line by line, without the tool's name."""
        return [line.removeprefix("rondel: ") for line in self.regrid(*arguments, **options).stderr.splitlines()]

    def write_elsewhere(self, names, **dimensions):
        """Adds variables along other dimensions to a file of cells: {name: (dimensions, attributes)}."""
        with netCDF4.Dataset(self.folder / "elsewhere.nc", "w", format="NETCDF3_CLASSIC") as file:
            for dimension, size in {"lat": 18, "lon": 36, "time": 2, **dimensions}.items():
                file.createDimension(dimension, size)
            for axis, values, units in (("lat", np.arange(-85.0, 90, 10), "north"), ("lon", np.arange(5.0, 360, 10), "east")):
                variable = file.createVariable(axis, "f8", (axis,))
                variable.units = f"degrees_{units}"
                variable[:] = values
            file.createVariable("t", "f8", ("time", "lat", "lon"))[:] = 1.0
            for name, (own, attributes) in names.items():
                variable = file.createVariable(name, "f8", own)
                variable.setncatts(attributes)
                variable[:] = 7.0

    def test_what_is_at_other_places_is_left_out_and_told(self):
        away = {
            "zm": (("time", "lat"), {}),
            "of_edges": (("nEdges",), {}),
            "of_vertices": (("time", "nVertices"), {}),
            "u": (("eta_u", "xi_u"), {}),
            "w": (("south_north_stag",), {}),
            "said": (("parts",), {"mesh": "m", "location": "edge"}),
        }
        kept = {"series": (("time",), {}), "time_bnds": (("time", "bnds"), {}), "height": ((), {"units": "m"}), "bands": (("band",), {})}
        sizes = {"nEdges": 7, "nVertices": 5, "eta_u": 4, "xi_u": 3, "south_north_stag": 6, "parts": 9, "bnds": 2, "band": 8}
        self.write_elsewhere({**away, **kept}, **sizes)
        said = self.lines_of("elsewhere.nc", "grid:30", "-o", "out.nc")
        self.assertEqual(
            said,
            [
                "elsewhere.nc: left out, as they have no values at the points: zm, of_edges, of_vertices, u, w and 1 more",
                "elsewhere.nc: copied, as nothing says that their dimensions count places: bands (band)",
            ],
        )
        with netCDF4.Dataset(self.folder / "out.nc") as out:
            self.assertEqual(set(out.variables), {"t", "lat", "lon", *kept})

    def test_edges_of_ugrid_without_places_are_left_out(self):
        """A square of four nodes; one face, with a value on it, and values on its edges."""
        with netCDF4.Dataset(self.folder / "mesh.nc", "w", format="NETCDF3_CLASSIC") as file:
            for dimension, size in (("p", 4), ("s", 4), ("f", 1), ("two", 2), ("most", 4)):
                file.createDimension(dimension, size)
            mesh = file.createVariable("mesh", "i4", ())
            mesh.setncatts({"cf_role": "mesh_topology", "topology_dimension": np.int32(2), "node_coordinates": "px py"})
            mesh.setncatts({"face_node_connectivity": "faces", "edge_node_connectivity": "ends"})
            for name, units, values in (("px", "degrees_east", (0, 40, 40, 0)), ("py", "degrees_north", (0, 0, 40, 40))):
                variable = file.createVariable(name, "f8", ("p",))
                variable.units = units
                variable[:] = values
            file.createVariable("faces", "i4", ("f", "most"))[:] = [[0, 1, 2, 3]]
            file.createVariable("ends", "i4", ("s", "two"))[:] = [[0, 1], [1, 2], [2, 3], [3, 0]]
            for name, place, dimension in (("of_face", "face", "f"), ("of_edges", "edge", "s"), ("of_nodes", "node", "p")):
                variable = file.createVariable(name, "f8", (dimension,))
                variable.setncatts({"mesh": "mesh", "location": place})
                variable[:] = 5.0
        said = self.lines_of("mesh.nc", "grid:10", "-o", "out.nc")
        self.assertEqual(len(said), 1)
        self.assertIn("of_edges", said[0])
        self.assertIn("of_nodes", said[0])
        with netCDF4.Dataset(self.folder / "out.nc") as out:
            self.assertEqual(set(out.variables), {"lat", "lon", "of_face"})
            self.assertEqual(out["of_face"][:].count(), 16)
        # The face has no place of its own: it is at its center of mass.
        for method in ("nearest", "linear"):
            self.regrid("mesh.nc:of_face", "grid:20", "--method", method, "-o", "out.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                self.assertEqual(out["of_face"][:].count() > 0, method == "nearest")

    def test_scalars_stay_coordinates(self):
        self.write_elsewhere({"height": ((), {"units": "m"})})
        with netCDF4.Dataset(self.folder / "elsewhere.nc", "a") as file:
            file["t"].coordinates = "height"
        for target, wanted in (("grid:30", "height"), ("healpix:1", "lon lat height")):
            for options in ((), ("--value", "t"), ("--statistics", "mean")):
                self.regrid("elsewhere.nc", target, "-o", "out.nc", *options)
                with netCDF4.Dataset(self.folder / "out.nc") as out:
                    name = "t_mean" if "--statistics" in options else "t"
                    self.assertEqual(out[name].coordinates, wanted)
                    self.assertEqual(float(out["height"][...]), 7)

    def test_grids_are_known_by_their_file(self):
        self.write("in.nc", "NETCDF3_64BIT_OFFSET", False)
        for grid in ("O8", "N32", "C4", "R2B1", "F4", "hexagons:R2B1", "tripolar:15"):
            self.regrid("in.nc", grid, "-o", "made.nc")
            self.regrid("made.nc", "grid:30", "-o", "known.nc")
            self.regrid("made.nc", "grid:30", "-o", "said.nc", "--source", grid)
            with netCDF4.Dataset(self.folder / "known.nc") as known, netCDF4.Dataset(self.folder / "said.nc") as said:
                np.testing.assert_array_equal(known["t"][:], said["t"][:])
                self.assertNotIn("rondel_grid", known.ncattrs())

    def test_a_missing_value_hides_none_at_its_place(self):
        """Each place of a curvilinear grid twice: first without a value, then with one."""
        lon, lat = np.meshgrid(np.arange(0.0, 40, 5), np.arange(-20.0, 21, 5))
        values = np.stack([lon + lat, np.where(lon > 20, np.nan, lon + lat)])
        with netCDF4.Dataset(self.folder / "twice.nc", "w", format="NETCDF3_CLASSIC") as file:
            for dimension, size in (("time", 2), ("y", 9), ("x", 16)):
                file.createDimension(dimension, size)
            for name, units, places in (("lon", "degrees_east", lon), ("lat", "degrees_north", lat)):
                variable = file.createVariable(name, "f8", ("y", "x"))
                variable.units = units
                variable[:] = np.concatenate([places, places], axis=1)
            field = file.createVariable("t", "f8", ("time", "y", "x"), fill_value=-9)
            field.coordinates = "lon lat"
            field[:] = np.ma.masked_invalid(np.concatenate([np.full_like(values, np.nan), values], axis=2))
        for method in ("nearest", "linear", "sibson"):
            for options in ((), ("--tile", "20")):
                said = self.lines_of("twice.nc", "twice.nc", "--method", method, "-o", "out.nc", *options)
                text = "twice.nc: 72 of 144 places are those of others before them; at each place the first value that is there counts"
                self.assertIn(text, said)
                with netCDF4.Dataset(self.folder / "out.nc") as out:
                    found = out["t"][:].filled(np.nan)[..., :8]
                np.testing.assert_array_equal(np.isnan(found), np.isnan(values), method)
                np.testing.assert_allclose(found, values, atol=1e-9)

    def test_what_is_refused_names_the_way_out(self):
        lon, lat = np.meshgrid(np.arange(0.0, 40, 5), np.arange(-20.0, 21, 5))
        with netCDF4.Dataset(self.folder / "curved.nc", "w", format="NETCDF3_CLASSIC") as file:
            for dimension, size in (("y", 9), ("x", 8)):
                file.createDimension(dimension, size)
            for name, units, places in (("lon", "degrees_east", lon + lat / 10), ("lat", "degrees_north", lat)):
                variable = file.createVariable(name, "f8", ("y", "x"))
                variable.units = units
                variable[:] = places
            for name in ("t", "s"):
                variable = file.createVariable(name, "f8", ("y", "x"))
                variable.coordinates = "lon lat"
                variable[:] = lon
            file["s"][2, 2] = np.inf
        for arguments, wanted in (
            (("grid:5",), "--corners made"),
            (("grid:5", "--method", "native"), "linear takes any places"),
            (("grid:5", "--method", "linear"), 'variable "s": value inf at point 18 is not finite; --value NAME'),
            (("grid:2x7", "--corners", "made", "--sides", "great-circles"), "grid:2x7: cell 0 is 180 degrees wide"),
        ):
            said = self.lines_of("curved.nc", *arguments, "-o", "out.nc", status=1)
            self.assertIn(wanted, said[-1])
            self.assertFalse((self.folder / "out.nc").exists())

    def test_axes_without_two_numbers_are_named_with_them(self):
        for name, lon, lat in (("onelat", [0.0, 90, 180], [47.5]), ("onelon", [7.0], [-45.0, 45]), ("nolat", [0.0, 90], [])):
            with netCDF4.Dataset(self.folder / (name + ".nc"), "w", format="NETCDF4") as file:
                for axis, values, units in (("lat", lat, "degrees_north"), ("lon", lon, "degrees_east")):
                    file.createDimension(axis, len(values) or None)
                    variable = file.createVariable(axis, "f8", (axis,))
                    variable.units = units
                    variable[:] = values
                file.createVariable("t", "f8", ("lat", "lon"))[:] = np.zeros((len(lat), len(lon)))
        rule = "must be an axis: two numbers or more, increasing or decreasing; "
        for name, method, wanted in (
            ("onelat", "bilinear", "lat " + rule + "lat[0] is 47.5 alone"),
            ("onelon", "bilinear", "lon " + rule + "lon[0] is 7 alone"),
            ("onelat", "conservative", 'variable "lat": one latitude without bounds, 47.5, has no width'),
            ("nolat", "conservative", 'variable "lat": there are no latitudes'),
        ):
            said = self.lines_of(name + ".nc", "grid:5", "--method", method, "-o", "out.nc", status=1)
            self.assertEqual(said, [name + ".nc: " + wanted])

    def test_repeated_columns_hide_nothing(self):
        lon, lat = np.arange(0.0, 361, 30), np.arange(-60.0, 61, 30)
        values = np.where(lon == 0, np.nan, np.where(lon == 360, 0, lon)) + lat[:, None]
        for order in (slice(None), slice(None, None, -1)):
            with netCDF4.Dataset(self.folder / "cyclic.nc", "w", format="NETCDF3_CLASSIC") as file:
                for name, units, axis in (("lat", "degrees_north", lat), ("lon", "degrees_east", lon[order])):
                    file.createDimension(name, len(axis))
                    variable = file.createVariable(name, "f8", (name,))
                    variable.units = units
                    variable[:] = axis
                file.createVariable("t", "f8", ("lat", "lon"), fill_value=-9)[:] = np.ma.masked_invalid(values[:, order])
            for method in ("bilinear", "nearest", "linear"):
                self.regrid("cyclic.nc", "grid:12x6", "--method", method, "-o", "out.nc")
                with netCDF4.Dataset(self.folder / "out.nc") as out:
                    self.assertEqual(np.ma.count_masked(out["t"][1:5]), 0, method)

    def test_nothing_is_left_of_what_fails(self):
        self.write("in.nc", "NETCDF3_64BIT_OFFSET", False)
        data = (self.folder / "in.nc").read_bytes()
        (self.folder / "cut.nc").write_bytes(data[: len(data) // 2])
        before = sorted(path.name for path in self.folder.iterdir())
        for arguments in (("cut.nc", "grid:12x6"), ("in.nc", "healpix:99"), ("in.nc", "missing.nc")):
            done = self.regrid(*arguments, "-o", "out.nc", status=1)
            self.assertEqual(len(done.stderr.splitlines()), 1)
            self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)


if __name__ == "__main__":
    unittest.main()
