// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers and writers of sites, one function a format and direction.
//
// in    the bytes of a file; or sites
// out   a SiteTable; or a file
#pragma once

#include <span>
#include <string_view>

#include "io/atomic_file.h"
#include "rondel/io.h"

namespace rondel::io {

// Options for reading, and how many threads may be used.
struct ReadJob : ReadOptions, Execution {};

// Each of these reads `bytes`, the content of the file `table.name`, into `table`. They throw
// BadValue, or FileError like read_sites().
void read_csv(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_tsv(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_xyz(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_npy_sites(std::string_view bytes, const ReadJob& options, SiteTable& table);
void read_geojson(std::string_view bytes, const ReadJob& options, SiteTable& table);

// Throws BadValue if read_npy_sites() would refuse the head of a file of `file_size` bytes (0: not
// known).
void check_npy_sites(std::string_view head, std::uint64_t file_size);

// The arguments of write_sites(). Positions and radii may be empty.
struct SitesToWrite {
  std::span<const Point> sites;
  std::span<const LonLat> positions;
  std::span<const double> radii_deg;
  const Execution& execution;
};

// Each of these writes the positions if there are any, otherwise the sites. Tables with a header
// have a column for the radii; if there are radii, .npy has the sites. .xyz always has the sites.
void write_csv(AtomicFile& file, const SitesToWrite& to_write);
void write_tsv(AtomicFile& file, const SitesToWrite& to_write);
void write_xyz(AtomicFile& file, const SitesToWrite& to_write);
void write_npy_sites(AtomicFile& file, const SitesToWrite& to_write);

}  // namespace rondel::io
