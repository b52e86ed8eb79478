// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An array of numbers of sites or faces: uint32 while the largest one fits, otherwise int64, as NumPy
// makes a double of uint64 and int64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "distributed/result_array.h"

namespace rondel::distributed {

// Whether so many different numbers, from 0 on, are uint32.
constexpr bool are_narrow(std::uint64_t num_different) {
  return num_different <= std::uint64_t{1} << 32U;
}

class RowFile {
 public:
  explicit RowFile(std::unique_ptr<ResultArray> array) : array_(std::move(array)) {}

  // Asks for room for so many rows.
  void reserve(std::uint64_t num_rows, std::uint64_t num_columns, std::uint64_t num_different);
  // Numbers are less than `num_different`. One column: one dimension. As many as the rows have must follow.
  void begin(std::uint64_t num_rows, std::uint64_t num_columns, std::uint64_t num_different);

  void add(std::uint64_t number) {
    if (is_narrow_) {
      narrow_.push_back(static_cast<std::uint32_t>(number));
      if (narrow_.size() == buffer_size) write_buffer();
    } else {
      wide_.push_back(static_cast<std::int64_t>(number));
      if (wide_.size() == buffer_size) write_buffer();
    }
  }

  void commit();

 private:
  static constexpr std::size_t buffer_size = std::size_t{1} << 17;

  void write_buffer();

  std::unique_ptr<ResultArray> array_;
  bool is_narrow_ = true;
  std::vector<std::uint32_t> narrow_;
  std::vector<std::int64_t> wide_;
};

}  // namespace rondel::distributed
