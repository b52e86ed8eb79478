// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/orientation.h"

#include "exact/expansion.h"
#include "exact/integer.h"
#include "predicates/side_of_plane.h"

namespace rondel::predicates {
namespace {

using exact::expansion;

Sign filter(const Point& a, const Point& b, const Point& c, const Point& center) {
  const Vector from_center = to_vector(a) - to_vector(center);
  const Vector ab = to_vector(b) - to_vector(a);
  const Vector ac = to_vector(c) - to_vector(a);
  const double value = det(from_center, ab, ac);
  return unless_unsure(value, is_orientation_certain(value, from_center, ab, ac));
}

Sign by_expansions(const Point& a, const Point& b, const Point& c) {
  const exact::Expansion<1> ra[3] = {expansion(a.x), expansion(a.y), expansion(a.z)};
  const exact::Expansion<1> rb[3] = {expansion(b.x), expansion(b.y), expansion(b.z)};
  const exact::Expansion<1> rc[3] = {expansion(c.x), expansion(c.y), expansion(c.z)};
  return sign_of(det(ra, rb, rc));
}

}  // namespace

Decision orientation_ladder(const Point& a, const Point& b, const Point& c, const Point& center) {
  if (const Sign sign = filter(a, b, c, center); sign != Sign::zero) return {sign, Rung::filter};
  if (center == Point{} && is_safe_for_expansions({a, b, c})) {
    return {by_expansions(a, b, c), Rung::exact};
  }
  if (center != Point{}) {
    const Decision above = side_of_plane_ladder(a, b, c, center);
    return {-above.sign, above.rung};
  }
  const auto v = exact::scaled_rays({a, b, c}, center);
  return {exact::sign_of(det(v[0], v[1], v[2])), Rung::exact};
}

}  // namespace rondel::predicates
