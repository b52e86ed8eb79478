// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/collected_rows.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "system/row_assembly.h"

namespace rondel::interpolation {

CollectedRows::CollectedRows(const PreparedTriangulation& prepared, SharedPlace shared)
    : prepared_(prepared) {
  if (shared == SharedPlace::mean) shared_ = shared_places(prepared);
}

void CollectedRows::append(Index target, const Row& row, RowList& list) const {
  const std::size_t before = list.columns.size();
  for (const auto& [vertex, weight] : row) {
    const auto place = std::ranges::lower_bound(shared_, vertex, {}, &SharedSites::vertex);
    if (place == shared_.end() || place->vertex != vertex) {
      list.columns.push_back(prepared_.name(vertex));
      list.values.push_back(weight);
      continue;
    }
    for (const Index site : place->sites) {
      list.columns.push_back(site);
      list.values.push_back(weight / static_cast<double>(place->sites.size()));
    }
  }
  list.targets.push_back(target);
  list.sizes.push_back(static_cast<Index>(list.columns.size() - before));
}

void CollectedRows::add(RowList list) {
  const std::lock_guard lock(mutex_);
  lists_.push_back(std::move(list));
}

Weights CollectedRows::joined(std::size_t num_targets, unsigned threads) {
  Weights weights;
  weights.num_columns = prepared_.num_sites();
  weights.offsets = system::join_rows(
      threads, num_targets, std::move(lists_),
      [](std::size_t /*list*/, const RowList& list, std::size_t k) { return list.targets[k]; },
      system::JoinedColumn{&RowList::columns, weights.columns},
      system::JoinedColumn{&RowList::values, weights.values});
  return weights;
}

}  // namespace rondel::interpolation
