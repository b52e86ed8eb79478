// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a rank keeps of a triangulation.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bulk/bucket_faces.h"
#include "distributed/joined_part.h"
#include "distributed/rank_buckets.h"
#include "rondel/distributed.h"

namespace rondel {

struct DistributedTriangulation::Impl {
  static const Impl& of(const DistributedTriangulation& triangulation) {
    return *triangulation.impl_;
  }

  int dimension = -1;
  std::uint64_t num_sites = 0;  // and so on: of all ranks
  std::uint64_t num_vertices = 0;
  std::uint64_t num_faces = 0;
  std::uint64_t num_ghost_faces = 0;
  std::uint64_t num_duplicates = 0;
  std::uint64_t num_hidden = 0;
  std::uint64_t num_open_sites = 0;

  Options options;
  std::uint64_t first_number = 0;         // of all sites
  std::vector<std::uint64_t> first_site;  // of each rank, and behind the last one, from 0 on

  std::uint64_t first_face = 0;
  std::uint64_t num_own_faces = 0;
  std::vector<std::uint64_t> ghost_faces;
  std::vector<std::uint64_t> ring;
  std::vector<GlobalDuplicate> duplicates;
  std::vector<std::uint64_t> hidden;

  // For areas and circumcenters, as are the points of `own` and `part`.
  bool has_points = false;
  std::vector<Point> landmarks;                   // of all sites
  std::vector<distributed::SiteArea> flat_areas;  // below dimension 2, of all vertices, on rank 0

  distributed::RankBuckets own;
  distributed::JoinedPart part;
  // By bucket; they look at `own` and `part`, which stay where they are. None below dimension 2.
  std::vector<bulk::BucketFaces> faces;
  std::unique_ptr<bulk::JoinedNumbers> numbers;  // with `has_points`, of all faces in `part`
};

}  // namespace rondel
