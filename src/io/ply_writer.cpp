// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes Stanford's .ply: binary, little-endian, with coordinates in double precision.
#include <array>

#include "io/binary.h"
#include "io/triangle_formats.h"

namespace rondel::io {

void write_ply(AtomicFile& file, const MeshToWrite& mesh) {
  const std::span<const Point> sites = mesh.table.sites;
  file.write("ply\nformat binary_little_endian 1.0\ncomment Rondel\nelement vertex " +
             std::to_string(sites.size()) +
             "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
             std::to_string(mesh.faces.size()) +
             "\nproperty list uchar int vertex_indices\nend_header\n");
  file.write(NumberBytes(sites));
  // Most readers expect a signed index; it suffices, as there are fewer than 2^30 sites.
  static_assert(max_sites < (std::size_t{1} << 30U));
  mesh.write_faces(file, [&](std::string& bytes, Index begin, Index end) {
    for (const Triple& face : mesh.faces.subspan(begin, end - begin)) {
      std::array<char, 1 + sizeof(Triple)> record = {3};
      char* next = record.data() + 1;
      for (const Index corner : face) next = store(corner, next);
      bytes.append(record.data(), record.size());
    }
  });
}

}  // namespace rondel::io
