// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::overlay {

// For each point the first one before it, or itself, that is as near as `distance` in each coordinate and has no such
// point itself.
std::vector<Index> same_nodes(std::span<const Point> points, double distance);

}  // namespace rondel::overlay
