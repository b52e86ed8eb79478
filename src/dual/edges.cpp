// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "dual/ring_walk.h"
#include "rondel/diagram.h"

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
  std::vector<std::uint64_t> ends(triangulation.num_sites() + 1, 0);
  for_each_edge(faces, [&](Index a, Index) { ++ends[a + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Edge> result(ends.back());
  // ends[a] moves from the first place of a's edges to the first place after them.
  for_each_edge(faces, [&](Index a, Index b) { result[ends[a]++] = {a, b}; });
  std::uint64_t begin = 0;
  for (const std::uint64_t end : ends) {
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(begin),
              result.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  return result;
}

}  // namespace rondel
