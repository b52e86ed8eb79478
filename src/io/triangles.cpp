// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_triangles() and write_triangles() pick the format and do what all formats have in common.
#include <algorithm>
#include <array>
#include <string>

#include "io/atomic_file.h"
#include "io/bad_value.h"
#include "io/cell_formats.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/parallel_write.h"
#include "io/triangle_formats.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "system/job.h"

namespace rondel {
namespace {

// A format of triangles and how it is read.
struct TriangleReader {
  std::string_view ending;
  std::vector<Triple> (*read)(std::string_view);
  // Throws BadValue for what can be refused given the head of a file and its size.
  void (*check)(std::string_view, std::uint64_t) = nullptr;
};
constexpr std::array<TriangleReader, 5> triangle_readers = {
    {{".npy", &io::read_npy, &io::check_npy},
     {".off", &io::read_off},
     {".ply", &io::read_ply},
     {".obj", &io::read_obj},
     {".vtp", &io::read_vtp}}};

using TriangleWriter = io::Writer<io::MeshToWrite>;
constexpr std::array<TriangleWriter, 7> triangle_writers = {{{".npy", &io::write_npy},
                                                             {".off", &io::write_off},
                                                             {".ply", &io::write_ply},
                                                             {".obj", &io::write_obj},
                                                             {".stl", &io::write_stl},
                                                             {".vtp", &io::write_vtp_triangles},
                                                             {".geojson", &io::write_geojson}}};

}  // namespace

void io::MeshToWrite::write_faces(
    AtomicFile& file, const std::function<void(std::string&, Index, Index)>& append) const {
  const std::size_t num_faces = faces.size();
  write_in_parallel(
      file, execution.threads, num_faces, items_per_piece,
      [&](std::string& text, std::size_t begin, std::size_t end) {
        append(text, static_cast<Index>(begin), static_cast<Index>(end));
      },
      [&](std::size_t done) { system::announce(execution, "write", done, num_faces); });
}

std::vector<Triple> read_triangles(const FileName& file) {
  const system::ArithmeticScope arithmetic;
  io::FileBytes bytes(file);
  const TriangleReader& reader =
      io::require_format<TriangleReader>(triangle_readers, file, "triangles are read from");
  if (bytes.head().empty()) throw FileError(bytes.name() + ": the file is empty");
  return io::in_file(bytes.name(), [&] {
    if (reader.check != nullptr) reader.check(bytes.head(), bytes.claimed_size());
    return reader.read(bytes.text());
  });
}

bool can_write_triangles(const FileName& file) {
  return io::find_format<TriangleWriter>(triangle_writers, file) != nullptr;
}

void write_triangles(const FileName& output, const SiteTable& table,
                     const Triangulation& triangulation, const Execution& execution,
                     std::vector<std::string>* remarks) {
  const system::Call call(execution);
  io::require_sites(table, triangulation);
  const io::MeshToWrite mesh = {
      table,     triangulation, triangulation.faces(), triangulation.ghost_faces(), {},
      execution, remarks};
  io::write_whole<io::MeshToWrite>(triangle_writers, output, "triangles are written as", mesh);
}

void write_some_triangles(const FileName& output, const SiteTable& table,
                          const Triangulation& triangulation, std::span<const Index> faces,
                          const Execution& execution, std::vector<std::string>* remarks) {
  const system::Call call(execution);
  io::require_sites(table, triangulation);
  std::vector<Triple> corners;
  std::vector<Index> ghosts;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] >= triangulation.num_faces()) {
      throw InvalidInput("face " + std::to_string(faces[i]) + " does not exist; there are " +
                             std::to_string(triangulation.num_faces()) + " faces",
                         i);
    }
    if (triangulation.is_ghost(faces[i])) ghosts.push_back(static_cast<Index>(i));
    corners.push_back(triangulation.faces()[faces[i]]);
  }
  const io::MeshToWrite mesh = {table, triangulation, corners, ghosts, faces, execution, remarks};
  io::write_whole<io::MeshToWrite>(triangle_writers, output, "triangles are written as", mesh);
}

}  // namespace rondel
