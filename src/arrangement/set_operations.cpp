// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/set_operations.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/combined_each.h"
#include "arrangement/even_odd.h"
#include "arrangement/pair_shortcuts.h"
#include "arrangement/ring_arrays.h"
#include "arrangement/set_regions.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

using arrangement::cells_of;
using arrangement::joined_each;
using arrangement::Region;
using arrangement::RegionParts;
using arrangement::Sides;

Sides sides_of(const CellRings& first, const CellRings& second) {
  arrangement::validate_rings(first);
  arrangement::validate_rings(second);
  Sides sides;
  sides.append(first, 0);
  sides.append(second, 1);
  return sides;
}

}  // namespace

std::string_view name_of(SetOperation operation) noexcept {
  switch (operation) {
    case SetOperation::unite:
      return "union";
    case SetOperation::intersection:
      return "intersection";
    case SetOperation::difference:
      return "difference";
    case SetOperation::symmetric_difference:
      return "symmetric_difference";
    case SetOperation::identity:
      return "identity";
  }
  return {};
}

CellRings combine(const CellRings& first, const CellRings& second, SetOperation operation,
                  const Execution& execution) {
  const system::Call call(execution);
  const Sides sides = sides_of(first, second);
  return cells_of(std::vector{joined_region(sides, operation, RegionParts::areas, execution)},
                  execution.threads);
}

RegionPieces overlay_pieces(const CellRings& first, const CellRings& second, SetOperation operation,
                            const Execution& execution) {
  const system::Call call(execution);
  const Sides sides = sides_of(first, second);
  const std::vector<Region> regions =
      regions_of(sides, arrangement::RegionRule(operation, false), RegionParts::areas, execution);
  RegionPieces result{cells_of(regions, execution.threads), {}, {}};
  for (const Region& region : regions) {
    result.cells.push_back(region.key.first);
    const Index second_key = region.key.second;
    result.regions.push_back(
        second_key == no_index ? no_index : second_key - static_cast<Index>(first.num_cells()));
  }
  return result;
}

CellRings unite(const CellRings& polygons, const Execution& execution) {
  return combine(polygons, {}, SetOperation::unite, execution);
}

CellRings combine_pairs(const CellRings& first, const CellRings& second,
                        std::span<const std::array<Index, 2>> pairs, SetOperation operation,
                        const Execution& execution) {
  const system::Call call(execution);
  arrangement::validate_rings(first);
  arrangement::validate_rings(second);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    if (a >= first.num_cells() || b >= second.num_cells()) {
      throw InvalidInput("a polygon of a pair does not exist", k);
    }
  }
  const arrangement::PairShortcuts shortcuts(first, second, pairs, operation, execution.threads);
  return cells_of(joined_each(pairs.size(), operation, RegionParts::areas, execution,
                              [&](std::size_t k) { return shortcuts.sides(k); }),
                  execution.threads);
}

CellRings repaired(const CellRings& polygons, const Execution& execution) {
  const system::Call call(execution);
  arrangement::validate_rings(polygons);
  return cells_of(
      joined_each(polygons.num_cells(), SetOperation::unite, RegionParts::areas, execution,
                  [&](std::size_t cell) {
                    Sides sides;
                    sides.append_cell(polygons, cell, 0);
                    return sides;
                  }),
      execution.threads);
}

namespace arrangement {

CellRings extracted(const CellRings& cells, std::size_t begin, std::size_t end) {
  CellRings result;
  for (std::size_t c = begin; c < end; ++c) {
    if (cells.is_whole(c)) result.whole.push_back(static_cast<Index>(result.num_cells()));
    for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
      for (const Index p : cells.corners_of(r)) {
        result.corners.push_back(static_cast<Index>(result.points.size()));
        result.points.push_back(cells.points[p]);
      }
      result.end_ring();
    }
    result.end_cell();
  }
  return result;
}

CellRings combined_each(std::size_t count, const std::function<Operands(std::size_t)>& operands_of,
                        SetOperation operation, const Execution& execution) {
  return cells_of(joined_each(count, operation, RegionParts::areas, execution,
                              [&](std::size_t i) {
                                const Operands operands = operands_of(i);
                                return sides_of(operands.first, operands.second);
                              }),
                  execution.threads);
}

CellRings even_odd_union(const CellRings& polygons,
                         std::span<const std::optional<KnownPlace>> known,
                         const Execution& execution) {
  Sides sides;
  sides.append(polygons, 0);
  sides.known.assign(known.begin(), known.end());
  return cells_of(
      std::vector{joined_region(sides, SetOperation::unite, RegionParts::areas, execution)},
      execution.threads);
}

}  // namespace arrangement
}  // namespace rondel
