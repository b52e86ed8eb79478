// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/cell_formats.h"
#include "io/geojson_writer.h"
#include "io/number.h"
#include "io/parallel_write.h"
#include "map/cell_map.h"
#include "system/job.h"

namespace rondel::io {
namespace {

// Returns a foreign member (RFC 7946, section 6.1) with each hidden site and the corners of the
// face above it.
std::string hidden_member(const Triangulation& triangulation) {
  std::string text;
  for (const auto& [site, face] : triangulation.hidden()) {
    text += text.empty() ? ",\"hidden\":[\n" : ",\n";
    text += R"({"site":)";
    append_integer(text, site);
    text += R"(,"below":[)";
    if (face != no_index) {
      for (const Index corner : triangulation.faces()[face]) {
        append_integer(text, corner);
        text += ',';
      }
      text.pop_back();
    }
    text += "]}";
  }
  return text.empty() ? text : text + "\n]";
}

}  // namespace

void write_cells_geojson(AtomicFile& file, const CellsToWrite& cells) {
  // Each thread makes the text of so many sites at a time.
  constexpr std::size_t grain = 512;
  const std::vector<Column>& columns = cells.table.columns;
  const std::vector<std::string> keys = property_keys(columns, {"site", "area"});
  const std::size_t n = cells.table.sites.size();
  const map::CellMap cell_map(cells.triangulation, cells.diagram.cells, cells.tolerance_deg,
                              cells.execution);
  std::size_t first_cell = 0;
  while (first_cell < n && !cell_map.has_cell(first_cell)) ++first_cell;

  const auto append_feature = [&](std::string& text, std::size_t site, map::CellMap::Pen& pen) {
    begin_feature(text, site == first_cell, cells.table.ids, site);
    text += R"("site":)";
    append_integer(text, site);
    text += R"(,"area":)";
    append_number(text, cells.diagram.areas[site]);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      text += keys[k];
      append_value(text, columns[k], site);
    }
    text += geometry_begin;
    append_geometry(text, cell_map.polygons(site, pen));
    text += '}';
  };
  file.write(features_begin);
  write_in_parallel(
      file, cells.execution.threads, n, grain,
      [&](std::string& text, std::size_t begin, std::size_t end) {
        map::CellMap::Pen pen;
        for (std::size_t site = begin; site < end; ++site) {
          cell_map.prefetch(std::min(site + 4, n - 1));
          if (cell_map.has_cell(site)) append_feature(text, site, pen);
        }
      },
      [&](std::size_t done) { system::announce(cells.execution, "write", done, n); });
  file.write("\n]");
  file.write(hidden_member(cells.triangulation));
  file.write("}\n");
}

}  // namespace rondel::io
