# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What each process of python_test.py does.

python_ranks.py SIZE (results FOLDER | pieces | failures | refused TEXT | interrupt | lost)
"""

import pathlib
import signal
import sys

import numpy as np
from mpi4py import MPI

import rondel
import rondel.distributed
from rondel._ranks import MpiCalls

WORLD = MPI.COMM_WORLD
RANK, SIZE = WORLD.rank, WORLD.size


def share(points):
    return points[len(points) * RANK // SIZE : len(points) * (RANK + 1) // SIZE]


def clouds():
    rng = np.random.default_rng(5)
    points = rng.normal(size=(4000, 3))
    angle = np.arange(300.0)
    yield np.vstack([points, points[:100]])
    yield points * rng.uniform(1, 3, (4000, 1))
    yield np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    yield points[:2]
    yield points[:0]


def results(folder):
    for points in clouds():
        for model in ("projected", "weighted"):
            part = rondel.distributed.delaunay(
                share(points), model=model, max_bucket_sites=500, threads=1
            )
            expected = rondel.delaunay(points, model)._triangulation
            for name in ("faces", "neighbors", "ghost_faces", "ring", "duplicates"):
                found = np.concatenate(WORLD.allgather(getattr(part, name)))
                np.testing.assert_array_equal(found, getattr(expected, name), name)
            hidden = np.concatenate(WORLD.allgather(part.hidden))
            np.testing.assert_array_equal(hidden, expected.hidden[:, 0])

    folder = pathlib.Path(folder)
    if RANK == 0:
        np.save(folder / "sites.npy", next(clouds()))
    WORLD.Barrier()
    files = [folder / f"{name}.npy" for name in ("faces", "neighbors", "duplicates")]
    rondel.distributed.delaunay_file(folder / "sites.npy", files[0], WORLD, *files[1:])
    tri = rondel.delaunay(next(clouds()))
    for file, expected in zip(files, (tri.simplices, tri.neighbors, tri.duplicates), strict=True):
        np.testing.assert_array_equal(np.load(file), expected)

    # Fewer than all, and each one for itself.
    half = WORLD.Split(RANK % 2)
    part = rondel.distributed.delaunay([[RANK + 1, 1, 2]], half)
    assert part.num_sites == half.size
    assert rondel.distributed.delaunay(np.eye(3), MPI.COMM_SELF).num_faces == 2


def pieces():
    """Messages of all lengths, which say where they come from."""
    calls = MpiCalls(WORLD, max_bytes=7)
    for length in (0, 1, 6, 7, 8, 40):

        def message(source, target, length=length):
            return bytes([16 * source + target]) * (length * ((source + 2 * target) % 3))

        received = calls.alltoall([message(RANK, r) for r in range(SIZE)])
        assert list(map(bytes, received)) == [message(r, RANK) for r in range(SIZE)]
        gathered = calls.allgather(message(RANK, 0))
        assert list(map(bytes, gathered)) == [message(r, 0) for r in range(SIZE)]


def failures():
    """One rank after the other; all can go on."""
    for failing in range(SIZE):
        points = np.ones((10, 3))
        if RANK == failing:
            points[3, 2] = np.inf
        try:
            rondel.distributed.delaunay(points)
        except rondel.distributed.DistributedError as error:
            site = 10 * failing + 3
            line = f"rank {failing}, count: site {site}: (1, 1, inf) is not finite"
            assert (str(error), error.rank) == (line, failing), error
        else:
            raise AssertionError("no error")
    assert rondel.distributed.delaunay(np.eye(3)[:RANK]).num_sites == sum(
        min(r, 3) for r in range(SIZE)
    )


def refused(text):
    """MPI that other threads may not call; or, where they may, ranks that are two groups."""
    own = WORLD.Split(RANK == 0)
    comm = own.Create_intercomm(0, WORLD, int(RANK == 0)) if SIZE > 1 else WORLD
    try:
        rondel.distributed.delaunay(np.eye(3), comm)
    except (RuntimeError, TypeError) as error:
        assert text in str(error), error
    else:
        raise AssertionError("no error")


def interrupt():
    """Ctrl-C, which the last rank alone gets."""
    points = np.random.default_rng(RANK).normal(size=(1 << 19, 3))
    if RANK == SIZE - 1:
        signal.signal(signal.SIGALRM, signal.default_int_handler)
        signal.setitimer(signal.ITIMER_REAL, 0.05)
    try:
        rondel.distributed.delaunay(points, threads=1)
    except KeyboardInterrupt:
        WORLD.Barrier()
        return
    raise AssertionError("no interrupt")


def lost():
    """A communicator that fails on one rank."""

    class Failing:
        rank, size, alltoall = RANK, SIZE, WORLD.alltoall

        def allgather(self, message, calls=iter(range(3))):
            if RANK == SIZE - 1 and next(calls, None) is None:
                raise ConnectionError("the line is cut")
            return WORLD.allgather(message)

    rondel.distributed.delaunay(np.eye(3), Failing())


assert int(sys.argv[1]) == SIZE, "mpiexec and mpi4py are not of the same MPI"
WORK = (results, pieces, failures, refused, interrupt, lost)
{work.__name__: work for work in WORK}[sys.argv[2]](*sys.argv[3:])
