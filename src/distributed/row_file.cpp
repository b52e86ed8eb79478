// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/row_file.h"

#include "io/binary.h"

namespace rondel::distributed {

void RowFile::reserve(std::uint64_t num_rows, std::uint64_t num_columns,
                      std::uint64_t num_different) {
  const NumberType& type = are_narrow(num_different) ? narrow_number : wide_number;
  array_.reserve(num_rows * num_columns * type.size);
}

void RowFile::begin(std::uint64_t num_rows, std::uint64_t num_columns,
                    std::uint64_t num_different) {
  is_narrow_ = are_narrow(num_different);
  std::vector<std::uint64_t> shape = {num_rows};
  if (num_columns != 1) shape.push_back(num_columns);
  array_.begin(is_narrow_ ? narrow_number : wide_number, shape);
  if (is_narrow_) {
    narrow_.reserve(buffer_size);
  } else {
    wide_.reserve(buffer_size);
  }
}

void RowFile::write_buffer() {
  array_.write(io::NumberBytes(narrow_));
  array_.write(io::NumberBytes(wide_));
  narrow_.clear();
  wide_.clear();
}

void RowFile::commit() {
  write_buffer();
  array_.commit();
}

}  // namespace rondel::distributed
