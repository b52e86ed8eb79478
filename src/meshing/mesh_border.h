// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The border of triangles: the edges that one triangle has alone, and what is wrong with a mesh.
//
// in    triangles, counterclockwise
// out   edges of the border, each from one node to another one with its triangle to the left
// index nodes and triangles as given
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondel/triangle_mesh.h"

namespace rondel::meshing {

// Throws InvalidInput for the first triangle with a corner that is no node.
void require_corners(std::size_t num_nodes, std::span<const Triple> triangles, Index base = 0);

// Finds the border, edges in the order of their triangles. Throws InvalidInput (the triangle) if a
// corner is no node, or two triangles have an edge in one direction. Messages give
// the first element the number `base`.
std::vector<std::array<Index, 2>> border_of(std::size_t num_nodes,
                                            std::span<const Triple> triangles, Index base = 0);

// Returns edges without their directions, the lower node first, sorted.
std::vector<std::array<Index, 2>> undirected(std::vector<std::array<Index, 2>> edges);

// Returns the sides of triangles, each as often as triangles have it, the lower node first, sorted.
std::vector<std::array<Index, 2>> sides_of(std::span<const Triple> triangles);

// Returns the loops of a border, without repeated nodes, each from its lowest node and in the order
// of these. Loops that touch are apart.
std::vector<std::vector<Index>> loops_of(std::span<const Point> points,
                                         std::span<const std::array<Index, 2>> border);

// The parts of a mesh that may be wrong.
enum class MeshPart : std::uint8_t { mesh, node, triangle, segment };

// The fault of a mesh.
struct MeshFault {
  MeshPart part = MeshPart::mesh;
  std::size_t index = 0;  // of the node, triangle or segment
  std::string text;       // names it, with numbers that begin with `base`
};

// Returns the first fault of a mesh, as mesh::require_valid() says; nothing if there is none.
std::optional<MeshFault> fault_of(const mesh::TriangleMesh& mesh, Index base = 0);

// ADCIRC's types of boundaries: those of islands, the usual one of a kind, and those that have numbers
// at their nodes, which a segment does not hold. Of the latter, weirs and pipes have pairs of nodes.
inline bool is_island_type(std::int64_t type) { return type == 1 || type == 11 || type == 21; }
inline std::int32_t usual_type(mesh::BoundaryKind kind) {
  return kind == mesh::BoundaryKind::island ? 1 : 0;
}
inline bool is_pair_type(std::int64_t type) {
  return type == 4 || type == 5 || type == 24 || type == 25 || type == 64;
}
inline bool is_barrier_type(std::int64_t type) {
  return is_pair_type(type) || type == 3 || type == 13 || type == 23;
}
// The largest number of a type.
inline constexpr std::int32_t largest_type = 999;

// Divides the border into segments, as mesh::boundary_segments() does.
std::vector<mesh::BoundarySegment> segments_of(
    std::span<const Point> points, std::span<const std::array<Index, 2>> border,
    const std::optional<std::span<const std::array<Index, 2>>>& coast);

}  // namespace rondel::meshing
