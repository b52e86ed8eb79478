// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <vector>

#include "overlay/partition_data.h"
#include "rondel/regions.h"

namespace rondel::overlay {

// The cells, of which those that overlap are one: the first of them is their union, and the others are empty. Nothing if
// none do. Throws InvalidInput if a cell overlaps itself, with `what` the cells are.
std::optional<Partition> united(const PartitionData& cells, const char* what,
                                const Execution& execution);

}  // namespace rondel::overlay
