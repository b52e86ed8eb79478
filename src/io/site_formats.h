// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The formats of sites, one function each way.
#pragma once

#include <span>
#include <string_view>

#include "io/atomic_file.h"
#include "rondel/io.h"

namespace rondel::io {

// How to read, and with what.
struct ReadJob : ReadOptions, Execution {};

// Each reads `bytes`, the content of the file `table.name`, into `table`.
// Throws BadValue, or FileError as read_sites does.
void read_csv(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_tsv(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_xyz(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_npy_sites(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_geojson(std::string_view bytes, const ReadJob& options, SiteTable& table);

// Throws BadValue if the head of a file of `file_size` bytes, or of a size not known (0), claims
// what read_npy_sites would refuse.
void check_npy_sites(std::string_view head, std::uint64_t file_size);

// What write_sites got. Positions and radii may be empty.
struct SitesToWrite {
  std::span<const Point> sites;
  std::span<const LonLat> positions;
  std::span<const double> radii_deg;
  const Execution& execution;
};

// Each writes the positions if there are any, otherwise the sites. Where there are radii, the
// tables with a header have a column for them; .npy then has the sites. .xyz always has the sites.
void write_csv(AtomicFile& file, const SitesToWrite& to_write);
void write_tsv(AtomicFile& file, const SitesToWrite& to_write);
void write_xyz(AtomicFile& file, const SitesToWrite& to_write);
void write_npy_sites(AtomicFile& file, const SitesToWrite& to_write);

}  // namespace rondel::io
