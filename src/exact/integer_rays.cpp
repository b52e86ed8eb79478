// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The determinant times the lengths of the rays is a sum of four terms a_i sqrt(alpha_i): alpha_i
// is the squared length of ray i, a_i a determinant of the other three. Two roots are in one class
// when the product of their radicands is a square, r_ij^2 = alpha_i alpha_j. Then
//
//     a_i sqrt(alpha_i) + a_j sqrt(alpha_j) = (a_i alpha_i + a_j r_ij) / sqrt(alpha_i),
//
// so the sign of the sum over a class is that of an integer. When these signs agree, or all are
// zero, that is the answer. As roots of different classes are linearly independent over the
// rationals (exact/integer.h), the sum is zero in no other case.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "exact/integer_signs.h"
#include "exact/words.h"

namespace rondel::exact {

#ifdef __SIZEOF_INT128__

namespace {

__extension__ using Long = __int128;
__extension__ using UnsignedLong = unsigned __int128;

using IntegerRay = std::array<std::int64_t, 3>;  // smaller than 2^61

// The ray from o to p in a unit of which the longest coordinate of the two has between 2^59 and
// 2^60; whether all are multiples of the unit, which is no subnormal number.
bool find_ray(const Point& p, const Point& o, IntegerRay& ray) {
  constexpr std::uint64_t max_bits = 59;
  constexpr std::uint64_t bias = 1023;
  const std::array<double, 6> given = {p.x, p.y, p.z, o.x, o.y, o.z};
  double longest = 0;
  for (const double x : given) longest = std::max(longest, std::abs(x));
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(longest) >> 52U;
  if (exponent <= max_bits) return false;
  const auto unit = std::bit_cast<double>((exponent - max_bits) << 52U);
  const auto per_unit = std::bit_cast<double>((2 * bias + max_bits - exponent) << 52U);
  std::array<std::int64_t, 6> integers{};
  bool are_exact = true;
  for (std::size_t i = 0; i < 6; ++i) {
    integers[i] = static_cast<std::int64_t>(per_unit * given[i]);
    are_exact &= static_cast<double>(integers[i]) * unit == given[i];
  }
  for (std::size_t i = 0; i < 3; ++i) ray[i] = integers[i] - integers[i + 3];
  return are_exact;
}

// Below 3 * 2^122.
UnsignedLong squared_length(const IntegerRay& ray) {
  Long sum = 0;
  for (const std::int64_t x : ray) sum += Long{x} * x;
  return static_cast<UnsignedLong>(sum);
}

// Each coordinate is smaller than 2^123.
using Minors = std::array<Long, 3>;

Minors minors_of(const IntegerRay& v, const IntegerRay& w) {
  return {Long{v[1]} * w[2] - Long{v[2]} * w[1], Long{v[2]} * w[0] - Long{v[0]} * w[2],
          Long{v[0]} * w[1] - Long{v[1]} * w[0]};
}

// A determinant, high 2^64 + low, smaller than 2^186.
struct Determinant {
  Long high = 0;
  Word low = 0;

  [[nodiscard]] Sign sign() const {
    if (high != 0) return high < 0 ? Sign::negative : Sign::positive;
    return low == 0 ? Sign::zero : Sign::positive;
  }
};

// Minors are split into high 2^64 + low, with 0 <= low < 2^64 and |high| < 2^59: so three products
// with either are smaller than 2^127.
Determinant dot(const IntegerRay& v, const Minors& minors) {
  Long high = 0;
  Long low = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    high += (minors[i] >> 64U) * v[i];
    low += static_cast<Long>(static_cast<Word>(minors[i])) * v[i];
  }
  return {high + (low >> 64U), static_cast<Word>(low)};
}

Determinant operator-(const Determinant& a) {
  return {-a.high - static_cast<Long>(a.low != 0), Word{0} - a.low};
}

// A sum of at most four products of a determinant and a number below 2^124 is smaller than 2^312.
// Numbers so small are told apart modulo 2^320.
class SumOfProducts {
 public:
  void add(const Determinant& a, UnsignedLong b) {
    const Word sign = a.high < 0 ? ~Word{0} : 0;
    const Words<5> first = {a.low, static_cast<Word>(a.high), static_cast<Word>(a.high >> 64U),
                            sign, sign};
    const std::array<Word, 2> second = {static_cast<Word>(b), static_cast<Word>(b >> 64U)};
    for (std::size_t j = 0; j < 2; ++j) {
      Word carry = 0;
      for (std::size_t i = 0; i + j < 5; ++i) {
        const TwoWords t = multiply_and_add(first[i], second[j], words_[i + j], carry);
        words_[i + j] = t.low;
        carry = t.high;
      }
    }
  }

