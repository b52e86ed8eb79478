# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The parts that Voronoi and power diagrams share."""

from __future__ import annotations

from functools import cached_property
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import ORIGIN, frozen
from ._dimensions import FlatMesh
from ._geo import CellShapes
from ._globe import Globes
from ._plot import CellPictures
from ._regions import CellRegions
from ._repr import Described
from ._tables import CellTables
from ._types import FloatArray, IntArray, Model, Triangulated

Kind = TypeVar("Kind", bound="Diagram[Any]")
Delaunay = TypeVar("Delaunay", bound=Triangulated)


class Cells(NamedTuple):
    """Cells in compressed rows.

    The ring of site i is ``rings[offsets[i]:offsets[i + 1]]``, rows of `points`, counterclockwise
    seen from outside. Its points are joined by the shorter arcs of great circles, none longer than
    120 degrees.
    """

    offsets: npt.NDArray[np.int64]
    rings: IntArray
    points: FloatArray


class Diagram(
    Described,
    CellShapes,  # to_geojson, to_geopandas, to_xarray
    CellTables,  # to_netcdf, to_parquet
    CellRegions,  # clip, dissolve
    CellPictures,  # plot
    Globes,  # save_html, view
    Generic[Delaunay],
):
    """The dual of a `SphericalDelaunay`. Attributes are computed when they are first read."""

    # The kind of diagram that is the dual of triangulations of a model. (Triangulations know only
    # this class, as the kinds know them.)
    _kinds: ClassVar[dict[str, type[Diagram[Any]]]] = {}

    def __init_subclass__(cls, *, model: Model | None = None, **options: Any) -> None:
        super().__init_subclass__(**options)
        if model is not None:
            cls._kinds[model] = cls

    @classmethod
    def _of(cls, delaunay: Any) -> Diagram[Any]:
        return cls._kinds[delaunay.model]._from_delaunay(delaunay)

    def _keep(self, delaunay: Any) -> None:
        self._delaunay = delaunay

    # What was found is found again, but for `vertices` and `regions` that the user has changed.
    def __getstate__(self) -> dict[str, Any]:
        state = self.__dict__.copy()
        if isinstance(self._delaunay, FlatMesh):
            return state
        for name in ("_diagram", "_ridges", "cells", "areas", "centroids"):
            state.pop(name, None)
        if "vertices" in state and np.array_equal(state["vertices"], self._found_vertices()):
            del state["vertices"]
        if "regions" in state and state["regions"] == self._found_regions():
            del state["regions"]
        return state

    @classmethod
    def _from_delaunay(cls: type[Kind], delaunay: Any) -> Kind:
        self = cls.__new__(cls)
        self._keep(delaunay)
        return self

    @cached_property
    def _diagram(self) -> _core.Diagram:
        return _core.diagram(self._delaunay._triangulation)

    def _on_sphere(self, directions: FloatArray) -> FloatArray:
        radius, center = self._delaunay.radius, self._delaunay._triangulation.center
        if radius == 1 and center == ORIGIN:
            return directions
        return radius * directions + np.array(center)

    @property
    def delaunay(self) -> Delaunay:
        """SphericalDelaunay: the triangulation, the dual of this diagram."""
        return self._delaunay

    @property
    def points(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the sites, read-only."""
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
        """Ndarray of int32, shape (d, 2): each row has a duplicate site and the site that
        represents its place. Duplicates have empty cells.
        """
        return self._delaunay.duplicates

    @property
    def _simplices(self) -> IntArray:
        return self._delaunay.simplices

    @cached_property
    def cells(self) -> Cells:
        """Cells: every cell, for any set of sites. Long borders, as of hemispheres and lunes, have
        points in between that make their arcs short. The cell of a single site is the whole sphere,
        which has no points.
        """
        d = self._diagram
        return Cells(d.offsets, d.rings, frozen(self._on_sphere(d.points)))

    @cached_property
    def vertices(self) -> FloatArray:
        """Ndarray of float64, shape (m, 3): the corners of the cells; vertex k is the center of the
        circle of face k. Below dimension 2 these are all points of `cells`. The array may be
        changed: nothing else depends on it.
        """
        return self._found_vertices().copy()

    def _found_vertices(self) -> FloatArray:
        points = self.cells.points
        faces = len(self._simplices)
        return points[:faces] if faces else points

    @cached_property
    def regions(self) -> list[list[int]]:
        """List of lists of int: the corners of each site's cell, positions in `vertices`,
        counterclockwise seen from outside. Empty for duplicates and hidden sites.

        Corners and neighbors (``delaunay.vertex_neighbor_vertices``) alternate around a cell, but
        the two lists begin anywhere: what lies across which border is in `ridge_points`.
        """
        return self._found_regions()

    def _found_regions(self) -> list[list[int]]:
        offsets, rings, _ = self.cells
        corners = rings < len(self._found_vertices())
        if not corners.all():
            offsets = np.concatenate([[0], np.cumsum(corners)])[offsets]
            rings = rings[corners]
        return _core.lists(rings, offsets)

    @cached_property
    def _ridges(self) -> tuple[IntArray, IntArray]:
        offsets, rings, points = self.cells
        sizes = np.diff(offsets)
        following = np.arange(1, len(rings) + 1)
        following[offsets[1:][sizes > 0] - 1] = offsets[:-1][sizes > 0]
        sites = np.repeat(np.arange(len(sizes), dtype=np.int32), sizes)
        begin, end = rings, rings[following]
        # A border is in two rings, once in each direction.
        key = np.minimum(begin, end) * np.int64(len(points)) + np.maximum(begin, end)
        there, back = np.flatnonzero(begin < end), np.flatnonzero(begin > end)
        there, back = there[np.argsort(key[there])], back[np.argsort(key[back])]
        first = np.where(sites[there] < sites[back], there, back)
        last = np.where(sites[there] < sites[back], back, there)
        order = np.lexsort((sites[last], sites[first]))
        first, last = first[order], last[order]
        ends = np.column_stack([begin[first], end[first]])
        return frozen(np.column_stack([sites[first], sites[last]])), frozen(ends)

    @property
    def ridge_points(self) -> IntArray:
        """Ndarray of int32, shape (r, 2): the two sites of each border between cells, the lower
        one first, sorted; as in `scipy.spatial.Voronoi`.
        """
        return self._ridges[0]

    @property
    def ridge_vertices(self) -> IntArray:
        """Ndarray of int32, shape (r, 2): the ends of each border of `ridge_points`, rows of
        ``cells.points``, the first of which are `vertices`. The cell of the first site is to the
        left of the arc. A border longer than 120 degrees is divided into several rows.
        """
        return self._ridges[1]

    @cached_property
    def areas(self) -> FloatArray:
        """Ndarray of float64, shape (n,): the areas of the cells in the squared unit of the radius;
        0 for duplicates and hidden sites. They are accurate for tiny cells too; their sum is
        4 pi radius**2.
        """
        areas = self._diagram.areas
        return areas if self.radius == 1 else frozen(areas * self.radius**2)

    @cached_property
    def centroids(self) -> FloatArray:
        """Ndarray of float64, shape (n, 3): the centers of mass of the cells, projected to the
        sphere; NaN if a cell is empty or its center of mass is the center of the sphere.
        """
        directions = _core.centroids(self._delaunay._triangulation)
        none = ~directions.any(axis=1)
        if none.any():
            directions[none] = np.nan
        return frozen(self._on_sphere(directions))

    def _facts(self) -> list[tuple[str, str]]:
        return self._delaunay._facts()
