// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Outlines of regions: those of cells that tile the sphere must tile the disc.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "globe.h"
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
  for (std::size_t c = 0; c + 1 < all.offsets.size(); ++c) {
    Region& region = regions.emplace_back();
    for (auto k = all.offsets[c]; k < all.offsets[c + 1]; ++k) {
      region.push_back(all.points[all.rings[k]]);
    }
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

}  // namespace
}  // namespace rondel::cli
