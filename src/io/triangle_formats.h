// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The formats of triangles, one function each way.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "rondel/io.h"
#include "system/job.h"

namespace rondel::io {

// What the writers write: corners are input indices, and vertices are all sites in input order.
struct MeshToWrite {
  const SiteTable& table;
  const Triangulation& triangulation;
  const Execution& execution;

  // Writes the texts of the faces from `begin` to `end`, as write_in_parallel does, and reports how
  // far it is.
  void write_faces(
      AtomicFile& file,
      const std::function<void(std::string& text, Index begin, Index end)>& append) const;
};

void write_npy(AtomicFile& file, const MeshToWrite& mesh);
void write_off(AtomicFile& file, const MeshToWrite& mesh);
void write_ply(AtomicFile& file, const MeshToWrite& mesh);
void write_obj(AtomicFile& file, const MeshToWrite& mesh);
void write_stl(AtomicFile& file, const MeshToWrite& mesh);
void write_vtp_triangles(AtomicFile& file, const MeshToWrite& mesh);
void write_geojson(AtomicFile& file, const MeshToWrite& mesh);

// Formats of several files.
void write_pvtp(const std::string& path, const MeshToWrite& mesh);
void write_zarr_mesh(const std::string& path, const MeshToWrite& mesh);

// Each reads the triangles of `bytes`, the content of a file. Indices count from 0 and may be too
// large for the sites. Throws BadValue.
std::vector<Triple> read_npy(std::string_view bytes);
std::vector<Triple> read_off(std::string_view bytes);
std::vector<Triple> read_ply(std::string_view bytes);
std::vector<Triple> read_obj(std::string_view bytes);
std::vector<Triple> read_vtp(std::string_view bytes);

// Throws BadValue if the head of a file of `file_size` bytes, or of a size not known (0), claims
// what read_npy would refuse.
void check_npy(std::string_view head, std::uint64_t file_size);

}  // namespace rondel::io
