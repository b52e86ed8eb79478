// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// PlanarFaces: to which region each face of the plane belongs.
//
//     2 +-----+-----+
//       |  A  |  B  |      A line is written once, from west to east or from south to north, and
//     0 +-----+-----+      counts for A how often A is to the left of it, minus to the right.
//       0     2     4
#include "map/planar_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "map/map_plane.h"
#include "map/planar_loops.h"
#include "map/settled_regions.h"
#include "support/random.h"

namespace rondel::test::of_planar_faces {
namespace {

using map::InPlane;
using map::Loop;
using map::no_region;
using map::NodedLine;
using map::PlanarFaces;

// The lines of regions whose sides meet only in common ends.
std::vector<NodedLine> lines_of_regions(const std::vector<std::vector<Loop>>& regions) {
  const auto is_earlier = [](const std::array<LonLat, 2>& x, const std::array<LonLat, 2>& y) {
    return x[0] == y[0] ? InPlane()(x[1], y[1]) : InPlane()(x[0], y[0]);
  };
  std::map<std::array<LonLat, 2>, std::map<std::size_t, int>, decltype(is_earlier)> counts(
      is_earlier);
  for (std::size_t region = 0; region < regions.size(); ++region) {
    for (const auto& [from, to] : map::sides_of_loops(regions[region])) {
      const bool is_forward = InPlane()(from, to);
      counts[is_forward ? std::array{from, to} : std::array{to, from}][region] +=
          is_forward ? 1 : -1;
    }
  }
  std::vector<NodedLine> lines;
  for (const auto& [ends, own] : counts) {
    NodedLine line{ends[0], ends[1], {}};
    for (const auto& [region, count] : own) {
      if (count != 0) line.counts.push_back({region, count});
    }
    if (!line.counts.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

// The region of the face to the left of the way between two neighboring positions.
std::size_t region_left_of(const std::vector<NodedLine>& lines, const LonLat& from,
                           const LonLat& to) {
  const PlanarFaces faces(lines);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].from == from && lines[i].to == to) return faces.region_at(2 * i);
    if (lines[i].from == to && lines[i].to == from) return faces.region_at(2 * i + 1);
  }
  ADD_FAILURE() << "there is no such line";
  return no_region;
}

Loop box(double west, double east, double south, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}};
}

Loop backward(Loop loop) {
  std::ranges::reverse(loop);
  return loop;
}

TEST(planar_faces, neighbors_have_the_faces_on_both_sides_of_their_line) {
  const auto lines = lines_of_regions({{box(0, 2, 0, 2)}, {box(2, 4, 0, 2)}});
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(region_left_of(lines, {2, 0}, {2, 2}), 0U);
  EXPECT_EQ(region_left_of(lines, {2, 2}, {2, 0}), 1U);
  EXPECT_EQ(region_left_of(lines, {0, 2}, {0, 0}), 0U);
  EXPECT_EQ(region_left_of(lines, {0, 0}, {0, 2}), no_region);
  EXPECT_EQ(region_left_of(lines, {4, 0}, {4, 2}), 1U);
  EXPECT_EQ(region_left_of(lines, {4, 2}, {4, 0}), no_region);
}

// A frame, an island in its hole and a pond in the island: no line connects them.
TEST(planar_faces, what_lies_inside_is_counted_from_what_lies_around_it) {
  const auto lines = lines_of_regions(
      {{box(0, 9, 0, 9), backward(box(1, 8, 1, 8))}, {box(2, 7, 2, 7), backward(box(3, 6, 3, 6))}});
  EXPECT_EQ(region_left_of(lines, {0, 0}, {9, 0}), 0U);
  EXPECT_EQ(region_left_of(lines, {1, 1}, {8, 1}), no_region);
  EXPECT_EQ(region_left_of(lines, {8, 1}, {1, 1}), 0U);
  EXPECT_EQ(region_left_of(lines, {2, 2}, {7, 2}), 1U);
  EXPECT_EQ(region_left_of(lines, {7, 2}, {2, 2}), no_region);
  EXPECT_EQ(region_left_of(lines, {3, 3}, {6, 3}), no_region);
}

// The last region goes around the square twice, the others once.
TEST(planar_faces, the_region_that_goes_around_most_often_has_the_face) {
  const Loop square = box(0, 2, 0, 2);
  const Loop beside = box(0, 2, 2, 3);  // so that the first region has a face in any case
  const auto lines =
      lines_of_regions({{square, beside}, {square, box(0, 2, -1, 0)}, {square, square}});
  EXPECT_EQ(region_left_of(lines, {0, 0}, {2, 0}), 2U);
  const auto equals = lines_of_regions({{square, beside}, {square, box(0, 2, -1, 0)}});
  EXPECT_EQ(region_left_of(equals, {0, 0}, {2, 0}), 0U);
}

// A region without a face gets those around which its sides go in either direction.
TEST(planar_faces, a_lost_region_gets_a_face) {
  // The square of the second region lies in that of the first one.
  const auto inside = lines_of_regions({{box(0, 4, 0, 4)}, {box(1, 3, 1, 3)}});
  EXPECT_EQ(region_left_of(inside, {1, 1}, {3, 1}), 1U);
  EXPECT_EQ(region_left_of(inside, {3, 1}, {1, 1}), 0U);
  // It is turned over, in the first one or in no region.
  const auto turned = lines_of_regions({{box(0, 4, 0, 4)}, {backward(box(1, 3, 1, 3))}});
  EXPECT_EQ(region_left_of(turned, {1, 1}, {3, 1}), 1U);
  const auto alone = lines_of_regions({{backward(box(1, 3, 1, 3))}});
  EXPECT_EQ(region_left_of(alone, {1, 1}, {3, 1}), 0U);
  EXPECT_EQ(region_left_of(alone, {3, 1}, {1, 1}), no_region);
}

