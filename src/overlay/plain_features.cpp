// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Most features are valid, and most of these at first sight: rings that do not touch, the holes
// inside of their shells. This needs neither the arcs of all rings in order nor areas of cells.
//
// Rings that do not touch agree on what is inside if each shell is in an even number of other rings,
// and each hole in an odd one. For rings that span less than 180 degrees of longitude and have no
// pole, one is in another one if the meridian from one of its corners to the pole crosses an odd
// number of the other's sides.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "exact/vector.h"
#include "map/ring_area.h"
#include "overlay/border_rings.h"
#include "overlay/feature_polygons.h"
#include "overlay/overlaps.h"
#include "rondel/predicates.h"

namespace rondel::overlay {
namespace {

constexpr double far_above_rounding = 1e-10;  // steradians: that of areas is far less

// The sides of a feature's rings: side k leads from corner k to corner next[k].
struct FeatureSides {
  std::vector<Point> corners;
  std::vector<Index> next;

  void append(std::span<const Point> ring) {
    const auto first = static_cast<Index>(corners.size());
    corners.insert(corners.end(), ring.begin(), ring.end());
    for (auto k = first + 1; k < corners.size(); ++k) next.push_back(k);
    next.push_back(first);
  }
  [[nodiscard]] const Point& from(Index side) const { return corners[side]; }
  [[nodiscard]] const Point& to(Index side) const { return corners[next[side]]; }

  // True if side t begins where side s ends, and leads away from its great circle.
  [[nodiscard]] bool turns_into(Index s, Index t) const {
    return next[s] == t && orientation(from(s), to(s), to(t)) != Sign::zero;
  }
  // True if both ends of side t are on one side of the great circle of side s.
  [[nodiscard]] bool has_on_one_side(Index s, Index t) const {
    const Sign first = orientation(from(s), to(s), from(t));
    return first != Sign::zero && first == orientation(from(s), to(s), to(t));
  }
  // True if two sides have no place in common, or only the corner between them.
  [[nodiscard]] bool are_surely_apart(Index s, Index t) const {
    if (next[s] == t || next[t] == s) return turns_into(s, t) || turns_into(t, s);
    return has_on_one_side(s, t) || has_on_one_side(t, s);
  }
};

// True if the sides meet in the corners between consecutive sides alone.
bool are_plain(const FeatureSides& sides) {
  const arrangement::BoxTree tree(
      sides.corners.size(),
      [&](std::size_t k) {
        const auto side = static_cast<Index>(k);
        return arrangement::box_of(sides.from(side), sides.to(side));
      },
      1);
  bool are_apart = true;
  for (std::size_t block = 0; block < tree.num_blocks() && are_apart; ++block) {
    tree.visit_pairs(
        block, [&](Index s, Index t) { are_apart = are_apart && sides.are_surely_apart(s, t); });
  }
  return are_apart;
}

// A ring in longitude and latitude, for questions that need no arcs.
class RingOnMap {
 public:
  // The corners of the ring, with the positions of the file. A ring with an area may be asked.
  RingOnMap(std::span<const LonLat> positions, std::span<const Point> corners, double area)
      : positions_(positions), corners_(corners) {
    constexpr double near_pole = 89;
    double longest = std::abs(positions.back().lon_deg - positions.front().lon_deg);
    west_ = east_ = positions.front().lon_deg;
    double highest = 0;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const LonLat& p = positions[k];
      if (k > 0) longest = std::max(longest, std::abs(p.lon_deg - positions[k - 1].lon_deg));
      west_ = std::min(west_, p.lon_deg);
      east_ = std::max(east_, p.lon_deg);
      highest = std::max(highest, std::abs(p.lat_deg));
    }
    constexpr double farthest = 3600;  // so that rounding of longitudes is below the margin
    is_simple_ = longest < widest && east_ - west_ < widest && highest < near_pole &&
                 std::max(-west_, east_) < farthest && std::abs(area) > far_above_rounding;
  }

  // False for a ring that may be around a pole, or whose direction rounding may have changed.
  [[nodiscard]] bool is_simple() const { return is_simple_; }

  // True if another ring, which does not touch this one, is on the side of it that has no pole;
  // nothing if that is not sure. Both are simple.
  [[nodiscard]] std::optional<bool> surrounds(const RingOnMap& other) const {
    constexpr std::size_t num_tried = 4;
    const std::size_t stride = (other.corners_.size() + num_tried - 1) / num_tried;
    for (std::size_t k = 0; k < other.corners_.size(); k += stride) {
      const auto found = surrounds(other.positions_[k].lon_deg, other.corners_[k]);
      if (found) return found;
    }
    return std::nullopt;
  }

 private:
  static constexpr double widest = 179;
  // More than rounding of longitudes below 89 degrees of latitude.
  static constexpr double margin = 1e-9;

