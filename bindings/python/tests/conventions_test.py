# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A matrix of files by the conventions: the same cells, weights and values from the tool, from
`Partition.read` and from Datasets, against areas and sums computed here.
"""

import ctypes
import ctypes.util
import itertools
import os
import subprocess
import warnings

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
netCDF4 = pytest.importorskip("netCDF4")  # noqa: N816

TOOL = os.environ.get("RONDEL")
DEGREES = ("degrees_east", "degree_E", "degreesE", "Degrees_East", "degrees", "arcdeg")
RADIANS = ("radian", "radians", "rad", "Radian")
NORTH = {"degrees_east": "degrees_north", "degree_E": "degree_N", "degreesE": "degreesN"}
NORTH["Degrees_East"] = "Degrees_North"
OTHER = rondel.lonlat_grid(8, 5)


def run(*arguments):
    found = subprocess.run([TOOL, *map(str, arguments)], capture_output=True, text=True)
    assert found.returncode == 0, found.stderr
    return found.stderr


def remapped(path, folder, name=""):
    """The weights and source areas that the tool writes, and what it says."""
    source = f"{path}:{name}" if name else path
    other = folder / "other.nc"
    if not other.exists():
        lon, lat = np.arange(-157.5, 180, 45), np.arange(-72.0, 90, 36)
        write(other, axes_file(lon, lat))
    said = run("remap", source, other, "-o", folder / "w.nc", "--quiet")
    with netCDF4.Dataset(folder / "w.nc") as file:
        areas = file["area_a"][:].data
    return rondel.read_weights(folder / "w.nc"), areas, said


def same_weights(a, b):
    def dense(weights):
        made = np.zeros(weights.shape)
        np.add.at(
            made,
            (np.repeat(np.arange(weights.shape[0]), np.diff(weights.indptr)), weights.indices),
            weights.data,
        )
        return made

    return a.shape == b.shape and np.allclose(dense(a), dense(b), atol=1e-12)


def axes_file(lon, lat):
    return xarray.Dataset(
        coords={
            "lon": ("lon", lon, {"units": "degrees_east"}),
            "lat": ("lat", lat, {"units": "degrees_north"}),
        }
    )


def write(path, dataset, form="NETCDF3_64BIT"):
    plain = {name: {"_FillValue": None} for name in dataset.variables}
    dataset.to_netcdf(path, format=form, encoding=plain)


def rectangles(west, east, south, north):
    """Of each latitude and longitude, in steradians."""
    height = np.sin(np.radians(north)) - np.sin(np.radians(south))
    return np.abs(height)[:, None] * np.radians(np.abs(east - west))


def polygon_area(lon, lat):
    """Of convex polygons of great circles, shape (n, k), in degrees."""
    lon, lat = np.radians(lon), np.radians(lat)
    p = np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=-1)
    total = np.zeros(len(p))
    for k in range(1, p.shape[1] - 1):
        a, b, c = p[:, 0], p[:, k], p[:, k + 1]
        along = (a * b).sum(-1) + (b * c).sum(-1) + (c * a).sum(-1)
        total += 2 * np.arctan2((a * np.cross(b, c)).sum(-1), 1 + along)
    return np.abs(total)


def check(path, dataset, areas, folder, tolerance=1e-13, name=""):
    """The same from the file and from the Dataset; returns what the tool says."""
    part = rondel.Partition.read(f"{path}:{name}" if name else path)
    assert np.allclose(part.areas, areas.ravel(), rtol=1e-9, atol=tolerance)
    if dataset is not None:
        regridder = rondel.Regridder(dataset, OTHER, "conservative")
        assert same_weights(regridder.weights, rondel.remap(part, OTHER).weights)
    if TOOL is None:
        return ""
    weights, of_tool, said = remapped(path, folder, name)
    assert np.allclose(of_tool, areas.ravel(), rtol=1e-9, atol=tolerance)
    assert same_weights(weights, rondel.remap(part, OTHER).weights)
    return said


LON = np.array([5.0, 20.0, 50.0, 130.0, 250.0, 340.0])
LON_LINES = np.array([-5.0, 10.0, 30.0, 90.0, 190.0, 310.0, 355.0])
LAT = np.array([-70.0, -10.0, 0.0, 40.0])
LAT_LINES = np.array([-90.0, -20.0, -5.0, 10.0, 80.0])


@pytest.mark.parametrize("bounds", ["none", "usual", "reversed", "transposed", "lost"])
def test_axes(tmp_path, bounds):
    units = itertools.cycle([*DEGREES, *RADIANS, None])
    cases = itertools.product(
        ("east", "west", "rolled", "both ends"), ("north", "south"), ("f8", "f4")
    )
    for number, (along, across, dtype) in enumerate(cases):
        unit = next(units)
        west, east = LON_LINES[:-1].copy(), LON_LINES[1:].copy()
        lon, lat, south, north = LON.copy(), LAT.copy(), LAT_LINES[:-1], LAT_LINES[1:]
        if along == "both ends":
            lines = np.array([-30.0, 30, 90, 150, 210, 270, 330, 390])
            lon, west, east = np.arange(0.0, 361, 60), lines[:-1], lines[1:]
        elif along == "rolled":
            # Coordinates from -180 to 180, bounds from 0 to 360.
            order = np.argsort((lon + 180) % 360)
            lon = ((lon + 180) % 360 - 180)[order]
            west, east = west[order] % 360, east[order] % 360
            east = np.where(east < west, east + 360, east)
        if along == "west":
            lon, west, east = lon[::-1], west[::-1], east[::-1]
        if across == "south":
            lat, south, north = lat[::-1], south[::-1], north[::-1]
        pairs = {"lon_bnds": np.stack([west, east], -1), "lat_bnds": np.stack([south, north], -1)}
        if bounds == "reversed":
            pairs = {key: value[:, ::-1] for key, value in pairs.items()}
        has_bounds = bounds not in ("none", "lost")
        scale = np.pi / 180 if unit in RADIANS else 1
        ds = xarray.Dataset(
            coords={
                "lon": ("lon", (lon * scale).astype(dtype)),
                "lat": ("lat", (lat * scale).astype(dtype)),
            }
        )
        if unit is not None:
            ds.lon.attrs["units"], ds.lat.attrs["units"] = unit, NORTH.get(unit, unit)
        if bounds != "none":
            ds.lon.attrs["bounds"], ds.lat.attrs["bounds"] = "lon_bnds", "lat_bnds"
        if has_bounds:
            for key, value in pairs.items():
                dims = (key[:3], "two")
                turned = bounds == "transposed"
                value = (value * scale).astype(dtype)
                ds[key] = (dims[::-1], value.T) if turned else (dims, value)
        # What the cells are.
        if not has_bounds:
            turns = np.unwrap(lon, period=360)
            if along == "both ends":
                turns = lon
            inner = (turns[1:] + turns[:-1]) / 2
            first, last = turns[0] - (inner[0] - turns[0]), turns[-1] + (turns[-1] - inner[-1])
            edge = np.concatenate([[first], inner, [last]])
            if along == "both ends":
                edge[0], edge[-1] = 0, 360
            elif abs(edge[-1] - edge[0]) > 360:
                continue  # such axes are refused
            west, east = edge[:-1], edge[1:]
            between = (lat[1:] + lat[:-1]) / 2
            first, last = 2 * lat[0] - between[0], 2 * lat[-1] - between[-1]
            ends = []
            for line, width in ((first, between[0] - first), (last, last - between[-1])):
                ends.append(np.copysign(90, line) if 90 - abs(line) < abs(width) else line)
            edge = np.concatenate([[ends[0]], between, [ends[1]]])
            south, north = edge[:-1], edge[1:]
        elif along == "both ends":
            west, east = np.maximum(west, 0), np.minimum(east, 360)
        path = tmp_path / f"{number}.nc"
        write(path, ds)
        tolerance = 1e-12 if dtype == "f8" else 3e-6
        with warnings.catch_warnings():
            warnings.simplefilter("error" if bounds != "lost" else "ignore")
            said = check(path, ds, rectangles(west, east, south, north), tmp_path, tolerance)
        if TOOL is not None:
            assert ("there is no variable 'lon_bnds'" in said) == (bounds == "lost")


def quadrilaterals(seed=1):
    """Corners of a skewed grid of 5 x 7 cells, shape (6, 8), and centers."""
    j, i = np.meshgrid(np.arange(6.0), np.arange(8.0), indexing="ij")
    lon, lat = 170 + 4 * i + j, -30 + 5 * j - i
    middle = [(c[:-1, :-1] + c[1:, 1:]) / 2 for c in (lon, lat)]
    return lon, lat, *middle


def four(corners):
    return np.stack(
        [corners[:-1, :-1], corners[:-1, 1:], corners[1:, 1:], corners[1:, :-1]], axis=-1
    )


@pytest.mark.parametrize("unit", ["degrees_east", "radian", None])
@pytest.mark.parametrize("time", ["none", "first", "last"])
def test_curvilinear(tmp_path, unit, time):
    lon_b, lat_b, lon, lat = quadrilaterals()
    scale = np.pi / 180 if unit == "radian" else 1
    areas = polygon_area(four(lon_b).reshape(-1, 4), four(lat_b).reshape(-1, 4))
    cases = itertools.product(("corners", "clockwise", "first", "grid"), (0, 3))
    for number, (kind, missing) in enumerate(cases):
        names = {"lon": "nav_lon", "lat": "nav_lat"}
        arrays = {"lon": four(lon_b) * scale, "lat": four(lat_b) * scale}
        dims = ("y", "x", "nv")
        if kind == "clockwise":
            arrays = {key: value[..., ::-1] for key, value in arrays.items()}
        elif kind == "first":
            arrays = {key: np.moveaxis(value, -1, 0) for key, value in arrays.items()}
            dims = ("nv", "y", "x")
        elif kind == "grid":
            arrays, dims = {"lon": lon_b * scale, "lat": lat_b * scale}, ("y_b", "x_b")
        expected = areas.reshape(5, 7).copy()
        centers = {"lon": lon * scale, "lat": lat * scale}
        if missing:
            place = {"corners": (0, 2), "clockwise": (0, 2), "first": (slice(None), 0, 2)}
            where = place.get(kind, (0, 0))
            for value in arrays.values():
                value[where] = np.nan
            expected[0, 0 if kind == "grid" else 2] = 0
        ds = xarray.Dataset()
        for key, name in names.items():
            attrs = {"bounds": f"{key}_of_corners"}
            if unit is not None:
                attrs["units"] = NORTH.get(unit, unit) if key == "lat" else unit
            own = centers[key]
            if time == "first":
                ds[name] = (("Time", "y", "x"), np.stack([own] * 3), attrs)
            elif time == "last":
                ds[name] = (("y", "x", "Time"), np.stack([own] * 3, -1), attrs)
            else:
                ds[name] = (("y", "x"), own, attrs)
            ds[f"{key}_of_corners"] = (dims, arrays[key])
        ds = ds.set_coords(list(names.values()))
        path = tmp_path / f"{number}.nc"
        write(path, ds)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            said = check(path, ds, expected, tmp_path)
        if missing:
            text = "1 of 35 cells have corners that are missing and are left out"
            assert [text in str(warning.message) for warning in told] == [True, True]
            assert TOOL is None or text in said
        else:
            assert not told
            assert not said


def mesh_of_voronoi(n=40):
    cells = rondel.Partition.voronoi(rondel.delaunay(clouds_of(n)))
    offsets, _, corners, points = cells.rings
    return cells, offsets, corners, rondel.lonlat(points)


def clouds_of(n):
    points = np.random.default_rng(3).normal(size=(n, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


def rows_of(rings, corners, first, fill):
    sizes = np.diff(rings)
    rows = np.full((len(sizes), sizes.max()), fill, np.int64)
    rows[np.arange(rows.shape[1]) < sizes[:, None]] = corners + first
    return rows


UGRID = list(
    itertools.product(
        ("i4", "f8"), (0, 1), (-1, -999, 2**31 - 1), (False, True), ("degrees_east", "radians")
    )
)


def test_ugrid(tmp_path):
    cells, _, _, nodes = mesh_of_voronoi()
    _, rings, corners, _ = cells.rings
    for number, (dtype, first, fill, turned, unit) in enumerate(UGRID):
        scale = np.pi / 180 if unit == "radians" else 1
        path = tmp_path / f"{number}.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
            rows = rows_of(rings, corners, first, fill)
            for name, size in (("face", len(rows)), ("corner", rows.shape[1])):
                file.createDimension(name, size)
            file.createDimension("node", len(nodes))
            mesh = file.createVariable("mesh", "i4")
            mesh.cf_role, mesh.topology_dimension = "mesh_topology", 2
            mesh.node_coordinates = "there that"  # latitudes first
            mesh.face_node_connectivity, mesh.face_dimension = "faces", "face"
            for name, column, text in (("that", 0, unit), ("there", 1, NORTH.get(unit, unit))):
                variable = file.createVariable(name, "f8", ("node",))
                variable.units = text
                variable.standard_name = ("longitude", "latitude")[column]
                variable[:] = nodes[:, column] * scale
            dims = ("corner", "face") if turned else ("face", "corner")
            faces = file.createVariable("faces", dtype, dims, fill_value=fill)
            faces.start_index = np.int32(first)
            faces[:] = rows.T if turned else rows
        check(path, None, cells.areas, tmp_path)


def test_ugrid_without_fill_or_start(tmp_path):
    """Negative numbers are told; numbers from 1 that nobody announced get a hint."""
    for first, fill, text in ((0, -7, "are less than 0 and taken"), (1, 0, "start_index = 1")):
        path = tmp_path / f"{first}.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC") as file:
            file.createDimension("face", 2)
            file.createDimension("corner", 4)
            file.createDimension("node", 4)
            mesh = file.createVariable("mesh", "i4")
            mesh.cf_role, mesh.topology_dimension = "mesh_topology", 2
            mesh.node_coordinates, mesh.face_node_connectivity = "x y", "faces"
            file.createVariable("x", "f8", ("node",))[:] = [0, 10, 10, 0]
            file.createVariable("y", "f8", ("node",))[:] = [0, 0, 10, 10]
            rows = np.array([[0, 1, 2, -1], [0, 2, 3, -1]])
            if first == 1:
                rows[:, 3] = rows[:, 2]
            rows = np.where(rows < 0, fill, rows + first)
            file.createVariable("faces", "i4", ("face", "corner"))[:] = rows
        if first == 0:
            with pytest.warns(UserWarning, match=text):
                assert len(rondel.Partition.read(path).areas) == 2
        else:
            with pytest.raises(OSError, match=text):
                rondel.Partition.read(path)


@pytest.mark.parametrize("unit", ["degrees", "radians"])
def test_scrip(tmp_path, unit):
    cells, _, _, nodes = mesh_of_voronoi()
    _, rings, corners, _ = cells.rings
    scale = np.pi / 180 if unit == "radians" else 1
    padded = rows_of(rings, corners, 0, -1)
    cases = itertools.product(("repeated", "missing"), (False, True), ("none", "nan", "far"))
    for number, (ends, turned, hole) in enumerate(cases):
        rows = padded.copy()
        if ends == "repeated":
            last = corners[rings[1:] - 1]
            rows = np.where(rows < 0, last[:, None], rows)
        values = np.where(rows[..., None] < 0, np.nan, nodes[rows] * scale)
        areas, mask = cells.areas.copy(), np.ones(len(rows), int)
        if hole != "none":  # masked cells may have anything for corners
            values[[3, 8]] = np.nan if hole == "nan" else 1e4
            mask[[3, 8]], areas[[3, 8]] = 0, 0
        path = tmp_path / f"{number}.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_DATA") as file:
            file.createDimension("grid_size", len(rows))
            file.createDimension("grid_corners", rows.shape[1])
            for name, column in (("lon", 0), ("lat", 1)):
                center = file.createVariable(f"grid_center_{name}", "f8", ("grid_size",))
                center.units = unit
                middle = np.where(np.isnan(values) | (abs(values) > 999), 0, values)
                center[:] = middle[:, :3, column].mean(axis=1)
                dims = ("grid_size", "grid_corners")
                corner = file.createVariable(
                    f"grid_corner_{name}", "f8", dims[::-1] if turned else dims
                )
                corner.units = unit
                corner[:] = values[..., column].T if turned else values[..., column]
            file.createVariable("grid_imask", "i4", ("grid_size",))[:] = mask
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            said = check(path, None, areas, tmp_path)
        assert bool(told) == (hole != "none")
        if hole != "none":
            assert TOOL is None or "2 of 40 cells are masked by" in said


def test_meshes_without_units(tmp_path):
    """MPAS and ICON have radians where no attribute says anything; nCells + 1 is none."""
    points = clouds_of(60)
    mesh = rondel.mesh.from_points(points)
    mesh.to_mpas(tmp_path / "mesh.nc")
    with xarray.open_dataset(tmp_path / "mesh.nc") as file:
        ds = file.load()
    for name in ds.variables:
        ds[name].attrs.pop("units", None)
    write(tmp_path / "plain.nc", ds, "NETCDF3_64BIT")
    areas = rondel.Partition.read(tmp_path / "mesh.nc").areas
    assert np.isclose(areas.sum(), 4 * np.pi)
    check(tmp_path / "plain.nc", None, areas, tmp_path)
    found = rondel.Regridder(ds, OTHER, "nearest_s2d")
    assert same_weights(found.weights, rondel.Regridder(file, OTHER, "nearest_s2d").weights)


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_masks_of_regions(tmp_path):
    """MPAS-Tools' regionCellMasks(nCells, nRegions); of times nobody knows which is meant."""
    mesh = rondel.mesh.from_points(clouds_of(80))
    mesh.to_mpas(tmp_path / "mesh.nc")
    masks = np.zeros((80, 3), np.int32)
    masks[[3, 5], 0] = masks[[5, 9], 2] = 1
    for name, dim, status in (("regions", "nRegions", 0), ("times", "Time", 1)):
        data = xarray.Dataset({"regionCellMasks": (("nCells", dim), masks)})
        write(tmp_path / f"{name}.nc", data, "NETCDF3_CLASSIC")
        command = ["mesh", "cull", tmp_path / "mesh.nc", "-o", tmp_path / "less.nc"]
        command += ["--mask", f"{tmp_path / name}.nc:regionCellMasks"]
        command += ["--cell-map", tmp_path / "map.npy"]
        found = subprocess.run([TOOL, *map(str, command)], capture_output=True, text=True)
        assert found.returncode == status, found.stderr
    assert np.flatnonzero(np.load(tmp_path / "map.npy") == 2**32 - 1).tolist() == [3, 5, 9]


