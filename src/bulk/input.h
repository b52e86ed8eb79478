// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of a bulk build.
#pragma once

#include <span>

#include "blocks/cube_position.h"
#include "blocks/site_copies.h"
#include "bulk/cell_sites.h"
#include "rondel/triangulation.h"

namespace rondel::bulk {

// The sites of a build and what is known of all.
struct Input {
  std::span<const Point> sites;
  std::span<const Index> order;  // the site of each rank
  Options options;
  blocks::SiteCopies copies{};  // of the sites by rank, or none
  Extent extent{};

  [[nodiscard]] blocks::CubePosition position(Index rank) const {
    const Point& center = options.sphere.center;
    const bool is_rounding_harmless = options.model == Model::weighted || center == Point{};
    return is_rounding_harmless ? blocks::cube_position(sites[order[rank]], center)
                                : blocks::exact_cube_position(sites[order[rank]], center);
  }
};

// Also finds the extent.
Input make_input(std::span<const Point> sites, std::span<const Index> order, const Options& options,
                 const blocks::SiteCopies& copies = {});

}  // namespace rondel::bulk
