# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Exact Delaunay triangulations and Voronoi diagrams of points on the sphere.

Functions
---------
delaunay, delaunay_lonlat
    Triangulate points, or longitudes and latitudes.
power_diagram
    The cells of circles.
constrained_delaunay, check_constrained
    Triangulations with given edges, and the proof of one.
convex_hull
    The hull of any points in space.
area_weights
    The area of each point's cell, also at the borders of regional domains.
feature_cells
    The cells of lines and polygons: which of them is nearest.
remap
    Conservative weights between two sets of cells.
check_weights
    What is wrong with weights, of whichever program, by themselves and by the cells' areas.
lonlat_grid, polygons
    Cells for it: a grid of the whole sphere, and polygons of files and libraries.
overlay, intersection, union, union_all, difference, symmetric_difference
    Set operations on points, lines and polygons, with the names of GeoPandas and shapely.
relate, relate_pattern
    How geometries lie to each other.
intersects, disjoint, contains, within, covers, covered_by, touches, crosses, overlaps, equals
    Questions about that.
buffer
    The places within a distance of points, lines and polygons.
simplify
    Lines and polygons with fewer corners and the same topology.
area, length
    Measures of geometries on the sphere.
make_valid, is_valid, validity_reason
    Polygons that are not valid.
interpolate
    Values at longitudes and latitudes, from values at others.
native_weights
    Weights that interpolate in the faces of a mesh.
native_isolines, native_bands
    Lines and areas of equal values in the faces of a mesh.
unit_vectors, lonlat
    Degrees to unit vectors and back.

Modules
-------
rondel.mesh
    Meshes of models: arrays, quality, files.
rondel.data
    Small samples: weather stations, land and countries.
rondel.out_of_core
    Triangulations that are larger than the memory, from files to files.
rondel.distributed
    Triangulations by several processes, with MPI or without.
rondel.xarray
    The accessor `rondel` of Datasets, which interpolates.

Classes
-------
SphericalVoronoi
    In place of `scipy.spatial.SphericalVoronoi`.
SphericalDelaunay, ConstrainedDelaunay, PowerDiagram, ConvexHull
    Results.
DynamicTriangulation, DynamicConstrainedTriangulation
    Sites that come, go and move; sites and given edges that come and go.
SphericalInterpolator
    In place of `scipy.interpolate.LinearNDInterpolator`.
CellSet
    Cells of diagrams, grids, models and polygons, for `remap`.
regrid, regrid_file
    Datasets and files on another grid, which may be a name such as "healpix:7".
zonal_statistics
    Means, extremes, quantiles and more of fields in polygons, as a table of pandas.
Regridder
    In place of `xesmf.Regridder`.
Regions
    Cells that were clipped by polygons, or joined.
Isolines, Bands
    Lines of equal value, and the regions between them.
Weights
    What carries values from sites to targets, as a sparse matrix.
ProgressBar
    Shows how far a long call is, and how long it will take.

Notes
-----
No result depends on `threads`, the largest number of threads that a call uses. What is passed as
`progress` is called some times a second with the name of a stage of the work and the fraction of
it that is done; with True a `ProgressBar` shows that in notebooks and terminals.

"""

from typing import TYPE_CHECKING, Any

from . import _core
from . import mesh as mesh
from ._area_weights import area_weights
from ._arrays import lonlat, point_set_hash, unit_vectors
from ._buffer import buffer
from ._cell_set import CellSet
from ._cells import lonlat_grid, polygons
from ._constrained import ConstrainedDelaunay, check_constrained, constrained_delaunay
from ._contours import Bands, Isolines
from ._delaunay import CheckReport, SphericalDelaunay, delaunay, delaunay_lonlat
from ._diagram import Cells
from ._dynamic import DynamicTriangulation, Snapshot
from ._dynamic_constrained import ConstrainedSnapshot, DynamicConstrainedTriangulation
from ._errors import CrossingConstraints, FileError, InvalidInput
from ._hull import ConvexHull, convex_hull
from ._interpolator import SphericalInterpolator, interpolate
from ._mesh import Lists
from ._native import native_bands, native_isolines, native_weights
from ._netcdf import netcdf_library as _netcdf_library
from ._plot import LonLatTriangles
from ._polygons import (
    area,
    difference,
    intersection,
    length,
    overlay,
    symmetric_difference,
    union,
    union_all,
)
from ._power import PowerDiagram, power_diagram
from ._progress import ProgressBar
from ._queries import Location, Where
from ._regions import Regions, feature_cells
from ._regrid import regrid
from ._regrid_files import RegridReport, regrid_file
from ._regridder import Regridder
from ._relations import (
    contains,
    covered_by,
    covers,
    crosses,
    disjoint,
    equals,
    intersects,
    overlaps,
    relate,
    relate_pattern,
    touches,
    within,
)
from ._remap import Remap, remap
from ._simplify import simplify
from ._validity import is_valid, make_valid, validity_reason
from ._voronoi import SphericalVoronoi
from ._weight_checks import (
    ComparedRow,
    WeightComparison,
    WeightFault,
    WeightReport,
    check_weights,
)
from ._weights import Weights, read_weights
from ._zonal import zonal_statistics

if TYPE_CHECKING:
    from . import data as data
    from . import distributed as distributed
    from . import out_of_core as out_of_core

__version__ = _core.version

if (_found := _netcdf_library()) is not None:
    _core.set_netcdf_library(_found)

__all__ = [
    "Bands",
    "CellSet",
    "Cells",
    "CheckReport",
    "ComparedRow",
    "ConstrainedDelaunay",
    "ConstrainedSnapshot",
    "ConvexHull",
    "CrossingConstraints",
    "DynamicConstrainedTriangulation",
    "DynamicTriangulation",
    "FileError",
    "InvalidInput",
    "Isolines",
    "Lists",
    "Location",
    "LonLatTriangles",
    "PowerDiagram",
    "ProgressBar",
    "Regions",
    "RegridReport",
    "Regridder",
    "Remap",
    "Snapshot",
    "SphericalDelaunay",
    "SphericalInterpolator",
    "SphericalVoronoi",
    "WeightComparison",
    "WeightFault",
    "WeightReport",
    "Weights",
    "Where",
    "area",
    "area_weights",
    "buffer",
    "check_constrained",
    "check_weights",
    "constrained_delaunay",
    "contains",
    "convex_hull",
    "covered_by",
    "covers",
    "crosses",
    "delaunay",
    "delaunay_lonlat",
    "difference",
    "disjoint",
    "equals",
    "feature_cells",
    "interpolate",
    "intersection",
    "intersects",
    "is_valid",
    "length",
    "lonlat",
    "lonlat_grid",
    "make_valid",
    "native_bands",
    "native_isolines",
    "native_weights",
    "overlaps",
    "overlay",
    "point_set_hash",
    "polygons",
    "power_diagram",
    "read_weights",
    "regrid",
    "regrid_file",
    "relate",
    "relate_pattern",
    "remap",
    "simplify",
    "symmetric_difference",
    "touches",
    "union",
    "union_all",
    "unit_vectors",
    "validity_reason",
    "within",
    "zonal_statistics",
]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """The modules that few programs need, when they are asked for."""
        if name not in ("data", "distributed", "out_of_core"):
            raise AttributeError(f"module 'rondel' has no attribute {name!r}")
        import importlib

        return importlib.import_module(f"rondel.{name}")


def __dir__() -> list[str]:
    """List the names that are for users, and the modules."""
    return sorted([*__all__, "__version__", "data", "distributed", "mesh", "out_of_core"])