def test_of_several_grids_one_is_named(tmp_path):
    first = rectangles(LON_LINES[:-1], LON_LINES[1:], LAT_LINES[:-1], LAT_LINES[1:])
    wide = {"units": "degrees_east", "bounds": "lon_bnds"}
    high = {"units": "degrees_north", "bounds": "lat_bnds"}
    ds = xarray.Dataset(
        {
            "lon_bnds": (("lon", "two"), np.stack([LON_LINES[:-1], LON_LINES[1:]], -1)),
            "lat_bnds": (("lat", "two"), np.stack([LAT_LINES[:-1], LAT_LINES[1:]], -1)),
            "t": (("lat", "lon"), np.zeros((4, 6))),
            "u": (("slat", "slon"), np.zeros((3, 4))),
        },
        {
            "lon": ("lon", LON, wide),
            "lat": ("lat", LAT, high),
            "slon": ("slon", np.arange(0.0, 360, 90), {"units": "degrees_east"}),
            "slat": ("slat", np.array([-60.0, 0, 60]), {"units": "degrees_north"}),
        },
    )
    path = tmp_path / "several.nc"
    write(path, ds)
    with pytest.warns(UserWarning, match="several grids; that of lon and lat is read"):
        assert np.allclose(rondel.Partition.read(path).areas, first.ravel())
    lines = np.arange(-45.0, 316, 90), np.array([-90.0, -30, 30, 90])
    second = rectangles(lines[0][:-1], lines[0][1:], lines[1][:-1], lines[1][1:])
    for name in ("slon", "slat", "u"):
        check(path, None, second, tmp_path, name=name)
    check(path, ds[["t", "lon_bnds", "lat_bnds"]], first, tmp_path, name="t")
    with pytest.raises(OSError, match='no variable "nothing"'):
        rondel.Partition.read(f"{path}:nothing")


