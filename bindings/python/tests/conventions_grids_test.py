# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Grids along lines and curved ones: the same cells and weights from tool, file and Dataset."""

import itertools
import warnings

import numpy as np
import pytest
from netcdf_cases import (
    DEGREES,
    LAT,
    LAT_LINES,
    LON,
    LON_LINES,
    NORTH,
    RADIANS,
    TOOL,
    check,
    four,
    polygon_area,
    quadrilaterals,
    rectangles,
    write,
    xarray,
)

import rondel


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
        # The cells that the reader should find.
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
        assert np.allclose(rondel.CellSet.read(path).areas, first.ravel())
    lines = np.arange(-45.0, 316, 90), np.array([-90.0, -30, 30, 90])
    second = rectangles(lines[0][:-1], lines[0][1:], lines[1][:-1], lines[1][1:])
    for name in ("slon", "slat", "u"):
        check(path, None, second, tmp_path, name=name)
    check(path, ds[["t", "lon_bnds", "lat_bnds"]], first, tmp_path, name="t")
    with pytest.raises(OSError, match='no variable "nothing"'):
        rondel.CellSet.read(f"{path}:nothing")


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
        rondel.CellSet.read(path)
