# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Statistics over polygons, against NumPy on exact areas of boxes."""

import numpy as np
import pytest

import rondel

xarray = pytest.importorskip("xarray")
pandas = pytest.importorskip("pandas")

LON, LAT = np.arange(-177.5, 180, 5), np.arange(-87.5, 90, 5)
NAMES = (
    "mean sum count min max fraction variance stdev median quantile:0.1 majority minority variety"
)


@pytest.fixture
def data():
    values = np.random.default_rng(3).integers(0, 7, (2, 36, 72)).astype(float)
    values[:, 20, 40] = np.nan
    return xarray.DataArray(
        values, {"time": [10, 20], "lat": LAT, "lon": LON}, ("time", "lat", "lon"), name="t"
    )


BOXES = [(-30.0, -20.0, 42.0, 33.0), (21.0, 12.0, 28.0, 14.0), (100.0, 40.0, 180.0, 90.0)]


def shares(box):
    """Of each cell the share in a box between meridians and parallels; and the cells' areas."""
    west, south, east, north = box
    height = np.sin(np.radians(np.clip(LAT + 2.5, south, north))) - np.sin(
        np.radians(np.clip(LAT - 2.5, south, north))
    )
    whole = np.sin(np.radians(LAT + 2.5)) - np.sin(np.radians(LAT - 2.5))
    width = np.clip(LON + 2.5, west, east) - np.clip(LON - 2.5, west, east)
    return np.outer(height / whole, width / 5), np.outer(whole, np.full(72, np.radians(5)))


def expected(field, box, by_fraction):
    """All statistics of a field, by NumPy."""
    f, areas = shares(box)
    of_box = (f * areas).sum()
    kept = (f > 1e-12) & ~np.isnan(field)
    v, f, w = field[kept], f[kept], (f * (1 if by_fraction else areas))[kept]
    mean = (w * v).sum() / w.sum()
    variance = (w * (v - mean) ** 2).sum() / w.sum()
    order = np.lexsort((w, v))
    sorted_v, sorted_w = v[order], w[order]
    n = len(v)
    s = np.arange(n) * sorted_w + (n - 1) * (np.cumsum(sorted_w) - sorted_w)

    def quantile(q):
        return np.interp(q * s[-1], s, sorted_v)

    values = np.unique(v)
    weights = np.array([w[v == value].sum() for value in values])
    return {
        "mean": mean,
        "sum": (f * v).sum(),
        "count": f.sum(),
        "min": v.min(),
        "max": v.max(),
        "fraction": (f * areas[kept]).sum() / of_box,
        "variance": variance,
        "stdev": np.sqrt(variance),
        "median": quantile(0.5),
        "quantile_0.1": quantile(0.1),
        "majority": values[weights.argmax()],
        "minority": values[weights.argmin()],
        "variety": len(values),
    }


def as_grids():
    """The boxes as cells between parallels."""
    return [rondel.CellSet.lonlat_grid(box[::2], box[1::2]) for box in BOXES]


def as_polygons():
    """The boxes as polygons."""
    return [[box_polygon(*box)] for box in BOXES]


def polygon(*ring):
    return {"type": "Polygon", "coordinates": [[*map(list, ring), list(ring[0])]]}


def box_polygon(west, south, east, north):
    return polygon((west, south), (east, south), (east, north), (west, north))


@pytest.mark.parametrize("weights", ["area", "fraction"])
@pytest.mark.parametrize("make", [as_grids, as_polygons])
def test_all_statistics_are_those_of_numpy(data, weights, make):
    for box, zone in zip(BOXES, make(), strict=True):
        table = rondel.zonal_statistics(data, zone, NAMES.split(), weights=weights)
        assert list(table.index) == [(0, 10), (0, 20)]
        assert table.index.names == ["zone", "time"]
        for time in (0, 1):
            wanted = expected(data.values[time], box, weights == "fraction")
            assert list(table.columns) == list(wanted)
            for name, value in wanted.items():
                assert table[name].iloc[time] == pytest.approx(value, rel=1e-12), (name, box)


