// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/face_finder.h"

#include <array>
#include <string>

#include "constrained/constrained_walk.h"
#include "predicates/orientation.h"
#include "query/locate.h"
#include "rondel/error.h"
#include "rondel/predicates.h"

namespace rondel::constrained {

Location ConstrainedFaceFinder::locate(const Point& p, query::Cursor& cursor) const {
  using Surface = query::SurfaceGraph<models::ProjectedPoints>;
  const auto* surface = std::get_if<Surface>(&graph_);
  if (surface == nullptr) return engine_.locate(p, cursor);
  constexpr Index query = no_index - 1;  // its name among the vertices
  predicates::Vector ray;
  predicates::directions({&p, 1}, sphere_.center, &ray);
  const auto oriented = [&, sites = &surface->sites](Index a, Index b, Index c) {
    const auto direction = [&](Index v) { return v == query ? ray : sites->direction(v); };
    const Sign sign = predicates::sure_orientation(direction(a), direction(b), direction(c));
    if (sign != Sign::zero) return sign;
    const auto point = [&](Index v) { return v == query ? p : sites->point(v); };
    return orientation(point(a), point(b), point(c), sphere_);
  };
  if (cursor.face == no_index) cursor.face = query::first_solid_face(*surface, cursor.vertex);
  if (cursor.face == no_index) cursor.face = surface->solid_face;
  ConstrainedWalk walk(oriented, surface->mesh, surface->kinds, sides_, query);
  const ConstrainedWalkEnd end = walk.locate(cursor.face);
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

void require_sides(std::size_t num_sides, std::size_t num_faces) {
  if (num_sides == num_faces) return;
  throw InvalidInput("there are sides for " + std::to_string(num_sides) + " faces, but there are " +
                     std::to_string(num_faces) + " faces");
}

}  // namespace rondel::constrained
