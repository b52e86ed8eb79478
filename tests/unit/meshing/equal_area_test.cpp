// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>

#include "exact/eft.h"
#include "exact/vector.h"
#include "meshing/graph_laplacian.h"
#include "meshing/scvt_levels.h"
#include "meshing/weighted_site.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/mesh_equal_area.h"
#include "rondel/scvt.h"
#include "support/random.h"

namespace rondel::mesh {
namespace {

constexpr double whole = 4 * std::numbers::pi;

// The areas of the power cells, by the diagram.
std::vector<double> power_areas(const EqualArea& made) {
  return areas(delaunay(made.poles, {.model = Model::weighted}));
}

TEST(equal_area, cells_of_a_centroidal_tessellation_become_equal) {
  const std::vector<Point> sites = scvt({.count = 2562}).sites;
  int steps = 0;
  EqualAreaOptions options;
  options.on_step = [&](const EqualAreaStep& step) {
    steps = step.step;
    EXPECT_EQ(step.length, 1);  // as long as Newton's
  };
  const EqualArea made = equal_area(sites, {}, options);
  EXPECT_EQ(made.end, EqualAreaEnd::converged);
  EXPECT_LE(made.largest_error, 1e-12);
  EXPECT_LE(made.steps, 6);
  EXPECT_EQ(made.steps, steps);
  const double wanted = whole / 2562;
  for (const double area : power_areas(made)) EXPECT_NEAR(area, wanted, 3e-12 * wanted);
  EXPECT_EQ(*std::min_element(made.weights.begin(), made.weights.end()), 1);
}

// Weights that are doubles would leave errors of 1e-11 everywhere; they do next to the six ends of the axes.
TEST(equal_area, small_cells_become_equal_to_the_last_digits) {
  const std::vector<Point> sites = scvt({.count = 20000, .mean_tolerance = 1e-2}).sites;
  const EqualArea made = equal_area(sites);
  EXPECT_TRUE(made.end == EqualAreaEnd::converged || made.end == EqualAreaEnd::rounded);
  EXPECT_LE(made.largest_error, 2e-12);
  EXPECT_LE(made.steps, 8);
  const std::vector<double> found = power_areas(made);
  const double wanted = whole / 20000;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Point& p = made.poles[i];
    EXPECT_NEAR(norm(exact::to_vector(p)), made.weights[i], 4e-16);
    EXPECT_LT(norm(cross(exact::to_vector(p), exact::to_vector(sites[i]))), 1e-13);
    const double from_axis = 1 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (from_axis > 20 * wanted) {
      EXPECT_NEAR(found[i], wanted, 1e-12 * wanted) << i;
    }
  }
}

TEST(equal_area, random_sites_get_areas_of_any_size) {
  const std::vector<Point> sites = sampled_sites(500, nullptr, 9);
  std::vector<double> targets;
  for (std::size_t i = 0; i < sites.size(); ++i) targets.push_back(1 + 0.8 * sites[i].x);
  const double sum = std::accumulate(targets.begin(), targets.end(), 0.0);
  for (double& target : targets) target *= whole / sum;
  const EqualArea made = equal_area(sites, targets);
  EXPECT_EQ(made.end, EqualAreaEnd::converged);
  const std::vector<double> found = power_areas(made);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(found[i], targets[i], 1e-11 * targets[i]);
  }
}

TEST(equal_area, eight_corners_of_a_cube_and_their_symmetry) {
  std::vector<Point> cube;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) cube.push_back({x, y, z});
    }
  }
  const EqualArea made = equal_area(cube);
  EXPECT_EQ(made.end, EqualAreaEnd::converged);
  EXPECT_EQ(made.steps, 0);
  for (const double weight : made.weights) EXPECT_EQ(weight, 1);
}

TEST(equal_area, bytes_do_not_depend_on_threads) {
  const std::vector<Point> sites = sampled_sites(9000, nullptr, 1);
  const EqualArea one = equal_area(sites, {}, {}, {.threads = 1});
  const EqualArea two = equal_area(sites, {}, {}, {.threads = 2});
  EXPECT_EQ(one.weights, two.weights);
  EXPECT_EQ(one.areas, two.areas);
  EXPECT_EQ(one.end, two.end);
}

