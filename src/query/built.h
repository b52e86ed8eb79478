// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A finished triangulation, prepared for queries. Vertices get internal names that suit queries:
// their spatial rank in dimension 2, so that neighbors are close in memory; their place in the ring
// below.
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "models/projected_points.h"
#include "models/weighted_points.h"
#include "order/sorts.h"
#include "query/graph.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "topology/mesh.h"

namespace rondel::query {

// RONDEL_API, here and in engine.h: what rondel::geo uses.
class RONDEL_API Built {
 public:
  // Vertices whose keys are equal are in the order of the input, or as this puts them:
  // order_ties_by_place().
  using OrderTies = void (*)(const Triangulation&, order::KeyedIndices&);

  // `ids`, if any, are what the sites are called outside, in increasing order; otherwise that is
  // their index.
  Built(const Triangulation& triangulation, std::span<const Index> ids,
        OrderTies order_ties = nullptr);
  Built(const Built&) = delete;
  Built& operator=(const Built&) = delete;

  // Refers to this object.
  [[nodiscard]] AnyGraph graph() const { return graph(names_); }
  // Refers to these names, too, which vertices have outside instead.
  [[nodiscard]] AnyGraph graph(std::span<const Index> names) const;
  [[nodiscard]] std::size_t num_vertices() const { return names_.size(); }

  [[nodiscard]] bool has_site(Index site) const {
    return site < vertex_of_.size() && vertex_of_[site] != not_there;
  }
  // Precondition: there is such a site. no_index if it is hidden.
  [[nodiscard]] Index vertex_of(Index site) const { return vertex_of_[site]; }
  // These return for each vertex its name outside, and the site whose coordinates count.
  [[nodiscard]] std::span<const Index> names() const { return names_; }
  [[nodiscard]] std::span<const Index> representatives() const { return representatives_; }
  [[nodiscard]] const Point& point(Index v) const { return sites_.points()[representatives_[v]]; }
  // In dimension 2: the faces as the triangulation numbers them.
  [[nodiscard]] const topology::Mesh& mesh() const { return mesh_; }
  // A vertex close to p. Precondition: there is a vertex.
  [[nodiscard]] Index near(const Point& p) const;

 private:
  static constexpr Index not_there = no_index - 1;

  void list_vertices(const Triangulation& triangulation, OrderTies order_ties);
  void rename(std::span<const Index> ids);
  template <class T>
  void link_faces(const Triangulation& triangulation, const T& model);

  Sites sites_;
  Model model_;
  Point center_;
  bool is_ring_;

  std::vector<Index> names_;  // of each vertex
  std::vector<Index>
      representatives_;              // the site whose coordinates count: of duplicates the smallest
  std::vector<Index> vertex_of_;     // the vertex of each site
  std::vector<std::uint64_t> keys_;  // sorted
  std::vector<Index> at_key_;        // their vertices; empty: 0, 1, 2 ...

  std::variant<models::ProjectedPoints, models::WeightedPoints> points_;

  // In dimension 2.
  topology::Mesh mesh_;
  std::vector<topology::Halfedge> corner_of_;
  kernel::FaceKinds kinds_;
  Index solid_face_ = 0;
  Index entry_face_ = no_index;
};

// Ranks that depend on places alone: for those who promise that the order of the sites changes no
// bit.
// Orders the vertices of equal keys, which are in the order of the input, by what else there is to their
// places. A Built::OrderTies; apart from it, so that programs without need of it have nothing of it.
RONDEL_API void order_ties_by_place(const Triangulation& triangulation,
                                    order::KeyedIndices& sorted);

}  // namespace rondel::query
