// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The data of a triangulation that each rank keeps.
//
// index sites and faces of all ranks, counted through
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "distributed/bucket_faces.h"
#include "distributed/joined_part.h"
#include "distributed/rank_buckets.h"
#include "rondel/distributed.h"

namespace rondel {

struct DistributedTriangulation::Impl {
  static const Impl& of(const DistributedTriangulation& triangulation) {
    return *triangulation.impl_;
  }

  int dimension = -1;
  std::uint64_t num_sites = 0;  // this and the next ones: of all ranks
  std::uint64_t num_vertices = 0;
  std::uint64_t num_faces = 0;
  std::uint64_t num_ghost_faces = 0;
  std::uint64_t num_duplicates = 0;
  std::uint64_t num_hidden = 0;
  std::uint64_t num_open_sites = 0;

  Options options;
  std::uint64_t first_number = 0;         // number of the first site of all
  std::vector<std::uint64_t> first_site;  // by rank, from 0 on; then the number of all sites

  std::uint64_t first_face = 0;
  std::uint64_t num_own_faces = 0;
  std::vector<std::uint64_t> ghost_faces;
  std::vector<std::uint64_t> ring;
  std::vector<GlobalDuplicate> duplicates;
  std::vector<std::uint64_t> hidden;

  // Points are kept for areas and circumcenters, here and in `own` and `part`.
  bool has_points = false;
  std::vector<Point> landmarks;                   // of all sites
  std::vector<distributed::SiteArea> flat_areas;  // below dimension 2: areas of all vertices, on
                                                  // rank 0

  distributed::RankBuckets own;
  distributed::JoinedPart part;
  // The faces by bucket; they refer to `own` and `part`, which are not moved. Empty below dimension
  // 2.
  std::vector<distributed::BucketFaces> faces;
  std::unique_ptr<distributed::JoinedNumbers>
      numbers;  // numbers of all faces in `part`, if `has_points`
};

}  // namespace rondel
