// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_zarr.

#include "io/binary.h"
#include "io/cell_formats.h"
#include "io/triangle_formats.h"
#include "io/zarr_mesh.h"
#include "rondel/diagram.h"
#include "rondel/io.h"
#include "system/job.h"

namespace rondel {
namespace io {
namespace {

constexpr const char* index_type = "uint32";

void write_array(ZarrGroup& group, const ZarrHead& head, std::string_view bytes) {
  ZarrArray array(group, head);
  array.write(bytes);
  array.finish();
}

}  // namespace

void write_zarr_mesh(const std::string& path, const MeshToWrite& mesh, const ZarrContent& content) {
  const Triangulation& t = mesh.triangulation;
  ZarrGroup group(path);
  write_array(group, zarr_faces(index_type, t.num_faces()), NumberBytes(t.faces()));
  if (t.num_ghost_faces() > 0) {
    write_array(group, zarr_ghost_faces(index_type, t.num_ghost_faces()),
                NumberBytes(t.ghost_faces()));
  }
  if (content.neighbors)
    write_array(group, zarr_neighbors(index_type, t.num_faces()), NumberBytes(t.neighbors()));
  if (content.areas) {
    const std::vector<double> all = areas(t, mesh.execution);
    write_array(group, zarr_areas(t.num_sites()), NumberBytes(all));
  }
  if (content.duplicates) {
    write_array(group, zarr_duplicates(index_type, t.duplicates().size()),
                NumberBytes(t.duplicates()));
  }
  ZarrNodes nodes(group, t.num_sites(), t.sphere().center);
  nodes.add(mesh.table.sites, mesh.table.positions, mesh.execution.threads);
  nodes.finish();
  commit_zarr_mesh(group, content.neighbors);
}

void write_zarr_mesh(const std::string& path, const MeshToWrite& mesh) {
  write_zarr_mesh(path, mesh, {});
}

}  // namespace io

void write_zarr(const std::string& path, const SiteTable& table, const Triangulation& triangulation,
                const ZarrContent& content, const Execution& execution) {
  const system::Call call(execution);
  io::require_sites(table, triangulation);
  io::write_zarr_mesh(path, {table, triangulation, execution}, content);
}

}  // namespace rondel
