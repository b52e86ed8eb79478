// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of netCDF-4, where netCDF-C is installed.
#include <cstdint>
#include <limits>
#include <numeric>

#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_boxes.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"
#include "support/thrown.h"
#include "unit/io/support.h"

namespace rondel::test::of_netcdf4_files {
namespace {

using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;
using Shape = std::vector<std::uint64_t>;
using io::NetcdfReader;
using io::NetcdfType;

constexpr std::size_t num_rows = 300;
constexpr std::size_t num_columns = 250;

class netcdf4 : public ::testing::Test {
 protected:
  void SetUp() override {
    io::AtomicFile file(path_);
    io::NetcdfWriter writer(file);
    const std::size_t rows = writer.add_dimension("rows", num_rows);
    const std::size_t columns = writer.add_dimension("columns", num_columns);
    const std::size_t three = writer.add_dimension("three", 3);
    writer.add_attribute("title", "two words");
    writer.add_variable({"v", NetcdfType::float64, {rows, columns}, {}});
    writer.add_variable({"single", NetcdfType::float32, {three}, {}});
    writer.add_variable({"wide", NetcdfType::int64, {three}, {}});
    writer.add_variable({"natural", NetcdfType::uint64, {three}, {}});
    writer.add_variable({"beyond", NetcdfType::uint64, {three}, {}});
    writer.add_variable({"number",
                         NetcdfType::int32,
                         {},
                         {{"units", NetcdfType::text, "m", {}},
                          {"range", NetcdfType::int64, {}, {-3, 9}, {-3, 9}}}});
    writer.add_variable({"letters", NetcdfType::text, {three}, {}});
    try {
      writer.begin({.kind = NetcdfKind::netcdf4});
    } catch (const io::BadValue& bad) {
      GTEST_SKIP() << bad.what();
    }
    for (std::size_t i = 0; i < num_rows * num_columns; ++i) {
      values_.push_back(static_cast<double>(i) * 0.5);
    }
    writer.write<double>(values_);
    writer.write<float>(std::vector<float>{1, 2.5, 3});
    writer.write<std::int64_t>(Integers{-5, std::int64_t{1} << 52U, 7});
    writer.write<std::uint64_t>(std::vector<std::uint64_t>{5, 6, std::uint64_t{1} << 62U});
    writer.write<std::uint64_t>(std::vector<std::uint64_t>{5, 6, std::uint64_t{1} << 63U});
    writer.write<std::int32_t>(std::vector<std::int32_t>{-8});
    writer.write<char>(std::string("abc"));
    writer.finish();
    file.commit();
    bytes_ = read_all(path_);
  }

  // The message of the BadValue; empty if there is none.
  template <class Action>
  static std::string refused(const Action& action) {
    return thrown_message<io::BadValue>(action);
  }

