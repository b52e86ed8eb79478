// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Directions from a node are compared by exact orientations: first by the part of a turn from the
// first of them, then with each other.
#include "arrangement/halfedges.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "arrangement/noded_arcs.h"
#include "exact/vector.h"
#include "rondel/predicates.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

// Returns the part of a turn from the direction to `reference` to that to p: 0 for none, 1 for less
// than half, 2 for half, 3 for more.
int quarter(const Point& node, const Point& reference, const Point& p) {
  const Sign side = orientation(node, reference, p);
  if (side != Sign::zero) return side == Sign::positive ? 1 : 3;
  // Both directions are on one great circle, so that the sign of this product is certain.
  const Vec first = normalized(normal_of(node, reference));
  return dot(first, normal_of(node, p)) > 0 ? 0 : 2;
}

}  // namespace

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

int Halfedges::compare(Index node, const Point& reference, const Point& p, const Point& q) const {
  const int of_p = quarter(point(node), reference, p);
  const int of_q = quarter(point(node), reference, q);
  if (of_p != of_q) return of_p < of_q ? -1 : 1;
  if (of_p % 2 == 0) return 0;
  return -static_cast<int>(orientation(point(node), p, q));
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
      return compare(node, reference, point(end(g)), point(end(h))) < 0;
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
    if (compare(node, reference, point(end(h)), target) < 0) sector = h;
  }
  return sector;
}

Index Halfedges::sector_from(Index node, const Point& target) const {
  const std::span<const Index> row = around(node);
  const Point& reference = point(end(row[0]));
  // Seen from this end, the path is to the left of the arc.
  Index sector = row.back();
  for (const Index h : row) {
    if (compare(node, reference, point(end(h)), target) <= 0) sector = h;
  }
  return sector;
}

bool Halfedges::is_crossed(Index edge, const Point& p, const Point& q) const {
  const Point& a = point(arrangement_.edges[edge][0]);
  const Point& b = point(arrangement_.edges[edge][1]);
  // Nodes on the arc are to the left of the path.
  const auto side = [&](const Point& node) {
    return orientation(p, q, node) == Sign::negative ? Sign::negative : Sign::positive;
  };
  const Sign first = side(a);
  return side(b) == -first && orientation(a, b, p) == -first && orientation(a, b, q) == first;
}

}  // namespace rondel::arrangement