@pytest.mark.parametrize("step", [0.1, 0.01])
def test_boxes_along_cells_have_no_other_cells(step):
    n, m = round(4 / step), round(0.2 / step)
    lon, lat = (np.arange(n) + 0.5) * step, 45 + (np.arange(m) + 0.5) * step
    field = np.where(lat < 45.1, 1.0, 999.0)[:, None] * np.ones(n)
    field = xarray.DataArray(field, {"lat": lat, "lon": lon}, ("lat", "lon"))
    boxes = [
        box_polygon(0, 45, 4, 45.1),
        box_polygon(0, 45.1 - step, 4, 45.1),
        box_polygon(0.5, 44.5, 2, 45.1),
    ]
    table = rondel.zonal_statistics(field, boxes, "mean,max,variety,count", max_missing=1)
    np.testing.assert_allclose(table[["mean", "max", "variety"]], 1, rtol=1e-12)
    counts = [n * round(0.1 / step), n, round(1.5 / step) * round(0.1 / step)]
    np.testing.assert_allclose(table["count"], counts, rtol=1e-9)
    # Each box is the same alone.
    for k, box in enumerate(boxes):
        alone = rondel.zonal_statistics(field, [box], "mean,max,variety,count", max_missing=1)
        np.testing.assert_allclose(table.iloc[[k]], alone, rtol=1e-12)
    half = rondel.remap(
        rondel.CellSet.lonlat_centers(lon, lat), rondel.polygons([box_polygon(-4, 45, 4, 45.2)])
    )
    assert half.target_fractions == pytest.approx([0.5], abs=1e-12)


def test_slanted_sides_are_straight_in_longitude_and_latitude():
    """Against strips of latitude that NumPy sums, for a triangle across the antimeridian."""
    lat = np.arange(50.005, 60, 0.01)
    lon = np.arange(175.05, 186, 0.1)
    field = np.sin(np.arange(lat.size))[:, None] + np.cos(np.arange(lon.size))
    data = xarray.DataArray(field, {"lat": lat, "lon": lon}, ("lat", "lon"))
    corners = [(176.0, 51.0), (185.0, 54.0), (178.0, 59.0)]
    mean = rondel.zonal_statistics(data, [polygon(*corners)])["mean"].iloc[0]
    # At a latitude the triangle is between the long side and one of the two others.
    fine = 51 + (np.arange(400_000) + 0.5) * (8 / 400_000)
    west = np.interp(fine, [51, 59], [176, 178])
    east = np.interp(fine, [51, 54, 59], [176, 185, 178])
    weights = np.zeros(field.shape)
    row = ((fine - 50) / 0.01).astype(int)
    for column, center in enumerate(lon):
        width = np.clip(np.minimum(east, center + 0.05) - np.maximum(west, center - 0.05), 0, None)
        weights[:, column] = np.bincount(row, width * np.cos(np.radians(fine)), minlength=lat.size)
    assert mean == pytest.approx((weights * field).sum() / weights.sum(), rel=1e-8)


def test_zones_keep_their_index_and_columns(data):
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    frame = geopandas.GeoDataFrame(
        {"name": ["a", "b", "c"], "code": [7, 8, 9]},
        geometry=[shapely.box(0, 0, 20, 20), shapely.box(10, 10, 30, 30), shapely.Polygon()],
        crs="EPSG:4326",
    ).set_index("code")
    table = rondel.zonal_statistics(data, frame, "mean,count", include_cols=["name"])
    assert table.index.names == ["code", "time"]
    assert list(table.index) == [(7, 10), (7, 20), (8, 10), (8, 20), (9, 10), (9, 20)]
    assert list(table["name"]) == ["a", "a", "b", "b", "c", "c"]
    assert list(table.columns) == ["name", "mean", "count"]
    # Zones overlap: each is what it is alone.
    for k in (0, 1):
        alone = rondel.zonal_statistics(data, frame.iloc[[k]], "mean,count")
        rows = slice(2 * k, 2 * k + 2)
        np.testing.assert_allclose(
            table[["mean", "count"]].to_numpy()[rows], alone.to_numpy(), rtol=1e-12
        )
    assert np.isnan(table["mean"].to_numpy()[4:]).all()
    assert (table["count"].to_numpy()[4:] == 0).all()
    with pytest.raises(ValueError, match="overlap"):
        rondel.zonal_statistics(data, frame, overlap="error")
    frame = frame.rename(columns={"name": "mean"})
    for columns, message in (
        ("mean", "include_cols: 'mean' is the name of a statistic's column, too"),
        ("nope", "include_cols: the zones have no column 'nope', but 'mean', 'geometry'"),
        (["geometry", "geometry"], "include_cols has the column 'geometry' twice"),
    ):
        with pytest.raises(ValueError, match=message):
            rondel.zonal_statistics(data, frame, "mean", include_cols=columns)
    table = rondel.zonal_statistics(data, frame, "max", include_cols="mean")
    assert list(table.columns) == ["mean", "max"]


def test_fields_without_other_dimensions_have_a_row_for_each_zone(data):
    table = rondel.zonal_statistics(data[0], "grid:90", "max,variety")
    assert table.shape == (8, 2)
    assert table.index.name == "zone"
    blocks = data.values[0].reshape(2, 18, 4, 18)
    np.testing.assert_array_equal(table["max"], np.nanmax(blocks, axis=(1, 3)).ravel())


