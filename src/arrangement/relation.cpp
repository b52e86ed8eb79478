// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a matrix says.
#include <algorithm>
#include <cstddef>
#include <string>

#include "rondel/error.h"
#include "rondel/relate.h"

namespace rondel {
namespace {

bool fits(char entry, char pattern) {
  return pattern == '*' || (pattern == 'T' ? entry != 'F' : entry == pattern);
}

}  // namespace

std::string_view name_of(SpatialPredicate predicate) noexcept {
  switch (predicate) {
    case SpatialPredicate::intersects:
      return "intersects";
    case SpatialPredicate::disjoint:
      return "disjoint";
    case SpatialPredicate::contains:
      return "contains";
    case SpatialPredicate::within:
      return "within";
    case SpatialPredicate::covers:
      return "covers";
    case SpatialPredicate::covered_by:
      return "covered_by";
    case SpatialPredicate::touches:
      return "touches";
    case SpatialPredicate::overlaps:
      return "overlaps";
    case SpatialPredicate::equals:
      return "equals";
  }
  return {};
}

// Polygons that have a place in common, but no interior, touch: where the boundary of one is in the
// interior of the other, their interiors meet, too. So `covers` needs no more patterns than
// `contains`.
bool Relation::is(SpatialPredicate predicate) const {
  switch (predicate) {
    case SpatialPredicate::intersects:
      return !matches("FF*FF****");
    case SpatialPredicate::disjoint:
      return matches("FF*FF****");
    case SpatialPredicate::contains:
    case SpatialPredicate::covers:
      return matches("T*****FF*");
    case SpatialPredicate::within:
    case SpatialPredicate::covered_by:
      return matches("T*F**F***");
    case SpatialPredicate::touches:
      return matches("F***T****");
    case SpatialPredicate::overlaps:
      return matches("T*T***T**");
    case SpatialPredicate::equals:
      return matches("**F**FFF*");
  }
  return false;
}

bool Relation::matches(std::string_view pattern) const {
  const std::size_t wrong = pattern.find_first_not_of("TF*012");
  if (wrong != std::string_view::npos) {
    throw InvalidInput(
        "a pattern of a relation has characters other than T F * 0 1 2: " + std::string(pattern),
        wrong);
  }
  if (pattern.size() != matrix.size()) {
    throw InvalidInput(
        "a pattern of a relation has nine characters, not " + std::to_string(pattern.size()),
        std::min(pattern.size(), matrix.size()));
  }
  return std::ranges::equal(matrix, pattern, fits);
}

Relation Relation::transposed() const {
  const auto& m = matrix;
  return {{m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}};
}

}  // namespace rondel
