// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Fields of netCDF files whose dimensions are in any order, read in blocks of any size: each value says where it is.
#include "formats/field_slices.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "io/bad_value.h"
#include "io/netcdf_writer.h"
#include "support/thrown.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

using formats::FieldSlices;
using io::NetcdfType;
using Doubles = std::vector<double>;

constexpr std::array<const char*, 4> dimension_names = {"time", "lev", "lat", "lon"};
constexpr std::array<std::uint64_t, 4> dimension_lengths = {3, 2, 4, 5};
constexpr std::size_t num_points = 20;
constexpr std::size_t num_fields = 6;

// Of a place of time, level, latitude and longitude: its digits.
double value_at(const std::array<std::size_t, 4>& place) {
  double value = 0;
  for (const std::size_t index : place) value = 10 * value + static_cast<double>(index);
  return value;
}

// The values in the order of the dimensions, the last one of which changes fastest.
Doubles values_in(const std::array<std::size_t, 4>& order) {
  Doubles values;
  std::array<std::size_t, 4> place{};
  for (std::size_t i = 0; i < num_points * num_fields; ++i) {
    std::size_t rest = i;
    for (std::size_t w = 4; w-- > 0;) {
      place[order[w]] = rest % dimension_lengths[order[w]];
      rest /= dimension_lengths[order[w]];
    }
    values.push_back(value_at(place));
  }
  return values;
}

// A file with the variable t in this order. False if it cannot be written: netCDF-4 without its library.
bool write_file(const std::string& path, const std::array<std::size_t, 4>& order, NetcdfType type,
                NetcdfKind kind) {
  io::AtomicFile file(path);
  io::NetcdfWriter out(file);
  for (std::size_t d = 0; d < 4; ++d) out.add_dimension(dimension_names[d], dimension_lengths[d]);
  for (const std::size_t d : {std::size_t{2}, std::size_t{3}}) {
    const char* const units = d == 2 ? "degrees_north" : "degrees_east";
    out.add_variable(
        {dimension_names[d], NetcdfType::float64, {d}, {{"units", NetcdfType::text, units, {}}}});
  }
  out.add_variable({"t", type, {order.begin(), order.end()}, {}});
  try {
    out.begin({.kind = kind});
  } catch (const io::BadValue&) {
    return false;
  }
  out.write<double>(Doubles{-60, -20, 20, 60});
  out.write<double>(Doubles{10, 80, 150, 220, 290});
  const Doubles values = values_in(order);
  if (type == NetcdfType::float64) {
    out.write<double>(values);
  } else {
    out.write_values<std::int32_t>(values.size(), [&](std::size_t i) { return values[i]; });
  }
  out.finish();
  file.commit();
  return true;
}

// All fields, `together` at once, in blocks of so many values.
Doubles fields_of(const io::NetcdfReader& file, std::size_t max_per_block, std::size_t together) {
  const std::vector<std::string> names = {"t"};
  const FieldSlices slices(file, {names, num_points, {}, {}}, max_per_block);
  const FieldArray& array = slices.fields().arrays.at(0);
  EXPECT_EQ(array.num_fields(), num_fields);
  Doubles all(num_fields * num_points);
  for (std::size_t first = 0; first < num_fields; first += together) {
    const std::size_t count = std::min(together, num_fields - first);
    slices.read(0, first, std::span(all).subspan(first * num_points, count * num_points), 1);
  }
  return all;
}

