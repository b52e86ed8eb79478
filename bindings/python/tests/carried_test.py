# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What is carried of a Dataset, what is left out and told, and data that share a dimension."""

import warnings

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402 (needs xarray)

LON, LAT = np.arange(0.0, 360, 15), np.arange(-82.5, 90, 15)
POINTS = {"lon": ("place", [1.0, 50, 200]), "lat": ("place", [5.0, -40, 88])}
TARGET = xarray.Dataset({}, POINTS)


def dataset(times=2, **variables):
    heights = np.add.outer(np.arange(times), LAT[:, None] + 0 * LON)
    made = xarray.Dataset(
        {"t": (("time", "lat", "lon"), heights)},
        {"lon": LON, "lat": LAT, "time": np.arange(times, dtype=float)},
    )
    return made.assign(variables)


def by_accessor(data, target=TARGET):
    return data.rondel.interpolate(target, "linear")


def by_regridder(data, target=TARGET):
    return rondel.Regridder(data, target, "bilinear")(data)


WAYS = pytest.mark.parametrize("carry", [by_accessor, by_regridder])
EVERYWHERE = ("lat", "lon")


@WAYS
def test_variables_that_are_left_out_are_told(carry):
    shape = (len(LAT), len(LON))
    data = dataset(
        name=(EVERYWHERE, np.full(shape, "a")),
        day=(EVERYWHERE, np.full(shape, np.datetime64("2000-01-01", "ns"))),
        thing=(EVERYWHERE, np.full(shape, None, object)),
        zonal=(("time", "lat"), np.zeros((2, len(LAT)))),
        along=("lon", LON),
        step=("time", [1, 2]),
        number=3.0,
    )
    with pytest.warns(UserWarning, match="left out") as told:
        found = carry(data)
    assert list(found.data_vars) == ["t", "step", "number"]
    texts = [str(warning.message) for warning in told]
    assert texts == [
        "left out, as they are no real numbers: name, day, thing",
        "left out, as they have only some of the dimensions lat, lon: zonal, along",
    ]
    assert {warning.filename for warning in told} == {__file__}


@WAYS
def test_variables_are_not_listed_for_each_of_them(carry, monkeypatch):
    def number_of_lists(num_fields):
        lists = []

        def counted(data, of=rondel._coordinates._headers):
            lists.append(data)
            return of(data)

        more = {f"f{k}": (EVERYWHERE, np.full((len(LAT), len(LON)), k)) for k in range(num_fields)}
        series = {f"s{k}": ("time", [k, k]) for k in range(num_fields)}
        with monkeypatch.context() as patch:
            patch.setattr(rondel._coordinates, "_headers", counted)
            heights = {f"h{k}": (f"h{k}", [1.0]) for k in range(num_fields)}
            found = carry(dataset(**more, **series).assign_coords(heights))
        assert list(found.data_vars) == ["t", *more, *series]
        assert all(np.allclose(found[name], k) for k, name in enumerate(more))
        return len(lists)

    # A list takes a time that grows with the number of variables.
    assert number_of_lists(60) == number_of_lists(3)


@WAYS
@pytest.mark.parametrize("of", ["Dataset", "DataArray"])
def test_coordinates_of_the_places_that_are_left_out_are_told(carry, of):
    shape = (len(LAT), len(LON))
    data = dataset().assign_coords(
        area=(EVERYWHERE, np.ones(shape)),
        zone=("lat", list("abcdefghijkl")),
        run=7,
        day=("time", ["a", "b"]),
        lon_bnds=(("lon", "two"), LON[:, None] + [-7.5, 7.5]),
    )
    data.lon.attrs["bounds"] = "lon_bnds"
    data = data if of == "Dataset" else data.t
    regridder = rondel.Regridder({"lon": LON, "lat": LAT}, TARGET, "bilinear")
    with pytest.warns(UserWarning, match=r"coordinates of the source's places .*: area, zone$"):
        found = carry(data)
    with pytest.warns(UserWarning, match=": area, zone$"):
        regridder(data)
    assert {"run", "day", "time"} <= set(found.coords)
    assert not {"area", "zone", "lon_bnds"} & set(found.coords)


@WAYS
def test_what_is_no_field_is_not_told(carry):
    data = dataset(lat_bnds=(("lat", "two"), np.stack([LAT - 7.5, LAT + 7.5], axis=1)))
    data["lat"].attrs = {"bounds": "lat_bnds", "units": "degrees_north"}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert list(carry(data).data_vars) == ["t"]


