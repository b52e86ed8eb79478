// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of a build, or of a piece of it.
//
// in    sites as users give them, and an order of some of them
// out   where they are on the cube, and how far from the center
// index a rank in this order: of a build the spatial rank, of a piece the local site
#pragma once

#include <span>

#include "order/place_keys.h"
#include "rondel/triangulation.h"
#include "system/job.h"
#include "system/site_copies.h"

namespace rondel::bulk {

// Distances of all sites from the center, at least and at most, of weighted sites; of projected
// ones, whose lengths do not count, 1.
struct Extent {
  double min_size = 1;
  double max_size = 1;
};

struct Input {
  std::span<const Point> sites;
  std::span<const Index> order;  // the site of each rank
  system::Job options;
  system::SiteCopies copies{};  // of the sites by rank, or none
  Extent extent{};

  [[nodiscard]] const Point& point(Index rank) const { return sites[order[rank]]; }
  [[nodiscard]] const Point& center() const { return options.sphere.center; }
  [[nodiscard]] order::CubePosition position(Index rank) const {
    return order::place_position(point(rank), options.model, center());
  }

  // The ranks begin ... end-1, which become 0, 1, ...
  [[nodiscard]] Input piece(Index begin, Index end) const {
    return {sites, order.subspan(begin, end - begin), options, copies.from(begin), extent};
  }
};

// Also finds the extent.
Input make_input(std::span<const Point> sites, std::span<const Index> order,
                 const system::Job& options, const system::SiteCopies& copies = {});

}  // namespace rondel::bulk
