# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Attributes of what is carried: those that no longer hold are left out, as files lose them, and
what is read of the result is what was computed.
"""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
import rondel.xarray  # noqa: E402 (needs xarray)

LON, LAT = np.arange(-180.0, 180, 20) + 10, np.arange(-90.0, 90, 20) + 10
SHAPE = len(LAT), len(LON)
KINDS = np.add.outer(np.arange(SHAPE[0]) // 2, np.arange(SHAPE[1]) // 3) % 2
FLAGS = {"flag_values": np.array([0, 1], np.int8), "flag_meanings": "sea land"}
POINTS = xarray.Dataset({}, {"lon": ("place", [1.0, 50, 170]), "lat": ("place", [5.0, -40, 88])})


def dataset(**attrs):
    return xarray.Dataset(
        {"kind": (("lat", "lon"), KINDS.astype(float), {"long_name": "a mask", **attrs})},
        {
            "lat": ("lat", LAT, {"units": "degrees_north"}),
            "lon": ("lon", LON, {"units": "degrees_east"}),
        },
    )


@pytest.mark.parametrize("end", ["nc", "nc4"])
@pytest.mark.parametrize(
    "options", [{}, {"statistics": "mean"}, {"method": "linear"}], ids=["cells", "zones", "places"]
)
def test_shares_of_booleans_are_read_as_numbers(tmp_path, end, options):
    data = dataset()
    data["kind"] = data.kind.astype(bool)
    pytest.importorskip("netCDF4")
    data.to_netcdf(tmp_path / "in.nc")
    out = tmp_path / f"out.{end}"
    rondel.regrid_file(tmp_path / "in.nc", "grid:30", out, **options)
    with xarray.open_dataset(out) as file:
        (found,) = file.data_vars.values()
        assert found.dtype.kind == "f"
        assert ((found > 0) & (found < 1)).any()
        if options != {"statistics": "mean"}:
            own = rondel.regrid(data, "grid:30", **options)
            np.testing.assert_allclose(found, own.kind, atol=1e-6)
            assert "dtype" not in own.kind.attrs
    # As another reader than xarray finds it in the file.
    made = rondel.regrid(dataset(dtype="bool"), "grid:30")
    assert made.kind.attrs == {"long_name": "a mask", "cell_methods": "area: mean"}


MEANS = [
    lambda data: rondel.regrid(data, "grid:30", "conservative"),
    lambda data: rondel.regrid(data, "grid:30", "linear"),
    lambda data: rondel.Regridder(data, POINTS, "bilinear")(data, keep_attrs=True),
    lambda data: rondel.Regridder(data, POINTS, "nearest_s2d", extrap_method="idw")(
        data, keep_attrs=True
    ),
    lambda data: data.rondel.interpolate(POINTS, "linear"),
]
CHOICES = [
    lambda data: rondel.regrid(data, "grid:30"),
    lambda data: rondel.regrid(data, "grid:30", "largest_share"),
    lambda data: rondel.regrid(data, "grid:30", "nearest"),
    lambda data: rondel.Regridder(data, POINTS, "nearest_s2d")(data, keep_attrs=True),
    lambda data: rondel.Regridder(data, "grid:30", "conservative")(
        data, keep_attrs=True, how="by_kind"
    ),
    lambda data: data.rondel.interpolate(POINTS, "nearest"),
]


@pytest.mark.parametrize(
    ("carry", "kept"), [(way, set()) for way in MEANS] + [(way, {*FLAGS}) for way in CHOICES]
)
def test_flags_are_those_of_values_of_sources(carry, kept):
    data = dataset(**FLAGS, minimum=0.0, valid_count=162)
    for made in (carry(data).kind, carry(data.kind)):
        assert {*made.attrs} - {"cell_methods"} == {"long_name", *kept}
        assert not kept or np.isin(made.values[np.isfinite(made.values)], [0, 1]).all()


def test_a_dataset_does_not_tell_of_another_grid():
    data = dataset(stagger="X")
    kept = {"title": "x", "geospatial_vertical_min": 0.0}
    data.attrs = {"featureType": "timeSeries", "geospatial_lat_min": -90.0, "DX": 9000.0, **kept}
    made = rondel.regrid(data, "grid:30")
    assert {*made.attrs} - {"rondel_grid"} == {*kept}
    assert "stagger" not in made.kind.attrs


@pytest.mark.parametrize("is_array", [False, True])
@pytest.mark.parametrize(
    "way",
    [
        lambda given: rondel.regrid(given, "grid:30"),
        lambda given: rondel.regrid(dataset(), given),
        lambda given: rondel.Regridder(given, POINTS, "bilinear"),
        lambda given: given.rondel.interpolate(POINTS, "nearest"),
    ],
)
def test_longitudes_of_another_meridian_are_refused(way, is_array):
    def with_meridian(number):
        mapping = {
            "grid_mapping_name": "latitude_longitude",
            "longitude_of_prime_meridian": number,
        }
        given = dataset(grid_mapping="crs").assign_coords(crs=((), 0, mapping))
        return given.kind if is_array else given

    way(with_meridian(0.0))
    text = "longitudes count from the meridian at 106.5 degrees east of Greenwich"
    with pytest.raises(ValueError, match=text):
        way(with_meridian(106.5))


def test_corners_that_are_made_are_told_by_the_data_and_the_file(tmp_path):
    lon, lat = np.meshgrid(np.arange(0.0, 50, 5), np.arange(-20.0, 25, 5))
    places = {
        "lon": (("y", "x"), lon, {"units": "degrees_east"}),
        "lat": (("y", "x"), lat, {"units": "degrees_north"}),
    }
    data = xarray.Dataset({"t": (("y", "x"), lon + lat)}, places)
    data.to_netcdf(tmp_path / "in.nc", engine="scipy")
    rondel.regrid_file(tmp_path / "in.nc", "grid:30", tmp_path / "out.nc", corners="made")
    with pytest.warns(UserWarning, match="half way"):
        own = rondel.regrid(data, "grid:30", corners="made")
    with xarray.open_dataset(tmp_path / "out.nc") as file:
        assert own.attrs["source_corners"] == file.attrs["source_corners"]
    assert "target_corners" not in own.attrs
    with pytest.warns(UserWarning, match="half way"):
        other = rondel.regrid(dataset(), data, "conservative", corners="made")
    assert "source_corners" not in other.attrs
    assert other.attrs["target_corners"] == own.attrs["source_corners"]


def test_edges_of_polygons_need_polygons(tmp_path):
    dataset().to_netcdf(tmp_path / "in.nc", engine="scipy")
    with pytest.raises(rondel.InvalidInput, match="edges have no effect without polygons"):
        rondel.regrid_file(tmp_path / "in.nc", "grid:30", tmp_path / "out.nc", edges="geodesic")
