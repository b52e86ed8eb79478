// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Counts how far the incremental algorithm walks where doubles cannot decide on which side of an
// edge a site is: among sites nearly on one great circle, or in a crowd. Steps are counted, time is
// not measured.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "kernel/brio.h"
#include "kernel/great_circle.h"
#include "kernel/mutable_hull.h"
#include "models/projected_points.h"
#include "models/weighted_points.h"
#include "order/spatial_order.h"
#include "support/generators.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

// The traits of a model, which count what a walk asks for.
template <class T>
class Counting : public T {
 public:
  using T::T;
  [[nodiscard]] predicates::Vector coordinates(Index a) const {
    ++num_coordinates;
    return T::coordinates(a);
  }
  // The first rungs of predicates read directions in the projected model, else points.
  [[nodiscard]] predicates::Vector direction(Index a) const requires(!T::hides_sites) {
    ++num_read;
    return T::direction(a);
  }
  [[nodiscard]] Point point(Index a) const {
    if (T::hides_sites) ++num_read;
    return T::point(a);
  }
  mutable std::size_t num_coordinates = 0;
  mutable std::size_t num_read = 0;
};

// Of a build, for each site.
struct Steps {
  double in_doubles = 0;
  double exact = 0;  // an upper bound: the kinds of faces take orientations, too
};

template <class T>
Steps steps_of_build(const std::vector<Point>& sites) {
  constexpr Model model = T::hides_sites ? Model::weighted : Model::projected;
  const auto order = order::spatial_order(sites, model, {}, 1).order;
  const auto insertion = kernel::insertion_order(sites, order, model, {});
  std::vector<Point> points;
  for (const Index rank : insertion) points.push_back(sites[order[rank]]);
  std::vector<Index> first = kernel::find_span(points, {});
  for (Index& i : first) i = insertion[i];
  Counting<T> traits(sites, order, {});
  kernel::MutableHull<Counting<T>> hull(traits, {first[0], first[1], first[2]});
  for (const Index p : insertion) {
    if (std::ranges::find(first, p) == first.end()) hull.insert(p);
  }
  const auto n = static_cast<double>(order.size());
  const auto num_coordinates = static_cast<double>(traits.num_coordinates);
  const Tally& rungs = hull.tally();
  const std::size_t num_conflict_tests = rungs.filter + rungs.extended + rungs.double_double +
                                         rungs.close + rungs.exact + rungs.perturbed;
  // A conflict test reads four points or more, an orientation three.
  const auto num_orientations = static_cast<double>(traits.num_read - 4 * num_conflict_tests) / 3;
  // Each walk asks for its site, each step for three corners, or for up to three orientations.
  return {(num_coordinates / n - 1) / 3, num_orientations / n};
}

struct Curve {
  const char* name;
  std::function<std::vector<Point>(std::size_t)> make;
};

// A turn that leaves no coordinate of a plane exact.
Point turned(const Point& p) {
  const Point a = normalized({0.3, -0.7, 0.5});
  const Point b = normalized(cross_product(a, {0.1, 0.2, 0.9}));
  return p.x * a + p.y * b + p.z * cross_product(a, b);
}

// Of so many radians, in the plane z = 0 before the turn.
std::vector<Point> arc(std::size_t n, double length) {
  std::vector<Point> sites;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = length * static_cast<double>(i) / static_cast<double>(n);
    sites.push_back(turned({std::cos(angle), std::sin(angle), 0}));
  }
  return sites;
}

std::vector<Point> with(std::vector<Point> sites, const std::vector<Point>& more) {
  sites.insert(sites.end(), more.begin(), more.end());
  return sites;
}

std::vector<Point> meridian(std::size_t n, double lon) {
  std::vector<Point> sites;
  for (std::size_t i = 0; i < n; ++i) {
    const double lat = -90 + 180 * static_cast<double>(i) / static_cast<double>(n - 1);
    sites.push_back(unit_vector_deg(lon, std::round(lat * 1e9) / 1e9));
  }
  return sites;
}

// Sites nearly on one great circle, or on two that are close, and what lies around them.
std::vector<Curve> curves() {
  constexpr double turn = 2 * std::numbers::pi;
  const std::vector<Point> poles = {turned({0, 0, 1}), turned({0, 0, -1})};
  return {
      {"half a circle", [](std::size_t n) { return arc(n, turn / 2); }},
      {"half a circle, one site off it",
       [=](std::size_t n) { return with(arc(n, turn / 2), {poles[0]}); }},
      {"half a circle, two sites off it",
       [=](std::size_t n) { return with(arc(n, turn / 2), poles); }},
      {"a circle, one site off it", [=](std::size_t n) { return with(arc(n, turn), {poles[0]}); }},
      {"many turns", [](std::size_t n) { return arc(n, 17.3 * turn); }},
      {"a short arc", [](std::size_t n) { return arc(n, 1e-3); }},
      {"meridian", [](std::size_t n) { return with(meridian(n, 30), {unit_vector_deg(120, 0)}); }},
      {"wedge",
       [](std::size_t n) { return with(meridian(n / 2, 30), meridian(n / 2, 30 + 1e-12)); }},
      {"a circle among others",
       [](std::size_t n) {
         Random random(1);
         std::vector<Point> sites = arc(n, turn);
         for (std::size_t i = 0; i < n / 40; ++i) sites.push_back(random_direction(random));
         return sites;
       }},
  };
}

template <class T>
void expect_short_walks(std::size_t n) {
  for (const Curve& curve : curves()) {
    SCOPED_TRACE(std::string(curve.name) + (T::hides_sites ? ", weighted" : ", projected"));
    const Steps steps = steps_of_build<T>(curve.make(n));
    // Uniform sites take 3.2 steps.
    EXPECT_LT(steps.in_doubles, 12);
    EXPECT_LT(steps.exact, 32);
  }
}

TEST(kernel_walk, is_short_near_a_great_circle) {
  const std::size_t n = is_shortened() ? 2'000 : 10'000;
  expect_short_walks<models::ProjectedPoints>(n);
  expect_short_walks<models::WeightedPoints>(n);
}

// Along the ranks alone the walks of the second kind are longer, and grow with the number of sites.
TEST(kernel_walk, is_short_in_a_crowd) {
  const std::size_t n = is_shortened() ? 4'000 : 20'000;
  for (const char* kind : {"cap", "exponents"}) {
    SCOPED_TRACE(kind);
    const auto sites = inputs::make(*inputs::find_kind(kind), {.n = n}).sites;
    const Steps steps = steps_of_build<models::ProjectedPoints>(sites);
    EXPECT_LT(steps.exact, 40);
  }
}

TEST(kernel_walk, leads_to_the_triangulation_of_blocks_near_a_great_circle) {
  for (const Curve& curve : curves()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      SCOPED_TRACE(std::string(curve.name) + ", " + text_of(model));
      BulkCase bulk({curve.make(400), {}}, model);
      EXPECT_TRUE(bulk.run(100));
    }
  }
}

}  // namespace
}  // namespace rondel::test
