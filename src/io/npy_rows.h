// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of an array, all at once or some at a time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/npy_header.h"
#include "io/site_collector.h"
#include "rondel/export.h"

namespace rondel::io {

// The array in the bytes of a file, or of its head. Throws BadValue unless it is one of sites.
NpyTable site_table(std::string_view bytes, std::uint64_t file_size);

// Adds all rows. Throws BadValue, which counts the rows from `first_row` on.
void add_rows(const NpyTable& array, std::uint64_t first_row, SiteCollector& collector);

// A file of sites that is never in memory as a whole. Every function throws FileError.
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

  // Whether rows are longitudes and latitudes.
  [[nodiscard]] bool are_positions() const { return table_.num_columns() == 2; }

  // Reads the rows `first`, `first` + 1, ..., by several threads. They are numbers that are finite.
  // Of positions also these, in degrees, if there is room for them.
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