  std::string path_ = temporary_path("a.nc4");
  Doubles values_;
  std::string bytes_;
};

TEST_F(netcdf4, has_what_was_written) {
  io::FileBytes on_disk(path_);
  for (const NetcdfReader& reader : {NetcdfReader(bytes_), NetcdfReader(on_disk)}) {
    EXPECT_EQ(reader.num_bytes(), bytes_.size());
    EXPECT_EQ(reader.max_values(), bytes_.size() << 20U);
    EXPECT_EQ(io::netcdf_text(reader.attributes(), "title"), "two words");
    ASSERT_GE(reader.dimensions().size(), 3U);
    EXPECT_EQ(reader.dimensions()[1].name, "columns");
    EXPECT_EQ(reader.dimensions()[1].size, num_columns);
    const io::VariableInFile& v = reader.require("v");
    EXPECT_EQ(v.shape, (Shape{num_rows, num_columns}));
    EXPECT_EQ(v.num_values, num_rows * num_columns);
    EXPECT_EQ(reader.numbers(v), values_);
    // As many rows as 2^16 values have.
    EXPECT_EQ(reader.chunk_of(v), (Shape{65536 / num_columns, num_columns}));
    EXPECT_EQ(reader.chunk_of(reader.require("number")), Shape{});
    EXPECT_EQ(reader.numbers(reader.require("single")), (Doubles{1, 2.5, 3}));
    EXPECT_EQ(reader.numbers(reader.require("number")), Doubles{-8});
    EXPECT_EQ(reader.integers(reader.require("wide")), (Integers{-5, std::int64_t{1} << 52U, 7}));
    EXPECT_EQ(reader.numbers(reader.require("wide")), (Doubles{-5, 0x1p52, 7}));
    EXPECT_EQ(reader.integers(reader.require("natural")), (Integers{5, 6, std::int64_t{1} << 62U}));
    EXPECT_EQ(reader.numbers(reader.require("beyond")), (Doubles{5, 6, 0x1p63}));
    const auto& attributes = reader.require("number").attributes;
    EXPECT_EQ(io::netcdf_text(attributes, "units"), "m");
    ASSERT_NE(io::find_attribute(attributes, "range"), nullptr);
    EXPECT_EQ(io::find_attribute(attributes, "range")->numbers, (Doubles{-3, 9}));
    EXPECT_EQ(io::find_attribute(attributes, "range")->integers, (Integers{-3, 9}));
  }
}

TEST_F(netcdf4, refuses_what_is_asked_for_as_another_type) {
  const NetcdfReader reader(bytes_);
  EXPECT_EQ(refused([&] { (void)reader.integers(reader.require("v")); }),
            "variable \"v\" is not of integers");
  EXPECT_EQ(refused([&] { (void)reader.integers(reader.require("single")); }),
            "variable \"single\" is not of integers");
  EXPECT_EQ(refused([&] { (void)reader.integers(reader.require("beyond")); }),
            "variable \"beyond\" has an integer beyond 2^63");
  for (const bool are_integers : {false, true}) {
    EXPECT_EQ(refused([&] {
                const auto& letters = reader.require("letters");
                if (are_integers) {
                  (void)reader.integers(letters);
                } else {
                  (void)reader.numbers(letters);
                }
              }),
              "variable \"letters\" is a text where numbers are needed");
  }
  io::VariableInFile large = reader.require("v");
  large.num_values = (bytes_.size() << 20U) + 1;
  EXPECT_NE(refused([&] { reader.require_room(large); }), "");
  --large.num_values;
  EXPECT_EQ(refused([&] { reader.require_room(large); }), "");
}

TEST_F(netcdf4, is_read_from_any_value_on_and_box_by_box) {
  const NetcdfReader reader(bytes_);
  const io::VariableInFile& v = reader.require("v");
  for (const std::size_t begin : {0U, 1U, 249U, 250U, 1234U, 74'990U}) {
    for (const std::size_t size : {1U, 2U, 10U, 250U, 1000U}) {
      if (begin + size > values_.size()) continue;
      Doubles found(size);
      reader.read_numbers(v, begin, found);
      EXPECT_TRUE(std::equal(found.begin(), found.end(),
                             values_.begin() + static_cast<std::ptrdiff_t>(begin)));
    }
  }
  for (const std::size_t most : {1U, 100U, 65'000U, 70'000U, 1U << 20U}) {
    const io::NetcdfBox box{{7, 40}, {280, 30}};
    Doubles found(std::size_t{280} * 30);
    io::read_in_order(reader, v, box, std::vector<std::size_t>{1, 0}, found, 1, most);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t row = 7 + i % 280;
      const std::size_t column = 40 + i / 280;
      ASSERT_EQ(found[i], values_[row * num_columns + column]) << most << " " << i;
    }
  }
  Doubles two(2);
  reader.read_box(reader.require("wide"), {{1}, {2}}, two);
  EXPECT_EQ(two, (Doubles{0x1p52, 7}));
  reader.read_box(reader.require("beyond"), {{1}, {2}}, two);
  EXPECT_EQ(two, (Doubles{6, 0x1p63}));
  Integers last(2);
  reader.read_integers(reader.require("wide"), 1, last);
  EXPECT_EQ(last, (Integers{std::int64_t{1} << 52U, 7}));
  bool is_rounded = false;
  EXPECT_EQ(reader.rounded_numbers(reader.require("wide"), is_rounded), (Doubles{-5, 0x1p52, 7}));
  EXPECT_FALSE(is_rounded);
}

// There is nothing to test with an HDF5 that does not say where chunks are.
TEST_F(netcdf4, has_chunks_that_are_read_without_the_library) {
  io::FileBytes on_disk(path_);
  const NetcdfReader reader(on_disk);
  const io::VariableInFile& v = reader.require("v");
  const std::size_t of_chunk = 65536 / num_columns;
  EXPECT_FALSE(NetcdfReader(bytes_).has_chunks(v));
  if (!reader.has_chunks(v)) {
    GTEST_SKIP() << "HDF5 is too old";
  }
  Doubles found(values_.size(), -1);
  const std::vector<std::size_t> steps = {num_columns, 1};
  const auto read = [&](std::size_t start, std::size_t count) {
    return reader.read_chunk(v, {{start, 0}, {count, num_columns}},
                             {found.data() + start * num_columns, steps});
  };
  EXPECT_FALSE(read(1, of_chunk));
  EXPECT_FALSE(read(of_chunk - 1, 2));
  EXPECT_EQ(found, Doubles(values_.size(), -1));
  EXPECT_TRUE(read(of_chunk, num_rows - of_chunk));  // the last one, which goes beyond the rows
  EXPECT_EQ(found[of_chunk * num_columns - 1], -1);
  EXPECT_TRUE(read(0, of_chunk));
  EXPECT_EQ(found, values_);
  // Parts of chunks, which are kept if there is room; also in another order, and twice.
  for (const std::size_t room : {std::size_t{0}, std::size_t{1} << 20U}) {
    reader.keep_chunks(v, room);
    for (const std::size_t step : {std::size_t{1}, std::size_t{7}, of_chunk / 2 + 1}) {
      found.assign(values_.size(), -1);
      for (const bool is_second : {false, true}) {
        for (std::size_t start = 0; start < num_rows; start += step) {
          const std::size_t end = std::min(start + step, num_rows);
          if (start / of_chunk != (end - 1) / of_chunk) {
            const std::size_t middle = end - end % of_chunk;
            EXPECT_TRUE(read(middle, end - middle) && read(start, middle - start));
          } else {
            EXPECT_TRUE(read(start, end - start)) << is_second;
          }
        }
        EXPECT_EQ(found, values_) << room << ' ' << step;
      }
    }
  }
  for (const unsigned threads : {1U, 2U, 5U}) {
    Doubles run(values_.size() - 7);
    io::read_run(reader, v, 7, run, threads);
    EXPECT_TRUE(std::equal(run.begin(), run.end(), values_.begin() + 7));
  }
  // Columns first: a chunk goes to places that are a column apart.
  Doubles turned(values_.size());
  io::read_in_order(reader, v, {{0, 0}, {num_rows, num_columns}}, std::vector<std::size_t>{1, 0},
                    turned, 2);
  for (std::size_t i = 0; i < turned.size(); ++i) {
    ASSERT_EQ(turned[i], values_[i % num_rows * num_columns + i / num_rows]) << i;
  }
}

}  // namespace
}  // namespace rondel::test::of_netcdf4_files
