// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Removes the parts of rings that have no inside.
//
// index cells, as in the input: their number does not change
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns the cells without sides that cancel (spikes and keyholes) and without rings no wider than
// rounding of their corners. Only cells of Shape::other change. `known` is the subdivision of
// `cells`. Returns nothing if no cell changes. Throws InvalidInput for a cell of which nothing is
// left although a ring of it is wider than rounding.
std::optional<CellRings> tidied(const CellRings& cells, const Subdivision& known);

// Returns false only for cells which tidied() does not change if their sides do not meet: none of
// their rings turns back on itself or is no wider than rounding.
bool may_be_untidy(const CellRings& cells, const Subdivision& known, unsigned threads);

// Whether tidying has made a region its complement: its area was less than half of the sphere, and
// is more, or the other way. That happens where rounding is all that is left of one of the two; if
// wide rings are left, the region crosses itself.
enum class Inversion : std::uint8_t { none, of_rounding, of_wide_rings };

// A cell, and its area.
struct MeasuredCell {
  const CellRings& cells;
  std::size_t cell;
  double area;
};
Inversion inversion_of(const MeasuredCell& before, const MeasuredCell& after);

// True if a ring of the cell crosses itself by more than rounding and has no area, such as a bow
// tie with two equal loops.
bool has_balanced_crossing(const CellRings& cells, std::size_t cell);

// Returns the tidied() cells as a subdivision. Which parts of a cover are inside of a cell can only
// be found if the cell's sides do not cross. Where they cross because a corner is on a side up to
// rounding, this corner becomes a corner of the side, in all cells that have the side. `whole`
// lists the cells that are the whole sphere, by their indices in the input: before the call those
// of `cells`, after it those of the result.
Subdivision sound_cells(const CellRings& cells, std::vector<Index>& whole,
                        const Execution& execution);

}  // namespace rondel::overlay
