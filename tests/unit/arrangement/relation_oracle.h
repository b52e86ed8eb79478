// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The relation of two geometries by brute force in integers of any length.
#pragma once

#include <cstddef>
#include <string>

#include "rondel/cell_rings.h"
#include "rondel/geometries.h"

namespace rondel::test {

// Returns the matrix of two geometries, each of points, lines or a valid polygon: what places of
// all kinds they have. Each side is divided where any other one meets it. Places are points, the
// ends of these pieces (points), their middles (lines) and places beside the middles, which lie in
// all faces (areas). Which polygons have a place is counted along arcs to a place beside the first
// side of the polygon.
std::string relation_by_places(const Geometries& a, std::size_t of_a, const Geometries& b,
                               std::size_t of_b);
// Returns the matrix of two valid polygons.
std::string relation_by_places(const CellRings& a, std::size_t cell_a, const CellRings& b,
                               std::size_t cell_b);

}  // namespace rondel::test
