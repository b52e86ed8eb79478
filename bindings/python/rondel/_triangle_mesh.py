# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of triangles for models of the ocean, and their files."""

from __future__ import annotations

import pathlib
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core
from ._arrays import as_floats, as_indices, as_name, as_rows, as_threads, as_vector, frozen
from ._errors import InvalidInput, warn_caller
from ._geometries import Edges, Invalid
from ._mesh_making import Spacing, raster_of, slope_of
from ._operands import operands
from ._pickled import arrays_of, with_arrays
from ._plot_mesh import plot_triangle_mesh
from ._repr import count
from ._types import ArrayLike, FloatArray, IntArray, Path, Progress

if TYPE_CHECKING:
    import meshio


class Boundary(NamedTuple):
    """A segment of the border of a `TriangleMesh`: a chain of its edges.

    Attributes
    ----------
    kind : {'open', 'land', 'island'}
        What is beyond it. Around an island the chain is closed.
    nodes : ndarray of int32
        The nodes in order, with the mesh to their left unless a file has them otherwise.
    type : int or None
        ADCIRC's IBTYPE, if it is another one than 0 for open water and land, 1 for islands.

    """

    kind: str
    nodes: IntArray
    type: int | None = None


class TriangleQuality(NamedTuple):
    """The measures on which the time step and the errors of a model depend.

    Attributes
    ----------
    smallest_angle : float
        The smallest angle of all triangles, in degrees.
    shortest_edge, longest_edge : float
        Lengths in radians.

    """

    smallest_angle: float
    shortest_edge: float
    longest_edge: float


