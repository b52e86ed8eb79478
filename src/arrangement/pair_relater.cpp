// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sides of two polygons that do not cross run inside, outside or along each other between the nodes
// where they meet. Which of these occur gives the matrix. At a node the directions of the sides
// show it; components that meet no side of the other polygon are inside or outside as one of their
// nodes is.
#include "arrangement/pair_relater.h"

#include <algorithm>

namespace rondel::arrangement {
namespace {

// Each region that two polygons divide the sphere into is to the left or the right of a side, if
// there is one.
Relation relation_of(const PreparedPolygon& a, const PreparedPolygon& b, const SideFacts& facts) {
  const auto entry = [](bool exists, char dimension) { return exists ? dimension : 'F'; };
  const auto [a_in, b_in] = facts.are_inside;
  const auto [a_out, b_out] = facts.are_outside;
  const bool are_shared = facts.are_along || facts.are_against;
  return {{entry(a_in || b_in || facts.are_along || (a.is_whole() && b.is_whole()), '2'),
           entry(b_in, '1'),
           entry(a_out || b_in || facts.are_against || (a.is_whole() && b.is_empty()), '2'),
           entry(a_in, '1'), entry(facts.do_meet || are_shared, are_shared ? '1' : '0'),
           entry(a_out, '1'),
           entry(b_out || a_in || facts.are_against || (b.is_whole() && a.is_empty()), '2'),
           entry(b_out, '1'),
           entry(a_out || b_out || facts.are_along || (a.is_empty() && b.is_empty()), '2')}};
}

}  // namespace

Relation PairRelater::operator()(const PreparedPolygon& a, const PreparedPolygon& b) {
  polygons_ = {&a, &b};
  facts_ = {};
  meetings_.find(a, b);
  if (meetings_.has_crossings()) {
    facts_.are_inside = facts_.are_outside = {true, true};
    facts_.do_meet = true;
  }
  meetings_.visit_nodes([&](Index node, const auto& directions) {
    facts_.do_meet = true;
    for (const std::size_t k : {0U, 1U}) {
      for (const SideDirection& direction : directions[k]) {
        look_along(node, direction, directions[1 - k], k);
      }
    }
  });
  for (const std::size_t k : {0U, 1U}) locate_components(k);
  return relation_of(a, b, facts_);
}

// Looks where a side of polygon k runs.
void PairRelater::look_along(Index node, const SideDirection& direction,
                             std::span<const SideDirection> others, std::size_t k) {
  switch (place_of_side(meetings_.points(), node, direction, others)) {
    case SidePlace::inside:
      facts_.are_inside[k] = true;
      break;
    case SidePlace::outside:
      facts_.are_outside[k] = true;
      break;
    case SidePlace::along:
      facts_.are_along = true;
      break;
    case SidePlace::against:
      facts_.are_against = true;
  }
}

// Finds where the components of polygon k are that meet no side of the other one.
void PairRelater::locate_components(std::size_t k) {
  const PreparedPolygon& one = *polygons_[k];
  const PreparedPolygon& other = *polygons_[1 - k];
  bool& is_inside = facts_.are_inside[k];
  bool& is_outside = facts_.are_outside[k];
  if (is_inside && is_outside) return;
  const std::span<const Index> met = meetings_.met_components(k);
  // Components far from the other polygon are outside.
  std::size_t num_near = 0;
  one.component_boxes().visit(other.extent(), [&](Index c) {
    ++num_near;
    if ((is_inside && is_outside) || std::ranges::binary_search(met, c)) return;
    (other.has(meetings_.points()[one.side_of(c).from]) ? is_inside : is_outside) = true;
  });
  if (num_near < one.num_components()) is_outside = true;
}

Relation PairRelater::of_itself(const PreparedPolygon& polygon) {
  return relation_of(polygon, polygon, {.are_along = !polygon.sides().empty()});
}

}  // namespace rondel::arrangement
