# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Set operations on polygons of GeoPandas and GeoArrow: rows, columns, and coordinates."""

import itertools

import numpy as np
import pytest

import rondel

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")

HOWS = ("intersection", "union", "identity", "symmetric_difference", "difference")
BOXES = [shapely.box(west, 0, west + 0.01, 0.01) for west in (0, 0.02, 0.04)]
OTHERS = [shapely.box(0.005, 0.005, 0.025, 0.02), shapely.box(0.05, -0.01, 0.06, 0)]


def frames():
    first = geopandas.GeoDataFrame(
        {"name": list("abc"), "count": [1, 2, 3], "is_dry": [True, False, True]},
        geometry=BOXES,
        crs=4326,
        index=[5, 6, 7],
    )
    second = geopandas.GeoDataFrame(
        {"name": list("xy"), "depth": [1.5, 2.5]}, geometry=OTHERS, crs=4326
    )
    return first, second


def sorted_rows(frame):
    """The attributes of each row and its area in the plane."""
    values = frame.drop(columns=frame.geometry.name)
    rows = [
        (*map(str, row), round(1e6 * shape.area, 3))
        for row, shape in zip(values.itertuples(index=False), frame.geometry, strict=True)
    ]
    return list(values.columns), sorted(rows)


@pytest.mark.parametrize("how", HOWS)
def test_pieces_have_the_attributes_of_geopandas(how):
    first, second = frames()
    found, expected = rondel.overlay(first, second, how), geopandas.overlay(first, second, how)
    assert isinstance(found, geopandas.GeoDataFrame)
    assert sorted_rows(found) == sorted_rows(expected)
    assert found.dtypes.to_dict() == expected.dtypes.to_dict()
    assert found.index.tolist() == list(range(len(expected)))
    assert found.crs == expected.crs
    assert found.geometry.name == expected.geometry.name
    assert found.is_valid.all()


@pytest.mark.parametrize("how", HOWS)
def test_without_pieces_there_are_the_columns(how):
    first, second = frames()
    columns = rondel.overlay(first, second, how).columns.tolist()
    for one, other in ((first[:0], second[:0]), (first[:0], second), (first[:1], second[1:])):
        assert rondel.overlay(one, other, how).columns.tolist() == columns


def test_columns_of_geometries_have_any_name():
    first, second = frames()
    named = first.rename_geometry("shape")
    named["geometry"] = "no geometry"
    assert rondel.overlay(named, second).columns.tolist() == [
        "name_1", "count", "is_dry", "name_2", "depth", "geometry",
    ]  # fmt: skip
    plain = named.drop(columns="geometry")
    rest = rondel.overlay(plain, second, "difference")
    assert rest.columns.tolist() == ["name", "count", "is_dry", "shape"]
    found = rondel.overlay(first, OTHERS, "union")
    assert found.columns.tolist() == ["name", "count", "is_dry", "geometry"]
    assert found["name"].isna().sum() == 2
    assert isinstance(rondel.overlay(first.geometry, second), geopandas.GeoSeries)
    assert rondel.overlay(OTHERS, first).shape == (2,)


def test_rows_that_overlap_keep_their_places():
    first, _ = frames()
    overlapping = first.set_geometry([*first.buffer(0.02, cap_style="square")])
    found, i, k = rondel.overlay(overlapping, first, return_indices=True)
    assert len(found) == 7
    expected = [first.geometry.iloc[n].area for n in k]
    inside = [overlapping.geometry.iloc[n] for n in i]
    expected = [
        shape.intersection(first.geometry.iloc[n]).area for shape, n in zip(inside, k, strict=True)
    ]
    assert np.array([shape.area for shape in found.geometry]) == pytest.approx(expected, rel=1e-6)


@pytest.mark.filterwarnings("ignore:Geometry is in a geographic CRS")
def test_rows_are_paired_by_index():
    first = geopandas.GeoSeries(BOXES, index=["a", "b", "c"], crs=4326)
    second = geopandas.GeoSeries(BOXES[::-1], index=["c", "b", "d"], crs=4326)
    found = rondel.intersection(first, second)
    assert found.index.tolist() == first.align(second)[0].index.tolist() == ["a", "b", "c", "d"]
    assert found.isna().tolist() == [True, False, False, True]
    expected = first.intersection(second, align=True)
    assert found[["b", "c"]].area.tolist() == pytest.approx(expected[["b", "c"]].area, rel=1e-6)
    by_position = rondel.intersection(first, second, align=False)
    assert by_position.index.tolist() == ["a", "b", "c"]
    assert by_position.is_empty.tolist() == [True, False, True]
    turned = rondel.intersection(first, first[::-1])
    assert turned.area[first.index].tolist() == pytest.approx(first.area, rel=1e-6)
    frame = geopandas.GeoDataFrame({"n": [1, 2, 3]}, geometry=first, index=first.index)
    joined = rondel.union(frame, second)
    assert joined["n"].tolist()[:3] == [1, 2, 3]
    assert np.isnan(joined["n"].iloc[3])
    assert joined.geometry.isna().tolist() == [True, False, False, True]
    assert rondel.union(second, frame).index.tolist() == ["a", "b", "c", "d"]


