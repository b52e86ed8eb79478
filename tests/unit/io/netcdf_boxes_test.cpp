// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Boxes of variables in classic files, and boxes with their dimensions in another order, against copies that are made number by
// number.
#include "io/netcdf_boxes.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "support/random.h"
#include "unit/io/classic_file.h"
#include "unit/io/support.h"

namespace rondel::test::of_boxes {
namespace {

using Shape = std::vector<std::uint64_t>;
using io::NetcdfBox;
using io::NetcdfReader;
using io::NetcdfType;

// A file with one variable "v", behind another one, of numbers that differ from their neighbors.
struct BoxFile {
  Shape shape;
  std::vector<double> values;
  std::string bytes;

  explicit BoxFile(Shape of, NetcdfType type = NetcdfType::int8) : shape(std::move(of)) {
    ClassicFile file;
    std::uint64_t size = 1;
    std::vector<std::size_t> dimensions;
    for (const std::uint64_t length : shape) {
      dimensions.push_back(file.dimensions.size());
      file.dimensions.push_back({"d" + std::to_string(dimensions.size()), length});
      size *= length;
    }
    for (std::uint64_t i = 0; i < size; ++i) {
      values.push_back(static_cast<double>((i * 37 + i / 251 + i / 60'000) % 127));
    }
    file.variables.push_back(classic_variable("first", NetcdfType::int32, {}, {-1}));
    file.variables.push_back(classic_variable("v", type, dimensions, values));
    bytes = file.bytes();
  }

  // The numbers of a box, dimension order[k] of the variable as dimension k of the result.
  [[nodiscard]] std::vector<double> copy(const NetcdfBox& box,
                                         const std::vector<std::size_t>& order) const {
    std::size_t size = 1;
    for (const std::size_t count : box.count) size *= count;
    std::vector<double> numbers(size);
    for (std::size_t i = 0; i < size; ++i) {
      std::vector<std::size_t> at(shape.size());
      std::size_t rest = i;
      for (std::size_t k = order.size(); k-- > 0; rest /= box.count[order[k]]) {
        at[order[k]] = box.start[order[k]] + rest % box.count[order[k]];
      }
      std::size_t place = 0;
      for (std::size_t d = 0; d < shape.size(); ++d) place = place * shape[d] + at[d];
      numbers[i] = values[place];
    }
    return numbers;
  }
  [[nodiscard]] std::vector<std::size_t> natural_order() const {
    std::vector<std::size_t> order(shape.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
  }
};

// Compares a box, read from memory, with the copy.
void expect_box(const BoxFile& file, const NetcdfReader& reader, const NetcdfBox& box) {
  const std::vector<double> expected = file.copy(box, file.natural_order());
  std::vector<double> found(expected.size());
  reader.read_box(reader.require("v"), box, found);
  EXPECT_TRUE(found == expected) << ::testing::PrintToString(box.start) << " "
                                 << ::testing::PrintToString(box.count) << " of "
                                 << ::testing::PrintToString(file.shape);
}

NetcdfBox random_box(Random& random, const Shape& shape) {
  NetcdfBox box;
  for (const std::uint64_t length : shape) {
    const std::size_t count =
        random.below(3) == 0 ? length : 1 + random.below(static_cast<std::uint32_t>(length));
    box.count.push_back(count);
    box.start.push_back(random.below(static_cast<std::uint32_t>(length - count + 1)));
  }
  return box;
}

TEST(netcdf_boxes, of_small_arrays_are_what_a_copy_is) {
  for (const Shape& shape :
       {Shape{5}, Shape{4, 3}, Shape{1, 6}, Shape{2, 3, 4}, Shape{3, 1, 4}, Shape{2, 2, 3, 3}}) {
    for (const NetcdfType type : {NetcdfType::int8, NetcdfType::int32, NetcdfType::float64}) {
      const BoxFile file(shape, type);
      const NetcdfReader reader(file.bytes);
      NetcdfBox box{std::vector<std::size_t>(shape.size(), 0),
                    std::vector<std::size_t>(shape.size(), 1)};
      for (std::size_t d = 0; d < shape.size();) {  // all boxes
        expect_box(file, reader, box);
        for (d = 0; d < shape.size(); ++d) {
          if (box.start[d] + ++box.count[d] <= shape[d]) break;
          box.count[d] = 1;
          if (++box.start[d] < shape[d]) break;
          box.start[d] = 0;
        }
      }
    }
  }
}

// Short runs with gaps between them are read together, about 2^20 numbers at once; longer ones one by one.
TEST(netcdf_boxes, of_short_runs_with_gaps_are_what_a_copy_is) {
  struct Case {
    Shape shape;
    NetcdfBox box;
  };
  const std::vector<Case> cases = {
      {{530'000, 2}, {{3, 1}, {529'990, 1}}},
      {{2100, 1024}, {{1, 5}, {2099, 7}}},
      {{2100, 1025}, {{1, 5}, {2098, 511}}},
      {{1500, 1024}, {{0, 0}, {1500, 511}}},
      {{1500, 1024}, {{0, 1}, {1500, 512}}},
      {{1500, 1024}, {{7, 1}, {1025, 513}}},
      {{2, 1600, 700}, {{0, 2, 600}, {2, 1597, 100}}},
      {{2, 1600, 700}, {{1, 2, 0}, {1, 1598, 699}}},
      {{3, 1100, 20, 50}, {{1, 40, 3, 7}, {2, 1055, 16, 40}}},
      {{3, 1100, 20, 50}, {{0, 40, 3, 0}, {3, 1055, 16, 50}}},
      {{3, 400, 2000}, {{1, 5, 100}, {2, 390, 1500}}},
      {{3, 400, 2000}, {{0, 5, 0}, {3, 390, 2000}}},
  };
  for (const Case& one : cases) {
    const BoxFile file(one.shape);
    expect_box(file, NetcdfReader(file.bytes), one.box);
  }
  Random random(3);
  for (const Shape& shape : {Shape{7, 50, 30}, Shape{30, 40, 50}, Shape{4, 5, 600, 3}}) {
    const BoxFile file(shape);
    const NetcdfReader reader(file.bytes);
    for (int i = 0; i < 60; ++i) expect_box(file, reader, random_box(random, shape));
  }
}

TEST(netcdf_boxes, are_read_from_the_disk) {
  const BoxFile file({40, 7, 600}, NetcdfType::int16);
  const TemporaryDirectory directory;
  io::FileBytes bytes(directory.with("v.nc", file.bytes));
  const NetcdfReader reader(bytes);
  EXPECT_EQ(reader.num_bytes(), file.bytes.size());
  expect_box(file, reader, {{3, 2, 590}, {31, 3, 9}});
  expect_box(file, reader, {{39, 6, 599}, {1, 1, 1}});
}

TEST(netcdf_boxes, have_their_dimensions_in_any_order) {
  Random random(4);
  for (const Shape& shape : {Shape{6}, Shape{5, 7}, Shape{4, 5, 6}, Shape{3, 4, 2, 5}}) {
    const BoxFile file(shape, NetcdfType::int16);
    const NetcdfReader reader(file.bytes);
    std::vector<std::size_t> order = file.natural_order();
    do {
      for (const std::size_t most : {1U, 2U, 3U, 5U, 8U, 17U, 40U, 1000U}) {
        NetcdfBox box = random_box(random, shape);
        for (int i = 0; i < 2; ++i) {
          const std::vector<double> expected = file.copy(box, order);
          std::vector<double> found(expected.size());
          io::read_in_order(reader, reader.require("v"), box, order, found, 2, most);
          EXPECT_EQ(found, expected) << ::testing::PrintToString(order) << " in pieces of " << most;
          box = {std::vector<std::size_t>(shape.size(), 0), {shape.begin(), shape.end()}};
        }
      }
    } while (std::ranges::next_permutation(order).found);
  }
}

TEST(netcdf_boxes, of_no_dimensions_are_one_number) {
  const BoxFile file({});
  const NetcdfReader reader(file.bytes);
  std::vector<double> found = {-5};
  io::read_in_order(reader, reader.require("first"), {}, {}, found, 1);
  EXPECT_EQ(found, std::vector<double>{-1});
  const BoxFile other({3, 2});
  const NetcdfReader of_other(other.bytes);
  io::read_in_order(of_other, of_other.require("v"), {{0, 0}, {0, 2}},
                    std::vector<std::size_t>{1, 0}, {}, 1);
}

}  // namespace
}  // namespace rondel::test::of_boxes
