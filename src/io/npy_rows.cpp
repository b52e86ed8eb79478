// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/npy_rows.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <limits>
#include <system_error>

#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/number.h"
#include "rondel/error.h"
#include "system/descriptor.h"
#include "system/parallel.h"

namespace rondel::io {
namespace {

// Adds the rows of an array whose numbers have the type T.
template <typename Number>
void add_rows_of(const NpyTable& array, std::uint64_t first_row, SiteCollector& collector) {
  const bool is_lonlat = array.num_columns() == 2;
  const auto number = [&](std::size_t row, std::size_t column) {
    return exact_double(array.at<Number>(row, column));
  };
  for (std::size_t i = 0; i < array.num_rows(); ++i) {
    at_item("row", first_row + i, [&] {
      if (is_lonlat) {
        collector.add_position(number(i, 0), number(i, 1), 0);
      } else {
        collector.add_point({number(i, 0), number(i, 1), number(i, 2)}, 0);
      }
    });
    collector.report_progress(i, array.num_rows());
  }
}

// The types that are read, and for each the function that adds its rows.
constexpr std::array<std::string_view, 10> number_types = {"f8", "f4", "i1", "i2", "i4",
                                                           "i8", "u1", "u2", "u4", "u8"};
constexpr std::array adders = {
    &add_rows_of<double>,        &add_rows_of<float>,         &add_rows_of<std::int8_t>,
    &add_rows_of<std::int16_t>,  &add_rows_of<std::int32_t>,  &add_rows_of<std::int64_t>,
    &add_rows_of<std::uint8_t>,  &add_rows_of<std::uint16_t>, &add_rows_of<std::uint32_t>,
    &add_rows_of<std::uint64_t>,
};
static_assert(number_types.size() == adders.size());

// True if the rows are stored as points are in memory.
bool are_points(const NpyTable& table) {
  return table.type() == "f8" && table.num_columns() == 3 && table.has_native_rows();
}

// True if all coordinates are finite; the loop has no branches, so that compilers vectorize it.
bool are_finite(std::span<const Point> points) {
  constexpr double largest = std::numeric_limits<double>::max();
  const auto bit = [](double x) { return static_cast<unsigned>(std::abs(x) <= largest); };
  unsigned result = 1;
  for (const Point& p : points) result &= bit(p.x) & bit(p.y) & bit(p.z);
  return result != 0;
}

}  // namespace

NpyTable site_table(std::string_view bytes, std::uint64_t file_size) {
  NpyTable array(bytes, file_size, number_types, "float64, float32 or an integer");
  if (array.num_columns() != 2 && array.num_columns() != 3) {
    throw BadValue("shape " + array.shape() + " where (n, 3) or (n, 2) is needed");
  }
  return array;
}

void add_rows(const NpyTable& array, std::uint64_t first_row, SiteCollector& collector) {
  const auto type = std::ranges::find(number_types, array.type()) - number_types.begin();
  adders[static_cast<std::size_t>(type)](array, first_row, collector);
}

NpyRows::NpyRows(const std::string& path, bool are_radians)
    : path_(path), table_([&] {
        const FileBytes file(path);
        head_ = file.head();
        file_size_ = file.claimed_size();
        if (head_.empty()) throw FileError(path + ": the file is empty");
        if (file_size_ == 0) throw FileError(path + ": not a file that can be read twice");
        return in_file(path, [&] { return site_table(head_, file_size_); });
      }()) {
  options_.radians = are_radians;
  descriptor_ = system::open_to_read(path);
  if (descriptor_ < 0) fail(errno);
}

NpyRows::~NpyRows() { system::close(descriptor_); }

void NpyRows::read(std::uint64_t first, std::span<Point> sites, unsigned threads,
                   std::span<LonLat> positions) const {
  constexpr std::size_t grain = std::size_t{1} << 16;
  const auto read_piece = [&](std::size_t begin, std::size_t end) {
    read_some(first + begin, sites.subspan(begin, end - begin),
              positions.empty() ? positions : positions.subspan(begin, end - begin));
  };
  try {
    system::parallel_for(threads, sites.size(), grain, read_piece);
  } catch (const FileError&) {
    system::parallel_for(1, sites.size(), grain, read_piece);  // throws for the first invalid row
    throw;
  }
}

void NpyRows::read_some(std::uint64_t first, std::span<Point> sites,
                        std::span<LonLat> positions) const {
  if (are_points(table_)) {
    read_bytes(table_.place(first, 0), {reinterpret_cast<char*>(sites.data()), sites.size_bytes()});
    if (are_finite(sites)) return;
  }
  const std::string bytes = rows(first, sites.size());
  SiteTable read;
  SiteCollector collector(read, options_);
  in_file(path_, [&] { add_rows(table_.piece(bytes, sites.size()), first, collector); });
  std::ranges::copy(read.sites, sites.begin());
  if (!positions.empty()) std::ranges::copy(read.positions, positions.begin());
}

// Returns the bytes of some rows, in the order of the file.
std::string NpyRows::rows(std::uint64_t first, std::size_t count) const {
  const std::size_t num_runs = table_.is_by_columns() ? table_.num_columns() : 1;
  const std::size_t run = table_.row_bytes() / num_runs * count;
  std::string bytes(run * num_runs, '\0');
  for (std::size_t i = 0; i < num_runs; ++i)
    read_bytes(table_.place(first, i), std::span(bytes).subspan(i * run, run));
  return bytes;
}

void NpyRows::read_bytes(std::uint64_t place, std::span<char> bytes) const {
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system::read_at(descriptor_, place, bytes.data(), bytes.size());
    if (count < 0) fail(errno);
    if (count == 0) throw FileError(path_ + ": the file was cut while it was read");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    place += static_cast<std::uint64_t>(count);
  }
}

void NpyRows::fail(int error) const {
  throw FileError(path_, std::error_code(error, std::generic_category()));
}

}  // namespace rondel::io
