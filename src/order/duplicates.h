// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites in one place, for sites that need no order.
#pragma once

#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::order {

// The duplicates among the sites listed, in increasing order of `site`. `listed` is increasing.
std::vector<Duplicate> find_duplicates(std::span<const Point> sites, std::span<const Index> listed);

}  // namespace rondel::order
