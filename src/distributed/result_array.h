// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An array of the result while it is written row by row: a .npy file, or an array of a Zarr group.
//
// in    the bytes of rows, in order
// out   a file
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "io/atomic_file.h"
#include "io/zarr_mesh.h"

namespace rondel::distributed {

// The names that .npy and Zarr have for a type of numbers, and its size in bytes.
struct NumberType {
  const char* npy;
  const char* zarr;
  std::uint64_t size;
};
inline constexpr NumberType narrow_number = {"<u4", "uint32", 4};
inline constexpr NumberType wide_number = {"<i8", "int64", 8};
inline constexpr NumberType real_number = {"<f8", "float64", 8};

struct ArrayShape {
  std::uint64_t num_rows = 0;
  std::uint64_t num_columns = 0;  // 0 if the array has one dimension
};

class ResultArray {
 public:
  ResultArray() = default;
  virtual ~ResultArray() = default;
  ResultArray(const ResultArray&) = delete;
  ResultArray& operator=(const ResultArray&) = delete;

  // Reserves disk space.
  virtual void reserve(std::uint64_t num_bytes) = 0;
  // Begins the array: writes its header.
  virtual void begin(const NumberType& type, const ArrayShape& shape) = 0;
  // Appends rows.
  virtual void write(std::string_view bytes) = 0;
  // Ends the array when all rows are written. A .npy file gets its name; a group gets its name when
  // all its arrays are complete.
  virtual void commit() = 0;
};

// Makes a .npy file.
std::unique_ptr<ResultArray> make_result(const std::string& path);

// Makes an array of a group; `head` makes its description from the type of numbers and the number
// of rows.
using MakeHead = io::ZarrHead (*)(const std::string& type, std::uint64_t num_rows);
std::unique_ptr<ResultArray> make_result(io::ZarrGroup& group, MakeHead head);

}  // namespace rondel::distributed
