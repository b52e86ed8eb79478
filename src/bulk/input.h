// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of a bulk build.
#pragma once

#include <span>

#include "bulk/square_sites.h"
#include "order/cube_position.h"
#include "rondel/triangulation.h"
#include "system/job.h"
#include "system/site_copies.h"

namespace rondel::bulk {

// The sites of a build and what is known of all.
struct Input {
  std::span<const Point> sites;
  std::span<const Index> order;  // the site of each rank
  system::Job options;
  system::SiteCopies copies{};  // of the sites by rank, or none
  Extent extent{};

  [[nodiscard]] order::CubePosition position(Index rank) const {
    const Point& center = options.sphere.center;
    const bool is_rounding_harmless = options.model == Model::weighted || center == Point{};
    return is_rounding_harmless ? order::cube_position(sites[order[rank]], center)
                                : order::exact_cube_position(sites[order[rank]], center);
  }
};

// Also finds the extent.
Input make_input(std::span<const Point> sites, std::span<const Index> order,
                 const system::Job& options, const system::SiteCopies& copies = {});

}  // namespace rondel::bulk
