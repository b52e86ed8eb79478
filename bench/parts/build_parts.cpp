// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Measures whole builds: order, triangulation, canonical result.

#include "parts.h"
#include "rondel/hull.h"

namespace rondel::bench {
namespace {

void build(benchmark::State& state, const std::string& kind, Model model) {
  Inputs inputs(kind, state.range(0));
  for (auto _ : state) {
    const auto& sites = inputs.next();
    benchmark::DoNotOptimize(delaunay(Sites::view(sites), {.model = model}, {.threads = 1}));
  }
  report_each(state, static_cast<std::size_t>(state.range(0)));
}

void hull(benchmark::State& state, const std::string& kind) {
  const auto points = make_input(kind, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(convex_hull(Sites::view(points), {.threads = 1}));
  report_each(state, points.size());
}

BENCHMARK_CAPTURE(build, uniform_projected, "uniform", Model::projected)
    ->Arg(small_size)
    ->Arg(large_size);
BENCHMARK_CAPTURE(build, uniform_weighted, "uniform", Model::weighted)
    ->Arg(small_size)
    ->Arg(large_size);
BENCHMARK_CAPTURE(build, grid_projected, "grid", Model::projected)->Arg(large_size);
BENCHMARK_CAPTURE(build, fibonacci_projected, "fibonacci", Model::projected)->Arg(large_size);
BENCHMARK_CAPTURE(hull, ball, "ball")->Arg(large_size);

}  // namespace
}  // namespace rondel::bench
