// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One reader of sites, named by RONDEL_FUZZED_READER: any bytes give sites or a FileError of one
// line.
#include <cmath>
#include <string>

#include "fuzz/fuzz_input.h"
#include "io/bad_value.h"
#include "io/site_formats.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

void test(std::string_view bytes, const ReadOptions& options) {
  SiteTable table;
  table.name = "name";
  try {
    io::in_file(table.name, [&] { io::RONDEL_FUZZED_READER(bytes, {options, {}}, table); });
  } catch (const FileError& error) {
    const std::string what = error.what();
    require(what.starts_with("name:"), "a message starts with the file: " + what);
    require(what.find('\n') == std::string::npos, "a message is one line: " + what);
    return;
  }
  require(table.positions.empty() || table.positions.size() == table.sites.size(),
          "every site has a position or none");
  require(table.radii_deg.empty() || table.radii_deg.size() == table.sites.size(),
          "every site has a radius or none");
  for (const double radius_deg : table.radii_deg) {
    require(radius_deg >= 0 && radius_deg < 90, "radii are those of circles");
  }
  require(table.lines.empty() || table.lines.size() == table.sites.size(),
          "every site has a line or none");
  for (const Point& p : table.sites) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "sites are finite");
  }
  for (std::size_t i = 0; i < table.sites.size(); ++i) {
    require(table.where(i).starts_with("name:"), "a site is somewhere");
  }
  for (const Column& column : table.columns) {
    require(column.ends.size() == table.sites.size(), "a cell for each site");
    require(column.ends.empty() || column.ends.back() == column.text.size(), "cells have ends");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  rondel::ReadOptions options;
  rondel::fuzz::test(bytes, options);
  options.radians = true;
  options.keep_columns = true;
  rondel::fuzz::test(bytes, options);
  options.radius = "radius";
  rondel::fuzz::test(bytes, options);
  return 0;
}
