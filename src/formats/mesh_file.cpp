// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes a Voronoi mesh as a file: mesh::write() picks the convention, whose define_...() says
// which variables there are, and MeshFile::write() computes and writes their values. write_graph()
// writes the neighbors of cells for METIS. Coordinates are computed here, the same for all
// conventions.
#include "formats/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/angles.h"
#include "exact/vector.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "meshing/consistency.h"
#include "system/disjoint_sets.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// Returns an angle from 0 to less than `whole`, the size of a turn. Rounding may turn an angle just
// below 0 into a whole turn, which becomes 0.
double in_turn(double angle, double whole) {
  const double moved = angle < 0 ? angle + whole : angle;
  return moved < whole ? moved : 0;
}

const mesh::VoronoiMesh& no_arrays() {
  static const mesh::VoronoiMesh nothing;
  return nothing;
}

}  // namespace

// The function argument() gives the same bits on every machine, so that files have the same bytes.
double longitude_of(const Point& p) { return in_turn(exact::argument(p.y, p.x), turn); }

double latitude_of(const Point& p) {
  return exact::argument(p.z, std::sqrt(p.x * p.x + p.y * p.y));
}

double longitude_deg_of(const Point& p) {
  return in_turn(exact::argument(p.y, p.x) * (180 / std::numbers::pi), 360);
}

double latitude_deg_of(const Point& p) {
  return std::clamp(latitude_of(p) * (180 / std::numbers::pi), -90.0, 90.0);
}

MeshFile::MeshFile(io::AtomicFile& file, const Execution& execution)
    : arrays_(no_arrays()), execution_(execution), out_(file) {}

io::NetcdfVariable MeshFile::variable(const char* name, io::NetcdfType type,
                                      std::vector<std::size_t> dimensions, Texts texts) {
  io::NetcdfVariable result{name, type, std::move(dimensions), {}};
  for (const auto& [key, text] : texts) {
    result.attributes.push_back({key, io::NetcdfType::text, text, {}});
  }
  return result;
}

void MeshFile::set(io::NetcdfVariable& variable, const char* name, double number) {
  variable.attributes.push_back({name, variable.type, "", {number}});
}

void MeshFile::write(const NetcdfOptions& options) {
  out_.begin(options);
  std::size_t done = 0;
  for (const auto& write : writes_) {
    write(nullptr);
    system::announce(execution_, "write", ++done, writes_.size());
  }
  out_.finish();
}

// Each vertex is represented by the lowest of the vertices with which it is joined.
CellCorners::CellCorners(const mesh::VoronoiMesh& arrays) : arrays_(arrays) {
  if (std::ranges::find(arrays.vertex_distances, 0.0) == arrays.vertex_distances.end()) return;
  system::DisjointSets sets(arrays.num_vertices());
  for (std::size_t e = 0; e < arrays.num_edges(); ++e) {
    if (arrays.vertex_distances[e] != 0) continue;
    sets.join(arrays.vertices_on_edge[e][0], arrays.vertices_on_edge[e][1]);
  }
  joined_.reserve(arrays.num_vertices());
  for (Index v = 0; v < arrays.num_vertices(); ++v) joined_.push_back(sets[v]);
}

}  // namespace rondel::formats

namespace rondel::mesh {

std::string_view name_of(MeshFormat format) noexcept {
  return system::name_in({"mpas", "ugrid", "scrip", "esmf", "exodus"}, format);
}

void write(const FileName& name, const VoronoiMesh& arrays, const MeshFileOptions& options,
           const Execution& execution) {
  const system::Call call(execution);
  meshing::require_consistent(arrays, execution.threads);
  const formats::CellCorners corners(arrays);
  formats::CellBlocks blocks;
  io::AtomicFile output(name);
  formats::MeshFile file(output, arrays, execution);
  switch (options.format) {
    case MeshFormat::mpas:
      formats::define_mpas(file);
      break;
    case MeshFormat::ugrid:
      formats::define_ugrid(file, corners);
      break;
    case MeshFormat::scrip:
      formats::define_scrip(file, corners);
      break;
    case MeshFormat::esmf:
      formats::define_esmf(file, corners);
      break;
    case MeshFormat::exodus:
      blocks = formats::blocks_of(arrays, corners);
      formats::define_exodus(file, corners, blocks);
      break;
  }
  NetcdfOptions netcdf = io::with_kind({options.kind, options.deflate}, name);
  // Where neither options nor the ending say it, CDF-5 has room for variables of any size.
  if (netcdf.kind == NetcdfKind::by_name) netcdf.kind = NetcdfKind::cdf5;
  io::in_file(name.path, [&] { file.write(netcdf); });
  output.commit();
}

// Writes the graph in the format of METIS: the numbers of cells and edges, then a line for each
// cell with its neighbors, counted from 1.
void write_graph(const FileName& name, const VoronoiMesh& arrays, const Execution& execution) {
  const system::Call call(execution);
  meshing::require_consistent(arrays, execution.threads);
  io::AtomicFile file(name);
  // METIS counts each pair of neighbors once; an edge at the border joins no two cells.
  const auto edges = std::ranges::count_if(
      arrays.cells_on_edge, [](const auto& cells) { return !meshing::is_at_border(cells); });
  file.write(std::to_string(arrays.num_cells()) + ' ' + std::to_string(edges) + '\n');
  io::write_in_parallel(file, execution.threads, arrays.num_cells(), io::items_per_piece,
                        [&](std::string& text, std::size_t begin, std::size_t end) {
                          for (std::size_t i = begin; i < end; ++i) {
                            bool is_first = true;
                            for (std::uint64_t at = arrays.edges_on_cell.offsets[i];
                                 at < arrays.edges_on_cell.offsets[i + 1]; ++at) {
                              if (arrays.cells_on_cell[at] == no_index) continue;
                              if (!is_first) text += ' ';
                              is_first = false;
                              text += std::to_string(arrays.cells_on_cell[at] + 1);
                            }
                            text += '\n';
                          }
                        });
  file.commit();
}

}  // namespace rondel::mesh
