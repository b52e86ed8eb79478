// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that stay, and rows of them along lines: where cells of both sides meet, measured from the mesh alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/mesh_lines.h"
#include "rondel/mesh_quality.h"
#include "rondel/scvt.h"
#include "support/thrown.h"
#include "unit/meshing/support.h"

namespace rondel::mesh {
namespace {

using exact::cross;
using exact::dot;

using Lines = std::vector<std::vector<Point>>;

double away(const Point& a, const Point& b) { return norm(a - b); }

std::vector<Point> random_places(std::size_t n, std::uint64_t seed) {
  return test::mesh_sites(n, seed);
}

// The largest distance of a site that is not fixed from the centroid of its cell, in spacings, by the library's areas and
// centroids.
double largest_offset_of_free(const Scvt& made) {
  const Triangulation triangulation = delaunay(made.sites);
  const std::vector<Point> middles = centroids(triangulation);
  const std::vector<double> all_areas = areas(triangulation);
  const std::set<Index> fixed(made.fixed.begin(), made.fixed.end());
  double most = 0;
  for (Index i = 0; i < made.sites.size(); ++i) {
    if (fixed.contains(i)) continue;
    const double spacing = std::sqrt(2 * all_areas[i] / std::numbers::sqrt3);
    most = std::max(most, away(normalized(middles[i]), made.sites[i]) / spacing);
  }
  return most;
}

TEST(scvt_fixed, sites_stay_bit_by_bit_and_others_relax) {
  const std::vector<Point> places = random_places(12, 7);
  std::vector<ScvtStep> steps;
  ScvtOptions options{.count = 500, .fixed = places};
  options.on_step = [&](const ScvtStep& step) { steps.push_back(step); };
  const Scvt made = scvt(options);
  EXPECT_EQ(made.end, ScvtEnd::converged);
  ASSERT_EQ(made.sites.size(), 500U);
  ASSERT_EQ(made.fixed.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(made.sites[made.fixed[i]], places[i]);
  }
  EXPECT_EQ(std::set<Index>(made.fixed.begin(), made.fixed.end()).size(), places.size());
  // Of the free sites; the repair moves a few of them.
  EXPECT_LE(made.last.largest_offset, 1e-2);
  options.repair = false;
  const Scvt unrepaired = scvt(options);
  // A moment over a mass is not quite the distance of the center: by a part of the cell's size, squared.
  EXPECT_NEAR(largest_offset_of_free(unrepaired), made.last.largest_offset,
              1e-2 * made.last.largest_offset);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(unrepaired.sites[unrepaired.fixed[i]], made.sites[made.fixed[i]]);
  }
  for (std::size_t k = 1; k < steps.size(); ++k) {
    if (steps[k].iteration == 0) continue;
    EXPECT_LE(steps[k].energy, steps[k - 1].energy + 1e-12);
  }
  EXPECT_EQ(scvt({.count = 500, .repair = false, .fixed = places}, {.threads = 2}).sites,
            unrepaired.sites);
}

// More of them than cells meet anywhere, so that some have the same nearest site.
TEST(scvt_fixed, places_near_each_other_have_a_site_each) {
  std::vector<Point> places = random_places(6, 10);
  for (std::size_t i = 1; i < places.size(); ++i) {
    places[i] = normalized(places[0] + 0.01 * places[i]);
  }
  const Scvt made =
      relax(random_places(60, 11), {.max_iterations = 2, .repair = false, .fixed = places});
  EXPECT_EQ(std::set<Index>(made.fixed.begin(), made.fixed.end()).size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(made.sites[made.fixed[i]], places[i]);
}

TEST(scvt_fixed, sites_of_a_start_keep_their_numbers) {
  const std::vector<Point> sites = random_places(400, 8);
  const std::vector<Point> some(sites.begin() + 100, sites.begin() + 140);
  const Scvt made = relax(sites, {.fixed = some});
  for (Index i = 0; i < some.size(); ++i) {
    EXPECT_EQ(made.fixed[i], 100 + i);
    EXPECT_EQ(made.sites[100 + i], some[i]);
  }
  EXPECT_GT(away(made.sites[50], sites[50]), 1e-3);
  // All of them: nothing moves, and that is the end.
  const Scvt still = relax(made.sites, {.fixed = made.sites});
  EXPECT_EQ(still.end, ScvtEnd::converged);
  EXPECT_EQ(still.last.iteration, 0);
  EXPECT_EQ(still.repair.moved, 0U);
  EXPECT_EQ(still.sites, made.sites);
}

TEST(scvt_fixed, places_that_cannot_be_are_refused) {
  const auto index_of_error = [](const ScvtOptions& options) -> std::size_t {
    return test::thrown_index([&] { return scvt(options); }, 1000);
  };
  std::vector<Point> places = random_places(13, 9);
  EXPECT_EQ(index_of_error({.count = 12, .fixed = places}), 12U);
  places[4] = 2 * places[2];
  EXPECT_EQ(index_of_error({.count = 50, .fixed = places}), 4U);
  places[4] = {0, 0, 0};
  EXPECT_EQ(index_of_error({.count = 50, .fixed = places}), 4U);
}

// A closed line on which a site's side is known.
struct Curve {
  std::vector<Point> line;
  bool (*is_inside)(const Point&);
};
Point on_curve(double angle, double radius) {
  return {std::sin(radius) * std::cos(angle), std::sin(radius) * std::sin(angle), std::cos(radius)};
}
double radius_of_wave(double angle) { return 0.8 + 0.15 * std::sin(3 * angle); }
Curve circle() {
  Curve curve{{}, [](const Point& p) { return p.z > std::cos(0.8); }};
  for (int k = 0; k <= 2000; ++k) {
    curve.line.push_back(on_curve(std::numbers::pi * (k % 2000) / 1000, 0.8));
  }
  return curve;
}
Curve wave() {
  Curve curve{{}, [](const Point& p) {
                return std::atan2(std::hypot(p.x, p.y), p.z) < radius_of_wave(std::atan2(p.y, p.x));
              }};
  for (int k = 0; k <= 2000; ++k) {
    const double angle = std::numbers::pi * (k % 2000) / 1000;
    curve.line.push_back(on_curve(angle, radius_of_wave(angle)));
  }
  return curve;
}

struct Deviation {
  double of_edges = 0;  // of corners between the sides from the line
  double of_line = 0;   // of points of the line from the edges between the sides
};
double distance_to(const Point& p, const std::vector<std::array<Point, 2>>& pieces) {
  double least = 9;
  for (const auto& [a, b] : pieces) {
    const Point d = b - a;
    const double t = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-300), 0.0, 1.0);
    least = std::min(least, away(p, a + t * d));
  }
  return least;
}
Deviation deviation_of(const Curve& curve, const VoronoiMesh& arrays) {
  std::vector<std::array<Point, 2>> edges;
  for (std::size_t e = 0; e < arrays.num_edges(); ++e) {
    const auto [a, b] = arrays.cells_on_edge[e];
    if (curve.is_inside(arrays.cell_points[a]) == curve.is_inside(arrays.cell_points[b])) continue;
    const auto [v, w] = arrays.vertices_on_edge[e];
    edges.push_back({arrays.vertex_points[v], arrays.vertex_points[w]});
  }
  std::vector<std::array<Point, 2>> line;
  for (std::size_t k = 0; k + 1 < curve.line.size(); ++k) {
    line.push_back({curve.line[k], curve.line[k + 1]});
  }
  Deviation found;
  for (const auto& edge : edges)
    found.of_edges = std::max(found.of_edges, distance_to(edge[0], line));
  for (std::size_t k = 0; k < line.size(); k += 5) {
    found.of_line = std::max(found.of_line, distance_to(line[k][0], edges));
  }
  return found;
}

