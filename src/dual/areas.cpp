// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Areas of cells from the spherical excess.
//
// For a point q and consecutive points n, n' of the ring, half the area of the triangle (q, n, n')
// is the argument of
//
//     z = (1 + q.n)(1 + q.n') + r.r' + i q.(r x r'),   r = q x n
//
// (Eriksson, Math. Magazine 63, 1990, with n.n' = (q.n)(q.n') + r.r').
// Half the cell's area is then the argument of the product of all z: it is at most pi, since a
// cell of two or more is convex, so one arctangent is enough.

#include <cmath>
#include <numbers>

#include "dual/local_ring.h"
#include "dual/parts.h"
#include "exact/angles.h"

namespace rondel::dual {
namespace {

// |z| <= 4. The factor keeps products below 1; they are raised before they underflow.
constexpr double factor_scale = 0.25;
constexpr double smallest_product = 0x1p-300;

double area_of(const LocalRing& ring) {
  double re = 1;
  double im = 0;
  const RingPoint* last = &ring.points.back();
  for (const RingPoint& p : ring.points) {
    const double x = factor_scale * (last->cosine_plus_1 * p.cosine_plus_1 + dot(last->r, p.r));
    const double y = factor_scale * det(ring.origin, last->r, p.r);
    const double old_re = re;
    re = re * x - im * y;
    im = old_re * y + im * x;
    if (std::abs(re) + std::abs(im) < smallest_product) {
      re /= smallest_product;
      im /= smallest_product;
    }
    last = &p;
  }
  const double half = exact::argument(im, re);
  // Rounding may move a vanishing area below 0 and a hemisphere above pi.
  if (half >= 0) return 2 * half;
  return half > -std::numbers::pi / 2 ? 0 : 2 * half + 4 * std::numbers::pi;
}

}  // namespace

double careful_area(RingLocalizer& localize, Index rank) { return area_of(localize(rank)); }

}  // namespace rondel::dual
