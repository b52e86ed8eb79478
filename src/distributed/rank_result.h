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
  int dimension = -1;
  std::uint64_t num_sites = 0;  // and so on: of all ranks
  std::uint64_t num_vertices = 0;
  std::uint64_t num_faces = 0;
  std::uint64_t num_ghost_faces = 0;
  std::uint64_t num_duplicates = 0;
  std::uint64_t num_hidden = 0;
  std::uint64_t num_open_sites = 0;

  std::uint64_t first_face = 0;
  std::uint64_t num_own_faces = 0;
  std::vector<std::uint64_t> ghost_faces;
  std::vector<std::uint64_t> ring;
  std::vector<GlobalDuplicate> duplicates;
  std::vector<std::uint64_t> hidden;

  distributed::RankBuckets own;
  distributed::JoinedPart part;
  // By bucket; they look at `own` and `part`, which stay where they are. None below dimension 2.
  std::vector<bulk::BucketFaces> faces;
  std::unique_ptr<bulk::JoinedNumbers> numbers;
};

}  // namespace rondel
