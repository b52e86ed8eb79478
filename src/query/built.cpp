// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query/built.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "models/with_model.h"
#include "order/along_the_curve.h"
#include "order/cube_position.h"
#include "order/hilbert.h"
#include "predicates/orientation.h"
#include "predicates/perturbation.h"
#include "system/gather.h"
#include "topology/mesh.h"

namespace rondel::query {
namespace {

std::vector<Index> vertices_by_index(const Triangulation& triangulation) {
  const auto n = static_cast<Index>(triangulation.num_sites());
  std::vector<bool> is_vertex(n, true);
  for (const Duplicate& d : triangulation.duplicates()) is_vertex[d.site] = false;
  for (const Hidden& h : triangulation.hidden()) is_vertex[h.site] = false;
  std::vector<Index> vertices;
  vertices.reserve(triangulation.num_vertices());
  for (Index i = 0; i < n; ++i) {
    if (is_vertex[i]) vertices.push_back(i);
  }
  return vertices;
}

}  // namespace

Built::Built(const Triangulation& triangulation, std::span<const Index> ids, OrderTies order_ties)
    : sites_(triangulation.sites()),
      model_(triangulation.model()),
      center_(triangulation.sphere().center),
      is_ring_(triangulation.dimension() < 2) {
  list_vertices(triangulation, order_ties);
  models::with_model(model_, [&]<class T> {
    const T& model = points_.emplace<T>(sites_.points(), representatives_, center_);
    if (!is_ring_) link_faces(triangulation, model);
  });
  if (!ids.empty()) rename(ids);
}

void Built::list_vertices(const Triangulation& triangulation, OrderTies order_ties) {
  auto sorted = order::along_the_curve(vertices_by_index(triangulation), model_, center_, 1,
                                       [this](Index i) { return sites_[i]; });
  if (order_ties != nullptr) order_ties(triangulation, sorted);
  keys_ = std::move(sorted.keys);
  if (is_ring_) {
    names_.assign(triangulation.ring().begin(), triangulation.ring().end());
  } else {
    names_ = std::move(sorted.indices);
  }
  vertex_of_.assign(triangulation.num_sites(), no_index);
  for (Index v = 0; v < names_.size(); ++v) vertex_of_[names_[v]] = v;
  if (is_ring_) {
    for (const Index i : sorted.indices) at_key_.push_back(vertex_of_[i]);
  }
  representatives_ = names_;
  for (const auto& [site, representative] : triangulation.duplicates()) {
    const Index v = vertex_of_[representative];
    vertex_of_[site] = v;
    if (v == no_index) continue;
    Index& first_site = representatives_[v];
    if (predicates::is_lexicographically_less(sites_[site], sites_[first_site])) first_site = site;
  }
}

template <class T>
void Built::link_faces(const Triangulation& triangulation, const T& model) {
  mesh_ = topology::link_faces(triangulation.faces(), triangulation.neighbors(), vertex_of_);
  corner_of_.assign(names_.size(), no_index);
  for (Index f = 0; f < mesh_.num_slots(); ++f) {
    for (unsigned i = 0; i < 3; ++i) corner_of_[mesh_[f].vertex[i]] = topology::halfedge(f, i);
  }
  while (triangulation.is_ghost(solid_face_)) ++solid_face_;
  for (const Index f : triangulation.ghost_faces()) {
    const auto& v = mesh_[f].vertex;
    const auto kind = kernel::kind_of(predicates::orientation(model, v[0], v[1], v[2]).sign);
    kinds_.add(f, kind);
    if (kind == kernel::FaceKind::entry) entry_face_ = f;
  }
}

void Built::rename(std::span<const Index> ids) {
  std::vector<Index> vertex_of(ids.back() + std::size_t{1}, not_there);
  for (std::size_t i = 0; i < ids.size(); ++i) vertex_of[ids[i]] = vertex_of_[i];
  vertex_of_ = std::move(vertex_of);
  for (Index& name : names_) name = ids[name];
}

AnyGraph Built::graph(std::span<const Index> names) const {
  return std::visit(
      [this, names]<class T>(const T& model) -> AnyGraph {
        if (!is_ring_) {
          return SurfaceGraph<T>{model, mesh_, kinds_, corner_of_, names, solid_face_, entry_face_};
        }
        return RingGraph<T>{
            model, names, RingLocation(system::gather(sites_.points(), representatives_), center_)};
      },
      points_);
}

Index Built::near(const Point& p) const {
  // Rounded, and of the high key alone: any vertex will do.
  const std::uint64_t key = order::hilbert_key(order::cube_position(p, center_)).high;
  const auto at = std::ranges::upper_bound(keys_, key);
  const auto place = static_cast<Index>(at == keys_.begin() ? 0 : at - keys_.begin() - 1);
  return at_key_.empty() ? place : at_key_[place];
}

}  // namespace rondel::query
