// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_cells: which format.
#include <array>

#include "io/cell_formats.h"
#include "io/ending.h"
#include "system/arithmetic.h"

namespace rondel {
namespace {

struct Writer {
  std::string_view ending;
  void (*write)(io::AtomicFile&, const io::CellsToWrite&);
};
constexpr std::array<Writer, 3> writers = {{{".geojson", &io::write_cells_geojson},
                                            {".vtp", &io::write_cells_vtp},
                                            {".npz", &io::write_cells_npz}}};

}  // namespace

bool can_write_cells(const std::string& path) {
  return io::find_format<Writer>(writers, path) != nullptr;
}

void write_cells(const std::string& path, const SiteTable& table,
                 const Triangulation& triangulation, const Diagram& diagram, double tolerance_deg,
                 const Progress& progress) {
  const system::ArithmeticScope arithmetic;
  const auto& writer = io::require_format<Writer>(writers, path, "cells are written as");
  io::AtomicFile file(path);
  writer.write(file, {table, triangulation, diagram, tolerance_deg, progress});
  file.commit();
}

}  // namespace rondel
