// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Sparse matrices of weights that interpolate or remap values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// A sparse matrix in compressed rows: row r has the weight `values[k]` in column `columns[k]` for
/// offsets[r] <= k < offsets[r + 1]. A row is a target, a column is a site or a source cell.
///
/// 1. A row without entries stands for a target that has no value.
/// 2. Within a row the order depends on the places of the sites alone, not on their indices, so
///    that sums along it have the same bytes for every order of the sites.
/// 3. The hashes are point_set_hash() of the sites and of the targets, or 0 if they are not known.
struct Weights {
  std::vector<std::uint64_t> offsets = {0};  ///< one offset more than rows; counts entries
  std::vector<Index> columns;
  std::vector<double> values;
  std::size_t num_columns = 0;
  std::uint64_t sites_hash = 0;
  std::uint64_t targets_hash = 0;

  [[nodiscard]] std::size_t num_rows() const noexcept { return offsets.size() - 1; }
  /// Ends a row, whose entries are those that were appended after the row before it.
  void end_row() { offsets.push_back(columns.size()); }
  friend bool operator==(const Weights&, const Weights&) = default;
};

/// Returns a hash of the points and their order: the 64-bit FNV-1a (Fowler, Noll, Vo) of the
/// coordinates x y z of each point, as little-endian doubles, with -0 as 0. It is never 0.
RONDEL_API std::uint64_t point_set_hash(std::span<const Point> points);

/// True if a part may be missing of a whole: its share is at most `max_missing`, or larger by no more than
/// 1e-9, since shares that should be equal, such as halves of cells, differ in their last bits. This
/// rule holds wherever a share of a target may lack values, by weights or by areas.
/// \param missing  the part, not negative
/// \param all  the whole, in the same unit
RONDEL_API bool may_be_missing(double missing, double all, double max_missing) noexcept;

/// True if a part is larger than another one by more than rounding, 1e-9 of it: equal areas differ in
/// their last digits.
RONDEL_API bool is_larger_share(double a, double b) noexcept;

/// Returns 1 for each target that is covered, and of which the rest may be missing, and 0 for others.
/// \param fractions  the share of each target that is covered
RONDEL_API std::vector<std::int32_t> covered_enough(std::span<const double> fractions,
                                                    double max_missing);

/// The treatment of missing values (NaN) by apply().
struct ApplyOptions {
  /// The value of rows without entries, and of rows in which too much is missing.
  double fill = std::numeric_limits<double>::quiet_NaN();
  /// The share of the sum of a row's absolute weights that missing values may have (may_be_missing()).
  /// The sum of the other values is divided by their share of the row's sum. With 0 one missing value
  /// is too many if its share is above 1e-9, with 1 one value is enough.
  double max_missing = 0;
  /// Whether the sum of the other values stays what it is: integrals are then those of the values that
  /// are there, as RemapNorm::destarea has them. apply_largest_share() does not look at it.
  bool keeps_sums = false;
};

/// Multiplies fields by the matrix: out[f * num_rows() + r] becomes the sum of values[k] * in[f *
/// num_columns + columns[k]] over row r, in the order of the row, for each field f. The bytes are
/// the same on every machine and for any number of threads.
///
/// Where the weights of a row sum up to 1, but for rounding, the sum is a mean: equal values give this
/// value exactly, and without negative weights no mean is beyond the smallest and the largest value.
/// \param in  shape (num_fields, num_columns)
/// \param out  shape (num_fields, num_rows())
/// \throws InvalidInput if a length is not as described, the weights are not in compressed rows
///         or not finite (first bad position), or `max_missing` is not in [0, 1].
RONDEL_API void apply(const Weights& weights, std::span<const double> in, std::span<double> out,
                      std::size_t num_fields = 1, const ApplyOptions& options = {},
                      const Execution& execution = {});

/// Gives each row the value that the largest part of its weights has, for categories: flags, land
/// use, types of soil. Of values with equal parts the smallest counts. Missing values, empty rows
/// and lengths are treated as by apply().
/// \throws InvalidInput as apply() does, and for a weight that is not finite (first bad position)
RONDEL_API void apply_largest_share(const Weights& weights, std::span<const double> in,
                                    std::span<double> out, std::size_t num_fields = 1,
                                    const ApplyOptions& options = {},
                                    const Execution& execution = {});

/// Returns the matrix with other numbers of rows and columns, for weights that were made for a part
/// of the targets and sites: row r becomes row rows[r], and column c becomes column columns[c]. The
/// order within a row is kept. The hashes are unknown.
/// \param rows  one number below `num_rows` for each row, all different; rows that are not named are
///              empty
/// \param columns  one number below `num_columns` for each column
/// \throws InvalidInput if the weights are not in compressed rows, a length is not as described, or
///         a number is too large or stands twice (its position).
RONDEL_API Weights renumbered(const Weights& weights, std::span<const Index> rows,
                              std::size_t num_rows, std::span<const Index> columns,
                              std::size_t num_columns);

/// Returns the matrix with rows replaced where a mask is 0: by the rows of another matrix, or by
/// empty ones. The hashes are those of `weights`.
/// \param mask  one number for each row
/// \param others  a matrix of the same shape; null for empty rows
/// \throws InvalidInput if a matrix is not in compressed rows, or the lengths differ.
RONDEL_API Weights with_rows(const Weights& weights, std::span<const std::int32_t> mask,
                             const Weights* others = nullptr);

/// Returns the matrix with empty rows instead of those that have an entry in a column whose mask is
/// 0: their targets need a site that takes no part. The hashes are those of `weights`.
/// \param mask  one number for each column
/// \throws InvalidInput if the weights are not in compressed rows, or the lengths differ.
RONDEL_API Weights without_columns(const Weights& weights, std::span<const std::int32_t> mask);

/// True if the weights give each target the value of one site, or none: beside zeros a row has one
/// entry, which is 1. What the values stand for, as numbers of categories, then holds at the targets.
/// \throws InvalidInput if the weights are not in compressed rows
RONDEL_API bool choose_values(const Weights& weights);

}  // namespace rondel
