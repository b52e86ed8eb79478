// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "io/npy_header.h"
#include "io/number.h"
#include "io/site_collector.h"
#include "io/site_formats.h"
#include "rondel/error.h"
#include "system/view_as.h"

namespace rondel::io {
namespace {

constexpr std::array<std::string_view, 1> types = {"f8"};

// Fewer sites are copied: that costs little, and their file may change meanwhile.
constexpr std::size_t least_mapped = std::size_t{1} << 22;

void refer_to(std::span<const Point> sites, const ReadOptions& options, SiteTable& table) {
  constexpr std::size_t interval = 65536;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    try {
      checked_point(sites[i]);
    } catch (const BadValue& bad) {
      throw FileError(table.where(i) + ": " + bad.what());
    }
    if (i % interval == 0 && options.progress) {
      options.progress("read", static_cast<double>(i) / static_cast<double>(sites.size()));
    }
  }
  table.sites = PointArray(sites, nullptr);
}

void read_table(std::string_view bytes, const ReadOptions& options, SiteTable& table) {
  const NpyTable array(bytes, types, "float64");
  const bool is_lonlat = array.num_columns() == 2;
  if (!is_lonlat && array.num_columns() != 3) {
    throw BadValue("shape " + array.shape() + " where (n, 3) or (n, 2) is needed");
  }
  require_indices(array.num_rows());
  table.first_line = 0;
  const double* const numbers = array.in_place<double>();
  if (!is_lonlat && numbers != nullptr && array.num_rows() >= least_mapped) {
    return refer_to(system::view_as<Point>(std::span(numbers, 3 * array.num_rows())), options,
                    table);
  }
  SiteCollector collector(table, options);
  collector.reserve(array.num_rows(), is_lonlat);
  for (std::size_t i = 0; i < array.num_rows(); ++i) {
    const double a = array.at<double>(i, 0);
    const double b = array.at<double>(i, 1);
    try {
      if (is_lonlat) {
        collector.add_position(a, b, 0);
      } else {
        collector.add_point({a, b, array.at<double>(i, 2)}, 0);
      }
    } catch (const BadValue& bad) {
      throw FileError(table.where(i) + ": " + bad.what());
    }
    collector.report_progress(i, array.num_rows());
  }
}

}  // namespace

void read_npy_sites(std::string_view bytes, const ReadOptions& options, SiteTable& table) {
  if (bytes.empty()) throw FileError(table.name + ": the file is empty");
  try {
    read_table(bytes, options, table);
  } catch (const BadValue& bad) {
    throw FileError(table.name + ": " + bad.what());
  }
  if (table.sites.empty()) throw FileError(table.name + ": no sites");
}

void write_npy_sites(AtomicFile& file, const SitesToWrite& to_write) {
  const std::span<const Point> sites = to_write.sites;
  const std::span<const LonLat> positions = to_write.positions;
  const std::uint64_t n = sites.size();
  if (!positions.empty() && to_write.radii_deg.empty()) {
    file.write(make_npy_header("<f8", std::array<std::uint64_t, 2>{n, 2}));
    write_values<double>(file, 2 * positions.size(), [&](std::size_t i) {
      const LonLat& position = positions[i / 2];
      return i % 2 == 0 ? position.lon_deg : position.lat_deg;
    });
    return;
  }
  file.write(make_npy_header("<f8", std::array<std::uint64_t, 2>{n, 3}));
  write_values<double>(file, 3 * sites.size(), [&](std::size_t i) {
    const Point& site = sites[i / 3];
    return i % 3 == 0 ? site.x : i % 3 == 1 ? site.y : site.z;
  });
}

}  // namespace rondel::io
