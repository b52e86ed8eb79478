// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/tidy_rings.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "exact/point_order.h"
#include "exact/vector.h"
#include "overlay/border_rings.h"
#include "overlay/measure.h"
#include "overlay/region_area.h"
#include "overlay/single_cells.h"
#include "overlay/snapped_sides.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

// True if the path from a over b to c turns back on itself: all three are on one great circle, with
// a and c on the same side of b.
bool is_turned_back(const Point& a, const Point& b, const Point& c) {
  if (a == c) return true;
  const Point to_a = a - b;
  const Point to_c = c - b;
  const double height = dot(b, cross(to_a, to_c));
  constexpr double surely = 0x1p-40;
  if (height * height > surely * surely * dot(to_a, to_a) * dot(to_c, to_c)) return false;
  return dot(cross(b, to_a), cross(b, to_c)) > 0 && orientation(a, b, c) == Sign::zero;
}

// Returns a ring without the corners at which it turns back: a path from a over b to c is replaced
// by that from a to c.
std::vector<Point> without_turns(std::span<const Point> ring) {
  std::vector<Point> kept;
  const auto take = [&](const Point& p) {
    while (kept.size() > 1 && is_turned_back(kept[kept.size() - 2], kept.back(), p)) {
      kept.pop_back();
    }
    if (kept.empty() || !(kept.back() == p)) kept.push_back(p);
  };
  for (const Point& p : ring) take(p);
  // The place where the ring closes is treated in the same way.
  for (bool has_changed = true; has_changed && kept.size() > 2;) {
    has_changed = false;
    const std::size_t n = kept.size();
    if (kept.front() == kept.back() || is_turned_back(kept[n - 2], kept[n - 1], kept[0])) {
      kept.pop_back();
      has_changed = true;
    } else if (is_turned_back(kept[n - 1], kept[0], kept[1])) {
      kept.erase(kept.begin());
      has_changed = true;
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

// True if a ring is wider than rounding somewhere: after corners within rounding of its sides have
// become corners of the sides, the ring consists of loops, of which one is wide.
bool has_wide_loop(std::span<const Point> ring) {
  std::vector<OwnedSide> sides;
  const auto size = static_cast<Index>(ring.size());
  for (Index k = 0; k < size; ++k) sides.push_back({k, k + 1 < size ? k + 1 : 0, 0});
  std::vector<KeyedArc> arcs;
  for (const auto& [from, to, owner] : Snaps(ring, sides).applied(sides)) {
    arcs.push_back({owner, ring[from], ring[to]});
  }
  return !rings_around(arcs, 1, 1).corners.empty();
}

double length_of(std::span<const Point> ring) {
  double length = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    length += rough_length(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
  }
  return length;
}

// True if a ring is wider than rounding of corners along a border of this length can make it.
bool is_surely_wide(const RingArea& ring, double length) {
  constexpr double surely = 64;
  return std::abs(ring.area) > surely * area_of_rounding(length);
}

// True if a ring has no area up to rounding, such as one with two equal loops.
bool is_balanced(std::span<const Point> ring) {
  const RingArea area = area_of_ring(ring);
  return !is_surely_wide(area, length_of(ring)) || area.is_nothing();
}

bool crosses_surely(std::span<const Point> ring) {
  std::vector<BorderArc> sides;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    sides.push_back({ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]});
  }
  return has_sure_crossing(sides);
}

// Returns the arcs of a cell with turns removed, or nothing for a cell with a balanced crossing;
// whoever overlays the cell reports it.
std::optional<std::vector<KeyedArc>> arcs_of_cell(const CellRings& cells, std::size_t cell,
                                                  Index key) {
  std::vector<KeyedArc> arcs;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    const std::vector<Point> kept = without_turns(points_of_ring(cells, r));
    if (!kept.empty() && is_balanced(kept) && (crosses_surely(kept) || has_wide_loop(kept))) {
      return std::nullopt;
    }
    for (std::size_t k = 0; k < kept.size(); ++k) {
      arcs.push_back({key, kept[k], kept[k + 1 < kept.size() ? k + 1 : 0]});
    }
  }
  return arcs;
}

// Throws InvalidInput for a cell whose sides all cancel, if one of its rings is wider than
// rounding. Such a cell could be empty (a ring and an equal hole) or the whole sphere (two parts
// that share their border).
void require_nothing(const CellRings& cells, std::size_t cell, std::span<const KeyedArc> arcs) {
  if (!is_nothing(arcs)) return;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    if (area_of_ring(points_of_ring(cells, r)).is_nothing()) continue;
    throw InvalidInput("cell " + std::to_string(cell) +
                           " has all of its sides in both directions: it is nothing, or the whole "
                           "sphere, which has no rings",
                       cell);
  }
}

std::size_t num_corners_of(const CellRings& cells, std::size_t cell) {
  return cells.rings[cells.cells[cell + 1]] - cells.rings[cells.cells[cell]];
}