def test_pretended_axes(tmp_path):
    """The attribute `coordinates` counts more than axes; corners of a grid are shared."""
    lon_b, lat_b, lon, lat = quadrilaterals()
    east, north = {"units": "degrees_east"}, {"units": "degrees_north"}
    ds = xarray.Dataset(
        {
            "v": (("nf", "Y", "X"), np.zeros((1, 5, 7)), {"coordinates": "lons lats"}),
            "lons": (("nf", "Y", "X"), lon[None], east),
            "lats": (("nf", "Y", "X"), lat[None], north),
            "corner_lons": (("nf", "YC", "XC"), lon_b[None], east),
            "corner_lats": (("nf", "YC", "XC"), lat_b[None], north),
        },
        {"X": ("X", np.arange(7.0), east), "Y": ("Y", np.arange(5.0), north)},
    )
    path = tmp_path / "cube.nc"
    write(path, ds)
    areas = polygon_area(four(lon_b).reshape(-1, 4), four(lat_b).reshape(-1, 4))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        check(path, ds, areas, tmp_path)
    path = tmp_path / "lost.nc"
    write(path, ds.drop_vars(["corner_lons", "corner_lats"]))
    with pytest.raises(OSError, match="have no bounds, so no cells"):
        rondel.Partition.read(path)


