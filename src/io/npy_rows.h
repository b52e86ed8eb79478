// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the sites of an array, all at once or some at a time.
//
// in    a .npy file of longitudes and latitudes (n, 2) or of points (n, 3), and for circles a
//       radius
// out   sites as points
// index rows of the array
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/npy_header.h"
#include "io/site_collector.h"
#include "rondel/export.h"

namespace rondel::io {

// Returns the array in the bytes of a file, or of its head. Throws BadValue unless it is an array
// of sites.
NpyTable site_table(std::string_view bytes, std::uint64_t file_size);

// Adds all rows. Throws BadValue for the first invalid row, counting from `first_row`.
void add_rows(const NpyTable& array, std::uint64_t first_row, SiteCollector& collector);

// A file of sites that is never in memory as a whole. Every function throws FileError if reading
// fails.
class RONDEL_API NpyRows {
 public:
  NpyRows(const std::string& path, bool are_radians);
  ~NpyRows();
  NpyRows(const NpyRows&) = delete;
  NpyRows& operator=(const NpyRows&) = delete;

  [[nodiscard]] std::uint64_t num_rows() const { return table_.num_rows(); }
  [[nodiscard]] std::uint64_t num_bytes() const { return file_size_; }
  [[nodiscard]] bool are_radians() const { return options_.radians; }
  [[nodiscard]] const std::string& name() const { return path_; }

  // True if rows are longitudes and latitudes, false if they are points.
  [[nodiscard]] bool are_positions() const { return table_.num_columns() == 2; }

  // Reads the rows from `first` on, by several threads, and checks that they are finite. If rows
  // are longitudes and latitudes, also returns these in degrees, unless `positions` is empty.
  void read(std::uint64_t first, std::span<Point> sites, unsigned threads,
            std::span<LonLat> positions = {}) const;

 private:
  void read_bytes(std::uint64_t place, std::span<char> bytes) const;
  void read_some(std::uint64_t first, std::span<Point> sites, std::span<LonLat> positions) const;
  [[nodiscard]] std::string rows(std::uint64_t first, std::size_t count) const;
  [[noreturn]] void fail(int error) const;

  std::string path_;
  ReadJob options_;
  int descriptor_ = -1;
  std::uint64_t file_size_ = 0;
  std::string head_;
  NpyTable table_;
};

}  // namespace rondel::io
