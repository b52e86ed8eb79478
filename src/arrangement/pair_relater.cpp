// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sides of two polygons that do not cross run inside, outside or along each other between the nodes
// where they meet. Which of these occur gives the matrix. At a node the directions of the sides show
// it; components that meet no side of the other polygon are inside or outside as one of their nodes
// is.
#include "arrangement/pair_relater.h"

#include <algorithm>

#include "arrangement/directions.h"
#include "arrangement/side_meeting.h"

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
  incidences_.clear();
  if (a.extent().overlaps(b.extent())) {
    find_meetings();
    look_around_nodes();
  }
  for (const std::size_t k : {0U, 1U}) locate_components(k);
  return relation_of(a, b, facts_);
}

// Asks the polygon with more sides for the sides near to those of the other one.
void PairRelater::find_meetings() {
  const Index few = polygons_[0]->sides().size() <= polygons_[1]->sides().size() ? 0 : 1;
  const PreparedPolygon& one = *polygons_[few];
  const PreparedPolygon& other = *polygons_[1 - few];
  one.boxes().visit(other.extent(), [&](Index s) {
    other.boxes().visit(one.boxes().box(s), [&](Index t) { meet(few, s, t); });
  });
  std::ranges::sort(incidences_);
  incidences_.erase(std::unique(incidences_.begin(), incidences_.end()), incidences_.end());
}

// Looks at side s of polygon k and side t of the other one.
void PairRelater::meet(Index k, Index s, Index t) {
  const PolygonSide& one = polygons_[k]->sides()[s];
  const PolygonSide& other = polygons_[1 - k]->sides()[t];
  const SideMeeting meeting = meeting_of(points_, one.from, one.to, other.from, other.to);
  if (meeting.is_crossing) {
    facts_.are_inside = facts_.are_outside = {true, true};
    facts_.do_meet = true;
  }
  for (std::size_t m = 0; m < meeting.num_nodes; ++m) {
    incidences_.push_back({meeting.nodes[m], k, s});
    incidences_.push_back({meeting.nodes[m], 1 - k, t});
  }
}

void PairRelater::look_around_nodes() {
  for (std::size_t begin = 0; begin < incidences_.size();) {
    facts_.do_meet = true;
    const Index node = incidences_[begin].node;
    std::size_t end = begin;
    for (auto& directions : directions_) directions.clear();
    for (; end < incidences_.size() && incidences_[end].node == node; ++end) {
      const PolygonSide& at_node = side(incidences_[end]);
      std::vector<SideDirection>& directions = directions_[incidences_[end].polygon];
      if (at_node.from != node) directions.push_back({at_node.from, false});
      if (at_node.to != node) directions.push_back({at_node.to, true});
    }
    for (const std::size_t k : {0U, 1U}) {
      for (const SideDirection& direction : directions_[k]) look_along(node, direction, k);
    }
    begin = end;
  }
}

// Looks where a side of polygon k runs.
void PairRelater::look_along(Index node, const SideDirection& direction, std::size_t k) {
  const std::vector<SideDirection>& others = directions_[1 - k];
  const auto same = std::ranges::find(others, direction.target, &SideDirection::target);
  const Point& target = points_[direction.target];
  const SideDirection& before =
      same != others.end() ? *same : direction_before(points_, node, target, others, true);
  if (same != others.end() || part_of_turn(points_[node], target, points_[before.target]) == 0) {
    (before.is_out == direction.is_out ? facts_.are_along : facts_.are_against) = true;
  } else {
    (before.is_out ? facts_.are_inside : facts_.are_outside)[k] = true;
  }
}

// Finds where the components of polygon k are that meet no side of the other one.
void PairRelater::locate_components(std::size_t k) {
  const PreparedPolygon& one = *polygons_[k];
  const PreparedPolygon& other = *polygons_[1 - k];
  bool& is_inside = facts_.are_inside[k];
  bool& is_outside = facts_.are_outside[k];
  if (is_inside && is_outside) return;
  met_.clear();
  for (const Incidence& i : incidences_) {
    if (i.polygon == k) met_.push_back(one.component(i.side));
  }
  std::ranges::sort(met_);
  met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
  // Components far from the other polygon are outside.
  std::size_t num_near = 0;
  one.component_boxes().visit(other.extent(), [&](Index c) {
    ++num_near;
    if ((is_inside && is_outside) || std::ranges::binary_search(met_, c)) return;
    (other.has(points_[one.side_of(c).from]) ? is_inside : is_outside) = true;
  });
  if (num_near < one.num_components()) is_outside = true;
}

Relation PairRelater::of_itself(const PreparedPolygon& polygon) {
  return relation_of(polygon, polygon, {.are_along = !polygon.sides().empty()});
}

}  // namespace rondel::arrangement