class TriangleMesh:
    """Triangles on the sphere for models of the ocean, with depths and a border, all immutable.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        The nodes: longitude and latitude in degrees, or x, y, z. Those in no triangle are left
        out; the others keep their order.
    triangles : array_like of int, shape (m, 3)
        The nodes of each triangle, counterclockwise seen from outside.
    coast : array_like of int, shape (k, 2), optional
        The edges of the border that are coast, as pairs of nodes; the rest of the border is open
        water. By default all of it is coast.
    depths : array_like, shape (nodes that are left,), optional
        The depth of the water in metres, positive down.
    levels : array_like, optional
        The depths of the levels between layers in metres, three or more, increasing, for FESOM.

    Raises
    ------
    InvalidInput
        If a triangle is clockwise or has no area, or triangles do not fit together: an edge has
        three of them, or two in one direction; or if a pair of `coast` is not an edge of the
        border. Its `index` is that of the triangle or the pair.

    See Also
    --------
    read_triangles : reads files.

    Notes
    -----
    The border consists of loops. A loop that is coast and has less than half of the sphere beyond
    it is an island; others are divided into open and land segments, with the mesh to the left.
    Where triangles meet in a node without a common edge, each gap has a loop of its own.

    Examples
    --------
    >>> import rondel.mesh
    >>> lonlat = [[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]]
    >>> triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    >>> mesh = rondel.mesh.TriangleMesh(lonlat, triangles, coast=[[0, 1], [1, 2]])
    >>> mesh
    <TriangleMesh: 5 nodes, 4 triangles, 2 segments>
    >>> [(segment.kind, segment.nodes.tolist()) for segment in mesh.boundary]
    [('open', [2, 3, 0]), ('land', [0, 1, 2])]

    """

    def __init__(
        self,
        points: ArrayLike,
        triangles: ArrayLike,
        *,
        coast: ArrayLike | None = None,
        depths: ArrayLike | None = None,
        levels: ArrayLike | None = None,
    ) -> None:
        given = as_floats(points, "points")
        is_lonlat = given.ndim == 2 and given.shape[1] == 2
        nothing = np.empty(0)
        self._arrays = _core.mesh_of_triangles(
            np.empty((0, 3)) if is_lonlat else as_rows(points, 3, "points"),
            given if is_lonlat else np.empty((0, 2)),
            _rows_of_indices(triangles, 3, "triangles"),
            None if coast is None else _rows_of_indices(coast, 2, "coast"),
            nothing if depths is None else as_vector(depths, "depths"),
            nothing if levels is None else as_vector(levels, "levels"),
        )

    @classmethod
    def _of(cls, arrays: _core.TriangleMesh) -> TriangleMesh:
        mesh = cls.__new__(cls)
        mesh._arrays = arrays
        return mesh

    def __getstate__(self) -> dict[str, Any]:
        return arrays_of(self._arrays)

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._arrays = with_arrays(_core.TriangleMesh(), state)

    def __repr__(self) -> str:
        return (
            f"<TriangleMesh: {len(self.points)} nodes, {len(self.triangles)} triangles, "
            f"{len(self.boundary)} segments>"
        )

    @property
    def points(self) -> FloatArray:
        """The nodes, float64 of shape (n, 3): unit vectors, or as long as a file has them."""
        return self._arrays.points

    @property
    def lonlat(self) -> FloatArray:
        """The nodes in degrees, float64 of shape (n, 2), as given or computed."""
        positions = self._arrays.positions
        return positions if len(positions) else frozen(_core.lonlats(self.points))

    @property
    def triangles(self) -> IntArray:
        """The nodes of each triangle, int32 of shape (m, 3)."""
        return self._arrays.triangles

    @property
    def depths(self) -> FloatArray | None:
        """The depth at each node in metres, positive down, float64; None if it is not known."""
        return self._arrays.depths if len(self._arrays.depths) else None

    @property
    def levels(self) -> FloatArray | None:
        """The depths of the levels between layers in metres, float64; None if not known."""
        return self._arrays.levels if len(self._arrays.levels) else None

    @property
    def boundary(self) -> list[Boundary]:
        """The segments of the border."""
        return [Boundary(*segment) for segment in self._arrays.boundary]

    @property
    def pinched_nodes(self) -> IntArray:
        """The nodes with several gaps between triangles, which models refuse, int32."""
        return self._arrays.pinched_nodes()

    @property
    def quality(self) -> TriangleQuality:
        """TriangleQuality: the smallest angle and the extreme edges."""
        return TriangleQuality(*self._arrays.quality())

    def quality_picture(self, path: Path, *, num_worst: int = 20) -> None:
        """Draws histograms and a map of the triangles in colors of their smallest angle as an SVG.

        Parameters
        ----------
        path : path_like
            The file to write.
        num_worst : int, optional
            The number of smallest angles that get a circle, whose title names triangle and place;
            by default 20.

        """
        text = self._arrays.quality_picture(num_worst)
        pathlib.Path(as_name(path)).write_text(text, encoding="utf-8")

    plot = plot_triangle_mesh

    def write(self, path: Path, *, format: str | None = None, threads: int | None = None) -> None:
        """Writes a file, complete or not at all.

        Parameters
        ----------
        path : path_like
            The file to write: ``.msh`` (Gmsh 4.1), ``.14`` (ADCIRC's fort.14), ``.gr3`` and
            ``.ll`` (SCHISM), ``.2dm`` (SMS), or ``.nc`` (UGRID).
        format : str, optional
            'gmsh', 'gmsh2' (2.2), 'adcirc', 'schism', 'sms', 'ugrid', or 'fesom', for which `path`
            is a folder; by default the ending of the name decides.
        threads : int, optional
            The largest number of threads; by default one for each core.

        Raises
        ------
        OSError
            If the file cannot be written, or no format has such a name.
        InvalidInput
            If a depth is negative and the format is 'fesom'; or, in formats with degrees but for
            'ugrid', if a triangle has no area in them, as three nodes of one meridian have none
            (`leave_out_flat`).

        Warns
        -----
        UserWarning
            If the format does not hold levels, types or open segments of the mesh.

        Examples
        --------
        >>> import os, tempfile
        >>> import rondel.mesh
        >>> mesh = rondel.mesh.TriangleMesh([[0, 0], [4, 0], [4, 3]], [[0, 1, 2]], depths=[5, 6, 7])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     name = os.path.join(folder, "hgrid.gr3")
        ...     mesh.write(name)
        ...     rondel.mesh.read_triangles(name).depths
        array([5., 6., 7.])

        """
        name = as_name(path)
        for remark in self._arrays.write(name, format or "", as_threads(threads)):
            warnings.warn(f"{name}: {remark}", UserWarning, stacklevel=2)

    def to_meshio(self) -> meshio.Mesh:
        """Returns a mesh of meshio, which has to be installed.

        The triangles and the lines of the border are its cells, with the names of physical groups:
        'domain', 'open', 'land', 'island'; `depths` are the data 'depth' of its points.
        """
        import meshio

        cells: list[tuple[str, Any]] = [("triangle", self.triangles)]
        groups = [np.full(len(self.triangles), 4)]
        kinds = ("open", "land", "island")
        for kind, nodes, _ in self.boundary:
            ring = np.append(nodes, nodes[0]) if kind == "island" else nodes
            cells.append(("line", np.stack([ring[:-1], ring[1:]], axis=1)))
            groups.append(np.full(len(ring) - 1, 1 + kinds.index(kind)))
        names = {kind: np.array([1 + k, 1]) for k, kind in enumerate(kinds)}
        return meshio.Mesh(
            self.points,
            cells,
            point_data={} if self.depths is None else {"depth": self.depths},
            cell_data={"gmsh:physical": groups, "gmsh:geometrical": groups},
            field_data={**names, "domain": np.array([4, 2])},
        )


