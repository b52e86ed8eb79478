#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Files that say two things of where their values are: the true places are read, or the tool tells.

Without netCDF4-python ctest says "Skipped".
"""

import csv
import json
import unittest

import numpy as np
from netcdf_meaning_test import LAT, LON, Files, add, add_axes, height, netCDF4

ROWS, COLUMNS = 6, 8


def tripolar():
    """Longitudes and latitudes of a grid whose rows bend in the north."""
    j, i = np.mgrid[0:ROWS, 0:COLUMNS]
    return 10.0 + 5 * i + 2.0 * j, 50.0 + 4 * j - 0.3 * (i - 3) ** 2


class Nominal(Files):
    def ocean(self, name, geolon="geolon", geolat="geolat", coordinates=None, has_true=True):
        """A file as MOM writes it: nominal axes beside the true longitudes and latitudes."""
        data = self.new(name)
        for axis, size, unit in (("xh", COLUMNS, "degrees_east"), ("yh", ROWS, "degrees_north")):
            data.createDimension(axis, size)
            values = 200.0 + 5 * np.arange(size) if axis == "xh" else 30.0 + np.arange(size)
            add(data, axis, (axis,), values, units=unit, long_name="nominal")
        lon, lat = tripolar()
        if has_true:
            add(data, geolon, ("yh", "xh"), lon, units="degrees_east")
            add(data, geolat, ("yh", "xh"), lat, units="degrees_north")
        texts = {} if coordinates is None else {"coordinates": coordinates}
        add(data, "depth", ("yh", "xh"), height(lon, lat), **texts)
        data.close()

    def test_true_places_come_before_nominal_axes(self):
        for names in (("geolon", "geolat"), ("geolon_t", "geolat_t"), ("TLONG", "TLAT")):
            self.ocean("o.nc", *names)
            self.said("interpolate", "o.nc", "--method", "nearest", "--to", "o.nc", "-o", "v.nc")
            lon, lat = tripolar()
            with netCDF4.Dataset(self.folder / "v.nc") as out:
                self.assertTrue(np.allclose(out["lon"][:], lon))
                self.assertTrue(np.allclose(out["depth"][:], height(lon, lat)))
            said = self.said("remap", "o.nc", "grid:10", "-o", "w.nc", status=1)
            self.assertIn("have no bounds, so no cells, and the axes", said)
            self.said("remap", "o.nc", "grid:10", "-o", "w.nc", "--corners", "made")
            with netCDF4.Dataset(self.folder / "w.nc") as weights:
                self.assertLess(float(weights["yc_a"][:].max()), 71)
                self.assertGreater(float(weights["yc_a"][:].max()), 69)

    def test_names_are_enough(self):
        lon, lat = tripolar()
        for names in (("geolon", "geolat"), ("nav_lon", "nav_lat")):
            data = self.new("o.nc")
            for axis, size, unit in (("xh", COLUMNS, "degrees_east"), ("yh", ROWS, "degrees_north")):
                data.createDimension(axis, size)
                add(data, axis, (axis,), 10.0 + np.arange(size), units=unit)
            for name, values in zip(names, (lon, lat), strict=True):
                add(data, name, ("yh", "xh"), values)
            add(data, "depth", ("yh", "xh"), height(lon, lat))
            data.close()
            self.said("interpolate", "o.nc", "--method", "nearest", "--to", "o.nc", "-o", "v.nc")
            with netCDF4.Dataset(self.folder / "v.nc") as out:
                self.assertTrue(np.allclose(out["lat"][:], lat))

    def test_fields_of_degrees_are_no_places(self):
        self.ocean("o.nc", "lon_of_origin", "lat_of_origin")
        self.said("interpolate", "o.nc:depth", "--method", "nearest", "--to", "o.nc:depth",
                      "-o", "v.nc")
        with netCDF4.Dataset(self.folder / "v.nc") as out:
            self.assertEqual(out["lon"].shape, (COLUMNS,))
            self.assertEqual(float(out["lon"][0]), 200)

    def test_coordinates_that_are_not_there_are_told(self):
        self.ocean("o.nc", coordinates="geolon_t geolat_t", has_true=False)
        said = self.said("regrid", "o.nc", "grid:10", "-o", "v.nc")
        for name in ("geolon_t", "geolat_t"):
            self.assertIn(
                f"there is no variable '{name}', which the attribute coordinates of 'depth' names",
                said,
            )


class OtherOrders(Files):
    def test_grids_that_files_name_are_compared_with_their_places(self):
        data = self.new("v.nc")
        add_axes(data)
        add(data, "v", ("lat", "lon"), height(LON[None, :], LAT[:, None]))
        data.close()
        for grid in ("F8", "healpix:2", "O8", "C8"):
            self.said("regrid", "v.nc", grid, "--method", "linear", "-o", "on.nc", "--quiet")
            self.said("remap", "on.nc", "grid:30", "-o", "right.nc")
            with netCDF4.Dataset(self.folder / "on.nc") as on, netCDF4.Dataset(
                self.folder / "turned.nc", "w", format="NETCDF3_64BIT_OFFSET"
            ) as turned:
                turned.setncatts({name: on.getncattr(name) for name in on.ncattrs()})
                for name, dimension in on.dimensions.items():
                    turned.createDimension(name, len(dimension))
                first = on["v"].dimensions[0]
                for name, item in on.variables.items():
                    values = np.asarray(item[...])
                    if item.dimensions and item.dimensions[0] == first:
                        values = values[::-1]
                    texts = {key: item.getncattr(key) for key in item.ncattrs()}
                    fill = texts.pop("_FillValue", None)
                    add(turned, name, item.dimensions, values, fill, **texts)
            self.said("remap", "turned.nc", "grid:30", "-o", "w.nc")
            with netCDF4.Dataset(self.folder / "right.nc") as right, netCDF4.Dataset(
                self.folder / "w.nc"
            ) as weights:
                if grid != "C8":  # whose first face is upside down
                    south = weights["yc_a"][0]
                    self.assertAlmostEqual(float(south), -float(right["yc_a"][0]), 6)
                np.testing.assert_allclose(np.sort(weights["S"][:]), np.sort(right["S"][:]), rtol=1e-9)
            self.said("regrid", "on.nc", "grid:30", "-o", "a.nc", "--quiet")
            self.said("regrid", "turned.nc", "grid:30", "-o", "b.nc", "--quiet")
            with netCDF4.Dataset(self.folder / "a.nc") as a, netCDF4.Dataset(self.folder / "b.nc") as b:
                np.testing.assert_allclose(a["v"][:], b["v"][:], rtol=1e-9)

    def test_corners_are_not_made_of_what_is_no_grid_of_rows(self):
        self.said("remap", "C4", "grid:30", "-o", "c.nc")
        with netCDF4.Dataset(self.folder / "c.nc") as weights:
            lon, lat = weights["xc_a"][:], weights["yc_a"][:]
        for name, shape, way_out in (
            ("tiles.nc", (6, 4, 4), "the name has its cells"),
            ("row.nc", (1, 96), "the name has its cells"),
            ("rows.nc", (8, 12), "--corners made"),
        ):
            data = self.new(name)
            dimensions = ("f", "j", "i")[-len(shape):]
            for dimension, length in zip(dimensions, shape, strict=True):
                data.createDimension(dimension, length)
            add(data, "lon", dimensions, np.reshape(lon, shape), units="degrees_east")
            add(data, "lat", dimensions, np.reshape(lat, shape), units="degrees_north")
            data.close()
            said = self.said("remap", name, "grid:30", "-o", "w.nc", status=1)
            self.assertIn("have no bounds, so no cells", said)
            self.assertIn(way_out, said)

    def test_rows_without_a_place_are_told(self):
        (self.folder / "s.csv").write_text("name,lon,lat\na,1,1\nb,,\nc,10,10\n")
        self.said("generate", "uniform", "-n", "5", "-o", "u.csv")
        for command in (
            ("overlay", "s.csv", "s.csv", "-o", "o.geojson"),
            ("relate", "s.csv", "s.csv", "-o", "o.csv"),
            ("buffer", "s.csv", "--distance", "5", "-o", "o.geojson"),
        ):
            said = self.said(*command)
            self.assertIn("left out 1 row without a place; features are numbered without it", said)
        (self.folder / "e.csv").write_text("0,1\n")
        said = self.said("triangulate", "s.csv", "--constraints", "e.csv", "-o", "o.npy",
                             status=1)
        self.assertIn("e.csv: it counts the rows of s.csv, of which 1 has no place", said)
        said = self.said("mesh", "scvt", "-n", "20", "--fixed", "s.csv", "-o", "o.nc", status=1)
        self.assertIn("s.csv: 1 row has no place", said)

    def test_columns_of_targets_stand_beside_the_values(self):
        (self.folder / "s.csv").write_text("lon,lat,v\n1,2,3\n40,5,6\n7,50,9\n-20,-30,4\n")
        (self.folder / "to.csv").write_text('ID,Lon,lat,name,z\n7,1,2,a b,5\n9,7,50,"x,y",\n')
        point = {"type": "Point", "coordinates": [1, 2]}
        named = {"type": "Feature", "properties": {"name": "p", "lat": 1}, "geometry": point}
        (self.folder / "to.geojson").write_text(json.dumps(named))
        (self.folder / "space.csv").write_text("v,x,y,z,w\nold,0,0,5,own\n")
        wanted = 'lon,lat,ID,name,z,v\n1,2,7,a b,5,3\n7,50,9,"x,y",,9\n'
        nearest = ("interpolate", "s.csv", "--value", "v", "--method", "nearest", "--to")
        for file in ("o.csv", "o.nc"):
            self.said(*nearest, "to.csv", "-o", file, "--weights", "w.nc")
        self.assertEqual((self.folder / "o.csv").read_text(), wanted)
        with netCDF4.Dataset(self.folder / "o.nc") as out:
            self.assertEqual(out["name"][:].tolist(), ["a b", "x,y"])
            np.testing.assert_array_equal(out["ID"][:], [7, 9])
        self.said("apply", "w.nc", "s.csv", "--value", "v", "-o", "a.csv")
        self.assertEqual((self.folder / "a.csv").read_text(), wanted)
        self.said(*nearest, "to.geojson", "-o", "o.csv")
        self.assertEqual((self.folder / "o.csv").read_text(), "lon,lat,name,lat_,v\n1,2,p,1,3\n")
        self.said(*nearest, "space.csv", "-o", "o.csv")
        self.assertEqual((self.folder / "o.csv").read_text(), "lon,lat,v_,w,v\n0,90,old,own,9\n")
        self.said(*nearest, "to.csv", "--lon", "z", "--lat", "lat", "-o", "o.csv", status=1)

    def test_degrees_and_heights_are_no_places_in_space(self):
        rows = "-74.0,40.7,10\n2.35,48.85,35\n139.7,35.7,40\n-43,-23,0\n"
        (self.folder / "h.csv").write_text("X,Y,Z\n" + rows)
        (self.folder / "h.xyz").write_text(rows.replace(",", " "))
        unit = np.random.default_rng(3).normal(size=(20, 3))
        np.savetxt(self.folder / "cloud.xyz", 60 * unit / np.abs(unit).max())
        np.savetxt(self.folder / "near.xyz", 90 * unit / np.linalg.norm(unit, axis=1)[:, None])
        look = "x, y and z look like longitude, latitude and height, but are taken as places in space; "
        said = self.said("delaunay", "h.csv", "-o", "o.npy")
        self.assertIn("h.csv: " + look + "--lon x --lat y takes degrees", said)
        said = self.said("delaunay", "h.xyz", "-o", "o.npy")
        self.assertIn("h.xyz: " + look + ".csv with the columns lon and lat has degrees", said)
        for told in (
            ("h.csv", "--lon", "X", "--lat", "Y"),
            ("h.csv", "--x", "X", "--y", "Y", "--z", "Z"),
            ("cloud.xyz",),
            ("near.xyz",),
        ):
            self.assertNotIn("look like", self.said("delaunay", *told, "-o", "o.npy"))

    def test_endings_in_capitals_are_endings(self):
        (self.folder / "S.CSV").write_text("lon,lat,t\n1,1,5\n10,10,6\n-30,3,7\n0,60,8\n")
        (self.folder / "t.csv").write_text("lon,lat\n2,2\n")
        self.said("interpolate", "S.CSV", "--to", "t.csv", "--weights", "w.nc")
        (self.folder / "OTHER.CSV").write_text("lon,lat,t\n10,10,6\n1,1,5\n-30,3,7\n0,60,8\n")
        self.said("apply", "w.nc", "S.CSV", "--value", "t", "-o", "o.csv")
        said = self.said("apply", "w.nc", "OTHER.CSV", "--value", "t", "-o", "o.csv", status=1)
        self.assertIn("OTHER.CSV", said)
        box = {
            "type": "Feature",
            "properties": {},
            "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]]},
        }
        (self.folder / "B.GEOJSON").write_text(json.dumps(box))
        self.assertIn("1 feature", self.said("info", "B.GEOJSON"))
        self.grid()
        self.said("regrid", "grid.nc", "B.GEOJSON", "--edges", "geodesic", "-o", "o.csv")

    def masked_targets(self):
        """Four cells of SCRIP in mask.nc, of which the second and the last one are masked."""
        data = self.new("mask.nc")
        data.createDimension("grid_size", 4)
        data.createDimension("grid_corners", 4)
        for name, values, sides in (
            ("lon", [0.0, 10, 20, 30], [-1, 1, 1, -1]),
            ("lat", [5.0, 6, 7, 8], [-1, -1, 1, 1]),
        ):
            add(data, f"grid_center_{name}", ("grid_size",), values, units="degrees")
            add(data, f"grid_corner_{name}", ("grid_size", "grid_corners"),
                np.add.outer(values, sides), units="degrees")
        add(data, "grid_imask", ("grid_size",), np.array([1, 0, 1, 0], np.int32))
        data.close()

    def test_masked_targets_get_no_value(self):
        self.grid()
        self.masked_targets()
        for options in ((), ("--extrapolate", "nearest")):
            self.said("interpolate", "grid.nc", "--to", "mask.nc", "--weights", "w.nc",
                          "-o", "o.csv", *options)
            with open(self.folder / "o.csv", newline="") as file:
                values = [row["v"] for row in csv.DictReader(file)]
            self.assertEqual([value == "" for value in values], [False, True, False, True])
            with netCDF4.Dataset(self.folder / "w.nc") as weights:
                self.assertEqual(sorted(set(weights["row"][:].tolist())), [1, 3])
                self.assertEqual(weights["mask_b"][:].tolist(), [1, 0, 1, 0])

    def test_sites_are_given_to_targets_that_are_not_masked(self):
        """--method nearest_d2s: each site counts once, at its nearest target among these."""
        sites = [(1.0, 5.0, 3.0), (9.0, 6.2, 5.0), (21.0, 7.0, 7.0), (29.0, 8.0, 11.0)]
        rows = "".join(f"{lon},{lat},{t}\n" for lon, lat, t in sites)
        (self.folder / "s.csv").write_text("lon,lat,t\n" + rows)
        self.masked_targets()
        self.said("interpolate", "s.csv", "--value", "t", "--to", "mask.nc", "--method",
                      "nearest_d2s", "-o", "o.csv")
        with open(self.folder / "o.csv", newline="") as file:
            values = [row["t"] for row in csv.DictReader(file)]
        self.assertEqual(values, ["8", "", "18", ""])


class Values(Files):
    def test_equal_areas_of_pixels_are_ties(self):
        data = self.new("q.nc")
        data.createDimension("cell", 48)
        add(data, "kind", ("cell",), np.tile(np.array([1, 2, 2, 1], np.int8), 12),
            flag_values=np.array([1, 2], np.int8))
        data.setncattr("rondel_grid", "healpix:1:nested")
        data.close()
        for options in ((), ("--statistics", "majority"), ("--statistics", "minority")):
            self.said("regrid", "q.nc", "healpix:0", "--source", "healpix:1:nested", *options,
                          "-o", "o.nc")
            with netCDF4.Dataset(self.folder / "o.nc") as out:
                name = "_".join(["kind", *options[1:]])
                self.assertEqual(set(np.asarray(out[name][:]).tolist()), {1}, options)

    def test_packed_numbers_that_floats_do_not_tell_apart_are_doubles(self):
        for scale, offset, kind in ((0.01, 273.15, "f4"), (0.01, 1e7, "f8"), (1e38, 0.0, "f8"),
                                    (1e-48, 0.0, "f8")):
            data = self.new("big.nc")
            add_axes(data)
            raw = np.arange(len(LON) * len(LAT), dtype=np.int16).reshape(len(LAT), len(LON))
            add(data, "v", ("lat", "lon"), raw, scale_factor=scale, add_offset=offset)
            data.close()
            self.said("regrid", "big.nc", "grid:20", "--method", "nearest", "-o", "o.nc")
            with netCDF4.Dataset(self.folder / "o.nc") as out:
                self.assertEqual(out["v"].dtype.str[1:], kind, (scale, offset))
                self.assertEqual(len(np.unique(np.asarray(out["v"][:]))), raw.size)

    def test_fields_are_named_once(self):
        self.grid()
        for command in (
            ("regrid", "grid.nc", "grid:30", "--value", "v", "--value", "v", "-o", "o.nc"),
            ("interpolate", "grid.nc", "--value", "v", "--value", "v", "--to", "to.csv", "-o", "o.csv"),
        ):
            self.assertIn('"v" is named twice', self.said(*command, status=1))
        (self.folder / "s.csv").write_text("lon,lat,v\n1,2,3\n40,5,6\n7,90,9\n")
        twice = ("--value", "v", "--value", "v", "--to", "to.csv", "-o", "o.csv")
        self.assertIn("--value: 'v' is named twice", self.said("interpolate", "s.csv", *twice, status=2))

    def test_two_names_of_one_field_are_refused(self):
        data = self.new("times.nc")
        add_axes(data)
        data.createDimension("time", 2)
        add(data, "time", ("time",), np.array([10.0, 20.0]))
        add(data, "v", ("time", "lat", "lon"), np.zeros((2, len(LAT), len(LON))))
        data.close()
        for names, what in (
            (("v[0]", "v[-2]"), "are the same field"),
            (("v_20", "v[1]"), "are the same field"),
            (("v[1]", "v"), "have a field in common"),
        ):
            values = ("--value", names[0], "--value", names[1])
            for command in (
                ("regrid", "times.nc", "grid:30", *values, "-o", "o.nc"),
                ("interpolate", "times.nc", *values, "--to", "to.csv", "-o", "o.csv"),
            ):
                said = self.said(*command, status=1)
                self.assertIn(f'"{names[0]}" and "{names[1]}" {what}', said)
        self.said("regrid", "times.nc", "grid:30", "--value", "v[0]", "--value", "v[1]", "-o", "o.nc")


class MeshesOfOceans(Files):
    def mesh(self, name, nodes=None, **topology):
        """Two triangles of UGRID; `nodes` are the numbers of corners, face by face."""
        data = self.new(name)
        data.createDimension("node", 4)
        add(data, "lon", ("node",), [0.0, 10, 10, 0], units="degrees_east")
        add(data, "lat", ("node",), [0.0, 0, 10, 10], units="degrees_north")
        data.createDimension("nele", 2)
        data.createDimension("three", 3)
        corners = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
        if nodes == "transposed":
            add(data, "nv", ("three", "nele"), corners.T)
        else:
            add(data, "nv", ("nele", "three"), corners)
        variable = data.createVariable("mesh", "i4", ())
        variable.setncatts(
            {
                "cf_role": "mesh_topology",
                "topology_dimension": 2,
                "node_coordinates": "lon lat",
                "face_node_connectivity": "nv",
                **topology,
            }
        )
        return data

    def depths_of(self, name):
        self.said("mesh", "convert", name, "-o", "fort.14")
        rows = (self.folder / "fort.14").read_text().split("\n")[2:6]
        return [float(row.split()[3]) for row in rows]

    def test_depths_of_adcirc_and_delft3d(self):
        data = self.mesh("a.nc")
        add(data, "depth", ("node",), [1.0, 2, 3, 4], standard_name="depth_below_geoid", units="m")
        data.close()
        self.assertEqual(self.depths_of("a.nc"), [1, 2, 3, 4])
        data = self.mesh("d.nc")
        add(data, "z", ("node",), [-1.0, -2, 3, 4], standard_name="altitude", units="m")
        data.close()
        self.assertEqual(self.depths_of("d.nc"), [1, 2, -3, -4])

    def test_variables_that_are_left_out_are_told(self):
        data = self.mesh("a.nc")
        add(data, "drag", ("node",), [1.0, 2, 3, 4], units="m")
        data.close()
        said = self.said("mesh", "convert", "a.nc", "-o", "fort.14")
        self.assertIn("left out, as they are no part of the mesh: drag", said)

    def test_faces_that_are_the_last_dimension(self):
        data = self.mesh("t.nc", "transposed", face_coordinates="lonc latc")
        add(data, "lonc", ("nele",), [20 / 3, 10 / 3], units="degrees_east")
        add(data, "latc", ("nele",), [10 / 3, 20 / 3], units="degrees_north")
        data.close()
        self.said("remap", "t.nc", "grid:10", "-o", "w.nc")
        with netCDF4.Dataset(self.folder / "w.nc") as weights:
            self.assertEqual(len(weights.dimensions["n_a"]), 2)
        many = 400
        data = self.new("many.nc")
        data.createDimension("node", many)
        angles = np.linspace(0, 2 * np.pi, many, endpoint=False)
        add(data, "lon", ("node",), 10 * np.cos(angles), units="degrees_east")
        add(data, "lat", ("node",), 10 * np.sin(angles), units="degrees_north")
        data.createDimension("nele", many)
        data.createDimension("three", 3)
        add(data, "nv", ("three", "nele"), np.tile(np.arange(many, dtype=np.int32), (3, 1)))
        variable = data.createVariable("mesh", "i4", ())
        variable.setncatts(
            {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "lon lat",
             "face_node_connectivity": "nv"}
        )
        data.close()
        said = self.said("remap", "many.nc", "grid:10", "-o", "w.nc", status=1)
        self.assertIn("the attribute face_dimension of \"mesh\" must say so", said)


class Statistics(Files):
    def test_variables_of_the_second_grid(self):
        data = self.new("two.nc")
        add_axes(data)
        add_axes(data, LON[:4], LAT[:3], "_u")
        for name in ("lon_u", "lat_u"):
            self.assertIn(name, data.variables)
        add(data, "t", ("lat", "lon"), np.ones((len(LAT), len(LON))))
        add(data, "u", ("lat_u", "lon_u"), 2 * np.ones((3, 4)))
        data.close()
        box = {
            "type": "Feature",
            "properties": {},
            "geometry": {
                "type": "Polygon",
                "coordinates": [[[-165, -70], [-130, -70], [-130, -50], [-165, -50], [-165, -70]]],
            },
        }
        (self.folder / "b.geojson").write_text(json.dumps(box))
        self.said("regrid", "two.nc:u", "b.geojson", "--statistics", "mean", "-o", "o.csv")
        with open(self.folder / "o.csv", newline="") as file:
            row = next(csv.DictReader(file))
        self.assertAlmostEqual(float(row["u_mean"]), 2)


if __name__ == "__main__":
    unittest.main()
