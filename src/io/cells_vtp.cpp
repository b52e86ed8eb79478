// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/cell_formats.h"
#include "io/vtp_file.h"

namespace rondel::io {

// Empty cells have no polygon.
void write_cells_vtp(AtomicFile& file, const CellsToWrite& to_write) {
  const Cells& cells = to_write.diagram.cells;
  const std::vector<double>& areas = to_write.diagram.areas;
  std::vector<Index> sites;  // sites with a ring
  for (std::size_t site = 0; site < cells.rings.size(); ++site) {
    if (!cells.rings[site].empty()) sites.push_back(static_cast<Index>(site));
  }
  VtpMesh mesh;
  mesh.num_points = cells.points.size();
  mesh.num_polys = sites.size();
  mesh.points = vtp_points(cells.points);
  mesh.connectivity = vtp_array<std::int64_t>("connectivity", cells.rings.values.size(),
                                              [&](std::size_t i) { return cells.rings.values[i]; });
  mesh.offsets = vtp_array<std::int64_t>("offsets", sites.size(), [&](std::size_t i) {
    return cells.rings.offsets[std::size_t{sites[i]} + 1];
  });
  mesh.cell_data = {
      vtp_array<std::int64_t>("site", sites.size(), [&](std::size_t i) { return sites[i]; }),
      vtp_array<double>("area", sites.size(), [&](std::size_t i) { return areas[sites[i]]; })};
  write_vtp(file, mesh);
}

}  // namespace rondel::io
