// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_cells() picks the format and checks its arguments.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/cell_formats.h"
#include "io/ending.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel::io {

void require_sites(const SiteTable& table, const Triangulation& triangulation) {
  const auto sites = triangulation.sites().points();
  const auto [ours, theirs] = std::ranges::mismatch(table.sites, sites);
  if (ours == table.sites.end() && theirs == sites.end()) return;
  throw InvalidInput("the sites of the table are not those of the triangulation",
                     static_cast<std::size_t>(ours - table.sites.begin()));
}

double checked_tolerance(double tolerance_deg) {
  if (tolerance_deg > 0) return std::max(tolerance_deg, min_tolerance_deg);
  throw InvalidInput("the tolerance is not positive");
}

void require_diagram(const Triangulation& triangulation, const Diagram& diagram) {
  const std::size_t n = triangulation.num_sites();
  const Cells& cells = diagram.cells;
  const bool is_sized = diagram.areas.size() == n &&
                        system::are_offsets(cells.rings.offsets, n, cells.rings.values.size()) &&
                        cells.points.size() >= triangulation.num_faces();
  const auto is_unit = [](const Point& p) {
    return std::abs(p.x * p.x + p.y * p.y + p.z * p.z - 1) < 1e-6;
  };
  if (!is_sized || !std::ranges::all_of(cells.points, is_unit) ||
      std::ranges::any_of(cells.rings.values, [&](Index i) { return i >= cells.points.size(); })) {
    throw InvalidInput("the diagram is not that of the triangulation");
  }
}

}  // namespace rondel::io

namespace rondel {
namespace {

using CellWriter = io::Writer<io::CellsToWrite>;
// The formats in which cells are written, by their endings.
constexpr std::array<CellWriter, 3> cell_writers = {{{".geojson", &io::write_cells_geojson},
                                                     {".vtp", &io::write_cells_vtp},
                                                     {".npz", &io::write_cells_npz}}};

}  // namespace

bool can_write_cells(const FileName& file) {
  return io::find_format<CellWriter>(cell_writers, file) != nullptr;
}

void write_cells(const FileName& output, const SiteTable& table, const Triangulation& triangulation,
                 const Diagram& diagram, double tolerance_deg, const Execution& execution) {
  const system::Call call(execution);
  io::require_sites(table, triangulation);
  io::require_diagram(triangulation, diagram);
  const double tolerance = io::checked_tolerance(tolerance_deg);
  io::write_whole<io::CellsToWrite>(cell_writers, output, "cells are written as",
                                    {table, triangulation, diagram, tolerance, execution});
}

}  // namespace rondel
