// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The nearest vertex by steepest ascent over neighbors, which graph.h proves right: exact for any
// start, fast from a near one.
#pragma once

#include <algorithm>
#include <vector>

#include "query/graph.h"
#include "query/target.h"
#include "query/visited.h"

namespace rondel::query {

// The vertices at exactly the same distance as `top`, to which none of its neighbors is nearer. If
// one of their neighbors is nearer, `top` becomes that one. Otherwise it becomes the vertex of
// the smallest name.
template <Graph G, class Target>
bool leave_plateau(const G& graph, const Target& target, Candidate& top) {
  VisitedSet visited;
  std::vector<Candidate> plateau = {top};
  visited.insert(top.vertex);
  bool is_left = false;
  for (std::size_t i = 0; i < plateau.size() && !is_left; ++i) {
    graph.visit_neighbors(plateau[i].vertex, [&](Index w) {
      if (!visited.insert(w)) return false;
      const Candidate candidate = target.candidate(w);
      const Sign sign = target.compare(candidate, top);
      if (sign == Sign::zero) plateau.push_back(candidate);
      if (sign == Sign::positive) top = candidate;
      is_left = sign == Sign::positive;
      return is_left;
    });
  }
  if (!is_left) {
    top = *std::ranges::min_element(plateau, {},
                                    [&graph](const Candidate& c) { return graph.name(c.vertex); });
  }
  return is_left;
}

// The nearest vertex; of several, the one of the smallest name.
template <Graph G, class Target>
Candidate nearest(const G& graph, const Target& target, Index start) {
  Candidate top = target.candidate(start);
  for (;;) {
    const Index from = top.vertex;
    bool is_tied = false;
    graph.visit_neighbors(from, [&](Index w) {
      const Candidate candidate = target.candidate(w);
      const Sign sign = target.compare(candidate, top);
      if (sign == Sign::positive) top = candidate;
      if (sign == Sign::zero) is_tied = true;
      return false;
    });
    if (top.vertex != from) continue;
    if (!is_tied || !leave_plateau(graph, target, top)) return top;
  }
}

}  // namespace rondel::query
