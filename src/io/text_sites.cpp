// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites as text: .csv, .tsv and .xyz.
#include <string>

#include "io/number.h"
#include "io/site_formats.h"

namespace rondel::io {
namespace {

void append_row(std::string& line, std::initializer_list<double> values, char delimiter) {
  for (const double value : values) {
    append_number(line, value);
    line += delimiter;
  }
  line.back() = '\n';
}

void write_points(AtomicFile& file, std::span<const Point> sites, char delimiter) {
  std::string line;
  for (const Point& site : sites) {
    line.clear();
    append_row(line, {site.x, site.y, site.z}, delimiter);
    file.write(line);
  }
}

void write_delimited(AtomicFile& file, const SitesToWrite& to_write, char delimiter) {
  const auto& [sites, positions, radii_deg] = to_write;
  std::string line = positions.empty()   ? "x,y,z\n"
                     : radii_deg.empty() ? "lon,lat\n"
                                         : "lon,lat,radius\n";
  for (char& c : line) {
    if (c == ',') c = delimiter;
  }
  file.write(line);
  if (positions.empty()) return write_points(file, sites, delimiter);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto& [lon_deg, lat_deg] = positions[i];
    line.clear();
    if (radii_deg.empty()) {
      append_row(line, {lon_deg, lat_deg}, delimiter);
    } else {
      append_row(line, {lon_deg, lat_deg, radii_deg[i]}, delimiter);
    }
    file.write(line);
  }
}

}  // namespace

void write_csv(AtomicFile& file, const SitesToWrite& to_write) {
  write_delimited(file, to_write, ',');
}

void write_tsv(AtomicFile& file, const SitesToWrite& to_write) {
  write_delimited(file, to_write, '\t');
}

void write_xyz(AtomicFile& file, const SitesToWrite& to_write) {
  write_points(file, to_write.sites, ' ');
}

}  // namespace rondel::io
