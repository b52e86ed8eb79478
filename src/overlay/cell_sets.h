// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Single cells, taken from others, turned inside out and put together.
#pragma once

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

CellRings one_cell(const CellRings& cells, Index cell);
// The complement of a cell.
CellRings beyond_cell(CellRings one);
[[nodiscard]] bool has_any(const CellRings& one);
// One cell more. Points are its own.
void append(const CellRings& one, CellRings& all);
// Makes points that are equal bit by bit one, so that cells share the sides that they have in common.
void merge_equal_points(CellRings& cells);

}  // namespace rondel::overlay