// The tolerance of mesh_lines.h, with what curvature adds.
constexpr double stated_tolerance = 0.18;

TEST(mesh_lines, edges_follow_smooth_lines) {
  for (const Curve& curve : {circle(), wave()}) {
    const double spacing = 0.1;
    const SizeFunction size = SizeFunction::constant(spacing, 64);
    const LineSites rows = sites_along(Lines{curve.line}, size);
    EXPECT_EQ(rows.num_left_out, 0U);
    const auto count = static_cast<std::size_t>(size.count());
    const Scvt made = scvt({.count = count, .largest_tolerance = 0.1, .fixed = rows.sites});
    const VoronoiMesh mesh = make_mesh(delaunay(made.sites));
    const Deviation found = deviation_of(curve, mesh);
    EXPECT_LT(found.of_edges, stated_tolerance * spacing);
    EXPECT_LT(found.of_line, stated_tolerance * spacing);
    const Quality report = quality(mesh);
    EXPECT_LE(report.num_obtuse, 1U);  // beside rows that do not give way
    EXPECT_GT(report.min_edge_ratio.value, 0.05);
    // Without the rows it is three times as far away.
    const Deviation without = deviation_of(
        curve, make_mesh(delaunay(scvt({.count = count, .largest_tolerance = 0.1}).sites)));
    EXPECT_GT(without.of_edges, 0.4 * spacing);
  }
}

