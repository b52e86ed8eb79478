// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads and writes Geomview's .off: "OFF", the numbers of vertices, faces and edges, the vertices,
// the faces.
#include <algorithm>

#include "io/mesh_text.h"
#include "io/number.h"
#include "io/text_lines.h"
#include "io/triangle_formats.h"

namespace rondel::io {
namespace {

// Returns a number of elements from the line of counts.
std::uint64_t count(std::string_view word, std::string_view what) {
  const std::int64_t value = parse_integer(word, what);
  if (value < 0) throw BadValue("negative " + std::string(what));
  return static_cast<std::uint64_t>(value);
}

// Goes to the next line, which is element i of n. Throws BadValue if the file ends before it.
void require_line(TextLines& lines, std::uint64_t i, std::uint64_t n, std::string_view what) {
  if (lines.next()) return;
  throw BadValue("the file ends after " + std::to_string(i) + " of " + std::to_string(n) + " " +
                 std::string(what));
}

// Reads a face, which must be a triangle.
Triple read_face(const TextLines& lines) {
  const auto& words = lines.words();
  const std::int64_t size = parse_integer(words[0], "the number of corners");
  if (size != 3) {
    throw BadValue("a face with " + std::to_string(size) + " corners where a triangle is needed");
  }
  if (words.size() < 4) throw BadValue("a face without its three indices");
  const auto index = [&](std::size_t i) { return checked_index(parse_integer(words[i], "index")); };
  return {index(1), index(2), index(3)};
}

std::vector<Triple> read_lines(TextLines& lines, std::string_view bytes) {
  if (!lines.next() || lines.words()[0] != "OFF") throw BadValue("not an OFF file");
  std::size_t first = 1;  // the counts may stand behind the word OFF or on a line of their own
  if (lines.words().size() == 1) {
    require_line(lines, 0, 1, "lines of counts");
    first = 0;
  }
  if (lines.words().size() < first + 2) throw BadValue("no numbers of vertices and faces");
  const std::uint64_t num_vertices = count(lines.words()[first], "number of vertices");
  const std::uint64_t num_faces = count(lines.words()[first + 1], "number of faces");
  for (std::uint64_t i = 0; i < num_vertices; ++i) require_line(lines, i, num_vertices, "vertices");
  std::vector<Triple> triangles;
  triangles.reserve(std::min<std::uint64_t>(num_faces, bytes.size() / 8));  // "3 0 1 2\n"
  for (std::uint64_t i = 0; i < num_faces; ++i) {
    require_line(lines, i, num_faces, "faces");
    triangles.push_back(read_face(lines));
  }
  return triangles;
}

}  // namespace

std::vector<Triple> read_off(std::string_view bytes) {
  TextLines lines(bytes);
  return at_line_of(lines, [&] { return read_lines(lines, bytes); });
}

void write_off(AtomicFile& file, const MeshToWrite& mesh) {
  // Readers ignore the number of edges; on a closed surface it is 3/2 times the number of faces.
  const std::size_t num_faces = mesh.faces.size();
  file.write("OFF\n" + std::to_string(mesh.table.sites.size()) + " " + std::to_string(num_faces) +
             " " + std::to_string(3 * num_faces / 2) + "\n");
  write_site_lines(file, mesh.table.sites, mesh.execution.threads, "", ' ');
  write_face_lines(file, mesh, "3 ", 0);
}

}  // namespace rondel::io
