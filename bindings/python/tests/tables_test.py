# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""NetCDF, Parquet and Zarr, as other programs read them."""

import importlib.util
import os
import stat
import sys

import clouds
import numpy as np
import pytest

import rondel
import rondel._tables
import rondel.out_of_core

SITES = {
    "random": lambda: rondel.delaunay(clouds.uniform(300)),
    "duplicates": lambda: rondel.delaunay(np.concatenate([clouds.uniform(100)] * 2)),
    "patch": lambda: rondel.delaunay(clouds.patch(50, 0.1)),
    "two": lambda: rondel.delaunay([[0, 0, 1], [0, 0, -1]]),
    "none": lambda: rondel.delaunay([]),
    "hidden": lambda: (
        rondel.power_diagram(
            [[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90], [5, 0]], [30, 0, 0, 0, 0, 0, 0]
        ).delaunay
    ),
}
every_kind = pytest.mark.parametrize("make", SITES.values(), ids=SITES)


@every_kind
def test_netcdf(make, tmp_path):
    pytest.importorskip("xarray")
    netcdf = pytest.importorskip("netCDF4")
    tri = make()
    tri.to_netcdf(tmp_path / "mesh.nc")
    with netcdf.Dataset(tmp_path / "mesh.nc") as file:
        assert file.data_model == "NETCDF4"
        assert file["mesh"].cf_role == "mesh_topology"
        faces = file["face_node_connectivity"]
        assert (faces.start_index, faces._FillValue) == (0, -1)
        assert np.array_equal(faces[:].data.reshape(-1, 3), tri.simplices[~tri.ghost])
        assert np.array_equal(file["node_lon"][:].data, tri.lonlat[:, 0])
    sv = tri.voronoi()
    sv.to_netcdf(tmp_path / "cells.nc", properties={"height": np.arange(tri.npoints)})
    with netcdf.Dataset(tmp_path / "cells.nc") as file:
        assert np.array_equal(file["face_area"][:].data, sv.areas[file["site"][:].data])
        assert np.array_equal(file["height"][:].data, file["site"][:].data)


def test_uxarray_opens_netcdf(tmp_path):
    uxarray = pytest.importorskip("uxarray")
    pytest.importorskip("netCDF4")
    tri = rondel.delaunay(clouds.uniform(100))
    tri.to_netcdf(tmp_path / "mesh.nc")
    grid = uxarray.open_grid(tmp_path / "mesh.nc")
    assert (grid.n_node, grid.n_face) == (100, 196)


def test_netcdf_by_the_other_library(tmp_path, monkeypatch):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    pytest.importorskip("h5py")
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: name != "netCDF4" and find(name))
    tri = rondel.delaunay(clouds.uniform(100))
    tri.to_netcdf(tmp_path / "mesh.nc")
    with xarray.open_dataset(tmp_path / "mesh.nc", engine="h5netcdf") as mesh:
        assert mesh.sizes["n_face"] == 196


def test_what_is_not_installed_is_named(tmp_path, monkeypatch):
    pytest.importorskip("xarray")
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    tri = rondel.delaunay(np.eye(3))
    with pytest.raises(ImportError, match="netCDF4 or h5netcdf"):
        tri.to_netcdf(tmp_path / "mesh.nc")
    for thing in (tri, tri.voronoi()):
        with pytest.raises(ImportError, match="pyarrow"):
            thing.to_parquet(tmp_path / "mesh.parquet")
    assert os.listdir(tmp_path) == []