AXES = {"time": 2, "lat": 4, "lon": 6, "lev": 3}
SMOOTH = np.random.default_rng(7).normal(size=(2, 4, 6, 3)).round(3)


def source_file(folder):
    path = folder / "source.nc"
    ds = axes_file(np.arange(30.0, 360, 60), np.arange(-67.5, 90, 45))
    write(path, ds)
    return path, ds


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_dimensions_in_any_order(tmp_path):
    path, ds = source_file(tmp_path)
    run("remap", path, "grid:90", "-o", tmp_path / "w.nc", "--quiet")
    weights = rondel.read_weights(tmp_path / "w.nc")
    expected = weights.apply(np.moveaxis(SMOOTH, 3, 1).reshape(2, 3, 24)).reshape(2, 3, 2, 4)
    target = {"lon": np.arange(-135.0, 180, 90), "lat": np.array([-45.0, 45])}
    regridder = rondel.Regridder(ds, target, "conservative")
    for number, order in enumerate(itertools.permutations(AXES)):
        field = xarray.DataArray(SMOOTH, dims=list(AXES)).transpose(*order)
        made = ds.assign(t=field)
        values = tmp_path / f"{number}.nc"
        write(values, made)
        run("apply", tmp_path / "w.nc", values, "-o", tmp_path / "out.nc", "--quiet")
        with netCDF4.Dataset(tmp_path / "out.nc") as file:
            found = xarray.DataArray(file["t"][:].data, dims=file["t"].dimensions)
        assert np.allclose(found.transpose("time", "lev", "lat", "lon"), expected, atol=1e-14)
        again = regridder(made).t.transpose("time", "lev", "lat", "lon")
        assert np.allclose(again, expected, atol=1e-13)


