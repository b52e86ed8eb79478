// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps on the surface w(x) = sqrt(1 + |x|^2) over places x, seen over its tangent plane at one
// place, where no number is larger than it must be.
#pragma once

#include <algorithm>

#include "bulk/square_point.h"

namespace rondel::bulk {

struct TangentStep {
  double u;
  double v;
  double height;
  double squared;  // u^2 + v^2
};

// By d = (u, v) from x to a place y. The height is the one over the tangent plane at x times w(x),
// which is the same for all steps from x:
//
//     w(x) w(y) - w(x)^2 - x.d = (|d|^2 w(x) - x.d (2 x.d + |d|^2) / (w(x) + w(y))) / (w(x) + w(y))
inline TangentStep tangent_step(const SquareVector& x, double u, double v, double w_of_y) {
  const double squared = u * u + v * v;
  const double along = x.u * u + x.v * v;
  const double factor = 1 / (x.w + w_of_y);
  const double height = (squared * x.w - along * (2 * along + squared) * factor) * factor;
  return {u, v, height, squared};
}

// Positive if the third step leads above the plane of the others, seen from the side from which
// they are in counterclockwise order.
inline double volume(const TangentStep& a, const TangentStep& b, const TangentStep& c) {
  return a.height * (b.u * c.v - b.v * c.u) + b.height * (c.u * a.v - c.v * a.u) +
         c.height * (a.u * b.v - a.v * b.u);
}

inline double max_squared(const TangentStep& a, const TangentStep& b, const TangentStep& c) {
  return std::max(std::max(a.squared, b.squared), c.squared);
}

}  // namespace rondel::bulk
