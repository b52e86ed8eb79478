// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Set operations on polygons whose sides are arcs of great circles: union, intersection,
/// difference, symmetric difference, and repair. Results are valid and can be operands again, as
/// often as one likes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel {

/// A set operation on two regions A and B. Names are those of GeoPandas.
enum class SetOperation : std::uint8_t {
  unite,                 ///< "union": what is in A or in B
  intersection,          ///< "intersection": what is in both
  difference,            ///< "difference": what is in A and not in B
  symmetric_difference,  ///< "symmetric_difference": what is in one of the two alone
  identity               ///< "identity": what is in A, divided by B
};

/// Returns the name of a set operation, as above; empty for other numbers.
RONDEL_API std::string_view name_of(SetOperation operation) noexcept;

/// Computes a set operation on two regions, each of which is the union of some polygons.
///
/// Which places a polygon has: those that an arc from outside reaches by crossing its rings an odd
/// number of times. So rings may cross, overlap and repeat each other. The left side of the rings
/// is inside; where rings contradict each other on that, the outside is opposite to the mean of the
/// corners if they lie in a hemisphere, and else the side that more of the rings' edges have to
/// their right.
///
/// 1. The result is one cell: rings that are simple, with the interior to the left, of which two
///    meet in corners at most; exact for these doubles. It has no ring if it is empty, or the whole
///    sphere (in `whole`).
/// 2. Its corners are corners of the operands, bit by bit, and places where sides cross, rounded to
///    doubles as by arrange() (rondel/arrangement.h). No part is too small to be kept.
/// 3. The result depends on the two sets of rings alone: not on the order of polygons, rings and
///    corners, nor on the number of threads.
/// \param first, second  the polygons of A and of B; corners as arrange() wants them
/// \throws InvalidInput if offsets do not fit; (the position of the side among the corners) if a
///         side leads to the opposite point, up to 2^-45; or (the position) if a point is no unit vector
RONDEL_API CellRings combine(const CellRings& first, const CellRings& second,
                             SetOperation operation, const Execution& execution = {});

/// Divides two sets of polygons by each other. Each polygon of A is divided into its intersections
/// with the polygons of B and what is in none of them, and the same for B; the operation says which
/// of these pieces are returned: intersections (all operations but difference and
/// symmetric_difference), what is in A alone (all but intersection), and what is in B alone (unite
/// and symmetric_difference). Pieces of one set that overlap stay as they are, as in
/// geopandas.overlay().
/// \return pieces sorted by their two polygons; `cells` has the polygon of A and `regions` that of
///         B, no_index for none
/// \throws InvalidInput as combine()
RONDEL_API RegionPieces overlay_pieces(const CellRings& first, const CellRings& second,
                                       SetOperation operation, const Execution& execution = {});

/// Computes the union of any number of polygons at once: combine() with no second operand.
RONDEL_API CellRings unite(const CellRings& polygons, const Execution& execution = {});

/// Computes a set operation on pairs of polygons, each pair by itself. Cell k of the result has the
/// places that combine() says for polygon `pairs[k][0]` of A and polygon `pairs[k][1]` of B, and
/// the same corners, bit by bit. Cells of the result may overlap.
/// \param first, second  A and B, as for combine(); they may be the same object
/// \throws InvalidInput if offsets do not fit, or (the position of the pair) if a polygon does not
///         exist or is one that combine() refuses. Polygons in no pair are not looked at.
RONDEL_API CellRings combine_pairs(const CellRings& first, const CellRings& second,
                                   std::span<const std::array<Index, 2>> pairs,
                                   SetOperation operation, const Execution& execution = {});

/// Makes each polygon valid: cell i of the result has the places of polygon i, as for combine().
/// Polygons do not change each other.
/// \throws InvalidInput if offsets do not fit, or (the position of the polygon) if combine() refuses
///         a polygon
RONDEL_API CellRings repaired(const CellRings& polygons, const Execution& execution = {});

}  // namespace rondel
