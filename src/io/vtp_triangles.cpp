// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/triangle_formats.h"
#include "io/vtp_file.h"

namespace rondel::io {

// The points are the sites and the polygons the faces; the cell data "ghost" is 1 for ghost faces.
void write_vtp_triangles(AtomicFile& file, const MeshToWrite& mesh) {
  const std::span<const Triple> faces = mesh.faces;
  const std::size_t m = faces.size();
  VtpMesh vtp;
  vtp.num_points = mesh.table.sites.size();
  vtp.num_polys = m;
  vtp.points = vtp_points(mesh.table.sites);
  vtp.connectivity = vtp_array<std::int64_t>("connectivity", 3 * m, [&](std::size_t i) {
    constexpr std::size_t corners_between_reports = 196608;
    if (i % corners_between_reports == 0) {
      system::announce(mesh.execution, "write", i, 3 * m);
    }
    return faces[i / 3][i % 3];
  });
  vtp.offsets = vtp_array<std::int64_t>("offsets", m, [](std::size_t i) { return 3 * (i + 1); });
  vtp.cell_data = {vtp_array<std::uint8_t>(
      "ghost", m, [&](std::size_t i) { return mesh.is_ghost(static_cast<Index>(i)) ? 1 : 0; })};
  write_vtp(file, vtp);
}

}  // namespace rondel::io
