// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/shared_places.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "arrangement/arc_checks.h"
#include "arrangement/owned_parts.h"
#include "exact/vector.h"
#include "overlay/overlaps.h"
#include "overlay/single_cells.h"
#include "overlay/tidy_rings.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

// Cuts the cells that overlap, of which `is_cut` tells, into parts; the others stay as they are.
// What cells that overlap have of each other is between arcs, so that they lose straight sides.
OverlaySide cut_up(const CellRings& cells, const StraightSides* straight,
                   const std::vector<bool>& is_cut, arrangement::PlaceOwners rule,
                   const Execution& execution) {
  const Execution told{.threads = execution.threads, .stop = execution.stop};
  OverlaySide result;
  CellRings all;
  CellRings crowded;
  std::vector<Index> names;  // of the crowded cells
  CompressedRows<LonLatSide> sides;
  all.points = cells.points;
  for (Index i = 0; i < cells.num_cells(); ++i) {
    if (is_cut[i]) {
      append(one_cell(cells, i), crowded);
      names.push_back(i);
      continue;
    }
    all.append_cell(cells, i);
    sides.append(straight != nullptr ? straight->rows()[i] : std::span<const LonLatSide>());
    result.owners.append({&i, 1});
  }
  std::ranges::transform(crowded.points, crowded.points.begin(), arrangement::arrangeable);
  const arrangement::OwnedParts found = arrangement::owned_parts(crowded, rule, told);
  for (Index k = 0; k < found.parts.num_cells(); ++k) {
    append(one_cell(found.parts, k), all);
    sides.end_row();
    for (const Index owner : found.owners[k]) result.owners.values.push_back(names[owner]);
    result.owners.end_row();
  }
  merge_equal_points(all);
  std::vector<Index> whole = all.whole;
  Subdivision parts = sound_cells(all, whole, told);
  const auto data =
      std::make_shared<CellSetData>(std::move(parts), std::move(whole), execution.threads);
  data->keep_straight_sides(std::move(sides), execution.threads);
  result.parts = data;
  result.data = result.parts.get();
  return result;
}

// True if the mask excludes a cell.
bool is_masked(const std::vector<std::int32_t>& mask, Index cell) {
  return !mask.empty() && mask[cell] == 0;
}

// Returns the cells, with masked cells empty.
CellRings unmasked(const CellRings& cells, const std::vector<std::int32_t>& mask) {
  CellRings result;
  result.points = cells.points;
  for (Index i = 0; i < cells.num_cells(); ++i) {
    if (is_masked(mask, i)) {
      result.end_cell();
    } else {
      result.append_cell(cells, i);
    }
  }
  return result;
}

}  // namespace

OverlaySide taking_part(const CellSetData& cells, const CellFacts& facts, CellOverlap rule,
                        const char* what, const Execution& execution) {
  const std::vector<std::int32_t>& mask = facts.mask;
  // Each cell has its own pieces then, whatever the others have.
  if (rule == CellOverlap::each && cells.cells_crossing_themselves().empty()) return {&cells};
  const std::vector<CrossingCells> overlaps = cells.some_overlaps(
      rule == CellOverlap::error ? OverlapsWanted::first : OverlapsWanted::cells, mask, execution);
  if (overlaps.empty()) return {&cells};
  const CellRings rings = unmasked(rings_of(cells), mask);
  std::vector<bool> is_cut(rings.num_cells(), false);
  for (const CrossingCells& pair : overlaps) {
    if (is_masked(mask, pair.first) || is_masked(mask, pair.second)) continue;
    const std::string message = std::string(what) + ' ' + message_of(pair, facts.columns);
    if (pair.first == pair.second) throw InvalidInput(message, pair.second);
    if (rule == CellOverlap::error) {
      const bool is_target = std::string_view(what) == "target";
      throw InvalidInput(message + "; --overlap first" +
                             (is_target ? ", share or each (overlap='each' in Python) takes them"
                                        : " or share (overlap='first' in Python) takes them"),
                         pair.second);
    }
    is_cut[pair.first] = true;
    is_cut[pair.second] = true;
  }
  const auto owners =
      rule == CellOverlap::first ? arrangement::PlaceOwners::first : arrangement::PlaceOwners::all;
  OverlaySide side = cut_up(rings, cells.straight_sides(), is_cut, owners, execution);
  side.is_whole_for_each = rule == CellOverlap::each;
  return side;
}

std::span<const Index> OverlaySide::owners_of(const Index& part) const {
  return has_parts() ? owners[part] : std::span(&part, 1);
}

PieceRows joined_parts(PieceRows pieces, const OverlaySide& rows, std::size_t num_rows,
                       const OverlaySide& columns) {
  if (!rows.has_parts() && !columns.has_parts()) return pieces;
  // A piece as an entry of the table of cells.
  struct PartPiece {
    Index row;
    Index column;
    double area;
    Point moment;
  };
  std::vector<PartPiece> entries;
  entries.reserve(pieces.columns.size());
  for (Index j = 0; j + std::size_t{1} < pieces.offsets.size(); ++j) {
    const std::span<const Index> of_row = rows.owners_of(j);
    for (std::uint64_t k = pieces.offsets[j]; k < pieces.offsets[j + std::size_t{1}]; ++k) {
      const std::span<const Index> of_column = columns.owners_of(pieces.columns[k]);
      const double share = rows.share_of(j) * columns.share_of(pieces.columns[k]);
      const double area = share * pieces.areas[k];
      const Point moment = pieces.moments.empty() ? Point{} : share * pieces.moments[k];
      for (const Index row : of_row) {
        for (const Index column : of_column) entries.push_back({row, column, area, moment});
      }
    }
  }
  std::ranges::stable_sort(entries, {},
                           [](const PartPiece& e) { return std::pair(e.row, e.column); });
  PieceRows joined;
  joined.offsets.assign(num_rows + 1, 0);
  const PartPiece* last = nullptr;
  for (const PartPiece& entry : entries) {
    if (last != nullptr && last->row == entry.row && last->column == entry.column) {
      joined.areas.back() += entry.area;
      if (!pieces.moments.empty()) joined.moments.back() = joined.moments.back() + entry.moment;
      continue;
    }
    last = &entry;
    joined.columns.push_back(entry.column);
    joined.areas.push_back(entry.area);
    if (!pieces.moments.empty()) joined.moments.push_back(entry.moment);
    ++joined.offsets[entry.row + std::size_t{1}];
  }
  system::sum_counts(joined.offsets);
  return joined;
}

CountedSizes::CountedSizes(const CellSetData& cells, const OverlaySide& part, Borders borders)
    : cells_(cells), borders_(borders), of_parts_(part.has_parts()) {
  if (!of_parts_) return;
  const std::size_t n = cells.areas().size();
  areas_.resize(n);
  lengths_.resize(n);
  moments_.resize(n);
  const std::vector<Point> moments = part.data->moments(borders);
  for (Index k = 0; k < part.owners.size(); ++k) {
    const double share = part.share_of(k);
    for (const Index owner : part.owners_of(k)) {
      areas_[owner] += share * part.data->areas(borders)[k];
      lengths_[owner] += part.data->lengths(borders)[k];
      moments_[owner] = moments_[owner] + share * moments[k];
    }
  }
}

}  // namespace rondel::overlay
