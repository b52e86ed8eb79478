// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Buffers on the sphere: the places within a distance of points, of lines and of polygons, and
/// polygons without the places near their borders (target rondel::geo). Distances are along great
/// circles; no projection is involved.
#pragma once

#include <span>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"

namespace rondel {

/// The distance of a buffer, and how near its border is to the places at this distance.
struct BufferOptions {
  /// Radians; any finite number. A negative distance removes the places of a polygon that are nearer
  /// than its magnitude to the border. Pi and more reach every place.
  double distance = 0;
  /// Radians. 0 stands for a thousandth of the distance, for which a circle has 50 corners. At least
  /// 2^-48 (23 nanometers on the Earth) and 2^-30 of the distance count, and at most half of the
  /// distance.
  double tolerance = 0;
};

/// Computes the buffer of each feature. A feature consists of its lines and of its polygon, as in
/// read_features().
///
/// 1. Let D be the distance and T the tolerance. With D > 0 the result has all places that are
///    nearer than D - T to the feature, and none farther than D + T. The places of its polygon are
///    at distance 0, and all of them are in the result.
/// 2. With D < 0 it has the places of the polygon that are farther than |D| + T from the border,
///    and none nearer than |D| - T. Lines and points have no such places.
/// 3. Distances below 2^-44 (0.4 micrometers on the Earth) count as 0: polygons are returned as by
///    repaired(), and lines and points have empty cells.
/// 4. Cell i of the result is valid, as the results of combine() are (rondel/set_operations.h). It
///    may be empty or the whole sphere. A polygon's places are as for combine().
/// 5. Ends and corners are round: all places at a distance are treated alike. So there are no flat
///    caps and no mitred corners, whose form would depend on a projection.
/// 6. Features do not change each other; unite() joins their buffers. The result depends on the
///    features alone, not on the number of threads.
///
/// Corners of the border are placed on both sides of the places at distance D, so that few of them
/// are enough: a circle has pi / sqrt(4 T / D) corners, for small T / D. The proof is in
/// docs/theory/arrangements.md.
/// \param lines  the points and lines of each feature; neighbors on one ray count once
/// \param polygons  a cell for each feature, without rings where it has no polygon; or no cells at
///                  all
/// \throws InvalidInput as combine() for polygons; if offsets do not fit, the number of cells is
///         neither 0 nor that of the features, a number is not finite, or the tolerance is
///         negative; (index of the feature) if a point of a line is no unit vector, or neighbors in
///         a line are opposite to each other.
RONDEL_API CellRings buffered(const FeatureLines& lines, const CellRings& polygons,
                              const BufferOptions& options, const Execution& execution = {});

/// Computes the buffer of each polygon: buffered() of features without lines.
RONDEL_API CellRings buffered(const CellRings& polygons, const BufferOptions& options,
                              const Execution& execution = {});

/// Computes a disk around each point: buffered() of features that are points.
/// \param points  unit vectors
RONDEL_API CellRings buffered(std::span<const Point> points, const BufferOptions& options,
                              const Execution& execution = {});

}  // namespace rondel
