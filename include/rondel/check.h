// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// An independent validator: it shares the predicates with the construction, but no algorithm.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// The verdict on a list of triangles.
struct CheckReport {
  bool is_valid = false;
  std::string reason;  ///< one line that says what is wrong, with indices; empty when valid
  std::size_t num_vertices = 0;  ///< below dimension 2: distinct places, hidden ones included
  std::size_t num_edges = 0;
  std::size_t num_duplicates = 0;
  std::size_t num_hidden = 0;
};

/// Proves or refutes that `triangles` (m, 3; in any order) are the faces of the
/// triangulation of `sites`: corners in range and distinct, every halfedge with its
/// opposite, one closed connected surface of Euler characteristic 2, every
/// site accounted for, every edge locally Delaunay (regular) by an exact test that breaks ties
/// as delaunay() does, every star convex.
/// \throws InvalidInput as delaunay() does.
RONDEL_API CheckReport check(std::span<const Point> sites, std::span<const Triple> triangles,
                             const Options& options = {}, const Execution& execution = {});

}  // namespace rondel
