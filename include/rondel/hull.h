// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Convex hulls of points in space: the second approach of the paper (Caroli, de Castro, Loriot,
/// Rouiller, Teillaud et al., SEA 2010, end of section 4.2), seen from inside.
#pragma once

#include <span>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Computes the convex hull of n points: a triangulation with Model::weighted around a center
/// inside of the hull.
///
/// The result is exact for every finite input, and unique: it depends on the set of points only.
/// Its vertices are exactly the extreme points; a point on a facet or an edge, however flat, that
/// is no corner of it is no vertex.
///
/// 1. `dimension` is 2 for points that span space. The faces are closed triangles, counterclockwise
///    seen from outside. A facet with more than three corners is triangulated in a way that depends
///    on its corners only. Every other point is hidden (below the first face whose cone from the
///    center has it).
/// 2. Points in one plane have a flat hull: dimension 1, and `ring()` has the corners of the convex
///    polygon, counterclockwise seen from the side to which the plane's normal points; the normal's
///    first non-zero coordinate is positive. For points on one line `ring()` has the two ends, in
///    ascending order of index. Points in one place have dimension 0.
/// 3. `sphere().center` lies strictly inside the hull, and every face is solid. There is no such
///    point in a flat hull, and perhaps no double in a hull about as thin as the
///    distance of doubles; then the center is the lexicographically smallest point, a vertex, and
///    the faces whose planes contain it are ghost faces. The hull is as exact as any other.
///
/// The expected time is O(n log n), in practice O(n) if most points are inside.
/// \throws InvalidInput (first bad index) if a coordinate is not finite or there are more than
///         `max_sites` points.
RONDEL_API Triangulation convex_hull(Sites points, const Execution& execution = {});

/// Computes the hull of the points in an array of 3n numbers x0 y0 z0 x1 y1 z1 ..., which are
/// copied.
/// \throws InvalidInput also if the length is not a multiple of 3.
RONDEL_API Triangulation convex_hull(std::span<const double> xyz, const Execution& execution = {});

/// The volume and the surface area of a hull.
struct HullSize {
  double volume = 0;
  double area = 0;  ///< for a flat hull the area of both sides of the polygon
};

/// Computes volume and area by sums over the faces in doubles. The relative error is near 1e-15 for
/// a body that is as thick as wide, and larger by their ratio for a thin one. The result is
/// infinite where it exceeds the range of doubles.
/// \throws InvalidInput for projected sites, or a center outside of the hull: `hull` comes from
///         convex_hull().
RONDEL_API HullSize size_of_hull(const Triangulation& hull);

}  // namespace rondel
