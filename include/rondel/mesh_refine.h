// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Delaunay refinement: meshes of triangles with a smallest angle and a wanted spacing, whose edges
/// follow coasts and other lines (target rondel::geo).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/export.h"
#include "rondel/mesh_size.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The settings of refine().
struct RefineOptions {
  /// The smallest angle of triangles, in degrees, from 0 to 33. Below arcsin(1/sqrt(5)) = 26.56 the
  /// refinement is proved to end; beyond that it ended in all our tests, with more triangles.
  double smallest_angle_deg = 26.5;
  /// The wanted length of edges. No edge of a triangle is longer than 1.5 times the smallest
  /// spacing at its corners, both as chords. It should change slowly (SizeFunction::limited()): it
  /// is looked at where vertices are. Without it triangles grow as fast as their angles allow.
  std::optional<SizeFunction> spacing{};
  /// The most vertices that the mesh may have.
  std::size_t most_vertices = max_sites;
};

/// How a refinement went.
struct RefineReport {
  std::size_t num_divisions = 0;  ///< of constrained edges
  std::size_t num_inserted = 0;   ///< vertices inside
  std::size_t num_removed = 0;    ///< and those of them that were too close to a division
  /// Triangles with a smaller angle, the shortest edge of which is between two constrained edges
  /// that meet at less than 60 degrees, at equal distances from their common end.
  std::size_t num_near_small_angles = 0;
  /// All others that are not as wanted: doubles have no place for a vertex.
  std::size_t num_too_small = 0;
};

/// Triangles of a part of the sphere.
struct RefinedMesh {
  std::vector<Point> nodes;       ///< those of sites bit by bit as given; the others unit vectors
  std::vector<Index> sites;       ///< of each node; no_index: it was added
  std::vector<Triple> triangles;  ///< nodes, counterclockwise seen from outside
  std::vector<Index> regions;     ///< of each triangle
  /// The edges of triangles that are parts of constrained edges, or between regions, or at the
  /// border: two nodes, the lower one first, in lexicographic order.
  std::vector<std::array<Index, 2>> edges;
  /// The edge of ConstrainedTriangulation::edges that each is a part of; no_index: of none.
  std::vector<Index> sources;
  RefineReport report;
};

/// Refines triangles until none is larger than wanted or has a smaller angle than wanted.
///
/// 1. The triangles cover the faces of the given regions. No triangle crosses a constrained edge:
///    each of these is a chain of edges, which bends by the rounding of its points to doubles.
/// 2. They are those of constrained_delaunay() of all vertices and these chains.
/// 3. Each angle of a triangle, between its chords, is at least the smallest angle, except where
///    RefineReport counts triangles. Edges of triangles are at most 1.5 times the spacing,
///    both as chords.
/// 4. No edge is shorter than a part of the distances that the sites, the constrained edges and the
///    spacing have there; the proof is in docs/theory/refinement.md (Chew, Guaranteed-quality mesh
///    generation for curved surfaces, SoCG 1993; Shewchuk, Computational Geometry 22, 2002; Üngör,
///    Off-centers, Computational Geometry 42, 2009; Miller, Pav and Walkington, IMR 2003).
/// 5. The result depends neither on the order of sites and constraints, but for the numbers of
///    nodes, nor on the number of threads; one is used.
/// \param given  a triangulation around the origin, for example constrained_delaunay() of a coast
/// \param regions  for each face of it: a region; or no_index for faces that are not asked for,
///        which ghost faces never are. faces_inside() helps to find them.
/// \throws InvalidInput if there is not one region for each face, the center of the sphere is not
///         the origin, an option is not as described, or more vertices would be needed
RONDEL_API RefinedMesh refine(const ConstrainedTriangulation& given, std::span<const Index> regions,
                              const RefineOptions& options = {}, const Execution& execution = {});

}  // namespace rondel::mesh
