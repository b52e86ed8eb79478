// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_sites, write_sites and write_file: which format, and what all have in common.
#include <array>
#include <memory>

#include "io/atomic_file.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/site_formats.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "system/arithmetic.h"

namespace rondel::inline v0 {
namespace {

struct Reader {
  std::string_view ending;
  void (*read)(std::string_view, const ReadOptions&, SiteTable&);
  bool has_columns = false;
};
constexpr std::array<Reader, 6> readers = {{{".csv", &io::read_csv, true},
                                            {".tsv", &io::read_tsv, true},
                                            {".xyz", &io::read_xyz},
                                            {".txt", &io::read_xyz},
                                            {".npy", &io::read_npy_sites},
                                            {".geojson", &io::read_geojson}}};

struct Writer {
  std::string_view ending;
  void (*write)(io::AtomicFile&, const io::SitesToWrite&);
};
constexpr std::array<Writer, 5> writers = {{{".csv", &io::write_csv},
                                            {".tsv", &io::write_tsv},
                                            {".xyz", &io::write_xyz},
                                            {".txt", &io::write_xyz},
                                            {".npy", &io::write_npy_sites}}};

bool names_a_column(const ReadOptions& options) {
  return !(options.lon.empty() && options.lat.empty() && options.x.empty() && options.y.empty() &&
           options.z.empty());
}

}  // namespace

std::string SiteTable::where(std::size_t site) const {
  if (!lines.empty()) return name + ":" + std::to_string(lines[site]);
  if (first_line != 0) return name + ":" + std::to_string(first_line + site);
  return name + ": row " + std::to_string(site);
}

SiteTable read_sites(const std::string& path, const ReadOptions& options) {
  const system::ArithmeticScope arithmetic;
  SiteTable table;
  table.name = path == "-" ? "<stdin>" : path;
  const auto file = std::make_shared<const io::FileBytes>(path);
  const Reader& reader =
      path == "-" ? readers[0] : io::require_format<Reader>(readers, path, "sites are read from");
  if (!reader.has_columns && names_a_column(options)) {
    throw FileError(table.name + ": columns are named, but " + std::string(reader.ending) +
                    " files have no names for columns");
  }
  if (!reader.has_columns && !options.radius.empty() && reader.ending != ".geojson") {
    throw FileError(table.name + ": a radius is named, but " + std::string(reader.ending) +
                    " files have no names for columns; give weighted sites as x, y, z");
  }
  reader.read(file->text(), options, table);
  if (table.sites.is_mapped()) {
    file->keep();
    table.sites = PointArray(table.sites, file);
  }
  return table;
}

bool can_write_sites(const std::string& path) {
  return io::find_format<Writer>(writers, path) != nullptr;
}

void write_sites(const std::string& path, std::span<const Point> sites,
                 std::span<const LonLat> positions, std::span<const double> radii_deg,
                 unsigned threads) {
  const system::ArithmeticScope arithmetic;
  const Writer& writer = io::require_format<Writer>(writers, path, "sites are written as");
  io::AtomicFile file(path);
  writer.write(file, {sites, positions, radii_deg, threads});
  file.commit();
}

void write_file(const std::string& path, std::string_view bytes) {
  io::AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace rondel::inline v0
