// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The vertices of a finished triangulation under internal names that suit queries: their spatial
// rank in dimension 2, so that neighbors are close in memory; their place in the ring below.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "topology/mesh.h"

namespace rondel::query {

struct Vertices {
  std::vector<Index> names;         // the input index of each vertex
  std::vector<Index> speakers;      // the site whose coordinates count: of duplicates the smallest
  std::vector<Index> vertex_of;     // the vertex of each site; no_index for hidden ones
  std::vector<std::uint64_t> keys;  // sorted Hilbert keys
  std::vector<Index> at_key;        // their vertices; empty: 0, 1, 2 ...

  // A vertex near a place on the curve. Precondition: there is a vertex.
  [[nodiscard]] Index near(std::uint64_t key) const;
};

Vertices list_vertices(const Triangulation& triangulation, std::span<const Point> sites);

// For each vertex 3*face + corner of one of its faces.
std::vector<topology::Halfedge> corners_of(const topology::Mesh& mesh, std::size_t num_vertices);

}  // namespace rondel::query
