// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The queries that need no more than a graph, and those on a surface, wherever it is kept.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "query/engine.h"
#include "query/locate.h"
#include "query/nearest.h"
#include "query/surface.h"
#include "query/target.h"

namespace rondel::query {

// What both graphs share: queries for near vertices.
template <models::SphereTraits T>
class GraphEngine : public Engine {
 public:
  // Keeps both references.
  GraphEngine(const T& traits, const Sphere& sphere) : traits_(traits), sphere_(sphere) {}

 protected:
  template <Graph G>
  Candidate find_nearest(const G& graph, const Target<T>& target, Cursor& cursor) const {
    const Candidate top = query::nearest(graph, target, cursor.vertex);
    cursor.vertex = top.vertex;
    return top;
  }

  template <Graph G>
  void find_k_nearest(const G& graph, const Point& p, std::size_t k, Cursor& cursor,
                      std::vector<Index>& found) const {
    const Target<T> target(traits_, p);
    const Candidate start = find_nearest(graph, target, cursor);
    query::k_nearest(graph, target, start, k, cursor.scratch, found);
  }

  template <Graph G>
  void find_within(const G& graph, const Point& p, const std::optional<predicates::Cosine>& cosine,
                   Cursor& cursor, std::vector<Index>& found) const {
    const Target<T> target(traits_, p);
    const Candidate start = find_nearest(graph, target, cursor);
    const auto is_inside = [&](Index v) {
      return !cosine.has_value() || target.is_within(v, *cosine, sphere_);
    };
    flood(graph, start.vertex, is_inside, cursor.scratch, found);
  }

  template <Graph G>
  [[nodiscard]] std::vector<Index> find_neighbors(const G& graph, Index v) const {
    std::vector<Index> found;
    graph.visit_neighbors(v, [&found](Index w) {
      found.push_back(w);
      return false;
    });
    const auto lowest =
        std::ranges::min_element(found, {}, [&graph](Index w) { return graph.name(w); });
    std::rotate(found.begin(), lowest, found.end());
    return found;
  }

  const T& traits_;
  const Sphere& sphere_;
};

// Dimension 2.
template <models::SphereTraits T>
class SurfaceEngine : public GraphEngine<T> {
 public:
  using GraphEngine<T>::GraphEngine;

  Location locate(const Point& p, Cursor& cursor) const override {
    const Target<T> target(this->traits_, p);
    const Place place = query::locate(surface(), target, start_face(cursor));
    cursor.face = place.last_face;
    return {place.where, place.face, place.vertices};
  }

  Index nearest(const Point& p, Cursor& cursor) const override {
    return this->find_nearest(surface(), Target<T>(this->traits_, p), cursor).vertex;
  }

  void k_nearest(const Point& p, std::size_t k, Cursor& cursor,
                 std::vector<Index>& found) const override {
    this->find_k_nearest(surface(), p, k, cursor, found);
  }

  void within(const Point& p, const std::optional<predicates::Cosine>& cosine, Cursor& cursor,
              std::vector<Index>& found) const override {
    this->find_within(surface(), p, cosine, cursor, found);
  }

  [[nodiscard]] std::vector<Index> neighbors(Index v) const override {
    return this->find_neighbors(surface(), v);
  }

  std::vector<Index> conflict_region(const Point& p, Cursor& cursor) const override {
    Target<T> target(this->traits_, p);
    const Candidate top = this->find_nearest(surface(), target, cursor);
    if (target.is_duplicate(top)) return {};
    return query::conflict_region(surface(), target, start_face(cursor), entry_face());
  }

 protected:
  [[nodiscard]] virtual Surface<T> surface() const = 0;
  // Some solid face; some entry face, or no_index if there is none.
  [[nodiscard]] virtual Index solid_face() const = 0;
  [[nodiscard]] virtual Index entry_face() const = 0;

 private:
  [[nodiscard]] Index start_face(const Cursor& cursor) const {
    if (cursor.face != no_index) return cursor.face;
    const Index f = first_solid_face(surface(), cursor.vertex);
    return f != no_index ? f : solid_face();
  }
};

}  // namespace rondel::query