@every_kind
def test_parquet(make, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    tri = make()
    tri.to_parquet(tmp_path / "faces.parquet")
    tri.to_parquet(tmp_path / "sites.parquet", table="sites")
    faces = parquet.read_table(tmp_path / "faces.parquet").to_pydict()
    assert np.array_equal(
        np.reshape([faces[f"site_{k}"] for k in range(3)], (3, -1)).T, tri.simplices
    )
    assert np.array_equal(
        np.reshape([faces[f"neighbor_{k}"] for k in range(3)], (3, -1)).T, tri.neighbors
    )
    assert faces["ghost"] == tri.ghost.tolist()
    sites = parquet.read_table(tmp_path / "sites.parquet").to_pydict()
    assert np.array_equal(np.reshape([sites[c] for c in "xyz"], (3, -1)).T, tri.points)
    assert np.array_equal(np.reshape([sites["lon"], sites["lat"]], (2, -1)).T, tri.lonlat)
    assert np.flatnonzero(sites["vertex"]).tolist() == tri.vertices.tolist()
    stands_for = dict(tri.duplicates.tolist())
    assert sites["representative"] == [stands_for.get(i, i) for i in range(tri.npoints)]
    sv = tri.voronoi()
    sv.to_parquet(tmp_path / "cells.parquet", properties={"name": list(map(str, tri.points))})
    cells = parquet.read_table(tmp_path / "cells.parquet").to_pydict()
    assert cells["site"] == tri.vertices.tolist()
    assert cells["area"] == sv.areas[tri.vertices].tolist()
    assert cells["lon"] == tri.lonlat[tri.vertices, 0].tolist()
    assert cells["name"] == [str(tri.points[i]) for i in tri.vertices]


def test_parquet_in_row_groups(tmp_path, monkeypatch):
    parquet = pytest.importorskip("pyarrow.parquet")
    monkeypatch.setattr(rondel._tables, "_ROWS", 100)
    tri = rondel.delaunay(clouds.uniform(130))
    tri.to_parquet(tmp_path / "faces.parquet")
    file = parquet.ParquetFile(tmp_path / "faces.parquet")
    assert [file.metadata.row_group(i).num_rows for i in range(file.num_row_groups)] == [
        100,
        100,
        56,
    ]
    assert file.read().column("site_1").to_pylist() == tri.simplices[:, 1].tolist()


def test_parquet_keeps_types_of_properties(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    pandas = pytest.importorskip("pandas")
    given = {
        "truth": [True, False, None],
        "day": pandas.date_range("2020-01-01", periods=3, tz="UTC"),
        "kind": pandas.Categorical(list("aba")),
        "value": np.array([1, np.nan, 3], np.float32),
    }
    rondel.SphericalVoronoi(np.eye(3)).to_parquet(tmp_path / "cells.parquet", properties=given)
    table = parquet.read_table(tmp_path / "cells.parquet")
    types = [str(table.schema.field(name).type).split("[")[0] for name in given]
    assert types[0] == "bool"
    assert types[1] == "timestamp"
    assert types[3] == "float"
    assert table.column("truth").to_pylist() == given["truth"]
    assert table.column("kind").to_pylist() == list("aba")
    with pytest.raises(ValueError, match="is taken"):
        rondel.SphericalVoronoi(np.eye(3)).to_parquet(
            tmp_path / "cells.parquet", properties={"area": range(3)}
        )
    with pytest.raises(ValueError, match="neither 'faces' nor 'sites'"):
        rondel.delaunay(np.eye(3)).to_parquet(tmp_path / "a.parquet", table="cells")


def writers():
    """What writes a file, by the library that it needs."""
    tri = rondel.delaunay(clouds.uniform(50))
    return {
        "netCDF4": (tri.to_netcdf, tri.voronoi().to_netcdf),
        "pyarrow": (tri.to_parquet, tri.voronoi().to_parquet),
    }


@pytest.mark.parametrize("library", ["netCDF4", "pyarrow"])
def test_bad_paths(library, tmp_path):
    pytest.importorskip(library)
    (tmp_path / "folder").mkdir()
    for write in writers()[library]:
        for name, error in (("none/file", FileNotFoundError), ("folder", IsADirectoryError)):
            with pytest.raises(error) as caught:
                write(tmp_path / name)
            assert caught.value.filename == str(tmp_path / name)
        assert os.listdir(tmp_path) == ["folder"]
        assert os.listdir(tmp_path / "folder") == []


@pytest.mark.parametrize("library", ["netCDF4", "pyarrow"])
def test_a_file_is_replaced_when_the_new_one_is_complete(library, tmp_path, monkeypatch):
    pytest.importorskip(library)
    path = tmp_path / "file"
    for write in writers()[library]:
        path.write_text("before")
        path.chmod(0o640)
        with monkeypatch.context() as patched:

            def fail(*_):
                raise KeyboardInterrupt

            patched.setattr(os, "replace", fail)
            with pytest.raises(KeyboardInterrupt):
                write(path)
        assert path.read_text() == "before"
        assert os.listdir(tmp_path) == ["file"]
        write(path)
        assert path.read_bytes() != b"before"
        assert os.listdir(tmp_path) == ["file"]
        if os.name == "posix":
            assert stat.S_IMODE(path.stat().st_mode) == 0o640