def test_series_and_frames_keep_what_they_are():
    first, _ = frames()
    for given in (first, first.geometry, first.rename_geometry("shape")):
        for other in (OTHERS[0], [OTHERS[0]] * 3, first.geometry.tolist(), None):
            found = rondel.difference(given, other)
            assert type(found) is type(given)
            assert found.index.equals(given.index)
            assert found.crs == given.crs
            assert found.geometry.isna().all() == (other is None)
    assert rondel.difference(first, OTHERS[0])["count"].tolist() == [1, 2, 3]
    assert isinstance(rondel.difference(OTHERS[0], first.geometry), geopandas.GeoSeries)
    assert rondel.area(first).shape == (3,)
    assert rondel.union_all(first).geom_type == "MultiPolygon"
    assert isinstance(rondel.union(first.geometry.array, BOXES[0]), geopandas.GeoSeries)
    with pytest.raises(ValueError, match=r"a has 1 rows, and the result \(3,\)"):
        rondel.union(first.geometry[:1], BOXES)
    with pytest.raises(ValueError, match=r"shapes of a and b do not fit: \(3,\) and \(2,\)"):
        rondel.union(first, OTHERS)


@pytest.mark.filterwarnings("ignore:Geometry is in a geographic CRS")
def test_coordinates_become_degrees():
    first, second = frames()
    expected = rondel.overlay(first, second)
    for one, other in itertools.product((4326, 3857, 32631), (4326, 3857)):
        found = rondel.overlay(first.to_crs(one), second.to_crs(other))
        assert found.crs == "EPSG:4326"
        assert found.area.tolist() == pytest.approx(expected.area.tolist(), rel=1e-5)
    plain = first.set_crs(None, allow_override=True)
    assert rondel.intersection(plain, OTHERS[0]).crs is None
    moon = geopandas.GeoSeries(BOXES, crs="IAU_2015:30100")
    assert rondel.union(moon.to_crs("IAU_2015:30110"), moon).crs == moon.crs
    with pytest.raises(ValueError, match="a and b are on different bodies, 'WGS 84' and 'Moon"):
        rondel.union(first.geometry, moon)


def test_a_body_may_have_several_names():
    first, second = frames()
    expected = rondel.overlay(first, second)
    same = ["OGC:CRS84", "+proj=longlat +datum=WGS84", first.crs.to_wkt("WKT1_ESRI")]
    for name in same:
        renamed = first.set_crs(name, allow_override=True)
        assert renamed.crs != first.crs
        found = rondel.overlay(renamed, second)
        assert found.crs == "EPSG:4326"
        assert found.geom_equals(expected).all()
        assert rondel.overlay(second, renamed).crs == "EPSG:4326"
        assert rondel.make_valid(renamed).crs == "EPSG:4326"
        assert renamed.crs != first.crs  # the argument stays what it is
    moon = geopandas.GeoSeries(BOXES, crs="IAU_2015:30100")
    other = moon.set_crs("+proj=longlat +R=1737400", allow_override=True)
    assert rondel.union(moon, other).crs == moon.crs
    with pytest.raises(ValueError, match="different bodies"):
        rondel.union(moon, moon.set_crs("IAU_2015:49900", allow_override=True))


def test_polygons_of_projections_may_cross_the_date_line():
    fiji = geopandas.GeoSeries([shapely.box(2e6, -2e6, 4e6, -1e6)], crs=3832)
    found = rondel.intersection(fiji, shapely.box(170, -30, 190, 0))
    assert found.geom_type.tolist() == ["MultiPolygon"]
    west, _, east, _ = found.total_bounds
    assert (west, east) == (-180, 180)


@pytest.mark.parametrize("encoding", ["WKB", "geoarrow"])
def test_arrays_of_arrow_become_arrays_of_arrow(encoding):
    pyarrow = pytest.importorskip("pyarrow")
    first, second = frames()
    series = geopandas.GeoSeries([*BOXES, None], crs=4326)
    given = series.to_arrow(geometry_encoding=encoding)
    found = rondel.difference(given, OTHERS[0])
    metadata = pyarrow.Field._import_from_c_capsule(found.__arrow_c_array__()[0]).metadata
    name = b"geoarrow.wkb" if encoding == "WKB" else b"geoarrow.polygon"
    assert metadata[b"ARROW:extension:name"] == name
    back = geopandas.GeoSeries.from_arrow(found)
    expected = rondel.difference(series, OTHERS[0])
    assert back.geom_equals(expected).tolist() == [True, True, True, False]
    assert back.isna().tolist() == [False, False, False, True]
    assert rondel.area(given)[:3] == pytest.approx(rondel.area(BOXES))
    assert rondel.union_all(given).geom_type == "MultiPolygon"
    tables = [frame.to_arrow(geometry_encoding=encoding) for frame in (first, second)]
    parts = rondel.overlay(*tables, "union")
    assert encoding.lower() in str(pyarrow.table(parts).schema).lower()
    expected = rondel.overlay(first, second, "union")
    back = geopandas.GeoDataFrame.from_arrow(parts)
    assert back.fillna("").astype(str).equals(expected.fillna("").astype(str))
    clipped = geopandas.GeoDataFrame.from_arrow(rondel.intersection(tables[0], BOXES[0]))
    assert clipped["count"].tolist() == [1, 2, 3]
    with pytest.raises(ValueError, match=r"^b: No GeoArrow geometry field found"):
        rondel.union(given, pyarrow.array([b"1", b"2", b"3", b"4"]))
