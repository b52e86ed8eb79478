// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/scvt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>

#include "exact/vector.h"
#include "meshing/scvt_levels.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "support/generators.h"
#include "support/thrown.h"

namespace rondel::mesh {
namespace {

double distance(const Point& p, const Point& q) {
  const double dx = p.x - q.x;
  const double dy = p.y - q.y;
  const double dz = p.z - q.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

struct Shape {
  std::map<int, int> degrees;
  int num_obtuse = 0;
  double min_dual_edge = 9;  // over its edge
};

Shape shape_of(const std::vector<Point>& sites) {
  const Triangulation triangulation = delaunay(sites);
  const std::vector<Point> centers = circumcenters(triangulation);
  std::vector<int> degree(sites.size());
  Shape shape;
  for (std::size_t f = 0; f < triangulation.num_faces(); ++f) {
    std::array<double, 3> squares{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Triple& face = triangulation.faces()[f];
      ++degree[face[i]];
      const double edge = distance(sites[face[(i + 1) % 3]], sites[face[(i + 2) % 3]]);
      squares[i] = edge * edge;
      shape.min_dual_edge =
          std::min(shape.min_dual_edge,
                   distance(centers[f], centers[triangulation.neighbors()[f][i]]) / edge);
    }
    std::ranges::sort(squares);
    if (squares[2] > squares[0] + squares[1]) ++shape.num_obtuse;
  }
  for (const int d : degree) ++shape.degrees[d];
  return shape;
}

SizeFunction fourfold() {
  return SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) {
          const double s = std::clamp(2.5 * (places[i].x - 0.3), 0.0, 1.0);
          out[i] = 0.08 - 0.06 * s * s * (3 - 2 * s);
        }
      },
      64);
}

TEST(scvt, subdivided_icosahedron_ends_as_good_as_published_ones) {
  const Scvt made = scvt({.count = 10242});
  EXPECT_EQ(made.end, ScvtEnd::converged);
  EXPECT_LE(made.last.mean_offset, 1e-4);
  EXPECT_LE(made.last.largest_offset, 1e-2);
  ASSERT_EQ(made.sites.size(), 10242U);
  const double ratio = energy_over_hexagons(made.last.energy, made.sites.size());
  EXPECT_GT(ratio, 1);
  EXPECT_LT(ratio, 1.005);
  const Shape shape = shape_of(made.sites);
  EXPECT_EQ(shape.degrees, (std::map<int, int>{{5, 12}, {6, 10230}}));
  EXPECT_EQ(shape.num_obtuse, 0);
  EXPECT_GE(shape.min_dual_edge, 0.39);
}

TEST(scvt, every_number_of_sites_is_met) {
  for (const std::size_t n : std::vector<std::size_t>{12, 13, 42, 100, 401, 999, 1602}) {
    const Scvt made = scvt({.count = n});
    EXPECT_EQ(made.sites.size(), n);
    EXPECT_LT(energy_over_hexagons(made.last.energy, n), n < 100 ? 1.1 : 1.015) << n;
    for (const Point& p : made.sites) EXPECT_NEAR(distance(p, {}), 1, 1e-15);
  }
}

TEST(scvt, energy_never_grows) {
  double last = 0;
  std::size_t level = 0;
  int num_steps = 0;
  const auto see = [&](const ScvtStep& step) {
    if (step.sites == level) {
      EXPECT_LE(step.energy, last + 0x1p-48);
    }
    level = step.sites;
    last = step.energy;
    ++num_steps;
  };
  (void)scvt({.count = 3000, .mean_tolerance = 1e-6, .on_step = see});
  EXPECT_GT(num_steps, 20);
}

