# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Groups of Zarr arrays: what is in them, when they are replaced, runs that are cut short."""

import builtins
import json
import os
import stat
import sys
import types

import clouds
import numpy as np
import pytest

import rondel
import rondel.out_of_core
from rondel import _zarr, _zarr_files

SIZES = {"uint32": 4, "int64": 8, "float64": 8}


@pytest.fixture
def zarr():
    return pytest.importorskip("zarr", "3")


def array_of(folder):
    """The numbers of an array by the specification, without zarr: its chunks, less the filling."""
    head = json.loads((folder / "zarr.json").read_text())
    assert (head["zarr_format"], head["node_type"]) == (3, "array")
    assert head["codecs"] == [{"name": "bytes", "configuration": {"endian": "little"}}]
    shape, chunk = head["shape"], head["chunk_grid"]["configuration"]["chunk_shape"]
    assert chunk == [_zarr.chunk_rows(shape[0]), *shape[1:]]
    assert len(head["dimension_names"]) == len(shape)
    files = [folder / f"c.{i}{'.0' * (len(shape) - 1)}" for i in range(-(-shape[0] // chunk[0]))]
    assert sorted(os.listdir(folder)) == sorted([*(f.name for f in files), "zarr.json"])
    found = b"".join(file.read_bytes() for file in files)
    assert len(found) == len(files) * SIZES[head["data_type"]] * int(np.prod(chunk))
    return np.frombuffer(found, head["data_type"]).reshape(-1, *shape[1:])[: shape[0]]


def expect_content(group, tri, sites, degrees, extra=True):
    """The arrays and what is said of them."""
    expected = {
        "faces": (tri.simplices, "uint32", ["n_face", "n_max_face_nodes"]),
        "sites": (sites, "float64", ["n_node", "xyz"]),
        "node_lon": (degrees[:, 0], "float64", ["n_node"]),
        "node_lat": (degrees[:, 1], "float64", ["n_node"]),
    }
    if tri.ghost.any():
        expected["ghost_faces"] = (np.flatnonzero(tri.ghost), "uint32", ["n_ghost_face"])
    if extra:
        areas = tri.voronoi()._diagram.areas
        expected["neighbors"] = (tri.neighbors, "uint32", ["n_face", "n_max_face_nodes"])
        expected["areas"] = (areas, "float64", ["n_node"])
        expected["duplicates"] = (tri.duplicates, "uint32", ["n_duplicate", "two"])
    assert sorted(os.listdir(group)) == sorted([*expected, "mesh", "zarr.json"])
    whole = json.loads((group / "zarr.json").read_text())
    assert whole["attributes"]["Conventions"] == "CF-1.11 UGRID-1.0"
    described = whole["consolidated_metadata"]["metadata"]
    assert sorted(described) == sorted([*expected, "mesh"])
    for name, (values, dtype, dimensions) in expected.items():
        np.testing.assert_array_equal(array_of(group / name), values, name)
        head = json.loads((group / name / "zarr.json").read_text())
        assert (head["data_type"], head["dimension_names"]) == (dtype, dimensions), name
        assert described[name]["attributes"] == head["attributes"]
    topology = described["mesh"]["attributes"]
    assert topology["node_coordinates"] == "node_lon node_lat"
    assert described["faces"]["attributes"]["cf_role"] == "face_node_connectivity"
    assert ("face_face_connectivity" in topology) == extra
    assert described["node_lat"]["attributes"]["units"] == "degrees_north"


def cases():
    points = clouds.uniform(3000)
    cap = np.random.default_rng(5).normal(size=(200, 3)) + np.array([0, 0, 30])
    poles = [[0, 0, 2], [0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -3, 0]]
    return {
        "duplicates": np.concatenate([points, points[:50]]),
        "ghosts": cap,
        "poles": np.array(poles, float),
        "no_faces": points[:2],
        "none": points[:0],
    }


@pytest.mark.parametrize("case", cases())
def test_content(zarr, tmp_path, case):
    points = cases()[case]
    tri = rondel.delaunay(points)
    tri.to_zarr(tmp_path / "mesh.zarr", neighbors=True, areas=True, duplicates=True)
    expect_content(tmp_path / "mesh.zarr", tri, points, tri.lonlat)
    tri.to_zarr(str(tmp_path / "mesh.zarr") + "/")
    expect_content(tmp_path / "mesh.zarr", tri, points, tri.lonlat, extra=False)
    for sites in (points, np.asfortranarray(points)):
        np.save(tmp_path / "sites.npy", sites)
        run(tmp_path)
        expect_content(tmp_path / "mesh.zarr", tri, points, tri.lonlat)
    assert sorted(os.listdir(tmp_path)) == ["mesh.zarr", "sites.npy"]


def run(folder, **options):
    group = folder / "mesh.zarr"
    inside = dict.fromkeys(("neighbors", "areas", "duplicates"), group)
    return rondel.out_of_core.delaunay(
        folder / "sites.npy", group, scratch=folder / "work", **inside | options
    )


@pytest.mark.parametrize("radians", [False, True])
def test_longitudes_as_given(zarr, tmp_path, radians):
    rng = np.random.default_rng(4)
    given = np.stack([rng.uniform(-500, 500, 400), rng.uniform(-90, 90, 400)], axis=1)
    np.save(tmp_path / "sites.npy", np.radians(given) if radians else given)
    run(tmp_path, radians=radians)
    degrees = np.degrees(np.radians(given)) if radians else given
    tri = rondel.delaunay_lonlat(*degrees.T)
    expect_content(tmp_path / "mesh.zarr", tri, tri.points, degrees)


def test_the_center_has_longitude_0(zarr, tmp_path):
    points = np.array([[2, 0, 0], [0, 0, 0], [0, 2, 0], [0, 0, 2], [-1, -1, -1]], float)
    rondel.delaunay(points, "weighted").to_zarr(tmp_path / "mesh.zarr")
    assert array_of(tmp_path / "mesh.zarr" / "node_lon")[1] == 0
    assert array_of(tmp_path / "mesh.zarr" / "node_lat")[1] == 0


def test_arrays_may_be_files(zarr, tmp_path):
    np.save(tmp_path / "sites.npy", clouds.uniform(500))
    run(tmp_path, areas=tmp_path / "areas.npy", duplicates=None)
    assert sorted(os.listdir(tmp_path)) == ["areas.npy", "mesh.zarr", "sites.npy"]
    assert not (tmp_path / "mesh.zarr" / "areas").exists()
    assert np.load(tmp_path / "areas.npy").sum() == pytest.approx(4 * np.pi)
    with pytest.raises(ValueError, match=r"areas is '.*a\.zarr', whose ending is not \.npy"):
        run(tmp_path, areas=tmp_path / "a.zarr")


def test_chunks_have_equal_numbers_of_rows():
    most = 1 << 20
    for n in (1, 7, most - 1, most, most + 1, 2 * most, 2 * most + 1, 10 * most - 3, 7_654_321):
        num_chunks = next(k for k in range(1, 100) if -(-n // k) <= most)
        assert _zarr.chunk_rows(n) == -(-n // num_chunks)
    assert _zarr.chunk_rows(0) == 1


def test_several_chunks(zarr, tmp_path, monkeypatch):
    """Also of numbers of 64 bits, which only more than 2^32 sites have."""
    monkeypatch.setattr(_zarr, "_MAX_ROWS", 100)
    points = clouds.uniform(250)
    tri = rondel.delaunay(points)
    np.save(tmp_path / "faces.npy", tri.simplices.astype(np.int64) + (1 << 40))
    reads = []

    def nodes(some):
        reads.append((some.start, some.stop))
        return points[some], tri.lonlat[some]

    faces = _zarr_files.FileRows(str(tmp_path / "faces.npy"))
    content = _zarr.GroupContent(250, nodes, faces, np.zeros(0, np.uint32))
    told = []
    _zarr.write_group(tmp_path / "m.zarr", content, lambda *done: told.append(done))
    assert reads == [(0, 84), (84, 168), (168, 250)]
    assert told[-1] == ("group", 1.0)
    assert [fraction for _, fraction in told] == sorted(fraction for _, fraction in told)
    np.testing.assert_array_equal(array_of(tmp_path / "m.zarr" / "faces"), faces[:])
    np.testing.assert_array_equal(array_of(tmp_path / "m.zarr" / "sites"), points)


def names_of(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_what_is_not_ours_stays(zarr, tmp_path):
    group = tmp_path / "mesh.zarr"
    np.save(tmp_path / "sites.npy", clouds.uniform(100))
    tri = rondel.delaunay(clouds.uniform(100))

    def expect_refused(why):
        before = names_of(tmp_path)
        for write in (lambda: tri.to_zarr(group), lambda: run(tmp_path)):
            with pytest.raises(OSError, match=why) as caught:
                write()
            assert caught.value.filename == str(group)
            assert names_of(tmp_path) == before

    tri.to_zarr(group)
    for name in ("notes.txt", "temperature", "faces/other", "faces/c.0.0.tmp", "faces/c.."):
        (group / name).write_text("x")
        expect_refused(f"'{name}' in it is not ours; the folder is not replaced")
        (group / name).unlink()
    os.rename(group / "sites", tmp_path / "elsewhere")
    (group / "sites").symlink_to(tmp_path / "elsewhere")
    expect_refused("'sites' in it is not ours")
    (group / "sites").unlink()
    (group / "zarr.json").write_text('{"zarr_format": 3, "node_type": "group"}')
    expect_refused("it was not made by rondel; the folder is not replaced")
    for path in sorted(group.rglob("*"), reverse=True):
        path.rmdir() if path.is_dir() else path.unlink()
    tri.to_zarr(group)  # it is empty
    assert (group / "zarr.json").exists()


def test_names_that_make_no_group(zarr, tmp_path):
    tri = rondel.delaunay(clouds.uniform(10))
    (tmp_path / "file").write_text("x")
    with pytest.raises(NotADirectoryError, match="a file, where a folder is to be made"):
        tri.to_zarr(tmp_path / "file")
    with pytest.raises(FileNotFoundError) as caught:
        tri.to_zarr(tmp_path / "no" / "m.zarr")
    assert caught.value.filename == str(tmp_path / "no" / "m.zarr")
    with pytest.raises(NotADirectoryError):
        tri.to_zarr(tmp_path / "file" / "m.zarr")
    assert names_of(tmp_path) == ["file"]


@pytest.mark.skipif(os.name != "posix", reason="links and permissions of POSIX")
def test_links_and_permissions_stay(zarr, tmp_path):
    tri = rondel.delaunay(clouds.uniform(10))
    (tmp_path / "link").symlink_to(tmp_path / "target")
    tri.to_zarr(tmp_path / "link")
    for mode in (0o700, 0o750, 0o755):
        os.chmod(tmp_path / "target", mode)
        tri.to_zarr(tmp_path / "link")
        assert stat.S_IMODE(os.stat(tmp_path / "target").st_mode) == mode
    assert (tmp_path / "link").is_symlink()
    assert sorted(os.listdir(tmp_path)) == ["link", "target"]


@pytest.mark.parametrize("error", [KeyboardInterrupt, OSError(28, "No space left on device")])
def test_an_older_group_stays_when_a_chunk_fails(zarr, tmp_path, error):
    rondel.delaunay(clouds.uniform(10)).to_zarr(tmp_path / "mesh.zarr")
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}

    def nodes(_):
        raise error

    content = _zarr.GroupContent(5, nodes, np.zeros((2, 3), np.uint32), np.zeros(0, np.uint32))
    with pytest.raises(error if isinstance(error, type) else OSError) as caught:
        _zarr.write_group(tmp_path / "mesh.zarr", content)
    if isinstance(error, OSError):
        assert caught.value.filename == str(tmp_path / "mesh.zarr")
    assert {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()} == before


def test_a_run_is_resumed_when_the_group_fails(zarr, tmp_path):
    class Ended(Exception):
        pass

    def end_in(ended):
        def listen(stage, fraction):
            assert 0 <= fraction <= 1
            if stage == ended:
                raise Ended

        return listen

    np.save(tmp_path / "sites.npy", clouds.uniform(3000))
    with pytest.raises(Ended):
        run(tmp_path, progress=end_in("group"))
    assert sorted(os.listdir(tmp_path)) == ["sites.npy", "work"]
    with pytest.raises(OSError, match="work: a run that has not come to its end; resume it"):
        run(tmp_path)
    for other in ({"model": "weighted"}, {"areas": None}, {"center": (0, 0, 0.1)}):
        with pytest.raises(OSError, match="work: a run of other sites, or with other options"):
            run(tmp_path, resume=True, **other)
    report = run(tmp_path, resume=True, progress=lambda stage, _: end_in("count")(stage, 0))
    assert report.num_resumed == report.num_buckets > 0
    assert report.num_faces == 5996
    tri = rondel.delaunay(clouds.uniform(3000))
    expect_content(tmp_path / "mesh.zarr", tri, tri.points, tri.lonlat)
    assert sorted(os.listdir(tmp_path)) == ["mesh.zarr", "sites.npy"]


def test_a_run_that_fails_leaves_nothing(zarr, tmp_path, monkeypatch):
    points = clouds.uniform(100)
    points[17, 1] = np.nan
    np.save(tmp_path / "sites.npy", points)
    with pytest.raises(OSError, match=r"sites\.npy: row 17: "):
        run(tmp_path)
    (tmp_path / "text.npy").write_text("no array")
    with pytest.raises(OSError, match=r"text\.npy: "):
        rondel.out_of_core.delaunay(
            tmp_path / "text.npy", tmp_path / "m.zarr", scratch=tmp_path / "work"
        )
    usage = types.SimpleNamespace(free=100 * 96 - 1)
    monkeypatch.setattr(_zarr_files.shutil, "disk_usage", lambda _: usage)
    with pytest.raises(OSError, match="No space left on device") as caught:
        run(tmp_path)
    assert caught.value.filename == str(tmp_path / "mesh.zarr")
    assert sorted(os.listdir(tmp_path)) == ["sites.npy", "text.npy"]


@pytest.mark.parametrize("progress", [True, False])
def test_progress_may_be_true_or_false(zarr, tmp_path, progress):
    points = clouds.uniform(300)
    np.save(tmp_path / "sites.npy", points)
    run(tmp_path, progress=progress)
    tri = rondel.delaunay(points)
    expect_content(tmp_path / "mesh.zarr", tri, tri.points, tri.lonlat)


def test_sites_that_change_meanwhile(zarr, tmp_path):
    def change(stage, _):
        if stage == "group":
            os.utime(tmp_path / "sites.npy", ns=(1, 1))

    np.save(tmp_path / "sites.npy", clouds.uniform(100))
    with pytest.raises(OSError, match=r"sites\.npy: changed while it was read"):
        run(tmp_path, progress=change)
    assert not (tmp_path / "mesh.zarr").exists()


@pytest.mark.parametrize("version", [None, "2.18.7"])
def test_without_zarr_it_is_told_what_to_install(tmp_path, monkeypatch, version):
    imported = builtins.__import__

    def without(name, *rest):
        if name == "zarr":
            raise ModuleNotFoundError(name)
        return imported(name, *rest)

    if version is None:
        monkeypatch.delitem(sys.modules, "zarr", raising=False)
        monkeypatch.setattr(builtins, "__import__", without)
        said = "which is not installed: pip install 'zarr>=3'"
    else:
        monkeypatch.setitem(sys.modules, "zarr", types.SimpleNamespace(__version__=version))
        said = f"and {version} is installed: pip install 'zarr>=3'"
    np.save(tmp_path / "sites.npy", clouds.uniform(10))
    for write in (
        lambda: run(tmp_path),
        lambda: rondel.delaunay(clouds.uniform(10)).to_zarr(tmp_path / "mesh.zarr"),
    ):
        with pytest.raises(ImportError, match=f"written by zarr-python 3 or later, {said}"):
            write()
    assert os.listdir(tmp_path) == ["sites.npy"]


def test_zarr_and_dask_read_groups(zarr, tmp_path):
    tri = rondel.delaunay(clouds.uniform(300))
    tri.to_zarr(tmp_path / "mesh.zarr", areas=True)
    arrays = zarr.open_group(tmp_path / "mesh.zarr", mode="r")
    assert np.array_equal(arrays["faces"][:], tri.simplices)
    assert arrays["areas"][:].sum() == pytest.approx(4 * np.pi)
    dask = pytest.importorskip("dask.array")
    faces = dask.from_zarr(str(tmp_path / "mesh.zarr"), component="faces")
    assert np.array_equal(faces.compute(), tri.simplices)


@pytest.mark.filterwarnings("error:Failed to open Zarr:RuntimeWarning")
def test_xarray_opens_groups(zarr, tmp_path):
    xarray = pytest.importorskip("xarray")
    tri = rondel.delaunay(clouds.uniform(300))
    tri.to_zarr(tmp_path / "mesh.zarr", areas=True)
    mesh = xarray.open_zarr(tmp_path / "mesh.zarr")
    assert np.array_equal(np.column_stack([mesh.node_lon, mesh.node_lat]), tri.lonlat)
    assert np.array_equal(mesh.faces, tri.simplices)
    assert mesh.mesh.attrs["cf_role"] == "mesh_topology"
    uxarray = pytest.importorskip("uxarray")
    grid = uxarray.Grid.from_dataset(mesh)
    assert (grid.n_node, grid.n_face) == (300, 596)
    assert grid.face_areas.values.sum() == pytest.approx(4 * np.pi)
