// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The arrangement of arcs of great circles: the planar subdivision that arcs form which may cross,
/// overlap and touch. Set operations on polygons (rondel/set_operations.h) are made of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// The nodes and edges of an arrangement, and how each given arc runs along them.
struct Arrangement {
  /// Unit vectors up to rounding, one for each node, along the spatial order.
  std::vector<Point> nodes;
  /// The two nodes of each edge, the lower one first, in lexicographic order. An edge is the
  /// shorter arc between its nodes.
  std::vector<std::array<Index, 2>> edges;
  /// The halfedges of each given arc, from its first end to its second one: `2 * e` is edge e from
  /// its lower node to its higher one, `2 * e + 1` is the same edge backwards. An arc whose ends
  /// are one place has none.
  CompressedRows<Index> chains;
};

/// The angle in radians by which nodes and arcs of an arrangement may be apart to be treated as
/// touching: 2^-52, or 1.4 nanometers on the Earth.
inline constexpr double arrangement_radius = 0x1p-52;

/// Computes the arrangement of arcs. Any arcs are valid input: they may overlap, share ends, pass
/// through the ends of others, and many may cross in one point.
///
/// 1. No two edges cross, no node lies within an edge, and no edge occurs twice. This is exact for
///    the nodes as they are returned.
/// 2. Each end of an arc is a node, bit by bit. Of several points on one ray from the center the
///    one with the least coordinates is the node.
/// 3. A node that is no end of an arc is the place where two arcs cross, rounded to doubles: each
///    coordinate to the nearest one, or to 0 below 2^-150. Where such rounding lets an arc come
///    within `arrangement_radius` of a node or pass it on the wrong side, the arc is led through the
///    node. This is repeated until 1 holds; so an arc may be bent by that radius as often. (In all tests
///    once or twice.)
/// 4. The result depends on the set of arcs alone, not on their order, their direction or the
///    number of threads. The arrangement of its edges is itself.
///
/// The algorithm and the proof are in docs/theory/arrangements.md.
/// \param points  unit vectors: lengths within 1e-14 of 1, coordinates 0 or at least 2^-150
/// \param arcs  the two ends of each arc, as indices into `points`. Each arc is the shorter one
///        between its ends. An arc whose ends are the same is a point.
/// \throws InvalidInput (the position of the arc) if an end does not exist, or both ends are
///         opposite up to 2^-45; (the position of the point) if a point is not as described; if
///         there are more than 2^31 - 1 arcs, or pieces of them
RONDEL_API Arrangement arrange(std::span<const Point> points,
                               std::span<const std::array<Index, 2>> arcs,
                               const Execution& execution = {});

}  // namespace rondel
