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

void write_delimited(AtomicFile& file, std::span<const Point> sites,
                     std::span<const LonLat> positions, char delimiter) {
  std::string line = positions.empty() ? "x,y,z\n" : "lon,lat\n";
  for (char& c : line) {
    if (c == ',') c = delimiter;
  }
  file.write(line);
  if (positions.empty()) return write_points(file, sites, delimiter);
  for (const LonLat& position : positions) {
    line.clear();
    append_row(line, {position.lon_deg, position.lat_deg}, delimiter);
    file.write(line);
  }
}

}  // namespace

void write_csv(AtomicFile& file, std::span<const Point> sites, std::span<const LonLat> positions) {
  write_delimited(file, sites, positions, ',');
}

void write_tsv(AtomicFile& file, std::span<const Point> sites, std::span<const LonLat> positions) {
  write_delimited(file, sites, positions, '\t');
}

void write_xyz(AtomicFile& file, std::span<const Point> sites, std::span<const LonLat>) {
  write_points(file, sites, ' ');
}

}  // namespace rondel::io
