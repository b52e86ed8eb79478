// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query/engine.h"

#include "models/with_model.h"
#include "predicates/orientation.h"
#include "query/graph_engine.h"
#include "query/ring_location.h"
#include "topology/linking.h"

namespace rondel::query {
namespace {

using kernel::FaceKind;
using kernel::FaceKinds;

// What both engines of a finished triangulation own.
template <models::SphereModel T>
struct Built {
  Built(const Triangulation& triangulation, std::span<const Point> sites, const Vertices& names)
      : sphere(triangulation.sphere()),
        vertices(names),
        traits(sites, names.speakers, triangulation.sphere().center) {}

  Sphere sphere;
  const Vertices& vertices;
  T traits;
};

template <models::SphereModel T>
class BuiltSurface final : private Built<T>, public SurfaceEngine<T> {
 public:
  BuiltSurface(const Triangulation& triangulation, std::span<const Point> sites,
               const Vertices& names)
      : Built<T>(triangulation, sites, names),
        SurfaceEngine<T>(this->traits, this->sphere),
        mesh_(topology::link_faces(triangulation.faces(), triangulation.neighbors(),
                                   names.vertex_of)),
        corner_of_(corners_of(mesh_, names.names.size())) {
    while (triangulation.is_ghost(solid_)) ++solid_;
    if (triangulation.num_ghost_faces() > 0) classify(triangulation);
  }

 private:
  [[nodiscard]] Surface<T> surface() const override {
    return {this->traits, mesh_, kinds_, corner_of_, this->vertices.names};
  }
  [[nodiscard]] Index solid_face() const override { return solid_; }
  [[nodiscard]] Index entry_face() const override { return entry_; }

  void classify(const Triangulation& triangulation) {
    for (Index f = 0; f < mesh_.num_slots(); ++f) {
      const auto& v = mesh_[f].vertex;
      const FaceKind kind =
          triangulation.is_ghost(f)
              ? kernel::kind_of(predicates::orientation(this->traits, v[0], v[1], v[2]).sign)
              : FaceKind::solid;
      kinds_.add(f, kind);
      if (kind == FaceKind::entry) entry_ = f;
    }
  }

  topology::Mesh mesh_;
  std::vector<topology::Halfedge> corner_of_;
  FaceKinds kinds_;
  Index solid_ = 0;
  Index entry_ = no_index;
};

// Dimensions 0 and 1.
template <models::SphereModel T>
class BuiltRing final : private Built<T>, public GraphEngine<T> {
 public:
  BuiltRing(const Triangulation& triangulation, std::span<const Point> sites, const Vertices& names)
      : Built<T>(triangulation, sites, names),
        GraphEngine<T>(this->traits, this->sphere),
        points_(points_of(sites, names)),
        location_(points_, triangulation.sphere().center) {}

  Location locate(const Point& p, Cursor& cursor) const override {
    const Index near = nearest(p, cursor);
    const auto place = location_.locate(p, near);
    return {place.where, no_index, {place.vertices[0], place.vertices[1], no_index}};
  }

  Index nearest(const Point& p, Cursor& cursor) const override {
    return this->find_nearest(ring(), Target<T>(this->traits, p), cursor).vertex;
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
    return {this->traits, static_cast<Index>(points_.size()), this->vertices.names};
  }

  std::vector<Point> points_;
  RingLocation location_;
};

template <template <class> class E>
std::unique_ptr<Engine> make(const Triangulation& triangulation, std::span<const Point> sites,
                             const Vertices& vertices) {
  return models::with_model(triangulation.model(), [&]<class T> {
    return std::unique_ptr<Engine>(std::make_unique<E<T>>(triangulation, sites, vertices));
  });
}

}  // namespace

std::unique_ptr<Engine> make_engine(const Triangulation& triangulation,
                                    std::span<const Point> sites, const Vertices& vertices) {
  if (triangulation.dimension() < 0) return nullptr;
  return triangulation.dimension() < 2 ? make<BuiltRing>(triangulation, sites, vertices)
                                       : make<BuiltSurface>(triangulation, sites, vertices);
}

}  // namespace rondel::query