// The part grows from 0 to 1, with sites of every level, of a density, and of one's own.
TEST(scvt, part_of_the_work_that_is_done_grows_to_one) {
  const std::vector<Point> start = sampled_sites(700, nullptr, 2);
  ScvtOptions options{.count = 3000};
  std::vector<double> done;
  options.on_step = [&](const ScvtStep& step) { done.push_back(step.done); };
  const auto check = [&](const Scvt& made) {
    EXPECT_TRUE(std::ranges::is_sorted(done));
    EXPECT_GE(done.front(), 0);
    EXPECT_EQ(done.back(), 1) << name_of(made.end);
    const auto half_way = std::ranges::count_if(done, [](double x) { return 0.2 < x && x < 0.8; });
    EXPECT_GT(half_way, 3);
    done.clear();
  };
  check(scvt(options));
  options.size = fourfold();
  check(scvt(options));
  check(relax(start, options));
  options.mean_tolerance = 1e-9;
  options.max_iterations = 40;
  check(scvt(options));
}

TEST(scvt, spacings_that_jump_are_told_from_sites_that_somebody_gave) {
  const auto message = [](const auto& make) { return test::thrown_message<InvalidInput>(make); };
  const SizeFunction jump = SizeFunction::from_function(
      [](std::span<const Point> at, std::span<double> out) {
        for (std::size_t i = 0; i < at.size(); ++i) out[i] = at[i].z > 0.999 ? 1e-4 : 0.5;
      },
      64);
  const std::string of_spacings = message([&] { (void)scvt({.size = jump}); });
  EXPECT_NE(of_spacings.find("the spacings change too fast: from 0.000100 to 0.500000 radians"),
            std::string::npos);
  const std::vector<Point> cap = {{0, 0, 1}, {0.1, 0, 1}, {0, 0.1, 1}, {-0.1, -0.1, 1}};
  const std::string of_sites = message([&] { (void)relax(cap, {.size = jump}); });
  EXPECT_NE(of_sites.find("do not surround the center"), std::string::npos);
}

TEST(scvt, bytes_do_not_depend_on_threads) {
  for (const bool with_size : {false, true}) {
    if (test::is_shortened() && !with_size) continue;
    ScvtOptions options{.count = test::is_shortened() ? 5000U : 9000U};
    if (with_size) options.size = fourfold();
    const Scvt one = scvt(options, {.threads = 1});
    const Scvt three = scvt(options, {.threads = 3});
    EXPECT_EQ(one.sites, three.sites);
    EXPECT_EQ(one.flips, three.flips);
  }
}

TEST(scvt, far_fewer_steps_than_lloyd) {
  const std::vector<Point> start = sampled_sites(2562, nullptr, 2);
  ScvtOptions options{.largest_tolerance = 1, .max_iterations = 20000};
  options.mean_tolerance = 1e-4;
  int steps = 0;
  options.on_step = [&](const ScvtStep& step) { steps = step.iteration; };
  EXPECT_EQ(relax(start, options).end, ScvtEnd::converged);
  const int by_springs = steps;
  options.method = ScvtMethod::lloyd;
  EXPECT_EQ(relax(start, options).end, ScvtEnd::converged);
  EXPECT_LT(by_springs * 8, steps) << by_springs;
}

TEST(scvt, spacings_follow_the_size_function) {
  ScvtOptions options{.size = fourfold()};
  const Scvt made = scvt(options);
  EXPECT_NEAR(static_cast<double>(made.sites.size()), options.size->count(), 1);
  const Triangulation triangulation = delaunay(made.sites);
  const std::vector<double> cell_areas = areas(triangulation);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < made.sites.size(); ++i) {
    ratios.push_back(std::sqrt(2 * cell_areas[i] / std::sqrt(3.0)) /
                     options.size->spacing(made.sites[i]));
  }
  std::ranges::sort(ratios);
  EXPECT_GT(ratios[ratios.size() / 20], 0.9);
  EXPECT_LT(ratios[ratios.size() * 19 / 20], 1.1);
}

