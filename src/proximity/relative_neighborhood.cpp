// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "proximity/relative_neighborhood.h"

#include <utility>

#include "system/row_assembly.h"

namespace rondel::proximity {

CompressedRows<Index> adjacency_of(std::size_t num_sites,
                                   std::span<const std::array<Index, 2>> edges) {
  system::RowPlaces places(num_sites);
  for (const auto& [a, b] : edges) {
    places.count(a);
    places.count(b);
  }
  CompressedRows<Index> result;
  result.values.resize(places.sum());
  for (const auto& [a, b] : edges) {
    result.values[places.place(a)] = b;
    result.values[places.place(b)] = a;
  }
  result.offsets = std::move(places).offsets();
  return result;
}

void LuneSearch::Front::start(Index v) {
  visited.clear();
  queue.assign(1, v);
  visited.insert(v);
  next = 0;
}

bool LuneSearch::is_empty(const std::array<Index, 2>& edge) {
  const auto [a, b] = edge;
  from_a_.start(a);
  from_b_.start(b);
  while (true) {
    if (step(from_a_, a, b)) return false;
    if (from_a_.is_at_end()) return true;
    if (step(from_b_, b, a)) return false;
    if (from_b_.is_at_end()) return true;
  }
}

bool LuneSearch::step(Front& front, Index from, Index to) const {
  for (const Index c : adjacency_[front.queue[front.next++]]) {
    if (c == to || !front.visited.insert(c) || !distances_.is_shorter(from, c, from, to)) continue;
    if (distances_.is_shorter(to, c, from, to)) return true;
    front.queue.push_back(c);
  }
  return false;
}

}  // namespace rondel::proximity
