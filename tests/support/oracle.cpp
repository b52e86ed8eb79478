// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/oracle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "support/root_sum.h"

namespace rondel::test {
namespace {

constexpr int lowest_exponent = -1074;  // every finite double is an integer times 2^-1074

mpz_class to_integer(double value) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  mpz_class result(mantissa);
  const int shift = exponent - 53 - lowest_exponent;
  if (shift >= 0) {
    result <<= static_cast<mp_bitcnt_t>(shift);
  } else {
    result >>= static_cast<mp_bitcnt_t>(-shift);  // a subnormal: the lost bits are zeros
  }
  return result;
}

mp_bitcnt_t trailing_zeros(const IntegerVector& v) {
  mp_bitcnt_t zeros = std::numeric_limits<mp_bitcnt_t>::max();
  for (const auto& x : v) {
    if (x != 0) zeros = std::min(zeros, mpz_scan1(x.get_mpz_t(), 0));
  }
  return zeros;
}

void shift_right(IntegerVector& v, mp_bitcnt_t bits) {
  for (auto& x : v) x >>= bits;
}

auto coordinates(const Point& p) { return std::tie(p.x, p.y, p.z); }

// The bits of a double, put together from its parts.
mpz_class encoding(double x) {
  if (x == 0) return 0;
  int exponent = 0;
  const double half = std::frexp(std::abs(x), &exponent);  // at least 1/2, below 1
  const bool is_subnormal = exponent < -1021;
  mpz_class mantissa(std::ldexp(half, is_subnormal ? exponent + 1074 : 53));
  mpz_class fields = is_subnormal ? 0 : exponent + 1022;
  if (!is_subnormal) mantissa -= mpz_class(1) << 52;
  if (std::signbit(x)) fields += 2048;
  return mpz_class(fields << 52) + mantissa;
}

// The first 64 bits of the fraction of the square root, the last one set.
mpz_class odd_fraction_of_root(unsigned n) {
  const mpz_class root = sqrt(mpz_class(mpz_class(n) << 128));
  return mpz_class(root % (mpz_class(1) << 64)) | 1;
}

}  // namespace