TEST(scvt, repair_leaves_neither_short_edges_nor_odd_cells) {
  const std::size_t count = test::is_shortened() ? 10242 : 40962;
  ScvtOptions options{.count = count, .size = fourfold(), .largest_tolerance = 1};
  options.repair = false;
  const Scvt as_is = scvt(options);
  EXPECT_EQ(as_is.repair.moved, 0U);
  EXPECT_LT(shape_of(as_is.sites).min_dual_edge, 0.05);

  options.repair = true;
  const Scvt made = scvt(options);
  ASSERT_EQ(made.sites.size(), count);
  const Shape shape = shape_of(made.sites);
  EXPECT_GE(shape.min_dual_edge, 0.05);
  EXPECT_EQ(shape.num_obtuse, 0);
  EXPECT_GE(shape.degrees.begin()->first, 5);
  EXPECT_LE(shape.degrees.rbegin()->first, 7);
  EXPECT_GT(made.repair.before.short_edges, 0U);
  EXPECT_EQ(made.repair.after.short_edges, 0U);
  EXPECT_EQ(made.repair.after.odd_cells, 0U);

  const double scale = std::sqrt(options.size->count() / static_cast<double>(count));
  std::size_t num_moved = 0;
  for (std::size_t i = 0; i < made.sites.size(); ++i) {
    num_moved += made.sites[i] == as_is.sites[i] ? 0U : 1U;
    EXPECT_LT(distance(made.sites[i], as_is.sites[i]),
              0.15 * 1.5 * scale * options.size->spacing(made.sites[i]))
        << i;
  }
  EXPECT_EQ(num_moved, made.repair.moved);
  EXPECT_LT(num_moved, made.sites.size() / 20);
  options.mean_tolerance = 1;
  EXPECT_LT(relax(made.sites, options).last.mean_offset, 1e-3);
}

TEST(scvt, stop_leaves_the_sites_so_far) {
  std::atomic<bool> stop = false;
  int num_steps = 0;
  ScvtOptions options{.count = 5000};
  options.on_step = [&](const ScvtStep& step) {
    if (step.sites > 1000 && ++num_steps == 3) stop = true;
  };
  const Scvt made = scvt(options, {.stop = &stop});
  EXPECT_EQ(made.end, ScvtEnd::stopped);
  EXPECT_GT(made.sites.size(), 1000U);
}

TEST(scvt, own_sites_keep_their_order) {
  std::vector<Point> start = sampled_sites(500, nullptr, 4);
  for (Point& p : start) p = 3.0 * p;
  const Scvt made = relax(start);
  ASSERT_EQ(made.sites.size(), 500U);
  std::size_t num_close = 0;
  for (std::size_t i = 0; i < 500; ++i) num_close += distance(made.sites[i], start[i] / 3) < 0.2;
  EXPECT_GT(num_close, 450U);
}

TEST(scvt, what_is_no_start_is_refused) {
  EXPECT_THROW((void)scvt({}), InvalidInput);
  EXPECT_THROW((void)scvt({.count = 11}), InvalidInput);
  EXPECT_THROW((void)relax({}), InvalidInput);
  std::vector<Point> sites = icosahedron();
  sites[5] = {0, 0, 0};
  EXPECT_THROW((void)relax(sites), InvalidInput);
  sites[5] = sites[6];
  try {
    (void)relax(sites);
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), 6U);
    EXPECT_STREQ(error.what(), "site 6 is in the place of site 5");
  }
  EXPECT_THROW((void)scvt({.count = 42, .max_iterations = -1}), InvalidInput);
  EXPECT_THROW((void)relax(icosahedron(), {.max_iterations = -1}), InvalidInput);
}

TEST(scvt, names_of_ends) {
  EXPECT_EQ(name_of(ScvtEnd::converged), "converged");
  EXPECT_EQ(name_of(ScvtEnd::iterations), "iterations");
  EXPECT_EQ(name_of(ScvtEnd::stopped), "stopped");
  EXPECT_EQ(name_of(ScvtEnd::stuck), "stuck");
}

}  // namespace
}  // namespace rondel::mesh
