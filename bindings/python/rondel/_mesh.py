# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What triangulations and hulls have in common: points, faces and who is next to whom."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import frozen
from ._repr import Described, count
from ._types import BoolArray, FloatArray, IntArray


class Lists(NamedTuple):
    """Lists in compressed rows (CSR): list i is ``indices[indptr[i]:indptr[i + 1]]``."""

    indptr: npt.NDArray[np.int64]
    indices: IntArray


class Mesh(Described):
    """Points and a triangulation of them, both immutable."""

    def __init__(self, points: FloatArray, triangulation: _core.Triangulation) -> None:
        self._points = frozen(points)
        self._triangulation = triangulation

    # The arrays say everything: nothing is triangulated again when an object is loaded.
    def __getstate__(self) -> dict[str, Any]:
        t = self._triangulation
        arrays = ("faces", "neighbors", "ghost_faces", "ring", "duplicates", "hidden")
        return {
            "points": self._points,
            "scalars": (t.dimension, t.is_weighted, t.center, t.squared_radius),
            "arrays": tuple(getattr(t, name) for name in arrays),
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._points = frozen(state["points"])
        self._triangulation = _core.Triangulation.from_arrays(
            self._points, *state["scalars"], *state["arrays"]
        )

    @property
    def points(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the points, read-only."""
        return self._points

    @property
    def npoints(self) -> int:
        """int: the number of points, n."""
        return len(self._points)

    @property
    def dimension(self) -> int:
        """int: 2 for a closed surface, 1 for points on one circle (of a hull: in one plane or on
        one line), 0 for one place, -1 without points.
        """
        return self._triangulation.dimension

    @property
    def simplices(self) -> IntArray:
        """Ndarray of int32, shape (m, 3): the corners of the faces, counterclockwise seen from
        outside. Positions in `points`. Empty below dimension 2.
        """
        return self._triangulation.faces

    @property
    def neighbors(self) -> IntArray:
        """Ndarray of int32, shape (m, 3): ``neighbors[f, i]`` is the face across the edge
        opposite to the corner ``simplices[f, i]``.
        """
        return self._triangulation.neighbors

    @property
    def ring(self) -> IntArray:
        """Ndarray of int32, shape (v,): below dimension 2 the vertices in their order around;
        empty in dimension 2.
        """
        return self._triangulation.ring

    @property
    def duplicates(self) -> IntArray:
        """Ndarray of int32, shape (d, 2): rows of a site and the one that stands for it, the
        lowest index in the same place. In increasing order of the first.
        """
        return self._triangulation.duplicates

    @property
    def hidden(self) -> IntArray:
        """Ndarray of int32, shape (h, 2): rows of a site that is no vertex and a face below which
        it lies (-1 below dimension 2). In increasing order of the first.
        """
        return self._triangulation.hidden

    @cached_property
    def ghost(self) -> BoolArray:
        """Ndarray of bool, shape (m,): faces that the center of the sphere does not see from
        below. There are some only where the points do not surround the center.
        """
        mask = np.zeros(len(self.simplices), bool)
        mask[self._triangulation.ghost_faces] = True
        mask.flags.writeable = False
        return mask

    @cached_property
    def vertices(self) -> IntArray:
        """Ndarray of int32, shape (v,): the sites that are vertices, in increasing order; neither
        duplicates nor hidden sites.
        """
        mask = np.ones(self.npoints, bool)
        mask[self.duplicates[:, 0]] = False
        mask[self.hidden[:, 0]] = False
        return np.flatnonzero(mask).astype(np.int32)

    @cached_property
    def edges(self) -> IntArray:
        """Ndarray of int32, shape (e, 2): every edge once, the lower index first, sorted."""
        return _core.edges(self._triangulation)

    @cached_property
    def vertex_neighbor_vertices(self) -> Lists:
        """Lists: the neighbors of vertex k are ``indices[indptr[k]:indptr[k + 1]]``,
        counterclockwise seen from outside, the lowest index first. A tuple (indptr, indices) as in
        `scipy.spatial.Delaunay`. Duplicates and hidden sites have empty lists.
        """
        return Lists(*_core.neighbor_lists(self._triangulation))

    @cached_property
    def facets(self) -> Lists:
        """Lists: the faces that lie in one plane merged into polygons, each from its lowest index
        counterclockwise: a cube has 6, not 12.
        """
        return Lists(*_core.merge_cocircular(self._triangulation))

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("points", count(self.npoints, "point"))]
        if len(self.duplicates):
            facts.append(("duplicates", count(len(self.duplicates), "duplicate")))
        if len(self.hidden):
            facts.append(("hidden", f"{len(self.hidden):,} hidden"))
        if self.dimension == 2:
            facts.append(("faces", count(len(self.simplices), "face")))
        else:
            facts.append(("dimension", f"dimension {self.dimension}"))
        if self._triangulation.ghost_faces.size:
            facts.append(("ghost faces", count(self._triangulation.ghost_faces.size, "ghost face")))
        return facts
