// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Decides which edges belong to the relative neighborhood graph. The lune of an edge ab has the
// points that are nearer to a and nearer to b than a and b are to each other; the edge stays if its
// lune has no vertex.
//
// in    the exact distances of sites, the edges of the Delaunay triangulation
// out   whether the lune of an edge is empty
// index sites
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "proximity/site_distances.h"
#include "query/visited.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::proximity {

// Returns the neighbors of each vertex: row v has the other ends of the edges at v.
CompressedRows<Index> adjacency_of(std::size_t num_sites,
                                   std::span<const std::array<Index, 2>> edges);

// Looks for a vertex in the lune of an edge. The vertices that are nearer to one end than the other
// end is are connected by Delaunay edges (query/graph.h), so that a breadth-first search from this
// end finds them all. The search advances from both ends by turns and stops when either is
// exhausted, since one end may have many such vertices.
class LuneSearch {
 public:
  LuneSearch(const SiteDistances& distances, const CompressedRows<Index>& adjacency)
      : distances_(distances), adjacency_(adjacency) {}

  bool is_empty(const std::array<Index, 2>& edge);

 private:
  // The breadth-first search from one end: the queue has the vertices found, `next` is the first of
  // them whose neighbors were not visited.
  struct Front {
    query::VisitedSet visited;
    std::vector<Index> queue;
    std::size_t next = 0;

    void start(Index v);
    [[nodiscard]] bool is_at_end() const { return next == queue.size(); }
  };

  // Visits the neighbors of the next vertex in the queue and returns whether one of them is in the
  // lune. Neighbors that are only nearer to `from` than `to` is are appended to the queue.
  bool step(Front& front, Index from, Index to) const;

  const SiteDistances& distances_;
  const CompressedRows<Index>& adjacency_;
  Front from_a_;
  Front from_b_;
};

}  // namespace rondel::proximity
