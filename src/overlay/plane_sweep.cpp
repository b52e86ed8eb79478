// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A line sweeps the plane from west to east (Shamos, Hoey 1976). It keeps the sides that it crosses
// in their order from south to north, and the state of the region above each side: which rings are
// around it.
//
//       \ above: in ring 0     The state above a side follows from the state below it, which is that above
//     ---*------------------   the next side to the south, and from the rings that have the side. Rings
//       / below: in no ring    around a place that do not fit to each other are a fault: two shells
//                              without a hole between them, or a hole without its shell.
//
// Only corners are events. When the sweep arrives at a corner, the sides on which it lies are
// divided there, and sides that coincide are merged. So the sides that are left either cross
// properly, which is found between neighbors, or meet only in corners.
#include "overlay/plane_sweep.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "exact/vector.h"
#include "overlay/plane.h"

namespace rondel::overlay {
namespace {

// The state of a place: the rings around it, in order, and whether it is inside of a polygon, that is
// in a shell and in none of its holes.
struct PlaneState {
  std::vector<Index> rings = {};
  bool is_inside = false;
};

// A side from a corner to one farther east (or north), both by their numbers.
struct SweptSide {
  Index west;
  Index east;
  std::vector<Index> rings;  // the rings that have the side, in order
  Index below = 0;           // the numbers of the states on both sides
  Index above = 0;
};

// Sweeps over the rings of one feature.
class PlaneSweep {
 public:
  explicit PlaneSweep(std::span<const map::LonLatRing> rings)
      : rings_(rings),
        has_sides_(rings.size(), false),
        states_(1),
        numbers_of_states_{{{}, 0}},
        active_(Southern{this}) {
    number_corners();
    add_sides();
  }

  // Returns the sides of the region, or the first fault.
  PlaneRegion operator()() {
    for (Index corner = 0; corner < corners_.size() && !fault_; ++corner) visit(corner);
    if (!fault_) find_lines();
    if (fault_) return {{}, fault_};
    return {std::move(found_), std::nullopt};
  }

 private:
  // Orders active sides, and a corner among them, from south to north.
  struct Southern {
    using is_transparent = void;
    const PlaneSweep* sweep;
    bool operator()(Index s, Index t) const { return sweep->is_south_of(s, t); }
    bool operator()(Index side, const LonLat& p) const {
      return sweep->side_of(side, p) == Sign::positive;
    }
    bool operator()(const LonLat& p, Index side) const {
      return sweep->side_of(side, p) == Sign::negative;
    }
  };
  using Active = std::set<Index, Southern>;

  // Numbers the different corners from west to east.
  void number_corners() {
    for (const map::LonLatRing& ring : rings_) {
      corners_.insert(corners_.end(), ring.positions.begin(), ring.positions.end());
    }
    std::ranges::sort(corners_, is_west_of);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    first_from_.assign(corners_.size(), no_index);
  }
  [[nodiscard]] Index number_of(const LonLat& p) const {
    return static_cast<Index>(std::ranges::lower_bound(corners_, p, is_west_of) - corners_.begin());
  }

  // Adds the sides of all rings, and assigns rings to polygons: each shell begins one.
  void add_sides() {
    Index part = no_index;
    for (Index r = 0; r < rings_.size(); ++r) {
      if (!rings_[r].is_hole || part == no_index) {
        ++part;
        first_ring_of_.push_back(r);
      }
      parts_.push_back(part);
      const std::vector<LonLat>& positions = rings_[r].positions;
      if (positions.empty() || rings_[r].is_left_out) continue;
      Index from = number_of(positions.back());
      for (const LonLat& position : positions) {
        const Index to = number_of(position);
        if (from != to) start(std::min(from, to), std::max(from, to), {r});
        from = to;
      }
    }
    has_area_.assign(first_ring_of_.size(), false);
  }

  // Adds a side that begins at the corner `west`.
  void start(Index west, Index east, std::vector<Index> rings) {
    const auto side = static_cast<Index>(sides_.size());
    sides_.push_back({west, east, std::move(rings)});
    next_from_.push_back(first_from_[west]);
    first_from_[west] = side;
  }

  // Returns positive if p is north of the line through a side.
  [[nodiscard]] Sign side_of(Index side, const LonLat& p) const {
    return side_of_line(corners_[sides_[side].west], corners_[sides_[side].east], p);
  }
  // True if active side s is south of active side t.
  [[nodiscard]] bool is_south_of(Index s, Index t) const {
    if (s == t) return false;
    const SweptSide& first = sides_[s];
    const SweptSide& second = sides_[t];
    if (first.west == second.west) return side_of(s, corners_[second.east]) == Sign::positive;
    if (first.west < second.west) return side_of(s, corners_[second.west]) == Sign::positive;
    return side_of(t, corners_[first.west]) == Sign::negative;
  }

