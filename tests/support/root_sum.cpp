// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/root_sum.h"

#include <mpfr.h>

#include <span>
#include <vector>

namespace rondel::test {
namespace {

using Coefficients = std::vector<mpz_class>;  // 2^k of them over k roots
using Squares = std::span<const mpz_class>;

Coefficients multiply(std::span<const mpz_class> a, std::span<const mpz_class> b, Squares squares) {
  Coefficients product(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == 0) continue;
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (b[j] == 0) continue;
      mpz_class term = a[i] * b[j];
      for (std::size_t root = 0; root < squares.size(); ++root) {
        if ((i & j & (std::size_t{1} << root)) != 0) term *= squares[root];
      }
      product[i ^ j] += term;
    }
  }
  return product;
}

int sign_in_tower(std::span<const mpz_class> c, Squares squares) {
  if (squares.empty()) return sgn(c[0]);
  const std::size_t half = c.size() / 2;
  const Squares lower = squares.first(squares.size() - 1);
  const auto a = c.first(half);
  const auto b = c.last(half);
  const int sign_a = sign_in_tower(a, lower);
  const int sign_b = sign_in_tower(b, lower);
  if (sign_a * sign_b >= 0) return sign_a != 0 ? sign_a : sign_b;
  Coefficients difference = multiply(a, a, lower);
  const Coefficients b2 = multiply(b, b, lower);
  for (std::size_t i = 0; i < half; ++i) difference[i] -= b2[i] * squares.back();
  return sign_a * sign_in_tower(difference, lower);
}

class Float {
 public:
  explicit Float(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
  ~Float() { mpfr_clear(value_); }
  Float(const Float&) = delete;
  Float& operator=(const Float&) = delete;
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

// Each term is a product of at most five factors with 9 roundings in all, and the sum
// of 16 terms has 15 more, each relative to the sum of absolute values: the error is below
// (9 + 15 + second-order terms) * 2^-bits * total < 2^(5-bits) * total.
std::optional<int> sign_at_precision(const RootSum& sum, mpfr_prec_t bits) {
  Float root(bits);
  Float term(bits);
  Float value(bits);
  Float total(bits);
  mpfr_set_zero(value, 1);
  mpfr_set_zero(total, 1);
  for (std::size_t m = 0; m < sum.c.size(); ++m) {
    if (sum.c[m] == 0) continue;
    mpfr_set_z(term, sum.c[m].get_mpz_t(), MPFR_RNDN);
    for (std::size_t i = 0; i < sum.squares.size(); ++i) {
      if ((m & (std::size_t{1} << i)) == 0) continue;
      mpfr_set_z(root, sum.squares[i].get_mpz_t(), MPFR_RNDN);
      mpfr_sqrt(root, root, MPFR_RNDN);
      mpfr_mul(term, term, root, MPFR_RNDN);
    }
    mpfr_add(value, value, term, MPFR_RNDN);
    mpfr_abs(term, term, MPFR_RNDN);
    mpfr_add(total, total, term, MPFR_RNDU);
  }
  if (mpfr_zero_p(static_cast<mpfr_ptr>(total)) != 0) return 0;
  mpfr_mul_2si(total, total, 6 - static_cast<long>(bits), MPFR_RNDU);
  if (mpfr_cmpabs(value, total) <= 0) return std::nullopt;
  return mpfr_sgn(static_cast<mpfr_ptr>(value)) > 0 ? 1 : -1;
}

}  // namespace

int sign_by_squaring(const RootSum& sum) { return sign_in_tower(sum.c, sum.squares); }

std::optional<int> sign_by_mpfr(const RootSum& sum, unsigned max_bits) {
  for (unsigned bits = 128; bits <= max_bits; bits *= 2) {
    const auto result = sign_at_precision(sum, static_cast<mpfr_prec_t>(bits));
    if (result) return result;
  }
  return std::nullopt;
}

int sign(const RootSum& sum) {
  const auto quick = sign_by_mpfr(sum, 256);
  return quick ? *quick : sign_by_squaring(sum);
}

}  // namespace rondel::test
