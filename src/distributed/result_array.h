// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An array of the result while it is written row by row, a .npy file.
//
// in    the bytes of rows, in order
// out   a file
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/npy_header.h"

namespace rondel::distributed {

// The name that .npy has for a type of numbers, and its size in bytes.
struct NumberType {
  const char* npy;
  std::uint64_t size;
};
inline constexpr NumberType narrow_number = {"<u4", 4};
inline constexpr NumberType wide_number = {"<i8", 8};
inline constexpr NumberType real_number = {"<f8", 8};

class ResultArray {
 public:
  explicit ResultArray(const std::string& path) : file_(path) {}

  // Reserves disk space.
  void reserve(std::uint64_t num_bytes) {
    constexpr std::uint64_t header = 128;
    file_.reserve(header + num_bytes);
  }
  // Begins the array: writes its header. The shape has one or two sizes.
  void begin(const NumberType& type, const std::vector<std::uint64_t>& shape) {
    file_.write(io::make_npy_header(type.npy, shape));
  }
  // Appends rows.
  void write(std::string_view bytes) { file_.write(bytes); }
  // Gives the file its name when all rows are written.
  void commit() { file_.commit(); }

 private:
  io::AtomicFile file_;
};

}  // namespace rondel::distributed
