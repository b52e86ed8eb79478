// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A triangulation prepared for interpolation: the read-only data that the kernels of all threads
// share.
//
// in    a triangulation
// out   queries for locations, unit vectors and the mesh
// index vertices by spatial rank throughout; `names` are indices of sites
#pragma once

#include <span>
#include <vector>

#include "exact/unit_vector.h"
#include "interpolation/flat_faces.h"
#include "query/built.h"
#include "query/engine.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::interpolation {

class PreparedTriangulation {
 public:
  explicit PreparedTriangulation(const Triangulation& triangulation);
  PreparedTriangulation(const PreparedTriangulation&) = delete;
  PreparedTriangulation& operator=(const PreparedTriangulation&) = delete;

  [[nodiscard]] const Triangulation& triangulation() const { return triangulation_; }
  [[nodiscard]] std::size_t num_sites() const { return triangulation_.num_sites(); }
  [[nodiscard]] std::size_t num_vertices() const { return built_.num_vertices(); }
  [[nodiscard]] Model model() const { return triangulation_.model(); }
  [[nodiscard]] const Point& center() const { return center_; }

  // Returns the engine for locate and nearest. It answers with ranks and breaks ties by the lowest
  // rank.
  [[nodiscard]] const query::Engine& engine() const { return engine_; }
  // Returns what the engine runs on, for other walks; vertices have their ranks as names.
  [[nodiscard]] query::AnyGraph graph() const { return built_.graph(ranks_); }
  // Returns a vertex near the point, from which a walk may begin.
  [[nodiscard]] Index near(const Point& p) const { return built_.near(p); }

  // Returns the mesh, if the dimension is 2: faces as the triangulation numbers them, corners as
  // ranks.
  [[nodiscard]] const topology::Mesh& mesh() const { return built_.mesh(); }
  [[nodiscard]] bool is_solid(Index face) const { return !triangulation_.is_ghost(face); }

  // Returns the faces on the border in which no target is interpolated.
  [[nodiscard]] const FlatFaces& flat_faces() const { return flat_faces_; }

  // unit() is the direction of a vertex from the center (Model::projected only), point() its
  // coordinates as given.
  [[nodiscard]] const exact::SplitPoint& unit(Index rank) const { return units_[rank]; }
  [[nodiscard]] std::span<const exact::SplitPoint> units() const { return units_; }
  [[nodiscard]] const Point& point(Index rank) const { return built_.point(rank); }

  // names() gives the lowest site of each vertex. vertex_of() gives the vertex of a site, or
  // no_index if the site is hidden.
  [[nodiscard]] std::span<const Index> names() const { return built_.names(); }
  [[nodiscard]] Index name(Index rank) const { return built_.names()[rank]; }
  [[nodiscard]] Index vertex_of(Index site) const { return built_.vertex_of(site); }

 private:
  Triangulation triangulation_;
  Point center_;
  query::Built built_;
  std::vector<Index> ranks_;  // 0, 1, 2 ...
  query::Engine engine_;
  std::vector<exact::SplitPoint> units_;
  FlatFaces flat_faces_;
};

}  // namespace rondel::interpolation
