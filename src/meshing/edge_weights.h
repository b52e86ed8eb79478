// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The rows of tangential_weights(), one by one: files are written without room for all.
#pragma once

#include <cstddef>
#include <span>

#include "rondel/mesh.h"

namespace rondel::meshing {

// How many entries the row of an edge has.
std::size_t num_weights(const mesh::MeshArrays& arrays, std::size_t edge);

// Writes the row of an edge to the first num_weights() places; either span may be empty.
void write_weights(const mesh::MeshArrays& arrays, std::size_t edge, std::span<Index> edges,
                   std::span<double> weights);

}  // namespace rondel::meshing
