# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations by several processes, none of which ever has all points.

The processes are the ranks of a communicator of mpi4py, or of anything else that has `rank`,
`size`, ``allgather(bytes)`` and ``alltoall(list of bytes)``. All of them make the same calls in the
same order, each with its own share of the points. The result is that of `rondel.delaunay` of all
points, those of rank r behind those of rank r - 1, bit by bit, whatever the number of ranks.

Where one rank cannot go on, all of them raise. What the communicator itself raises is raised on its
own rank alone: ``mpirun -n 8 python -m mpi4py program.py`` ends the others, too.
"""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core, _regrid_files
from ._arrays import (
    as_center,
    as_name,
    as_points,
    as_result_name,
    as_threads,
    frozen,
    is_weighted,
)
from ._errors import DistributedError
from ._ranks import Communicator, Ranks
from ._regrid_files import RegridReport
from ._repr import count
from ._types import ArrayLike, Model, Path, Progress

__all__ = [
    "Communicator",
    "DistributedError",
    "DistributedTriangulation",
    "delaunay",
    "delaunay_file",
    "regrid_file",
]


def __dir__() -> list[str]:
    return list(__all__)


FloatArray: TypeAlias = npt.NDArray[np.float64]
LongArray: TypeAlias = npt.NDArray[np.int64]


class DistributedTriangulation:
    """The part of one rank of a triangulation that `delaunay` or `delaunay_file` made.

    Points and faces are numbered through all ranks: those of rank r follow those of rank r - 1. All
    arrays of numbers are of int64 and read-only.
    """

    def __init__(
        self, part: _core.DistributedTriangulation, comm: Communicator | None, keep_points: bool
    ) -> None:
        self._part = part
        self._comm = comm
        self._has_points = keep_points

    @property
    def dimension(self) -> int:
        """int: the dimension, as in `SphericalDelaunay`; below 2 there are no faces."""
        return self._part.dimension

    @property
    def num_sites(self) -> int:
        """int: the number of points of all ranks."""
        return self._part.num_sites

    @property
    def num_vertices(self) -> int:
        """int: the number of vertices: of points that are neither duplicates nor hidden."""
        return self._part.num_vertices

    @property
    def num_faces(self) -> int:
        """int: the number of triangles of all ranks."""
        return self._part.num_faces

    @property
    def num_ghost_faces(self) -> int:
        """int: the number of triangles that are not seen from the center, of all ranks."""
        return self._part.num_ghost_faces

    @property
    def num_duplicates(self) -> int:
        """int: the number of points that are in the same place as one before them."""
        return self._part.num_duplicates

    @property
    def num_hidden(self) -> int:
        """int: the number of hidden points, which exist for model 'weighted' only."""
        return self._part.num_hidden

    @property
    def num_open_sites(self) -> int:
        """int: the number of points whose faces no rank could find alone; rank 0 joined them."""
        return self._part.num_open_sites

    @property
    def first_face(self) -> int:
        """int: the number of this rank's first triangle, row 0 of `faces`."""
        return self._part.first_face

    @cached_property
    def faces(self) -> LongArray:
        """Ndarray of int64, shape (m, 3): this rank's triangles as points, counterclockwise seen
        from outside. Made when it is first asked for, as `neighbors`.
        """
        return frozen(self._part.faces())

    @cached_property
    def neighbors(self) -> LongArray:
        """Ndarray of int64, shape (m, 3): for each corner of `faces` the triangle opposite to it,
        which may be another rank's.
        """
        return frozen(self._part.neighbors())

    @cached_property
    def ghost_faces(self) -> LongArray:
        """Ndarray of int64, shape (g,): those of this rank's triangles that are not seen from the
        center, increasing.
        """
        return self._part.ghost_faces

    @cached_property
    def owned_sites(self) -> LongArray:
        """Ndarray of int64, shape (s,): the points in this rank's part of the sphere, of several
        in one place the first. Their triangles are this rank's, but for those in which another
        corner comes first.
        """
        return self._part.owned_sites

    @cached_property
    def ring(self) -> LongArray:
        """Ndarray of int64, shape (v,): below dimension 2, on rank 0, the vertices in their order
        along the great circle. Empty otherwise.
        """
        return self._part.ring

    @cached_property
    def duplicates(self) -> LongArray:
        """Ndarray of int64, shape (k, 2): points that this rank gave, and the first ones in the
        same places.
        """
        return self._part.duplicates

    @cached_property
    def hidden(self) -> LongArray:
        """Ndarray of int64, shape (h,): points that this rank gave and that are no vertices."""
        return self._part.hidden

    @cached_property
    def circumcenters(self) -> FloatArray:
        """Ndarray, shape (m, 3): those of this rank's triangles, bit by bit as
        `SphericalDelaunay.circumcenters`. Only after ``keep_points=True``; a matter of this rank
        alone.
        """
        self._require_points()
        return frozen(self._part.circumcenters(0))

    def areas(self, *, threads: int | None = None, progress: Progress = None) -> FloatArray:
        """Computes the areas of the cells of the points that this rank gave.

        All ranks call this together. It needs ``keep_points=True``.

        Parameters
        ----------
        threads : int, optional
            The largest number of threads of this rank; by default its share of the cores.
        progress : callable or bool, optional
            Called as ``progress(stage, fraction)``, as in `delaunay`.

        Returns
        -------
        ndarray of float64, shape (n,)
            Areas in steradians, with the same bits as ``tri.voronoi().areas``; 0 for duplicates and
            hidden points.

        Raises
        ------
        DistributedError
            On all ranks, if memory is short on one of them.
        ValueError
            If the points were not kept.

        """
        self._require_points()
        ranks = Ranks(self._comm)
        try:
            ranks.prepare("areas", as_threads(threads))
        except BaseException as error:
            ranks.fail(error)
        return _core.areas_of_ranks(ranks, self._part, progress)

    def _require_points(self) -> None:
        if not self._has_points:
            raise ValueError("the points were not kept: delaunay(..., keep_points=True)")

    def __repr__(self) -> str:
        own = f"{self._part.num_own_faces:,} of {count(self.num_faces, 'face')}"
        name = f"rondel.distributed.{type(self).__name__}"
        return f"<{name}: {own}, {count(self.num_sites, 'point')}>"