def _rows_of_indices(values: ArrayLike, columns: int, name: str) -> IntArray:
    """Rows of that many indices."""
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != columns:
        if array.size:
            raise ValueError(f"{name} must have shape (n, {columns}), not {array.shape}")
        return np.empty((0, columns), np.int32)
    return as_indices(array.ravel(), name).reshape(-1, columns)


def leave_out_flat(
    points: ArrayLike, triangles: ArrayLike, *, constraints: ArrayLike | None = None
) -> IntArray:
    """Leaves out triangles on the border that have no area in longitude and latitude.

    Models compute in this plane, where three nodes of one meridian, or of one parallel, have no
    area, whatever they have on the sphere; a triangulation of points has such slivers where its
    border is straight. They are left out from the border inwards, also those that are at most 1e-12
    degrees high, which rounding makes of them.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        The nodes: longitude and latitude in degrees, as the file will have them.
    triangles : array_like of int, shape (m, 3)
        The nodes of each triangle, counterclockwise seen from outside.
    constraints : array_like of int, shape (k, 2), optional
        Edges that stay, as pairs of nodes.

    Returns
    -------
    ndarray of int, shape (l, 3)
        The triangles that are left, in their order. One whose longest side in degrees is inside, or
        a constraint, stays, and so does one with a corner at a pole or a pole inside.

    Raises
    ------
    InvalidInput
        If a corner is no node. Its `index` is that of the triangle.

    Examples
    --------
    >>> import rondel.mesh
    >>> lonlat = [[0, 0], [5, 5], [0, 10], [0, 5]]
    >>> rondel.mesh.leave_out_flat(lonlat, [[0, 1, 3], [1, 2, 3], [0, 3, 2]]).tolist()
    [[0, 1, 3], [1, 2, 3]]

    """
    return _core.without_flat(
        as_rows(points, 2, "points"),
        _rows_of_indices(triangles, 3, "triangles"),
        np.empty((0, 2), np.int32)
        if constraints is None
        else _rows_of_indices(constraints, 2, "constraints"),
    )


