// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Crossings and PieceBoundaries: where the sides of octants cross those of turned octants, and what bounds the pieces.
//
//            z                 The side from x to y leaves cells of the cover one after the other. The arcs of a piece are
//           / \                parts of the octant's sides, and parts of sides of the cover inside of the octant, which bound
//       ___/___\___            two pieces; at each point as many of them arrive as leave.
//         /     \      .
//        x-------y
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "exact/vector.h"
#include "overlay/crossings.h"
#include "overlay/piece_boundaries.h"
#include "support/random.h"
#include "unit/overlay/support.h"

namespace rondel::test::of_arcs {
namespace {

using overlay::Halfedge;
using overlay::Subdivision;

// The octants of three perpendicular axes.
CellRings octants_of(const Point& a, const Point& b, const Point& c) {
  CellRings cells;
  for (const Point& p : {a, b, c}) {
    cells.points.push_back(p);
    cells.points.push_back({-p.x, -p.y, -p.z});
  }
  for (const Index i : {0U, 1U}) {
    for (const Index j : {2U, 3U}) {
      for (const Index k : {4U, 5U}) {
        const bool is_even = (i + j + k) % 2 == 0;
        cells.corners.insert(cells.corners.end(), {i, is_even ? j : k, is_even ? k : j});
        cells.rings.push_back(cells.corners.size());
        cells.cells.push_back(cells.rings.size() - 1);
      }
    }
  }
  return cells;
}

CellRings turned_octants(Random& random) {
  const Point a = random.direction();
  const Point b = normalized(cross(a, random.direction()));
  return octants_of(a, b, normalized(cross(a, b)));
}

bool is_left(const Point& a, const Point& b, const Point& p) { return dot(cross(a, b), p) > 0; }

// True if the place is to the left of all sides of a cell.
bool is_inside(const Subdivision& all, Index cell, const Point& place) {
  for (Halfedge h = all.begin_of(cell); h < all.end_of(cell); ++h) {
    if (!is_left(all.origin(h), all.end(h), place)) return false;
  }
  return true;
}

bool do_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return is_left(a, b, c) != is_left(a, b, d) && is_left(c, d, a) != is_left(c, d, b) &&
         dot(a + b, c + d) > 0;
}

TEST(crossings, lead_from_cell_to_cell) {
  Random random(86);
  std::size_t num_crossings = 0;
  for (int round = 0; round < 20; ++round) {
    const Subdivision cells(octants_of({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), false, 1);
    const Subdivision cover(turned_octants(random), false, 1);
    const overlay::Crossings crossings(cells, cover, 0, 8);
    for (Halfedge h = 0; h < cells.num_halfedges(); ++h) {
      const auto& trace = crossings.trace_of(h);
      const std::span<const overlay::EdgeCrossing> found = crossings.of(trace);
      EXPECT_TRUE(is_inside(cover, trace.start, cells.origin(h)));
      // Those of the twin, which were found first, are in its order.
      Index here = trace.is_backwards ? crossings.trace_of(cells.twins[h]).start : trace.start;
      const Point from = trace.is_backwards ? cells.end(h) : cells.origin(h);
      const Point to = trace.is_backwards ? cells.origin(h) : cells.end(h);
      double along = 0;
      for (const auto& [out, point] : found) {
        EXPECT_EQ(cover.cell_of[out], here);
        here = cover.cell_of[cover.twins[out]];
        EXPECT_NEAR(dot(normalized(cross(from, to)), point), 0, 1e-15);
        EXPECT_NEAR(dot(normalized(cross(cover.origin(out), cover.end(out))), point), 0, 1e-15);
        EXPECT_GT(norm(point - from), along);
        along = norm(point - from);
      }
      EXPECT_TRUE(is_inside(cover, here, to));
      std::size_t expected = 0;
      for (Halfedge g = 0; g < cover.num_halfedges(); ++g)
        expected += g < cover.twins[g] && do_cross(from, to, cover.origin(g), cover.end(g)) ? 1 : 0;
      EXPECT_EQ(found.size(), expected) << round << ' ' << h;
      num_crossings += expected;
    }
    // A range of cells has the same crossings as all cells.
    const overlay::Crossings some(cells, cover, 3, 5);
    for (Halfedge h = cells.begin_of(3); h < cells.end_of(4); ++h) {
      EXPECT_EQ(some.trace_of(h).start, crossings.trace_of(h).start);
      EXPECT_EQ(some.of(some.trace_of(h)).size(), crossings.of(crossings.trace_of(h)).size());
    }
  }
  EXPECT_GT(num_crossings, 200U);
}

long double area_of_piece_by_clipping(const Subdivision& cells, Index i, const Subdivision& cover,
                                      Index j) {
  LongRing ring;
  for (Halfedge h = cells.begin_of(i); h < cells.end_of(i); ++h)
    ring.push_back(long_vector(cells.origin(h)));
  for (Halfedge h = cover.begin_of(j); h < cover.end_of(j); ++h)
    ring = clipped(ring, long_vector(cover.origin(h)), long_vector(cover.end(h)));
  return area_of(ring);
}

// The triangles of the arcs of a piece with the middle of the octant add up to the piece.
TEST(piece_arcs, bound_the_pieces) {
  Random random(87);
  for (int round = 0; round < 20; ++round) {
    const Subdivision cells(octants_of({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), false, 1);
    const Subdivision cover(turned_octants(random), false, 1);
    overlay::PieceBoundaries maker(cells, cover, 0, 8);
    for (Index cell = 0; cell < 8; ++cell) {
      const std::span<const overlay::BoundaryArc> arcs = maker(cell);
      EXPECT_TRUE(maker.is_consistent());
      ASSERT_EQ(maker.corners().size(), 3U);
      for (Index k = 0; k < 3; ++k)
        EXPECT_EQ(maker.points()[maker.corners()[k]], cells.origin(cells.begin_of(cell) + k));
      std::map<std::tuple<Index, double, double, double>, int> balance;  // by piece and place
      std::array<double, 8> areas{};
      const Point& middle = cells.centers[cell];
      for (const auto& [left, right, from, to] : arcs) {
        const auto points = maker.points();
        const auto add = [&](Index piece, Index p, Index q) {
          ++balance[{piece, points[p].x, points[p].y, points[p].z}];
          --balance[{piece, points[q].x, points[q].y, points[q].z}];
          const LongRing triangle = {long_vector(middle), long_vector(points[p]),
                                     long_vector(points[q])};
          areas[piece] += static_cast<double>(area_of(triangle));
        };
        add(left, from, to);
        if (right != no_index) add(right, to, from);
      }
      for (const auto& [at, difference] : balance) EXPECT_EQ(difference, 0) << std::get<0>(at);
      for (Index other = 0; other < 8; ++other) {
        EXPECT_NEAR(areas[other],
                    static_cast<double>(area_of_piece_by_clipping(cells, cell, cover, other)),
                    1e-13)
            << round;
      }
    }
  }
}

}  // namespace
}  // namespace rondel::test::of_arcs
