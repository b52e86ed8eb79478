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


class Graph(NamedTuple):
    """A graph of sites.

    Attributes
    ----------
    edges : ndarray of int32, shape (e, 2)
        The two sites of each edge, the lower index first.
    lengths : ndarray of float64, shape (e,)
        The lengths of the edges in radians.

    """

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
    """Circles without sites inside.

    Attributes
    ----------
    centers : ndarray of float64, shape (k, 3)
        Unit vectors to the centers.
    radii : ndarray of float64, shape (k,)
        Angular radii in radians.
    sites : ndarray of int32, shape (k, 3)
        Three sites on each circle.

    """

    centers: FloatArray
    radii: FloatArray
    sites: IntArray


class Graphs:
    """The graphs, hulls and circles that triangulations contain."""

    _triangulation: Any

    def graph(self, kind: GraphName = "delaunay") -> Graph:
        """Returns a graph of near sites.

        Parameters
        ----------
        kind : {'delaunay', 'urquhart', 'gabriel', 'relative', 'mst'}, optional
            'delaunay' (default): the edges of the solid faces, of which the other graphs are
            subsets. 'urquhart': without edges that are the longest of a face. 'gabriel': edges
            whose closed diametral circle contains no other site. 'relative' (relative neighborhood
            graph): edges without a site that is nearer to both ends. 'mst': the minimum spanning
            tree; of equal edges the first in lexicographic order is taken.

        Returns
        -------
        Graph
            The edges in lexicographic order, and their lengths; ties are decided exactly. Of
            duplicates only the lowest index has edges.

        Raises
        ------
        InvalidInput
            If the sites are weighted.
        ValueError
            If there is no such kind.

        Examples
        --------
        >>> import rondel
        >>> tri = rondel.delaunay_lonlat([0, 10, 25, 180], [0, 0, 0, 10])
        >>> tri.graph("mst").edges.tolist()
        [[0, 1], [1, 2], [2, 3]]

        """
        return Graph(**_core.site_graph(self._triangulation, kind))

    def edge_index(
        self, kind: GraphName = "delaunay", *, both: bool = True
    ) -> tuple[npt.NDArray[np.int64], FloatArray]:
        """Returns a graph in the form of PyTorch Geometric.

        Parameters
        ----------
        kind : {'delaunay', 'urquhart', 'gabriel', 'relative', 'mst'}, optional
            As in `graph`; by default 'delaunay'.
        both : bool, optional
            Whether each edge occurs in both directions (default), or only from the lower index to
            the higher.

        Returns
        -------
        edge_index : ndarray of int64, shape (2, e)
            Sources and targets, in lexicographic order.
        lengths : ndarray of float64, shape (e,)
            The lengths of the edges in radians.

        Raises
        ------
        InvalidInput
            If the sites are weighted.

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
        """Returns the convex hull on the sphere, which is the union of the solid faces.

        Returns
        -------
        Outline
            One polygon, which has no rings and is the whole sphere if no closed hemisphere contains
            all sites. There is no polygon below dimension 2.

        """
        return Outline(**_core.hull_polygon(self._triangulation))

    def alpha_shape(self, radius: float) -> Outline:
        """Returns the union of the solid faces whose circle has at most a given radius.

        Parameters
        ----------
        radius : float
            The largest radius of a circle in radians.

        Returns
        -------
        Outline
            A polygon for each part that is connected by edges.

        Raises
        ------
        InvalidInput
            If the radius is negative or NaN, or the sites are weighted.

        """
        return Outline(**_core.alpha_shape(self._triangulation, float(radius)))

    def largest_empty_circles(self, k: int = 1, *, anywhere: bool = False) -> EmptyCircles:
        """Returns the largest circles of the faces, which have no site inside.

        Each of them touches three or more sites. If all sites are in one half of the sphere, a
        circle that touches only two sites may be larger.

        Parameters
        ----------
        k : int, optional
            The number of circles; by default 1. There are fewer if there are fewer faces.
        anywhere : bool, optional
            Whether centers may lie outside of the hull of the sites; by default False.

        Returns
        -------
        EmptyCircles
            The circles, the largest first.

        Raises
        ------
        ValueError
            If k is negative.

        """
        count = operator.index(k)
        if count < 0:
            raise ValueError("k must not be negative")
        return EmptyCircles(**_core.largest_empty_circles(self._triangulation, count, anywhere))
