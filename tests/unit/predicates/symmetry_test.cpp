// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Properties that hold for any sites, without an oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "rondel/predicates.h"
#include "support/adversarial.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

constexpr std::array<Model, 2> models = {Model::projected, Model::weighted};

int side(const Four& f, Model model) {
  return to_int(side_of_circle(f[0], f[1], f[2], f[3], model));
}

// A permutation of the axes and a reflection of each, with the sign of its determinant.
struct AxisPermutation {
  std::array<int, 3> axis;
  int signs;
  int determinant;

  Point operator()(const Point& p) const {
    const std::array<double, 3> c = {p.x, p.y, p.z};
    std::array<double, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] = ((signs >> i & 1) != 0 ? -1 : 1) * c[static_cast<std::size_t>(axis[i])];
    }
    return {r[0], r[1], r[2]};
  }
};

std::vector<AxisPermutation> axis_permutations() {
  std::vector<AxisPermutation> result;
  std::array<int, 3> axis = {0, 1, 2};
  do {
    const bool is_cyclic = (axis[0] + 1) % 3 == axis[1];
    for (int signs = 0; signs < 8; ++signs) {
      const int reflections = (signs & 1) + (signs >> 1 & 1) + (signs >> 2);
      result.push_back({axis, signs, (reflections % 2 == 0) == is_cyclic ? 1 : -1});
    }
  } while (std::ranges::next_permutation(axis).found);
  return result;
}

class predicate_symmetry : public testing::TestWithParam<FourGenerator> {};

TEST_P(predicate_symmetry, side_of_circle_is_odd) {
  Random random(21);
  for (std::size_t i = 0; i < scaled(150) && !HasFailure(); ++i) {
    const Four four = GetParam().make(random);
    for (const Model model : models) {
      const int expected = side(four, model);
      std::array<std::size_t, 4> order = {0, 1, 2, 3};
      do {
        int parity = 1;
        for (std::size_t a = 0; a < 4; ++a) {
          for (std::size_t b = a + 1; b < 4; ++b) parity *= order[a] > order[b] ? -1 : 1;
        }
        const Four permuted = {four[order[0]], four[order[1]], four[order[2]], four[order[3]]};
        EXPECT_EQ(side(permuted, model), parity * expected);
      } while (std::ranges::next_permutation(order).found);
    }
  }
}

TEST_P(predicate_symmetry, orientation_is_odd_and_cyclic) {
  Random random(22);
  for (std::size_t i = 0; i < scaled(600) && !HasFailure(); ++i) {
    const auto [a, b, c, p] = GetParam().make(random);
    const int expected = to_int(orientation(a, b, c));
    EXPECT_EQ(to_int(orientation(b, c, a)), expected);
    EXPECT_EQ(to_int(orientation(c, a, b)), expected);
    EXPECT_EQ(to_int(orientation(b, a, c)), -expected);
    EXPECT_EQ(to_int(orientation(a, c, b)), -expected);
    EXPECT_EQ(to_int(orientation(c, b, a)), -expected);
  }
}

TEST_P(predicate_symmetry, signed_axis_permutations_turn_all_signs_alike) {
  const auto symmetries = axis_permutations();
  Random random(23);
  for (std::size_t i = 0; i < scaled(60) && !HasFailure(); ++i) {
    const Four four = GetParam().make(random);
    for (const auto& symmetry : symmetries) {
      Four moved;
      std::ranges::transform(four, moved.begin(), symmetry);
      for (const Model model : models) {
        EXPECT_EQ(side(moved, model), symmetry.determinant * side(four, model));
      }
      EXPECT_EQ(to_int(orientation(moved[0], moved[1], moved[2])),
                symmetry.determinant * to_int(orientation(four[0], four[1], four[2])));
    }
  }
}

// s * p, if no bit is lost.
std::optional<Point> exact_multiple(double s, const Point& p) {
  const Point q = s * p;
  const bool is_finite = std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
  return is_finite && (1 / s) * q == p ? std::optional(q) : std::nullopt;
}

TEST_P(predicate_symmetry, powers_of_two_do_not_matter) {
  Random random(24);
  for (std::size_t i = 0; i < scaled(600) && !HasFailure(); ++i) {
    const Four four = GetParam().make(random);
    const double common = std::ldexp(1.0, random.between(-900, 900));
    Four alike = four;
    Four apart = four;
    bool is_exact = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto a = exact_multiple(common, four[k]);
      const auto b = exact_multiple(std::ldexp(1.0, random.between(-900, 900)), four[k]);
      is_exact = is_exact && a;
      alike[k] = a.value_or(four[k]);
      apart[k] = b.value_or(four[k]);
    }
    if (is_exact) {
      EXPECT_EQ(side(alike, Model::weighted), side(four, Model::weighted));
    }
    EXPECT_EQ(side(apart, Model::projected), side(four, Model::projected));
    EXPECT_EQ(orientation(apart[0], apart[1], apart[2]), orientation(four[0], four[1], four[2]));
  }
}

// With ties broken, exchanging p and a corner of the face turns the answer around.
TEST_P(predicate_symmetry, a_tie_is_broken_one_way) {
  Random random(25);
  for (std::size_t i = 0; i < scaled(600) && !HasFailure(); ++i) {
    const auto [a, b, c, p] = GetParam().make(random);
    for (const Model model : models) {
      bool is_general = orientation(a, b, c) != Sign::zero || orientation(a, b, p) != Sign::zero ||
                        orientation(b, c, p) != Sign::zero || orientation(a, c, p) != Sign::zero;
      is_general = is_general && !is_same_site(a, b, model) && !is_same_site(a, c, model) &&
                   !is_same_site(a, p, model) && !is_same_site(b, c, model) &&
                   !is_same_site(b, p, model) && !is_same_site(c, p, model);
      if (!is_general) continue;
      EXPECT_NE(is_in_conflict(a, b, c, p, model), is_in_conflict(p, b, c, a, model));
      EXPECT_NE(is_in_conflict(a, b, c, p, model), is_in_conflict(b, a, c, p, model));
      EXPECT_EQ(is_in_conflict(a, b, c, p, model), is_in_conflict(b, c, a, p, model));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, predicate_symmetry, testing::ValuesIn(four_generators()),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace rondel::test