  [[nodiscard]] Sign sign() const {
    if (words_[4] >> 63U != 0) return Sign::negative;
    const bool is_zero = std::ranges::all_of(words_, [](Word w) { return w == 0; });
    return is_zero ? Sign::zero : Sign::positive;
  }

 private:
  Words<5> words_{};
};

Words<4> product_of(UnsignedLong a, UnsignedLong b) {
  const auto words = [](UnsignedLong x) {
    return Words<2>{static_cast<Word>(x), static_cast<Word>(x >> 64U)};
  };
  Words<4> product{};
  multiply(words(a), words(b), product);
  return product;
}

unsigned trailing_zeros(UnsignedLong x) {
  const auto low = static_cast<Word>(x);
  return static_cast<unsigned>(low != 0 ? std::countr_zero(low)
                                        : 64 + std::countr_zero(static_cast<Word>(x >> 64U)));
}

// y with y^2 q = 1 modulo 2^126, for q = 1 modulo 8. Where y^2 q = 1 + e, the square of y (2 - e) / 2
// times q is 1 - 3/4 e^2 + e^3 / 4: so if e is 0 modulo 2^k for y, it is modulo 2^(2k-2) for that.
// From k = 3 on: 4, 6, 10, 18, 34 and, with more words, 66, 130. The halves lose the highest bit.
UnsignedLong inverse_root_modulo(UnsignedLong q) {
  const auto short_q = static_cast<Word>(q);
  Word short_y = 1;
  for (int i = 0; i < 5; ++i) short_y *= (3 - short_q * short_y * short_y) >> 1U;
  UnsignedLong y = short_y;
  for (int i = 0; i < 2; ++i) y *= (3 - q * y * y) >> 1U;
  return y;
}

// The root of a b where that is a square, else 0. Precondition: 0 < a, b < 2^124.
//
// The odd part of a square is 1 modulo 8. Its odd root, r < 2^124, is one of only two numbers below
// 2^125 whose squares agree with it modulo 2^126: the other one is 2^125 - r.
UnsignedLong root_of_product(UnsignedLong a, UnsignedLong b) {
  if (a == b) return a;
  const unsigned zeros_of_a = trailing_zeros(a);
  const unsigned zeros_of_b = trailing_zeros(b);
  if ((zeros_of_a + zeros_of_b) % 2 != 0) return 0;
  const UnsignedLong odd_a = a >> zeros_of_a;
  const UnsignedLong odd_b = b >> zeros_of_b;
  const UnsignedLong q = odd_a * odd_b;
  if (q % 8 != 1) return 0;
  constexpr UnsignedLong range = UnsignedLong{1} << 125U;
  const UnsignedLong r = q * inverse_root_modulo(q) % range;
  const UnsignedLong root = std::min(r, range - r);
  if (product_of(root, root) != product_of(odd_a, odd_b)) return 0;
  return root << (zeros_of_a + zeros_of_b) / 2;
}

using Determinants = std::array<Determinant, 4>;

std::optional<Sign> sign_by_classes(const Determinants& a,
                                    const std::array<UnsignedLong, 4>& alpha) {
  std::array<bool, 4> is_done{};
  for (std::size_t i = 0; i < 4; ++i) is_done[i] = a[i].sign() == Sign::zero;
  Sign common = Sign::zero;
  for (std::size_t i = 0; i < 4; ++i) {
    if (is_done[i]) continue;
    SumOfProducts sum;
    sum.add(a[i], alpha[i]);
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (is_done[j]) continue;
      const UnsignedLong root = root_of_product(alpha[i], alpha[j]);
      if (root == 0) continue;
      is_done[j] = true;
      sum.add(a[j], root);
    }
    const Sign sign = sum.sign();
    if (sign == Sign::zero) continue;
    if (common != Sign::zero && sign != common) return std::nullopt;
    common = sign;
  }
  return common;
}

}  // namespace

std::optional<Sign> side_of_rays_in_integers(const std::array<Point, 4>& points,
                                             const Point& center) {
  IntegerRay b;
  IntegerRay c;
  IntegerRay d;
  IntegerRay p;
  if (!find_ray(points[0], center, b) || !find_ray(points[1], center, c) ||
      !find_ray(points[2], center, d) || !find_ray(points[3], center, p)) {
    return std::nullopt;
  }
  const Minors cd = minors_of(c, d);
  const Minors pb = minors_of(p, b);
  return sign_by_classes(
      {dot(p, cd), -dot(b, cd), -dot(d, pb), dot(c, pb)},
      {squared_length(b), squared_length(p), squared_length(c), squared_length(d)});
}

#else

std::optional<Sign> side_of_rays_in_integers(const std::array<Point, 4>& /*points*/,
                                             const Point& /*center*/) {
  return std::nullopt;
}

#endif

}  // namespace rondel::exact