// Finds the points of a cell by their coordinates.
class NamesOfCorners {
 public:
  NamesOfCorners(const CellRings& cells, std::size_t cell) : points_(cells.points) {
    for (std::uint64_t k = cells.rings[cells.cells[cell]]; k < cells.rings[cells.cells[cell + 1]];
         ++k) {
      names_.push_back(cells.corners[k]);
    }
    std::ranges::sort(names_, [&](Index a, Index b) {
      const Point& p = points_[a];
      const Point& q = points_[b];
      return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
    });
  }
  // Returns the index of the cell's point with these coordinates. Precondition: there is one.
  [[nodiscard]] Index operator[](const Point& p) const {
    return *std::ranges::lower_bound(names_, p, exact::is_less,
                                     [&](Index name) -> const Point& { return points_[name]; });
  }

 private:
  std::span<const Point> points_;
  std::vector<Index> names_;
};

}  // namespace

Inversion inversion_of(const MeasuredCell& before, const MeasuredCell& after) {
  constexpr double half_of_sphere = 2 * std::numbers::pi;
  if (std::abs(after.area - before.area) < half_of_sphere) return Inversion::none;
  double length = 0;
  for (std::uint64_t r = before.cells.cells[before.cell]; r < before.cells.cells[before.cell + 1];
       ++r) {
    length += length_of(points_of_ring(before.cells, r));
  }
  for (std::uint64_t r = after.cells.cells[after.cell]; r < after.cells.cells[after.cell + 1];
       ++r) {
    const RingArea area = area_of_ring(points_of_ring(after.cells, r));
    if (is_surely_wide(area, length)) return Inversion::of_wide_rings;
  }
  return Inversion::of_rounding;
}

bool has_balanced_crossing(const CellRings& cells, std::size_t cell) {
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    const std::vector<Point> kept = without_turns(points_of_ring(cells, r));
    if (!kept.empty() && is_balanced(kept) && crosses_surely(kept)) return true;
  }
  return false;
}

bool may_be_untidy(const CellRings& cells, const Subdivision& known, unsigned threads) {
  std::vector<std::uint64_t> rings;  // of all cells that tidied() looks at
  for (const auto& [place, area] : known.areas_of_others) {
    const Index cell = known.names[place];
    for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + std::size_t{1}]; ++r) {
      rings.push_back(r);
    }
  }
  std::atomic<bool> is_found = false;
  constexpr std::size_t rings_per_task = 64;
  system::parallel_for(threads, rings.size(), rings_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t k = begin; k < end && !is_found; ++k) {
                           const std::vector<Point> ring = points_of_ring(cells, rings[k]);
                           if (without_turns(ring).size() != ring.size() || is_rounding(ring))
                             is_found = true;
                         }
                       });
  return is_found;
}

std::optional<CellRings> tidied(const CellRings& cells, const Subdivision& known) {
  if (known.areas_of_others.empty()) return std::nullopt;
  std::vector<Index> keys(cells.num_cells(), no_index);
  std::vector<KeyedArc> arcs;
  std::vector<double> areas_before;
  std::vector<std::size_t> begins;  // where the arcs of each key begin
  Index num_keys = 0;
  for (const auto& [place, area] : known.areas_of_others) {
    const Index cell = known.names[place];
    const std::optional<std::vector<KeyedArc>> of_cell = arcs_of_cell(cells, cell, num_keys);
    if (!of_cell) continue;
    begins.push_back(arcs.size());
    keys[cell] = num_keys++;
    areas_before.push_back(area);
    arcs.insert(arcs.end(), of_cell->begin(), of_cell->end());
  }
  const CellRings left = rings_around(arcs, num_keys, 1);
  const std::vector<double> areas_after = areas(left);
  const auto turned = [&](std::size_t cell) {
    const Index key = keys[cell];
    return inversion_of({cells, cell, areas_before[key]}, {left, key, areas_after[key]});
  };
  const auto has_changed = [&](std::size_t cell) {
    return keys[cell] != no_index &&
           num_corners_of(left, keys[cell]) != num_corners_of(cells, cell) &&
           turned(cell) != Inversion::of_wide_rings;
  };
  CellRings result;
  bool has_any = false;
  result.points = cells.points;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    if (cells.is_whole(i)) result.whole.push_back(static_cast<Index>(i));
    if (!has_changed(i)) {
      result.append_rings(cells, i);
    } else {
      has_any = true;
      const Index key = keys[i];
      const std::size_t end = key + 1 < num_keys ? begins[key + std::size_t{1}] : arcs.size();
      if (left.cells[key] == left.cells[key + std::size_t{1}]) {
        require_nothing(cells, i, std::span(arcs).subspan(begins[key], end - begins[key]));
      }
      if (turned(i) == Inversion::of_rounding) {
        if (areas_after[key] < areas_before[key]) result.whole.push_back(static_cast<Index>(i));
        result.end_cell();
        continue;
      }
      const NamesOfCorners names(cells, i);
      for (std::uint64_t r = left.cells[key]; r < left.cells[key + std::size_t{1}]; ++r) {
        for (const Index corner : left.corners_of(r)) {
          result.corners.push_back(names[left.points[corner]]);
        }
        result.end_ring();
      }
    }
    result.end_cell();
  }
  if (!has_any) return std::nullopt;
  return result;
}

}  // namespace rondel::overlay
