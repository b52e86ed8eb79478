# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Zarr groups of triangulations that are larger than the memory, made of NumPy's files."""

from __future__ import annotations

import contextlib
import errno
import json
import os
import shutil
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import degrees_of, unit_vectors
from ._progress import listening
from ._types import FloatArray, Progress
from ._zarr import GroupContent, require_zarr, write_group
from ._zarr_folder import require_replaceable

_FOLDER = "rondel-arrays"  # in the scratch directory
_REPORT = "report.json"


class FileRows:
    """An array of a `.npy` file, of which nothing but the rows that are asked for is read."""

    def __init__(self, path: str) -> None:
        self._path = path
        array = self._array()
        self.shape: tuple[int, ...] = array.shape
        self.dtype: np.dtype[Any] = array.dtype

    def _array(self) -> npt.NDArray[Any]:
        array: npt.NDArray[Any] = np.load(self._path, mmap_mode="r")
        return array

    def __getitem__(self, some: slice) -> npt.NDArray[Any]:
        return np.array(self._array()[some])  # the file is mapped no longer than this takes


class RunIntoGroup:
    """A run out of core whose results are arrays of a group.

    The run writes `.npy` files into a folder of the scratch directory. They stay there until the
    group is complete, so that writing it can be resumed, too.
    """

    def __init__(
        self,
        path: str,
        out: str,
        scratch: str,
        arrays: list[str],
        options: dict[str, Any],
    ) -> None:
        """Keeps the names of the sites, the group, and of the arrays that it has beside faces."""
        self._path = path
        self._out = out
        self._scratch = scratch
        self._folder = os.path.join(scratch, _FOLDER)
        self._arrays = arrays
        self._options = options
        require_zarr()
        require_replaceable(out)

    def file(self, name: str) -> str:
        """The file of an array."""
        return os.path.join(self._folder, f"{name}.npy")

    def run(
        self, run: Callable[[], dict[str, Any]], resume: bool, progress: Progress
    ) -> dict[str, Any]:
        """Calls `run` unless an earlier run has done its work; writes the group."""
        self._require_room()
        about = self._about()
        report = self._finished(about, resume)
        if report is None:
            report = self._run(run)
            kept = {"about": about, "report": report}
            with open(os.path.join(self._folder, _REPORT), "w", encoding="utf-8") as file:
                json.dump(kept, file)
        with listening(progress) as listener:
            write_group(self._out, self._content(about), listener)
        self._clean(["faces", "ghost_faces", *self._arrays])
        return report

    def _run(self, run: Callable[[], dict[str, Any]]) -> dict[str, Any]:
        os.makedirs(self._folder, exist_ok=True)
        try:
            return run()
        except BaseException:
            self._clean([])
            raise

    def _about(self) -> dict[str, Any]:
        """What must be the same if a run is to be resumed."""
        about = {"version": _core.version, "arrays": self._arrays, **self._options}
        with contextlib.suppress(OSError):  # the run says what is wrong
            status = os.stat(self._path)
            about["sites"] = [status.st_size, status.st_mtime_ns]
        as_kept: dict[str, Any] = json.loads(json.dumps(about))
        return as_kept

    def _finished(self, about: dict[str, Any], resume: bool) -> dict[str, Any] | None:
        """The report of an earlier run, all of whose arrays are there."""
        try:
            with open(os.path.join(self._folder, _REPORT), encoding="utf-8") as file:
                kept = json.load(file)
        except (FileNotFoundError, ValueError):
            return None
        if not resume:
            what = "a run that has not come to its end; resume it, or remove the directory"
            raise OSError(f"{self._scratch}: {what}")
        if kept["about"] != about:
            raise OSError(f"{self._scratch}: a run of other sites, or with other options")
        report: dict[str, Any] = kept["report"]
        return {**report, "num_resumed": report["num_buckets"]}

    def _require_room(self) -> None:
        """Raises OSError at once if the disk is too small for the group."""
        try:
            num_sites = FileRows(self._path).shape[0]
        except (OSError, ValueError, IndexError):
            return  # the run says what is wrong
        row = 40 + 24 + 24 * ("neighbors" in self._arrays) + 8 * ("areas" in self._arrays)
        parent = os.path.dirname(require_replaceable(self._out))
        if shutil.disk_usage(parent).free < row * num_sites:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), self._out)

    def _content(self, about: dict[str, Any]) -> GroupContent:
        sites = FileRows(self._path)

        def nodes(some: slice) -> tuple[FloatArray, FloatArray]:
            read = self._nodes(sites[some].astype(np.float64))
            if self._about() != about:
                raise OSError(f"{self._path}: changed while it was read")
            return read

        rows = {name: FileRows(self.file(name)) for name in self._arrays}
        return GroupContent(
            sites.shape[0],
            nodes,
            FileRows(self.file("faces")),
            FileRows(self.file("ghost_faces")),
            **rows,
        )

    def _nodes(self, rows: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Points and degrees: the sites as given, and longitudes and latitudes as given."""
        if rows.shape[1] == 3:
            return rows, np.nan_to_num(degrees_of(rows, self._options["sphere"][0]), nan=0.0)
        degrees = np.degrees(rows) if self._options["radians"] else rows
        return unit_vectors(*degrees.T), degrees

    def _clean(self, arrays: list[str]) -> None:
        """Removes files of arrays, and the folders that are empty then."""
        files = [self.file(name) for name in arrays]
        if arrays:
            files.append(os.path.join(self._folder, _REPORT))
        with contextlib.suppress(OSError):
            for file in files:
                os.unlink(file)
            os.rmdir(self._folder)
            os.rmdir(self._scratch)
