// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Turns the bytes of a fuzzer into a table of sites for the writers, and reads files as bytes.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/io.h"

namespace rondel::fuzz {

// Points, or circles at longitudes and latitudes.
inline SiteTable next_table(ByteSource& source, std::size_t limit) {
  SiteTable table;
  table.name = "sites";
  if (source.byte() % 2 == 0) {
    const Scales scales = next_scales(source);
    table.sites = all_sites(source, limit, scales);
    remove_center(table.sites, {});
    return table;
  }
  while (!source.is_empty() && table.sites.size() < limit) {
    table.positions.push_back({source.small() * 1.5 + source.byte() / 256.0,
                               source.small() % 90 + source.small() / 128.0});
    table.sites.push_back(unit_vector(table.positions.back()));
    table.radii_deg.push_back(source.byte() * 0.35);
  }
  return table;
}

// For a file of this kind: maps take far longer than lists, so that they have few sites.
inline SiteTable next_table(ByteSource& source, std::size_t most, const std::string& ending) {
  const std::size_t limit = next_limit(source, most);
  return next_table(source, ending != ".geojson" ? limit : limit == most ? 12 : 5);
}

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace rondel::fuzz
