// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_sites(), write_sites() and write_file() pick the format and do what all formats have in
// common.
#include <array>

#include "io/atomic_file.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/site_formats.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "system/job.h"

namespace rondel {
namespace {

// A format of sites: how it is read, and whether it can have columns.
struct SiteReader {
  std::string_view ending;
  void (*read)(std::string_view, const io::ReadJob&, SiteTable&);
  bool has_columns = false;
  // Throws BadValue for what can be refused given the head of a file and its size.
  void (*check)(std::string_view, std::uint64_t) = nullptr;
};
constexpr std::array<SiteReader, 6> site_readers = {
    {{".csv", &io::read_csv, true},
     {".tsv", &io::read_tsv, true},
     {".xyz", &io::read_xyz},
     {".txt", &io::read_xyz},
     {".npy", &io::read_npy_sites, false, &io::check_npy_sites},
     {".geojson", &io::read_geojson}}};

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
  if (!options.radius.empty() && reader.ending != ".geojson") {
    throw FileError(start + "a radius is named" + end + "; give weighted sites as x, y, z");
  }
  if (options.delimiter != '\0') {
    throw FileError(start + "a delimiter is named, but " + std::string(reader.ending) +
                    " files have none");
  }
}

}  // namespace

std::string SiteTable::where(std::size_t site) const {
  const std::uint64_t line = lines.empty() ? first_line + site : lines[site];
  const std::string place = name + (first_line != 0 ? ":" : ": row ") + std::to_string(line);
  return features.empty() ? place : place + ": feature " + std::to_string(features[site]);
}

SiteTable SiteTable::selection(const std::vector<bool>& keep) const {
  SiteTable selected;
  selected.name = name;
  selected.first_line = first_line;
  selected.num_unlocated = num_unlocated;
  for (const Column& column : columns) selected.columns.push_back(column.empty_copy());
  selected.ids = ids.empty_copy();
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    selected.sites.push_back(sites[i]);
    if (!positions.empty()) selected.positions.push_back(positions[i]);
    if (!radii_deg.empty()) selected.radii_deg.push_back(radii_deg[i]);
    if (!features.empty()) selected.features.push_back(features[i]);
    selected.lines.push_back(lines.empty() ? first_line + i : lines[i]);
    for (std::size_t c = 0; c < columns.size(); ++c) selected.columns[c].add(columns[c], i);
    if (!ids.ends.empty()) selected.ids.add(ids, i);
  }
  return selected;
}

SiteTable read_sites(const FileName& file, const ReadOptions& options, const Execution& execution) {
  const system::Call call(execution);
  io::FileBytes bytes(file);
  SiteTable table;
  table.name = bytes.name();
  const bool is_csv = file.path == "-" && file.format.empty();
  const SiteReader& reader =
      is_csv ? site_readers[0]
             : io::require_format<SiteReader>(site_readers, file, "sites are read from");
  require_columns(reader, options, table);
  if (bytes.head().empty()) throw FileError(table.name + ": the file is empty");
  io::in_file(table.name, [&] {
    if (reader.check != nullptr) reader.check(bytes.head(), bytes.claimed_size());
    reader.read(bytes.text(), {options, execution}, table);
  });
  return table;
}

bool can_write_sites(const FileName& file) {
  return io::find_format<SiteWriter>(site_writers, file) != nullptr;
}

void write_sites(const FileName& output, std::span<const Point> sites,
                 std::span<const LonLat> positions, std::span<const double> radii_deg,
                 const Execution& execution) {
  const system::Call call(execution);
  io::write_whole<io::SitesToWrite>(site_writers, output, "sites are written as",
                                    {sites, positions, radii_deg, execution});
}

void write_file(const FileName& name, std::string_view bytes) {
  io::AtomicFile file(name);
  file.write(bytes);
  file.commit();
}

}  // namespace rondel
