# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Triangulations as groups of Zarr arrays (version 3), which zarr-python writes.

A group is a mesh by UGRID 1.0, whose nodes are the sites, in chunks of at most 2^20 rows that are
not compressed. Arrays are written chunk by chunk, so that they need not fit into memory.
"""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from . import _core, _ugrid
from ._types import FloatArray, Listener, Path, Triangulated
from ._zarr_folder import replaced

_MAX_ROWS = 1 << 20  # of a chunk


class Rows(Protocol):
    """An array that is read row by row: `shape`, `dtype`, and slices of rows."""

    @property
    def shape(self) -> tuple[int, ...]: ...
    @property
    def dtype(self) -> np.dtype[Any]: ...
    def __getitem__(self, some: slice) -> npt.NDArray[Any]: ...


@dataclasses.dataclass(frozen=True)
class GroupContent:
    """The arrays of a group; `nodes` returns points (k, 3) and degrees (k, 2) of some sites."""

    num_nodes: int
    nodes: Callable[[slice], tuple[FloatArray, FloatArray]]
    faces: Rows
    ghost_faces: Rows
    neighbors: Rows | None = None
    areas: Rows | None = None
    duplicates: Rows | None = None


class ZarrGroups:
    """Zarr groups of triangulations: a method of `SphericalDelaunay`."""

    def to_zarr(
        self: Triangulated,
        path: Path,
        *,
        neighbors: bool = False,
        areas: bool = False,
        duplicates: bool = False,
    ) -> None:
        """Writes a group of Zarr arrays (version 3), a folder, with the conventions of UGRID 1.0.

        The group has `sites`, `node_lon`, `node_lat`, `faces` with the ghost faces, and
        `ghost_faces` if there are some. It appears complete or not at all. A group that was made by
        Rondel, and to which nothing was added, is replaced.

        Parameters
        ----------
        path : path_like
            The folder; a name that ends in `.zarr` is usual.
        neighbors : bool, optional
            Whether to write `neighbors`, shape (m, 3); by default False.
        areas : bool, optional
            Whether to write `areas`, shape (n,), the areas of the cells in steradians; by default
            False.
        duplicates : bool, optional
            Whether to write `duplicates`, shape (k, 2); by default False.

        Raises
        ------
        ImportError
            If zarr-python 3 or later is not installed.
        OSError
            If the folder cannot be written, or is one that must not be replaced; then nothing is
            changed.

        """
        degrees = np.nan_to_num(self.lonlat, nan=0.0)  # of a site at the center
        content = GroupContent(
            len(self.points),
            lambda some: (self.points[some], degrees[some]),
            self.simplices.view(np.uint32),
            self._triangulation.ghost_faces.view(np.uint32),
            self.neighbors.view(np.uint32) if neighbors else None,
            _core.diagram(self._triangulation).areas if areas else None,
            self.duplicates.view(np.uint32) if duplicates else None,
        )
        write_group(path, content)


def write_group(path: Path, content: GroupContent, progress: Listener | None = None) -> None:
    """Writes a group; calls ``progress("group", fraction)`` after each chunk."""
    zarr = require_zarr()
    with replaced(path) as folder:
        root = zarr.create_group(
            folder, zarr_format=3, attributes=_ugrid.about("Delaunay triangulation")
        )
        add = _Adder(root, content, progress)
        add.rows("faces", content.faces, _FACE, _ugrid.CORNERS)
        if content.ghost_faces.shape[0] > 0:
            add.rows("ghost_faces", content.ghost_faces, ["n_ghost_face"], {"long_name": _GHOSTS})
        if content.neighbors is not None:
            add.rows("neighbors", content.neighbors, _FACE, _ugrid.ACROSS)
        if content.areas is not None:
            areas = {**_ugrid.values_at("node", "areas of the cells"), "units": "sr"}
            add.rows("areas", content.areas, ["n_node"], areas)
        if content.duplicates is not None:
            add.rows("duplicates", content.duplicates, _DUPLICATE, {"long_name": _REPEATS})
        add.nodes()
        topology = _ugrid.topology("faces")
        if content.neighbors is not None:
            topology["face_face_connectivity"] = "neighbors"
        add.array("mesh", "int32", (), [], topology)
        with warnings.catch_warnings():  # that version 3 does not specify it; xarray asks for it
            warnings.simplefilter("ignore")
            zarr.consolidate_metadata(root.store)


_FACE = ["n_face", "n_max_face_nodes"]
_DUPLICATE = ["n_duplicate", "two"]
_GHOSTS = "faces that are flat or reversed, seen from the center"
_REPEATS = "sites, each with the site that it repeats"


class _Adder:
    """Adds arrays to a group, chunk by chunk."""

    def __init__(self, root: Any, content: GroupContent, progress: Listener | None) -> None:
        self._root = root
        self._content = content
        self._progress = progress
        fields = ("faces", "ghost_faces", "neighbors", "areas", "duplicates")
        arrays = [getattr(content, field) for field in fields]
        self._total = content.num_nodes + sum(a.shape[0] for a in arrays if a is not None)
        self._done = 0

    def array(
        self, name: str, dtype: Any, shape: tuple[int, ...], names: list[str], attributes: Any
    ) -> Any:
        """Adds an array without chunks."""
        return self._root.create_array(
            name,
            dtype=dtype,
            shape=shape,
            chunks=(chunk_rows(shape[0]), *shape[1:]) if shape else (),
            filters=None,
            compressors=None,
            fill_value=0,
            attributes=attributes,
            dimension_names=names,
            chunk_key_encoding={"name": "default", "separator": "."},
            config={"write_empty_chunks": True},
        )

    def rows(self, name: str, rows: Rows, names: list[str], attributes: Any) -> None:
        array = self.array(name, rows.dtype, rows.shape, names, attributes)
        self._write([array], lambda some: [rows[some]])

    def nodes(self) -> None:
        n = self._content.num_nodes
        arrays = [
            self.array(
                "sites", "float64", (n, 3), ["n_node", "xyz"], _ugrid.values_at("node", "sites")
            )
        ]
        for name, says in _ugrid.angles("node").items():
            arrays.append(self.array(name, "float64", (n,), ["n_node"], says))

        def read(some: slice) -> list[FloatArray]:
            points, degrees = self._content.nodes(some)
            return [points, degrees[:, 0], degrees[:, 1]]

        self._write(arrays, read)

    def _write(
        self, arrays: list[Any], read: Callable[[slice], Sequence[npt.NDArray[Any]]]
    ) -> None:
        """Writes all rows of arrays of equal numbers of rows, a chunk of each at a time."""
        num_rows = arrays[0].shape[0]
        step = chunk_rows(num_rows)
        for begin in range(0, num_rows, step):
            some = slice(begin, min(begin + step, num_rows))
            for array, values in zip(arrays, read(some), strict=True):
                array[some] = values
            self._done += some.stop - some.start
            if self._progress is not None:
                self._progress("group", self._done / self._total)


def chunk_rows(num_rows: int) -> int:
    """The rows of a chunk: equally many in all, and as few chunks as 2^20 rows allow.

    The last chunk is stored in full, so that chunks of 2^20 rows would waste space.
    """
    num_chunks = -(-num_rows // _MAX_ROWS)
    return -(-num_rows // num_chunks) if num_chunks else 1


def require_zarr() -> Any:
    """The module zarr. Raises ImportError if it is not there, or is too old for version 3."""
    need = "Zarr groups are written by zarr-python 3 or later"
    try:
        import zarr
    except ImportError as error:
        raise ImportError(f"{need}, which is not installed: pip install 'zarr>=3'") from error
    if int(zarr.__version__.partition(".")[0]) < 3:
        found = f"{need}, and {zarr.__version__} is installed: pip install 'zarr>=3'"
        raise ImportError(found)
    return zarr
