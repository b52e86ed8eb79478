// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/triangulation.h"

#include <algorithm>
#include <utility>

namespace rondel {

Triangulation::Triangulation(TriangulationArrays arrays, const Options& options,
                             const BuildReport& report)
    : arrays_(std::move(arrays)), model_(options.model), sphere_(options.sphere), report_(report) {}

std::size_t Triangulation::num_vertices() const noexcept {
  return arrays_.num_sites - arrays_.duplicates.size() - arrays_.hidden.size();
}

bool Triangulation::is_ghost(Index face) const noexcept {
  return std::ranges::binary_search(arrays_.ghost_faces, face);
}

}  // namespace rondel
