// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Water that is too narrow for a mesh: straits, coves and the ends of fjords.
//
// in    triangles of a domain, as small as its width asks for, and what their edges follow
// out   the domain without its narrow triangles
// index nodes and triangles of the mesh
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/mesh_triangles.h"
#include "rondel/types.h"

namespace rondel::meshing {

// A domain that narrow water was taken from.
struct WiderDomain {
  mesh::MeshDomain domain;         // one polygon is its area; all coasts are lines
  std::vector<Point> new_corners;  // corners of its border that are ends of new coast
};

// Fills the triangles that have all corners on the border or on coasts, and an edge in the water that
// is shorter than `share` of the spacing. Returns nothing if there are none. Corners of the new
// border are sites of `made`, and ends of its edges inside; so what stays does not move. Throws
// InvalidInput if nothing is left.
std::optional<WiderDomain> without_narrow_water(const mesh::DomainTriangles& made,
                                                const mesh::SizeFunction& spacing, double share);

// Returns triangles as one polygon: the rings of their border.
CellRings polygon_of(std::span<const Point> points, std::span<const Triple> triangles);

// Returns the area in steradians of what is in the first polygon and not in the second one: never
// negative, even where the second one is larger, as a coast that was simplified may make it.
double area_without(const CellRings& before, const CellRings& after, const Execution& execution);

}  // namespace rondel::meshing
