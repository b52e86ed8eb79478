// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/collected_rows.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

#include "system/parallel.h"

namespace rondel::interpolation {

CollectedRows::CollectedRows(const Ground& ground, SharedPlace shared) : ground_(ground) {
  if (shared == SharedPlace::mean) shared_ = shared_places(ground);
}

void CollectedRows::append(const Row& row, RowList& list) const {
  for (const auto& [vertex, weight] : row) {
    const auto place = std::ranges::lower_bound(shared_, vertex, {}, &SharedSites::vertex);
    if (place == shared_.end() || place->vertex != vertex) {
      list.columns.push_back(ground_.name(vertex));
      list.values.push_back(weight);
      continue;
    }
    for (const Index site : place->sites) {
      list.columns.push_back(site);
      list.values.push_back(weight / static_cast<double>(place->sites.size()));
    }
  }
}

void CollectedRows::add(RowList list) {
  const std::lock_guard lock(mutex_);
  lists_.push_back(std::move(list));
}

// Lengths of rows are summed to offsets; then each list is copied to its places, in parallel.
Weights CollectedRows::joined(std::size_t num_targets, unsigned threads) const {
  Weights weights;
  weights.num_columns = ground_.num_sites();
  weights.offsets.assign(num_targets + 1, 0);
  for (const RowList& list : lists_) {
    std::uint64_t begin = 0;
    for (std::size_t k = 0; k < list.targets.size(); ++k) {
      weights.offsets[list.targets[k] + std::size_t{1}] =
          list.ends[k] - std::exchange(begin, list.ends[k]);
    }
  }
  std::partial_sum(weights.offsets.begin(), weights.offsets.end(), weights.offsets.begin());
  weights.columns.resize(weights.offsets.back());
  weights.values.resize(weights.offsets.back());
  system::parallel_for(threads, lists_.size(), 1, [&](std::size_t first, std::size_t /*last*/) {
    const RowList& list = lists_[first];
    std::uint64_t from = 0;
    for (std::size_t k = 0; k < list.targets.size(); ++k) {
      std::uint64_t to = weights.offsets[list.targets[k]];
      for (; from < list.ends[k]; ++from, ++to) {
        weights.columns[to] = list.columns[from];
        weights.values[to] = list.values[from];
      }
    }
  });
  return weights;
}

}  // namespace rondel::interpolation
