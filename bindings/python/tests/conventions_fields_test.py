# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Values in files: dimensions in any order, what is missing, where they are."""

import ctypes
import ctypes.util
import itertools
import subprocess
import warnings

import numpy as np
import pytest
from netcdf_cases import (
    LAT,
    LON,
    LON_LINES,
    OTHER,
    TOOL,
    axes_file,
    four,
    netCDF4,
    quadrilaterals,
    run,
    write,
    xarray,
)

import rondel

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
        header = [
            ("lon", True, ["n"], [3], [("units", word)], False),
            ("lat", True, ["n"], [3], [], False),
        ]
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
        source = rondel.CellSet.read(tmp_path / "source.nc")
    target = rondel.CellSet.read(tmp_path / "target.nc")
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


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_files_of_weights_have_the_properties_of_polygons(tmp_path):
    """Of a file as the tool writes them, and of a GeoDataFrame."""
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    frame = geopandas.GeoDataFrame(
        {"name": ["Élan", 'a,"b"', None], "size": [1.5, np.nan, -3.0]},
        geometry=[shapely.box(west, 0, west + 20, 30) for west in (0, 20, 50)],
        crs=4326,
    )
    path = tmp_path / "regions.geojson"
    frame.to_file(path, driver="GeoJSON")
    run("remap", "grid:30", path, "-o", tmp_path / "tool.nc", "--quiet")
    tables = []
    for regions in (None, path, frame):
        name = tmp_path / "tool.nc"
        if regions is not None:
            name = tmp_path / "python.nc"
            rondel.remap(rondel.lonlat_grid(12, 6), rondel.polygons(regions)).to_netcdf(name)
        with netCDF4.Dataset(name) as file:
            tables.append(file.rondel_target_table)
    assert tables[0].splitlines() == ["name,size", "Élan,1.5", '"a,""b""",""', '"",-3.0']
    assert tables[0] == tables[1] == tables[2]


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_weights_of_each_method_pass_the_check(tmp_path):
    source = {"lon": np.arange(0.0, 50, 5), "lat": np.arange(0.0, 40, 5)}
    target = {"lon": np.arange(2.0, 40, 12), "lat": np.arange(3.0, 33, 9)}
    for method in ("bilinear", "nearest_s2d", "nearest_d2s", "conservative", "sibson"):
        path = tmp_path / f"{method}.nc"
        regridder = rondel.Regridder(source, target, method)
        regridder.to_netcdf(path)
        run("check-weights", path)
    # 80 sources for 16 targets.
    assert rondel.Regridder(source, target, "nearest_d2s").weights.apply(np.ones(80)).sum() == 80


@pytest.mark.parametrize("missing", [np.nan, 1e20, -999.0])
@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_sites_without_a_place_are_left_out(tmp_path, missing):
    """Of curved grids: at the edges of swaths, on land. Undeclared ones are refused."""
    lon, lat = np.meshgrid(np.linspace(0, 30, 31), np.linspace(60, 80, 21))
    values = np.arange(3.0)[:, None, None] * 1000 + lon + 40 * lat
    nowhere = (lon > 28) | (lat < 62)
    targets = np.array([[29.9, 70.0], [15.2, 60.1], [3.1, 77.2]])
    nearest = np.array([[28.0, 70.0], [15.0, 62.0], [3.0, 77.0]])
    np.save(tmp_path / "to.npy", targets)
    expected = np.arange(3.0)[:, None] * 1000 + nearest[:, 0] + 40 * nearest[:, 1]
    for is_declared, dims in itertools.product((True, False), itertools.permutations("tyx")):
        fill = missing if is_declared else None
        path = tmp_path / "swath.nc"
        with netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC") as file:
            for name, size in (("t", 3), ("y", 21), ("x", 31)):
                file.createDimension(name, size)
            for name, places, unit in (("lon", lon, "east"), ("lat", lat, "north")):
                variable = file.createVariable(name, "f8", ("y", "x"), fill_value=fill)
                variable.set_auto_mask(False)
                variable.units = f"degrees_{unit}"
                variable[:] = np.where(nowhere, missing, places)
            variable = file.createVariable("v", "f8", dims)
            variable.coordinates = "lon lat"
            variable[:] = values.transpose(["tyx".index(name) for name in dims])
        command = ["interpolate", f"{path}:v", "--to", tmp_path / "to.npy", "--method", "nearest"]
        command += ["-o", tmp_path / "out.npy", "--quiet"]
        if is_declared or np.isnan(missing):
            text = f"{nowhere.sum()} of 651 places have no longitude or latitude and are left out"
            assert text in run(*command)
            assert np.array_equal(np.load(tmp_path / "out.npy"), expected)
        else:
            found = subprocess.run([TOOL, *map(str, command)], capture_output=True, text=True)
            assert found.returncode == 1
            assert "which is no place" in found.stderr


@pytest.mark.skipif(TOOL is None, reason="needs the tool")
def test_a_field_on_another_grid_brings_its_own_places(tmp_path):
    fine = {"lon": np.arange(-178.0, 180, 4), "lat": np.arange(-88.0, 90, 4)}
    ds = axes_file(np.arange(30.0, 360, 60), np.arange(-67.5, 90, 45))
    ds["s"] = (("lat", "lon"), np.zeros((4, 6)))
    for name, unit in (("lon", "degrees_east"), ("lat", "degrees_north")):
        ds[f"{name}_2"] = (f"{name}_2", fine[name], {"units": unit})
    ds["t"] = (("lat_2", "lon_2"), fine["lat"][:, None] + fine["lon"])
    path = tmp_path / "two.nc"
    write(path, ds)
    np.save(tmp_path / "to.npy", [[10.0, 20.0], [-100.0, -30.0]])
    for source, more in ((f"{path}:t", ()), (path, ("--value", "t"))):
        command = ["interpolate", source, *more, "--to", tmp_path / "to.npy", "--method", "linear"]
        run(*command, "-o", tmp_path / "out.npy", "--quiet")
        assert np.allclose(np.load(tmp_path / "out.npy"), [30, -130], atol=0.5)