FILL = netCDF4.default_fillvals
MISSING = {
    "fill": ("f4", {"_FillValue": np.float32(-9)}, -9),
    "missing of another type": ("f4", {"missing_value": 1e20}, 1e20),
    "missing of single precision": ("f8", {"missing_value": np.float32(1e20)}, np.float32(1e20)),
    "several": ("i2", {"missing_value": np.array([-9, -8], "i2")}, -8),
    "default of floats": ("f4", {}, FILL["f4"]),
    "default of shorts": ("i2", {}, FILL["i2"]),
    "default of ints": ("i4", {}, FILL["i4"]),
    "above": ("f8", {"valid_max": 50.0}, 51),
    "below": ("i4", {"valid_min": np.int32(-50)}, -51),
    "outside": ("f4", {"valid_range": np.array([-50, 50], "f4")}, 60),
    "packed": ("i2", {"scale_factor": 0.5, "add_offset": 10.0, "_FillValue": np.int16(-99)}, -99),
    "packed range": (
        "i2",
        {"scale_factor": 0.5, "add_offset": 10.0, "valid_range": np.array([-40, 40], "i2")},
        41,
    ),
    "unsigned": ("i1", {"_Unsigned": "true", "_FillValue": np.int8(-1)}, -1),
    "nan": ("f8", {}, np.nan),
}


