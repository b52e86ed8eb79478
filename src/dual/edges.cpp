// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "dual/ring_walk.h"
#include "rondel/diagram.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using Edge = std::array<Index, 2>;

std::vector<Edge> ring_edges(std::span<const Index> ring) {
  std::vector<Edge> result;
  const std::size_t count = ring.size() < 3 ? ring.size() / 2 : ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const Index a = ring[j];
    const Index b = ring[(j + 1) % ring.size()];
    result.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(result);
  return result;
}

// Each edge is a halfedge with its lower end first in one of its two faces.
template <class F>
void for_each_edge(std::span<const Triple> faces, F visit) {
  for (const Triple& face : faces) {
    for (Index i = 0; i < 3; ++i) {
      const Index a = face[i];
      const Index b = face[dual::next_corner(i)];
      if (a < b) visit(a, b);
    }
  }
}

}  // namespace

// One counting sort by the lower end, then the few edges of each site.

std::vector<Edge> edges(const Triangulation& triangulation) {
  if (triangulation.dimension() < 2) return ring_edges(triangulation.ring());
  const auto faces = triangulation.faces();
  system::RowPlaces places(triangulation.num_sites());
  for_each_edge(faces, [&](Index a, Index) { places.count(a); });
  std::vector<Edge> result(places.sum());
  for_each_edge(faces, [&](Index a, Index b) { result[places.place(a)] = {a, b}; });
  std::uint64_t begin = 0;
  for (const std::uint64_t end : std::move(places).offsets()) {
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(begin),
              result.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  return result;
}

}  // namespace rondel
