// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where rows of cells end, four sites of a centroidal tessellation may lie nearly on one circle: the dual
// edge between them is short, and a triangle there may be obtuse. The sites are moved by as little as
// puts that right, some hundredths of the spacing.
//
//        c          The dual edge of ab is (cot c + cot d) / 2 times as long as ab, and shorter than
//      /   \        nothing where that is negative: then the edge is cd. All that is asked for is a bound
//     a --- b       of cotangents: of the sum of two, of one where no triangle shall be obtuse, or of the sum
//      \   /        at a and b where the edge shall be cd, because cells then have 5, 6 or 7 sides.
//        d
//
// A bound that is missed is met by the smallest move of its sites to first order, along its gradient; all
// bounds in turn, again and again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/scvt.h"
#include "rondel/types.h"

namespace rondel::mesh {

// Sites whose `is_fixed` is not 0 stay; empty: none does.
// Precondition: unit vectors that surround the center, without duplicates.
ScvtRepair repair(std::vector<Point>& sites, std::span<const std::uint8_t> is_fixed,
                  unsigned threads);

}  // namespace rondel::mesh
