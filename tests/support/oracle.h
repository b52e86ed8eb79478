// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the library's predicates from their definition with GMP and MPFR. It shares no code and
// no formula with the library.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::test {

using IntegerVector = std::array<mpz_class, 3>;

// A set of sites, each an exact integer vector from the center of the sphere.
//
// Perturbation. Site i moves from its exact place p_i (in the projected model p_i is the unit
// vector) to
//
//     p_i (1 + s e_i) + s d_i (p_i - g),    s = -1 in the projected model, 1 in the weighted one,
//
// where g is a point inside the hull and, with the sites in the order of `rank`,
// 1 >> e_1 >> e_2 >> ... >> d_1 >> d_2 >> ...: each is positive and smaller than
// any power of those before. The determinant of four moved sites is a polynomial in
// the e's and d's, linear in each; its sign is that of its leading coefficient.
class Oracle {
 public:
  Oracle(std::span<const Point> sites, Model model, const Sphere& sphere);

  [[nodiscard]] std::size_t size() const noexcept { return vectors_.size(); }
  // The sign of det(a, b, c), looking from the center.
  [[nodiscard]] int orientation(std::size_t a, std::size_t b, std::size_t c) const;
  // The unperturbed sign of det(b-a, c-a, p-a): 0 if and only if the four are coplanar.
  [[nodiscard]] int side_of_circle(std::size_t a, std::size_t b, std::size_t c,
                                   std::size_t p) const;
  // The sign after the perturbation. It is 0 only if all moved sites stay coplanar: two equal
  // sites, or four on a line through the center.
  [[nodiscard]] int perturbed_side(std::size_t a, std::size_t b, std::size_t c,
                                   std::size_t p) const;
  [[nodiscard]] bool is_same_site(std::size_t a, std::size_t b) const;
  // The place of the site in the order of the infinitesimals: the lexicographic order of the
  // coordinates; in the projected model hash_of_coordinates() comes before these.
  [[nodiscard]] std::size_t rank(std::size_t a) const { return rank_[a]; }
  // Whether the site is the center of the sphere.
  [[nodiscard]] bool is_center(std::size_t a) const;
  // Whether p, in line with a and b, is strictly between them, unperturbed.
  [[nodiscard]] bool is_between(std::size_t p, std::size_t a, std::size_t b) const;
  // Whether all sites lie in one plane with the center.
  [[nodiscard]] bool is_flat() const;
  // \pre is_flat(). The orientation of three moved sites within that plane, seen from the side of
  // its normal whose first non-zero coordinate is positive. Only the e's count: 0 means in line
  // with the center.
  [[nodiscard]] int flat_orientation(std::size_t a, std::size_t b, std::size_t c) const;
  // Exact vector from the center, up to a positive factor (in the weighted model the same one for
  // all sites).
  [[nodiscard]] const IntegerVector& vector(std::size_t a) const { return vectors_[a]; }

 private:
  // A row that is the normal of the plane of all sites instead of a site.
  static constexpr std::size_t normal_row = static_cast<std::size_t>(-1);
  using Quad = std::array<std::size_t, 4>;
  [[nodiscard]] IntegerVector plane_normal() const;
  // The sign of the coefficient of the product of e_i, i in `e_set`, and d_i, i in `d_set`;
  // sets are bit masks over the rows of `quad`.
  [[nodiscard]] int coefficient_sign(const Quad& quad, unsigned e_set, unsigned d_set) const;

  Model model_;
  std::vector<IntegerVector> vectors_;
  std::vector<mpz_class> squares_;  // squared lengths; 1 in the weighted model
  std::vector<std::size_t> rank_;
  IntegerVector inner_;  // g = inner_ / inner_weight_
  mpz_class inner_weight_;
};

// The hash that docs/theory/perturbation.md defines.
mpz_class hash_of_coordinates(const Point& p);

mpz_class determinant(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c);
IntegerVector cross(const IntegerVector& a, const IntegerVector& b);
mpz_class dot(const IntegerVector& a, const IntegerVector& b);

}  // namespace rondel::test
