// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "arrangement/halfedges.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "arrangement/directions.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {

Halfedges::Halfedges(const Arrangement& arrangement, unsigned threads)
    : arrangement_(arrangement), next_(2 * arrangement.edges.size()) {
  system::RowPlaces<std::uint64_t> places(arrangement.nodes.size());
  for (const auto& edge : arrangement.edges) {
    for (const Index node : edge) places.count(node);
  }
  around_.values.resize(places.sum());
  for (Index h = 0; h < next_.size(); ++h) around_.values[places.place(origin(h))] = h;
  around_.offsets = std::move(places).offsets();
  constexpr std::size_t grain = 1024;
  system::parallel_for(threads, num_nodes(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) sort_around(static_cast<Index>(node));
  });
}

// Sorts the halfedges from a node, and finds what follows the ones that lead to it.
void Halfedges::sort_around(Index node) {
  const std::span<Index> row =
      std::span(around_.values)
          .subspan(around_.offsets[node], around_.offsets[node + 1] - around_.offsets[node]);
  constexpr std::size_t least_unordered = 3;
  if (row.size() >= least_unordered) {
    const Point& reference = point(end(row[0]));
    std::sort(row.begin() + 1, row.end(), [&](Index g, Index h) {
      return compare_directions(point(node), reference, point(end(g)), point(end(h))) < 0;
    });
  }
  for (std::size_t k = 0; k < row.size(); ++k) {
    // Around the face to the left, the halfedge after the one into the node is the next clockwise.
    next_[twin(row[k])] = row[k == 0 ? row.size() - 1 : k - 1];
  }
}

Index Halfedges::sector_towards(Index node, const Point& target) const {
  const std::span<const Index> row = around(node);
  const Point& reference = point(end(row[0]));
  // The last halfedge that is before the direction; the path keeps to the right of an edge along it.
  Index sector = row.back();
  for (const Index h : row) {
    if (compare_directions(point(node), reference, point(end(h)), target) < 0) sector = h;
  }
  return sector;
}

Index Halfedges::sector_from(Index node, const Point& target) const {
  const std::span<const Index> row = around(node);
  const Point& reference = point(end(row[0]));
  // Seen from this end, the path is to the left of the arc.
  Index sector = row.back();
  for (const Index h : row) {
    if (compare_directions(point(node), reference, point(end(h)), target) <= 0) sector = h;
  }
  return sector;
}

bool Halfedges::is_crossed(Index edge, const Point& p, const Point& q) const {
  const auto [a, b] = arrangement_.edges[edge];
  return is_path_crossed(point(a), point(b), p, q);
}

}  // namespace rondel::arrangement
