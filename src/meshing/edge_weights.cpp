// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The weights of TRiSK (Thuburn et al. 2009). Around a cell, from an edge e counterclockwise to an
// edge e',
//
//     w(e, e') = +-(1/2 - sum of the kites between e and e' / area of the cell) l(e') / d(e),
//
// where l is the length of an edge and d the distance of its cells. The sign is positive if the
// normal of e' points out of the cell, and is reversed if the normal of e points into the cell.

#include <string>

#include "meshing/consistency.h"
#include "meshing/mesh_arrays.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel::meshing {
namespace {

constexpr std::size_t weights_grain = 4096;

// Returns the kite of a vertex that belongs to a cell.
double kite_of(const mesh::VoronoiMesh& arrays, Index vertex, Index cell) {
  const Triple& cells = arrays.cells_on_vertex[vertex];
  const std::size_t i = cells[0] == cell ? 0 : cells[1] == cell ? 1 : 2;
  return arrays.kite_areas[vertex][i];
}

}  // namespace

// The row of an edge has the other edges of its one or two cells.
std::size_t num_weights(const mesh::VoronoiMesh& arrays, std::size_t edge) {
  std::size_t count = 0;
  for (const Index cell : arrays.cells_on_edge[edge]) {
    if (cell == no_index) continue;
    count += static_cast<std::size_t>(arrays.edges_on_cell.offsets[cell + 1] -
                                      arrays.edges_on_cell.offsets[cell]) -
             1;
  }
  return count;
}

void write_weights(const mesh::VoronoiMesh& arrays, std::size_t edge, std::span<Index> edges,
                   std::span<double> weights) {
  std::size_t out = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Index cell = arrays.cells_on_edge[edge][side];
    if (cell == no_index) continue;
    const std::uint64_t begin = arrays.edges_on_cell.offsets[cell];
    const std::uint64_t end = arrays.edges_on_cell.offsets[cell + 1];
    std::uint64_t at = begin;
    while (at < end && arrays.edges_on_cell.values[at] != edge) ++at;
    if (at == end) {
      throw InvalidInput("edge " + std::to_string(edge) +
                             " of the mesh is not among those of cell " + std::to_string(cell),
                         edge);
    }
    double sum = 0;
    for (std::uint64_t left = end - begin - 1; left > 0; --left, ++out) {
      if (!weights.empty()) sum += kite_of(arrays, arrays.vertices_on_cell[at], cell);
      at = at + 1 < end ? at + 1 : begin;
      const Index other = arrays.edges_on_cell.values[at];
      if (!edges.empty()) edges[out] = other;
      if (weights.empty()) continue;
      const bool is_leaving = arrays.cells_on_edge[other][0] == cell;
      const double part = (0.5 - sum / arrays.cell_areas[cell]) * arrays.vertex_distances[other] /
                          arrays.cell_distances[edge];
      weights[out] = is_leaving == (side == 0) ? part : -part;
    }
  }
}

}  // namespace rondel::meshing

namespace rondel::mesh {

TangentialWeights tangential_weights(const VoronoiMesh& arrays, const Execution& execution) {
  const system::Call call(execution);
  meshing::require_consistent(arrays, execution.threads);
  TangentialWeights result;
  auto& [offsets, edges] = result.edges;
  offsets = system::offsets_of(arrays.num_edges(),
                               [&](std::size_t e) { return meshing::num_weights(arrays, e); });
  edges.resize(offsets.back());
  result.weights.resize(offsets.back());
  system::parallel_for(
      execution.threads, arrays.num_edges(), meshing::weights_grain,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
          const auto first = static_cast<std::size_t>(result.edges.offsets[e]);
          const auto size = static_cast<std::size_t>(result.edges.offsets[e + 1]) - first;
          meshing::write_weights(arrays, e, std::span(result.edges.values).subspan(first, size),
                                 std::span(result.weights).subspan(first, size));
        }
      });
  return result;
}

}  // namespace rondel::mesh
