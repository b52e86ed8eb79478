// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "overlay/border_rings.h"
#include "overlay/cover_triangulation.h"
#include "overlay/overlaps.h"
#include "overlay/single_cells.h"
#include "overlay/snapped_sides.h"
#include "overlay/tidy_rings.h"
#include "rondel/regions.h"

namespace rondel::overlay {
namespace {

// Returns the sides of a cell.
std::vector<OwnedSide> sides_of_cell(const CellRings& cells, std::size_t cell, Index owner) {
  std::vector<OwnedSide> sides;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    const std::uint64_t first = cells.rings[r];
    const std::uint64_t end = cells.rings[r + 1];
    for (std::uint64_t k = first; k < end; ++k) {
      sides.push_back({cells.corners[k], cells.corners[k + 1 < end ? k + 1 : first], owner});
    }
  }
  return sides;
}

// Returns the sides of the cells whose sides cross or cancel, which snapping may mend. The order of
// crossings along an edge of a cover is not defined for sides on one great circle.
std::vector<OwnedSide> sides_to_snap(const CellRings& cells, const Subdivision& known,
                                     const Execution& execution) {
  std::vector<OwnedSide> all;
  for (const auto& [place, area] : known.areas_of_others) {
    const Index cell = known.names[place];
    if (are_exactly_valid(one_cell(cells, cell), execution)) continue;
    const std::vector<OwnedSide> sides = sides_of_cell(cells, cell, cell);
    if (Snaps(cells.points, sides).is_empty()) continue;
    const Subdivision one(rings_of(known, std::span(&place, 1)), false, 1);
    if (has_plain_sides(one, execution) || has_balanced_crossing(cells, cell)) continue;
    all.insert(all.end(), sides.begin(), sides.end());
  }
  return all;
}

// Returns the cells with corners inserted into the sides on which they are up to rounding, or
// nothing if all cells are sound.
std::optional<CellRings> with_corners_on_sides(const CellRings& cells, const Subdivision& known,
                                               const Execution& execution) {
  constexpr double half_of_sphere = 2 * std::numbers::pi;
  const Snaps snaps(cells.points, sides_to_snap(cells, known, execution));
  if (snaps.is_empty()) return std::nullopt;
  CellRings result;
  for (Index i = 0; i < cells.num_cells(); ++i) {
    const std::vector<OwnedSide> sides = sides_of_cell(cells, i, 0);
    CellRings one = one_cell(cells, i);
    if (snaps.would_change(sides)) {
      std::vector<KeyedArc> arcs;
      for (const auto& [from, to, owner] : snaps.applied(sides)) {
        arcs.push_back({owner, cells.points[from], cells.points[to]});
      }
      const double before = areas(one).front();
      CellRings rest = rings_around(arcs, 1, 1);
      const Inversion inversion = inversion_of({one, 0, before}, {rest, 0, areas(rest).front()});
      if (inversion == Inversion::of_rounding) {
        rest = CellRings{};
        rest.cells.push_back(0);
      }
      if (inversion != Inversion::of_wide_rings) one = std::move(rest);
      if (before > half_of_sphere && !has_any(one)) one.whole = {0};
    }
    append(one, result);
  }
  merge_equal_points(result);
  return result;
}

}  // namespace

Subdivision sound_cells(const CellRings& cells, std::vector<Index>& whole,
                        const Execution& execution) {
  constexpr int max_times = 4;  // a corner may then be on another side
  const Execution told{.threads = execution.threads, .stop = execution.stop};
  Subdivision sound(cells, false, execution.threads);
  std::optional<CellRings> changed = tidied(cells, sound);
  if (changed) sound = Subdivision(*changed, false, execution.threads);
  for (int time = 0; time < max_times; ++time) {
    std::optional<CellRings> next = with_corners_on_sides(changed ? *changed : cells, sound, told);
    if (!next) break;
    changed = std::move(next);
    sound = Subdivision(*changed, false, execution.threads);
  }
  if (changed) whole = changed->whole;
  return sound;
}

}  // namespace rondel::overlay
