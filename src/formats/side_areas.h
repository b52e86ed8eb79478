// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sums over cells, such as people per cell: their densities are carried, and become sums again at the target, so
// that each target gets its share of the sum of each source.
//
// in    a side of a regridding, a field's attribute cell_methods
// out   areas of its cells in steradians
// index cells, in the order of the side
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "formats/regrid_side.h"
#include "rondel/fields.h"
#include "rondel/remap.h"
#include "rondel/types.h"

namespace rondel::formats {

// True if the attribute cell_methods of an array says that its values are sums over cells.
bool has_sums_over_cells(const FieldArray& array);
// Says in the attribute cell_methods what was done over the area of a cell: "mean", "sum" ...
void add_cell_method(std::string_view method, FieldArray& array);

// The areas of the cells of a side. Those between parallels take no room for each cell.
class SideAreas {
 public:
  // Precondition: the side was read with cells.
  SideAreas(RegridSide& side, const Execution& execution);

  // Turns sums over the cells from `first` on into densities. A sum over an empty cell is missing.
  void divide(std::size_t first, std::span<double> sums) const;

 private:
  [[nodiscard]] double at(std::size_t cell) const;

  std::vector<double> rows_;     // of a grid between parallels: differences of sines; or all areas
  std::vector<double> columns_;  // of a grid between parallels: radians; else empty
};

// Returns the areas by which densities at targets become sums: those of the targets, or of their covered parts,
// as the weights have them.
std::vector<double> areas_of_sums(std::span<const double> target_areas,
                                  std::span<const double> fractions, RemapNorm norm);

}  // namespace rondel::formats
