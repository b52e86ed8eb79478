// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "dual/split_sites.h"
#include "exact/integer.h"
#include "rondel/error.h"

namespace rondel::dual {
namespace {

using exact::floor_sqrt;
using exact::Integer;
using exact::IntegerVector;

// Significant bits of what is rounded to doubles in the end.
constexpr int wanted_bits = 62;

IntegerVector operator*(const Integer& s, const IntegerVector& v) {
  return {s * v.x, s * v.y, s * v.z};
}

int num_bits(const Integer& value) { return static_cast<int>(value.num_bits()); }

int num_bits(const IntegerVector& v) {
  return std::max({num_bits(v.x), num_bits(v.y), num_bits(v.z)});
}

// value * 2^bits, rounded towards zero.
Integer shifted(const Integer& value, int bits) {
  return bits >= 0 ? value << static_cast<unsigned>(bits) : value >> static_cast<unsigned>(-bits);
}

// value * 2^exponent, rounded to nearest. A sticky bit below the 62 leading ones makes the
// single conversion round correctly.
double to_double(const Integer& value, int exponent) {
  const int excess = num_bits(value) - wanted_bits;
  std::uint64_t magnitude = shifted(value, -std::max(excess, 0)).low_word();
  if (excess > 0) {
    if (static_cast<int>(value.trailing_zeros()) < excess) magnitude |= 1U;
    exponent += excess;
  }
  const double rounded = std::ldexp(static_cast<double>(magnitude), exponent);
  return value < 0 ? -rounded : rounded;
}

// The unit vector of a non-zero integer vector. Its leading 128 bits give the direction to
// 2^-126, the root and the quotients keep that.
Vec rounded_unit(const IntegerVector& v) {
  constexpr unsigned bits = 128;
  const int shift = static_cast<int>(bits) - num_bits(v);
  const IntegerVector w = {shifted(v.x, shift), shifted(v.y, shift), shifted(v.z, shift)};
  const Integer length = floor_sqrt(dot(w, w));
  const auto quotient = [&](const Integer& x) {
    return to_double((x << bits) / length, -static_cast<int>(bits));
  };
  return {quotient(w.x), quotient(w.y), quotient(w.z)};
}

// No two vertices of a triangulation are in the same place, and none is at the center. Where they are,
// these are not the sites that were triangulated, and what follows would divide by zero or try ever
// more digits.
[[noreturn]] void refuse_same_place() {
  throw InvalidInput(
      "two vertices are in the same place, or one is at the center: the sites are not those of the "
      "triangulation",
      0);
}

// Zero has no ray.
void require_different_rays(const IntegerVector& a, const IntegerVector& b) {
  if (dot(a, b) >= 0 && is_zero(cross(a, b))) refuse_same_place();
}

// |a| b x c + |b| c x a + |c| a x b, the normal of the projections of a, b and c, times some
// positive factor. Never zero: a line has at most two points on a sphere.
//
// Roots of numbers scaled by 4^k, rounded down, are wrong by less than 1 in 2^k |a|, so the sum is
// wrong by less than |b x c| + |c x a| + |a x b|.
IntegerVector projected_normal(const IntegerVector& a, const IntegerVector& b,
                               const IntegerVector& c) {
  const IntegerVector bc = cross(b, c);
  const IntegerVector ca = cross(c, a);
  const IntegerVector ab = cross(a, b);
  require_different_rays(a, b);
  require_different_rays(b, c);
  require_different_rays(c, a);
  const int error_bits = std::max({num_bits(bc), num_bits(ca), num_bits(ab)}) + 4;
  for (unsigned k = 64;; k *= 2) {
    const auto scaled_root = [k](const IntegerVector& p) {
      return floor_sqrt(dot(p, p) << (2 * k));
    };
    IntegerVector n = scaled_root(a) * bc + scaled_root(b) * ca + scaled_root(c) * ab;
    if (num_bits(n) >= error_bits + wanted_bits) return n;
  }
}

std::optional<IntegerVector> plane_normal(const IntegerVector& a, const IntegerVector& b,
                                          const IntegerVector& c) {
  IntegerVector n = cross(b - a, c - a);
  if (is_zero(n)) return std::nullopt;
  return n;
}

// The plane through the line of a and b and through `apex`, oriented away from the first site that
// does not lie on it (either way if there is none). Empty if apex is on the line.
std::optional<Point> supporting_normal(const SplitSites& sites, Index a, Index b,
                                       const Point& apex) {
  const Point& pa = sites.point(a);
  const auto ray = exact::scaled_differences({pa, sites.point(b)}, apex);
  const auto normal = cross(ray[0], ray[1] - ray[0]);
  if (is_zero(normal)) return std::nullopt;
  const Vec n = rounded_unit(normal);
  for (const Point& p : sites.sites()) {
    const auto q = exact::scaled_differences({p}, pa);
    const Sign side = exact::sign_of(dot(normal, q[0]));
    if (side == Sign::negative) break;
    if (side == Sign::positive) return Point{-n.x, -n.y, -n.z};
  }
  return to_point(n);
}

ExactNormal collinear_normal(const SplitSites& sites, Index a, Index b) {
  if (const auto n = supporting_normal(sites, a, b, sites.center())) return {*n, true};
  for (const Point& apex : sites.sites()) {
    if (const auto n = supporting_normal(sites, a, b, apex)) return {*n, true};
  }
  return {{}, true};
}

}  // namespace

ExactNormal exact_normal(const SplitSites& sites, Index a, Index b, Index c) {
  const Point& pa = sites.point(a);
  const Point& pb = sites.point(b);
  const Point& pc = sites.point(c);
  if (sites.is_projected()) {
    const auto p = exact::scaled_rays({pa, pb, pc}, sites.center());
    return {to_point(rounded_unit(projected_normal(p[0], p[1], p[2]))), false};
  }
  const auto p = exact::scaled_differences({pa, pb, pc}, sites.center());
  if (const auto n = plane_normal(p[0], p[1], p[2])) return {to_point(rounded_unit(*n)), false};
  if (pa == pb || pb == pc || pc == pa) refuse_same_place();
  return collinear_normal(sites, a, b);
}

// |a| b - |b| a, divided by |a| |b|. Roots are wrong by less than 1 in 2^k |a|, so the sum by
// less than |a| + |b|.
ExactDifference exact_projected_difference(const Point& a, const Point& b, const Point& center) {
  const auto p = exact::scaled_rays({a, b}, center);
  require_different_rays(p[0], p[1]);
  const int error_bits = std::max(num_bits(p[0]), num_bits(p[1])) + 3;
  for (unsigned k = 64;; k *= 2) {
    const Integer length_a = floor_sqrt(dot(p[0], p[0]) << (2 * k));
    const Integer length_b = floor_sqrt(dot(p[1], p[1]) << (2 * k));
    const IntegerVector d = length_a * p[1] - length_b * p[0];
    if (num_bits(d) < error_bits + wanted_bits) continue;
    // |d| / (2^-k length_a length_b), to 128 bits of quotient.
    const Integer product = length_a * length_b;
    const int shift = 128 + num_bits(product) - num_bits(d);
    const Integer quotient = shifted(floor_sqrt(dot(d, d)), shift) / product;
    return {rounded_unit(d), to_double(quotient, static_cast<int>(k) - shift)};
  }
}

// With the integer rays a, b, c and p the weight of a is to the others as det(p, b, c) |a|.
std::array<double, 3> exact_weights(const std::array<Point, 3>& corners, const Point& p,
                                    const Point& center) {
  constexpr unsigned root_bits = 128;
  const auto r = exact::scaled_rays({corners[0], corners[1], corners[2], p}, center);
  std::array<Integer, 3> weights = {det(r[3], r[1], r[2]), det(r[3], r[2], r[0]),
                                    det(r[3], r[0], r[1])};
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = weights[i] * floor_sqrt(dot(r[i], r[i]) << (2 * root_bits));
  }
  const Integer sum = weights[0] + weights[1] + weights[2];
  const auto share = [&sum](const Integer& weight) {
    if (weight == 0) return 0.0;
    const int shift = 128 + num_bits(sum) - num_bits(weight);
    return to_double(shifted(weight, shift) / sum, -shift);
  };
  return {share(weights[0]), share(weights[1]), share(weights[2])};
}

Vec exact_direction(const Point& a, const Point& b) {
  if (a == b) refuse_same_place();
  return rounded_unit(exact::scaled_differences({b}, a)[0]);
}

}  // namespace rondel::dual
