// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_text.h"

#include <string>

#include "io/number.h"

namespace rondel::io {

void write_vertex_lines(AtomicFile& file, const Mesh& mesh, std::string_view prefix) {
  std::string line;
  for (const Point& site : mesh.table.sites) {
    line = prefix;
    append_number(line, site.x);
    line += ' ';
    append_number(line, site.y);
    line += ' ';
    append_number(line, site.z);
    line += '\n';
    file.write(line);
  }
}

void write_face_lines(AtomicFile& file, const Mesh& mesh, std::string_view prefix, Index base) {
  std::string line;
  std::size_t done = 0;
  for (const Triple& face : mesh.triangulation.faces()) {
    line = prefix;
    for (const Index corner : face) {
      append_integer(line, corner + base);
      line += ' ';
    }
    line.back() = '\n';
    file.write(line);
    mesh.report_progress(++done);
  }
}

}  // namespace rondel::io
