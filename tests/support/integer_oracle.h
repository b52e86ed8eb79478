// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The signs of the predicates for small integers, in 128 bits: an oracle that takes nanoseconds and
// shares no formula with the library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rondel::test {

__extension__ using Wide = __int128;

// An exact vector from the center of the sphere.
struct IntegerRay {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
  friend bool operator==(const IntegerRay&, const IntegerRay&) = default;
};

inline IntegerRay operator-(const IntegerRay& a, const IntegerRay& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline int sign_of(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// \pre |coordinates| <= 2^40: the six products are below 2^120 each.
inline Wide determinant(const IntegerRay& a, const IntegerRay& b, const IntegerRay& c) {
  const auto minor = [](Wide p, Wide q, Wide r, Wide s) { return p * s - q * r; };
  return a.x * minor(b.y, b.z, c.y, c.z) - a.y * minor(b.x, b.z, c.x, c.z) +
         a.z * minor(b.x, b.y, c.x, c.y);
}

// \pre |coordinates| < 2^62.
inline Wide squared_length(const IntegerRay& a) {
  return Wide{a.x} * a.x + Wide{a.y} * a.y + Wide{a.z} * a.z;
}

// \pre |coordinates| <= 2^40.
inline bool are_on_one_ray(const IntegerRay& a, const IntegerRay& b) {
  const auto minor = [](Wide p, Wide q, Wide r, Wide s) { return p * s - q * r; };
  return minor(a.x, a.y, b.x, b.y) == 0 && minor(a.y, a.z, b.y, b.z) == 0 &&
         minor(a.x, a.z, b.x, b.z) == 0 && Wide{a.x} * b.x + Wide{a.y} * b.y + Wide{a.z} * b.z > 0;
}

// The largest coordinate for which sign_of_four_roots() has the room that it needs.
inline constexpr std::int64_t max_for_roots = 7;

// The sign of p sqrt(u) + q sqrt(v), with signs p and q.
inline int sign_of_two_roots(int p, Wide u, int q, Wide v) {
  const int first = p * sign_of(u);
  const int second = q * sign_of(v);
  if (first * second >= 0) return first != 0 ? first : second;
  return sign_of(u - v) * first;
}

// The sign of k + p sqrt(u) + q sqrt(v), with signs p and q: of two parts with different signs,
// that with the larger square. \pre |k| < 2^30; u, v < 2^60.
inline int sign_with_two_roots(Wide k, int p, Wide u, int q, Wide v) {
  const int roots = sign_of_two_roots(p, u, q, v);
  const int rational = sign_of(k);
  if (rational * roots >= 0) return rational != 0 ? rational : roots;
  // k^2 - (u + v + 2 p q sqrt(u v)), in which |m| < 2^61.
  const Wide m = k * k - u - v;
  const int mixed = p * q * sign_of(u) * sign_of(v);
  if (mixed == 0) return rational * sign_of(m);
  if (sign_of(m) != mixed) return rational * -mixed;
  return rational * mixed * sign_of(m * m - 4 * u * v);
}

// The sign of s0 sqrt(t0) + s1 sqrt(t1) + s2 sqrt(t2) + s3 sqrt(t3), with signs s. \pre t < 2^29.
inline int sign_of_four_roots(const std::array<int, 4>& s, const std::array<Wide, 4>& t) {
  const int left = sign_of_two_roots(s[0], t[0], s[1], t[1]);
  const int right = sign_of_two_roots(s[2], t[2], s[3], t[3]);
  if (left * right >= 0) return left != 0 ? left : right;
  const auto used = [&](std::size_t i) { return s[i] == 0 ? Wide{0} : t[i]; };
  return left * sign_with_two_roots(used(0) + used(1) - used(2) - used(3), s[0] * s[1],
                                    4 * used(0) * used(1), -s[2] * s[3], 4 * used(2) * used(3));
}

// Where p lies with respect to the plane through a, b, c. \pre |coordinates| <= 2^39.
inline int side_of_plane(const IntegerRay& a, const IntegerRay& b, const IntegerRay& c,
                         const IntegerRay& p) {
  return sign_of(determinant(b - a, c - a, p - a));
}

// The same for the projections on the sphere: the determinants of three rays, each times the length
// of the fourth. \pre |coordinates| <= max_for_roots: by Hadamard a determinant is at most
// (3 * 7^2)^1.5 and its square times a squared length below 2^29.
inline int side_of_circle(const IntegerRay& a, const IntegerRay& b, const IntegerRay& c,
                          const IntegerRay& p) {
  const std::array<Wide, 4> minors = {determinant(b, c, p), -determinant(a, c, p),
                                      determinant(a, b, p), -determinant(a, b, c)};
  const std::array<Wide, 4> lengths = {squared_length(a), squared_length(b), squared_length(c),
                                       squared_length(p)};
  std::array<int, 4> signs{};
  std::array<Wide, 4> squares{};
  for (std::size_t i = 0; i < 4; ++i) {
    signs[i] = sign_of(minors[i]);
    squares[i] = minors[i] * minors[i] * lengths[i];
  }
  return sign_of_four_roots(signs, squares);
}

}  // namespace rondel::test
