// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/side_of_plane.h"

#include "exact/expansion.h"
#include "exact/integer.h"

namespace rondel::predicates {
namespace {

using exact::DoubleDouble;
using exact::expansion;
using exact::Expansion;
using exact::two_diff;

using DifferenceVector = exact::Vector3<DoubleDouble>;

DifferenceVector difference(const Point& a, const Point& b) {
  return {two_diff(a.x, b.x), two_diff(a.y, b.y), two_diff(a.z, b.z)};
}

Vector rounded(const DifferenceVector& v) { return {v.x.hi, v.y.hi, v.z.hi}; }

bool is_exact(const DifferenceVector& v) { return v.x.lo == 0 && v.y.lo == 0 && v.z.lo == 0; }

Sign by_double_double(const DifferenceVector& pb, const DifferenceVector& pc,
                      const DifferenceVector& pd) {
  const double value = -det(pb, pc, pd).hi;
  const double m = max_squared_length(rounded(pb), rounded(pc), rounded(pd));
  constexpr double bound = plane_double_double_bound * plane_double_double_bound;
  return unless_unsure(value, value * value > bound * (m * m * m) + underflow_guard);
}

template <int N, class Convert>
Sign by_expansions(const DifferenceVector& pb, const DifferenceVector& pc,
                   const DifferenceVector& pd, Convert convert) {
  const Expansion<N> b[3] = {convert(pb.x), convert(pb.y), convert(pb.z)};
  const Expansion<N> c[3] = {convert(pc.x), convert(pc.y), convert(pc.z)};
  const Expansion<N> d[3] = {convert(pd.x), convert(pd.y), convert(pd.z)};
  return -sign_of(det(b, c, d));
}

}  // namespace

Decision side_of_plane_ladder(const Point& b, const Point& c, const Point& d, const Point& p) {
  const DifferenceVector pb = difference(b, p);
  const DifferenceVector pc = difference(c, p);
  const DifferenceVector pd = difference(d, p);
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

}  // namespace rondel::predicates
