// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_text.h"

#include <string>

#include "io/number.h"
#include "io/parallel_write.h"

namespace rondel::io {

void write_vertex_lines(AtomicFile& file, const MeshToWrite& mesh, std::string_view prefix) {
  const std::span<const Point> sites = mesh.table.sites;
  write_in_parallel(file, mesh.execution.threads, sites.size(), items_per_piece,
                    [&](std::string& text, std::size_t begin, std::size_t end) {
                      for (const Point& site : sites.subspan(begin, end - begin)) {
                        text += prefix;
                        append_number(text, site.x);
                        text += ' ';
                        append_number(text, site.y);
                        text += ' ';
                        append_number(text, site.z);
                        text += '\n';
                      }
                    });
}

void write_face_lines(AtomicFile& file, const MeshToWrite& mesh, std::string_view prefix,
                      Index base) {
  mesh.write_faces(file, [&](std::string& text, Index face) {
    text += prefix;
    for (const Index corner : mesh.triangulation.faces()[face]) {
      append_integer(text, corner + base);
      text += ' ';
    }
    text.back() = '\n';
  });
}

}  // namespace rondel::io
