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
// A state is the set of the rings around a place, by its number.
//
// Only corners are events. Where a side ends at a corner, the sides at the corner are its neighbors;
// elsewhere they are searched for.  When the sweep arrives at a corner, the sides on which it lies are
// divided there, and sides that coincide are merged. So the sides that are left either cross
// properly, which is found between neighbors, or meet only in corners.
#include "overlay/plane_sweep.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>

#include "exact/vector.h"
#include "overlay/plane.h"
#include "overlay/ring_sets.h"

namespace rondel::overlay {
namespace {

// A side from a corner to one farther east (or north), both by their numbers.
struct SweptSide {
  Index west;
  Index east;
  Index rings;      // the set of rings that have the side
  Index below = 0;  // the states on both sides
  Index above = 0;
};

// Sweeps over the rings of one feature.
class PlaneSweep {
 public:
  explicit PlaneSweep(std::span<const map::LonLatRing> rings)
      : rings_(rings),
        has_sides_(rings.size(), false),
        sets_(rings.size()),
        kinds_(sets_.size(), PlaceKind::unknown),
        active_(Southern{this}) {
    kinds_[sets_.empty()] = PlaceKind::outside;
    add_sides(numbered_corners());
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
  // Whether a place is inside of a polygon, that is in a shell and in none of its holes.
  enum class PlaceKind : std::uint8_t { unknown, outside, inside };

  // Numbers the different corners from west to east. Returns the numbers of the positions of all
  // rings.
  std::vector<Index> numbered_corners() {
    struct CornerOnMap {
      LonLat position;
      Index place;
    };
    std::size_t size = 0;
    for (const map::LonLatRing& ring : rings_) size += ring.positions.size();
    std::vector<CornerOnMap> sorted;
    sorted.reserve(size);
    for (const map::LonLatRing& ring : rings_) {
      for (const LonLat& p : ring.positions)
        sorted.push_back({p, static_cast<Index>(sorted.size())});
    }
    std::ranges::sort(sorted, IsWestOf{}, &CornerOnMap::position);
    std::vector<Index> numbers(sorted.size());
    for (const CornerOnMap& corner : sorted) {
      if (corners_.empty() || !(corners_.back() == corner.position)) {
        corners_.push_back(corner.position);
      }
      numbers[corner.place] = static_cast<Index>(corners_.size() - 1);
    }
    first_from_.assign(corners_.size(), no_index);
    last_to_.assign(corners_.size(), no_index);
    return numbers;
  }

  // Adds the sides of all rings, and assigns rings to polygons: each shell begins one.
  void add_sides(std::span<const Index> numbers) {
    sides_.reserve(numbers.size());
    next_from_.reserve(numbers.size());
    Index part = no_index;
    for (Index r = 0; r < rings_.size(); ++r) {
      if (!rings_[r].is_hole || part == no_index) {
        ++part;
        first_ring_of_.push_back(r);
      }
      parts_.push_back(part);
      const std::span<const Index> ring = numbers.first(rings_[r].positions.size());
      numbers = numbers.subspan(ring.size());
      if (ring.empty() || rings_[r].is_left_out) continue;
      Index from = ring.back();
      for (const Index to : ring) {
        if (from != to) start(std::min(from, to), std::max(from, to), r);
        from = to;
      }
    }
    places_.resize(sides_.size(), active_.end());
    has_area_.assign(first_ring_of_.size(), false);
  }

  // Adds a side that begins at the corner `west`.
  void start(Index west, Index east, Index rings) {
    const auto side = static_cast<Index>(sides_.size());
    sides_.push_back({west, east, rings, 0, 0});
    next_from_.push_back(first_from_[west]);
    first_from_[west] = side;
    last_to_[east] = side;
  }
  // Takes a side among the active ones, in front of another one.
  void activate(Active::iterator above, Index side) {
    if (places_.size() < sides_.size()) places_.resize(sides_.size(), active_.end());
    if (unused_.empty()) {
      places_[side] = active_.insert(above, side);
      return;
    }
    unused_.back().value() = side;
    places_[side] = active_.insert(above, std::move(unused_.back()));
    unused_.pop_back();
  }
  // Ends active sides, and keeps their memory for others.
  void deactivate(Active::iterator first, Active::iterator last) {
    while (first != last) {
      const auto next = std::next(first);
      places_[*first] = active_.end();
      unused_.push_back(active_.extract(first));
      first = next;
    }
  }
  // Returns the active sides on which a corner lies, from south to north, or where they would be.
  [[nodiscard]] std::pair<Active::iterator, Active::iterator> sides_at(Index corner) const {
    const LonLat& place = corners_[corner];
    const Index known = last_to_[corner];
    const bool is_active =
        known != no_index && known < places_.size() && places_[known] != active_.end();
    if (!is_active) return active_.equal_range(place);
    auto first = places_[known];
    auto last = std::next(first);
    while (first != active_.begin() && side_of(*std::prev(first), place) == Sign::zero) --first;
    while (last != active_.end() && side_of(*last, place) == Sign::zero) ++last;
    return {first, last};
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
    const auto [first, last] = sides_at(corner);
    for (auto side = first; side != last; ++side) end_side(*side, corner);
    deactivate(first, last);
    const std::vector<Index>& begun = sides_from(corner);
    const auto above = last;
    const auto below = above == active_.begin() ? active_.end() : std::prev(above);
    Index state = below == active_.end() ? sets_.empty() : sides_[*below].above;
    const Index south = below == active_.end() ? no_index : *below;
    for (const Index side : begun) {
      sides_[side].below = state;
      if (!cross(side, state, place)) return;
      sides_[side].above = state;
      activate(above, side);
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
    const bool is_inside = kinds_[done.above] == PlaceKind::inside;
    if ((kinds_[done.below] == PlaceKind::inside) == is_inside) return;
    const LonLat& west = corners_[done.west];
    const LonLat& east = corners_[done.east];
    found_.push_back(is_inside ? PlaneSide{west, east} : PlaneSide{east, west});
  }

  // Returns the sides that begin at a corner, from south to north, each once. Where two coincide,
  // the longer one is divided.
  const std::vector<Index>& sides_from(Index corner) {
    beginning_.clear();
    kept_.clear();
    for (Index s = first_from_[corner]; s != no_index; s = next_from_[s]) beginning_.push_back(s);
    std::ranges::sort(beginning_, [&](Index s, Index t) {
      const Sign side = side_of(s, corners_[sides_[t].east]);
      if (side != Sign::zero) return side == Sign::positive;
      return std::pair(sides_[s].east, s) < std::pair(sides_[t].east, t);
    });
    for (const Index side : beginning_) {
      if (kept_.empty() || side_of(kept_.back(), corners_[sides_[side].east]) != Sign::zero) {
        kept_.push_back(side);
        continue;
      }
      const Index rings = sides_[side].rings;
      SweptSide& nearer = sides_[kept_.back()];
      nearer.rings = sets_.symmetric_difference(nearer.rings, rings);
      // This may move all sides.
      const Index middle = nearer.east;
      if (sides_[side].east != middle) start(middle, sides_[side].east, rings);
    }
    // Sides that a ring has twice have cancelled.
    std::erase_if(kept_, [&](Index side) { return sides_[side].rings == sets_.empty(); });
    for (const Index side : kept_) {
      for (const Index ring : sets_[sides_[side].rings]) has_sides_[ring] = true;
    }
    return kept_;
  }

  // Changes the state by going north across a side. Returns whether the rings around the place there
  // fit to each other.
  bool cross(Index side, Index& state, const LonLat& place) {
    const Index crossed = sides_[side].rings;
    state = sets_.symmetric_difference(state, crossed);
    if (kinds_.size() < sets_.size()) kinds_.resize(sets_.size(), PlaceKind::unknown);
    return kinds_[state] != PlaceKind::unknown || take(state, sets_[crossed], place);
  }

  // Finds the polygon that a new state is inside of. Returns false, with a fault, if its rings do not
  // fit to each other.
  bool take(Index state, std::span<const Index> crossed, const LonLat& place) {
    const auto refuse = [&](PlaneFaultKind kind, Index first, Index second) {
      fault_ = PlaneFault{kind, first, second, place};
      return false;
    };
    const std::span<const Index> rings = sets_[state];
    Index shell = no_index;  // of the polygon that has the place inside
    for (auto ring = rings.begin(); ring != rings.end();) {
      const auto end =
          std::find_if(ring, rings.end(), [&](Index r) { return parts_[r] != parts_[*ring]; });
      if (rings_[*ring].is_hole) {
        return refuse(PlaneFaultKind::outside, other_than(rings, *ring), *ring);
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
    kinds_[state] = shell != no_index ? PlaceKind::inside : PlaceKind::outside;
    if (shell != no_index) has_area_[parts_[shell]] = true;
    return true;
  }
  // Returns a ring of another polygon around the place, or no_index.
  [[nodiscard]] Index other_than(std::span<const Index> rings, Index hole) const {
    Index other = no_index;
    for (const Index ring : rings) {
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
    const auto [first, second] =
        std::minmax(sets_[sides_[s].rings].front(), sets_[sides_[t].rings].front());
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
  RingSets sets_;
  std::vector<PlaceKind> kinds_;  // of each set
  std::vector<LonLat> corners_;
  std::vector<SweptSide> sides_;
  std::vector<Index> first_from_;  // for each corner a side that begins there
  std::vector<Index> next_from_;   // for each side another one with the same beginning
  std::vector<Index> last_to_;     // for each corner the last side that was to end there
  Active active_;
  std::vector<Active::iterator> places_;   // of the active sides; the end of them for others
  std::vector<Active::node_type> unused_;  // the memory of active sides that have ended
  std::vector<Index> beginning_;           // of a corner: the sides that begin there
  std::vector<Index> kept_;                // those of them that are left
  std::vector<PlaneSide> found_;
  std::optional<PlaneFault> fault_;
};

}  // namespace

PlaneRegion sweep_rings(std::span<const map::LonLatRing> rings) { return PlaneSweep(rings)(); }

}  // namespace rondel::overlay
