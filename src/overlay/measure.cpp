// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/measure.h"

#include <array>
#include <cstdio>
#include <string>

#include "exact/eft.h"
#include "predicates/bounds.h"
#include "rondel/error.h"

namespace rondel::overlay {

namespace {

// Adds the areas of all triangles at `origin`, and returns false if one of them is large. The sum
// is kept in double_double arithmetic, since a belt can have thousands of arcs whose triangles
// cancel.
bool add_triangles(std::span<const BorderArc> border, const Point& origin, double& area) {
  const LocalAxes axes(origin);
  bool is_any_large = false;
  exact::DoubleDouble sum{};
  for (const auto& [from, to] : border) {
    const Triangle triangle(axes.place_of(from), axes.place_of(to));
    is_any_large |= triangle.is_large();
    add_term(triangle.area(), sum);
  }
  area = sum.hi + sum.lo;
  return !is_any_large;
}

}  // namespace

// Triangles are taken at a point nearby, or, for large regions, at the direction of the center of
// mass.
Measures measures_of(std::span<const BorderArc> border, const Point& nearby) {
  Measures result;
  for (const auto& [from, to] : border) {
    result.moment = result.moment + moment_of_arc(from, to);
    result.length += rough_length(from, to);
  }
  if (add_triangles(border, nearby, result.area)) return result;
  result.area = 0;
  result.is_sure = norm(result.moment) > 4 * predicates::unit_roundoff * result.length;
  if (result.is_sure) add_triangles(border, normalized(result.moment), result.area);
  return result;
}

void refuse_pieces(Index name, double sum, double area) {
  std::array<char, 96> sizes{};
  std::snprintf(sizes.data(), sizes.size(), "its parts add up to %.6g of %.6g steradians", sum,
                area);
  throw InvalidInput(
      "cell " + std::to_string(name) + " crosses or overlaps itself: " + sizes.data(), name);
}

}  // namespace rondel::overlay
