// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From faces and pieces of constraints to a ConstrainedTriangulation, of a build and of a
// triangulation that changes.
//
// in    arrays in canonical order; edges with the constraints that they are pieces of
// out   a ConstrainedTriangulation; where two constraints cross
// index names: a site, of duplicates the lowest one; constraints in the order of the input
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "constrained/constraints.h"
#include "rondel/compressed_rows.h"
#include "rondel/constrained.h"
#include "rondel/triangulation.h"
#include "topology/triangulation_arrays.h"

namespace rondel::constrained {

// Returns where two arcs cross, up to rounding, by their ends.
LonLat place_of_crossing(const std::array<Point, 2>& e, const std::array<Point, 2>& f,
                         const Sphere& sphere);

// Sorts pieces by their ends, which are less than `bound`.
void sort_by_ends(std::vector<ConstrainedPiece>& pieces, std::size_t bound);

// The pieces of constraints, by names, in any order.
struct PiecesOfConstraints {
  std::span<const std::array<Index, 2>> ends;
  std::span<const Index> divided;            // ascending: the constraints that are not one edge
  std::span<const ConstrainedPiece> pieces;  // of these

  [[nodiscard]] std::size_t size() const { return ends.size() - divided.size() + pieces.size(); }
};

// Lists the edges, between names less than `bound`, with their constraints, or with the sources of
// these.
void list_edges(const PiecesOfConstraints& all, std::size_t bound,
                const CompressedRows<Index>* sources, ConstrainedTriangulation& result);

// Returns a triangulation of faces that are not all Delaunay: what relies on that proves it first.
Triangulation with_faces(const Sites& sites, TriangulationArrays arrays, const Options& options,
                         const BuildReport& report);

}  // namespace rondel::constrained
