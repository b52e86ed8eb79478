// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads and writes Wavefront's .obj: lines "v x y z" and "f a b c"; indices count from 1.
#include "io/mesh_text.h"
#include "io/number.h"
#include "io/text_lines.h"
#include "io/triangle_formats.h"

namespace rondel::io {
namespace {

// Reads a corner, which is v, v/vt, v//vn or v/vt/vn; a negative v counts back from the last vertex
// so far.
Index read_corner(std::string_view word, std::int64_t num_vertices) {
  const std::int64_t number = parse_integer(word.substr(0, word.find('/')), "index");
  if (number == 0) throw BadValue("index 0 where indices count from 1");
  return checked_index(number > 0 ? number - 1 : num_vertices + number);
}

// Reads the triangles of all lines; other lines than v and f are skipped.
std::vector<Triple> read_lines(TextLines& lines) {
  std::vector<Triple> triangles;
  std::int64_t num_vertices = 0;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v") ++num_vertices;
    if (words[0] != "f") continue;
    if (words.size() != 4) {
      throw BadValue("a face with " + std::to_string(words.size() - 1) +
                     " corners where a triangle is needed");
    }
    triangles.push_back({read_corner(words[1], num_vertices), read_corner(words[2], num_vertices),
                         read_corner(words[3], num_vertices)});
  }
  return triangles;
}

}  // namespace

std::vector<Triple> read_obj(std::string_view bytes) {
  TextLines lines(bytes);
  return at_line_of(lines, [&] { return read_lines(lines); });
}

void write_obj(AtomicFile& file, const MeshToWrite& mesh) {
  write_site_lines(file, mesh.table.sites, mesh.execution.threads, "v ", ' ');
  write_face_lines(file, mesh, "f ", 1);
}

}  // namespace rondel::io
