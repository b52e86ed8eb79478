// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// How points, lines and polygons lie to each other: the DE-9IM relation of geometries whose sides
/// are arcs of great circles, its named predicates, and spatial joins (target rondel::geo). All of
/// it is exact.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/geometries.h"
#include "rondel/types.h"

namespace rondel {

/// A question about two geometries A and B that their relation answers. Names are those of shapely
/// and GeoPandas, meanings those of OGC simple features.
enum class SpatialPredicate : std::uint8_t {
  intersects,  ///< "intersects": A and B have a place in common
  disjoint,    ///< "disjoint": they have none
  contains,    ///< "contains": B is in A, and their interiors meet: T*****FF*
  within,      ///< "within": A is in B, and their interiors meet: T*F**F***
  covers,      ///< "covers": B is in A, its interior or its boundary; for polygons as `contains`
  covered_by,  ///< "covered_by": A is in B; for polygons as `within`
  touches,     ///< "touches": they have a place in common, but none of both interiors
  overlaps,    ///< "overlaps": they have the same dimension, share an interior of that dimension,
               ///< and each has one of its own
  equals,      ///< "equals": they have the same places, or both are empty
  /// "crosses": two lines whose interiors meet in points alone; or the interior of the geometry of
  /// lower dimension is in part inside of the other one and in part outside
  crosses
};

/// Returns the name of a predicate, as above; empty for other numbers.
RONDEL_API std::string_view name_of(SpatialPredicate predicate) noexcept;

/// How two geometries A and B lie to each other: the matrix of the dimensionally extended
/// nine-intersection model (Clementini, Di Felice and van Oosterom 1993; Egenhofer and Herring
/// 1990). An entry is the dimension of what a part of A and a part of B have in common: '2' (area),
/// '1' (lines), '0' (points) or 'F' (nothing).
struct Relation {
  /// Interior of A with interior, boundary and exterior of B; then the boundary of A with these;
  /// then the exterior of A.
  std::array<char, 9> matrix = {'F', 'F', 'F', 'F', 'F', 'F', 'F', 'F', '2'};

  /// Returns the matrix in one row, as "212101212".
  [[nodiscard]] std::string_view text() const { return {matrix.data(), matrix.size()}; }
  /// True if the answer to a question is yes.
  [[nodiscard]] RONDEL_API bool is(SpatialPredicate predicate) const;
  /// True if each entry fits to its character of a pattern: T (not F), F, 0, 1, 2, or * (anything).
  /// \throws InvalidInput (the position) if a pattern has not nine of these characters
  [[nodiscard]] RONDEL_API bool matches(std::string_view pattern) const;
  /// Returns the relation of B to A.
  [[nodiscard]] RONDEL_API Relation transposed() const;
  friend bool operator==(const Relation&, const Relation&) = default;
};

/// Computes the relation of polygon i of A to polygon i of B, for each i. If one operand has one
/// polygon alone, its relation to each polygon of the other one is computed.
///
/// 1. The result is exact for the corners as they are: nothing is rounded or snapped. Sides meet
///    where arcs between these doubles meet; points on one ray from the center are one place.
/// 2. The boundary of a polygon consists of its sides; the interior is to the left of them. Sides
///    that lead back and forth between the same places cancel. The whole sphere (`whole`) has no
///    boundary and no exterior.
/// 3. Polygons are valid: no two of their sides cross, and all sides agree on where the interior
///    is. Rings may touch each other and themselves. Results of repaired(), combine(), unite(),
///    overlay_pieces() and read_polygons() are so.
///
/// Each polygon is prepared once, in O(n log n) for n sides. A pair with n and m sides takes
/// O(min(n, m) log(n + m)), and as many steps as sides meet.
/// \param first, second  the polygons of A and of B; corners as arrange() wants them
///        (rondel/arrangement.h)
/// \throws InvalidInput if offsets do not fit, or the numbers of polygons; (the index) if a polygon
///         is not valid, has a side that leads to the opposite point, up to 2^-45, or has a point
///         that is no unit vector
RONDEL_API std::vector<Relation> relate(const CellRings& first, const CellRings& second,
                                        const Execution& execution = {});

/// Computes the relation of a polygon of A to a polygon of B for each pair, as relate() does.
/// \param pairs  the indices of both polygons; a polygon may be in any number of pairs
/// \throws InvalidInput as relate(); (the position of the pair) if a polygon does not exist
RONDEL_API std::vector<Relation> relate_pairs(const CellRings& first, const CellRings& second,
                                              std::span<const std::array<Index, 2>> pairs,
                                              const Execution& execution = {});

/// Two polygons, and how they lie to each other.
struct RelatedPair {
  Index first = no_index;   ///< a polygon of A
  Index second = no_index;  ///< a polygon of B
  Relation relation;
  friend bool operator==(const RelatedPair&, const RelatedPair&) = default;
};

/// Finds all pairs of a polygon of A and a polygon of B for which the answer to a question is yes:
/// a spatial join. Relations are those of relate(). An empty polygon is in no pair.
///
/// Pairs are looked at whose boxes in space overlap, with their interiors; a tree finds them.
/// \param first, second  as for relate(), with any numbers of polygons. Polygons of one operand may
///        overlap. The same object twice joins polygons with themselves, in half of the time.
/// \return pairs in lexicographic order
/// \throws InvalidInput as relate(); if the predicate is `disjoint`
RONDEL_API std::vector<RelatedPair> related_pairs(
    const CellRings& first, const CellRings& second,
    SpatialPredicate predicate = SpatialPredicate::intersects, const Execution& execution = {});

/// Computes the relations of geometries as those of polygons. Each geometry has parts of one
/// dimension.
///
/// 4. Points have no boundary. That of lines consists of the nodes in which an odd number of lines
///    begins or ends, as in OGC simple features: a closed line has none. Lines may cross and repeat
///    themselves and each other.
///
/// A pair with lines takes as many steps as one of polygons; a point in a polygon O(log n).
/// \throws InvalidInput as for polygons; (the index) if a geometry has parts of several dimensions
RONDEL_API std::vector<Relation> relate(const Geometries& first, const Geometries& second,
                                        const Execution& execution = {});

/// Computes the relations of pairs of geometries, as relate_pairs() does those of polygons.
/// \throws InvalidInput as relate() of geometries; (the position of the pair) if one does not exist
RONDEL_API std::vector<Relation> relate_pairs(const Geometries& first, const Geometries& second,
                                              std::span<const std::array<Index, 2>> pairs,
                                              const Execution& execution = {});

/// Finds pairs of geometries, as related_pairs() does those of polygons; such as the polygon in
/// which each point is.
/// \throws InvalidInput as relate() of geometries; if the predicate is `disjoint`
RONDEL_API std::vector<RelatedPair> related_pairs(
    const Geometries& first, const Geometries& second,
    SpatialPredicate predicate = SpatialPredicate::intersects, const Execution& execution = {});

}  // namespace rondel
