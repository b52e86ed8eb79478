// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/binary.h"
#include "io/triangle_formats.h"
#include "io/vtp_file.h"

namespace rondel::io {

// Points are the sites, polygons the faces; the cell data "ghost" is 1 for ghost faces.
void write_vtp_triangles(AtomicFile& file, const MeshToWrite& mesh) {
  const std::span<const Point> sites = mesh.table.sites;
  const std::span<const Triple> faces = mesh.triangulation.faces();
  const std::size_t m = faces.size();
  VtpMesh vtp;
  vtp.num_points = sites.size();
  vtp.num_polys = m;
  static_assert(sizeof(Point) == 3 * sizeof(double));
  vtp.points = {"Points", "Float64", 3, sites.size_bytes(), [=](AtomicFile& out) {
                  out.write({reinterpret_cast<const char*>(sites.data()), sites.size_bytes()});
                }};
  vtp.connectivity = {"connectivity", "Int64", 1, 3 * m * sizeof(std::int64_t),
                      [=, &mesh](AtomicFile& out) {
                        write_values<std::int64_t>(out, 3 * m, [&](std::size_t i) {
                          const std::size_t f = i / 3;
                          if (i % 196608 == 0) {
                            system::announce(mesh.execution, "write",
                                             static_cast<double>(f) / static_cast<double>(m));
                          }
                          return faces[f][i % 3];
                        });
                      }};
  vtp.offsets = {"offsets", "Int64", 1, m * sizeof(std::int64_t), [=](AtomicFile& out) {
                   write_values<std::int64_t>(out, m, [](std::size_t i) { return 3 * (i + 1); });
                 }};
  vtp.cell_data = {{"ghost", "UInt8", 1, m, [=, &mesh](AtomicFile& out) {
                      write_values<std::uint8_t>(out, m, [&](std::size_t i) {
                        return mesh.triangulation.is_ghost(static_cast<Index>(i)) ? 1 : 0;
                      });
                    }}};
  write_vtp(file, vtp);
}

}  // namespace rondel::io
