// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Points, lines and polygons as sites and constraints of a constrained Delaunay triangulation
/// (target rondel::geo).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"

namespace rondel {

/// The arguments of constrained_delaunay() and faces_inside() that features give.
struct FeatureConstraints {
  /// The places of features, each once, in the order in which they first occur: for each feature
  /// the points of its lines and then the corners of its polygons. Places are one if their three
  /// coordinates are equal.
  std::vector<Point> sites;
  /// The arcs of lines and the sides of polygons, in the same order and in their directions. An arc
  /// between two equal points is left out.
  std::vector<std::array<Index, 2>> constraints;
  std::vector<Index> features;  ///< the feature of each constraint, never decreasing
  /// The constraints that are sides of each feature's polygons; as many rows as features.
  CompressedRows<Index> polygons;
};

/// Collects the sites and constraints of features, such as the operands of combine() or those of a
/// FeatureTable.
/// \param lines  group i has the lines and the points of feature i
/// \param polygons  cell i has the polygons of feature i
/// \throws InvalidInput if offsets do not fit or the numbers of groups and cells differ; (the
///         feature) if a line has no point, a point is not finite, or a polygon is the whole sphere,
///         which has no sides
RONDEL_API FeatureConstraints constraints_of_features(const FeatureLines& lines,
                                                      const CellRings& polygons);

/// Returns longitudes and latitudes of unit vectors as a file has them: those with the fewest
/// decimals of which unit_vectors() makes the same points bit by bit, 10.5 in place of
/// 10.499999999999998. For points that no longitude and latitude of up to 12 decimals gives it
/// returns one of 13 decimals that does, or another one that does, or what lonlats() returns: so
/// points that unit_vectors() made are the same again.
/// \param west_deg  where the turn of the longitudes begins (rondel/longitudes.h)
RONDEL_API std::vector<LonLat> short_lonlats(std::span<const Point> points, double west_deg = -180);

}  // namespace rondel
