// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes of triangles for tests.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "rondel/triangle_mesh.h"

namespace rondel::test {

// Random positions, the poles, and some on the antimeridian and the equator.
std::vector<LonLat> positions_with_poles(std::size_t count, std::uint64_t seed);

// The Delaunay triangles of positions for which is_kept(middle, number) is true.
std::vector<Triple> some_triangles_of(
    const std::vector<LonLat>& positions,
    const std::function<bool(const Point&, std::size_t)>& is_kept);

// A mesh of such triangles, where an edge is coast if is_coast(its middle) is true.
mesh::TriangleMesh mesh_of(const std::vector<LonLat>& positions,
                           const std::function<bool(const Point&, std::size_t)>& is_kept,
                           const std::function<bool(const Point&)>& is_coast);

// A basin around the north pole with islands, whose coast is open in the half of positive x, and
// depths, levels and types.
mesh::TriangleMesh arctic_mesh(std::uint64_t seed);

// The mesh of all oceans but two round continents and a pole.
mesh::TriangleMesh global_mesh(std::uint64_t seed);

}  // namespace rondel::test
