// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query/engine.h"

#include <algorithm>

#include "incremental/projected_points.h"
#include "incremental/weighted_points.h"
#include "query/locate.h"
#include "query/nearest.h"
#include "query/ring_location.h"
#include "query/surface.h"
#include "query/target.h"

namespace rondel::query {
namespace {

using incremental::FaceKind;
using incremental::FaceKinds;

// What both graphs share: queries for near vertices.
template <incremental::SphereTraits T>
class GraphEngine : public Engine {
 public:
  GraphEngine(const Triangulation& triangulation, std::span<const Point> sites,
              const Vertices& vertices)
      : sphere_(triangulation.sphere()),
        vertices_(vertices),
        traits_(sites, vertices.speakers, triangulation.sphere().center) {}

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
  std::vector<Index> find_neighbors(const G& graph, Index v) const {
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

  Sphere sphere_;
  const Vertices& vertices_;
  T traits_;
};

template <incremental::SphereTraits T>
class SurfaceEngine final : public GraphEngine<T> {
 public:
  SurfaceEngine(const Triangulation& triangulation, std::span<const Point> sites,
                const Vertices& vertices)
      : GraphEngine<T>(triangulation, sites, vertices),
        mesh_(link_faces(triangulation, vertices)),
        corner_of_(corners_of(mesh_, vertices.names.size())) {
    while (triangulation.is_ghost(solid_)) ++solid_;
    if (triangulation.num_ghost_faces() > 0) classify(triangulation);
  }

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
    const Target<T> target(this->traits_, p);
    const Candidate top = this->find_nearest(surface(), target, cursor);
    if (target.is_duplicate(top)) return {};
    return query::conflict_region(surface(), target, start_face(cursor), near_);
  }

 private:
  [[nodiscard]] Surface<T> surface() const {
    return {this->traits_, mesh_, kinds_, corner_of_, this->vertices_.names};
  }

  [[nodiscard]] Index start_face(const Cursor& cursor) const {
    if (cursor.face != no_index) return cursor.face;
    const Index f = first_solid_face(surface(), cursor.vertex);
    return f != no_index ? f : solid_;
  }

  void classify(const Triangulation& triangulation) {
    for (Index f = 0; f < mesh_.num_slots(); ++f) {
      const auto& v = mesh_[f].vertex;
      const FaceKind kind = triangulation.is_ghost(f)
                                ? incremental::kind_of(this->traits_.orientation(v[0], v[1], v[2]))
                                : FaceKind::solid;
      kinds_.add(f, kind);
      if (kind == FaceKind::near) near_ = f;
    }
  }

  topology::Mesh mesh_;
  std::vector<topology::Halfedge> corner_of_;
  FaceKinds kinds_;
  Index solid_ = 0;
  Index near_ = no_index;
};

// Dimensions 0 and 1.
template <incremental::SphereTraits T>
class RingEngine final : public GraphEngine<T> {
 public:
  RingEngine(const Triangulation& triangulation, std::span<const Point> sites,
             const Vertices& vertices)
      : GraphEngine<T>(triangulation, sites, vertices),
        points_(points_of(sites, vertices)),
        location_(points_, triangulation.sphere().center) {}

  Location locate(const Point& p, Cursor& cursor) const override {
    const Index near = nearest(p, cursor);
    const auto place = location_.locate(p, near);
    return {place.where, no_index, {place.vertices[0], place.vertices[1], no_index}};
  }

  Index nearest(const Point& p, Cursor& cursor) const override {
    return this->find_nearest(ring(), Target<T>(this->traits_, p), cursor).vertex;
  }

  void k_nearest(const Point& p, std::size_t k, Cursor& cursor,
                 std::vector<Index>& found) const override {
    this->find_k_nearest(ring(), p, k, cursor, found);
  }

  void within(const Point& p, const std::optional<predicates::Cosine>& cosine, Cursor& cursor,
              std::vector<Index>& found) const override {
    this->find_within(ring(), p, cosine, cursor, found);
  }

  [[nodiscard]] std::vector<Index> neighbors(Index v) const override {
    return this->find_neighbors(ring(), v);
  }

  std::vector<Index> conflict_region(const Point& /*p*/, Cursor& /*cursor*/) const override {
    return {};
  }

 private:
  static std::vector<Point> points_of(std::span<const Point> sites, const Vertices& vertices) {
    std::vector<Point> points;
    for (const Index i : vertices.speakers) points.push_back(sites[i]);
    return points;
  }

  [[nodiscard]] Ring<T> ring() const {
    return {this->traits_, static_cast<Index>(points_.size()), this->vertices_.names};
  }

  std::vector<Point> points_;
  RingLocation location_;
};

template <template <class> class E>
std::unique_ptr<Engine> make(const Triangulation& triangulation, std::span<const Point> sites,
                             const Vertices& vertices) {
  if (triangulation.model() == Model::projected) {
    return std::make_unique<E<incremental::ProjectedPoints>>(triangulation, sites, vertices);
  }
  return std::make_unique<E<incremental::WeightedPoints>>(triangulation, sites, vertices);
}

}  // namespace

std::unique_ptr<Engine> make_engine(const Triangulation& triangulation,
                                    std::span<const Point> sites, const Vertices& vertices) {
  if (triangulation.dimension() < 0) return nullptr;
  return triangulation.dimension() < 2 ? make<RingEngine>(triangulation, sites, vertices)
                                       : make<SurfaceEngine>(triangulation, sites, vertices);
}

}  // namespace rondel::query
