// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cuts cells that overlap into parts that do not.
//
// in    a set of cells, a mask, the rule for overlaps
// out   the parts with the cells that own each, and tables of parts converted to tables of cells
// index parts, from 0; cells by their indices in the input
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "overlay/cell_set_data.h"
#include "overlay/pieces.h"
#include "rondel/compressed_rows.h"
#include "rondel/remap.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The cells that take part in an overlay, as given or cut into parts.
struct OverlaySide {
  // The cells or the parts.
  const CellSetData* data = nullptr;
  std::shared_ptr<const CellSetData> parts = nullptr;  // owns `data` if these are parts
  // Part k belongs to the cells owners[k], in equal shares or to each as a whole. There are no rows
  // if `data` has the cells themselves.
  CompressedRows<Index> owners = {};
  bool is_whole_for_each = false;

  [[nodiscard]] bool has_parts() const { return parts != nullptr; }
  [[nodiscard]] std::span<const Index> owners_of(const Index& part) const;
  // Returns what one of the owners of a part has of it.
  [[nodiscard]] double share_of(const Index& part) const {
    return is_whole_for_each ? 1 : 1.0 / static_cast<double>(owners_of(part).size());
  }
};

// Returns the cells that are not masked. If some of them overlap and `rule` is error, or if one
// overlaps itself, throws InvalidInput with `what` ("source" or "target"), the cells by their numbers
// and names, a place, and the rules that take such cells.
OverlaySide taking_part(const CellSetData& cells, const CellFacts& facts, CellOverlap rule,
                        const char* what, const Execution& execution);

// Converts rows and columns of parts into those of the cells that own them.
PieceRows joined_parts(PieceRows pieces, const OverlaySide& rows, std::size_t num_rows,
                       const OverlaySide& columns);

// The part of each cell that counts in the overlay: its area (steradians), its first moment, and
// the length of its border.
class CountedSizes {
 public:
  CountedSizes(const CellSetData& cells, const OverlaySide& part, Borders borders);
  [[nodiscard]] const std::vector<double>& areas() const {
    return of_parts_ ? areas_ : cells_.areas(borders_);
  }
  [[nodiscard]] const std::vector<double>& lengths() const {
    return of_parts_ ? lengths_ : cells_.lengths(borders_);
  }
  [[nodiscard]] std::vector<Point> moments() const {
    return of_parts_ ? moments_ : cells_.moments(borders_);
  }

 private:
  const CellSetData& cells_;
  Borders borders_;
  bool of_parts_;
  std::vector<double> areas_;
  std::vector<double> lengths_;
  std::vector<Point> moments_;
};

}  // namespace rondel::overlay