TEST(field_slices, have_the_values_of_any_order_of_dimensions_in_blocks_of_any_size) {
  const TemporaryDirectory directory;
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  std::size_t number = 0;
  do {
    // Levels before times are so in the array.
    const bool is_time_first = std::ranges::find(order, 0U) < std::ranges::find(order, 1U);
    const Doubles wanted = values_in(is_time_first ? std::array<std::size_t, 4>{0, 1, 2, 3}
                                                   : std::array<std::size_t, 4>{1, 0, 2, 3});
    const NetcdfType type = number++ % 2 == 0 ? NetcdfType::float64 : NetcdfType::int32;
    for (const NetcdfKind kind : {NetcdfKind::cdf2, NetcdfKind::cdf5, NetcdfKind::netcdf4}) {
      const std::string path = directory.file("t.nc");
      if (!write_file(path, order, type, kind)) continue;
      io::FileBytes bytes(path);
      const io::NetcdfReader file(bytes);
      for (const std::size_t max_per_block : {1U, 45U, 60U, 80U, 1000U}) {
        for (const std::size_t together : {1U, 2U, 5U, 6U}) {
          EXPECT_EQ(fields_of(file, max_per_block, together), wanted)
              << "order " << number << ", blocks of " << max_per_block << ", " << together;
        }
      }
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST(field_slices, are_single_fields_by_their_place_or_name) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("t.nc");
  const std::array<std::size_t, 4> order = {2, 0, 3, 1};
  ASSERT_TRUE(write_file(path, order, NetcdfType::float64, NetcdfKind::cdf2));
  const std::string bytes = read_all(path);
  const io::NetcdfReader file(bytes);
  const auto field = [&](const std::string& name) {
    const FieldSlices slices(file, {std::span(&name, 1), num_points, {}, {}});
    const FieldArray& array = slices.fields().arrays.at(0);
    EXPECT_EQ(array.num_fields(), 1U);
    EXPECT_EQ(array.name, "t_2_1");
    Doubles values(num_points);
    slices.read(0, 0, values, 2);
    return values;
  };
  Doubles wanted;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 5; ++i) wanted.push_back(value_at({2, 1, j, i}));
  }
  for (const char* name : {"t[2,1]", "t[2, 1]", "t[-1,-1]", "t_2_1"})
    EXPECT_EQ(field(name), wanted);
  for (const char* name : {"t[3,0]", "t[-4,0]", "t[0]", "t[0,0,0]", "t[", "t[]", "t[0,0", "t[a,0]",
                           "t[0,0]x", "t[0;0]", "t[99999999999999999999,0]"}) {
    EXPECT_EQ(thrown_message<io::BadValue>([&] { return field(name); }),
              "\"" + std::string(name) +
                  R"(" is no field of variable "t", which has those of time 3, lev 2)")
        << name;
  }
  for (const char* name : {"t_2", "t_2_2", "u[0,0]"}) {
    EXPECT_THROW(static_cast<void>(field(name)), io::BadValue) << name;
  }
}

// Runs along the last dimensions that are short or long, and far from each other or not.
TEST(netcdf_boxes, are_read_in_any_order_and_in_pieces_of_any_size) {
  const TemporaryDirectory directory;
  const std::vector<std::uint64_t> shape = {4, 3, 1500};
  Doubles all(18000);
  std::iota(all.begin(), all.end(), 0.0);
  for (const NetcdfKind kind : {NetcdfKind::cdf2, NetcdfKind::netcdf4}) {
    const std::string path = directory.file("box.nc");
    {
      io::AtomicFile file(path);
      io::NetcdfWriter out(file);
      for (const std::uint64_t length : shape)
        out.add_dimension("d" + std::to_string(length), length);
      out.add_variable({"v", NetcdfType::float64, {0, 1, 2}, {}});
      try {
        out.begin({.kind = kind});
      } catch (const io::BadValue&) {
        continue;
      }
      out.write<double>(all);
      out.finish();
      file.commit();
    }
    io::FileBytes bytes(path);
    const io::NetcdfReader file(bytes);
    const io::VariableInFile& variable = file.require("v");
    const std::vector<io::NetcdfBox> boxes = {{{0, 0, 0}, {4, 3, 1500}}, {{1, 1, 100}, {3, 2, 700}},
                                              {{0, 0, 1499}, {4, 3, 1}}, {{3, 2, 5}, {1, 1, 20}},
                                              {{0, 1, 0}, {4, 1, 1500}}, {{2, 0, 3}, {2, 3, 10}}};
    for (const io::NetcdfBox& box : boxes) {
      std::array<std::size_t, 3> order = {0, 1, 2};
      do {
        Doubles wanted;
        std::array<std::size_t, 3> at{};
        const auto& count = box.count;
        for (at[0] = 0; at[0] < count[order[0]]; ++at[0]) {
          for (at[1] = 0; at[1] < count[order[1]]; ++at[1]) {
            for (at[2] = 0; at[2] < count[order[2]]; ++at[2]) {
              std::array<std::size_t, 3> place{};
              for (std::size_t w = 0; w < 3; ++w) place[order[w]] = box.start[order[w]] + at[w];
              wanted.push_back(all[(place[0] * 3 + place[1]) * 1500 + place[2]]);
            }
          }
        }
        for (const std::size_t most : {std::size_t{7}, io::usual_piece}) {
          Doubles found(wanted.size());
          io::read_in_order(file, variable, box, order, found, 1, most);
          EXPECT_EQ(found, wanted);
        }
      } while (std::ranges::next_permutation(order).found);
    }
  }
}

}  // namespace
}  // namespace rondel::test
