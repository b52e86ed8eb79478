// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes a mesh with a border from its sites and the rings of corners around them. Across an edge of
// the border, the missing Voronoi cell had its site at the reflection of the cell's site in that
// edge.
//
// in    cells of one ring each, how they meet, their sites
// out   the arrays of a mesh
// index cells and their sites; sides of rings (ring_surface.h)
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "meshing/ring_surface.h"
#include "rondel/mesh.h"
#include "rondel/query.h"

namespace rondel::meshing {

// The distance that a corner of a file may have from the corner of the mesh, in units of the
// spacing. It allows for files of single precision and for programs that compute circumcenters in
// the plane.
inline constexpr double corner_tolerance = 1e-3;

// The cells of a file with their sites and how they meet.
struct RingsAndSites {
  const CellRings& cells;
  const RingSides& sides;
  std::span<const Point> sites;
  const Locator& locator;
};

// Throws BadValue with the number of a cell that is not the Voronoi cell of its center.
[[noreturn]] void refuse_cell(std::size_t cell);

// Throws BadValue for the first ring that does not run around its site once and counterclockwise.
void require_rings_around_sites(const RingsAndSites& from);

// Returns two cells of which one has its site across a border edge of the other, so that they share
// an edge but state it differently. Precondition: rings run around their sites.
std::optional<std::pair<Index, Index>> cells_that_differ(const RingsAndSites& from,
                                                         const Execution& execution);

// Makes the mesh. Precondition: rings run around their sites. Throws BadValue if some site is
// nearer to a corner than the sites of the corner's cells.
mesh::VoronoiMesh bordered_mesh(const RingsAndSites& from, const mesh::MeshOptions& options,
                                const Execution& execution);

}  // namespace rondel::meshing
