# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What Voronoi and power diagrams have in common."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from . import _core, _geo, _plot
from ._arrays import ORIGIN
from ._delaunay import SphericalDelaunay
from ._dimensions import FlatMesh
from ._repr import Described
from ._types import FloatArray, IntArray

Kind = TypeVar("Kind", bound="Diagram")


class Cells(NamedTuple):
    """Cells in compressed rows: the ring of site i is ``rings[offsets[i]:offsets[i + 1]]``,
    positions in `points`, counterclockwise seen from outside. Its points are joined by the shorter
    arcs of great circles, none longer than 120 degrees.
    """

    offsets: npt.NDArray[np.int64]
    rings: IntArray
    points: FloatArray


class Diagram(Described):
    """The dual of a triangulation; found when it is first asked for."""

    def _keep(self, delaunay: Any) -> None:
        self._delaunay = delaunay

    def __getstate__(self) -> dict[str, Any]:
        state = self.__dict__.copy()
        if isinstance(self._delaunay, FlatMesh):
            return state
        for name in ("_diagram", "cells", "areas", "centroids", "vertices", "regions"):
            state.pop(name, None)
        return state

    @classmethod
    def _from_delaunay(cls: type[Kind], delaunay: SphericalDelaunay) -> Kind:
        self = cls.__new__(cls)
        self._keep(delaunay)
        return self

    @cached_property
    def _diagram(self) -> _core.Diagram:
        return _core.diagram(self._delaunay._triangulation, self._delaunay.points, None)

    def _on_sphere(self, directions: FloatArray) -> FloatArray:
        radius, center = self._delaunay.radius, self._delaunay._triangulation.center
        if radius == 1 and center == ORIGIN:
            return directions
        return radius * directions + np.array(center)

    @property
    def delaunay(self) -> SphericalDelaunay:
        """SphericalDelaunay: the triangulation, the dual of this diagram."""
        return self._delaunay

    @property
    def points(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the sites, not copied. Do not change them."""
        return self._delaunay.points

    @property
    def radius(self) -> float:
        """float: the radius of the sphere."""
        return self._delaunay.radius

    @property
    def center(self) -> FloatArray:
        """Ndarray of float64, shape (3,): the center of the sphere."""
        return self._delaunay.center

    @property
    def duplicates(self) -> IntArray:
        """Ndarray of int32, shape (d, 2): rows of a site and the one in the same place that stands
        for it. Duplicates have empty cells.
        """
        return self._delaunay.duplicates

    @property
    def _simplices(self) -> IntArray:
        return self._delaunay.simplices

    @cached_property
    def cells(self) -> Cells:
        """Cells: every cell, whatever the sites are. Hemispheres and lunes have as many points on
        their boundary as make its arcs short; a single site's cell, the whole sphere, none.
        """
        d = self._diagram
        return Cells(d.offsets, d.rings, self._on_sphere(d.points))

    @cached_property
    def vertices(self) -> FloatArray:
        """Ndarray of float64, shape (m, 3): the corners of the cells; vertex k is the center of the
        circle of face k. Below dimension 2, all points of `cells`.
        """
        points = self.cells.points
        faces = len(self._simplices)
        return points[:faces] if faces else points

    @cached_property
    def regions(self) -> list[list[int]]:
        """List of lists of int: the corners of each site's cell, positions in `vertices`,
        counterclockwise seen from outside. Empty for duplicates and hidden sites.
        """
        offsets, rings, _ = self.cells
        corners = rings < len(self.vertices)
        if not corners.all():
            offsets = np.concatenate([[0], np.cumsum(corners)])[offsets]
            rings = rings[corners]
        return _core.lists(rings, offsets)

    @cached_property
    def areas(self) -> FloatArray:
        """Ndarray of float64, shape (n,): the areas of the cells, in units of the radius squared;
        0 for duplicates and hidden sites. Accurate for tiny cells too; the sum is
        4 pi radius**2.
        """
        areas = self._diagram.areas
        return areas if self.radius == 1 else areas * self.radius**2

    @cached_property
    def centroids(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the cells' centers of mass, moved out to the sphere;
        nan where a cell is empty or its center of mass is that of the sphere.
        """
        directions = _core.centroids(
            self._delaunay._triangulation, self._delaunay.points, self._diagram
        )
        none = ~directions.any(axis=1)
        if none.any():
            directions[none] = np.nan
        return self._on_sphere(directions)

    def _facts(self) -> list[tuple[str, str]]:
        return self._delaunay._facts()

    to_geojson = _geo.cells_to_geojson
    to_geopandas = _geo.to_geopandas
    to_xarray = _geo.cells_to_xarray
    plot = _plot.plot_cells
