// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Runs out of core in a directory of their own, and what they must write.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "distributed/out_of_core.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/io.h"
#include "support/generators.h"
#include "unit/io/support.h"

namespace rondel::test {

// The rows of numbers in a .npy file of uint32 or int64, as 64 bits, less `first_number`.
struct NumberRows {
  std::string header;
  std::vector<std::uint64_t> numbers;
};

inline NumberRows rows_of(const std::string& path, std::uint64_t first_number = 0) {
  const std::string bytes = read_all(path);
  const std::size_t end = bytes.find('\n') + 1;
  NumberRows rows = {bytes.substr(0, end), {}};
  const bool is_wide = rows.header.find("<i8") != std::string::npos;
  const std::size_t size = is_wide ? 8 : 4;
  for (std::size_t i = end; i + size <= bytes.size(); i += size) {
    std::uint64_t number = 0;
    std::memcpy(&number, &bytes[i], size);
    rows.numbers.push_back(number - first_number);
  }
  return rows;
}

inline std::vector<double> areas_in(const std::string& path) {
  const std::string bytes = read_all(path);
  const std::size_t end = bytes.find('\n') + 1;
  std::vector<double> areas((bytes.size() - end) / sizeof(double));
  if (!areas.empty()) std::memcpy(areas.data(), &bytes[end], areas.size() * sizeof(double));
  return areas;
}

template <class Row>
std::vector<std::uint64_t> numbers_of(std::span<const Row> rows) {
  constexpr std::size_t width = sizeof(std::array<Row, 1>) / sizeof(Index);
  std::vector<std::uint64_t> numbers;
  for (const Row& row : rows) {
    for (const Index i : std::bit_cast<std::array<Index, width>>(row)) numbers.push_back(i);
  }
  return numbers;
}

// Sites in a file, their triangulation in memory, and runs that must find the same.
class FileCase {
 public:
  FileCase(std::vector<Point> sites, const Options& options)
      : sites_(std::move(sites)), options_(options), expected_(delaunay(sites_, options)) {
    write_sites(folder_.file("sites.npy"), sites_);
  }

  [[nodiscard]] const TemporaryDirectory& folder() const { return folder_; }
  [[nodiscard]] const Triangulation& expected() const { return expected_; }
  [[nodiscard]] OutOfCoreFiles files() const {
    return {folder_.file("faces.npy"), folder_.file("neighbors.npy"), folder_.file("areas.npy"),
            folder_.file("duplicates.npy"), folder_.file("ghost_faces.npy")};
  }

  // NOLINTNEXTLINE(modernize-use-nodiscard): it writes files
  OutOfCoreReport run(const distributed::RunLimits& limits, bool resume = false,
                      const Execution& execution = {.threads = 1}) const {
    const io::NpyRows rows(folder_.file("sites.npy"), false);
    OutOfCoreOptions out_of_core;
    out_of_core.scratch = folder_.file("scratch");
    out_of_core.resume = resume;
    return distributed::run(rows, files(), out_of_core, limits, {options_, execution});
  }

  void compare(const OutOfCoreReport& report, std::uint64_t first_number = 0) const {
    const Triangulation& t = expected_;
    EXPECT_TRUE(rows_of(files().faces, first_number).numbers == numbers_of(t.faces()));
    EXPECT_TRUE(rows_of(files().neighbors, first_number).numbers == numbers_of(t.neighbors()));
    EXPECT_TRUE(rows_of(files().duplicates, first_number).numbers == numbers_of(t.duplicates()));
    EXPECT_TRUE(rows_of(files().ghost_faces, first_number).numbers == numbers_of(t.ghost_faces()));
    EXPECT_TRUE(areas_in(files().areas) == areas(t));
    EXPECT_EQ(report.num_sites, t.num_sites());
    EXPECT_EQ(report.num_vertices, t.num_vertices());
    EXPECT_EQ(report.num_faces, t.num_faces());
    EXPECT_EQ(report.num_ghost_faces, t.num_ghost_faces());
    EXPECT_EQ(report.num_duplicates, t.duplicates().size());
    EXPECT_EQ(report.num_hidden, t.hidden().size());
    EXPECT_EQ(report.dimension, t.dimension());
    EXPECT_FALSE(std::filesystem::exists(folder_.file("scratch")));
  }

 private:
  TemporaryDirectory folder_;
  std::vector<Point> sites_;
  Options options_;
  Triangulation expected_;
};

}  // namespace rondel::test
