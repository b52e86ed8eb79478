// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rows that come in any order of the targets, from several threads, put together in their order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/ground.h"
#include "interpolation/place_values.h"
#include "interpolation/row.h"
#include "rondel/weights.h"
#include "system/mutex.h"

namespace rondel::interpolation {

// Those of one range of targets: row k ends at ends[k].
struct RowList {
  std::vector<Index> targets;
  std::vector<std::uint64_t> ends;
  std::vector<Index> columns;
  std::vector<double> values;
};

class CollectedRows {
 public:
  // The columns are the sites of the vertices, all of a place where the mean is asked for.
  CollectedRows(const Ground& ground, SharedPlace shared);

  void append(const Row& row, RowList& list) const;
  void add(RowList list);
  // The rows of so many targets, in which those that nobody added are empty. Once.
  [[nodiscard]] Weights joined(std::size_t num_targets, unsigned threads) const;

 private:
  const Ground& ground_;
  std::vector<SharedSites> shared_;
  system::Mutex mutex_;
  std::vector<RowList> lists_;
};

}  // namespace rondel::interpolation
