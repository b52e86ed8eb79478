// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Sparse weights that carry values from points to points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// A sparse matrix in compressed rows: what row r takes is `values[k]` of column `columns[k]` for
/// offsets[r] <= k < offsets[r + 1]. A row is a target, a column a site.
///
/// 1. A row without entries stands for a target that has no value.
/// 2. Within a row the order depends on the places of the sites alone, not on their indices, so that
///    sums along it have the same bytes for every order of the sites.
/// 3. The hashes are point_set_hash() of the sites and of the targets; 0: not known.
struct Weights {
  std::vector<std::uint64_t> offsets = {0};  ///< number of rows + 1
  std::vector<Index> columns;
  std::vector<double> values;
  std::size_t num_columns = 0;
  std::uint64_t sites_hash = 0;
  std::uint64_t targets_hash = 0;

  [[nodiscard]] std::size_t num_rows() const noexcept { return offsets.size() - 1; }
  friend bool operator==(const Weights&, const Weights&) = default;
};

/// A number that depends on the points and their order: FNV-1a of 64 bits (Fowler, Noll, Vo) over
/// the coordinates x y z of each, as little-endian doubles, -0 being 0. Never 0.
RONDEL_API std::uint64_t point_set_hash(std::span<const Point> points);

/// What apply() does with values that are not there (NaN).
struct ApplyOptions {
  /// The value of rows without entries, and of those that miss too much.
  double fill = std::numeric_limits<double>::quiet_NaN();
  /// A row may miss values that have up to this share of the sum of its absolute weights; what is left is
  /// divided by its share of the row's sum. 0: one missing value is too many. 1: one value is enough.
  double most_missing = 0;
};

/// The values of rows: for each field f and row r the sum of values[k] * in[f * num_columns +
/// columns[k]] in the order of the row, into out[f * num_rows() + r]. `in` has the shape
/// (num_fields, num_columns), `out` (num_fields, num_rows()).
/// The same bytes on every machine and for any number of threads.
/// \throws InvalidInput if a length is not what it should be, the weights are not in compressed rows
///         (first bad position), or `most_missing` is not in [0, 1].
RONDEL_API void apply(const Weights& weights, std::span<const double> in, std::span<double> out,
                      std::size_t num_fields = 1, const ApplyOptions& options = {},
                      const Execution& execution = {});

}  // namespace rondel