  [[nodiscard]] std::optional<bool> surrounds(double lon_deg, const Point& p) const {
    const double lon = lon_deg - 360 * std::floor((lon_deg - west_) / 360);
    if (lon > east_ + margin && lon < west_ + 360 - margin) return false;
    if (lon < west_ + margin || lon > east_ - margin) return std::nullopt;
    bool is_odd = false;
    std::size_t before = corners_.size() - 1;
    bool was_west = positions_[before].lon_deg < lon;
    for (std::size_t k = 0; k < corners_.size(); before = k++) {
      const double off = positions_[k].lon_deg - lon;
      if (std::abs(off) < margin) return std::nullopt;
      const bool is_west = off < 0;
      if (is_west == was_west) continue;
      const auto& [west, east] = is_west ? std::pair(k, before) : std::pair(before, k);
      const Sign side = orientation(corners_[west], corners_[east], p);
      if (side == Sign::zero) return std::nullopt;
      is_odd = is_odd != (side == Sign::negative);
      was_west = is_west;
    }
    return is_odd;
  }

  std::span<const LonLat> positions_;
  std::span<const Point> corners_;
  double west_;
  double east_;
  bool is_simple_;
};

// Returns whether rings that do not touch agree on what is inside: holes are in their shells, and
// shells apart. Returns nothing if that is not sure.
std::optional<bool> do_simply_agree(std::span<const RingOnMap> rings,
                                    std::span<const map::LonLatRing> given) {
  if (!std::ranges::all_of(rings, &RingOnMap::is_simple)) return std::nullopt;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    bool is_in_odd = false;
    for (std::size_t other = 0; other < rings.size(); ++other) {
      if (other == r) continue;
      const std::optional<bool> is_in = rings[other].surrounds(rings[r]);
      if (!is_in) return std::nullopt;
      is_in_odd = is_in_odd != *is_in;
    }
    if (is_in_odd != given[r].is_hole) return false;
  }
  return true;
}

// True if the rings agree on what is inside, exactly.
bool do_agree(const FeatureSides& sides, const Execution& execution) {
  CellRings one;
  one.points = sides.corners;
  for (Index k = 0; k < sides.corners.size(); ++k) {
    one.corners.push_back(k);
    if (sides.next[k] != k + 1) one.end_ring();
  }
  one.end_cell();
  return are_exactly_valid(one, execution);
}

// What is known of a feature at first sight.
struct PlainFeature {
  FeatureSides sides;
  bool is_valid = false;
  bool has_thin_rings = false;  // rings of which rounding may have changed the direction
};

PlainFeature plain_feature(std::span<const map::LonLatRing> rings, const Execution& execution) {
  constexpr double half_of_sphere = 2 * std::numbers::pi;
  double sum = 0;
  PlainFeature feature;
  std::vector<GeodesicRing> arcs;
  std::vector<RingOnMap> on_map;
  arcs.reserve(rings.size());
  on_map.reserve(rings.size());
  for (const map::LonLatRing& ring : rings) {
    arcs.push_back(geodesic_ring(ring));
    const auto& [positions, corners] = arcs.back();
    if (corners.size() < 3) return feature;
    // The sign of a ring that is thin or wide may be that of rounding.
    const double area = map::area_on_left(corners);
    if (std::abs(area) >= half_of_sphere || (ring.is_hole ? area >= 0 : area <= 0)) return feature;
    feature.has_thin_rings = feature.has_thin_rings || std::abs(area) <= far_above_rounding;
    sum += area;
    feature.sides.append(corners);
    on_map.emplace_back(positions, corners, area);
  }
  // Rings also agree on the region outside of a hole that has its shell inside.
  const bool has_area = sum > far_above_rounding || rings.size() < 2;
  if (!has_area || !are_plain(feature.sides)) return feature;
  feature.is_valid = rings.size() < 2;
  if (feature.is_valid) return feature;
  const std::optional<bool> agree = do_simply_agree(on_map, rings);
  feature.is_valid = agree ? *agree : do_agree(feature.sides, execution);
  return feature;
}

}  // namespace

bool is_plainly_valid(std::span<const map::LonLatRing> rings, const Execution& execution) {
  return plain_feature(rings, execution).is_valid;
}

std::optional<CellRings> plain_cell(std::span<const map::LonLatRing> rings,
                                    const Execution& execution) {
  const PlainFeature feature = plain_feature(rings, execution);
  if (!feature.is_valid || feature.has_thin_rings) return std::nullopt;
  std::vector<KeyedSide> sides;
  sides.reserve(feature.sides.next.size());
  for (Index k = 0; k < feature.sides.next.size(); ++k) {
    sides.push_back({0, k, feature.sides.next[k]});
  }
  CellRings cell = rings_around(feature.sides.corners, sides, 1, execution.threads);
  if (cell.corners.size() != sides.size()) return std::nullopt;  // rings vanish by rounding
  return cell;
}

}  // namespace rondel::overlay
