// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/mesh_files.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "map/ring_area.h"
#include "overlay/mesh_formats.h"
#include "overlay/same_nodes.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

overlay::MeshContent read_mesh(const io::NetcdfReader& file) {
  for (const auto read : {&overlay::read_ugrid, &overlay::read_scrip_grid, &overlay::read_esmf_mesh,
                          &overlay::read_mpas, &overlay::read_icon, &overlay::read_cf_grid}) {
    if (std::optional<overlay::MeshContent> mesh = read(file)) return std::move(*mesh);
  }
  throw io::BadValue(
      "it has no cells: it follows none of UGRID, SCRIP, ESMF, MPAS, ICON, and no longitudes and "
      "latitudes "
      "of CF");
}

// Rings with the inside to the left, without corners that repeat the one before.
CellRings cells_of(const overlay::MeshContent& mesh) {
  CellRings result;
  result.points = unit_vectors(mesh.nodes);
  const std::vector<Index> same = overlay::same_nodes(result.points, mesh.is_single ? 1e-6 : 1e-10);
  std::vector<Index> ring;
  std::vector<Point> points;
  for (std::size_t i = 0; i + 1 < mesh.cells.size(); ++i) {
    for (std::uint64_t r = mesh.cells[i]; r < mesh.cells[i + 1]; ++r) {
      ring.clear();
      for (std::uint64_t k = mesh.rings[r]; k < mesh.rings[r + 1]; ++k) {
        const Index corner = same[mesh.corners[k]];
        if (ring.empty() || corner != ring.back()) ring.push_back(corner);
      }
      while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
      if (ring.size() < 3) continue;
      points.clear();
      for (const Index corner : ring) points.push_back(result.points[corner]);
      if (map::area_on_left(points) < 0) std::ranges::reverse(ring);
      result.corners.insert(result.corners.end(), ring.begin(), ring.end());
      result.rings.push_back(result.corners.size());
    }
    result.cells.push_back(result.rings.size() - 1);
  }
  return result;
}

}  // namespace

std::size_t CellTable::num_cells() const {
  return grid ? (grid->lon_deg.size() - 1) * (grid->lat_deg.size() - 1) : cells.num_cells();
}

CellTable read_cells(const FileName& file) {
  const system::ArithmeticScope arithmetic;
  constexpr std::string_view netcdf = ".nc";
  if (io::ending(file) != netcdf) {
    io::throw_unknown_ending(file, "cells of models are read from", {&netcdf, 1});
  }
  io::FileBytes bytes(file.path, true);
  return io::in_file(bytes.name(), [&] {
    overlay::MeshContent mesh = read_mesh(io::NetcdfReader(bytes.text()));
    CellTable table;
    table.name = bytes.name();
    if (!mesh.grid) table.cells = cells_of(mesh);
    table.convention = std::move(mesh.convention);
    table.grid = std::move(mesh.grid);
    table.centers = std::move(mesh.centers);
    table.mask = std::move(mesh.mask);
    table.shape = std::move(mesh.shape);
    return table;
  });
}

Partition partition_of(const CellTable& table, GridSides sides, const Execution& execution) {
  try {
    return table.grid ? Partition::lonlat_grid(*table.grid, sides, execution)
                      : Partition(table.cells, execution);
  } catch (const InvalidInput& error) {
    throw FileError(table.name + ": " + error.what());
  }
}

}  // namespace rondel
