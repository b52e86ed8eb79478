// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_cells: which format.
#include <algorithm>
#include <array>

#include "io/cell_formats.h"
#include "io/ending.h"
#include "rondel/error.h"
#include "system/arithmetic.h"

namespace rondel::io {

void require_diagram(std::size_t num_sites, const Triangulation& triangulation,
                     const Diagram& diagram) {
  const std::size_t n = triangulation.num_sites();
  const Cells& cells = diagram.cells;
  const bool is_sized = num_sites == n && diagram.areas.size() == n &&
                        cells.offsets.size() == n + 1 && cells.offsets.front() == 0 &&
                        cells.offsets.back() == cells.rings.size() &&
                        cells.points.size() >= triangulation.num_faces();
  if (!is_sized || !std::ranges::is_sorted(cells.offsets) ||
      std::ranges::any_of(cells.rings, [&](Index i) { return i >= cells.points.size(); })) {
    throw InvalidInput("the sites, the triangulation and the diagram do not belong together", 0);
  }
}

}  // namespace rondel::io

namespace rondel {
namespace {

struct CellWriter {
  std::string_view ending;
  void (*write)(io::AtomicFile&, const io::CellsToWrite&);
};
constexpr std::array<CellWriter, 3> cell_writers = {{{".geojson", &io::write_cells_geojson},
                                                     {".vtp", &io::write_cells_vtp},
                                                     {".npz", &io::write_cells_npz}}};

}  // namespace

bool can_write_cells(const FileName& file) {
  return io::find_format<CellWriter>(cell_writers, file) != nullptr;
}

void write_cells(const FileName& output, const SiteTable& table, const Triangulation& triangulation,
                 const Diagram& diagram, double tolerance_deg, const Progress& progress) {
  const system::ArithmeticScope arithmetic;
  io::require_diagram(table.sites.size(), triangulation, diagram);
  const auto& writer = io::require_format<CellWriter>(cell_writers, output, "cells are written as");
  io::AtomicFile file(output.path);
  writer.write(file, {table, triangulation, diagram, tolerance_deg, progress});
  file.commit();
}

}  // namespace rondel