def test_datasets_have_columns_for_each_variable(data):
    dataset = xarray.Dataset({"t": data, "height": data[0] * 2})
    table = rondel.zonal_statistics(dataset, "grid:90", "mean,max")
    assert list(table.columns) == ["t_mean", "t_max", "height_mean", "height_max"]
    assert table.index.names == ["zone", "time"]
    assert (table["height_max"] == 2 * np.repeat(table["t_max"].to_numpy()[::2], 2)).all()


def test_other_variables_are_left_out_and_numbers_of_any_type_are_taken(data):
    kept = data[0].fillna(0)
    dataset = xarray.Dataset(
        {
            "single": kept.astype("f4"),
            "whole": kept.astype("i2"),
            "text": (("lat", "lon"), np.full((36, 72), "a")),
            "name": ((), "a file"),
        }
    )
    with pytest.warns(UserWarning, match="left out, as they are no real numbers: text"):
        table = rondel.zonal_statistics(dataset, "grid:90", "mean,majority")
    assert list(table.columns) == ["single_mean", "single_majority", "whole_mean", "whole_majority"]
    np.testing.assert_array_equal(table["single_mean"], table["whole_mean"])
    assert (table.dtypes == np.float64).all()


def test_a_mask_is_a_field_here(data):
    dataset = xarray.Dataset({"t": data[0], "mask": data[0] * 0})
    wanted = rondel.zonal_statistics(dataset[["t"]], "grid:90", "mean,count")
    with pytest.warns(UserWarning, match="'mask' of the data masks nothing here"):
        table = rondel.zonal_statistics(dataset, "grid:90", "mean,count")
    assert list(table.columns) == ["t_mean", "t_count", "mask_mean", "mask_count"]
    np.testing.assert_array_equal(table[["t_mean", "t_count"]], wanted)
    with pytest.warns(UserWarning, match="mask"):
        table = rondel.zonal_statistics(dataset.set_coords("mask").t, "grid:90", "mean,count")
    np.testing.assert_array_equal(table, wanted)


def test_arrays_of_dask_give_the_same(data):
    pytest.importorskip("dask")
    whole = rondel.zonal_statistics(data, "grid:90", "mean,max")
    lazy = rondel.zonal_statistics(data.chunk({"time": 1}), "grid:90", "mean,max")
    pandas.testing.assert_frame_equal(whole, lazy)


def test_work_of_dask_can_be_sent_to_other_processes(data):
    dask = pytest.importorskip("dask")
    cloudpickle = pytest.importorskip("cloudpickle")  # as Dask does
    sent = []

    def elsewhere(graph, keys, **_):
        sent.append(cloudpickle.dumps(graph))
        return dask.get(cloudpickle.loads(sent[-1]), keys)

    whole = rondel.zonal_statistics(data, "grid:90", NAMES.split())
    with dask.config.set(scheduler=elsewhere):
        lazy = rondel.zonal_statistics(data.chunk({"time": 1}), "grid:90", NAMES.split())
    assert sent
    pandas.testing.assert_frame_equal(whole, lazy)


def test_means_are_those_of_a_regridder(data):
    zones = rondel.CellSet.named("healpix:1")
    table = rondel.zonal_statistics(data, zones)
    regridder = rondel.Regridder(data, zones, "conservative_normed")
    means = regridder(data, skipna=True)
    np.testing.assert_allclose(table["mean"].to_numpy().reshape(48, 2), means.values.T, rtol=1e-12)


def test_files_have_the_same_numbers(data, tmp_path):
    pytest.importorskip("netCDF4")
    made = data.to_dataset()
    made.lat.attrs["units"], made.lon.attrs["units"] = "degrees_north", "degrees_east"
    made.t.attrs.update(units="m s-1", cell_methods="time: mean")
    path = tmp_path / "in.nc"
    made.to_netcdf(path)
    table = rondel.zonal_statistics(made.t, "healpix:1", NAMES.split())
    for memory in (2 << 30, 1):  # all statistics at once, or one by one
        report = rondel.regrid_file(
            path,
            "healpix:1",
            tmp_path / "out.nc",
            statistics=NAMES.split(),
            max_missing=1,
            memory=memory,
        )
        assert report.fields == 2
        with xarray.open_dataset(tmp_path / "out.nc") as out:
            for name in table.columns:
                found = out[f"t_{name}"].values
                wanted = table[name].to_numpy().reshape(48, 2).T
                np.testing.assert_allclose(found, wanted, rtol=1e-12, err_msg=name)
            assert out.t_mean.attrs["units"] == "m s-1"
            assert out.t_mean.attrs["cell_methods"] == "time: mean area: mean"
            assert out.t_variance.attrs["units"] == "(m s-1)2"
            assert out.t_count.attrs["units"] == "1"
            assert "cell_methods" not in out.t_count.attrs


