// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// netCDF's classic formats: files that netCDF-C made (tests/corpus/io/netcdf), what is written
// against bytes that follow from the format's description, and damaged files.
#include <cstdint>
#include <numeric>
#include <random>

#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_slabs.h"
#include "io/netcdf_writer.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

using namespace std::literals;
using io::NetcdfReader;
using io::NetcdfType;
using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;

std::string bytes_of(const std::string& name) { return read_all(corpus / "netcdf" / name); }

// What is said of bytes that are refused; empty if they are read with all values.
std::string refusal(std::string_view bytes) {
  return thrown_message<io::BadValue>([&] {
    const NetcdfReader reader(bytes);
    for (const io::VariableInFile& variable : reader.variables()) {
      if (variable.type != NetcdfType::text) static_cast<void>(reader.numbers(variable));
    }
  });
}

Doubles numbers(const NetcdfReader& reader, std::string_view name) {
  return reader.numbers(reader.require(name));
}

TEST(netcdf_reader, reads_what_netcdf_c_wrote_in_all_formats) {
  for (const char* const name : {"cdf1.nc", "cdf2.nc", "cdf5.nc"}) {
    SCOPED_TRACE(name);
    const std::string bytes = bytes_of(name);
    const NetcdfReader reader(bytes);
    EXPECT_EQ(numbers(reader, "lon"), (Doubles{-12.5, 0.1, 179}));
    EXPECT_EQ(numbers(reader, "flag"), (Doubles{-1, 0, 127}));
    EXPECT_EQ(numbers(reader, "height"), (Doubles{-300, 2, 3, 4, 5, 600}));
    EXPECT_EQ(numbers(reader, "depth"), (Doubles{0.5, -0.25}));
    EXPECT_EQ(numbers(reader, "single"), Doubles{1e-300});
    EXPECT_EQ(reader.integers(reader.require("number")),
              (Integers{-2'147'483'647, 7, 2'147'483'647}));
    EXPECT_EQ(reader.require("height").shape, (std::vector<std::uint64_t>{2, 3}));
    EXPECT_EQ(io::netcdf_text(reader.attributes(), "title"), "all types of the first format");
    const auto& lon = reader.require("lon").attributes;
    EXPECT_EQ(io::netcdf_text(lon, "units"), "degrees_east");
    EXPECT_EQ(io::find_attribute(lon, "range")->numbers, (Doubles{-180, 180}));
    EXPECT_EQ(reader.dimensions()[0].size, 2U);
    EXPECT_EQ(reader.find("none"), nullptr);
    EXPECT_THROW(static_cast<void>(reader.require("none")), io::BadValue);
    EXPECT_THROW(static_cast<void>(numbers(reader, "word")), io::BadValue);
    EXPECT_THROW(static_cast<void>(reader.integers(reader.require("lon"))), io::BadValue);
  }
}

TEST(netcdf_reader, reads_the_types_of_cdf5) {
  const std::string bytes = bytes_of("cdf5.nc");
  const NetcdfReader reader(bytes);
  EXPECT_EQ(reader.integers(reader.require("wide")),
            (Integers{-9'007'199'254'740'993, 0, 9'007'199'254'740'993}));
  EXPECT_EQ(numbers(reader, "small"), (Doubles{0, 128, 255}));
  EXPECT_EQ(reader.integers(reader.require("huge")), (Integers{0, 1, INT64_MAX}));
}

