// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The places nearer to both ends of an edge than these are to each other, and whether a vertex is there.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "query/visited.h"
#include "readings/chords.h"
#include "rondel/types.h"

namespace rondel::readings {

// The neighbors of each vertex.
class Adjacency {
 public:
  Adjacency(std::size_t num_sites, std::span<const std::array<Index, 2>> edges);
  [[nodiscard]] std::span<const Index> operator[](Index v) const {
    return {ends_.data() + offsets_[v], ends_.data() + offsets_[v + 1]};
  }

 private:
  std::vector<std::size_t> offsets_;
  std::vector<Index> ends_;
};

// Looks for a vertex nearer to both ends of an edge than these are to each other. The vertices nearer to
// one end are connected by edges (query/graph.h), and so are found from it; from both ends by turns, as
// there may be many around the one.
class LuneSearch {
 public:
  LuneSearch(const Chords& chords, const Adjacency& adjacency)
      : chords_(chords), adjacency_(adjacency) {}

  bool is_empty(const std::array<Index, 2>& edge);

 private:
  struct Front {
    query::VisitedSet visited;
    std::vector<Index> queue;
    std::size_t next = 0;

    void start(Index v);
    [[nodiscard]] bool is_at_end() const { return next == queue.size(); }
  };

  // Whether a neighbor of the next vertex is nearer to both; those nearer to `from` are queued.
  bool step(Front& front, Index from, Index to) const;

  const Chords& chords_;
  const Adjacency& adjacency_;
  Front from_a_;
  Front from_b_;
};

}  // namespace rondel::readings