@pytest.mark.parametrize("target", ["grid:60", "healpix:1"])
def test_attributes_name_no_field_in_place_of_a_statistic(data, tmp_path, target):
    """Names of fields may be those of statistics, and of the mapping of the target's grid."""
    pytest.importorskip("netCDF4")
    made = data.to_dataset()
    made.lat.attrs["units"], made.lon.attrs["units"] = "degrees_north", "degrees_east"
    made["t_max"], made["crs"] = made.t.copy(), made.t.copy()
    made["b"], made["label"] = (("time",), np.ones(made.time.size)), ((), 2.0)
    made["time_bnds"] = (("time", "nv"), np.zeros((made.time.size, 2)))
    made.t.attrs.update(ancillary_variables="t_max crs b", units="")
    made.time.attrs.update(bounds="time_bnds", formula_terms="b: b ps: crs")
    made["time_bnds"].attrs["ancillary_variables"] = "crs"
    for name in made.data_vars:
        made[name].encoding["coordinates"] = "label t_max crs" if name == "t" else None
    made.to_netcdf(tmp_path / "in.nc")
    out = tmp_path / "out.nc"
    rondel.regrid_file(tmp_path / "in.nc", target, out, statistics=["max", "variance"])
    with xarray.open_dataset(out, decode_coords=False, decode_times=False) as file:
        places = "lon lat " if target == "healpix:1" else ""
        for name in ("t_max", "t_variance"):
            assert file[name].attrs["ancillary_variables"] == "b"
            assert file[name].attrs["coordinates"] == places + "label"
            assert file[name].attrs["units"] == ""
        assert file["time"].attrs["bounds"] == "time_bnds"
        assert "formula_terms" not in file["time"].attrs
        assert "ancillary_variables" not in file["time_bnds"].attrs
        assert {"t_max_max", "crs_max"} <= {*file.data_vars}
    rondel.regrid_file(tmp_path / "in.nc", target, out)
    with xarray.open_dataset(out, decode_coords=False, decode_times=False) as file:
        assert file.t.attrs["ancillary_variables"] == "t_max crs b"
        assert file["time"].attrs["formula_terms"] == "b: b ps: crs"


@pytest.mark.filterwarnings("ignore:left out")
def test_wrong_calls_are_refused(data):
    with pytest.raises(ValueError, match="'avg' is no statistic"):
        rondel.zonal_statistics(data, "grid:90", "avg")
    with pytest.raises(TypeError, match="include_cols needs a GeoDataFrame"):
        rondel.zonal_statistics(data, "grid:90", include_cols="name")
    with pytest.raises(ValueError, match="weights must be 'area' or 'fraction'"):
        rondel.zonal_statistics(data, "grid:90", weights="none")
    with pytest.raises(ValueError, match="max_missing"):
        rondel.zonal_statistics(data, "grid:90", max_missing=2)
    for dataset in (
        xarray.Dataset(coords=data.coords),
        xarray.Dataset({"name": (("lat", "lon"), np.full((36, 72), "a"))}, data.coords),
    ):
        with pytest.raises(ValueError, match="no variable of the data is a field of numbers"):
            rondel.zonal_statistics(dataset, "grid:90")
    for kind, words in (("U1", "text"), ("M8[ns]", "times"), ("c16", "complex numbers")):
        other = xarray.zeros_like(data[0], dtype=kind)
        with pytest.raises(TypeError, match=f"must be real numbers, not {words}"):
            rondel.zonal_statistics(other, "grid:90")
    with pytest.raises(ValueError, match="statistics are of the cells"):
        rondel.regrid_file("in.nc", "grid:90", "o.nc", statistics="mean", method="nearest")


def test_statistics_of_cells_whose_corners_are_made():
    lon, lat = np.meshgrid(np.arange(5.0, 65, 10), np.arange(-25.0, 30, 10))
    data = xarray.Dataset(
        {"t": (("y", "x"), np.random.default_rng(9).random(lon.shape))},
        {
            "lon": (("y", "x"), lon, {"units": "degrees_east"}),
            "lat": (("y", "x"), lat, {"units": "degrees_north"}),
        },
    )
    with pytest.raises(ValueError, match="corners='made'"):
        rondel.zonal_statistics(data, "grid:30")
    with pytest.warns(UserWarning, match="half way between the centers"):
        found = rondel.zonal_statistics(data, "grid:30", "mean,count", corners="made")
    with pytest.warns(UserWarning, match="half way between the centers"):
        means = rondel.regrid(data, "grid:30", corners="made", max_missing=1).t.values.ravel()
    np.testing.assert_allclose(found.t_mean, means, rtol=1e-12)
    assert found.t_count.sum() == pytest.approx(36)
    with pytest.raises(ValueError, match="corners must be 'error' or 'made', not 'none'"):
        rondel.zonal_statistics(data, "grid:30", corners="none")
