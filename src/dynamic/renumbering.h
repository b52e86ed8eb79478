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

#include "rondel/export.h"
#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::dynamic {

// Tells when: after the number of places has grown or shrunk by a factor, so that the work is
// constant for each change, whatever the changes are.
class RenumberingSchedule {
 public:
  // The largest number of places before it is due, if it was done with so many.
  static constexpr std::size_t limit(std::size_t size) { return 2 * size + least; }

  // Whether it is due with so many places.
  [[nodiscard]] bool is_due(std::size_t size) const {
    return size > limit(last_) || limit(size) < last_;
  }
  void done(std::size_t size) { last_ = size; }

 private:
  // Small enough that each test of changes meets it.
  static constexpr std::size_t least = 8;

  std::size_t last_ = 0;
};

// Numbers are dense afterwards.
struct RONDEL_API Renumbering {
  Renumbering(std::vector<Index> old_places, Index place_limit);

  // How many places there may be before the next one.
  [[nodiscard]] std::size_t room() const { return RenumberingSchedule::limit(old_place.size()); }

  std::vector<Index> old_place;  // by new number
  std::vector<Index> new_place;  // by old number; no_index for those that are not in use
};

// A mesh with new vertices and faces: those that have the same least vertex follow each other, in
// the order of these vertices.
struct RenumberedMesh {
  topology::Mesh mesh;
  std::vector<Index> new_face;  // by old number
};
RONDEL_API RenumberedMesh renumber(const topology::Mesh& mesh, const Renumbering& places);

}  // namespace rondel::dynamic
