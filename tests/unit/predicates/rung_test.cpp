// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The right rung decides: a cheap one where it should, and never one that cannot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "exact/eft.h"
#include "exact/integer_signs.h"
#include "models/with_model.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "support/adversarial.h"
#include "support/generators.h"
#include "support/oracle.h"

namespace rondel::test {
namespace {

using predicates::Decision;
using predicates::Rung;

predicates::Vector direction(const Point& p) {
  const Point high = exact::unit_vector(p, {}).hi;
  return {high.x, high.y, high.z};
}

// The ladder that builds climb, but for the perturbation.
Decision decide(const Four& four, Model model) {
  return models::with_model(model, [&]<class T> {
    const predicates::FourPoints<T::model> points{four};
    return predicates::side(points, 0, 1, 2, 3);
  });
}

// A rung that may be unsure.
void expect_no_other(Sign sign, int expected) {
  if (sign != Sign::zero) {
    EXPECT_EQ(to_int(sign), expected);
  }
}

// The rungs one by one, whether the ladder comes to them or not.
void expect_circle_rungs(const Four& four, int expected) {
  const predicates::FourPoints<Model::projected> points{four};
  const std::array split = {points.split(0), points.split(1), points.split(2), points.split(3)};
  const auto& [u, v, w, x] = split;
  expect_no_other(predicates::side_of_circle_extended(u, v, w, x), expected);
  expect_no_other(predicates::side_of_circle_double_double(u, v, w, x), expected);
  expect_no_other(predicates::side_of_circle_wide_filter(four, {}), expected);
  expect_no_other(predicates::side_of_circle_close(four, {}), expected);
  const auto integers = predicates::side_of_circle_integers_exact(four, {});
  EXPECT_EQ(to_int(integers.value_or(static_cast<Sign>(expected))), expected);
  EXPECT_EQ(to_int(predicates::side_of_circle_exact(four, {})), expected);
  expect_no_other(predicates::side_of_circle_filter(exact::to_vector(u.hi), exact::to_vector(v.hi),
                                                    exact::to_vector(w.hi), exact::to_vector(x.hi)),
                  expected);
}

void expect_plane_rungs(const Four& four, int expected) {
  const predicates::PlaneSteps steps = predicates::scaled_steps(predicates::with_best_origin(four));
  expect_no_other(predicates::side_of_plane_scaled_filter(steps), expected);
  expect_no_other(predicates::side_of_plane_double_double(steps), expected);
  const auto integers = predicates::side_of_plane_integers_exact(four);
  EXPECT_EQ(to_int(integers.value_or(static_cast<Sign>(expected))), expected);
  EXPECT_EQ(to_int(predicates::side_of_plane_exact(four)), expected);
}

class predicate_rungs : public testing::TestWithParam<FourGenerator> {};

// The sign of the rung that decided, and of each rung that could have decided.
TEST_P(predicate_rungs, never_give_a_wrong_sign) {
  Random random(31);
  for (std::size_t i = 0; i < scaled(2500) && !HasFailure(); ++i) {
    const Four four = GetParam().make(random);
    const auto& [a, b, c, p] = four;
    for (const Model model : {Model::projected, Model::weighted}) {
      const int expected = Oracle(four, model, {}).side_of_circle(0, 1, 2, 3);
      const Decision decision = decide(four, model);
      EXPECT_EQ(to_int(decision.sign), expected);
      if (expected == 0) {
        EXPECT_EQ(decision.rung, Rung::exact);
      }
      if (model == Model::weighted) {
        expect_plane_rungs(four, expected);
        continue;
      }
      expect_circle_rungs(four, expected);
      // Directions that are not the nearest doubles, but within the contract's
      // error.
      const Sign coarse = predicates::side_of_circle_filter(
          exact::to_vector(normalized(a)), exact::to_vector(normalized(b)),
          exact::to_vector(normalized(c)), exact::to_vector(normalized(p)));
      const bool is_in_range = std::ranges::all_of(four, [](const Point& q) {
        const double square = q.x * q.x + q.y * q.y + q.z * q.z;
        return square > 0x1p-600 && square < 0x1p600;
      });
      if (is_in_range && coarse != Sign::zero) {
        EXPECT_EQ(to_int(coarse), expected);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, predicate_rungs, testing::ValuesIn(four_generators()),
                         [](const auto& kind) { return std::string(kind.param.name); });

double filter_share(Model model, double distance) {
  Random random(32);
  std::size_t decided = 0;
  const std::size_t count = 2000;
  for (std::size_t i = 0; i < count; ++i) {
    const Point pole = random_direction(random);
    Four four;
    for (Point& p : four) p = random_near(random, pole, distance);
    if (decide(four, model).rung == Rung::filter) ++decided;
  }
  return static_cast<double>(decided) / static_cast<double>(count);
}

// The projected filter must not fade with density, as the paper's filters did
// (section 5).
TEST(rungs, filter_decides_at_any_distance) {
  EXPECT_GT(filter_share(Model::projected, 1), 0.999);
  EXPECT_GT(filter_share(Model::projected, 1e-3), 0.999);
  EXPECT_GT(filter_share(Model::projected, 1e-6), 0.999);
  EXPECT_GT(filter_share(Model::projected, 1e-9), 0.995);
  EXPECT_GT(filter_share(Model::projected, 1e-11), 0.9);
  EXPECT_GT(filter_share(Model::weighted, 1), 0.999);
  EXPECT_GT(filter_share(Model::weighted, 1e-3), 0.999);
}

// Nor with the length of faces: sites on curves have two corners close to p and
// one far away.
TEST(rungs, filter_decides_for_long_faces) {
  Random random(39);
  for (std::size_t i = 0; i < 2000; ++i) {
    const Point pole = random_direction(random);
    Four four;
    for (Point& p : four) p = random_near(random, pole, 1e-5);
    four[i % 3] = random_direction(random);
    const Decision decision = decide(four, Model::projected);
    ASSERT_EQ(decision.rung, Rung::filter) << i;
    ASSERT_EQ(to_int(decision.sign), Oracle(four, Model::projected, {}).side_of_circle(0, 1, 2, 3));
  }
}

// Three close sites and one whose weight is far larger, in each of the four
// roles.
TEST(rungs, filter_decides_between_weights_of_all_magnitudes) {
  Random random(36);
  for (const double length : {1e1, 1e4, 1e8, 1e15, 1e30}) {
    for (std::size_t i = 0; i < 400; ++i) {
      const Point pole = random_direction(random);
      Four four;
      for (Point& p : four) p = random_near(random, pole, 1e-3);
      four[i % 4] = length * random_direction(random);
      const Decision decision = decide(four, Model::weighted);
      ASSERT_EQ(decision.rung, Rung::filter) << length;
      ASSERT_EQ(to_int(decision.sign),
                Oracle(four, Model::weighted, {}).side_of_circle(0, 1, 2, 3));
    }
  }
}

// Squared lengths that vanish must not vanish from the bound.
TEST(rungs, filter_is_unsure_where_squares_underflow) {
  const Point b = {0x1p-600, 0, 0};
  const Point c = {0, 0x1p400, 0x1p300};
  const Point d = {0, 0x1p300, 0x1p400};
  EXPECT_EQ(predicates::side_of_plane_filter(exact::to_vector(b), exact::to_vector(c),
                                             exact::to_vector(d), {0, 0, 0}),
            Sign::zero);
  const Decision decision = decide({{b, c, d, {0, 0, 0}}}, Model::weighted);
  EXPECT_EQ(decision.rung,
            Rung::filter);  // of differences that are all scaled to 1
  EXPECT_EQ(decision.sign, Sign::negative);
}

// Sites as close as doubles can be, for which directions are no longer told
// apart. What is left to the exact rung are ties up to rounding.
TEST(rungs, doubles_decide_between_sites_at_any_distance) {
  Random random(40);
  for (const FourGenerator& kind : four_generators()) {
    if (kind.name != "cap_of_any_size" && kind.name != "ulps_of_one_site" &&
        kind.name != "two_pairs")
      continue;
    std::size_t exact = 0;
    const std::size_t num_sets = 2000;
    for (std::size_t i = 0; i < num_sets; ++i) {
      const Four four = kind.make(random);
      const int expected = Oracle(four, Model::projected, {}).side_of_circle(0, 1, 2, 3);
      const Sign close = predicates::side_of_circle_close(four, {});
      if (close == Sign::zero)
        ++exact;
      else
        ASSERT_EQ(to_int(close), expected) << kind.name;
    }
    EXPECT_LT(exact, num_sets / 20) << kind.name;
  }
}

// Faces between two clusters: a step from one pair to the other says nothing of
// the pairs.
TEST(rungs, doubles_decide_between_two_pairs_that_are_far_apart) {
  Random random(43);
  std::size_t exact = 0;
  const std::size_t num_sets = 500;
  for (std::size_t i = 0; i < num_sets; ++i) {
    const double distance = random_distance(random, 1e-6);
    const Point pole = random_direction(random);
    Four four;
    for (std::size_t k = 0; k < 4; k += 2) {
      const Point near = random_near(random, pole, distance);
      four[k] = near;
      four[k + 1] = near;
      for (std::size_t moves = 0; moves < 6; ++moves) {
        four[k + moves % 2] = moved_by_one_ulp(random, four[k + moves % 2]);
      }
    }
    std::swap(four[1], four[1 + i % 3]);
    const auto& [a, b, c, p] = four;
    if (a == b || a == c || a == p || b == c || b == p || c == p) continue;
    const Decision decision = decide(four, Model::projected);
    ASSERT_EQ(to_int(decision.sign), Oracle(four, Model::projected, {}).side_of_circle(0, 1, 2, 3));
    if (decision.rung == Rung::exact) ++exact;
  }
  EXPECT_LT(exact, num_sets / 20);
}

// Coordinates of all magnitudes, of sites that are near one axis as neighbors
// are, or near several.
TEST(rungs, doubles_decide_between_coordinates_of_all_magnitudes) {
  Random random(42);
  const auto magnitude = [&random](int lowest, int highest) {
    return std::ldexp((random.coin() ? 1 : -1) * (1 + random.unit()),
                      random.between(lowest, highest));
  };
  std::size_t exact = 0;
  const std::size_t num_sets = scaled(2000);
  for (std::size_t i = 0; i < num_sets; ++i) {
    const std::size_t axis = random.below(3);
    const double side = random.coin() ? 1 : -1;
    Four four;
    for (Point& p : four) {
      const std::size_t other = i % 4 == 0 && random.below(4) == 0 ? random.below(3) : axis;
      std::array<double, 3> d = {magnitude(-1074, 0), magnitude(-1074, 0), magnitude(-1074, 0)};
      d[other] = side * std::abs(magnitude(1, 1000));
      p = {d[0], d[1], d[2]};
    }
    const int expected = Oracle(four, Model::projected, {}).side_of_circle(0, 1, 2, 3);
    const Sign sign = predicates::side_of_circle_wide_filter(four, {});
    expect_no_other(sign, expected);
    const Decision decision = decide(four, Model::projected);
    ASSERT_EQ(to_int(decision.sign), expected);
    if (decision.rung == Rung::exact) ++exact;
    const Decision orientation = predicates::orientation(four[0], four[1], four[2], {});
    ASSERT_EQ(to_int(orientation.sign), Oracle(four, Model::projected, {}).orientation(0, 1, 2));
    EXPECT_NE(orientation.rung, Rung::exact);
  }
  EXPECT_LE(exact, num_sets / 50);
}

// Differences from a center that overflow.
TEST(rungs, doubles_are_unsure_of_infinite_rays) {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr std::array sizes = {0.0, 5e-324, 0x1p-1022, 1.0, 0x1p1000, most / 2, most};
  const Sphere sphere = {{most, 0, -1}};
  Random random(44);
  const auto coordinate = [&] {
    return (random.coin() ? 1 : -1) * sizes[random.below(sizes.size())];
  };
  for (std::size_t i = 0; i < 2000; ++i) {
    Four four;
    for (Point& p : four) {
      do p = {coordinate(), coordinate(), coordinate()};
      while (p == sphere.center);
    }
    const Oracle oracle(four, Model::projected, sphere);
    const Decision decision = predicates::orientation(four[0], four[1], four[2], sphere.center);
    ASSERT_EQ(to_int(decision.sign), oracle.orientation(0, 1, 2));
    expect_no_other(predicates::side_of_circle_wide_filter(four, sphere.center),
                    oracle.side_of_circle(0, 1, 2, 3));
  }
}

// Three sites in line with the center but for one coordinate, at all
// magnitudes.
TEST(rungs, orientation_needs_no_long_numbers_at_any_scale) {
  Random random(41);
  for (std::size_t i = 0; i < 2000; ++i) {
    const double size = random_distance(random, 1e-300);
    Four four;
    for (Point& p : four) p = {size * random.signed_unit(), size * random.signed_unit(), 1};
    const Decision decision = predicates::orientation(four[0], four[1], four[2], {});
    ASSERT_TRUE(decision.rung == Rung::filter || decision.rung == Rung::extended ||
                exact::sign_of_volume_in_integers({}, four[0], four[1], four[2]));
    ASSERT_EQ(to_int(decision.sign), Oracle(four, Model::projected, {}).orientation(0, 1, 2));
  }
}

TEST(rungs, above_the_filter_decide_near_ties) {
  Random random(33);
  std::size_t decided = 0;
  std::size_t unsure = 0;
  for (std::size_t i = 0; i < 2000; ++i) {
    Four four = near_one_circle(random, 0.5);
    const Rung rung = decide(four, Model::projected).rung;
    if (rung == Rung::filter) continue;
    ++unsure;
    if (rung == Rung::extended || rung == Rung::double_double) ++decided;
  }
  EXPECT_GT(unsure, 1000U);
  EXPECT_EQ(decided, unsure);
}

// Sites on one circle but for the roundings of their coordinates, as those of
// grids.
TEST(rungs, numbers_of_64_bits_do_not_err_and_decide_ties_of_rounded_sites) {
  Random random(35);
  std::size_t decided = 0;
  const std::size_t num_sets = scaled(4000);
  for (std::size_t i = 0; i < num_sets; ++i) {
    const double radius = random_distance(random, 1e-12);
    const Four four = near_one_circle(random, radius);
    const auto split = [&four](std::size_t k) { return exact::unit_vector(four[k], {}); };
    const Sign sign = predicates::side_of_circle_extended(split(0), split(1), split(2), split(3));
    if (sign == Sign::zero) continue;
    ++decided;
    EXPECT_EQ(sign, predicates::side_of_circle_exact(four, {}));
  }
  std::cout << decided << " of " << num_sets << " decided\n";
  EXPECT_TRUE(decided > num_sets / 2 || !exact::has_extended_precision());
}

// Three sites an ulp apart in a line, and one that is not: their circle is nearly a great circle.
constexpr Four three_in_a_line = {{{0.625, 0.5, 0.75},
                                   {0.625 + 0x1p-53, 0.5, 0.75 + 0x1p-52},
                                   {0.625 + 0x1p-52, 0.5, 0.75 + 0x1p-51},
                                   {-0.3, 0.4, 0.8}}};

TEST(rungs, exact_decides_what_lies_below_twice_double_precision) {
  const Decision projected = decide(three_in_a_line, Model::projected);
  EXPECT_EQ(projected.rung, Rung::exact);
  EXPECT_EQ(to_int(projected.sign),
            Oracle(three_in_a_line, Model::projected, {}).side_of_circle(0, 1, 2, 3));
  EXPECT_NE(projected.sign, Sign::zero);
}

// Four sites, none of equal length, whose roots fall into two classes: sqrt(2)
// and 1.
TEST(rungs, exact_sees_ties_among_unequal_roots) {
  const Four four = {{{3, 3, 0}, {-1, 1, 0}, {0, 0, 2}, {0, 0, -5}}};
  const Decision decision = decide(four, Model::projected);
  const int expected = Oracle(four, Model::projected, {}).side_of_circle(0, 1, 2, 3);
  EXPECT_EQ(to_int(decision.sign), expected);
  const Four tie = {{{3, 4, 12}, {-6, 8, 24}, {-9, -12, 36}, {12, -16, 48}}};
  EXPECT_EQ(decide(tie, Model::projected).sign, Sign::zero);
  EXPECT_EQ(decide(tie, Model::projected).rung, Rung::exact);
}

TEST(rungs, structured_input_is_decided_exactly) {
  Random random(34);
  for (std::size_t i = 0; i < 200; ++i) {
    const Point p = random_direction(random);
    const Four rectangle = {{p, {-p.x, p.y, p.z}, {-p.x, -p.y, p.z}, {p.x, -p.y, p.z}}};
    for (const Model model : {Model::projected, Model::weighted}) {
      const Decision decision = decide(rectangle, model);
      EXPECT_EQ(decision.rung, Rung::exact);
      EXPECT_EQ(decision.sign, Sign::zero);
    }
    EXPECT_EQ(predicates::orientation(p, {-p.x, -p.y, p.z}, {0, 0, p.z}, {}).rung, Rung::exact);
  }
}

// Every rung of the ladder decides somewhere, and says so; the exact sign never
// has another one.
TEST(rungs, each_decides_what_is_left_to_it) {
  Random random(37);
  const auto rung_of = [](const Four& four) {
    const predicates::FourPoints<Model::projected> points{four};
    const Decision decision = predicates::conflict(points, 0, 1, 2, 3);
    EXPECT_NE(decision.sign, Sign::zero);
    const Sign exact = predicates::side_of_circle_exact(four, {});
    EXPECT_EQ(decision.rung == Rung::perturbed, exact == Sign::zero);
    if (exact != Sign::zero) {
      EXPECT_EQ(decision.sign, exact);
    }
    return decision.rung;
  };
  Tally tally;
  for (std::size_t i = 0; i < 200; ++i) {
    Four four;
    for (Point& p : four) p = random_direction(random);
    predicates::count(tally, rung_of(four));
    predicates::count(tally, rung_of(near_one_circle(random, 0.5)));
    for (Point& p : four) p = random_near(random, four[0], 1e-13);
    predicates::count(tally, rung_of(four));
    const Point& p = four[0];
    predicates::count(tally, rung_of({{p, {-p.x, p.y, p.z}, {-p.x, -p.y, p.z}, {p.x, -p.y, p.z}}}));
  }
  predicates::count(tally, rung_of(three_in_a_line));
  EXPECT_GT(tally.filter, 190U);
  EXPECT_TRUE(tally.extended > 100 || !exact::has_extended_precision());
  EXPECT_GT(tally.double_double, 100U);
  EXPECT_GE(tally.exact, 1U);
  EXPECT_GE(tally.perturbed, 200U);
}

// Queries ask about points in the places of vertices.
TEST(conflict, a_point_in_the_place_of_a_corner_is_in_conflict_with_no_face) {
  Random random(38);
  for (std::size_t i = 0; i < 100; ++i) {
    Four four;
    for (Point& p : four) p = random_direction(random);
    four[3] = four[i % 3];
    for (const Model model : {Model::projected, Model::weighted}) {
      const Decision decision = models::with_model(model, [&]<class T> {
        const predicates::FourPoints<T::model> points{four};
        return predicates::conflict(points, 0, 1, 2, 3);
      });
      EXPECT_EQ(decision.sign, Sign::negative);
      EXPECT_EQ(decision.rung, Rung::perturbed);
    }
  }
}

TEST(rungs, orientation_filter_never_gives_a_wrong_sign) {
  Random random(35);
  for (const FourGenerator& kind : four_generators()) {
    for (std::size_t i = 0; i < scaled(1000); ++i) {
      const Four four = kind.make(random);
      const auto& [a, b, c, p] = four;
      const int expected = Oracle(four, Model::projected, {}).orientation(0, 1, 2);
      const Sign filter = predicates::orientation_filter(direction(a), direction(b), direction(c));
      if (filter != Sign::zero) {
        ASSERT_EQ(to_int(filter), expected) << kind.name;
      }
      expect_no_other(predicates::orientation_extended(a, b, c, {}), expected);
      ASSERT_EQ(to_int(predicates::orientation(a, b, c, {}).sign), expected) << kind.name;
    }
  }
}

}  // namespace
}  // namespace rondel::test
