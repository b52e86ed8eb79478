# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Voronoi diagrams."""

from __future__ import annotations

from typing import Literal

import numpy as np

from . import _core
from ._arrays import as_center, as_kept, as_vector
from ._delaunay import SphericalDelaunay, delaunay_lonlat
from ._diagram import Diagram
from ._dimensions import circle_diagram, general_diagram
from ._errors import InvalidInput
from ._types import ArrayLike, FloatArray, IntArray, Progress

WhatIfDuplicates = Literal["raise", "merge"]


class SphericalVoronoi(Diagram[SphericalDelaunay], model="projected"):
    """The Voronoi diagram of points on a sphere; it replaces `scipy.spatial.SphericalVoronoi`.

    Attributes, methods and errors are those of SciPy; the notes list the differences.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        The sites, on the sphere up to `threshold`. With shape (n, 2) they are points on a circle;
        arrays with more columns are passed to SciPy.
    radius : float, optional
        The radius of the sphere, in the unit of the points; by default 1.
    center : array_like, shape (3,), optional
        The center of the sphere; by default the origin.
    threshold : float, optional
        The largest distance of a point from the sphere, in radii; by default 1e-6. ``numpy.inf``
        accepts any distance.
    duplicates : {'raise', 'merge'}, optional
        What to do with points in the same place, which means exactly on the same ray. 'raise'
        (default) raises an error. 'merge' gives the cell to the first of them and empty cells to
        the others.
    threads : int, optional
        The largest number of threads; by default one for each core.
    progress : callable or bool, optional
        Called as ``progress(stage, fraction)``; an exception that it raises ends the work.
        True shows a `ProgressBar`.
    copy : bool, optional
        Whether to copy the points, as in `delaunay`; by default True.

    Attributes
    ----------
    points, radius, center, vertices, regions
        As in SciPy. All arrays but `vertices` are read-only.
    cells, areas, centroids, ridge_points, ridge_vertices, duplicates, delaunay
        Attributes that SciPy lacks: cells in compressed rows, their areas, centroids and borders,
        and the triangulation.

    Raises
    ------
    InvalidInput
        If a point is not finite, is at the center, or is a duplicate that is not merged. It is a
        `ValueError` whose `index` is the bad point.
    ValueError
        If points are farther than `threshold` from the sphere.

    Notes
    -----
    These differences from SciPy are deliberate:

    1. `vertices` are numbered by the canonical order of the faces, not by Qhull's.
    2. Every set of sites has a diagram: one, two, all on a great circle. SciPy demands rank 3.
    3. Only points in the same place are duplicates. SciPy raises for points within `threshold`.
    4. `regions` are always sorted, and `sort_vertices_of_regions` has nothing to do.
    5. Of points on a circle, `calculate_areas` gives the arc of each site, where SciPy gives those
       between two sites.

    References
    ----------
    Caroli et al., SEA 2010; areas of cells: Van Oosterom and Strackee, IEEE Transactions on
    Biomedical Engineering 2, 1983.

    Examples
    --------
    >>> import math, rondel
    >>> sv = rondel.SphericalVoronoi([[0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0],
    ...                               [0, -1, 0]])
    >>> sv.vertices.shape
    (8, 3)
    >>> len(sv.regions[0])
    4
    >>> math.isclose(sv.calculate_areas()[0], 4 * math.pi / 6)
    True

    """

    def __init__(
        self,
        points: ArrayLike,
        radius: float = 1,
        center: ArrayLike | None = None,
        threshold: float = 1e-06,
        *,
        duplicates: WhatIfDuplicates = "raise",
        threads: int | None = None,
        progress: Progress = None,
        copy: bool = True,
    ) -> None:
        if radius is None:
            raise ValueError(
                "`radius` is `None`. Please provide a floating point number (i.e. `radius=1`)."
            )
        if duplicates not in ("raise", "merge"):
            raise ValueError(f"duplicates must be 'raise' or 'merge', not {duplicates!r}")
        shape = np.shape(points)
        if len(shape) == 2 and shape[1] != 3:
            kept = as_kept(points, copy=copy, columns=shape[1])
            self._be_flat(kept, float(radius), center, threshold, duplicates, threads)
            return
        built = SphericalDelaunay(
            points, radius=radius, center=center, threads=threads, progress=progress, copy=copy
        )
        off = _core.largest_discrepancy(built.points, as_center(center), built.radius)
        _check_radius(off, threshold * built.radius)
        _check_duplicates(built.duplicates, duplicates)
        self._keep(built)

    def _be_flat(
        self,
        points: FloatArray,
        radius: float,
        center: ArrayLike | None,
        threshold: float,
        duplicates: WhatIfDuplicates,
        threads: int | None,
    ) -> None:
        if points.shape[1] < 2:
            raise ValueError(f"points must have shape (n, 3), not {points.shape}")
        dimensions = points.shape[1]
        center = as_vector(np.zeros(dimensions) if center is None else center, "center", dimensions)
        if dimensions > 2:
            mesh, attributes = general_diagram(points, radius, center, threshold)
        else:
            mesh, attributes = circle_diagram(points, radius, center, threads)
            off = np.abs(np.linalg.norm(points - center, axis=1) - radius).max()
            hint = "; SphericalVoronoi.from_lonlat(lon, lat) takes longitudes and latitudes"
            _check_radius(off, threshold * radius, hint)
            _check_duplicates(mesh.duplicates, duplicates)
        self._keep(mesh)
        self.__dict__.update(attributes)

    @classmethod
    def from_lonlat(
        cls,
        lon: ArrayLike,
        lat: ArrayLike,
        *,
        duplicates: WhatIfDuplicates = "merge",
        threads: int | None = None,
        progress: Progress = None,
    ) -> SphericalVoronoi:
        """Computes the diagram of longitudes and latitudes, on the unit sphere.

        Parameters
        ----------
        lon, lat : array_like, shape (n,)
            Longitudes and latitudes of the sites in degrees; latitudes are from -90 to 90.
        duplicates : {'merge', 'raise'}, optional
            As in `SphericalVoronoi`, but by default 'merge'.
        threads, progress
            As in `SphericalVoronoi`.

        Returns
        -------
        SphericalVoronoi
            The diagram; its `delaunay` is the triangulation, whose `lonlat` has the degrees.

        Raises
        ------
        InvalidInput
            If an angle is not finite, a latitude is outside [-90, 90], or a site is a duplicate
            that is not merged.

        Examples
        --------
        >>> import rondel
        >>> sv = rondel.SphericalVoronoi.from_lonlat([0, 90, 180, -90, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> (6 * sv.areas / 3.141592653589793).round(9).tolist()
        [4.0, 4.0, 4.0, 4.0, 4.0, 4.0]

        """
        built = delaunay_lonlat(lon, lat, threads=threads, progress=progress)
        _check_duplicates(built.duplicates, duplicates)
        return cls._from_delaunay(built)

    def sort_vertices_of_regions(self) -> None:
        """Does nothing: the vertices of each region are always sorted around its site.

        Raises
        ------
        TypeError
            If the points are not three-dimensional.

        """
        if self.points.shape[1] != 3:
            raise TypeError("Only supported for three-dimensional point sets")

    def calculate_areas(self) -> FloatArray:
        """Returns the areas of the cells.

        Returns
        -------
        ndarray of float64, shape (n,)
            A new array with the areas in the squared unit of the radius; see `areas`.

        """
        return self.areas.copy()


def _check_radius(off: float, threshold: float, hint: str = "") -> None:
    if not off < threshold:
        raise ValueError(
            f"Radius inconsistent with generators: a point is {off:.3g} off the sphere, the "
            f"threshold is {threshold:.3g}{hint}"
        )


def _check_duplicates(duplicates: IntArray, what: WhatIfDuplicates) -> None:
    if what == "merge" or len(duplicates) == 0:
        return
    site, first = (int(i) for i in duplicates[0])
    raise InvalidInput(
        f"Duplicate generators present: point {site} is in the same place as point {first}; "
        "duplicates='merge' merges them",
        site,
    )
