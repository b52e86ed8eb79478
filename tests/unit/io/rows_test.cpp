// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays of sites that are read a part at a time. The test writes them itself, after NumPy's NEP 1.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/npy_rows.h"
#include "rondel/delaunay.h"
#include "support/random.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

struct Layout {
  std::endian order = std::endian::little;
  bool is_by_columns = false;
};

template <class Number>
std::string type_name(std::endian order) {
  const char* const start = sizeof(Number) == 1 ? "|" : order == std::endian::big ? ">" : "<";
  const char* const kind = std::is_floating_point_v<Number> ? "f"
                           : std::is_signed_v<Number>       ? "i"
                                                            : "u";
  return start + std::string(kind) + std::to_string(sizeof(Number));
}

template <class Number>
std::string bytes_of(Number value, std::endian order) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  return order == std::endian::native ? bytes : std::string(bytes.rbegin(), bytes.rend());
}

// The path of a file with rows of numbers.
template <class Number>
std::string file_of(const std::vector<std::vector<Number>>& rows, const Layout& layout) {
  const std::size_t num_columns = rows.at(0).size();
  std::string dictionary = "{'descr': '" + type_name<Number>(layout.order) +
                           "', 'fortran_order': " + (layout.is_by_columns ? "True" : "False") +
                           ", 'shape': (" + std::to_string(rows.size()) + ", " +
                           std::to_string(num_columns) + "), }";
  dictionary.append(117 - dictionary.size(), ' ');
  std::string bytes = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + dictionary + "\n";
  if (layout.is_by_columns) {
    for (std::size_t c = 0; c < num_columns; ++c) {
      for (const auto& row : rows) bytes += bytes_of(row[c], layout.order);
    }
  } else {
    for (const auto& row : rows) {
      for (const Number x : row) bytes += bytes_of(x, layout.order);
    }
  }
  static const TemporaryDirectory directory;
  return directory.with("rows.npy", bytes);
}

// Numbers of a type that no two places share, among them its ends.
template <class Number>
std::vector<std::vector<Number>> random_rows(std::size_t count, std::size_t num_columns,
                                             double most) {
  Random random(count + num_columns);
  std::vector<std::vector<Number>> rows(count, std::vector<Number>(num_columns));
  for (auto& row : rows) {
    for (Number& x : row) {
      const double value = most * (std::is_signed_v<Number> ? random.signed_unit() : random.unit());
      x = static_cast<Number>(value);
    }
  }
  return rows;
}

template <class Number>
void expect_points(const Layout& layout) {
  const auto rows = random_rows<Number>(7, 3, 100);
  const std::string path = file_of(rows, layout);
  const io::NpyRows file(path, false);
  EXPECT_EQ(file.num_rows(), 7U);
  EXPECT_EQ(file.num_bytes(), 128 + 21 * sizeof(Number));
  EXPECT_EQ(file.name(), path);
  EXPECT_FALSE(file.are_positions());
  for (std::size_t first = 0; first < 7; ++first) {
    std::vector<Point> sites(7 - first);
    file.read(first, sites, 2);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const auto& row = rows[first + i];
      EXPECT_EQ(sites[i], (Point{static_cast<double>(row[0]), static_cast<double>(row[1]),
                                 static_cast<double>(row[2])}));
    }
  }
}

template <class Number>
void expect_positions(const Layout& layout, bool are_radians) {
  const auto rows = random_rows<Number>(5, 2, are_radians ? 1.5 : 89);
  const io::NpyRows file(file_of(rows, layout), are_radians);
  EXPECT_TRUE(file.are_positions());
  EXPECT_EQ(file.are_radians(), are_radians);
  std::vector<Point> sites(3);
  std::vector<LonLat> positions(3);
  file.read(1, sites, 1, positions);
  std::vector<Point> alone(3);
  file.read(1, alone, 1);
  EXPECT_EQ(alone, sites);
  const double unit = are_radians ? 180 / std::numbers::pi : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(positions[i].lon_deg, unit * static_cast<double>(rows[i + 1][0]), 1e-13);
    EXPECT_NEAR(positions[i].lat_deg, unit * static_cast<double>(rows[i + 1][1]), 1e-13);
    EXPECT_EQ(sites[i], unit_vector(positions[i]));
  }
}

