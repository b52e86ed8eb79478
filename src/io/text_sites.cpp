// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes sites as text: .csv, .tsv and .xyz.
#include <string>

#include "io/mesh_text.h"
#include "io/parallel_write.h"
#include "io/site_formats.h"

namespace rondel::io {
namespace {

void write_points(AtomicFile& file, const SitesToWrite& to_write, char delimiter) {
  write_site_lines(file, to_write.sites, to_write.execution.threads, "", delimiter);
}

void write_delimited(AtomicFile& file, const SitesToWrite& to_write, char delimiter) {
  const std::span<const LonLat> positions = to_write.positions;
  const std::span<const double> radii_deg = to_write.radii_deg;
  std::string line = positions.empty()   ? "x,y,z\n"
                     : radii_deg.empty() ? "lon,lat\n"
                                         : "lon,lat,radius\n";
  for (char& c : line) {
    if (c == ',') c = delimiter;
  }
  file.write(line);
  if (positions.empty()) return write_points(file, to_write, delimiter);
  write_in_parallel(file, to_write.execution.threads, positions.size(), items_per_piece,
                    [&](std::string& text, std::size_t begin, std::size_t end) {
                      for (std::size_t i = begin; i < end; ++i) {
                        const auto& [lon_deg, lat_deg] = positions[i];
                        if (radii_deg.empty()) {
                          append_row(text, {lon_deg, lat_deg}, delimiter);
                        } else {
                          append_row(text, {lon_deg, lat_deg, radii_deg[i]}, delimiter);
                        }
                      }
                    });
}

}  // namespace

void write_csv(AtomicFile& file, const SitesToWrite& to_write) {
  write_delimited(file, to_write, ',');
}

void write_tsv(AtomicFile& file, const SitesToWrite& to_write) {
  write_delimited(file, to_write, '\t');
}

void write_xyz(AtomicFile& file, const SitesToWrite& to_write) {
  write_points(file, to_write, ' ');
}

}  // namespace rondel::io
