// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Islands and lakes that are nowhere wider than the tolerance vanish, with what is within them, wherever
// they are; all else stays. The mesh is that of the same domain without them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "inputs/random.h"
#include "meshing/rings_within.h"
#include "rondel/mesh_triangles.h"
#include "unit/meshing/domains.h"

namespace rondel::test {
namespace {

Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

// A ring around a place, counterclockwise.
Ring ellipse(double lon, double lat, double width, double height, int size) {
  Ring ring;
  for (int k = 0; k < size; ++k) {
    const double angle = 2 * std::numbers::pi * k / size;
    ring.push_back({lon + 0.5 * width * std::cos(angle), lat + 0.5 * height * std::sin(angle)});
  }
  return ring;
}

TrianglesOptions simplified_by_spacing(double degrees) {
  TrianglesOptions options = spaced(degrees);
  options.tolerance.reset();
  return options;
}

class SmallRingsTest : public testing::Test {
 protected:
  // Expects a coast to give the mesh of another one.
  void expect_equal(const std::vector<Geometries>& coast, const std::vector<Geometries>& without) {
    expect_same(triangles({coast, {sea_}, lines_}, options_),
                triangles({without, {sea_}, lines_}, options_));
  }

  TrianglesOptions options_ = simplified_by_spacing(4);
  Geometries sea_ = polygon({box(-9, -8, 9, 8)});
  std::vector<Geometries> lines_;
};

// A lake like a needle across a land, with a lake beside it in the box around the needle.
TEST_F(SmallRingsTest, needles_take_nothing_with_them) {
  inputs::Random random(3);
  for (int run = 0; run < 60; ++run) {
    SCOPED_TRACE(run);
    const double size = 3 + 2 * random.unit();
    const double tip = size * std::ldexp(1.0, -run % 40);
    const double mirror = run % 2 == 0 ? 1 : -1;
    const auto turned = [&](Ring ring) {
      for (LonLat& p : ring) p.lon_deg *= mirror;
      return mirror > 0 ? ring : reversed(ring);
    };
    const Ring land = box(-6, -6, 6, 6);
    const Ring lake = reversed(turned(box(-4, 1, -1, 4)));
    const Ring needle = turned({{-size, -size}, {0.1, 0.1 + 1e-3 * tip}, {size, size}});
    expect_equal({polygon({land, needle})}, {polygon({land})});
    expect_equal({polygon({land, needle, lake})}, {polygon({land, lake})});
    // As parts of one feature.
    Geometries parts = polygon({reversed(needle), turned(box(-4, 1, -1, 4))});
    expect_equal({parts}, {polygon({turned(box(-4, 1, -1, 4))})});
  }
}

// Thin islands and lakes, whose corners the clearance would keep from the other shore.
TEST_F(SmallRingsTest, thin_rings_vanish) {
  const Ring land = box(-7, -7, 7, 7);
  for (const int size : {4, 5, 8, 12, 40}) {
    for (const double height : {0.3, 0.1, 0.01, 1e-4}) {
      SCOPED_TRACE(size);
      SCOPED_TRACE(height);
      const Ring thin = ellipse(0.5, 1, 6, height, size);
      expect_equal({polygon({thin})}, {});
      expect_equal({polygon({land, reversed(thin)})}, {polygon({land})});
    }
  }
}

// An island that vanishes with a lake that is too thin to be simplified beside its shore; the lake
// touches the shore, or the island touches something.
TEST_F(SmallRingsTest, lakes_vanish_with_islands_that_touch) {
  const Ring shore = ellipse(1, 0, 2, 0.2, 8);
  const Ring lake = {{0.2, 0}, {1, 0.01}, {1.8, 0}, {1, -0.01}};
  Ring lagoon = lake;
  lagoon.back() = {1, -0.01};
  lagoon.front() = shore[4];  // a corner of the island
  const Geometries land = polygon({{shore[4], {-4, 3}, {-4, -3}}});
  const Geometries islet = polygon({{shore[0], {2.1, -0.05}, {2.1, 0.05}}});
  for (const Ring& water : {lake, lagoon}) {
    const Geometries island = polygon({shore, water});
    expect_equal({island}, {});
    expect_equal({island, islet}, {});
    expect_equal({island, land}, {land});
    expect_equal({island, islet, land}, {land});
  }
}

TEST_F(SmallRingsTest, lines_and_points_keep_no_islet) {
  const Geometries islet = polygon({box(2, 2, 2.1, 2.1)});
  for (const Geometries& beside :
       {line({{2, 2}}), line({{2, 2}, {-3, 1}}), line({{-3, 2}, {2, 2}, {5, 3}}),
        line({{2.1, 2.05}, {5, 3}}), line({{0, 2.05}, {5, 2.05}})}) {
    lines_ = {beside};
    const DomainTriangles made = triangles({{islet}, {sea_}, lines_}, options_);
    EXPECT_EQ(std::ranges::count(made.features, FeatureOfEdge::coast), 0);
    expect_same(made, triangles({{islet, islet}, {sea_}, lines_}, options_));
  }
}

// Islets some times as wide as what is welded, where a line crosses the border of the sea, a coast or another
// line: these would run through their corners.
TEST_F(SmallRingsTest, nothing_is_welded_to_islets_that_vanish) {
  inputs::Random random(8);
  const Geometries land = polygon({box(-6, -6, -2, 2)});
  constexpr double welded = 1e-4 * 4;
  for (int run = 0; run < 60; ++run) {
    SCOPED_TRACE(run);
    const LonLat place = std::array<LonLat, 3>{{{9, 1.5}, {-2, -2.5}, {3, 3}}}[run % 3];
    const auto beside = [&] { return place.lon_deg + welded * (2 * random.unit() - 1); };
    const LonLat middle = {beside(), place.lat_deg};
    Ring islet = ellipse(middle.lon_deg, middle.lat_deg, 1, 1, 3 + run % 4);
    for (LonLat& p : islet) {
      const double at = welded * (1 + run % 5) * (0.8 + 1.2 * random.unit());
      p = {middle.lon_deg + at * (p.lon_deg - middle.lon_deg),
           middle.lat_deg + at * (p.lat_deg - middle.lat_deg)};
    }
    const auto through = [&](double from, double to) {
      return line({{place.lon_deg - 1, place.lat_deg + from},
                   {beside(), place.lat_deg},
                   {place.lon_deg + 1, place.lat_deg + to}});
    };
    lines_ = {through(-1.1, 0.7)};
    if (run % 3 == 2) lines_.push_back(through(1, -1.2));
    if (run % 3 == 1) {  // the islet may be a cape, which the line crosses
      const MeshDomain domain = {{land, polygon({islet})}, {sea_}, lines_};
      EXPECT_GT(shortest_edge(triangles(domain, options_)), welded);
    } else {
      expect_equal({land, polygon({islet})}, {land});
    }
  }
}

// The same where the coast itself has the lines, and there is nothing else.
TEST_F(SmallRingsTest, lines_of_the_coast_are_not_welded_to_islets_that_vanish) {
  inputs::Random random(9);
  const Geometries land = polygon({box(-6, -6, -2, 2)});
  constexpr double welded = 1e-4 * 15;
  options_ = simplified_by_spacing(15);
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    const auto beside = [&] { return 3 + welded * (2 * random.unit() - 1); };
    const Ring islet = ellipse(beside(), beside(), welded * (0.7 + 3 * random.unit()),
                               welded * (0.7 + 3 * random.unit()), 3 + run % 4);
    std::vector<Geometries> coast = {land, line({{2, 2}, {beside(), beside()}, {4, 4.1}}),
                                     line({{2, 4}, {beside(), beside()}, {4, 2.2}})};
    const DomainTriangles without = triangles({{together(coast)}, {}, {}}, options_);
    coast.push_back(polygon({islet}));
    expect_same(triangles({{together(coast)}, {}, {}}, options_), without);
  }
}

TEST_F(SmallRingsTest, parts_of_an_area_that_is_everywhere_change_nothing) {
  const Geometries part = polygon({box(40, 0, 50, 10)});
  const Geometries beside = polygon({box(50.05, 0, 60, 10)});
  const Geometries island = polygon({box(0, 0, 20, 20)});
  Geometries world = polygon({});
  world.polygons.whole.push_back(0);
  options_ = simplified_by_spacing(15);
  const auto made = [&](const std::vector<Geometries>& area) {
    return triangles({{island}, area, {}}, options_);
  };
  expect_same(made({world, part, beside}), made({world}));
  expect_same(made({part, world}), made({}));
  // The same in an area that is all but a box.
  const Geometries rest = polygon({reversed(box(100, -10, 130, 20))});
  expect_same(made({rest, part, beside}), made({rest}));
  expect_same(made({part, rest}), made({rest}));
}

// A weld in rounds: the lake vanishes in one, and the other parts change in the next one.
TEST_F(SmallRingsTest, a_world_whose_lake_vanishes_stays_whole) {
  options_ = simplified_by_spacing(13.5);
  const Geometries rest = polygon({reversed({{40, 20}, {40.00067, 20}, {40, 20.00067}})});
  const Geometries part =
      polygon({{{-20.0021, 9.9993}, {-20.0017, 9.9952}, {-20.001, 9.9961}, {-20.0006, 9.9965}}});
  const Geometries beside = polygon({box(-25, 5, -20, 10)});
  expect_same(triangles({{}, {rest, part, beside}, {}}, options_),
              triangles({{}, {}, {}}, options_));
}

TEST_F(SmallRingsTest, parts_of_the_area_that_touch_are_one) {
  const Geometries part = polygon({{{9, 8}, {9.1, 8}, {9.1, 8.1}}});
  const Geometries apart = polygon({box(20, 0, 30, 8)});
  const Geometries overlapping = polygon({box(25, 2, 35, 6)});
  expect_same(triangles({{}, {sea_, part}, {}}, options_), triangles({{}, {sea_}, {}}, options_));
  expect_same(triangles({{}, {sea_, part, apart, overlapping}, {}}, options_),
              triangles({{}, {sea_, apart, overlapping}, {}}, options_));
}

// Two countries with a border in common, of which one has corners where the other one has a side, and a
// third outline at that border, inside of both: a weld that moves corners of one moves the border of both.
TEST_F(SmallRingsTest, borders_that_fit_are_not_torn_by_a_weld) {
  inputs::Random random(6);
  const Geometries east = polygon({{{0, -3}, {4, -3}, {4, 3}, {0, 3}}});
  const Geometries west = polygon({{{0, 3}, {-4, 3}, {-4, -3}, {0, -3}, {0, -1}, {0, 1}}});
  options_ = simplified_by_spacing(2);
  options_.weld = 0.1 * std::numbers::pi / 180;
  for (int run = 0; run < 60; ++run) {
    SCOPED_TRACE(run);
    options_.tolerance = run % 2 == 0 ? std::optional<double>(0) : std::nullopt;
    const double lat = -1.2 + 2.4 * random.unit();
    Ring third;
    for (int k = 0; k < 3 + run % 4; ++k) {
      const double angle = 2 * std::numbers::pi * k / (3 + run % 4);
      const double radius = 0.05 + 0.3 * random.unit();
      third.push_back({radius * std::cos(angle), lat + radius * std::sin(angle)});
    }
    expect_equal({east, west, polygon({third})}, {east, west});
  }
}

// Islets that a weld makes vanish, where lines pass them.
TEST_F(SmallRingsTest, nothing_is_welded_to_islets_that_a_weld_drops) {
  inputs::Random random(10);
  constexpr double weld = 0.05;
  options_.weld = weld * std::numbers::pi / 180;
  for (int run = 0; run < 100; ++run) {
    SCOPED_TRACE(run);
    options_.tolerance = run % 2 == 0 ? std::optional<double>(0) : std::nullopt;
    const auto beside = [&] { return 3 + weld * (random.unit() - 0.5); };
    const Ring islet = ellipse(beside(), beside(), weld * (0.2 + 0.7 * random.unit()),
                               weld * (0.2 + 0.7 * random.unit()), 3 + run % 4);
    lines_ = {line({{2, 2.2}, {beside(), beside()}, {4, 3.9}})};
    if (run % 3 == 0) lines_.push_back(line({{2.1, 4}, {beside(), beside()}, {3.8, 2}}));
    expect_equal({polygon({islet})}, {});
  }
}

// An islet at the side of a land, whose lake is on that land: the weld bends that side, but not such that the
// lake is open.
TEST_F(SmallRingsTest, no_lake_opens_in_a_weld) {
  const Geometries land = polygon({box(-5, -5, -1, 1)});
  const Geometries islet = polygon(
      {{{-0.835, -2.84}, {-1.13, -2.66}, {-1.195, -3.025}, {-0.975, -3.06}, {-0.885, -2.965}},
       reversed({{-1.0125, -2.85}, {-1.055, -2.9225}, {-1.035, -2.9575}, {-1.0225, -2.9625}})});
  options_ = spaced(2);
  options_.weld = 0.05 * std::numbers::pi / 180;
  EXPECT_GT(shortest_edge(triangles({{land, islet}, {sea_}, {}}, options_)), 0.1);
}

// A star that is squeezed to a line has folds along it, which no removal of corners undoes.
TEST_F(SmallRingsTest, folded_rings_along_an_arc_vanish) {
  inputs::Random random(8);
  const Geometries far = polygon({box(-8, -7, -7.5, -6.5)});
  for (int run = 0; run < 100; ++run) {
    SCOPED_TRACE(run);
    const int size = 4 + run % 30;
    Ring star;
    for (int k = 0; k < size; ++k) {
      const double angle = 2 * std::numbers::pi * k / size;
      const double radius = 1 + 3 * random.unit();
      star.push_back({radius * std::cos(angle), 0.1 * radius * std::sin(angle)});
    }
    lines_.clear();
    expect_equal({polygon({star})}, {});
    expect_equal({polygon({box(-7, -6, 7, 6), reversed(star)})}, {polygon({box(-7, -6, 7, 6)})});
    lines_ = {far};
    expect_equal({polygon({star})}, {});
  }
}

// Land inside of other land is one with it, so that its corners keep nothing.
TEST_F(SmallRingsTest, land_within_land_changes_nothing) {
  for (const double share : {0.999, 0.99, 0.9, 0.5}) {
    expect_equal(
        {polygon({ellipse(0, 0, 6, 6, 60)}), polygon({ellipse(0, 0, 6 * share, 6 * share, 60)})},
        {polygon({ellipse(0, 0, 6, 6, 60)})});
  }
}

// An islet and a part of the area that cross do not keep each other.
TEST_F(SmallRingsTest, small_parts_of_the_area_vanish_where_islets_cross_them) {
  const Geometries part = polygon({box(12, 0, 12.1, 0.1)});
  for (const Geometries& islet :
       {polygon({box(12.05, 0.05, 12.15, 0.15)}), polygon({box(12, -0.02, 12.1, 0.05)}),
        polygon({box(11.9, -0.1, 12.2, 0.2)})}) {
    expect_same(triangles({{islet}, {sea_, part}, {}}, options_),
                triangles({{}, {sea_}, {}}, options_));
  }
}

// A bit of a river that was cut into pieces, no longer than the distance of the weld, is one node.
TEST_F(SmallRingsTest, tiny_lines_are_one_node) {
  for (const double length : {3e-4, 1e-5, 1e-8}) {
    SCOPED_TRACE(length);
    const Geometries bit = line({{1, 1}, {1 + length, 1}});
    for (const std::vector<Geometries>& lines :
         {std::vector{bit}, {line({{-4, 1}, {1, 1}}), bit, line({{1 + length, 1}, {5, 2}})}}) {
      for (const bool is_welded : {false, true}) {
        TrianglesOptions options = options_;
        if (is_welded) options.weld = 4e-4 * std::numbers::pi / 180;
        const DomainTriangles made = triangles({{}, {sea_}, lines}, options);
        EXPECT_GT(std::ranges::min(edge_lengths(made)), 0.5);
        EXPECT_LT(made.mesh.nodes.size(), 200U);
      }
    }
  }
}

// A lake in an island in a lake in a land, and rings that touch in corners.
TEST(rings_within, smaller_sides) {
  Geometries all = polygon({box(0, 0, 10, 10), reversed(box(1, 1, 9, 9)), box(2, 2, 8, 8),
                            reversed({{2, 2}, {7, 3}, {3, 7}}), box(10, 10, 12, 12)});
  const auto within = [&](std::size_t around) {
    std::vector<bool> is_around(5);
    is_around[around] = true;
    return meshing::rings_within(all.polygons, 0, is_around);
  };
  using Flags = std::vector<bool>;
  EXPECT_EQ(within(0), (Flags{false, true, true, true, false}));
  EXPECT_EQ(within(1), (Flags{false, false, true, true, false}));
  EXPECT_EQ(within(2), (Flags{false, false, false, true, false}));
  EXPECT_EQ(within(3), Flags(5));
  EXPECT_EQ(within(4), Flags(5));
}

}  // namespace
}  // namespace rondel::test