template <class Number>
void expect_all() {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const bool is_by_columns : {false, true}) {
      expect_points<Number>({order, is_by_columns});
      expect_positions<Number>({order, is_by_columns}, false);
      expect_positions<Number>({order, is_by_columns}, true);
    }
  }
}

TEST(npy_rows, are_those_of_the_array_whatever_its_type_and_layout) {
  expect_all<double>();
  expect_all<float>();
  expect_all<std::int8_t>();
  expect_all<std::int16_t>();
  expect_all<std::int32_t>();
  expect_all<std::int64_t>();
  expect_all<std::uint8_t>();
  expect_all<std::uint16_t>();
  expect_all<std::uint32_t>();
  expect_all<std::uint64_t>();
}

// The message for the rows from `first` on, by so many threads; empty if there is none.
std::string message_of_rows(const io::NpyRows& file, std::size_t first, std::size_t count,
                            unsigned threads) {
  return message_of([&] {
    std::vector<Point> sites(count);
    file.read(first, sites, threads);
  });
}

TEST(npy_rows, are_refused_by_the_first_that_is_no_site) {
  const std::size_t count = 200'000;  // of several pieces
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (const std::size_t column : {0U, 1U, 2U}) {
      std::vector<std::vector<double>> rows(count, {1, 2, 3});
      rows[150'000][column] = bad;
      rows[99'999][column] = bad;
      const std::string path = file_of(rows, {});
      const io::NpyRows file(path, false);
      for (const unsigned threads : {1U, 2U}) {
        const std::string message = message_of_rows(file, 0, count, threads);
        EXPECT_TRUE(message.starts_with(path + ": row 99999: ")) << message;
      }
      EXPECT_TRUE(message_of_rows(file, 100'000, 50'001, 1).starts_with(path + ": row 150000: "));
      EXPECT_EQ(message_of_rows(file, 100'000, 50'000, 1), "");
      EXPECT_EQ(message_of_rows(file, 0, 99'999, 2), "");
    }
  }
}

TEST(npy_rows, that_are_no_positions_or_no_doubles_are_refused) {
  const std::string beyond = file_of<double>({{10, 20}, {10, 90.5}}, {});
  EXPECT_TRUE(message_of_rows(io::NpyRows(beyond, false), 0, 2, 1).starts_with(beyond + ": row 1"));
  const std::string odd = file_of<std::uint64_t>({{1, 2, 3}, {(1ULL << 60U) + 1, 0, 0}}, {});
  const io::NpyRows file(odd, false);
  EXPECT_EQ(message_of_rows(file, 0, 1, 1), "");
  EXPECT_TRUE(message_of_rows(file, 0, 2, 1).starts_with(odd + ": row 1"));
}

TEST(npy_rows, have_numbers_instead_of_lines) {
  for (const std::size_t num_columns : {2U, 3U}) {
    const std::string path = file_of(random_rows<float>(9, num_columns, 80), {});
    const SiteTable table = read_sites(path);
    EXPECT_EQ(table.first_line, 0U);
    EXPECT_TRUE(table.lines.empty());
    EXPECT_EQ(table.where(0), path + ": row 0");
    EXPECT_EQ(table.where(8), path + ": row 8");
  }
}

TEST(npy_rows, of_a_file_that_is_cut_meanwhile_are_told) {
  const std::vector<std::vector<double>> rows(100, {1, 2, 3});
  const std::string path = file_of(rows, {});
  const io::NpyRows file(path, false);
  std::filesystem::resize_file(path, 128 + 24 * 50 + 7);
  EXPECT_EQ(message_of_rows(file, 0, 50, 1), "");
  EXPECT_EQ(message_of_rows(file, 0, 51, 1), path + ": the file was cut while it was read");
}

TEST(npy_rows, are_of_a_file_that_is_there_and_an_array) {
  const TemporaryDirectory directory;
  const auto opened = [](const std::string& path) {
    return message_of([&] { const io::NpyRows rows(path, false); });
  };
  EXPECT_NE(opened(directory.file("none.npy")), "");
  const std::string empty = directory.with("empty.npy", "");
  EXPECT_EQ(opened(empty), empty + ": the file is empty");
  const std::string other = directory.with("other.npy", "x,y,z\n1,2,3\n");
  EXPECT_TRUE(opened(other).starts_with(other + ": ")) << opened(other);
  EXPECT_NE(opened(file_of<double>({{1, 2, 3, 4}}, {})), "");
}

}  // namespace
}  // namespace rondel::test
