# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations that are larger than the memory: from NumPy's files to such files or Zarr."""

from __future__ import annotations

import dataclasses
import os
from typing import Any

from . import _core
from ._arrays import as_bytes, as_center, as_name, as_result_name, as_threads
from ._types import ArrayLike, Model, Path, Progress
from ._zarr_files import RunIntoGroup

__all__ = ["Report", "delaunay"]


def __dir__() -> list[str]:
    return list(__all__)


@dataclasses.dataclass(frozen=True)
class Report:
    """What was found.

    Attributes
    ----------
    num_sites, num_vertices, num_duplicates, num_hidden : int
        Rows of the input; what became of them adds up to `num_sites`.
    num_faces, num_ghost_faces : int
        Triangles, and those of them that are not seen from the center.
    dimension : int
        As that of `SphericalDelaunay`; below 2 there are no faces.
    num_buckets, num_resumed : int
        Squares of the sphere that were triangulated one by one; how many an earlier run had done.
    num_open_sites : int
        Sites that no square could decide alone.

    """

    num_sites: int
    num_vertices: int
    num_faces: int
    num_ghost_faces: int
    num_duplicates: int
    num_hidden: int
    dimension: int
    num_buckets: int
    num_resumed: int
    num_open_sites: int


def delaunay(
    path: Path,
    out: Path,
    *,
    scratch: Path,
    memory: int | str = "2G",
    neighbors: Path | None = None,
    areas: Path | None = None,
    duplicates: Path | None = None,
    model: Model = "projected",
    radius: float = 1.0,
    center: ArrayLike | None = None,
    radians: bool = False,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Report:
    """The Delaunay triangulation of a file of points that need not fit into memory.

    The faces are those of `rondel.delaunay`, byte by byte, whatever the memory: the sphere is cut
    into squares of as many sites as fit, each is triangulated by itself, and what no square can
    decide alone is joined at last.

    Parameters
    ----------
    path : path_like
        A `.npy` file, shape (n, 3) of points or (n, 2) of longitudes and latitudes in degrees.
    out : path_like
        A `.npy` file of the triangles, shape (m, 3): input rows, counterclockwise. As all
        results, of type uint32 while all numbers fit, otherwise int64. If the name ends in
        `.zarr`, a Zarr group with the sites, too, which xarray, UXarray and Dask open; other
        results are arrays in it if they have the same name. It is written by zarr-python, chunk
        by chunk, when the triangulation is done.
    scratch : path_like
        A directory for some 64 bytes a site, 88 with neighbors, 128 with areas, and for a Zarr
        group as much as its arrays but the sites take. Made if it is not there, and removed at
        the end.
    memory : int or str, optional
        What the process may have in memory, in bytes or as '500M', '1.5g', '1T' (powers of 1024):
        held to if the process has little else in memory.
    neighbors : path_like, optional
        A `.npy` file, shape (m, 3): the faces opposite to each corner.
    areas : path_like, optional
        A `.npy` file, shape (n,): the areas of the cells in steradians, 0 without a cell.
    duplicates : path_like, optional
        A `.npy` file, shape (k, 2): rows, and the rows that they repeat.
    model : {'projected', 'weighted'}, optional
    radius : float, optional
    center : array_like, shape (3,), optional
        As for `rondel.delaunay`.
    radians : bool, optional
        Whether longitudes and latitudes are in radians.
    resume : bool, optional
        Go on with what a run that ended early left in the scratch directory.
    threads : int, optional
        At most so many work; one for each core by default.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)`` with the stages 'count', 'scatter', 'triangulate',
        'join' and 'write', and 'group' for a Zarr group. If it raises, the run ends and can be
        resumed, as after Ctrl-C.

    Returns
    -------
    Report

    Raises
    ------
    OSError
        With one line that names file, row and value of what is wrong, or how much memory or disk is
        missing.
    ImportError
        If `out` is a Zarr group and zarr-python 3 or later is not installed.
    InvalidInput
        If an option is not valid.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import numpy as np
    >>> import rondel.out_of_core
    >>> folder = tempfile.TemporaryDirectory()
    >>> path = pathlib.Path(folder.name)
    >>> np.save(path / "sites.npy", np.random.default_rng(1).normal(size=(20_000, 3)))
    >>> report = rondel.out_of_core.delaunay(
    ...     path / "sites.npy", path / "faces.npy", scratch=path / "work", memory="200M"
    ... )
    >>> report.num_faces
    39996
    >>> np.load(path / "faces.npy", mmap_mode="r").shape
    (39996, 3)
    >>> folder.cleanup()

    """
    if model not in ("projected", "weighted"):
        raise ValueError(f"model is {model!r}, which is neither 'projected' nor 'weighted'")
    results = {"faces": out, "neighbors": neighbors, "areas": areas, "duplicates": duplicates}
    group = _group_name(out)
    arrays = [name for name, file in results.items() if group and _group_name(file) == group]
    files = {
        name: "" if name in arrays else as_result_name(file, "out" if name == "faces" else name)
        for name, file in results.items()
    }
    if not group and not files["faces"]:
        raise ValueError("out has no name")
    directory = as_name(scratch)
    numbers = as_center(center), float(radius) ** 2

    def run() -> dict[str, Any]:
        found: dict[str, Any] = _core.delaunay_file(
            as_name(path),
            [files.get(name, "") for name in (*results, "ghost_faces")],
            as_bytes(memory),
            directory,
            bool(resume),
            bool(radians),
            model == "weighted",
            *numbers,
            as_threads(threads),
            progress,
        )
        return found

    if not group:
        return Report(**run())
    options = {
        "files": dict(files),
        "model": model,
        "sphere": numbers,
        "radians": bool(radians),
    }
    into = RunIntoGroup(as_name(path), group, directory, arrays[1:], options)
    files.update({name: into.file(name) for name in (*arrays, "ghost_faces")})
    return Report(**into.run(run, resume, progress))


def _group_name(path: Path | None) -> str:
    """The name of a Zarr group without slashes at its end; empty if the file is none."""
    name = "" if path is None else os.fsdecode(path).rstrip("/")
    return as_name(name) if os.path.splitext(name)[1].lower() == ".zarr" else ""
