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
    case SpatialPredicate::crosses:
      return "crosses";
    case SpatialPredicate::equals:
      return "equals";
  }
  return {};
}

// A geometry has the dimension of what its interior has in common with the interior, the boundary
// and the exterior of another one; these cover the sphere.
bool Relation::is(SpatialPredicate predicate) const {
  const auto dimension = [](char a, char b, char c) {
    int highest = -1;
    for (const char entry : {a, b, c}) highest = std::max(highest, entry == 'F' ? -1 : entry - '0');
    return highest;
  };
  const int first = dimension(matrix[0], matrix[1], matrix[2]);
  const int second = dimension(matrix[0], matrix[3], matrix[6]);
  const bool do_meet = !matches("FF*FF****");
  switch (predicate) {
    case SpatialPredicate::intersects:
      return do_meet;
    case SpatialPredicate::disjoint:
      return !do_meet;
    case SpatialPredicate::contains:
      return matches("T*****FF*");
    case SpatialPredicate::covers:
      return do_meet && matches("******FF*");
    case SpatialPredicate::within:
      return matches("T*F**F***");
    case SpatialPredicate::covered_by:
      return do_meet && matches("**F**F***");
    case SpatialPredicate::touches:
      return do_meet && matches("F********");
    case SpatialPredicate::overlaps:
      return first == second && matches("T*T***T**") && matrix[0] - '0' == first;
    case SpatialPredicate::crosses:
      if (first == 1 && second == 1) return matches("0********");
      return first != second && matches(first < second ? "T*T******" : "T*****T**");
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
