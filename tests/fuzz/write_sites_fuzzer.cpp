// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_sites, can_write_sites against read_sites: sites, positions and circles are read back with
// the same bits; arrays that do not fit are refused, and no file is left.
#include <array>
#include <string>

#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

constexpr std::array site_endings = {".csv", ".tsv", ".xyz", ".txt", ".npy"};

bool has_header(const std::string& path) {
  return path.ends_with(".csv") || path.ends_with(".tsv");
}

void test_sites(const std::string& path, const SiteTable& table) {
  write_sites(path, table.sites);
  require(read_sites(path).sites == table.sites, "sites survive");
}

void test_positions(const std::string& path, const SiteTable& table) {
  write_sites(path, table.sites, table.positions);
  const SiteTable back = read_sites(path);
  require(back.sites == table.sites, "the sites of positions survive");
  const bool has_positions = has_header(path) || path.ends_with(".npy");
  if (has_positions) require(back.positions == table.positions, "positions survive");
}

void test_circles(const std::string& path, const SiteTable& table) {
  const auto sites = polar_points(table.positions, table.radii_deg);
  write_sites(path, sites, table.positions, table.radii_deg);
  ReadOptions options;
  if (has_header(path)) options.radius = "radius";
  const SiteTable back = read_sites(path, options);
  require(back.sites == sites, "circles survive");
  if (has_header(path)) require(back.radii_deg == table.radii_deg, "radii survive");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::ScratchFolder folder;
  fuzz::ByteSource source(data, size);
  const std::string path = folder.file(std::string("sites") +
                                       fuzz::site_endings[source.below(fuzz::site_endings.size())]);
  const std::size_t what = source.below(3);
  const SiteTable table = fuzz::next_table(source, fuzz::next_limit(source, 100));
  fuzz::require(can_write_sites(path), "a format of sites can be written");
  fuzz::require(path.ends_with('.' + format_of(path)), "the ending is the format");
  fuzz::require(!can_write_sites(folder.file("sites.obj")), "other formats cannot");
  if (table.sites.empty()) return 0;
  if (what == 0 || table.positions.empty()) {
    fuzz::test_sites(path, table);
  } else if (what == 1) {
    fuzz::test_positions(path, table);
  } else {
    fuzz::test_circles(path, table);
  }
  return 0;
}
