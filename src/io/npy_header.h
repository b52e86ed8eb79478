// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// NumPy's array format (.npy): a magic string, a header that is a Python dictionary, the numbers.
// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
//
// in    the bytes of a file, or of its head
// out   a header; numbers of a table
// index rows and columns of a table, from 0, in both orders of the file
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/binary.h"
#include "rondel/export.h"

namespace rondel::io {

// The header of an array, such as '<f8', False, (10, 3).
struct NpyHeader {
  std::string dtype;
  bool is_fortran_order = false;
  std::vector<std::uint64_t> shape;
  std::size_t data_offset = 0;
};

// Reads the header of a file of version 1, 2 or 3. Throws BadValue if it is not valid.
NpyHeader parse_npy_header(std::string_view bytes);

// Returns a header of version 1 for an array in C order, padded so that the data is aligned to 64
// bytes.
RONDEL_API std::string make_npy_header(std::string_view dtype,
                                       std::span<const std::uint64_t> shape);

// Returns the shape as Python writes it, such as "(10, 3)".
std::string shape_text(std::span<const std::uint64_t> shape);

// A two-dimensional array in the bytes of a file.
class NpyTable {
 public:
  // Throws BadValue unless the type is one of `types` (such as "f8", in any byte order), which
  // `needed` describes, and the size of the file is that of the array. If `bytes` are only the head
  // of the file, no number may be read.
  NpyTable(std::string_view bytes, std::uint64_t file_size, std::span<const std::string_view> types,
           std::string_view needed);

  // Returns the type without its byte order, such as "f8".
  [[nodiscard]] std::string_view type() const { return std::string_view(header_.dtype).substr(1); }
  [[nodiscard]] std::size_t num_rows() const { return header_.shape[0]; }
  [[nodiscard]] std::size_t num_columns() const { return header_.shape[1]; }
  [[nodiscard]] std::string shape() const { return shape_text(header_.shape); }

  // True if the numbers of a row are stored as they would be in this machine's memory.
  [[nodiscard]] bool has_native_rows() const {
    return !header_.is_fortran_order && order_ == std::endian::native;
  }
  [[nodiscard]] bool is_by_columns() const { return header_.is_fortran_order; }
  [[nodiscard]] std::size_t row_bytes() const { return num_columns() * item_size(); }
  // Returns the offset of a number in the file.
  [[nodiscard]] std::uint64_t place(std::uint64_t row, std::size_t column) const {
    return header_.data_offset + item_size() * position(row, column);
  }

  // Returns the same array with `num_rows` rows, whose bytes, in the order of the file, are
  // elsewhere.
  [[nodiscard]] NpyTable piece(std::string_view bytes, std::size_t num_rows) const;

  // Returns a number. Precondition: T is the type that type() names.
  template <typename T>
  [[nodiscard]] T at(std::size_t row, std::size_t column) const {
    return load<T>(data_ + position(row, column) * sizeof(T), order_);
  }

 private:
  // Returns the bytes of a number: the digit in "f8".
  [[nodiscard]] std::size_t item_size() const { return static_cast<std::size_t>(type()[1] - '0'); }
  // Returns how many numbers come before this one in the file.
  [[nodiscard]] std::size_t position(std::size_t row, std::size_t column) const {
    return header_.is_fortran_order ? column * num_rows() + row : row * num_columns() + column;
  }
  void check_size(std::uint64_t num_bytes) const;

  NpyHeader header_;
  std::endian order_ = std::endian::little;
  const char* data_ = nullptr;
};

}  // namespace rondel::io