def read_triangles(
    path: Path, *, format: str | None = None, threads: int | None = None
) -> TriangleMesh:
    r"""Reads a mesh of triangles: what `TriangleMesh.write` writes, and files of other programs.

    Parameters
    ----------
    path : path_like
        A file of Gmsh (text, 4.1 or 2.2, on a sphere around the origin), ADCIRC, SCHISM or SMS (in
        degrees), UGRID whose faces are triangles, or a folder of FESOM2.
    format : str, optional
        The format, as for `TriangleMesh.write`; by default the ending of the name decides.
    threads : int, optional
        The largest number of threads; by default one for each core.

    Returns
    -------
    TriangleMesh
        The mesh. Clockwise triangles are turned; a border of which the file says nothing is land.

    Raises
    ------
    OSError
        If the file cannot be read or is not valid; the message has the line and the value.

    Warns
    -----
    UserWarning
        If something was changed or left out.

    Examples
    --------
    >>> import os, tempfile
    >>> import rondel.mesh
    >>> text = "a lake\n1 3\n1 8.1 47.2 9\n2 8.3 47.2 5\n3 8.2 47.3 4\n1 3 1 2 3\n"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     name = os.path.join(folder, "fort.14")
    ...     with open(name, "w") as file:
    ...         _ = file.write(text)
    ...     rondel.mesh.read_triangles(name)
    <TriangleMesh: 3 nodes, 1 triangles, 2 segments>

    """
    name = as_name(path)
    found, remarks = _core.read_triangles(name, format or "", as_threads(threads))
    for remark in remarks:
        warnings.warn(f"{name}: {remark}", UserWarning, stacklevel=2)
    return TriangleMesh._of(found)


