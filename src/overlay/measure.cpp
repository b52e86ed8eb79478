// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/measure.h"

#include "predicates/bounds.h"

namespace rondel::overlay {

// Triangles around the first corner, or, for large regions, the direction of the center of mass. Where
// the moment is nothing but rounding, so is the area.
Measures measures_of(std::span<const BorderArc> border) {
  Measures result;
  if (border.empty()) return result;
  Point origin = border.front().from;
  bool is_large = false;
  for (const auto& [from, to] : border) {
    result.moment = result.moment + moment_of_arc(from, to);
    result.length += rough_length(from, to);
    is_large |= is_far(origin, from);
  }
  if (is_large) {
    if (norm(result.moment) <= 4 * predicates::unit_roundoff * result.length) return result;
    origin = normalized(result.moment);
  }
  for (const auto& [from, to] : border) {
    if (from != origin && to != origin) result.area += Triangle(origin, from, to).area();
  }
  return result;
}

}  // namespace rondel::overlay
