// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The areas of the cells of a bucket's sites, in every bit those of all sites together: the faces at some
// sites are a surface with a border, and the same sums run over it.
//
// in    the surface of a bucket, points, and the numbers of its faces
// out   areas by rank
// index ranks and codes of the bucket; in a piece, local sites and faces
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "bulk/bucket_surface.h"
#include "system/job.h"

namespace rondel::distributed {

struct AreaInput {
  const bulk::BucketSurface& surface;
  std::span<const Point> points;       // by rank
  std::span<const Point> open_points;  // of all buckets
  std::vector<Point> landmarks;        // of all sites
  // The number of a face, by its code.
  std::function<bulk::GlobalIndex(Index)> number;
};

// 0 for hidden sites. In pieces of so many sites.
std::vector<double> bucket_areas(const AreaInput& input, const system::Job& options,
                                 std::size_t piece_sites = std::size_t{1} << 15);

}  // namespace rondel::distributed
