// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes of a part of the sphere, such as the ocean or a region (target rondel::geo).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/mesh.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// A mesh of which cells were removed. `cells`, `edges` and `vertices` have for each element of the
/// mesh before its index in the new mesh, or no_index if it was removed.
struct Culled {
  VoronoiMesh arrays;
  std::vector<Index> cells;
  std::vector<Index> edges;
  std::vector<Index> vertices;
};

/// Returns the mesh without some cells.
///
/// 1. An edge or vertex stays if one of its cells does. What stays keeps its order, place, lengths
///    and areas bit by bit; so the cell distance of an edge on the border is that to the removed
///    cell.
/// 2. At the border no_index stands for cells and edges that were removed (VoronoiMesh, rule 7).
/// 3. An edge that lost its first cell is reversed.
/// 4. Kites of removed cells are 0, and the areas of triangles are the sums of their kites.
/// 5. A mesh with a border may be culled again; two steps give the same mesh as one.
/// \param is_removed  one for each cell: 0 if it stays
/// \throws InvalidInput if there is not one number for each cell, no cell is left, or the arrays do
///         not fit together.
RONDEL_API Culled cull(const VoronoiMesh& mesh, std::span<const std::uint8_t> is_removed,
                       const Execution& execution = {});

/// Returns 1 for each point that lies in one of the regions or on a border of one, else 0; exact.
/// \param points  of any length but 0
/// \param regions  for example those of read_polygons(); they may overlap
/// \throws InvalidInput (index of the point) for the center or a point that is not finite; (cell)
///         for rings that CellSet refuses.
RONDEL_API std::vector<std::uint8_t> inside(std::span<const Point> points, const CellRings& regions,
                                            const Execution& execution = {});

}  // namespace rondel::mesh
