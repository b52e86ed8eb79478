// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Most features are valid, and most of these at first sight: rings that do not touch, the holes
// inside of their shells. This needs neither the arcs of all rings in order nor areas of cells.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "exact/vector.h"
#include "map/ring_area.h"
#include "overlay/feature_polygons.h"
#include "overlay/overlaps.h"
#include "rondel/predicates.h"

namespace rondel::overlay {
namespace {

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

// True if the rings agree on what is inside, exactly: holes are in their shells, and shells apart.
bool do_agree(const FeatureSides& sides, std::size_t num_rings, const Execution& execution) {
  if (num_rings < 2) return true;
  CellRings one;
  one.points = sides.corners;
  for (Index k = 0; k < sides.corners.size(); ++k) {
    one.corners.push_back(k);
    if (sides.next[k] != k + 1) one.end_ring();
  }
  one.end_cell();
  return are_exactly_valid(one, execution);
}

}  // namespace

bool is_plainly_valid(std::span<const map::LonLatRing> rings, const Execution& execution) {
  constexpr double half_of_sphere = 2 * std::numbers::pi;
  constexpr double rounding = 1e-10;  // far more than that of areas
  double sum = 0;
  FeatureSides sides;
  for (const map::LonLatRing& ring : rings) {
    const std::vector<Point> corners = geodesic_ring(ring);
    if (corners.size() < 3) return false;
    // The sign of a ring that is thin or wide may be that of rounding.
    const double area = map::area_on_left(corners);
    if (std::abs(area) >= half_of_sphere || (ring.is_hole ? area >= 0 : area <= 0)) return false;
    sum += area;
    sides.append(corners);
  }
  // Rings also agree on the region outside of a hole that has its shell inside.
  const bool has_area = sum > rounding || rings.size() < 2;
  return has_area && are_plain(sides) && do_agree(sides, rings.size(), execution);
}

}  // namespace rondel::overlay