// The cell of a site has no point farther than 90 degrees from it where the hull surrounds the center, so its
// area is below 2 pi.
TEST(equal_area, infeasible_areas_end_as_such) {
  const std::vector<Point> sites = icosahedron();
  std::vector<double> targets(12, 0.3 * whole / 11);
  targets[4] = 0.7 * whole;
  const EqualArea made = equal_area(sites, targets);
  EXPECT_EQ(made.end, EqualAreaEnd::infeasible);
  EXPECT_LT(made.steps, 60);
  EXPECT_GT(made.largest_error, 0.01);
  EXPECT_NE(made.worst, no_index);
  // Sites in one hemisphere.
  const std::vector<Point> octant = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  EXPECT_EQ(equal_area(octant).end, EqualAreaEnd::infeasible);
}

// Sites that do not surround the center: the result tells by how much their cells are wrong.
TEST(equal_area, few_sites_have_the_cells_that_they_have) {
  const EqualArea one = equal_area(std::vector<Point>{{0, 3, 0}});
  EXPECT_EQ(one.end, EqualAreaEnd::converged);
  EXPECT_EQ(one.areas, std::vector<double>{whole});
  const EqualArea two = equal_area(std::vector<Point>{{0, 0, 1}, {1, 0, 0}});
  EXPECT_EQ(two.end, EqualAreaEnd::converged);
  for (const double area : two.areas) EXPECT_NEAR(area, whole / 2, 1e-12);
  const EqualArea unequal = equal_area(std::vector<Point>{{0, 0, 1}, {1, 0, 0}},
                                       std::vector<double>{whole / 4, 3 * whole / 4});
  EXPECT_EQ(unequal.end, EqualAreaEnd::infeasible);
  EXPECT_NEAR(unequal.largest_error, 1, 1e-12);
  EXPECT_EQ(unequal.worst, 0U);
  EXPECT_NE(unequal.reason.find("hemispheres"), std::string::npos);
  // These sites are in an octant; the middle one has hardly a cell.
  const EqualArea octant =
      equal_area(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
  EXPECT_EQ(octant.end, EqualAreaEnd::infeasible);
  ASSERT_EQ(octant.areas.size(), 4U);
  double most = 0;
  for (const double area : octant.areas) most = std::max(most, std::abs(area / (whole / 4) - 1));
  EXPECT_NEAR(octant.largest_error, most, 1e-14);
  EXPECT_GT(most, 0.1);
  EXPECT_LT(octant.worst, 4U);
  EXPECT_NE(octant.reason.find("surround the center"), std::string::npos);
}

// Weighted sites on an ellipse around the center, and on the far arc of one that is beside the center: the areas of their lunes can
// be had.
std::vector<std::vector<Point>> convex_polygons(std::size_t n, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<std::vector<Point>> polygons;
  for (const bool is_around : {true, false}) {
    std::vector<Point> polygon;
    for (std::size_t i = 0; i < n; ++i) {
      const double t = (static_cast<double>(i) + 0.8 * random.unit()) / static_cast<double>(n);
      // The tangents from the center touch the second ellipse at 2.62.
      const double angle = (2 * t - 1) * (is_around ? std::numbers::pi : 2.5);
      polygon.push_back({(is_around ? 0.2 : 1.5) + 1.3 * std::cos(angle), std::sin(angle), 0});
    }
    polygons.push_back(polygon);
  }
  return polygons;
}

TEST(equal_area, lunes_of_sites_on_a_great_circle_get_their_areas) {
  for (const std::size_t n : {3U, 4U, 7U, 40U}) {
    for (std::uint64_t seed = 1; seed < 6; ++seed) {
      for (const std::vector<Point>& polygon : convex_polygons(n, seed)) {
        // The sites are in the plane z = 0, or in one that their coordinates only meet to rounding.
        for (const bool is_turned : {false, true}) {
          std::vector<Point> poles = polygon;
          if (is_turned) {
            for (Point& p : poles)
              p = p.x * Point{0.6, 0.64, 0.48} + p.y * Point{0.8, -0.48, -0.36};
          }
          const std::vector<double> targets = areas(delaunay(poles, {.model = Model::weighted}));
          const EqualArea made = equal_area(poles, targets);
          EXPECT_TRUE(made.end == EqualAreaEnd::converged || made.end == EqualAreaEnd::rounded);
          EXPECT_EQ(made.reason, "");
          EXPECT_LT(made.largest_error, 1e-10) << n << ' ' << seed << ' ' << is_turned;
          const std::vector<double> found = power_areas(made);
          for (std::size_t i = 0; i < n; ++i) {
            EXPECT_NEAR(found[i], targets[i], 1e-10 * targets[i]);
            EXPECT_NEAR(norm(exact::to_vector(made.poles[i])), made.weights[i],
                        1e-15 * made.weights[i]);
          }
          EXPECT_EQ(*std::min_element(made.weights.begin(), made.weights.end()), 1);
        }
      }
    }
  }
}

TEST(equal_area, equal_lunes_exist_or_not) {
  const auto equator = [](std::initializer_list<double> degrees) {
    std::vector<Point> sites;
    for (const double lon : degrees) sites.push_back(unit_vector(LonLat{lon, 0}));
    return sites;
  };
  for (const auto& sites : {equator({0, 100, 200}), equator({10, 20, 170, 185, 300}),
                            equator({0, 1, 2, 3}), equator({0, 80, 180, 250})}) {
    const EqualArea made = equal_area(sites);
    EXPECT_EQ(made.end, EqualAreaEnd::converged);
    for (const double area : power_areas(made)) {
      EXPECT_NEAR(area * static_cast<double>(sites.size()), whole, 1e-11);
    }
  }
  // The first and the last wall of the inner sites are less than 180 degrees apart, but three lunes of a fifth are wider.
  const EqualArea five = equal_area(equator({0, 1, 2, 3, 4}));
  EXPECT_EQ(five.end, EqualAreaEnd::infeasible);
  EXPECT_NE(five.reason.find("half of a great circle"), std::string::npos);
  EXPECT_GT(five.largest_error, 0.5);
  ASSERT_EQ(five.areas.size(), 5U);
  // 0 and 180 degrees are opposite: the wall between them passes through both poles of the sites.
  const EqualArea opposite = equal_area(equator({0, 50, 180}));
  EXPECT_EQ(opposite.end, EqualAreaEnd::infeasible);
  EXPECT_NE(opposite.reason.find("are lunes"), std::string::npos);
  for (const EqualArea* const end : {&five, &opposite}) {
    EXPECT_LT(std::ranges::max(end->radii_deg), 90);
  }
  const std::vector<double> targets = {whole * 140 / 360, whole * 80 / 360, whole * 140 / 360};
  const EqualArea made = equal_area(equator({0, 50, 180}), targets);
  EXPECT_EQ(made.end, EqualAreaEnd::converged);
  const std::vector<double> found = power_areas(made);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], targets[i], 1e-12);
}

