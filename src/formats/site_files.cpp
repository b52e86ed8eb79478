// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_sites() and write_sites() pick the format and do what all formats have in common. GDAL reads
// and writes some formats (sites_gdal.h, features_gdal.h).
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "formats/drawn_features.h"
#include "formats/features_gdal.h"
#include "formats/sites_gdal.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/site_formats.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "system/job.h"

namespace rondel {
namespace {

// A format of sites: how it is read (null: by GDAL), and whether it can have columns.
struct SiteReader {
  std::string_view ending;
  void (*read)(std::string_view, const io::ReadJob&, SiteTable&);
  bool has_columns = false;
  // Throws BadValue for what can be refused given the head of a file and its size.
  void (*check)(std::string_view, std::uint64_t) = nullptr;
};
constexpr std::array<SiteReader, 10> site_readers = {
    {{".csv", &io::read_csv, true},
     {".tsv", &io::read_tsv, true},
     {".xyz", &io::read_xyz},
     {".txt", &io::read_xyz},
     {".npy", &io::read_npy_sites, false, &io::check_npy_sites},
     {".geojson", &io::read_geojson},
     {".gpkg", nullptr},
     {".fgb", nullptr},
     {".shp", nullptr},
     {".parquet", nullptr}}};

using SiteWriter = io::Writer<io::SitesToWrite>;
constexpr std::array<SiteWriter, 5> site_writers = {{{".csv", &io::write_csv},
                                                     {".tsv", &io::write_tsv},
                                                     {".xyz", &io::write_xyz},
                                                     {".txt", &io::write_xyz},
                                                     {".npy", &io::write_npy_sites}}};

// Throws FileError if options name columns and the format has none.
void require_columns(const SiteReader& reader, const ReadOptions& options, const SiteTable& table) {
  if (reader.has_columns) return;
  const bool names_a_column = !(options.lon.empty() && options.lat.empty() && options.x.empty() &&
                                options.y.empty() && options.z.empty());
  const std::string start = table.name + ": ";
  const std::string end =
      ", but " + std::string(reader.ending) + " files have no names for columns";
  if (names_a_column) throw FileError(start + "columns are named" + end);
  const bool has_fields = reader.ending == ".geojson" || reader.read == nullptr;
  if (!options.radius.empty() && !has_fields) {
    throw FileError(start + "a radius is named" + end + "; give weighted sites as x, y, z");
  }
  if (options.delimiter != '\0') {
    throw FileError(start + "a delimiter is named, but " + std::string(reader.ending) +
                    " files have none");
  }
}

// Writes sites by GDAL, as points with their radii.
void write_by_gdal(const FileName& file, const io::SitesToWrite& sites) {
  std::vector<LonLat> places(sites.positions.begin(), sites.positions.end());
  if (places.empty()) places = lonlats(sites.sites);
  std::vector<formats::DrawnGeometry> points(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) points[i].points = {places[i]};
  std::vector<formats::Measure> radii;
  if (!sites.radii_deg.empty()) {
    radii.push_back({"radius", {sites.radii_deg.begin(), sites.radii_deg.end()}});
  }
  const Column no_ids;
  formats::write_features_gdal(file, {.geometries = std::move(points),
                                      .is_written = std::vector<bool>(places.size(), true),
                                      .measures = std::move(radii),
                                      .columns = {},
                                      .ids = no_ids,
                                      .are_single_points = true});
}

}  // namespace

SiteTable read_sites(const FileName& file, const ReadOptions& options, const Execution& execution) {
  const system::Call call(execution);
  const SiteReader* reader = io::find_format<SiteReader>(site_readers, file);
  SiteTable table;
  if (reader != nullptr && reader->read == nullptr) {
    table.name = file.path;
    require_columns(*reader, options, table);
    formats::read_sites_gdal(file, {options, execution}, table);
    return table;
  }
  io::FileBytes bytes(file);
  table.name = bytes.name();
  if (reader == nullptr) {
    const FileName named(
        file.path, io::is_unnamed_input(file) ? io::format_of_text(bytes.head()) : file.format);
    reader = &io::require_format<SiteReader>(site_readers, named, "sites are read from");
  }
  require_columns(*reader, options, table);
  if (bytes.head().empty()) throw FileError(table.name + ": the file is empty");
  io::in_file(table.name, [&] {
    if (reader->check != nullptr) reader->check(bytes.head(), bytes.claimed_size());
    reader->read(bytes.text(), {options, execution}, table);
  });
  return table;
}

bool can_write_sites(const FileName& file) {
  return io::find_format<SiteWriter>(site_writers, file) != nullptr ||
         formats::is_format_of_gdal(file);
}

void write_sites(const FileName& output, std::span<const Point> sites,
                 std::span<const LonLat> positions, std::span<const double> radii_deg,
                 const Execution& execution) {
  const system::Call call(execution);
  const io::SitesToWrite to_write{sites, positions, radii_deg, execution};
  if (formats::is_format_of_gdal(output)) {
    write_by_gdal(output, to_write);
    return;
  }
  io::write_whole<io::SitesToWrite>(site_writers, output, "sites are written as", to_write);
}

}  // namespace rondel
