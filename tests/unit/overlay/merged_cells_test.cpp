// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells that are joined of arcs and merged, and corners found in the plane, against what takes
// longer and is plain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "exact/point_order.h"
#include "overlay/border_rings.h"
#include "overlay/plane_corners.h"
#include "overlay/single_cells.h"
#include "rondel/delaunay.h"
#include "support/random.h"

namespace rondel::test::of_merged_cells {
namespace {

using overlay::KeyedArc;

bool are_equal(const CellRings& a, const CellRings& b) {
  return a.cells == b.cells && a.rings == b.rings && a.corners == b.corners &&
         a.points == b.points && a.whole == b.whole;
}

void append_ring(std::vector<KeyedArc>& arcs, Index key, const std::vector<LonLat>& places) {
  const std::vector<Point> ring = unit_vectors(places);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    arcs.push_back({key, ring[k], ring[(k + 1) % ring.size()]});
  }
}

// Squares of a grid, of which each third is in one region with its neighbor to the north, and
// wedges that meet at a pole: more than one side begins in most corners.
std::vector<KeyedArc> arcs_of_cells(int size, Index& num_keys) {
  std::vector<KeyedArc> arcs;
  num_keys = 0;
  // The meridian 90 has corners whose x is 0 but for rounding.
  const auto corner = [size](int row, int column) {
    return LonLat{70 + 40.0 * column / size, -20 + 40.0 * row / size};
  };
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const bool is_joined = column % 3 == 0 && row % 2 == 1;
      const Index key = is_joined ? num_keys - static_cast<Index>(size) : num_keys;
      append_ring(arcs, key,
                  {corner(row, column), corner(row, column + 1), corner(row + 1, column + 1),
                   corner(row + 1, column)});
      ++num_keys;
    }
  }
  constexpr int wedges = 24;
  for (int k = 0; k < wedges; ++k) {
    append_ring(arcs, num_keys++,
                {{360.0 / wedges * k, 60}, {360.0 / wedges * (k + 1), 60}, {0, 90}});
  }
  return arcs;
}

TEST(overlay_merged_cells, rings_do_not_depend_on_the_order_of_arcs) {
  Random random(5);
  for (const int size : {2, 7, 30}) {
    Index num_keys = 0;
    std::vector<KeyedArc> arcs = arcs_of_cells(size, num_keys);
    const CellRings cells = overlay::rings_around(arcs, num_keys, 1);
    EXPECT_TRUE(std::ranges::is_sorted(cells.points, exact::is_less));
    EXPECT_TRUE(std::ranges::adjacent_find(cells.points) == cells.points.end());
    std::size_t num_joined = 0;
    for (std::size_t key = 0; key < num_keys; ++key) {
      const std::size_t num_rings = cells.cells[key + 1] - cells.cells[key];
      if (num_rings == 0) ++num_joined;
      EXPECT_LE(num_rings, 1U);
    }
    const auto rows = static_cast<std::size_t>(size);
    EXPECT_EQ(num_joined, rows / 2 * ((rows + 2) / 3));
    // Joined squares have the six corners of both, as their common side is left out.
    const std::size_t num_plain = rows * rows - 2 * num_joined;
    EXPECT_EQ(cells.corners.size(), 4 * num_plain + 6 * num_joined + 3 * 24);
    for (int round = 0; round < 3; ++round) {
      for (std::size_t k = arcs.size(); k > 1; --k) std::swap(arcs[k - 1], arcs[random.below(k)]);
      EXPECT_TRUE(are_equal(overlay::rings_around(arcs, num_keys, 1), cells)) << size;
    }
  }
}

