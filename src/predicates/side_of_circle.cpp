// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/side_of_circle.h"

#include <array>
#include <optional>

#include "exact/expansion.h"
#include "exact/extended.h"
#include "exact/integer.h"

namespace rondel::predicates {
namespace {

using exact::DoubleDouble;
using exact::Expansion;
using exact::expansion;
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

using Row = Expansion<1>[3];

struct ExactRow {
  Row row;
  Expansion<6> squared_length;

  explicit ExactRow(const Point& p)
      : row{expansion(p.x), expansion(p.y), expansion(p.z)},
        squared_length((expansion(exact::two_square(p.x)) + expansion(exact::two_square(p.y))) +
                       expansion(exact::two_square(p.z))) {}
};

template <int N>
Sign compare(const Expansion<N>& a, const Expansion<N>& b) {
  return sign_of(a - b);
}

// The determinant of the four unit vectors with a last column of ones, times the product of the
// lengths, is the sum of four terms a_i sqrt(alpha_i): alpha_i the squared length of
// point i, a_i a determinant of the other three. Terms of equal alpha are added
// exactly. When the sums agree in sign, or all are zero, that is the answer: so it is for sites on
// one sphere and for mirrored sites. Otherwise nothing is returned.
std::optional<Sign> sign_by_equal_lengths(const Point& pb, const Point& pc, const Point& pd,
                                          const Point& pp) {
  const ExactRow b(pb);
  const ExactRow c(pc);
  const ExactRow d(pd);
  const ExactRow p(pp);
  const std::array<const Expansion<6>*, 4> alpha = {&p.squared_length, &b.squared_length,
                                                    &c.squared_length, &d.squared_length};
  const std::array<Expansion<24>, 4> a = {-det(b.row, c.row, d.row), det(p.row, c.row, d.row),
                                          -det(p.row, b.row, d.row), det(p.row, b.row, c.row)};
  std::array<bool, 4> done{};
  Sign common = Sign::zero;
  for (std::size_t i = 0; i < 4; ++i) {
    if (done[i]) continue;
    Expansion<24> zero;
    std::array<const Expansion<24>*, 4> members = {&a[i], &zero, &zero, &zero};
    std::size_t count = 1;
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (done[j] || compare(*alpha[i], *alpha[j]) != Sign::zero) continue;
      done[j] = true;
      members[count++] = &a[j];
    }
    const Sign sign = sign_of((*members[0] + *members[1]) + (*members[2] + *members[3]));
    if (sign == Sign::zero) continue;
    if (common != Sign::zero && sign != common) return std::nullopt;
    common = sign;
  }
  return common;
}

}  // namespace

// For a coordinate p_z of p that is not 0, p.B = -|B|^2 / 2 turns the third column of det(B, C, D)
// into -|B|^2 / (2 p_z), ... (docs/theory/filters.md).
Sign side_of_circle_extended(const SplitPoint& b, const SplitPoint& c, const SplitPoint& d,
                             const SplitPoint& p) {
  constexpr long double bound = 128 * exact::extended_unit_roundoff;
  constexpr long double least_squared_distance = 0x1p-72L;
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
  if (!(m > least_squared_distance && std::abs(value) > bound * (m * m))) return Sign::zero;
  return (value > 0) == (along[last] > 0) ? Sign::positive : Sign::negative;
}

Sign side_of_circle_double_double(const SplitPoint& b, const SplitPoint& c, const SplitPoint& d,
                                  const SplitPoint& p) {
  const DoubleDoubleVector pb = difference(b, p);
  const DoubleDoubleVector pc = difference(c, p);
  const DoubleDoubleVector pd = difference(d, p);
  const double value = -det(pb, pc, pd).hi;
  const double m = max_squared_length(rounded(pb), rounded(pc), rounded(pd));
  return unless_unsure(value, std::abs(value) > circle_double_double_bound * m);
}

Sign side_of_circle_exact(const Point& b, const Point& c, const Point& d, const Point& p,
                          const Point& center) {
  if (center == Point{} && is_safe_for_expansions({b, c, d, p})) {
    if (const auto sign = sign_by_equal_lengths(b, c, d, p)) return *sign;
  }
  const auto v = exact::scaled_rays({b, c, d, p}, center);
  const std::array<exact::Integer, 4> coefficients = {
      -det(v[0], v[1], v[2]), det(v[3], v[1], v[2]), -det(v[3], v[0], v[2]), det(v[3], v[0], v[1])};
  const std::array<exact::Integer, 4> radicands = {dot(v[3], v[3]), dot(v[0], v[0]),
                                                   dot(v[1], v[1]), dot(v[2], v[2])};
  return exact::sign_of_root_sum(coefficients, radicands);
}

Decision side_of_circle_ladder(const Point& b, const Point& c, const Point& d, const Point& p,
                               const Point& center) {
  const Sign sign =
      side_of_circle_double_double(exact::unit_vector(b, center), exact::unit_vector(c, center),
                                   exact::unit_vector(d, center), exact::unit_vector(p, center));
  if (sign != Sign::zero) return {sign, Rung::double_double};
  return {side_of_circle_exact(b, c, d, p, center), Rung::exact};
}

}  // namespace rondel::predicates
