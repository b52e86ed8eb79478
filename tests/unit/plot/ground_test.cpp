// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Coasts under a figure, and the lines that they are made of.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "plot_draw.h"
#include "plot_ground.h"
#include "unit/plot/recorder.h"

namespace rondel::cli {
namespace {

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
  const std::vector<LonLat> line = {{10, 20}, {370, 20}};
  const LineLayer layer = seen(line, std::vector<std::uint64_t>{0, 2}, View({10, 20}));
  ASSERT_EQ(layer.points.size(), 2U);
  for (const Point& p : layer.points) EXPECT_NEAR(p.z, 1, 1e-15);
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
  figure.coast = {{{0, 0, 1}, normalized({0.1, 0, 1}), normalized({0.1, 0.1, 1})}, {0, 3}};
  EXPECT_EQ(num_paths(figure), bare + 1);
  for (Point& p : figure.coast.points) p.z = -p.z;
  EXPECT_EQ(num_paths(figure), bare);
}

}  // namespace
}  // namespace rondel::cli