TEST(overlay_merged_cells, are_those_that_are_appended_and_merged) {
  Index num_keys = 0;
  const std::vector<KeyedArc> arcs = arcs_of_cells(6, num_keys);
  CellRings set = overlay::rings_around(arcs, num_keys, 1);
  // The last cell is the whole sphere.
  set.end_cell();
  set.whole = {num_keys};
  // Others have points of the set, points of their own, and both.
  const CellRings here = overlay::one_cell(set, 8);
  CellRings there = here;
  for (Point& p : there.points) p = {-p.x, -p.y, p.z};
  CellRings partly = here;
  partly.points[1] = there.points[1];
  partly.points.push_back(there.points[2]);  // no corner has it
  Random random(11);
  for (int round = 0; round < 20; ++round) {
    CellRings expected;
    overlay::MergedCells merged(set, 0);
    for (int k = 0; k < 40; ++k) {
      const std::size_t which = random.below(6);
      if (which < 3) {
        const auto cell = static_cast<Index>(random.below(num_keys + std::size_t{1}));
        overlay::append(overlay::one_cell(set, cell), expected);
        merged.append_of_set(cell);
      } else {
        const CellRings& one = which == 3 ? here : which == 4 ? there : partly;
        overlay::append(one, expected);
        merged.append(one);
      }
    }
    overlay::merge_equal_points(expected);
    EXPECT_TRUE(are_equal(merged.made(), expected)) << round;
  }
  const CellRings none;
  overlay::MergedCells merged(none, 4);
  CellRings expected;
  for (const Index cell : {3U, 4U, 3U, 11U}) {
    const CellRings one = overlay::one_cell(set, cell);
    overlay::append(one, expected);
    merged.append_by_corners(one);
  }
  overlay::merge_equal_points(expected);
  EXPECT_TRUE(are_equal(merged.made(), expected));
}

TEST(overlay_plane_corners, all_near_a_line_are_visited_once) {
  Random random(17);
  const auto number = [&](double low, double high) { return low + (high - low) * random.unit(); };
  for (int round = 0; round < 30; ++round) {
    std::vector<overlay::PlaneCorners::OwnedCorner> corners;
    const std::size_t size = random.below(3000);
    for (std::size_t k = 0; k < size; ++k) {
      LonLat p = {number(-540, 540), number(-90, 90)};
      if (k % 3 == 0) p = {std::round(p.lon_deg), std::round(p.lat_deg)};
      if (k % 3 == 1) p = {12 + number(0, 0.1), 34 + number(0, 0.1)};  // crowded
      if (k % 7 == 0) p.lon_deg = k % 2 == 0 ? 180 : -180;
      const bool is_far = p.lat_deg > 40;  // from other owners
      corners.push_back({p, is_far ? 1 : static_cast<Index>(k % 5)});
    }
    const overlay::PlaneCorners found(corners);
    for (int line = 0; line < 40; ++line) {
      LonLat west = {number(-400, 400), number(-90, 90)};
      if (line % 2 == 0) west = {11.9, number(33.9, 34.1)};
      const double width = line % 4 == 3 ? 0 : number(0, 3);
      const LonLat east = {west.lon_deg + width,
                           std::clamp(west.lat_deg + number(-3, 3), -90.0, 90.0)};
      const LonLat margins = {number(0, 0.5), number(0, 0.5)};
      std::vector<LonLat> visited;
      found.visit_near(west, east, margins,
                       [&](const LonLat& p, Index /*owner*/) { visited.push_back(p); });
      // Those of one owner in the inside of the map may be left out, and no others.
      for (Index owner = 0; owner < 2; ++owner) {
        std::vector<LonLat> all;
        std::vector<LonLat> others;
        const auto take_in = [&](std::vector<LonLat>& taken) {
          return [&taken, owner](const LonLat& p, Index of) {
            if (of != owner || std::abs(p.lon_deg) >= 180) taken.push_back(p);
          };
        };
        found.visit_near(west, east, margins, take_in(all));
        found.visit_near(west, east, margins, take_in(others), owner);
        EXPECT_EQ(all, others);
      }
      const auto count = [&](const LonLat& p) {
        return std::ranges::count_if(visited, [&](const LonLat& q) {
          return p.lat_deg == q.lat_deg && std::abs(p.lon_deg - q.lon_deg) < 1e-9;
        });
      };
      for (const auto& corner : corners) {
        for (double turn = -1080; turn <= 1080; turn += 360) {
          const LonLat p = {corner.position.lon_deg + turn, corner.position.lat_deg};
          const double x = std::clamp(p.lon_deg, west.lon_deg, east.lon_deg);
          const double slope = width == 0 ? 0 : (east.lat_deg - west.lat_deg) / width;
          double y = west.lat_deg + (x - west.lon_deg) * slope;
          if (width == 0)
            y = std::clamp(p.lat_deg, std::min(west.lat_deg, east.lat_deg),
                           std::max(west.lat_deg, east.lat_deg));
          const bool is_near = std::abs(p.lon_deg - x) < 0.999 * margins.lon_deg &&
                               std::abs(p.lat_deg - y) < 0.999 * margins.lat_deg;
          if (is_near) {
            EXPECT_EQ(count(p), 1) << p.lon_deg << ' ' << p.lat_deg;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace rondel::test::of_merged_cells
