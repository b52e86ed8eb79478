// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "exact/vector.h"
#include "overlay/measure.h"
#include "predicates/bounds.h"

namespace rondel::overlay {
namespace {

// True if an end of one of two arcs is within rounding of the other arc.
bool is_touch_by_rounding(const Point& a, const Point& b, const Point& p, const Point& q) {
  constexpr double rounding = 32 * predicates::unit_roundoff;
  const auto is_near = [&](const Point& from, const Point& to, const Point& x) {
    const Point normal = cross(from, to - from);
    const double height = dot(normal, x - from);
    return height * height <= rounding * rounding * dot(normal, normal);
  };
  return is_near(a, b, p) || is_near(a, b, q) || is_near(p, q, a) || is_near(p, q, b);
}

// A side with the least x that its arc may have.
struct RangedSide {
  Point a;
  Point b;
  double low;
  double high;
};

}  // namespace

bool has_sure_crossing(std::span<const BorderArc> arcs) {
  std::vector<RangedSide> sides;
  for (const auto& [a, b] : arcs) {
    const double bulge = dot(b - a, b - a) / 4;  // exceeds the distance of the arc from its chord
    sides.push_back({a, b, std::min(a.x, b.x) - bulge, std::max(a.x, b.x) + bulge});
  }
  std::ranges::sort(sides, {}, &RangedSide::low);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& [a, b, low, high] = sides[i];
    for (std::size_t k = i + 1; k < sides.size() && sides[k].low <= high; ++k) {
      const Point& p = sides[k].a;
      const Point& q = sides[k].b;
      if (arrangement::do_arcs_cross(a, b, p, q) && !is_touch_by_rounding(a, b, p, q)) return true;
    }
  }
  return false;
}

}  // namespace rondel::overlay
