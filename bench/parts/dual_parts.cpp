// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Measures what is computed from a triangulation.

#include "parts.h"
#include "rondel/diagram.h"

namespace rondel::bench {
namespace {

// Measures work(triangulation).
template <class Work>
void measure_dual(benchmark::State& state, Work work) {
  const Case& uniform = case_of("uniform", state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(work(uniform.triangulation));
  }
  report_each(state, uniform.sites.size());
}

void dual_circumcenters(benchmark::State& state) {
  measure_dual(state, [](const auto& t) { return circumcenters(t); });
}

void dual_cells(benchmark::State& state) {
  measure_dual(state, [](const auto& t) { return cells(t); });
}

void dual_cells_and_areas(benchmark::State& state) {
  measure_dual(state, [](const auto& t) { return diagram(t); });
}

void dual_edges(benchmark::State& state) {
  measure_dual(state, [](const auto& t) { return edges(t); });
}

void dual_merged_facets(benchmark::State& state) {
  measure_dual(state, [](const auto& t) { return merge_cocircular(t); });
}

BENCHMARK(dual_circumcenters)->Arg(small_size)->Arg(large_size);
BENCHMARK(dual_cells)->Arg(small_size)->Arg(large_size);
BENCHMARK(dual_cells_and_areas)->Arg(small_size)->Arg(large_size);
BENCHMARK(dual_edges)->Arg(large_size);
BENCHMARK(dual_merged_facets)->Arg(large_size);

}  // namespace
}  // namespace rondel::bench
