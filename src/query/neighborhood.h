// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The k nearest vertices, and all within an angle: searches that spread from the nearest vertex
// over neighbors, because the vertices nearer than any bound are connected (graph.h).
#pragma once

#include <algorithm>
#include <vector>

#include "query/graph.h"
#include "query/nearest.h"
#include "query/target.h"
#include "query/visited.h"

namespace rondel::query {

// The memory of a search, to be used again by the next one.
struct Scratch {
  VisitedSet visited;
  std::vector<Candidate> front;  // a heap, the nearest first
  std::vector<Candidate> level;
  std::vector<Index> found;
};

// Appends the k nearest vertices in order of distance, of equal ones the smaller name first; all if
// there are fewer. `start` is the nearest vertex.
//
// The front holds the neighbors of what was found. Vertices at the same distance form a
// level: within it the search goes on before any is reported, because one of a small name may be
// reached through one of a larger name only.
template <Graph G, class Target>
void k_nearest(const G& graph, const Target& target, const Candidate& start, std::size_t k,
               Scratch& scratch, std::vector<Index>& found) {
  VisitedSet& visited = scratch.visited;
  std::vector<Candidate>& front = scratch.front;
  std::vector<Candidate>& level = scratch.level;
  visited.clear();
  front.assign(1, start);
  visited.insert(start.vertex);
  const auto is_farther = [&target](const Candidate& a, const Candidate& b) {
    return target.compare(a, b) == Sign::negative;
  };
  const std::size_t end = found.size() + k;
  while (found.size() < end && !front.empty()) {
    level.clear();
    do {
      std::ranges::pop_heap(front, is_farther);
      level.push_back(front.back());
      front.pop_back();
      graph.visit_neighbors(level.back().vertex, [&](Index w) {
        if (visited.insert(w)) {
          front.push_back(target.candidate(w));
          std::ranges::push_heap(front, is_farther);
        }
        return false;
      });
    } while (!front.empty() && target.compare(front.front(), level.front()) == Sign::zero);
    std::ranges::sort(level, {}, [&graph](const Candidate& c) { return graph.name(c.vertex); });
    const std::size_t count = std::min(level.size(), end - found.size());
    for (std::size_t i = 0; i < count; ++i) found.push_back(level[i].vertex);
  }
}

// Appends the vertices that `is_inside` accepts, in no order: those connected to
// `start`, the nearest vertex.
template <Graph G, class IsInside>
void flood(const G& graph, Index start, IsInside&& is_inside, Scratch& scratch,
           std::vector<Index>& found) {
  if (!is_inside(start)) return;
  scratch.visited.clear();
  scratch.visited.insert(start);
  std::size_t next = found.size();
  found.push_back(start);
  for (; next < found.size(); ++next) {
    graph.visit_neighbors(found[next], [&](Index w) {
      if (scratch.visited.insert(w) && is_inside(w)) found.push_back(w);
      return false;
    });
  }
}

}  // namespace rondel::query
