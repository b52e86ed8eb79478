// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a Triangulation is made of while it is being made; rondel/triangulation.h says what each means.
#pragma once

#include <cstddef>
#include <vector>

#include "rondel/triangulation.h"
#include "system/large_arrays.h"

namespace rondel {

struct TriangulationArrays {
  std::size_t num_sites = 0;
  int dimension = -1;
  LargeVector<Triple> faces;
  LargeVector<Triple> neighbors;
  std::vector<Index> ghost_faces;
  std::vector<Index> ring;
  std::vector<Duplicate> duplicates;
  std::vector<Hidden> hidden;
};

}  // namespace rondel
