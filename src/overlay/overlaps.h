// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds cells that overlap each other or themselves by more than rounding of their corners.
//
// in    a subdivision
// out   pairs of cells, each with a place that is in both cells
// index pairs: indices of the cells in the input
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/cell_rings.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns the pairs of cells that overlap, each once, in lexicographic order. `whole` has the
// indices of cells that are the whole sphere.
std::vector<CrossingCells> overlaps_of(const Subdivision& cells, std::span<const Index> whole,
                                       const Execution& execution);

// Which overlaps are wanted. Of many cells within each other all pairs take long.
enum class OverlapsWanted : std::uint8_t {
  all,
  any,    // one, if there are some
  first,  // the first pair of all
  cells,  // one or more for each cell that overlaps others
};

// Returns the wanted overlaps of cells that are not the whole sphere, and perhaps others, in
// lexicographic order. Cells that overlap themselves are always there. The mask, by indices of the
// input, leaves out cells for which it is 0; if it is empty, none.
std::vector<CrossingCells> some_overlaps(const Subdivision& cells, OverlapsWanted wanted,
                                         std::span<const std::int32_t> mask,
                                         const Execution& execution);

// Returns the cells that cross or overlap themselves by more than rounding, each as a pair of the
// cell with itself, by ascending indices of the input.
std::vector<CrossingCells> cells_crossing_themselves(const Subdivision& cells,
                                                     const Execution& execution);

// True if no cell crosses or overlaps itself, not even by rounding. That is found faster than a
// place where a cell does.
bool are_exactly_valid(const CellRings& cells, const Execution& execution);

// Returns the pairs of cells that may overlap, also by less than rounding, with the lower index of
// the input first. Others are certainly apart.
std::vector<std::pair<Index, Index>> near_cells(const Subdivision& cells, unsigned threads);

// Returns "crosses or overlaps itself at 12.5000 40.2500" for a pair of a cell with itself.
std::string fault_of(const CrossingCells& crossing);
// Returns "cells 3 and 17 overlap at 12.5000 40.2500", or "cell 3" and its fault for a pair of a
// cell with itself; columns with names of the cells add these, "cell 3 (Peru)".
std::string message_of(const CrossingCells& overlap, std::span<const Column> columns = {});

// Returns some of the cells, given by their places in spatial order, in this order.
CellRings rings_of(const Subdivision& cells, std::span<const Index> some);

}  // namespace rondel::overlay
