// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds where arcs cross, and which nodes are on arcs or so near to them that rounding may bring
// them there.
//
// in    arcs between nodes
// out   the pairs of arcs that cross, and pairs of an arc and a node
// index arcs and nodes, as in NodedArcs
#pragma once

#include <span>
#include <vector>

#include "arrangement/box_tree.h"
#include "arrangement/noded_arcs.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Two arcs that cross in the inside of both; exact.
struct CrossingArcs {
  Index first;
  Index second;  // above first
  friend auto operator<=>(const CrossingArcs&, const CrossingArcs&) = default;
};

// A node within `arrangement_radius` of the inside of an arc: the node that is nearest to some place
// of the arc may be this one. The node is none of the arc's ends.
struct NearNode {
  Index arc;
  Index node;
  friend auto operator<=>(const NearNode&, const NearNode&) = default;
};

struct Contacts {
  std::vector<CrossingArcs> crossings;  // ascending
  std::vector<NearNode> near;           // ascending; of ends of arcs alone
};

// True if the arcs ab and cd cross in the inside of both; exact.
bool do_arcs_cross(const Point& a, const Point& b, const Point& c, const Point& d);

// True if the foot of the perpendicular from a point to the arc ab is within the arc and not farther
// from the point than `arrangement_radius`, up to rounding: the same result for the same bits.
bool is_near(const Point& a, const Point& b, const Point& p);

// Returns the distance of a point from the great circle of ab, positive to the left, with a small
// relative error, however small it is.
double exact_height(const Point& a, const Point& b, const Point& p);

// True if a point is in the inside of the arc ab; exact. Precondition: is_near(a, b, p).
bool is_on_near_arc(const Point& a, const Point& b, const Point& p);

// Returns a box that contains the arc ab and what is near to it.
SpaceBox box_of(const Point& a, const Point& b);

// Returns the boxes of all arcs, which contain what is near to the arcs.
BoxTree boxes_of(const NodedArcs& input, unsigned threads);

Contacts find_contacts(const NodedArcs& input, const BoxTree& boxes, unsigned threads);

// Points to which arcs near to them are sought.
struct SoughtPoints {
  std::span<const Point> points;
  std::span<const Index> which;         // of these points, along the spatial order
  std::span<const CrossingArcs> known;  // for each of `which` two arcs that are left out
};

// Returns the arcs to which points are near: entries (arc, index of the point), in any order.
std::vector<NearNode> arcs_near(const NodedArcs& input, const BoxTree& boxes,
                                const SoughtPoints& sought, unsigned threads);

}  // namespace rondel::arrangement
