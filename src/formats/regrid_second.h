// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Applies conservative weights of order 2, whose gradients leave out sources without a value.
//
// in    a remapping of order 2, fields at its sources
// out   fields at its targets
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/remap.h"
#include "rondel/types.h"

namespace rondel::formats {

class SecondOrder {
 public:
  // Targets that are not covered (0) get no value. With `is_limited` values are those of
  // apply_limited().
  SecondOrder(Remap remap, std::vector<std::int32_t> covered, bool is_limited);

  // Fields follow each other in both arrays. Weights for fields that lack values are computed again
  // where the field lacks them in other sources than the one before it.
  void apply(std::span<const double> in, std::span<double> out, const ApplyOptions& rules,
             const Execution& execution);

 private:
  [[nodiscard]] std::vector<std::int32_t> with_enough(std::span<const std::int32_t> has_value,
                                                      double max_missing) const;
  void apply_fields(std::span<const double> in, std::span<double> out, const ApplyOptions& rules,
                    const Execution& execution) const;

  Remap remap_;    // its weights are those for has_value_
  Weights whole_;  // those for fields without gaps, while others are in use
  std::vector<std::int32_t> covered_;
  std::vector<std::int32_t> has_value_;  // empty: all sources have values
  bool is_limited_;
};

}  // namespace rondel::formats
