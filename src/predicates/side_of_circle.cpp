// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/side_of_circle.h"

#include <array>

#include "exact/eft.h"

namespace rondel::predicates {
namespace {

using exact::DoubleDouble;
using exact::SplitPoint;

using DoubleDoubleVector = exact::Vector3<DoubleDouble>;

// a - b, where only the low parts are rounded.
DoubleDouble difference(double a, double a_low, double b, double b_low) {
  const DoubleDouble d = exact::two_diff(a, b);
  return exact::two_sum(d.hi, d.lo + (a_low - b_low));
}

DoubleDoubleVector difference(const SplitPoint& a, const SplitPoint& b) {
  return {difference(a.hi.x, a.lo.x, b.hi.x, b.lo.x), difference(a.hi.y, a.lo.y, b.hi.y, b.lo.y),
          difference(a.hi.z, a.lo.z, b.hi.z, b.lo.z)};
}

Vector rounded(const DoubleDoubleVector& v) { return {v.x.hi, v.y.hi, v.z.hi}; }

using Coordinates = std::array<double, 3>;

Coordinates coordinates(const Point& p) { return {p.x, p.y, p.z}; }

// The difference q - p of split unit vectors, in axes of which the last one is the longest of p.
struct ExtendedStep {
  long double x;
  long double y;
  long double squared;

  ExtendedStep(const SplitPoint& q, const SplitPoint& p, unsigned last) {
    constexpr std::array<double Point::*, 5> axes = {&Point::x, &Point::y, &Point::z, &Point::x,
                                                     &Point::y};
    const auto along = [&](unsigned i) {
      const auto axis = axes[i];
      return (static_cast<long double>(q.hi.*axis) - p.hi.*axis) + (q.lo.*axis - p.lo.*axis);
    };
    x = along(last + 1);
    y = along(last + 2);
    const long double z = along(last);
    squared = x * x + y * y + z * z;
  }
};

}  // namespace

// For a coordinate p_z of p that is not 0, p.B = -|B|^2 / 2 turns the third column of det(B, C, D)
// into -|B|^2 / (2 p_z), ... (docs/theory/filters.md).
Sign side_of_circle_extended(const SplitPoint& b, const SplitPoint& c, const SplitPoint& d,
                             const SplitPoint& p) {
  constexpr long double bound = 128 * exact::extended_unit_roundoff;
  constexpr long double min_squared_distance = 0x1p-72L;
  if (!exact::has_extended_precision()) return Sign::zero;
  const Coordinates along = coordinates(p.hi);
  const auto longer = [&](unsigned i, unsigned j) {
    return std::abs(along[i]) < std::abs(along[j]) ? j : i;
  };
  const unsigned last = longer(longer(0, 1), 2);
  const ExtendedStep pb(b, p, last);
  const ExtendedStep pc(c, p, last);
  const ExtendedStep pd(d, p, last);
  const long double m = std::max({pb.squared, pc.squared, pd.squared});
  const long double value = pb.squared * (pc.x * pd.y - pc.y * pd.x) +
                            pc.squared * (pd.x * pb.y - pd.y * pb.x) +
                            pd.squared * (pb.x * pc.y - pb.y * pc.x);
  if (!(m > min_squared_distance && std::abs(value) > bound * (m * m))) return Sign::zero;
  return (value > 0) == (along[last] > 0) ? Sign::positive : Sign::negative;
}

Sign side_of_circle_double_double(const SplitPoint& b, const SplitPoint& c, const SplitPoint& d,
                                  const SplitPoint& p) {
  const DoubleDoubleVector pb = difference(b, p);
  const DoubleDoubleVector pc = difference(c, p);
  const DoubleDoubleVector pd = difference(d, p);
  // |value| <= 3/2 H^4 of unit vectors.
  const double m = max_squared_length(rounded(pb), rounded(pc), rounded(pd));
  if (m < circle_double_double_bound / 2) return Sign::zero;
  const double value = -det(pb, pc, pd).hi;
  return unless_unsure(value, std::abs(value) > circle_double_double_bound * m);
}

}  // namespace rondel::predicates
