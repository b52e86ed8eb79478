// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "page/page_input.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "rondel/error.h"
#include "system/row_assembly.h"

namespace rondel::page {
namespace {

// True if `ends` has `count` ends of consecutive parts that make up [0, size).
bool are_parts(const std::vector<std::uint64_t>& ends, std::size_t count, std::size_t size) {
  return ends.size() == count && std::ranges::is_sorted(ends) &&
         (count == 0 ? 0 : ends.back()) == size;
}

// True if the arrays of the diagram have the sizes that the triangulation requires and all indices
// are in range.
bool has_shape_of(const Triangulation& triangulation, const Diagram& diagram) {
  const Cells& cells = diagram.cells;
  const std::size_t n = triangulation.num_sites();
  return diagram.areas.size() == n &&
         system::are_offsets(cells.rings.offsets, n, cells.rings.values.size()) &&
         cells.points.size() >= triangulation.num_faces() &&
         std::ranges::all_of(cells.rings.values, [&](Index i) { return i < cells.points.size(); });
}

}  // namespace

void require_input(const SiteTable& table, const Triangulation& triangulation,
                   const Diagram& diagram, const GlobeOptions& options) {
  const std::size_t n = triangulation.num_sites();
  if (!std::ranges::equal(table.sites, triangulation.sites().points())) {
    throw InvalidInput("the sites of the table are not those of the triangulation");
  }
  if (!table.radii_deg.empty() && table.radii_deg.size() != n) {
    throw InvalidInput("there is not one radius for each site", table.radii_deg.size());
  }
  if (!has_shape_of(triangulation, diagram)) {
    throw InvalidInput("the diagram is not that of the triangulation");
  }
  for (const Column& column : table.columns) {
    if (!are_parts(column.ends, n, column.text.size())) {
      throw InvalidInput("a column does not have one cell for each site");
    }
  }
  if (!options.values.empty() && options.values.size() != n) {
    throw InvalidInput("there is not one value for each site", options.values.size());
  }
  const Isolines* const lines = options.isolines;
  if (lines != nullptr && !system::are_offsets(lines->lines.rows.offsets, lines->num_lines(),
                                               lines->lines.rows.values.size())) {
    throw InvalidInput("the arrays of the isolines do not fit together");
  }
  const LonLat view = options.view.value_or(LonLat{});
  const double all = view.lon_deg + view.lat_deg + options.up_deg + options.graticule_deg;
  if (!std::isfinite(all) || options.graticule_deg < 0) {
    throw InvalidInput("an option of the globe is not finite, or negative");
  }
}

}  // namespace rondel::page
