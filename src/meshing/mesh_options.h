// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The options of a mesh, which all functions that make one check in the same way.
//
// in    a radius in units of length, densities by site
// out   an exception that names what is wrong
#pragma once

#include <cstddef>

#include "rondel/mesh.h"

namespace rondel::meshing {

// Throws InvalidInput if the radius is not positive and finite, or the densities are not one
// positive number a site.
void require_options(const mesh::MeshOptions& options, std::size_t num_sites);

}  // namespace rondel::meshing
