// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The rows of weights of many targets, which several threads find in any order, put together in the
// order of the targets.
//
// in    lists of rows, each of some targets, in any order
// out   Weights: one compressed row for each target
// index vertices (spatial ranks) in Row; sites in RowList and in the result
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"
#include "interpolation/vertex_fields.h"
#include "rondel/weights.h"
#include "system/mutex.h"

namespace rondel::interpolation {

// The rows of some targets: row k is that of targets[k] and has sizes[k] entries.
struct RowList {
  std::vector<Index> targets;
  std::vector<Index> sizes;
  std::vector<Index> columns;
  std::vector<double> values;
};

class CollectedRows {
 public:
  // The columns of the rows are sites: the lowest site of each vertex, or with SharedPlace::mean
  // all sites of its place, with equal parts of the weight.
  CollectedRows(const PreparedTriangulation& prepared, SharedPlace shared);

  // Appends the row of a target to a list, with sites instead of vertices.
  void append(Index target, const Row& row, RowList& list) const;
  // Takes over a finished list. Several threads may call this at once.
  void add(RowList list);
  // Returns the rows of targets 0 ... num_targets - 1; the row of a target that nobody added is
  // empty. Call this once, when all lists have been added.
  [[nodiscard]] Weights joined(std::size_t num_targets, unsigned threads);

 private:
  const PreparedTriangulation& prepared_;
  std::vector<SharedSites> shared_;
  system::Mutex mutex_;
  std::vector<RowList> lists_;
};

}  // namespace rondel::interpolation
