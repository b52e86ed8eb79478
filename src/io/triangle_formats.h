// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers and writers of triangles, one function a format and direction.
//
// in    the bytes of a file; or a triangulation with its sites
// out   triangles; or a file
// index corners are indices of sites in the order of the input, from 0 on
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "rondel/io.h"
#include "system/job.h"

namespace rondel::io {

// The argument of the writers: all sites are vertices of the file, in the order of the input.
struct MeshToWrite {
  const SiteTable& table;
  const Triangulation& triangulation;
  std::span<const Triple> faces;
  std::span<const Index> ghost_faces;  // of `faces`, ascending
  std::span<const Index> chosen;       // the faces of the triangulation, if these are not all
  const Execution& execution;
  std::vector<std::string>* remarks = nullptr;  // gets what the format does not hold, unless null

  [[nodiscard]] bool is_ghost(Index face) const {
    return std::ranges::binary_search(ghost_faces, face);
  }
  // Writes the texts of the faces begin ... end - 1, like write_in_parallel(), and reports the
  // progress.
  void write_faces(
      AtomicFile& file,
      const std::function<void(std::string& text, Index begin, Index end)>& append) const;
};

// Each of these writes one format, in which the triangulation is a single file.
void write_npy(AtomicFile& file, const MeshToWrite& mesh);
void write_off(AtomicFile& file, const MeshToWrite& mesh);
void write_ply(AtomicFile& file, const MeshToWrite& mesh);
void write_obj(AtomicFile& file, const MeshToWrite& mesh);
void write_stl(AtomicFile& file, const MeshToWrite& mesh);
void write_vtp_triangles(AtomicFile& file, const MeshToWrite& mesh);
void write_geojson(AtomicFile& file, const MeshToWrite& mesh);

// Each of these reads the triangles of `bytes`, the content of a file. Indices count from 0 and may
// be too large for the sites. They throw BadValue if the content is not as the format says.
std::vector<Triple> read_npy(std::string_view bytes);
std::vector<Triple> read_off(std::string_view bytes);
std::vector<Triple> read_ply(std::string_view bytes);
std::vector<Triple> read_obj(std::string_view bytes);
std::vector<Triple> read_vtp(std::string_view bytes);

// Throws BadValue if read_npy() would refuse the head of a file of `file_size` bytes (0: not
// known).
void check_npy(std::string_view head, std::uint64_t file_size);

}  // namespace rondel::io
