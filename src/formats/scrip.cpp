// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grid files of SCRIP (Jones, SCRIP user's guide, 1998, section 2.2.1): the corners of each cell
// (`grid_corner_lon`, `grid_corner_lat`), the centers (`grid_center_lon`, `grid_center_lat`),
// `grid_imask`, which is 0 for masked cells, and `grid_dims`, the fastest dimension first. Weights
// of SCRIP are in weights_scrip.cpp.
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "formats/mesh_file.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/number.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using io::NetcdfReader;

// Defines the corners of each cell; the last one is repeated to the end of the row.
void define_corners(MeshFile& file, const char* name, std::vector<std::size_t> dimensions,
                    const CellCorners& corners, double (*coordinate)(const Point&)) {
  const mesh::VoronoiMesh& arrays = file.arrays();
  const std::size_t room = arrays.max_edges();
  file.numbers(name, std::move(dimensions), texts_of_degrees, arrays.num_cells(), room,
               [&arrays, &corners, coordinate, room](std::size_t cell, double* out) {
                 double* const end = out + room;
                 double last = 0;
                 corners.visit(
                     cell, [&](Index v) { *out++ = last = coordinate(arrays.vertex_points[v]); });
                 std::fill(out, end, last);
               });
}

}  // namespace

std::optional<MeshContent> read_scrip_grid(const NetcdfReader& file, const std::string& name) {
  const io::VariableInFile* const lon = file.find("grid_corner_lon");
  const io::VariableInFile* const lat = file.find("grid_corner_lat");
  if (lon == nullptr || lat == nullptr || !is_meant(file, name, *lon)) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "SCRIP";
  (void)require_rank(*lon, 2);
  const MeshCoordinates centers = {file.find("grid_center_lon"), file.find("grid_center_lat")};
  // Some files have the corners as (corners, cells); the dimension of the centers tells.
  const bool is_transposed = centers.lon != nullptr && centers.lon->dimensions.size() == 1 &&
                             centers.lon->dimensions[0] == lon->dimensions[1] &&
                             centers.lon->dimensions[0] != lon->dimensions[0];
  const std::uint64_t num_cells = lon->shape[is_transposed ? 1 : 0];
  if (num_cells == 0 || lon->num_values >= no_index) {
    throw BadValue("variable " + io::in_quotes(lon->name) + " has " +
                   std::to_string(lon->num_values) + " values for " + std::to_string(num_cells) +
                   " cells");
  }
  take_nodes(file, {lon, lat}, centers, UsualUnits::degrees, mesh);
  const std::uint64_t corners_per_cell = lon->num_values / num_cells;
  if (is_transposed) {
    std::vector<LonLat> nodes;
    for (std::uint64_t i = 0; i < num_cells; ++i) {
      for (std::uint64_t k = 0; k < corners_per_cell; ++k)
        nodes.push_back(mesh.nodes[k * num_cells + i]);
    }
    mesh.nodes = std::move(nodes);
  }
  if (const io::VariableInFile* const dims = file.find("grid_dims")) {
    mesh.shape = io::shape_of_grid(file, *dims, num_cells);
  }
  // Only lists of cells have cells with fewer corners than others; cells of a grid have four.
  end_cells_of_nodes(corners_per_cell, !has_rows(mesh.shape), mesh);
  take_mask(file, "grid_imask", num_cells, MaskedBy::zero, mesh);
  take_centers(file, centers, {lon, lat}, UsualUnits::degrees, mesh);
  return mesh;
}

// SCRIP has a row of corners for each cell, so that a corner is stored once for each of its cells.
void define_scrip(MeshFile& file, const CellCorners& corners) {
  const mesh::VoronoiMesh& arrays = file.arrays();
  const std::size_t size = arrays.num_cells();
  const std::size_t cells = file.dimension("grid_size", size);
  const std::size_t max_corners = file.dimension("grid_corners", arrays.max_edges());
  const std::size_t rank = file.dimension("grid_rank", 1);
  file.netcdf().add_attribute("title", "Voronoi cells");
  file.indices("grid_dims", rank, {}, 1, [size](std::size_t) { return size; });
  file.numbers("grid_center_lat", cells, texts_of_degrees, size,
               [&arrays](std::size_t i) { return latitude_deg_of(arrays.cell_points[i]); });
  file.numbers("grid_center_lon", cells, texts_of_degrees, size,
               [&arrays](std::size_t i) { return longitude_deg_of(arrays.cell_points[i]); });
  file.indices("grid_imask", cells, {{"units", "unitless"}}, size, [](std::size_t) { return 1; });
  define_corners(file, "grid_corner_lat", {cells, max_corners}, corners, latitude_deg_of);
  define_corners(file, "grid_corner_lon", {cells, max_corners}, corners, longitude_deg_of);
  file.numbers("grid_area", cells, texts_of_areas, size,
               [&arrays](std::size_t i) { return area_at_one(arrays, i); });
}

}  // namespace rondel::formats
