// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Triangles that fill polygons, for drawing them on a globe (target rondel::geo).
#pragma once

#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// The triangles of polygons.
struct PolygonTriangles {
  std::vector<Point> points;  ///< unit vectors, each of which is a corner of a triangle
  /// Row i has the triangles of polygon i: indices of points, counterclockwise seen from outside. A
  /// triangle of two polygons, which overlap, is in both rows.
  CompressedRows<Triple> triangles;
};

/// Triangulates polygons together, by constrained_delaunay() and faces_inside().
///
/// 1. The triangles of a polygon fill it once and never leave it: its sides are chains of edges.
///    Polygons may be around poles, have holes and any area; polygons that share a side have the
///    same edges along it.
/// 2. Corners of polygons are points, bit by bit. Other points are crossings of sides of polygons
///    that overlap, rounded to doubles; what the spacing asks for; and, if a polygon is not within
///    the hull of all corners or is the whole sphere, those of the six points of the axes that are
///    in a polygon.
/// 3. With a spacing, sides that are longer are halved until they are not, and the inside gets rows
///    of points along parallels about that far from each other, so that triangles follow the
///    sphere. New corners of sides are rounded to doubles.
/// 4. The result is the same on every machine and for every number of threads. Without a spacing the
///    triangulation is Delaunay as far as sides let it be.
/// \param polygons  points are unit vectors
/// \param spacing_deg  degrees of arc; 0: no points are added for the sake of it
/// \throws InvalidInput if offsets do not fit, the spacing is negative or not finite, or so small
///         that more than 100 million points would be added; (the polygon) if a corner is not
///         finite, a side leads to the opposite point, or sides do not close rings that have the
///         interior on one side; or as constrained_delaunay()
RONDEL_API PolygonTriangles triangles_of_polygons(const CellRings& polygons, double spacing_deg = 0,
                                                  const Execution& execution = {});

}  // namespace rondel
