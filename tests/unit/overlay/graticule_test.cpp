// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// PreparedGrid and GridWalk: grids with their columns and rows, and the strips between an arc and the parallels.
//
//     +----+----+----+        An arc from west to east passes columns and rows. In each of them it leaves a strip: the area
//     |    |  __|____|_       between the arc and the row's southern parallel, which is the integral of the height of the arc
//     +----+-/--+----+        over the parallel, sin(lat) - sin(south), over longitude.
//     |   _|/   |    |
//     +--/-+----+----+
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "exact/vector.h"
#include "overlay/grid_walk.h"
#include "overlay/prepared_grid.h"
#include "rondel/error.h"
#include "support/random.h"

namespace rondel::test::of_graticule {
namespace {

using overlay::GridWalk;
using overlay::PreparedGrid;
using overlay::Strip;
constexpr double pi = std::numbers::pi;

Point at(double lon_deg, double lat_deg) {
  const double lon = lon_deg * pi / 180;
  const double lat = lat_deg * pi / 180;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

double total(const std::vector<double>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

TEST(grid, of_octants) {
  for (const std::vector<double>& lat : {std::vector<double>{-90, 0, 90}, {90, 0, -90}}) {
    const PreparedGrid grid({{0, 90, 180, 270, 360}, lat});
    EXPECT_EQ(grid.num_cells(), 8U);
    EXPECT_TRUE(grid.is_around());
    EXPECT_TRUE(grid.covers_sphere());
    EXPECT_EQ(grid.columns().size(), 4U);
    EXPECT_EQ(grid.num_rows(), 2U);
    // The cells of the grid are numbered as it is given, its rows lead to the north.
    EXPECT_EQ(grid.cell(2, 0), lat[0] < 0 ? 2U : 6U);
    EXPECT_EQ(grid.cell(2, 1), lat[0] < 0 ? 6U : 2U);
    for (const double area : grid.areas()) EXPECT_NEAR(area, pi / 2, 1e-15);
    for (const double length : grid.lengths()) EXPECT_NEAR(length, 3 * pi / 2, 1e-14);
    const std::vector<Point> moments = grid.moments();
    EXPECT_NEAR(moments[1].x, -pi / 4, 1e-15);
    EXPECT_NEAR(moments[1].y, pi / 4, 1e-15);
    EXPECT_NEAR(moments[1].z, lat[0] < 0 ? -pi / 4 : pi / 4, 1e-15);
    std::vector<Index> neighbors;
    grid.append_neighbors(0, neighbors);
    std::ranges::sort(neighbors);
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    EXPECT_EQ(neighbors, (std::vector<Index>{1, 3, 4}));
  }
}

// Two columns and two rows in a part of the sphere: what is beside them is filled by a column and two rows that are no cells.
TEST(grid, of_a_part_is_filled_up_to_the_sphere) {
  const PreparedGrid grid({{10, 30, 40}, {-20, 0, 30}});
  EXPECT_EQ(grid.num_cells(), 4U);
  EXPECT_FALSE(grid.is_around());
  EXPECT_FALSE(grid.covers_sphere());
  EXPECT_EQ(grid.columns().size(), 3U);
  EXPECT_EQ(grid.num_rows(), 4U);
  EXPECT_EQ(grid.first_row(), 1U);
  EXPECT_EQ(grid.latitudes(), (std::vector<double>{-20, 0, 30}));
  double sum = 0;
  std::size_t num_cells = 0;
  for (Index column = 0; column < 3; ++column) {
    for (Index row = 0; row < 4; ++row) {
      sum += grid.area(column, row);
      num_cells += grid.cell(column, row) == no_index ? 0 : 1;
    }
  }
  EXPECT_NEAR(sum, 4 * pi, 1e-14);
  EXPECT_EQ(num_cells, 4U);
  const double south = std::sin(20 * pi / 180);
  const std::vector<double> areas = grid.areas();
  EXPECT_NEAR(areas[0], 20 * pi / 180 * south, 1e-15);
  EXPECT_NEAR(areas[1], 10 * pi / 180 * south, 1e-15);
  EXPECT_NEAR(areas[2], 20 * pi / 180 * 0.5, 1e-15);
  EXPECT_NEAR(total(areas), 30 * pi / 180 * (south + 0.5), 1e-15);
  EXPECT_NEAR(grid.columns()[1].start, 20 * pi / 180, 1e-15);
  EXPECT_NEAR(grid.meridian(1, 5 * pi / 180).y, std::sin(35 * pi / 180), 1e-15);
  EXPECT_NEAR(grid.eastern_meridian(1).x, std::cos(40 * pi / 180), 1e-15);
  std::vector<Index> neighbors;
  grid.append_neighbors(0, neighbors);
  std::ranges::sort(neighbors);
  EXPECT_EQ(neighbors, (std::vector<Index>{1, 2}));
  EXPECT_THROW(PreparedGrid({{10, 30, 20}, {0, 10}}), InvalidInput);
  EXPECT_THROW(PreparedGrid({{10, 30}, {80, 95}}), InvalidInput);
  EXPECT_THROW(PreparedGrid({{10}, {0, 10}}), InvalidInput);
}

// Near a pole the gap 1 - |sine| has more digits than the sine.
TEST(grid, heights_near_a_pole_are_compared_by_their_gaps) {
  const double radius = 1e-9;
  const overlay::SphereHeight low = overlay::height_of(1, 2 * radius);
  const overlay::SphereHeight high = overlay::height_of(1, radius);
  EXPECT_TRUE(overlay::is_polar(low, high));
  EXPECT_DOUBLE_EQ(overlay::rise(low, high), 1.5 * radius * radius);
  EXPECT_DOUBLE_EQ(
      overlay::rise(overlay::height_of(-1, radius), overlay::height_of(-1, 2 * radius)),
      1.5 * radius * radius);
  EXPECT_DOUBLE_EQ(overlay::rise(overlay::height_of(0.25, 0.9), overlay::height_of(0.5, 0.8)),
                   0.25);
  EXPECT_FALSE(overlay::is_polar(overlay::height_of(-1, 0), overlay::height_of(1, 0)));
}

// The latitude of the arc's great circle at a longitude (radians), as a sine.
double sine_on_circle(const Point& normal, double lon) {
  const double across = normal.x * std::cos(lon) + normal.y * std::sin(lon);
  return -across / std::sqrt(across * across + normal.z * normal.z);
}

// Strips against sums over many small steps of longitude. The arcs lead to the east, so that the areas are negative.
TEST(grid_walk, strips_are_integrals_over_longitude) {
  const std::vector<double> lon = {-30, -10, 0, 20, 50};
  const std::vector<double> lat = {-60, -20, 0, 15, 40, 70};
  const PreparedGrid grid({lon, lat});
  const GridWalk walk(grid, false);
  Random random(91);
  for (int round = 0; round < 40; ++round) {
    const double west = -29 + 30 * random.unit();
    const double east = west + 1 + 45 * random.unit();
    const Point p = at(west, 120 * random.unit() - 55);
    const Point q = at(std::min(east, 49.0), 120 * random.unit() - 55);
    std::vector<Strip> strips;
    walk.append(walk.place_of(p), walk.place_of(q), strips);
    std::map<std::array<Index, 2>, double> areas;
    double width = 0;
    for (const Strip& strip : strips) {
      areas[{strip.column, strip.row}] += strip.area;
      EXPECT_LE(strip.area, 1e-15);
      width += strip.width;
    }
    EXPECT_NEAR(std::abs(width), (std::min(east, 49.0) - west) * pi / 180, 1e-14);
    std::map<std::array<Index, 2>, double> expected;
    const Point normal = cross(p, q);
    constexpr int steps = 4000;
    const double step = (std::min(east, 49.0) - west) / steps;
    for (int k = 0; k < steps; ++k) {
      const double here = west + (k + 0.5) * step;
      const double sine = sine_on_circle(normal, here * pi / 180);
      const auto column = static_cast<Index>(std::ranges::upper_bound(lon, here) - lon.begin() - 1);
      const double lat_deg = std::asin(sine) * 180 / pi;
      const auto row = static_cast<Index>(std::ranges::upper_bound(lat, lat_deg) - lat.begin());
      expected[{column, row}] -= step * pi / 180 * (sine - std::sin(lat[row - 1] * pi / 180));
    }
    for (const auto& [place, area] : expected) EXPECT_NEAR(areas[place], area, 2e-4) << round;
    for (const auto& [place, area] : areas) EXPECT_NEAR(expected[place], area, 2e-4) << round;
    // The other direction has the same strips with the other sign.
    std::vector<Strip> back;
    walk.append(walk.place_of(q), walk.place_of(p), back);
    ASSERT_EQ(back.size(), strips.size());
    for (std::size_t k = 0; k < strips.size(); ++k) {
      EXPECT_EQ(back[k].area, -strips[k].area);
      EXPECT_EQ(back[k].row, strips[k].row);
    }
  }
}

// Next to a pole the pole stands for the parallel, as if it were south of the arc: the height is sin(lat) less its own sine.
TEST(grid_walk, strips_at_a_pole_reach_it) {
  for (const double pole : {1.0, -1.0}) {
    const PreparedGrid grid({{-30, 50}, {-60, 60}});
    const GridWalk walk(grid, false);
    for (const double lat : {89.0, 89.9, 89.9999}) {
      const Point p = at(-20, pole * lat);
      const Point q = at(40, pole * (90 - 2 * (90 - lat)));
      std::vector<Strip> strips;
      walk.append(walk.place_of(p), walk.place_of(q), strips);
      ASSERT_EQ(strips.size(), 1U);
      EXPECT_EQ(strips[0].row, pole > 0 ? 2U : 0U);
      EXPECT_EQ(strips[0].pole, pole);
      double area = 0;
      const Point normal = cross(p, q);
      constexpr int steps = 20'000;
      const double step = 60 * pi / 180 / steps;
      for (int k = 0; k < steps; ++k) {
        const double here = -20 * pi / 180 + (k + 0.5) * step;
        // 1 - |sine| from the tangent of the distance to the pole, which loses no digits.
        const double across = normal.x * std::cos(here) + normal.y * std::sin(here);
        const double t = normal.z / across;
        area += step * t * t / (1 + t * t + std::sqrt(1 + t * t));
      }
      EXPECT_NEAR(strips[0].area, pole * area, 1e-6 * area) << lat;
    }
  }
}

// The integral of the unit vector from one latitude to another, along a meridian, times the width of a step.
Point moment_between(double lon, double south, double north, double step) {
  const auto level = [](double lat) { return (lat + std::sin(lat) * std::cos(lat)) / 2; };
  const auto upright = [](double lat) { return std::sin(lat) * std::sin(lat) / 2; };
  const double along = step * (level(north) - level(south));
  return {along * std::cos(lon), along * std::sin(lon), step * (upright(north) - upright(south))};
}

TEST(grid_walk, moments_of_strips_are_integrals_over_longitude) {
  const std::vector<double> lon = {-30, -10, 0, 20, 50};
  const std::vector<double> lat = {-60, -20, 0, 15, 40, 70};
  const PreparedGrid grid({lon, lat});
  const GridWalk walk(grid, true);
  for (const auto& [p, q] : {std::array{at(-25, -30), at(45, 35)},
                             {at(-5, 30), at(5, 32)},
                             {at(-25, 60), at(45, -50)}}) {
    std::vector<Strip> strips;
    walk.append(walk.place_of(p), walk.place_of(q), strips);
    std::map<std::array<Index, 2>, Point> moments;
    for (const Strip& strip : strips) {
      Point& sum = moments[{strip.column, strip.row}];
      sum = sum + strip.moment;
    }
    std::map<std::array<Index, 2>, Point> expected;
    const Point normal = cross(p, q);
    constexpr int steps = 20'000;
    const double west = std::atan2(p.y, p.x);
    const double step = (std::atan2(q.y, q.x) - west) / steps;
    for (int k = 0; k < steps; ++k) {
      const double here = west + (k + 0.5) * step;
      const double here_deg = here * 180 / pi;
      const double north = std::asin(sine_on_circle(normal, here));
      const auto column =
          static_cast<Index>(std::ranges::upper_bound(lon, here_deg) - lon.begin() - 1);
      const auto row =
          static_cast<Index>(std::ranges::upper_bound(lat, north * 180 / pi) - lat.begin());
      Point& sum = expected[{column, row}];
      sum = sum - moment_between(here, lat[row - 1] * pi / 180, north, step);
    }
    for (const auto& [place, moment] : expected)
      EXPECT_LT(norm(moments[place] - moment), 1e-4) << place[0] << ' ' << place[1];
    EXPECT_EQ(moments.size(), expected.size());
  }
}

// A place has the column whose western meridian is next to it in the west.
TEST(grid_walk, places_are_in_their_columns) {
  const PreparedGrid grid({{-30, -10, 0, 20, 50}, {-60, 70}});
  const GridWalk walk(grid, false);
  for (const auto& [lon_deg, column] : {std::pair(-29.0, 0U),
                                        {-11.0, 0U},
                                        {-9.0, 1U},
                                        {10.0, 2U},
                                        {49.0, 3U},
                                        {51.0, 4U},
                                        {180.0, 4U},
                                        {-31.0, 4U}}) {
    const overlay::PlaceInGrid place = walk.place_of(at(lon_deg, 30));
    EXPECT_EQ(place.column, column) << lon_deg;
    const double start = grid.columns()[column].start - 30 * pi / 180;
    EXPECT_NEAR(std::remainder(start + place.offset - lon_deg * pi / 180, 2 * pi), 0, 1e-14);
    EXPECT_NEAR(place.radius, std::cos(30 * pi / 180), 1e-15);
    EXPECT_EQ(place.gap, 0);
  }
}

}  // namespace
}  // namespace rondel::test::of_graticule
