// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "arrangement/pair_meetings.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "arrangement/directions.h"
#include "arrangement/prepared_polygon.h"
#include "arrangement/side_meeting.h"

namespace rondel::arrangement {

// Asks the part with more sides for the sides near to those of the other one.
void PairMeetings::find(const PreparedSides& first, const PreparedSides& second) {
  parts_ = {&first, &second};
  incidences_.clear();
  overlaps_.clear();
  has_crossings_ = false;
  if (!first.extent().overlaps(second.extent())) return;
  const Index few = first.sides().size() <= second.sides().size() ? 0 : 1;
  const PreparedSides& one = *parts_[few];
  const PreparedSides& other = *parts_[1 - few];
  one.boxes().visit(other.extent(), [&](Index s) {
    other.boxes().visit(one.boxes().box(s), [&](Index t) { meet(few, s, t); });
  });
  std::ranges::sort(incidences_);
  incidences_.erase(std::unique(incidences_.begin(), incidences_.end()), incidences_.end());
}

// Looks at side s of part k and side t of the other one.
void PairMeetings::meet(Index k, Index s, Index t) {
  const PolygonSide& one = parts_[k]->sides()[s];
  const PolygonSide& other = parts_[1 - k]->sides()[t];
  const SideMeeting meeting = meeting_of(points_, one.from, one.to, other.from, other.to);
  has_crossings_ = has_crossings_ || meeting.is_crossing;
  for (std::size_t m = 0; m < meeting.num_nodes; ++m) {
    incidences_.push_back({meeting.nodes[m], k, s});
    incidences_.push_back({meeting.nodes[m], 1 - k, t});
  }
  if (meeting.num_nodes < 2) return;
  overlaps_.push_back({k == 0 ? std::array{s, t} : std::array{t, s}, meeting.nodes});
}

// The stretches of a side are between its nodes and do not overlap, as sides of one part do not. So
// they cover the side if each begins where the one before it ends.
bool PairMeetings::is_covered(std::size_t k) {
  const std::span<const PolygonSide> sides = parts_[k]->sides();
  const auto is_before = [&](const PolygonSide& side, Index p, Index q) {
    if (p == q || q == side.from || p == side.to) return false;
    if (p == side.from || q == side.to) return true;
    return is_between(points_[side.from], points_[q], points_[p]);
  };
  for (Stretch& overlap : overlaps_) {
    const PolygonSide& side = sides[overlap.sides[k]];
    if (is_before(side, overlap.nodes[1], overlap.nodes[0])) {
      std::swap(overlap.nodes[0], overlap.nodes[1]);
    }
  }
  std::ranges::sort(overlaps_, [&](const Stretch& a, const Stretch& b) {
    if (a.sides[k] != b.sides[k]) return a.sides[k] < b.sides[k];
    return is_before(sides[a.sides[k]], a.nodes[0], b.nodes[0]);
  });
  std::size_t next = 0;
  for (Index s = 0; s < sides.size(); ++s) {
    Index reached = sides[s].from;
    for (; next < overlaps_.size() && overlaps_[next].sides[k] == s; ++next) {
      if (overlaps_[next].nodes[0] == reached) reached = overlaps_[next].nodes[1];
    }
    if (reached != sides[s].to) return false;
  }
  return true;
}

std::span<const Index> PairMeetings::met_components(std::size_t k) {
  met_.clear();
  for (const Incidence& i : incidences_) {
    if (i.part == k) met_.push_back(parts_[k]->component(i.side));
  }
  std::ranges::sort(met_);
  met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
  return met_;
}

SidePlace place_of_side(std::span<const Point> points, Index node, const SideDirection& direction,
                        std::span<const SideDirection> of_polygon) {
  const auto same = std::ranges::find(of_polygon, direction.target, &SideDirection::target);
  const Point& target = points[direction.target];
  const SideDirection& before =
      same != of_polygon.end() ? *same : direction_before(points, node, target, of_polygon, true);
  if (same != of_polygon.end() || part_of_turn(points[node], target, points[before.target]) == 0) {
    return before.is_out == direction.is_out ? SidePlace::along : SidePlace::against;
  }
  return before.is_out ? SidePlace::inside : SidePlace::outside;
}

}  // namespace rondel::arrangement