@WAYS
def test_booleans_are_numbers(carry):
    is_north = xarray.DataArray(LAT[:, None] + 0 * LON > 0, dims=EVERYWHERE)
    data = dataset(north=is_north)
    found = carry(data).north
    assert found.dtype == np.float64
    assert np.allclose(found.values[1:], [0, 1], atol=1e-12)
    assert 0 < found.values[0] < 1
    alone = data.north.rondel.interpolate(TARGET, "linear")
    assert np.array_equal(by_accessor(data).north, alone)


def test_data_without_the_dimensions_of_the_source_are_refused():
    regridder = rondel.Regridder(dataset(), TARGET, "bilinear")
    with pytest.raises(ValueError, match="the data have no dimension lat and no lon, which the"):
        regridder(dataset().rename(lat="y", lon="x"))
    with pytest.raises(ValueError, match="'t' and the source differ in the length of lon: 23, 24"):
        regridder(dataset().isel(lon=slice(1, None)))


@pytest.mark.parametrize("name", ["lon", "lat"])
def test_gaps_of_axes_are_told(name):
    data = dataset()
    axis = data[name].values.copy()
    axis[-1] = np.nan
    data = data.assign_coords({name: axis})
    count = 288 // len(axis)
    with pytest.warns(UserWarning, match=f"{count} of 288 places have no longitude or latitude"):
        found = by_accessor(data)
    kept = by_accessor(dataset().isel({name: slice(None, -1)}))
    assert np.array_equal(found.t, kept.t, equal_nan=True)


@WAYS
@pytest.mark.parametrize("times", [1, 2, 3])
def test_tracks_with_the_time_of_the_data_are_refused(carry, times):
    track = TARGET.rename(place="time")
    for data in (dataset(times), dataset(times).t):
        with pytest.raises(ValueError, match="'t' and the targets both have the dimension 'time'"):
            carry(data, track)
    # As the message says.
    found = carry(dataset(times), track.rename(time="place"))
    assert found.t.dims == ("time", "place")
    # Fields without time have no such question.
    assert carry(dataset(times).t[0].drop_vars("time"), track).dims == ("time",)


@WAYS
def test_dimensions_of_the_targets_are_not_mixed_up(carry):
    data = dataset(3, step=("time", [1, 2, 3])).isel(time=0, drop=True)
    data = data.assign(step=("time", [1, 2, 3])).assign_coords(time=[10, 20, 30])
    track = TARGET.rename(place="time")
    with pytest.warns(UserWarning, match="left out, as the targets have another dimension time: s"):
        found = carry(data, track)
    assert list(found.data_vars) == ["t"]
    assert "time" not in found.coords
    # The times of the track are those of the data.
    found = carry(data, track.assign_coords(time=[10, 20, 30]))
    assert found.step.values.tolist() == [1, 2, 3]


@WAYS
def test_data_of_no_time(carry):
    found = carry(dataset(0))
    assert found.t.shape == (0, 3)
    assert carry(dataset(0).t).shape == (0, 3)
    dask = pytest.importorskip("dask.array")
    lazy = carry(dataset(0).chunk())
    assert isinstance(lazy.t.data, dask.Array)
    assert lazy.t.values.shape == (0, 3)


def test_arrays_of_no_time():
    regridder = rondel.Regridder({"lon": LON, "lat": LAT}, TARGET, "bilinear")
    assert regridder(np.zeros((0, 12, 24))).shape == (0, 3)
    assert regridder(np.zeros((2, 0, 12, 24))).shape == (2, 0, 3)


def pop():
    """Two kinds of points along the same dimensions; each variable says which are its own."""
    lon, lat = np.meshgrid(np.arange(0.0, 360, 30), np.arange(-75.0, 76, 30))
    grid = ("y", "x")
    return xarray.Dataset(
        {
            "temp": (grid, np.cos(np.radians(lon)), {"coordinates": "TLONG TLAT"}),
            "wind": (grid, np.cos(np.radians(lon + 15)), {"coordinates": "ULONG ULAT"}),
            "depth": (grid, np.ones_like(lon)),
        },
        {
            name: (grid, values, {"units": units})
            for name, values, units in (
                ("TLONG", lon, "degrees_east"),
                ("TLAT", lat, "degrees_north"),
                ("ULONG", lon + 15, "degrees_east"),
                ("ULAT", lat + 10, "degrees_north"),
            )
        },
    )


@pytest.mark.parametrize(
    ("kind", "names", "away"), [("T", ["temp", "depth"], "wind"), ("U", ["wind", "depth"], "temp")]
)
def test_variables_are_at_the_places_that_their_own_attribute_names(kind, names, away):
    data = pop()
    lon, lat = f"{kind}LONG", f"{kind}LAT"
    target = (data[lon].values, data[lat].values)
    with pytest.warns(UserWarning, match=f"are not those of the source: {away}$"):
        found = data.rondel.interpolate(target, lon=lon, lat=lat, method="nearest")
    assert list(found.data_vars) == names
    np.testing.assert_array_equal(found[names[0]].values, data[names[0]].values)


