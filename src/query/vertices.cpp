// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query/vertices.h"

#include <algorithm>
#include <utility>

#include "order/cube_position.h"
#include "order/hilbert.h"
#include "order/radix_sort.h"
#include "predicates/perturbation.h"

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

order::KeyedIndices sorted_by_key(std::vector<Index> indices, std::span<const Point> sites,
                                  const Point& center) {
  order::KeyedIndices data;
  data.keys.reserve(indices.size());
  for (const Index i : indices) {
    data.keys.push_back(hilbert_key(order::cube_position(sites[i], center)).high);
  }
  data.indices = std::move(indices);
  order::radix_sort(data, 3 + 2 * order::high_levels);
  return data;
}

}  // namespace

Index Vertices::near(std::uint64_t key) const {
  const auto at = std::ranges::upper_bound(keys, key);
  const auto place = static_cast<Index>(at == keys.begin() ? 0 : at - keys.begin() - 1);
  return at_key.empty() ? place : at_key[place];
}

Vertices list_vertices(const Triangulation& triangulation, std::span<const Point> sites) {
  Vertices result;
  auto sorted =
      sorted_by_key(vertices_by_index(triangulation), sites, triangulation.sphere().center);
  result.keys = std::move(sorted.keys);
  const bool is_ring = triangulation.dimension() < 2;
  if (is_ring) {
    result.names.assign(triangulation.ring().begin(), triangulation.ring().end());
  } else {
    result.names = std::move(sorted.indices);
  }
  result.vertex_of.assign(triangulation.num_sites(), no_index);
  for (Index v = 0; v < result.names.size(); ++v) result.vertex_of[result.names[v]] = v;
  if (is_ring) {
    for (const Index i : sorted.indices) result.at_key.push_back(result.vertex_of[i]);
  }
  result.speakers = result.names;
  for (const auto& [site, representative] : triangulation.duplicates()) {
    const Index v = result.vertex_of[representative];
    result.vertex_of[site] = v;
    if (v == no_index) continue;
    Index& speaker = result.speakers[v];
    if (predicates::is_lexicographically_less(sites[site], sites[speaker])) speaker = site;
  }
  return result;
}

std::vector<topology::Halfedge> corners_of(const topology::Mesh& mesh, std::size_t num_vertices) {
  std::vector<topology::Halfedge> corners(num_vertices, no_index);
  for (Index f = 0; f < mesh.num_slots(); ++f) {
    for (unsigned i = 0; i < 3; ++i) corners[mesh[f].vertex[i]] = topology::halfedge(f, i);
  }
  return corners;
}

}  // namespace rondel::query
