// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A triangulation, prepared for interpolation: what all kernels of all threads read. Vertices are
// named by their spatial rank everywhere; names outside are indices of sites.
#pragma once

#include <span>
#include <vector>

#include "exact/unit_vector.h"
#include "query/built.h"
#include "query/engine.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::interpolation {

class Ground {
 public:
  explicit Ground(const Triangulation& triangulation);
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;

  [[nodiscard]] const Triangulation& triangulation() const { return triangulation_; }
  [[nodiscard]] std::size_t num_sites() const { return triangulation_.num_sites(); }
  [[nodiscard]] std::size_t num_vertices() const { return built_.num_vertices(); }
  [[nodiscard]] Model model() const { return triangulation_.model(); }
  [[nodiscard]] const Point& center() const { return center_; }

  // Its answers are ranks, and ties go to the lowest rank.
  [[nodiscard]] const query::Engine& engine() const { return engine_; }
  [[nodiscard]] Index near(const Point& p) const { return built_.near(p); }

  // In dimension 2: faces as the triangulation numbers them, their corners as ranks.
  [[nodiscard]] const topology::Mesh& mesh() const { return built_.mesh(); }
  [[nodiscard]] bool is_solid(Index face) const { return !triangulation_.is_ghost(face); }

  // Of a vertex: its direction from the center (Model::projected only), and its coordinates as given.
  [[nodiscard]] const exact::SplitPoint& unit(Index rank) const { return units_[rank]; }
  [[nodiscard]] std::span<const exact::SplitPoint> units() const { return units_; }
  [[nodiscard]] const Point& point(Index rank) const { return built_.point(rank); }

  // The lowest index of the sites of a vertex; the vertex of a site, no_index if that is hidden.
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
};

}  // namespace rondel::interpolation
