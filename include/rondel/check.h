// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// An independent validator of triangulations: it shares the predicates with the construction, but
/// no algorithm.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// The result of check().
struct CheckReport {
  bool is_valid = false;
  std::string reason;  ///< one line that says what is wrong, with indices; empty when valid
  /// Vertices; below dimension 2 the number of different places, those of hidden sites included.
  std::size_t num_vertices = 0;
  std::size_t num_edges = 0;
  std::size_t num_duplicates = 0;
  std::size_t num_hidden = 0;
};

/// Proves or refutes that triangles are the faces of the triangulation of `sites`: corners are in
/// range and distinct, every halfedge has its opposite, the faces are one closed connected surface
/// of Euler characteristic 2, every site is accounted for, every edge is locally Delaunay (regular)
/// by an exact test that breaks ties as delaunay() does, and every star is convex.
/// \param triangles  shape (m, 3), indices of sites; the triangles may have any order
/// \throws InvalidInput as delaunay() does.
RONDEL_API CheckReport check(std::span<const Point> sites, std::span<const Triple> triangles,
                             const Options& options = {}, const Execution& execution = {});

}  // namespace rondel
