#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What `rondel regrid` carries beside plain fields: texts, dimensions that may grow, vectors, faces without
places; and grids that files name, in other commands.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import subprocess
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import TOOL, ToolInFolder, add

LON, LAT = np.arange(0.0, 360, 10) + 5, np.arange(-90.0, 90, 10) + 5


def new(path, kind="NETCDF3_CLASSIC", times=None):
    """A file with the axes of a grid and a time that may grow."""
    file = netCDF4.Dataset(path, "w", format=kind)
    file.createDimension("time", times)
    for name, units, values in (("lat", "degrees_north", LAT), ("lon", "degrees_east", LON)):
        file.createDimension(name, len(values))
        add(file, name, (name,), values, units=units)
    return file


def frame(lon, lat):
    """The unit vectors to the east and to the north, and up."""
    lon, lat = np.radians(lon), np.radians(lat)
    east = np.stack([-np.sin(lon), np.cos(lon), np.zeros_like(lon)], -1)
    north = np.stack([-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)], -1)
    return east, north, np.cross(east, north)


class Carried(ToolInFolder):
    def test_texts_that_are_not_of_places_are_carried(self):
        for kind in ("NETCDF3_CLASSIC", "NETCDF4"):
            with new(self.folder / "in.nc", kind) as file:
                for name, size in (("length", 19), ("region", 2), ("word", 5)):
                    file.createDimension(name, size)
                times = np.array([list(f"2020-01-{day:02}_06:00:00") for day in (1, 2, 3)], "S1")
                add(file, "Times", ("time", "length"), times, "S1", description="times as texts")
                add(file, "word", ("word",), np.array(list("hello"), "S1"), "S1")
                add(file, "place", ("lat", "lon", "word"), np.full((18, 36, 5), b"a"), "S1")
                add(file, "t", ("time", "lat", "lon"), np.random.default_rng(1).normal(size=(3, 18, 36)))
                add(file, "r", ("region", "lat", "lon"), 1.0)
                if kind == "NETCDF4":
                    add(file, "region", ("region",), np.array(["Zürich", "x"], object), str)
                    add(file, "model", (), "a model", str)
            for end in ("nc", "nc4"):
                out = f"out.{end}"
                self.assertEqual(
                    self.run_tool("regrid", "in.nc", "grid:30", "-o", out),
                    ["in.nc: left out, as they are texts of places: place"],
                )
                with netCDF4.Dataset(self.folder / out) as found:
                    np.testing.assert_array_equal(found["Times"][:], times)
                    self.assertEqual(found["Times"].dimensions, ("time", "length"))
                    self.assertEqual(found["Times"].description, "times as texts")
                    self.assertEqual(b"".join(found["word"][:]), b"hello")
                    self.assertNotIn("place", found.variables)
                    if kind == "NETCDF4":
                        self.assertEqual(list(found["region"][:]), ["Zürich", "x"])
                        self.assertEqual(str(found["model"][...]), "a model")
            self.run_tool("regrid", "in.nc", "grid:30", "--value", "t", "-o", "out.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as found:
                np.testing.assert_array_equal(found["Times"][:], times)
                self.assertNotIn("word", found.variables)
            said = self.run_tool("regrid", "in.nc", "grid:30", "--value", "Times", "-o", "x.nc", status=1)
            self.assertEqual(said, ['in.nc: variable "Times" is a text, and no field'])

    def test_dimensions_that_may_grow_still_may(self):
        values = np.random.default_rng(2).normal(size=(3, 2, 18, 36))
        for kind in ("NETCDF3_CLASSIC", "NETCDF4"):
            with new(self.folder / "in.nc", kind) as file:
                file.createDimension("level", 2)
                add(file, "time", ("time",), [1.0, 2, 4], units="days since 2000-01-01")
                add(file, "flag", ("time",), np.array([b"a", b"b", b"c"]), "S1")  # with padding
                add(file, "t", ("time", "level", "lat", "lon"), values, "f4")
                add(file, "turned", ("level", "lat", "lon", "time"), np.moveaxis(values, 0, -1)) if kind == "NETCDF4" else None
            with netCDF4.Dataset(self.folder / "in.nc") as file, netCDF4.Dataset(self.folder / "fixed.nc", "w") as fixed:
                for name, dimension in file.dimensions.items():
                    fixed.createDimension(name, len(dimension))
                for name, variable in file.variables.items():
                    add(fixed, name, variable.dimensions, variable[...], variable.dtype, **variable.__dict__)
            for end in ("nc", "nc4"):
                for arguments in ((), ("--tile", "300"), ("--value", "t")):
                    told = self.run_tool("regrid", "in.nc", "grid:30", *arguments, "-o", f"out.{end}")
                    self.run_tool("regrid", "fixed.nc", "grid:30", *arguments, "-o", f"fixed_out.{end}")
                    with netCDF4.Dataset(self.folder / f"out.{end}") as out, netCDF4.Dataset(self.folder / f"fixed_out.{end}") as fixed:
                        self.assertEqual(list(out.variables), list(fixed.variables))
                        for name in out.variables:
                            np.testing.assert_array_equal(out[name][...], fixed[name][...], name)
                        self.assertFalse(fixed.dimensions["time"].isunlimited())
                        # In a classic file records are the first dimension of all that have them.
                        is_classic = end == "nc" and "turned" in out.variables
                        self.assertEqual(out.dimensions["time"].isunlimited(), not is_classic)
                    why = "one dimension of records, in front of all others; netCDF-4 can"
                    remark = f"out.nc: no records can be appended along time, as classic netCDF has {why}"
                    self.assertEqual(told, [remark] if is_classic else [])
                with netCDF4.Dataset(self.folder / f"out.{end}", "a") as out:
                    out["t"][3] = 7
                    self.assertEqual(out["t"].shape[0], 4)
            self.run_tool("remap", "in.nc", "grid:30", "-o", "weights.nc")
            for command in (
                ("regrid", "in.nc", "grid:30"),
                ("regrid", "in.nc", "grid:30", "--statistics", "max"),
                ("interpolate", "in.nc", "--to", "grid:30", "--method", "nearest"),
                ("apply", "weights.nc", "in.nc"),
            ):
                for form in ("nc", "nc4"):
                    piped = subprocess.run(
                        [TOOL, *command, "-o", "-", "--format", form, "--quiet"],
                        cwd=self.folder,
                        capture_output=True,
                        check=True,
                    )
                    with netCDF4.Dataset("piped", memory=piped.stdout) as out:
                        self.assertEqual(out.dimensions["time"].isunlimited(), form == "nc4")
                    remark = "<stdout>: no records can be appended along time, as classic netCDF has no dimension of"
                    self.assertEqual(remark in piped.stderr.decode(), form == "nc")

    def write_rotation(self, path, axis, kind="f8"):
        """The wind of a solid rotation around an axis, with a missing value."""
        east, north, up = frame(*np.meshgrid(LON, LAT))
        wind = np.cross(axis, up)
        with new(path, times=2) as file:
            for name, to in (("u", east), ("v", north)):
                values = np.stack([(wind * to).sum(-1), 2 * (wind * to).sum(-1)])
                values[1, 3, 4] = np.nan if name == "v" else values[1, 3, 4]
                add(file, name, ("time", "lat", "lon"), values, kind)
            add(file, "t", ("time", "lat", "lon"), np.ones((2, 18, 36)))
        return np.meshgrid(LON, LAT)

    def test_vectors_are_carried_in_space(self):
        axis = np.array([0.3, -0.8, 0.2])
        self.write_rotation(self.folder / "in.nc", axis)
        east, north, _ = frame(*np.meshgrid(LON, LAT))
        with netCDF4.Dataset(self.folder / "in.nc") as file:
            u, v = (file[name][:].filled(np.nan) for name in "uv")
        space = u[..., None] * east + v[..., None] * north
        with new(self.folder / "xyz.nc", times=2) as file:
            for k, name in enumerate("xyz"):
                add(file, name, ("time", "lat", "lon"), space[..., k])
        for arguments in (
            ("grid:30",),
            ("grid:30", "--tile", "200"),
            ("O8", "--norm", "destarea"),
            ("O8", "--method", "conservative-2nd"),
            ("O8", "--method", "conservative-2nd", "--limiter", "bounds"),
            ("O8", "--method", "conservative-2nd", "--limiter", "slopes"),
            ("healpix:2", "--method", "bilinear"),
            ("healpix:2", "--method", "linear", "--tile", "50"),
            ("grid:30", "--extrapolate", "creep"),
        ):
            self.run_tool("regrid", "in.nc", *arguments, "--vector", "u,v", "-o", "out.nc")
            self.run_tool("regrid", "xyz.nc", *arguments, "-o", "wanted.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as out, netCDF4.Dataset(self.folder / "wanted.nc") as wanted:
                parts = np.stack([wanted[name][:].filled(np.nan) for name in "xyz"], -1)
                lon, lat = out["lon"][:], out["lat"][:]
                if out["u"].ndim == 3:
                    lon, lat = np.meshgrid(lon, lat)
                for name, to in zip("uv", frame(lon, lat)):
                    np.testing.assert_allclose(out[name][:].filled(np.nan), (parts * to).sum(-1), atol=1e-14)
                self.assertIn("t", out.variables)

    def test_gradients_end_at_coasts(self):
        """Values of a region among missing ones give what a file of the region alone gives."""
        lon, lat = np.meshgrid(LON, LAT)
        field = np.cos(np.radians(lat)) * np.cos(np.radians(lon)) + 0.1 * np.random.default_rng(3).normal(size=lon.shape)
        rows, columns = slice(4, 13), slice(5, 22)
        gaps = np.full((3, 18, 36), np.nan)
        gaps[0] = field
        gaps[1, rows, columns] = field[rows, columns]
        gaps[2, rows, columns] = 2 * field[rows, columns]
        with new(self.folder / "in.nc", times=3) as file:
            add(file, "t", ("time", "lat", "lon"), gaps)
        with netCDF4.Dataset(self.folder / "part.nc", "w") as file:
            for name, units, values in (("lat", "degrees_north", LAT[rows]), ("lon", "degrees_east", LON[columns])):
                file.createDimension(name, len(values))
                add(file, name, (name,), values, units=units)
            add(file, "t", ("lat", "lon"), field[rows, columns])
        for target in ("grid:15x7", "healpix:2"):
            for more in ((), ("--max-missing", "1"), ("--limiter", "bounds"), ("--limiter", "slopes")):
                options = (target, "--method", "conservative-2nd", *more)
                self.run_tool("regrid", "in.nc", *options, "-o", "out.nc")
                self.run_tool("regrid", "part.nc", *options, "-o", "wanted.nc")
                with netCDF4.Dataset(self.folder / "out.nc") as out, netCDF4.Dataset(self.folder / "wanted.nc") as wanted:
                    found, known = out["t"][:].filled(np.nan), wanted["t"][:].filled(np.nan)
                self.assertGreater(np.isfinite(known).sum(), 5)
                self.assertTrue(np.isfinite(found[0]).all())
                np.testing.assert_allclose(found[1], known, atol=1e-12)
                np.testing.assert_allclose(found[2], 2 * known, atol=1e-12)

    def test_winds_near_poles_are_not_turned(self):
        axis = np.array([1.0, 0.5, 0.0])
        self.write_rotation(self.folder / "in.nc", axis)
        self.run_tool("regrid", "in.nc", "grid:5", "--method", "linear", "--vector", "u,v", "-o", "out.nc")
        with netCDF4.Dataset(self.folder / "out.nc") as out:
            lon, lat = np.meshgrid(out["lon"][:], out["lat"][:])
            east, north, up = frame(lon, lat)
            wind = np.cross(axis, up)
            for name, to in (("u", east), ("v", north)):
                np.testing.assert_allclose(out[name][0], (wind * to).sum(-1), atol=0.02)

    def test_vectors_that_are_none_are_refused(self):
        self.write_rotation(self.folder / "in.nc", np.array([0, 0, 1.0]))
        for arguments, status, wanted in (
            (("--vector", "u"), 2, "--vector: 'u' is not EAST,NORTH (see rondel regrid --help)"),
            (("--vector", "u,w"), 1, 'in.nc: "w", a component of vectors, is none of the fields that are regridded'),
            (("--vector", "u,u"), 1, 'in.nc: "u" and "u" are no pair of vectors, as one of them is named twice'),
            (("--vector", "u,v", "--vector", "t,v"), 1, 'in.nc: "t" and "v" are no pair of vectors, as one of them is named twice'),
            (("--vector", "u,v", "--method", "largest-share"), 2, "--vector has no effect with --method largest-share"),
            (("--vector", "u,v", "--statistics", "mean"), 2, "--vector has no effect with --statistics"),
        ):
            self.assertEqual(self.run_tool("regrid", "in.nc", "grid:30", *arguments, "-o", "out.nc", status=status), [wanted])

    def test_vectors_of_groups_have_the_names_of_their_files(self):
        lon, lat = np.arange(5.0, 360, 10), np.arange(-85.0, 90, 10)
        with netCDF4.Dataset(self.folder / "in.nc", "w") as file:
            file.createDimension("lat", len(lat))
            file.createDimension("lon", len(lon))
            add(file, "lat", ("lat",), lat, units="degrees_north")
            add(file, "lon", ("lon",), lon, units="degrees_east")
            for place, names in (("WIND", "uv"), ("SEA", "v")):
                group = file.createGroup(place)
                for name in names:
                    add(group, name, ("lat", "lon"), np.cos(np.radians(lat))[:, None] + 0 * lon)
        for given in ("u,WIND/v", "WIND/u,WIND/v", "/WIND/u,/WIND/v", "WIND_u,WIND_v"):
            self.run_tool("regrid", "in.nc", "grid:30", "--vector", given, "-o", given.replace("/", "") + ".nc")
        with netCDF4.Dataset(self.folder / "WIND_u,WIND_v.nc") as wanted:
            for given in ("u,WINDv", "WINDu,WINDv"):
                with netCDF4.Dataset(self.folder / (given + ".nc")) as found:
                    for name in ("WIND_u", "WIND_v"):
                        np.testing.assert_array_equal(found[name][:], wanted[name][:])
        several = 'in.nc: several groups have a variable "v": "WIND/v", "SEA/v"'
        for arguments in (("in.nc", "grid:30", "--vector", "u,v"), ("in.nc:v", "grid:30"), ("in.nc", "grid:30", "--value", "v")):
            self.assertEqual(self.run_tool("regrid", *arguments, "-o", "out.nc", status=1), [several])

    def test_components_that_the_file_says_are_none_are_refused(self):
        self.write_rotation(self.folder / "in.nc", np.array([0, 0, 1.0]))
        with netCDF4.Dataset(self.folder / "in.nc", "a") as file:
            file["u"].standard_name, file["v"].standard_name = "eastward_wind", "northward_wind"
        said = self.run_tool("regrid", "in.nc", "grid:30", "--vector", "v,u", "-o", "out.nc", status=1)
        wanted = (
            'in.nc: "v" and "u" are no eastward and northward components: '
            "'v' has the standard_name 'northward_wind', which is no eastward component"
        )
        self.assertEqual(said, [wanted])
        self.run_tool("regrid", "in.nc", "grid:30", "--vector", "u,v", "-o", "out.nc")

    def write_quads(self, name, places):
        """A mesh of 4 by 3 faces without `face_coordinates`, with values at these places."""
        lon, lat = (each.ravel() for each in np.meshgrid(np.arange(0.0, 50, 10), np.arange(0.0, 40, 10)))
        faces = np.array([[r * 5 + c, r * 5 + c + 1, r * 5 + c + 6, r * 5 + c + 5] for r in range(3) for c in range(4)])
        edges = np.array(sorted({tuple(sorted((f[k - 1], f[k]))) for f in faces for k in range(4)}))
        with netCDF4.Dataset(self.folder / name, "w", format="NETCDF3_CLASSIC") as file:
            for dimension, size in (("node", 20), ("face", 12), ("edge", len(edges)), ("four", 4), ("two", 2)):
                file.createDimension(dimension, size)
            add(file, "mesh", (), 0, "i4", cf_role="mesh_topology", topology_dimension=2, node_coordinates="x y",
                face_node_connectivity="faces", edge_node_connectivity="edges")
            add(file, "x", ("node",), lon, units="degrees_east")
            add(file, "y", ("node",), lat, units="degrees_north")
            add(file, "faces", ("face", "four"), faces, "i4", start_index=0)
            add(file, "edges", ("edge", "two"), edges, "i4", start_index=0)
            for place in places:
                add(file, "of_" + place, (place,), np.arange(file.dimensions[place].size), mesh="mesh", location=place)

    def test_methods_between_places_take_faces_without_places(self):
        self.write_quads("mesh.nc", ("edge", "node", "face"))
        self.write_quads("bare.nc", ())
        self.write_quads("nodes.nc", ("node",))
        for method in ("nearest", "linear", "sibson", "native"):
            said = self.run_tool("regrid", "mesh.nc", "grid:5", "--method", method, "-o", "out.nc")
            self.assertEqual(said, ["mesh.nc: left out, as they have no values at the points: of_edge, of_node"])
            self.run_tool("regrid", "mesh.nc:of_face", "grid:5", "--method", method, "-o", "named.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as out, netCDF4.Dataset(self.folder / "named.nc") as named:
                np.testing.assert_array_equal(out["of_face"][:], named["of_face"][:])
        self.run_tool("regrid", "nodes.nc", "grid:5", "--method", "nearest", "-o", "out.nc")
        with new(self.folder / "in.nc", times=1) as file:
            add(file, "t", ("lat", "lon"), np.ones((18, 36)))
        for target, size in (("mesh.nc", 12), ("bare.nc", 12), ("bare.nc:mesh", 12), ("nodes.nc", 20)):
            self.run_tool("regrid", "in.nc", target, "--method", "linear", "-o", "out.nc")
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                self.assertEqual(out["t"].size, size, target)

    def test_other_commands_know_the_grid_that_a_file_names(self):
        with new(self.folder / "in.nc", times=1) as file:
            add(file, "t", ("lat", "lon"), np.ones((18, 36)))
        for grid in ("healpix:1", "healpix:2:ring", "O8", "N32", "C4", "R2B1", "hexagons:R2B1", "tripolar:15"):
            self.run_tool("regrid", "in.nc", grid, "-o", "pixels.nc")
            for sides in (("pixels.nc", "grid:30"), ("grid:30", "pixels.nc")):
                self.run_tool("remap", *sides, "-o", "w.nc", "--quiet")
                names = [grid if side == "pixels.nc" else side for side in sides]
                self.run_tool("remap", *names, "-o", "named.nc", "--quiet")
                with netCDF4.Dataset(self.folder / "w.nc") as found, netCDF4.Dataset(self.folder / "named.nc") as wanted:
                    for name in ("S", "col", "row"):
                        np.testing.assert_array_equal(found[name][:], wanted[name][:])
                self.assertEqual(self.run_tool("check-weights", "w.nc", "--source", sides[0], "--target", sides[1]), [])
            said = self.run_tool("mesh", "quality", "pixels.nc", status=1)
            self.assertIn("whose cells are no Voronoi cells", said[0])
        # Points of no grid: a name that would have cells is what the message asks for.
        with netCDF4.Dataset(self.folder / "points.nc", "w") as file:
            file.createDimension("cell", 5)
            for name, units in (("lon", "degrees_east"), ("lat", "degrees_north")):
                add(file, name, ("cell",), np.arange(5) * 7.0, units=units)
            add(file, "t", ("cell",), 1.0, coordinates="lon lat")
        for arguments in (("remap", "points.nc", "grid:30"), ("regrid", "in.nc", "points.nc"), ("regrid", "points.nc", "grid:30")):
            said = self.run_tool(*arguments, "-o", "x.nc", status=1)
            self.assertIn("points of a grid with a name, such as healpix:7 or O320", said[0])

    def test_lists_of_pixels_are_no_fields(self):
        pixels = np.array([5, 3, 1, 100, 77, 20])
        for name, texts in (("mapped.nc", {"grid_mapping": "crs"}), ("stated.nc", {})):
            with netCDF4.Dataset(self.folder / name, "w") as file:
                file.createDimension("cell", 6)
                add(file, "t", ("cell",), np.arange(6.0), **texts)
                add(file, "ipix", ("cell",), pixels, "i4", **({} if texts else {"standard_name": "healpix_index"}))
                mapping = {"grid_mapping_name": "healpix", "refinement_level": 2, "indexing_scheme": "nested"}
                if texts:
                    add(file, "crs", (), 0, "i4", **mapping)
        self.run_tool("interpolate", "mapped.nc", "--to", "grid:30", "--weights", "w.nc", "-o", "out.nc")
        for arguments in (
            ("interpolate", "mapped.nc", "--to", "grid:30"),
            ("regrid", "stated.nc", "grid:30", "--method", "nearest", "--source", "mapped.nc"),
            ("apply", "w.nc", "mapped.nc"),
            ("apply", "w.nc", "stated.nc"),
        ):
            self.assertEqual(self.run_tool(*arguments, "-o", "out.nc"), [])
            with netCDF4.Dataset(self.folder / "out.nc") as out:
                self.assertEqual(set(out.variables), {"lat", "lon", "t"}, arguments)
        with netCDF4.Dataset(self.folder / "mapped.nc", "a") as file:
            file["ipix"][:] = pixels[::-1]
        said = self.run_tool("apply", "w.nc", "mapped.nc", "-o", "out.nc", status=1)
        self.assertEqual(
            said, ['mapped.nc: variable "ipix" has the numbers of pixels that are at other places than the source']
        )

    def test_a_file_that_names_another_order_of_pixels_is_refused(self):
        with netCDF4.Dataset(self.folder / "ring.nc", "w", format="NETCDF3_CLASSIC") as file:
            file.createDimension("cell", 192)
            add(file, "t", ("cell",), np.arange(192.0), grid_mapping="crs")
            add(file, "crs", (), 0, "i4", grid_mapping_name="healpix", refinement_level=2, indexing_scheme="ring")
        self.run_tool("remap", "healpix:2", "grid:30", "-o", "w.nc")
        self.run_tool("remap", "healpix:2:ring", "grid:30", "-o", "ring_w.nc")
        why = "ring.nc: its attributes name the grid healpix:2:ring, whose places are others than those that are wanted"
        for arguments in (
            ("regrid", "ring.nc", "grid:30", "--source", "healpix:2"),
            ("regrid", "ring.nc", "grid:30", "--source", "healpix:2", "--method", "nearest"),
            ("apply", "w.nc", "ring.nc"),
        ):
            self.assertEqual(self.run_tool(*arguments, "-o", "out.nc", status=1), [why])
        for arguments in (("regrid", "ring.nc", "grid:30", "--source", "healpix:2:ring"), ("apply", "ring_w.nc", "ring.nc")):
            self.assertEqual(self.run_tool(*arguments, "-o", "out.nc"), [])

    def test_fields_may_be_named_like_coordinates(self):
        """What is written as a field is read as one, whatever its column is called; its values are those of any other."""
        names = "latitude longitude lat lon TLAT nav_lon lonVertex lat_bnds lon_bnds verticesOnCell indexToCellID grid_corner_lon".split()
        names += "grid_center_lon grid_imask connect1 coord elementConn glamt gphit a.lon a.lat time point crs axis_0 leaf_area_index".split()
        random = np.random.default_rng(3)
        sites = random.normal(size=(200, 3))
        sites /= np.linalg.norm(sites, axis=1, keepdims=True)
        values = random.normal(size=(len(names), 200))
        rows = np.column_stack([sites, *values])
        for header, path in ((names, "own.csv"), ([f"v{k}" for k in range(len(names))], "plain.csv")):
            np.savetxt(self.folder / path, rows, delimiter=",", comments="", header=",".join(["x", "y", "z", *header]))
        np.savetxt(self.folder / "places.csv", sites[:60] + 0.01, delimiter=",", comments="", header="x,y,z")
        for target, method in (("grid:30", "conservative"), ("healpix:2", "conservative"), ("places.csv", "nearest")):
            for path, header in (("own", names), ("plain", [f"v{k}" for k in range(len(names))])):
                wanted = [word for name in header for word in ("--value", name)]
                sides = ("--x", "x", "--y", "y", "--z", "z")
                self.run_tool("interpolate", f"{path}.csv", *sides, "--to", target, *wanted, "--method", "nearest", "-o", f"{path}.nc", "--quiet")
                self.run_tool("regrid", f"{path}.nc", "grid:20", "--method", method, "-o", f"{path}_again.nc", "--quiet")
            for end in ("", "_again"):
                with netCDF4.Dataset(self.folder / f"own{end}.nc") as own, netCDF4.Dataset(self.folder / f"plain{end}.nc") as plain:
                    fields = [name for name in own.variables if name not in ("lat", "lon")]
                    fields = [name for name in fields if "grid_mapping_name" not in own[name].ncattrs()]
                    self.assertEqual([name.rstrip("_") for name in fields], names)
                    for k, name in enumerate(fields):
                        np.testing.assert_array_equal(own[name][:], plain[f"v{k}"][:], name)
                    self.assertIn("latitude_", fields)
                    self.assertIn("leaf_area_index", fields)

    def test_fields_of_angles_are_fields(self):
        """Names that have "lat" or "lon" in them, and fields of coordinates where these are asked for."""
        with new(self.folder / "in.nc", times=1) as file:
            ones = np.ones((18, 36))
            for name, units in (("platform_zenith_angle", "degrees"), ("relative_azimuth", "degrees"), ("leaf_area_index", "1")):
                add(file, name, ("lat", "lon"), ones, units=units)
            add(file, "target_lat", ("lat", "lon"), 2 * ones, units="degrees_north", standard_name="latitude")
            add(file, "parent_cell_index", ("lat", "lon"), ones, "i4")
        self.run_tool("regrid", "in.nc", "grid:30", "-o", "out.nc", "--quiet")
        with netCDF4.Dataset(self.folder / "out.nc") as out:
            self.assertEqual(list(out.variables), ["lat", "lon", "platform_zenith_angle", "relative_azimuth", "leaf_area_index"])
        self.run_tool("regrid", "in.nc", "grid:30", "--value", "target_lat", "-o", "out.nc", "--quiet")
        self.run_tool("regrid", "out.nc", "grid:90", "-o", "again.nc", "--quiet")
        for path in ("out.nc", "again.nc"):
            with netCDF4.Dataset(self.folder / path) as out:
                self.assertEqual(out["target_lat_"].units, "degrees")
                self.assertNotIn("standard_name", out["target_lat_"].ncattrs())
                np.testing.assert_allclose(out["target_lat_"][:], 2, rtol=1e-14)

    def test_what_no_method_takes_is_said(self):
        with new(self.folder / "in.nc", times=1) as file:
            add(file, "t", ("lat", "lon"), np.ones((18, 36)))
            add(file, "mask", ("lat", "lon"), 0, "i4")
        ring = "[[0,0],[40,0],[40,40],[0,{}]]"
        feature = '{{"type":"Feature","properties":{{"n":1}},"geometry":{}}}'
        polygon = '{{"type":"Polygon","coordinates":[{}]}}'
        for name, last in (("closed", 0), ("open", 1)):
            features = [feature.format(polygon.format(ring.format(last))), feature.format("null")]
            (self.folder / f"{name}.geojson").write_text('{"type":"FeatureCollection","features":[' + ",\n".join(features) + "]}")
        for name in ("table.csv", "table.off"):
            (self.folder / name).write_text("lon,lat\n1,2\n")
        for target, method, wanted in (
            ("closed.geojson", "linear", "it has polygons, which are no places"),
            ("table.csv", "conservative", "points have no cells, which conservative methods"),
            ("table.off", "nearest", "neither the name of a grid, nor netCDF with places, nor points (.csv"),
            ("open.geojson", "conservative", "1: feature 0: a ring that is not closed, from 0 0 to 0 1; --invalid repair"),
        ):
            said = self.run_tool("regrid", "in.nc", target, "--method", method, "--value", "t", "-o", "x.csv", status=1)
            self.assertIn(f"{target}:", said[0])
            self.assertIn(wanted, said[0])
        said = self.run_tool("regrid", "in.nc", "grid:30", "--sides", "great-circles", "--method", "nearest", "-o", "x.nc", status=2)
        self.assertEqual(said, ["--sides has no effect with a method between places"])
        # A variable of this name is a field, and masks nothing.
        said = self.run_tool("regrid", "in.nc", "closed.geojson", "-o", "means.csv")
        self.assertEqual(said, ['in.nc: the variable "mask" is a field as others, and masks nothing'])
        with new(self.folder / "to.nc", times=1) as file:
            add(file, "mask", ("lat", "lon"), 0, "i4")
            add(file, "crs", (), 0, "i4")
        said = self.run_tool("regrid", "in.nc", "to.nc", "--value", "t", "-o", "to_out.nc")
        self.assertEqual(said, ['to.nc: the variable "mask" masks nothing'])
        rows = (self.folder / "means.csv").read_text().splitlines()
        self.assertEqual(rows[0], "lon,lat,n,t,mask")
        np.testing.assert_allclose([float(cell) for cell in rows[1].split(",")[2:]], [1, 1, 0], rtol=1e-15)
        # A row without a place can be read again.
        self.assertEqual(rows[2], ",,1,,")
        said = self.run_tool("info", "means.csv")
        self.assertEqual(said, ["means.csv: left out 1 row without a place; sites are numbered without it"])


if __name__ == "__main__":
    unittest.main()
