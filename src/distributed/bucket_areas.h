// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the areas of the cells of a bucket's sites, with the same bits as for all sites
// together: the faces at some sites form a surface with a border, and the same sums are taken over
// it.
//
// in    the surface of a bucket, points, and the numbers of its faces
// out   areas by rank
// index ranks and codes of the bucket; in a piece, local sites and faces
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "distributed/bucket_surface.h"
#include "system/job.h"

namespace rondel::distributed {

// The parts of a triangulation from which the areas of a bucket's cells are computed.
struct AreaInput {
  const BucketSurface& surface;
  std::span<const Point> points;       // by rank
  std::span<const Point> open_points;  // open points of all buckets
  std::vector<Point> landmarks;        // landmarks of all sites (bulk/bucket.h)
  // Returns the number of a face among those of all buckets, given its code.
  std::function<GlobalIndex(Index)> number;
};

// Returns the areas on the unit sphere by rank, 0 for hidden sites. The work is done in pieces of
// `piece_sites` sites.
std::vector<double> bucket_areas(const AreaInput& input, const system::Job& options,
                                 std::size_t piece_sites = std::size_t{1} << 15);

}  // namespace rondel::distributed
