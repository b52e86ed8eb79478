// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Measures the canonical result, written from a mesh whose faces are already in that order in
// memory; a mesh directly after its construction causes more cache misses.

#include <algorithm>

#include "kernel/canonical.h"
#include "order/spatial_order.h"
#include "parts.h"
#include "topology/mesh.h"

namespace rondel::bench {
namespace {

unsigned edge_to(const Triple& neighbors, Index face) {
  return static_cast<unsigned>(std::ranges::find(neighbors, face) - neighbors.begin());
}

topology::Mesh mesh_of(const Triangulation& triangulation, const std::vector<Index>& order) {
  std::vector<Index> ranks(order.size());
  for (Index rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  const auto faces = triangulation.faces();
  const auto neighbors = triangulation.neighbors();
  topology::Mesh mesh;
  mesh.reserve(faces.size());
  for (Index f = 0; f < faces.size(); ++f) {
    topology::Face& face = mesh[mesh.add_face()];
    for (unsigned i = 0; i < 3; ++i) {
      const Index g = neighbors[f][i];
      face.vertex[i] = ranks[faces[f][i]];
      face.opposite[i] = topology::halfedge(g, edge_to(neighbors[g], f));
    }
  }
  return mesh;
}

void canonical_result(benchmark::State& state) {
  const Case& uniform = case_of("uniform", state.range(0));
  const auto order = order::spatial_order(uniform.sites, Model::projected, {}, 1).order;
  const auto unsorted = mesh_of(uniform.triangulation, order);
  topology::Mesh mesh;
  TriangulationArrays arrays;
  for (auto _ : state) {
    state.PauseTiming();
    mesh = unsorted;
    arrays = {};
    std::vector<Index> scratch(order.size());
    state.ResumeTiming();
    kernel::write_canonical(mesh, order, std::move(scratch), arrays);
    benchmark::DoNotOptimize(arrays.faces.data());
  }
  report_each(state, uniform.sites.size());
}

BENCHMARK(canonical_result)->Arg(small_size)->Arg(large_size);

}  // namespace
}  // namespace rondel::bench
