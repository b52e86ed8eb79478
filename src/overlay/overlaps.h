// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of one partition that overlap each other or themselves by more than rounding of their corners.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/cell_rings.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The pairs of cells that overlap, by name, in lexicographic order, each once. `whole` are the names of cells that are the whole
// sphere.
std::vector<CrossingCells> overlaps_of(const Subdivision& cells, std::span<const Index> whole,
                                       const Execution& execution);

// "cells 3 and 17 overlap at 12.5000 40.2500", or that a cell crosses or overlaps itself.
std::string message_of(const CrossingCells& overlap);

// Some of the cells, in this order.
CellRings rings_of(const Subdivision& cells, std::span<const Index> some);

}  // namespace rondel::overlay