  // Handles the event of a corner: ends the sides that meet it, and begins those that start there.
  void visit(Index corner) {
    const LonLat place = corners_[corner];
    const auto [first, last] = active_.equal_range(place);
    for (auto side = first; side != last; side = active_.erase(side)) end_side(*side, corner);
    std::vector<Index> begun = sides_from(corner);
    auto above = last;
    const auto below = above == active_.begin() ? active_.end() : std::prev(above);
    Index state = below == active_.end() ? 0 : sides_[*below].above;
    Index south = below == active_.end() ? no_index : *below;
    for (const Index side : begun) {
      sides_[side].below = state;
      if (!cross(side, state, place)) return;
      sides_[side].above = state;
      active_.insert(above, side);
    }
    if (begun.empty()) {
      if (above != active_.end()) require_apart(south, *above);
      return;
    }
    require_apart(south, begun.front());
    if (above != active_.end() && !fault_) require_apart(begun.back(), *above);
  }

  // Ends an active side at a corner. If the side goes on to the east, the rest of it begins there.
  void end_side(Index side, Index corner) {
    if (sides_[side].east != corner) {
      const Index east = std::exchange(sides_[side].east, corner);
      start(corner, east, sides_[side].rings);
    }
    const SweptSide& done = sides_[side];
    const bool is_inside = states_[done.above].is_inside;
    if (states_[done.below].is_inside == is_inside) return;
    const LonLat& west = corners_[done.west];
    const LonLat& east = corners_[done.east];
    found_.push_back(is_inside ? PlaneSide{west, east} : PlaneSide{east, west});
  }

  // Returns the sides that begin at a corner, from south to north, each once. Where two coincide,
  // the longer one is divided.
  std::vector<Index> sides_from(Index corner) {
    std::vector<Index> sides;
    for (Index s = first_from_[corner]; s != no_index; s = next_from_[s]) sides.push_back(s);
    std::ranges::sort(sides, [&](Index s, Index t) {
      const Sign side = side_of(s, corners_[sides_[t].east]);
      if (side != Sign::zero) return side == Sign::positive;
      return std::pair(sides_[s].east, s) < std::pair(sides_[t].east, t);
    });
    std::vector<Index> kept;
    for (const Index side : sides) {
      if (kept.empty() || side_of(kept.back(), corners_[sides_[side].east]) != Sign::zero) {
        kept.push_back(side);
        continue;
      }
      const std::vector<Index> rings = sides_[side].rings;
      const Index nearer = sides_[kept.back()].east;
      if (sides_[side].east != nearer) start(nearer, sides_[side].east, rings);
      for (const Index ring : rings) add_ring(sides_[kept.back()].rings, ring);
    }
    std::erase_if(kept, [&](Index side) { return sides_[side].rings.empty(); });
    for (const Index side : kept) {
      for (const Index ring : sides_[side].rings) has_sides_[ring] = true;
    }
    return kept;
  }
  // Adds a ring to those of a side. A side that a ring has twice cancels.
  static void add_ring(std::vector<Index>& rings, Index ring) {
    const auto same = std::ranges::lower_bound(rings, ring);
    if (same == rings.end() || *same != ring) {
      rings.insert(same, ring);
    } else {
      rings.erase(same);
    }
  }

  // Changes the state by going north across a side. Returns whether the rings around the place there
  // fit to each other.
  bool cross(Index side, Index& state, const LonLat& place) {
    const std::vector<Index>& crossed = sides_[side].rings;
    std::vector<Index> rings;
    std::ranges::set_symmetric_difference(states_[state].rings, crossed, std::back_inserter(rings));
    const auto [known, is_new] =
        numbers_of_states_.try_emplace(rings, static_cast<Index>(states_.size()));
    state = known->second;
    if (!is_new) return true;
    states_.push_back({std::move(rings), false});
    return take(states_.back(), crossed, place);
  }

