// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which places a polygon has is found along a path (directions.h) to one of its nodes: the sector
// in which the path ends is known from the sides there, and each side that is crossed changes it.
#include "arrangement/prepared_polygon.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "arrangement/arc_contacts.h"
#include "arrangement/directions.h"
#include "arrangement/side_meeting.h"
#include "arrangement/sided_arc.h"
#include "exact/vector.h"
#include "rondel/predicates.h"
#include "system/disjoint_sets.h"

namespace rondel::arrangement {
namespace {

bool are_opposite_sites(const Point& p, const Point& q) {
  return dot(p, q) < 0 && is_same_site(p, -1.0 * q);
}

// True if sides run from and to a node in turn, so that they agree on its sectors.
bool do_alternate(std::span<const Point> points, Index node,
                  std::vector<SideDirection>& directions) {
  const Point& reference = points[directions[0].target];
  std::sort(directions.begin() + 1, directions.end(),
            [&](const SideDirection& a, const SideDirection& b) {
              return compare_directions(points[node], reference, points[a.target],
                                        points[b.target]) < 0;
            });
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (directions[k].is_out == directions[(k + 1) % directions.size()].is_out) return false;
  }
  return true;
}

}  // namespace

const SideDirection& direction_before(std::span<const Point> points, Index node,
                                      const Point& target,
                                      std::span<const SideDirection> directions,
                                      bool is_along_before) {
  const SideDirection* last = nullptr;
  for (const SideDirection& direction : directions) {
    const Point& end = points[direction.target];
    if (part_of_turn(points[node], target, end) == 0) {
      if (is_along_before) return direction;
    } else if (last == nullptr ||
               compare_directions(points[node], target, points[last->target], end) < 0) {
      last = &direction;
    }
  }
  return *last;
}

PreparedPolygon::PreparedPolygon(const CellRings& cells, std::size_t cell,
                                 std::span<const Point> points, std::span<const Index> numbers)
    : PreparedSides(points), is_whole_(cells.is_whole(cell)) {
  if (is_whole_) extent_ = whole_box;
  if (cells.rings[cells.cells[cell]] == cells.rings[cells.cells[cell + 1]]) return;
  append_sides(cells, cell, numbers);
  make_boxes();
  if (divide_sides(true)) fault_ = PolygonFault::crossing_sides;
  if (fault_ == PolygonFault::none) cancel_sides();
  if (fault_ == PolygonFault::none) find_components();
  if (fault_ == PolygonFault::none && !do_components_agree()) {
    fault_ = PolygonFault::disagreeing_sides;
  }
  if (fault_ == PolygonFault::none && (is_whole_ || sides_.empty())) {
    fault_ = PolygonFault::no_sides;
  }
  if (fault_ == PolygonFault::none) {
    find_extent();
  } else {
    sides_.clear();
  }
}

// Rings are sorted by their lowest nodes, so that neighbors in the trees are close to each other.
void PreparedPolygon::append_sides(const CellRings& cells, std::size_t cell,
                                   std::span<const Index> numbers) {
  std::vector<std::vector<Index>> rings;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    const std::span<const Index> corners = cells.corners_of(r);
    if (corners.empty()) continue;
    std::vector<Index>& nodes = rings.emplace_back();
    nodes.reserve(corners.size());
    for (const Index corner : corners) nodes.push_back(numbers[corner]);
  }
  std::ranges::sort(rings, {},
                    [](const std::vector<Index>& ring) { return *std::ranges::min_element(ring); });
  for (const std::vector<Index>& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const PolygonSide side = {ring[k], ring[k + 1 == ring.size() ? 0 : k + 1]};
      if (side.from != side.to) sides_.push_back(side);
    }
  }
}

// Leaves out sides that lead back and forth between two nodes.
void PreparedPolygon::cancel_sides() {
  struct SideBetween {
    std::pair<Index, Index> nodes;  // the lower one first
    Index side;
  };
  std::vector<SideBetween> places;
  places.reserve(sides_.size());
  for (Index s = 0; s < sides_.size(); ++s) {
    places.push_back({std::minmax({sides_[s].from, sides_[s].to}), s});
  }
  std::ranges::sort(places, {}, [](const SideBetween& s) { return std::tuple(s.nodes, s.side); });
  std::vector<Index> kept;
  for (std::size_t begin = 0; begin < places.size();) {
    std::size_t end = begin;
    int sum = 0;
    for (; end < places.size() && places[end].nodes == places[begin].nodes; ++end) {
      sum += sides_[places[end].side].from == places[begin].nodes.first ? 1 : -1;
    }
    if (sum > 1 || sum < -1) fault_ = PolygonFault::disagreeing_sides;
    if (sum != 0) {
      const auto [low, high] = places[begin].nodes;
      kept.push_back(places[begin].side);
      sides_[kept.back()] = sum > 0 ? PolygonSide{low, high} : PolygonSide{high, low};
    }
    begin = end;
  }
  if (kept.size() == sides_.size()) return;
  std::ranges::sort(kept);
  keep_sides(kept);
}

