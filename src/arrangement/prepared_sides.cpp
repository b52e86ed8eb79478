// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "arrangement/prepared_sides.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "arrangement/arc_contacts.h"
#include "arrangement/directions.h"
#include "arrangement/side_meeting.h"
#include "rondel/predicates.h"

namespace rondel::arrangement {

void PreparedSides::make_boxes() {
  std::vector<SpaceBox> boxes;
  boxes.reserve(sides_.size());
  for (const PolygonSide& side : sides_) {
    boxes.push_back(box_of(points_[side.from], points_[side.to]));
  }
  boxes_ = BoxTree(boxes, 1);
}

// Divides sides at nodes in their inside.
bool PreparedSides::divide_sides(bool are_apart) {
  bool is_crossed = false;
  std::vector<NodeOfSide> inside;
  for (std::size_t block = 0; block < boxes_.num_blocks(); ++block) {
    boxes_.visit_pairs(block, [&](Index i, Index j) {
      const PolygonSide& s = sides_[i];
      const PolygonSide& t = sides_[j];
      const SideMeeting meeting = meeting_of(points_, s.from, s.to, t.from, t.to);
      is_crossed = is_crossed || meeting.is_crossing;
      for (std::size_t k = 0; k < meeting.num_nodes; ++k) {
        const Index node = meeting.nodes[k];
        if (node != s.from && node != s.to) inside.push_back({node, i});
        if (node != t.from && node != t.to) inside.push_back({node, j});
      }
    });
    if (is_crossed && are_apart) return true;
  }
  if (inside.empty()) return is_crossed;
  // Along its side a node is before another one if it is between the start of the side and that.
  std::ranges::sort(inside, [&](const NodeOfSide& a, const NodeOfSide& b) {
    if (a.side != b.side || a.node == b.node) return a.side < b.side;
    return is_between(points_[sides_[a.side].from], points_[b.node], points_[a.node]);
  });
  std::vector<PolygonSide> divided;
  std::size_t next = 0;
  for (Index s = 0; s < sides_.size(); ++s) {
    Index from = sides_[s].from;
    for (; next < inside.size() && inside[next].side == s; ++next) {
      if (inside[next].node == from) continue;
      divided.push_back({from, inside[next].node});
      from = inside[next].node;
    }
    divided.push_back({from, sides_[s].to});
  }
  sides_ = std::move(divided);
  make_boxes();
  return is_crossed;
}

void PreparedSides::keep_sides(std::span<const Index> kept) {
  for (std::size_t k = 0; k < kept.size(); ++k) sides_[k] = sides_[kept[k]];
  sides_.resize(kept.size());
  make_boxes();
}

std::vector<NodeOfSide> PreparedSides::sorted_ends() const {
  std::vector<NodeOfSide> ends;
  ends.reserve(2 * sides_.size());
  for (Index s = 0; s < sides_.size(); ++s) {
    ends.push_back({sides_[s].from, s});
    ends.push_back({sides_[s].to, s});
  }
  std::ranges::sort(ends, {}, [](const NodeOfSide& end) { return std::tuple(end.node, end.side); });
  return ends;
}

void PreparedSides::make_components(const system::DisjointSets& sets) {
  components_.resize(sides_.size());
  std::vector<SpaceBox> boxes;
  for (Index s = 0; s < sides_.size(); ++s) {
    const Index first = sets[s];
    if (first == s) {
      components_[s] = static_cast<Index>(first_sides_.size());
      first_sides_.push_back(s);
      boxes.push_back(boxes_.box(s));
    } else {
      components_[s] = components_[first];
      boxes[components_[s]].include(boxes_.box(s));
    }
  }
  component_boxes_ = BoxTree(boxes, 1);
}

bool PreparedSides::is_on_side(Index node) const {
  const Point& place = points_[node];
  bool is_on = false;
  boxes_.visit(box_of(place, place), [&](Index s) {
    const PolygonSide& side = sides_[s];
    if (is_on) return;
    is_on = node == side.from || node == side.to ||
            (orientation(points_[side.from], points_[side.to], place) == Sign::zero &&
             is_between(points_[side.from], points_[side.to], place));
  });
  return is_on;
}

}  // namespace rondel::arrangement
