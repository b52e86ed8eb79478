// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/side_of_plane.h"

#include <algorithm>
#include <array>

#include "exact/expansion.h"
#include "exact/integer.h"

namespace rondel::predicates {
namespace {

using exact::DoubleDouble;
using exact::expansion;
using exact::Expansion;

using DifferenceVector = exact::Vector3<DoubleDouble>;

double squared_length(const DifferenceVector& v) {
  return v.x.hi * v.x.hi + v.y.hi * v.y.hi + v.z.hi * v.z.hi;
}

bool is_exact(const DifferenceVector& v) { return v.x.lo == 0 && v.y.lo == 0 && v.z.lo == 0; }

Sign by_double_double(const DifferenceVector& pb, const DifferenceVector& pc,
                      const DifferenceVector& pd) {
  const double value = -det(pb, pc, pd).hi;
  return unless_unsure(value, is_beyond(value, plane_double_double_bound, squared_length(pb),
                                        squared_length(pc), squared_length(pd)));
}

template <int N, class Convert>
Sign by_expansions(const DifferenceVector& pb, const DifferenceVector& pc,
                   const DifferenceVector& pd, Convert convert) {
  const Expansion<N> b[3] = {convert(pb.x), convert(pb.y), convert(pb.z)};
  const Expansion<N> c[3] = {convert(pc.x), convert(pc.y), convert(pc.z)};
  const Expansion<N> d[3] = {convert(pd.x), convert(pd.y), convert(pd.z)};
  return -sign_of(det(b, c, d));
}

using Quad = std::array<Point, 4>;  // b, c, d, p

double squared_distance(const Point& a, const Point& b) {
  const Vector v = to_vector(a) - to_vector(b);
  return dot(v, v);
}

// The bound of the errors is relative to the lengths of the three differences. A point far from the
// other three makes all of them long unless it is not the one from which they are taken: so the
// even permutation of the four is chosen whose last point has the smallest product.
//
//     p . . . . . . . .          |b-p||c-p||d-p| is of order |p|^3,
//          . . . . . . :: d b    |c-b||d-b||p-b| of order |p|
//            . . . . . : c
Quad with_best_origin(const Quad& q) {
  const auto& [b, c, d, p] = q;
  const std::array<Quad, 4> choices = {q, {b, d, p, c}, {b, p, c, d}, {d, c, p, b}};
  return *std::ranges::min_element(choices, {}, [](const Quad& choice) {
    return squared_distance(choice[0], choice[3]) * squared_distance(choice[1], choice[3]) *
           squared_distance(choice[2], choice[3]);
  });
}

Decision climb(const Point& b, const Point& c, const Point& d, const Point& p) {
  const Sign filtered =
      side_of_plane_filter(to_vector(b), to_vector(c), to_vector(d), to_vector(p));
  if (filtered != Sign::zero) return {filtered, Rung::filter};
  const DifferenceVector pb = exact::difference(b, p);
  const DifferenceVector pc = exact::difference(c, p);
  const DifferenceVector pd = exact::difference(d, p);
  if (const Sign sign = by_double_double(pb, pc, pd); sign != Sign::zero) {
    return {sign, Rung::double_double};
  }
  if (is_safe_for_expansions({b, c, d, p})) {
    const bool are_single = is_exact(pb) && is_exact(pc) && is_exact(pd);
    const Sign sign = are_single
                          ? by_expansions<1>(pb, pc, pd, [](auto v) { return expansion(v.hi); })
                          : by_expansions<2>(pb, pc, pd, [](auto v) { return expansion(v); });
    return {sign, Rung::exact};
  }
  const auto v = exact::scaled_differences({b, c, d}, p);
  return {-exact::sign_of(det(v[0], v[1], v[2])), Rung::exact};
}

}  // namespace

Decision side_of_plane_ladder(const Point& b, const Point& c, const Point& d, const Point& p) {
  const Quad best = with_best_origin({b, c, d, p});
  return climb(best[0], best[1], best[2], best[3]);
}

}  // namespace rondel::predicates
