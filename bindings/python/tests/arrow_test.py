# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons from and to Arrow, as pyarrow and GeoPandas see them."""

import json
import sys

import numpy as np
import pytest

import rondel

geopandas = pytest.importorskip("geopandas")
pyarrow = pytest.importorskip("pyarrow")
shapely = pytest.importorskip("shapely")

HOLED = shapely.Polygon(
    shapely.box(0, 0, 9, 9).exterior, [shapely.box(3, 3, 6, 6).exterior.coords[::-1]]
)
SHAPES = [HOLED, shapely.box(20, 0, 30, 5), None, shapely.box(-50, -5, -40, 60)]
SERIES = geopandas.GeoSeries(SHAPES, crs=4326)
CELLS = rondel.SphericalVoronoi.from_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
BAND = CELLS.clip([-180, -60, 180, 10])


def handed(series, change=lambda array: array, **options):
    """An array of GeoArrow that another library hands over."""
    field, array = pyarrow_of(series, **options)
    return Handed(field, change(array))


def pyarrow_of(series, **options):
    schema, array = series.to_arrow(geometry_encoding="geoarrow", **options).__arrow_c_array__()
    field = pyarrow.Field._import_from_c_capsule(schema)
    return field, pyarrow.Array._import_from_c_capsule(field.type.__arrow_c_schema__(), array)


class Handed:
    def __init__(self, field, array):
        self.field, self.array = field, array

    def __arrow_c_array__(self, requested_schema=None):
        return self.field.__arrow_c_schema__(), self.array.__arrow_c_array__()[1]


class Tied(pyarrow.ExtensionType):
    def __init__(self):
        storage = pyarrow.list_(pyarrow.list_(pyarrow.list_(pyarrow.list_(pyarrow.float64(), 2))))
        super().__init__(storage, "geoarrow.multipolygon")

    def __arrow_ext_serialize__(self):
        return b"{}"

    @classmethod
    def __arrow_ext_deserialize__(cls, storage, serialized):
        return cls()


def is_same(cells, expected):
    return all(
        np.array_equal(mine, theirs)
        for mine, theirs in zip(cells.rings, expected.rings, strict=True)
    )


@pytest.fixture
def without_geopandas(monkeypatch):
    monkeypatch.setitem(sys.modules, "geopandas", None)


def test_regions_are_arrays_of_the_same_polygons():
    field = pyarrow.Field._import_from_c_capsule(BAND.__arrow_c_array__()[0])
    assert field.metadata[b"ARROW:extension:name"] == b"geoarrow.multipolygon"
    about = json.loads(field.metadata[b"ARROW:extension:metadata"])
    assert about == {"crs": "OGC:CRS84", "crs_type": "authority_code"}
    array = pyarrow.array(BAND)
    assert len(array) == len(BAND) == 6
    assert array.null_count == 0
    array.validate(full=True)
    found = geopandas.GeoSeries.from_arrow(BAND)
    frame = BAND.to_geopandas()
    assert found.crs.equals("OGC:CRS84")
    assert found[~found.is_empty].index.tolist() == frame.index.tolist() == [0, 1, 2, 3, 5]
    for mine, theirs in zip(found[frame.index], frame.geometry, strict=True):
        assert mine.is_valid
        parts = getattr(theirs, "geoms", [theirs])
        assert mine.equals_exact(shapely.MultiPolygon([*parts]))
    chunked = pyarrow.chunked_array([array, array])
    assert chunked.num_chunks == 2


def test_cells_are_arrays_of_their_polygons():
    cells = rondel.CellSet.from_geometries(SHAPES)
    found = geopandas.GeoSeries.from_arrow(cells)
    expected = rondel.make_valid(SHAPES)
    assert found.is_empty.tolist() == [False, False, True, False]
    for mine, theirs in zip(found, expected, strict=True):
        if theirs is not None:
            assert shapely.symmetric_difference(mine, theirs).area < 1e-2 * theirs.length
    whole = rondel.union_all(rondel.CellSet.from_geometries(shapely.box(-180, -90, 180, 90)))
    assert geopandas.GeoSeries.from_arrow(whole)[0].bounds == (-180, -90, 180, 90)
    both = rondel.CellSet.from_geometries([SHAPES[1], SHAPES[1]])  # which overlap
    drawn = geopandas.GeoSeries.from_arrow(both).to_numpy()
    assert shapely.area(drawn) == pytest.approx([50, 50], rel=1e-3)
    nothing = rondel.CellSet.polygons([0], [0], [], np.zeros((0, 3)))
    assert len(pyarrow.array(nothing)) == 0
    with pytest.raises(ValueError, match="parallels"):
        pyarrow.array(rondel.lonlat_grid(4, 2))


