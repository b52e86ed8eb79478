// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Contours of the octahedron, whose values are the heights of its corners: 1 at z, -1 at -z, 0 at the four others.
//
//            z (1)               A face is cut into a triangle above the level 0.5 and a quadrilateral below it. ValuedFaces
//           / \                  makes these pieces, ContourTracer joins their sides to lines and rings with the region to
//        0.5---0.5               the left, and append_simple_lines() divides what visits a point twice.
//         /     \      .
//     x (0) --- y (0)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "interpolation/contour_pieces.h"
#include "interpolation/contour_tracing.h"
#include "rondel/delaunay.h"

namespace rondel::test::of_contour_pieces {
namespace {

using interpolation::ContourPiece;
using interpolation::ContourTracer;
using interpolation::RegionKind;
using interpolation::TracedLines;
using interpolation::ValuedFaces;
using interpolation::ValueRange;

const std::vector<Point> octahedron = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                       {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
const std::vector<double> heights = {0, 0, 1, 0, 0, -1};
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<std::size_t> sizes_of_pieces(const ValuedFaces& faces, const ValueRange& range) {
  std::vector<std::size_t> sizes;
  for (Index face = 0; face < faces.size(); ++face) {
    const ContourPiece piece = faces.piece(face, range);
    EXPECT_EQ(piece.size > 0, faces.has_piece(face, range));
    sizes.push_back(piece.size);
  }
  std::ranges::sort(sizes);
  return sizes;
}

TEST(contour_pieces, of_ranges_of_heights) {
  const Triangulation triangulation = delaunay(octahedron);
  ValuedFaces faces(interpolation::surface_of(triangulation), heights);
  faces.find_missing(0, faces.size());
  using Sizes = std::vector<std::size_t>;
  EXPECT_EQ(sizes_of_pieces(faces, {0.5, infinity}), (Sizes{0, 0, 0, 0, 3, 3, 3, 3}));
  EXPECT_EQ(sizes_of_pieces(faces, {-infinity, 0.5}), (Sizes{3, 3, 3, 3, 4, 4, 4, 4}));
  EXPECT_EQ(sizes_of_pieces(faces, {-0.5, 0.5}), (Sizes{4, 4, 4, 4, 4, 4, 4, 4}));
  // A face is cut twice by the levels 0.25 and 0.75.
  EXPECT_EQ(sizes_of_pieces(faces, {0.25, 0.75}), (Sizes{0, 0, 0, 0, 4, 4, 4, 4}));
  // The corners at a level are the crossings, and a corner alone is no piece.
  EXPECT_EQ(sizes_of_pieces(faces, {0, infinity}), (Sizes{0, 0, 0, 0, 3, 3, 3, 3}));
  EXPECT_EQ(sizes_of_pieces(faces, {-infinity, 0}), (Sizes{0, 0, 0, 0, 3, 3, 3, 3}));
  EXPECT_EQ(sizes_of_pieces(faces, {1, infinity}), Sizes(8, 0));
  EXPECT_EQ(sizes_of_pieces(faces, {}), Sizes(8, 3));
}

// Corners are counterclockwise, know the edges of the face that they lie on, and sides those along which they lead.
TEST(contour_pieces, have_corners_on_the_edges_of_their_face) {
  const Triangulation triangulation = delaunay(octahedron);
  const ValuedFaces faces(interpolation::surface_of(triangulation), heights);
  for (Index face = 0; face < faces.size(); ++face) {
    const Triple& corners = faces.corners(face);
    const ContourPiece piece = faces.piece(face, {0.5, infinity});
    if (piece.size == 0) continue;
    std::size_t num_across = 0;
    for (std::size_t side = 0; side < piece.size; ++side) {
      EXPECT_EQ(piece.next(piece.previous(side)), side);
      const auto& corner = piece.corners[side];
      if (corner.upper == no_index) {
        EXPECT_EQ(corner.lower, 2U);  // z
      } else {
        EXPECT_EQ(corner.upper, 2U);
        EXPECT_EQ(corner.level, 0.5);
        EXPECT_EQ(heights[corner.lower], 0);
      }
      const std::size_t edge = piece.edge_of(side);
      num_across += edge == 3 ? 1 : 0;
      if (edge == 3) continue;
      // The side and the edge lead the same way: one of both begins or ends in z.
      EXPECT_EQ(corners[edge] == 2, corner.upper == no_index);
      EXPECT_EQ(corners[(edge + 1) % 3] == 2, corner.upper != no_index);
    }
    EXPECT_EQ(num_across, 1U);
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const Index across = faces.across(face, edge);
      ASSERT_NE(across, no_index);
      const std::size_t twin = faces.twin(face, edge, across);
      EXPECT_EQ(faces.corners(across)[twin], corners[(edge + 1) % 3]);
      EXPECT_EQ(faces.corners(across)[(twin + 1) % 3], corners[edge]);
    }
  }
}

TEST(contour_pieces, are_not_where_a_value_is_missing) {
  const Triangulation triangulation = delaunay(octahedron);
  std::vector<double> values = heights;
  values[0] = std::nan("");
  ValuedFaces faces(interpolation::surface_of(triangulation), values);
  faces.find_missing(0, faces.size());
  for (Index face = 0; face < faces.size(); ++face) {
    const Triple& corners = faces.corners(face);
    const bool has_x = std::ranges::find(corners, 0U) != corners.end();
    EXPECT_EQ(faces.is_missing(face), has_x);
    if (has_x) continue;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      // The edges opposite to x have no face across.
      const bool is_at_gap = octahedron[corners[(edge + 2) % 3]].x == -1;
      EXPECT_EQ(faces.across(face, edge) == no_index, is_at_gap);
    }
  }
}

// Expects one closed line through points at these angles around the z axis, with this height, to the east or to the west.
void expect_ring(const TracedLines& lines, double height, bool leads_east) {
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_EQ(lines.is_closed[0], 1);
  ASSERT_EQ(lines.lines.values.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(lines.lines.values[k].z, height, 1e-15);
    EXPECT_NEAR(norm(lines.lines.values[k]), 1, 1e-15);
    const Point& next = lines.lines.values[(k + 1) % 4];
    const double turn = cross(lines.lines.values[k], next).z;
    EXPECT_NEAR(turn, (leads_east ? 1 : -1) * (1 - height * height), 1e-15);
  }
}

TEST(contour_tracer, has_the_region_to_the_left) {
  const Triangulation triangulation = delaunay(octahedron);
  // The point at half of the chord from x to z.
  const double half = std::sqrt(0.5);
  for (const auto& [level, height] : {std::pair(0.5, half), {0.0, 0.0}, {-0.5, -half}}) {
    const std::vector<double> levels = {level};
    ContourTracer tracer(interpolation::surface_of(triangulation), heights, levels,
                         RegionKind::from_level_on, {});
    EXPECT_EQ(tracer.num_regions(), 2U);
    expect_ring(tracer.lines(1), height, true);  // the north is higher
    ContourTracer bands(interpolation::surface_of(triangulation), heights, levels, RegionKind::band,
                        {});
    expect_ring(bands.rings(0), height, false);
    expect_ring(bands.rings(1), height, true);
  }
}

// A quarter of the way up the chord from x to z.
TEST(contour_tracer, divides_chords_by_the_level) {
  const Triangulation triangulation = delaunay(octahedron);
  std::vector<double> values = heights;
  values[2] = 4;
  const std::vector<double> levels = {1};
  ContourTracer tracer(interpolation::surface_of(triangulation), values, levels,
                       RegionKind::from_level_on, {});
  expect_ring(tracer.lines(1), 1 / std::sqrt(10), true);
  // Differences of values may be too large for a double.
  for (double& value : values) value = value == 4 ? 1.5e308 : -1.5e308;
  const std::vector<double> half = {-0.75e308};
  ContourTracer huge(interpolation::surface_of(triangulation), values, half,
                     RegionKind::from_level_on, {});
  expect_ring(huge.lines(1), 1 / std::sqrt(10), true);
}

// The middle of three bands has two rings, of one part. It has the most pieces, and where nothing has a border, all is one band.
TEST(contour_tracer, numbers_the_parts_of_bands) {
  const Triangulation triangulation = delaunay(octahedron);
  const std::vector<double> levels = {-0.5, 0.5};
  ContourTracer bands(interpolation::surface_of(triangulation), heights, levels, RegionKind::band,
                      {});
  EXPECT_EQ(bands.num_regions(), 3U);
  EXPECT_EQ(bands.region_without_border(), 1U);
  const TracedLines middle = bands.rings(1);
  ASSERT_EQ(middle.lines.size(), 2U);
  EXPECT_EQ(middle.component[0], middle.component[1]);
  expect_ring(bands.rings(0), -std::sqrt(0.5), false);
  expect_ring(bands.rings(2), std::sqrt(0.5), true);
  // Both poles are above a level, so that the region has two parts.
  std::vector<double> poles = heights;
  poles[5] = 1;
  const std::vector<double> one = {0.5};
  ContourTracer both(interpolation::surface_of(triangulation), poles, one, RegionKind::band, {});
  const TracedLines caps = both.rings(1);
  ASSERT_EQ(caps.lines.size(), 2U);
  EXPECT_NE(caps.component[0], caps.component[1]);
  ContourTracer all(interpolation::surface_of(triangulation), heights, std::vector<double>{},
                    RegionKind::band, {});
  EXPECT_EQ(all.region_without_border(), 0U);
  EXPECT_TRUE(all.rings(0).lines.values.empty());
}

// Without a value at x, a line ends at the border of the surface, and the ring of the band goes along that.
TEST(contour_tracer, ends_lines_at_the_border_of_the_surface) {
  const Triangulation triangulation = delaunay(octahedron);
  std::vector<double> values = heights;
  values[0] = std::nan("");
  const std::vector<double> levels = {0.5};
  ContourTracer tracer(interpolation::surface_of(triangulation), values, levels,
                       RegionKind::from_level_on, {});
  const TracedLines line = tracer.lines(1);
  ASSERT_EQ(line.lines.size(), 1U);
  EXPECT_EQ(line.is_closed[0], 0);
  ASSERT_EQ(line.lines.values.size(), 3U);
  EXPECT_NEAR(line.lines.values[0].y, std::sqrt(0.5), 1e-15);   // from the edge of y
  EXPECT_NEAR(line.lines.values[1].x, -std::sqrt(0.5), 1e-15);  // by that of -x
  EXPECT_NEAR(line.lines.values[2].y, -std::sqrt(0.5), 1e-15);  // to that of -y
  ContourTracer bands(interpolation::surface_of(triangulation), values, levels, RegionKind::band,
                      {});
  EXPECT_EQ(bands.region_without_border(), 2U);
  const TracedLines ring = bands.rings(1);
  ASSERT_EQ(ring.lines.size(), 1U);
  EXPECT_EQ(ring.lines.values.size(), 4U);  // and z
}

Point numbered(int number) { return {static_cast<double>(number), 0, 0}; }

// The lines into which a line through these points is divided, each without its end where it is closed.
std::vector<std::vector<int>> simple_lines(const std::vector<int>& line, bool is_closed,
                                           std::vector<bool> expected_closed) {
  std::vector<Point> points;
  for (const int number : line) points.push_back(numbered(number));
  TracedLines out;
  interpolation::append_simple_lines(points, is_closed, out);
  std::vector<std::vector<int>> lines;
  for (std::size_t i = 0; i < out.lines.size(); ++i) {
    std::vector<int>& one = lines.emplace_back();
    for (const Point& p : out.lines[i]) one.push_back(static_cast<int>(p.x));
  }
  EXPECT_EQ(std::vector<bool>(out.is_closed.begin(), out.is_closed.end()), expected_closed);
  return lines;
}

TEST(contour_loops, lines_that_visit_a_point_twice_are_divided) {
  using Lines = std::vector<std::vector<int>>;
  EXPECT_EQ(simple_lines({1, 2, 3, 4}, true, {true}), (Lines{{1, 2, 3, 4}}));
  EXPECT_EQ(simple_lines({1, 2, 3, 4}, false, {false}), (Lines{{1, 2, 3, 4}}));
  // A figure of eight, and one whose first loop is visited on the way of a line.
  EXPECT_EQ(simple_lines({1, 2, 3, 1, 4, 5}, true, {true, true}), (Lines{{1, 2, 3}, {1, 4, 5}}));
  EXPECT_EQ(simple_lines({9, 1, 2, 3, 1, 8}, false, {true, false}), (Lines{{1, 2, 3}, {9, 1, 8}}));
  // There and back is no loop, and a single point is no line.
  EXPECT_EQ(simple_lines({9, 1, 2, 1, 8}, false, {false}), (Lines{{9, 1, 8}}));
  EXPECT_EQ(simple_lines({1, 2}, true, {}), Lines{});
  EXPECT_EQ(simple_lines({1, 2, 3, 1}, false, {true}), (Lines{{1, 2, 3}}));
  // A loop in a loop.
  EXPECT_EQ(simple_lines({1, 2, 3, 4, 5, 3, 6}, true, {true, true}),
            (Lines{{3, 4, 5}, {1, 2, 3, 6}}));
}

}  // namespace
}  // namespace rondel::test::of_contour_pieces
