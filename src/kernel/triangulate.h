// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From sites in spatial order to the arrays of the result.
#pragma once

#include <span>
#include <vector>

#include "order/renamed.h"
#include "rondel/types.h"
#include "system/job.h"
#include "topology/triangulation_arrays.h"

namespace rondel::kernel {

struct Triangulated {
  TriangulationArrays arrays;  // but for duplicates, num_sites and the faces of hidden sites
  Builder builder = Builder::incremental;
  Tally tally;
};

// `order` lists the distinct sites by rank, and is taken so that it can be freed early; `renamed` the
// ranks that are reported by another input index.
Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                         std::span<const order::Renamed> renamed, const system::Job& options);

}  // namespace rondel::kernel
