// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divides the fields of a variable into blocks that are boxes of it, so that each part of the file
// is read once. The block of a field follows from its number alone.
#include "formats/field_blocks.h"

#include <algorithm>
#include <cstdint>

#include "system/checked_product.h"

namespace rondel::formats {

// Takes whole dimensions from the last leading one on, while they fit; the next one is divided.
FieldBlocks::FieldBlocks(const io::NetcdfReader& file, const io::VariableInFile& variable,
                         const FieldDimensions& layout, std::size_t max_values)
    : shape_(variable.shape.begin(), variable.shape.end()), leading_(layout.leading) {
  const std::vector<std::uint64_t> chunk = file.chunk_of(variable);
  are_apart_ = std::ranges::is_sorted(layout.order()) &&
               std::ranges::all_of(leading_, [&](std::size_t d) { return chunk[d] == 1; });
  std::size_t num_points = 1;
  for (const std::size_t d : layout.points) num_points *= shape_[d];
  // The number of fields that a block has room for.
  const std::size_t room =
      std::max<std::size_t>(max_values / std::max<std::size_t>(num_points, 1), 1);
  num_outer_ = leading_.size();
  while (num_outer_ > 0) {
    const std::size_t d = leading_[--num_outer_];
    length_ = std::clamp<std::size_t>(room / of_place_, 1, std::max<std::size_t>(shape_[d], 1));
    if (length_ < shape_[d]) {
      // A chunk is decompressed as a whole, so no block ends within one if it has room for the
      // chunk.
      if (length_ > chunk[d]) length_ -= length_ % chunk[d];
      break;
    }
    if (num_outer_ > 0) of_place_ *= length_;
  }
  bytes_of_chunks_ = io::size_of(variable.type);
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    const bool is_leading = std::ranges::count(leading_, d) != 0;
    const std::uint64_t num_chunks = is_leading ? 1 : (shape_[d] + chunk[d] - 1) / chunk[d];
    if (!system::multiply_checked(bytes_of_chunks_, num_chunks * chunk[d], bytes_of_chunks_)) {
      bytes_of_chunks_ = ~std::uint64_t{0};
      break;
    }
  }
}

FieldBlock FieldBlocks::part_from(std::size_t field, std::size_t most) const {
  if (leading_.empty() || of_place_ > 1) return {field, 0};
  const std::size_t of_row = shape_[leading_[num_outer_]];
  return {field, std::min(most, of_row - field % of_row)};
}

FieldBlock FieldBlocks::block_of(std::size_t field) const {
  if (leading_.empty()) return {0, 1};
  // A row of blocks has all indices of the divided dimension; the last block of a row may be
  // shorter.
  const std::size_t of_row = shape_[leading_[num_outer_]] * of_place_;
  const std::size_t row = field - field % of_row;
  const std::size_t size = length_ * of_place_;
  const std::size_t first = row + field % of_row / size * size;
  return {first, std::min(size, row + of_row - first)};
}

io::NetcdfBox FieldBlocks::box_of(const FieldBlock& block) const {
  io::NetcdfBox box{std::vector<std::size_t>(shape_.size(), 0), shape_};
  if (leading_.empty()) return box;
  const std::size_t divided = leading_[num_outer_];
  std::size_t place = block.first / of_place_;
  box.start[divided] = place % shape_[divided];
  box.count[divided] = block.count / of_place_;
  place /= shape_[divided];
  for (std::size_t k = num_outer_; k-- > 0;) {
    box.start[leading_[k]] = place % shape_[leading_[k]];
    box.count[leading_[k]] = 1;
    place /= shape_[leading_[k]];
  }
  return box;
}

}  // namespace rondel::formats
