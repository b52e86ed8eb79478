// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divide and conquer by itself: all its triangles against the faces that the center sees, of the
// same sites in the incremental build.
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <type_traits>
#include <vector>

#include "bulk/piece.h"
#include "kernel/triangulate.h"
#include "order/cube_position.h"
#include "order/spatial_order.h"
#include "support/generators.h"

namespace rondel::test {

inline Triple lowest_corner_first(Triple t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

// The faces of the part of the graph that the boundary reaches, by rank. Adds {} if a face has not
// three sides.
inline std::set<Triple> faces_of(const bulk::PlaneGraph& graph, bulk::PlaneGraph::Edge boundary) {
  using Edge = bulk::PlaneGraph::Edge;
  std::set<Edge> outer;
  Edge e = boundary;
  do {
    outer.insert(e ^ 1);
    e = graph.next(e ^ 1);
  } while (e != boundary);
  std::set<Triple> faces;
  std::vector<Edge> stack = {boundary};
  std::set<Edge> seen = {boundary};
  while (!stack.empty()) {
    const Edge f = stack.back();
    stack.pop_back();
    const Edge g = graph.face_next(f);
    if (outer.count(f) == 0) {
      const bool is_triangle = graph.face_next(graph.face_next(g)) == f;
      faces.insert(is_triangle
                       ? lowest_corner_first({graph.origin(f), graph.origin(g), graph.target(g)})
                       : Triple{});
    }
    for (const Edge next : {f ^ 1, g}) {
      if (seen.insert(next).second) stack.push_back(next);
    }
  }
  return faces;
}

// The faces that the center sees, by rank.
inline std::set<Triple> solid_faces(const SiteSet& set, const order::SpatialOrder& order,
                                    Model model) {
  const system::Job options{{.model = model, .sphere = set.sphere}, {.threads = 1}};
  const auto arrays = kernel::triangulate(set.sites, order.order, {}, options).arrays;
  std::vector<Index> rank(set.sites.size(), no_index);
  for (Index i = 0; i < order.order.size(); ++i) rank[order.order[i]] = i;
  std::set<Triple> faces;
  for (Index f = 0; f < arrays.faces.size(); ++f) {
    if (std::ranges::binary_search(arrays.ghost_faces, f)) continue;
    const Triple& v = arrays.faces[f];
    faces.insert(lowest_corner_first({rank[v[0]], rank[v[1]], rank[v[2]]}));
  }
  return faces;
}

enum class Divided { same, different, left_to_seam, misplaced, too_few };

// Sites of one face of the cube. `extent` holds for the weighted model.
template <class T>
Divided divide_and_compare(const SiteSet& set, const bulk::Extent& extent) {
  constexpr bool is_weighted = std::is_same_v<T, models::WeightedPoints>;
  constexpr Model model = is_weighted ? Model::weighted : Model::projected;
  constexpr int min_bit = bulk::min_bit;
  const Point& center = set.sphere.center;
  const auto order = order::spatial_order(set.sites, model, center, 1);
  if (order.order.size() < 2) return Divided::too_few;
  const auto first = order::exact_cube_position(set.sites[order.order[0]], center);
  const bulk::Square whole_face = {{first.face, 0, 0}, order::position_bits, 0};
  const auto num_sites = static_cast<Index>(order.order.size());
  const bulk::Input input = {set.sites,
                             order.order,
                             {{.model = model, .sphere = set.sphere}, {.threads = 1}},
                             {},
                             is_weighted ? extent : bulk::Extent{}};
  bulk::PieceMemory memory;
  memory.reserve(num_sites);
  const bulk::GivenSites<T> given(input);
  bulk::SquareSites<T> sites;
  sites.assign(input, given, 0, num_sites, memory.coordinates());
  sites.enter(whole_face, num_sites);
  for (Index i = 0; i < num_sites; ++i) {
    const auto exact = order::exact_cube_position(sites.point(i), center);
    const auto& p = sites.positions()[i];
    if (order::cube_position(sites.point(i), center).face != first.face) return Divided::misplaced;
    if (exact.u >> min_bit != p.u >> min_bit || exact.v >> min_bit != p.v >> min_bit) {
      return Divided::misplaced;
    }
  }
  bulk::PlaneGraph graph = memory.graph(0, 0, num_sites);
  const auto plan = std::make_unique<bulk::LeafPlan>();
  bulk::Divide<T> divide(sites, {}, *plan, graph);
  const auto all = divide.run(0, num_sites, 0, order::position_bits - 1);
  if (divide.has_failed()) return Divided::left_to_seam;
  return faces_of(graph, all.edge) == solid_faces(set, order, model) ? Divided::same
                                                                     : Divided::different;
}

}  // namespace rondel::test
