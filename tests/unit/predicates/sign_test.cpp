// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The public predicates against the oracle, on random and adversarial sites.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "rondel/predicates.h"
#include "support/adversarial.h"
#include "support/generators.h"
#include "support/hull_oracle.h"
#include "support/integer_oracle.h"
#include "support/oracle.h"
#include "support/root_sum.h"

namespace rondel::test {
namespace {

std::string text(const Four& four, const Sphere& sphere) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const Point& p : four) out << '{' << p.x << ", " << p.y << ", " << p.z << "} ";
  out << "center " << sphere.center.x << ", " << sphere.center.y << ", " << sphere.center.z;
  return out.str();
}

bool are_distinct(const Oracle& oracle) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (oracle.is_same_site(i, j)) return false;
    }
  }
  return true;
}

// Adds a site below (a, b, c), which makes that triple a face seen from inside.
bool add_inner_site(std::vector<Point>& sites, Model model, const Sphere& sphere) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    sites.resize(4);
    sites.push_back(sphere.center + random_direction(random));
    if (Oracle(sites, model, sphere).side_of_circle(0, 1, 2, 4) < 0) return true;
  }
  return false;
}

void expect_conflict_as_oracle(const Four& four, Model model, const Sphere& sphere) {
  const auto& [a, b, c, p] = four;
  std::vector<Point> sites(four.begin(), four.end());
  const Oracle oracle(sites, model, sphere);
  if (!are_distinct(oracle)) return;
  int expected = oracle.side_of_circle(0, 1, 2, 3);
  if (expected == 0) {
    const bool is_flat = oracle.is_flat();
    if (is_flat && !add_inner_site(sites, model, sphere)) return;  // a, b, c are collinear
    expected = Oracle(sites, model, sphere).perturbed_side(0, 1, 2, 3);
    ASSERT_NE(expected, 0) << text(four, sphere);
  }
  EXPECT_EQ(is_in_conflict(a, b, c, p, model, sphere), expected > 0) << text(four, sphere);
}

void expect_as_oracle(const Four& four, const Sphere& sphere) {
  const auto& [a, b, c, p] = four;
  for (const Model model : {Model::projected, Model::weighted}) {
    const Oracle oracle(four, model, sphere);
    EXPECT_EQ(to_int(side_of_circle(a, b, c, p, model, sphere)), oracle.side_of_circle(0, 1, 2, 3))
        << text(four, sphere);
    EXPECT_EQ(to_int(orientation(a, b, c, sphere)), oracle.orientation(0, 1, 2))
        << text(four, sphere);
    EXPECT_EQ(is_same_site(a, b, model, sphere), oracle.is_same_site(0, 1)) << text(four, sphere);
    expect_conflict_as_oracle(four, model, sphere);
  }
}

class predicates : public testing::TestWithParam<FourGenerator> {};

TEST_P(predicates, agree_with_the_oracle) {
  Random random(11);
  for (std::size_t i = 0; i < scaled(1500) && !HasFailure(); ++i) {
    expect_as_oracle(GetParam().make(random), {});
  }
}

TEST_P(predicates, agree_with_the_oracle_around_any_center) {
  constexpr std::array<Point, 5> centers = {{{0.1, -3, 1e6},
                                             {1e10, 1e10, -1e10},
                                             {0.5, 0.5, 0.5},
                                             {1e-300, 0, 1e-10},
                                             {1e300, -1e290, 7}}};
  Random random(12);
  for (std::size_t i = 0; i < scaled(600) && !HasFailure(); ++i) {
    Sphere sphere{centers[random.below(centers.size())], 1};
    if (random.coin()) sphere.center = random_direction(random);
    Four four = GetParam().make(random);
    for (Point& p : four) {
      const Point moved = p + sphere.center;
      const bool is_finite =
          std::isfinite(moved.x) && std::isfinite(moved.y) && std::isfinite(moved.z);
      if (random.coin() && is_finite) p = moved;
      while (p == sphere.center) p = moved_by_one_ulp(random, p);
    }
    expect_as_oracle(four, sphere);
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, predicates, testing::ValuesIn(four_generators()),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(is_same_site, sees_multiples_and_no_neighbors) {
  Random random(3);
  for (std::size_t i = 0; i < scaled(2000); ++i) {
    const Point p = random_direction(random);
    const Point near = moved_by_one_ulp(random, p);
    EXPECT_TRUE(is_same_site(p, std::ldexp(1.0, random.between(-900, 900)) * p));
    EXPECT_FALSE(is_same_site(p, near));
    EXPECT_FALSE(is_same_site(p, -1.0 * p));
    EXPECT_FALSE(is_same_site(p, 2.0 * p, Model::weighted));
    EXPECT_TRUE(is_same_site(p, p, Model::weighted));
  }
  EXPECT_TRUE(is_same_site({-0.0, 0, 1}, {0.0, -0.0, 1}, Model::weighted));
  EXPECT_TRUE(is_same_site({5e-324, 0, 5e-324}, {1e300, 0, 1e300}));
}

// The oracles themselves: two independent ways agree, and known answers come out.

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
    const int most = random.between(1, static_cast<int>(max_for_roots));
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
