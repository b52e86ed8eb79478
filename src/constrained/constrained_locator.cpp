// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ConstrainedLocator: the vertices and faces are prepared as for a Locator (query::Built); the walk
// is another one (constrained_walk.h).

#include "rondel/constrained_locator.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "api/validation.h"
#include "constrained/constrained_walk.h"
#include "predicates/orientation.h"
#include "query/batch.h"
#include "query/built.h"
#include "query/engine.h"
#include "query/locate.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/job.h"

namespace rondel {

struct ConstrainedLocator::Impl {
  using Surface = query::SurfaceGraph<models::ProjectedPoints>;

  explicit Impl(const ConstrainedTriangulation& result)
      : sphere(result.triangulation.sphere()),
        sides(result.sides),
        built(result.triangulation, {}),
        graph(built.graph()),
        engine(graph) {}

  [[nodiscard]] Location locate(const Point& p, query::Cursor& cursor) const;
  [[nodiscard]] bool is_empty() const { return built.num_vertices() == 0; }

  Sphere sphere;
  std::vector<std::uint8_t> sides;
  query::Built built;
  query::AnyGraph graph;
  query::Engine engine;  // below dimension 2, where constraints are in nobody's way
};

Location ConstrainedLocator::Impl::locate(const Point& p, query::Cursor& cursor) const {
  const auto* surface = std::get_if<Surface>(&graph);
  if (surface == nullptr) return engine.locate(p, cursor);
  constexpr Index query = no_index - 1;  // its name among the vertices
  predicates::Vector ray;
  predicates::directions({&p, 1}, sphere.center, &ray);
  const auto oriented = [&, sites = &surface->sites](Index a, Index b, Index c) {
    const auto direction = [&](Index v) { return v == query ? ray : sites->direction(v); };
    const Sign sign = predicates::sure_orientation(direction(a), direction(b), direction(c));
    if (sign != Sign::zero) return sign;
    const auto point = [&](Index v) { return v == query ? p : sites->point(v); };
    return orientation(point(a), point(b), point(c), sphere);
  };
  if (cursor.face == no_index) cursor.face = query::first_solid_face(*surface, cursor.vertex);
  constrained::ConstrainedWalk walk(oriented, surface->mesh, surface->kinds, sides, query);
  const constrained::ConstrainedWalkEnd end = walk.locate(cursor.face);
  cursor.face = topology::face_of(end.halfedge);
  if (end.where == Where::outside) return {};
  const unsigned i = topology::edge_of(end.halfedge);
  std::array<bool, 3> is_on{};
  if (end.where == Where::edge) is_on[i] = true;
  if (end.where == Where::vertex) {
    is_on[topology::next_corner[i]] = true;
    is_on[topology::previous_corner[i]] = true;
  }
  Location location = query::location_in(*surface, cursor.face, is_on);
  for (Index& v : location.sites) {
    if (v != no_index) v = surface->name(v);
  }
  if (location.where == Where::edge && location.sites[1] < location.sites[0]) {
    std::swap(location.sites[0], location.sites[1]);
  }
  return location;
}

ConstrainedLocator::ConstrainedLocator(const ConstrainedTriangulation& result) {
  const system::ArithmeticScope arithmetic;
  if (result.sides.size() != result.triangulation.num_faces()) {
    throw InvalidInput("there are sides for " + std::to_string(result.sides.size()) +
                       " faces, but there are " + std::to_string(result.triangulation.num_faces()) +
                       " faces");
  }
  impl_ = std::make_unique<const Impl>(result);
}

ConstrainedLocator::~ConstrainedLocator() = default;
ConstrainedLocator::ConstrainedLocator(ConstrainedLocator&&) noexcept = default;
ConstrainedLocator& ConstrainedLocator::operator=(ConstrainedLocator&&) noexcept = default;

Location ConstrainedLocator::locate(const Point& query) const {
  const system::ArithmeticScope arithmetic;
  api::validate_queries({&query, 1}, impl_->sphere.center);
  if (impl_->is_empty()) return {};
  query::Cursor cursor;
  cursor.vertex = impl_->built.near(query);
  return impl_->locate(query, cursor);
}

std::vector<Location> ConstrainedLocator::locate(std::span<const Point> queries,
                                                 const Execution& execution) const {
  const system::Call call(execution);
  api::validate_queries(queries, impl_->sphere.center);
  std::vector<Location> found(queries.size());
  if (impl_->is_empty()) return found;
  query::for_each_range(
      queries, Model::projected, impl_->sphere.center, execution.threads,
      [this](const Point& p) { return impl_->built.near(p); },
      [&](std::span<const Index> range, query::Cursor& cursor) {
        query::for_each_query(range, queries, cursor, [&](Index i, query::Cursor& at) {
          found[i] = impl_->locate(queries[i], at);
        });
      });
  return found;
}

}  // namespace rondel