  // Finds the polygon that a new state is inside of. Returns false, with a fault, if its rings do not
  // fit to each other.
  bool take(PlaneState& state, const std::vector<Index>& crossed, const LonLat& place) {
    const auto refuse = [&](PlaneFaultKind kind, Index first, Index second) {
      fault_ = PlaneFault{kind, first, second, place};
      return false;
    };
    Index shell = no_index;  // of the polygon that has the place inside
    for (auto ring = state.rings.begin(); ring != state.rings.end();) {
      const auto end = std::find_if(ring, state.rings.end(),
                                    [&](Index r) { return parts_[r] != parts_[*ring]; });
      if (rings_[*ring].is_hole) {
        return refuse(PlaneFaultKind::outside, other_than(state, *ring), *ring);
      }
      if (end - ring > 2) {
        const bool is_second_new = std::ranges::binary_search(crossed, ring[2]);
        return refuse(PlaneFaultKind::outside, ring[is_second_new ? 1 : 2],
                      ring[is_second_new ? 2 : 1]);
      }
      if (end - ring == 1) {
        if (shell != no_index) {
          const bool is_second_new = std::ranges::binary_search(crossed, *ring);
          return refuse(PlaneFaultKind::overlap, is_second_new ? shell : *ring,
                        is_second_new ? *ring : shell);
        }
        shell = *ring;
      }
      ring = end;
    }
    state.is_inside = shell != no_index;
    if (state.is_inside) has_area_[parts_[shell]] = true;
    return true;
  }
  // Returns a ring of another polygon around the place, or no_index.
  [[nodiscard]] Index other_than(const PlaneState& state, Index hole) const {
    Index other = no_index;
    for (const Index ring : state.rings) {
      if (parts_[ring] != parts_[hole]) other = ring;
    }
    return other;
  }

  // Records a fault if two neighboring sides, s south of t, cross.
  void require_apart(Index s, Index t) {
    if (s == no_index) return;
    const LonLat &a = corners_[sides_[s].west], &b = corners_[sides_[s].east];
    const LonLat &c = corners_[sides_[t].west], &d = corners_[sides_[t].east];
    if (side_of_line(a, b, c) * side_of_line(a, b, d) != Sign::negative ||
        side_of_line(c, d, a) * side_of_line(c, d, b) != Sign::negative) {
      return;
    }
    const double along = b.lon_deg - a.lon_deg;
    const double up = b.lat_deg - a.lat_deg;
    const double before = along * (c.lat_deg - a.lat_deg) - up * (c.lon_deg - a.lon_deg);
    const double after = along * (d.lat_deg - a.lat_deg) - up * (d.lon_deg - a.lon_deg);
    const double t_of_place = before == after ? 0.5 : before / (before - after);
    const LonLat place = {c.lon_deg + t_of_place * (d.lon_deg - c.lon_deg),
                          c.lat_deg + t_of_place * (d.lat_deg - c.lat_deg)};
    const auto [first, second] = std::minmax(sides_[s].rings.front(), sides_[t].rings.front());
    fault_ = PlaneFault{PlaneFaultKind::crossing, first, second, place};
  }

  // Records a fault if all sides of a ring have cancelled.
  void find_lines() {
    for (Index r = 0; r < rings_.size() && !fault_; ++r) {
      if (has_sides_[r] || rings_[r].is_left_out) continue;
      const std::vector<LonLat>& positions = rings_[r].positions;
      fault_ = PlaneFault{PlaneFaultKind::no_area, r, r,
                          positions.empty() ? LonLat{} : positions.front()};
    }
    for (std::size_t part = 0; part < has_area_.size() && !fault_; ++part) {
      const Index shell = first_ring_of_[part];
      if (has_area_[part] || rings_[shell].is_left_out) continue;
      fault_ = PlaneFault{PlaneFaultKind::filled, shell, shell, rings_[shell].positions.front()};
    }
  }

  std::span<const map::LonLatRing> rings_;
  std::vector<Index> parts_;          // for each ring the number of its polygon
  std::vector<bool> has_sides_;       // true for each ring that has sides left
  std::vector<Index> first_ring_of_;  // for each polygon its shell
  std::vector<bool> has_area_;        // true for each polygon that has an inside
  std::vector<PlaneState> states_;    // the first one is outside of all rings
  std::map<std::vector<Index>, Index> numbers_of_states_;  // by the rings
  std::vector<LonLat> corners_;
  std::vector<SweptSide> sides_;
  std::vector<Index> first_from_;  // for each corner a side that begins there
  std::vector<Index> next_from_;   // for each side another one with the same beginning
  Active active_;
  std::vector<PlaneSide> found_;
  std::optional<PlaneFault> fault_;
};

}  // namespace

PlaneRegion sweep_rings(std::span<const map::LonLatRing> rings) { return PlaneSweep(rings)(); }

}  // namespace rondel::overlay
