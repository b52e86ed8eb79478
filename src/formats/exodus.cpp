// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exodus II (Schoof and Yarberry, SAND92-2137;
// https://sandialabs.github.io/seacas-docs/exodusII-new.pdf): blocks of elements with the same
// number of corners, at points in space. Cells are written as elements of a shell on the unit
// sphere; numbers start at 1.
//
// The reader joins the blocks `connect1`, `connect2` ... and puts the cells into the order of their
// numbers; the writer groups the cells into blocks by their number of corners.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "formats/cf_reader.h"
#include "formats/mesh_file.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "rondel/delaunay.h"
#include "rondel/version.h"
#include "system/row_assembly.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using io::NetcdfReader;

// Returns the nodes, which are points in space: from `coord` of the shape (3, nodes), or from
// `coordx`, `coordy` and `coordz`. Throws BadValue if the three have different lengths.
std::vector<Point> points_of_exodus(const NetcdfReader& file) {
  std::vector<Point> points;
  if (const io::VariableInFile* const all = file.find("coord")) {
    if (require_rank(*all, 2).shape[0] != 3) {
      throw BadValue(R"(variable "coord" has not three coordinates)");
    }
    const std::vector<double> values = meant_numbers(file, *all);
    const std::size_t n = values.size() / 3;
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back({values[i], values[n + i], values[2 * n + i]});
    }
    return points;
  }
  const std::vector<double> x = meant_numbers(file, file.require("coordx"));
  const std::vector<double> y = meant_numbers(file, file.require("coordy"));
  const std::vector<double> z = meant_numbers(file, file.require("coordz"));
  if (x.size() != y.size() || x.size() != z.size()) {
    throw BadValue(R"(variables "coordx", "coordy" and "coordz" have not as many values)");
  }
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i], z[i]});
  return points;
}

// Returns the elements' numbers, block by block, from the variables `global_id1`, `global_id2` ...
// that TempestRemap writes. The result is empty if a block has no such variable.
std::vector<double> ids_of_blocks(const NetcdfReader& file, std::size_t num_blocks) {
  std::vector<double> ids;
  for (std::size_t block = 1; block <= num_blocks; ++block) {
    const io::VariableInFile* const of_block = file.find("global_id" + std::to_string(block));
    if (of_block == nullptr) return {};
    const std::vector<double> numbers = file.numbers(*of_block);
    ids.insert(ids.end(), numbers.begin(), numbers.end());
  }
  return ids;
}

// Returns the place of each number 1 to n among `numbers`, or nothing if they are not these
// numbers, each once.
std::vector<std::size_t> places_of_numbers(const std::vector<double>& numbers, std::size_t n) {
  std::vector<std::size_t> places(n, n);
  if (numbers.size() != n) return {};
  for (std::size_t k = 0; k < n; ++k) {
    const double number = numbers[k];
    if (!(number >= 1 && number <= static_cast<double>(n)) || number != std::floor(number))
      return {};
    std::size_t& place = places[static_cast<std::size_t>(number) - 1];
    if (place != n) return {};
    place = k;
  }
  return places;
}

// Puts the cells into the order of their numbers. The blocks have them sorted by their number of
// corners.
void order_by_number(const NetcdfReader& file, std::size_t num_blocks, MeshContent& mesh) {
  const std::size_t n = mesh.cells.num_cells();
  const io::VariableInFile* const map = file.find("elem_num_map");
  std::vector<std::size_t> places;
  if (map != nullptr) places = places_of_numbers(file.numbers(*map), n);
  // A map may be there and not be a permutation; then the numbers of TempestRemap may serve.
  if (places.empty()) places = places_of_numbers(ids_of_blocks(file, num_blocks), n);
  if (places.empty()) {
    if (map == nullptr) return;
    mesh.remarks.push_back("the numbers of " + io::in_quotes(map->name) + " are not 1 to " +
                           std::to_string(n) + ", each once: cells are in the order of the blocks");
    return;
  }
  CellRings ordered;
  for (const std::size_t place : places) ordered.append_cell(mesh.cells, place);
  mesh.cells = std::move(ordered);
}

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
  const mesh::VoronoiMesh& arrays = file.arrays();
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

std::optional<MeshContent> read_exodus(const NetcdfReader& file, const std::string& name) {
  const io::VariableInFile* const block_1 = file.find("connect1");
  if (block_1 == nullptr || !is_meant(file, name, *block_1)) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "Exodus";
  mesh.nodes = lonlats(points_of_exodus(file));
  mesh.names = "the coordinates";
  std::size_t num_along_parallels = 0;
  std::size_t num_blocks = 0;
  while (const io::VariableInFile* const corners =
             file.find("connect" + std::to_string(num_blocks + 1))) {
    const std::size_t block = ++num_blocks;
    const auto& shape = require_rank(*corners, 2).shape;
    take_connectivity(file, {*corners, shape[0], shape[1], false, 1, 1}, {}, mesh);
    if (const io::VariableInFile* const kinds = file.find("edge_type" + std::to_string(block))) {
      // In `edge_type`, 0 is an arc of a great circle and 1 an arc of a parallel.
      for (const double kind : file.numbers(*kinds)) num_along_parallels += kind == 1 ? 1U : 0U;
    }
  }
  order_by_number(file, num_blocks, mesh);
  if (num_along_parallels > 0) {
    mesh.remarks.push_back(std::to_string(num_along_parallels) +
                           " sides along parallels (edge_type) are taken for great circles");
  }
  return mesh;
}

// Groups the cells by their number of corners with a counting sort.
CellBlocks blocks_of(const mesh::VoronoiMesh& arrays, const CellCorners& corners) {
  system::RowPlaces<std::size_t> places(arrays.max_edges() + 1);
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) places.count(corners.count(i));
  CellBlocks blocks;
  blocks.cells.resize(places.sum());
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) {
    blocks.cells[places.place(corners.count(i))] = static_cast<Index>(i);
  }
  const std::vector<std::size_t> begins = std::move(places).offsets();
  for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
    if (begins[k] == begins[k + 1]) continue;
    blocks.begins.push_back(begins[k]);
    blocks.corners.push_back(k);
  }
  blocks.begins.push_back(begins.back());
  return blocks;
}

// The order of the variables is that in which they are written.
void define_exodus(MeshFile& file, const CellCorners& corners, const CellBlocks& blocks) {
  const mesh::VoronoiMesh& arrays = file.arrays();
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
    const std::size_t corners_per_cell = blocks.corners[b];
    const std::size_t in_block =
        file.dimension(("num_el_in_blk" + number).c_str(), blocks.begins[b + 1] - begin);
    const std::size_t per_element =
        file.dimension(("num_nod_per_el" + number).c_str(), corners_per_cell);
    file.indices(("connect" + number).c_str(), {in_block, per_element},
                 {{"elem_type", element_type(corners_per_cell).c_str()}},
                 blocks.begins[b + 1] - begin, corners_per_cell,
                 [&corners, &blocks, begin](std::size_t i, std::int32_t* out) {
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

}  // namespace rondel::formats
