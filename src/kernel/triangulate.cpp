// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "kernel/triangulate.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "kernel/brio.h"
#include "kernel/canonical.h"
#include "kernel/great_circle.h"
#include "kernel/mutable_hull.h"
#include "models/with_model.h"
#include "system/gather.h"

namespace rondel::kernel {
namespace {

// Three sites that span space. Sites far apart come first in the order of insertion.
std::vector<Index> find_first(std::span<const Point> sites, std::span<const Index> order,
                              std::span<const Index> insertion, const Point& center) {
  constexpr std::size_t enough = 64;
  std::vector<Point> points;
  const std::size_t few = std::min(enough, insertion.size());
  for (std::size_t i = 0; i < few; ++i) points.push_back(sites[order[insertion[i]]]);
  auto first = find_span(points, center);
  if (first.size() < 3) {
    for (std::size_t i = few; i < insertion.size(); ++i) {
      points.push_back(sites[order[insertion[i]]]);
    }
    first = find_span(points, center);
  }
  for (Index& i : first) i = insertion[i];
  return first;
}

// The hidden ranks.
template <models::SphereTraits T>
std::vector<Hidden> find_hidden(const topology::Mesh& mesh, Index num_ranks) {
  std::vector<Hidden> hidden;
  // V vertices have 2V-4 faces.
  if (T::hides_sites && mesh.num_faces() / 2 + 2 < num_ranks) {
    std::vector<bool> is_vertex(num_ranks, false);
    mesh.for_each_face([&](Index f) {
      for (const Index v : mesh[f].vertex) is_vertex[v] = true;
    });
    for (Index p = 0; p < num_ranks; ++p) {
      if (!is_vertex[p]) hidden.push_back({p, no_index});
    }
  }
  return hidden;
}

template <models::SphereModel T>
Triangulated build(std::span<const Point> sites, std::vector<Index> order,
                   std::span<const order::Renamed> renamed, std::vector<Index> insertion,
                   std::span<const Index> first, const system::Job& options) {
  const auto num_ranks = static_cast<Index>(order.size());
  std::optional<T> traits(std::in_place, sites, order, options.sphere.center);
  MutableHull<T> hull(*traits, {first[0], first[1], first[2]});
  constexpr std::size_t stride = std::size_t{1} << 16;
  for (std::size_t i = 0; i < insertion.size(); ++i) {
    const Index p = insertion[i];
    if (p != first[0] && p != first[1] && p != first[2]) hull.insert(p);
    if (i % stride == 0) system::announce(options, "triangulate", i, insertion.size());
  }
  order::rename(order, renamed);
  Triangulated result;
  result.arrays.dimension = 2;
  result.arrays.hidden = find_hidden<T>(hull.mesh(), num_ranks);
  result.tally = hull.tally();
  traits.reset();
  write_canonical(hull.mesh(), order, std::move(insertion), result.arrays);
  report_ghosts(hull.mesh(), hull.kinds(), result.arrays.ghost_faces);
  for (Hidden& h : result.arrays.hidden) h.site = order[h.site];
  std::ranges::sort(result.arrays.hidden, {}, &Hidden::site);
  return result;
}

// Dimension 1 and below.
Triangulated build_ring(std::span<const Point> sites, std::vector<Index> order,
                        std::span<const order::Renamed> renamed, const system::Job& options) {
  Triangulated result;
  const std::vector<Point> points = system::gather(sites, order);
  const auto span = find_span(points, options.sphere.center);
  result.arrays.ring = ring_of_great_circle(points, span, options.model, options.sphere.center);
  order::rename(order, renamed);
  std::vector<bool> is_vertex(order.size(), false);
  for (Index& v : result.arrays.ring) {
    is_vertex[v] = true;
    v = order[v];
  }
  for (Index p = 0; p < order.size(); ++p) {
    if (!is_vertex[p]) result.arrays.hidden.push_back({order[p], no_index});
  }
  std::ranges::sort(result.arrays.hidden, {}, &Hidden::site);
  const std::size_t num_vertices = result.arrays.ring.size();
  result.arrays.dimension = num_vertices == 0 ? -1 : (num_vertices == 1 ? 0 : 1);
  return result;
}

}  // namespace

Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                         std::span<const order::Renamed> renamed, const system::Job& options) {
  auto insertion = insertion_order(sites, order, options.model, options.sphere.center);
  const auto first = find_first(sites, order, insertion, options.sphere.center);
  if (first.size() < 3) return build_ring(sites, std::move(order), renamed, options);
  return models::with_model(options.model, [&]<class T> {
    return build<T>(sites, std::move(order), renamed, std::move(insertion), first, options);
  });
}

}  // namespace rondel::kernel
