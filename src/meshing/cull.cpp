// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Removes cells from a mesh: decides which edges and vertices stay, and renumbers what stays.

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>

#include "meshing/consistency.h"
#include "rondel/error.h"
#include "rondel/mesh_cull.h"
#include "system/job.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::mesh {
namespace {

constexpr std::size_t cull_grain = 4096;

// Numbers the elements that stay, whose entry is not no_index before, in their order; returns how
// many.
std::size_t number_kept(std::vector<Index>& numbers) {
  Index next = 0;
  for (Index& number : numbers) {
    if (number != no_index) number = next++;
  }
  return next;
}

// The arrays before and after. The maps from old to new numbers are a part of the result.
class Culler {
 public:
  Culler(const VoronoiMesh& arrays, std::span<const std::uint8_t> is_removed, unsigned threads)
      : from_(arrays), is_removed_(is_removed), threads_(threads), to_(culled_.arrays) {}

  Culled cull() {
    mark();
    num_cells_ = number_kept(culled_.cells);
    num_edges_ = number_kept(culled_.edges);
    num_vertices_ = number_kept(culled_.vertices);
    if (num_cells_ == 0) throw InvalidInput("no cell of the mesh is left");
    to_.radius = from_.radius;
    keep_cells();
    keep_edges();
    keep_vertices();
    return std::move(culled_);
  }

 private:
  // Sets the numbers of all cells, edges and vertices that stay to 0, those of the others to
  // no_index.
  void mark() {
    culled_.cells.assign(from_.num_cells(), no_index);
    culled_.edges.assign(from_.num_edges(), no_index);
    culled_.vertices.assign(from_.num_vertices(), no_index);
    for (std::size_t i = 0; i < from_.num_cells(); ++i) {
      if (is_removed_[i] != 0) continue;
      culled_.cells[i] = 0;
      for (std::uint64_t at = from_.edges_on_cell.offsets[i];
           at < from_.edges_on_cell.offsets[i + 1]; ++at) {
        culled_.edges[from_.edges_on_cell.values[at]] = 0;
        culled_.vertices[from_.vertices_on_cell[at]] = 0;
      }
    }
  }

