// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/face_normal.h"

#include <cmath>

#include "dual/split_sites.h"

namespace rondel::dual {
namespace {

// N = B x C, rounded.
struct RoundedNormal {
  Vec normal;
  double squared;
  bool is_accurate;
};

inline RoundedNormal rounded_normal(const SplitSites& sites, Index a, Index b, Index c) {
  const exact::SplitPoint& place = sites[a];
  const Offset to_b = offset(place, sites[b]);
  const Offset to_c = offset(place, sites[c]);
  const Vec n = split_cross(to_b, to_c).rounded();
  const double n2 = dot(n, n);
  return {n, n2,
          is_accurate(dot(to_b.hi, to_b.hi), dot(to_c.hi, to_c.hi), n2, sites.is_projected())};
}

}  // namespace

double split_dot(const SplitNormal& n, const Offset& d) {
  const auto term = [](double nh, double nl, double dh, double dl) {
    return exact::DoubleDouble{nh, 0} * dh + exact::DoubleDouble{nh * dl + nl * dh, 0};
  };
  return (term(n.hi.x, n.lo.x, d.hi.x, d.lo.x) + term(n.hi.y, n.lo.y, d.hi.y, d.lo.y) +
          term(n.hi.z, n.lo.z, d.hi.z, d.lo.z))
      .hi;
}

Point unit_normal(const SplitSites& sites, Index a, Index b, Index c) {
  const RoundedNormal n = rounded_normal(sites, a, b, c);
  if (!n.is_accurate) return exact_normal(sites, a, b, c).normal;
  return to_point(n.normal / std::sqrt(n.squared));
}

bool is_degenerate(const SplitSites& sites, Index a, Index b, Index c) {
  if (sites.is_projected() || rounded_normal(sites, a, b, c).is_accurate) return false;
  return exact_normal(sites, a, b, c).is_degenerate;
}

}  // namespace rondel::dual
