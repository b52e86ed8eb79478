// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The oracles themselves: two independent ways agree, and known answers come out.
#include "support/oracle.h"

#include <gtest/gtest.h>

#include "support/adversarial.h"
#include "support/generators.h"
#include "support/hull_oracle.h"
#include "support/integer_oracle.h"
#include "support/root_sum.h"

namespace rondel::test {
namespace {

TEST(root_sum, squaring_and_mpfr_agree) {
  Random random(1);
  for (std::size_t i = 0; i < scaled(3000); ++i) {
    RootSum sum;
    for (auto& square : sum.squares) square = random.between(1, 30);
    for (auto& c : sum.c) c = random.below(3) == 0 ? random.between(-20, 20) : 0;
    const int expected = sign_by_squaring(sum);
    const auto quick = sign_by_mpfr(sum);
    ASSERT_EQ(quick.value_or(0), expected);
    ASSERT_EQ(sign(sum), expected);
  }
}

TEST(root_sum, near_zero_sums_are_told_from_zero) {
  // sqrt(N) - floor(sqrt(N) * 10^k) / 10^k and the exact identity sqrt(8) = 2 sqrt(2).
  RootSum sum;
  sum.squares = {8, 2, 1, 1};
  sum.c[1] = 1;
  sum.c[2] = -2;
  EXPECT_EQ(sign_by_squaring(sum), 0);
  EXPECT_FALSE(sign_by_mpfr(sum));
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, 200);
  sum.c = {};
  sum.c[2] = power;
  sum.c[0] = -sqrt(mpz_class(2 * power * power));
  EXPECT_EQ(sign_by_squaring(sum), 1);
  EXPECT_EQ(sign_by_mpfr(sum), 1);
  sum.c[0] -= 1;
  EXPECT_EQ(sign_by_squaring(sum), -1);
  EXPECT_EQ(sign_by_mpfr(sum), -1);
}

// Small integers in 128 bits, often in one plane or at one distance.
TEST(integer_oracle, agrees_with_the_other) {
  Random random(7);
  for (std::size_t i = 0; i < scaled(4000); ++i) {
    const int most = random.between(1, static_cast<int>(most_for_roots));
    std::array<IntegerRay, 4> q;
    std::vector<Point> sites;
    for (IntegerRay& a : q) {
      do {
        a = {random.between(-most, most), random.between(-most, most), random.between(-most, most)};
      } while (a == IntegerRay{});
      sites.push_back(
          {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)});
    }
    const auto& [a, b, c, p] = q;
    const Oracle projected(sites, Model::projected, {});
    const Oracle weighted(sites, Model::weighted, {});
    ASSERT_EQ(side_of_circle(a, b, c, p), projected.side_of_circle(0, 1, 2, 3));
    ASSERT_EQ(side_of_plane(a, b, c, p), weighted.side_of_circle(0, 1, 2, 3));
    ASSERT_EQ(sign_of(determinant(a, b, c)), projected.orientation(0, 1, 2));
    ASSERT_EQ(are_on_one_ray(a, b), projected.is_same_site(0, 1));
  }
}

TEST(oracle, known_sides) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {-1, -1, -1}};
  for (const Model model : {Model::projected, Model::weighted}) {
    const Oracle oracle(sites, model, {});
    EXPECT_EQ(oracle.orientation(0, 1, 2), 1);
    EXPECT_EQ(oracle.side_of_circle(0, 1, 2, 3), 1);
    EXPECT_EQ(oracle.side_of_circle(0, 1, 2, 4), -1);
  }
}

// Every perturbed hull must be a closed surface with 2V-4 faces, whatever the ties.
TEST(oracle, perturbed_hulls_are_closed_surfaces) {
  for (const Generator& kind : generators()) {
    for (std::uint64_t seed = 0; seed < scaled(2); ++seed) {
      const SiteSet set = kind.make(8, seed);
      if (set.sites.size() > 14) continue;
      for (const Model model : {Model::projected, Model::weighted}) {
        if (model == Model::projected && kind.weighted_only) continue;
        const Hull hull = brute_force_hull(set.sites, model, set.sphere);
        if (hull.dimension != 2) continue;
        std::set<std::array<Index, 2>> halfedges;
        std::set<Index> vertices;
        for (const Triple& face : hull.faces) {
          for (std::size_t i = 0; i < 3; ++i) {
            vertices.insert(face[i]);
            ASSERT_TRUE(halfedges.insert({face[i], face[(i + 1) % 3]}).second) << kind.name << seed;
          }
        }
        for (const auto& [from, to] : halfedges) {
          ASSERT_TRUE(halfedges.contains({to, from})) << kind.name << ' ' << seed;
        }
        ASSERT_EQ(hull.faces.size(), 2 * vertices.size() - 4) << kind.name << ' ' << seed;
      }
    }
  }
}

}  // namespace
}  // namespace rondel::test
