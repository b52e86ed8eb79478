// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads and writes sites as arrays: (n, 2) longitudes and latitudes in degrees, or (n, 3) points.
#include <array>
#include <cstdint>

#include "io/npy_header.h"
#include "io/npy_rows.h"
#include "io/site_collector.h"
#include "io/site_formats.h"

namespace rondel::io {
namespace {

// Returns the array if it is one of sites and not too large.
NpyTable checked_table(std::string_view bytes, std::uint64_t file_size) {
  NpyTable array = site_table(bytes, file_size);
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
  SiteCollector collector(table, options);
  collector.reserve(array.num_rows(), array.num_columns() == 2);
  add_rows(array, 0, collector);
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
