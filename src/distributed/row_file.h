// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An array of numbers of sites or faces. They are stored as uint32 if the largest one fits,
// otherwise as int64, since NumPy converts uint64 and int64 together to double.
//
// in    numbers, row by row
// out   a .npy file
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "distributed/result_array.h"

namespace rondel::distributed {

// True if the numbers 0 ... num_different - 1 fit uint32.
constexpr bool are_narrow(std::uint64_t num_different) {
  return num_different <= std::uint64_t{1} << 32U;
}

// Writes numbers of sites or faces.
class RowFile {
 public:
  explicit RowFile(const std::string& path) : array_(path) {}

  // Reserves disk space for that many rows.
  void reserve(std::uint64_t num_rows, std::uint64_t num_columns, std::uint64_t num_different);
  // Begins the array; with one column it has one dimension. All numbers must be less than
  // `num_different`, and num_rows * num_columns numbers must follow.
  void begin(std::uint64_t num_rows, std::uint64_t num_columns, std::uint64_t num_different);

  // Appends a number.
  void add(std::uint64_t number) {
    if (is_narrow_) {
      narrow_.push_back(static_cast<std::uint32_t>(number));
      if (narrow_.size() == buffer_size) write_buffer();
    } else {
      wide_.push_back(static_cast<std::int64_t>(number));
      if (wide_.size() == buffer_size) write_buffer();
    }
  }

  // Writes the rest and ends the array.
  void commit();

 private:
  static constexpr std::size_t buffer_size = std::size_t{1} << 17;

  void write_buffer();

  ResultArray array_;
  bool is_narrow_ = true;
  std::vector<std::uint32_t> narrow_;
  std::vector<std::int64_t> wide_;
};

}  // namespace rondel::distributed