TEST(mesh_lines, rows_have_the_spacing_of_their_place) {
  const SizeFunction size = SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) out[i] = 0.03 + 0.01 * places[i].x;
      },
      64);
  const Curve curve = circle();
  const LineSites rows = sites_along(Lines{curve.line}, size);
  EXPECT_EQ(rows.num_left_out, 0U);
  // In turn left, inside, and right, each a spacing away from four others.
  for (std::size_t i = 0; i < rows.sites.size(); ++i) {
    const Point& p = rows.sites[i];
    const double h = size.spacing(p);
    EXPECT_EQ(curve.is_inside(p), i % 2 == 0);
    int near = 0;
    for (const Point& q : rows.sites) {
      const double d = away(p, q) / h;
      EXPECT_TRUE(d == 0 || d > 0.9) << i << ' ' << d;
      near += d > 0 && d < 1.1 ? 1 : 0;
    }
    EXPECT_EQ(near, 4);
  }
}

// Each at a right angle to the line, also beside the last station, behind which the first one follows.
TEST(mesh_lines, rows_beside_a_parallel_are_two_parallels) {
  const double spacing = 0.1;
  const LineSites rows = sites_along(Lines{circle().line}, SizeFunction::constant(spacing, 64));
  EXPECT_EQ(rows.num_left_out, 0U);
  const double offset = std::atan(std::sqrt(3.0) / 4 * spacing);
  const std::size_t n = rows.sites.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    const Point wanted = on_curve(turn, k % 2 == 0 ? 0.8 - offset : 0.8 + offset);
    EXPECT_LT(away(rows.sites[k], wanted), 1e-4) << k << " of " << n;
  }
}

TEST(mesh_lines, what_is_too_near_is_left_out) {
  const SizeFunction size = SizeFunction::constant(0.05, 64);
  // To and fro: a strait of 0.02.
  const std::vector<Point> strait = {{1, 0, 0}, {1, 1, 0}, {1, 1, 0.03}, {1, 0, 0.02}};
  const LineSites rows = sites_along(Lines{strait}, size);
  EXPECT_GT(rows.num_left_out, 10U);
  EXPECT_GT(rows.sites.size(), 10U);
  for (std::size_t i = 0; i < rows.sites.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT(away(rows.sites[i], rows.sites[k]), 0.0349);
  }
  // The same line twice is there once.
  const Curve curve = circle();
  const LineSites once = sites_along(Lines{curve.line}, size);
  const LineSites twice = sites_along(Lines{curve.line, curve.line}, size);
  EXPECT_EQ(twice.sites, once.sites);
  EXPECT_EQ(twice.num_left_out, once.sites.size());
  // An islet, a point, and nothing.
  std::vector<Point> islet;
  for (const double radius : {0.01, 0.018}) {
    islet.clear();
    for (int k = 0; k <= 8; ++k) islet.push_back(on_curve(std::numbers::pi * (k % 8) / 4, radius));
    EXPECT_TRUE(sites_along(Lines{islet, {{1, 2, 3}}, {}}, size).sites.empty());
  }
}

