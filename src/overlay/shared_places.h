// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells that overlap, cut into parts of which each has a share.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "overlay/partition_data.h"
#include "overlay/pieces.h"
#include "rondel/remap.h"
#include "rondel/types.h"

namespace rondel::overlay {

// What takes part in an overlay: the cells as they are, or parts of them.
struct TakingPart {
  const PartitionData* data = nullptr;
  std::shared_ptr<const PartitionData> parts = nullptr;  // owns `data`, if these are not the cells
  // Of each part, which cell it is of and how much of its area counts; empty if these are the cells.
  std::vector<Index> owners = {};
  std::vector<double> shares = {};
};

// The cells that are not masked. Throws InvalidInput if some of them overlap and `rule` is error, or if one overlaps itself,
// with `what` they are, the cells and a place.
TakingPart taking_part(const PartitionData& cells, const std::vector<std::int32_t>& mask,
                       CellOverlap rule, const char* what, const Execution& execution);

// Rows and columns of parts, as those of their cells.
PieceRows joined_parts(PieceRows pieces, const TakingPart& rows, std::size_t num_rows,
                       const TakingPart& columns);

// By cell: the area that counts, and its first moment.
struct CountedSizes {
  std::vector<double> areas;
  std::vector<double> lengths;
  std::vector<Point> moments;
};
CountedSizes counted_sizes(const PartitionData& cells, const TakingPart& part);

}  // namespace rondel::overlay
