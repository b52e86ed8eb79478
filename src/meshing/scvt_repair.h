// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Repairs small defects of a centroidal tessellation. Where rows of cells end, four sites may lie
// nearly on one circle: the dual edge between them is short, and a triangle there may be obtuse.
// The sites are moved by as little as corrects that, some hundredths of the spacing.
//
//        c          The dual edge of ab is (cot c + cot d) / 2 times as long as ab; if that is
//      /   \        negative, the edge is cd instead. All requirements are bounds of cotangents: of
//     a --- b       the sum of two; of a single one where no triangle may be obtuse; or of the sum at
//      \   /        a and b where the edge should be cd, because cells then have 5, 6 or 7 sides.
//        d
//
// A violated bound is satisfied to first order by the smallest move of its sites, along the
// gradient; the bounds are taken in turn, again and again.
//
// in    sites of a tessellation, which of them are fixed
// out   moved sites, and the defects that are left
// index sites
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/scvt.h"
#include "rondel/types.h"

namespace rondel::mesh {

// Moves the sites. Those whose `is_fixed` is not 0 stay; it is empty if no site is fixed.
// Precondition: unit vectors that surround the center, without duplicates.
ScvtRepair repair(std::vector<Point>& sites, std::span<const std::uint8_t> is_fixed,
                  unsigned threads);

}  // namespace rondel::mesh
