// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_text.h"

#include "io/number.h"
#include "io/parallel_write.h"

namespace rondel::io {

void append_row(std::string& text, std::initializer_list<double> values, char delimiter) {
  for (const double value : values) {
    append_number(text, value);
    text += delimiter;
  }
  text.back() = '\n';
}

void write_site_lines(AtomicFile& file, std::span<const Point> sites, unsigned threads,
                      std::string_view prefix, char delimiter) {
  write_in_parallel(file, threads, sites.size(), items_per_piece,
                    [&](std::string& text, std::size_t begin, std::size_t end) {
                      for (const Point& site : sites.subspan(begin, end - begin)) {
                        text += prefix;
                        append_row(text, {site.x, site.y, site.z}, delimiter);
                      }
                    });
}

void write_face_lines(AtomicFile& file, const MeshToWrite& mesh, std::string_view prefix,
                      Index base) {
  mesh.write_faces(file, [&](std::string& text, Index begin, Index end) {
    for (const Triple& face : mesh.faces.subspan(begin, end - begin)) {
      text += prefix;
      for (const Index corner : face) {
        append_integer(text, corner + base);
        text += ' ';
      }
      text.back() = '\n';
    }
  });
}

}  // namespace rondel::io
