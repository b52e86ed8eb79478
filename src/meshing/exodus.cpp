// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exodus II (https://sandialabs.github.io/seacas-docs/exodusII-new.pdf): the cells are elements of
// a shell on the unit sphere, in one block for each number of corners. Numbers start at 1.

#include <algorithm>
#include <array>
#include <string>

#include "meshing/mesh_file.h"
#include "rondel/version.h"

namespace rondel::meshing {
namespace {

// The lengths of the buffers into which the Exodus library reads.
constexpr std::size_t exodus_name_length = 33;
constexpr std::size_t exodus_line_length = 81;

// Adds the attributes by which the Exodus library recognizes the format.
void define_exodus_attributes(io::NetcdfWriter& out) {
  out.add_attribute({"api_version", io::NetcdfType::float32, "", {8.0}});
  out.add_attribute({"version", io::NetcdfType::float32, "", {8.0}});
  out.add_attribute({"floating_point_word_size", io::NetcdfType::int32, "", {8}});
  out.add_attribute({"file_size", io::NetcdfType::int32, "", {0}});
  out.add_attribute("title", std::string("Rondel ") + version + ": Voronoi cells");
}

// Defines one variable with all x, then all y, then all z. With a file_size of 1 the format has
// three variables, which TempestRemap does not read.
void define_coordinates(MeshFile& file, std::size_t axes, std::size_t nodes) {
  const mesh::MeshArrays& arrays = file.arrays();
  const std::size_t size = arrays.num_vertices();
  file.numbers("coord", {axes, nodes}, {}, 3 * size, 1,
               [&arrays, size](std::size_t i, double* out) {
                 constexpr std::array coordinates = {&Point::x, &Point::y, &Point::z};
                 *out = arrays.vertex_points[i % size].*coordinates[i / size] / arrays.radius;
               });
}

// Returns the name that TempestRemap gives to an element type.
std::string element_type(std::size_t corners) { return "SHELL" + std::to_string(corners); }

}  // namespace

// Groups the cells by their number of corners with a counting sort.
CellBlocks blocks_of(const mesh::MeshArrays& arrays, const CellCorners& corners) {
  std::vector<std::size_t> sizes(arrays.max_edges() + 1, 0);
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) ++sizes[corners.count(i)];
  CellBlocks blocks;
  blocks.cells.resize(arrays.num_cells());
  std::vector<std::size_t> next(sizes.size(), 0);
  std::size_t begin = 0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    next[k] = begin;
    if (sizes[k] == 0) continue;
    blocks.begins.push_back(begin);
    blocks.corners.push_back(k);
    begin += sizes[k];
  }
  blocks.begins.push_back(begin);
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) {
    blocks.cells[next[corners.count(i)]++] = static_cast<Index>(i);
  }
  return blocks;
}

// The order of the variables is that in which they are written.
void define_exodus(MeshFile& file, const CellCorners& corners, const CellBlocks& blocks) {
  const mesh::MeshArrays& arrays = file.arrays();
  const std::size_t num_blocks = blocks.corners.size();
  const std::size_t names = file.dimension("len_string", exodus_name_length);
  file.dimension("len_line", exodus_line_length);
  file.dimension("four", 4);
  const std::size_t time = file.dimension("time_step", 0);
  const std::size_t axes = file.dimension("num_dim", 3);
  const std::size_t nodes = file.dimension("num_nodes", arrays.num_vertices());
  const std::size_t elements = file.dimension("num_elem", arrays.num_cells());
  const std::size_t blocks_dimension = file.dimension("num_el_blk", num_blocks);
  define_exodus_attributes(file.netcdf());
  file.indices("eb_status", blocks_dimension, {}, num_blocks, [](std::size_t) { return 1; });
  file.indices("eb_prop1", blocks_dimension, {{"name", "ID"}}, num_blocks,
               [](std::size_t b) { return b + 1; });
  define_coordinates(file, axes, nodes);
  file.add<char>(MeshFile::variable("coor_names", io::NetcdfType::text, {axes, names}, {}), 3,
                 exodus_name_length,
                 [](std::size_t axis, char* out) { *out = static_cast<char>('x' + axis); });
  file.indices("elem_num_map", elements, {}, blocks.cells.size(),
               [&blocks](std::size_t i) { return blocks.cells[i] + 1; });
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const std::string number = std::to_string(b + 1);
    const std::size_t begin = blocks.begins[b];
    const std::size_t of_each = blocks.corners[b];
    const std::size_t in_block =
        file.dimension(("num_el_in_blk" + number).c_str(), blocks.begins[b + 1] - begin);
    const std::size_t per_element = file.dimension(("num_nod_per_el" + number).c_str(), of_each);
    file.indices(("connect" + number).c_str(), {in_block, per_element},
                 {{"elem_type", element_type(of_each).c_str()}}, blocks.begins[b + 1] - begin,
                 of_each, [&corners, &blocks, begin](std::size_t i, std::int32_t* out) {
                   corners.visit(blocks.cells[begin + i],
                                 [&](Index v) { *out++ = static_cast<std::int32_t>(v + 1); });
                 });
    // The Exodus library reads numbers of cells from elem_num_map, TempestRemap from this variable.
    file.indices(("global_id" + number).c_str(), in_block, {}, blocks.begins[b + 1] - begin,
                 [&blocks, begin](std::size_t i) { return blocks.cells[begin + i] + 1; });
  }
  // Record variables come last.
  file.numbers("time_whole", time, {}, 0, [](std::size_t) { return 0.0; });
}

}  // namespace rondel::meshing
