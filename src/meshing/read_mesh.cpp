// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes of other formats: made again of the centers of their cells, and held against the cells' corners.

#include "meshing/read_mesh.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "exact/vector.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_files.h"
#include "rondel/mesh_io.h"
#include "system/job.h"

namespace rondel::mesh {
namespace {

// Of the spacing: how far a corner of the file may be from that of the mesh. Files have single precision, too, and
// programs find circumcenters in the plane.
constexpr double corner_tolerance = 1e-3;

bool has_corner(const MeshArrays& arrays, std::size_t cell, const Point& corner,
                double square_distance) {
  for (std::uint64_t at = arrays.offsets[cell]; at < arrays.offsets[cell + 1]; ++at) {
    const Point away =
        (1 / arrays.radius) * arrays.vertex_points[arrays.vertices_on_cell[at]] - corner;
    if (dot(away, away) <= square_distance) return true;
  }
  return false;
}

void require_cells(const MeshArrays& arrays, const CellTable& table) {
  const CellRings& cells = table.cells;
  const auto refuse = [&](std::size_t cell, const std::string& why) {
    throw FileError(table.name + ": cell " + std::to_string(cell) + ' ' + why);
  };
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    if (cells.cells[i + 1] - cells.cells[i] != 1) refuse(i, "has not one ring of corners");
    const double distance = corner_tolerance * spacing_of(arrays.cell_areas[i]) / arrays.radius;
    const std::uint64_t ring = cells.cells[i];
    for (std::uint64_t k = cells.rings[ring]; k < cells.rings[ring + 1]; ++k) {
      if (has_corner(arrays, i, cells.points[cells.corners[k]], distance * distance)) continue;
      refuse(i, "is not the Voronoi cell of its center");
    }
  }
}

MeshArrays mesh_of_centers(const CellTable& table, const MeshOptions& options,
                           const Execution& execution) {
  if (table.grid) throw FileError(table.name + ": a grid of longitudes and latitudes is no mesh");
  if (table.centers.size() != table.num_cells()) {
    throw FileError(table.name + ": " + table.convention +
                    " without centers of cells, of which the mesh is made");
  }
  try {
    MeshArrays result =
        arrays(delaunay(unit_vectors(table.centers), {}, execution), options, execution);
    require_cells(result, table);
    return result;
  } catch (const InvalidInput& error) {
    throw FileError(table.name + ": cell " + std::to_string(error.index()) + ": " + error.what());
  }
}

}  // namespace

MeshArrays read_mesh(const FileName& file, const MeshOptions& options, const Execution& execution) {
  const system::Call call(execution);
  constexpr std::string_view netcdf = ".nc";
  if (io::ending(file) != netcdf) {
    io::throw_unknown_ending(file, "meshes are read from", {&netcdf, 1});
  }
  {
    io::FileBytes bytes(file.path, true);
    std::optional<MeshArrays> arrays = io::in_file(bytes.name(), [&] {
      const io::NetcdfReader reader(bytes);
      return reader.find("cellsOnEdge") != nullptr && reader.find("verticesOnEdge") != nullptr
                 ? std::optional(meshing::read_mpas(reader, execution))
                 : std::nullopt;
    });
    if (arrays) return std::move(*arrays);
  }
  return mesh_of_centers(read_cells(file), options, execution);
}

}  // namespace rondel::mesh