void PreparedPolygon::find_components() {
  const std::vector<NodeOfSide> ends = sorted_ends();
  system::DisjointSets sets(sides_.size());
  std::vector<SideDirection> directions;
  for (std::size_t begin = 0; begin < ends.size();) {
    const Index node = ends[begin].node;
    directions.clear();
    std::size_t end = begin;
    for (; end < ends.size() && ends[end].node == node; ++end) {
      const PolygonSide& side = sides_[ends[end].side];
      const bool is_out = side.from == node;
      directions.push_back({is_out ? side.to : side.from, is_out});
      sets.join(ends[begin].side, ends[end].side);
    }
    if (directions.size() > 2 && !do_alternate(points_, node, directions)) {
      fault_ = PolygonFault::disagreeing_sides;
    }
    begin = end;
  }
  make_components(sets);
}

PreparedPolygon::Path PreparedPolygon::path(const Point& from, Index start, Index end) const {
  Path result;
  const SidedArc way(from, points_[end]);
  boxes_.visit(box_of(from, points_[end]), [&](Index s) {
    const PolygonSide& side = sides_[s];
    // Doubles show that most sides do not come near.
    const int of_from = way.side(points_[side.from]);
    if (of_from != 0 && of_from == way.side(points_[side.to])) return;
    bool has_end = false;
    const auto look_at = [&](Index node, std::vector<SideDirection>& directions) {
      if (side.from != node && side.to != node) return;
      directions.push_back({side.from == node ? side.to : side.from, side.from == node});
      has_end = true;
    };
    look_at(start, result.at_start);
    look_at(end, result.at_end);
    if (!has_end && is_path_crossed(points_[side.from], points_[side.to], from, points_[end])) {
      result.is_odd = !result.is_odd;
    }
  });
  return result;
}

// Looks along a path from each component to the next one.
bool PreparedPolygon::do_components_agree() const {
  for (Index k = 1; k < num_components(); ++k) {
    const Index start = side_of(k - 1).from;
    const PolygonSide& side = side_of(k);
    const Point& from = points_[start];
    const Index end = are_opposite_sites(from, points_[side.from]) ? side.to : side.from;
    const Path between = path(from, start, end);
    const bool is_in_at_start =
        direction_before(points_, start, points_[end], between.at_start, false).is_out;
    const bool is_in_at_end = direction_before(points_, end, from, between.at_end, true).is_out;
    if ((is_in_at_start != is_in_at_end) != between.is_odd) return false;
  }
  return true;
}

bool PreparedPolygon::has(const Point& place) const {
  if (sides_.empty()) return is_whole_;
  const PolygonSide& side = sides_[boxes_.near({place.x, place.y, place.z})];
  const Index end = are_opposite_sites(place, points_[side.from]) ? side.to : side.from;
  const Path way = path(place, no_index, end);
  return direction_before(points_, end, place, way.at_end, true).is_out != way.is_odd;
}

// A coordinate is largest on a side, or at the end of its axis. Ends of axes that are outside of a
// ball around all sides are in one face.
void PreparedPolygon::find_extent() {
  SpaceBox border = empty_box;
  for (std::size_t c = 0; c < num_components(); ++c) {
    border.include(component_boxes().box(static_cast<Index>(c)));
  }
  extent_ = border;
  const Point low = {border.low[0], border.low[1], border.low[2]};
  const Point high = {border.high[0], border.high[1], border.high[2]};
  const Point middle = 0.5 * (low + high);
  constexpr double rounding = 1e-9;
  const double radius = norm(high - middle) + rounding;
  std::optional<bool> has_far_ends;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double end : {-1.0, 1.0}) {
      if (border.low[i] <= end && end <= border.high[i]) continue;
      std::array<double, 3> place = {0, 0, 0};
      place[i] = end;
      const Point axis_end = {place[0], place[1], place[2]};
      const bool is_far = norm(axis_end - middle) > radius;
      const bool is_inside = is_far && has_far_ends ? *has_far_ends : has(axis_end);
      if (is_far) has_far_ends = is_inside;
      if (is_inside) extent_.include({place, place});
    }
  }
}

}  // namespace rondel::arrangement