TEST(equal_area, no_better_weights_than_doubles_is_told) {
  const EqualArea made = equal_area(sampled_sites(300, nullptr, 2), {}, {.tolerance = 0});
  EXPECT_EQ(made.end, EqualAreaEnd::rounded);
  EXPECT_LT(made.largest_error, 1e-12);
}

TEST(equal_area, stop_and_too_few_steps_leave_weights) {
  const std::vector<Point> sites = sampled_sites(300, nullptr, 2);
  EXPECT_EQ(equal_area(sites, {}, {.max_steps = 1}).end, EqualAreaEnd::iterations);
  const std::atomic<bool> stop = true;
  const EqualArea made = equal_area(sites, {}, {}, {.stop = &stop});
  EXPECT_EQ(made.end, EqualAreaEnd::stopped);
  EXPECT_EQ(made.areas.size(), 300U);
}

TEST(equal_area, what_is_no_partition_is_refused) {
  std::vector<Point> sites = icosahedron();
  EXPECT_THROW((void)equal_area({}), InvalidInput);
  EXPECT_THROW((void)equal_area(sites, std::vector<double>(11, whole / 11)), InvalidInput);
  EXPECT_THROW((void)equal_area(sites, std::vector<double>(12, 1)), InvalidInput);
  std::vector<double> targets(12, whole / 11);
  targets[7] = 0;
  EXPECT_THROW((void)equal_area(sites, targets), InvalidInput);
  sites[1] = 2.0 * sites[3];
  EXPECT_THROW((void)equal_area(sites), InvalidInput);
  sites[1] = {0, 0, 0};
  EXPECT_THROW((void)equal_area(sites), InvalidInput);
}

