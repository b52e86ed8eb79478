// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The normal of a face in double-double arithmetic, with a proof that it is good enough.
#pragma once

#include <algorithm>

#include "dual/split_sites.h"

namespace rondel::dual {

// N = B x C as the unevaluated sum hi + lo.
struct SplitNormal {
  Vec hi;
  Vec lo;
  [[nodiscard]] Vec rounded() const { return hi + lo; }
};

// a*b - c*d + low, where |low| is far smaller than the products.
inline exact::DoubleDouble difference_of_products(double a, double b, double c, double d,
                                                  double low) {
  const auto p = exact::two_product(a, b);
  const auto q = exact::two_product(c, d);
  const auto s = exact::two_diff(p.hi, q.hi);
  return {s.hi, s.lo + ((p.lo - q.lo) + low)};
}

// Error: the products and their difference are exact, so what is left are the roundings of
// the low part, below 2^-101 |B||C| where lo comes from hi's rounding and below 2^-101 (|B| +
// |C|) where it comes from the places' low parts (|lo| <= 2^-51).
//
// Inline always, or Clang makes no vector code of the loop over faces (face_batch.cpp).
[[gnu::always_inline]] inline SplitNormal split_cross(const Offset& b, const Offset& c) {
  const Vec s = c.hi + c.lo;
  const auto low = [&](double bh1, double bl1, double cl2, double s2, double bh2, double bl2,
                       double cl1,
                       double s1) { return (bh1 * cl2 + bl1 * s2) - (bh2 * cl1 + bl2 * s1); };
  const auto x =
      difference_of_products(b.hi.y, c.hi.z, b.hi.z, c.hi.y,
                             low(b.hi.y, b.lo.y, c.lo.z, s.z, b.hi.z, b.lo.z, c.lo.y, s.y));
  const auto y =
      difference_of_products(b.hi.z, c.hi.x, b.hi.x, c.hi.z,
                             low(b.hi.z, b.lo.z, c.lo.x, s.x, b.hi.x, b.lo.x, c.lo.z, s.z));
  const auto z =
      difference_of_products(b.hi.x, c.hi.y, b.hi.y, c.hi.x,
                             low(b.hi.x, b.lo.x, c.lo.y, s.y, b.hi.y, b.lo.y, c.lo.x, s.x));
  return {{x.hi, y.hi, z.hi}, {x.lo, y.lo, z.lo}};
}

// N.D in double-double, rounded: right to about 2^-100 |N||D|.
double split_dot(const SplitNormal& n, const Offset& d);

// Whether split_cross gives N to a quarter of u|N|, given the squared lengths of B, C and N.
//
// A place is wrong by 2^-100 at most (projected; 0 or below 2^-1073 in the weighted model), an
// offset by 2^-99, so N by 2^-98 (|B| + |C|), which also covers the roundings above, plus 2^-101
// |B||C|. This is below 2^-55 |N| if |N| >= 2^-43 (|B| + |C|) + 2^-46 |B||C|; squared with (x +
// y)^2 <= 2x^2 + 2y^2, twice. The squares may be those of the high parts: of a
// projected offset, the low part may add 2^-100, all there is of sites closer than 2^-53. The
// last condition keeps away from underflow.
inline bool is_accurate(double b2, double c2, double n2, bool is_projected) {
  const double from_places = (is_projected ? 0x1p-84 : 0.0) * (b2 + c2 + 0x1p-100);
  const double least = from_places + 0x1p-91 * b2 * c2;
  return n2 >= (least > 0x1p-900 ? least : 0x1p-900);
}

// The circumcenter of a face: at most 4u from the exact unit normal.
//
// Fast path: N is wrong by u/4 before and by u in each coordinate (so by u|N|
// and across N at worst) after rounding to double; the computed square is off by 3u, its
// root by 2.5u along N, and the division by another u: 0.25 + sqrt(1 + 2.5^2) + 1 = 3.95.
Point unit_normal(const SplitSites& sites, Index a, Index b, Index c);

// Whether the corners are collinear, which needs a perturbed, weighted face.
bool is_degenerate(const SplitSites& sites, Index a, Index b, Index c);

}  // namespace rondel::dual
