// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/row_file.h"

#include <array>

#include "io/binary.h"
#include "io/npy_header.h"

namespace rondel::distributed {

void RowFile::reserve(std::uint64_t num_rows, std::uint64_t num_columns,
                      std::uint64_t num_different) {
  constexpr std::uint64_t header = 128;
  file_.reserve(header + num_rows * num_columns * (are_narrow(num_different) ? 4 : 8));
}

void RowFile::begin(std::uint64_t num_rows, std::uint64_t num_columns,
                    std::uint64_t num_different) {
  is_narrow_ = are_narrow(num_different);
  const std::array<std::uint64_t, 2> shape = {num_rows, num_columns};
  file_.write(io::make_npy_header(is_narrow_ ? "<u4" : "<i8", shape));
  if (is_narrow_) {
    narrow_.reserve(buffer_size);
  } else {
    wide_.reserve(buffer_size);
  }
}

void RowFile::write_buffer() {
  file_.write(io::NumberBytes(narrow_));
  file_.write(io::NumberBytes(wide_));
  narrow_.clear();
  wide_.clear();
}

void RowFile::commit() {
  write_buffer();
  file_.commit();
}

}  // namespace rondel::distributed
