// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/rings_within.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "arrangement/prepared_polygon.h"
#include "exact/point_order.h"
#include "map/ring_area.h"
#include "overlay/single_cells.h"

namespace rondel::meshing {
namespace {

using arrangement::SpaceBox;

// The smaller side of a ring.
class SmallerSide {
 public:
  explicit SmallerSide(std::vector<Point> sides) : corners_(sides) {
    if (map::area_on_left(sides) < 0) std::ranges::reverse(sides);
    std::ranges::sort(corners_, exact::is_less);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    overlay::append_ring_of(sides, ring_);
    ring_.end_cell();
    std::vector<Index> numbers;
    for (const Point& p : ring_.points) {
      const auto at = std::ranges::lower_bound(corners_, p, exact::is_less);
      numbers.push_back(static_cast<Index>(at - corners_.begin()));
    }
    prepared_.emplace(ring_, 0, corners_, numbers);
  }

  // True if a ring is on this side, which it is if one of its corners is that is not on the border.
  [[nodiscard]] bool has(std::span<const Point> ring) const {
    if (prepared_->is_empty()) return false;
    const auto place = std::ranges::find_if(ring, [&](const Point& p) { return !is_on_border(p); });
    return place != ring.end() && prepared_->has(*place);
  }

 private:
  [[nodiscard]] bool is_on_border(const Point& p) const {
    if (std::ranges::binary_search(corners_, p, exact::is_less)) return true;
    for (std::size_t k = 0; k < ring_.points.size(); ++k) {
      const Point& a = ring_.points[k];
      const Point& b = ring_.points[k + 1 == ring_.points.size() ? 0 : k + 1];
      if (arrangement::is_near(a, b, p) && arrangement::is_on_near_arc(a, b, p)) return true;
    }
    return false;
  }

  std::vector<Point> corners_;  // sorted
  CellRings ring_;
  std::optional<arrangement::PreparedPolygon> prepared_;
};

SpaceBox box_of_place(const Point& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

// Returns a box that has the smaller side of a ring, which is higher than its corners by less than the
// square of their distances.
SpaceBox box_of_side(std::span<const Point> ring) {
  SpaceBox box = arrangement::empty_box;
  for (const Point& p : ring) box.include(box_of_place(p));
  constexpr double rounding = 1e-12;
  box.widen(box.squared_diagonal() + rounding);
  return box;
}

}  // namespace

std::vector<bool> rings_within(const CellRings& polygons, std::size_t cell,
                               const std::vector<bool>& is_around) {
  std::vector<bool> is_within(is_around.size());
  std::vector<std::vector<Point>> around;
  std::vector<SpaceBox> boxes;
  const std::uint64_t first = polygons.cells[cell];
  for (std::size_t i = 0; i < is_around.size(); ++i) {
    if (!is_around[i] || polygons.corners_of(first + i).empty()) continue;
    around.push_back(overlay::points_of_ring(polygons, first + i));
    boxes.push_back(box_of_side(around.back()));
  }
  if (around.empty()) return is_within;
  const arrangement::BoxTree tree(boxes, 1);
  std::vector<std::optional<SmallerSide>> sides(around.size());
  for (std::size_t i = 0; i < is_around.size(); ++i) {
    if (is_around[i] || polygons.corners_of(first + i).empty()) continue;
    const std::vector<Point> ring = overlay::points_of_ring(polygons, first + i);
    bool is_found = false;
    tree.visit(box_of_place(ring.front()), [&](Index k) {
      if (is_found) return;
      if (!sides[k]) sides[k].emplace(around[k]);
      is_found = sides[k]->has(ring);
    });
    is_within[i] = is_found;
  }
  return is_within;
}

}  // namespace rondel::meshing
