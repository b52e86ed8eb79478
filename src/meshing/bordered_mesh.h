// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A mesh with a border, of its sites and the rings of corners around them. A cell of Voronoi that is gone had its site where
// that of a cell of the border is reflected in their edge.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "meshing/ring_surface.h"
#include "rondel/mesh.h"
#include "rondel/query.h"

namespace rondel::meshing {

// Of the spacing: how far a corner of a file may be from that of the mesh. Files have single precision, too, and
// programs find circumcenters in the plane.
inline constexpr double corner_tolerance = 1e-3;

struct RingsAndSites {
  const CellRings& cells;
  const RingSides& sides;
  std::span<const Point> sites;
  const Locator& locator;
};

// Throws BadValue: not the Voronoi cell of its center.
[[noreturn]] void refuse_cell(std::size_t cell);

// Throws BadValue for a ring that does not run around its site, once and counterclockwise.
void require_rings_around_sites(const RingsAndSites& from);

// Two cells of which one has its site across an edge of the other that is one of the border: what they have in common they
// say differently. Precondition: rings run around their sites.
std::optional<std::pair<Index, Index>> cells_that_differ(const RingsAndSites& from,
                                                         const Execution& execution);

// Precondition: as above. Throws BadValue where a corner has a site nearer than those of its cells.
mesh::MeshArrays bordered_mesh(const RingsAndSites& from, const mesh::MeshOptions& options,
                               const Execution& execution);

}  // namespace rondel::meshing
