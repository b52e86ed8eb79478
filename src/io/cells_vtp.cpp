// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/binary.h"
#include "io/cell_formats.h"
#include "io/vtp_file.h"

namespace rondel::io {
namespace {

// An array of 8-byte numbers, component i of which is value(i).
template <typename T, typename Value>
VtpArray vtp_array(const char* name, const char* type, int components, std::size_t count,
                   Value value) {
  static_assert(sizeof(T) == 8);
  return {name, type, components, count * sizeof(T),
          [count, value](AtomicFile& file) { write_values<T>(file, count, value); }};
}

double coordinate(const Point& p, std::size_t k) { return k == 0 ? p.x : (k == 1 ? p.y : p.z); }

}  // namespace

void write_cells_vtp(AtomicFile& file, const CellsToWrite& to_write) {
  const Cells& cells = to_write.diagram.cells;
  const std::vector<double>& areas = to_write.diagram.areas;
  std::vector<Index> sites;  // those with a ring
  for (std::size_t site = 0; site + 1 < cells.offsets.size(); ++site) {
    if (cells.offsets[site] != cells.offsets[site + 1]) sites.push_back(static_cast<Index>(site));
  }
  VtpMesh mesh;
  mesh.num_points = cells.points.size();
  mesh.num_polys = sites.size();
  mesh.points =
      vtp_array<double>("Points", "Float64", 3, 3 * cells.points.size(),
                        [&](std::size_t i) { return coordinate(cells.points[i / 3], i % 3); });
  mesh.connectivity = vtp_array<std::int64_t>("connectivity", "Int64", 1, cells.rings.size(),
                                              [&](std::size_t i) { return cells.rings[i]; });
  mesh.offsets = vtp_array<std::int64_t>("offsets", "Int64", 1, sites.size(), [&](std::size_t i) {
    return cells.offsets[std::size_t{sites[i]} + 1];
  });
  mesh.cell_data.push_back(vtp_array<std::int64_t>("site", "Int64", 1, sites.size(),
                                                   [&](std::size_t i) { return sites[i]; }));
  mesh.cell_data.push_back(vtp_array<double>("area", "Float64", 1, sites.size(),
                                             [&](std::size_t i) { return areas[sites[i]]; }));
  write_vtp(file, mesh);
}

}  // namespace rondel::io
