// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells that overlap, cut into parts that are apart.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "overlay/partition_data.h"
#include "overlay/pieces.h"
#include "rondel/remap.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The cells that take part in an overlay, as they are or in parts.
struct TakingPart {
  const PartitionData* data = nullptr;
  std::shared_ptr<const PartitionData> parts = nullptr;  // owns `data`, if these are not the cells
  // The cells that have part k are owners[offsets[k]] to owners[offsets[k + 1] - 1]; each has its share of it. Both are empty if
  // the parts are the cells.
  std::vector<std::uint64_t> offsets = {};
  std::vector<Index> owners = {};

  [[nodiscard]] bool has_parts() const { return !offsets.empty(); }
  [[nodiscard]] std::span<const Index> owners_of(const Index& part) const;
};

// The cells that are not masked. Throws InvalidInput if some of them overlap and `rule` is error, or if one overlaps itself,
// with `what` they are, the cells and a place.
TakingPart taking_part(const PartitionData& cells, const std::vector<std::int32_t>& mask,
                       CellOverlap rule, const char* what, const Execution& execution);

// Rows and columns of parts, as those of their cells.
PieceRows joined_parts(PieceRows pieces, const TakingPart& rows, std::size_t num_rows,
                       const TakingPart& columns);

// Sums for each cell: the area that counts, its first moment, and the length of its borders.
class CountedSizes {
 public:
  CountedSizes(const PartitionData& cells, const TakingPart& part);
  [[nodiscard]] const std::vector<double>& areas() const {
    return of_parts_ ? areas_ : cells_.areas();
  }
  [[nodiscard]] const std::vector<double>& lengths() const {
    return of_parts_ ? lengths_ : cells_.lengths();
  }
  [[nodiscard]] const std::vector<Point>& moments() const {
    return of_parts_ ? moments_ : cells_.moments();
  }

 private:
  const PartitionData& cells_;
  bool of_parts_;
  std::vector<double> areas_;
  std::vector<double> lengths_;
  std::vector<Point> moments_;
};

}  // namespace rondel::overlay