// Its records are not padded.
TEST(netcdf_reader, reads_a_single_variable_of_records) {
  const std::string bytes = bytes_of("one_record_variable.nc");
  const NetcdfReader reader(bytes);
  EXPECT_EQ(numbers(reader, "level"), (Doubles{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(netcdf_reader, counts_records_that_the_header_does_not_count) {
  std::string bytes = bytes_of("one_record_variable.nc");
  bytes.replace(4, 4, "\xFF\xFF\xFF\xFF");
  const NetcdfReader reader(bytes);
  EXPECT_EQ(numbers(reader, "level").size(), 9U);
}

TEST(netcdf_reader, says_what_it_does_not_read) {
  EXPECT_EQ(refusal("text"), "not a netCDF file");
  EXPECT_NE(refusal("CDF\3").find("classic"), std::string::npos);
  EXPECT_EQ(refusal("CDF\1"), "the header is cut off");
}

TEST(netcdf_slabs, are_the_run_in_its_order) {
  // Every run of every shape of up to 4 dimensions with lengths of 1 to 3, against the numbers counted one by one.
  std::vector<std::vector<std::uint64_t>> shapes = {{}};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const std::vector<std::uint64_t> shape = shapes[k];
    std::uint64_t total = 1;
    for (const std::uint64_t length : shape) total *= length;
    if (shape.size() < 4) {
      for (const std::uint64_t length : {1U, 2U, 3U}) {
        shapes.push_back(shape);
        shapes.back().push_back(length);
      }
    }
    for (std::uint64_t begin = 0; begin < total; ++begin) {
      for (std::size_t size = 1; begin + size <= total; ++size) {
        std::vector<std::uint64_t> visited;
        std::size_t num_boxes = 0;
        io::for_each_slab(
            shape, begin, size,
            [&](const auto& start, const auto& count, std::size_t offset, std::size_t in_box) {
              ++num_boxes;
              EXPECT_EQ(offset, visited.size());
              for (std::uint64_t i = 0; i < total; ++i) {
                std::uint64_t rest = i;
                bool is_inside = true;
                for (std::size_t d = shape.size(); d-- > 0; rest /= shape[d]) {
                  const std::uint64_t at = rest % shape[d];
                  is_inside = is_inside && at >= start[d] && at < start[d] + count[d];
                }
                if (is_inside) visited.push_back(i);
              }
              EXPECT_EQ(visited.size(), offset + in_box);
            });
        std::vector<std::uint64_t> expected(size);
        std::iota(expected.begin(), expected.end(), begin);
        EXPECT_EQ(visited, expected);
        EXPECT_LE(num_boxes, shape.empty() ? 1 : 2 * shape.size() - 1);
      }
    }
  }
}

TEST(netcdf_reader, knows_files_by_their_first_bytes) {
  EXPECT_TRUE(io::is_netcdf("CDF\1"));
  EXPECT_TRUE(io::is_netcdf("\x89HDF\r\n\x1a\n"));
  EXPECT_TRUE(io::is_netcdf(std::string(1024, ' ') + "\x89HDF\r\n\x1a\n"));
  EXPECT_FALSE(io::is_netcdf(std::string(1000, ' ') + "\x89HDF\r\n\x1a\n"));
  EXPECT_FALSE(io::is_netcdf("lon,lat"));
}

TEST(netcdf_reader, refuses_files_that_are_cut) {
  for (const auto& path : files_in(corpus / "netcdf")) {
    const std::string bytes = read_all(path);
    std::size_t read = 0;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      read += refusal(std::string_view(bytes).substr(0, size)).empty() ? 1U : 0U;
    }
    EXPECT_LE(read, 3U) << path;  // without the padding at the end
  }
}

TEST(netcdf_reader, survives_changed_bytes) {
  std::mt19937_64 random(5);
  std::size_t refused = 0;
  const std::size_t runs_of_byte = is_shortened() ? 5 : 20;
  for (const auto& path : files_in(corpus / "netcdf")) {
    const std::string bytes = read_all(path);
    for (std::size_t run = 0; run < runs_of_byte * bytes.size(); ++run) {
      std::string changed = bytes;
      constexpr std::string_view values = "\0\1\x7F\x80\xFF"sv;
      for (std::size_t n = 1 + random() % 3; n > 0; --n) {
        changed[random() % changed.size()] = values[random() % values.size()];
      }
      if (!refusal(changed).empty()) ++refused;
    }
  }
  EXPECT_GT(refused, 1000U);
}

io::NetcdfVariable variable(std::string name, NetcdfType type,
                            std::vector<std::size_t> dimensions) {
  return {std::move(name), type, std::move(dimensions), {}};
}

TEST(netcdf_writer, writes_the_bytes_of_the_format) {
  const TemporaryDirectory directory;
  io::AtomicFile file(directory.file("out.nc"));
  io::NetcdfWriter writer(file);
  const std::size_t n = writer.add_dimension("n", 3);
  writer.add_attribute("a", "hi");
  writer.add_variable(variable("c", NetcdfType::text, {n}));
  writer.add_variable(variable("x", NetcdfType::int32, {}));
  writer.begin();
  writer.write<char>(std::string("abc"));
  writer.write_values<std::int32_t>(1, [](std::size_t) { return -2; });
  writer.finish();
  file.commit();
  const auto word = [](char value) { return "\0\0\0"s + value; };
  const std::string header = "CDF\1" + word(0) +                                    //
                             word(10) + word(1) + word(1) + "n\0\0\0"s + word(3) +  //
                             word(12) + word(1) + word(1) + "a\0\0\0"s + word(2) +  //
                             word(2) + "hi\0\0"s +                                  //
                             word(11) + word(2) +                                   //
                             word(1) + "c\0\0\0"s + word(1) + word(0) + word(0) +   //
                             word(0) + word(2) + word(4) + word('\x84') +           //
                             word(1) + "x\0\0\0"s + word(0) + word(0) + word(0) +   //
                             word(4) + word(4) + word('\x88');
  EXPECT_EQ(header.size(), 0x84U);
  EXPECT_EQ(read_all(directory.file("out.nc")), header + "abc\0\xFF\xFF\xFF\xFE"s);
}

TEST(netcdf_writer, round_trip_of_all_types) {
  const TemporaryDirectory directory;
  const Doubles values = {1.5, -0.0, 1e300, -1e-300, 0.1};
  const auto whole = [](std::size_t i) { return (std::int64_t{1} << 40) * (int(i) - 2); };
  io::AtomicFile file(directory.file("out.nc"));
  io::NetcdfWriter writer(file);
  const std::size_t n = writer.add_dimension("n", values.size());
  const std::size_t two = writer.add_dimension("two", 2);
  io::NetcdfVariable first = variable("doubles", NetcdfType::float64, {n});
  first.attributes = {{"numbers", NetcdfType::float64, "", {0.1, -2}},
                      {"whole", NetcdfType::int32, "", {-7, 2'147'483'647}}};
  writer.add_variable(first);
  writer.add_variable(variable("wide", NetcdfType::int64, {n}));
  writer.add_variable(variable("floats", NetcdfType::float32, {two, n}));
  writer.add_variable(variable("bytes", NetcdfType::int8, {n}));
  writer.begin();
  writer.write<double>(std::span(values).first(2));  // in pieces
  writer.write<double>(std::span(values).subspan(2));
  writer.write_values<std::int64_t>(values.size(), whole);
  writer.write_values<float>(10, [](std::size_t i) { return float(i) / 4; });
  writer.write_values<std::int8_t>(values.size(), [](std::size_t i) { return int(i) - 3; });
  writer.finish();
  file.commit();
  const std::string bytes = read_all(directory.file("out.nc"));
  EXPECT_EQ(bytes[3], 5);  // the only format with 64-bit integers
  const NetcdfReader reader(bytes);
  EXPECT_EQ(numbers(reader, "doubles"), values);
  EXPECT_EQ(reader.integers(reader.require("wide"))[4], whole(4));
  EXPECT_EQ(numbers(reader, "floats")[9], 2.25);
  EXPECT_EQ(reader.require("floats").shape, (std::vector<std::uint64_t>{2, 5}));
  EXPECT_EQ(numbers(reader, "bytes"), (Doubles{-3, -2, -1, 0, 1}));
  const auto& attributes = reader.require("doubles").attributes;
  EXPECT_EQ(io::find_attribute(attributes, "numbers")->numbers, (Doubles{0.1, -2}));
  EXPECT_EQ(io::find_attribute(attributes, "whole")->numbers, (Doubles{-7, 2'147'483'647}));
}

// The version of the header that begin() writes for a variable of bytes or of doubles along each of these dimensions; no value is
// written. Negative: the version that a refusal names.
int version_for(const std::vector<std::uint64_t>& sizes, NetcdfType type, int asked = 0) {
  const std::string path = temporary_path("versions.nc");
  io::AtomicFile file(path);
  io::NetcdfWriter writer(file);
  for (std::size_t d = 0; d < sizes.size(); ++d) {
    const std::string number = std::to_string(d);
    writer.add_variable(
        variable("v" + number, type, {writer.add_dimension("d" + number, sizes[d])}));
  }
  try {
    writer.begin(asked);
  } catch (const io::BadValue& error) {
    const std::string message = error.what();
    return -(message[message.rfind("CDF-") + 4] - '0');
  }
  file.commit();
  return read_all(path)[3];
}

// The limits of the format: NetCDF Classic and 64-bit Offset File Formats, and CDF-5.
TEST(netcdf_writer, has_the_lowest_version_that_suffices) {
  constexpr std::uint64_t gib = std::uint64_t{1} << 30U;
  const auto version = [](const std::vector<std::uint64_t>& sizes) {
    return version_for(sizes, NetcdfType::int8);
  };
  EXPECT_EQ(version({5}), 1);
  EXPECT_EQ(version({2 * gib - 1}), 1);
  EXPECT_EQ(version({2 * gib}), 5);  // no 31 bits
  // Where the last variable begins, a header behind 2 GiB of values.
  EXPECT_EQ(version({2 * gib - 1, 5}), 2);
  EXPECT_EQ(version({gib, gib - 4096, 5}), 1);
  EXPECT_EQ(version({gib, gib - 8, 5}), 2);
  EXPECT_EQ(version({gib, 5, 2 * gib - 1}), 1);
  const auto version_of_doubles = [](std::uint64_t size) {
    return version_for({size}, NetcdfType::float64);
  };
  EXPECT_EQ(version_of_doubles(gib / 2 - 1), 1);
  EXPECT_EQ(version_of_doubles(gib / 2), 5);  // 4 GiB
  EXPECT_EQ(version_for({5}, NetcdfType::int64), 5);
  EXPECT_EQ(version_for({5}, NetcdfType::uint8), 5);
  EXPECT_EQ(version_for({5}, NetcdfType::float64), 1);
  for (const int asked : {1, 2, 5}) {
    EXPECT_EQ(version_for({5}, NetcdfType::int32, asked), asked);
    EXPECT_EQ(version_for({5}, NetcdfType::int64, asked), asked < 5 ? -5 : 5);
  }
  EXPECT_EQ(version_for({2 * gib - 1, 5}, NetcdfType::int8, 1), -2);
}

}  // namespace
}  // namespace rondel::test