def test_the_same_places_under_other_names_are_no_other_places():
    data = pop()
    data["wind"].attrs["coordinates"] = "ULONG ULAT"
    data["ULONG"], data["ULAT"] = data["TLONG"] + 360, data["TLAT"]
    data["ULONG"].attrs["units"], data["ULAT"].attrs["units"] = "degrees_east", "degrees_north"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = data.rondel.interpolate(TARGET, lon="TLONG", lat="TLAT")
    assert list(found.data_vars) == ["temp", "wind", "depth"]


def test_what_describes_a_mesh_is_no_field():
    rng = np.random.default_rng(5)
    lon, lat = rng.uniform(0, 6, 12), rng.uniform(-1.5, 1.5, 12)
    data = xarray.Dataset(
        {
            "lonCell": ("nCells", lon),
            "latCell": ("nCells", lat),
            "xCell": ("nCells", np.cos(lon)),
            "nEdgesOnCell": ("nCells", np.full(12, 6)),
            "verticesOnCell": (("nCells", "maxEdges"), np.ones((12, 6), int)),
            "cellsOnEdge": (("nEdges", "TWO"), np.ones((5, 2), int)),
            "areaCell": ("nCells", np.ones(12)),
            "t": ("nCells", np.ones(12)),
        }
    )
    with pytest.warns(UserWarning, match="areas or volumes of cells: areaCell$") as told:
        found = data.rondel.interpolate(TARGET)
    assert len(told) == 1
    assert list(found.data_vars) == ["t"]
    data.attrs["on_a_sphere"] = "NO              "
    with pytest.raises(ValueError, match="in the plane: on_a_sphere is NO"):
        data.rondel.interpolate(TARGET)
    found = data.rondel.interpolate(TARGET, lon="lonCell", lat="latCell")
    assert "t" in found


def test_rotated_coordinates_are_no_places():
    data = dataset()
    data["lon"].attrs.update(standard_name="grid_longitude", units="degrees_east")
    data["lat"].attrs.update(standard_name="grid_latitude", units="degrees_north")
    with pytest.raises(ValueError, match="no coordinate has the"):
        data.rondel.interpolate(TARGET)
    with pytest.raises(ValueError, match="rotated pole or a projection"):
        data.rondel.interpolate(TARGET, lon="lon", lat="lat")


@WAYS
def test_what_is_on_other_parts_of_a_mesh_is_told(carry):
    data = dataset(
        of_edges=(("time", "nEdges"), np.zeros((2, 7))),
        u=(("eta_u", "xi_u"), np.zeros((3, 4))),
        said=("parts", np.zeros(9), {"mesh": "m", "location": "edge"}),
        series=("time", [1.0, 2]),
        time_bnds=(("time", "bnds"), np.zeros((2, 2))),
    )
    with pytest.warns(UserWarning, match="left out") as told:
        found = carry(data)
    assert [str(warning.message) for warning in told] == [
        "left out, as they are at other places than the source: of_edges, u, said"
    ]
    assert list(found.data_vars) == ["t", "series", "time_bnds"]


@WAYS
@pytest.mark.parametrize("attribute", ["bounds", "climatology"])
def test_bounds_of_times_stay(carry, attribute):
    bounds = np.stack([np.arange(2) - 0.5, np.arange(2) + 0.5], axis=1)
    data = dataset(
        time_bnds=(("time", "two"), bounds),
        lat_bnds=(("lat", "two"), np.stack([LAT - 7.5, LAT + 7.5], axis=1)),
    )
    data.time.attrs[attribute] = "time_bnds"
    data.lat.attrs["bounds"] = "lat_bnds"
    found = carry(data)
    np.testing.assert_array_equal(found.time_bnds, bounds)
    assert found.time_bnds.dims == ("time", "two")
    assert "lat_bnds" not in found.variables


@WAYS
def test_a_mesh_that_is_left_is_not_named(carry):
    lon, lat = np.meshgrid(LON, LAT)
    topology = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "nx ny"}
    data = xarray.Dataset(
        {
            "mesh": ((), 0, topology | {"face_coordinates": "fx fy"}),
            "t": ("face", lat.ravel(), {"mesh": "mesh", "location": "face"}),
        },
        {
            "fx": ("face", lon.ravel(), {"units": "degrees_east"}),
            "fy": ("face", lat.ravel(), {"units": "degrees_north"}),
        },
    )
    found = data.pipe(carry)
    assert "mesh" not in found.variables
    assert not {"mesh", "location"} & set(found.t.attrs)
