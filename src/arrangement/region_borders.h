// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The borders of regions in an arrangement.
//
// in    an arrangement of the sides of polygons, and the halfedges on the borders of regions
// out   the polygons of each edge; the rings of each region
// index halfedges as in halfedges.h
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "arrangement/coverage.h"
#include "arrangement/halfedges.h"
#include "arrangement/set_regions.h"
#include "rondel/arrangement.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Returns the polygons of each edge, of which an odd number of rings runs along it. polygons[k] is
// the polygon of arc k, or no_index.
CompressedRows<EdgeOfPolygon> polygons_of_edges(const Arrangement& arranged,
                                                std::span<const Index> polygons);

// A halfedge with a region to its left, and not to its right.
struct BorderHalfedge {
  RegionKey key;
  Index halfedge;
  friend auto operator<=>(const BorderHalfedge&, const BorderHalfedge&) = default;
};

// Returns the regions that have a border, of which the halfedges are sorted.
std::vector<Region> bordered_regions(const Arrangement& arranged, const Halfedges& halfedges,
                                     std::span<const BorderHalfedge> border);

}  // namespace rondel::arrangement
