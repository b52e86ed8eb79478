# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Graphs of near sites, hulls, alpha shapes and empty circles, for triangulations."""

from __future__ import annotations

import operator
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._types import FloatArray, IntArray

GraphName: TypeAlias = Literal["delaunay", "urquhart", "gabriel", "relative", "mst"]

_GRAPHS = ("delaunay", "urquhart", "gabriel", "relative", "mst")


class Graph(NamedTuple):
    """Edges between sites, shape (e, 2), the lower index first, and their lengths in radians."""

    edges: IntArray
    lengths: FloatArray


class Outline(NamedTuple):
    """Polygons whose corners are sites, the inside to the left.

    Polygon i has the rings ``polygon_offsets[i]`` to ``polygon_offsets[i + 1]``, and ring j the
    sites ``sites[ring_offsets[j]:ring_offsets[j + 1]]``. A polygon without rings is the sphere.
    """

    polygon_offsets: npt.NDArray[np.int64]
    ring_offsets: npt.NDArray[np.int64]
    sites: IntArray

    @property
    def rings(self) -> list[IntArray]:
        """The sites of each ring."""
        return np.split(self.sites, self.ring_offsets[1:-1]) if len(self.sites) else []


class EmptyCircles(NamedTuple):
    """Circles without sites inside: centers (k, 3), radii (k,) in radians, three sites on each."""

    centers: FloatArray
    radii: FloatArray
    sites: IntArray


class Graphs:
    """The methods of triangulations that read graphs and regions from them."""

    _triangulation: Any

    def graph(self, kind: GraphName = "delaunay") -> Graph:
        """A graph of near sites.

        Parameters
        ----------
        kind : {'delaunay', 'urquhart', 'gabriel', 'relative', 'mst'}
            'delaunay': the edges of the faces that the center sees; the others are parts of it.
            'urquhart': without edges longer than both others of a face. 'gabriel': no site in the
            closed circle with the edge as its diameter. 'relative': no site nearer to both ends.
            'mst': the shortest spanning tree, of equal edges those first in lexicographic order.

        Returns
        -------
        Graph
            Edges in lexicographic order, exact ties included. Duplicates have no edges but the
            lowest index of each place.

        Raises
        ------
        InvalidInput
            If the sites are weighted.

        """
        if kind not in _GRAPHS:
            raise ValueError(f"kind must be one of {', '.join(map(repr, _GRAPHS))}, not {kind!r}")
        return Graph(*_core.site_graph(self._triangulation, _GRAPHS.index(kind)))

    def edge_index(
        self, kind: GraphName = "delaunay", *, both: bool = True
    ) -> tuple[npt.NDArray[np.int64], FloatArray]:
        """A graph as PyTorch Geometric takes it.

        Parameters
        ----------
        kind : str
            As `graph` has it.
        both : bool, optional
            Each edge in both directions; otherwise from the lower index to the higher.

        Returns
        -------
        edge_index : ndarray of int64, shape (2, e)
            Sources and targets, in lexicographic order.
        lengths : ndarray of float64, shape (e,)
            Radians.

        """
        edges, lengths = self.graph(kind)
        ends = edges.T.astype(np.int64)
        if both:
            ends = np.concatenate([ends, ends[::-1]], axis=1)
            lengths = np.concatenate([lengths, lengths])
            order = np.lexsort((ends[1], ends[0]))
            ends, lengths = ends[:, order], lengths[order]
        return np.ascontiguousarray(ends), lengths

    def hull_polygon(self) -> Outline:
        """The convex hull on the sphere, the union of the faces that the center sees.

        Returns
        -------
        Outline
            One polygon: without rings, which is the whole sphere, if no closed hemisphere has all
            sites. No polygon below dimension 2.

        """
        return Outline(*_core.hull_polygon(self._triangulation))

    def alpha_shape(self, radius: float) -> Outline:
        """The union of the faces whose circle has at most this radius.

        Parameters
        ----------
        radius : float
            Radians.

        Returns
        -------
        Outline
            A polygon for each part that hangs together by edges.

        Raises
        ------
        InvalidInput
            If the radius is negative or not a number, or the sites are weighted.

        """
        return Outline(*_core.alpha_shape(self._triangulation, float(radius)))

    def largest_empty_circles(self, k: int = 1, *, anywhere: bool = False) -> EmptyCircles:
        """The largest circles of the faces, which have no site inside.

        Each touches three sites or more. Where all sites are in half of the sphere, a circle that
        touches two sites alone may be larger.

        Parameters
        ----------
        k : int
            How many; fewer if there are fewer.
        anywhere : bool, optional
            Centers may lie outside of the hull of the sites.

        Returns
        -------
        EmptyCircles
            The largest first.

        """
        count = operator.index(k)
        if count < 0:
            raise ValueError("k must not be negative")
        return EmptyCircles(*_core.largest_empty_circles(self._triangulation, count, anywhere))
