// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// New numbers for places and faces, so that what is close on the sphere is close in memory.
//
// Places and faces get the numbers that are free when they come. After many changes in random
// places, the neighborhood that a change reads is spread over all of memory, a miss of the caches
// for each vertex and each face. Renumbering along the spatial order brings it together again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::dynamic {

// Tells when: after the number of places has doubled or halved, so that the work is constant for
// each change, whatever the changes are.
class RenumberingSchedule {
 public:
  // Whether it is due with so many places.
  [[nodiscard]] bool is_due(std::size_t size) const {
    constexpr std::size_t least = 16;
    return size > std::max(last_ + last_ / 2, least) || size + size / 2 + least < last_;
  }
  void done(std::size_t size) { last_ = size; }

 private:
  std::size_t last_ = 0;
};

// Numbers are dense afterwards.
struct Renumbering {
  Renumbering(std::vector<Index> old_places, Index place_limit);

  std::vector<Index> old_place;  // by new number
  std::vector<Index> new_place;  // by old number; no_index for those that are not in use
};

// A mesh with new vertices and faces: those that have the same least vertex follow each other, in
// the order of these vertices.
struct RenumberedMesh {
  topology::Mesh mesh;
  std::vector<Index> new_face;  // by old number
};
RenumberedMesh renumber(const topology::Mesh& mesh, const Renumbering& places);

}  // namespace rondel::dynamic
