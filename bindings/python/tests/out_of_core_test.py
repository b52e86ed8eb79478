# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Runs from files to files: what rondel.delaunay finds in memory."""

import os

import clouds
import numpy as np
import pytest

import rondel
import rondel.out_of_core


@pytest.fixture
def folder(tmp_path):
    points = clouds.uniform(3000)
    np.save(tmp_path / "sites.npy", np.concatenate([points, points[:50]]))
    return tmp_path


def run(folder, **options):
    return rondel.out_of_core.delaunay(
        folder / "sites.npy", folder / "faces.npy", scratch=folder / "work", **options
    )


def results(folder):
    return sorted(path.name for path in folder.glob("*.npy"))


@pytest.mark.parametrize("model", ["projected", "weighted"])
def test_all_results(folder, model):
    report = run(
        folder,
        model=model,
        neighbors=folder / "neighbors.npy",
        areas=str(folder / "areas.npy"),
        duplicates=folder / "duplicates.npy",
    )
    tri = rondel.delaunay(np.load(folder / "sites.npy"), model)
    faces = np.load(folder / "faces.npy")
    assert faces.dtype == np.uint32
    np.testing.assert_array_equal(faces, tri.simplices)
    np.testing.assert_array_equal(np.load(folder / "neighbors.npy"), tri.neighbors)
    np.testing.assert_array_equal(np.load(folder / "duplicates.npy"), tri.duplicates)
    areas = np.load(folder / "areas.npy")
    assert areas.sum() == pytest.approx(4 * np.pi)
    if model == "projected":
        voronoi = rondel.SphericalVoronoi(np.load(folder / "sites.npy")[:3000])
        np.testing.assert_array_equal(areas[:3000], voronoi.calculate_areas())
        assert not areas[3000:].any()
    assert (report.num_sites, report.num_vertices, report.num_faces) == (3050, 3000, 5996)
    assert (report.num_duplicates, report.dimension, report.num_resumed) == (50, 2, 0)
    assert not (folder / "work").exists()


def test_lonlat(folder):
    rng = np.random.default_rng(4)
    lon, lat = rng.uniform(-180, 180, 500), rng.uniform(-90, 90, 500)
    for radians in (False, True):
        given = np.stack([lon, lat], axis=1)
        np.save(folder / "sites.npy", np.radians(given) if radians else given)
        run(folder, radians=radians)
        if radians:
            lon, lat = np.degrees(np.radians(lon)), np.degrees(np.radians(lat))
        expected = rondel.delaunay_lonlat(lon, lat).simplices
        np.testing.assert_array_equal(np.load(folder / "faces.npy"), expected)


def test_progress_and_resume(folder):
    class Ended(Exception):
        pass

    def listen(stage, fraction):
        assert 0 <= fraction <= 1
        if stage not in ("count", "scatter") and (stage != "triangulate" or fraction > 0):
            raise Ended  # a bucket is done

    np.save(folder / "sites.npy", clouds.uniform(1_000_000))
    with pytest.raises(Ended):
        run(folder, progress=listen)
    assert results(folder) == ["sites.npy"]
    with pytest.raises(OSError, match="a run that has not come to its end"):
        run(folder)
    report = run(folder, resume=True)
    assert 0 < report.num_resumed <= report.num_buckets
    expected = rondel.delaunay(np.load(folder / "sites.npy")).simplices
    np.testing.assert_array_equal(np.load(folder / "faces.npy"), expected)


def test_what_is_wrong(folder):
    for memory in ("1M", "1m", "1024k", "1048576", 1 << 20, "1.5M", "0.0015g", "0.0000015T"):
        found = 2 if "." in str(memory) else 1
        with pytest.raises(rondel.InvalidInput, match=f"{found} MB of memory are less than the 96"):
            run(folder, memory=memory)
    for memory in ("2X", "2GB", "1.5", "1.5.1G", "G", "", "17e9", -1, 2e8, True):
        with pytest.raises(ValueError, match=f"memory is {memory!r}, which is not a number of byt"):
            run(folder, memory=memory)
    with pytest.raises(ValueError, match="out has no name"):
        rondel.out_of_core.delaunay(folder / "sites.npy", "", scratch=folder / "work")
    with pytest.raises(FileNotFoundError):
        rondel.out_of_core.delaunay(
            folder / "sites.npy", folder / "no/f.npy", scratch=folder / "work"
        )
    assert not (folder / "work").exists()
    with pytest.raises(ValueError, match="model is 'flat'"):
        run(folder, model="flat")
    points = np.load(folder / "sites.npy")
    points[17, 1] = np.nan
    np.save(folder / "sites.npy", points)
    with pytest.raises(OSError, match=r"sites\.npy: row 17: "):
        run(folder)
    os.remove(folder / "sites.npy")
    with pytest.raises(FileNotFoundError) as caught:
        run(folder)
    assert caught.value.filename == str(folder / "sites.npy")
    assert results(folder) == []


class Named:
    def __init__(self, path):
        self.path = path

    def __fspath__(self):
        return self.path


def test_names(folder):
    sites, faces, work = (os.fsencode(folder / name) for name in ("sites.npy", "f.npy", "work"))
    for kind in (bytes, os.fsdecode, Named):
        report = rondel.out_of_core.delaunay(kind(sites), kind(faces), scratch=kind(work))
        assert report.num_faces == len(np.load(folder / "f.npy"))
    for wrong, text in (("a\0b.npy", "has a NUL"), (b"\0", "has a NUL"), (b"\xff", "is not UTF-8")):
        names = {"path": sites, "out": faces, "scratch": work, "areas": None}
        for argument in names:
            with pytest.raises(ValueError, match=f"the name of a file {text}: "):
                rondel.out_of_core.delaunay(**names | {argument: wrong})
    with pytest.raises(TypeError, match="expected str, bytes or os"):
        rondel.out_of_core.delaunay(3, faces, scratch=work)


@pytest.mark.parametrize("argument", ["out", "neighbors", "areas", "duplicates"])
def test_endings_that_are_not_written(folder, argument):
    names = {"path": folder / "sites.npy", "out": folder / "f.npy", "scratch": folder / "work"}
    for name in ("a.txt", "a.npy.gz", "A.CSV"):
        with pytest.raises(ValueError, match=f"{argument} is '{name}', whose ending is not .npy"):
            rondel.out_of_core.delaunay(**names | {argument: name})
    assert results(folder) == ["sites.npy"]


def test_memory_in_bytes(folder):
    for memory in (100 << 20, "0.1g", "100.5M"):
        assert run(folder, memory=memory).num_faces == 5996
