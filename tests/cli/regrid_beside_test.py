#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What stands beside the fields in the output of `rondel regrid`: the bounds of the target's cells, coordinates of
series, and attributes that name variables; and what is no field there.

Without netCDF4-python ctest says "Skipped".
"""

import importlib.util
import sys
import unittest

if importlib.util.find_spec("netCDF4") is None:
    sys.exit(77)
import netCDF4
import numpy as np
from tool_in_folder import ToolInFolder, add

LON, LAT = np.arange(0.0, 360, 10) + 5, np.arange(-90.0, 90, 10) + 5
UNITS = {"lat": "degrees_north", "lon": "degrees_east"}


def write(path, lat=LAT, lon=LON, **sizes):
    """A file with axes, and further dimensions."""
    file = netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC")
    for name, values in (("lat", lat), ("lon", lon)):
        file.createDimension(name, len(values))
        add(file, name, (name,), values, units=UNITS[name])
    for name, size in sizes.items():
        file.createDimension(name, size)
    return file


def overlaps(edges, others):
    """The lengths that the pieces between edges share with those between others."""
    low = np.maximum(edges[:-1, None], others[None, :-1])
    return np.clip(np.minimum(edges[1:, None], others[None, 1:]) - low, 0, None)


def on_sphere(lon, lat):
    lon, lat = np.radians(lon), np.radians(lat)
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], -1)


# Quadrangles of five rows of nodes and six columns, in a part of the sphere where no side is on an axis.
NODE_LON, NODE_LAT = np.meshgrid(np.arange(6) * 11.0 + 160, np.arange(5) * 9.0 - 11)
NODE_LON, NODE_LAT = NODE_LON + 0.2 * NODE_LAT, NODE_LAT + 0.05 * (NODE_LON - 160)
CORNERS = np.stack([np.stack([each[:-1, :-1], each[:-1, 1:], each[1:, 1:], each[1:, :-1]], -1) for each in (NODE_LON, NODE_LAT)], -1)


def write_curvilinear(file, missing=()):
    corners = CORNERS.copy()
    corners[missing or (slice(0),)] = np.nan
    for name, size in (("j", 4), ("i", 5), ("corner", 4)):
        file.createDimension(name, size)
    for k, name in enumerate(("lon", "lat")):
        add(file, name, ("j", "i"), CORNERS[..., k].mean(-1), units=UNITS[name], bounds=f"{name}_edges")
        add(file, f"{name}_edges", ("j", "i", "corner"), corners[..., k])


def write_ugrid(file):
    numbers = np.arange(30).reshape(5, 6)
    faces = np.stack([numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]], -1).reshape(-1, 4)
    for name, size in (("node", 30), ("face", 20), ("four", 4)):
        file.createDimension(name, size)
    add(file, "mesh", (), 0, "i4", cf_role="mesh_topology", topology_dimension=2, node_coordinates="x y", face_node_connectivity="faces")
    add(file, "x", ("node",), NODE_LON.ravel(), units="degrees_east")
    add(file, "y", ("node",), NODE_LAT.ravel(), units="degrees_north")
    add(file, "faces", ("face", "four"), faces, "i4", start_index=0)


def write_scrip(file):
    for name, size in (("grid_size", 20), ("grid_corners", 4), ("grid_rank", 1)):
        file.createDimension(name, size)
    add(file, "grid_dims", ("grid_rank",), 20, "i4")
    for k, name in enumerate(("lon", "lat")):
        add(file, f"grid_center_{name}", ("grid_size",), CORNERS[..., k].mean(-1).ravel(), units="degrees")
        add(file, f"grid_corner_{name}", ("grid_size", "grid_corners"), CORNERS[..., k].reshape(20, 4), units="degrees")
    add(file, "grid_imask", ("grid_size",), 1, "i4")


class Beside(ToolInFolder):
    def read(self, path):
        file = netCDF4.Dataset(self.folder / path)
        self.addCleanup(file.close)
        file.set_auto_mask(False)
        return file

    def test_bounds_of_axes_are_those_of_the_target(self):
        """Rows of unequal widths, from the north, and a longitude whose cells begin before 0; the means of a second
        regridding are by areas between parallels.
        """
        field = np.random.default_rng(1).normal(size=(18, 36))
        with write(self.folder / "in.nc") as file:
            add(file, "t", ("lat", "lon"), field)
        lat_edges, lon_edges = np.array([90.0, 61, 45, -20, -90]), np.array([-30.0, 50, 110, 330])
        centers = np.array([80.0, 50, 10, -60]), np.array([0.0, 100, 200])
        pairs = {"lat": np.stack([lat_edges[:-1], lat_edges[1:]], -1), "lon": np.stack([lon_edges[:-1], lon_edges[1:]], -1)}
        for bounded in (("lat", "lon"), ("lat",), ()):
            with write(self.folder / "target.nc", *centers, side=2) as file:
                for name in bounded:
                    file[name].bounds = f"{name}_sides"
                    add(file, f"{name}_sides", (name, "side"), pairs[name])
            for method in ("conservative", "nearest"):
                self.run_tool("regrid", "in.nc", "target.nc", "--method", method, "-o", "out.nc")
                out = self.read("out.nc")
                for name in ("lat", "lon"):
                    self.assertEqual(getattr(out[name], "bounds", ""), f"{name}_bnds" if name in bounded else "")
                    if name in bounded:
                        np.testing.assert_array_equal(out[f"{name}_bnds"][:], pairs[name])
            if len(bounded) < 2:
                continue
            self.run_tool("regrid", "in.nc", "target.nc", "-o", "out.nc")
            self.run_tool("regrid", "out.nc", "grid:4x3", "-o", "back.nc")
            # Longitudes of the last column continue beyond a turn.
            sines, turns = (np.sin(np.radians(each)) for each in (lat_edges[::-1], np.linspace(-90, 90, 4))), np.linspace(-180, 180, 5)
            rows = overlaps(*list(sines)[::-1])[:, ::-1]
            columns = sum(overlaps(turns, lon_edges + turn) for turn in (-360, 0))
            values = self.read("out.nc")["t"][:]
            means = rows @ values @ columns.T / np.outer(rows.sum(1), columns.sum(1))
            np.testing.assert_allclose(self.read("back.nc")["t"][:], means, atol=1e-12)

    def test_bounds_of_meshes_are_the_corners_of_the_target(self):
        with write(self.folder / "in.nc") as file:
            add(file, "t", ("lat", "lon"), np.random.default_rng(2).normal(size=(18, 36)))
        for content in (write_curvilinear, write_ugrid, write_scrip):
            with netCDF4.Dataset(self.folder / "mesh.nc", "w", format="NETCDF3_CLASSIC") as file:
                content(file)
            dimensions = ("y", "x") if content is write_curvilinear else ("cell",)
            for method in ("conservative", "linear"):
                self.run_tool("regrid", "in.nc", "mesh.nc", "--method", method, "-o", "out.nc")
                out = self.read("out.nc")
                self.assertEqual(out["lat"].bounds, "lat_bnds", content)
                self.assertEqual(out["lon_bnds"].dimensions, (*dimensions, "nv"))
                lon, lat = (out[f"{name}_bnds"][:].reshape(20, -1) for name in ("lon", "lat"))
                self.assertTrue((abs(lon - out["lon"][:].reshape(20, 1)) <= 180).all())
                away = np.linalg.norm(on_sphere(lon, lat)[:, :, None] - on_sphere(*CORNERS.reshape(20, 1, 4, 2).transpose(3, 0, 1, 2)), axis=-1)
                self.assertLess(away.min(1).max(), 1e-14)
                self.assertLess(away.min(2).max(), 1e-14)
                # The same cells as those of the mesh itself.
                self.run_tool("regrid", "out.nc", "grid:6", "-o", "back.nc")
                self.run_tool("regrid", "out.nc", "grid:6", "--source", "mesh.nc", "-o", "wanted.nc")
                found, wanted = (self.read(path)["t"][:] for path in ("back.nc", "wanted.nc"))
                self.assertGreater(np.isfinite(wanted).sum(), 10)
                np.testing.assert_allclose(found, wanted, atol=1e-12)

    def test_other_commands_say_which_cells_there_are(self):
        """By bounds as regrid has them, or by the name of the grid."""
        with write(self.folder / "in.nc") as file:
            add(file, "t", ("lat", "lon"), np.random.default_rng(2).normal(size=(18, 36)))
        with write(self.folder / "axes.nc", np.array([-40.0, 0, 10]), np.array([5.0, 20]), side=2) as file:
            for name, sides in (("lat", [(-60, -20), (-20, 5), (5, 30)]), ("lon", [(0, 10), (10, 30)])):
                file[name].bounds = f"{name}_sides"
                add(file, f"{name}_sides", (name, "side"), sides)
        for content in (write_curvilinear, write_ugrid, write_scrip):
            with netCDF4.Dataset(self.folder / f"{content.__name__}.nc", "w", format="NETCDF3_CLASSIC") as file:
                content(file)
        for target in ("axes.nc", "write_curvilinear.nc", "write_ugrid.nc", "write_scrip.nc"):
            self.run_tool("regrid", "in.nc", target, "-o", "wanted.nc")
            self.run_tool("interpolate", "in.nc", "--to", target, "--weights", "w.nc", "-o", "found.nc")
            self.run_tool("remap", "in.nc", target, "-o", "means.nc")
            self.run_tool("apply", "means.nc", "in.nc", "-o", "applied.nc")
            self.assertFalse(np.isnan(self.read("w.nc")["xc_b"][:]).any())
            wanted = self.read("wanted.nc")
            for path in ("found.nc", "applied.nc"):
                found = self.read(path)
                if path == "applied.nc" and target == "axes.nc":
                    continue  # the weights have corners of cells, and no lines
                for name in ("lat", "lon"):
                    self.assertEqual(found[name].bounds, f"{name}_bnds")
                    np.testing.assert_allclose(found[f"{name}_bnds"][:], wanted[f"{name}_bnds"][:], atol=1e-12)
            np.testing.assert_allclose(self.read("applied.nc")["t"][:], wanted["t"][:], atol=1e-12)
        for grid in ("O8", "healpix:1", "C4"):
            self.run_tool("interpolate", "in.nc", "--to", grid, "--method", "nearest", "-o", "found.nc")
            self.run_tool("regrid", "in.nc", grid, "--method", "nearest", "-o", "wanted.nc")
            for path in ("found.nc", "wanted.nc"):
                self.run_tool("regrid", path, "grid:30", "-o", f"again_{path}")
            found, wanted = (self.read(f"again_{path}")["t"][:] for path in ("found.nc", "wanted.nc"))
            np.testing.assert_array_equal(found, wanted)
            # A file that names its grid is a target as the grid is; one with some of its pixels has bounds.
            self.run_tool("interpolate", "in.nc", "--to", "wanted.nc", "--method", "nearest", "-o", "file.nc")
            self.assertEqual((self.folder / "file.nc").read_bytes(), (self.folder / "found.nc").read_bytes())
        file = self.read("found.nc")
        with netCDF4.Dataset(self.folder / "some.nc", "w") as some:
            some.rondel_grid = file.rondel_grid
            some.createDimension("n", 7)
            for name in ("lat", "lon"):
                add(some, name, ("n",), file[name][:].ravel()[3:24:3], units=UNITS[name])
            add(some, "v", ("n",), 1.0, coordinates="lat lon")
        self.run_tool("interpolate", "in.nc", "--to", "some.nc", "--method", "nearest", "-o", "found.nc")
        self.run_tool("regrid", "in.nc", "some.nc", "-o", "wanted.nc")
        found, wanted = (self.read(path)["lat_bnds"][:] for path in ("found.nc", "wanted.nc"))
        self.assertEqual(found.shape[0], 7)
        np.testing.assert_array_equal(found, wanted)

    def test_cells_without_corners_have_no_bounds(self):
        with write(self.folder / "in.nc") as file:
            add(file, "t", ("lat", "lon"), 1.0)
        with netCDF4.Dataset(self.folder / "mesh.nc", "w", format="NETCDF3_CLASSIC") as file:
            write_curvilinear(file, missing=(1, 2))
        self.run_tool("regrid", "in.nc", "mesh.nc", "-o", "out.nc")
        lon = self.read("out.nc")["lon_bnds"][:]
        self.assertTrue(np.isnan(lon[1, 2]).all())
        self.assertEqual(np.isnan(lon).sum(), 4)
        said = self.run_tool("regrid", "out.nc", "grid:6", "-o", "back.nc")
        self.assertEqual(len(said), 1)
        self.assertIn("corners", said[0])
        # Nodes of a mesh have no cells of their own.
        with netCDF4.Dataset(self.folder / "mesh.nc", "w", format="NETCDF3_CLASSIC") as file:
            write_ugrid(file)
        self.run_tool("regrid", "in.nc", "mesh.nc:x", "--method", "nearest", "-o", "out.nc")
        out = self.read("out.nc")
        self.assertEqual(out["t"].size, 30)
        self.assertNotIn("lon_bnds", out.variables)

    def test_series_keep_their_coordinates(self):
        with write(self.folder / "in.nc", time=3, plev=2, side=2, station=2) as file:
            add(file, "time", ("time",), [1, 2, 4], units="days since 2000-01-01", bounds="time_sides")
            add(file, "time_sides", ("time", "side"), [[0, 2], [1, 3], [3, 5]])
            add(file, "plev", ("plev",), [500, 850], units="Pa")
            add(file, "station", ("station",), [17, 19])
            add(file, "height", (), 2.0, units="m")
            add(file, "co2vmr", ("time",), [7, 8, 9], coordinates="height")
            add(file, "nudging", ("plev",), [3, 4])
            add(file, "of_station", ("time", "station"), np.arange(6).reshape(3, 2))
            add(file, "orog", ("lat", "lon"), 1.0)
        self.run_tool("regrid", "in.nc", "grid:30", "-o", "out.nc")
        before, after = self.read("in.nc"), self.read("out.nc")
        for name in ("time", "time_sides", "plev", "station", "height", "co2vmr", "nudging", "of_station"):
            np.testing.assert_array_equal(after[name][...], before[name][...], name)
            self.assertEqual(after[name].dimensions, before[name].dimensions)
        self.assertEqual(after["time"].bounds, "time_sides")
        self.assertEqual(after["co2vmr"].coordinates, "height")
        self.assertEqual(after["time"].units, "days since 2000-01-01")

    def test_attributes_name_what_is_written(self):
        terms = "a: a b: b p0: p0 ps: ps"
        for target, cell in (("grid:30", "cell"), ("healpix:1", "cell_")):
            with write(self.folder / "in.nc", lev=2, side=2, few=3) as file:
                add(file, "lev", ("lev",), [1.0, 2], formula_terms=terms, bounds="lev_sides", positive="down")
                add(file, "lev_sides", ("lev", "side"), [[0.5, 1.5], [1.5, 2.5]], formula_terms="a: a b: lost")
                for name in ("a", "b"):
                    add(file, name, ("lev",), [0.1, 0.2])
                add(file, "p0", (), 1e5)
                add(file, "few", ("few",), [0, 1, 3], "i4", compress="lev side")
                add(file, "gathered", ("few",), [5.0, 6, 7])
                add(file, "zonal", ("lat",), LAT)
                for name in ("ps", "cell", "height"):
                    add(file, name, ("lat", "lon"), 1.0)
                add(file, "ta", ("lev", "lat", "lon"), 1.0, ancillary_variables="cell zonal p0", coordinates="lon height lat",
                    cell_measures="area: ps_area", grid_mapping="crs")  # fmt: skip
            self.run_tool("regrid", "in.nc", target, "-o", "out.nc")
            out = self.read("out.nc")
            self.assertEqual(out["lev"].formula_terms, terms)
            self.assertEqual(out["lev"].bounds, "lev_sides")
            self.assertNotIn("formula_terms", out["lev_sides"].ncattrs())
            self.assertEqual(out["few"].compress, "lev side")
            np.testing.assert_array_equal(out["few"][:], [0, 1, 3])
            self.assertEqual(out["ta"].ancillary_variables, f"{cell} p0")
            self.assertEqual(out["ta"].coordinates, "height" if target == "grid:30" else "lon lat height")
            self.assertEqual(out[cell].dimensions, ("lat", "lon") if target == "grid:30" else ("cell",))
            self.assertFalse({"cell_measures", "grid_mapping"} & {*out["ta"].ncattrs()} - ({"grid_mapping"} if target != "grid:30" else set()))
        self.run_tool("regrid", "in.nc", "grid:30", "--value", "ta", "-o", "out.nc")
        out = self.read("out.nc")
        self.assertEqual(out["lev"].bounds, "lev_sides")
        self.assertEqual({"formula_terms", "ancillary_variables"} & {*out["lev"].ncattrs(), *out["ta"].ncattrs()}, set())

    def test_names_in_groups_become_those_of_the_output(self):
        with netCDF4.Dataset(self.folder / "in.nc", "w") as file:
            group = file.createGroup("model")
            for name, values in (("lat", LAT), ("lon", LON), ("lev", [1.0, 2])):
                group.createDimension(name, len(values))
                add(group, name, (name,), values, **({"units": UNITS[name]} if name in UNITS else {}))
            group["lev"].formula_terms = "b: b ps: /model/ps"
            add(group, "b", ("lev",), [0.1, 0.2])
            for name in ("ps", "error", "area_of_cells"):
                add(group, name, ("lat", "lon"), 1.0)
            add(group, "ta", ("lev", "lat", "lon"), 1.0, ancillary_variables="error", cell_measures="area: area_of_cells")
        said = self.run_tool("regrid", "in.nc", "grid:30", "-o", "out.nc")
        self.assertEqual(said, ["in.nc: left out, as they are areas or volumes of cells: model/area_of_cells"])
        out = self.read("out.nc")
        self.assertEqual(out["model_lev"].formula_terms, "b: model_b ps: model_ps")
        self.assertEqual(out["model_ta"].ancillary_variables, "model_error")

    def test_statistics_name_no_fields_that_are_not_there(self):
        with write(self.folder / "in.nc", lev=2) as file:
            add(file, "lev", ("lev",), [1.0, 2], formula_terms="b: b ps: ps")
            add(file, "b", ("lev",), [0.1, 0.2])
            add(file, "height", (), 2.0)
            for name in ("ps", "error"):
                add(file, name, ("lat", "lon"), 1.0)
            add(file, "ta", ("lev", "lat", "lon"), 1.0, ancillary_variables="error", coordinates="height")
        self.run_tool("regrid", "in.nc", "grid:30", "--statistics", "mean,max", "-o", "out.nc")
        out = self.read("out.nc")
        self.assertNotIn("formula_terms", out["lev"].ncattrs())
        self.assertNotIn("ancillary_variables", out["ta_max"].ncattrs())
        self.assertEqual(out["ta_max"].coordinates, "height")

    def test_places_that_are_gathered_are_left_out(self):
        land = np.flatnonzero(np.random.default_rng(4).uniform(size=648) < 0.4)
        with write(self.folder / "in.nc", land=len(land), time=2) as file:
            add(file, "land", ("land",), land, "i4", compress="lat lon")
            add(file, "gpp", ("land",), 1.0)
            add(file, "npp", ("time", "land"), 1.0)
            add(file, "t", ("lat", "lon"), 1.0)
        said = self.run_tool("regrid", "in.nc", "grid:30", "-o", "out.nc")
        self.assertEqual(said, ["in.nc: left out, as they are compressed by gathering: gpp (land), npp (land)"])
        self.assertEqual([*self.read("out.nc").variables], ["lat", "lon", "t"])
        said = self.run_tool("regrid", "in.nc:gpp", "grid:30", "-o", "out.nc", status=1)
        self.assertIn("gpp", said[0])

    def test_areas_of_cells_are_no_fields(self):
        with write(self.folder / "in.nc", time=2) as file:
            add(file, "areacella", ("lat", "lon"), 1.0, standard_name="cell_area", units="m2")
            add(file, "area", ("lat", "lon"), 1.0, units="km2")
            add(file, "vol", ("time", "lat", "lon"), 1.0)
            add(file, "leaf_area", ("lat", "lon"), 1.0, units="m2")
            add(file, "tas", ("lat", "lon"), 1.0, cell_measures="area: areacella volume: vol")
        said = self.run_tool("regrid", "in.nc", "grid:30", "-o", "out.nc")
        self.assertEqual(said, ["in.nc: left out, as they are areas or volumes of cells: areacella, area, vol"])
        out = self.read("out.nc")
        self.assertEqual([*out.variables], ["lat", "lon", "leaf_area", "tas"])
        self.assertNotIn("cell_measures", out["tas"].ncattrs())
        # They are fields where they are asked for, as for a sum over polygons.
        self.assertEqual(self.run_tool("regrid", "in.nc", "grid:30", "--value", "areacella", "-o", "out.nc"), [])
        self.assertIn("areacella", self.read("out.nc").variables)


if __name__ == "__main__":
    unittest.main()
