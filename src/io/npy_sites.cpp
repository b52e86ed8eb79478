// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "io/npy_header.h"
#include "io/number.h"
#include "io/site_collector.h"
#include "io/site_formats.h"

namespace rondel::io {
namespace {

// The doubles nearest to most integers of 64 bits are others.
template <typename Number>
double exact_double(Number value) {
  if constexpr (std::is_integral_v<Number> && sizeof(Number) == 8) {
    constexpr int most_bits = std::numeric_limits<double>::digits;
    const auto bits = static_cast<std::uint64_t>(value);
    const std::uint64_t magnitude = value < 0 ? 0 - bits : bits;
    if (magnitude != 0 && magnitude >> std::countr_zero(magnitude) >> most_bits != 0) {
      throw BadValue(std::to_string(value) + " is no double");
    }
  }
  return static_cast<double>(value);
}

template <typename Number>
void read_rows(const NpyTable& array, const ReadJob& options, SiteTable& table) {
  const bool is_lonlat = array.num_columns() == 2;
  SiteCollector collector(table, options);
  collector.reserve(array.num_rows(), is_lonlat);
  const auto number = [&](std::size_t row, std::size_t column) {
    return exact_double(array.at<Number>(row, column));
  };
  for (std::size_t i = 0; i < array.num_rows(); ++i) {
    at_item("row", i, [&] {
      if (is_lonlat) {
        collector.add_position(number(i, 0), number(i, 1), 0);
      } else {
        collector.add_point({number(i, 0), number(i, 1), number(i, 2)}, 0);
      }
    });
    collector.report_progress(i, array.num_rows());
  }
}

constexpr std::array<std::string_view, 10> number_types = {"f8", "f4", "i1", "i2", "i4",
                                                           "i8", "u1", "u2", "u4", "u8"};
constexpr std::array readers = {
    &read_rows<double>,        &read_rows<float>,         &read_rows<std::int8_t>,
    &read_rows<std::int16_t>,  &read_rows<std::int32_t>,  &read_rows<std::int64_t>,
    &read_rows<std::uint8_t>,  &read_rows<std::uint16_t>, &read_rows<std::uint32_t>,
    &read_rows<std::uint64_t>,
};
static_assert(number_types.size() == readers.size());

NpyTable checked_table(std::string_view bytes, std::uint64_t file_size) {
  NpyTable array(bytes, file_size, number_types, "float64, float32 or an integer");
  if (array.num_columns() != 2 && array.num_columns() != 3) {
    throw BadValue("shape " + array.shape() + " where (n, 3) or (n, 2) is needed");
  }
  require_indices(array.num_rows());
  return array;
}

}  // namespace

void check_npy_sites(std::string_view head, std::uint64_t file_size) {
  if (file_size > head.size()) checked_table(head, file_size);
}

void read_npy_sites(std::string_view bytes, const ReadJob& options, SiteTable& table) {
  table.first_line = 0;
  const NpyTable array = checked_table(bytes, bytes.size());
  const auto type = std::ranges::find(number_types, array.type()) - number_types.begin();
  readers[static_cast<std::size_t>(type)](array, options, table);
}

void write_npy_sites(AtomicFile& file, const SitesToWrite& to_write) {
  const std::span<const Point> sites = to_write.sites;
  const std::span<const LonLat> positions = to_write.positions;
  const std::uint64_t n = sites.size();
  if (!positions.empty() && to_write.radii_deg.empty()) {
    file.write(make_npy_header("<f8", std::array<std::uint64_t, 2>{n, 2}));
    file.write(NumberBytes(positions));
    return;
  }
  file.write(make_npy_header("<f8", std::array<std::uint64_t, 2>{n, 3}));
  file.write(NumberBytes(sites));
}

}  // namespace rondel::io
