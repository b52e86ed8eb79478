// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Locates points in the faces of a constrained triangulation, on the graph that others prepared:
// ConstrainedLocator asks for sites, ConstrainedInterpolator for ranks.
//
// in    a graph whose faces are numbered as the triangulation numbers them; a point
// out   its location
// index vertices go out under the names of the graph
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <variant>

#include "query/engine.h"
#include "query/graph.h"
#include "rondel/query.h"
#include "rondel/types.h"

namespace rondel::constrained {

class ConstrainedFaceFinder {
 public:
  // Refers to what the graph refers to, and to the sides, which are bits by face as in
  // ConstrainedTriangulation.
  ConstrainedFaceFinder(const query::AnyGraph& graph, std::span<const std::uint8_t> sides,
                        const Sphere& sphere)
      : graph_(graph), engine_(graph), sides_(sides), sphere_(sphere) {}

  // Precondition: there is a vertex, and the cursor has one.
  [[nodiscard]] Location locate(const Point& p, query::Cursor& cursor) const;

 private:
  query::AnyGraph graph_;
  query::Engine engine_;  // below dimension 2, where constraints are in nobody's way
  std::span<const std::uint8_t> sides_;
  Sphere sphere_;
};

// Throws InvalidInput unless there is an entry of `sides` for each face.
void require_sides(std::size_t num_sides, std::size_t num_faces);

}  // namespace rondel::constrained