@pytest.mark.parametrize("interleaved", [True, False])
def test_arrays_are_read_without_geopandas(interleaved, without_geopandas):
    expected = rondel.CellSet.from_geometries(SHAPES)
    given = handed(SERIES, interleaved=interleaved)
    assert is_same(rondel.CellSet.from_geometries(given), expected)
    sliced = handed(SERIES, lambda array: array[1:3], interleaved=interleaved)
    assert is_same(
        rondel.CellSet.from_geometries(sliced), rondel.CellSet.from_geometries(SHAPES[1:3])
    )
    several = geopandas.GeoSeries(
        [shapely.MultiPolygon([HOLED, SHAPES[1]]), None, SHAPES[3]], crs="OGC:CRS84"
    )
    cells = rondel.CellSet.from_geometries(handed(several, interleaved=interleaved))
    assert is_same(cells, rondel.CellSet.from_geometries([*several]))
    for edges in ("lonlat", "geodesic"):
        clipped = CELLS.clip(given, edges=edges)
        assert clipped.areas.tolist() == CELLS.clip(SHAPES, edges=edges).areas.tolist()
    with pytest.raises(ImportError):
        rondel.CellSet.from_geometries(SERIES.to_arrow(geometry_encoding="WKB"))


def test_what_is_handed_over_comes_back(without_geopandas):
    again = rondel.CellSet.from_geometries(BAND.cell_set())
    assert again.areas == pytest.approx(BAND.areas, rel=1e-3)
    pyarrow.register_extension_type(Tied())
    try:
        array = pyarrow.array(BAND)
        assert isinstance(array, pyarrow.ExtensionArray)
        part = rondel.CellSet.from_geometries(array[1:3])
    finally:
        pyarrow.unregister_extension_type("geoarrow.multipolygon")
    assert part.areas == pytest.approx(BAND.areas[1:3], rel=1e-3)


def test_geopandas_reads_other_arrays_and_tables():
    expected = rondel.CellSet.from_geometries(SHAPES).areas
    frame = geopandas.GeoDataFrame({"name": list("abcd")}, geometry=SERIES)
    table = pyarrow.table(frame.to_arrow(geometry_encoding="geoarrow"))
    chunked = pyarrow.concat_tables([table, table])
    assert chunked.column("geometry").num_chunks == 2
    projected = SERIES.to_crs(3857)
    for given in (
        SERIES.to_arrow(geometry_encoding="WKB"),
        projected.to_arrow(geometry_encoding="geoarrow"),
        table,
        frame.to_arrow(geometry_encoding="WKB"),
    ):
        assert rondel.CellSet.from_geometries(given).areas == pytest.approx(expected, rel=1e-4)
    twice = rondel.CellSet.from_geometries(chunked).areas
    assert twice == pytest.approx(np.tile(expected, 2), rel=1e-4)
    assert rondel.CellSet.from_geometries(chunked[3:5]).num_cells == 2
    with pytest.raises(ValueError, match="No GeoArrow"):
        rondel.CellSet.from_geometries(pyarrow.array([1]))


def test_arrays_are_refused_and_repaired_by_the_rules():
    tie = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    given = handed(geopandas.GeoSeries([SHAPES[1], tie]))
    for geometries in (given, [SHAPES[1], tie]):
        with pytest.raises(ValueError, match=r"^geometries: geometry 1: ring 0 of part 0 crosses"):
            rondel.CellSet.from_geometries(geometries)
        with pytest.warns(UserWarning, match="feature 1 was repaired"):
            cells = rondel.CellSet.from_geometries(geometries, invalid="repair")
        assert cells.areas[1] == pytest.approx(rondel.area(rondel.make_valid(tie)), rel=1e-6)
    overlapping = handed(geopandas.GeoSeries([HOLED, shapely.box(1, 1, 2, 2)]))
    with pytest.raises(ValueError, match=r"^geometries 0 and 1 overlap at"):
        rondel.CellSet.from_geometries(overlapping, overlap="error")
    outside = handed(geopandas.GeoSeries([shapely.box(0, 0, 1, 91)]))
    with pytest.raises(ValueError, match=r"^geometries: geometry 0: latitude 91 is outside"):
        rondel.CellSet.from_geometries(outside)