TEST(planar_faces, a_lost_region_leaves_others_their_last_face) {
  const Loop square = box(0, 2, 0, 2);
  EXPECT_EQ(region_left_of(lines_of_regions({{square}, {square}}), {0, 0}, {2, 0}), 0U);
  // What one lost region has got, another one does not get.
  const auto lost = lines_of_regions({{backward(square)}, {backward(square)}});
  EXPECT_EQ(region_left_of(lost, {0, 0}, {2, 0}), 0U);
  // The first region has two faces: the second region gets one of them, the third does not get the other.
  const Loop all = box(0, 2, 0, 4);
  const auto both = lines_of_regions({{square, box(0, 2, 2, 4)}, {all}, {all, box(5, 6, 0, 1)}});
  EXPECT_EQ(region_left_of(both, {5, 0}, {6, 0}), 2U);
}

// A board of fields that are parallelograms, of which each region covers some, and some of these several times, or is to the
// right of all sides. A line of the board is there where the counts on both sides of it differ.
class Board {
 public:
  static constexpr std::size_t columns = 12;
  static constexpr std::size_t rows = 7;

  Board(Random& random, std::size_t num_regions) : fields_(num_regions) {
    const std::uint64_t one_in = 2 + random.below(5);
    for (auto& own : fields_) {
      for (auto& column : own) {
        for (int& count : column) {
          count = random.below(one_in) == 0 ? static_cast<int>(random.below(4)) - 1 : 0;
        }
      }
    }
    // A field in the first column that no other region covers, so that no region is lost.
    for (std::size_t region = 0; region < num_regions; ++region) {
      for (std::size_t other = 0; other < num_regions; ++other)
        fields_[other][0][region] = other == region ? 1 : 0;
    }
  }

  // How often a region covers a field; the board begins with field 1, and around it are fields that no region covers.
  [[nodiscard]] int count(std::size_t region, std::size_t x, std::size_t y) const {
    return x == 0 || y == 0 || x > columns || y > rows ? 0 : fields_[region][x - 1][y - 1];
  }

  [[nodiscard]] std::size_t region_at(std::size_t x, std::size_t y) const {
    std::size_t best = no_region;
    int most = 0;
    for (std::size_t region = 0; region < fields_.size(); ++region) {
      if (count(region, x, y) <= most) continue;
      most = count(region, x, y);
      best = region;
    }
    return best;
  }

  // A line between two fields, which are to the left and to the right of it.
  void add_line(const LonLat& from, const LonLat& to, std::array<std::size_t, 2> left,
                std::array<std::size_t, 2> right) {
    NodedLine line{from, to, {}};
    for (std::size_t region = 0; region < fields_.size(); ++region) {
      const int count_left = count(region, left[0], left[1]);
      const int count_right = count(region, right[0], right[1]);
      if (count_left != count_right) line.counts.push_back({region, count_left - count_right});
    }
    if (line.counts.empty()) return;
    lines_.push_back(std::move(line));
    expected_.push_back({region_at(left[0], left[1]), region_at(right[0], right[1])});
  }

  void expect_regions(int slope, bool is_upright) {
    // The corner in the south west of a field. Rows are 4 degrees high, columns 30 degrees wide.
    const auto corner = [&](std::size_t x, std::size_t y) {
      const double across = 30 * static_cast<double>(x) - 210;
      const double up = 4 * static_cast<double>(y) - 20;
      return is_upright ? LonLat{across, up + slope * across / 8} : LonLat{across + slope * up, up};
    };
    for (std::size_t x = 1; x <= columns + 1; ++x) {
      for (std::size_t y = 1; y <= rows + 1; ++y) {
        if (x <= columns) add_line(corner(x, y), corner(x + 1, y), {x, y}, {x, y - 1});
        if (y > rows) continue;
        if (InPlane()(corner(x, y), corner(x, y + 1))) {
          add_line(corner(x, y), corner(x, y + 1), {x - 1, y}, {x, y});
        } else {
          add_line(corner(x, y + 1), corner(x, y), {x, y}, {x - 1, y});
        }
      }
    }
    const PlanarFaces faces(lines_);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      EXPECT_EQ(faces.region_at(2 * i), expected_[i][0]) << i;
      EXPECT_EQ(faces.region_at(2 * i + 1), expected_[i][1]) << i;
    }
  }

 private:
  std::vector<std::array<std::array<int, rows>, columns>> fields_;
  std::vector<NodedLine> lines_;
  std::vector<std::array<std::size_t, 2>> expected_;
};

TEST(planar_faces, of_boards_are_those_of_their_fields) {
  Random random(81);
  for (int round = 0; round < 60; ++round) {
    Board board(random, 1 + random.below(Board::rows));
    board.expect_regions(static_cast<int>(random.below(5)) - 2, round % 2 == 0);
  }
}

}  // namespace
}  // namespace rondel::test::of_planar_faces
