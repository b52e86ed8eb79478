// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Decides which fields of a netCDF variable are read together. A field is the array of values at
// the points for one index of each other dimension (a time, a level). In a file with the order
// (cell, time) each field is spread over the whole file, and a chunk of a netCDF-4 file may hold
// parts of many fields.
//
// in    a variable and which of its dimensions are those of the points
// out   for each field the block of fields to read with it, as a box of the variable
// index fields, the last leading dimension varying fastest
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/field_layout.h"
#include "io/netcdf_boxes.h"
#include "io/netcdf_reader.h"

namespace rondel::formats {

// Fields `first` ... `first + count - 1`.
struct FieldBlock {
  std::size_t first;  // number of the first field
  std::size_t count;
};

// The number of values in a block that FieldSlices uses.
inline constexpr std::size_t usual_block = std::size_t{1} << 24U;

// Blocks of about `max_values` values, or of one field where a field has more. A block is a box of
// the variable: it has one index of each of the first leading dimensions, some indices of the next
// one (whole chunks if they fit) and all indices of the rest. So the file is read once for each
// block of fields, and only once if the fields of a chunk fit into a block.
class FieldBlocks {
 public:
  FieldBlocks(const io::NetcdfReader& file, const io::VariableInFile& variable,
              const FieldDimensions& layout, std::size_t max_values);

  // True if the values of each field are contiguous in the file and in no chunk with those of
  // others.
  [[nodiscard]] bool are_apart() const { return are_apart_; }
  // Returns the block that has this field.
  [[nodiscard]] FieldBlock block_of(std::size_t field) const;
  // Returns up to so many fields from this one on that are a block as well, or none if fields of
  // several indices of the divided dimension would be.
  [[nodiscard]] FieldBlock part_from(std::size_t field, std::size_t most) const;
  // Returns the bytes of all uncompressed chunks that a field has a part of.
  [[nodiscard]] std::uint64_t bytes_of_chunks() const { return bytes_of_chunks_; }
  // Returns the box of the variable that has this block.
  [[nodiscard]] io::NetcdfBox box_of(const FieldBlock& block) const;

 private:
  bool are_apart_;
  std::vector<std::size_t> shape_;    // lengths of the dimensions of the variable
  std::vector<std::size_t> leading_;  // the dimensions that are not those of the points
  // The number of leading dimensions, the first ones, of which a block has one index.
  std::size_t num_outer_ = 0;
  // How many indices of the next leading dimension a block has.
  std::size_t length_ = 1;
  // The number of fields for each of these indices.
  std::size_t of_place_ = 1;
  std::uint64_t bytes_of_chunks_ = 0;
};

}  // namespace rondel::formats