// Straight lines one by one, whose sites all stay; of their places those are taken, line by line, the longest first, that are
// far enough from all stations and from those taken before.
TEST(mesh_lines, of_lines_that_cross_the_longest_go_first) {
  const double spacing = 0.06;
  const SizeFunction size = SizeFunction::constant(spacing, 64);
  test::Random random(12);
  Lines lines;
  std::vector<std::pair<std::vector<Point>, Point>> rows;  // and the line's normal
  for (int k = 0; k < 40; ++k) {
    const Point a = test::random_direction(random);
    const Point b = normalized(a + (0.2 + 0.03 * k) * test::random_direction(random));
    lines.push_back({a, b});
    const LineSites alone = sites_along(Lines{lines.back()}, size);
    EXPECT_EQ(alone.num_left_out, 0U);
    rows.emplace_back(alone.sites, normalized(cross(a, b)));
  }
  std::ranges::stable_sort(rows, std::greater(), [](const auto& row) { return row.first.size(); });
  std::vector<Point> stations;
  for (const auto& [sites, normal] : rows) {
    for (const Point& p : sites) stations.push_back(normalized(p - dot(p, normal) * normal));
  }
  std::vector<Point> taken;
  std::size_t num_left_out = 0;
  for (const auto& [sites, normal] : rows) {
    for (const Point& p : sites) {
      const auto is_near = [&p](double distance) {
        return [&p, distance](const Point& q) { return away(p, q) < distance; };
      };
      if (std::ranges::any_of(stations, is_near(0.3 * spacing)) ||
          std::ranges::any_of(taken, is_near(0.7 * spacing))) {
        ++num_left_out;
      } else {
        taken.push_back(p);
      }
    }
  }
  const LineSites found = sites_along(lines, size);
  EXPECT_GT(num_left_out, 50U);
  EXPECT_EQ(found.num_left_out, num_left_out);
  EXPECT_EQ(found.sites, taken);
}

// A straight line of 1.2 radians has twelve steps of a tenth, and chords that long.
TEST(mesh_lines, sites_on_an_open_line_begin_and_end_with_it) {
  const SizeFunction size = SizeFunction::constant(0.1, 64);
  const Point begin = {1, 0, 0};
  const Point end = {std::cos(1.2), std::sin(1.2), 0};
  const LineSites found = sites_on(Lines{{begin, {std::cos(0.3), std::sin(0.3), 0}, end}}, size);
  EXPECT_EQ(found.num_left_out, 0U);
  ASSERT_EQ(found.sites.size(), 13U);
  EXPECT_EQ(found.sites.front(), begin);
  EXPECT_LT(away(found.sites.back(), end), 1e-15);
  for (std::size_t i = 1; i < found.sites.size(); ++i) {
    EXPECT_EQ(found.sites[i].z, 0);
    EXPECT_NEAR(away(found.sites[i], found.sites[i - 1]), 2 * std::sin(0.05), 2e-3);
  }
}

// The places lie on the line, and each has two neighbors a spacing away, also across the line's own first point.
TEST(mesh_lines, sites_on_closed_lines_have_their_spacing) {
  for (const Curve& curve : {circle(), wave()}) {
    const SizeFunction size = SizeFunction::from_function(
        [](std::span<const Point> places, std::span<double> out) {
          for (std::size_t i = 0; i < places.size(); ++i) out[i] = 0.05 + 0.02 * places[i].x;
        },
        64);
    const LineSites found = sites_on(Lines{curve.line}, size);
    EXPECT_EQ(found.num_left_out, 0U);
    EXPECT_LT(away(found.sites.front(), curve.line.front()), 1e-15);
    std::vector<std::array<Point, 2>> pieces;
    for (std::size_t k = 0; k + 1 < curve.line.size(); ++k) {
      pieces.push_back({curve.line[k], curve.line[k + 1]});
    }
    const std::size_t n = found.sites.size();
    EXPECT_GT(n, 60U);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_LT(distance_to(found.sites[i], pieces), 1e-6);
      const double step = away(found.sites[i], found.sites[(i + 1) % n]);
      EXPECT_NEAR(step / size.spacing(found.sites[i]), 1, 0.02) << i;
    }
  }
}

