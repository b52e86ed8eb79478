// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Simplification on the sphere: lines and polygons with fewer corners, within a distance, whose
/// topology stays (target rondel::geo).
#pragma once

#include <functional>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"

namespace rondel {

/// A function that returns the tolerance at a place, in radians.
using ToleranceAt = std::function<double(const Point&)>;

/// How far simplified lines may be from the given ones, and what else may change.
struct SimplifyOptions {
  /// Radians along great circles; not negative. Below 2^-44 (0.4 micrometers on the Earth) nothing
  /// changes; above pi / 4 it counts as pi / 4.
  double tolerance = 0;
  /// The tolerance at a place, where it is not the same everywhere; it replaces `tolerance`. It is
  /// called once for each corner, by one thread.
  ToleranceAt tolerance_at = {};
  /// Whether rings vanish that come down to three corners within the tolerance of one of their sides,
  /// as those do that are nowhere wider, unless they are bent or folded. By default they stay, with
  /// three corners or more.
  bool drop_small = false;
  /// Whether corners stay that are on a ring of one polygon alone: the boundary of a coverage.
  bool keep_boundary = false;
  /// An arc that replaces others keeps away from other corners by this share of the tolerance, from
  /// 0 to 1, or as far as the arcs were, if that is nearer: so no strait becomes a slit. A corner
  /// that is not twice as far from the ends of the arc as from the arc does not count, and neither do
  /// those of rings that vanish without it.
  double clearance = 0;
};

/// Lines and polygons of features.
struct SimplifiedFeatures {
  FeatureLines lines;
  CellRings polygons;
};

/// Simplifies all features together: a line or border that several of them have in common is
/// simplified once and stays common to them, so that no gaps and no overlaps appear.
///
/// 1. Corners of the result are corners of the input, bit by bit, in their order. (Of several
///    points on one ray from the center the one with the least coordinates is the corner.) Ends of
///    lines stay, and so do corners where three or more arcs meet, or where lines or borders part.
/// 2. A chain of arcs is replaced by one arc, of at most 90 degrees, only if each of its corners is
///    within its tolerance of that arc; rounding never breaks this. Then each place of the chain is
///    as near to the arc as the greater of the tolerances at the ends of its side says, and each
///    place of the arc as near to the chain as the greatest of them.
/// 3. If arcs meet in corners alone, those of the result do, too, and how they lie to each other is
///    the same: no ring vanishes (but for `drop_small`), inverts, crosses itself or another one,
///    holes stay in their polygons, islands on their side of a coast, and so do corners and points
///    of all features. Exact. Arcs that cross or touch are valid input; then no further pair
///    begins to cross. Corners on the inside of an arc are not shared with it: arrange()
///    (rondel/arrangement.h) divides arcs there.
/// 4. A place is in another polygon than before only if it is within the tolerance of an arc that
///    replaced others.
/// 5. The result depends on the set of lines and rings alone: not on the order of features, rings,
///    or corners (a ring begins with the first of its given corners that is left), nor on the
///    number of threads.
/// 6. No corner is left that could be removed by these rules alone. A second call with the same
///    tolerance measures from the first result and may remove more.
///
/// Corners are removed one by one where that moves the line least, while the triangle between the
/// old and the new line is free of other corners (de Berg, van Kreveld and Schirra 1998,
/// Visvalingam and Whyatt 1993). It takes O(n log n) for n corners on usual input. The proof is in
/// docs/theory/simplification.md.
/// \param lines  the points and lines of each feature; points are never removed
/// \param polygons  cells with any number of rings, one for each feature or of other features
/// \throws InvalidInput if offsets do not fit, a tolerance is negative or not finite, or the clearance
///         is not from 0 to 1; (the position of the side among the corners) if a side leads to the opposite point, up to 2^-45; (the
///         position of the point) if a point is not as arrange() wants it; (index of the feature)
///         if a line has such a point or side.
RONDEL_API SimplifiedFeatures simplified(const FeatureLines& lines, const CellRings& polygons,
                                         const SimplifyOptions& options,
                                         const Execution& execution = {});

/// Simplifies polygons: simplified() of features without lines.
RONDEL_API CellRings simplified(const CellRings& polygons, const SimplifyOptions& options,
                                const Execution& execution = {});

}  // namespace rondel
