// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Duals of a triangulation: Voronoi diagrams and, in the weighted model,
/// power (Laguerre) diagrams.
///
/// cells(), areas(), diagram() and centroids() throw InvalidInput for a triangulation with
/// constraints (rondel/constrained.h) whose faces are not Delaunay. The other functions take each
/// face or edge by itself.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// The cells of a diagram: the ring of site i is `rings[i]`, indices into `points`,
/// counterclockwise seen from outside.
///
/// 1. `points` begins with the circumcenters of the faces, so that below
///    num_faces() an index in a ring is a face. Further points follow where an arc
///    would be longer than 120 degrees, and in dimensions 0 and 1.
/// 2. Consecutive points of a ring are joined by the shorter arc of a great circle.
/// 3. Duplicates and hidden sites have empty rings. So has a single vertex, whose
///    cell is the whole sphere.
struct Cells {
  CompressedRows<Index> rings;  ///< a row for each site
  std::vector<Point> points;    ///< unit vectors from the center of the sphere
};

/// Cells and their areas.
struct Diagram {
  Cells cells;
  std::vector<double> areas;  ///< steradians, for each site; 0 for duplicates and hidden sites
};

/// Computes the circumcenters of the faces (power centers in the weighted model), shape (m, 3):
/// outward unit normals, also for ghost faces. The distance from the exact value is at most 4 ulp
/// (4 * 2^-53), whatever the shape of the face.
RONDEL_API std::vector<Point> circumcenters(const Triangulation& triangulation,
                                            const Execution& execution = {});

/// Computes the Voronoi or power cells of all sites, in every dimension.
RONDEL_API Cells cells(const Triangulation& triangulation, const Execution& execution = {});

/// Computes the areas of the cells in steradians, one for each site; 0 for duplicates and hidden
/// sites. The relative error is small for tiny cells too, as long as their sites are at least 1e-28
/// radians apart. The sum is 4 pi.
RONDEL_API std::vector<double> areas(const Triangulation& triangulation,
                                     const Execution& execution = {});

/// Computes the cells and their areas together, which takes little more time than one of them.
RONDEL_API Diagram diagram(const Triangulation& triangulation, const Execution& execution = {});

/// Computes the directions of the cells' centers of mass, unit vectors of shape (n, 3); (0, 0, 0)
/// where the center of mass is the center of the sphere or the cell is empty.
RONDEL_API std::vector<Point> centroids(const Triangulation& triangulation,
                                        const Execution& execution = {});

/// Returns the edges, each once with the lower index first, in lexicographic order.
RONDEL_API std::vector<std::array<Index, 2>> edges(const Triangulation& triangulation);

/// Returns the facets of cocircular sites: faces that lie exactly in one plane are merged into one
/// polygon (a cube has 6 facets, not 12). A row has the corners of a polygon, as input indices
/// counterclockwise seen from outside, and begins with its lowest index.
RONDEL_API CompressedRows<Index> merge_cocircular(const Triangulation& triangulation,
                                                  const Execution& execution = {});

}  // namespace rondel
