// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations of three and four points in the plane, without degeneracies: where divide and
// conquer ends if a leaf is not certain (leaves.h). With four, the orientations of the triples tell
// which are on the boundary:
//
//      3-----2         0, 1, 2, 3 counterclockwise          2
//      |   / |         around a quadrilateral with         /|\        or with 3 inside
//      | /   |         the diagonal 0-2,                  / 3 \       the triangle 0, 1, 2.
//      0-----1                                           0-----1
//
// in    three or four sites, counterclockwise as in these pictures
// out   their edges in a graph
// index local sites
#pragma once

#include <array>
#include <cstdint>

#include "bulk/plane_graph.h"

namespace rondel::bulk {

struct FourSites {
  std::array<std::uint8_t, 4> order{0, 1, 2, 3};
  bool has_inner_point = false;
};

namespace few_sites {

// `signs` has a bit for each of abc, abd, acd and bcd, set if the triple is counterclockwise.
constexpr FourSites find_order(unsigned signs) {
  const bool is_swapped = (signs & 1U) == 0;  // b and c are, so that abc is counterclockwise
  const bool ab = (signs >> (is_swapped ? 2U : 1U) & 1U) != 0;  // d lies to the left of ab
  const bool ca = (signs >> (is_swapped ? 1U : 2U) & 1U) == 0;
  const bool bc = (signs >> 3 & 1U) != static_cast<unsigned>(is_swapped);
  const std::uint8_t a = 0;
  const std::uint8_t b = is_swapped ? 2 : 1;
  const std::uint8_t c = is_swapped ? 1 : 2;
  const std::uint8_t d = 3;
  if (ab && bc && ca) return {{a, b, c, d}, true};
  if (bc && ca) return {{a, d, b, c}, false};
  if (ab && ca) return {{a, b, d, c}, false};
  if (ab && bc) return {{a, b, c, d}, false};
  if (ca) return {{a, d, c, b}, true};
  if (ab) return {{a, b, d, c}, true};
  return {{b, c, d, a}, true};  // bc
}

constexpr std::array<FourSites, 16> make_orders() {
  std::array<FourSites, 16> orders{};
  for (unsigned signs = 0; signs < orders.size(); ++signs) orders[signs] = find_order(signs);
  return orders;
}

inline constexpr std::array<FourSites, 16> orders = make_orders();

}  // namespace few_sites

// Each returns the edge from 0 to 1, with the outer face on its right.

inline PlaneGraph::Edge draw_triangle(PlaneGraph& graph, const std::array<Index, 3>& p) {
  const std::array<PlaneGraph::Edge, 3> side = graph.new_pairs<3>();
  graph.set_ring<2>({{{side[0], p[1]}, {side[2] ^ 1, p[2]}}});
  graph.set_ring<2>({{{side[1], p[2]}, {side[0] ^ 1, p[0]}}});
  graph.set_ring<2>({{{side[2], p[0]}, {side[1] ^ 1, p[1]}}});
  return side[0];
}

inline PlaneGraph::Edge draw_triangle_around(PlaneGraph& graph, const std::array<Index, 4>& p) {
  const std::array<PlaneGraph::Edge, 3> side = graph.new_pairs<3>();
  const std::array<PlaneGraph::Edge, 3> spoke = graph.new_pairs<3>();  // to the inner point
  graph.set_ring<3>({{{side[0], p[1]}, {spoke[0], p[3]}, {side[2] ^ 1, p[2]}}});
  graph.set_ring<3>({{{side[1], p[2]}, {spoke[1], p[3]}, {side[0] ^ 1, p[0]}}});
  graph.set_ring<3>({{{side[2], p[0]}, {spoke[2], p[3]}, {side[1] ^ 1, p[1]}}});
  graph.set_ring<3>({{{spoke[0] ^ 1, p[0]}, {spoke[1] ^ 1, p[1]}, {spoke[2] ^ 1, p[2]}}});
  return side[0];
}

inline PlaneGraph::Edge draw_quadrilateral(PlaneGraph& graph, const std::array<Index, 4>& p) {
  const std::array<PlaneGraph::Edge, 4> side = graph.new_pairs<4>();
  const PlaneGraph::Edge diagonal = graph.new_pairs<1>()[0];
  graph.set_ring<3>({{{side[0], p[1]}, {diagonal, p[2]}, {side[3] ^ 1, p[3]}}});
  graph.set_ring<2>({{{side[1], p[2]}, {side[0] ^ 1, p[0]}}});
  graph.set_ring<3>({{{side[2], p[3]}, {diagonal ^ 1, p[0]}, {side[1] ^ 1, p[1]}}});
  graph.set_ring<2>({{{side[3], p[0]}, {side[2] ^ 1, p[2]}}});
  return side[0];
}

}  // namespace rondel::bulk
