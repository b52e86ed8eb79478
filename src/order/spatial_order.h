// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The spatial order: by Hilbert key on the cube's faces, then lexicographically by coordinates. It
// finds the duplicates on the way, which have equal keys.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "order/place_keys.h"
#include "order/renamed.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/site_copies.h"

namespace rondel::order {

struct SpatialOrder {
  // For each rank, the site whose coordinates count. Among duplicates that is the lexicographically
  // smallest one, so that the input order changes nothing.
  std::vector<Index> order;
  // In increasing order of `site`. The representative is the lowest index: it names the vertex.
  std::vector<Duplicate> duplicates;
  std::vector<Renamed> renamed;  // in increasing order of rank
};

// Looks at sites before they are used, at all of them, some at a time, by several threads; throws
// if they must not be used.
using SitesCheck = std::function<void(std::span<const Point>)>;

// The result does not depend on `threads`, of which 0 means one for each core. Needs 16 bytes for
// each site, the order included, unless many sites lie within 2^-28 of each other.
//
// Unless `copies` is empty it has room for all sites, those in `order` are copied to it by rank,
// and 24 bytes more are needed for each site meanwhile.
RONDEL_API SpatialOrder spatial_order(std::span<const Point> sites, Model model,
                                      const Point& center, unsigned threads,
                                      const SitesCheck& check = {},
                                      const system::SiteCopies& copies = {});

// Sites in one place, for sites that need no order.
// The duplicates among the sites listed, in increasing order of `site`. `listed` is increasing.
std::vector<Duplicate> find_duplicates(std::span<const Point> sites, std::span<const Index> listed);

}  // namespace rondel::order
