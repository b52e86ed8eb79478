// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Lists of different lengths in flat arrays: the form in which results have rings, lines,
/// neighbors and polygons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rondel {

/// Lists one after the other in one array. Row i has `values[offsets[i]] ...
/// values[offsets[i+1]-1]`. Where values have more than one array, entry k of the others belongs to
/// `values[k]`.
template <class T>
struct CompressedRows {
  std::vector<std::uint64_t> offsets = {0};  ///< one offset more than rows; never decreasing
  std::vector<T> values;

  [[nodiscard]] std::size_t size() const noexcept {
    return offsets.empty() ? 0 : offsets.size() - 1;
  }
  /// Returns row i. \pre i < size()
  [[nodiscard]] std::span<const T> operator[](std::size_t i) const {
    return {values.data() + offsets[i], values.data() + offsets[i + 1]};
  }

  /// Ends a row, whose values are those that were appended after the row before it.
  void end_row() { offsets.push_back(values.size()); }
  /// Appends a row, which must not be one of this object.
  void append(std::span<const T> row) {
    values.insert(values.end(), row.begin(), row.end());
    end_row();
  }
  /// Appends all rows of another object, which must not be this one.
  void append_rows(const CompressedRows& others) {
    for (std::size_t i = 0; i < others.size(); ++i) {
      offsets.push_back(values.size() + others.offsets[i + 1]);
    }
    values.insert(values.end(), others.values.begin(), others.values.end());
  }
  friend bool operator==(const CompressedRows&, const CompressedRows&) = default;
};

/// Groups of rows that follow each other: group i consists of the rows offsets[i] ...
/// offsets[i+1]-1. The rows are CompressedRows or are groups themselves, as those of a band, whose
/// polygons have several rings.
template <class Rows>
struct RowGroups {
  std::vector<std::uint64_t> offsets = {0};  ///< one offset more than groups; counts rows
  Rows rows;

  [[nodiscard]] std::size_t size() const noexcept {
    return offsets.empty() ? 0 : offsets.size() - 1;
  }
  /// Ends a group, whose rows are those that were appended after the group before it.
  void end_group() { offsets.push_back(rows.size()); }
  friend bool operator==(const RowGroups&, const RowGroups&) = default;
};

}  // namespace rondel