def triangles(
    coast: Any = None,
    *,
    area: Any = None,
    lines: Any = None,
    spacing: Spacing | None = None,
    gradient: float | None = None,
    tolerance: float | None = None,
    weld: float | None = None,
    smallest_angle: float = 26.5,
    fill_narrow: float = 0.0,
    smallest_part: float = 0.0,
    depths: Callable[[FloatArray], FloatArray] | None = None,
    raster_steps: int = 1024,
    edges: Edges = "lonlat",
    invalid: Invalid = "error",
    threads: int | None = None,
    progress: Progress = None,
) -> TriangleMesh:
    """Fills an ocean with triangles whose edges follow the coast.

    Parameters
    ----------
    coast : geometries, optional
        Polygons of land, which the mesh leaves out: of shapely, GeoPandas, GeoArrow or GeoJSON.
        Lines are edges of the mesh.
    area : geometries, optional
        Polygons inside of which the mesh is; by default everywhere. Geometries without a polygon
        are an error.
    lines : geometries, optional
        Lines and sides of polygons that are edges inside, and points that are nodes. A warning says
        how many are outside of the mesh: on land, outside of `area`, or too small to stay.
    spacing : float or callable, optional
        The length of edges in radians: a number, or a function of places, float64 of shape (n, 3),
        that returns n numbers. No edge is longer than 1.5 times the spacing at its ends. By default
        edges are as long as angles allow.
    gradient : float, optional
        The largest growth of the spacing per distance, positive; by default it is not limited. It
        needs `spacing`.
    tolerance : float, optional
        How far coasts, borders and lines of the mesh may be from those given, in radians. They are
        simplified with their topology kept; islands and lakes that are nowhere wider vanish. By
        default a quarter of the spacing, or 0 without one.
    weld : float, optional
        Corners that are nearer than this to a corner or a side of another outline, in radians, are
        put there first, as where rounded borders leave gaps and overlaps; by default 1e-4 of the
        spacing, at most the tolerance.
    smallest_angle : float, optional
        The smallest angle of triangles in degrees, up to 33; by default 26.5. Triangles near
        places where coasts, borders or lines meet at less than 60 degrees may have smaller ones.
    fill_narrow : float, optional
        Straits, coves and fjords that are narrower than this share of the spacing become land, as
        they would have edges as short; from 0 (default) to 1.
    smallest_part : float, optional
        Parts of the mesh that are smaller than this share of the largest part are left out; from
        0 (default) to 1, which keeps the largest part alone.
    depths : callable, optional
        A function of the nodes, float64 of shape (n, 3), that returns the depths there in metres,
        positive down.
    raster_steps : int, optional
        The function of the spacing is sampled at this many places along the longer side of a
        rectangle around `area`, as far as 16 million places in all; without an area, or for one
        that reaches farther than 45 degrees from its middle, along a quarter of a great circle, a
        power of two. By default 1024.
    edges : {'lonlat', 'geodesic'}, optional
        What joins the positions of geometries: straight lines in longitude and latitude (default),
        or arcs of great circles.
    invalid : {'error', 'repair'}, optional
        What becomes of polygons that are not valid.
    threads : int, optional
        The largest number of threads; by default one for each core. It changes no result.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.

    Returns
    -------
    TriangleMesh
        The mesh; sides of `coast` are land or islands of its border, others are open. Its
        longitudes are from -180 to 180, or in the turn of those given, as from 0 to 360: those of
        `area` if it has some, else of `coast` and `lines`.

    Raises
    ------
    ValueError
        If geometries are not valid, a number is not as described, nothing is left to fill, the
        spacing asks for more nodes than a mesh may have, or a depth is not finite.
    TypeError
        If `spacing` is neither a number nor a function, `depths` is no function, or `gradient` is
        given without `spacing`.

    See Also
    --------
    scvt : meshes of Voronoi cells.

    Notes
    -----
    Delaunay refinement (L. P. Chew, "Guaranteed-quality mesh generation for curved surfaces", SoCG
    1993) with off-centers (A. Üngör, "Off-centers: a new type of Steiner points for computing
    size-optimal quality-guaranteed Delaunay triangulations", Computational Geometry 42, 2009);
    docs/theory/refinement.md says what is guaranteed.

    Examples
    --------
    The sea around an island, in edges of about 1 degree:

    >>> import math, rondel.mesh, shapely
    >>> sea, island = shapely.box(0, 0, 10, 8), shapely.box(4, 3, 6, 5)
    >>> mesh = rondel.mesh.triangles(island, area=sea, spacing=math.radians(1))
    >>> [(segment.kind, len(segment.nodes)) for segment in mesh.boundary]
    [('open', 17), ('open', 17), ('island', 8)]

    """
    if gradient is not None and spacing is None:
        raise TypeError("gradient limits the growth of spacing, which is not given")
    if depths is not None and not callable(depths):
        raise TypeError("depths is no function of the nodes")
    given = {"coast": coast, "area": area, "lines": lines}
    present = {name: value for name, value in given.items() if value is not None}
    parts = dict.fromkeys(given, _core.Geometries())
    found = operands(present, edges, threads, invalid) if present else []
    for operand in found:
        parts[operand.name] = operand.geometries()
    if not present and spacing is None:
        raise TypeError("triangles() needs coast, area or spacing")
    nothing = np.empty((0, 2))
    steps = raster_steps if callable(spacing) else 1
    within = parts.pop("area")
    of_area = [operand.longitudes for operand in found if operand.name == "area"]
    of_others = [operand.longitudes for operand in found if operand.name != "area"]
    made, too_small, lines_outside = _core.triangles_of_domain(
        **parts,
        # A missing area is the sphere, and an area without features is none.
        area=None if area is None else within,
        spacings=raster_of(spacing, steps, None if area is None else within),
        steps=steps,
        gradient=slope_of(gradient),
        tolerance=None if tolerance is None else float(tolerance),
        weld=None if weld is None else float(weld),
        smallest_angle=float(smallest_angle),
        fill_narrow=float(fill_narrow),
        smallest_part=float(smallest_part),
        west_deg=_core.west_of(
            *(np.concatenate([nothing, *rows]) for rows in (of_area, of_others))
        ),
        threads=as_threads(threads),
        progress=progress,
    )
    if too_small:
        warn_caller(
            f"{count(too_small, 'triangle is', 'triangles are')} not as wanted where "
            "doubles have no place between the corners"
        )
    if lines_outside:
        number = count(len(lines_outside), "feature of lines is", "features of lines are")
        warn_caller(f"{number} outside of the mesh, the first one {lines_outside[0]}")
    mesh = TriangleMesh._of(made)
    if depths is None:
        return mesh
    known = as_vector(depths(mesh.points), "depths", len(mesh.points))
    for node in np.flatnonzero(~np.isfinite(known))[:1]:
        lon, lat = mesh.lonlat[node]
        raise InvalidInput(
            f"depths are {known[node]} at node {node}, at longitude {lon:.6g}, latitude {lat:.6g}, "
            "where a finite number is needed",
            int(node),
        )
    made.depths = known
    return mesh
