// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Outlines of regions: those of cells that tile the sphere must tile the disc.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "globe.h"
#include "plot_draw.h"
#include "plot_ground.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "unit/plot/recorder.h"

namespace rondel::cli {
namespace {

constexpr double pi = std::numbers::pi;

using Region = std::vector<Point>;

// The 8 triangles between the axes.
std::vector<Region> octants() {
  std::vector<Region> regions;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      for (const double z : {1.0, -1.0}) {
        Region region{{x, 0, 0}, {0, y, 0}, {0, 0, z}};
        if (x * y * z < 0) std::swap(region[0], region[1]);
        regions.push_back(region);
      }
    }
  }
  return regions;
}

// The quarters between four meridians, from pole to pole.
std::vector<Region> lunes() {
  const std::array<Point, 4> equator{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
  std::vector<Region> regions;
  for (std::size_t i = 0; i < 4; ++i) {
    regions.push_back({{0, 0, -1}, equator[(i + 1) % 4], {0, 0, 1}, equator[i]});
  }
  return regions;
}

double visible_area(const std::vector<Region>& regions, const View& view) {
  double sum = 0;
  for (const Region& region : regions) {
    Region corners;
    for (const Point& p : region) corners.push_back(view.turn(p));
    Recorder pen;
    const bool is_visible = trace_region(pen, corners, 1e-7);
    EXPECT_EQ(is_visible, !pen.paths.empty());
    const double area = pen.area();
    EXPECT_GE(area, -2e-6);  // curves are so near to their arcs
    for (const auto& path : pen.paths) {
      for (const Spot p : path) EXPECT_LE(length(p), 1 + 1.1e-6);
    }
    sum += area;
  }
  return sum;
}

// The chords of the recorder's samples, 2 degrees long, lose that much of the disc.
constexpr double sampling = 1e-3;

TEST(trace_region, tiles_the_disc_from_every_direction) {
  Directions random(4);
  for (int i = 0; i < 300; ++i) {
    const Point center = random.next();
    const View view({std::atan2(center.y, center.x) * 180 / pi, std::asin(center.z) * 180 / pi},
                    static_cast<double>(i));
    ASSERT_NEAR(visible_area(octants(), view), pi, sampling);
    ASSERT_NEAR(visible_area(lunes(), view), pi, sampling);
  }
}

TEST(trace_region, tiles_the_disc_when_corners_and_edges_lie_on_the_limb) {
  for (const double lon : {-180.0, -90.0, -45.0, 0.0, 45.0, 90.0}) {
    for (const double lat : {-90.0, -45.0, 0.0, 45.0, 90.0}) {
      const View view({lon, lat});
      ASSERT_NEAR(visible_area(octants(), view), pi, sampling) << lon << ' ' << lat;
      ASSERT_NEAR(visible_area(lunes(), view), pi, sampling) << lon << ' ' << lat;
    }
  }
}

// Flat cells just behind the limb are seen edge-on: their chords turn the other way than their arcs.
TEST(trace_region, tiles_the_disc_with_voronoi_cells_of_any_form) {
  Directions random(9);
  std::vector<Point> sites;
  for (int i = 0; i < 400; ++i) {
    const Point p = random.next();
    sites.push_back(i % 2 == 0 ? p : normalized({p.x, p.y, 0.02 * p.z}));
  }
  const Cells all = cells(delaunay(sites));
  std::vector<Region> regions;
  for (std::size_t c = 0; c < all.rings.size(); ++c) {
    Region& region = regions.emplace_back();
    for (const Index k : all.rings[c]) region.push_back(all.points[k]);
  }
  for (int i = 0; i < 300; ++i) {
    const Point center = random.next();
    const View view({std::atan2(center.y, center.x) * 180 / pi, std::asin(center.z) * 180 / pi});
    ASSERT_NEAR(visible_area(regions, view), pi, sampling);
  }
}

TEST(trace_region, of_the_hemisphere_in_front_is_the_disc_and_of_the_other_nothing) {
  const Region front{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const Region back{{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 1, 0}};
  Recorder pen;
  EXPECT_TRUE(trace_region(pen, front, 1e-7));
  EXPECT_NEAR(pen.area(), pi, sampling);
  EXPECT_FALSE(trace_region(pen, back, 1e-7));
}

// Coasts under a figure, and the lines that they are made of.

TEST(trace_line, draws_what_its_arcs_do_without_a_break) {
  Directions random(5);
  for (int i = 0; i < 200; ++i) {
    std::vector<Point> line;
    for (int k = 0; k < 12; ++k) line.push_back(random.next());
    for (const Side side : {Side::front, Side::back}) {
      Recorder whole, arcs;
      trace_line(whole, line, side, 1e-6);
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        trace_arc(arcs, line[k], line[k + 1], side, 1e-6);
      }
      EXPECT_EQ(whole.num_curves, arcs.num_curves);
      EXPECT_EQ(whole.num_lines, arcs.num_lines);
      std::size_t starts = 0;  // where the line comes into sight
      for (std::size_t k = 0; k < line.size(); ++k) {
        const auto is_seen = [&](const Point& p) { return (p.z > 0) == (side == Side::front); };
        if (is_seen(line[k]) && (k == 0 || !is_seen(line[k - 1]))) ++starts;
      }
      EXPECT_EQ(whole.paths.size(), starts);
      for (const auto& path : whole.paths) {
        for (const Spot p : path) ASSERT_LE(length(p), 1 + 1e-5);
      }
    }
  }
}

TEST(trace_line, of_less_than_two_points_is_nothing) {
  Recorder pen;
  trace_line(pen, {}, Side::front, 1e-6);
  trace_line(pen, std::vector<Point>{{0, 0, 1}}, Side::front, 1e-6);
  EXPECT_TRUE(pen.paths.empty());
}

TEST(seen, turns_positions_into_the_view) {
  const LineLayer layer = seen({{0, 2}, {{10, 20}, {370, 20}}}, View({10, 20}));
  ASSERT_EQ(layer.values.size(), 2U);
  for (const Point& p : layer.values) EXPECT_NEAR(p.z, 1, 1e-15);
}

std::size_t num_paths(const Figure& figure) {
  const std::string svg = draw(figure, FigureFormat::svg);
  std::size_t count = 0;
  for (auto at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1))
    ++count;
  return count;
}

TEST(draw, shows_the_coast_that_is_in_front) {
  Figure figure;
  figure.style.size = 200;
  const std::size_t bare = num_paths(figure);
  figure.coast = {{0, 3}, {{0, 0, 1}, normalized({0.1, 0, 1}), normalized({0.1, 0.1, 1})}};
  EXPECT_EQ(num_paths(figure), bare + 1);
  for (Point& p : figure.coast.values) p.z = -p.z;
  EXPECT_EQ(num_paths(figure), bare);
}

}  // namespace
}  // namespace rondel::cli
