// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A line sweeps the plane from west to east (Shamos, Hoey 1976). It keeps the sides that it crosses
// in their order from south to north, and the state of the region above each side: inside of a
// polygon, or outside and in a hole or in none.
//
//       \ above: in polygon 0       The state above a side follows from the state below it, which is that above
//     ---*------------------        the next side to the south, and from the side's ring. A side that does not
//       / below: outside            fit to the state below is a fault: a shell in another polygon, or a hole
//                                   outside of its shell.
//
// Only corners are events. When the sweep arrives at a corner, the sides on which it lies are
// divided there, and sides that coincide are merged. So the sides that are left either cross
// properly, which is found between neighbors, or meet only in corners.
#include "overlay/plane_sweep.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "exact/vector.h"
#include "overlay/plane.h"

namespace rondel::overlay {
namespace {

// The state of a place: inside of the polygon `number`, or outside, in the hole whose ring is
// `number`, or in no hole (no_index).
struct PlaneState {
  bool is_inside = false;
  Index number = no_index;
  friend bool operator==(const PlaneState&, const PlaneState&) = default;
};

// A side from a corner to one farther east (or north), both by their numbers.
struct SweptSide {
  Index west;
  Index east;
  std::vector<Index> rings;  // the rings that have the side, of different polygons
  PlaneState below{};
  PlaneState above{};
};

// Sweeps over the rings of one feature.
class PlaneSweep {
 public:
  explicit PlaneSweep(std::span<const io::LonLatRing> rings)
      : rings_(rings), has_sides_(rings.size(), false), active_(Southern{this}) {
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
    for (const io::LonLatRing& ring : rings_) {
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
      if (!rings_[r].is_hole || part == no_index) ++part;
      parts_.push_back(part);
      const std::vector<LonLat>& positions = rings_[r].positions;
      if (positions.empty()) continue;
      Index from = number_of(positions.back());
      for (const LonLat& position : positions) {
        const Index to = number_of(position);
        if (from != to) start(std::min(from, to), std::max(from, to), {r});
        from = to;
      }
    }
    around_.assign(part == no_index ? 0 : part + std::size_t{1}, std::nullopt);
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
    PlaneState state = below == active_.end() ? PlaneState{} : sides_[*below].above;
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
    if (done.below.is_inside == done.above.is_inside) return;
    const LonLat& west = corners_[done.west];
    const LonLat& east = corners_[done.east];
    found_.push_back(done.above.is_inside ? PlaneSide{west, east} : PlaneSide{east, west});
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
  // Adds a ring to those of a side. Two rings of one polygon cancel.
  void add_ring(std::vector<Index>& rings, Index ring) const {
    const auto same =
        std::ranges::find_if(rings, [&](Index r) { return parts_[r] == parts_[ring]; });
    if (same == rings.end()) {
      rings.push_back(ring);
    } else {
      rings.erase(same);
    }
  }

  // Changes the state by going north across a side. Returns whether the side fits to the state
  // south of it.
  bool cross(Index side, PlaneState& state, const LonLat& place) {
    std::vector<Index> rings = sides_[side].rings;
    // The rings whose inside the sweep leaves come first.
    const auto is_left = [&](Index r) {
      return state == (rings_[r].is_hole ? PlaneState{false, r} : PlaneState{true, parts_[r]}) ||
             (rings_[r].is_hole && state == PlaneState{true, parts_[r]});
    };
    std::stable_partition(rings.begin(), rings.end(), is_left);
    for (const Index ring : rings) {
      if (!cross_ring(ring, state, place)) return false;
    }
    return true;
  }
  // Changes the state by crossing a side of one ring. Returns false, with a fault, if the ring does
  // not fit there.
  bool cross_ring(Index ring, PlaneState& state, const LonLat& place) {
    const PlaneState own = {true, parts_[ring]};
    if (rings_[ring].is_hole) {
      const PlaneState hole = {false, ring};
      if (state != own && state != hole) return refuse(PlaneFaultKind::outside, state, ring, place);
      state = state == own ? hole : own;
      return true;
    }
    if (state == own) {
      state = *around_[parts_[ring]];
      return true;
    }
    if (state.is_inside) return refuse(PlaneFaultKind::overlap, state, ring, place);
    if (state.number != no_index && parts_[state.number] == parts_[ring]) {
      return refuse(PlaneFaultKind::outside, {}, state.number, place);
    }
    around_[parts_[ring]] = state;
    state = own;
    return true;
  }
  // Records a fault of a ring in a region with this state; returns false.
  bool refuse(PlaneFaultKind kind, const PlaneState& state, Index ring, const LonLat& place) {
    Index other = state.number;
    if (state.is_inside) other = first_ring_of(state.number);
    fault_ = PlaneFault{kind, other, ring, place};
    return false;
  }
  [[nodiscard]] Index first_ring_of(Index part) const {
    return static_cast<Index>(std::ranges::find(parts_, part) - parts_.begin());
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
      if (has_sides_[r]) continue;
      const std::vector<LonLat>& positions = rings_[r].positions;
      fault_ = PlaneFault{PlaneFaultKind::no_area, r, r,
                          positions.empty() ? LonLat{} : positions.front()};
    }
  }

  std::span<const io::LonLatRing> rings_;
  std::vector<Index> parts_;                       // for each ring the number of its polygon
  std::vector<bool> has_sides_;                    // true for each ring that has sides left
  std::vector<std::optional<PlaneState>> around_;  // for each polygon the state around it
  std::vector<LonLat> corners_;
  std::vector<SweptSide> sides_;
  std::vector<Index> first_from_;  // for each corner a side that begins there
  std::vector<Index> next_from_;   // for each side another one with the same beginning
  Active active_;
  std::vector<PlaneSide> found_;
  std::optional<PlaneFault> fault_;
};

}  // namespace

PlaneRegion sweep_rings(std::span<const io::LonLatRing> rings) { return PlaneSweep(rings)(); }

}  // namespace rondel::overlay
