// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>

#include "rondel/mesh.h"

namespace rondel::meshing {

// Throws InvalidInput for a radius or densities that a mesh of so many cells cannot have.
void require_options(const mesh::MeshOptions& options, std::size_t num_sites);

}  // namespace rondel::meshing