  // Calls keep(before, now) with the old and new number of each element that stays.
  template <class Keep>
  void for_each_kept(const std::vector<Index>& numbers, const Keep& keep) const {
    system::parallel_for(threads_, numbers.size(), cull_grain,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = begin; i < end; ++i) {
                             if (numbers[i] != no_index) keep(i, numbers[i]);
                           }
                         });
  }
  // Copies the values of the elements that stay.
  template <class Value>
  void keep_values(const std::vector<Index>& numbers, std::size_t size,
                   const std::vector<Value>& before, std::vector<Value>& now) const {
    now.resize(size);
    for_each_kept(numbers, [&](std::size_t i, Index number) { now[number] = before[i]; });
  }
  // Returns the new number of an element, and no_index for one that is gone or was none before.
  static Index renumbered(const std::vector<Index>& numbers, Index index) {
    return index == no_index ? no_index : numbers[index];
  }

  // Copies what belongs to the cells that stay.
  void keep_cells() {
    keep_values(culled_.cells, num_cells_, from_.cell_points, to_.cell_points);
    keep_values(culled_.cells, num_cells_, from_.cell_areas, to_.cell_areas);
    if (!from_.density.empty()) {
      keep_values(culled_.cells, num_cells_, from_.density, to_.density);
    }
    auto& offsets = to_.edges_on_cell.offsets;
    offsets.assign(num_cells_ + 1, 0);
    for_each_kept(culled_.cells, [&](std::size_t i, Index number) {
      offsets[number + 1] = from_.edges_on_cell[i].size();
    });
    system::sum_counts(offsets);
    to_.edges_on_cell.values.resize(to_.edges_on_cell.offsets.back());
    to_.cells_on_cell.resize(to_.edges_on_cell.offsets.back());
    to_.vertices_on_cell.resize(to_.edges_on_cell.offsets.back());
    for_each_kept(culled_.cells, [&](std::size_t i, Index number) {
      std::uint64_t out = to_.edges_on_cell.offsets[number];
      for (std::uint64_t at = from_.edges_on_cell.offsets[i];
           at < from_.edges_on_cell.offsets[i + 1]; ++at, ++out) {
        to_.edges_on_cell.values[out] = culled_.edges[from_.edges_on_cell.values[at]];
        to_.cells_on_cell[out] = renumbered(culled_.cells, from_.cells_on_cell[at]);
        to_.vertices_on_cell[out] = culled_.vertices[from_.vertices_on_cell[at]];
      }
    });
  }

  // Copies what belongs to the edges that stay. An edge that loses its first cell is turned around.
  void keep_edges() {
    keep_values(culled_.edges, num_edges_, from_.edge_points, to_.edge_points);
    keep_values(culled_.edges, num_edges_, from_.cell_distances, to_.cell_distances);
    keep_values(culled_.edges, num_edges_, from_.vertex_distances, to_.vertex_distances);
    keep_values(culled_.edges, num_edges_, from_.normal_angles, to_.normal_angles);
    to_.cells_on_edge.resize(num_edges_);
    to_.vertices_on_edge.resize(num_edges_);
    for_each_kept(culled_.edges, [&](std::size_t e, Index number) {
      auto& cells = to_.cells_on_edge[number];
      auto& ends = to_.vertices_on_edge[number];
      for (std::size_t side = 0; side < 2; ++side) {
        cells[side] = renumbered(culled_.cells, from_.cells_on_edge[e][side]);
        ends[side] = renumbered(culled_.vertices, from_.vertices_on_edge[e][side]);
      }
      if (cells[0] != no_index) return;
      std::swap(cells[0], cells[1]);
      std::swap(ends[0], ends[1]);
      double& angle = to_.normal_angles[number];
      angle += angle > 0 ? -std::numbers::pi : std::numbers::pi;
    });
  }

  // Copies what belongs to the vertices that stay.
  void keep_vertices() {
    keep_values(culled_.vertices, num_vertices_, from_.vertex_points, to_.vertex_points);
    keep_values(culled_.vertices, num_vertices_, from_.kite_areas, to_.kite_areas);
    keep_values(culled_.vertices, num_vertices_, from_.triangle_areas, to_.triangle_areas);
    to_.cells_on_vertex.resize(num_vertices_);
    to_.edges_on_vertex.resize(num_vertices_);
    for_each_kept(culled_.vertices, [&](std::size_t v, Index number) {
      auto& kites = to_.kite_areas[number];
      bool lost_one = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index cell = from_.cells_on_vertex[v][k];
        to_.cells_on_vertex[number][k] = renumbered(culled_.cells, cell);
        to_.edges_on_vertex[number][k] = renumbered(culled_.edges, from_.edges_on_vertex[v][k]);
        if (cell == no_index || culled_.cells[cell] != no_index) continue;
        kites[k] = 0;
        lost_one = true;
      }
      if (lost_one) to_.triangle_areas[number] = kites[0] + kites[1] + kites[2];
    });
  }

  const VoronoiMesh& from_;
  std::span<const std::uint8_t> is_removed_;
  unsigned threads_;
  Culled culled_;
  VoronoiMesh& to_;
  std::size_t num_cells_ = 0;
  std::size_t num_edges_ = 0;
  std::size_t num_vertices_ = 0;
};

}  // namespace

Culled cull(const VoronoiMesh& arrays, std::span<const std::uint8_t> is_removed,
            const Execution& execution) {
  const system::Call call(execution);
  meshing::require_consistent(arrays, execution.threads);
  if (is_removed.size() != arrays.num_cells()) {
    throw InvalidInput("there are " + std::to_string(is_removed.size()) + " numbers for " +
                           std::to_string(arrays.num_cells()) + " cells",
                       0);
  }
  return Culler(arrays, is_removed, execution.threads).cull();
}

}  // namespace rondel::mesh
