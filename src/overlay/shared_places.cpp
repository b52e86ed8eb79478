// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/shared_places.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "exact/vector.h"
#include "overlay/overlaps.h"
#include "overlay/single_cells.h"
#include "overlay/tidy_rings.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

// A part of a cell, and all cells that have it.
struct OwnedPart {
  CellRings rings;
  std::vector<Index> owners;
};

// Returns the parts of a cell that no cell before it has. Parts that later cells have as well are
// separate. `others` are the cells that overlap with the cell.
std::vector<OwnedPart> parts_of_cell(const CellRings& cells, Index cell,
                                     const std::vector<Index>& others, const Execution& execution) {
  std::vector<OwnedPart> parts = {{one_cell(cells, cell), {cell}}};
  for (const Index other : others) {
    const CellRings there = one_cell(cells, other);
    const CellSet inside = CellSet::polygons(there);
    const CellSet outside = CellSet::polygons(beyond_cell(there));
    std::vector<OwnedPart> cut;
    for (const OwnedPart& part : parts) {
      const CellSet whole_part = CellSet::polygons(part.rings);
      CellRings left = clip(whole_part, outside, execution);
      if (has_any(left)) cut.push_back({std::move(left), part.owners});
      if (other < cell) continue;
      CellRings both = clip(whole_part, inside, execution);
      if (!has_any(both)) continue;
      cut.push_back({std::move(both), part.owners});
      cut.back().owners.push_back(other);
    }
    parts = std::move(cut);
  }
  return parts;
}

// Cuts cells into parts; others[i] are the cells whose overlaps with cell i are to be separated.
OverlaySide cut_up(const CellRings& cells, const StraightSides* straight,
                   const std::vector<std::vector<Index>>& others, const Execution& execution) {
  const Execution told{.threads = execution.threads, .stop = execution.stop};
  OverlaySide result;
  CellRings all;
  // What cells that overlap have of each other is between arcs, so that they have arcs.
  CompressedRows<LonLatSide> sides;
  std::vector<bool> overlaps(others.size(), false);
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (!others[i].empty()) overlaps[i] = true;
    for (const Index other : others[i]) overlaps[other] = true;
  }
  all.points = cells.points;
  for (Index i = 0; i < cells.num_cells(); ++i) {
    if (others[i].empty()) {
      all.append_cell(cells, i);
      const bool is_straight = straight != nullptr && !overlaps[i];
      sides.append(is_straight ? straight->rows()[i] : std::span<const LonLatSide>());
      result.owners.append({&i, 1});
      continue;
    }
    for (const OwnedPart& part : parts_of_cell(cells, i, others[i], told)) {
      append(part.rings, all);
      sides.end_row();
      result.owners.append(part.owners);
    }
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

// Throws InvalidInput with the first cell that takes part and crosses or overlaps itself.
void require_simple_cells(const CellSetData& cells, const CellFacts& facts, const char* what) {
  for (const CrossingCells& pair : cells.cells_crossing_themselves()) {
    if (is_masked(facts.mask, pair.first)) continue;
    throw InvalidInput(std::string(what) + ' ' + message_of(pair, facts.columns), pair.first);
  }
}

}  // namespace

OverlaySide taking_part(const CellSetData& cells, const CellFacts& facts, CellOverlap rule,
                        const char* what, const Execution& execution) {
  const std::vector<std::int32_t>& mask = facts.mask;
  if (rule == CellOverlap::each && cells.all_whole().empty()) {
    // Each cell has its own pieces, whatever the others have.
    require_simple_cells(cells, facts, what);
    return {&cells};
  }
  const std::vector<CrossingCells>& overlaps = cells.overlaps(execution);
  if (overlaps.empty()) return {&cells};
  const CellRings rings = unmasked(rings_of(cells), mask);
  std::vector<std::vector<Index>> others(rings.num_cells());
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
    others[pair.second].push_back(pair.first);
    if (rule != CellOverlap::first) others[pair.first].push_back(pair.second);
  }
  OverlaySide side = cut_up(rings, cells.straight_sides(), others, execution);
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
