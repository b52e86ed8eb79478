// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes cells for remapping: SCRIP's grid file and ESMF's unstructured mesh file
// (https://earthsystemmodeling.org/docs/release/latest/ESMF_refdoc/node3.html).

#include <algorithm>
#include <limits>

#include "meshing/mesh_file.h"

namespace rondel::meshing {
namespace {

constexpr std::int32_t esmf_none = -1;

constexpr MeshFile::Texts degrees = {{"units", "degrees"}};
constexpr MeshFile::Texts square_radians = {{"units", "radians^2"}};

// Returns the area of a cell on the unit sphere.
double area_at_one(const mesh::MeshArrays& arrays, std::size_t cell) {
  return arrays.cell_areas[cell] / (arrays.radius * arrays.radius);
}

// Defines the corners of each cell; the last one is repeated to the end of the row.
void define_corners(MeshFile& file, const char* name, std::vector<std::size_t> dimensions,
                    const CellCorners& corners, double (*coordinate)(const Point&)) {
  const mesh::MeshArrays& arrays = file.arrays();
  const std::size_t room = arrays.max_edges();
  file.numbers(name, std::move(dimensions), degrees, arrays.num_cells(), room,
               [&arrays, &corners, coordinate, room](std::size_t cell, double* out) {
                 double* const end = out + room;
                 double last = 0;
                 corners.visit(
                     cell, [&](Index v) { *out++ = last = coordinate(arrays.vertex_points[v]); });
                 std::fill(out, end, last);
               });
}

// Defines a variable of longitudes and latitudes in degrees, a pair a row.
void define_pairs_of_degrees(MeshFile& file, const char* name, std::vector<std::size_t> dimensions,
                             const std::vector<Point>& points) {
  file.numbers(name, std::move(dimensions), degrees, points.size(), 2,
               [&points](std::size_t i, double* out) {
                 out[0] = longitude_deg_of(points[i]);
                 out[1] = latitude_deg_of(points[i]);
               });
}

// ESMF stores counts as bytes if these suffice.
template <typename T>
void define_counts(MeshFile& file, io::NetcdfType type, std::size_t cells,
                   const CellCorners& corners) {
  file.add<T>(MeshFile::variable("numElementConn", type, {cells},
                                 {{"long_name", "Number of nodes per element"}}),
              file.arrays().num_cells(), 1,
              [&corners](std::size_t cell, T* out) { *out = static_cast<T>(corners.count(cell)); });
}

}  // namespace

// SCRIP has a row of corners for each cell, so that a corner is stored once for each of its cells.
void define_scrip(MeshFile& file, const CellCorners& corners) {
  const mesh::MeshArrays& arrays = file.arrays();
  const std::size_t size = arrays.num_cells();
  const std::size_t cells = file.dimension("grid_size", size);
  const std::size_t max_corners = file.dimension("grid_corners", arrays.max_edges());
  const std::size_t rank = file.dimension("grid_rank", 1);
  file.netcdf().add_attribute("title", "Voronoi cells");
  file.indices("grid_dims", rank, {}, 1, [size](std::size_t) { return size; });
  file.numbers("grid_center_lat", cells, degrees, size,
               [&arrays](std::size_t i) { return latitude_deg_of(arrays.cell_points[i]); });
  file.numbers("grid_center_lon", cells, degrees, size,
               [&arrays](std::size_t i) { return longitude_deg_of(arrays.cell_points[i]); });
  file.indices("grid_imask", cells, {{"units", "unitless"}}, size, [](std::size_t) { return 1; });
  define_corners(file, "grid_corner_lat", {cells, max_corners}, corners, latitude_deg_of);
  define_corners(file, "grid_corner_lon", {cells, max_corners}, corners, longitude_deg_of);
  file.numbers("grid_area", cells, square_radians, size,
               [&arrays](std::size_t i) { return area_at_one(arrays, i); });
}

// ESMF has a list of nodes, to which the cells refer by numbers from 1.
void define_esmf(MeshFile& file, const CellCorners& corners) {
  const mesh::MeshArrays& arrays = file.arrays();
  const std::size_t size = arrays.num_cells();
  const std::size_t room = arrays.max_edges();
  const std::size_t nodes = file.dimension("nodeCount", arrays.num_vertices());
  const std::size_t cells = file.dimension("elementCount", size);
  const std::size_t max_corners = file.dimension("maxNodePElement", room);
  const std::size_t dimension = file.dimension("coordDim", 2);
  file.netcdf().add_attribute("gridType", "unstructured");
  file.netcdf().add_attribute("version", "0.9");
  define_pairs_of_degrees(file, "nodeCoords", {nodes, dimension}, arrays.vertex_points);
  auto connections =
      MeshFile::variable("elementConn", io::NetcdfType::int32, {cells, max_corners},
                         {{"long_name", "Node indices that define the element connectivity"}});
  MeshFile::set(connections, "_FillValue", esmf_none);
  MeshFile::set(connections, "start_index", 1);
  file.add<std::int32_t>(
      std::move(connections), size, room, [&corners, room](std::size_t cell, std::int32_t* out) {
        std::fill_n(out, room, esmf_none);
        corners.visit(cell, [&](Index v) { *out++ = static_cast<std::int32_t>(v + 1); });
      });
  if (room <= std::numeric_limits<std::int8_t>::max()) {
    define_counts<std::int8_t>(file, io::NetcdfType::int8, cells, corners);
  } else {
    define_counts<std::int32_t>(file, io::NetcdfType::int32, cells, corners);
  }
  define_pairs_of_degrees(file, "centerCoords", {cells, dimension}, arrays.cell_points);
  file.numbers("elementArea", cells, square_radians, size,
               [&arrays](std::size_t i) { return area_at_one(arrays, i); });
  file.indices("elementMask", cells, {{"units", "unitless"}}, size, [](std::size_t) { return 1; });
}

}  // namespace rondel::meshing
