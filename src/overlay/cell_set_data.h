// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The content of a CellSet: cells prepared for an overlay, or a grid, with areas and moments.
//
// in    a subdivision or a grid
// out   areas, moments and border lengths of the cells, and whether they cover the sphere
// index indices of the cells in the input, except in subdivision(), which has its own spatial order
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "overlay/overlaps.h"
#include "overlay/pieces.h"
#include "overlay/prepared_grid.h"
#include "overlay/straight_sides.h"
#include "overlay/subdivision.h"
#include "rondel/cell_set.h"
#include "rondel/compressed_rows.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel::overlay {

class CellSetData {
 public:
  // `whole` has the cells that are the whole sphere, in ascending order. `are_apart` says that the
  // caller knows that no cells overlap.
  CellSetData(Subdivision subdivision, std::vector<Index> whole, unsigned threads,
              bool are_apart = false);
  explicit CellSetData(PreparedGrid grid);

  [[nodiscard]] static const CellSetData& of(const CellSet& cells) { return *cells.data_; }
  // Returns cells that are known not to overlap each other or themselves, as they are, with their
  // straight sides if these are known, and the area that each of them has by definition unless it is 0.
  [[nodiscard]] static CellSet of_apart(const CellRings& cells, const Execution& execution,
                                        CompressedRows<LonLatSide> sides = {},
                                        double equal_area = 0) {
    const auto data = std::make_shared<CellSetData>(Subdivision(cells, false, execution.threads),
                                                    cells.whole, execution.threads, true);
    data->keep_straight_sides(std::move(sides), execution.threads);
    if (equal_area > 0) data->defined_areas_.assign(data->areas_.size(), equal_area);
    return CellSet(data);
  }

  // Returns the grid, or null if the cells are not between meridians and parallels.
  [[nodiscard]] const PreparedGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
  // The lines of a grid, whatever the sides of its cells are; null for other cells.
  [[nodiscard]] const LonLatGrid* lines() const { return lines_ ? &*lines_ : nullptr; }
  void keep_lines(const LonLatGrid& lines) { lines_ = lines; }
  // The straight sides of cells, a row for each cell, or null if none are known.
  [[nodiscard]] const StraightSides* straight_sides() const {
    return straight_sides_ ? &*straight_sides_ : nullptr;
  }
  // Keeps straight sides, which the arcs stand for. Cells without arcs lose theirs.
  void keep_straight_sides(CompressedRows<LonLatSide> sides, unsigned threads);
  // Returns which borders count in an overlay with other cells.
  [[nodiscard]] static Borders borders_between(const CellSetData& cells,
                                               const CellSetData& others) {
    return cells.grid() != nullptr || others.grid() != nullptr ? Borders::straight : Borders::arcs;
  }
  // Returns the cells. If there is a grid, the subdivision has no cells.
  [[nodiscard]] const Subdivision& subdivision() const { return subdivision_; }
  // Returns the first cell that is the whole sphere, or no_index.
  [[nodiscard]] Index whole() const { return all_whole_.empty() ? no_index : all_whole_.front(); }
  [[nodiscard]] const std::vector<Index>& all_whole() const { return all_whole_; }
  [[nodiscard]] bool covers_sphere() const { return covers_sphere_; }
  // Returns the pairs of cells that overlap. The first call computes them, except for diagrams,
  // grids and covers, whose cells are known not to overlap. Several threads may call it.
  [[nodiscard]] const std::vector<CrossingCells>& overlaps(const Execution& execution) const;
  // Returns the wanted pairs without keeping them, as the function of this name in overlaps.h does,
  // also of cells that are the whole sphere.
  [[nodiscard]] std::vector<CrossingCells> some_overlaps(OverlapsWanted wanted,
                                                         std::span<const std::int32_t> mask,
                                                         const Execution& execution) const;
  // True if there are such pairs. The first call finds one, which takes less time than all of them.
  [[nodiscard]] bool has_overlaps(const Execution& execution) const;
  // Returns the cells that cross or overlap themselves, each as a pair with itself, by ascending
  // indices. The first call looks for them. Several threads may call it.
  [[nodiscard]] const std::vector<CrossingCells>& cells_crossing_themselves() const;
  // Throws InvalidInput with the first cell that crosses or overlaps itself, which has no area.
  void require_simple_cells() const;
  [[nodiscard]] std::size_t num_cells() const { return areas_.size(); }
  // Returns the area of each cell in steradians.
  [[nodiscard]] const std::vector<double>& areas(Borders borders = Borders::arcs) const {
    return borders == Borders::straight && straight_sides_ ? straight_sides_->areas() : areas_;
  }
  // Returns the areas that cells have by definition, from which areas() differ by rounding of corners; empty
  // if there are none. Pieces add up to areas().
  [[nodiscard]] const std::vector<double>& defined_areas() const { return defined_areas_; }
  [[nodiscard]] const std::vector<Point>& moments() const { return moments_; }
  // Returns the first moments between some borders.
  [[nodiscard]] std::vector<Point> moments(Borders borders) const;
  // Returns bounds for the lengths of the cells' borders, in radians.
  [[nodiscard]] const std::vector<double>& lengths(Borders borders = Borders::arcs) const {
    return borders == Borders::straight && straight_sides_ ? straight_sides_->lengths() : lengths_;
  }
  [[nodiscard]] CellSizes sizes() const { return {areas_, lengths_}; }

 private:
  Subdivision subdivision_;
  std::optional<PreparedGrid> grid_;
  std::optional<LonLatGrid> lines_;
  std::optional<StraightSides> straight_sides_;
  std::vector<Index> all_whole_;
  bool covers_sphere_ = false;
  bool are_apart_ = false;
  mutable std::once_flag are_overlaps_known_;
  mutable std::vector<CrossingCells> overlaps_;
  mutable std::once_flag is_any_overlap_known_;
  mutable bool has_any_overlap_ = false;
  mutable std::once_flag is_crossing_known_;
  mutable std::vector<CrossingCells> crossing_;
  std::vector<double> areas_;
  std::vector<double> defined_areas_;  // empty if cells have no areas by definition
  std::vector<Point> moments_;
  std::vector<double> lengths_;
};

// Returns the cells in the order of the input.
CellRings rings_of(const CellSetData& data);
CellRings rings_of(const Subdivision& cells);
// Returns the same with rings that begin where those of the input did.
CellRings given_rings_of(const CellSetData& data);

// Throws InvalidInput if the cells are those of a grid, whose sides are no great circles.
void require_arcs(const CellSetData& cells);

}  // namespace rondel::overlay
