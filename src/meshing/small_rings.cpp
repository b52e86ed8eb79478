// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/small_rings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "arrangement/arc_distance.h"
#include "arrangement/corner_removal.h"
#include "exact/point_order.h"
#include "exact/vector.h"
#include "map/ring_area.h"
#include "meshing/rings_within.h"
#include "overlay/single_cells.h"

namespace rondel::meshing {
namespace {

// Judges rings one by one.
class SmallRing {
 public:
  SmallRing(const CellRings& polygons, std::uint64_t ring, const SimplifyOptions& options)
      : corners_(overlay::points_of_ring(polygons, ring)) {
    for (const Point& p : corners_) {
      const double tolerance = options.tolerance_at ? options.tolerance_at(p) : options.tolerance;
      limits_.push_back(arrangement::squared_sine_below(tolerance));
      widest_ = std::max(widest_, tolerance);
    }
  }

  [[nodiscard]] bool vanishes(SimplifyOptions options) const {
    if (corners_.empty() || is_surely_wide()) return false;
    if (is_along_an_arc()) return true;
    CellRings alone;
    overlay::append_ring_of(corners_, alone);
    alone.end_cell();
    options.drop_small = true;
    options.clearance = 0;
    return simplified(alone, options, {.threads = 1}).corners.empty();
  }

 private:
  // A ring that vanishes is within its tolerance of an arc that is no longer than half of it and twice the
  // tolerance. True if its area is larger than that of what is so near to such an arc.
  [[nodiscard]] bool is_surely_wide() const {
    double length = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Point& next = corners_[k + 1 == corners_.size() ? 0 : k + 1];
      length += norm(exact::to_vector(next) - exact::to_vector(corners_[k]));
    }
    constexpr double of_chords = 1.2;
    const double most = widest_ * (of_chords * length + 8 * widest_);
    return map::is_surely_larger(corners_, most) || std::abs(map::area_on_left(corners_)) > most;
  }

  // True if all corners are within their tolerance of the arc between two that are about as far from each
  // other as any. A simplification may keep such a ring, if it is folded along the arc.
  [[nodiscard]] bool is_along_an_arc() const {
    const Point a =
        farthest_from(farthest_from(*std::ranges::min_element(corners_, exact::is_less)));
    const Point b = farthest_from(a);
    const bool is_up = exact::is_less(a, b);
    const arrangement::ArcDistance distance(is_up ? a : b, is_up ? b : a);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      if (!(distance.squared_sine(corners_[k]) <= limits_[k])) return false;
    }
    return true;
  }
  // Returns the corner with the least coordinates of those that are farthest from a place.
  [[nodiscard]] Point farthest_from(const Point& place) const {
    return *std::ranges::max_element(corners_, [&](const Point& p, const Point& q) {
      const double of_p = dot(p - place, p - place);
      const double of_q = dot(q - place, q - place);
      return of_p != of_q ? of_p < of_q : exact::is_less(q, p);
    });
  }

  std::vector<Point> corners_;
  std::vector<double> limits_;  // squared sines of the tolerances
  double widest_ = 0;           // the greatest tolerance
};

}  // namespace

CellRings without_small_rings(const CellRings& polygons, const SimplifyOptions& options) {
  CellRings result;
  result.points = polygons.points;
  for (std::size_t cell = 0; cell < polygons.num_cells(); ++cell) {
    std::vector<bool> dropped;
    for (std::uint64_t ring = polygons.cells[cell]; ring < polygons.cells[cell + 1]; ++ring) {
      dropped.push_back(SmallRing(polygons, ring, options).vanishes(options));
    }
    const std::vector<bool> is_within = rings_within(polygons, cell, dropped);
    std::vector<std::vector<Point>> given;
    const std::size_t num_before = result.rings.size();
    for (std::size_t i = 0; i < dropped.size(); ++i) {
      const std::uint64_t ring = polygons.cells[cell] + i;
      if (!dropped[i] && !is_within[i]) {
        result.append_ring(polygons.corners_of(ring));
      } else {
        given.push_back(overlay::points_of_ring(polygons, ring));
      }
    }
    if (result.rings.size() == num_before &&
        (polygons.is_whole(static_cast<Index>(cell)) || map::have_outside_on_left(given))) {
      result.whole.push_back(static_cast<Index>(cell));
    }
    result.end_cell();
  }
  return result;
}

}  // namespace rondel::meshing
