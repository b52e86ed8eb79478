// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/small_rings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "map/ring_area.h"
#include "meshing/rings_within.h"
#include "overlay/single_cells.h"
#include "system/distinct.h"

namespace rondel::meshing {
namespace {

class SmallRings {
 public:
  // The rings are those of the cells from `begin` to before `end`.
  SmallRings(const CellRings& polygons, std::size_t begin, std::size_t end, SimplifyOptions options)
      : polygons_(polygons), options_(std::move(options)), is_small_(polygons.cells[end]) {
    options_.drop_small = true;
    options_.clearance = 0;
    for (std::uint64_t ring = polygons.cells[begin]; ring < polygons.cells[end]; ++ring) {
      if (!is_surely_wide(overlay::points_of_ring(polygons_, ring))) looked_at_.push_back(ring);
    }
  }

  // Says of each ring whether it vanishes alone. Those that touch none of the others are simplified
  // together.
  std::vector<bool> find(const Execution& execution) {
    CellRings together;
    std::vector<std::uint64_t> apart;
    const std::vector<bool> is_touching = touching();
    for (std::size_t k = 0; k < looked_at_.size(); ++k) {
      if (is_touching[k]) {
        is_small_[looked_at_[k]] = vanishes(alone(looked_at_[k]), {.threads = 1});
      } else {
        overlay::append(alone(looked_at_[k]), together);
        apart.push_back(looked_at_[k]);
      }
    }
    const CellRings left = simplified(together, options_, execution);
    for (std::size_t i = 0; i < apart.size(); ++i) {
      is_small_[apart[i]] = left.cells[i] == left.cells[i + 1];
    }
    return std::move(is_small_);
  }

 private:
  // A ring that vanishes is within its tolerance of an arc that is no longer than half of it and twice the
  // tolerance. True if its area is larger than that of what is so near to such an arc.
  [[nodiscard]] bool is_surely_wide(std::span<const Point> ring) const {
    double tolerance = options_.tolerance;
    double length = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point& next = ring[k + 1 == ring.size() ? 0 : k + 1];
      length += norm(exact::to_vector(next) - exact::to_vector(ring[k]));
      if (options_.tolerance_at) {
        tolerance = std::max(k == 0 ? 0 : tolerance, options_.tolerance_at(ring[k]));
      }
    }
    constexpr double of_chords = 1.2;
    const double most = tolerance * (of_chords * length + 8 * tolerance);
    return map::is_surely_larger(ring, most) || std::abs(map::area_on_left(ring)) > most;
  }

  [[nodiscard]] CellRings alone(std::uint64_t ring) const {
    CellRings one;
    overlay::append_ring_of(overlay::points_of_ring(polygons_, ring), one);
    one.end_cell();
    return one;
  }
  [[nodiscard]] bool vanishes(const CellRings& one, const Execution& execution) const {
    return simplified(one, options_, execution).corners.empty();
  }

  // Says of each ring that is looked at whether it has a corner in common with another one of them.
  [[nodiscard]] std::vector<bool> touching() const {
    std::vector<Point> corners;
    for (const std::uint64_t ring : looked_at_) {
      for (const Index corner : polygons_.corners_of(ring)) {
        corners.push_back(polygons_.points[corner]);
      }
    }
    const system::Distinct<Point> places = system::distinct(std::span<const Point>(corners));
    std::vector<Index> counts(places.values.size());
    for (const Index number : places.numbers) ++counts[number];
    std::vector<bool> result;
    auto number = places.numbers.begin();
    for (const std::uint64_t ring : looked_at_) {
      const auto end = number + static_cast<std::ptrdiff_t>(polygons_.corners_of(ring).size());
      result.push_back(std::any_of(number, end, [&](Index n) { return counts[n] > 1; }));
      number = end;
    }
    return result;
  }

  const CellRings& polygons_;
  SimplifyOptions options_;
  std::vector<std::uint64_t> looked_at_;  // rings that may be small
  std::vector<bool> is_small_;
};

}  // namespace

CellRings without_small_rings(const CellRings& polygons, std::size_t begin, std::size_t end,
                              const SimplifyOptions& options, const Execution& execution) {
  const std::vector<bool> is_small = SmallRings(polygons, begin, end, options).find(execution);
  CellRings result;
  result.points = polygons.points;
  for (std::size_t cell = 0; cell < polygons.num_cells(); ++cell) {
    if (cell < begin || cell >= end) {
      result.append_cell(polygons, cell);
      continue;
    }
    const auto begin_of_cell = is_small.begin() + static_cast<std::ptrdiff_t>(polygons.cells[cell]);
    const auto end_of_cell =
        is_small.begin() + static_cast<std::ptrdiff_t>(polygons.cells[cell + 1]);
    const std::vector<bool> dropped(begin_of_cell, end_of_cell);
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
