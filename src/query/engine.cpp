// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query/engine.h"

#include <algorithm>
#include <span>

#include "query/locate.h"
#include "query/nearest.h"

namespace rondel::query {
namespace {

template <Graph G>
void rename(const G& graph, std::span<Index> vertices) {
  for (Index& v : vertices) v = graph.name(v);
}

template <Graph G, class T>
Candidate nearest_from(Cursor& cursor, const G& graph, const Target<T>& target) {
  const Candidate top = nearest(graph, target, cursor.vertex);
  cursor.vertex = top.vertex;
  return top;
}

template <class T>
Index& solid_face_near(const SurfaceGraph<T>& surface, Cursor& cursor) {
  if (cursor.face == no_index) cursor.face = first_solid_face(surface, cursor.vertex);
  if (cursor.face == no_index) cursor.face = surface.solid_face;
  return cursor.face;
}

template <class T>
Location locate_from(Cursor& cursor, const SurfaceGraph<T>& surface, const Target<T>& target) {
  return locate(surface, target, solid_face_near(surface, cursor));
}
template <class T>
Location locate_from(Cursor& cursor, const RingGraph<T>& ring, const Target<T>& target) {
  return ring.location.locate(target.point(Target<T>::query),
                              nearest_from(cursor, ring, target).vertex);
}

template <class T>
std::vector<Index> region_from(Cursor& cursor, const SurfaceGraph<T>& surface,
                               const Target<T>& target) {
  if (target.is_duplicate(nearest_from(cursor, surface, target))) return {};
  return conflict_region(surface, target, solid_face_near(surface, cursor));
}
template <class T>
std::vector<Index> region_from(Cursor& /*cursor*/, const RingGraph<T>& /*ring*/,
                               const Target<T>& /*target*/) {
  return {};
}

// Returns work(graph, target), where the target is p seen from the graph's sites.
template <class Work>
decltype(auto) ask(const AnyGraph& any, const Point& p, const Work& work) {
  return std::visit([&](const auto& graph) { return work(graph, Target(graph.sites, p)); }, any);
}

}  // namespace

Location Engine::locate(const Point& p, Cursor& cursor) const {
  return ask(graph_, p, [&](const auto& graph, const auto& target) {
    Location location = locate_from(cursor, graph, target);
    for (Index& v : location.sites) {
      if (v != no_index) v = graph.name(v);
    }
    if (location.where == Where::edge && location.sites[1] < location.sites[0]) {
      std::swap(location.sites[0], location.sites[1]);
    }
    return location;
  });
}

Index Engine::nearest(const Point& p, Cursor& cursor) const {
  return ask(graph_, p, [&](const auto& graph, const auto& target) {
    return graph.name(nearest_from(cursor, graph, target).vertex);
  });
}

void Engine::k_nearest(const Point& p, std::size_t k, Cursor& cursor,
                       std::vector<Index>& found) const {
  ask(graph_, p, [&](const auto& graph, const auto& target) {
    const std::size_t begin = found.size();
    const Candidate start = nearest_from(cursor, graph, target);
    query::k_nearest(graph, target, start, k, cursor.scratch, found);
    rename(graph, std::span(found).subspan(begin));
  });
}

void Engine::within(const Point& p, const Limit& limit, Cursor& cursor,
                    std::vector<Index>& found) const {
  ask(graph_, p, [&](const auto& graph, const auto& target) {
    const std::size_t begin = found.size();
    const Index start = nearest_from(cursor, graph, target).vertex;
    const auto is_inside = [&](Index v) { return target.is_within(v, limit); };
    flood(graph, start, is_inside, cursor.scratch, found);
    const auto new_ones = std::span(found).subspan(begin);
    rename(graph, new_ones);
    std::ranges::sort(new_ones);
  });
}

std::vector<Index> Engine::neighbors(Index v) const {
  std::vector<Index> found;
  std::visit(
      [&](const auto& graph) {
        graph.visit_neighbors(v, [&](Index w) {
          found.push_back(graph.name(w));
          return false;
        });
      },
      graph_);
  std::rotate(found.begin(), std::ranges::min_element(found), found.end());
  return found;
}

std::vector<Index> Engine::conflict_region(const Point& p, Cursor& cursor) const {
  return ask(graph_, p, [&](const auto& graph, const auto& target) {
    return region_from(cursor, graph, target);
  });
}

std::span<const topology::HorizonEdge> Engine::horizon(const Point& p, Index start,
                                                       RegionSearch& search) const {
  using Sites = models::ProjectedPoints;
  const auto& graph = std::get<SurfaceGraph<Sites>>(graph_);
  Target<Sites> target(graph.sites, p);
  kernel::ConflictTest<Target<Sites>> test(target);
  search.find(test, graph.mesh, Target<Sites>::query, start);
  return search.horizon();
}

}  // namespace rondel::query