def delaunay(
    points: ArrayLike,
    comm: Communicator | None = None,
    *,
    model: Model = "projected",
    radius: float = 1.0,
    center: ArrayLike | None = None,
    max_bucket_sites: int = 1 << 28,
    keep_points: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> DistributedTriangulation:
    """Computes the Delaunay triangulation of the points of all ranks, which call this together.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        The points of this rank: any share of all, possibly none. For longitudes and latitudes use
        `rondel.unit_vectors`.
    comm : mpi4py.MPI.Intracomm or Communicator, optional
        The ranks; by default ``mpi4py.MPI.COMM_WORLD``. It is called from another thread, and must
        not be used elsewhere until this function returns.
    model : {'projected', 'weighted'}, optional
        What a point represents, as in `rondel.delaunay`; by default 'projected'. It must be the
        same on all ranks.
    radius : float, optional
        The radius of the sphere; by default 1. It must be the same on all ranks.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin. It must be the same on all ranks.
    max_bucket_sites : int, optional
        The largest number of points that a rank triangulates at once. It must be the same on all
        ranks.
    keep_points : bool, optional
        Whether to keep the points, which takes 24 bytes a point, for `areas` and `circumcenters` of
        the result. It must be the same on all ranks.
    threads : int, optional
        The largest number of threads of this rank; by default its share of the cores of the
        machine.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)`` with the stages of this rank, 'triangulate' and
        'join'. An exception that it raises ends the work on all ranks, even in its last call.

    Returns
    -------
    DistributedTriangulation
        The part of this rank.

    Raises
    ------
    DistributedError
        On all ranks: if a point of one of them is not valid, or its memory is short. Where
        arguments of a rank are not valid, on the others; that rank has its `TypeError` or
        `ValueError`.
    KeyboardInterrupt
        On all ranks, after Ctrl-C, or an exception of `progress`, on one of them.
    ModuleNotFoundError
        If there is no `comm`, and no mpi4py.

    Examples
    --------
    >>> import numpy as np
    >>> import rondel.distributed
    >>> class Alone:  # as MPI.COMM_WORLD where nobody calls mpirun
    ...     rank, size = 0, 1
    ...     def allgather(self, message):
    ...         return [message]
    ...     def alltoall(self, messages):
    ...         return messages
    >>> points = np.random.default_rng(1).normal(size=(1000, 3))
    >>> part = rondel.distributed.delaunay(points, Alone())
    >>> part.faces.shape, part.first_face, part.num_faces
    ((1996, 3), 0, 1996)

    """
    ranks = Ranks(comm)
    sites = np.empty((0, 3))
    options = _no_options
    try:
        sites = as_points(points)
        options = _as_options(model, radius, center, max_bucket_sites)
        ranks.prepare(("delaunay", options, bool(keep_points)), as_threads(threads))
    except BaseException as error:
        ranks.fail(error)
    part = _core.delaunay_of_ranks(ranks, sites, *options, bool(keep_points), progress)
    return DistributedTriangulation(part, comm, bool(keep_points))


def delaunay_file(
    sites: Path,
    faces: Path,
    comm: Communicator | None = None,
    neighbors: Path | None = None,
    duplicates: Path | None = None,
    areas: Path | None = None,
    circumcenters: Path | None = None,
    *,
    model: Model = "projected",
    radius: float = 1.0,
    center: ArrayLike | None = None,
    radians: bool = False,
    max_bucket_sites: int = 1 << 28,
    threads: int | None = None,
    progress: Progress = None,
) -> DistributedTriangulation:
    """Computes the Delaunay triangulation of a file, of which each rank reads its share.

    Each rank also writes its share of the results, on a disk that all ranks share. The files appear
    complete when all ranks are done, or not at all; until then they are called ``.rondel-N-M.tmp``.
    Their numbers are of type uint32 if all fit, otherwise int64.

    Parameters
    ----------
    sites : path_like
        A `.npy` file, shape (n, 3) of points or (n, 2) of longitudes and latitudes in degrees.
    faces : path_like
        A `.npy` file of the triangles, shape (m, 3): rows of `sites`, counterclockwise.
    comm : mpi4py.MPI.Intracomm or Communicator, optional
        As for `delaunay`.
    neighbors : path_like, optional
        A `.npy` file, shape (m, 3): the triangles opposite to each corner.
    duplicates : path_like, optional
        A `.npy` file, shape (k, 2): rows, and the rows that they repeat.
    areas : path_like, optional
        A `.npy` file of doubles, shape (n,): the areas of the cells in steradians; 0 for points
        without a cell.
    circumcenters : path_like, optional
        A `.npy` file of doubles, shape (m, 3): unit vectors to the circumcenters of the triangles.
    model : {'projected', 'weighted'}, optional
        What a point represents, as in `rondel.delaunay`; by default 'projected'.
    radius : float, optional
        The radius of the sphere; by default 1.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin.
    radians : bool, optional
        Whether longitudes and latitudes are in radians; by default False, degrees.
    max_bucket_sites, threads, progress : optional
        As in `delaunay`. All arguments except `threads` and `progress` must be the same on all
        ranks.

    Returns
    -------
    DistributedTriangulation
        The part of this rank.

    Raises
    ------
    DistributedError
        On all ranks, also if a file, or a row of it, cannot be read or written.

    """
    ranks = Ranks(comm)
    files = [""] * 6
    options = _no_options
    try:
        results = {
            "faces": faces,
            "neighbors": neighbors,
            "duplicates": duplicates,
            "areas": areas,
            "circumcenters": circumcenters,
        }
        files = [as_name(sites), *(as_result_name(results[each], each) for each in results)]
        if not files[1]:
            raise ValueError("faces has no name")
        options = _as_options(model, radius, center, max_bucket_sites)
        ranks.prepare(("delaunay_file", files, radians, options), as_threads(threads))
    except BaseException as error:
        ranks.fail(error)
    part = _core.delaunay_file_of_ranks(
        ranks, files[0], files[1:], bool(radians), *options, progress
    )
    return DistributedTriangulation(part, comm, False)


def regrid_file(
    path: Path,
    target: Path,
    out: Path,
    comm: Communicator | None = None,
    *,
    threads: int | None = None,
    progress: Progress = None,
    **options: Any,
) -> RegridReport:
    """Brings the fields of a file to another grid; all ranks call this together.

    The file has the same bytes as that of `rondel.regrid_file`, for any number of ranks. Tiles of
    weights are divided among the ranks, or times and levels where weights have no tiles. Each rank
    reads the input, from a disk that all of them see, and rank 0 writes the output.

    Parameters
    ----------
    path, target, out : path_like
        As in `rondel.regrid_file`.
    comm : mpi4py.MPI.Intracomm or Communicator, optional
        As for `delaunay`.
    threads, progress : optional
        As in `delaunay`.
    **options
        The other arguments of `rondel.regrid_file`, but for `statistics` and `weigh_by`, which one
        process computes. `memory` is that of each rank. All arguments except `threads` and
        `progress` must be the same on all ranks.

    Returns
    -------
    RegridReport
        As that of `rondel.regrid_file`. Only rank 0 counts missing values.

    Raises
    ------
    DistributedError
        On all ranks: if a file cannot be read or written, or there is no such grid or method.
        Where arguments of a rank are not valid, on the others; that rank has its `TypeError` or
        `ValueError`.
    KeyboardInterrupt
        On all ranks, after Ctrl-C, or an exception of `progress`, on one of them.

    Examples
    --------
    >>> import rondel.distributed
    >>> rondel.distributed.regrid_file(  # doctest: +SKIP
    ...     "big.nc", "healpix:10", "pixels.nc", memory=4 << 30
    ... )

    """
    ranks = Ranks(comm)
    files = ("", "", "")
    wanted = _regrid_files.as_options()
    try:
        files = (os.fsdecode(path), os.fsdecode(target), os.fsdecode(out))
        for name in ("statistics", "weigh_by"):
            if name in options:
                raise TypeError(f"{name} is of one process: rondel.regrid_file")
        # Iterables are taken once, as other ranks compare what is in them.
        given = {name: _as_given(value) for name, value in options.items()}
        wanted = _regrid_files.as_options(**given)
        ranks.prepare(("regrid_file", files, sorted(given.items())), as_threads(threads))
    except BaseException as error:
        ranks.fail(error)
    return _regrid_files.report_of(_core.regrid_file_of_ranks(ranks, *files, wanted, progress))


def _as_given(value: Any) -> Any:
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    is_plain = value is None or isinstance(value, (str, bytes, int, float))
    return value if is_plain or not isinstance(value, Iterable) else list(value)


Options: TypeAlias = tuple[bool, tuple[float, float, float], float, int]

_no_options: Options = (False, (0.0, 0.0, 0.0), 1.0, 1)


def _as_options(model: Model, radius: float, center: Any, max_bucket_sites: int) -> Options:
    most = operator.index(max_bucket_sites)
    if most < 1:
        raise ValueError(f"max_bucket_sites must be at least 1, not {most}")
    return is_weighted(model), as_center(center), float(radius) ** 2, min(most, 1 << 40)
