// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Headers and values of netCDF's classic formats, in files that the test writes byte by byte.
#include "io/netcdf_header.h"

#include <cstdint>
#include <limits>
#include <numeric>

#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf4_file.h"
#include "io/netcdf_reader.h"
#include "support/thrown.h"
#include "unit/io/classic_file.h"
#include "unit/io/support.h"

namespace rondel::test::of_headers {
namespace {

using io::NetcdfReader;
using io::NetcdfType;
using Doubles = std::vector<double>;
using Shape = std::vector<std::uint64_t>;

constexpr NetcdfType old_types[] = {NetcdfType::int8, NetcdfType::int16, NetcdfType::int32,
                                    NetcdfType::float32, NetcdfType::float64};
constexpr NetcdfType new_types[] = {NetcdfType::uint8, NetcdfType::uint16, NetcdfType::uint32,
                                    NetcdfType::int64, NetcdfType::uint64};

bool is_unsigned(NetcdfType type) {
  return type == NetcdfType::uint8 || type == NetcdfType::uint16 || type == NetcdfType::uint32 ||
         type == NetcdfType::uint64;
}

Doubles some_numbers(NetcdfType type, std::size_t size) {
  Doubles numbers;
  for (std::size_t i = 0; i < size; ++i) {
    numbers.push_back(is_unsigned(type) ? static_cast<double>(200 + i)
                                        : static_cast<double>(i) * 3 - 20);
  }
  return numbers;
}

// The types that the format has.
std::vector<NetcdfType> types_of(int version) {
  std::vector<NetcdfType> types(std::begin(old_types), std::end(old_types));
  if (version == 5) types.insert(types.end(), std::begin(new_types), std::end(new_types));
  return types;
}

// A file with variables of all types, fixed ones and ones of records.
ClassicFile all_types(int version, std::uint64_t num_records) {
  ClassicFile file;
  file.version = version;
  file.num_records = num_records;
  file.dimensions = {{"x", 3}, {"time", 0}, {"yy", 2}};
  file.attributes = {{"title", NetcdfType::text, "five!", {}}, {"empty", NetcdfType::text, "", {}}};
  for (const NetcdfType type : types_of(version)) {
    const std::string name = "v" + std::to_string(static_cast<int>(type));
    ClassicVariable fixed = classic_variable(name, type, {0, 2}, some_numbers(type, 6));
    fixed.attributes.push_back({"numbers", type, {}, some_numbers(type, 3)});
    fixed.attributes.push_back({"units", NetcdfType::text, "K", {}});
    file.variables.push_back(fixed);
    file.variables.push_back(
        classic_variable("r" + name, type, {1, 0}, some_numbers(type, 3 * num_records)));
  }
  file.variables.push_back(classic_variable("letters", NetcdfType::text, {0}, {65, 66, 67}));
  return file;
}

std::string refusal_of(std::string_view bytes) {
  return thrown_message<io::BadValue>([&] { const NetcdfReader reader(bytes); });
}

TEST(netcdf_header, has_what_was_written) {
  for (const int version : {1, 2, 5}) {
    const ClassicFile file = all_types(version, 4);
    const std::string bytes = file.bytes();
    const io::NetcdfHeader header = io::parse_netcdf_header(bytes);
    EXPECT_EQ(header.version, version);
    EXPECT_EQ(header.num_records, 4U);
    EXPECT_TRUE(header.counts_records);
    ASSERT_EQ(header.dimensions.size(), 3U);
    EXPECT_EQ(header.dimensions[2].name, "yy");
    EXPECT_EQ(header.dimensions[0].size, 3U);
    EXPECT_EQ(header.dimensions[1].size, 0U);
    ASSERT_EQ(header.attributes.size(), 2U);
    EXPECT_EQ(header.attributes[0].name, "title");
    EXPECT_EQ(header.attributes[0].text, "five!");
    EXPECT_EQ(header.attributes[1].text, "");
    ASSERT_EQ(header.variables.size(), file.variables.size());
    for (std::size_t v = 0; v < header.variables.size(); ++v) {
      EXPECT_EQ(header.variables[v].name, file.variables[v].name);
      EXPECT_EQ(header.variables[v].type, file.variables[v].type);
      EXPECT_EQ(header.variables[v].dimensions, file.variables[v].dimensions);
      const auto& attributes = header.variables[v].attributes;
      ASSERT_EQ(attributes.size(), file.variables[v].attributes.size());
      for (std::size_t a = 0; a < attributes.size(); ++a) {
        const io::NetcdfAttribute& expected = file.variables[v].attributes[a];
        EXPECT_EQ(attributes[a].name, expected.name);
        EXPECT_EQ(attributes[a].type, expected.type);
        EXPECT_EQ(attributes[a].text, expected.text);
        EXPECT_EQ(attributes[a].numbers, expected.numbers);
        const bool is_wide =
            expected.type == NetcdfType::int64 || expected.type == NetcdfType::uint64;
        const auto& integers = attributes[a].integers;
        EXPECT_EQ(Doubles(integers.begin(), integers.end()),
                  is_wide ? expected.numbers : Doubles());
      }
    }
  }
}

TEST(netcdf_header, of_texts_ends_at_a_zero) {
  ClassicFile file;
  file.attributes = {{"a", NetcdfType::text, std::string("ab\0cd", 5), {}},
                     {"b", NetcdfType::text, std::string("\0", 1), {}}};
  const std::string bytes = file.bytes();
  const io::NetcdfHeader header = io::parse_netcdf_header(bytes);
  EXPECT_EQ(header.attributes[0].text, "ab");
  EXPECT_EQ(header.attributes[1].text, "");
}

TEST(netcdf_header, is_refused_with_what_is_wrong) {
  EXPECT_EQ(refusal_of("CDG\1"), "not a netCDF file");
  for (const char version : {'\0', '\3', '\4', '\6', '\xFF'}) {
    EXPECT_EQ(refusal_of("CDF" + std::string(1, version) + std::string(40, '\0')),
              "not one of netCDF's classic formats (CDF-1, CDF-2, CDF-5)");
  }
  for (const int version : {1, 2, 5}) {
    ClassicFile file;
    file.version = version;
    file.dimensions = {{"x", 2}, {"time", 0}};
    file.variables = {classic_variable("v", NetcdfType::int8, {2}, {})};
    EXPECT_EQ(refusal_of(file.bytes()), "variable \"v\" has a dimension 2 of 2");
    file.variables = {classic_variable("v", NetcdfType::int8, {0, 1}, {})};
    EXPECT_EQ(refusal_of(file.bytes()),
              "variable \"v\" has the dimension of records not as its first one");
    file.variables = {classic_variable("v", static_cast<NetcdfType>(12), {0}, {})};
    EXPECT_EQ(refusal_of(file.bytes()), "the header has a type 12");
    file.variables = {classic_variable("v", static_cast<NetcdfType>(0), {0}, {})};
    EXPECT_EQ(refusal_of(file.bytes()), "the header has a type 0");
    file.variables = {classic_variable("v", NetcdfType::uint64, {0}, {1, 2})};
    EXPECT_EQ(refusal_of(file.bytes()), "");
    file.dimensions[0].size = 3;
    const std::string bytes = file.bytes();
    EXPECT_EQ(refusal_of(bytes), "variable \"v\" ends at byte " + std::to_string(bytes.size() + 8) +
                                     ", the file at " + std::to_string(bytes.size()));
    // Every beginning of a header is cut off, or counts more than it has.
    file.dimensions[0].size = 2;
    const std::string whole = file.bytes();
    for (std::size_t size = 4; size < whole.size(); ++size) {
      EXPECT_NE(refusal_of(whole.substr(0, size)), "") << size;
    }
  }
  // A list with another tag, and one without a tag that has members.
  ClassicFile file;
  file.dimensions = {{"x", 2}};
  std::string bytes = file.bytes();
  EXPECT_EQ(refusal_of(bytes), "");
  bytes[11] = 11;
  EXPECT_EQ(refusal_of(bytes), "the header is damaged");
  bytes[11] = 0;
  EXPECT_EQ(refusal_of(bytes), "the header is damaged");
}

TEST(netcdf_reader, has_every_number_wherever_reading_begins) {
  for (const int version : {1, 2, 5}) {
    for (const std::uint64_t num_records : {1U, 4U}) {
      const ClassicFile file = all_types(version, num_records);
      const std::string bytes = file.bytes();
      const TemporaryDirectory directory;
      io::FileBytes on_disk(directory.with("a.nc", bytes));
      for (const NetcdfReader& reader : {NetcdfReader(bytes), NetcdfReader(on_disk)}) {
        EXPECT_EQ(reader.dimensions()[1].size, num_records);
        EXPECT_EQ(reader.max_values(), bytes.size());
        for (const ClassicVariable& expected : file.variables) {
          const io::VariableInFile& variable = reader.require(expected.name);
          EXPECT_EQ(variable.num_values, expected.values.size());
          EXPECT_EQ(reader.chunk_of(variable), Shape(variable.shape.size(), 1));
          if (variable.type == NetcdfType::text) {
            EXPECT_THROW((void)reader.numbers(variable), io::BadValue);
            EXPECT_THROW((void)reader.integers(variable), io::BadValue);
            continue;
          }
          EXPECT_EQ(variable.has_records, expected.name[0] == 'r');
          EXPECT_EQ(variable.shape,
                    expected.name[0] == 'r' ? (Shape{num_records, 3}) : (Shape{3, 2}));
          EXPECT_EQ(reader.numbers(variable), expected.values);
          for (std::size_t begin = 0; begin < expected.values.size(); ++begin) {
            for (std::size_t size = 0; begin + size <= expected.values.size(); ++size) {
              Doubles found(size);
              reader.read_numbers(variable, begin, found);
              EXPECT_TRUE(std::equal(found.begin(), found.end(),
                                     expected.values.begin() + static_cast<std::ptrdiff_t>(begin)));
            }
          }
          if (variable.type == NetcdfType::float32 || variable.type == NetcdfType::float64) {
            EXPECT_THROW((void)reader.integers(variable), io::BadValue);
          } else {
            const auto integers = reader.integers(variable);
            EXPECT_EQ(Doubles(integers.begin(), integers.end()), expected.values);
          }
        }
      }
    }
  }
}

// A single variable of records is not padded; other files are.
TEST(netcdf_reader, counts_whole_records_if_the_header_does_not) {
  for (const int version : {1, 2, 5}) {
    for (const std::size_t num_variables : {1U, 2U, 3U}) {
      ClassicFile file;
      file.version = version;
      file.num_records = 5;
      file.counts_records = false;
      file.dimensions = {{"time", 0}, {"x", 3}};
      for (std::size_t v = 0; v < num_variables; ++v) {
        file.variables.push_back(classic_variable("v" + std::to_string(v), NetcdfType::int8, {0, 1},
                                                  some_numbers(NetcdfType::int8, 15)));
      }
      std::string bytes = file.bytes();
      EXPECT_FALSE(io::parse_netcdf_header(bytes).counts_records);
      const std::size_t record = num_variables == 1 ? 3 : 4 * num_variables;
      for (std::size_t cut = 0; cut <= 2 * record; ++cut) {
        const NetcdfReader reader(std::string_view(bytes).substr(0, bytes.size() - cut));
        const std::size_t whole = 5 - (cut + record - 1) / record;
        for (const io::VariableInFile& variable : reader.variables()) {
          EXPECT_EQ(variable.shape, (Shape{whole, 3})) << cut;
          EXPECT_EQ(reader.numbers(variable), some_numbers(NetcdfType::int8, 3 * whole));
        }
        EXPECT_EQ(reader.dimensions()[0].size, whole);
      }
      // Where the header counts them, all of them are needed, but not the padding behind the last one.
      file.counts_records = true;
      bytes = file.bytes();
      const std::size_t padding = num_variables == 1 ? 0 : 1;
      EXPECT_EQ(refusal_of(bytes.substr(0, bytes.size() - padding)), "");
      EXPECT_EQ(refusal_of(bytes.substr(0, bytes.size() - padding - 1)),
                "variable \"v" + std::to_string(num_variables - 1) + "\" ends at byte " +
                    std::to_string(bytes.size() - padding) + ", the file at " +
                    std::to_string(bytes.size() - padding - 1));
    }
  }
}

TEST(netcdf_reader, without_records_has_no_values_of_them) {
  for (const int version : {1, 2, 5}) {
    const std::string bytes = all_types(version, 0).bytes();
    const NetcdfReader reader(bytes);
    EXPECT_EQ(reader.require("rv3").shape, (Shape{0, 3}));
    EXPECT_EQ(reader.require("rv3").num_values, 0U);
    EXPECT_TRUE(reader.numbers(reader.require("rv3")).empty());
  }
}

// The header is longer than what is read of a file at first.
TEST(netcdf_reader, reads_a_long_header_from_the_disk) {
  const TemporaryDirectory directory;
  for (const std::size_t size : {100'000U, 140'000U, 3'000'000U}) {
    ClassicFile file;
    file.dimensions = {{"x", 3}};
    file.attributes = {{"long", NetcdfType::text, std::string(size, 'a'), {}}};
    file.variables = {classic_variable("v", NetcdfType::int16, {0}, {7, -8, 9})};
    const std::string bytes = file.bytes();
    io::FileBytes on_disk(directory.with("a.nc", bytes));
    const NetcdfReader reader(on_disk);
    EXPECT_EQ(reader.attributes()[0].text.size(), size);
    EXPECT_EQ(reader.numbers(reader.require("v")), (Doubles{7, -8, 9}));
    // The file, and not only its head, is cut off.
    io::FileBytes cut(directory.with("b.nc", bytes.substr(0, bytes.size() - 40)));
    EXPECT_THROW(NetcdfReader{cut}, io::BadValue);
  }
}

TEST(netcdf_reader, finds_variables_and_attributes_by_name) {
  const std::string bytes = all_types(1, 1).bytes();
  const NetcdfReader reader(bytes);
  EXPECT_EQ(reader.find("v3"), &reader.require("v3"));
  EXPECT_EQ(reader.find("v"), nullptr);
  EXPECT_THROW((void)reader.require("v"), io::BadValue);
  const auto& attributes = reader.require("v3").attributes;
  EXPECT_EQ(io::netcdf_text(attributes, "units"), "K");
  EXPECT_EQ(io::netcdf_text(attributes, "numbers"), "");
  EXPECT_EQ(io::netcdf_text(attributes, "none"), "");
  EXPECT_EQ(io::find_attribute(attributes, "none"), nullptr);
  EXPECT_EQ(io::find_attribute(attributes, "units"), &attributes[1]);
}

TEST(netcdf_reader, tells_of_integers_that_are_rounded) {
  for (const NetcdfType type : {NetcdfType::int64, NetcdfType::uint64}) {
    for (const std::size_t odd : {0U, 1U, 2U, 3U}) {  // 3: none of the three
      ClassicFile file;
      file.version = 5;
      file.dimensions = {{"x", 3}};
      file.variables = {classic_variable("v", type, {0}, {0x1p62, 0x1p61, 0x1p60})};
      std::string bytes = file.bytes();
      if (odd < 3) bytes[bytes.size() - 8 * (2 - odd) - 1] = 1;
      const NetcdfReader reader(bytes);
      bool is_rounded = false;
      EXPECT_EQ(reader.rounded_numbers(reader.require("v"), is_rounded),
                (Doubles{0x1p62, 0x1p61, 0x1p60}));
      EXPECT_EQ(is_rounded, odd < 3);
      is_rounded = true;
      static_cast<void>(reader.rounded_numbers(reader.require("v"), is_rounded));
      EXPECT_TRUE(is_rounded);
      if (odd == 3) continue;
      EXPECT_THROW((void)reader.numbers(reader.require("v")), io::BadValue);
    }
  }
}

TEST(netcdf_reader, has_the_lengths_of_grids_from_the_slowest_on) {
  const auto shape = [](const Doubles& lengths, std::uint64_t size) {
    ClassicFile file;
    file.dimensions = {{"rank", lengths.size()}};
    file.variables = {classic_variable("grid_dims", NetcdfType::int32, {0}, lengths)};
    const std::string bytes = file.bytes();
    const NetcdfReader reader(bytes);
    return io::shape_of_grid(reader, reader.require("grid_dims"), size);
  };
  EXPECT_EQ(shape({4, 3}, 12), (Shape{3, 4}));
  EXPECT_EQ(shape({1, 5, 2}, 10), (Shape{2, 5, 1}));
  EXPECT_EQ(shape({12}, 12), Shape{});
  EXPECT_EQ(shape({0}, 12), Shape{});
  EXPECT_EQ(shape({1}, 12), Shape{});
  EXPECT_THROW((void)shape({11}, 12), io::BadValue);
  EXPECT_THROW((void)shape({4, 3}, 11), io::BadValue);
  EXPECT_THROW((void)shape({0, 3}, 3), io::BadValue);
  EXPECT_THROW((void)shape({-4, -3}, 12), io::BadValue);
  EXPECT_THROW((void)shape({65536, 65536, 65536, 65536, 2}, 0x1'0000'0000), io::BadValue);
}

TEST(netcdf_reader, knows_hdf5_at_powers_of_2) {
  const std::string signature = "\x89HDF\r\n\x1a\n";
  EXPECT_TRUE(io::is_hdf5(signature));
  for (std::size_t at = 1; at <= 5000; ++at) {
    const bool is_there = at == 512 || at == 1024 || at == 2048 || at == 4096;
    EXPECT_EQ(io::is_hdf5(std::string(at, ' ') + signature), is_there) << at;
  }
  EXPECT_FALSE(io::is_hdf5(std::string(512, ' ') + signature.substr(0, 7)));
}

TEST(netcdf_format, sizes_of_types_and_padding) {
  const std::size_t sizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8, 0, 0};
  for (std::uint32_t type = 0; type < 14; ++type) {
    EXPECT_EQ(io::size_of(static_cast<NetcdfType>(type)), sizes[type]) << type;
  }
  const std::uint64_t padded[] = {0, 4, 4, 4, 4, 8, 8, 8, 8, 12};
  for (std::uint64_t size = 0; size < 10; ++size) {
    EXPECT_EQ(io::netcdf_padded(size), padded[size]);
  }
}

}  // namespace
}  // namespace rondel::test::of_headers