TEST(mesh_lines, points_are_sites_as_they_are_and_lines_keep_away) {
  const SizeFunction size = SizeFunction::constant(0.1, 64);
  const Point first = random_places(1, 3)[0];
  const Point second = normalized(first + 0.01 * random_places(1, 4)[0]);
  // The second line crosses the first one, which is longer, and passes a point in its middle.
  const Point pole = {0, 0, 1};
  const Lines lines = {{first},          {{0, 0.2, 1}, {0, -0.2, 1}}, {pole},
                       {second, second}, {{0.6, 0, 1}, {-0.6, 0, 1}}, {}};
  const LineSites found = sites_on(lines, size);
  ASSERT_GT(found.sites.size(), 3U);
  EXPECT_EQ(found.sites[0], first);
  EXPECT_EQ(found.sites[1], pole);
  EXPECT_EQ(found.sites[2], second);
  EXPECT_GT(found.num_left_out, 0U);
  for (std::size_t i = 3; i < found.sites.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT(away(found.sites[i], found.sites[k]), 0.07 - 1e-12) << i << ' ' << k;
    }
  }
  // All places of the longer line but the one at the pole, at most.
  const LineSites alone = sites_on(Lines{lines[4]}, size);
  for (const Point& p : alone.sites) {
    const bool is_there = std::ranges::find(found.sites, p) != found.sites.end();
    EXPECT_EQ(is_there, away(p, pole) > 0.07) << p.x;
  }
  // An islet has one site, and so has a line shorter than half a spacing.
  const LineSites short_line = sites_on(Lines{{first, second}}, size);
  ASSERT_EQ(short_line.sites.size(), 1U);
  EXPECT_LT(away(short_line.sites[0], first), 1e-15);
  std::vector<Point> islet;
  for (int k = 0; k <= 8; ++k) islet.push_back(on_curve(std::numbers::pi * (k % 8) / 4, 0.005));
  EXPECT_EQ(sites_on(Lines{islet}, size).sites.size(), 1U);
}

// Points of other lengths, of which some round to other unit vectors, and some whose unit vectors are one: each line is a
// point, beside which a line gives way.
TEST(mesh_lines, points_in_one_direction_are_one_place) {
  const SizeFunction size = SizeFunction::constant(0.2, 16);
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sites_on(Lines{{{1, 0, -2 * least}, {0x1p376, 0, 0}}}, size).sites,
            (std::vector<Point>{{1, 0, -2 * least}}));
  test::Random random(5);
  for (int k = 0; k < 200; ++k) {
    const Point p = test::random_direction(random);
    const Point near = normalized(p + 1e-2 * test::random_direction(random));
    const Lines lines = {{p, near, 2 * p}, {0x1p-600 * near, 3 * near, 0x1p900 * near}, {5 * p}};
    const LineSites found = sites_on(lines, size);
    ASSERT_EQ(found.sites.size(), 2U);
    EXPECT_LT(away(found.sites[0], near), 4e-16);
    EXPECT_LT(away(found.sites[1], p), 4e-16);
    for (const Point& site : found.sites) EXPECT_NEAR(dot(site, site), 1, 1e-15);
    EXPECT_TRUE(sites_along(Lines{lines[1]}, size).sites.empty());
  }
}

// Lines on which no step fits: their corners are about a spacing apart.
TEST(mesh_lines, sites_on_rough_lines_end_with_them) {
  const double spacing = 0.1;
  const SizeFunction size = SizeFunction::constant(spacing, 16);
  test::Random random(6);
  for (int k = 0; k < 300; ++k) {
    std::vector<Point> line = {{1, 0, 0}};
    for (int i = 1; i < 9; ++i) {
      const double turn = i % 2 == 0 ? 0.03 : -0.03;
      line.push_back(unit_vector(LonLat{i * (2 + 4 * random.unit()), turn * 90}));
    }
    const LineSites found = sites_on(Lines{line}, size);
    ASSERT_FALSE(found.sites.empty());
    EXPECT_EQ(found.sites.front(), line.front());
    const bool is_far = std::ranges::none_of(
        found.sites, [&](const Point& site) { return away(site, line.back()) < 0.7 * spacing; });
    EXPECT_FALSE(is_far);
  }
}

TEST(mesh_lines, that_are_none_are_refused) {
  const SizeFunction size = SizeFunction::constant(0.05, 64);
  const Lines antipodes = {{{1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  const Lines center = {{{1, 0, 0}, {0, 0, 0}}};
  EXPECT_EQ(test::thrown_index([&] { return sites_along(antipodes, size); }), 1U);
  EXPECT_THROW((void)sites_on(antipodes, size), InvalidInput);
  EXPECT_THROW((void)sites_along(center, size), InvalidInput);
  EXPECT_THROW((void)sites_on(center, size), InvalidInput);
}

}  // namespace
}  // namespace rondel::mesh
