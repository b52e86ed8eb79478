// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes of a part of the sphere: the ocean's without land, a region's (target rondel::mesh).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/mesh.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// A mesh of which cells were removed, and where all went: of each cell, edge and vertex of the mesh before, its
/// number now, or no_index if it is gone.
struct Culled {
  MeshArrays arrays;
  std::vector<Index> cells;
  std::vector<Index> edges;
  std::vector<Index> vertices;
};

/// The mesh without the cells whose `is_removed` is not 0.
///
/// 1. Edges and vertices stay where one of their cells does. What stays keeps its order, and its place, lengths
///    and areas bit by bit; so the distance of cells is that to the one that is gone.
/// 2. At the border no_index stands for cells and edges that are gone (MeshArrays, rule 7).
/// 3. An edge that lost its first cell is turned around.
/// 4. Kites of cells that are gone are 0, and triangles the sums of their kites.
/// 5. A mesh with a border may be culled again: in two steps it becomes what it becomes in one.
/// \throws InvalidInput if there is not one number a cell, no cell is left, or the arrays do not fit together.
RONDEL_API Culled cull(const MeshArrays& arrays, std::span<const std::uint8_t> is_removed,
                       const Execution& execution = {});

/// Of each point 1 if it lies in one of the regions or on a border of one, else 0; exact. Points are of any
/// length, regions those of read_polygons(), for example, and may overlap.
/// \throws InvalidInput (index of the point) for the center or what is not finite; (cell) for rings that Partition
///         refuses.
RONDEL_API std::vector<std::uint8_t> inside(std::span<const Point> points, const CellRings& regions,
                                            const Execution& execution = {});

}  // namespace rondel::mesh
