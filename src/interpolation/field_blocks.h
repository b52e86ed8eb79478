// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which fields of a variable are read together. A field is what the dimensions of the points have at one place of the others; in a
// file of the order (cell, time) each one is spread over the whole file, and in one of netCDF-4 a chunk may have parts of many.
#pragma once

#include <cstddef>
#include <vector>

#include "interpolation/field_layout.h"
#include "io/netcdf_boxes.h"
#include "io/netcdf_reader.h"

namespace rondel::interpolation {

struct FieldBlock {
  std::size_t first;  // field
  std::size_t count;
};

inline constexpr std::size_t usual_block = std::size_t{1} << 24U;

// Blocks of about `most_values` values, or of one field where that has more. A block is a box of the variable: it has one place of the
// first dimensions that are not those of the points, some places of the next one, of whole chunks if they fit, and all places of the
// others. So the file is read once for each block of a chunk's fields, and once in all where a chunk's fields fit into a block.
class FieldBlocks {
 public:
  FieldBlocks(const io::NetcdfReader& file, const io::NetcdfReader::Variable& variable,
              const FieldDimensions& layout, std::size_t most_values);

  // Whether the values of a field follow each other in the file, in no chunk with others.
  [[nodiscard]] bool are_apart() const { return are_apart_; }
  [[nodiscard]] FieldBlock block_of(std::size_t field) const;
  [[nodiscard]] io::NetcdfBox box_of(const FieldBlock& block) const;

 private:
  bool are_apart_;
  std::vector<std::size_t> shape_;    // of the variable
  std::vector<std::size_t> leading_;  // its dimensions that are not those of the points
  std::size_t num_outer_ = 0;         // so many of these have one place in a block
  std::size_t length_ = 1;            // places of the one after them
  std::size_t of_place_ = 1;          // fields of each of these
};

}  // namespace rondel::interpolation
