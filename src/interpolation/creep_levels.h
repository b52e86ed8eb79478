// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Creeping fill: in which order targets get values from their neighbors.
//
// in    neighbors of targets, which targets have a value, and which may get one
// out   levels, and rows of weights
// index targets; two of them are neighbors if each names the other
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel::interpolation {

// The levels of targets that are filled one after the other: those of level 1 have neighbors with
// values, those of level k + 1 have neighbors of level k and none below.
class CreepLevels {
 public:
  CreepLevels() = default;
  // Finds the levels up to `most`, or all of them if that is 0.
  CreepLevels(const CompressedRows<Index>& neighbors, const std::vector<bool>& has_value,
              std::vector<bool>&& may_fill, Index most);

  // Returns the targets of level 1, 2 ..., each ascending.
  [[nodiscard]] const std::vector<std::vector<Index>>& filled() const { return filled_; }
  // Calls visit(giver) for the neighbors of a target that have a lower level.
  template <class Visit>
  void for_each_giver(const CompressedRows<Index>& neighbors, Index target,
                      const Visit& visit) const {
    for (const Index other : neighbors[target]) {
      const bool is_mutual = std::ranges::count(neighbors[other], target) != 0;
      if (is_mutual && level_[other] < level_[target]) visit(other);
    }
  }
  // Returns rows for the targets of all levels: the means of their neighbors' rows. Entries are in
  // the order of the sources' coordinates.
  [[nodiscard]] Weights rows(const CompressedRows<Index>& neighbors, const Weights& weights,
                             std::span<const Point> sources) const;

 private:
  std::vector<Index> level_;  // by target: 0 if it has a value, no_index if it gets none
  std::vector<std::vector<Index>> filled_;
};

}  // namespace rondel::interpolation