TEST(weighted_site, length_is_the_weight_beyond_double_precision) {
  const std::vector<Point> sites = sampled_sites(20000, nullptr, 12);
  constexpr double spacing = 3.5e-3;
  std::size_t num_rough = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const exact::DoubleDouble weight = {1 + 1e-7 * static_cast<double>(i),
                                        1e-21 * static_cast<double>(i)};
    const Point placed = weighted_site(sites[i], weight, spacing);
    const auto [x, y, z] = placed;
    const auto square = [](double a) { return exact::two_product(a, a); };
    const exact::DoubleDouble rest = square(x) + square(y) + square(z) - weight * weight;
    const double error = std::abs(rest.hi) / (2 * weight.hi);
    num_rough += error > 0x1p-58 ? 1U : 0U;
    EXPECT_LT(error, 0x1p-53);
    EXPECT_LT(norm(cross(exact::to_vector(placed), exact::to_vector(sites[i]))), 1e-13);
    // A mirrored site has the mirrored pole.
    EXPECT_EQ(weighted_site({-sites[i].x, sites[i].y, -sites[i].z}, weight, spacing),
              (Point{-x, y, -z}));
    // What is placed stays.
    EXPECT_EQ(weighted_site(placed, {weight.hi, weight.lo + rest.hi / (2 * weight.hi)}, spacing),
              placed);
  }
  EXPECT_LT(num_rough, sites.size() / 200);
}

// Where two coordinates are too small to change the length: what doubles can.
TEST(weighted_site, near_an_axis_the_length_is_rounded) {
  for (const Point& site : {Point{0, 0, 1}, Point{-1, 0, 0}, Point{0x1p-20, 1, 0x1p-30}}) {
    const Point placed = weighted_site(site, {1.25, 0x1p-54}, 0.01);
    EXPECT_NEAR(norm(exact::to_vector(placed)), 1.25, 0x1p-51);
    EXPECT_LT(norm(cross(exact::to_vector(placed), exact::to_vector(site))), 1e-15);
  }
}

// A path through all vertices and some chords, with weights of all sizes.
TEST(graph_laplacian, solution_solves) {
  const std::size_t n = 5000;
  std::vector<std::vector<std::pair<Index, double>>> rows(n);
  const auto tie = [&](std::size_t i, std::size_t j, double weight) {
    rows[i].push_back({static_cast<Index>(j), weight});
    rows[j].push_back({static_cast<Index>(i), weight});
  };
  for (std::size_t i = 0; i + 1 < n; ++i) tie(i, i + 1, 1 + static_cast<double>(i % 7));
  for (std::size_t i = 0; i + 70 < n; ++i) tie(i, i + 70, 0.5 + static_cast<double>(i % 3));
  WeightedGraph graph;
  for (const auto& row : rows) {
    double sum = 0;
    for (const auto& [j, weight] : row) {
      graph.neighbors.push_back(j);
      graph.weights.push_back(weight);
      sum += weight;
    }
    graph.diagonal.push_back(sum);
    graph.end_row();
  }
  std::vector<double> wanted(n);
  for (std::size_t i = 0; i < n; ++i) wanted[i] = static_cast<double>(i * i % 101) - 50;
  const double mean = std::accumulate(wanted.begin(), wanted.end(), 0.0) / n;
  std::vector<double> right(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& [j, weight] : rows[i]) right[i] += weight * (wanted[i] - wanted[j]);
  }
  std::vector<double> found;
  const int steps = LaplacianSolver(graph, 1).solve(right, 1e-12, 1000, found);
  EXPECT_LT(steps, 60);
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], wanted[i] - mean, 1e-8);
}

}  // namespace
}  // namespace rondel::mesh