@pytest.mark.parametrize("kind", MISSING)
@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_missing_values(tmp_path, kind):
    path, ds = source_file(tmp_path)
    dtype, attributes, missing = MISSING[kind]
    numbers = np.random.default_rng(8).integers(10, 40, size=(2, 24)).astype(dtype)
    stored = numbers.copy()
    stored[0, 5] = stored[1, 17] = missing
    meant = numbers.astype("f8")
    if "_Unsigned" in attributes:
        meant = numbers.view("u1").astype("f8")
    meant = meant * attributes.get("scale_factor", 1) + attributes.get("add_offset", 0)
    meant[0, 5] = meant[1, 17] = np.nan
    values = tmp_path / "values.nc"
    write(values, ds)
    with netCDF4.Dataset(values, "a") as file:
        file.set_auto_maskandscale(False)
        file.createDimension("time", 2)
        fill = attributes.get("_FillValue")
        variable = file.createVariable("t", dtype, ("time", "lat", "lon"), fill_value=fill)
        variable.set_auto_maskandscale(False)
        for name, value in attributes.items():
            if name != "_FillValue":
                variable.setncattr(name, value)
        variable[:] = stored.reshape(2, 4, 6)
    run("remap", path, "grid:90", "-o", tmp_path / "w.nc", "--quiet")
    run("apply", tmp_path / "w.nc", values, "-o", tmp_path / "out.npy", "--quiet")
    expected = rondel.read_weights(tmp_path / "w.nc").apply(meant)
    assert np.isnan(expected).any()
    assert not np.isnan(expected).all()
    found = np.load(tmp_path / "out.npy").reshape(2, -1)
    assert np.allclose(found, expected, atol=1e-13, equal_nan=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # xarray's of several missing values
        with xarray.open_dataset(values, decode_times=False) as opened:
            regridder = rondel.Regridder(opened, rondel.lonlat_grid(4, 2), "conservative")
            again = regridder(opened.t).values.reshape(2, -1)
    assert np.allclose(again, expected, atol=1e-4, equal_nan=True)


def test_units_are_those_of_udunits():
    """Held against the library, where it is installed."""
    name = ctypes.util.find_library("udunits2")
    if name is None:
        pytest.skip("no libudunits2")
    lib = ctypes.CDLL(name)
    lib.ut_read_xml.restype = lib.ut_parse.restype = lib.ut_get_converter.restype = ctypes.c_void_p
    lib.ut_set_error_message_handler(ctypes.cast(lib.ut_ignore, ctypes.c_void_p))
    lib.ut_parse.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
    lib.ut_get_converter.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    lib.cv_convert_double.argtypes = [ctypes.c_void_p, ctypes.c_double]
    lib.cv_convert_double.restype = ctypes.c_double
    system = lib.ut_read_xml(None)
    if not system:
        pytest.skip("no database of udunits2")
    degree = lib.ut_parse(system, b"degree", 0)
    roots = ["degree", "degrees", "radian", "radians", "rad", "RAD", "arc_degree", "arcdegs"]
    ends = ["", "_east", "_north", "_E", "_N", "E", "N", "_true", "T", "_west", "W", "_K", "C"]
    words = [f"{root}{end}" for root in roots for end in ends]
    words += [word.upper() for word in words] + [word.capitalize() for word in words]
    words += ["angular_degree", "arcminute", "arc_second", "gon", "gons", "grades", "m", "K", "°"]
    for word in sorted(set(words)):
        unit = lib.ut_parse(system, word.encode(), 0)
        expected = None
        if unit:
            converter = lib.ut_get_converter(unit, degree)
            if converter:
                expected = lib.cv_convert_double(converter, 1.0)
        header = [("lon", True, ["n"], [3], [("units", word)]), ("lat", True, ["n"], [3], [])]
        try:
            pairs, _ = rondel._core.find_coordinates(header, "lon", "lat", "")
            found = pairs[0][1][0]
        except ValueError:
            found = None
        assert (found is None) == (expected is None), word
        assert found is None or np.isclose(found, expected, rtol=1e-15), word


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_weight_files_are_those_of_the_tool(tmp_path):
    """With centers, masks and corners."""
    lon_b, lat_b, lon, lat = quadrilaterals()
    corners = [four(c) for c in (lon_b, lat_b)]
    corners[0][1, 2] = np.nan
    ds = xarray.Dataset()
    for name, own, values, unit in (
        ("lon", lon, corners[0], "degrees_east"),
        ("lat", lat, corners[1], "degrees_north"),
    ):
        ds[f"{name}_b"] = (("y", "x", "nv"), values)
        ds[name] = (("y", "x"), own, {"units": unit, "bounds": f"{name}_b"})
    write(tmp_path / "source.nc", ds)
    write(tmp_path / "target.nc", axes_file(np.arange(160.0, 210, 10), np.arange(10.0, -50, -20)))
    run("remap", tmp_path / "source.nc", tmp_path / "target.nc", "-o", tmp_path / "tool.nc")
    with pytest.warns(UserWarning, match="1 of 35 cells"):
        source = rondel.Partition.read(tmp_path / "source.nc")
    target = rondel.Partition.read(tmp_path / "target.nc")
    rondel.remap(source, target).to_netcdf(tmp_path / "python.nc")
    with netCDF4.Dataset(tmp_path / "tool.nc") as a, netCDF4.Dataset(tmp_path / "python.nc") as b:
        assert set(a.variables) == set(b.variables)
        assert {"xv_a", "yv_b", "mask_a"} < set(a.variables)
        assert a["mask_a"][:].sum() == 34
        for name in a.variables:
            assert np.array_equal(a[name][:].data, b[name][:].data), name


@pytest.mark.parametrize("method", ["bilinear", "nearest_s2d", "nearest_d2s", "sibson"])
def test_places_that_are_nowhere(method):
    """Swaths have NaN for longitudes and latitudes at their edges, land in models has no place."""
    lon, lat = np.meshgrid(np.linspace(0, 30, 31), np.linspace(60, 80, 21))
    values = lat.copy()
    swath = {"lon": np.where(lon > 28, np.nan, lon), "lat": np.where(lat < 62, np.nan, lat)}
    target = {"lon": np.array([[15.0, 20], [np.nan, 25]]), "lat": np.array([[70.0, 71], [72, 75]])}
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found = rondel.Regridder(swath, target, method)(values)
    nowhere = int(np.isnan(swath["lon"] + swath["lat"]).sum())
    texts = [str(warning.message) for warning in told]
    assert texts == [
        f"{nowhere} of 651 places have no longitude or latitude and are left out",
        "1 of 4 places have no longitude or latitude and are left out",
    ]
    assert {warning.filename for warning in told} == {__file__}
    assert np.isnan(found[1, 0])
    if method != "nearest_d2s":
        wanted = [70, 71, 75]
        assert np.allclose(found[[0, 0, 1], [0, 1, 1]], wanted, atol=0.1)


def test_names_are_given():
    lon, lat = np.meshgrid(np.linspace(0, 20, 21), np.linspace(-5, 5, 11))
    data = {"v": (("j", "i"), lat)}
    for name in ("u", "t"):
        data |= {f"{name}_east": (("j", "i"), lon), f"{name}_north": (("j", "i"), lat)}
    ds = xarray.Dataset(data)
    with pytest.raises(ValueError, match=r"say lon=NAME and lat=NAME, of v, u_east, u_north"):
        rondel.Regridder(ds, {"lon": [5, 6], "lat": [1, 2]}, "bilinear")
    names = {"lon": "t_east", "lat": "t_north", "lon_out": "u_east", "lat_out": "u_north"}
    found = rondel.Regridder(ds, ds, "nearest_s2d", **names)(ds)
    assert np.array_equal(found.v, lat)
    assert {"u_east", "u_north"} <= set(found.coords)
    with pytest.raises(ValueError, match=r"there is no variable 'w' \(lon=\)"):
        rondel.Regridder(ds, ds, "bilinear", lon="w")


def test_bounds_are_no_fields():
    lines = np.stack([LON_LINES[:-1], LON_LINES[1:]], -1)
    ds = xarray.Dataset(
        {"lon_bnds": (("lon", "two"), lines), "t": (("lat", "lon"), np.ones((4, 6)))},
        {
            "lon": ("lon", LON, {"units": "degrees_east", "bounds": "lon_bnds"}),
            "lat": ("lat", LAT, {"units": "degrees_north"}),
        },
    )
    assert list(rondel.Regridder(ds, OTHER, "conservative")(ds).data_vars) == ["t"]
