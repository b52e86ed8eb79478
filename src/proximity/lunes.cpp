// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "proximity/lunes.h"

#include <numeric>

namespace rondel::proximity {

Adjacency::Adjacency(std::size_t num_sites, std::span<const std::array<Index, 2>> edges)
    : offsets_(num_sites + 1) {
  for (const auto& [a, b] : edges) {
    ++offsets_[a];
    ++offsets_[b];
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  ends_.resize(offsets_.back());
  for (const auto& [a, b] : edges) {
    ends_[--offsets_[a]] = b;
    ends_[--offsets_[b]] = a;
  }
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
    if (c == to || !front.visited.insert(c) || !chords_.is_shorter(from, c, from, to)) continue;
    if (chords_.is_shorter(to, c, from, to)) return true;
    front.queue.push_back(c);
  }
  return false;
}

}  // namespace rondel::proximity
