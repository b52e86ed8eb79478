# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Builds by ranks that are threads: what rondel.delaunay finds alone, and errors on all of them."""

import signal
import subprocess
import sys
import threading
import time

import clouds
import numpy as np
import pytest
from threads import on_ranks, shares

import rondel
import rondel.distributed
from rondel import _core
from rondel.distributed import DistributedError


def repeated(points):
    return np.concatenate([points, points[: len(points) // 3], -points[:5]])


CLOUDS = {
    "uniform": clouds.uniform(3000),
    "duplicates": repeated(clouds.uniform(500, 1)),
    "grid": np.stack(np.meshgrid(*[np.arange(-4.0, 5.0, 2.0) + 0.5] * 3), -1).reshape(-1, 3),
    "patch": clouds.patch(1000, 1e-6),
    "ball": clouds.uniform(2000, 2) * np.random.default_rng(3).uniform(0.9, 1, (2000, 1)),
    "circle": clouds.circle(200),
    "few": clouds.cube()[:2],
    "none": np.empty((0, 3)),
}


def build(points, size, **options):
    parts = shares(points, size)

    def work(rank):
        return rondel.distributed.delaunay(parts[rank.rank], rank, threads=1, **options)

    return on_ranks(size, work)


def together(parts, name):
    return np.concatenate([getattr(part, name) for part in parts])


@pytest.mark.parametrize("model", ["projected", "weighted"])
@pytest.mark.parametrize("size", [1, 2, 3, 5])
@pytest.mark.parametrize("name", CLOUDS)
def test_the_result_is_that_of_delaunay(name, size, model):
    points = CLOUDS[name]
    parts = build(points, size, model=model, max_bucket_sites=400)
    expected = rondel.delaunay(points, model)._triangulation
    for array in ("faces", "neighbors", "ghost_faces", "ring", "duplicates"):
        found = together(parts, array)
        assert found.dtype == np.int64
        np.testing.assert_array_equal(found, getattr(expected, array))
    np.testing.assert_array_equal(together(parts, "hidden"), expected.hidden[:, 0])
    owned = np.sort(together(parts, "owned_sites"))
    np.testing.assert_array_equal(
        owned, np.setdiff1d(np.arange(len(points)), expected.duplicates[:, 0])
    )
    first = 0
    for part in parts:
        assert part.dimension == expected.dimension
        assert part.num_sites == len(points)
        assert part.num_vertices == expected.num_vertices
        assert part.num_faces == expected.num_faces
        assert part.num_ghost_faces == len(expected.ghost_faces)
        assert part.num_duplicates == len(expected.duplicates)
        assert part.num_hidden == len(expected.hidden)
        assert part.num_open_sites <= part.num_sites
        if part.dimension == 2:
            assert part.first_face == first
        first += len(part.faces)


@pytest.mark.parametrize("model", ["projected", "weighted"])
@pytest.mark.parametrize("size", [1, 3])
@pytest.mark.parametrize("name", CLOUDS)
def test_areas_and_circumcenters_are_those_in_memory(name, size, model):
    points = CLOUDS[name]
    given = shares(points, size)

    def work(rank):
        mine = given[rank.rank]
        part = rondel.distributed.delaunay(
            mine, rank, threads=1, model=model, max_bucket_sites=400, keep_points=True
        )
        areas = part.areas()
        assert areas.shape == (len(mine),)
        return part.circumcenters, areas

    results = on_ranks(size, work)
    expected = rondel.delaunay(points, model)._triangulation
    known = _core.circumcenters(expected), _core.diagram(expected).areas
    for k in range(2):
        assert np.concatenate([found[k] for found in results]).tobytes() == known[k].tobytes()


def test_points_must_be_kept_for_areas():
    (part,) = build(CLOUDS["uniform"], 1)
    for ask in (part.areas, lambda: part.circumcenters):
        with pytest.raises(ValueError, match="keep_points=True"):
            ask()


def test_the_sphere_is_that_of_delaunay():
    points = 3 * CLOUDS["ball"] + [1, 2, 3]
    options = {"model": "weighted", "radius": 2.9, "center": [1, 2, 3]}
    expected = rondel.delaunay(points, **options)
    assert expected.hidden.size
    np.testing.assert_array_equal(
        together(build(points, 3, **options), "faces"), expected.simplices
    )


def test_points_are_taken_as_delaunay_takes_them():
    rng = np.random.default_rng(6)
    lon, lat = rng.uniform(-180, 180, 300), rng.uniform(-90, 90, 300)
    parts = np.split(rondel.unit_vectors(lon, lat), 3)
    parts = [parts[0].tolist(), np.asfortranarray(parts[1]), parts[2][:, ::-1][:, ::-1]]
    found = on_ranks(3, lambda rank: rondel.distributed.delaunay(parts[rank.rank], rank))
    expected = rondel.delaunay_lonlat(lon, lat).simplices
    np.testing.assert_array_equal(together(found, "faces"), expected)


def test_arrays_are_read_only_and_outlive_the_object():
    (part,) = build(repeated(CLOUDS["uniform"]), 1)
    assert "6,006 of 6,006 faces, 4,005 points" in repr(part)
    assert part.faces is part.faces
    duplicates = part.duplicates
    for array in (part.faces, part.neighbors, part.owned_sites, duplicates):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    del part
    assert duplicates[0].tolist() == [3000, 0]


@pytest.mark.parametrize("size", [1, 4])
def test_a_point_that_is_not_valid_is_told_to_all(size):
    points = clouds.uniform(4000)
    points[3999, 1] = np.nan
    for r, error in enumerate(build(points, size)):
        assert type(error) is DistributedError, (r, error)
        assert error.rank == size - 1
        assert str(error).startswith(f"rank {size - 1}, count: site 3999: (")
        assert str(error).endswith("is not finite")


@pytest.mark.parametrize(
    ("wrong", "kind", "text"),
    [
        (
            {"points": np.ones((4, 2))},
            ValueError,
            "points must have shape (n, 3), not (4, 2); "
            "rondel.unit_vectors(lon, lat) makes them of longitudes and latitudes",
        ),
        ({"points": ["a", "b"]}, TypeError, "points must be real numbers, not text"),
        ({"model": "flat"}, ValueError, "model must be 'projected' or 'weighted', not 'flat'"),
        ({"max_bucket_sites": 0}, ValueError, "max_bucket_sites must be at least 1, not 0"),
        ({"threads": 0}, ValueError, "threads must be at least 1, or None for all cores, not 0"),
    ],
    ids=lambda wrong: next(iter(wrong)) if isinstance(wrong, dict) else "",
)
def test_an_argument_that_one_rank_has_wrong(wrong, kind, text):
    def work(rank):
        given = {"points": CLOUDS["uniform"], "comm": rank}
        return rondel.distributed.delaunay(**given | (wrong if rank.rank == 1 else {}))

    errors = on_ranks(3, work)
    assert type(errors[1]) is kind
    assert str(errors[1]) == text
    for r in (0, 2):
        assert type(errors[r]) is DistributedError
        assert str(errors[r]) == f"rank 1, arguments: {text}"
        assert errors[r].rank == 1


def test_ranks_that_want_different_things():
    def work(rank):
        model = "weighted" if rank.rank == 2 else "projected"
        return rondel.distributed.delaunay(CLOUDS["uniform"], rank, model=model)

    for error in on_ranks(4, work):
        assert type(error) is DistributedError
        assert str(error) == "rank 2, arguments: not those of rank 0"


class Lost(Exception):
    pass


@pytest.mark.parametrize("call", range(16))
def test_what_a_communicator_raises_is_raised(call):
    left = [call, call]

    def work(rank):
        def lose():
            left[rank.rank] -= 1
            if rank.rank == 1 and left[1] < 0:
                raise Lost("no line")

        rank.on_call = lose
        return rondel.distributed.delaunay(CLOUDS["uniform"], rank)

    errors = on_ranks(2, work)
    assert type(errors[1]) is Lost
    assert str(errors[1]) == "no line"
    assert type(errors[0]) is threading.BrokenBarrierError


def changing(change):
    """What a build gives whose communicator returns what ``change(messages)`` makes of messages."""

    def work(rank):
        allgather = rank.allgather
        rank.allgather = lambda message: change(allgather(message))
        return rondel.distributed.delaunay(CLOUDS["uniform"], rank)

    return on_ranks(1, work)[0]


def test_messages_are_memory_of_any_kind():
    for kind in (bytearray, memoryview, lambda message: np.frombuffer(message, np.uint8)):
        part = changing(lambda messages, kind=kind: tuple(map(kind, messages)))
        assert len(part.faces) == 5996


def test_what_is_no_message_of_each_rank():
    def later(answer):  # than the ranks meet
        return lambda messages: messages if messages[0].startswith(b"[") else answer

    error = changing(later([b"", b""]))
    assert type(error) is ValueError
    assert str(error) == "allgather returned 2 messages of 1 ranks"
    assert type(changing(later(["text"]))) is TypeError
    assert type(changing(later(None))) is TypeError


def test_what_is_no_communicator():
    with pytest.raises(TypeError, match="comm has no allgather: it is a Half"):
        rondel.distributed.delaunay(np.eye(3), type("Half", (), {"rank": 0, "size": 1})())


@pytest.fixture
def alarm():
    """Raises KeyboardInterrupt in the main thread after a time, as Ctrl-C does."""
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    yield lambda seconds: signal.setitimer(signal.ITIMER_REAL, seconds)
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


def test_an_interrupt_of_one_rank_ends_all(alarm):
    points = clouds.uniform(1 << 18)

    def work(rank):
        if rank.rank == 0:
            alarm(0.03)
        return rondel.distributed.delaunay(points, rank, threads=1)

    for error in on_ranks(3, work):
        assert type(error) is KeyboardInterrupt


def test_an_interrupt_while_others_are_late(alarm):
    def work(rank):
        if rank.rank == 0:
            alarm(0.05)
        else:
            time.sleep(0.3)
        return rondel.distributed.delaunay(CLOUDS["uniform"], rank)

    for error in on_ranks(2, work):
        assert type(error) is KeyboardInterrupt


def test_an_interrupt_while_points_are_made(alarm):
    class Slow:
        def __array__(self, *_, **__):
            alarm(0.01)
            time.sleep(5)

    def work(rank):
        points = Slow() if rank.rank == 0 else CLOUDS["uniform"]
        return rondel.distributed.delaunay(points, rank)

    for error in on_ranks(2, work):
        assert type(error) is KeyboardInterrupt


def test_progress_is_told_and_ends_all():
    told = []
    points = clouds.uniform(1 << 17)
    parts = on_ranks(
        2,
        lambda rank: rondel.distributed.delaunay(
            points, rank, progress=None if rank.rank else lambda *what: told.append(what)
        ),
    )
    assert sum(len(part.faces) for part in parts) == parts[0].num_faces
    assert {stage for stage, _ in told} <= {"triangulate", "join"}
    assert told

    def stop(stage, fraction):
        raise Lost(stage)

    errors = on_ranks(
        2,
        lambda rank: rondel.distributed.delaunay(
            points, rank, progress=stop if rank.rank else None, max_bucket_sites=100
        ),
    )
    assert type(errors[1]) is Lost
    assert type(errors[0]) is KeyboardInterrupt


def test_progress_that_raises_when_all_is_done_leaves_no_result():
    """Of few points it is told at the end alone."""

    def lose(stage, fraction):
        raise Lost(stage)

    def work(rank):
        listener = lose if rank.rank == 1 else None
        return rondel.distributed.delaunay(CLOUDS["uniform"], rank, progress=listener)

    found = [type(error) for error in on_ranks(3, work)]
    assert found == [KeyboardInterrupt, Lost, KeyboardInterrupt]


def test_files(tmp_path):
    rng = np.random.default_rng(7)
    lonlat = np.column_stack([rng.uniform(-180, 180, 900), rng.uniform(-90, 90, 900)])
    lonlat[850:] = lonlat[:50]
    tri = rondel.delaunay_lonlat(*lonlat.T)
    for radians in (False, True):
        np.save(tmp_path / "sites.npy", np.radians(lonlat) if radians else lonlat)
        if radians:
            tri = rondel.delaunay_lonlat(*np.degrees(np.radians(lonlat)).T)

        def work(rank, radians=radians):
            return rondel.distributed.delaunay_file(
                tmp_path / "sites.npy",
                str(tmp_path / "faces.npy"),
                rank,
                tmp_path / "neighbors.npy",
                tmp_path / "duplicates.npy",
                tmp_path / "areas.npy",
                tmp_path / "circumcenters.npy",
                radians=radians,
            )

        parts = on_ranks(3, work)
        assert {part.num_sites for part in parts} == {900}
        np.testing.assert_array_equal(together(parts, "faces"), tri.simplices)
        areas = np.load(tmp_path / "areas.npy")
        np.testing.assert_array_equal(areas, _core.diagram(tri._triangulation).areas)
        np.testing.assert_array_equal(np.load(tmp_path / "circumcenters.npy"), tri.circumcenters)
        faces = np.load(tmp_path / "faces.npy")
        assert faces.dtype == np.uint32
        np.testing.assert_array_equal(faces, tri.simplices)
        np.testing.assert_array_equal(np.load(tmp_path / "neighbors.npy"), tri.neighbors)
        np.testing.assert_array_equal(np.load(tmp_path / "duplicates.npy"), tri.duplicates)


def test_files_that_cannot_be(tmp_path):
    def run(sites, faces, **more):
        return on_ranks(
            2, lambda rank: rondel.distributed.delaunay_file(sites, faces, rank, **more)
        )

    sites, faces = tmp_path / "sites.npy", tmp_path / "faces.npy"
    for error in run(sites, faces):
        assert type(error) is DistributedError
        assert str(error) == f"rank 0, read: {sites}: No such file or directory"
    np.save(sites, np.ones((9, 3)))
    for error in run(sites, tmp_path / "no" / "faces.npy"):
        assert type(error) is DistributedError
    for error in run(sites, ""):
        assert str(error) == "faces has no name"
    for error in run(sites, faces, neighbors=3):
        assert type(error) is TypeError
    for error in run(sites, faces, areas="areas.txt"):
        assert str(error) == "areas is 'areas.txt', whose ending is not .npy"
    for error in run(f"{sites}\0", faces):
        assert type(error) is ValueError
    points = np.ones((9, 3))
    points[7] = 0
    np.save(sites, points)
    for error in run(sites, faces):
        assert str(error).startswith(f"rank 1, read: {sites}: row 7: site 7: (0, 0, 0) is the ")
    assert list(tmp_path.iterdir()) == [sites]


def said_by(program):
    """What a program of its own prints."""
    return subprocess.run(
        [sys.executable, "-c", program], check=True, capture_output=True, text=True
    ).stdout.strip()


def test_rondel_alone_imports_no_mpi():
    program = "import sys, rondel; print({'mpi4py', 'rondel.distributed'} & set(sys.modules))"
    assert said_by(program) == "set()"
    program = "import sys, rondel.distributed; print('mpi4py' in sys.modules)"
    assert said_by(program) == "False"


def test_a_missing_mpi4py_is_named():
    program = """
import sys
sys.modules["mpi4py"] = None
import rondel.distributed
try:
    rondel.distributed.delaunay([[1, 0, 0]])
except ModuleNotFoundError as error:
    print(error)
"""
    assert said_by(program) == (
        "rondel.distributed needs mpi4py, which is not there (pip install mpi4py), "
        "or another communicator: comm="
    )


def write_field(path, times):
    from netCDF4 import Dataset

    rng = np.random.default_rng(4)
    with Dataset(path, "w", format="NETCDF3_CLASSIC") as file:
        for name, size in (("time", times), ("lat", 18), ("lon", 36)):
            file.createDimension(name, size)
        for name, units, values in (
            ("lat", "degrees_north", np.arange(-85.0, 90, 10)),
            ("lon", "degrees_east", np.arange(5.0, 360, 10)),
        ):
            variable = file.createVariable(name, "f8", (name,))
            variable.units = units
            variable[:] = values
        field = file.createVariable("t", "f8", ("time", "lat", "lon"), fill_value=-9)
        values = rng.normal(size=(times, 18, 36))
        field[:] = np.ma.masked_where(rng.random(values.shape) < 0.1, values)


@pytest.mark.parametrize("size", [1, 2, 3])
def test_files_are_regridded_as_by_one_process(size, tmp_path):
    pytest.importorskip("netCDF4")
    write_field(tmp_path / "in.nc", 5)
    jobs = {
        "tiles": {"tile": 300},
        "places": {"method": "linear", "memory": 1 << 28},
        "second": {"method": "conservative_2nd", "tile": 300, "vectors": [], "names": iter(["t"])},
        "filled": {"extrapolate": "nearest", "max_missing": 0.01},
    }
    for name, options in jobs.items():
        own = {**options, "names": ["t"]} if "names" in options else options
        alone = rondel.regrid_file(
            tmp_path / "in.nc", "healpix:3", tmp_path / "alone.nc", threads=1, **own
        )

        def work(rank, options=options, name=name):
            own = {**options, "names": iter(["t"])} if "names" in options else options
            return rondel.distributed.regrid_file(
                tmp_path / "in.nc", "healpix:3", tmp_path / "out.nc", rank, threads=1, **own
            )

        reports = on_ranks(size, work)
        assert (tmp_path / "out.nc").read_bytes() == (tmp_path / "alone.nc").read_bytes(), name
        assert reports[0].missing == alone.missing
        for report in reports:
            assert (report.sources, report.targets, report.fields) == (648, 768, 5)
            assert report.extrapolated == alone.extrapolated
        if name == "filled":
            assert alone.extrapolated > 0
        if name in ("tiles", "second"):
            assert alone.tiles > 3
        (tmp_path / "out.nc").unlink()


def test_what_is_wrong_with_a_regridding_is_told_on_all_ranks(tmp_path):
    pytest.importorskip("netCDF4")
    write_field(tmp_path / "in.nc", 1)

    def regrid(rank, target="healpix:2", **options):
        return rondel.distributed.regrid_file(
            tmp_path / "in.nc", target, tmp_path / "out.nc", rank, threads=1, **options
        )

    for error in on_ranks(2, lambda rank: regrid(rank, "healpix:99")):
        assert isinstance(error, DistributedError)
        assert "the level of HEALPix is from 0 to 13" in str(error)
    for rank, error in enumerate(
        on_ranks(2, lambda rank: regrid(rank, **({"methods": "linear"} if rank.rank else {})))
    ):
        assert isinstance(error, TypeError if rank else DistributedError)
        assert "methods" in str(error)
    for error in on_ranks(2, lambda rank: regrid(rank, statistics="mean")):
        assert isinstance(error, TypeError)
        assert "statistics is of one process" in str(error)
    for error in on_ranks(2, lambda rank: regrid(rank, tile=100 + rank.rank)):
        assert isinstance(error, DistributedError)
        assert "not those of rank 0" in str(error)
    assert not (tmp_path / "out.nc").exists()
