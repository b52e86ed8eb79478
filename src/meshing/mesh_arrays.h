// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the functions that make the arrays of a mesh or write them share: the check of the options,
// and the rows of tangential_weights(), one by one, so that files are written without memory for
// all of them.
//
// in    the arrays of a mesh, an edge
// out   the edges and weights of its row
// index edges of the mesh; a row begins after the edge, counterclockwise around its first cell,
// then around its second one
#pragma once

#include <cstddef>
#include <span>

#include "rondel/mesh.h"

namespace rondel::meshing {

// Returns how many entries the row of an edge has.
std::size_t num_weights(const mesh::VoronoiMesh& arrays, std::size_t edge);

// Writes the row of an edge to the first num_weights() elements; either span may be empty.
void write_weights(const mesh::VoronoiMesh& arrays, std::size_t edge, std::span<Index> edges,
                   std::span<double> weights);

// Throws InvalidInput if the radius is not positive and finite, or the densities are not one
// positive number a site.
void require_options(const mesh::MeshOptions& options, std::size_t num_sites);

}  // namespace rondel::meshing