IntegerVector cross(const IntegerVector& a, const IntegerVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpz_class dot(const IntegerVector& a, const IntegerVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

mpz_class determinant(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c) {
  return dot(a, cross(b, c));
}

mpz_class hash_of_coordinates(const Point& p) {
  const mpz_class word = mpz_class(1) << 64;
  const auto mixed = [&word](const mpz_class& x, unsigned n) {
    const mpz_class folded = x ^ mpz_class(x >> 32);
    return mpz_class(folded * odd_fraction_of_root(n) % word);
  };
  mpz_class hash = mixed(encoding(p.x), 2);
  hash = mixed((hash + encoding(p.y)) % word, 3);
  hash = mixed((hash + encoding(p.z)) % word, 5);
  return mixed(hash, 2);
}

Oracle::Oracle(std::span<const Point> sites, Model model, const Sphere& sphere) : model_(model) {
  const IntegerVector center = {to_integer(sphere.center.x), to_integer(sphere.center.y),
                                to_integer(sphere.center.z)};
  mp_bitcnt_t common = std::numeric_limits<mp_bitcnt_t>::max();
  for (const Point& p : sites) {
    IntegerVector v = {to_integer(p.x), to_integer(p.y), to_integer(p.z)};
    for (std::size_t i = 0; i < 3; ++i) v[i] -= center[i];
    const mp_bitcnt_t zeros = trailing_zeros(v);
    common = std::min(common, zeros);
    // A projected site is its ray: any positive multiple will do.
    if (model == Model::projected) shift_right(v, zeros);
    vectors_.push_back(std::move(v));
  }
  // The mean of the p_i, with weights |P_i| in the projected model so that the sum is rational.
  // Its length is rounded at 2^-256: g stays on its ray, which is all that the sign needs.
  for (auto& v : vectors_) {
    if (model == Model::weighted) shift_right(v, common);
    squares_.emplace_back(model == Model::weighted ? mpz_class(1) : dot(v, v));
    for (std::size_t i = 0; i < 3; ++i) inner_[i] += v[i] << 256;
    inner_weight_ += sqrt(mpz_class(squares_.back() << 512));
  }
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<mpz_class> hashes(sites.size());
  if (model == Model::projected) std::ranges::transform(sites, hashes.begin(), hash_of_coordinates);
  std::ranges::stable_sort(order, [&](auto a, auto b) {
    if (hashes[a] != hashes[b]) return hashes[a] < hashes[b];
    return coordinates(sites[a]) < coordinates(sites[b]);
  });
  rank_.resize(sites.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank_[order[i]] = i;
}

int Oracle::orientation(std::size_t a, std::size_t b, std::size_t c) const {
  return sgn(determinant(vectors_[a], vectors_[b], vectors_[c]));
}

bool Oracle::is_center(std::size_t a) const {
  return std::ranges::all_of(vectors_[a], [](const auto& x) { return x == 0; });
}

bool Oracle::is_same_site(std::size_t a, std::size_t b) const {
  if (model_ == Model::weighted) return vectors_[a] == vectors_[b];
  const IntegerVector n = cross(vectors_[a], vectors_[b]);
  return n[0] == 0 && n[1] == 0 && n[2] == 0 && dot(vectors_[a], vectors_[b]) > 0;
}

// Any two directions that differ span the plane in which all others must lie.
IntegerVector Oracle::plane_normal() const {
  IntegerVector first;
  IntegerVector normal;
  for (const auto& v : vectors_) {
    if (first == IntegerVector{}) first = v;
    if (normal == IntegerVector{}) normal = cross(first, v);
  }
  const auto leading = std::ranges::find_if(normal, [](const auto& x) { return x != 0; });
  if (leading != normal.end() && *leading < 0) {
    for (auto& x : normal) x = -x;
  }
  return normal;
}

bool Oracle::is_between(std::size_t p, std::size_t a, std::size_t b) const {
  IntegerVector to_a;
  IntegerVector to_b;
  for (std::size_t i = 0; i < 3; ++i) {
    to_a[i] = vectors_[a][i] - vectors_[p][i];
    to_b[i] = vectors_[b][i] - vectors_[p][i];
  }
  return dot(to_a, to_b) < 0;
}

bool Oracle::is_flat() const {
  const IntegerVector normal = plane_normal();
  return std::ranges::all_of(vectors_, [&](const auto& v) { return dot(normal, v) == 0; });
}

int Oracle::flat_orientation(std::size_t a, std::size_t b, std::size_t c) const {
  std::array<unsigned, 3> by_rank = {0, 1, 2};
  const Quad quad = {a, b, c, normal_row};
  std::ranges::sort(by_rank, {}, [&](unsigned i) { return rank_[quad[i]]; });
  for (unsigned monomial = 0; monomial < 8; ++monomial) {
    unsigned e_set = 0;
    for (unsigned k = 0; k < 3; ++k) {
      if ((monomial >> k & 1U) != 0) e_set |= 1U << by_rank[k];
    }
    const int result = coefficient_sign(quad, e_set, 0);
    if (result != 0) return result;
  }
  return 0;
}

// The moved point i in homogeneous coordinates, multiplied by s_i = sqrt(square) > 0 and, for the
// d-part, by the weight w of g = G / w (which makes every d_i larger by one factor):
//
//     (s_i, P_i) + e_i (0, P_i) + d_i (0, w P_i - s_i G)
//
// A row of the determinant takes one of the three summands, and each summand is
// a sum of at most two terms: rational, or rational times s_i.
int Oracle::coefficient_sign(const Quad& quad, unsigned e_set, unsigned d_set) const {
  struct Term {
    bool has_root = false;
    int head = 0;
    IntegerVector tail;
  };
  std::array<std::vector<Term>, 4> rows;
  RootSum sum;
  for (unsigned i = 0; i < 4; ++i) {
    if (quad[i] == normal_row) {
      rows[i] = {{false, 0, plane_normal()}};
      sum.squares[i] = 1;
      continue;
    }
    const IntegerVector& v = vectors_[quad[i]];
    sum.squares[i] = squares_[quad[i]];
    if ((e_set >> i & 1U) != 0) {
      rows[i] = {{false, 0, v}};
    } else if ((d_set >> i & 1U) != 0) {
      IntegerVector scaled = v;
      IntegerVector minus_inner = inner_;
      for (auto& x : scaled) x *= inner_weight_;
      for (auto& x : minus_inner) x = -x;
      rows[i] = {{false, 0, scaled}, {true, 0, minus_inner}};
    } else {
      rows[i] = {{true, 1, {}}, {false, 0, v}};
    }
  }
  for (const Term& a : rows[0]) {
    for (const Term& b : rows[1]) {
      for (const Term& c : rows[2]) {
        for (const Term& d : rows[3]) {
          if (a.head + b.head + c.head + d.head != 1) continue;  // two such rows are parallel
          mpz_class value;
          if (a.head != 0) value = determinant(b.tail, c.tail, d.tail);
          if (b.head != 0) value = -determinant(a.tail, c.tail, d.tail);
          if (c.head != 0) value = determinant(a.tail, b.tail, d.tail);
          if (d.head != 0) value = -determinant(a.tail, b.tail, c.tail);
          const unsigned roots = (a.has_root ? 1U : 0U) | (b.has_root ? 2U : 0U) |
                                 (c.has_root ? 4U : 0U) | (d.has_root ? 8U : 0U);
          sum.c[model_ == Model::weighted ? 0U : roots] += value;
        }
      }
    }
  }
  return sign(sum);
}

int Oracle::side_of_circle(std::size_t a, std::size_t b, std::size_t c, std::size_t p) const {
  return coefficient_sign({a, b, c, p}, 0, 0);
}

int Oracle::perturbed_side(std::size_t a, std::size_t b, std::size_t c, std::size_t p) const {
  const Quad quad = {a, b, c, p};
  std::array<unsigned, 4> by_rank = {0, 1, 2, 3};
  std::ranges::sort(by_rank, {}, [&](unsigned i) { return rank_[quad[i]]; });
  // Monomials from the largest to the smallest: bit k of the low half of `monomial` is the
  // exponent of the e of the (k+1)st site in order, the high half holds the d's.
  for (unsigned monomial = 0; monomial < 256; ++monomial) {
    unsigned e_set = 0;
    unsigned d_set = 0;
    for (unsigned k = 0; k < 4; ++k) {
      if ((monomial >> k & 1U) != 0) e_set |= 1U << by_rank[k];
      if ((monomial >> (k + 4) & 1U) != 0) d_set |= 1U << by_rank[k];
    }
    if ((e_set & d_set) != 0) continue;  // no row holds both
    const int result = coefficient_sign(quad, e_set, d_set);
    if (result == 0) continue;
    const bool is_odd = std::popcount(e_set | d_set) % 2 != 0;
    return model_ == Model::projected && is_odd ? -result : result;
  }
  return 0;
}

}  // namespace rondel::test
